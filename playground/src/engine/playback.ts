// Plays a trace, from a file of the user or from the server. The run is known as far as it is read; reading continues
// in the background until the end. The trace of a fleet that runs has no end before the command is stopped; while it
// plays, the moment shown is the latest one, unless a person has gone back.

import type { McapTypes } from "@mcap/core";
import type { Recorded } from "../../../apps/starl-wasm/starl.d.mts";
import { Rates } from "../plots/rates.ts";
import { firstWhere } from "../run/search.ts";
import { isFrequent, RECORDED } from "./engine.ts";
import { arriving, indexed, LocalFile, type Readable, records, ServedFile } from "./mcap.ts";
import { type RecordedWorld, readWorld } from "./recorded-world.ts";
import { MOST_ROBOTS, Refused, refuseTooMany } from "./refused.ts";
import {
  type Intervention,
  type Member,
  type Opened,
  type Outcome,
  POSE_NUMBERS,
  type Report,
  type Source,
  type TraceRecord,
  type Update,
} from "./types.ts";
import { Window } from "./window.ts";

const POSE = "/starl/pose";
const ESTIMATE = "/starl/estimate";
const SUMMARY = "/starl/summary";
/** Begins the names of attachments that a replay needs. */
const FILES = "starl/files/";
/** Seconds between two frames. */
const SAMPLE = 0.1;
const SAMPLE_NS = 100_000_000;
/** Real time between two updates while it plays, and while it is read; the page is heard in between. ms. */
const UPDATE_EVERY = 16;
const REPORT_EVERY = 120;
const READ_FOR = 30;
const RATES_EVERY = 500;
/** The latest moment of a fleet that runs is shown from this far before it on, s. */
const NEAR = 0.5;

interface Summary {
  outcome: Outcome;
  digest: string;
  end_ns: number;
}

/** Where what is read goes. */
interface Page {
  post(update: Update, transfer: Transferable[]): void;
  /** Resolves when the page has taken all updates but the last few, so that they do not pile up. */
  heard(): Promise<void>;
  /** Is called if the trace turns out to be damaged. */
  fail(message: string): void;
}

export class Playback {
  readonly opened: Opened;
  #now = 0;
  #known = 0;
  #read = false;
  /** Ends when everything is read. */
  whole = Promise.resolve();
  /** How the run was steered, and when, ns. */
  #interventions: [number, Intervention][] = [];
  #closed = false;
  #playing: symbol | null = null;
  /** Whether the latest moment is shown while it plays. */
  #following: boolean;
  /** Where programs are, by robot, at each change: time in s, robot, state. */
  #states: [number, number, string][] = [];
  /** The times of all records so far, s. */
  #times: number[] = [];
  #summary: Summary | null = null;
  #violations: Report["violations"] = [];
  #messages = { sent: 0, delivered: 0, lost: 0, dropped: 0, retransmitted: 0 };
  #collisions = 0;
  #conditions: Float64Array;
  /** With the robots that have joined so far, and whether the page does not know the last of them yet. */
  #fleet: Member[];
  #hasJoined = false;
  #frames: number[] = [];
  #fresh: Update["records"] = [];
  #placed: Update["window"] = null;
  #rates = new Rates();
  #ratesSaid = 0;
  /** Whether the window cannot be moved any more. */
  #broken = false;
  #pace = 0;

  private constructor(
    private readonly trace: AsyncGenerator<McapTypes.TypedMcapRecord>,
    private readonly start: Beginning,
    opened: Opened,
    private readonly page: Page,
    private readonly window: Window,
    private readonly grows: boolean,
  ) {
    this.opened = opened;
    this.#following = grows;
    this.#fleet = [...opened.fleet];
    this.#conditions = new Float64Array(opened.fleet.length * POSE_NUMBERS);
  }

  /** The window is for tests: how many of the frequent records the page has at once. */
  static async start(
    source: Source & { kind: "trace" | "fleet" },
    page: Page,
    windowSize?: number,
  ): Promise<Playback> {
    const grows = source.kind === "fleet";
    const file = grows ? null : await opened(source.from);
    const trace = file ? records(file) : arriving(String(source.from));
    const start = await beginning(trace).catch((error: Error) => {
      throw new Refused(`${source.name}: this is no trace that can be read: ${error.message}`);
    });
    const text = start.attachments.get("starl/world.json");
    const world = text === undefined ? null : readWorld(text);
    if (!start.about || !world) throw new Refused(`${source.name}: this file is no trace of StarL`);
    refuseTooMany(world.robots.length);
    const index = file && (await indexed(file));
    const end = Number(index?.statistics?.messageEndTime ?? 0) / 1e9;
    const about = describe(source.name, start.about, world, end);
    const playback = new Playback(trace, start, about, page, new Window(index, windowSize), grows);
    playback.whole = playback.#load();
    return playback;
  }

