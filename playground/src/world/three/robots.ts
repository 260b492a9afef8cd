// Robots: two draw calls for all of a model, however many there are.

import { Color, Group, InstancedMesh, MeshLambertMaterial, type Object3D } from "three";
import { type Member, POSE_NUMBERS } from "../../engine/types.ts";
import { mix, type Rgb } from "../palette.ts";
import { DOWN, FAILED, LEFT, RUNNING, type Scene } from "../scene.ts";
import { shapeOf } from "./shapes.ts";

/** How far a robot that is down leans over, radians. */
const FALLEN = 1.1;

/** Robots of larger fleets have coarser shapes. */
const FINE_FLEET = 250;

interface Kind {
  robots: number[];
  paint: InstancedMesh;
  trim: InstancedMesh;
}

export class Robots {
  readonly group: Object3D = new Group();
  #paint = new MeshLambertMaterial();
  #trim = new MeshLambertMaterial({ vertexColors: true });
  #kinds: Kind[] = [];
  #models = "";
  #colors: Scene["colors"] | null = null;
  #conditions = new Uint8Array();

  update(scene: Scene): void {
    const models = scene.fleet.length === this.#conditions.length ? this.#models : "";
    if (models === "" || scene.colors !== this.#colors) this.#build(scene.fleet);
    const recolor = scene.colors !== this.#colors;
    this.#colors = scene.colors;
    for (const kind of this.#kinds) this.#place(kind, scene, recolor);
  }

  dispose(): void {
    this.#clear();
    for (const material of [this.#paint, this.#trim]) material.dispose();
  }

  #clear(): void {
    for (const { paint, trim } of this.#kinds) {
      for (const mesh of [paint, trim]) {
        mesh.geometry.dispose();
        mesh.dispose();
        this.group.remove(mesh);
      }
    }
    this.#kinds = [];
  }

  #build(fleet: Member[]): void {
    const models = fleet.map(({ model }) => model).join();
    if (models === this.#models && this.#kinds.length > 0) return;
    this.#models = models;
    this.#conditions = new Uint8Array(fleet.length).fill(255);
    this.#clear();
    for (const model of new Set(fleet.map(({ model }) => model))) {
      const robots = fleet.filter((member) => member.model === model).map(({ id }) => id);
      const shape = shapeOf(model, fleet.length > FINE_FLEET);
      const paint = new InstancedMesh(shape.paint, this.#paint, robots.length);
      const trim = new InstancedMesh(shape.trim, this.#trim, robots.length);
      trim.instanceMatrix = paint.instanceMatrix;
      for (const mesh of [paint, trim]) {
        mesh.frustumCulled = false;
        mesh.castShadow = true;
        this.group.add(mesh);
      }
      this.#kinds.push({ robots, paint, trim });
    }
  }

  #place({ robots, paint }: Kind, { poses, fleet, colors, enlarged }: Scene, recolor: boolean): void {
    const matrices = paint.instanceMatrix.array as Float32Array;
    let recolored = recolor;
    for (let index = 0; index < robots.length; index++) {
      const robot = robots[index] ?? 0;
      const member = fleet[robot];
      const at = robot * POSE_NUMBERS;
      const condition = at < poses.length ? (poses[at + POSE_NUMBERS - 1] ?? LEFT) : LEFT;
      const size = condition === LEFT ? 0 : (member?.radius ?? 0.1) * enlarged;
      const tall = condition === LEFT ? 0 : (member?.height ?? 0.1) * enlarged;
      const lean = condition === DOWN && !member?.flies ? FALLEN : 0;
      place(matrices, index * 16, poses, at, size, tall, lean);
      if (recolor || condition !== this.#conditions[robot]) {
        this.#conditions[robot] = condition;
        paint.setColorAt(
          index,
          color.setRGB(...shade(colors.rgb[robot] ?? [0.5, 0.5, 0.5], condition), "srgb"),
        );
        recolored = true;
      }
    }
    paint.instanceMatrix.needsUpdate = true;
    if (recolored && paint.instanceColor) paint.instanceColor.needsUpdate = true;
  }
}

const color = new Color();

/** Robots that do not run are greyer. */
function shade(color: Rgb, condition: number): Rgb {
  if (condition === RUNNING) return color;
  return mix(color, [0.5, 0.52, 0.55], condition === DOWN || condition === FAILED ? 0.7 : 0.25);
}

/** Writes the matrix of a pose: yaw about z, then pitch about the turned y, then roll about the turned x. */
function place(
  matrix: Float32Array,
  to: number,
  poses: ArrayLike<number>,
  at: number,
  size: number,
  tall: number,
  lean: number,
): void {
  const yaw = poses[at + 3] ?? 0;
  const pitch = poses[at + 4] ?? 0;
  const roll = (poses[at + 5] ?? 0) + lean;
  const cy = Math.cos(yaw);
  const sy = Math.sin(yaw);
  const cp = Math.cos(pitch);
  const sp = Math.sin(pitch);
  const cr = Math.cos(roll);
  const sr = Math.sin(roll);
  matrix[to] = cy * cp * size;
  matrix[to + 1] = sy * cp * size;
  matrix[to + 2] = -sp * size;
  matrix[to + 4] = (cy * sp * sr - sy * cr) * size;
  matrix[to + 5] = (sy * sp * sr + cy * cr) * size;
  matrix[to + 6] = cp * sr * size;
  matrix[to + 8] = (cy * sp * cr + sy * sr) * tall;
  matrix[to + 9] = (sy * sp * cr - cy * sr) * tall;
  matrix[to + 10] = cp * cr * tall;
  matrix[to + 12] = poses[at] ?? 0;
  matrix[to + 13] = poses[at + 1] ?? 0;
  // A tilted body still lies on the floor.
  matrix[to + 14] = (poses[at + 2] ?? 0) + Math.sin(lean) * size * 0.9;
  matrix[to + 15] = 1;
}
