// Moving what is in the world by dragging it: an intervention when it is let go.

import type { Intervention, Obstacle, Point } from "../engine/types.ts";
import { POSE_NUMBERS } from "../engine/types.ts";
import type { Target } from "./pick.ts";
import type { Scene } from "./scene.ts";

/** The place of something that can be moved. */
export function placeOf(target: Target, { poses, world }: Scene): Point | null {
  switch (target.kind) {
    case "robot": {
      const at = target.robot * POSE_NUMBERS;
      return { x: poses[at] ?? 0, y: poses[at + 1] ?? 0, z: poses[at + 2] ?? 0 };
    }
    case "way_point":
      return world.way_points.find(({ name }) => name === target.name)?.position ?? null;
    case "thing":
      return world.things.find(({ name }) => name === target.name)?.position ?? null;
    case "obstacle":
      return { x: 0, y: 0, z: 0 };
  }
}

/** The intervention that moves it by this distance, to the millimetre; null if it no longer exists. */
export function movedBy(
  target: Target,
  distance: { x: number; y: number },
  { world }: Scene,
): Intervention | null {
  const by = { x: decimals(distance.x, 3), y: decimals(distance.y, 3) };
  const shifted = ({ x, y, z }: Point): Point => ({ x: decimals(x + by.x, 9), y: decimals(y + by.y, 9), z });
  switch (target.kind) {
    case "robot":
      return { push: { robot: target.robot, by: { ...by, z: 0 } } };
    case "way_point": {
      const point = world.way_points.find(({ name }) => name === target.name);
      return point ? { set_way_point: { ...point, position: shifted(point.position) } } : null;
    }
    case "thing": {
      const thing = world.things.find(({ name }) => name === target.name);
      return thing ? { set_thing: { name: thing.name, position: shifted(thing.position) } } : null;
    }
    case "obstacle": {
      const found = world.obstacles.find(({ index }) => index === target.index);
      return found
        ? { move_obstacle: { index: target.index, obstacle: shift(found.obstacle, shifted) } }
        : null;
    }
  }
}

/** A hand is no more exact, and people read these numbers in scenarios. */
const decimals = (value: number, count: number): number => Number(value.toFixed(count));

function shift(shape: Obstacle, shifted: (point: Point) => Point): Obstacle {
  if ("Polygon" in shape) {
    const { base, height } = shape.Polygon;
    return { Polygon: { base: base.map(shifted), height } };
  }
  if ("Circle" in shape) {
    return { Circle: { ...shape.Circle, center: shifted(shape.Circle.center) } };
  }
  const { low, high } = shape.Cuboid;
  return { Cuboid: { low: shifted(low), high: shifted(high) } };
}
