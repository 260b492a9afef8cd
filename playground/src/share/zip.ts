// Files as one, and an archive as files.

import { strToU8, unzipSync, zipSync } from "fflate";

export function zip(files: Record<string, string | Uint8Array>): Uint8Array<ArrayBuffer> {
  const contents = Object.entries(files).map(([path, content]): [string, Uint8Array] => [
    path,
    typeof content === "string" ? strToU8(content) : content,
  ]);
  return new Uint8Array(zipSync(Object.fromEntries(contents)));
}

/** The files of an archive in their order. Throws if it is none, or if it unpacks to more than `most` bytes. */
export function unzip(archive: Uint8Array, most: number): Record<string, Uint8Array> {
  let size = 0;
  return unzipSync(archive, {
    // No file unpacks to more than it says here.
    filter: ({ name, originalSize }) => {
      size += originalSize;
      if (size > most) throw new Error(`it unpacks to more than ${most / 1e6} MB`);
      return !name.endsWith("/");
    },
  });
}
