// The results of a sweep: counts by profile, the distribution of a number, and a table of all runs.

import { quoted } from "../plots/chart.ts";
import type { Tried } from "./protocol.ts";

export const OUTCOMES = ["reached", "timed_out", "violated", "failed"] as const;
export type Outcome = (typeof OUTCOMES)[number];

export interface Counts {
  runs: number;
  /** Runs in which something went wrong. */
  wrong: number;
  by: Record<Outcome, number>;
}

const noCounts = (): Counts => ({
  runs: 0,
  wrong: 0,
  by: { reached: 0, timed_out: 0, violated: 0, failed: 0 },
});

/** The runs of a sweep in the order in which they ended, and those that went wrong in the order of the sweep. */
export class Results {
  readonly runs: Tried[] = [];
  readonly wrong: Tried[] = [];
  readonly counts: Map<string, Counts>;
  readonly #places: Map<string, number>;

  constructor(readonly profiles: string[]) {
    this.counts = new Map(profiles.map((name) => [name, noCounts()]));
    this.#places = new Map(profiles.map((name, place) => [name, place]));
  }

  add(run: Tried): void {
    this.runs.push(run);
    const counts = this.counts.get(run.profile);
    if (counts) {
      counts.runs++;
      counts.by[run.outcome]++;
      if (run.wrong !== null) counts.wrong++;
    }
    if (run.wrong === null) return;
    const before = this.wrong.findLastIndex((other) => this.#compare(other, run) < 0);
    this.wrong.splice(before + 1, 0, run);
  }

  #compare(one: Tried, other: Tried): number {
    const place = ({ profile }: Tried) => this.#places.get(profile) ?? 0;
    return place(one) - place(other) || Number(one.seed) - Number(other.seed);
  }
}

export type Quantity = "end" | "messages";

const numberOf = (run: Tried, quantity: Quantity): number =>
  quantity === "end" ? run.now : run.messages.sent;

export interface Bin {
  low: number;
  high: number;
  right: number;
  wrong: number;
}

/** How a number is distributed over runs. All bins are equally wide; each but the last one excludes its end. */
export function histogram(runs: Tried[], quantity: Quantity, most: number): Bin[] {
  let [low, high] = [Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY];
  for (const run of runs) {
    const value = numberOf(run, quantity);
    [low, high] = [Math.min(low, value), Math.max(high, value)];
  }
  if (low > high) return [];
  const whole = quantity === "messages";
  const count = low === high ? 1 : whole ? Math.min(most, high - low + 1) : most;
  const spread = whole ? high - low + 1 : high - low;
  const width = whole ? Math.ceil(spread / count) : spread / count || 1;
  const bins = Array.from({ length: whole ? Math.ceil(spread / width) : count }, (_, index) => ({
    low: low + index * width,
    high: low + (index + 1) * width,
    right: 0,
    wrong: 0,
  }));
  for (const run of runs) {
    const index = Math.floor((numberOf(run, quantity) - low) / width);
    const bin = bins[Math.min(index, bins.length - 1)];
    if (!bin) continue;
    if (run.wrong === null) bin.right++;
    else bin.wrong++;
  }
  return bins;
}

const COLUMNS: [string, (run: Tried) => string | number][] = [
  ["profile", (run) => run.profile],
  ["seed", (run) => run.seed],
  ["outcome", (run) => run.outcome],
  ["wrong", (run) => run.wrong ?? ""],
  ["text", (run) => run.text],
  ["end, s", (run) => run.now],
  ["messages sent", (run) => run.messages.sent],
  ["delivered", (run) => run.messages.delivered],
  ["lost", (run) => run.messages.lost],
  ["dropped", (run) => run.messages.dropped],
  ["retransmitted", (run) => run.messages.retransmitted],
  ["collisions", (run) => run.collisions],
  ["robots", (run) => run.progress.robots],
  ["robots up", (run) => run.progress.up],
  ["robots finished", (run) => run.progress.finished],
  ["robots failed", (run) => run.progress.failed],
  ["digest", (run) => run.digest],
];

/** All runs as a table, as RFC 4180 has it. */
export function csvOf(runs: Tried[]): string {
  const rows = runs.map((run) => COLUMNS.map(([, cell]) => quoted(String(cell(run)))).join(","));
  return [COLUMNS.map(([name]) => quoted(name)).join(","), ...rows, ""].join("\r\n");
}
