// The events that the timeline marks, kept beside the list of all events so that no drawing has to look at each.

import type { Event, Events } from "../run/events.ts";
import { firstWhere } from "../run/search.ts";
import { LANES, laneOf } from "./lanes.ts";

/** For each lane its events, in order. */
export class Marks {
  lanes: Event[][] = [];
  #generation = -1;
  #seen = 0;

  /** Takes in what has happened since the last call. */
  follow(events: Events): void {
    if (events.generation !== this.#generation) {
      this.lanes = LANES.map(() => []);
      this.#generation = events.generation;
      this.#seen = 0;
    }
    for (; this.#seen < events.list.length; this.#seen++) {
      const event = events.list[this.#seen];
      const lane = event && laneOf(event);
      if (event && lane !== undefined) this.lanes[lane]?.push(event);
    }
  }

  /** The event of a lane that is nearest to a time, none if all are further away than `most`, s. */
  nearest(lane: number, time: number, most: number): Event | null {
    const list = this.lanes[lane] ?? [];
    const after = first(list, time);
    const near = [list[after - 1], list[after]].filter((event) => event !== undefined);
    const far = (event: Event) => Math.abs(event.time - time);
    const [found] = near.sort((a, b) => far(a) - far(b));
    return found && far(found) <= most ? found : null;
  }
}

/** Where in the list the events from a time on begin. */
export function first(list: Event[], time: number): number {
  return firstWhere(list, (event) => event.time >= time);
}
