// Traces that were cut off, damaged or made to do harm: each is shown as far as it can be read or refused with one
// message, without much time or memory.

import { readFileSync } from "node:fs";
import { McapWriter, TempBuffer } from "@mcap/core";
import { beforeAll, describe, expect, test } from "vitest";
import { load } from "../../../apps/starl-wasm/starl.mjs";
import { Playback } from "../../src/engine/playback.ts";
import type { Update } from "../../src/engine/types.ts";

let trace: Uint8Array<ArrayBuffer>;
beforeAll(async () => {
  const starl = await load(readFileSync(new URL("../../wasm/starl.wasm", import.meta.url)));
  const run = starl.open({}, { scenario: "race", seed: 1 });
  run.run({ until: 3 });
  trace = new Uint8Array(run.trace());
});

interface Shown {
  refused: string | null;
  damaged: string[];
  known: number;
  frames: number;
}

/** Opens a file and waits until it is read, as the page does. */
async function open(bytes: Uint8Array<ArrayBuffer>): Promise<Shown> {
  const shown: Shown = { refused: null, damaged: [], known: 0, frames: 0 };
  let last: Update | null = null;
  try {
    const source = { kind: "trace", name: "x.mcap", from: new Blob([bytes]) } as const;
    const post = (update: Update) => {
      last = update;
      shown.frames += update.frames?.length ?? 0;
    };
    const heard = () => new Promise<void>((resolve) => setTimeout(resolve));
    const fail = (message: string) => void shown.damaged.push(message);
    const playback = await Playback.start(source, { post, heard, fail });
    await playback.recorded().catch(() => undefined);
    await playback.whole;
    shown.known = (last as Update | null)?.known ?? 0;
  } catch (error) {
    shown.refused = (error as Error).message;
  }
  return shown;
}

/** The same numbers in every run. */
function* numbers(seed: number): Generator<number> {
  for (let state = seed; ; ) {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    yield state;
  }
}

test("a whole trace is shown whole", async () => {
  const { refused, damaged, known } = await open(trace);
  expect([refused, damaged]).toEqual([null, []]);
  expect(known).toBeCloseTo(3, 1);
});

test("a trace that is cut off anywhere is shown up to there or refused with one message", async () => {
  for (let part = 0; part <= 60; part++) {
    const { refused, damaged, known } = await open(trace.slice(0, Math.floor((trace.length * part) / 60)));
    expect(damaged).toEqual([]);
    if (refused !== null) expect(refused).toMatch(/^x\.mcap: this (file is no trace of StarL|is no trace)/);
    expect(known).toBeLessThanOrEqual(3.01);
  }
});

test("flipped bits give at most one message, and no time without end", async () => {
  const random = numbers(7);
  const next = () => random.next().value as number;
  for (let round = 0; round < 300; round++) {
    const bytes = trace.slice();
    for (let flips = 1 + (next() % 4); flips > 0; flips--) {
      const at = next() % (round % 2 === 0 ? bytes.length : Math.min(bytes.length, 9000));
      bytes[at] = (bytes[at] ?? 0) ^ (1 << (next() % 8));
    }
    const { refused, damaged, frames } = await open(bytes);
    expect((refused === null ? 0 : 1) + damaged.length).toBeLessThanOrEqual(1);
    expect(frames).toBeLessThan(1_000_000);
  }
}, 60_000);

const WORLD = {
  robots: [{ id: 0, name: "r", model: "create", radius: 0.2, height: 0.1, flies: false }],
  way_points: [],
  obstacles: [],
};

/** A trace as anyone can write it. */
async function made(
  world: unknown,
  messages: [time: bigint, topic: string, message: unknown][],
  compression = "",
) {
  const buffer = new TempBuffer();
  const writer = new McapWriter({
    writable: buffer,
    ...(compression && { compressChunk: (data) => ({ compression, compressedData: data }) }),
  });
  await writer.start({ profile: "", library: "" });
  await writer.addMetadata({ name: "starl", metadata: new Map([["seed", "1"]]) });
  const text = typeof world === "string" ? world : JSON.stringify(world);
  await writer.addAttachment({
    name: "starl/world.json",
    mediaType: "application/json",
    logTime: 0n,
    createTime: 0n,
    data: new TextEncoder().encode(text),
  });
  for (const [logTime, topic, message] of messages) {
    const channelId = await writer.registerChannel({
      schemaId: 0,
      topic,
      messageEncoding: "json",
      metadata: new Map(),
    });
    const data = new TextEncoder().encode(typeof message === "string" ? message : JSON.stringify(message));
    await writer.addMessage({ channelId, sequence: 0, logTime, publishTime: logTime, data });
  }
  await writer.end();
  return new Uint8Array(buffer.get());
}

