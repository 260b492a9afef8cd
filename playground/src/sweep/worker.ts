// A worker in which runs of a sweep are simulated.

import { load, type Starl, StarlError } from "../../../apps/starl-wasm/starl.mjs";
import type { Ask, FromWorker, Target, ToWorker } from "./protocol.ts";

let starl: Starl | null = null;
let module: WebAssembly.Module;
let target: Target;

const say = (message: FromWorker) => self.postMessage(message);

self.onmessage = async ({ data }: MessageEvent<ToWorker>) => {
  if ("target" in data) {
    ({ target, module } = data);
    return;
  }
  try {
    // A run that needs too much memory brings the instance down.
    if (!starl || starl.failed) starl = await load(module);
    say({ ok: answer(starl, data.ask) });
  } catch (error) {
    const message = error instanceof Error ? error.message : String(error);
    say({ error: { message, diagnostics: error instanceof StarlError ? error.diagnostics : [] } });
  }
};

function answer(starl: Starl, ask: Ask): unknown {
  const { files, options } = target;
  if ("try" in ask) return starl.try(files, options, ask.try.profile, ask.try.seed);
  if ("scenario" in ask)
    return starl.profileScenario(files, options, ask.scenario.profile, ask.scenario.seed);
  return starl.shrink(files, options, ask.shrink.profile, ask.shrink.seed, { most: ask.most });
}
