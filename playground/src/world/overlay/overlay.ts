// The overlay of the picture: labels, messages, selection, conditions, measured or moved items, and
// the scale. It is the same for both painters of the world below.

import { POSE_NUMBERS } from "../../engine/types.ts";
import { hovered, measured, moving, pointed, type Target, tool } from "../pick.ts";
import { barLength, metres } from "../scale.ts";
import { DOWN, FAILED, FINISHED, LEFT, type Scene } from "../scene.ts";
import type { View } from "../view.ts";
import { Labels } from "./labels.ts";
import { drawMessages } from "./messages.ts";
import { Pen } from "./pen.ts";
import { drawSensors } from "./sensors.ts";

/** From here on true and believed position differ visibly: px, radians. */
const [APART, TURNED] = [3.5, 0.2];
/** More outlines of believed positions are not drawn. */
const MOST_OUTLINES = 400;
/** How much longer than a message a flash lasts. */
const FLASH = 1.6;

export class Overlay {
  #pen: Pen;
  #labels = new Labels();
  #screen = new Float32Array();

  constructor(
    private readonly context: CanvasRenderingContext2D,
    private readonly view: View,
  ) {
    this.#pen = new Pen(context, view);
  }

  /** Where robots are on the screen, three numbers each as `View.project` gives them. */
  get screen(): Float32Array {
    return this.#screen;
  }

  draw(scene: Scene, ratio: number): void {
    const { context, view } = this;
    this.#project(scene);
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, view.width, view.height);
    context.lineCap = "round";
    if (!scene.hidden.has("range")) this.#range(scene);
    if (!scene.hidden.has("sensors")) drawSensors(this.#pen, scene);
    if (!scene.hidden.has("beliefs")) this.#beliefs(scene);
    this.#selection(scene);
    if (!scene.hidden.has("events")) this.#flashes(scene);
    drawMessages(this.#pen, scene, this.#screen);
    this.#conditions(scene);
    this.#labels.draw(context, scene, view, this.#screen, ratio);
    this.#measure(scene);
    this.#move(scene);
    if (!scene.hidden.has("grid")) this.#scale(scene);
  }

  #project({ count, poses, fleet, enlarged }: Scene): void {
    if (this.#screen.length !== count * 3) this.#screen = new Float32Array(count * 3);
    for (let robot = 0; robot < count; robot++) {
      const at = robot * POSE_NUMBERS;
      const middle = (poses[at + 2] ?? 0) + (fleet[robot]?.height ?? 0) * 0.5 * enlarged;
      this.view.project(poses[at] ?? 0, poses[at + 1] ?? 0, middle, this.#screen, robot * 3);
      if (poses[at + POSE_NUMBERS - 1] === LEFT) this.#screen[robot * 3 + 2] = 0;
    }
  }

  #range({ selected, poses, range, colors }: Scene): void {
    if (range === null) return;
    for (const robot of selected) {
      const at = robot * POSE_NUMBERS;
      this.context.beginPath();
      this.#pen.circle(poses[at] ?? 0, poses[at + 1] ?? 0, 0, range, 72);
      this.#pen.stroke(colors.css[robot] ?? "", 1.5, 0.8, [3, 6]);
    }
  }

  /** An outline at the estimated position of a robot, if it is visibly different. */
  #beliefs({ poses, count, fleet, enlarged, palette }: Scene): void {
    const pen = this.#pen;
    let left = MOST_OUTLINES;
    this.context.beginPath();
    for (let robot = 0; robot < count && left > 0; robot++) {
      const at = robot * POSE_NUMBERS;
      const scale = this.#screen[robot * 3 + 2] ?? 0;
      if (scale === 0) continue;
      const x = poses[at + 6] ?? 0;
      const y = poses[at + 7] ?? 0;
      const z = poses[at + 8] ?? 0;
      const yaw = poses[at + 9] ?? 0;
      const off =
        Math.hypot(x - (poses[at] ?? 0), y - (poses[at + 1] ?? 0), z - (poses[at + 2] ?? 0)) * scale;
      const turn = Math.abs(Math.sin((yaw - (poses[at + 3] ?? 0)) / 2)) * 2;
      const radius = (fleet[robot]?.radius ?? 0.1) * enlarged;
      if (off < APART && (turn < TURNED || radius * scale < 10)) continue;
      left--;
      pen.circle(x, y, z, radius, radius * scale < 10 ? 8 : 20);
      pen.to(x, y, z, true);
      pen.to(x + radius * 1.3 * Math.cos(yaw), y + radius * 1.3 * Math.sin(yaw), z);
    }
    pen.stroke(palette.css.text, 1.3, 0.75, [3, 3]);
  }

