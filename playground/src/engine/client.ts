// The page's end of the worker: requests with answers, and updates as they come.

import { simulator } from "./simulator.ts";
import type { Diagnostic, FromWorker, Needed, Request, ToWorker, Update } from "./types.ts";

/** An error of the simulator, with its single problems if there are any. */
export class EngineError extends Error {
  constructor(
    message: string,
    readonly diagnostics: Diagnostic[] = [],
  ) {
    super(message);
  }
}

interface Waiting {
  resolve: (value: unknown) => void;
  reject: (error: Error) => void;
}

export class Client {
  #worker: Worker;
  #waiting = new Map<number, Waiting>();
  #next = 1;

  constructor(
    private readonly onUpdate: (update: Update) => void,
    private readonly onFailure: (message: string) => void,
  ) {
    this.#worker = this.#start();
  }

  ask<Answer = void>(request: Request): Promise<Answer> {
    const id = this.#next++;
    return new Promise<Answer>((resolve, reject) => {
      this.#waiting.set(id, { resolve: resolve as Waiting["resolve"], reject });
      this.#worker.postMessage({ id, request } satisfies ToWorker);
    });
  }

  /** Ends running requests at once, however busy the worker is, and restarts it with nothing open. */
  restart(reason: string): void {
    this.#worker.terminate();
    for (const { reject } of this.#waiting.values()) reject(new EngineError(reason));
    this.#waiting.clear();
    this.#worker = this.#start();
  }

  /** Ends the worker permanently. */
  end(): void {
    this.#worker.terminate();
    for (const { reject } of this.#waiting.values()) reject(new EngineError("the run was ended"));
    this.#waiting.clear();
  }

  #start(): Worker {
    const worker = new Worker(new URL("./worker.ts", import.meta.url), { type: "module" });
    worker.onmessage = ({ data }: MessageEvent<FromWorker>) =>
      "needs" in data ? give(worker, data.needs) : this.#hear(data);
    worker.onerror = (event) => this.onFailure(event.message || "the simulator could not be loaded");
    return worker;
  }

  #hear(message: Exclude<FromWorker, { needs: unknown }>): void {
    if ("update" in message) return this.onUpdate(message.update);
    if ("failed" in message) return this.onFailure(message.failed);
    const waiting = this.#waiting.get(message.id);
    this.#waiting.delete(message.id);
    if (!waiting) return;
    if ("error" in message) waiting.reject(new EngineError(message.error.message, message.error.diagnostics));
    else waiting.resolve(message.ok);
  }
}

async function give(worker: Worker, needed: Needed): Promise<void> {
  const say = (message: ToWorker) => worker.postMessage(message);
  if (needed === "hearing") return say({ heard: true });
  if (needed === "picture") {
    requestAnimationFrame(() => say({ drawn: true }));
    return;
  }
  try {
    say({ module: await simulator() });
  } catch (error) {
    say({ noModule: error instanceof Error ? error.message : String(error) });
  }
}
