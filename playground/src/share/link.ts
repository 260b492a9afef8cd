// A project as the fragment of an address, `p=1.DATA`: the version of the form, and JSON, compressed, in base64url.
// Fragments are not sent to any server. A link may come from anyone, so nothing in it is trusted.

import { deflateSync, Inflate, strFromU8, strToU8 } from "fflate";
import { LIMITS, type Project, pathProblem } from "../project/model.ts";
import * as base64 from "./base64.ts";

const VERSION = "1";
/** The maximum unpacked size of a link, bytes. */
const MOST_BYTES = 2_000_000;
/** The maximum length of a link, characters. */
const LONGEST = 1_500_000;
/** Compressed bytes that are unpacked at a time: no more than about 1,000 times as many come of them. */
const PORTION = 256;

export type Shared = Pick<Project, "name" | "files" | "scenario" | "active"> & { seed: string };

/** Says why a link cannot be opened. */
export class BadLink extends Error {}

export function write({ name, files, scenario, active, seed }: Shared): string {
  const bytes = deflateSync(strToU8(JSON.stringify({ name, files, scenario, active, seed })), { level: 9 });
  return `p=${VERSION}.${base64.encode(bytes)}`;
}

/** The project of a fragment without its `#`. */
export function read(fragment: string): Shared {
  const [, version, data] = /^p=(\d{1,4})\.(.*)$/s.exec(fragment) ?? [];
  if (version === undefined || data === undefined) throw damaged();
  if (version !== VERSION)
    throw new BadLink("This link was made by another version of StarL. Load the page again.");
  if (data.length > LONGEST) throw new BadLink("This link is too long.");
  let content: unknown;
  try {
    content = JSON.parse(strFromU8(unpack(base64.decode(data))));
  } catch (error) {
    throw error instanceof BadLink ? error : damaged();
  }
  return examine(content);
}

function unpack(bytes: Uint8Array): Uint8Array {
  const parts: Uint8Array[] = [];
  let size = 0;
  let ended = false;
  const inflate = new Inflate((part, last) => {
    size += part.length;
    if (size > MOST_BYTES) throw new BadLink("This link unpacks to more than 2 MB.");
    // The decoder uses its memory again.
    parts.push(part.slice());
    ended = last;
  });
  for (let at = 0; at < bytes.length && !ended; at += PORTION) {
    inflate.push(bytes.subarray(at, at + PORTION), at + PORTION >= bytes.length);
  }
  const whole = new Uint8Array(size);
  let at = 0;
  for (const part of parts) {
    whole.set(part, at);
    at += part.length;
  }
  return whole;
}

function examine(content: unknown): Shared {
  if (typeof content !== "object" || content === null) throw damaged();
  const { name, files, scenario, active, seed } = content as Record<string, unknown>;
  if (typeof name !== "string" || typeof files !== "object" || files === null || Array.isArray(files))
    throw damaged();
  const entries = Object.entries(files);
  if (entries.length === 0) throw new BadLink("There are no files in this link.");
  if (entries.length > LIMITS.files)
    throw new BadLink(`There are more than ${LIMITS.files} files in this link.`);
  for (const [path, text] of entries) {
    const problem = pathProblem(path);
    if (problem) throw new BadLink(`A file in this link has a name that is not allowed. ${problem}`);
    if (typeof text !== "string") throw damaged();
  }
  const texts = Object.fromEntries(entries) as Record<string, string>;
  const among = (path: unknown) => (typeof path === "string" && texts[path] !== undefined ? path : null);
  return {
    name: printable(name) || "Shared program",
    files: texts,
    scenario: among(scenario),
    active: among(active) ?? entries[0]?.[0] ?? "",
    seed: typeof seed === "string" && /^\d{1,19}$/.test(seed) ? seed : "",
  };
}

/** Without characters that change how the text around them is shown. */
const printable = (text: string) =>
  text
    .replace(/[\p{C}]/gu, "")
    .slice(0, 80)
    .trim();

const damaged = () => new BadLink("This link is damaged: a part of it may be missing. Ask for it again.");
