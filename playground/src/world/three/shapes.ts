// Shapes of robots by model: radius 1 and height 1, the base on the floor, the nose along x. Each has a part in the
// robot's own colour and a trim in colours of its own.

import {
  BoxGeometry,
  type BufferGeometry,
  ConeGeometry,
  CylinderGeometry,
  Float32BufferAttribute,
  TorusGeometry,
} from "three";
import { mergeGeometries } from "three/examples/jsm/utils/BufferGeometryUtils.js";
import { parse } from "../palette.ts";

export interface Shape {
  paint: BufferGeometry;
  trim: BufferGeometry;
}

const DARK = "#20262d";
const METAL = "#8b95a0";
const LIGHT = "#fdfdfb";
const LAMP = "#ffe08a";

/** Sides of what is round; fewer in large fleets, where a robot is a few pixels. */
const [FINE, COARSE] = [24, 9];
let round = FINE;

/** An upright cylinder between two heights. */
function disc(radius: number, low: number, high: number, sides = round, top = radius): BufferGeometry {
  return new CylinderGeometry(top, radius, high - low, sides)
    .rotateX(Math.PI / 2)
    .translate(0, 0, (low + high) / 2);
}

/** A wheel with its axle along y. */
function wheel(x: number, y: number, radius: number, width: number, tall: number): BufferGeometry {
  return new CylinderGeometry(radius, radius, width, Math.ceil(round * 0.6))
    .scale(1, 1, tall)
    .translate(x, y, radius * tall);
}

function box(length: number, width: number, low: number, high: number, x = 0, y = 0): BufferGeometry {
  return new BoxGeometry(length, width, high - low).translate(x, y, (low + high) / 2);
}

/** A flat arrow that points along x. */
function arrow(size: number, z: number, x = 0): BufferGeometry {
  return new ConeGeometry(size * 0.72, size * 1.5, 3)
    .rotateY(Math.PI)
    .rotateZ(-Math.PI / 2)
    .scale(1, 1, 0.08 / size)
    .translate(x, 0, z);
}

function ring(radius: number, thickness: number, z: number, arc = 2 * Math.PI, turn = 0): BufferGeometry {
  return new TorusGeometry(radius, thickness, round === FINE ? 5 : 3, round, arc)
    .rotateZ(turn)
    .translate(0, 0, z);
}

function colored(geometry: BufferGeometry, color: string): BufferGeometry {
  // three takes the colours of vertices as linear.
  const linear = parse(color).map((part) =>
    part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4,
  );
  const count = geometry.getAttribute("position").count;
  const colors = Array.from({ length: count }, () => linear).flat();
  return geometry.setAttribute("color", new Float32BufferAttribute(colors, 3));
}

function join(parts: BufferGeometry[]): BufferGeometry {
  const joined = mergeGeometries(parts.map((part) => part.toNonIndexed()));
  for (const part of parts) part.dispose();
  return joined.deleteAttribute("uv");
}

const shape = (paint: BufferGeometry[], trim: [string, BufferGeometry][]): Shape => ({
  paint: join(paint),
  trim: join(trim.map(([color, part]) => colored(part, color))),
});

/** The iRobot Create: a low disc on two wheels, with a bumper around its front. */
function create(): Shape {
  return shape(
    [disc(0.96, 0.12, 0.86), disc(0.96, 0.86, 1, round, 0.88)],
    [
      [DARK, wheel(0, 0.78, 0.3, 0.22, 0.9)],
      [DARK, wheel(0, -0.78, 0.3, 0.22, 0.9)],
      [DARK, ring(0.95, 0.075, 0.5, Math.PI * 0.9, -Math.PI * 0.45)],
      [LIGHT, arrow(0.5, 1.03, 0.12)],
    ],
  );
}

/** A tall robot on two wheels, such as the foot-bot. */
function differential(): Shape {
  return shape(
    [disc(0.86, 0.14, 0.52), disc(0.78, 0.62, 0.96, round, 0.7)],
    [
      [METAL, disc(0.7, 0.52, 0.62)],
      [DARK, wheel(0, 0.86, 0.42, 0.22, 0.55)],
      [DARK, wheel(0, -0.86, 0.42, 0.22, 0.55)],
      [LIGHT, arrow(0.48, 0.99, 0.1)],
    ],
  );
}

