// Reads MCAP files from their start, a part at a time, so that a large one is never in memory as a whole, and one whose
// end is missing is read as far as it goes.

import { McapIndexedReader, McapStreamReader, type McapTypes } from "@mcap/core";
import { Refused } from "./refused.ts";

/** Bytes that are fetched at once. */
const PART = 1 << 20;
/** The maximum length of a record, bytes. Records of traces are far shorter, but a damaged or hostile file can claim any length. */
const LONGEST = 256 << 20;

/** A file of which ranges of bytes can be read. */
export interface Readable extends McapTypes.IReadable {
  size(): Promise<bigint>;
  read(offset: bigint, length: bigint): Promise<Uint8Array>;
}

/** All records of the file in their order, those in chunks too. */
export async function* records(file: Readable): AsyncGenerator<McapTypes.TypedMcapRecord> {
  const reader = new McapStreamReader();
  const size = await file.size();
  for (let offset = 0n; offset < size; offset += BigInt(PART)) {
    const left = size - offset;
    reader.append(await file.read(offset, left < PART ? left : BigInt(PART)));
    for (let record = reader.nextRecord(); record; record = reader.nextRecord()) yield record;
    // Bytes after the end of a trace are ignored.
    if (reader.done()) return;
    if (reader.bytesRemaining() > LONGEST) throw new Error("a record is longer than 256 MB");
  }
}

/** All records of a file that the server sends as it grows, as they come. */
export async function* arriving(url: string): AsyncGenerator<McapTypes.TypedMcapRecord> {
  const answer = await fetch(url);
  if (!answer.ok || !answer.body) throw gone();
  const reader = new McapStreamReader();
  const parts = answer.body.getReader();
  for (let part = await parts.read(); !part.done; part = await parts.read()) {
    reader.append(part.value);
    for (let record = reader.nextRecord(); record; record = reader.nextRecord()) yield record;
  }
}

/** A reader that uses the index at the end of the file; null if there is none. */
export async function indexed(file: Readable): Promise<McapIndexedReader | null> {
  const readable: Readable = {
    size: () => file.size(),
    read: (offset, length) => {
      if (length > LONGEST) throw new Error("a part of it is longer than 256 MB");
      return file.read(offset, length);
    },
  };
  try {
    return await McapIndexedReader.Initialize({ readable });
  } catch {
    return null;
  }
}

/** A file of the user. */
export class LocalFile implements Readable {
  constructor(private readonly blob: Blob) {}

  async size(): Promise<bigint> {
    return BigInt(this.blob.size);
  }

  async read(offset: bigint, length: bigint): Promise<Uint8Array> {
    const part = this.blob.slice(Number(offset), Number(offset + length));
    return new Uint8Array(await part.arrayBuffer());
  }
}

/** A file of the server. */
export class ServedFile implements Readable {
  private constructor(
    private readonly url: string,
    private readonly length: number,
  ) {}

  static async of(url: string): Promise<ServedFile> {
    const head = await fetch(url, { method: "HEAD" });
    const length = Number(head.headers.get("content-length"));
    if (!head.ok || !Number.isFinite(length)) throw gone();
    return new ServedFile(url, length);
  }

  async size(): Promise<bigint> {
    return BigInt(this.length);
  }

  async read(offset: bigint, length: bigint): Promise<Uint8Array> {
    const range = `bytes=${offset}-${offset + length - 1n}`;
    const answer = await fetch(this.url, { headers: { range } });
    if (!answer.ok) throw gone();
    return new Uint8Array(await answer.arrayBuffer());
  }
}

const gone = () => new Refused("the trace is not served any more: the command was stopped");
