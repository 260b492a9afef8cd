// Two runs are compared record by record up to the moment to which both are known.

import { expect, test } from "vitest";
import { around, firstDifference, type Known } from "../../src/compare/difference.ts";
import { Events } from "../../src/run/events.ts";
import { acted, delivered, sent } from "./records.ts";

function known(until: number, ...records: ReturnType<typeof acted>[]): Known {
  const events = new Events();
  events.add(records);
  return { list: events.list, until };
}

test("the first record that differs is found, not a later one", () => {
  const first = known(9, acted(1, 0, "a"), acted(2, 0, "b"), acted(3, 0, "c"));
  const second = known(9, acted(1, 0, "a"), acted(2, 1, "b"), acted(3, 0, "d"));
  expect(firstDifference(first, second)).toMatchObject({
    time: 2,
    index: 1,
    first: { message: { robot: 0 } },
  });
});

test("the same record at another time is a difference, at the earlier time", () => {
  const found = firstDifference(
    known(9, sent(1, 0, 0), sent(2, 0, 1)),
    known(9, sent(1, 0, 0), sent(1.5, 0, 1)),
  );
  expect(found).toMatchObject({ time: 1.5, index: 1 });
});

test("a run that goes on longer does not differ by that", () => {
  const first = known(2, acted(1, 0, "a"));
  const second = known(5, acted(1, 0, "a"), acted(4, 0, "b"));
  expect(firstDifference(first, second)).toBeNull();
});

test("a record that the other run lacks is a difference", () => {
  const found = firstDifference(known(5, acted(1, 0, "a")), known(5, acted(1, 0, "a"), acted(4, 0, "b")));
  expect(found).toMatchObject({ time: 4, index: 1, first: null, second: { message: { name: "b" } } });
});

test("records that one run has forgotten are left out", () => {
  const records = [sent(1, 0, 0), delivered(2, 1, 0, 0), acted(3, 1, "a")];
  const first = known(9, ...records, acted(4, 1, "b"));
  const second = known(9, ...records, acted(4, 1, "c"));
  second.list.splice(1, 1);
  expect(firstDifference(first, second)).toMatchObject({ time: 4, index: 3 });
  first.list.splice(0, 1);
  expect(firstDifference(first, second)).toMatchObject({ time: 4, index: 3 });
});

test("nested fields are compared", () => {
  const moved = (x: number) => ({
    ...acted(1, 0, "a"),
    message: { robot: 0, fields: [{ name: "p", point: { x, y: 0 } }] },
  });
  expect(firstDifference(known(2, moved(1)), known(2, moved(1)))).toBeNull();
  expect(firstDifference(known(2, moved(1)), known(2, moved(2)))).not.toBeNull();
});

test("the records around a place are those before it and from it on", () => {
  const { list } = known(9, ...[1, 2, 3, 4, 5].map((time) => acted(time, 0, String(time))));
  expect(around(list, 2, 1, 2).map(({ index }) => index)).toEqual([1, 2, 3]);
});
