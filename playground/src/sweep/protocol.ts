// The requests of a sweep to its workers. Each worker does one thing at a time.

import type * as starl from "../../../apps/starl-wasm/starl.d.mts";

export type { Profile, Shrunk, Tried } from "../../../apps/starl-wasm/starl.d.mts";

/** The subject of the trials. */
export interface Target {
  files: Record<string, string>;
  options: starl.TrialOptions;
}

/** One run: a profile of faults and the seed that they are drawn from. */
export interface Trial {
  profile: string;
  seed: number;
}

export type Ask = { try: Trial } | { shrink: Trial; most: number } | { scenario: Trial };

/** The target comes first. */
export type ToWorker = { target: Target; module: WebAssembly.Module } | { ask: Ask };

export type FromWorker = { ok: unknown } | { error: { message: string; diagnostics: starl.Diagnostic[] } };
