// Going back and forth in a run, and steering it, against the real simulator.

import { readFileSync } from "node:fs";
import { beforeAll, describe, expect, test } from "vitest";
import { load, type Starl } from "../../../apps/starl-wasm/starl.mjs";
import { Driver } from "../../src/engine/driver.ts";
import { RECORDED } from "../../src/engine/engine.ts";
import type { Intervention, Options, Update } from "../../src/engine/types.ts";
import { Events } from "../../src/run/events.ts";
import { History } from "../../src/run/history.ts";

const RACE: Options = { scenario: "race", seed: 7 };
const CRASH: Intervention = { fault: { crash: [1] } };

let starl: Starl;
beforeAll(async () => {
  starl = await load(readFileSync(new URL("../../wasm/starl.wasm", import.meta.url)));
});

/** A run with what the page would know of it. */
async function start(options: Options, picture = () => Promise.resolve()) {
  const simulation = starl.open({}, { ...options, topics: RECORDED });
  const [history, events] = [new History(), new Events()];
  let last: Update | null = null;
  let updates = 0;
  const post = (update: Update) => {
    last = update;
    updates++;
    if (update.cut !== null) {
      history.cut(update.cut);
      events.cut(update.position);
    }
    if (update.frames) history.add(update.frames);
    events.add(update.records);
  };
  const driver = await Driver.start(simulation, { ...simulation, simulation: 0 }, { post, picture });
  const update = () => last as unknown as Update;
  return { driver, history, events, update, updates: () => updates };
}

const story = (events: Events) =>
  events.list.map(({ time_ns, topic, message }) => ({ time_ns, topic, message }));

/** The same without any going back. */
function straight(options: Options, until: number, steered?: { at: number; intervention: Intervention }) {
  const simulation = starl.open({}, { ...options, topics: RECORDED });
  if (steered) {
    simulation.run({ until: steered.at });
    simulation.apply(steered.intervention);
  }
  simulation.run({ until });
  const { records } = simulation.records();
  return { digest: simulation.report().digest, records };
}

const wait = (ms: number) => new Promise((resolve) => setTimeout(resolve, ms));

describe("a run that is shown", () => {
  test("sends one update for each picture of the page", async () => {
    let draw = () => {};
    const { driver, updates } = await start(RACE, () => new Promise((resolve) => (draw = resolve)));
    driver.play(1);
    // More slowly than the run has slices.
    for (let picture = 0; picture < 6; picture++) {
      await expect.poll(updates).toBe(picture + 1);
      await wait(60);
      expect(updates()).toBe(picture + 1);
      draw();
    }
    await driver.pause();
  });

  test("goes on while the page makes no pictures", async () => {
    const { driver, update, updates } = await start(RACE, () => new Promise(() => {}));
    driver.play(Infinity);
    await expect.poll(() => update()?.over, { timeout: 20_000 }).toBe(true);
    expect(updates()).toBeLessThan(40);
  });

  test("has the same digest after going back and forth", async () => {
    const { driver, update } = await start(RACE);
    await driver.seek(10);
    const { digest } = await driver.report();
    await driver.seek(2.5);
    await driver.step();
    await driver.seek(0);
    await driver.seek(10);
    expect((await driver.report()).digest).toBe(digest);
    expect(update().now).toBeGreaterThanOrEqual(10);
    expect(straight(RACE, 10).digest).toBe(digest);
  });

  test("tells every record once, however one goes through it", async () => {
    const { driver, events, history, update } = await start(RACE);
    for (const time of [6, 1, 3, 8, 0, 12, 11.9, 13]) await driver.seek(time);
    expect(story(events)).toEqual(straight(RACE, 13).records);
    expect(events.count).toBe(update().position);
    const times = history.frames.map((frame) => frame.time);
    expect(times).toEqual([...new Set(times)].sort((a, b) => a - b));
    expect(times.at(-1)).toBeGreaterThan(12.8);
  });

  test("is steered again as it was steered when one goes back behind an intervention", async () => {
    const { driver, events } = await start(RACE);
    await driver.seek(5);
    await driver.apply(CRASH);
    await driver.seek(9);
    const { digest } = await driver.report();
    await driver.seek(1);
    await driver.seek(9);
    expect((await driver.report()).digest).toBe(digest);
    const steered = straight(RACE, 9, { at: 5, intervention: CRASH });
    expect(digest).toBe(steered.digest);
    expect(story(events)).toEqual(steered.records);
    // Just behind the intervention no moment is kept: the run is repeated.
    await driver.seek(1);
    await driver.seek(5.2);
    expect((await driver.report()).digest).toBe(straight(RACE, 5.2, { at: 5, intervention: CRASH }).digest);
    // Later moments that are kept have it in them already.
    await driver.seek(9.3);
    expect((await driver.report()).digest).toBe(straight(RACE, 9.3, { at: 5, intervention: CRASH }).digest);
  });

  test("forgets what came later when it is steered in the past", async () => {
    const { driver, events, history } = await start(RACE);
    await driver.seek(9);
    await driver.seek(4);
    await driver.apply(CRASH);
    expect(history.frames.at(-1)?.time).toBeLessThanOrEqual(4);
    await driver.seek(9);
    const steered = straight(RACE, 9, { at: 4, intervention: CRASH });
    expect((await driver.report()).digest).toBe(steered.digest);
    expect(story(events)).toEqual(steered.records);
    const times = history.frames.map((frame) => frame.time);
    const gaps = times.slice(1).map((time, index) => time - (times[index] ?? 0));
    expect(Math.max(...gaps)).toBeLessThan(0.11);
    expect(times.at(-1)).toBeGreaterThan(8.8);
  });

  test("keeps an intervention at its very start", async () => {
    const { driver } = await start(RACE);
    await driver.apply(CRASH);
    await driver.seek(3);
    await driver.seek(0);
    await driver.seek(3);
    expect((await driver.report()).digest).toBe(straight(RACE, 3, { at: 0, intervention: CRASH }).digest);
  });

  test("stops at the next event and not behind it", async () => {
    const { driver, events, update } = await start(RACE);
    await driver.next(["/starl/action"]);
    const first = events.list.find((event) => event.topic === "/starl/action");
    expect(first).toBeDefined();
    expect(update().now).toBeGreaterThan(first?.time ?? Number.NaN);
    expect(update().now - driver.opened.stepLength).toBeLessThanOrEqual((first?.time ?? 0) + 1e-9);
  });
});
