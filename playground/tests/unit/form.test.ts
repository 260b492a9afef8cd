import { describe, expect, test } from "vitest";
import { fieldsOf, fieldsOfModel, type Schema } from "../../src/scenario/schema.ts";
import { read, show } from "../../src/scenario/values.ts";

/** A part of what the simulator answers to `schema`. */
const SCHEMA: Schema = {
  properties: {
    program: {
      description: "What the robots run.",
      "x-default": "each group names its own",
      "x-kind": "text",
    },
    duration: {
      description: "The time at which the run ends at the latest.",
      default: "120s",
      "x-kind": "quantity",
      "x-quantity": "duration",
      "x-units": ["ns", "us", "ms", "s", "min", "h"],
      "x-exclusive-minimum": 0,
    },
    network: {
      "x-kind": "table",
      properties: {
        loss: { anyOf: [{ minimum: 0, maximum: 1 }, {}], default: 0, "x-kind": "probability" },
        range: {
          anyOf: [{ const: "everywhere" }, {}],
          default: "everywhere",
          "x-kind": "quantity",
          "x-units": ["m"],
        },
        distribution: { enum: ["constant", "normal"], default: "normal", "x-kind": "choice" },
      },
    },
    avoidance: {
      anyOf: [{}, { properties: { margin: { "x-kind": "quantity" } } }],
      default: true,
      "x-kind": "switch",
    },
    robots: {
      "x-kind": "tables",
      items: {
        properties: {
          model: { enum: ["create", "drone"], "x-kind": "model" },
          count: { minimum: 0, maximum: 9, "x-kind": "count" },
        },
        required: ["model"],
        allOf: [
          {
            if: { properties: { model: { const: "drone" } } },
            // biome-ignore lint/suspicious/noThenProperty: so JSON Schema calls it
            then: {
              properties: {
                model_parameters: { properties: { pitch_max: { default: "20deg", "x-kind": "quantity" } } },
              },
            },
          },
        ],
      },
    },
  },
};

const field = (table: Schema, name: string) => {
  const found = fieldsOf(table).find((field) => field.name === name);
  if (!found) throw new Error(`there is no field ${name}`);
  return found;
};

describe("a form is made from the schema", () => {
  test("with the fields in their order", () => {
    expect(fieldsOf(SCHEMA).map(({ label }) => label)).toEqual([
      "Program",
      "Duration",
      "Network",
      "Avoidance",
      "Robots",
    ]);
  });

  test("a quantity has its default, units and limits", () => {
    expect(field(SCHEMA, "duration")).toMatchObject({
      kind: "quantity",
      default: "120s",
      limits: "above 0",
      required: false,
    });
    expect(field(SCHEMA, "duration").units).toContain("min");
  });

  test("a table has fields, and so has each element of a list, and a table that may be switched off", () => {
    const names = (name: string) => fieldsOf(field(SCHEMA, name).table ?? {}).map(({ name }) => name);
    expect(names("network")).toEqual(["loss", "range", "distribution"]);
    expect(names("robots")).toEqual(["model", "count"]);
    expect(names("avoidance")).toEqual(["margin"]);
  });

  test("words come first, limits of alternatives are found, what must be given is known", () => {
    const network = field(SCHEMA, "network").table ?? {};
    expect(field(network, "range")).toMatchObject({ choices: ["everywhere"], default: "everywhere" });
    expect(field(network, "distribution").choices).toEqual(["constant", "normal"]);
    expect(field(network, "loss")).toMatchObject({ limits: "0 to 1", default: "0" });
    expect(field(field(SCHEMA, "robots").table ?? {}, "model").required).toBe(true);
  });

  test("a model brings its own parameters", () => {
    const robots = field(SCHEMA, "robots").table ?? {};
    expect(fieldsOfModel(robots, "drone")).toMatchObject([{ name: "pitch_max", default: "20deg" }]);
    expect(fieldsOfModel(robots, "create")).toEqual([]);
  });
});

describe("a value is read as it is shown", () => {
  const same: [string, string, unknown][] = [
    ["quantity", "1.5 m", "1.5 m"],
    ["quantity", "0", 0],
    ["probability", "20%", "20%"],
    ["probability", "0.2", 0.2],
    ["count", "9223372036854775807", 9223372036854775807n],
    ["point", "1, -2.5", [1, -2.5]],
    ["point", "150cm, 2", ["150cm", 2]],
    ["robots", "all", "all"],
    ["robots", "create0, drone", ["create0", "drone"]],
    [
      "outline",
      "[[0, 0], [1, 0]]",
      [
        [0, 0],
        [1, 0],
      ],
    ],
    ["flag", "false", false],
    ["any", "true", true],
    ["any", "3", 3],
    ["any", "north", "north"],
    ["text", "5", "5"],
  ];
  test.each(same)("%s %s", (kind, text, value) => {
    const form = { kind, choices: [] };
    expect(read(form, text)).toEqual(value);
    expect(show(form, value as never)).toBe(text);
  });

  test("nothing is the default; a word is a word; what cannot be is refused", () => {
    expect(read({ kind: "quantity", choices: [] }, "  ")).toBeUndefined();
    expect(read({ kind: "quantity", choices: ["never"] }, "never")).toBe("never");
    expect(() => read({ kind: "count", choices: [] }, "1.5")).toThrow("whole number");
    expect(() => read({ kind: "outline", choices: [] }, "[[0")).toThrow("as in the file");
  });
});
