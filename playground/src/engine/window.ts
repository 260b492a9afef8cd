// The frequent records of a trace near the moment shown: datagrams and actions, of which a long trace has millions. The
// page holds as many as a window has, and all other records. When the moment shown comes near the window's edge, the
// window moves, and what is in it is read from the file again by the file's index.
//
// A trace without an index, such as one that was cut off, has no window: the page takes all records as they are read,
// and forgets the oldest of too many.

import type { McapIndexedReader, McapTypes } from "@mcap/core";
import { firstWhere } from "../run/search.ts";
import { isFrequent } from "./engine.ts";

/** Records in a window. */
const SIZE = 50_000;

/** The places of records among all of the trace, the second excluded. */
export interface Span {
  from: number;
  to: number;
}

export class Window {
  #span: Span;
  #moving = false;
  /** How near its edge the moment shown may come, records. */
  private readonly edge: number;

  constructor(
    private readonly reader: McapIndexedReader | null,
    private readonly size = SIZE,
  ) {
    this.#span = { from: 0, to: size };
    this.edge = size / 8;
  }

  /** Whether the page takes the record at a place as the trace is read. */
  takes(place: number, topic: string): boolean {
    const { from, to } = this.#span;
    return !this.reader || !isFrequent(topic) || (place >= from && place < to);
  }

  /**
   * Moves the window to a place if it is near an edge behind which there is more. `times` has the times of the records
   * that have been read, s. Calls back with each frequent record in it, and returns the span of records that this
   * covers; null if the window stays.
   */
  async move(
    place: number,
    times: number[],
    topics: string[],
    take: (place: number, message: McapTypes.TypedMcapRecords["Message"]) => void,
  ): Promise<Span | null> {
    const { from, to } = this.#span;
    const isInside =
      (from === 0 || place >= from + this.edge) && (to >= times.length || place < to - this.edge);
    if (!this.reader || this.#moving || isInside) return null;
    this.#moving = true;
    try {
      const middle = Math.max(this.size / 2, Math.floor(place));
      // Records of one time are read together.
      const first = times[middle - this.size / 2] ?? 0;
      const start = firstWhere(times, (time) => time >= first);
      const end = Math.min(times.length, start + this.size);
      this.#span = { from: start, to: start + this.size };
      const time = (of: number) => BigInt(Math.round((times[of] ?? 0) * 1e9));
      let at = start;
      const messages = this.reader.readMessages({ topics, startTime: time(start), endTime: time(end - 1) });
      for await (const message of messages) {
        if (at >= end) break;
        take(at++, message);
      }
      return { from: start, to: end };
    } finally {
      this.#moving = false;
    }
  }
}
