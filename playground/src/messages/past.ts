// The causal past of a moment: the events that could have influenced it. An event happened before another if it came
// earlier at the same robot, or if it came before the sending of a message that was delivered there (Lamport, "Time,
// Clocks, and the Ordering of Events in a Distributed System", 1978). Influence through what robots sense of each
// other is left out.
//
// Invariant: what a causal past contains of a robot's events is a beginning of them, so one number a robot says it all.

import type { Event } from "../run/events.ts";
import { countBefore, type Traffic } from "./traffic.ts";

export interface Past {
  /** By robot: events with a lower index than this are in the past. */
  until: Map<number, number>;
  /** How many events it has. */
  count: number;
  /** The last ones, the latest first. */
  last: Event[];
  /** Delivered messages through which other robots came to be in it. */
  messages: number;
}

const LAST = 100;

/** The events before the record with index `until` at the robots, and all that could have influenced them. */
export function causalPast(traffic: Traffic, robots: number[], until: number): Past {
  /** How many events of each robot are in the past. */
  const included = new Map<number, number>();
  const work = robots.map((robot) => ({ robot, count: countBefore(traffic.robots[robot] ?? [], until) }));
  let messages = 0;
  for (let next = work.pop(); next; next = work.pop()) {
    const { robot, count } = next;
    const list = traffic.robots[robot] ?? [];
    const from = included.get(robot) ?? 0;
    if (count <= from && included.has(robot)) continue;
    included.set(robot, count);
    for (let at = from; at < count; at++) {
      const event = list[at];
      if (event?.topic !== "/starl/delivered") continue;
      const sent = traffic.of(event)?.sent;
      if (!sent) continue;
      messages++;
      const sender = Number(sent.message.robot);
      const before = countBefore(traffic.robots[sender] ?? [], sent.index + 1);
      if (before > (included.get(sender) ?? 0)) work.push({ robot: sender, count: before });
    }
  }
  const past: Past = { until: new Map(), count: 0, last: [], messages };
  for (const [robot, count] of included) {
    const list = traffic.robots[robot] ?? [];
    past.until.set(robot, (list[count - 1]?.index ?? -1) + 1);
    past.count += count;
    past.last.push(...list.slice(Math.max(0, count - LAST), count));
  }
  past.last.sort((a, b) => b.index - a.index).splice(LAST);
  return past;
}

export const isPast = (past: Past, event: Event): boolean =>
  event.message.robot !== undefined && event.index < (past.until.get(event.message.robot) ?? 0);
