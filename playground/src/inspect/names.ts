// Names of robots and kinds of records, as the page shows them.

import { run } from "../app/context.ts";

export const nameOf = (robot: number): string => run.fleet.value[robot]?.name ?? `robot ${robot}`;

export const CONDITIONS = ["running", "finished", "failed", "down", "left"] as const;

/** `/starl/action` as `action`. */
export const kindOf = (topic: string): string => topic.slice(topic.lastIndexOf("/") + 1);
