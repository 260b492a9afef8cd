// Values of a scenario as the text of a form's field, and back.

import { parse } from "smol-toml";
import type { Field } from "./schema.ts";
import { literal, type Toml } from "./toml/edit.ts";

const NUMBER = /^[+-]?(\d[\d_]*)(\.\d+)?([eE][+-]?\d+)?$/;

/** Kinds that are lists of numbers, written `1, 2.5`. */
const COORDINATES = new Set(["point", "planar_point", "velocity", "heights"]);
/** Kinds that are lists of names, written `a, b`. */
const NAMES = new Set(["texts", "robots"]);
const TEXTS = new Set(["text", "choice", "model"]);

export function show({ kind }: Pick<Field, "kind">, value: Toml | undefined): string {
  if (value === undefined) return "";
  if (typeof value === "string") return value;
  const isFlat = Array.isArray(value) && value.every((item) => typeof item !== "object");
  if (isFlat && (COORDINATES.has(kind) || NAMES.has(kind))) return value.join(", ");
  return literal(value);
}

/** Undefined for an empty field: the default holds. Throws with what to write instead. */
export function read({ kind, choices }: Pick<Field, "kind" | "choices">, text: string): Toml | undefined {
  const written = text.trim();
  if (written === "") return undefined;
  if (choices.includes(written) || TEXTS.has(kind)) return written;
  if (kind === "flag") return written === "true";
  if (kind === "count") {
    if (!/^\d+$/.test(written)) throw new Error("Write a whole number.");
    return BigInt(written);
  }
  if (kind === "quantity" || kind === "probability") return quantity(written);
  if (COORDINATES.has(kind)) return list(written).map(quantity);
  if (kind === "robots" && written === "all") return written;
  if (NAMES.has(kind)) return list(written);
  return written.startsWith("[") || written.startsWith("{") || kind !== "any"
    ? raw(written)
    : anything(written);
}

/** A number stays one; with a unit it is a text. */
const quantity = (text: string): Toml => (NUMBER.test(text) ? Number(text.replaceAll("_", "")) : text);

const list = (text: string): string[] =>
  text
    .replace(/^\[|\]$/g, "")
    .split(",")
    .map((part) => part.trim().replace(/^(["'])(.*)\1$/, "$2"))
    .filter((part) => part !== "");

/** A value as the file holds it. */
function raw(text: string): Toml {
  try {
    return parse(`value = ${text}`, { integersAsBigInt: "asNeeded" }).value as Toml;
  } catch {
    throw new Error("Write it as in the file, for example [[0, 0], [1, 0]].");
  }
}

/** Parameters of programs: numbers, true and false as they are, all else is text. */
function anything(text: string): Toml {
  if (text === "true" || text === "false") return text === "true";
  return quantity(text);
}
