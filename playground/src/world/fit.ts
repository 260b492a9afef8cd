// The content that a view must show: robots that move, their recent and planned paths, rather than the
// world's far corners.

import { type Obstacle, POSE_NUMBERS, type World } from "../engine/types.ts";
import type { History } from "../run/history.ts";
import { FINISHED, LEFT } from "./scene.ts";
import type { Box, Place } from "./view.ts";

/** How far back movement counts, s. */
const RECENT = 6;
/** Of larger fleets, so many are looked at. */
const LOOKED_AT = 250;
/** Of more robots than this, those far from the others do not count: they would be dots. */
const CROWD = 60;
const SHARE_OF_CROWD = 0.5;
/** Waypoints and obstacles count while they enlarge the view around the robots by at most a factor: for few, for many. */
const FEW = 12;
const [AROUND_FEW, AROUND_MANY] = [6, 1.5];

export function boxOf(places: Place[]): Box | null {
  const [first] = places;
  if (!first) return null;
  const box = { low: { ...first }, high: { ...first } };
  for (const place of places) {
    for (const axis of ["x", "y", "z"] as const) {
      box.low[axis] = Math.min(box.low[axis], place[axis]);
      box.high[axis] = Math.max(box.high[axis], place[axis]);
    }
  }
  return box;
}

export const joined = (one: Box, other: Box): Box => boxOf([one.low, one.high, other.low, other.high]) ?? one;

/** Around what moves near `now`, with what stands around it. */
export function movingBox(poses: ArrayLike<number>, history: History, now: number, world: World): Box | null {
  const count = Math.floor(poses.length / POSE_NUMBERS);
  const earlier = history.frames[Math.max(0, history.indexAt(now - RECENT))]?.poses ?? poses;
  const moved: Place[] = [];
  const present: Place[] = [];
  const step = Math.ceil(count / LOOKED_AT);
  for (let robot = 0; robot < count; robot += step) {
    const at = robot * POSE_NUMBERS;
    const condition = poses[at + POSE_NUMBERS - 1];
    if (condition === LEFT) continue;
    const here = placeAt(poses, at);
    present.push(here);
    if (condition === FINISHED || at >= earlier.length) continue;
    const before = placeAt(earlier, at);
    if (Math.hypot(here.x - before.x, here.y - before.y, here.z - before.z) > 0.1) moved.push(here, before);
  }
  const places = moved.length > 0 ? central(moved, 2 * CROWD) : central(present, CROWD);
  const robots = boxOf(places);
  if (!robots) return surroundings(world);
  const few = present.length <= FEW;
  const around = few ? joined(robots, boxOf(present) ?? robots) : robots;
  const stands = surroundings(world);
  const whole = stands && joined(around, stands);
  return padded(
    whole && size(whole) <= Math.max(4, (few ? AROUND_FEW : AROUND_MANY) * size(around)) ? whole : around,
  );
}

/** Around everything there is. */
export function wholeBox(poses: ArrayLike<number>, world: World): Box | null {
  const places: Place[] = [];
  for (let at = 0; at < poses.length; at += POSE_NUMBERS) places.push(placeAt(poses, at));
  const robots = boxOf(places);
  const stands = surroundings(world);
  return robots && stands ? padded(joined(robots, stands)) : (robots ?? stands);
}

/** The corners of an obstacle's base. */
export function footprint(shape: Obstacle): { x: number; y: number }[] {
  if ("Polygon" in shape) return shape.Polygon.base;
  if ("Cuboid" in shape) {
    const { low, high } = shape.Cuboid;
    return [low, { x: high.x, y: low.y }, high, { x: low.x, y: high.y }];
  }
  const { center, radius } = shape.Circle;
  return Array.from({ length: 40 }, (_, index) => {
    const angle = (index / 40) * 2 * Math.PI;
    return { x: center.x + radius * Math.cos(angle), y: center.y + radius * Math.sin(angle) };
  });
}

/** From where to where an obstacle reaches; one without a height is drawn up to `sky`. */
export function heights(shape: Obstacle, sky: number): { low: number; high: number } {
  if ("Cuboid" in shape) return { low: shape.Cuboid.low.z, high: shape.Cuboid.high.z };
  const span = "Polygon" in shape ? shape.Polygon.height : shape.Circle.height;
  return span ? { low: Math.max(span.low, -sky), high: Math.min(span.high, 1e4) } : { low: 0, high: sky };
}

function surroundings({ way_points, obstacles, things }: World): Box | null {
  const feet = obstacles.flatMap(({ obstacle }) => footprint(obstacle).map(({ x, y }) => ({ x, y, z: 0 })));
  return boxOf([
    ...way_points.map(({ position }) => position),
    ...things.map(({ position }) => position),
    ...feet,
  ]);
}

const placeAt = (poses: ArrayLike<number>, at: number): Place => ({
  x: poses[at] ?? 0,
  y: poses[at + 1] ?? 0,
  z: poses[at + 2] ?? 0,
});

const size = ({ low, high }: Box): number => Math.max(high.x - low.x, high.y - low.y);

/** Those nearest to the middle, if there are more than `most`. */
function central(places: Place[], most: number): Place[] {
  if (places.length <= most) return places;
  const middle = (axis: "x" | "y") =>
    places.map((place) => place[axis]).sort((a, b) => a - b)[places.length >> 1] ?? 0;
  const [x, y] = [middle("x"), middle("y")];
  const distance = (place: Place) => Math.hypot(place.x - x, place.y - y);
  return [...places]
    .sort((a, b) => distance(a) - distance(b))
    .slice(0, Math.ceil(places.length * SHARE_OF_CROWD));
}

function padded(box: Box): Box {
  const margin = Math.max(0.25, size(box) * 0.03);
  return {
    low: { x: box.low.x - margin, y: box.low.y - margin, z: Math.min(0, box.low.z) },
    high: { x: box.high.x + margin, y: box.high.y + margin, z: box.high.z },
  };
}
