// The causal past of a moment: what happened before it at a robot, and through delivered messages elsewhere.

import { expect, test } from "vitest";
import { causalPast, isPast } from "../../src/messages/past.ts";
import { Traffic } from "../../src/messages/traffic.ts";
import { Events } from "../../src/run/events.ts";
import { acted, delivered, dropped, sent } from "./records.ts";

function of(records: ReturnType<typeof acted>[]) {
  const events = new Events();
  events.add(records);
  return { events, traffic: new Traffic().update(events) };
}

const names = (past: ReturnType<typeof causalPast>) =>
  past.last.map((event) => event.message.name).filter(Boolean);

test("a message brings the sender's events before it, not those after it", () => {
  const { traffic, events } = of([
    acted(1, 0, "before"),
    sent(2, 0, 7),
    acted(3, 0, "after"),
    delivered(4, 1, 0, 7),
    acted(5, 1, "end"),
  ]);
  const past = causalPast(traffic, [1], 5);
  expect(names(past)).toEqual(["end", "before"]);
  expect(past.count).toBe(4);
  expect(past.messages).toBe(1);
  expect(events.list.map((event) => isPast(past, event))).toEqual([true, true, false, true, true]);
});

test("influence goes on through several robots", () => {
  const { traffic } = of([
    acted(1, 0, "origin"),
    sent(2, 0, 0),
    delivered(3, 1, 0, 0),
    sent(4, 1, 0),
    delivered(5, 2, 1, 0),
    acted(6, 2, "end"),
    acted(7, 3, "elsewhere"),
  ]);
  const past = causalPast(traffic, [2], 6);
  expect(names(past)).toEqual(["end", "origin"]);
  expect([...past.until.keys()].sort()).toEqual([0, 1, 2]);
});

test("a lost message has no influence", () => {
  const { traffic } = of([acted(1, 0, "secret"), sent(2, 0, 0), dropped(3, 0, 0, 1), acted(4, 1, "end")]);
  expect(names(causalPast(traffic, [1], 4))).toEqual(["end"]);
});

test("sequence numbers are told apart by their sender", () => {
  const { traffic } = of([
    acted(1, 0, "of 0"),
    sent(2, 0, 5),
    acted(3, 1, "of 1"),
    sent(4, 1, 5),
    delivered(5, 2, 1, 5),
    acted(6, 2, "end"),
  ]);
  expect(names(causalPast(traffic, [2], 6))).toEqual(["end", "of 1"]);
});

test("a later message from a robot extends its past", () => {
  const { traffic } = of([
    sent(1, 0, 0),
    acted(2, 0, "between"),
    sent(3, 0, 1),
    delivered(4, 1, 0, 0),
    delivered(5, 1, 0, 1),
    acted(6, 1, "end"),
  ]);
  expect(names(causalPast(traffic, [1], 6))).toEqual(["end", "between"]);
});

test("what comes after the moment is left out", () => {
  const { traffic } = of([acted(1, 0, "first"), sent(2, 0, 0), delivered(3, 1, 0, 0)]);
  expect(causalPast(traffic, [1], 2).count).toBe(0);
});