const POSE = { robot: 0, x: 1, y: 1, z: 0, yaw: 0, pitch: 0, roll: 0 };
const END_OF_TIME = 2n ** 64n - 1n;

describe("a trace that somebody made", () => {
  const damaged: [string, [bigint, string, unknown][]][] = [
    ["names a robot that does not exist", [[1n, "/starl/pose", { ...POSE, robot: 4_000_000_000 }]]],
    ["names a robot that is no number", [[1n, "/starl/action", { robot: { a: 1 }, name: "x" }]]],
    ["has a message that is no JSON", [[1n, "/starl/pose", "{"]]],
    ["has a message that is no object", [[1n, "/starl/pose", [1, 2]]]],
    ["nests too deep", [[1n, "/starl/log", `${"[".repeat(1e6)}${"]".repeat(1e6)}`]]],
    ["lets a robot join like nobody", [[1n, "/starl/intervention", { intervention: '{"join":{"like":9}}' }]]],
  ];
  for (const [what, messages] of damaged) {
    test(`${what}: one message`, async () => {
      const shown = await open(await made(WORLD, messages));
      expect(shown.refused).toBeNull();
      expect(shown.damaged).toHaveLength(1);
      expect(shown.damaged[0]).toMatch(/^x\.mcap: the trace is damaged after/);
    });
  }

  test("jumps to the end of time: few frames", async () => {
    const shown = await open(
      await made(WORLD, [
        [1n, "/starl/pose", POSE],
        [END_OF_TIME, "/starl/pose", POSE],
      ]),
    );
    expect([shown.refused, shown.damaged]).toEqual([null, []]);
    expect(shown.frames).toBeLessThan(100);
  });

  test("is compressed: refused with the name of the compression", async () => {
    const shown = await open(await made(WORLD, [[1n, "/starl/pose", POSE]], "zstd"));
    expect(shown.refused).toMatch(/Unsupported compression zstd/);
  });

  for (const [what, world] of [
    ["no JSON", "{"],
    ["no object", "3"],
    ["no robots", "{}"],
    ["a robot without a name", { ...WORLD, robots: [{ ...WORLD.robots[0], name: null }] }],
    ["a place that is no number", { ...WORLD, way_points: [{ name: "A", position: { x: "1", y: 0 } }] }],
    ["an obstacle without corners", { ...WORLD, obstacles: [{ polygon: 3 }] }],
  ] as const) {
    test(`has a world with ${what}: refused`, async () => {
      const shown = await open(await made(world, []));
      expect(shown.refused).toBe("x.mcap: this file is no trace of StarL");
    });
  }

  test("has too many robots: refused before anything is made for them", async () => {
    const robots = Array.from({ length: 200_000 }, () => WORLD.robots[0]);
    const shown = await open(await made({ ...WORLD, robots }, [[1n, "/starl/pose", POSE]]));
    expect(shown.refused).toMatch(/^There are 200000 robots/);
  });

  test("claims a length that the file does not have: refused", async () => {
    const bytes = trace.slice();
    // The length of the first record after the magic and the header.
    const header = Number(new DataView(bytes.buffer).getBigUint64(9, true));
    new DataView(bytes.buffer).setBigUint64(8 + 9 + header + 1, 2n ** 52n, true);
    expect((await open(bytes)).refused).toBe("x.mcap: this file is no trace of StarL");
  });

  test("has a robot that joins: it is in the fleet from then on", async () => {
    const join = { join: { like: 0, name: "late", pose: {} } };
    const messages: [bigint, string, unknown][] = [
      [1n, "/starl/intervention", { intervention: JSON.stringify(join) }],
      [2n, "/starl/pose", { ...POSE, robot: 1 }],
    ];
    const shown = await open(await made(WORLD, messages));
    expect([shown.refused, shown.damaged]).toEqual([null, []]);
  });
});
