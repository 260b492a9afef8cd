// The run of the page, with a worker that answers what the test says.

import { afterEach, expect, test, vi } from "vitest";
import type { Opened, ToWorker } from "../../src/engine/types.ts";
import { Run } from "../../src/run/run.ts";

class Answering {
  onmessage: (event: { data: unknown }) => void = () => undefined;
  static asked: ToWorker[] = [];
  static last: Answering;
  constructor() {
    Answering.last = this;
  }
  postMessage(message: ToWorker): void {
    Answering.asked.push(message);
    if (!("request" in message)) return;
    const { id, request } = message;
    if ("open" in request) this.say({ id, ok: opened(request.open.kind === "files") });
    else if ("report" in request)
      this.say({ id, error: { message: "a recorded run cannot be steered", diagnostics: [] } });
    else this.say({ id, ok: undefined });
  }
  say(data: unknown): void {
    queueMicrotask(() => this.onmessage({ data }));
  }
}

const opened = (live: boolean): Opened => ({
  title: live ? "Race" : "race.mcap",
  seed: "1",
  duration: 10,
  stepLength: 0.1,
  warnings: [],
  fleet: [],
  world: { obstacles: [], way_points: [], things: [] },
  live,
});

afterEach(() => vi.unstubAllGlobals());

test("a report that is asked for just after a trace was opened hides no message about the trace", async () => {
  vi.stubGlobal("Worker", Answering);
  const run = new Run();
  await run.open({ kind: "files", files: {}, options: {} });
  const opening = run.open({ kind: "trace", name: "race.mcap", from: new Blob() });
  expect(await run.refreshReport()).toBe(false);
  await opening;
  Answering.last.say({ failed: "race.mcap: the trace is damaged" });
  expect(await run.refreshReport()).toBe(false);
  await Promise.resolve();
  expect(run.problem.value?.message).toBe("race.mcap: the trace is damaged");
  const reports = Answering.asked.filter((message) => "request" in message && "report" in message.request);
  expect(reports).toEqual([]);
});
