// The readings of the chosen robots' sensors: rays to what they meet, the reach of a detector with lines to what it
// sees, and where the bumper is pressed.

import type { Robot } from "../../engine/types.ts";
import type { Scene } from "../scene.ts";
import type { Pen } from "./pen.ts";

/** A bumper that is pressed is marked this far to both sides of the touch, radians. */
const PRESSED = 0.35;

export function drawSensors(pen: Pen, scene: Scene): void {
  for (const robot of scene.robots) {
    const color = scene.colors.css[robot.id] ?? scene.palette.css.text;
    const { radius = 0, height = 0 } = scene.fleet[robot.id] ?? {};
    proximity(pen, scene, robot, radius, height, color);
    detector(pen, robot, height, color);
    bumper(pen, scene, robot, radius, height);
  }
}

function proximity(
  pen: Pen,
  { palette }: Scene,
  robot: Robot,
  radius: number,
  height: number,
  color: string,
) {
  const { proximity, proximity_range: range } = robot.sensors;
  if (range === null) return;
  const { position, yaw } = robot.pose;
  const z = position.z + height / 2;
  const ray = ({ bearing, distance }: (typeof proximity)[number]) => {
    const [cos, sin] = [Math.cos(yaw + bearing), Math.sin(yaw + bearing)];
    const end = radius + distance;
    pen.to(position.x + radius * cos, position.y + radius * sin, z, true);
    pen.to(position.x + end * cos, position.y + end * sin, z);
    return { x: position.x + end * cos, y: position.y + end * sin };
  };
  pen.context.beginPath();
  for (const free of proximity.filter(({ distance }) => distance >= range)) ray(free);
  pen.stroke(color, 1, 0.45);
  const met = proximity.filter(({ distance }) => distance < range);
  pen.context.beginPath();
  const ends = met.map(ray);
  pen.stroke(palette.css.violation, 1.5, 0.9);
  pen.context.beginPath();
  for (const { x, y } of ends) pen.circle(x, y, z, pen.view.pixel * 2.5, 8);
  pen.stroke(palette.css.violation, 2);
}

function detector(pen: Pen, { pose, sensors }: Robot, height: number, color: string): void {
  if (sensors.detector_range === null) return;
  const { x, y, z } = pose.position;
  pen.context.beginPath();
  pen.circle(x, y, z + height / 2, sensors.detector_range, 64);
  pen.stroke(color, 1, 0.6, [1, 4]);
  pen.context.beginPath();
  for (const { position } of sensors.detections) {
    pen.to(x, y, z + height / 2, true);
    pen.to(position.x, position.y, position.z);
  }
  pen.stroke(color, 1.5, 0.9, [6, 3]);
}

function bumper(pen: Pen, { palette }: Scene, robot: Robot, radius: number, height: number): void {
  const { bumper } = robot.sensors;
  if (bumper === null) return;
  const { position, yaw } = robot.pose;
  pen.context.beginPath();
  for (let step = -4; step <= 4; step++) {
    const angle = yaw + bumper + (step / 4) * PRESSED;
    const [x, y] = [position.x + radius * Math.cos(angle), position.y + radius * Math.sin(angle)];
    pen.to(x, y, position.z + height / 2, step === -4);
  }
  pen.stroke(palette.css.violation, 5);
}
