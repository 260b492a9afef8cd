// Which fields the form shows, and in which order: what most people set comes first.

import { signal } from "@preact/signals";
import { run } from "../app/context.ts";
import { type Field, fieldsOf, type Schema } from "./schema.ts";

const FIRST = ["robots", "duration", "network", "program", "seed", "parameters", "world"];

/** Null until the simulator has answered. */
export const schema = signal<Schema | null>(null);
export const unavailable = signal(false);

export async function loadSchema(): Promise<void> {
  if (schema.value) return;
  try {
    schema.value = await run.client.ask<Schema>({ raw: { schema: {} } });
    unavailable.value = false;
  } catch {
    unavailable.value = true;
  }
}

/** The fields of the scenario: those with one value together, then the tables. */
export function ordered(root: Schema): { single: Field[]; tables: Field[] } {
  const rank = ({ name }: Field) => (FIRST.includes(name) ? FIRST.indexOf(name) : FIRST.length);
  const fields = fieldsOf(root).sort((one, other) => rank(one) - rank(other));
  const isTable = ({ table, kind }: Field) => table !== null || kind === "parameters";
  return { single: fields.filter((field) => !isTable(field)), tables: fields.filter(isTable) };
}
