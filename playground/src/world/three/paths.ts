// The paths of all robots so far. The buffer holds the places of all robots frame by frame, so a moment of the run is a
// length of it: going there costs nothing, and a new frame is appended. A line goes from a place to the one that
// stands a frame later in the same buffer.

import {
  DataTexture,
  type InstancedBufferGeometry,
  InstancedInterleavedBuffer,
  Mesh,
  NearestFilter,
  RGBAFormat,
  type ShaderMaterial,
} from "three";
import { POSE_NUMBERS } from "../../engine/types.ts";
import type { Frame, History } from "../../run/history.ts";
import { LEFT, type Scene } from "../scene.ts";
import { instanced, lineMaterial } from "./lines.ts";

/** x, y, z, and the robot. */
const STRIDE = 4;
/** More lines than this are not drawn: the oldest are left out. */
const MOST_LINES = 400_000;

export class Paths {
  readonly mesh: Mesh<InstancedBufferGeometry, ShaderMaterial>;
  #palette = new DataTexture(new Uint8Array(4), 1, 1, RGBAFormat);
  #numbers = new Float32Array();
  #buffer = new InstancedInterleavedBuffer(this.#numbers, STRIDE, 1);
  #robots = 0;
  #frames = 0;
  #generation = -1;
  #colors: Scene["colors"] | null = null;
  #selection = "";

  constructor() {
    const geometry = instanced(this.#buffer, {});
    this.mesh = new Mesh(geometry, lineMaterial(this.#palette, 2));
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = 2;
  }

  update(scene: Scene): void {
    this.mesh.visible = !scene.hidden.has("paths") && scene.history.frames.length > 0;
    if (!this.mesh.visible) return;
    this.#paint(scene);
    const { history, count } = scene;
    if (history.generation !== this.#generation || count !== this.#robots) {
      this.#generation = history.generation;
      this.#robots = count;
      this.#frames = 0;
    }
    this.#append(history);
    this.#tip(scene);
    // The place after the last frame up to now is that of now.
    const segments = (history.indexAt(scene.now) + 1) * count;
    const first = Math.max(0, segments - MOST_LINES);
    this.#range(first - (first % Math.max(1, count)), segments);
  }

  dispose(): void {
    this.mesh.geometry.dispose();
    this.mesh.material.dispose();
    this.#palette.dispose();
  }

  /** Takes over frames that are new. */
  #append(history: History): void {
    const frames = history.frames;
    // Room for the frames and for the place of now.
    const needed = (frames.length + 2) * this.#robots * STRIDE;
    if (needed > this.#numbers.length) {
      this.#numbers = new Float32Array(Math.max(4096, 2 * needed));
      this.#frames = 0;
      this.#buffer = new InstancedInterleavedBuffer(this.#numbers, STRIDE, 1);
      this.#first = -1;
    }
    if (this.#frames === frames.length) return;
    const from = this.#frames;
    for (; this.#frames < frames.length; this.#frames++) {
      const frame = frames[this.#frames];
      if (frame) this.#write(frame.poses, this.#frames, frames[this.#frames - 1]);
    }
    this.#upload(from, frames.length);
  }

  /** The way from the last frame to now. It overwrites the next frame, which is written again when it is reached. */
  #tip(scene: Scene): void {
    const next = scene.history.indexAt(scene.now) + 1;
    const kept = this.#tipAt;
    if (kept >= 0 && kept !== next) {
      const frame = scene.history.frames[kept];
      if (frame) {
        this.#write(frame.poses, kept, scene.history.frames[kept - 1]);
        this.#upload(kept, kept + 1);
      }
    }
    this.#tipAt = next;
    this.#write(scene.poses, next, scene.history.frames[next - 1]);
    this.#upload(next, next + 1);
  }

  #tipAt = -1;
  #first = -1;

  #write(poses: ArrayLike<number>, frame: number, before: Frame | undefined): void {
    const numbers = this.#numbers;
    for (let robot = 0; robot < this.#robots; robot++) {
      const to = (frame * this.#robots + robot) * STRIDE;
      const from = robot * POSE_NUMBERS;
      const gone = poses[from + POSE_NUMBERS - 1] === LEFT || from >= poses.length;
      const source = gone ? (before?.poses ?? poses) : poses;
      numbers[to] = source[from] ?? Number.NaN;
      numbers[to + 1] = source[from + 1] ?? Number.NaN;
      numbers[to + 2] = (source[from + 2] ?? Number.NaN) + 0.004;
      numbers[to + 3] = robot;
    }
  }

  #upload(from: number, to: number): void {
    const row = this.#robots * STRIDE;
    this.#buffer.addUpdateRange(from * row, (to - from) * row);
    this.#buffer.needsUpdate = true;
  }

  /** Draws the lines from number `first` up to `end`. */
  #range(first: number, end: number): void {
    if (first !== this.#first || this.mesh.geometry.userData.robots !== this.#robots) {
      this.mesh.geometry.dispose();
      const start = first * STRIDE;
      const next = start + this.#robots * STRIDE;
      this.mesh.geometry = instanced(this.#buffer, {
        start: [3, start],
        end: [3, next],
        robot: [1, start + 3],
      });
      this.mesh.geometry.userData.robots = this.#robots;
      this.#first = first;
    }
    this.mesh.geometry.instanceCount = Math.max(0, end - first);
  }

  /** Colours by robot: those of robots that are not selected are fainter, if some are. */
  #paint({ colors, selected, count, palette }: Scene): void {
    const selection = `${selected.join()} ${palette.dark}`;
    if (colors === this.#colors && selection === this.#selection) return;
    [this.#colors, this.#selection] = [colors, selection];
    const width = Math.max(1, count);
    const texels = new Uint8Array(width * 4);
    const chosen = new Set(selected);
    for (let robot = 0; robot < count; robot++) {
      const alpha = chosen.size === 0 ? (count > 200 ? 0.45 : 0.8) : chosen.has(robot) ? 1 : 0.22;
      texels.set(
        [...(colors.rgb[robot] ?? [0, 0, 0]), alpha].map((part) => Math.round(part * 255)),
        robot * 4,
      );
    }
    this.#palette.dispose();
    this.#palette = new DataTexture(texels, width, 1, RGBAFormat);
    this.#palette.minFilter = this.#palette.magFilter = NearestFilter;
    this.#palette.needsUpdate = true;
    const uniform = this.mesh.material.uniforms.palette;
    if (uniform) uniform.value = this.#palette;
    const size = this.mesh.material.uniforms.width;
    if (size) size.value = count > 200 ? 1.2 : 2.2;
  }
}
