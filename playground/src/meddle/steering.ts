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
export async function steer(intervention: Intervention): Promise<boolean> {
  const what = wordsOf(intervention, nameOf);
  try {
    await run.apply(intervention);
    said.value = {
      good: true,
      text: `At ${seconds(run.now.value)}: ${what}. It takes effect in the next step.`,
    };
    return true;
  } catch (error) {
    const reason = error instanceof Error ? error.message : String(error);
    said.value = { good: false, text: `Refused (${what}): ${reason}` };
    return false;
  }
}
