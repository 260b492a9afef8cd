// The simulator's own types, and the contract between the page and the worker that runs it.
// Units as in starl.d.mts: seconds, metres, radians, one right-handed world frame with z up.

import type * as starl from "../../../apps/starl-wasm/starl.d.mts";

export type {
  Condition,
  Diagnostic,
  Example,
  Fault,
  Files,
  Intervention,
  Member,
  NetworkKnob,
  Obstacle,
  Options,
  Outcome,
  Point,
  Pose,
  Report,
  Robot,
  TraceRecord,
  WayPoint,
  World,
} from "../../../apps/starl-wasm/starl.d.mts";

/** Numbers of a robot in a frame: true x, y, z, yaw, pitch, roll; believed x, y, z, yaw; condition. */
export const POSE_NUMBERS = 11;

/** A run that can be shown. */
export type Source =
  /** A scenario with its programs, simulated in the worker. */
  | { kind: "files"; files: starl.Files; options: starl.Options }
  /** The run that `starl run --open` holds; simulated by the command. */
  | { kind: "server"; opened: ServerRun }
  /** A trace, read as it is needed. */
  | { kind: "trace"; name: string; from: string | Blob }
  /** A trace of a fleet that runs, which the server sends as it grows. */
  | { kind: "fleet"; name: string; from: string }
  /** The run of the trace that is shown, simulated again in the worker. */
  | { kind: "again" };

/** The answer of the server about its run. */
export interface ServerRun {
  simulation: number;
  title: string;
  seed: string;
  duration: number;
  step_length: number;
  warnings: starl.Diagnostic[];
}

/** The kind of a run. */
export interface Opened {
  title: string;
  seed: string;
  /** When the run ends at the latest, s. */
  duration: number;
  /** The length of a physics step, s. */
  stepLength: number;
  warnings: starl.Diagnostic[];
  fleet: starl.Member[];
  world: starl.World;
  /** Whether it is simulated, so that it can be steered and robots can be looked into; otherwise it is recorded. */
  live: boolean;
}

/** Stops the run. */
export type Breakpoint =
  | { action: { name: string; robot: number | null } }
  | { message: { name: string | null; robot: number | null } }
  | { when: { expression: string } };

/** Where a run was stopped by a breakpoint. */
export interface Stopped {
  breakpoint: number;
  at: number;
  robot: number | null;
  text: string;
}

/** The changes since the last update. */
export interface Update {
  /** The moment shown, s. */
  now: number;
  /** How far the run is known, s. */
  known: number;
  /** How many records there are up to the moment shown, of all since the start. */
  position: number;
  /** Whether the run ends at `known`. */
  over: boolean;
  outcome: starl.Outcome | null;
  playing: boolean;
  /** The frame of the moment shown, null if it is to be made from those around it: time, number of robots, POSE_NUMBERS for each. */
  frame: Float64Array | null;
  /** New frames in the order of their times, one after the other, each as `frame`. */
  frames: Float64Array | null;
  /** New records in the order of their times, without poses and estimates. */
  records: (starl.TraceRecord & { place?: number })[];
  /** These records replace all frequent ones before `to`; applies before what is new. Only of long traces. */
  window: { records: (starl.TraceRecord & { place: number })[]; to: number } | null;
  /** Messages by the second, where not all records reach the page. */
  rates: { sent: number[]; delivered: number[]; lost: number[] } | null;
  /** New values of shared variables, by the hashes that records have for them. */
  values: starl.SharedValue[];
  /** Everything later than this moment is no longer so, because the run was steered. Applies before what is new. */
  cut: number | null;
  /** Where programs are, by robot. */
  states: (string | null)[];
  fleet: starl.Member[] | null;
  world: starl.World | null;
  /** The robots that are looked into. */
  robots: starl.Robot[];
  report: starl.Report | null;
  stopped: Stopped | null;
  /** Simulated seconds in a second, while it plays. */
  pace: number;
}

/** The requests of the page to the worker; each is answered by its `id`. */
export type Request =
  | { open: Source }
  /** Speed is in simulated seconds a second; Infinity is as fast as it goes. */
  | { play: { speed: number } }
  | { pause: true }
  | { seek: number }
  /** To the next step of physics. */
  | { step: true }
  /** Forward to the next moment at which something is recorded on one of these topics. */
  | { next: { topics: string[] } }
  | { inspect: number[] }
  | { breakpoints: Breakpoint[] }
  | { apply: starl.Intervention }
  | { scenario: true }
  | { report: true }
  | { trace: true }
  | { check: starl.Files }
  | { examples: true }
  /** A request of the simulator that is passed on unchanged. */
  | { raw: unknown };

export type ToWorker =
  | { id: number; request: Request }
  /** The answer to `needs`. */
  | { module: WebAssembly.Module }
  | { noModule: string }
  /** The answer to `needs`: all updates before it are shown. */
  | { heard: true }
  /** The answer to `needs`: the page makes a picture. */
  | { drawn: true };

/** An answer of the page that a worker waits for. */
export type Needed = "module" | "hearing" | "picture";

export type FromWorker =
  | { id: number; ok: unknown }
  | { id: number; error: { message: string; diagnostics: starl.Diagnostic[] } }
  | { update: Update }
  /**
   * The module, to simulate with; an answer when the page has taken all updates, so that they do not pile up; an answer
   * when it makes its next picture.
   */
  | { needs: Needed }
  /** An error without a request; the run cannot continue. */
  | { failed: string };
