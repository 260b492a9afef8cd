// Opens a run of a sweep in the viewer, as it is or shrunk, and goes to what went wrong.

import { signal } from "@preact/signals";
import { run } from "../app/context.ts";
import { part, sideTab } from "../app/shown.ts";
import { EngineError } from "../engine/client.ts";
import { simulator } from "../engine/simulator.ts";
import { showViolation } from "../inspect/violations.ts";
import type { Shrunk, Target, Trial, Tried } from "./protocol.ts";
import { problem } from "./sweep.ts";
import { Ended, TrialWorker } from "./trial-worker.ts";

/** Smaller scenarios that are tried at most, as by `starl test`. */
const MOST = 1000;
/** A call for smaller scenarios should take about so long, ms. */
const SLICE = 300;

/** How far shrinking is. */
export interface Shrinking {
  run: Tried;
  /** The smallest so far. */
  smallest: Shrunk | null;
}

export const shrinking = signal<Shrinking | null>(null);

/** A scenario of a sweep that the viewer shows. */
export interface OpenedTrial {
  path: string;
  text: string;
  /** The result of shrinking; null for an unshrunk run. */
  shrunk: Shrunk | null;
}

export const openedTrial = signal<OpenedTrial | null>(null);

let worker: TrialWorker | null = null;

const trialOf = ({ profile, seed }: Tried): Trial => ({ profile, seed: Number(seed) });

export async function openAsItIs(target: Target, tried: Tried): Promise<void> {
  await withWorker(target, async (worker) => {
    const text = await worker.ask<string>({ scenario: trialOf(tried) });
    await open(target, { path: pathFor(target, tried, ""), text, shrunk: null }, tried);
  });
}

export async function shrinkAndOpen(target: Target, tried: Tried): Promise<void> {
  shrinking.value = { run: tried, smallest: null };
  try {
    await withWorker(target, async (worker) => {
      const shrunk = await shrink(worker, tried);
      shrinking.value = null;
      if (!shrunk) return;
      const path = pathFor(target, tried, "-small");
      await open(target, { path, text: shrunk.scenario, shrunk }, shrunk.tried);
    });
  } finally {
    shrinking.value = null;
  }
}

/** Ends shrinking: the smallest scenario so far is opened. */
export const stopShrinking = (): void => worker?.end();

async function withWorker(target: Target, work: (worker: TrialWorker) => Promise<void>): Promise<void> {
  problem.value = null;
  try {
    const module = await simulator();
    worker?.end();
    const own = new TrialWorker(target, module);
    worker = own;
    await work(own).finally(() => own.end());
  } catch (error) {
    if (!(error instanceof Ended))
      problem.value = error instanceof EngineError ? error : new EngineError(String(error));
  }
}

/** The smallest scenario that is found until nothing can be left out, or someone stops it. */
async function shrink(worker: TrialWorker, tried: Tried): Promise<Shrunk | null> {
  let smallest: Shrunk | null = null;
  let step = 10;
  try {
    for (let most = 1; ; most = Math.min(MOST, most + step)) {
      const begun = performance.now();
      smallest = await worker.ask<Shrunk>({ shrink: trialOf(tried), most });
      shrinking.value = { run: tried, smallest };
      if (smallest.minimal || most === MOST) break;
      const took = performance.now() - begun;
      step = Math.min(200, Math.max(1, Math.round(step * Math.min(2, SLICE / Math.max(took, 1)))));
    }
  } catch (error) {
    if (!(error instanceof Ended)) throw error;
  }
  return smallest;
}

async function open(
  target: Target,
  opened: OpenedTrial,
  { violations, failures, now }: Tried,
): Promise<void> {
  const files = { ...target.files, [opened.path]: opened.text };
  if (!(await run.open({ kind: "files", files, options: { scenario: opened.path } }))) return;
  openedTrial.value = opened;
  part.value = "world";
  const [violation, failure] = [violations[0], failures[0]];
  sideTab.value = "properties";
  if (violation) await showViolation(violation);
  else if (failure) {
    await run.show({ time: failure.at });
    run.select([failure.robot]);
  } else await run.seek(now);
}

/** A path for a scenario beside the one that was tried, which no file has. */
export function pathFor({ files, options }: Target, { profile, seed }: Tried, ending: string): string {
  const folder = options.scenario?.replace(/[^/]*$/, "") ?? "";
  const name = `${folder}${profile}-${seed}${ending}`;
  let path = `${name}.toml`;
  for (let number = 2; files[path] !== undefined; number++) path = `${name}-${number}.toml`;
  return path;
}
