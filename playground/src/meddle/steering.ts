// Steers the run, and says what came of it.

import { signal } from "@preact/signals";
import { run } from "../app/context.ts";
import { seconds } from "../app/format.ts";
import type { Intervention } from "../engine/types.ts";

/** What became of the last act. */
export const said = signal<{ good: boolean; text: string } | null>(null);

/** Applies an intervention at the moment shown; `what` says it in words. Returns whether it was accepted. */
export async function steer(intervention: Intervention, what: string): Promise<boolean> {
  try {
    await run.apply(intervention);
    said.value = { good: true, text: `${seconds(run.now.value)}: ${what}.` };
    return true;
  } catch (error) {
    const reason = error instanceof Error ? error.message : String(error);
    said.value = { good: false, text: `Not done (${what}): ${reason}` };
    return false;
  }
}
