// The problems of the compiler and the scenario reader, as you type.

import { effect, signal } from "@preact/signals";
import { run } from "../app/context.ts";
import type { Diagnostic, Files } from "../engine/types.ts";
import { project } from "./project.ts";

/** After the last key, ms. */
const REST = 250;

export const diagnostics = signal<Diagnostic[]>([]);
/** The files that the diagnostics are about. */
export const checked = signal<Files | null>(null);

export async function check(files: Record<string, string>): Promise<Diagnostic[]> {
  const found = await run.client.ask<Diagnostic[]>({ check: files });
  if (project.peek().files === files) {
    diagnostics.value = found;
    checked.value = files;
  }
  return found;
}

let waiting: ReturnType<typeof setTimeout> | undefined;
let last: Files | null = null;

/** Begins to check whenever files change. */
export function keepChecking(): () => void {
  return effect(() => {
    const { files } = project.value;
    if (files === last) return;
    last = files;
    clearTimeout(waiting);
    waiting = setTimeout(() => check(files).catch(() => undefined), REST);
  });
}