  play(speed: number): void {
    const playing = Symbol("playing");
    this.#playing = playing;
    this.#pace = speed;
    void this.#play(speed, playing);
  }

  async #play(speed: number, playing: symbol): Promise<void> {
    let last = performance.now();
    if (this.#known - this.#now < NEAR) this.#following = this.grows;
    while (this.#playing === playing && (this.grows || this.#now < this.opened.duration)) {
      await new Promise((resolve) => setTimeout(resolve, UPDATE_EVERY));
      // The run has been paused, or another moment is shown.
      if (this.#playing !== playing) return;
      const real = performance.now();
      this.#now = Math.min(this.#known, this.#now + ((real - last) / 1000) * Math.min(speed, 1000));
      if (this.#following) this.#now = this.#known;
      last = real;
      this.#update();
    }
    this.#playing = null;
    this.#update();
  }

  async pause(): Promise<void> {
    this.#playing = null;
    this.#update();
  }

  async seek(time: number): Promise<void> {
    this.#playing = null;
    this.#following = false;
    this.#now = Math.min(Math.max(0, time), this.#known);
    this.#update();
  }

  async step(): Promise<void> {
    await this.seek(this.#now + this.opened.stepLength);
  }

  async next(): Promise<void> {
    await this.seek(this.#times[position(this.#times, this.#now)] ?? this.#known);
  }

  async inspect(): Promise<void> {}

  async close(): Promise<void> {
    this.#playing = null;
    this.#closed = true;
  }

  /** The inputs to run it again. Waits until the trace is read. */
  async recorded(): Promise<Recorded> {
    if (this.grows) throw new Refused("a fleet that runs cannot be simulated again");
    const { attachments } = this.start;
    const kept = [...attachments].filter(([name]) => name.startsWith(FILES));
    const files = Object.fromEntries(kept.map(([name, text]) => [name.slice(FILES.length), text]));
    const scenario = attachments.get("starl/scenario.toml");
    if (scenario === undefined || kept.length === 0) {
      throw new Refused("the trace does not hold what it takes to run it again");
    }
    await this.whole;
    return { scenario, files, interventions: this.#interventions };
  }

  /** Reads as far as the trace can be read, and says so if it is damaged. */
  async #load(): Promise<void> {
    let damage: unknown = null;
    try {
      await this.#readAll();
    } catch (error) {
      damage = error;
    }
    if (this.#closed) return;
    this.#frame(this.#known);
    this.#read = true;
    this.#update();
    if (damage === null) return;
    const reason = damage instanceof Error ? damage.message : String(damage);
    this.page.fail(
      `${this.opened.title}: the trace is damaged after ${this.#known.toFixed(3)} s (${reason}). It is shown up to there.`,
    );
  }

  async #readAll(): Promise<void> {
    let due = 1;
    let [heard, reported] = [performance.now(), 0];
    const wanted = new Set([POSE, ESTIMATE, SUMMARY, ...RECORDED]);
    const decoder = new TextDecoder();
    const { topics } = this.start;
    for (let record = this.start.first; record; record = (await this.trace.next()).value) {
      if (this.#closed) return;
      if (record.type === "Channel") topics.set(record.id, record.topic);
      const topic = record.type === "Message" ? topics.get(record.channelId) : undefined;
      if (record.type !== "Message" || !topic || !wanted.has(topic)) continue;
      const time = Number(record.logTime) / 1e9;
      const sample = Math.floor(Number(record.logTime) / SAMPLE_NS);
      if (sample >= due) due = this.#framesBefore(sample, due);
      this.#take(topic, Number(record.logTime), this.#message(decoder.decode(record.data)));
      this.#known = Math.max(this.#known, time);
      if (performance.now() - heard < READ_FOR) continue;
      if (performance.now() - reported > REPORT_EVERY) {
        this.#update();
        await this.page.heard();
        reported = performance.now();
      }
      await new Promise((resolve) => setTimeout(resolve));
      heard = performance.now();
    }
  }

  /** Adds the frames before a sample, and returns the number of the next. While nothing is recorded two are enough. */
  #framesBefore(sample: number, due: number): number {
    this.#frame((due - 1) * SAMPLE);
    if (sample > due) this.#frame((sample - 1) * SAMPLE);
    return sample + 1;
  }

  /** Throws if it is not about a robot of the fleet. */
  #message(text: string): TraceRecord["message"] & Record<string, unknown> {
    const message = JSON.parse(text);
    if (typeof message !== "object" || message === null || Array.isArray(message))
      throw new Error("a message is no object");
    for (const robot of [message.robot, message.from]) {
      const isOne = Number.isInteger(robot) && robot >= 0 && robot < this.#fleet.length;
      if (robot !== undefined && robot !== null && !isOne) throw new Error(`there is no robot ${robot}`);
    }
    return message;
  }

  #take(topic: string, time_ns: number, message: TraceRecord["message"] & Record<string, unknown>): void {
    const at = (message.robot ?? 0) * POSE_NUMBERS;
    switch (topic) {
      case POSE: {
        const { x, y, z, yaw, pitch, roll } = message as unknown as Record<string, number>;
        return this.#conditions.set([x, y, z, yaw, pitch, roll].map(Number), at);
      }
      case ESTIMATE: {
        const { x, y, z, yaw } = message as unknown as Record<string, number>;
        return this.#conditions.set([x, y, z, yaw].map(Number), at + 6);
      }
      case SUMMARY:
        this.#summary = message as unknown as Summary;
        return;
      case "/starl/violation": {
        const { property, text, robot } = message as unknown as {
          property: string;
          text: string;
          robot?: number;
        };
        this.#violations.push({
          property,
          text,
          at: time_ns / 1e9,
          robots: robot === undefined ? [] : [robot],
        });
        break;
      }
      case "/starl/intervention":
        this.#steer(time_ns, JSON.parse(String(message.intervention)));
        break;
      case "/starl/status":
        this.#conditions[at + POSE_NUMBERS - 1] = message.status === "failed" ? 2 : 1;
        break;
      case "/starl/program":
        this.#note(time_ns, message);
        break;
      case "/starl/sent":
        this.#messages.sent++;
        break;
      case "/starl/delivered":
        this.#messages.delivered++;
        break;
      case "/starl/dropped":
        this.#messages[message.reason === "loss" ? "lost" : "dropped"]++;
        break;
      case "/starl/collision":
        this.#collisions++;
        break;
    }
    const place = this.#times.length;
    this.#times.push(time_ns / 1e9);
    this.#rates.count(topic, time_ns / 1e9);
    if (this.window.takes(place, topic)) this.#fresh.push({ time_ns, topic, message, place });
  }

