// The events that pass a filter, kept up to date as the run continues: each event is looked at once. A long list is
// looked through in slices, so that the page stays free.

import type { Event, Events } from "../run/events.ts";
import { firstWhere } from "../run/search.ts";

/** The number of events that are filtered between two reads of the clock. */
const BETWEEN = 512;

export class Filtered {
  list: Event[] = [];
  #scanned = 0;
  #generation: number;

  constructor(
    private readonly events: Events,
    private readonly passes: (event: Event) => boolean,
  ) {
    this.#generation = events.generation;
  }

  /** Looks through events that are new, for at most so many ms. Returns whether all are looked through. */
  scan(budget = Number.POSITIVE_INFINITY): boolean {
    const events = this.events;
    if (this.#generation !== events.generation) {
      this.#generation = events.generation;
      [this.list, this.#scanned] = [[], 0];
    }
    const until = performance.now() + budget;
    while (this.#scanned < events.list.length) {
      const event = events.list[this.#scanned++];
      if (event && this.passes(event)) this.list.push(event);
      if (this.#scanned % BETWEEN === 0 && performance.now() > until) return false;
    }
    return true;
  }

  /** How many of the list are among the first `count` records of the run. */
  before(count: number): number {
    return firstWhere(this.list, (event) => event.index >= count);
  }
}
