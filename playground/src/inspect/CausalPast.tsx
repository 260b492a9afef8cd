// The last events that could have led to a violation.

import { run } from "../app/context.ts";
import { seconds } from "../app/format.ts";
import { sideTab } from "../app/shown.ts";
import { marked, markedPast } from "../messages/known.ts";
import { describe } from "../timeline/lanes.ts";
import { nameOf } from "./names.ts";
import { VirtualList } from "./VirtualList.tsx";

export function CausalPast() {
  const past = markedPast();
  if (!past) return null;
  const list = past.last;
  return (
    <section aria-label="Causal past">
      <h2>Possible causes</h2>
      <p class="muted">
        {past.count.toLocaleString("en")} events at {past.until.size}{" "}
        {past.until.size === 1 ? "robot" : "robots"} came before {marked.value?.text}, directly or through{" "}
        {past.messages.toLocaleString("en")} delivered messages.
        {list.length < past.count && ` These are the last ${list.length}.`} What robots sense of each other is
        not counted.
      </p>
      <div class="tools">
        <button
          type="button"
          class="small"
          onClick={() => {
            sideTab.value = "messages";
          }}
        >
          Show it in the diagram
        </button>
        <button
          type="button"
          class="small"
          onClick={() => {
            marked.value = null;
          }}
        >
          Remove the marks
        </button>
      </div>
      <div style={{ height: "200px", display: "grid" }}>
        <VirtualList
          label="Events of the causal past, the latest first"
          count={list.length}
          rowHeight={24}
          choose={(index) => {
            const event = list[index];
            if (event) void run.show(event);
          }}
          row={(index) => {
            const event = list[index];
            if (!event) return null;
            const text = describe(event, nameOf);
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
    </section>
  );
}
