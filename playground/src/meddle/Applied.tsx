// The list of what was done to the run.

import { run } from "../app/context.ts";
import { seconds } from "../app/format.ts";
import { nameOf } from "../inspect/names.ts";
import { VirtualList } from "../inspect/VirtualList.tsx";
import { interventions } from "./applied.ts";
import { recorded, wordsOf } from "./words.ts";

const ROW = 24;
const MOST_ROWS = 8;

export function Applied() {
  const list = interventions();
  if (list.length === 0) return <p class="muted">Nothing yet.</p>;
  return (
    <div style={{ height: `${Math.max(3, Math.min(MOST_ROWS, list.length)) * ROW + 2}px`, display: "grid" }}>
      <VirtualList
        label="What was done to the run"
        count={list.length}
        rowHeight={ROW}
        rowClass={(index) => ((list[index]?.index ?? 0) >= run.position.value ? "later" : "")}
        choose={(index) => {
          const event = list[index];
          if (event) void run.show(event);
        }}
        row={(index) => {
          const event = list[index];
          if (!event) return null;
          const intervention = recorded(event.message.intervention);
          const text = intervention ? wordsOf(intervention, nameOf) : String(event.message.intervention);
          return (
            <>
              <span class="time-cell muted">{seconds(event.time, 3)}</span>
              <span class="grow" title={text}>
                {text}
              </span>
            </>
          );
        }}
      />
    </div>
  );
}
