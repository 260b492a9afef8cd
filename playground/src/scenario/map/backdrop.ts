// The world of the scenario as the simulator reads it, world files and random starts included: what the map shows
// besides what can be moved.

import { effect, signal } from "@preact/signals";
import { run } from "../../app/context.ts";
import type { Member, Obstacle, World } from "../../engine/types.ts";
import { diagnostics } from "../../project/checking.ts";
import { errorsOf, optionsOf } from "../../project/model.ts";
import { project } from "../../project/project.ts";
import type { Point } from "./items.ts";

/** After the last change, ms. */
const REST = 500;
/** The number of robots whose places are requested. */
const MOST_ROBOTS = 60;

export interface Backdrop {
  obstacles: Point[][];
  wayPoints: { name: string; at: Point }[];
  robots: { name: string; at: Point; radius: number }[];
}

export const backdrop = signal<Backdrop | null>(null);

const ask = <Answer>(raw: object) => run.client.ask<Answer>({ raw });

async function look(): Promise<Backdrop> {
  const { files } = project.peek();
  const options = optionsOf(project.peek(), "");
  const { simulation } = await ask<{ simulation: number }>({ open: { files, options, topics: [] } });
  try {
    const world = await ask<World>({ world: { simulation } });
    const fleet = await ask<Member[]>({ fleet: { simulation } });
    const robots = await Promise.all(
      fleet.slice(0, MOST_ROBOTS).map(async ({ id, name, radius }) => {
        const { pose } = await ask<{ pose: { position: { x: number; y: number } } }>({
          robot: { simulation, robot: id },
        });
        return { name, radius, at: [pose.position.x, pose.position.y] as Point };
      }),
    );
    return {
      obstacles: world.obstacles.map(({ obstacle }) => cornersOf(obstacle)),
      wayPoints: world.way_points.map(({ name, position: { x, y } }) => ({ name, at: [x, y] })),
      robots,
    };
  } finally {
    await ask({ close: { simulation } });
  }
}

function cornersOf(shape: Obstacle): Point[] {
  if ("Polygon" in shape) return shape.Polygon.base.map(({ x, y }) => [x, y]);
  if ("Cuboid" in shape) {
    const { low, high } = shape.Cuboid;
    return [
      [low.x, low.y],
      [high.x, low.y],
      [high.x, high.y],
      [low.x, high.y],
    ];
  }
  const { center, radius } = shape.Circle;
  return Array.from({ length: 24 }, (_, index) => {
    const angle = (index / 24) * 2 * Math.PI;
    return [center.x + radius * Math.cos(angle), center.y + radius * Math.sin(angle)];
  });
}

/** Looks again whenever files change, as long as the map is shown. A scenario with errors leaves the last picture. */
export function keepLooking(): () => void {
  let waiting: ReturnType<typeof setTimeout> | undefined;
  let shown = "";
  const end = effect(() => {
    const { id } = project.value;
    const faulty = errorsOf(project.value, diagnostics.value).length > 0;
    if (id !== shown) backdrop.value = null;
    shown = id;
    clearTimeout(waiting);
    if (faulty) return;
    waiting = setTimeout(() => {
      look().then(
        (found) => {
          if (project.peek().id === id) backdrop.value = found;
        },
        () => undefined,
      );
    }, REST);
  });
  return () => {
    clearTimeout(waiting);
    end();
  };
}
