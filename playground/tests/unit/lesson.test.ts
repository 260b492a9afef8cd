/// <reference types="node" />

import { readFileSync } from "node:fs";
import { parse } from "smol-toml";
import { beforeAll, describe, expect, test } from "vitest";
import { load, type Starl } from "../../../apps/starl-wasm/starl.mjs";
import { type Seen, STEPS } from "../../src/lesson/steps.tsx";
import type { Table } from "../../src/scenario/table.ts";

let starl: Starl;
beforeAll(async () => {
  starl = await load(readFileSync(new URL("../../wasm/starl.wasm", import.meta.url)));
});

/** The view after these files were run to the end. */
function see(files: Record<string, string>): Seen {
  const diagnostics = starl.check(files);
  const scenario = files["hunt.toml"] === undefined ? null : (parse(files["hunt.toml"]) as Table);
  if (diagnostics.some(({ severity }) => severity === "error"))
    return { files, scenario, diagnostics, run: null };
  const run = starl.open(files);
  const { now, over, outcome } = run.run();
  const [report, fleet] = [run.report(), run.fleet()];
  run.close();
  const down = fleet.some(({ condition }) => condition === "down");
  return { files, scenario, diagnostics, run: { now, over, outcome, report, down } };
}

const given = (index: number) => STEPS[index]?.given ?? STEPS[index - 1]?.solution ?? {};

describe.each(STEPS.map((step, index) => ({ title: step.title, step, index })))("$title", ({
  step,
  index,
}) => {
  test("what the lesson writes does what the step asks for", () => {
    expect(step.isDone(see(step.solution ?? {}))).toBe(true);
  });

  // The first step asks only to run what is given.
  test.runIf(index > 0)("is not done by what was there before", () => {
    const before = see(given(index));
    expect(step.isDone(before)).toBe(false);
    expect(step.isDone({ ...before, run: null, diagnostics: null })).toBe(false);
  });
});
