// Two runs to compare: one that was kept, and another one: the run that is shown, or one that runs in a worker of its
// own.

import { computed, signal } from "@preact/signals";
import { run } from "../app/context.ts";
import type { Member, Source } from "../engine/types.ts";
import { nameOf } from "../inspect/names.ts";
import type { Event } from "../run/events.ts";
import type { Frame } from "../run/history.ts";
import { Run } from "../run/run.ts";
import { type Difference, firstDifference } from "./difference.ts";

export interface Recording {
  name: string;
  source: Source;
  list: Event[];
  frames: Frame[];
  fleet: Member[];
  /** s */
  until: number;
}

export const kept = signal<Recording | null>(null);
export const other = signal<Recording | null>(null);
/** How far the other run is, s; null if none is under way. */
export const underWay = signal<number | null>(null);
export const problem = signal("");

/** The other run's moment is looked at so often, ms. */
const LOOK_EVERY = 100;

export const difference = computed((): Difference | null =>
  kept.value && other.value ? firstDifference(kept.value, other.value) : null,
);

/** The names of robots in a recording. */
export const nameIn = (recording: Recording) => (robot: number) =>
  recording.fleet[robot]?.name ?? nameOf(robot);

function record(of: Run, name: string): Recording | null {
  const source = of.source.peek();
  if (!source) return null;
  return {
    name,
    source,
    list: [...of.events.list],
    frames: [...of.history.frames],
    fleet: of.fleet.peek(),
    until: of.known.peek(),
  };
}

const titleOf = (of: Run): string => {
  const opened = of.opened.peek();
  return `${opened?.title ?? "run"}, seed ${opened?.seed ?? ""}`;
};

/** Keeps the run that is shown, as it is known now. */
export function keep(): void {
  kept.value = record(run, titleOf(run));
  other.value = null;
}

/** Compares the run that is kept with the one that is shown. */
export function compareShown(): void {
  other.value = record(run, `${titleOf(run)} (shown)`);
}

let second: Run | null = null;

/** Runs what is shown with another seed, as far as the kept run is known, and compares. */
export async function compareSeed(seed: string): Promise<void> {
  if (!kept.value) keep();
  const first = kept.value;
  if (first?.source.kind !== "files") return;
  problem.value = "";
  stop();
  const running = new Run();
  second = running;
  underWay.value = 0;
  try {
    const { files, options } = first.source;
    const opened = await running.open({ kind: "files", files, options: { ...options, seed } });
    if (!opened) throw running.problem.value ?? new Error("the run cannot be opened");
    running.play(Number.POSITIVE_INFINITY);
    while (second === running && running.known.value < first.until && !running.over.value) {
      if (running.problem.value) throw running.problem.value;
      underWay.value = running.known.value;
      await new Promise((resolve) => setTimeout(resolve, LOOK_EVERY));
    }
    if (second !== running) return;
    other.value = record(running, titleOf(running));
  } catch (error) {
    problem.value = error instanceof Error ? error.message : String(error);
  } finally {
    if (second === running) stop();
  }
}

/** Ends the run in the worker. */
export function stop(): void {
  second?.client.end();
  second = null;
  underWay.value = null;
}

/** Shows the other run on the page, at a moment. */
export async function openAt({ source }: Recording, time: number): Promise<void> {
  if (run.source.value !== source && !(await run.open(source))) return;
  await run.show({ time });
}
