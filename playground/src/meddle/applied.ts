// The interventions in the run up to the moment shown, from its records.

import { run } from "../app/context.ts";
import { Filtered } from "../inspect/filtered.ts";
import type { Event } from "../run/events.ts";

const records = new Filtered(run.events, ({ topic }) => topic === "/starl/intervention");

/** All records of interventions that are known. */
export function interventions(): Event[] {
  void run.grown.value;
  records.scan();
  return records.list;
}
