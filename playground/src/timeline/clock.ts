// Numbers that change with each picture, as often as a person can read them. Each change lays the page out again.

import { computed, effect, signal } from "@preact/signals";
import { run } from "../app/context.ts";

/** While a run plays, the time between two changes, ms. */
const EVERY = 100;

/** The moment shown, s, and how many times as fast as real time it moves. Exact once the run rests. */
export const clock = signal({ time: 0, pace: 0 });

let changed = 0;
effect(() => {
  const shown = { time: run.now.value, pace: run.pace.value };
  if (run.playing.value && performance.now() - changed < EVERY) return;
  changed = performance.now();
  clock.value = shown;
});

const length = computed(() => run.ended.value ?? Math.max(run.opened.value?.duration ?? 0, run.known.value));

/** How long the timeline is, s: until the end is known, as long as the run may last. */
export const end = (): number => length.value;
