// Actions on robots.

import { useSignal } from "@preact/signals";
import { run } from "../app/context.ts";
import type { Intervention } from "../engine/types.ts";
import { nameOf } from "../inspect/names.ts";
import { Choice, Numeric } from "./inputs.tsx";
import { steer } from "./steering.ts";
import { target, targets } from "./targets.ts";

/** A list of more robots does not help. */
const LISTED = 200;

const ACTS: { label: string; hint: string; make: (robots: number[]) => Intervention }[] = [
  {
    label: "Crash",
    hint: "It stops and hears nothing until it restarts",
    make: (crash) => ({ fault: { crash } }),
  },
  { label: "Restart", hint: "Its software starts again", make: (restart) => ({ fault: { restart } }) },
  {
    label: "Corrupt state",
    hint: "Its program's variables are overwritten at random",
    make: (corrupt_state) => ({ fault: { corrupt_state } }),
  },
  { label: "Stick motors", hint: "It cannot move", make: (stuck_motor) => ({ fault: { stuck_motor } }) },
  {
    label: "Freeze sensors",
    hint: "Its sensors keep their present readings",
    make: (frozen_sensor) => ({ fault: { frozen_sensor } }),
  },
  { label: "Repair", hint: "Motors and sensors work again", make: (repair) => ({ fault: { repair } }) },
  { label: "Leave", hint: "It leaves the run permanently", make: (leave) => ({ leave }) },
];

export function RobotFaults() {
  const [x, y, z] = [useSignal("0.2"), useSignal("0"), useSignal("0")];
  const robots = targets.value;
  const none = robots.length === 0;
  const fleet = run.fleet.value;
  const push = async () => {
    const by = { x: Number(x.value), y: Number(y.value), z: Number(z.value) };
    for (const robot of robots) if (!(await steer({ push: { robot, by } }))) return;
  };
  return (
    <>
      <Choice label="Robots" value={target}>
        <option value="chosen">
          {run.selected.value.length > 0
            ? `chosen: ${run.selected.value.slice(0, 6).map(nameOf).join(", ")}`
            : "chosen (none)"}
        </option>
        <option value="all">all {fleet.length}</option>
        {fleet.slice(0, LISTED).map(({ id, name }) => (
          <option key={id} value={String(id)}>
            {name}
          </option>
        ))}
      </Choice>
      <div class="acts">
        {ACTS.map(({ label, hint, make }) => (
          <button key={label} type="button" title={hint} disabled={none} onClick={() => steer(make(robots))}>
            {label}
          </button>
        ))}
      </div>
      <div class="acts">
        <Numeric label="Push by x, m" value={x} />
        <Numeric label="y, m" value={y} />
        <Numeric label="z, m" value={z} />
        <button type="button" disabled={none} onClick={push}>
          Push
        </button>
      </div>
      {none && <p class="muted">Choose robots in the list above, in the world, or under Robots.</p>}
    </>
  );
}
