// Plots are made of what the run's frames and records say, and exported without loss of meaning.

import { expect, test } from "vitest";
import { csvOf, marksOf, rangeOf, thin, ticksOf } from "../../src/plots/chart.ts";
import { Rates } from "../../src/plots/rates.ts";
import { SharedVariables, scaleOf } from "../../src/plots/shared.ts";
import { PAPER, svgOf } from "../../src/plots/svg.ts";
import { Tracks } from "../../src/plots/tracks.ts";
import { Events } from "../../src/run/events.ts";
import { History } from "../../src/run/history.ts";
import { valueKey } from "../../src/run/run.ts";
import { delivered, dropped, sent } from "./records.ts";

const frame = (time: number, ...places: [number, number][]) => [
  time,
  places.length,
  ...places.flatMap(([x, y]) => [x, y, 0, 0, 0, 0, x, y, 0, 0, 0]),
];

test("speed is the way between two frames over its time", () => {
  const history = new History();
  history.add(new Float64Array([...frame(0, [0, 0], [5, 5]), ...frame(0.5, [0, 0], [5, 6])]));
  const tracks = new Tracks(history, [1]);
  tracks.update();
  expect(tracks.times).toEqual([0, 0.5]);
  expect(tracks.robots[0]?.y).toEqual([5, 6]);
  expect(tracks.robots[0]?.speed).toEqual([0, 2]);
});

test("tracks of a run that was cut are made anew", () => {
  const history = new History();
  history.add(new Float64Array([...frame(0, [0, 0]), ...frame(1, [1, 0])]));
  const tracks = new Tracks(history, [0]);
  tracks.update();
  history.cut(0.5);
  history.add(new Float64Array(frame(1, [0, 3])));
  tracks.update();
  expect(tracks.robots[0]).toEqual({ x: [0, 0], y: [0, 3], z: [0, 0], speed: [0, 3] });
});

test("messages are counted in the second in which they happen", () => {
  const events = new Events();
  events.add([sent(0.2, 0, 0), delivered(0.9, 1, 0, 0), dropped(2.5, 0, 0, 2)]);
  const rates = new Rates().update(events);
  expect([rates.sent, rates.delivered, rates.lost]).toEqual([
    [1, 0, 0],
    [1, 0, 0],
    [0, 0, 1],
  ]);
});

test("shared variables have their values, and unknown values of robots that agree have the same number", () => {
  const wrote = (time: number, robot: number, name: string, value: number) => ({
    time_ns: time * 1e9,
    topic: "/starl/primitive",
    message: {
      robot,
      primitive: "shared_memory",
      name,
      fields: [
        { name: "variable", text: "v" },
        { name: "value", int: value },
      ],
    },
  });
  const events = new Events();
  events.add([wrote(1, 0, "write", -77), wrote(2, 1, "update", -77), wrote(3, 1, "write", 12)]);
  const known = new Map([[valueKey("v", 12), "2.5"]]);
  const steps = new SharedVariables().update(events, known).steps.get("v") ?? [];
  expect(steps).toEqual([
    { time: 1, robot: 0, value: "value 1" },
    { time: 2, robot: 1, value: "value 1" },
    { time: 3, robot: 1, value: "2.5" },
  ]);
});

test("values that are numbers are drawn as they are, others by name", () => {
  const numbers = scaleOf(["7", "-2.5"]);
  expect(numbers.names).toBeUndefined();
  expect(numbers.at("-2.5")).toBe(-2.5);
  const names = scaleOf(["red", "3", "red", "blue"]);
  expect(names.names).toEqual(["red", "3", "blue"]);
  expect(names.at("blue")).toBe(2);
  const chart = {
    title: "t",
    xLabel: "time, s",
    yLabel: "v",
    square: false,
    names: names.names,
    lines: [line],
  };
  expect(csvOf(chart)).toContain(",0,blue\r\n");
  expect(marksOf(chart, { low: 0, high: 2 }, 14).map(([, text]) => text)).toEqual(["red", "3", "blue"]);
  const records = { ...chart, names: ["(life = 0.000s, number = 1)", "(life = 0.000s, number = 2)"] };
  const ends = marksOf(records, { low: 0, high: 1 }, 14).map(([, text]) => text);
  expect(ends).toEqual(["…0s, number = 1)", "…0s, number = 2)"]);
});

const line = { name: 'a "b", c', color: "#000", kept: false, x: [0, 1], y: [2, Number.NaN] };

test("a name with quotes and commas stays one field of the table", () => {
  const chart = { title: "t", xLabel: "time, s", yLabel: "x, m", square: false, lines: [line] };
  expect(csvOf(chart)).toBe('series,"time, s","x, m"\r\n"a ""b"", c",0,2\r\n"a ""b"", c",1,\r\n');
});

test("names cannot break out of the picture", () => {
  const name = '<script>"';
  const svg = svgOf(
    { title: name, xLabel: "", yLabel: "", square: true, lines: [{ ...line, name, y: [2, 3] }] },
    PAPER,
  );
  expect(svg).not.toContain("<script>");
  expect(svg).toContain("&lt;script&gt;&quot;");
});

test("a thinned line keeps its ends", () => {
  const long = { ...line, x: Array.from({ length: 1001 }, (_, index) => index), y: Array(1001).fill(0) };
  const thinned = thin(long, 100);
  expect(thinned.x.length).toBeLessThan(103);
  expect([thinned.x[0], thinned.x.at(-1)]).toEqual([0, 1000]);
});

test("ticks are round, also where all values are the same", () => {
  expect(ticksOf({ low: 0.13, high: 0.98 }, 4)).toEqual([0.2, 0.4, 0.6, 0.8]);
  expect(rangeOf([[3, 3]])).toEqual({ low: 2.5, high: 3.5 });
});

test("a long legend makes the picture higher, not the chart smaller", () => {
  const line = { color: "#000", kept: true, x: [0, 1], y: [0, 1] };
  const chart = (count: number) => ({
    title: "Paths",
    xLabel: "x, m",
    yLabel: "y, m",
    lines: Array.from({ length: count }, (_, index) => ({ ...line, name: `robot ${index} (1)` })),
    square: true,
  });
  const look = { ...PAPER, width: 240, height: 250 };
  const height = (svg: string) => Number(/height="(\d+)"/.exec(svg)?.[1]);
  expect(height(svgOf(chart(2), look))).toBe(250);
  expect(height(svgOf(chart(12), look))).toBe(250 + 10 * 16);
});
