// Names of robots and their conditions.

import { run } from "../app/context.ts";

export const nameOf = (robot: number): string => run.fleet.value[robot]?.name ?? `robot ${robot}`;

export const CONDITIONS = ["running", "finished", "failed", "down", "left"] as const;
