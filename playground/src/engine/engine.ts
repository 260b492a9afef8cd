// The engine of a simulation: the WebAssembly module in this worker, or the `starl` command behind a socket. Both have
// the methods of `Simulation` in starl.d.mts; those of the command answer later.

import type { Batch, Simulation, Status } from "../../../apps/starl-wasm/starl.d.mts";

type Later<Value> = Value | Promise<Value>;

type Asynchronous<Methods> = {
  [Name in keyof Methods]: Methods[Name] extends (...parameters: infer Parameters) => infer Result
    ? (...parameters: Parameters) => Later<Result>
    : Methods[Name];
};

export type Engine = Asynchronous<
  Pick<
    Simulation,
    | "run"
    | "step"
    | "status"
    | "frames"
    | "poses"
    | "records"
    | "states"
    | "values"
    | "world"
    | "fleet"
    | "robot"
    | "report"
    | "snapshot"
    | "restore"
    | "drop"
    | "apply"
    | "breakpoints"
    | "scenario"
    | "trace"
    | "close"
  >
>;

export type { Batch, Status };

/** Everything except poses and estimates, which make up most of a run and which frames show. */
export const RECORDED = [
  "sent",
  "delivered",
  "dropped",
  "collision",
  "action",
  "program",
  "primitive",
  "log",
  "mark",
  "fault",
  "discovered",
  "status",
  "violation",
  "thing",
  "intervention",
].map((topic) => `/starl/${topic}`);

const FREQUENT = new Set(["/starl/sent", "/starl/delivered", "/starl/dropped", "/starl/action"]);

/** Datagrams and actions: a long run has millions of them. */
export const isFrequent = (topic: string): boolean => FREQUENT.has(topic);
