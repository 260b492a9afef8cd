// Shared variables over time. Records name a value by its hash, not by the value itself, so what is shown is which
// value each robot has: values are numbered in the order in which they first appear. Robots that hold the same number
// agree.

import type { Event, Events } from "../run/events.ts";

const PRIMITIVES = new Set(["shared_memory", "register"]);

export interface Step {
  time: number;
  robot: number;
  /** The number of the value, from 1. */
  value: number;
}

export class SharedVariables {
  /** The values of robots, by variable. */
  steps = new Map<string, Step[]>();
  #values = new Map<string, Map<string, number>>();
  #scanned = 0;
  #generation = -1;

  update(events: Events): this {
    if (this.#generation !== events.generation) {
      this.#generation = events.generation;
      this.steps = new Map();
      this.#values = new Map();
      this.#scanned = 0;
    }
    for (; this.#scanned < events.list.length; this.#scanned++) {
      const event = events.list[this.#scanned];
      if (event?.topic === "/starl/primitive") this.#take(event);
    }
    return this;
  }

  #take({ time, message }: Event): void {
    const { robot, primitive, name } = message;
    if (robot === undefined || !PRIMITIVES.has(String(primitive))) return;
    if (name !== "write" && name !== "update" && name !== "initialize") return;
    const fields = new Map(
      (Array.isArray(message.fields) ? message.fields : []).map((field) => [
        field.name,
        field.text ?? field.int,
      ]),
    );
    const variable = fields.get("variable") ?? fields.get("register");
    const value = fields.get("value");
    if (typeof variable !== "string" || value === undefined) return;
    const numbers = this.#values.get(variable) ?? new Map<string, number>();
    this.#values.set(variable, numbers);
    const number = numbers.get(String(value)) ?? numbers.size + 1;
    numbers.set(String(value), number);
    const steps = this.steps.get(variable) ?? [];
    this.steps.set(variable, steps);
    steps.push({ time, robot, value: number });
  }
}
