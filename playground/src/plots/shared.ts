// Shared variables over time: which value each robot holds. Records name a value by its hash; the simulator gives the
// values too. Where it does not, as in a trace, values are numbered in the order in which they first appear.

import type { Event, Events } from "../run/events.ts";
import { valueKey } from "../run/run.ts";

const PRIMITIVES = new Set(["shared_memory", "register"]);
const CHANGES = new Set(["initialize", "write", "write_again", "update"]);

export interface Step {
  time: number;
  robot: number;
  /** The value as text, such as `3` or `red`; else `value 1`. */
  value: string;
}

export class SharedVariables {
  /** The values of robots, by variable. */
  steps = new Map<string, Step[]>();
  #unknown = new Map<string, Map<string, string>>();
  #scanned = 0;
  #generation = -1;

  update(events: Events, values: Map<string, string>): this {
    if (this.#generation !== events.generation) {
      this.#generation = events.generation;
      this.steps = new Map();
      this.#unknown = new Map();
      this.#scanned = 0;
    }
    for (; this.#scanned < events.list.length; this.#scanned++) {
      const event = events.list[this.#scanned];
      if (event?.topic === "/starl/primitive") this.#take(event, values);
    }
    return this;
  }

  #take({ time, message }: Event, values: Map<string, string>): void {
    const { robot, primitive, name } = message;
    if (robot === undefined || !PRIMITIVES.has(String(primitive)) || !CHANGES.has(String(name))) return;
    const fields = new Map(
      (Array.isArray(message.fields) ? message.fields : []).map((field) => [
        field.name,
        field.text ?? field.int ?? field.bool,
      ]),
    );
    // Of a variable that each robot writes an element of, a robot's line is its own element.
    if (fields.get("single_writer") === true && name === "update") return;
    const variable = fields.get("variable") ?? fields.get("register");
    const hash = fields.get("value");
    if (typeof variable !== "string" || hash === undefined) return;
    const steps = this.steps.get(variable) ?? [];
    this.steps.set(variable, steps);
    steps.push({
      time,
      robot,
      value: values.get(valueKey(variable, hash)) ?? this.#numbered(variable, String(hash)),
    });
  }

  #numbered(variable: string, hash: string): string {
    const numbers = this.#unknown.get(variable) ?? new Map<string, string>();
    this.#unknown.set(variable, numbers);
    const number = numbers.get(hash) ?? `value ${numbers.size + 1}`;
    numbers.set(hash, number);
    return number;
  }
}

/** The values as numbers if all are; else the places of the values among `names`, from 0. */
export function scaleOf(values: string[]): { names: string[] | undefined; at: (value: string) => number } {
  if (values.every((value) => Number.isFinite(Number(value)))) return { names: undefined, at: Number };
  const names = [...new Set(values)];
  const places = new Map(names.map((name, place) => [name, place]));
  return { names, at: (value) => places.get(value) ?? Number.NaN };
}
