// The list of all robots, with a filter.

import { computed, signal } from "@preact/signals";
import { useMemo } from "preact/hooks";
import { colorOf } from "../app/colors.ts";
import { run } from "../app/context.ts";
import { type Member, POSE_NUMBERS } from "../engine/types.ts";
import { CONDITIONS } from "./names.ts";
import { VirtualList } from "./VirtualList.tsx";

const ROW = 30;
/** A list this long needs no filter. */
const FEW = 8;
const MOST_ROWS = 7;

const query = signal("");
const several = signal(false);

export function Fleet() {
  const fleet = run.fleet.value;
  const states = run.states.value;
  const shown = matching(fleet, states, query.value);
  const chosen = new Set(run.selected.value);
  const choose = (index: number, event: { ctrlKey: boolean; metaKey: boolean; shiftKey: boolean }) => {
    const robot = shown[index]?.id;
    if (robot === undefined) return;
    const add = several.value || event.ctrlKey || event.metaKey || event.shiftKey;
    if (!add) run.select(chosen.has(robot) && chosen.size === 1 ? [] : [robot]);
    else if (chosen.has(robot)) run.select(run.selected.value.filter((other) => other !== robot));
    else run.select([...run.selected.value, robot]);
  };
  return (
    <section class="fleet" aria-label="Fleet">
      <div class="tools">
        {fleet.length > FEW && (
          <input
            type="search"
            placeholder={`Filter ${fleet.length} robots`}
            aria-label="Filter robots by name, model, program, condition or state"
            value={query.value}
            onInput={(event) => {
              query.value = event.currentTarget.value;
            }}
          />
        )}
        <label title="Each click adds a robot or takes it away; with Ctrl or Shift, too">
          <input
            type="checkbox"
            checked={several.value}
            onChange={(event) => {
              several.value = event.currentTarget.checked;
            }}
          />{" "}
          Choose several
        </label>
        {chosen.size > 0 && (
          <button type="button" class="small" onClick={() => run.select([])}>
            Choose none
          </button>
        )}
      </div>
      <div
        style={{ height: `${Math.max(1, Math.min(shown.length, MOST_ROWS)) * ROW + 2}px`, display: "grid" }}
      >
        <VirtualList
          label="Robots"
          several
          count={shown.length}
          rowHeight={ROW}
          selected={(index) => chosen.has(shown[index]?.id ?? -1)}
          choose={choose}
          row={(index) => {
            const member = shown[index];
            return member && <Row member={member} of={fleet.length} state={states[member.id] ?? null} />;
          }}
        />
      </div>
      {shown.length === 0 && <p class="muted">No robot matches.</p>}
    </section>
  );
}

function Row({ member, of, state }: { member: Member; of: number; state: string | null }) {
  // Poses change with every picture, conditions hardly ever.
  const now = useMemo(
    () => computed(() => CONDITIONS[run.poses.value[member.id * POSE_NUMBERS + POSE_NUMBERS - 1] ?? -1]),
    [member.id],
  );
  const condition = now.value ?? member.condition;
  return (
    <>
      <span class="swatch" style={{ background: colorOf(member.id, of) }} />
      <span class="grow">
        <strong>{member.name}</strong> <span class="muted">{member.model}</span>
      </span>
      {state && <span class="mono grow end">{state}</span>}
      <span class={`condition ${condition}`}>{condition}</span>
    </>
  );
}

function matching(fleet: Member[], states: (string | null)[], text: string): Member[] {
  const wanted = text.trim().toLowerCase();
  if (!wanted) return fleet;
  return fleet.filter(({ id, name, model, program, condition }) =>
    [name, model, program, condition, states[id] ?? ""].some((part) => part.toLowerCase().includes(wanted)),
  );
}
