// The run that `starl run --open` holds: requests and answers over a WebSocket, see apps/starl/src/web/.

import type { Engine } from "./engine.ts";
import { Refused } from "./refused.ts";

type Waiting = { resolve: (value: never) => void; reject: (error: Error) => void };

export class Socket {
  #socket: WebSocket;
  #waiting = new Map<number, Waiting>();
  #next = 1;

  private constructor(socket: WebSocket) {
    this.#socket = socket;
    socket.binaryType = "arraybuffer";
    socket.onmessage = (event) => this.#hear(event.data);
    socket.onclose = () => this.#end();
  }

  static connect(url: string): Promise<Socket> {
    return new Promise((resolve, reject) => {
      const socket = new WebSocket(url);
      socket.onerror = () => reject(new Refused("starl does not answer; is it still running?"));
      socket.onopen = () => resolve(new Socket(socket));
    });
  }

  ask<Answer>(content: object): Promise<Answer> {
    const id = this.#next++;
    return new Promise<Answer>((resolve, reject) => {
      if (this.#socket.readyState !== WebSocket.OPEN) throw lost();
      this.#waiting.set(id, { resolve: resolve as Waiting["resolve"], reject });
      this.#socket.send(JSON.stringify({ id, ...content }));
    });
  }

  close() {
    this.#socket.close();
  }

  #hear(data: string | ArrayBuffer) {
    if (typeof data === "string") {
      const { id, ok, error } = JSON.parse(data);
      if (error) this.#settle(id, (waiting) => waiting.reject(new Refused(error.message, error.diagnostics)));
      else this.#settle(id, (waiting) => waiting.resolve(ok as never));
      return;
    }
    const id = new DataView(data).getUint32(0, true);
    this.#settle(id, (waiting) => waiting.resolve(new Float64Array(data, 8) as never));
  }

  #settle(id: number, answer: (waiting: Waiting) => void) {
    const waiting = this.#waiting.get(id);
    this.#waiting.delete(id);
    if (waiting) answer(waiting);
  }

  #end() {
    for (const { reject } of this.#waiting.values()) reject(lost());
    this.#waiting.clear();
  }
}

const lost = () => new Refused("the connection to starl is lost: the command was stopped");

/** A simulation of the server, with the methods of one in this worker. */
export function remote(socket: Socket, simulation: number): Engine {
  const ask = <Answer>(name: string, parameters: object = {}) =>
    socket.ask<Answer>({ request: { [name]: { simulation, ...parameters } } });
  return {
    run: ({ until, steps, sample } = {}) =>
      ask("run", { until: until === Infinity ? undefined : until, steps, sample }),
    step: () => ask("step"),
    status: () => ask("status"),
    frames: () => socket.ask({ frames: simulation }),
    poses: () => socket.ask({ poses: simulation }),
    records: (max) => ask("records", { max }),
    states: () => ask("states"),
    values: () => ask("values"),
    world: () => ask("world"),
    fleet: () => ask("fleet"),
    robot: (robot) => ask("robot", { robot }),
    report: () => ask("report"),
    snapshot: () => ask("snapshot"),
    restore: (snapshot) => ask("restore", { snapshot }),
    drop: (snapshot) => ask("drop", { snapshot }),
    apply: (intervention, { at } = {}) => ask("apply", { at, intervention }),
    breakpoints: (breakpoints) => ask("breakpoints", { breakpoints }),
    scenario: () => ask("scenario"),
    trace: async () => Uint8Array.from(atob(await ask<string>("trace")), (letter) => letter.charCodeAt(0)),
    close: () => ask("close"),
  };
}
