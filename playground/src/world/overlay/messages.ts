// Datagrams under way: a dot that runs along a line, a ring that grows for one to all in reach, a cross where one is
// lost. They stay for a moment after they have arrived, as most take less time than an eye needs.

import { POSE_NUMBERS } from "../../engine/types.ts";
import type { Scene } from "../scene.ts";
import type { Sent } from "../traffic.ts";
import type { Pen } from "./pen.ts";

/** More are not drawn. */
const MOST = 150;
/** Lines and crosses of one broadcast. */
const MOST_RECEIVERS = 60;

/** The radius of a ring on the screen, px. */
const RING = 90;

/** The rings that are drawn now, by sender and span of time: one that sends all the time has one ring at a time. */
const rings = new Map<number, Sent>();

export function drawMessages(pen: Pen, scene: Scene, screen: Float32Array): void {
  const { happenings, now, linger, message } = scene;
  if (!scene.hidden.has("messages")) {
    rings.clear();
    happenings.traffic.near(now, linger, MOST, (sent) => drawSent(pen, scene, screen, sent));
    for (const sent of rings.values()) drawRing(pen, scene, screen, sent);
  }
  const chosen = message && happenings.traffic.find(message.from, message.sequence);
  if (chosen) lightUp(pen, scene, screen, chosen);
}

function drawSent(pen: Pen, scene: Scene, screen: Float32Array, sent: Sent): void {
  const color = scene.colors.css[sent.from] ?? "#888";
  const age = scene.now - sent.time;
  if (sent.to === null && age < scene.linger) {
    // Those before it in the same span come later and take its place.
    rings.set(sent.from + Math.floor(sent.time / scene.linger) * scene.count, sent);
  }
  for (const { robot, time, reason } of sent.arrivals.slice(0, MOST_RECEIVERS)) {
    const since = scene.now - time;
    if (since >= scene.linger || (sent.to === null && reason === null)) continue;
    const fade = 1 - Math.max(0, since) / scene.linger;
    const share = Math.min(1, age / Math.max(1e-6, time - sent.time));
    flight(pen, scene, screen, sent.from, robot, share, fade, reason !== null && since >= 0, color);
  }
  // The end is not known yet: it goes as those before did.
  if (sent.to !== null && sent.arrivals.length === 0) {
    const share = age / (age + scene.happenings.traffic.delay);
    flight(pen, scene, screen, sent.from, sent.to, share, 1, false, color);
  }
}

/** A ring that grows towards the radio's range, or the furthest receiver. */
function drawRing(pen: Pen, scene: Scene, screen: Float32Array, sent: Sent): void {
  const at = sent.from * POSE_NUMBERS;
  const scale = screen[sent.from * 3 + 2] ?? 0;
  if (scale === 0) return;
  const { poses, range } = scene;
  const [x, y, z] = [poses[at] ?? 0, poses[at + 1] ?? 0, poses[at + 2] ?? 0];
  let reach = 0;
  for (const { robot } of sent.arrivals) {
    const to = robot * POSE_NUMBERS;
    reach = Math.max(reach, Math.hypot((poses[to] ?? x) - x, (poses[to + 1] ?? y) - y));
  }
  reach = Math.min(reach || (range ?? 1), range ?? Number.POSITIVE_INFINITY, RING / scale);
  const share = Math.min(1, (scene.now - sent.time) / scene.linger);
  const radius = (scene.fleet[sent.from]?.radius ?? 0.1) * scene.enlarged;
  pen.context.beginPath();
  pen.circle(x, y, z, radius + Math.max(0, reach - radius) * share, 48);
  const crowd = Math.min(1, 14 / rings.size);
  pen.stroke(scene.colors.css[sent.from] ?? "#888", 1.8, (1 - share) * (0.35 + 0.55 * crowd));
}

function flight(
  pen: Pen,
  scene: Scene,
  screen: Float32Array,
  from: number,
  to: number,
  share: number,
  fade: number,
  lost: boolean,
  color: string,
): void {
  const [ax = 0, ay = 0, a = 0] = screen.subarray(from * 3, from * 3 + 3);
  const [bx = 0, by = 0, b = 0] = screen.subarray(to * 3, to * 3 + 3);
  if (a === 0 || b === 0) return;
  const { context } = pen;
  // A lost message does not reach the end.
  const along = lost ? 0.7 : share;
  const [x, y] = [ax + (bx - ax) * along, ay + (by - ay) * along];
  context.beginPath();
  context.moveTo(ax, ay);
  context.lineTo(lost ? x : bx, lost ? y : by);
  pen.stroke(lost ? scene.palette.css.violation : color, 1.5, 0.55 * fade, lost ? [4, 3] : []);
  context.beginPath();
  if (lost) {
    pen.cross(x, y, 5);
    pen.stroke(scene.palette.css.violation, 2.5, fade);
    return;
  }
  context.globalAlpha = fade;
  context.fillStyle = color;
  context.arc(x, y, 4, 0, 2 * Math.PI);
  context.fill();
  context.globalAlpha = 1;
}

/** Both ends of the datagram that a person has chosen. */
function lightUp(pen: Pen, scene: Scene, screen: Float32Array, sent: Sent): void {
  const { context } = pen;
  const color = scene.palette.css.accent;
  const ends =
    sent.arrivals.length > 0 ? sent.arrivals : sent.to === null ? [] : [{ robot: sent.to, reason: null }];
  const [ax = 0, ay = 0] = screen.subarray(sent.from * 3, sent.from * 3 + 3);
  halo(pen, scene, sent.from, color, []);
  for (const { robot, reason } of ends.slice(0, MOST_RECEIVERS)) {
    const [bx = 0, by = 0] = screen.subarray(robot * 3, robot * 3 + 3);
    context.beginPath();
    context.moveTo(ax, ay);
    context.lineTo(bx, by);
    const end = reason === null ? color : scene.palette.css.violation;
    pen.stroke(end, 2.5, 0.9, reason === null ? [] : [5, 4]);
    const angle = Math.atan2(by - ay, bx - ax);
    context.beginPath();
    for (const side of [-0.45, 0.45]) {
      context.moveTo(bx - 14 * Math.cos(angle + side), by - 14 * Math.sin(angle + side));
      context.lineTo(bx, by);
    }
    pen.stroke(end, 2.5);
    halo(pen, scene, robot, end, [5, 4]);
  }
}

function halo(pen: Pen, scene: Scene, robot: number, color: string, dash: number[]): void {
  const at = robot * POSE_NUMBERS;
  const radius = (scene.fleet[robot]?.radius ?? 0.1) * scene.enlarged * 1.9;
  pen.context.beginPath();
  pen.circle(scene.poses[at] ?? 0, scene.poses[at + 1] ?? 0, scene.poses[at + 2] ?? 0, radius);
  pen.stroke(color, 3, 1, dash);
}
