// The shapes of a stretch of the diagram, and those under a pointer. Only events of that stretch are
// drawn; of too many events only a regular sample is.

import type { Event, Events } from "../run/events.ts";
import type { Datagram, Traffic } from "./traffic.ts";

export interface Arrow {
  datagram: Datagram;
  /** Where it was delivered or lost; null while it is under way. */
  end: Event | null;
  x1: number;
  y1: number;
  x2: number;
  y2: number;
  lost: boolean;
}

export interface Mark {
  event: Event;
  /** Null: it happened to the world as a whole. */
  x: number | null;
  y: number;
}

export interface Scene {
  arrows: Arrow[];
  marks: Mark[];
  /** One of so many events is drawn. */
  thinned: number;
}

export interface Frame {
  from: number;
  to: number;
  /** Places, px. */
  xOf: (robot: number) => number;
  yOf: (time: number) => number;
  left: number;
  right: number;
}

/** More events are not looked at for one picture. */
const MOST = 8_000;
/** How far a message with no end goes, px. */
const STUB = 22;
/** Where on its way a lost message ends, as a share. */
const LOST_AT = 0.6;

export function sceneOf(events: Events, traffic: Traffic, frame: Frame): Scene {
  const scene: Scene = { arrows: [], marks: [], thinned: 1 };
  const start = events.from(frame.from);
  // Messages that arrive below the stretch may cross it.
  const stop = events.from(frame.to + traffic.longest + 1e-9);
  scene.thinned = Math.max(1, Math.ceil((stop - start) / MOST));
  for (let index = start; index < stop; index += scene.thinned) {
    const event = events.list[index];
    if (event) take(scene, event, traffic, frame);
  }
  return scene;
}

function take(scene: Scene, event: Event, traffic: Traffic, frame: Frame): void {
  const { message, topic, time } = event;
  switch (topic) {
    case "/starl/mark":
      return;
    case "/starl/sent": {
      const datagram = traffic.of(event);
      if (datagram?.ends.length === 0 && time <= frame.to) push(scene, arrow(datagram, null, frame), frame);
      return;
    }
    case "/starl/delivered":
    case "/starl/dropped": {
      const datagram = traffic.of(event);
      if (datagram && datagram.sent.time <= frame.to) push(scene, arrow(datagram, event, frame), frame);
      return;
    }
  }
  if (time > frame.to) return;
  const x = message.robot === undefined ? null : frame.xOf(message.robot);
  if (x !== null && (x < frame.left || x > frame.right)) return;
  scene.marks.push({ event, x, y: frame.yOf(time) });
}

function push(scene: Scene, arrow: Arrow, { left, right }: Frame): void {
  if (Math.max(arrow.x1, arrow.x2) >= left && Math.min(arrow.x1, arrow.x2) <= right) scene.arrows.push(arrow);
}

function arrow(datagram: Datagram, end: Event | null, frame: Frame): Arrow {
  const { sent, from } = datagram;
  const [x1, y1] = [frame.xOf(from), frame.yOf(sent.time)];
  const lost = end?.topic === "/starl/dropped";
  const to = lost ? end?.message.to : end ? end.message.robot : sent.message.to;
  if (typeof to !== "number") return { datagram, end, x1, y1, x2: x1 + STUB, y2: y1 + STUB / 2, lost };
  let [x2, y2] = [frame.xOf(to), end ? frame.yOf(end.time) : y1 + STUB];
  if (lost) [x2, y2] = [x1 + (x2 - x1) * LOST_AT, Math.max(y1 + (y2 - y1) * LOST_AT, y1 + 3)];
  else if (!end) x2 = x1 + Math.sign(x2 - x1) * STUB;
  return { datagram, end, x1, y1, x2, y2, lost };
}

/** The shapes within so many px of a place; marks lie over arrows. */
export function hit(scene: Scene, x: number, y: number, near: number): Mark | Arrow | null {
  let [found, least]: [Mark | Arrow | null, number] = [null, near];
  for (const mark of scene.marks) {
    const off = Math.hypot(mark.x === null ? 0 : mark.x - x, mark.y - y);
    if (off < least) [found, least] = [mark, off];
  }
  if (found) return found;
  for (const arrow of scene.arrows) {
    const off = distance(arrow, x, y);
    if (off < least) [found, least] = [arrow, off];
  }
  return found;
}

/** How far a place is from an arrow, px. */
function distance({ x1, y1, x2, y2 }: Arrow, x: number, y: number): number {
  const [dx, dy] = [x2 - x1, y2 - y1];
  const length = dx * dx + dy * dy;
  const share = length === 0 ? 0 : Math.min(1, Math.max(0, ((x - x1) * dx + (y - y1) * dy) / length));
  return Math.hypot(x - (x1 + share * dx), y - (y1 + share * dy));
}
