// The interface for JavaScript: node --test apps/starl-wasm/tests/starl.test.mjs

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import test from "node:test";
import { pathToFileURL } from "node:url";
import { POSE_NUMBERS, Starl, StarlError, load } from "../starl.mjs";
import { moduleFile } from "./module.mjs";

const module = await WebAssembly.compile(readFileSync(moduleFile));

const COUNTER = `program Counter

count: Int = 0

stop()
    pre count >= 3
    eff finish()

tick()
    pre count < 3
    eff count = count + 1
`;

test("the module can be loaded from a URL, from bytes and compiled", async () => {
  for (const source of [pathToFileURL(moduleFile), pathToFileURL(moduleFile).href, readFileSync(moduleFile), module]) {
    const names = (await load(source)).examples().map((example) => example.name);
    assert.ok(names.includes("race"));
  }
});

test("every example opens from the files that it has", async () => {
  const starl = await load(module);
  for (const { files, scenario } of starl.examples()) starl.open(files, { scenario }).close();
});

test("simulations live side by side and end alike", async () => {
  const starl = await load(module);
  const [one, other] = [1, 2].map(() => starl.open({}, { scenario: "race", seed: 3n }));
  assert.equal(one.seed, "3");
  one.run();
  while (!other.run({ steps: 50 }).over);
  assert.deepEqual(one.report(), other.report());
  assert.equal(one.report().outcome, "reached");
  one.close();
  assert.throws(() => one.status(), StarlError);
  assert.throws(() => one.poses(), StarlError);
  assert.equal(other.status().over, true);
});

test("a snapshot can be gone back to again and again", async () => {
  const simulation = (await load(module)).open({}, { scenario: "formation" });
  simulation.run({ until: 2 });
  const snapshot = simulation.snapshot();
  const digests = new Set();
  for (const steps of [3, 30, 90]) {
    simulation.restore(snapshot);
    simulation.run({ steps });
    simulation.run({ until: 5 });
    digests.add(simulation.report().digest);
  }
  assert.equal(digests.size, 1);
  simulation.drop(snapshot);
  assert.throws(() => simulation.restore(snapshot), /no snapshot/);
});

test("poses are those of the robots, also when memory has grown", async () => {
  const simulation = (await load(module)).open({}, { scenario: "race" });
  simulation.run({ until: 2 });
  const before = simulation.poses().slice();
  const snapshots = Array.from({ length: 200 }, () => simulation.snapshot());
  assert.equal(snapshots.length, 200);
  const poses = simulation.poses().slice();
  assert.deepEqual(poses, before);
  const fleet = simulation.fleet();
  assert.equal(poses.length, fleet.length * POSE_NUMBERS);
  const { pose, estimate } = simulation.robot(2);
  const own = poses.subarray(2 * POSE_NUMBERS, 3 * POSE_NUMBERS);
  assert.deepEqual([...own.slice(0, 4)], [pose.position.x, pose.position.y, pose.position.z, pose.yaw]);
  assert.deepEqual([...own.slice(6, 8)], [estimate.pose.position.x, estimate.pose.position.y]);
});

test("frames hold the poses of the moments that were sampled", async () => {
  const starl = await load(module);
  const open = () => starl.open({}, { scenario: "race", seed: 4 });
  const [sampled, stepped] = [open(), open()];
  const robots = stepped.fleet().length;
  const size = 2 + robots * POSE_NUMBERS;
  for (const until of [0.3, 0.75, 1]) sampled.run({ until, sample: 0.1 });
  const frames = sampled.frames().slice();
  assert.equal(sampled.frames().length, 0);
  assert.equal(frames.length, 10 * size);
  for (let at = 0; at < frames.length; at += size) {
    stepped.run({ until: frames[at] });
    assert.ok(Math.abs(frames[at] - (at / size + 1) / 10) < stepped.step_length);
    assert.equal(stepped.status().now, frames[at]);
    assert.equal(frames[at + 1], robots);
    assert.deepEqual([...frames.subarray(at + 2, at + size)], [...stepped.poses()]);
  }
  assert.equal(sampled.report().digest, stepped.report().digest);
  for (const sample of [0, -1, Number.NaN]) assert.throws(() => sampled.run({ sample }), StarlError);
});

