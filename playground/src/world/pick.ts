// The item under the pointer, and its use: the interface between the view of the world and the parts of the page
// that let a person do something there.

import { signal } from "@preact/signals";
import type { Point } from "../engine/types.ts";

/** Something in the world that a pointer can be on. */
export type Target =
  | { kind: "robot"; robot: number }
  | { kind: "way_point"; name: string }
  | { kind: "thing"; name: string }
  | { kind: "obstacle"; index: number };

/** The action of the pointer: selects robots, measures, moves items; other parts may add tools. */
export type Tool = "look" | "measure" | "move" | (string & {});

export interface Click {
  /** On the floor, m. */
  at: { x: number; y: number };
  on: Target | null;
  shift: boolean;
}

export const tool = signal<Tool>("look");

/** The item under the pointer. */
export const hovered = signal<Target | null>(null);

/** The place on the floor under the pointer, m. */
export const pointed = signal<{ x: number; y: number } | null>(null);

/** The latest click; a new object for each. With a tool of its own, nothing else answers to it. */
export const clicked = signal<Click | null>(null);

/** The robot that the view follows. */
export const followed = signal<number | null>(null);

/** The ends of what is measured: none, one, or two. */
export const measured = signal<Point[]>([]);

/** The item being moved: where it was taken, and where it would be put. */
export const moving = signal<{ target: Target; from: Point; to: Point } | null>(null);

export const sameTarget = (one: Target | null, other: Target | null): boolean =>
  JSON.stringify(one) === JSON.stringify(other);
