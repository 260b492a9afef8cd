// Changes of single values of a TOML text. Everything else stays as it is, comments and order included.

import { type Entry, isPrefix, Layout, type Path, type Section, type Value } from "./layout.ts";

export type Toml = string | number | bigint | boolean | Toml[] | { [key: string]: Toml };

/** Writes a value: tables inline. */
export function literal(value: Toml): string {
  if (typeof value === "string") return JSON.stringify(value).replaceAll("\u007f", "\\u007F");
  if (Array.isArray(value)) return `[${value.map(literal).join(", ")}]`;
  if (typeof value !== "object") return String(value);
  const entries = Object.entries(value).map(([key, value]) => `${keyOf([key])} = ${literal(value)}`);
  return entries.length > 0 ? `{ ${entries.join(", ")} }` : "{}";
}

/** Replaces a value, or adds it where it belongs. */
export function set(text: string, path: Path, value: Toml): string {
  const layout = new Layout(text);
  const found = layout.find(path);
  return found ? splice(text, found.from, found.to, literal(value)) : insert(layout, path, literal(value));
}

/** Takes away a key, an element of an array, or a table with everything that is in it. */
export function remove(text: string, path: Path): string {
  const layout = new Layout(text);
  const found = layout.entry(path);
  if (found) {
    const { entry, owner, value } = found;
    if ("kind" in owner) return removeMember(text, owner, entry ?? value);
    return splice(text, lineStart(text, (entry as Entry).from), nextLine(text, value.to), "");
  }
  let rest = text;
  for (const { start, end } of parts(layout, path).reverse()) rest = splice(rest, start, end, "");
  const dotted = layout.sections
    .flatMap(({ entries }) => entries)
    .filter((entry) => isPrefix(path, entry.path));
  if (dotted.length > 0 && rest === text) {
    for (const { from, to } of dotted.reverse())
      rest = splice(rest, lineStart(rest, from), nextLine(rest, to), "");
  }
  return rest;
}

/** Adds an element at the end of an array of tables. */
export function append(text: string, path: Path, table: { [key: string]: Toml }): string {
  const layout = new Layout(text);
  const array = layout.find(path);
  if (array) return appendItem(text, array, literal(table));
  const existing = parts(layout, path);
  // Elements of an array that are written with headers cannot have some that are not.
  const last = existing.at(-1);
  if (last) return splice(text, last.end, last.end, block(text, last.end, header(path, table)));
  if (path.some((part) => typeof part === "number")) return set(text, path, [table]);
  const sibling = parts(layout, path.slice(0, -1)).at(-1);
  const at = path.length > 1 && sibling ? sibling.end : text.length;
  return splice(text, at, at, block(text, at, header(path, table)));
}

function insert(layout: Layout, path: Path, value: string): string {
  const { text } = layout;
  for (let depth = path.length - 1; depth > 0; depth--) {
    const parent = layout.find(path.slice(0, depth));
    const rest = path.slice(depth);
    if (parent?.kind === "table") return insertEntry(text, parent, `${keyOf(rest)} = ${value}`);
    // For example `avoidance = true`, which becomes a table.
    if (parent?.kind === "scalar")
      return splice(text, parent.from, parent.to, `{ ${keyOf(rest)} = ${value} }`);
  }
  for (let depth = path.length - 1; depth >= 0; depth--) {
    const parent = path.slice(0, depth);
    const near = neighbour(layout, parent);
    if (!near) continue;
    if (depth === 0 && path.length > 1) break;
    const line = `${keyOf(path.slice(near.section.path.length))} = ${value}\n`;
    if (near.at !== null) return insertLine(text, near.at, line);
    const first = layout.sections[1];
    if (near.section.path.length > 0 || !first) return insertLine(text, near.section.to, line);
    const at = attached(text, first.from);
    return splice(text, at, at, `${line}\n`);
  }
  const at = text.length;
  return splice(
    text,
    at,
    at,
    block(text, at, `[${keyOf(path.slice(0, -1))}]\n${keyOf(path.slice(-1))} = ${value}\n`),
  );
}

