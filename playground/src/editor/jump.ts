// Shows a place in a file.

import { batch, signal } from "@preact/signals";
import { benchTab, part } from "../app/shown.ts";
import type { Diagnostic } from "../engine/types.ts";
import { project, show } from "../project/project.ts";
import { type Range, units } from "./offsets.ts";

/** A file that is not part of the project and is only read. */
export const reading = signal<{ path: string; text: string } | null>(null);

/** The place that the editor is to show, until it does. */
export const target = signal<{ path: string; range: Range } | null>(null);

export function goTo(path: string, range: Range, text: string | null = null): void {
  batch(() => {
    if (project.value.files[path] === undefined) {
      if (text === null) return;
      reading.value = { path, text };
    } else {
      reading.value = null;
      show(path);
    }
    benchTab.value = "program";
    part.value = "write";
    target.value = { path, range };
  });
}

export function goToDiagnostic({ file, line, column, end_line, end_column }: Diagnostic): void {
  if (file === null) return;
  const lines = (project.value.files[file] ?? "").split("\n");
  const place = (line: number, column: number) => ({
    line: line - 1,
    character: units(lines[line - 1] ?? "", column - 1),
  });
  goTo(file, { start: place(line, column), end: place(end_line, end_column) });
}