test("what is wrong with files has a place", async () => {
  const starl = await load(module);
  assert.deepEqual(starl.check({ "counter.starl": COUNTER }), []);
  const broken = { "counter.starl": COUNTER.replace("count + 1", "tally + 1") };
  const [found] = starl.check(broken);
  assert.equal(found.file, "counter.starl");
  assert.equal(found.line, 11);
  assert.equal(found.severity, "error");
  assert.throws(
    () => starl.open(broken),
    (error) => error instanceof StarlError && error.diagnostics[0].line === 11,
  );
});

test("an editor is told of names, completions, declarations and parts", async () => {
  const starl = await load(module);
  const files = { "counter.starl": COUNTER };
  const place = (word, behind = 0) => {
    const before = COUNTER.slice(0, COUNTER.indexOf(word) + behind).split("\n");
    return { line: before.length - 1, character: before.at(-1).length };
  };
  assert.match(starl.hover(files, "counter.starl", place("count >=")).markdown, /count: Int = 0/);
  const { path, range, text } = starl.definition(files, "counter.starl", place("count + 1"));
  assert.deepEqual([path, range.start, text], ["counter.starl", { line: 2, character: 0 }, null]);
  const offered = starl.complete(files, "counter.starl", place("finish()", 3));
  const finish = offered.find((item) => item.label === "finish");
  assert.deepEqual([finish.insert, finish.cursor, finish.range.start], ["finish", 6, place("finish()")]);
  assert.deepEqual(
    starl.outline(files, "counter.starl").map((part) => part.name),
    ["count", "stop", "tick"],
  );
  assert.equal(starl.format(COUNTER.replace("count: Int = 0", "count:Int=0")), COUNTER);
  assert.throws(() => starl.hover(files, "none.starl", place("count")), /none.starl: there is no such file/);
});

test("files can be bytes", async () => {
  const starl = await load(module);
  const simulation = starl.open({ "counter.starl": new TextEncoder().encode(COUNTER) }, { robots: "create=2" });
  const actions = new Set();
  while (!simulation.run({ steps: 1 }).over) {
    for (const { name, enabled } of simulation.robot(0).actions) if (enabled) actions.add(name);
  }
  assert.deepEqual([...actions].sort(), ["stop", "tick"]);
  const { records, left, dropped } = simulation.records(5);
  assert.equal(records.length, 5);
  assert.ok(left > 0 && dropped === 0);
});

test("a run can be steered", async () => {
  const simulation = (await load(module)).open({}, { scenario: "race" });
  simulation.run({ until: 1 });
  simulation.apply({ fault: { crash: [0] } });
  simulation.apply({ fault: { restart: [0] } }, { at: 2 });
  simulation.step();
  assert.equal(simulation.fleet()[0].condition, "down");
  simulation.run({ until: 2.1 });
  assert.equal(simulation.fleet()[0].condition, "running");
  assert.throws(() => simulation.apply({ fault: { crash: [77] } }), /there is no robot 77/);
  assert.throws(() => simulation.apply({ push: {} }), StarlError);
  assert.throws(() => simulation.apply({ leave: [1] }, { at: Number.NaN }), StarlError);
});

test("values of shared variables are reported once, by the hash in records, and change nothing", async () => {
  const starl = await load(module);
  const [simulation, alone] = [1, 2].map(() => starl.open({}, { scenario: "memory" }));
  for (const until of [1, 2, 3]) alone.run({ until });
  const values = [1, 2, 3].flatMap((until) => {
    simulation.run({ until });
    return simulation.values();
  });
  const written = (variable) =>
    simulation.records().records.flatMap(({ message: { primitive, name, fields } }) => {
      if (primitive !== "shared_memory" || name !== "write") return [];
      const of = (name) => fields.find((field) => field.name === name);
      return of("variable").text === variable ? [of("value").int] : [];
    });
  const records = written("board");
  const boards = records.map((hash) => values.filter((value) => value[0] === "board" && value[1] === hash));
  assert.ok(boards.every((found) => found.length === 1));
  assert.deepEqual([...new Set(boards.map(([[, , text]]) => text))].slice(0, 3), ["1", "2", "3"]);
  assert.ok(values.some(([variable, , text]) => variable === "result" && text.includes("number")));
  assert.deepEqual(simulation.values(), []);
  assert.equal(simulation.report().digest, alone.report().digest);
});

