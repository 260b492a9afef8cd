// A sweep: many runs of the project that is open, with many seeds and profiles of faults, in workers of their own.

import { computed, signal } from "@preact/signals";
import { run } from "../app/context.ts";
import { EngineError } from "../engine/client.ts";
import { simulator } from "../engine/simulator.ts";
import { check } from "../project/checking.ts";
import { errorsOf, optionsOf } from "../project/model.ts";
import { project } from "../project/project.ts";
import type { Profile, Target, Trial, Tried } from "./protocol.ts";
import { Results } from "./results.ts";
import { Ended, TrialWorker } from "./trial-worker.ts";

export const MOST_SEEDS = 10_000;
const MOST_WORKERS = 4;
/** The page shows what came of runs so often, ms. */
const SHOW_EVERY = 200;

export const profiles = signal<Profile[]>([]);
/** The names of those to try. */
export const chosen = signal<string[]>([]);
export const seeds = signal("20");
export const firstSeed = signal("1");

/** A sweep that runs or has run. */
export interface Sweep {
  target: Target;
  results: Results;
  total: number;
}

export const sweep = signal<Sweep | null>(null);
/** Changes when the results do. */
export const shown = signal(0);
export const running = signal(false);
/** Of the time that a sweep takes: what has passed and about what is left, s. */
export const passed = signal(0);
export const left = signal<number | null>(null);
export const problem = signal<EngineError | null>(null);

const MOST_FIRST_SEED = 2 ** 32 - 1;

export const wholeProblem = (text: string, least: number, most: number): string | null =>
  /^\d{1,10}$/.test(text) && Number(text) >= least && Number(text) <= most
    ? null
    : `Use a whole number from ${least} to ${most}.`;

export const seedsProblem = computed(() => wholeProblem(seeds.value, 1, MOST_SEEDS));
export const firstSeedProblem = computed(() => wholeProblem(firstSeed.value, 0, MOST_FIRST_SEED));

/** Whether the project is another one than that of the sweep, or was changed since. */
export const outdated = computed(
  () => sweep.value !== null && sweep.value.target.files !== project.value.files,
);

export async function loadProfiles(): Promise<void> {
  if (profiles.value.length > 0) return;
  const all = await run.client.ask<Profile[]>({ raw: { profiles: {} } });
  profiles.value = all;
  chosen.value = all.filter(({ usual }) => usual).map(({ name }) => name);
}

let workers: TrialWorker[] = [];

export const workerCount = (cores: number): number => Math.max(1, Math.min(MOST_WORKERS, cores - 1));

/** Runs all seeds under all chosen profiles. */
export async function start(): Promise<void> {
  if (running.value) return;
  problem.value = null;
  running.value = true;
  try {
    const shownProject = project.value;
    const errors = errorsOf(shownProject, await check(shownProject.files));
    if (errors.length > 0) throw new EngineError("Correct the errors of the project first.", errors);
    const target = { files: shownProject.files, options: optionsOf(shownProject, "") };
    const names = profiles.value.map(({ name }) => name).filter((name) => chosen.value.includes(name));
    const trials = Number(seeds.value) * names.length;
    await simulate(target, names, trials);
  } catch (error) {
    if (!(error instanceof Ended))
      problem.value = error instanceof EngineError ? error : new EngineError(String(error));
  } finally {
    endWorkers();
    running.value = false;
    shown.value++;
  }
}

async function simulate(target: Target, names: string[], total: number): Promise<void> {
  const module = await simulator();
  const results = new Results(names);
  sweep.value = { target, results, total };
  const first = Number(firstSeed.value);
  let next = 0;
  // All profiles of a seed before the next seed: a sweep that is stopped has tried each profile as often.
  const take = (): Trial | null => {
    const place = next++;
    const profile = names[place % names.length];
    if (place >= total || profile === undefined) return null;
    return { profile, seed: first + Math.floor(place / names.length) };
  };
  const begun = performance.now();
  [passed.value, left.value] = [0, null];
  const show = setInterval(() => {
    passed.value = (performance.now() - begun) / 1000;
    const done = results.runs.length;
    left.value = done > 0 ? (passed.value / done) * (total - done) : null;
    shown.value++;
  }, SHOW_EVERY);
  const count = Math.min(workerCount(navigator.hardwareConcurrency), total);
  workers = Array.from({ length: count }, () => new TrialWorker(target, module));
  try {
    await Promise.all(
      workers.map(async (worker) => {
        for (let trial = take(); trial; trial = take()) results.add(await worker.ask<Tried>({ try: trial }));
      }),
    );
  } finally {
    clearInterval(show);
    passed.value = (performance.now() - begun) / 1000;
  }
}

function endWorkers(): void {
  for (const worker of workers) worker.end();
  workers = [];
}

/** Ends a sweep; what it found stays. */
export const stop = endWorkers;
