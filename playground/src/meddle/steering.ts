// Steers the run, and says what came of it.

import { signal } from "@preact/signals";
import { run } from "../app/context.ts";
import { seconds } from "../app/format.ts";
import type { Intervention } from "../engine/types.ts";
import { nameOf } from "../inspect/names.ts";
import { wordsOf } from "./words.ts";

/** The result of the last action. */
export const said = signal<{ good: boolean; text: string } | null>(null);

/** Applies an intervention at the moment shown. Returns whether it was accepted. */
export function steer(intervention: Intervention): Promise<boolean> {
  return applied(intervention, () => run.apply(intervention), "It takes effect in the next step.");
}

/** The same; a paused run continues by one step, so that the effect is seen. */
export function steerAndShow(intervention: Intervention): Promise<boolean> {
  return applied(intervention, () => run.applyAndShow(intervention), "");
}

async function applied(
  intervention: Intervention,
  apply: () => Promise<void>,
  when: string,
): Promise<boolean> {
  const what = wordsOf(intervention, nameOf);
  try {
    await apply();
    said.value = { good: true, text: `At ${seconds(run.now.value)}: ${what}. ${when}` };
    return true;
  } catch (error) {
    const reason = error instanceof Error ? error.message : String(error);
    said.value = { good: false, text: `Refused (${what}): ${reason}` };
    return false;
  }
}
