// The violations that are known, those after the moment shown included: a report has only those before.

import { effect, signal } from "@preact/signals";
import { run } from "../app/context.ts";
import type { Opened, Report } from "../engine/types.ts";
import { knownTraffic, marked } from "../messages/known.ts";
import { causalPast } from "../messages/past.ts";
import { nameOf } from "./names.ts";

export type Violation = Report["violations"][number];

export const violations = signal<Violation[]>([]);

let opened: Opened | null = null;

effect(() => {
  const report = run.report.value?.violations ?? [];
  const known = run.known.value;
  const before = opened === run.opened.value ? violations.peek() : [];
  opened = run.opened.value;
  // Violations are reported in the order of their times, so the longer list contains the other one.
  const kept = before.at(-1)?.at ?? 0;
  const still = kept > known ? before.filter(({ at }) => at <= known) : before;
  const next = report.length >= still.length ? report : still;
  if (next !== violations.peek() && next.length + violations.peek().length > 0) violations.value = next;
});

/** The one that a person has chosen. */
export const chosenViolation = signal<Violation | null>(null);

/** Shows the moment of a violation, and marks what could have led to it. */
export async function showViolation(violation: Violation): Promise<void> {
  const { property, at, robots, text } = violation;
  chosenViolation.value = violation;
  await run.show({ time: at });
  const { list } = run.events;
  let until = 0;
  let concerned = robots;
  for (let index = run.events.from(at - 1e-9); index < list.length; index++) {
    const event = list[index];
    if (!event || event.time > at + 1e-9) break;
    until = event.index + 1;
    if (event.topic !== "/starl/violation" || event.message.property !== property) continue;
    if (event.message.text !== text) continue;
    if (robots.length === 0 && event.message.robot !== undefined) concerned = [event.message.robot];
    break;
  }
  if (until === 0) until = list[run.events.from(at)]?.index ?? run.events.count;
  // A property of the fleet as a whole concerns every robot.
  if (concerned.length === 0) concerned = run.fleet.value.map(({ id }) => id);
  marked.value = {
    past: causalPast(knownTraffic(), concerned, until),
    text: `${property}${robots.length > 0 ? ` at ${robots.map(nameOf).join(", ")}` : ""}`,
    generation: run.events.generation,
  };
  if (robots.length > 0) run.select(robots.slice(0, 8));
}
