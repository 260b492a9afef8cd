// The chosen robots in a trace. It has no variables, timers or guards, only records.

import { run } from "../app/context.ts";
import { seconds } from "../app/format.ts";
import { POSE_NUMBERS } from "../engine/types.ts";
import type { Event } from "../run/events.ts";
import { describe } from "../timeline/lanes.ts";
import { nameOf } from "./names.ts";

/** Events of a robot that are shown, and how many records are searched for them. */
const SHOWN = 8;
const SEARCHED = 4000;

export function Recorded() {
  return (
    <div class="recorded">
      <p class="muted">
        This run is a recording. It holds poses, messages, actions and events. Variables, enabled actions,
        timers and mailboxes are not in it. A simulated run can be run again here, exactly as it went.
      </p>
      <button type="button" disabled={run.opening.value} onClick={() => run.runAgain()}>
        {run.opening.value ? "Opening" : "Run it again here"}
      </button>
      {run.selected.value.map((robot) => (
        <Robot key={robot} robot={robot} />
      ))}
    </div>
  );
}

function Robot({ robot }: { robot: number }) {
  const poses = run.poses.value;
  const at = (place: number) => poses[robot * POSE_NUMBERS + place] ?? 0;
  const point = (place: number) => [0, 1, 2].map((axis) => at(place + axis).toFixed(3)).join(", ");
  return (
    <section>
      <h2>{nameOf(robot)}</h2>
      <dl>
        <dt>position</dt>
        <dd>({point(0)}) m</dd>
        <dt>heading</dt>
        <dd>{((at(3) * 180) / Math.PI).toFixed(1)}°</dd>
        <dt>estimated position</dt>
        <dd>({point(6)}) m</dd>
      </dl>
      <h3>Last events</h3>
      <ul>
        {lastOf(robot).map((event) => (
          <li key={event.index}>
            <button type="button" class="link" onClick={() => run.show(event)}>
              {seconds(event.time, 3)}
            </button>{" "}
            {describe(event, nameOf)}
          </li>
        ))}
      </ul>
    </section>
  );
}

function lastOf(robot: number): Event[] {
  void run.grown.value;
  const { list } = run.events;
  const end = run.events.before(run.position.value);
  const found: Event[] = [];
  for (let index = end - 1; index >= Math.max(0, end - SEARCHED) && found.length < SHOWN; index--) {
    const event = list[index];
    if (event?.message.robot === robot) found.push(event);
  }
  return found;
}