test("the report has the network as it is now", async () => {
  const simulation = (await load(module)).open({}, { scenario: "race" });
  const knob = (name) => simulation.report().network.find((knob) => name in knob)?.[name];
  assert.deepEqual([knob("delay"), knob("loss"), knob("range")], [15e6, 0, null]);
  simulation.apply({ network: [{ loss: 0.25 }, { range: 3 }] });
  simulation.step();
  assert.deepEqual([knob("delay"), knob("loss"), knob("range")], [15e6, 0.25, 3]);
});

test("a run stops at breakpoints", async () => {
  const simulation = (await load(module)).open({}, { scenario: "race", set: ["program=race.starl"] });
  simulation.breakpoints([{ action: { name: "pick", robot: 1 } }, { when: { expression: "currentIndex >= 1" } }]);
  const { stopped, over } = simulation.run();
  assert.deepEqual([stopped.breakpoint, stopped.robot, over], [0, 1, false]);
  const snapshot = simulation.snapshot();
  simulation.breakpoints([{ when: { expression: "currentIndex >= 1" } }]);
  const second = simulation.run().stopped;
  assert.equal(typeof second.robot, "number");
  simulation.restore(snapshot);
  assert.deepEqual(simulation.run().stopped, second);
  assert.throws(
    () => simulation.breakpoints([{ when: { expression: "currentIndex >= 1 and lost" } }]),
    (error) => error instanceof StarlError && error.diagnostics[0].column === 23,
  );
  simulation.breakpoints([]);
  assert.equal(simulation.run().stopped, null);
});

test("a failure is found and shrunk in pieces", async () => {
  const starl = await load(module);
  const program = "program Shy\n\ninvariant shy: not spoken\n\nspoken: Bool = false\n\nspeak()\n    pre not spoken\n    eff spoken = true\n";
  const files = { "shy.starl": program };
  assert.ok(starl.profiles().some(({ name, usual }) => name === "corruption" && !usual));
  const tried = starl.try(files, {}, "lossy", 7n);
  assert.deepEqual([tried.outcome, tried.wrong, tried.seed], ["violated", "Shy.shy", "7"]);
  const first = starl.shrink(files, {}, "lossy", 7, { most: 1 });
  const last = starl.shrink(files, {}, "lossy", 7);
  assert.deepEqual([first.trials, first.minimal, last.minimal, last.after.robots], [1, false, true, 2]);
  const again = starl.open({ ...files, "small.toml": last.scenario });
  again.run({ until: last.tried.now });
  assert.equal(again.report().digest, last.tried.digest);
  assert.match(starl.profileScenario(files, {}, "lossy", 7), /loss = /);
  assert.throws(() => starl.try(files, {}, "lossi", 7), /there is no profile "lossi"/);
});

test("the schema has every field in the order of the reference", async () => {
  const schema = (await load(module)).schema();
  assert.deepEqual(Object.keys(schema.properties).slice(0, 4), ["title", "program", "seed", "duration"]);
  assert.deepEqual(schema.required, ["robots"]);
  const { delay, loss } = schema.properties.network.properties;
  assert.deepEqual([delay["x-quantity"], delay.default, loss["x-quantity"]], ["duration", "15ms", "probability"]);
});

test("what is no request is refused", async () => {
  const starl = await load(module);
  for (const request of [null, 1, "", {}, [], { run: {} }, { open: { files: 3 } }, undefined]) {
    assert.throws(() => starl.request(request), StarlError);
  }
  assert.throws(() => starl.open({}, { scenario: "rase" }), /race/);
  assert.throws(() => starl.open({}), /neither a scenario nor a program/);
});

test("after a trap an instance says so", () => {
  const memory = new WebAssembly.Memory({ initial: 1 });
  const trap = () => {
    throw new WebAssembly.RuntimeError("unreachable");
  };
  const exports = { memory, buffer: () => 0, call: trap, failure: () => 0, answer: () => 0 };
  const starl = new Starl({ exports });
  assert.throws(() => starl.examples(), /fault of StarL.*unreachable/);
  assert.throws(() => starl.examples(), StarlError);
});
