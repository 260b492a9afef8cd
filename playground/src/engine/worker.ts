// The worker in which runs are simulated, so that the page never has to wait for them.

import { load, type Starl, StarlError } from "../../../apps/starl-wasm/starl.mjs";
import { Driver } from "./driver.ts";
import { RECORDED } from "./engine.ts";
import type { Playback } from "./playback.ts";
import { Refused, refuseTooMany } from "./refused.ts";
import { remote, Socket } from "./remote.ts";
import type { FromWorker, Opened, Request, Source, ToWorker, Update } from "./types.ts";

let instance: Promise<Starl> | null = null;

/** The instance; another one if a run has brought the last one down. */
async function starl(): Promise<Starl> {
  if ((await instance?.catch(() => null))?.failed !== false) instance = askForModule().then(load);
  return instance as Promise<Starl>;
}

let given: { resolve: (module: WebAssembly.Module) => void; reject: (error: Error) => void } | null = null;

/** The page compiles the module, once for all workers. */
function askForModule(): Promise<WebAssembly.Module> {
  return new Promise((resolve, reject) => {
    given = { resolve, reject };
    say({ needs: "module" });
  });
}

/** Questions to the page whether it has taken all updates that it has not answered yet. */
let unheard = 0;
/** The greatest number of them before the worker waits. */
const MOST_UNHEARD = 4;
let hearing: (() => void) | null = null;

/** Resolves when the page has taken all updates but the last few. */
async function heard(): Promise<void> {
  unheard++;
  say({ needs: "hearing" });
  if (unheard < MOST_UNHEARD) return;
  await new Promise<void>((resolve) => {
    hearing = resolve;
  });
}

let drawn: (() => void) | null = null;

/** Resolves when the page makes its next picture. */
function picture(): Promise<void> {
  return new Promise((resolve) => {
    drawn = resolve;
    say({ needs: "picture" });
  });
}

let shown: Driver | Playback | null = null;

const say = (message: FromWorker, transfer: Transferable[] = []) => self.postMessage(message, { transfer });
const post = (update: Update, transfer: Transferable[]) => say({ update }, transfer);
const page = { post, picture };

self.onmessage = async ({ data }: MessageEvent<ToWorker>) => {
  if ("module" in data) return given?.resolve(data.module);
  if ("heard" in data) {
    unheard--;
    return hearing?.();
  }
  if ("drawn" in data) return drawn?.();
  if ("noModule" in data) return given?.reject(new Error(data.noModule));
  const { id, request } = data;
  try {
    say({ id, ok: await answer(request) });
    // The first picture, once the page knows what it shows.
    if ("open" in request) await shown?.pause();
  } catch (error) {
    const refused = error instanceof StarlError || error instanceof Refused;
    const message = error instanceof Error ? error.message : String(error);
    say({ id, error: { message, diagnostics: refused ? error.diagnostics : [] } });
  }
};

self.addEventListener("unhandledrejection", ({ reason }) =>
  say({ failed: String(reason?.message ?? reason) }),
);

async function answer(request: Request): Promise<unknown> {
  if ("open" in request) return open(request.open);
  if ("check" in request) return (await starl()).check(request.check);
  if ("examples" in request) return (await starl()).examples();
  if ("raw" in request) return (await starl()).request(request.raw as object);
  const run = shown;
  if (!run) throw new Refused("nothing is open");
  if ("play" in request) return run.play(request.play.speed);
  if ("pause" in request) return run.pause();
  if ("seek" in request) return run.seek(request.seek);
  if ("step" in request) return run.step();
  if ("next" in request) return run.next(request.next.topics);
  if ("inspect" in request) return run.inspect(request.inspect);
  if (!(run instanceof Driver)) throw new Refused("a recorded run cannot be steered");
  if ("breakpoints" in request) return run.breakpoints(request.breakpoints);
  if ("apply" in request) return run.apply(request.apply);
  if ("trace" in request) return run.trace();
  if ("scenario" in request) return run.scenario();
  return run.report();
}

/** The run that is shown ends once the other one has begun, so it remains if that one cannot be opened. */
async function open(source: Source): Promise<Opened> {
  const before = shown;
  await before?.pause().catch(() => undefined);
  const next = source.kind === "again" ? await simulateAgain() : await start(source);
  try {
    refuseTooMany(next.opened.fleet.length);
  } catch (error) {
    await next.close().catch(() => undefined);
    throw error;
  }
  shown = next;
  await before?.close().catch(() => undefined);
  return next.opened;
}

async function simulateAgain(): Promise<Driver> {
  if (!shown || shown instanceof Driver) throw new Refused("no trace is open");
  const { title } = shown.opened;
  const simulation = (await starl()).openRecorded(await shown.recorded(), { topics: RECORDED });
  return Driver.start(simulation, { ...simulation, title: `${title}, run again`, simulation: 0 }, page);
}

async function start(source: Exclude<Source, { kind: "again" }>): Promise<Driver | Playback> {
  switch (source.kind) {
    case "files": {
      const simulation = (await starl()).open(source.files, { ...source.options, topics: RECORDED });
      return Driver.start(simulation, { ...simulation, simulation: 0 }, page);
    }
    case "server": {
      const url = new URL("engine", self.location.origin);
      url.protocol = url.protocol.replace("http", "ws");
      const socket = await Socket.connect(url.href);
      return Driver.start(remote(socket, source.opened.simulation), source.opened, page);
    }
    case "trace":
    case "fleet": {
      // Simulated runs do without the reader of traces.
      const { Playback } = await import("./playback.ts");
      return Playback.start(source, { post, heard, fail: (message) => say({ failed: message }) });
    }
  }
}
