// Moments that are kept so that one can go back quickly. They start close together; when there are too many, every
// second one is dropped and later ones are kept half as often. So going back to any moment repeats at most one
// interval of the run, and memory is bounded.

import type { Engine } from "./engine.ts";

export interface Kept {
  /** s */
  time: number;
  /** How many records there were before it. */
  records: number;
  /** How many interventions are in it, those included that are yet to take place. */
  interventions: number;
  snapshot: number;
}

const FIRST_INTERVAL = 0.5;
/** A snapshot takes about 2.5 kB a robot and more; this many robots in all keeps them near 100 MB. */
const ROBOTS_KEPT = 40_000;

export class Snapshots {
  #kept: Kept[] = [];
  #interval = FIRST_INTERVAL;
  readonly #most: number;

  constructor(
    private readonly engine: Engine,
    robots: number,
  ) {
    this.#most = Math.max(4, Math.min(64, Math.floor(ROBOTS_KEPT / Math.max(1, robots))));
  }

  /** Keeps the present moment, if it is late enough after the last one. */
  async keep(now: Omit<Kept, "snapshot">): Promise<void> {
    const last = this.#kept.at(-1);
    if (last && now.time < last.time + this.#interval) return;
    this.#kept.push({ ...now, snapshot: await this.engine.snapshot() });
    if (this.#kept.length <= this.#most) return;
    this.#interval *= 2;
    const dropped = this.#kept.filter((_, index) => index % 2 === 1);
    this.#kept = this.#kept.filter((_, index) => index % 2 === 0);
    for (const { snapshot } of dropped) await this.engine.drop(snapshot);
  }

  /** The last moment that is not after `time`. */
  before(time: number): Kept {
    const kept = this.#kept.findLast((kept) => kept.time <= time) ?? this.#kept[0];
    if (!kept) throw new Error("no moment is kept: the start of a run always is");
    return kept;
  }

  /** Forgets the moments after `time`: the run has been steered there. */
  async cut(time: number): Promise<void> {
    const dropped = this.#kept.filter((kept) => kept.time > time);
    this.#kept = this.#kept.filter((kept) => kept.time <= time);
    for (const { snapshot } of dropped) await this.engine.drop(snapshot);
  }
}
