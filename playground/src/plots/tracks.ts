// Columns for plots of robots, made from the frames of a run as it continues: each frame is looked at once.

import { POSE_NUMBERS } from "../engine/types.ts";
import type { Frame, History } from "../run/history.ts";

export const QUANTITIES = ["x", "y", "z", "speed"] as const;
export type Quantity = (typeof QUANTITIES)[number];

export interface Track {
  x: number[];
  y: number[];
  z: number[];
  /** Between the frame before and this one, m/s. */
  speed: number[];
}

type Frames = Pick<History, "frames" | "generation">;

export class Tracks {
  times: number[] = [];
  robots: Track[] = [];
  #scanned = 0;
  #generation: number;

  constructor(
    private readonly history: Frames,
    readonly chosen: number[],
  ) {
    this.#generation = history.generation;
    this.#clear();
  }

  /** Takes in new frames. Returns whether there were any. */
  update(): boolean {
    const { frames, generation } = this.history;
    if (generation !== this.#generation) {
      this.#generation = generation;
      this.#clear();
    }
    const before = this.#scanned;
    for (; this.#scanned < frames.length; this.#scanned++) {
      const frame = frames[this.#scanned];
      if (frame) this.#take(frame, frames[this.#scanned - 1]);
    }
    return this.#scanned !== before;
  }

  #clear(): void {
    this.times = [];
    this.robots = this.chosen.map(() => ({ x: [], y: [], z: [], speed: [] }));
    this.#scanned = 0;
  }

  #take({ time, poses }: Frame, before: Frame | undefined): void {
    this.times.push(time);
    for (const [index, robot] of this.chosen.entries()) {
      const track = this.robots[index];
      if (!track) continue;
      const at = robot * POSE_NUMBERS;
      // Robots that are yet to join have no place.
      const [x, y, z] = [0, 1, 2].map((axis) => poses[at + axis] ?? Number.NaN) as [number, number, number];
      track.x.push(x);
      track.y.push(y);
      track.z.push(z);
      const last = before?.poses;
      const went = last
        ? Math.hypot(
            x - (last[at] ?? Number.NaN),
            y - (last[at + 1] ?? Number.NaN),
            z - (last[at + 2] ?? Number.NaN),
          )
        : 0;
      track.speed.push(before && time > before.time ? went / (time - before.time) : 0);
    }
  }
}