  #steer(time_ns: number, intervention: Intervention): void {
    this.#interventions.push([time_ns, intervention]);
    if (typeof intervention !== "object" || !("join" in intervention)) return;
    const { like, name } = intervention.join;
    const model = this.#fleet[like];
    if (!model || this.#fleet.length >= MOST_ROBOTS) throw new Error("a robot joins that cannot be shown");
    this.#fleet.push({ ...model, id: this.#fleet.length, name: String(name) });
    const conditions = new Float64Array(this.#fleet.length * POSE_NUMBERS);
    conditions.set(this.#conditions);
    this.#conditions = conditions;
    this.#hasJoined = true;
  }

  /** A fleet that runs tells so in which state programs are. */
  #note(time_ns: number, { robot, name, fields }: TraceRecord["message"] & Record<string, unknown>): void {
    const field = (fields as { name: string; text?: string }[] | undefined)?.[0];
    if (!this.grows || name !== "state" || field?.name !== "state") return;
    this.#states.push([time_ns / 1e9, robot ?? 0, field.text ?? ""]);
  }

  /** Where programs are at the moment shown. */
  #statesNow(): (string | null)[] {
    const states: (string | null)[] = this.#fleet.map(() => null);
    for (const [time, robot, state] of this.#states) {
      if (time > this.#now) break;
      states[robot] = state;
    }
    return states;
  }

  #frame(time: number): void {
    this.#frames.push(time, this.#fleet.length, ...this.#conditions);
  }

