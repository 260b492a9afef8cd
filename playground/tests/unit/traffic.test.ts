// Messages are paired with where they arrive, as the run continues and when it is cut.

import { expect, test } from "vitest";
import { Traffic } from "../../src/messages/traffic.ts";
import { Events } from "../../src/run/events.ts";
import { delivered, dropped, sent } from "./records.ts";

test("a broadcast has one end for each robot it was meant for", () => {
  const events = new Events();
  events.add([sent(1, 0, 3), delivered(1.5, 1, 0, 3), dropped(1.6, 0, 3, 2), delivered(2, 3, 0, 3)]);
  const datagram = new Traffic().update(events).datagram(0, 3);
  expect(datagram?.ends.map((end) => end.topic)).toEqual([
    "/starl/delivered",
    "/starl/dropped",
    "/starl/delivered",
  ]);
});

test("ends that come later are paired with what was sent before", () => {
  const events = new Events();
  const traffic = new Traffic();
  events.add([sent(1, 0, 0)]);
  expect(traffic.update(events).datagram(0, 0)?.ends).toEqual([]);
  events.add([delivered(1.25, 1, 0, 0)]);
  expect(traffic.update(events).datagram(0, 0)?.ends).toHaveLength(1);
  expect(traffic.longest).toBe(0.25);
});

test("after a cut, what was cut away is unknown", () => {
  const events = new Events();
  const traffic = new Traffic();
  events.add([sent(1, 0, 0), delivered(2, 1, 0, 0), sent(3, 1, 0)]);
  traffic.update(events);
  events.cut(1);
  expect(traffic.update(events).datagram(0, 0)?.ends).toEqual([]);
  expect(traffic.datagram(1, 0)).toBeUndefined();
});

test("the end of a message whose start is forgotten belongs to nothing", () => {
  const events = new Events();
  events.add([delivered(2, 1, 0, 9)]);
  const traffic = new Traffic().update(events);
  expect(traffic.of(events.list[0] as never)).toBeUndefined();
});
