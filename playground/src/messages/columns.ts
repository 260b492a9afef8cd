// The order of the robots in the diagram: those that a person has chosen first.

import { computed } from "@preact/signals";
import { run } from "../app/context.ts";

/** The robot of each column. */
export const robotsInOrder = computed(() => {
  const chosen = run.selected.value.filter((robot) => robot < run.fleet.value.length);
  const first = new Set(chosen);
  return [...chosen, ...run.fleet.value.map(({ id }) => id).filter((id) => !first.has(id))];
});

/** The column of each robot. */
export const columnOf = computed(() => {
  const columns: number[] = [];
  for (const [column, robot] of robotsInOrder.value.entries()) columns[robot] = column;
  return columns;
});
