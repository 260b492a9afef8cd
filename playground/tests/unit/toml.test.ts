/// <reference types="node" />

import { readdirSync, readFileSync } from "node:fs";
import { parse } from "smol-toml";
import { describe, expect, test } from "vitest";
import { append, remove, set } from "../../src/scenario/toml/edit.ts";
import { Layout, type Path, type Value } from "../../src/scenario/toml/layout.ts";

const SCENARIO = `# The race.
title = "Race"   # shown above the world
duration = "120s"

[world]
files = ["worlds/four.wpt"]
start_area = { low = [0, 0], high = [5, 3] }

# Two on the ground.
[[robots]]
model = "create"
count = 2
start = [
    { position = [0, 0] },   # left
    { position = [0, 1], heading = "90deg" },
]

[[robots]]
model = "drone"
[robots.sensors]
bumper = false

[network]
delay = "15ms"  # as measured
`;

describe("a value is replaced and all else stays", () => {
  const cases: [string, Path, string, string][] = [
    ["a key at the top", ["duration"], "60s", 'duration = "60s"'],
    ["a key of a table, with its comment", ["network", "delay"], "1s", 'delay = "1s"  # as measured'],
    ["a key of an element", ["robots", 1, "model"], "car", 'model = "car"'],
    ["a key of a table in an element", ["robots", 0, "start", 1, "heading"], "0deg", 'heading = "0deg" }'],
  ];
  test.each(cases)("%s", (_, path, value, line) => {
    const after = set(SCENARIO, path, value);
    expect(after).toContain(line);
    expect(after.split("\n").length).toBe(SCENARIO.split("\n").length);
    expect(different(SCENARIO, after)).toBe(1);
  });

  test("a number in a point in a list", () => {
    expect(set(SCENARIO, ["robots", 0, "start", 1, "position", 0], 2.5)).toContain(
      "{ position = [2.5, 1], heading",
    );
  });
});

describe("a value that was not there is added where it belongs", () => {
  const cases: [string, Path, string][] = [
    ["to the keys at the top", ["seed"], 'duration = "120s"\nseed = 7\n\n[world]'],
    ["to its table", ["network", "loss"], 'delay = "15ms"  # as measured\nloss = 7\n'],
    ["as a new table", ["physics", "step"], "# as measured\n\n[physics]\nstep = 7\n"],
    ["to its element", ["robots", 0, "first_number"], "]\nfirst_number = 7\n\n[[robots]]"],
    ["to a table of an element", ["robots", 1, "sensors", "detector"], "bumper = false\ndetector = 7\n"],
    ["as a table of an element", ["robots", 0, "clock", "drift"], "]\nclock.drift = 7\n\n[[robots]]"],
    ["to an inline table", ["world", "start_area", "x"], "{ low = [0, 0], high = [5, 3], x = 7 }"],
    ["to an element in a list", ["robots", 0, "start", 0, "x"], "{ position = [0, 0], x = 7 },   # left"],
  ];
  test.each(cases)("%s", (_, path, expected) => {
    const after = set(SCENARIO, path, 7);
    expect(after).toContain(expected);
    expect(at(parse(after), path)).toBe(7);
    expect(remove(after, path).replace("\n[physics]\n", "").replaceAll("{}", "")).toBe(SCENARIO);
  });

  test("to a text with nothing in it, and to one with only tables", () => {
    expect(set("", ["seed"], 3)).toBe("seed = 3\n");
    expect(set("", ["network", "loss"], 0.5)).toBe("[network]\nloss = 0.5\n");
    expect(set("# Mine.\n\n# Radio.\n[network]\nloss = 0\n", ["seed"], 3)).toBe(
      "# Mine.\n\nseed = 3\n\n# Radio.\n[network]\nloss = 0\n",
    );
  });

  test("where `true` stood for a table", () => {
    expect(set("[motion]\navoidance = true\n", ["motion", "avoidance", "margin"], "5cm")).toBe(
      '[motion]\navoidance = { margin = "5cm" }\n',
    );
  });

  test("beside dotted keys", () => {
    expect(set("network.delay = 1\nseed = 2\n", ["network", "loss"], 3)).toBe(
      "network.delay = 1\nnetwork.loss = 3\nseed = 2\n",
    );
  });
});

