// From metres to the map's own units and back: y points up in the world and down on the screen.

import type { Backdrop } from "./backdrop.ts";
import type { Item, Point, Shape } from "./items.ts";

/** The part of the world that is shown, m. */
export interface View {
  left: number;
  bottom: number;
  width: number;
  height: number;
}

const EMPTY: Point[] = [
  [0, 0],
  [4, 3],
];

/** Everything with a margin. */
export function viewOf(items: Item[], backdrop: Backdrop | null, zoom: number): View {
  const points = [...items.flatMap(({ shape }) => pointsOf(shape))];
  if (backdrop) {
    points.push(
      ...backdrop.obstacles.flat(),
      ...backdrop.wayPoints.map(({ at }) => at),
      ...backdrop.robots.map(({ at }) => at),
    );
  }
  const all = points.length > 1 ? points : [...points, ...EMPTY];
  const [xs, ys] = [all.map(([x]) => x), all.map(([, y]) => y)];
  const [left, right, bottom, top] = [min(xs), max(xs), min(ys), max(ys)];
  const width = Math.max(1, right - left) * 1.16 * zoom;
  const height = Math.max(1, top - bottom) * 1.16 * zoom;
  return { left: (left + right - width) / 2, bottom: (bottom + top - height) / 2, width, height };
}

const min = (numbers: number[]) => numbers.reduce((least, number) => Math.min(least, number), Infinity);
const max = (numbers: number[]) => numbers.reduce((most, number) => Math.max(most, number), -Infinity);

export function pointsOf(shape: Shape): Point[] {
  if (shape.kind === "point") return [shape.at];
  if (shape.kind === "polygon") return shape.corners;
  const { center, radius } = shape;
  return [
    [center[0] - radius, center[1] - radius],
    [center[0] + radius, center[1] + radius],
  ];
}

/** To the nearest 5 cm, or less where the map shows little. */
export function snapped([x, y]: Point, view: View): Point {
  const step = view.width > 40 ? 0.5 : view.width > 1.5 ? 0.05 : 0.01;
  return [Math.round(x / step) * step, Math.round(y / step) * step];
}

/** The shape that a person draws from one point to another. */
export function drawn(tool: string, from: Point, to: Point): Shape | null {
  const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
  const long = Math.hypot(dx, dy);
  if (long < 0.02) return null;
  if (tool === "circle") return { kind: "circle", center: from, radius: Math.max(0.05, long) };
  if (tool === "wall") return { kind: "polygon", corners: [from, to] };
  if (tool !== "rectangle" || Math.abs(dx) < 0.02 || Math.abs(dy) < 0.02) return null;
  const [low, high]: [Point, Point] = [
    [Math.min(from[0], to[0]), Math.min(from[1], to[1])],
    [Math.max(from[0], to[0]), Math.max(from[1], to[1])],
  ];
  return { kind: "polygon", corners: [low, [high[0], low[1]], high, [low[0], high[1]]] };
}
