// The contents of the world: obstacles, waypoints, things and areas.

import {
  BoxGeometry,
  type BufferGeometry,
  Color,
  DodecahedronGeometry,
  ExtrudeGeometry,
  Group,
  Mesh,
  MeshLambertMaterial,
  OctahedronGeometry,
  Shape,
  SphereGeometry,
  TetrahedronGeometry,
} from "three";
import { POSE_NUMBERS } from "../../engine/types.ts";
import { footprint, heights } from "../fit.ts";
import type { Area } from "../happenings.ts";
import { mix } from "../palette.ts";
import type { Scene } from "../scene.ts";
import { Lines } from "./lines.ts";

/** Half the thickness that walls are drawn with, m. */
const WALL = 0.02;
const THINGS = [OctahedronGeometry, BoxGeometry, DodecahedronGeometry, TetrahedronGeometry, SphereGeometry];

export class Places {
  readonly group = new Group();
  #lines = new Lines(1);
  #solid = new MeshLambertMaterial();
  #hidden = new MeshLambertMaterial({ transparent: true, opacity: 0.25, depthWrite: false });
  #thing = new MeshLambertMaterial({ color: "#e0a100", emissive: "#7a5600", flatShading: true });
  #obstacles: Mesh[] = [];
  #things: Mesh[] = [];
  #made: unknown[] = [];

  constructor() {
    this.group.add(this.#lines.mesh);
  }

  update(scene: Scene): void {
    const { world, palette, hidden, sky, happenings } = scene;
    const made = [
      world.obstacles,
      world.way_points,
      palette,
      hidden,
      sky,
      happenings.areas.version,
      world.things.length,
    ];
    if (made.some((part, index) => part !== this.#made[index])) {
      this.#made = made;
      this.#build(scene);
    }
    this.#carry(scene);
  }

  dispose(): void {
    this.#clear();
    this.#lines.dispose();
    for (const material of [this.#solid, this.#hidden, this.#thing]) material.dispose();
  }

  #clear(): void {
    for (const mesh of [...this.#obstacles, ...this.#things]) {
      mesh.geometry.dispose();
      this.group.remove(mesh);
    }
    this.#obstacles = [];
    this.#things = [];
  }

  #build(scene: Scene): void {
    const { world, palette, hidden } = scene;
    this.#clear();
    this.#lines.begin();
    this.#solid.color = color(palette.rgb.obstacle);
    this.#hidden.color = color(palette.rgb.obstacle);
    if (!hidden.has("obstacles")) for (const obstacle of world.obstacles) this.#stand(obstacle, scene);
    if (!hidden.has("areas")) this.#areas(scene);
    if (!hidden.has("wayPoints")) {
      const [large, small] = [world.way_points.length <= 16, world.way_points.length > 40];
      for (const { position } of world.way_points) {
        const at = { ...position, z: position.z + 0.003 };
        if (position.z > 0.05) this.#lines.add({ ...at, z: 0 }, at, palette.rgb["way-point"], 0.35, 1);
        this.#lines.add(at, at, palette.rgb["way-point"], small ? 0.8 : 1, small ? 4 : large ? 13 : 8.5);
        if (small) continue;
        this.#lines.add(at, at, palette.rgb.floor, 1, large ? 8 : 4.5);
        if (large) this.#lines.add(at, at, palette.rgb["way-point"], 1, 3.5);
      }
    }
    this.#lines.end();
    if (hidden.has("things")) return;
    world.things.forEach((_, index) => {
      const Geometry = THINGS[index % THINGS.length] ?? OctahedronGeometry;
      const mesh = new Mesh<BufferGeometry, MeshLambertMaterial>(new Geometry(), this.#thing);
      mesh.castShadow = true;
      this.#things.push(mesh);
      this.group.add(mesh);
    });
  }

  #stand({ obstacle, hidden: unknown }: Scene["world"]["obstacles"][number], { palette, sky }: Scene): void {
    const base = footprint(obstacle);
    const { low, high } = heights(obstacle, sky);
    const edge = mix(palette.rgb.obstacle, palette.rgb.text, 0.45);
    base.forEach(({ x, y }, index) => {
      const next = base[(index + 1) % base.length] ?? { x, y };
      const [alpha, gap] = unknown ? [0.7, 5] : [1, 0];
      for (const z of [low + 0.002, high]) {
        this.#lines.add({ x, y, z }, { ...next, z }, edge, alpha, base.length === 2 ? 2.5 : 1.4, gap);
      }
    });
    const corners = base.length === 2 ? thick(base) : base;
    if (corners.length < 3) return;
    const shape = new Shape();
    corners.forEach(({ x, y }, index) => {
      if (index === 0) shape.moveTo(x, y);
      else shape.lineTo(x, y);
    });
    const geometry = new ExtrudeGeometry(shape, { depth: Math.max(0.001, high - low), bevelEnabled: false });
    const mesh = new Mesh(geometry.translate(0, 0, low), unknown ? this.#hidden : this.#solid);
    mesh.castShadow = mesh.receiveShadow = !unknown;
    this.#obstacles.push(mesh);
    this.group.add(mesh);
  }

  #areas({ happenings, palette }: Scene): void {
    const drawn = new Set<string>();
    for (const area of happenings.areas.current.values()) {
      const key = JSON.stringify(area);
      if (drawn.has(key)) continue;
      drawn.add(key);
      const corners = outline(area);
      corners.forEach((corner, index) => {
        const next = corners[(index + 1) % corners.length] ?? corner;
        this.#lines.add({ ...corner, z: 0.01 }, { ...next, z: 0.01 }, palette.rgb.program, 0.8, 2.5, 7);
      });
    }
  }

  /** Things lie where they are, or above the robot that holds them. */
  #carry({ world, poses, fleet, enlarged }: Scene): void {
    world.things.forEach(({ position, holder }, index) => {
      const mesh = this.#things[index];
      if (!mesh) return;
      const at = holder === null ? -1 : holder * POSE_NUMBERS;
      const body = holder === null ? undefined : fleet[holder];
      const size = Math.max(0.09, (fleet[0]?.radius ?? 0.15) * 0.7) * enlarged;
      mesh.scale.setScalar(size);
      if (at >= 0 && body) {
        const z = (poses[at + 2] ?? 0) + body.height * enlarged + size;
        mesh.position.set(poses[at] ?? 0, poses[at + 1] ?? 0, z);
      } else mesh.position.set(position.x, position.y, position.z + size);
    });
  }
}

const color = (rgb: [number, number, number]) => new Color().setRGB(...rgb, "srgb");

export function outline(area: Area): { x: number; y: number }[] {
  if ("circle" in area) return footprint({ Circle: { ...area.circle, height: null } });
  if ("polygon" in area) return area.polygon;
  return footprint({ Cuboid: area.box });
}

/** A wall as a thin box. */
function thick([from, to]: { x: number; y: number }[]): { x: number; y: number }[] {
  if (!from || !to) return [];
  const length = Math.hypot(to.x - from.x, to.y - from.y) || 1;
  const [x, y] = [((to.x - from.x) / length) * WALL, ((to.y - from.y) / length) * WALL];
  return [
    { x: from.x - x + y, y: from.y - y - x },
    { x: to.x + x + y, y: to.y + y - x },
    { x: to.x + x - y, y: to.y + y + x },
    { x: from.x - x - y, y: from.y - y + x },
  ];
}
