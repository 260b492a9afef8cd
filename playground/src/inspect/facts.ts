// All there is to see of a robot at one moment, as rows of a table. Robots are compared row by row.

import type { Point, Robot } from "../engine/types.ts";
import { fieldsOf } from "./debug.ts";

export interface Fact {
  name: string;
  value: string;
  hint?: string;
  mark?: "on" | "bad";
  /** It changes all the time, so that to mark changes of it would say nothing. */
  restless?: boolean;
}

export interface Section {
  title: string;
  facts: Fact[];
}

const SECTIONS = [
  "Program",
  "Variables",
  "Actions",
  "Primitives",
  "Timers",
  "Mailbox",
  "Body",
  "Clock",
  "Parameters",
];

type Name = (robot: number) => string;

export function sectionsOf(robot: Robot, nameOf: Name): Section[] {
  const facts: Record<string, Fact[]> = {
    Program: program(robot),
    Variables: variables(robot, false),
    Actions: robot.actions.map(({ name, enabled, error }) => ({
      name,
      value: error ?? (enabled ? "enabled" : "not enabled"),
      mark: error ? "bad" : enabled ? "on" : undefined,
    })),
    Primitives: robot.primitives.flatMap((primitive) => primitiveFacts(primitive, nameOf)),
    Timers: timers(robot),
    Mailbox: robot.mailbox.map(({ from, sequence, to, port, at, bytes }) => ({
      name: `${nameOf(from)} #${sequence}`,
      value: `for ${to ?? (port === 0 ? "the program" : `port ${port}`)}, ${bytes} bytes, arrives at ${at.toFixed(3)} s`,
    })),
    Body: body(robot),
    Clock: clock(robot),
    Parameters: variables(robot, true),
  };
  return SECTIONS.map((title) => ({ title, facts: facts[title] ?? [] }));
}

function program(robot: Robot): Fact[] {
  const facts: Fact[] = [{ name: "condition", value: robot.condition }];
  if (!robot.started && robot.condition === "running")
    facts.push({ name: "software", value: "not started yet" });
  if (robot.failure) facts.push({ name: "failure", value: robot.failure, mark: "bad" });
  if (robot.state) facts.push({ name: "state", value: robot.state });
  return facts;
}

const variables = (robot: Robot, parameter: boolean): Fact[] =>
  robot.variables
    .filter((variable) => variable.parameter === parameter)
    .map(({ name, type, value }) => ({ name, value, hint: type }));

/** Its kind, and the fields of its state. */
function primitiveFacts({ name, kind, port, state }: Robot["primitives"][number], nameOf: Name): Fact[] {
  const hint = port === null ? kind : `${kind}, port ${port}`;
  const fields = state === null ? [] : fieldsOf(state, nameOf);
  const [only] = fields;
  if (only?.name === "") return [{ name, value: only.value, hint }];
  return [
    { name, value: kind, hint },
    ...fields.map((field) => ({ name: `${name}.${field.name}`, value: field.value, hint })),
  ];
}

/** Timers that one primitive armed in the same way are distinguished by their order. */
function timers(robot: Robot): Fact[] {
  const seen = new Map<string, number>();
  return robot.timers.map(({ owner, port, kind, due, due_simulated }) => {
    const armed = `${owner ?? `port ${port}`}, timer ${kind}`;
    const count = (seen.get(armed) ?? 0) + 1;
    seen.set(armed, count);
    return {
      name: count > 1 ? `${armed} (${count})` : armed,
      value: `due at ${due_simulated.toFixed(3)} s`,
      hint: `${due.toFixed(3)} s by its own clock`,
    };
  });
}

function body(robot: Robot): Fact[] {
  const { pose, twist, estimate } = robot;
  const far = distance(pose.position, estimate.pose.position);
  const facts: Fact[] = [
    { name: "position", value: point(pose.position), restless: true },
    { name: "heading", value: degrees(pose.yaw), restless: true },
    {
      name: "speed",
      value: `${distance(twist.linear, { x: 0, y: 0, z: 0 }).toFixed(3)} m/s`,
      restless: true,
    },
    {
      name: "estimated position",
      value: point(estimate.pose.position),
      hint: `${(far * 100).toFixed(1)} cm from where it is`,
      restless: true,
    },
    { name: "command", value: command(robot.command), restless: typeof robot.command !== "string" },
    { name: "distance covered", value: `${robot.distance.toFixed(2)} m`, restless: true },
    { name: "holds", value: robot.holding ?? "nothing" },
    { name: "waypoints reached", value: String(robot.way_points_reached) },
  ];
  if (robot.motors_stuck) facts.push({ name: "motors", value: "stuck", mark: "bad" });
  facts.push(...senses(robot));
  if (robot.sensors_frozen) facts.push({ name: "sensors", value: "frozen", mark: "bad" });
  return facts;
}

/** The readings of those sensors that the robot carries. */
function senses({ sensors }: Robot): Fact[] {
  const facts: Fact[] = [];
  if (sensors.bumper !== null) facts.push({ name: "bumper", value: `touched at ${degrees(sensors.bumper)}` });
  if (sensors.proximity_range !== null) {
    const [nearest] = [...sensors.proximity].sort((a, b) => a.distance - b.distance);
    const met = nearest && nearest.distance < sensors.proximity_range;
    const value = met ? `${nearest.distance.toFixed(3)} m at ${degrees(nearest.bearing)}` : "nothing";
    facts.push({ name: "nearest by proximity", value, restless: true });
  }
  if (sensors.detector_range !== null) {
    const value = sensors.detections.map(({ name }) => name).join(", ") || "nothing";
    facts.push({ name: "detects", value });
  }
  return facts;
}

function clock({ clock, next_activation }: Robot): Fact[] {
  return [
    { name: "shows", value: `${clock.now.toFixed(3)} s`, restless: true },
    { name: "ahead at the start", value: `${clock.offset.toFixed(3)} s` },
    { name: "rate", value: `${clock.rate} s a second` },
    {
      name: "runs next at",
      value: next_activation === null ? "does not run" : `${next_activation.toFixed(3)} s`,
      restless: true,
    },
  ];
}

const distance = (a: Point, b: Point) => Math.hypot(a.x - b.x, a.y - b.y, a.z - b.z);
const point = ({ x, y, z }: Point) => `(${x.toFixed(3)}, ${y.toFixed(3)}, ${z.toFixed(3)}) m`;
const degrees = (radians: number) => `${((radians * 180) / Math.PI).toFixed(1)}°`;

/** `{"Straight": {"speed": 0.25}}` as `Straight: speed 0.25`. */
function command(value: unknown): string {
  if (typeof value === "string") return value;
  if (!value || typeof value !== "object") return String(value);
  return Object.entries(value)
    .map(([name, fields]) => `${name}: ${numbers(fields)}`)
    .join(", ");
}

function numbers(value: unknown): string {
  if (typeof value === "number") return String(Number(value.toFixed(3)));
  if (!value || typeof value !== "object") return String(value);
  return Object.entries(value)
    .map(([name, field]) => `${name} ${numbers(field)}`)
    .join(", ");
}