  /** Moves the window after the moment shown. */
  async #moveWindow(): Promise<void> {
    const records: NonNullable<Update["window"]>["records"] = [];
    const decoder = new TextDecoder();
    const { topics } = this.start;
    try {
      const place = position(this.#times, this.#now);
      const span = await this.window.move(
        place,
        this.#times,
        RECORDED,
        (place, { channelId, logTime, data }) => {
          const topic = topics.get(channelId) ?? "";
          if (!isFrequent(topic)) return;
          const message = this.#message(decoder.decode(data));
          records.push({ time_ns: Number(logTime), topic, message, place });
        },
      );
      if (!span || this.#closed) return;
      this.#placed = { records, to: span.to };
      this.#update();
    } catch (error) {
      this.#broken = true;
      const reason = error instanceof Error ? error.message : String(error);
      this.page.fail(
        `${this.opened.title}: the index of the trace is damaged (${reason}). Not all messages and actions are shown.`,
      );
    }
  }

  #update(): void {
    const frames = new Float64Array(this.#frames);
    const [records, window] = [this.#fresh, this.#placed];
    [this.#frames, this.#fresh, this.#placed] = [[], [], null];
    const over = this.#read && this.#now >= this.#known;
    const update: Update = {
      now: this.#now,
      known: this.#known,
      position: position(this.#times, this.#now),
      over,
      outcome: over ? (this.#summary?.outcome ?? null) : null,
      playing: this.#playing !== null,
      frame: null,
      frames,
      records,
      window,
      rates: this.#ratesNow(),
      values: [],
      cut: null,
      states: this.#states.length > 0 ? this.#statesNow() : [],
      fleet: this.#hasJoined ? this.#fleet : null,
      world: null,
      robots: [],
      report: this.#report(over),
      stopped: null,
      pace: this.#playing === null ? 0 : this.#pace,
    };
    this.#hasJoined = false;
    this.page.post(update, [frames.buffer]);
    if (!this.#broken) void this.#moveWindow();
  }

  /** The counts at most every RATES_EVERY ms; null in between. */
  #ratesNow(): Update["rates"] {
    const now = performance.now();
    if (this.#read ? this.#ratesSaid === Infinity : now - this.#ratesSaid < RATES_EVERY) return null;
    this.#ratesSaid = this.#read ? Infinity : now;
    const { sent, delivered, lost } = this.#rates;
    return { sent, delivered, lost };
  }

  #report(over: boolean): Report {
    const robots = this.#fleet.length;
    return {
      now: this.#now,
      over,
      outcome: this.#summary?.outcome ?? null,
      digest: this.#summary?.digest ?? "",
      progress: { robots, up: robots, finished: 0, failed: 0 },
      messages: { ...this.#messages },
      collisions: this.#collisions,
      network: [],
      properties: [],
      violations: this.#violations,
      failures: [],
    };
  }
}

/** A file of the user, or of the server. */
async function opened(from: string | Blob): Promise<Readable> {
  return typeof from === "string" ? await ServedFile.of(from) : new LocalFile(from);
}

/** How many of the ascending times are not after `time`. */
function position(times: number[], time: number): number {
  return firstWhere(times, (other) => other > time);
}

function describe(
  name: string,
  about: Map<string, string>,
  { robots, ...world }: RecordedWorld,
  duration: number,
): Opened {
  const program = about.get("program") ?? "";
  return {
    title: name,
    seed: about.get("seed") ?? "",
    duration,
    stepLength: SAMPLE,
    warnings: [],
    fleet: robots.map((robot) => ({ ...robot, program, condition: "running" })),
    world,
    live: false,
  };
}

/** The header before the messages. */
interface Beginning {
  about: Map<string, string> | null;
  attachments: Map<string, string>;
  topics: Map<number, string>;
  /** The first message; undefined if there is none. */
  first: McapTypes.TypedMcapRecord | undefined;
}

async function beginning(trace: AsyncGenerator<McapTypes.TypedMcapRecord>): Promise<Beginning> {
  const start: Beginning = { about: null, attachments: new Map(), topics: new Map(), first: undefined };
  const decoder = new TextDecoder();
  for (let next = await trace.next(); !next.done; next = await trace.next()) {
    const record = next.value;
    if (record.type === "Metadata" && record.name === "starl") start.about = record.metadata;
    if (record.type === "Attachment") start.attachments.set(record.name, decoder.decode(record.data));
    if (record.type === "Channel") start.topics.set(record.id, record.topic);
    if (record.type !== "Message") continue;
    start.first = record;
    break;
  }
  return start;
}
