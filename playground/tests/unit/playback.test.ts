// Playing recorded runs.

import { readFileSync } from "node:fs";
import { expect, test } from "vitest";
import { load } from "../../../apps/starl-wasm/starl.mjs";
import { isFrequent } from "../../src/engine/engine.ts";
import { Playback } from "../../src/engine/playback.ts";
import type { Update } from "../../src/engine/types.ts";
import { type Event, Events } from "../../src/run/events.ts";
import { History } from "../../src/run/history.ts";

const heard = () => wait(0);
const wait = (milliseconds: number) => new Promise<void>((resolve) => setTimeout(resolve, milliseconds));

test("a moment that is chosen while a recording plays stays", async () => {
  const starl = await load(readFileSync(new URL("../../wasm/starl.wasm", import.meta.url)));
  const run = starl.open({}, { scenario: "race", seed: 1 });
  run.run({ until: 3 });
  const source = { kind: "trace", name: "x.mcap", from: new Blob([new Uint8Array(run.trace())]) } as const;
  let shown = 0;
  const post = (update: Update) => {
    shown = update.now;
  };
  const playback = await Playback.start(source, { post, heard, fail: expect.fail });
  await playback.whole;
  playback.play(1);
  while (shown < 0.1) await wait(10);
  await playback.seek(0);
  await wait(100);
  await playback.pause();
  expect(shown).toBe(0);
});

test("of a long trace the page has the messages near the moment shown, wherever that is", async () => {
  const starl = await load(readFileSync(new URL("../../wasm/starl.wasm", import.meta.url)));
  const run = starl.open({}, { scenario: "race", seed: 1 });
  run.run({ until: 8 });
  const bytes = new Uint8Array(run.trace());
  const source = { kind: "trace", name: "x.mcap", from: new Blob([bytes]) } as const;

  const opened = async (size?: number) => {
    const events = new Events();
    let position = 0;
    const post = (update: Update) => {
      if (update.window) events.moveWindow(update.window);
      events.add(update.records);
      position = update.position;
    };
    const playback = await Playback.start(source, { post, heard, fail: expect.fail }, size);
    await playback.whole;
    return { playback, events, position: () => position };
  };
  const whole = (await opened()).events;
  const { playback, events, position } = await opened(64);
  const frequent = (list: Event[]) => list.filter(({ topic }) => isFrequent(topic));
  const rare = (list: Event[]) => list.filter(({ topic }) => !isFrequent(topic));

  for (const moment of [7.5, 0.2, 4, 8, 0]) {
    await playback.seek(moment);
    await wait(50);
    expect(frequent(events.list).length).toBeLessThanOrEqual(64);
    expect(rare(events.list)).toEqual(rare(whole.list));
    const near = ({ index }: Event) => index >= position() - 8 && index < position() + 8;
    expect(events.list.filter(near)).toEqual(whole.list.filter(near));
  }
});

test("a trace has a frame for each tenth of a second, whatever the times round to", async () => {
  const starl = await load(readFileSync(new URL("../../wasm/starl.wasm", import.meta.url)));
  const run = starl.open({}, { scenario: "race", seed: 1 });
  run.run({ until: 12 });
  const bytes = new Uint8Array(run.trace());
  const source = { kind: "trace", name: "x.mcap", from: new Blob([bytes]) } as const;
  const history = new History();
  const post = (update: Update) => history.add(update.frames ?? new Float64Array());
  await (await Playback.start(source, { post, heard, fail: expect.fail })).whole;
  const last = history.frames.at(-1)?.time ?? 0;
  expect(history.frames.length).toBeLessThanOrEqual(Math.ceil(last / 0.1) + 2);
});
