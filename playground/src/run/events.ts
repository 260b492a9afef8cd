// The events of a run, in order: the records of the trace except poses. Memory is bounded: of too many records
// the oldest datagrams are forgotten first, then the oldest of the others.

import { isFrequent } from "../engine/engine.ts";
import type { TraceRecord, Update } from "../engine/types.ts";
import { firstWhere } from "./search.ts";

const MOST = 400_000;

/** A record with its place among all records of the run, from 0. */
export interface Event extends TraceRecord {
  index: number;
  /** s */
  time: number;
}

export class Events {
  list: Event[] = [];
  /** Changes whenever events are taken away. */
  generation = 0;
  /** How many records there were, those forgotten included. */
  count = 0;
  forgotten = 0;
  /** Whether of the frequent records only those near the moment shown are here. */
  isWindow = false;

  /** A record without a place comes next to the one before. */
  add(records: Update["records"]): void {
    for (const record of records) {
      const event = eventOf(record, record.place ?? this.count);
      this.list.push(event);
      this.count = event.index + 1;
    }
    if (this.list.length <= MOST) return;
    const kept = this.#thin();
    this.forgotten += this.list.length - kept.length;
    this.list = kept;
    this.generation++;
  }

  /** Has other frequent records before the place `to`. */
  moveWindow({ records, to }: NonNullable<Update["window"]>): void {
    const kept = this.list.filter((event) => !isFrequent(event.topic) || event.index >= to);
    const list = [...kept, ...records.map((record) => eventOf(record, record.place))];
    this.list = list.sort((one, other) => one.index - other.index);
    this.isWindow = true;
    this.generation++;
  }

  /** Keeps the first `count` records of the run. */
  cut(count: number): void {
    this.list.length = this.before(count);
    this.count = count;
    this.generation++;
  }

  clear(): void {
    this.list = [];
    this.count = 0;
    this.forgotten = 0;
    this.isWindow = false;
    this.generation++;
  }

  /** How many events of the list are among the first `count` records of the run. */
  before(count: number): number {
    return firstWhere(this.list, (event) => event.index >= count);
  }

  /** Where in the list the events from a time on begin. */
  from(time: number): number {
    return firstWhere(this.list, (event) => event.time >= time);
  }

  #thin(): Event[] {
    const half = this.list.length - MOST / 2;
    const story = this.list.filter((event, index) => index >= half || !isTraffic(event));
    return story.length > MOST * 0.75 ? story.slice(story.length - MOST / 2) : story;
  }
}

const eventOf = ({ time_ns, topic, message }: TraceRecord, index: number): Event => ({
  time_ns,
  topic,
  message,
  time: time_ns / 1e9,
  index,
});

export const isTraffic = ({ topic }: TraceRecord): boolean =>
  topic === "/starl/sent" || topic === "/starl/delivered" || topic === "/starl/dropped";
