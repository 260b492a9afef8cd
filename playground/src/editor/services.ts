// Information of the language's tools about a place in a file.

import { run } from "../app/context.ts";
import { project } from "../project/project.ts";
import type { Position, Range } from "./offsets.ts";

export interface Hover {
  range: Range;
  markdown: string;
}

export interface Completion {
  label: string;
  kind: string;
  detail: string | null;
  documentation: string | null;
  /** The text that replaces `range`, and the position of the cursor in it, in UTF-16 units. */
  insert: string;
  cursor: number;
  range: Range;
}

export interface Definition {
  path: string;
  range: Range;
  /** The text of a file of the standard library. */
  text: string | null;
}

export interface Entry {
  name: string;
  kind: string;
  detail: string | null;
  range: Range;
  name_range: Range;
  parts: Entry[];
}

/** Null where there is no answer: the file may be unreadable just now. */
async function ask<Answer>(request: string, content: object): Promise<Answer | null> {
  try {
    return await run.client.ask<Answer>({ raw: { [request]: content } });
  } catch {
    return null;
  }
}

const place = (path: string, position: Position) => ({ files: project.peek().files, path, position });

export const hover = (path: string, position: Position) => ask<Hover>("hover", place(path, position));
export const complete = (path: string, position: Position) =>
  ask<Completion[]>("complete", place(path, position));
export const definition = (path: string, position: Position) =>
  ask<Definition>("definition", place(path, position));
export const format = (text: string) => ask<string>("format", { text });
export const outline = (path: string) => ask<Entry[]>("outline", { files: project.peek().files, path });
