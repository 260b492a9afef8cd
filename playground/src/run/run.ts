// The run that the page shows: what is open, the moment shown, and what is known of it. Everything on the page reads
// these signals; what a person does goes through the methods.

import { batch, computed, signal } from "@preact/signals";
import { Client, EngineError } from "../engine/client.ts";
import type {
  Breakpoint,
  Intervention,
  Member,
  Opened,
  Outcome,
  Report,
  Robot,
  Source,
  Stopped,
  Update,
  World,
} from "../engine/types.ts";
import { Events } from "./events.ts";
import { History } from "./history.ts";

/** The worker answers within this time, unless a program keeps it busy; ms. */
const PATIENCE = 10_000;

/** The events at which stepping stops. */
export const STORY = [
  "action",
  "program",
  "primitive",
  "delivered",
  "dropped",
  "fault",
  "status",
  "violation",
  "collision",
  "discovered",
  "thing",
  "intervention",
  "log",
].map((topic) => `/starl/${topic}`);

export class Run {
  readonly client = new Client(
    (update) => this.#update(update),
    (message) => this.#fail(message),
  );
  readonly history = new History();
  readonly events = new Events();
  /** The values of shared variables as texts, by variable and hash: see `valueKey`. */
  readonly values = new Map<string, string>();

  /** Null while nothing is open. */
  readonly opened = signal<Opened | null>(null);
  /** The opened target. */
  readonly source = signal<Source | null>(null);
  readonly opening = signal(false);
  /** Why nothing could be opened, or why the run could not continue. */
  readonly problem = signal<EngineError | null>(null);

  /** The moment shown, s. */
  readonly now = signal(0);
  /** How far the run is known, s. */
  readonly known = signal(0);
  /** How many records there are up to the moment shown: those before this index are in the past. */
  readonly position = signal(0);
  readonly playing = signal(false);
  /** Simulated seconds in a second. */
  readonly speed = signal(1);
  /** The result. */
  readonly pace = signal(0);
  readonly over = signal(false);
  /** When the run ends, as far as that is known, s. */
  readonly ended = signal<number | null>(null);
  readonly outcome = signal<Outcome | null>(null);
  readonly stopped = signal<Stopped | null>(null);

  /** POSE_NUMBERS numbers for each robot at the moment shown. */
  readonly poses = signal<Float64Array | Float32Array>(new Float32Array());
  /** Where programs are, by robot. */
  readonly states = signal<(string | null)[]>([]);
  readonly fleet = signal<Member[]>([]);
  readonly world = signal<World>({ obstacles: [], way_points: [], things: [] });
  readonly report = signal<Report | null>(null);
  /** Messages by the second, where not all of the run's records are in `events`. */
  readonly rates = signal<Update["rates"]>(null);
  /** All there is to see of the robots that are looked into, at the moment shown. */
  readonly robots = signal<Robot[]>([]);
  /** The robots that a person has chosen, the last one last. */
  readonly selected = signal<number[]>([]);
  /** The datagram that a person has chosen: `from` and `sequence` of it. */
  readonly message = signal<{ from: number; sequence: number } | null>(null);
  readonly breakpoints = signal<Breakpoint[]>([]);
  /** Changes when history or events change, be it that they grow. */
  readonly grown = signal(0);

  readonly live = computed(() => this.opened.value?.live ?? false);

  #wanted: number | null = null;
  #seeking = false;

  async open(source: Source): Promise<boolean> {
    batch(() => {
      this.opening.value = true;
      this.problem.value = null;
      this.playing.value = false;
    });
    try {
      const opened = await this.client.ask<Opened>({ open: source });
      batch(() => {
        this.history.clear();
        this.events.clear();
        this.values.clear();
        this.source.value = source;
        this.opened.value = opened;
        this.fleet.value = opened.fleet;
        this.world.value = opened.world;
        this.poses.value = new Float32Array();
        this.states.value = [];
        this.robots.value = [];
        this.report.value = null;
        this.rates.value = null;
        this.stopped.value = null;
        this.message.value = null;
        this.outcome.value = null;
        this.ended.value = null;
        [this.now.value, this.known.value, this.position.value] = [0, 0, 0];
        this.selected.value = this.selected.value.filter((robot) => robot < opened.fleet.length);
      });
      await this.client.ask({ inspect: this.selected.value });
      if (opened.live && this.breakpoints.value.length > 0) await this.setBreakpoints(this.breakpoints.value);
      return true;
    } catch (error) {
      this.problem.value = asEngineError(error);
      return false;
    } finally {
      this.opening.value = false;
    }
  }

  /** Simulates the run of the trace that is shown, and goes to the moment shown. */
  async runAgain(): Promise<void> {
    const now = this.now.value;
    if (await this.open({ kind: "again" })) await this.seek(now);
  }

  play(speed = this.speed.value): void {
    this.speed.value = speed;
    this.stopped.value = null;
    this.playing.value = true;
    void this.#ask({ play: { speed } });
  }

  pause(): void {
    this.playing.value = false;
    void this.#ask({ pause: true });
  }

