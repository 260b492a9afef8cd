// Datagrams on their way near a moment, found by their times.

import { firstWhere } from "../run/search.ts";

export interface Arrival {
  robot: number;
  /** s */
  time: number;
  /** Why it did not arrive; null if it did. */
  reason: string | null;
}

export interface Sent {
  /** s */
  time: number;
  from: number;
  sequence: number;
  /** Null for all in reach. */
  to: number | null;
  arrivals: Arrival[];
}

/** Longer delays are not shown: a datagram that is under way for longer is left out, s. */
const LONGEST = 3;
/** Keys of datagrams are numbers. */
const SEQUENCES = 2 ** 32;

export class Traffic {
  #sent: Sent[] = [];
  #byKey = new Map<number, Sent>();
  /** How long datagrams take, as far as is known; s. */
  delay = 0.02;

  sent(time: number, from: number, sequence: number, to: number | null): void {
    const sent = { time, from, sequence, to, arrivals: [] };
    this.#sent.push(sent);
    this.#byKey.set(from * SEQUENCES + sequence, sent);
  }

  arrived(from: number, sequence: number, arrival: Arrival): void {
    const sent = this.find(from, sequence);
    if (!sent) return;
    sent.arrivals.push(arrival);
    if (arrival.reason === null) this.delay += (arrival.time - sent.time - this.delay) / 16;
  }

  find(from: number, sequence: number): Sent | undefined {
    return this.#byKey.get(from * SEQUENCES + sequence);
  }

  /** Calls back for datagrams that are under way at `now`, or were in the last `linger` seconds; the newest first. */
  near(now: number, linger: number, most: number, each: (sent: Sent) => void): void {
    let left = most;
    for (let index = this.#after(now) - 1; index >= 0 && left > 0; index--) {
      const sent = this.#sent[index];
      if (!sent || sent.time < now - linger - LONGEST) return;
      const last = sent.arrivals.at(-1)?.time ?? sent.time;
      if (Math.max(last, sent.time) + linger < now) continue;
      each(sent);
      left--;
    }
  }

  clear(): void {
    this.#sent = [];
    this.#byKey.clear();
  }

  /** How many were sent up to a time. */
  #after(time: number): number {
    return firstWhere(this.#sent, (sent) => sent.time > time);
  }
}
