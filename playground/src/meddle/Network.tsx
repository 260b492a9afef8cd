// The network while it runs: loss, delay, jitter, range, and cuts.

import { useSignal } from "@preact/signals";
import { run } from "../app/context.ts";
import type { NetworkKnob } from "../engine/types.ts";
import { nameOf } from "../inspect/names.ts";
import { readGroups } from "./fields.ts";
import { Text } from "./inputs.tsx";
import { said, steer, steerAndShow } from "./steering.ts";
import { byName, targets } from "./targets.ts";

export function Network() {
  const groups = useSignal("");
  const now = new Map(run.report.value?.network.flatMap((knob) => Object.entries(knob)));
  const chosen = targets.value;
  const cut = () => {
    try {
      void steer({ fault: { partition: readGroups(groups.value, byName()) } });
    } catch (error) {
      said.value = { good: false, text: `The groups cannot be read: ${(error as Error).message}` };
    }
  };
  return (
    <>
      <Knob
        label="Loss"
        unit="%"
        most={100}
        now={percent(now.get("loss"))}
        make={(value) => ({ loss: value / 100 })}
      />
      <Knob
        label="Delay"
        unit="ms"
        most={500}
        now={ms(now.get("delay"))}
        make={(value) => ({ delay: ns(value) })}
      />
      <Knob
        label="Jitter"
        unit="ms"
        most={500}
        now={ms(now.get("jitter"))}
        make={(value) => ({ jitter: ns(value) })}
      />
      <Knob
        label="Range"
        unit="m"
        most={50}
        now={now.get("range") ?? null}
        make={(value) => ({ range: value })}
      />
      <div class="acts">
        <button
          type="button"
          disabled={now.get("range") === null}
          onClick={() => steerAndShow({ network: [{ range: null }] })}
        >
          Unlimited range
        </button>
        <button
          type="button"
          disabled={chosen.length === 0}
          title={`Cut off ${chosen.slice(0, 6).map(nameOf).join(", ")}`}
          onClick={() => steer({ fault: { partition: [chosen] } })}
        >
          Cut these robots off
        </button>
        <button type="button" onClick={() => steer({ fault: "heal" })}>
          Heal
        </button>
      </div>
      <div class="acts">
        <Text label="Groups that hear each other" value={groups} placeholder="robot0, robot1 | robot2" />
        <button type="button" disabled={groups.value.trim() === ""} onClick={cut}>
          Cut
        </button>
      </div>
    </>
  );
}

interface KnobProps {
  label: string;
  unit: string;
  most: number;
  /** The value now; null if unlimited. */
  now: number | null;
  make: (value: number) => NetworkKnob;
}

/** A slider and a field for the same number; it is applied when a person lets go. */
function Knob({ label, unit, most, now, make }: KnobProps) {
  // The input that is not applied yet: a run that plays draws the fields again all the time.
  const drawn = useSignal<string | null>(null);
  const shown = drawn.value ?? now;
  const draw = (event: InputEvent & { currentTarget: HTMLInputElement }) => {
    drawn.value = event.currentTarget.value;
  };
  const apply = (text: string) => {
    const value = Number(text);
    drawn.value = null;
    if (text !== "" && Number.isFinite(value)) void steerAndShow({ network: [make(value)] });
  };
  return (
    <div class="knob">
      <span class="name">{label}</span>
      <input
        type="range"
        min={0}
        max={most}
        step={most / 100}
        value={shown ?? most}
        aria-label={`${label}, ${unit}`}
        onInput={draw}
        onChange={(event) => apply(event.currentTarget.value)}
      />
      <input
        type="number"
        min={0}
        step="any"
        value={shown ?? ""}
        placeholder="unlimited"
        onClick={(event) => drawn.value === null && event.currentTarget.select()}
        aria-label={`${label} as a number, ${unit}`}
        onInput={draw}
        onChange={(event) => apply(event.currentTarget.value)}
      />
      <span class="unit">{unit}</span>
    </div>
  );
}

const ns = (ms: number) => Math.round(ms * 1e6);
const ms = (ns: unknown) => (typeof ns === "number" ? ns / 1e6 : null);
const percent = (share: unknown) => (typeof share === "number" ? Number((share * 100).toFixed(3)) : null);
