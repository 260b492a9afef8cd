// Files that leave the page.

import { strToU8, zipSync } from "fflate";

export function download(name: string, content: BlobPart, type: string): void {
  const url = URL.createObjectURL(new Blob([content], { type }));
  const link = document.createElement("a");
  link.href = url;
  link.download = name;
  link.click();
  // The browser begins to read it in its own time.
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}

export function zip(files: Record<string, string>): Uint8Array<ArrayBuffer> {
  const contents = Object.entries(files).map(([path, text]): [string, Uint8Array] => [path, strToU8(text)]);
  return new Uint8Array(zipSync(Object.fromEntries(contents)));
}

/** A name for a file that every system takes. */
export const fileName = (name: string): string =>
  name.replace(/[^\p{L}\p{N}_-]+/gu, "-").replace(/^-+|-+$/g, "") || "starl";
