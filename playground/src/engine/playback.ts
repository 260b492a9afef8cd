// Plays a trace: an MCAP file, read chunk by chunk through its index, from a file of the user or by ranges from the
// server. The run is known as far as it is read; reading goes on in the background until the end.

import { type IReadable, McapIndexedReader } from "@mcap/core";
import { RECORDED } from "./engine.ts";
import { Refused } from "./remote.ts";
import {
  type Member,
  type Opened,
  type Outcome,
  POSE_NUMBERS,
  type Report,
  type Source,
  type TraceRecord,
  type Update,
  type World,
} from "./types.ts";

const POSE = "/starl/pose";
const ESTIMATE = "/starl/estimate";
const SUMMARY = "/starl/summary";
/** Seconds between two frames. */
const SAMPLE = 0.1;
/** Real time between two updates while it plays, and while it is read, ms. */
const UPDATE_EVERY = 16;
const READ_FOR = 30;

interface Summary {
  outcome: Outcome;
  digest: string;
  end_ns: number;
}

type Post = (update: Update, transfer: Transferable[]) => void;

export class Playback {
  readonly opened: Opened;
  #now = 0;
  #known = 0;
  #read = false;
  #closed = false;
  #playing: symbol | null = null;
  /** The times of all records so far, s. */
  #times: number[] = [];
  #summary: Summary | null = null;
  #violations: Report["violations"] = [];
  #messages = { sent: 0, delivered: 0, lost: 0, dropped: 0, retransmitted: 0 };
  #collisions = 0;
  #conditions: Float64Array;
  #frames: number[] = [];
  #fresh: TraceRecord[] = [];

  private constructor(
    private readonly reader: McapIndexedReader,
    opened: Opened,
    private readonly post: Post,
  ) {
    this.opened = opened;
    this.#conditions = new Float64Array(opened.fleet.length * POSE_NUMBERS);
  }

  static async start(source: Source & { kind: "trace" }, post: Post): Promise<Playback> {
    const readable = typeof source.from === "string" ? await Ranges.of(source.from) : new Part(source.from);
    const reader = await McapIndexedReader.Initialize({ readable }).catch((error: Error) => {
      throw new Refused(`${source.name}: this is no trace that can be read: ${error.message}`);
    });
    const about = await metadata(reader);
    const world = await attachment(reader, "starl/world.json");
    if (!about || !world) throw new Refused(`${source.name}: this MCAP file is no trace of StarL`);
    const end = Number(reader.statistics?.messageEndTime ?? 0n) / 1e9;
    const opened = describe(source.name, about, JSON.parse(world), end);
    const playback = new Playback(reader, opened, post);
    void playback.#load();
    return playback;
  }

