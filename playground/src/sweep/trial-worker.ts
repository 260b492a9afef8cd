// The page's end of a worker of a sweep.

import { EngineError } from "../engine/client.ts";
import type { Ask, FromWorker, Target } from "./protocol.ts";

/** The worker was ended before it answered. */
export class Ended extends Error {}

export class TrialWorker {
  #worker: Worker;
  #waiting: { resolve: (value: unknown) => void; reject: (error: Error) => void } | null = null;

  /** The module is that of `simulator()`. */
  constructor(target: Target, module: WebAssembly.Module) {
    this.#worker = new Worker(new URL("./worker.ts", import.meta.url), { type: "module" });
    this.#worker.onmessage = ({ data }: MessageEvent<FromWorker>) => {
      const waiting = this.#waiting;
      this.#waiting = null;
      if ("ok" in data) waiting?.resolve(data.ok);
      else waiting?.reject(new EngineError(data.error.message, data.error.diagnostics));
    };
    this.#worker.onerror = (event) =>
      this.#refuse(new EngineError(event.message || "the simulator could not be loaded"));
    this.#worker.postMessage({ target, module });
  }

  /** One thing at a time. */
  ask<Answer>(ask: Ask): Promise<Answer> {
    return new Promise<Answer>((resolve, reject) => {
      this.#waiting = { resolve: resolve as (value: unknown) => void, reject };
      this.#worker.postMessage({ ask });
    });
  }

  /** Ends the worker at once, however busy it is. */
  end(): void {
    this.#worker.terminate();
    this.#refuse(new Ended());
  }

  #refuse(error: Error): void {
    this.#waiting?.reject(error);
    this.#waiting = null;
  }
}