/** A body of six sides on three rollers. */
function holonomic(): Shape {
  const rollers = [0, 1, 2].map((third): [string, BufferGeometry] => [
    DARK,
    wheel(0, 0.8, 0.24, 0.24, 1).rotateZ((third * 2 * Math.PI) / 3),
  ]);
  return shape([disc(0.95, 0.16, 1, 6, 0.8)], [...rollers, [LIGHT, arrow(0.46, 1.03, 0.1)]]);
}

/** A car: 0.58 by 0.31 of a circle of 0.66. */
function car(): Shape {
  const [length, width] = [1.76, 0.94];
  const wheels = [1, -1].flatMap((x) =>
    [1, -1].map((y): [string, BufferGeometry] => [DARK, wheel(x * 0.52, (y * width) / 2, 0.19, 0.12, 1.6)]),
  );
  return shape(
    [box(length, width * 0.94, 0.25, 0.62), box(0.78, width * 0.72, 0.9, 1, -0.12)],
    [
      ...wheels,
      [DARK, box(0.92, width * 0.8, 0.62, 0.9, -0.12)],
      [LIGHT, arrow(0.2, 0.65, 0.62)],
      [LAMP, box(0.05, 0.2, 0.4, 0.56, length / 2, 0.28)],
      [LAMP, box(0.05, 0.2, 0.4, 0.56, length / 2, -0.28)],
      ["#c62828", box(0.05, 0.2, 0.4, 0.56, -length / 2, 0.28)],
      ["#c62828", box(0.05, 0.2, 0.4, 0.56, -length / 2, -0.28)],
    ],
  );
}

/** A quadcopter: four rotors on arms; the front ones are light. */
function drone(): Shape {
  const arms = [1, 3, 5, 7];
  const out = (geometry: BufferGeometry, arm: number, reach: number) =>
    geometry.translate(Math.cos((arm * Math.PI) / 4) * reach, Math.sin((arm * Math.PI) / 4) * reach, 0);
  const trim = arms.flatMap((arm): [string, BufferGeometry][] => {
    const front = arm === 1 || arm === 7;
    return [
      [DARK, out(disc(0.06, 0.45, 0.9, 8), arm, 0.62)],
      [
        front ? LIGHT : METAL,
        out(new BoxGeometry(0.62, 0.05, 0.06).rotateZ(arm).translate(0, 0, 0.92), arm, 0.62),
      ],
    ];
  });
  const beams = [1, 3].map((arm) => box(1.28, 0.11, 0.42, 0.62).rotateZ((arm * Math.PI) / 4));
  const hoops = arms.map((arm) => out(ring(0.36, 0.045, 0.75), arm, 0.62));
  const legs = [1, -1].map((y): [string, BufferGeometry] => [DARK, box(0.5, 0.05, 0, 0.08, 0, y * 0.26)]);
  return shape(
    [box(0.72, 0.34, 0.3, 0.85), ...beams, ...hoops],
    [
      ...trim,
      ...legs,
      [LIGHT, arrow(0.17, 0.88, 0.2)],
      [DARK, box(0.36, 0.06, 0.08, 0.36, 0, 0.22)],
      [DARK, box(0.36, 0.06, 0.08, 0.36, 0, -0.22)],
    ],
  );
}

/** For models that the page does not know. */
function other(): Shape {
  return shape([disc(0.95, 0, 0.7, 16, 0.7)], [[LIGHT, arrow(0.6, 0.75, 0.05)]]);
}

const SHAPES: Record<string, () => Shape> = { create, differential, holonomic, car, drone };

/** The shape of a model; `coarse` for large fleets. */
export function shapeOf(model: string, coarse: boolean): Shape {
  round = coarse ? COARSE : FINE;
  return (SHAPES[model] ?? other)();
}
