// How many messages were sent, delivered and lost in each second of a run, counted as it continues.

import { kindOf } from "../inspect/kinds.ts";
import type { Events } from "../run/events.ts";

/** A trace can claim any time. */
const MOST_SECONDS = 200_000;

export class Rates {
  sent: number[] = [];
  delivered: number[] = [];
  lost: number[] = [];
  #scanned = 0;
  #generation = -1;

  update(events: Events): this {
    if (this.#generation !== events.generation) {
      this.#generation = events.generation;
      [this.sent, this.delivered, this.lost, this.#scanned] = [[], [], [], 0];
    }
    for (; this.#scanned < events.list.length; this.#scanned++) {
      const event = events.list[this.#scanned];
      if (event) this.count(event.topic, event.time);
    }
    return this;
  }

  /** Counts a record that happened at a time, s. */
  count(topic: string, time: number): void {
    const counts = this.#counts(kindOf(topic));
    const second = Math.floor(time);
    if (!counts || second >= MOST_SECONDS) return;
    while (this.sent.length <= second)
      for (const list of [this.sent, this.delivered, this.lost]) list.push(0);
    counts[second] = (counts[second] ?? 0) + 1;
  }

  #counts(kind: string): number[] | null {
    if (kind === "sent") return this.sent;
    if (kind === "delivered") return this.delivered;
    return kind === "dropped" ? this.lost : null;
  }
}
