// The visible part of the space-time diagram: time runs downwards, each robot has a column.

import { signal } from "@preact/signals";
import { run } from "../app/context.ts";
import { end } from "../timeline/clock.ts";

/** px */
export const AXIS = 62;
export const HEAD = 26;
const NARROWEST = 58;
const WIDEST = 320;
/** Where the moment shown is while the diagram follows it: a share of the height. */
const NOW_AT = 0.8;
/** s */
const SHORTEST = 1e-4;

/** The time at the top, and how much time is seen, s. */
export const from = signal(0);
export const span = signal(2);
/** How far columns are scrolled, px. */
export const left = signal(0);
export const follow = signal(true);
export const size = signal({ width: 0, height: 0 });

const body = () => Math.max(1, size.value.height - HEAD);

export const yOf = (time: number): number => HEAD + ((time - from.value) / span.value) * body();
export const timeAt = (y: number): number => from.value + ((y - HEAD) / body()) * span.value;

/** How wide a column is, px. */
export const columnWidth = (): number => {
  const room = (size.value.width - AXIS) / Math.max(1, run.fleet.value.length);
  return Math.min(WIDEST, Math.max(NARROWEST, room));
};

export const xOf = (column: number): number => AXIS + (column + 0.5) * columnWidth() - left.value;

/** Keeps the moment shown in view. */
export function keepUp(): void {
  from.value = Math.max(0, run.now.value - span.value * NOW_AT);
}

export function panTime(by: number): void {
  follow.value = false;
  from.value = Math.min(Math.max(from.value + by, -span.value / 10), Math.max(0, end() - span.value / 10));
}

export function panColumns(by: number): void {
  const widest = columnWidth() * run.fleet.value.length - (size.value.width - AXIS);
  left.value = Math.min(Math.max(0, left.value + by), Math.max(0, widest));
}

/** Shows `factor` times as much time; what is at `y` stays there. */
export function zoom(factor: number, y = follow.value ? HEAD + NOW_AT * body() : HEAD + body() / 2): void {
  const time = timeAt(y);
  const next = Math.min(Math.max(span.value * factor, SHORTEST), Math.max(1, end() * 1.1));
  from.value = time - ((time - from.value) * next) / span.value;
  span.value = next;
  if (follow.value) keepUp();
}

/** Moves the view so that a moment is seen. */
export function reveal(time: number): void {
  if (time >= from.value && time <= from.value + span.value) return;
  follow.value = false;
  from.value = Math.max(0, time - span.value / 2);
}
