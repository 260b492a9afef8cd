// Marks of changes, filters, the length of unfolded values, and the shapes of a diagram.

import { expect, test } from "vitest";
import { Changes } from "../../src/inspect/changes.ts";
import { Filtered } from "../../src/inspect/filtered.ts";
import { unfold } from "../../src/inspect/unfold.ts";
import { hit, sceneOf } from "../../src/messages/scene.ts";
import { Traffic } from "../../src/messages/traffic.ts";
import { Events } from "../../src/run/events.ts";
import { acted, delivered, dropped, sent } from "./records.ts";

const robot = (value: string, restless = false) => [
  { id: 0, sections: [{ title: "Variables", facts: [{ name: "v", value, restless }] }] },
];

test("a change is marked until the next moment", () => {
  const changes = new Changes();
  changes.update(1, robot("a"), 0);
  expect(changes.of(0, "Variables", "v", false, 0)).toBeNull();
  changes.update(2, robot("b"), 10);
  expect(changes.of(0, "Variables", "v", false, 10)?.before).toBe("a");
  changes.update(2, robot("b"), 20);
  expect(changes.of(0, "Variables", "v", false, 20)?.before).toBe("a");
  changes.update(3, robot("b"), 30);
  expect(changes.of(0, "Variables", "v", false, 30)).toBeNull();
});

test("while a run plays, a change stays marked long enough to be seen", () => {
  const changes = new Changes();
  changes.update(1, robot("a"), 0);
  changes.update(2, robot("b"), 10);
  changes.update(3, robot("b"), 20);
  expect(changes.of(0, "Variables", "v", true, 20)?.before).toBe("a");
  expect(changes.of(0, "Variables", "v", true, 2000)).toBeNull();
});

test("what changes all the time is not marked", () => {
  const changes = new Changes();
  changes.update(1, robot("a", true), 0);
  changes.update(2, robot("b", true), 10);
  expect(changes.of(0, "Variables", "v", false, 10)).toBeNull();
});

test("a filter keeps up with a run that grows and is cut", () => {
  const events = new Events();
  const filtered = new Filtered(events, (event) => event.message.name === "a");
  events.add([acted(1, 0, "a"), acted(2, 0, "b"), acted(3, 0, "a")]);
  filtered.scan();
  expect(filtered.list.map(({ time }) => time)).toEqual([1, 3]);
  expect(filtered.before(2)).toBe(1);
  events.cut(2);
  events.add([acted(4, 0, "a")]);
  filtered.scan();
  expect(filtered.list.map(({ time }) => time)).toEqual([1, 4]);
});

test("a filter looks through a long run in slices", () => {
  const events = new Events();
  events.add(Array.from({ length: 5000 }, (_, index) => acted(index, 0, "a")));
  const filtered = new Filtered(events, () => true);
  expect(filtered.scan(-1)).toBe(false);
  expect(filtered.list.length).toBeLessThan(5000);
  expect(filtered.scan()).toBe(true);
  expect(filtered.list.length).toBe(5000);
});

test("nested values get a line each, texts stay whole", () => {
  const long = "x".repeat(40);
  expect(unfold(`A { b: [1, 2], c: "${long}, }", d: 3 }`)).toBe(
    `A {\n  b: [1, 2],\n  c: "${long}, }",\n  d: 3\n}`,
  );
});

const frame = {
  from: 1,
  to: 2,
  xOf: (robot: number) => 100 * robot,
  yOf: (time: number) => 100 * (time - 1),
  left: 0,
  right: 1000,
};

test("messages that cross the stretch seen are drawn, those beside it are not", () => {
  const events = new Events();
  events.add([
    sent(0.1, 0, 0),
    delivered(0.2, 1, 0, 0),
    sent(0.9, 0, 1),
    delivered(1.5, 1, 0, 1),
    sent(1.9, 0, 2, 3),
    dropped(1.95, 0, 2, 3),
    sent(1.96, 1, 0),
    delivered(2.3, 2, 1, 0),
    sent(2.4, 0, 3),
  ]);
  const { arrows } = sceneOf(events, new Traffic().update(events), frame);
  expect(arrows.map(({ datagram, lost }) => [datagram.from, datagram.sequence, lost])).toEqual([
    [0, 1, false],
    [0, 2, true],
    [1, 0, false],
  ]);
});

test("a mark lies over an arrow, and nothing is far from everything", () => {
  const events = new Events();
  events.add([sent(1.2, 0, 0), acted(1.5, 1, "a"), delivered(1.8, 2, 0, 0)]);
  const scene = sceneOf(events, new Traffic().update(events), frame);
  expect(hit(scene, 101, 51, 7)).toBe(scene.marks[0]);
  expect(hit(scene, 50, 35, 7)).toBe(scene.arrows[0]);
  expect(hit(scene, 300, 90, 7)).toBeNull();
});
