// An intervention in words.

import type { Fault, Intervention, NetworkKnob, Point } from "../engine/types.ts";

type Name = (robot: number) => string;

export function wordsOf(intervention: Intervention, name: Name): string {
  const names = (robots: number[]) => robots.map(name).join(", ");
  if ("fault" in intervention) return fault(intervention.fault, names);
  if ("push" in intervention) {
    const { robot, by } = intervention.push;
    return `push ${name(robot)} by ${point(by)} m`;
  }
  if ("network" in intervention) return `network: ${intervention.network.map(knob).join(", ")}`;
  if ("add_obstacle" in intervention) return "add an obstacle";
  if ("move_obstacle" in intervention) return `move obstacle ${intervention.move_obstacle.index}`;
  if ("remove_obstacle" in intervention) return `remove obstacle ${intervention.remove_obstacle.index}`;
  if ("set_way_point" in intervention) {
    const { name, position } = intervention.set_way_point;
    return `set waypoint ${name} at ${point(position)}`;
  }
  if ("remove_way_point" in intervention) return `remove waypoint ${intervention.remove_way_point.name}`;
  if ("set_thing" in intervention) {
    const { name, position } = intervention.set_thing;
    return `put ${name} at ${point(position)}`;
  }
  if ("remove_thing" in intervention) return `remove ${intervention.remove_thing.name}`;
  if ("tell" in intervention) {
    const { robots, order } = intervention.tell;
    return `tell ${robots.length > 0 ? names(robots) : "all robots"}: ${order.name}`;
  }
  if ("join" in intervention) return `${intervention.join.name} joins, like ${name(intervention.join.like)}`;
  return `${names(intervention.leave)} leave`;
}

const point = (at: Point): string =>
  `(${[at.x, at.y, at.z].map((value) => Number(value.toFixed(3))).join(", ")})`;

function fault(fault: Fault, names: (robots: number[]) => string): string {
  if (fault === "heal") return "heal the network";
  if ("crash" in fault) return `crash ${names(fault.crash)}`;
  if ("restart" in fault) return `restart ${names(fault.restart)}`;
  if ("partition" in fault) return `cut the network: ${fault.partition.map(names).join(" | ")} | the others`;
  if ("one_way" in fault) return `let ${fault.one_way.map(names).join(" | ")} not be heard by those before`;
  if ("stuck_motor" in fault) return `stick the motors of ${names(fault.stuck_motor)}`;
  if ("frozen_sensor" in fault) return `freeze the sensors of ${names(fault.frozen_sensor)}`;
  if ("repair" in fault) return `repair ${names(fault.repair)}`;
  return `corrupt the state of ${names(fault.corrupt_state)}`;
}

function knob(knob: NetworkKnob): string {
  const [name, value] = Object.entries(knob)[0] as [string, unknown];
  const words = name.replaceAll("_", " ");
  if (value === null) return `${words} unlimited`;
  if (name === "delay" || name === "jitter" || name === "reordering_delay")
    return `${words} ${Number(value) / 1e6} ms`;
  if (name === "loss" || name === "duplication" || name === "reordering")
    return `${words} ${Number((Number(value) * 100).toFixed(3))} %`;
  return `${words} ${value}${name === "range" ? " m" : ""}`;
}

/** The intervention that a record of `/starl/intervention` describes; null if it cannot be read. */
export function recorded(text: unknown): Intervention | null {
  try {
    const value = JSON.parse(String(text));
    return value && typeof value === "object" ? value : null;
  } catch {
    return null;
  }
}
