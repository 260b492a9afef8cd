// The computations of the view of the world: places on the screen, values at a moment, datagrams in transit.

import { describe, expect, test } from "vitest";
import { POSE_NUMBERS } from "../../src/engine/types.ts";
import { History } from "../../src/run/history.ts";
import { covers } from "../../src/world/find.ts";
import { movingBox } from "../../src/world/fit.ts";
import { Ledger } from "../../src/world/ledger.ts";
import { parse } from "../../src/world/palette.ts";
import { barLength, metres } from "../../src/world/scale.ts";
import { Traffic } from "../../src/world/traffic.ts";
import { View } from "../../src/world/view.ts";

const view = (flat: boolean): View => {
  const view = new View();
  [view.width, view.height] = [800, 500];
  view.setFlat(flat);
  return view;
};

describe.each([true, false])("a view, flat: %s", (flat) => {
  test("the floor under a projected place is that place", () => {
    const seen = view(flat);
    Object.assign(seen.target, { x: 3, y: -2, z: 0 });
    const at = new Float32Array(3);
    seen.project(4.5, -1, 0, at);
    const floor = seen.floorAt(at[0] ?? 0, at[1] ?? 0);
    expect(floor?.x).toBeCloseTo(4.5, 4);
    expect(floor?.y).toBeCloseTo(-1, 4);
  });

  test("zooming keeps the place under the pointer", () => {
    const seen = view(flat);
    const before = seen.floorAt(600, 300);
    seen.zoom(0.5, 600, 300);
    const after = seen.floorAt(600, 300);
    expect(after?.x).toBeCloseTo(before?.x ?? 0, 6);
    expect(after?.y).toBeCloseTo(before?.y ?? 0, 6);
  });

  test("fitting a box shows all of it and not much more", () => {
    const seen = view(flat);
    const box = { low: { x: -5, y: 2, z: 0 }, high: { x: 45, y: 22, z: 3 } };
    seen.fit(box);
    expect(seen.holds(box)).toBe(true);
    seen.zoom(0.7);
    expect(seen.holds(box)).toBe(false);
  });
});

test("a ledger shows the same at a moment, from whichever side it comes", () => {
  const ledger = new Ledger<number>();
  ledger.record(0, "a", 1);
  ledger.record(3, "b", 2);
  ledger.record(5, "a", 3);
  ledger.record(7, "b", null);
  const at = (position: number) => {
    ledger.go(position);
    return Object.fromEntries(ledger.current);
  };
  const forth = Array.from({ length: 9 }, (_, position) => at(position));
  const back = Array.from({ length: 9 }, (_, index) => at(8 - index)).reverse();
  expect(forth).toEqual(back);
  expect([forth[0], forth[4], forth[6], forth[8]]).toEqual([{}, { a: 1, b: 2 }, { a: 3, b: 2 }, { a: 3 }]);
});

test("datagrams show while they are under way and for a moment after", () => {
  const traffic = new Traffic();
  traffic.sent(1, 0, 0, 1);
  traffic.arrived(0, 0, { robot: 1, time: 1.5, reason: null });
  const shown = (now: number) => {
    let count = 0;
    traffic.near(now, 0.2, 10, () => count++);
    return count;
  };
  expect([0.9, 1, 1.4, 1.6, 1.8].map(shown)).toEqual([0, 1, 1, 1, 0]);
});

test("a view fits robots that move, not one far away that stands", () => {
  const poses = new Float32Array(14 * POSE_NUMBERS);
  for (let robot = 0; robot < 13; robot++) poses[robot * POSE_NUMBERS] = robot * 0.1;
  poses[13 * POSE_NUMBERS] = 500;
  const history = new History();
  history.add(Float64Array.of(0, 14, ...poses));
  const now = poses.slice();
  for (let robot = 0; robot < 13; robot++) now[robot * POSE_NUMBERS + 1] = 2;
  const box = movingBox(now, history, 1, { obstacles: [], way_points: [], things: [] });
  expect(box?.high.x).toBeLessThan(10);
  expect(box?.high.y).toBeGreaterThan(1.9);
});

test.each([
  ["all of a fleet that spreads out", 20, true],
  ["the middle of a crowd", 100, false],
])("a view fits %s", (_, count, whole) => {
  const start = new Float32Array(count * POSE_NUMBERS);
  const history = new History();
  history.add(Float64Array.of(0, count, ...start));
  const now = start.slice();
  for (let robot = 0; robot < count; robot++) now[robot * POSE_NUMBERS] = robot - count / 2;
  const box = movingBox(now, history, 1, { obstacles: [], way_points: [], things: [] });
  expect((box?.low.x ?? 0) < -count / 2).toBe(whole);
});

test("a wall of two corners is hit near it, a polygon inside", () => {
  const wall = [
    { x: 0, y: 0 },
    { x: 4, y: 0 },
  ];
  expect(covers(wall, { x: 2, y: 0.05 }, 0.1)).toBe(true);
  expect(covers(wall, { x: 2, y: 0.5 }, 0.1)).toBe(false);
  expect(covers([...wall, { x: 4, y: 3 }], { x: 3, y: 1 }, 0.1)).toBe(true);
});

test("lengths and colours are read as people write them", () => {
  expect([metres(0.5), metres(1.416), metres(60), metres(2500)]).toEqual([
    "50 cm",
    "1.42 m",
    "60 m",
    "2.5 km",
  ]);
  expect(barLength(0.01)).toBe(1);
  expect(parse("#ff8000").map((part) => Math.round(part * 255))).toEqual([255, 128, 0]);
  expect(parse("hsl(120 100% 50%)").map(Math.round)).toEqual([0, 1, 0]);
});
