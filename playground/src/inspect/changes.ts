// The changes of the inspected robots since the previously shown moment.

import type { Section } from "./facts.ts";

interface Seen {
  value: string;
  /** The value before the last change; null for a new one. */
  before: string | null;
  /** The number of the moment with the last change, -1 if there was none, and when it was shown, ms. */
  moment: number;
  at: number;
}

/** While a run plays, moments follow each other too fast to be seen: a change stays marked for so long, ms. */
const LINGER = 800;

export class Changes {
  #seen = new Map<string, Seen>();
  #robots = new Set<number>();
  #moment = 0;
  #now = Number.NaN;

  /** Takes in the moment `now`, shown at the real time `at`. */
  update(now: number, robots: { id: number; sections: Section[] }[], at: number): void {
    // A moment that is reported again keeps its marks; steering it may add some.
    if (now !== this.#now) this.#moment++;
    this.#now = now;
    const seen = new Map<string, Seen>();
    for (const { id, sections } of robots) {
      for (const { title, facts } of sections) {
        for (const { name, value, restless } of facts) {
          if (restless) continue;
          const key = `${id}/${title}/${name}`;
          const last = this.#seen.get(key);
          if (last?.value === value) seen.set(key, last);
          else if (last) seen.set(key, { value, before: last.value, moment: this.#moment, at });
          else seen.set(key, { value, before: null, moment: this.#robots.has(id) ? this.#moment : -1, at });
        }
      }
    }
    this.#seen = seen;
    this.#robots = new Set(robots.map(({ id }) => id));
  }

  /** How it was before, if it has just changed. */
  of(
    robot: number,
    title: string,
    name: string,
    playing: boolean,
    at: number,
  ): { before: string | null } | null {
    const seen = this.#seen.get(`${robot}/${title}/${name}`);
    if (!seen || seen.moment < 0) return null;
    return seen.moment === this.#moment || (playing && at - seen.at < LINGER) ? seen : null;
  }

  clear(): void {
    this.#seen.clear();
    this.#robots.clear();
  }
}
