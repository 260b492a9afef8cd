// Where all robots were, from the start of the run as far as it is known. Memory is bounded: when there are too many
// frames, every second one is dropped, so a long run is shown in coarser steps.

import { POSE_NUMBERS } from "../engine/types.ts";
import { firstWhere } from "./search.ts";

/** Numbers that are kept of a robot in a frame: those of POSE_NUMBERS. */
const MOST_NUMBERS = 16_000_000;

export interface Frame {
  /** s */
  time: number;
  /** POSE_NUMBERS numbers for each robot. */
  poses: Float32Array;
}

export class History {
  frames: Frame[] = [];
  /** Changes whenever frames are removed, so that drawings of them are redrawn. */
  generation = 0;
  #numbers = 0;

  /** Adds frames as they come from the worker. */
  add(frames: Float64Array): void {
    for (let at = 0; at < frames.length; ) {
      const robots = frames[at + 1] ?? 0;
      const end = at + 2 + robots * POSE_NUMBERS;
      const poses = Float32Array.from(frames.subarray(at + 2, end));
      this.frames.push({ time: frames[at] ?? 0, poses });
      this.#numbers += poses.length;
      at = end;
    }
    while (this.#numbers > MOST_NUMBERS && this.frames.length > 2) this.#thin();
  }

  /** Forgets everything later than `time`. */
  cut(time: number): void {
    this.#keep(this.frames.filter((frame) => frame.time <= time));
  }

  clear(): void {
    this.#keep([]);
  }

  /** The index of the last frame that is not after `time`, or -1. */
  indexAt(time: number): number {
    return firstWhere(this.frames, (frame) => frame.time > time) - 1;
  }

  /** Where robots were at a time, between the two frames around it. */
  at(time: number): Float32Array {
    const index = Math.max(0, this.indexAt(time));
    const [before, after] = [this.frames[index], this.frames[index + 1]];
    if (!before) return new Float32Array();
    if (!after || after.poses.length !== before.poses.length || time <= before.time) return before.poses;
    const share = (time - before.time) / (after.time - before.time);
    return before.poses.map((from, place) => between(from, after.poses[place] ?? from, share, place));
  }

  #thin(): void {
    this.#keep(this.frames.filter((_, index) => index % 2 === 0 || index === this.frames.length - 1));
  }

  #keep(frames: Frame[]): void {
    this.frames = frames;
    this.#numbers = frames.reduce((sum, frame) => sum + frame.poses.length, 0);
    this.generation++;
  }
}

const ANGLES = new Set([3, 4, 5, 9]);
const CONDITION = POSE_NUMBERS - 1;

function between(from: number, to: number, share: number, place: number): number {
  const which = place % POSE_NUMBERS;
  if (which === CONDITION) return from;
  let way = to - from;
  // The short way round.
  if (ANGLES.has(which)) way = Math.atan2(Math.sin(way), Math.cos(way));
  return from + way * share;
}
