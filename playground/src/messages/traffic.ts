// Which datagram was sent, delivered and lost where, and what happened at each robot, in order. Kept up to date as the
// run continues: each event is looked at once.

import type { Event, Events } from "../run/events.ts";
import { firstWhere } from "../run/search.ts";

export interface Datagram {
  from: number;
  /** Counted by the sender. */
  sequence: number;
  sent: Event;
  /** Where it arrived, and where it was lost. */
  ends: Event[];
}

/** Sequence numbers have 32 bits. */
const SEQUENCES = 2 ** 32;

export class Traffic {
  /** The events of each robot, in order. */
  robots: Event[][] = [];
  /** Which type of primitive has a port, where it has reported itself. */
  ports = new Map<number, string>();
  /** The longest time from a sender to a receiver so far, s. */
  longest = 0;
  #datagrams = new Map<number, Datagram>();
  #scanned = 0;
  #generation = -1;

  update(events: Events): this {
    if (this.#generation !== events.generation) this.#clear(events.generation);
    for (; this.#scanned < events.list.length; this.#scanned++) {
      const event = events.list[this.#scanned];
      if (event) this.#take(event);
    }
    return this;
  }

  datagram(from: number, sequence: number): Datagram | undefined {
    return this.#datagrams.get(from * SEQUENCES + sequence);
  }

  /** The datagram of an event. */
  of({ topic, message }: Event): Datagram | undefined {
    switch (topic) {
      case "/starl/sent":
        return this.datagram(Number(message.robot), Number(message.sequence));
      case "/starl/delivered":
      case "/starl/dropped":
        return this.datagram(Number(message.from), Number(message.sequence));
    }
  }

  #take(event: Event): void {
    const { topic, message } = event;
    if (message.robot !== undefined) {
      while (this.robots.length <= message.robot) this.robots.push([]);
      this.robots[message.robot]?.push(event);
    }
    switch (topic) {
      case "/starl/sent": {
        const [from, sequence] = [Number(message.robot), Number(message.sequence)];
        this.#datagrams.set(from * SEQUENCES + sequence, { from, sequence, sent: event, ends: [] });
        break;
      }
      case "/starl/delivered":
      case "/starl/dropped": {
        const datagram = this.of(event);
        if (!datagram) break;
        datagram.ends.push(event);
        this.longest = Math.max(this.longest, event.time - datagram.sent.time);
        break;
      }
      case "/starl/primitive":
        this.ports.set(Number(message.port), String(message.primitive));
        break;
    }
  }

  #clear(generation: number): void {
    this.#generation = generation;
    this.robots = [];
    this.ports.clear();
    this.#datagrams.clear();
    this.longest = 0;
    this.#scanned = 0;
  }
}

/** How many of the ascending events are among the first `count` records of the run. */
export function countBefore(list: Event[], count: number): number {
  return firstWhere(list, (event) => event.index >= count);
}
