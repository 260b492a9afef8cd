// Tables of a scenario, as they are read.

import type { Toml } from "./toml/edit.ts";

export type Table = { [key: string]: Toml };

export const isTable = (value: unknown): value is Table =>
  typeof value === "object" && value !== null && !Array.isArray(value) && !(value instanceof Date);

export const tablesOf = (value: unknown): Table[] => (Array.isArray(value) ? value.filter(isTable) : []);
