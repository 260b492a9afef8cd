// The states of primitives are shown as fields, not as Rust writes them.

import { expect, test } from "vitest";
import { fieldsOf } from "../../src/inspect/debug.ts";

const name = (robot: number) => `r${robot}`;
const shown = (text: string) =>
  Object.fromEntries(fieldsOf(text, name).map(({ name, value }) => [name, value]));

test("fields have times in seconds, robots by name, places as points, and no names of types", () => {
  const text =
    "ReachAvoid { port: Port(84), options: Options { vicinity: 0.075, stuck_after: Duration(4000000000) }, " +
    "command: Some(Command { target: Point { x: 2.517, y: 2.734, z: 0.0 }, since: Time(8575000000) }), " +
    "plan_failures: 0, lane: None, heard: {RobotId(2): true, RobotId(3): false}, done: false }";
  expect(shown(text)).toEqual({
    command: "{target: (2.517, 2.734, 0.000), since: 8.575 s}",
    "plan failures": "0",
    lane: "none",
    heard: "{r2: true, r3: false}",
    done: "false",
    options: "{vicinity: 0.075, stuck_after: 4 s}",
  });
  expect(fieldsOf(text, name).at(-1)?.name).toBe("options");
});

test("variants keep their names, and boxes with one thing in them are opened", () => {
  expect(
    shown("Acknowledged(Channel { way: Following { at: 2 }, rules: Bully(Bully { due: None }) })"),
  ).toEqual({
    way: "Following {at: 2}",
    rules: "Bully(Bully {due: none})",
  });
});

test("texts with brackets, sets, tuples and negative numbers are read", () => {
  expect(shown('A { b: "x } \\" {", c: {"d", "e"}, f: (RobotId(2), Multicast), g: -1.5e-7, h: [] }')).toEqual(
    {
      b: '"x } \\" {"',
      c: '{"d", "e"}',
      f: "(r2, Multicast)",
      g: "-1.5e-7",
      h: "[]",
    },
  );
});

test("what cannot be read is shown as it is", () => {
  for (const text of ["A { b: ", "A { b: 1 } c", "[".repeat(5000), "SingleWriter"])
    expect(fieldsOf(text, name)).toEqual([{ name: "", value: text }]);
});
