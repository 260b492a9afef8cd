// The results of many runs are counted, ordered, distributed over bins and written as a table.

import { expect, test } from "vitest";
import type { Tried } from "../../src/sweep/protocol.ts";
import { csvOf, histogram, Results } from "../../src/sweep/results.ts";

const run = (
  profile: string,
  seed: number,
  now: number,
  sent: number,
  wrong: string | null = null,
): Tried => ({
  profile,
  seed: String(seed),
  outcome: wrong === null ? "reached" : "violated",
  wrong,
  text: wrong === null ? "" : 'it said "no", twice',
  now,
  digest: "0123456789abcdef",
  progress: { robots: 2, up: 2, finished: 2, failed: 0 },
  messages: { sent, delivered: sent, lost: 0, dropped: 0, retransmitted: 0 },
  collisions: 0,
  violations: [],
  failures: [],
});

test("runs are counted by profile, and failures come in the order of profiles and seeds", () => {
  const results = new Results(["calm", "lossy"]);
  for (const one of [
    run("lossy", 10, 1, 0, "p"),
    run("calm", 2, 1, 0),
    run("lossy", 9, 1, 0, "p"),
    run("calm", 11, 1, 0, "p"),
  ])
    results.add(one);
  expect(results.counts.get("lossy")).toEqual({
    runs: 2,
    wrong: 2,
    by: { reached: 0, timed_out: 0, violated: 2, failed: 0 },
  });
  expect(results.counts.get("calm")?.by.reached).toBe(1);
  expect(results.wrong.map(({ profile, seed }) => `${profile} ${seed}`)).toEqual([
    "calm 11",
    "lossy 9",
    "lossy 10",
  ]);
});

test("every run is in one bin of a histogram, the longest in the last", () => {
  const runs = [0, 0.1, 0.49, 0.5, 1].map((end, seed) => run("calm", seed, end, 0, seed === 4 ? "p" : null));
  expect(histogram(runs, "end", 2)).toEqual([
    { low: 0, high: 0.5, right: 3, wrong: 0 },
    { low: 0.5, high: 1, right: 1, wrong: 1 },
  ]);
  expect(histogram(runs.slice(0, 1), "end", 2)).toEqual([{ low: 0, high: 1, right: 1, wrong: 0 }]);
  expect(histogram([], "end", 2)).toEqual([]);
});

test("bins of counts hold whole numbers", () => {
  const runs = [3, 4, 4, 9].map((sent, seed) => run("calm", seed, 1, sent));
  expect(histogram(runs, "messages", 24).map(({ low, right }) => [low, right])).toEqual([
    [3, 1],
    [4, 2],
    [5, 0],
    [6, 0],
    [7, 0],
    [8, 0],
    [9, 1],
  ]);
  expect(histogram(runs, "messages", 3).map(({ low, high, right }) => [low, high, right])).toEqual([
    [3, 6, 3],
    [6, 9, 0],
    [9, 12, 1],
  ]);
});

test("the table of runs quotes what has commas or quotes in it", () => {
  const [head, row, end] = csvOf([run("lossy", 7, 1.5, 4, "p")]).split("\r\n");
  expect(head).toMatch(/^profile,seed,outcome,wrong,text,"end, s",messages sent,/);
  expect(row).toMatch(/^lossy,7,violated,p,"it said ""no"", twice",1\.5,4,4,/);
  expect(end).toBe("");
});
