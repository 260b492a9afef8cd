// The singletons of the page: the run that is shown, and the purpose of the page.

import { signal } from "@preact/signals";
import type { ServerRun } from "../engine/types.ts";
import { Run } from "../run/run.ts";

export const run = new Run();

/** The purpose of the page: opened by a static host or `starl web`, by `starl run --open`, or by `starl view`. */
export type Start =
  /** `static`: by a host of files, which can be done without once the page is loaded. */
  | { mode: "web"; static?: boolean }
  | { mode: "run"; opened: ServerRun; files: Record<string, string> }
  | { mode: "trace"; name: string; size: number }
  | { mode: "fleet"; name: string }
  /** By a page that holds a trace, which it shows or, if it is `live`, simulates again. */
  | { mode: "embedded"; name: string; live: boolean };

export const start = signal<Start>({ mode: "web" });

/** Whether the page is about to open a run. The world is made ready while the run is. */
export const expectsRun = signal(false);

/** Asks the host of the page what it was opened for. A static host answers with public/start.json. */
export async function askHost(): Promise<Start> {
  try {
    const answer = await fetch("start.json", { cache: "no-store" });
    if (answer.ok && answer.headers.get("content-type")?.includes("json")) return await answer.json();
  } catch {
    // Offline, or served from a folder.
  }
  return { mode: "web" };
}