  /** Shows another moment. While a person drags, only the last one counts. */
  async seek(time: number): Promise<void> {
    this.#wanted = Math.max(0, time);
    this.playing.value = false;
    if (this.#seeking) return;
    this.#seeking = true;
    while (this.#wanted !== null) {
      const wanted: number = this.#wanted;
      this.#wanted = null;
      await this.#ask({ seek: wanted });
    }
    this.#seeking = false;
  }

  /** One step of physics. */
  step(): Promise<void> {
    return this.#ask({ step: true });
  }

  /** To the next event. */
  next(): Promise<void> {
    return this.#ask({ next: { topics: STORY } });
  }

  /** To the event before. */
  async previous(): Promise<void> {
    const step = this.opened.value?.stepLength ?? 0;
    const started = Math.round((this.now.value - step) * 1e9);
    const wanted = new Set(STORY);
    const before = this.events.list.findLast((event) => event.time_ns < started && wanted.has(event.topic));
    await this.seek(before ? momentAfter(before.time) : 0);
  }

  /** Shows the moment of an event: the state just after the step in which it happened. */
  show(event: { time: number }): Promise<void> {
    return this.seek(momentAfter(event.time));
  }

  select(robots: number[]): void {
    this.selected.value = robots;
    void this.#ask({ inspect: robots });
  }

  async setBreakpoints(breakpoints: Breakpoint[]): Promise<void> {
    await this.client.ask({ breakpoints });
    this.breakpoints.value = breakpoints;
  }

  /** Steers the run now. Throws an EngineError with the reason. */
  apply(intervention: Intervention): Promise<void> {
    return this.client.ask({ apply: intervention });
  }

  /** Steers the run now. A paused run continues by one step, so that the effect is visible. */
  async applyAndShow(intervention: Intervention): Promise<void> {
    await this.apply(intervention);
    if (!this.playing.value) await this.step();
  }

  /** The scenario with everything that was applied, as the text of a file. */
  scenario(): Promise<string> {
    return this.client.ask<string>({ scenario: true });
  }

  /** The run up to the moment shown as a trace, the content of an MCAP file. */
  trace(): Promise<Uint8Array<ArrayBuffer>> {
    return this.client.ask<Uint8Array<ArrayBuffer>>({ trace: true });
  }

  /**
   * Asks for the present report, its digest up to date; false if another run is or was opened meanwhile, or if it is
   * recorded, whose report is always up to date.
   */
  async refreshReport(): Promise<boolean> {
    if (this.opening.value || !this.live.value) return false;
    const asked = this.opened.value;
    const gone = () => this.opening.value || this.opened.value !== asked;
    try {
      const report = await this.client.ask<Report>({ report: true });
      if (gone()) return false;
      this.report.value = report;
      return true;
    } catch (error) {
      if (!gone()) this.complain(error);
      return false;
    }
  }

  /** Shows what went wrong. */
  complain(error: unknown): void {
    this.problem.value = asEngineError(error);
  }

  /** Ends a run that does not answer. */
  abort(): void {
    this.client.restart("the run was stopped");
    batch(() => {
      this.opened.value = null;
      this.playing.value = false;
      this.opening.value = false;
    });
  }

  async #ask(request: Parameters<Client["ask"]>[0]): Promise<void> {
    const slow = setTimeout(() => {
      this.busy.value = true;
    }, PATIENCE);
    try {
      await this.client.ask(request);
    } catch (error) {
      this.problem.value = asEngineError(error);
    } finally {
      clearTimeout(slow);
      this.busy.value = false;
    }
  }

  /** Whether the simulator has not answered for long: a program keeps it busy. */
  readonly busy = signal(false);

  #update(update: Update): void {
    batch(() => {
      if (update.cut !== null) {
        this.history.cut(update.cut);
        this.events.cut(update.position);
        this.ended.value = null;
      }
      if (update.over) this.ended.value = update.known;
      if (update.frames) this.history.add(update.frames);
      if (update.window) this.events.moveWindow(update.window);
      this.events.add(update.records);
      if (update.rates) this.rates.value = update.rates;
      for (const [variable, hash, value] of update.values) this.values.set(valueKey(variable, hash), value);
      this.now.value = update.now;
      this.known.value = update.known;
      this.position.value = update.position;
      this.playing.value = update.playing;
      this.pace.value = update.pace;
      this.over.value = update.over;
      this.outcome.value = update.outcome;
      this.poses.value = update.frame ? update.frame.subarray(2) : this.history.at(update.now);
      const before = this.states.peek();
      const isSame =
        update.states.length === before.length && update.states.every((state, id) => state === before[id]);
      if (!isSame) this.states.value = update.states;
      this.robots.value = update.robots;
      if (update.fleet) this.fleet.value = update.fleet;
      if (update.world) this.world.value = update.world;
      if (update.report) this.report.value = update.report;
      if (update.stopped) this.stopped.value = update.stopped;
      if (update.frames || update.records.length > 0 || update.window || update.cut !== null)
        this.grown.value++;
    });
  }

  #fail(message: string): void {
    batch(() => {
      this.problem.value = new EngineError(message);
      this.playing.value = false;
    });
  }
}

export const valueKey = (variable: string, hash: unknown): string => `${hash} ${variable}`;

/** A moment at which everything that happened at `time` has happened: states are those after a physics step. */
const momentAfter = (time: number): number => time + 1e-9;

function asEngineError(error: unknown): EngineError {
  return error instanceof EngineError
    ? error
    : new EngineError(error instanceof Error ? error.message : String(error));
}
