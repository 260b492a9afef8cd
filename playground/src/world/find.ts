// Finds the item at a place of the screen.

import { footprint } from "./fit.ts";
import type { Target } from "./pick.ts";
import type { Scene } from "./scene.ts";
import type { View } from "./view.ts";

/** A pointer or a finger is on something this near, px. */
const NEAR = 12;

export function find(x: number, y: number, scene: Scene, view: View, screen: Float32Array): Target | null {
  const robot = nearest(scene, screen, x, y);
  if (robot !== null) return { kind: "robot", robot };
  const at = new Float32Array(3);
  const near = (position: { x: number; y: number; z: number }) => {
    view.project(position.x, position.y, position.z, at);
    return (at[2] ?? 0) > 0 && Math.hypot((at[0] ?? 0) - x, (at[1] ?? 0) - y) < NEAR;
  };
  if (!scene.hidden.has("things")) {
    const thing = scene.world.things.find(({ holder, position }) => holder === null && near(position));
    if (thing) return { kind: "thing", name: thing.name };
  }
  if (!scene.hidden.has("wayPoints")) {
    const point = scene.world.way_points.find(({ position }) => near(position));
    if (point) return { kind: "way_point", name: point.name };
  }
  const floor = view.floorAt(x, y);
  if (!floor || scene.hidden.has("obstacles")) return null;
  const obstacle = scene.world.obstacles.find(({ obstacle }) =>
    covers(footprint(obstacle), floor, view.pixel * 6),
  );
  return obstacle ? { kind: "obstacle", index: obstacle.index } : null;
}

/** The robot nearest to a place of the screen, if it is on its body or near enough. */
function nearest(
  { count, fleet, enlarged }: Scene,
  screen: Float32Array,
  x: number,
  y: number,
): number | null {
  let [found, least]: [number | null, number] = [null, Number.POSITIVE_INFINITY];
  for (let robot = 0; robot < count; robot++) {
    const scale = screen[robot * 3 + 2] ?? 0;
    if (scale === 0) continue;
    const off = Math.hypot((screen[robot * 3] ?? 0) - x, (screen[robot * 3 + 1] ?? 0) - y);
    if (off >= least || off > Math.max(NEAR, (fleet[robot]?.radius ?? 0) * enlarged * scale)) continue;
    [found, least] = [robot, off];
  }
  return found;
}

/** Whether a place is in a polygon, or near the wall that two corners are. */
export function covers(
  corners: { x: number; y: number }[],
  { x, y }: { x: number; y: number },
  near: number,
): boolean {
  let inside = false;
  for (let index = 0; index < corners.length; index++) {
    const [a, b] = [corners[index], corners[(index + 1) % corners.length]];
    if (!a || !b) continue;
    if (a.y > y !== b.y > y && x < a.x + ((y - a.y) / (b.y - a.y)) * (b.x - a.x)) inside = !inside;
    if (corners.length > 2) continue;
    const length = (b.x - a.x) ** 2 + (b.y - a.y) ** 2 || 1;
    const share = Math.min(1, Math.max(0, ((x - a.x) * (b.x - a.x) + (y - a.y) * (b.y - a.y)) / length));
    if (Math.hypot(a.x + share * (b.x - a.x) - x, a.y + share * (b.y - a.y) - y) < near) return true;
  }
  return inside;
}