/** The section of a table, and the end of the last entry of the table in it. */
function neighbour(layout: Layout, table: Path): { section: Section; at: number | null } | null {
  for (const section of layout.sections) {
    const members = section.entries.filter(
      (entry) => isPrefix(table, entry.path) && entry.path.length > table.length,
    );
    const isOwn = section.path.length === table.length && isPrefix(section.path, table);
    if (isOwn) return { section, at: section.entries.at(-1)?.to ?? null };
    const last = members.at(-1);
    if (last && isPrefix(section.path, table)) return { section, at: last.to };
  }
  return null;
}

/** The stretches of text that sections at a path, and those below them, take up; each with the comment right above. */
function parts(layout: Layout, path: Path): { start: number; end: number }[] {
  const { sections, text } = layout;
  const found: { start: number; end: number }[] = [];
  for (const [index, section] of sections.entries()) {
    if (index === 0 || !isPrefix(path, section.path)) continue;
    const next = sections[index + 1];
    found.push({ start: attached(text, section.from), end: next ? attached(text, next.from) : text.length });
  }
  return found;
}

/** Where the lines of comment begin that stand right above. */
function attached(text: string, from: number): number {
  let start = lineStart(text, from);
  while (start > 0) {
    const before = lineStart(text, start - 1);
    if (!text.slice(before, start).trimStart().startsWith("#")) break;
    start = before;
  }
  return start;
}

function insertEntry(text: string, table: Value, entry: string): string {
  const last = table.entries.at(-1);
  if (last) return splice(text, last.to, last.to, `, ${entry}`);
  return splice(text, table.from, table.to, `{ ${entry} }`);
}

function appendItem(text: string, array: Value, item: string): string {
  const last = array.items.at(-1);
  if (!last) return splice(text, array.from, array.to, `[${item}]`);
  const start = lineStart(text, last.from);
  const isOwnLine =
    text.slice(start, last.from).trim() === "" && text.slice(array.from, last.from).includes("\n");
  const indent = isOwnLine ? `\n${text.slice(start, last.from)}` : " ";
  return splice(text, last.to, last.to, `,${indent}${item}`);
}

function removeMember(text: string, owner: Value, member: Entry | Value): string {
  const members: (Entry | Value)[] = owner.kind === "array" ? owner.items : owner.entries;
  const index = members.findIndex(({ from }) => from === member.from);
  const [before, after] = [members[index - 1], members[index + 1]];
  if (after) return splice(text, member.from, after.from, "");
  if (before) return splice(text, before.to, member.to, "");
  return splice(text, owner.from, owner.to, owner.kind === "array" ? "[]" : "{}");
}

function header(path: Path, table: { [key: string]: Toml }): string {
  const lines = Object.entries(table).map(([key, value]) => `${keyOf([key])} = ${literal(value)}\n`);
  return `[[${keyOf(path)}]]\n${lines.join("")}`;
}

/** Lines between empty ones. */
function block(text: string, at: number, lines: string): string {
  const before = text.slice(0, at);
  const gap = before === "" || before.endsWith("\n\n") ? "" : before.endsWith("\n") ? "\n" : "\n\n";
  return gap + lines + (at < text.length ? "\n" : "");
}

/** Adds a line below the one in which `after` lies. */
function insertLine(text: string, after: number, line: string): string {
  const at = nextLine(text, after);
  const gap = at > 0 && text[at - 1] !== "\n" ? "\n" : "";
  return splice(text, at, at, gap + line);
}

const keyOf = (path: Path): string =>
  path
    .filter((part) => typeof part === "string")
    .map((part) => (/^[A-Za-z0-9_-]+$/.test(part) ? part : JSON.stringify(part)))
    .join(".");

const lineStart = (text: string, at: number): number => text.lastIndexOf("\n", at - 1) + 1;

function nextLine(text: string, at: number): number {
  const end = text.indexOf("\n", at);
  return end < 0 ? text.length : end + 1;
}

const splice = (text: string, from: number, to: number, insert: string): string =>
  text.slice(0, from) + insert + text.slice(to);
