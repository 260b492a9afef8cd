// Runs one simulation as the page asks: plays, pauses, goes to a moment, steers. One thing at a time happens; between
// two slices of a run that plays, everything else that is asked gets its turn.
//
// The run is deterministic, so the page goes back by restoring a snapshot and running again from there. Those
// records are known already; only records after the furthest moment are new.

import type { Engine, Status } from "./engine.ts";
import { Snapshots } from "./snapshots.ts";
import {
  type Breakpoint,
  type Intervention,
  type Opened,
  POSE_NUMBERS,
  type ServerRun,
  type Stopped,
  type TraceRecord,
  type Update,
} from "./types.ts";

/** Time of the processor that a slice takes, and the pause after it in which the page is heard, ms. */
const SLICE = 12;
const BREATH = 4;
/** The longest pause before the next slice while the page makes no picture, ms. */
const PICTURE = 15;
/**
 * While the run is not shown in its own pace, the least time between updates, ms. Also the longest time without one:
 * a page that is not visible makes no pictures.
 */
const REPORT_EVERY = 500;

/** The page, as a run sees it. */
interface Page {
  post(update: Update, transfer: Transferable[]): void;
  /** Resolves when the page makes its next picture. */
  picture(): Promise<void>;
}

export class Driver {
  readonly opened: Opened;
  #status: Status;
  #known = 0;
  /** Records up to the moment shown, and up to the furthest one. */
  #position = 0;
  #recorded = 0;
  #lastFrame = -1;
  /** Everything that the page has applied, in that order. */
  #interventions: { at: number; intervention: Intervention }[] = [];
  #snapshots: Snapshots;
  #inspected: number[] = [];
  #turn: Promise<unknown> = Promise.resolve();
  /** The current playback: another value each time, so that an earlier loop ends. */
  #playing: symbol | null = null;
  #stepsPerMs = 1;
  #pace = 0;
  #reportedAt = 0;
  #members = "";
  #places = "";
  #pending: { frames: Float64Array[]; records: TraceRecord[]; cut: number | null } = {
    frames: [],
    records: [],
    cut: null,
  };

  private constructor(
    private readonly engine: Engine,
    opened: Opened,
    status: Status,
    private readonly page: Page,
  ) {
    this.opened = opened;
    this.#status = status;
    this.#snapshots = new Snapshots(engine, opened.fleet.length);
    this.#members = JSON.stringify(opened.fleet);
    this.#places = JSON.stringify(opened.world);
  }

  static async start(engine: Engine, run: ServerRun, page: Page): Promise<Driver> {
    const { title, seed, duration, warnings } = run;
    const [fleet, world] = [await engine.fleet(), await engine.world()];
    const opened = { title, seed, duration, stepLength: run.step_length, warnings, fleet, world, live: true };
    const driver = new Driver(engine, opened, await engine.status(), page);
    await driver.#run({ steps: 0 });
    return driver;
  }

  /** How many seconds of simulated time lie between two frames. */
  get #sample(): number {
    return Math.max(0.05, this.opened.fleet.length / 10_000);
  }

  play(speed: number): void {
    const playing = Symbol("playing");
    this.#playing = playing;
    void this.#play(speed, playing);
  }

  pause(): Promise<void> {
    this.#playing = null;
    return this.#exclusive(() => this.#update(true));
  }

  seek(time: number): Promise<void> {
    this.#playing = null;
    return this.#exclusive(async () => {
      if (time < this.#status.now || this.#snapshots.before(time).time > this.#status.now)
        await this.#back(time);
      let heard = performance.now();
      while (this.#status.now < time && !this.#status.over) {
        await this.#run({ until: time, steps: this.#steps(SLICE) });
        if (performance.now() - heard < REPORT_EVERY) continue;
        heard = performance.now();
        await this.#update(false);
      }
      await this.#update(true);
    });
  }

  step(): Promise<void> {
    this.#playing = null;
    return this.#exclusive(async () => {
      await this.#run({ steps: 1 });
      await this.#update(true);
    });
  }

  /** Runs until something is recorded on one of the topics. */
  next(topics: string[]): Promise<void> {
    const playing = Symbol("playing");
    this.#playing = playing;
    return this.#exclusive(async () => {
      const wanted = new Set(topics);
      let heard = performance.now();
      while (!this.#status.over && this.#playing === playing) {
        const records = await this.#run({ steps: 1 });
        if (records.some((record) => wanted.has(record.topic))) break;
        if (performance.now() - heard < REPORT_EVERY) continue;
        heard = performance.now();
        await this.#update(false);
        await breath();
      }
      this.#playing = null;
      await this.#update(true);
    });
  }

  inspect(robots: number[]): Promise<void> {
    this.#inspected = robots;
    return this.#exclusive(() => this.#update(false));
  }

  breakpoints(breakpoints: Breakpoint[]): Promise<void> {
    return this.#exclusive(async () => this.engine.breakpoints(breakpoints));
  }

  /** Steers the run at the moment shown. Later moments are forgotten. */
  apply(intervention: Intervention): Promise<void> {
    return this.#exclusive(async () => {
      const at = this.#status.now;
      await this.engine.apply(intervention);
      this.#interventions.push({ at, intervention });
      await this.#snapshots.cut(at);
      if (this.#known > this.#status.now) {
        this.#known = this.#status.now;
        this.#recorded = this.#position;
        this.#lastFrame = Math.min(this.#lastFrame, this.#known);
        this.#pending = { frames: [], records: [], cut: this.#known };
      }
      await this.#update(true);
    });
  }

  scenario(): Promise<string> {
    return this.#exclusive(async () => this.engine.scenario());
  }

  /** The run up to the moment shown as a trace. */
  trace(): Promise<Uint8Array> {
    return this.#exclusive(async () => this.engine.trace());
  }

  report() {
    return this.#exclusive(async () => this.engine.report());
  }

  async close(): Promise<void> {
    this.#playing = null;
    await this.#exclusive(async () => this.engine.close());
  }

  /** One thing after the other, whatever becomes of those before. */
  #exclusive<Result>(act: () => Promise<Result>): Promise<Result> {
    const turn = this.#turn.then(act);
    this.#turn = turn.catch(() => undefined);
    return turn;
  }

  /** Plays. The page gets one update for each of its pictures: what it does with an update that is not seen is lost. */
  async #play(speed: number, playing: symbol): Promise<void> {
    let [isSeen, updated, picture] = [true, 0, Promise.resolve()];
    let shown = { real: performance.now(), simulated: this.#status.now };
    while (this.#playing === playing) {
      const began = performance.now();
      const due = shown.simulated + ((began - shown.real) / 1000) * speed;
      const stopped = await this.#exclusive(() => this.#slice(due));
      if (stopped || this.#status.over) this.#playing = null;
      // A run that cannot keep pace does not have to catch up later.
      const real = performance.now();
      if (this.#status.now < due || speed === Infinity) shown = { real, simulated: this.#status.now };
      this.#pace = (this.#status.now - this.#paceFrom.simulated) / ((real - this.#paceFrom.real) / 1000);
      if (real - this.#paceFrom.real > 1000) this.#paceFrom = { real, simulated: this.#status.now };
      const ended = this.#playing !== playing;
      if (isSeen || ended || real - updated > REPORT_EVERY) {
        await this.#exclusive(() => this.#update(ended, stopped));
        [isSeen, updated] = [false, real];
        picture = this.page.picture().then(() => {
          isSeen = true;
        });
      }
      await breath();
      if (!isSeen) await Promise.race([picture, breath(PICTURE - (performance.now() - began))]);
    }
  }

  #paceFrom = { real: 0, simulated: 0 };

  /** Runs up to the time `due`, as far as a slice allows. */
  async #slice(due: number): Promise<Stopped | null> {
    const began = performance.now();
    while (this.#status.now < due && !this.#status.over) {
      const left = SLICE - (performance.now() - began);
      if (left <= 0) break;
      await this.#run({ until: due, steps: this.#steps(left) });
      if (this.#status.stopped) return this.#status.stopped;
    }
    return null;
  }

  #steps(ms: number): number {
    return Math.max(1, Math.floor((this.#stepsPerMs * ms) / 2));
  }

  /** Runs, and takes what is new. */
  async #run(budget: { until?: number; steps: number }): Promise<TraceRecord[]> {
    const began = performance.now();
    this.#status = await this.engine.run({ ...budget, sample: this.#sample });
    const took = Math.max(0.05, performance.now() - began);
    if (this.#status.steps > 0) this.#stepsPerMs = (this.#stepsPerMs + this.#status.steps / took) / 2;
    const { records, dropped } = await this.engine.records();
    const fresh = Math.max(0, this.#position + dropped + records.length - this.#recorded);
    this.#position += dropped + records.length;
    this.#recorded = Math.max(this.#recorded, this.#position);
    this.#pending.records.push(...records.slice(records.length - Math.min(fresh, records.length)));
    this.#take(await this.engine.frames());
    this.#known = Math.max(this.#known, this.#status.now);
    const interventions = this.#interventions.length;
    await this.#snapshots.keep({ time: this.#status.now, records: this.#position, interventions });
    return records;
  }

  /** Keeps the frames that are later than all before. */
  #take(frames: Float64Array): void {
    for (let at = 0; at < frames.length; ) {
      const time = frames[at] ?? 0;
      if (time > this.#lastFrame) {
        const fresh = frames.slice(at);
        this.#lastFrame = lastTime(fresh);
        this.#pending.frames.push(fresh);
        return;
      }
      at += 2 + (frames[at + 1] ?? 0) * POSE_NUMBERS;
    }
  }

  async #back(time: number): Promise<void> {
    const kept = this.#snapshots.before(time);
    this.#status = await this.engine.restore(kept.snapshot);
    this.#position = kept.records;
    // The run is steered again as it was steered after that moment.
    for (const { at, intervention } of this.#interventions.slice(kept.interventions)) {
      await this.engine.apply(intervention, { at });
    }
    await this.engine.frames();
  }

  /** Tells the page what has changed; all of it, or what a run that plays changes all the time. */
  async #update(all: boolean, stopped: Stopped | null = null): Promise<void> {
    const poses = await this.engine.poses();
    const frame = new Float64Array(2 + poses.length);
    frame.set([this.#status.now, poses.length / POSE_NUMBERS]);
    frame.set(poses, 2);
    const states = (await this.engine.states?.()) ?? [];
    const robots = [];
    for (const robot of this.#inspected) robots.push(await this.engine.robot(robot));
    const due = all || performance.now() - this.#reportedAt > REPORT_EVERY;
    let [fleet, world, report]: [Update["fleet"], Update["world"], Update["report"]] = [null, null, null];
    if (due) {
      this.#reportedAt = performance.now();
      report = await this.engine.report();
      [fleet, world] = [await this.engine.fleet(), await this.engine.world()];
      [fleet, this.#members] = changed(fleet, this.#members);
      [world, this.#places] = changed(world, this.#places);
    }
    // Records of primitives name the values of shared variables by hashes.
    const values = this.#pending.records.some(({ topic }) => topic === "/starl/primitive")
      ? await this.engine.values()
      : [];
    const { frames, records, cut } = this.#pending;
    this.#pending = { frames: [], records: [], cut: null };
    const joined = frames.length > 0 ? join(frames) : null;
    const { now, over, outcome } = this.#status;
    const update: Update = {
      now,
      known: this.#known,
      position: this.#position,
      over: over && now >= this.#known,
      outcome,
      playing: this.#playing !== null,
      frame,
      frames: joined,
      records,
      window: null,
      rates: null,
      values,
      cut,
      states,
      fleet,
      world,
      robots,
      report,
      stopped,
      pace: this.#pace,
    };
    this.page.post(update, joined ? [frame.buffer, joined.buffer] : [frame.buffer]);
  }
}

const breath = (ms = BREATH) => new Promise((resolve) => setTimeout(resolve, ms));

function changed<Value>(value: Value, before: string): [Value | null, string] {
  const now = JSON.stringify(value);
  return now === before ? [null, before] : [value, now];
}

function lastTime(frames: Float64Array): number {
  let time = -1;
  for (let at = 0; at < frames.length; at += 2 + (frames[at + 1] ?? 0) * POSE_NUMBERS)
    time = frames[at] ?? time;
  return time;
}

function join(parts: Float64Array[]): Float64Array<ArrayBuffer> {
  const whole = new Float64Array(parts.reduce((length, part) => length + part.length, 0));
  let at = 0;
  for (const part of parts) {
    whole.set(part, at);
    at += part.length;
  }
  return whole;
}
