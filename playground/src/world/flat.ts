// The world painted from above without WebGL.

import { POSE_NUMBERS } from "../engine/types.ts";
import { footprint } from "./fit.ts";
import { gridStep } from "./scale.ts";
import { LEFT, type Painter, RUNNING, type Scene } from "./scene.ts";
import type { View } from "./view.ts";

/** Frames of a path that are drawn: the latest. */
const MOST_FRAMES = 600;
/** Lines of all paths together. */
const MOST_LINES = 20_000;

export class Flat implements Painter {
  #context: CanvasRenderingContext2D;
  #ratio = 1;
  #at = new Float32Array(3);

  constructor(private readonly canvas: HTMLCanvasElement) {
    const context = canvas.getContext("2d");
    if (!context) throw new Error("this browser draws no canvas");
    this.#context = context;
  }

  resize(width: number, height: number, ratio: number): void {
    this.#ratio = ratio;
    this.canvas.width = Math.round(width * ratio);
    this.canvas.height = Math.round(height * ratio);
  }

  paint(scene: Scene, view: View): void {
    const context = this.#context;
    context.setTransform(this.#ratio, 0, 0, this.#ratio, 0, 0);
    context.fillStyle = scene.palette.css.floor;
    context.fillRect(0, 0, view.width, view.height);
    context.lineJoin = context.lineCap = "round";
    if (!scene.hidden.has("grid")) this.#grid(scene, view);
    this.#places(scene, view);
    if (!scene.hidden.has("paths")) this.#paths(scene, view);
    if (!scene.hidden.has("plans")) this.#plans(scene, view);
    if (!scene.hidden.has("marks")) this.#marks(scene, view);
    this.#robots(scene, view);
  }

  dispose(): void {}

  #to(view: View, { x, y }: { x: number; y: number }, start: boolean): void {
    view.project(x, y, 0, this.#at);
    if (start) this.#context.moveTo(this.#at[0] ?? 0, this.#at[1] ?? 0);
    else this.#context.lineTo(this.#at[0] ?? 0, this.#at[1] ?? 0);
  }

  #line(view: View, points: { x: number; y: number }[]): void {
    this.#context.beginPath();
    for (const [index, point] of points.entries()) this.#to(view, point, index === 0);
  }

  #stroke(color: string, width: number, alpha = 1, dash: number[] = []): void {
    const context = this.#context;
    context.globalAlpha = alpha;
    context.strokeStyle = color;
    context.lineWidth = width;
    context.setLineDash(dash);
    context.stroke();
    context.setLineDash([]);
    context.globalAlpha = 1;
  }

  #grid({ palette }: Scene, view: View): void {
    const step = gridStep(view.pixel) * 5;
    const reach = (Math.hypot(view.width, view.height) / 2) * view.pixel;
    const { x, y } = view.target;
    this.#context.beginPath();
    for (let at = Math.ceil((x - reach) / step) * step; at < x + reach; at += step) {
      this.#to(view, { x: at, y: y - reach }, true);
      this.#to(view, { x: at, y: y + reach }, false);
    }
    for (let at = Math.ceil((y - reach) / step) * step; at < y + reach; at += step) {
      this.#to(view, { x: x - reach, y: at }, true);
      this.#to(view, { x: x + reach, y: at }, false);
    }
    this.#stroke(palette.css.grid, 1);
  }

  #places({ world, palette, hidden, poses }: Scene, view: View): void {
    const context = this.#context;
    if (!hidden.has("obstacles")) {
      for (const { obstacle, hidden: unknown } of world.obstacles) {
        const base = footprint(obstacle);
        this.#line(view, base);
        context.closePath();
        context.fillStyle = palette.css.obstacle;
        context.globalAlpha = unknown ? 0.3 : 1;
        if (base.length > 2) context.fill();
        this.#stroke(palette.css.muted, base.length > 2 ? 1.5 : 3, 1, unknown ? [4, 4] : []);
      }
    }
    const dot = (point: { x: number; y: number }, color: string, size: number) => {
      view.project(point.x, point.y, 0, this.#at);
      context.beginPath();
      context.rect((this.#at[0] ?? 0) - size / 2, (this.#at[1] ?? 0) - size / 2, size, size);
      context.fillStyle = color;
      context.fill();
    };
    if (!hidden.has("wayPoints"))
      for (const point of world.way_points) dot(point.position, palette.css["way-point"], 7);
    if (hidden.has("things")) return;
    for (const { position, holder } of world.things) {
      const at = (holder ?? 0) * POSE_NUMBERS;
      dot(holder === null ? position : { x: poses[at] ?? 0, y: poses[at + 1] ?? 0 }, palette.css.fault, 11);
    }
  }

  #paths({ history, now, count, colors, poses }: Scene, view: View): void {
    const end = history.indexAt(now) + 1;
    const start = Math.max(0, end - MOST_FRAMES, end - Math.floor(MOST_LINES / Math.max(1, count)));
    for (let robot = 0; robot < count; robot++) {
      const at = robot * POSE_NUMBERS;
      this.#context.beginPath();
      for (let index = start; index <= end; index++) {
        const frame = index < end ? history.frames[index]?.poses : poses;
        if (frame) this.#to(view, { x: frame[at] ?? 0, y: frame[at + 1] ?? 0 }, index === start);
      }
      this.#stroke(colors.css[robot] ?? "", 2, 0.7);
    }
  }

  #plans({ happenings, poses, colors }: Scene, view: View): void {
    for (const { robot, path } of happenings.plans.current.values()) {
      if (poses[robot * POSE_NUMBERS + POSE_NUMBERS - 1] !== RUNNING) continue;
      this.#line(view, path);
      this.#stroke(colors.css[robot] ?? "", 3, 0.9, [0.1, 8]);
    }
  }

  #marks({ happenings, colors }: Scene, view: View): void {
    for (const { robot, shape, points, radius } of happenings.marks.current.values()) {
      const [center] = points;
      if (shape === "text" || !center) continue;
      if (shape === "circle") this.#line(view, footprint({ Circle: { center, radius, height: null } }));
      else this.#line(view, shape === "dot" ? [center, center] : points);
      this.#stroke(colors.css[robot] ?? "", shape === "dot" ? 9 : 4);
    }
  }

  /** A circle with a tip at its nose. */
  #robots({ poses, count, fleet, colors, enlarged, palette }: Scene, view: View): void {
    for (let robot = 0; robot < count; robot++) {
      const at = robot * POSE_NUMBERS;
      if (poses[at + POSE_NUMBERS - 1] === LEFT) continue;
      const [x, y, yaw] = [poses[at] ?? 0, poses[at + 1] ?? 0, poses[at + 3] ?? 0];
      const radius = (fleet[robot]?.radius ?? 0.1) * enlarged;
      const point = (angle: number, size: number) => ({
        x: x + radius * size * Math.cos(yaw + angle),
        y: y + radius * size * Math.sin(yaw + angle),
      });
      const round = Array.from({ length: 13 }, (_, index) =>
        point(0.5 + (index / 12) * (2 * Math.PI - 1), 0.9),
      );
      this.#line(view, [point(0, 1.35), ...round]);
      this.#context.closePath();
      this.#context.fillStyle = colors.css[robot] ?? "";
      this.#context.fill();
      this.#stroke(palette.css.floor, 1);
    }
  }
}