  async play(speed: number): Promise<void> {
    const playing = Symbol("playing");
    this.#playing = playing;
    let last = performance.now();
    while (this.#playing === playing && this.#now < this.opened.duration) {
      await new Promise((resolve) => setTimeout(resolve, UPDATE_EVERY));
      const real = performance.now();
      this.#now = Math.min(this.#known, this.#now + ((real - last) / 1000) * Math.min(speed, 1000));
      last = real;
      if (this.#playing === playing) this.#update(speed);
    }
    if (this.#playing !== playing) return;
    this.#playing = null;
    this.#update();
  }

  async pause(): Promise<void> {
    this.#playing = null;
    this.#update();
  }

  async seek(time: number): Promise<void> {
    this.#playing = null;
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

  async #load(): Promise<void> {
    let due = SAMPLE;
    let heard = performance.now();
    const topics = [POSE, ESTIMATE, SUMMARY, ...RECORDED];
    const decoder = new TextDecoder();
    const channels = this.reader.channelsById;
    for await (const message of this.reader.readMessages({ topics })) {
      if (this.#closed) return;
      const time = Number(message.logTime) / 1e9;
      for (; time >= due; due += SAMPLE) this.#frame(due - SAMPLE);
      const topic = channels.get(message.channelId)?.topic ?? "";
      this.#take(topic, Number(message.logTime), JSON.parse(decoder.decode(message.data)));
      this.#known = Math.max(this.#known, Math.min(time, this.opened.duration));
      if (performance.now() - heard < READ_FOR) continue;
      this.#update();
      await new Promise((resolve) => setTimeout(resolve));
      heard = performance.now();
    }
    this.#frame(this.#known);
    this.#read = true;
    this.#update();
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
      case "/starl/status":
        this.#conditions[at + POSE_NUMBERS - 1] = message.status === "failed" ? 2 : 1;
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
    this.#times.push(time_ns / 1e9);
    this.#fresh.push({ time_ns, topic, message });
  }

  #frame(time: number): void {
    this.#frames.push(time, this.opened.fleet.length, ...this.#conditions);
  }

  #update(pace = 0): void {
    const frames = new Float64Array(this.#frames);
    const records = this.#fresh;
    [this.#frames, this.#fresh] = [[], []];
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
      cut: null,
      states: [],
      fleet: null,
      world: null,
      robots: [],
      report: this.#report(over),
      stopped: null,
      pace,
    };
    this.post(update, [frames.buffer]);
  }

  #report(over: boolean): Report {
    const robots = this.opened.fleet.length;
    return {
      now: this.#now,
      over,
      outcome: this.#summary?.outcome ?? null,
      digest: this.#summary?.digest ?? "",
      progress: { robots, up: robots, finished: 0, failed: 0 },
      messages: { ...this.#messages },
      collisions: this.#collisions,
      properties: [],
      violations: this.#violations,
      failures: [],
    };
  }
}

/** How many of the ascending times are not after `time`. */
function position(times: number[], time: number): number {
  let [low, high] = [0, times.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((times[middle] ?? 0) <= time) low = middle + 1;
    else high = middle;
  }
  return low;
}

function describe(
  name: string,
  about: Map<string, string>,
  world: {
    robots: Omit<Member, "program" | "condition">[];
    way_points: World["way_points"];
    obstacles: unknown[];
  },
  duration: number,
): Opened {
  const program = about.get("program") ?? "";
  return {
    title: name,
    seed: about.get("seed") ?? "",
    duration,
    stepLength: SAMPLE,
    warnings: [],
    fleet: world.robots.map((robot) => ({ ...robot, program, condition: "running" })),
    world: {
      obstacles: world.obstacles.map((obstacle, index) => ({
        index,
        obstacle: shape(obstacle),
        hidden: false,
      })),
      way_points: world.way_points,
      things: [],
    },
    live: false,
  };
}

/** An obstacle of a trace, as the simulator gives it. */
function shape(obstacle: unknown): World["obstacles"][number]["obstacle"] {
  const {
    circle,
    polygon,
    box,
    height = null,
  } = obstacle as {
    circle?: { center: { x: number; y: number; z: number }; radius: number };
    polygon?: { x: number; y: number; z: number }[];
    box?: { low: { x: number; y: number; z: number }; high: { x: number; y: number; z: number } };
    height?: { low: number; high: number } | null;
  };
  if (circle) return { Circle: { ...circle, height } };
  if (box) return { Cuboid: box };
  return { Polygon: { base: polygon ?? [], height } };
}

async function metadata(reader: McapIndexedReader): Promise<Map<string, string> | null> {
  for await (const { metadata } of reader.readMetadata({ name: "starl" })) return metadata;
  return null;
}

async function attachment(reader: McapIndexedReader, name: string): Promise<string | null> {
  for await (const { data } of reader.readAttachments({ name })) return new TextDecoder().decode(data);
  return null;
}

/** A file of the user. */
class Part implements IReadable {
  constructor(private readonly blob: Blob) {}
  async size(): Promise<bigint> {
    return BigInt(this.blob.size);
  }
  async read(offset: bigint, length: bigint): Promise<Uint8Array> {
    const part = this.blob.slice(Number(offset), Number(offset + length));
    return new Uint8Array(await part.arrayBuffer());
  }
}

/** A file of the server. */
class Ranges implements IReadable {
  private constructor(
    private readonly url: string,
    private readonly length: number,
  ) {}

  static async of(url: string): Promise<Ranges> {
    const head = await fetch(url, { method: "HEAD" });
    const length = Number(head.headers.get("content-length"));
    if (!head.ok || !Number.isFinite(length)) throw new Refused("the trace is not served any more");
    return new Ranges(url, length);
  }

  async size(): Promise<bigint> {
    return BigInt(this.length);
  }

  async read(offset: bigint, length: bigint): Promise<Uint8Array> {
    const range = `bytes=${offset}-${offset + length - 1n}`;
    const answer = await fetch(this.url, { headers: { range } });
    if (!answer.ok) throw new Refused("the trace is not served any more");
    return new Uint8Array(await answer.arrayBuffer());
  }
}
