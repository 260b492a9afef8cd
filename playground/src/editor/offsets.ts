// Places in a text. The simulator counts lines and Unicode characters from 1 in diagnostics, and lines and UTF-16 units
// from 0 elsewhere; the editor counts UTF-16 units from the start.

import type { Text } from "@codemirror/state";
import type { Diagnostic } from "../engine/types.ts";

export interface Position {
  line: number;
  character: number;
}

export interface Range {
  start: Position;
  end: Position;
}

/** UTF-16 units of the first `characters` Unicode characters. */
export function units(text: string, characters: number): number {
  let at = 0;
  for (let count = 0; count < characters && at < text.length; count++)
    at += (text.codePointAt(at) ?? 0) > 0xffff ? 2 : 1;
  return at;
}

export function offsetOf(doc: Text, { line, character }: Position): number {
  if (line >= doc.lines) return doc.length;
  const at = doc.line(Math.max(0, line) + 1);
  return Math.min(at.to, at.from + Math.max(0, character));
}

export function positionOf(doc: Text, offset: number): Position {
  const line = doc.lineAt(offset);
  return { line: line.number - 1, character: offset - line.from };
}

export type Place = Pick<Diagnostic, "line" | "column" | "end_line" | "end_column">;

export function spanOf(doc: Text, place: Place): { from: number; to: number } {
  const at = (line: number, column: number) => {
    if (line > doc.lines) return doc.length;
    const found = doc.line(Math.max(1, line));
    return found.from + units(found.text, column - 1);
  };
  const from = at(place.line, place.column);
  return { from, to: Math.max(from, at(place.end_line, place.end_column)) };
}

/** Where a diagnostic is marked: at least one character wide, or the rest of a line that it only begins in. */
export function rangeOf(doc: Text, diagnostic: Diagnostic): { from: number; to: number } {
  const { from, to } = spanOf(doc, diagnostic);
  if (to > from) return { from, to };
  const line = doc.lineAt(from);
  const code = line.text.slice(from - line.from).replace(/\s*(#.*)?$/, "");
  return {
    from: Math.min(from, Math.max(line.from, line.to - 1)),
    to: Math.min(line.to, from + Math.max(1, code.length)),
  };
}

/** The replacement that leads from one text to the other. */
export function difference(
  before: string,
  after: string,
): { from: number; to: number; insert: string } | null {
  if (before === after) return null;
  const shorter = Math.min(before.length, after.length);
  let from = 0;
  while (from < shorter && before[from] === after[from]) from++;
  let same = 0;
  while (same < shorter - from && before[before.length - 1 - same] === after[after.length - 1 - same]) same++;
  return { from, to: before.length - same, insert: after.slice(from, after.length - same) };
}
