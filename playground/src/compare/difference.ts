// The first record in which two runs differ. Runs are deterministic, so everything after it may differ because of it.

import { countBefore } from "../messages/traffic.ts";
import type { Event } from "../run/events.ts";

/** The known part of a run: its records, and how far they reach. */
export interface Known {
  list: Event[];
  /** s */
  until: number;
}

export interface Difference {
  /** When it happens in the run in which it happens first, s. */
  time: number;
  /** The place of the record among those of its run; the records before are the same. */
  index: number;
  /** The record there, null if the run has none. */
  first: Event | null;
  second: Event | null;
}

/**
 * Compares what is known of both, records that one of the two has forgotten left out. Null if there is no difference
 * up to the moment to which both are known.
 */
export function firstDifference(first: Known, second: Known): Difference | null {
  const until = Math.min(first.until, second.until) + 1e-9;
  let [a, b] = [0, 0];
  for (;;) {
    const [one, other] = [first.list[a], second.list[b]];
    // All records are numbered, so one that has no counterpart was forgotten in the other run.
    if (one && other && one.index !== other.index) {
      if (one.index < other.index) a++;
      else b++;
      continue;
    }
    const known = [one, other].filter((event) => event !== undefined && event.time <= until) as Event[];
    if (known.length === 0) return null;
    if (known.length === 2 && one && other && same(one, other)) {
      a++;
      b++;
      continue;
    }
    const time = Math.min(...known.map((event) => event.time));
    return { time, index: known[0]?.index ?? 0, first: one ?? null, second: other ?? null };
  }
}

const same = (one: Event, other: Event): boolean =>
  one.time_ns === other.time_ns && one.topic === other.topic && equal(one.message, other.message);

function equal(one: unknown, other: unknown): boolean {
  if (Object.is(one, other)) return true;
  if (!one || !other || typeof one !== "object" || typeof other !== "object") return false;
  const [keys, others] = [Object.keys(one), Object.keys(other)];
  if (keys.length !== others.length) return false;
  return keys.every((key) =>
    equal((one as Record<string, unknown>)[key], (other as Record<string, unknown>)[key]),
  );
}

/** The records around a place: `before` of them before it, and `after` from it on. */
export function around(list: Event[], index: number, before: number, after: number): Event[] {
  const at = countBefore(list, index);
  return list.slice(Math.max(0, at - before), at + after);
}
