// The robots that an act is for.

import { computed, signal } from "@preact/signals";
import { run } from "../app/context.ts";

/** `chosen`, `all`, or a robot's number. */
export const target = signal("chosen");

export const targets = computed((): number[] => {
  if (target.value === "chosen") return run.selected.value;
  const present = run.fleet.value.filter(({ condition }) => condition !== "left").map(({ id }) => id);
  return target.value === "all" ? present : present.filter((robot) => robot === Number(target.value));
});

/** Robots by their names. */
export const byName = (): Map<string, number> => new Map(run.fleet.value.map(({ name, id }) => [name, id]));
