// Files as one, and names for them.

import { strToU8, zipSync } from "fflate";

export function zip(files: Record<string, string | Uint8Array>): Uint8Array<ArrayBuffer> {
  const contents = Object.entries(files).map(([path, content]): [string, Uint8Array] => [
    path,
    typeof content === "string" ? strToU8(content) : content,
  ]);
  return new Uint8Array(zipSync(Object.fromEntries(contents)));
}

/** A name for a file that every system takes. */
export const fileName = (name: string): string =>
  name.replace(/[^\p{L}\p{N}_-]+/gu, "-").replace(/^-+|-+$/g, "") || "starl";