describe("elements", () => {
  test("are added after those with a header, and below their tables", () => {
    const after = append(SCENARIO, ["robots"], { model: "car", count: 1 });
    expect(after).toContain('bumper = false\n\n[[robots]]\nmodel = "car"\ncount = 1\n\n[network]');
    expect((parse(after).robots as unknown[]).length).toBe(3);
    expect(remove(after, ["robots", 2]).replaceAll("\n\n\n", "\n\n")).toBe(SCENARIO);
  });

  test("are added to a list in the way it is written", () => {
    const after = append(SCENARIO, ["robots", 0, "start"], { position: [1, 1] });
    expect(after).toContain('heading = "90deg" },\n    { position = [1, 1] },\n]');
  });

  test("are the first of their kind", () => {
    const after = append(SCENARIO, ["world", "way_point"], { name: "A", position: [1, 2] });
    expect(after).toContain(
      'high = [5, 3] }\n\n[[world.way_point]]\nname = "A"\nposition = [1, 2]\n\n# Two on',
    );
    expect(append(SCENARIO, ["robots", 1, "start"], { position: [0, 0] })).toContain(
      "start = [{ position = [0, 0] }]",
    );
  });

  test("are taken away with their tables and their comment", () => {
    expect(remove(SCENARIO, ["robots", 0])).not.toContain("Two on the ground");
    expect(parse(remove(SCENARIO, ["robots", 1])).robots).toHaveLength(1);
    expect(remove(SCENARIO, ["robots", 0, "start", 0])).toContain(
      'start = [\n    { position = [0, 1], heading = "90deg" },',
    );
  });
});

describe("every example", () => {
  const folder = new URL("../../../examples/", import.meta.url);
  const files = readdirSync(folder, { recursive: true, encoding: "utf8" }).filter(
    (path) => path.endsWith(".toml") && !path.endsWith("Cargo.toml"),
  );
  test.each(files)("%s: each of its values can be replaced alone", (path) => {
    const text = readFileSync(new URL(path, folder), "utf8");
    const before = parse(text);
    const leaves = [...paths(before)];
    expect(leaves.length).toBeGreaterThan(2);
    for (const leaf of leaves) {
      const after = parse(set(text, leaf, "changed"));
      expect(at(after, leaf)).toBe("changed");
      expect([...paths(after)].map(String)).toEqual(leaves.map(String));
    }
  });
});

test("texts that are no TOML are refused", () => {
  for (const text of ["a", "a = ", "a = [1", "[a", "a = {b = 1", '"a = 1'])
    expect(() => new Layout(text), text).toThrow();
});

test("a value ends where its text ends", () => {
  const text = 'a = """x\n"y" """ # c\nb = [1, # one\n 2]\nc = 1979-05-27 07:32:00 # d\n';
  const layout = new Layout(text);
  const shown = (path: Path) =>
    ((value: Value | null) => value && text.slice(value.from, value.to))(layout.find(path));
  expect([shown(["a"]), shown(["b"]), shown(["b", 1]), shown(["c"])]).toEqual([
    '"""x\n"y" """',
    "[1, # one\n 2]",
    "2",
    "1979-05-27 07:32:00",
  ]);
});

function* paths(value: unknown, path: Path = []): Generator<Path> {
  if (Array.isArray(value) && value.length > 0)
    for (const [index, item] of value.entries()) yield* paths(item, [...path, index]);
  else if (typeof value === "object" && value !== null && !(value instanceof Date) && !Array.isArray(value)) {
    for (const [key, item] of Object.entries(value)) yield* paths(item, [...path, key]);
  } else yield path;
}

const at = (value: unknown, path: Path) =>
  path.reduce<unknown>((value, part) => (value as Record<string, unknown>)[part as string], value);

/** How many lines differ. */
const different = (before: string, after: string) =>
  before.split("\n").filter((line, index) => line !== after.split("\n")[index]).length;
