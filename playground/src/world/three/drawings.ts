// Drawings of programs, and planned paths.

import { POSE_NUMBERS } from "../../engine/types.ts";
import { RUNNING, type Scene } from "../scene.ts";
import { Lines } from "./lines.ts";

/** Lines of a circle. */
const SIDES = 36;
/** Planned paths are drawn so far above the floor, m. */
const ABOVE_FLOOR = 0.006;

export class Drawings {
  readonly marks = new Lines(3);
  readonly plans = new Lines(4);
  readonly stems = new Lines(1);
  #marked: unknown[] = [];
  #planned: unknown[] = [];

  update(scene: Scene): void {
    const { happenings, colors, hidden, selected } = scene;
    const marked = [happenings.marks.version, colors, hidden];
    if (marked.some((part, index) => part !== this.#marked[index])) {
      this.#marked = marked;
      this.#mark(scene);
    }
    let running = 0;
    for (let at = POSE_NUMBERS - 1; at < scene.poses.length; at += POSE_NUMBERS) {
      if (scene.poses[at] === RUNNING) running++;
    }
    const planned = [happenings.plans.version, colors, hidden, selected, running];
    if (planned.some((part, index) => part !== this.#planned[index])) {
      this.#planned = planned;
      this.#plan(scene);
    }
    this.#stem(scene);
  }

  dispose(): void {
    for (const lines of [this.marks, this.plans, this.stems]) lines.dispose();
  }

  #mark({ happenings, colors, hidden }: Scene): void {
    this.marks.begin();
    if (!hidden.has("marks")) {
      for (const { robot, shape, points, radius } of happenings.marks.current.values()) {
        const color = colors.rgb[robot] ?? [0.5, 0.5, 0.5];
        if (shape === "dot") for (const point of points) this.marks.add(point, point, color, 1, 9);
        if (shape === "line") {
          for (let index = 1; index < points.length; index++) {
            const [from, to] = [points[index - 1], points[index]];
            if (from && to) this.marks.add(from, to, color, 1, 4.5);
          }
        }
        const center = points[0];
        if (shape !== "circle" || !center) continue;
        for (let side = 0; side < SIDES; side++) {
          this.marks.add(around(center, radius, side), around(center, radius, side + 1), color, 1, 3);
        }
      }
    }
    this.marks.end();
  }

  #plan({ happenings, colors, hidden, selected, poses }: Scene): void {
    this.plans.begin();
    if (!hidden.has("plans")) {
      const chosen = new Set(selected);
      for (const { robot, path } of happenings.plans.current.values()) {
        if (poses[robot * POSE_NUMBERS + POSE_NUMBERS - 1] !== RUNNING) continue;
        const color = colors.rgb[robot] ?? [0.5, 0.5, 0.5];
        const alpha = chosen.size > 0 && !chosen.has(robot) ? 0.3 : 0.95;
        for (let index = 1; index < path.length; index++) {
          const [from, to] = [path[index - 1], path[index]];
          if (from && to) this.plans.add(from, to, color, alpha, 3.2, 8, ABOVE_FLOOR);
        }
        const goal = path.at(-1);
        if (goal) this.plans.add(goal, goal, color, alpha, 7, 0, ABOVE_FLOOR);
      }
    }
    this.plans.end();
  }

  /** From robots in the air to the floor below them. */
  #stem({ fleet, poses, palette }: Scene): void {
    this.stems.begin();
    for (let robot = 0; robot < fleet.length; robot++) {
      const at = robot * POSE_NUMBERS;
      const z = poses[at + 2] ?? 0;
      if (!fleet[robot]?.flies || z < 0.1) continue;
      const top = { x: poses[at] ?? 0, y: poses[at + 1] ?? 0, z };
      this.stems.add(top, { ...top, z: 0 }, palette.rgb.muted, 0.55, 1);
      this.stems.add({ ...top, z: 0.003 }, { ...top, z: 0.003 }, palette.rgb.muted, 0.55, 5);
    }
    this.stems.end();
  }
}

function around(center: { x: number; y: number; z: number }, radius: number, side: number) {
  const angle = (side / SIDES) * 2 * Math.PI;
  return { x: center.x + radius * Math.cos(angle), y: center.y + radius * Math.sin(angle), z: center.z };
}
