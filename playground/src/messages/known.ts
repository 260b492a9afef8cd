// The messages of the run that is shown, and the causal past of the chosen event.

import { signal } from "@preact/signals";
import { run } from "../app/context.ts";
import type { Past } from "./past.ts";
import { Traffic } from "./traffic.ts";

const traffic = new Traffic();

/** The messages up to the furthest known moment. */
export const knownTraffic = (): Traffic => traffic.update(run.events);

/** The causal past that is marked, and of what; null if none is. */
export const marked = signal<{ past: Past; text: string; generation: number } | null>(null);

/** The causal past that is marked, unless its events are no longer known. */
export function markedPast(): Past | null {
  void run.grown.value;
  return marked.value?.generation === run.events.generation ? marked.value.past : null;
}
