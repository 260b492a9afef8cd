// The items of a scenario's world, which can be drawn, moved and added. Metres.

import { isTable, type Table, tablesOf } from "../table.ts";
import { append, remove, set, type Toml } from "../toml/edit.ts";
import type { Path } from "../toml/layout.ts";

export type Point = [number, number];

export type Shape =
  | { kind: "point"; at: Point }
  | { kind: "circle"; center: Point; radius: number }
  | { kind: "polygon"; corners: Point[] };

export interface Item {
  what: "way-point" | "thing" | "start" | "obstacle";
  name: string;
  /** The table that describes it. */
  path: Path;
  shape: Shape;
  hidden: boolean;
}

const METRES: Record<string, number> = { mm: 0.001, cm: 0.01, m: 1, km: 1000 };

/** A length as a scenario has it; null if it is none. */
export function metres(value: Toml | undefined): number | null {
  if (typeof value === "number" || typeof value === "bigint") return Number(value);
  const [, number, unit] = /^\s*([+-]?[\d._]+(?:e[+-]?\d+)?)\s*(mm|cm|m|km)?\s*$/i.exec(String(value)) ?? [];
  if (number === undefined) return null;
  const length = Number(number.replaceAll("_", "")) * (METRES[unit ?? "m"] ?? 1);
  return Number.isFinite(length) ? length : null;
}

function point(value: Toml | undefined): Point | null {
  if (!Array.isArray(value)) return null;
  const [x, y] = [metres(value[0]), metres(value[1])];
  return x === null || y === null ? null : [x, y];
}

export function itemsOf(scenario: Table): Item[] {
  const world = isTable(scenario.world) ? scenario.world : {};
  const items: (Item | null)[] = [];
  const named = (what: "way-point" | "thing", key: string) => {
    for (const [index, table] of tablesOf(world[key]).entries()) {
      items.push(dot(what, String(table.name ?? ""), ["world", key, index], table));
    }
  };
  for (const [index, table] of tablesOf(world.obstacle).entries()) {
    const shape = shapeOf(table);
    const path = ["world", "obstacle", index];
    if (shape)
      items.push({ what: "obstacle", name: `obstacle ${index}`, path, shape, hidden: table.hidden === true });
  }
  named("way-point", "way_point");
  named("thing", "thing");
  for (const [group, robots] of tablesOf(scenario.robots).entries()) {
    const name = String(robots.name ?? robots.model ?? "robot");
    for (const [index, table] of tablesOf(robots.start).entries()) {
      items.push(dot("start", `${name}${index}`, ["robots", group, "start", index], table));
    }
  }
  return items.filter((item) => item !== null);
}

function dot(what: Item["what"], name: string, path: Path, table: Table): Item | null {
  const at = point(table.position);
  return at && { what, name, path, shape: { kind: "point", at }, hidden: false };
}

function shapeOf({ circle, rectangle, box, polygon }: Table): Shape | null {
  if (isTable(circle)) {
    const [center, radius] = [point(circle.center), metres(circle.radius)];
    return center && radius !== null ? { kind: "circle", center, radius } : null;
  }
  const sides = isTable(rectangle) ? rectangle : isTable(box) ? box : null;
  if (sides) {
    const [low, high] = [point(sides.low), point(sides.high)];
    return low && high && { kind: "polygon", corners: [low, [high[0], low[1]], high, [low[0], high[1]]] };
  }
  if (!Array.isArray(polygon)) return null;
  const corners = polygon.map(point);
  return corners.length > 1 && corners.every((corner) => corner !== null)
    ? { kind: "polygon", corners }
    : null;
}

export function moved(shape: Shape, [dx, dy]: Point): Shape {
  const move = ([x, y]: Point): Point => [round(x + dx), round(y + dy)];
  if (shape.kind === "point") return { kind: "point", at: move(shape.at) };
  if (shape.kind === "circle") return { ...shape, center: move(shape.center) };
  return { kind: "polygon", corners: shape.corners.map(move) };
}

/** Moves an item in the text; what is written of heights stays. */
export function move(text: string, scenario: Table, { path }: Item, by: Point): string {
  const table = valueAt(scenario, path);
  if (!isTable(table)) return text;
  const places: Path[] = [];
  if (table.position !== undefined) places.push(["position"]);
  if (table.circle !== undefined) places.push(["circle", "center"]);
  for (const sides of ["rectangle", "box"])
    if (table[sides] !== undefined) places.push([sides, "low"], [sides, "high"]);
  if (Array.isArray(table.polygon)) for (const index of table.polygon.keys()) places.push(["polygon", index]);
  let after = text;
  for (const place of places) {
    const before = point(valueAt(table, place));
    if (!before) continue;
    for (const axis of [0, 1]) {
      if (by[axis]) after = set(after, [...path, ...place, axis], round((before[axis] ?? 0) + by[axis]));
    }
  }
  return after;
}

export const erase = (text: string, { path }: Item): string => remove(text, path);

/** Adds an obstacle of this shape. */
export function addObstacle(text: string, shape: Shape, isRectangle: boolean): string {
  const path = ["world", "obstacle"];
  if (shape.kind === "circle") {
    return append(text, path, {
      circle: { center: rounded(shape.center), radius: `${Math.round(shape.radius * 100)}cm` },
    });
  }
  if (shape.kind === "point") return text;
  const [low, , high] = shape.corners;
  if (isRectangle && low && high)
    return append(text, path, { rectangle: { low: rounded(low), high: rounded(high) } });
  return append(text, path, { polygon: shape.corners.map(rounded) });
}

export const addWayPoint = (text: string, name: string, at: Point): string =>
  append(text, ["world", "way_point"], { name, position: rounded(at) });

/** Adds a start to a group of robots, and a robot if all have one. */
export function addStart(text: string, scenario: Table, group: number, at: Point): string {
  const robots = tablesOf(scenario.robots)[group];
  if (!robots) return append(text, ["robots"], { model: "create", start: [{ position: rounded(at) }] });
  const starts = tablesOf(robots.start).length;
  const after = append(text, ["robots", group, "start"], { position: rounded(at) });
  const count = robots.count === undefined ? null : Number(robots.count);
  return count !== null && starts >= count ? set(after, ["robots", group, "count"], starts + 1) : after;
}

const valueAt = (value: Toml, path: Path): Toml | undefined =>
  path.reduce<Toml | undefined>((value, part) => (value as Table | undefined)?.[part as string], value);

const rounded = ([x, y]: Point): Point => [round(x), round(y)];

const round = (number: number): number => Math.round(number * 1000) / 1000;
