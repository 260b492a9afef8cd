// How many messages were sent, delivered and lost in each second of a run, counted as it continues.

import { kindOf } from "../inspect/kinds.ts";
import type { Events } from "../run/events.ts";

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
      const counts = event && this.#counts(kindOf(event.topic));
      if (!event || !counts) continue;
      const second = Math.floor(event.time);
      while (this.sent.length <= second)
        for (const list of [this.sent, this.delivered, this.lost]) list.push(0);
      counts[second] = (counts[second] ?? 0) + 1;
    }
    return this;
  }

  #counts(kind: string): number[] | null {
    if (kind === "sent") return this.sent;
    if (kind === "delivered") return this.delivered;
    return kind === "dropped" ? this.lost : null;
  }
}
