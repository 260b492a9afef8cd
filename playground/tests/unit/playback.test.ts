// Playing recorded runs.

import { readFileSync } from "node:fs";
import { expect, test } from "vitest";
import { load } from "../../../apps/starl-wasm/starl.mjs";
import { Playback } from "../../src/engine/playback.ts";

const wait = (milliseconds: number) => new Promise((resolve) => setTimeout(resolve, milliseconds));

test("a moment that is chosen while a recording plays stays", async () => {
  const starl = await load(readFileSync(new URL("../../wasm/starl.wasm", import.meta.url)));
  const run = starl.open({}, { scenario: "race", seed: 1 });
  run.run({ until: 3 });
  const source = { kind: "trace", name: "x.mcap", from: new Blob([new Uint8Array(run.trace())]) } as const;
  let shown = 0;
  const playback = await Playback.start(
    source,
    (update) => {
      shown = update.now;
    },
    (message) => expect.fail(message),
  );
  await playback.whole;
  playback.play(1);
  while (shown < 0.1) await wait(10);
  await playback.seek(0);
  await wait(100);
  await playback.pause();
  expect(shown).toBe(0);
});
