// Runs the project: checks it, opens it in the simulator and plays. A project with errors leaves the run that is
// shown as it is.

import { effect, signal } from "@preact/signals";
import { run } from "../app/context.ts";
import { part } from "../app/shown.ts";
import { EngineError } from "../engine/client.ts";
import { check, diagnostics } from "./checking.ts";
import { errorsOf, optionsOf } from "./model.ts";
import { project } from "./project.ts";

/** The seed of the next run; empty for the scenario's. */
export const seed = signal("");
export const starting = signal(false);

const LARGEST_SEED = 2n ** 63n - 1n;

export const seedProblem = (text: string): string | null =>
  text === "" || (/^\d{1,19}$/.test(text) && BigInt(text) <= LARGEST_SEED)
    ? null
    : "A seed is a whole number from 0.";

/** Draws another seed, at random. */
export function drawSeed(): void {
  seed.value = String(1 + Math.floor(Math.random() * 999_999));
}

let before: Promise<unknown> = Promise.resolve();
let latest = 0;

/** Opens the project's run, and plays it unless told otherwise. While a run starts, the last request waits. */
export function runProject({ play = true } = {}): Promise<boolean> {
  const request = ++latest;
  starting.value = true;
  const opened = before.then(() => request === latest && start(play));
  before = opened;
  return opened;
}

async function start(play: boolean): Promise<boolean> {
  starting.value = true;
  try {
    const shown = project.value;
    const wrong = seedProblem(seed.value);
    if (wrong) throw new EngineError(wrong);
    if (Object.keys(shown.files).length === 0)
      throw new EngineError("There is no program yet. Add a file first.");
    const errors = errorsOf(shown, await check(shown.files));
    if (errors.length > 0) {
      // All of them stand below the editor.
      refusal = new EngineError(
        `Not run: ${count(errors.length, "error")} to correct first.`,
        errors.slice(0, 1),
      );
      throw refusal;
    }
    const opened = await run.open({
      kind: "files",
      files: shown.files,
      options: optionsOf(shown, seed.value),
    });
    if (!opened) return false;
    part.value = "world";
    if (play) run.play();
    return true;
  } catch (error) {
    run.problem.value = error instanceof EngineError ? error : new EngineError(String(error));
    return false;
  } finally {
    starting.value = false;
  }
}

/** Why the project as it was has not been run. */
let refusal: EngineError | null = null;

effect(() => {
  const isFaulty = errorsOf(project.value, diagnostics.value).length > 0;
  if (refusal === null || isFaulty) return;
  if (run.problem.peek() === refusal) run.problem.value = null;
  refusal = null;
});

const count = (number: number, what: string) => `${number} ${what}${number === 1 ? "" : "s"}`;
