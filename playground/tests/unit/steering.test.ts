// Steering input is parsed by its form; interventions are described in words.

import { expect, test } from "vitest";
import { readFields, readGroups, readRobots } from "../../src/meddle/fields.ts";
import { recorded, wordsOf } from "../../src/meddle/words.ts";

const robots = new Map([
  ["r0", 0],
  ["r1", 1],
]);
const name = (robot: number) => `r${robot}`;

test("fields have the kind that they look like", () => {
  const text = 'count = 3\nspeed=1.5\nfast = true\nto = (0.5, -1)\nwho = r1\nnote = "3"\nword = go home';
  expect(readFields(text, robots)).toEqual([
    ["count", { int: 3 }],
    ["speed", { float: 1.5 }],
    ["fast", { bool: true }],
    ["to", { point: { x: 0.5, y: -1, z: 0 } }],
    ["who", { robot: 1 }],
    ["note", { text: "3" }],
    ["word", { text: "go home" }],
  ]);
});

test("a line that is no field is named", () => {
  expect(() => readFields("count = 3\nspeed", robots)).toThrow(/line 2/);
});

test("groups are lists of names or numbers", () => {
  expect(readGroups("r0 | 1,", robots)).toEqual([[0], [1]]);
  expect(() => readRobots("r7", robots)).toThrow(/no robot r7/);
  expect(() => readRobots("2", robots)).toThrow(/no robot 2/);
});

test("interventions are said in words", () => {
  expect(wordsOf({ fault: { crash: [1] } }, name)).toBe("crash r1");
  expect(wordsOf({ network: [{ loss: 0.2 }, { delay: 2e7 }, { range: null }] }, name)).toBe(
    "network: loss 20 %, delay 20 ms, range unlimited",
  );
  expect(wordsOf(recorded('{"leave":[0]}') as never, name)).toBe("r0 leave");
  expect(recorded("no JSON")).toBeNull();
});