  #selection({ selected, poses, fleet, enlarged, palette }: Scene): void {
    const ring = (robot: number, size: number) => {
      const at = robot * POSE_NUMBERS;
      const radius = (fleet[robot]?.radius ?? 0.1) * enlarged * size;
      this.#pen.circle(poses[at] ?? 0, poses[at + 1] ?? 0, poses[at + 2] ?? 0, radius);
    };
    this.context.beginPath();
    for (const robot of selected) if (this.#screen[robot * 3 + 2]) ring(robot, 1.45);
    this.#pen.stroke(palette.css.accent, 2.5);
    const target = hovered.value;
    if (target?.kind !== "robot") return;
    this.context.beginPath();
    ring(target.robot, 1.45);
    this.#pen.stroke(palette.css.accent, 1.5, 0.7);
  }

  #flashes({ happenings, now, linger, poses, fleet, enlarged, palette }: Scene): void {
    const span = linger * FLASH;
    happenings.flashes(now, span, ({ robot, time, kind }) => {
      const at = robot * POSE_NUMBERS;
      const share = (now - time) / span;
      const radius = (fleet[robot]?.radius ?? 0.1) * enlarged * (1.2 + 2.2 * share);
      this.context.beginPath();
      this.#pen.circle(poses[at] ?? 0, poses[at + 1] ?? 0, poses[at + 2] ?? 0, radius);
      this.#pen.stroke(palette.css[kind], 3.5, 1 - share);
    });
  }

  /** Down: crossed out. Failed: an exclamation mark in a triangle. Finished: a tick. */
  #conditions({ poses, count, fleet, enlarged, palette }: Scene): void {
    const { context } = this;
    const each = (condition: number, draw: (x: number, y: number, size: number) => void) => {
      context.beginPath();
      for (let robot = 0; robot < count; robot++) {
        const scale = this.#screen[robot * 3 + 2] ?? 0;
        if (scale === 0 || poses[robot * POSE_NUMBERS + POSE_NUMBERS - 1] !== condition) continue;
        const size = Math.min(14, Math.max(4, (fleet[robot]?.radius ?? 0.1) * enlarged * scale));
        draw(this.#screen[robot * 3] ?? 0, this.#screen[robot * 3 + 1] ?? 0, size);
      }
    };
    const outlined = (color: string, width: number) => {
      this.#pen.stroke(palette.css.floor, width + 2.5);
      this.#pen.stroke(color, width);
    };
    each(DOWN, (x, y, size) => this.#pen.cross(x, y, size * 0.9));
    outlined(palette.css.violation, 3);
    each(FAILED, (x, y, size) => {
      context.moveTo(x, y - size);
      context.lineTo(x + size, y + size * 0.8);
      context.lineTo(x - size, y + size * 0.8);
      context.closePath();
      context.moveTo(x, y - size * 0.4);
      context.lineTo(x, y + size * 0.2);
      context.moveTo(x, y + size * 0.5);
      context.lineTo(x, y + size * 0.51);
    });
    outlined(palette.css.violation, 2);
    each(FINISHED, (x, y, size) => {
      const tick = Math.min(6, size);
      const [left, top] = [x + size * 0.7, y + size * 0.7];
      context.moveTo(left - tick * 0.8, top);
      context.lineTo(left - tick * 0.2, top + tick * 0.6);
      context.lineTo(left + tick * 0.9, top - tick * 0.7);
    });
    outlined(palette.css.good, 2);
  }

  #measure({ palette }: Scene): void {
    const [from, fixed] = measured.value;
    if (!from) return;
    const place = pointed.value;
    const to = fixed ?? (tool.value === "measure" && place ? { ...place, z: from.z } : null);
    this.context.beginPath();
    this.#pen.circle(from.x, from.y, from.z, this.view.pixel * 4, 12);
    if (to) {
      this.#pen.to(from.x, from.y, from.z, true);
      this.#pen.to(to.x, to.y, to.z);
      this.#pen.circle(to.x, to.y, to.z, this.view.pixel * 4, 12);
    }
    this.#pen.stroke(palette.css.floor, 5);
    this.#pen.stroke(palette.css.text, 2);
    if (to) this.#note(palette, metres(Math.hypot(to.x - from.x, to.y - from.y, to.z - from.z)), from, to);
  }

  #move({ palette }: Scene): void {
    const move = moving.value;
    if (!move) return;
    const { from, to } = move;
    this.context.beginPath();
    this.#pen.to(from.x, from.y, from.z, true);
    this.#pen.to(to.x, to.y, to.z);
    this.#pen.circle(to.x, to.y, to.z, this.view.pixel * 9, 20);
    this.#pen.stroke(palette.css.accent, 2, 1, [5, 4]);
    this.#note(
      palette,
      `${nameOf(move.target)}${metres(Math.hypot(to.x - from.x, to.y - from.y))}`,
      from,
      to,
    );
  }

  /** A text in the middle between two places. */
  #note(
    palette: Scene["palette"],
    text: string,
    from: { x: number; y: number; z: number },
    to: typeof from,
  ): void {
    const { context } = this;
    const at = new Float32Array(3);
    this.view.project((from.x + to.x) / 2, (from.y + to.y) / 2, (from.z + to.z) / 2, at);
    const [x = 0, y = 0] = at;
    context.font = "600 13px system-ui, sans-serif";
    const width = context.measureText(text).width + 12;
    context.fillStyle = palette.css.text;
    context.beginPath();
    context.roundRect(x - width / 2, y - 26, width, 20, 5);
    context.fill();
    context.fillStyle = palette.css.panel;
    context.textBaseline = "middle";
    context.fillText(text, x - width / 2 + 6, y - 15.5);
  }

  /** The scale, and where the axes point. */
  #scale({ palette }: Scene): void {
    const { context, view } = this;
    const length = barLength(view.pixel);
    const width = length / view.pixel;
    const [x, y] = [view.width - 16 - width, view.height - 14];
    context.beginPath();
    context.moveTo(x, y - 4);
    context.lineTo(x, y);
    context.lineTo(x + width, y);
    context.lineTo(x + width, y - 4);
    this.#pen.stroke(palette.css.floor, 4);
    this.#pen.stroke(palette.css.muted, 1.5);
    context.font = "11px system-ui, sans-serif";
    context.textBaseline = "bottom";
    context.fillStyle = palette.css.muted;
    const label = metres(length);
    context.fillText(label, x + (width - context.measureText(label).width) / 2, y - 4);
    this.#axes(palette);
  }

  #axes(palette: Scene["palette"]): void {
    const { context, view } = this;
    const [x, y] = [30, view.height - 30];
    context.textBaseline = "middle";
    context.font = "600 11px system-ui, sans-serif";
    const colors = palette.dark ? ["#ff8a75", "#7bd694", "#8ab8ff"] : ["#b23a26", "#1d7a3d", "#1e5bb8"];
    ["x", "y", "z"].forEach((name, index) => {
      const axis = name as "x" | "y" | "z";
      const [dx, dy] = [view.right[axis] * 20, -view.up[axis] * 20];
      if (Math.hypot(dx, dy) < 3) return;
      context.beginPath();
      context.moveTo(x, y);
      context.lineTo(x + dx, y + dy);
      this.#pen.stroke(colors[index] ?? "", 2);
      context.fillStyle = colors[index] ?? "";
      context.fillText(name, x + dx * 1.35 - 3, y + dy * 1.35);
    });
  }
}

const nameOf = (target: Target): string => ("name" in target ? `${target.name} ` : "");
