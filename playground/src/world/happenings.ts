// The picture at a moment from the records of a run: drawings of programs, planned paths, the
// datagrams under way, and what has just happened. Each record is read once.

import type { Point } from "../engine/types.ts";
import type { Event, Events } from "../run/events.ts";
import { Ledger } from "./ledger.ts";
import { Traffic } from "./traffic.ts";

export interface Mark {
  robot: number;
  label: string;
  shape: "dot" | "circle" | "line" | "text";
  points: Point[];
  radius: number;
}

export interface Plan {
  robot: number;
  path: Point[];
}

export type Area =
  | { circle: { center: Point; radius: number } }
  | { polygon: Point[] }
  | { box: { low: Point; high: Point } };

export interface Flash {
  /** s */
  time: number;
  robot: number;
  kind: "violation" | "fault" | "program";
}

const FLASHES: Record<string, Flash["kind"]> = {
  "/starl/violation": "violation",
  "/starl/collision": "violation",
  "/starl/fault": "fault",
  "/starl/discovered": "program",
  "/starl/thing": "program",
  "/starl/status": "program",
};

/** The members of records, as docs/reference/trace.md has them. */
interface DrawnMark {
  label: string;
  shape: Mark["shape"] | "nothing";
  points?: Point[];
  radius?: number;
}

interface PrimitiveEvent {
  port: number;
  primitive: string;
  name: string;
  fields: { path?: Point[]; area?: Area }[];
}

export class Happenings {
  readonly marks = new Ledger<Mark>();
  readonly plans = new Ledger<Plan>();
  readonly areas = new Ledger<Area>();
  /** The radio's range, once the run was steered to another; under the key `range`. */
  readonly range = new Ledger<{ metres: number | null }>();
  readonly traffic = new Traffic();
  #flashes: Flash[] = [];
  #read = 0;
  #generation = -1;

  /** Goes to the moment at which the first `position` records of the run have been made. */
  go(events: Events, position: number): void {
    if (events.generation !== this.#generation) this.#forget(events.generation);
    for (; this.#read < events.list.length; this.#read++) {
      const event = events.list[this.#read];
      if (event) this.#take(event);
    }
    for (const ledger of [this.marks, this.plans, this.areas, this.range]) ledger.go(position);
  }

  /** The events of the last `span` seconds before `now`, the newest first. */
  flashes(now: number, span: number, each: (flash: Flash) => void): void {
    for (let index = this.#flashes.length - 1; index >= 0; index--) {
      const flash = this.#flashes[index];
      if (!flash || flash.time < now - span) return;
      if (flash.time <= now) each(flash);
    }
  }

  #forget(generation: number): void {
    for (const ledger of [this.marks, this.plans, this.areas, this.range]) ledger.clear();
    this.traffic.clear();
    this.#flashes = [];
    this.#read = 0;
    this.#generation = generation;
  }

  #take({ topic, message, time, index }: Event): void {
    const robot = message.robot ?? -1;
    const [from, sequence] = [Number(message.from), Number(message.sequence)];
    switch (topic) {
      case "/starl/sent":
        this.traffic.sent(time, robot, sequence, (message.to as number | undefined) ?? null);
        break;
      case "/starl/delivered":
        this.traffic.arrived(from, sequence, { robot, time, reason: null });
        break;
      case "/starl/dropped": {
        const to = (message.to as number | undefined) ?? robot;
        this.traffic.arrived(from, sequence, { robot: to, time, reason: String(message.reason) });
        break;
      }
      case "/starl/mark":
        this.#mark(index, robot, message as unknown as DrawnMark);
        break;
      case "/starl/primitive":
        this.#primitive(index, robot, message as unknown as PrimitiveEvent);
        break;
      case "/starl/intervention":
        this.#steered(index, String(message.intervention));
        break;
    }
    const kind = FLASHES[topic];
    if (kind && robot >= 0) this.#flashes.push({ time, robot, kind });
  }

  #mark(index: number, robot: number, { label, shape, points = [], radius = 0 }: DrawnMark): void {
    const mark = shape === "nothing" ? null : { robot, label, shape, points, radius };
    this.marks.record(index, `${robot} ${label}`, mark);
  }

  #primitive(index: number, robot: number, event: PrimitiveEvent): void {
    const key = `${robot} ${event.port}`;
    const path = event.fields.find((field) => field.path)?.path;
    if (path) this.plans.record(index, key, { robot, path });
    else if (event.primitive === "reach_avoid" && event.name !== "replan")
      this.plans.record(index, key, null);
    const area = event.fields.find((field) => field.area)?.area;
    if (area) this.areas.record(index, key, area);
    else if (event.name === "unregister") this.areas.record(index, key, null);
  }

  #steered(index: number, text: string): void {
    try {
      const { network } = JSON.parse(text) as { network?: { range?: number | null }[] };
      const knob = network?.find((knob) => "range" in knob);
      if (knob) this.range.record(index, "range", { metres: knob.range ?? null });
    } catch {
      // It says nothing of the range.
    }
  }
}
