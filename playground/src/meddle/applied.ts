// The interventions in the run up to the moment shown, from its records.

import { run } from "../app/context.ts";
import type { Intervention, NetworkKnob } from "../engine/types.ts";
import { Filtered } from "../inspect/filtered.ts";
import type { Event } from "../run/events.ts";
import { recorded } from "./words.ts";

const records = new Filtered(run.events, ({ topic }) => topic === "/starl/intervention");

/** All records of interventions that are known. */
export function interventions(): Event[] {
  void run.grown.value;
  records.scan();
  return records.list;
}

/** The knobs of the network that were turned up to the moment shown, with their last values. */
export function knobs(): Map<string, unknown> {
  const turned = new Map<string, unknown>();
  const list = interventions();
  for (const event of list.slice(0, records.before(run.position.value))) {
    const intervention: Intervention | null = recorded(event.message.intervention);
    if (!intervention || !("network" in intervention)) continue;
    for (const knob of intervention.network as NetworkKnob[]) {
      for (const [name, value] of Object.entries(knob)) turned.set(name, value);
    }
  }
  return turned;
}
