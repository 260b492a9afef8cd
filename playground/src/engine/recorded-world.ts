// The world of a trace, as its attachment `starl/world.json` has it. A trace may come from anyone, so
// everything is checked: the rest of the page relies on finite numbers and on names.

import type { Member, Obstacle, Point, World } from "./types.ts";

export interface RecordedWorld extends World {
  robots: Omit<Member, "program" | "condition">[];
}

/** Returns null if the text is not such a world. */
export function readWorld(text: string): RecordedWorld | null {
  try {
    const { robots, way_points, obstacles } = record(JSON.parse(text));
    return {
      robots: list(robots).map(robot),
      way_points: list(way_points).map(wayPoint),
      obstacles: list(obstacles).map((value, index) => ({ index, obstacle: shape(value), hidden: false })),
      things: [],
    };
  } catch {
    return null;
  }
}

function robot(value: unknown, id: number): RecordedWorld["robots"][number] {
  const { name, model, radius, height, flies } = record(value);
  return {
    id,
    name: words(name),
    model: words(model),
    radius: number(radius),
    height: number(height),
    flies: flies === true,
  };
}

function wayPoint(value: unknown): World["way_points"][number] {
  const { name, position, group } = record(value);
  return { name: words(name), position: point(position), group: number(group ?? 0) };
}

/** An obstacle as the simulator gives it. */
function shape(value: unknown): Obstacle {
  const { circle, polygon, box, height } = record(value);
  if (circle) {
    const { center, radius } = record(circle);
    return { Circle: { center: point(center), radius: number(radius), height: span(height) } };
  }
  if (box) {
    const { low, high } = record(box);
    return { Cuboid: { low: point(low), high: point(high) } };
  }
  return { Polygon: { base: list(polygon).map(point), height: span(height) } };
}

function span(value: unknown): { low: number; high: number } | null {
  if (value === undefined || value === null) return null;
  const { low, high } = record(value);
  return { low: number(low), high: number(high) };
}

function point(value: unknown): Point {
  const { x, y, z } = record(value);
  return { x: number(x), y: number(y), z: number(z ?? 0) };
}

function record(value: unknown): Record<string, unknown> {
  if (typeof value !== "object" || value === null) throw new Error("no object");
  return value as Record<string, unknown>;
}

function list(value: unknown): unknown[] {
  if (!Array.isArray(value)) throw new Error("no list");
  return value;
}

function number(value: unknown): number {
  if (typeof value !== "number" || !Number.isFinite(value)) throw new Error("no number");
  return value;
}

function words(value: unknown): string {
  if (typeof value !== "string") throw new Error("no text");
  return value;
}
