// The elements of a list of tables: their fields, their first values, and the words that describe them.

import { type Field, fieldsOfModel, type Schema } from "./schema.ts";
import { isTable, type Table } from "./table.ts";
import type { Toml } from "./toml/edit.ts";
import { show } from "./values.ts";

/** Parameters of a model are known by their names. */
export function withModel(fields: Field[], table: Schema, value: Table): Field[] {
  if (typeof value.model !== "string") return fields;
  const own = fieldsOfModel(table, value.model);
  return fields.map((field) =>
    field.kind === "model_parameters" && own.length > 0
      ? { ...field, kind: "table", table: { properties: schemasOf(table, value.model as string) } }
      : field,
  );
}

function schemasOf(table: Schema, model: string): Record<string, Schema> {
  for (const { if: condition, then } of table.allOf ?? []) {
    if (condition?.properties?.model?.const === model)
      return Object.values(then?.properties ?? {})[0]?.properties ?? {};
  }
  return {};
}

/** The required fields of a new element. */
export function first(name: string, fields: Field[], values: Table[]): Table {
  const made: Table = {};
  const taken = new Set(values.map((value) => value.name));
  for (const field of fields.filter(({ required }) => required)) made[field.name] = example(field, taken);
  if (name === "robots") made.count = 1;
  if (name === "obstacle") made.circle = { center: [1, 1], radius: "20cm" };
  if (name === "fault" || name === "event") made.at = "10s";
  if (name === "fault") made.robots = "all";
  return made;
}

function example({ kind, choices, units }: Field, taken: Set<Toml | undefined>): Toml {
  if (kind === "point" || kind === "planar_point") return [0, 0];
  if (choices[0] !== undefined) return choices[0];
  if (kind === "quantity") return `1${units[0] === "ns" ? "s" : (units.at(-1) ?? "")}`;
  if (kind === "count") return 0;
  return nextName(taken);
}

/** A, B, C, ..., and then P1, P2, ... */
export function nextName(taken: Set<unknown>): string {
  for (let index = 0; ; index++) {
    const name = index < 26 ? String.fromCharCode(65 + index) : `P${index - 25}`;
    if (!taken.has(name)) return name;
  }
}

export function describe(value: Table, index: number, one: string): string {
  const shown = ["name", "model", "kind", "at", "count"].filter(
    (key) => value[key] !== undefined && !isTable(value[key]),
  );
  const words = shown.map((key) =>
    key === "count" ? `× ${value.count}` : show({ kind: "text" }, value[key]),
  );
  const shape = ["circle", "rectangle", "polygon", "box"].find((key) => value[key] !== undefined);
  return words.length > 0 ? words.join(" ") : (shape ?? `${one} ${index + 1}`);
}

/** The word for one of the elements. */
export const singular = (label: string) => (label === "Robots" ? "Group" : label.replace(/s$/, ""));
