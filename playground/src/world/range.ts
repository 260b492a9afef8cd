// The range of the radio: of the scenario, read when a run is opened, or what the run was steered to.

import { effect, signal } from "@preact/signals";
import { run } from "../app/context.ts";
import type { Happenings } from "./happenings.ts";

/** Of the scenario, m; null where it has none or cannot be asked, as for a recorded run. */
const ofScenario = signal<number | null>(null);

const METRES: Record<string, number> = { mm: 0.001, cm: 0.01, m: 1, km: 1000 };

effect(() => {
  const opened = run.opened.value;
  ofScenario.value = null;
  if (!opened?.live) return;
  void run
    .scenario()
    .then(async (text) => {
      const { parse } = await import("smol-toml");
      if (run.opened.value === opened) ofScenario.value = readRange(parse(text));
    })
    .catch(() => undefined);
});

/** `network.range` of a scenario, m. */
export function readRange(scenario: Record<string, unknown>): number | null {
  const range = (scenario.network as { range?: unknown } | undefined)?.range;
  if (typeof range === "number") return range;
  const [, number = "", unit = "m"] = /^\s*([\d.eE+-]+)\s*([a-z]*)\s*$/.exec(String(range ?? "")) ?? [];
  const metres = Number(number) * (METRES[unit || "m"] ?? Number.NaN);
  return number && Number.isFinite(metres) ? metres : null;
}

export function rangeOf(happenings: Happenings): number | null {
  const steered = happenings.range.current.get("range");
  return steered ? steered.metres : ofScenario.value;
}
