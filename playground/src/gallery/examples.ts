// The examples that come with the simulator. Opening one copies its files into a project.

import { signal } from "@preact/signals";
import { run } from "../app/context.ts";
import { benchTab } from "../app/shown.ts";
import { EngineError } from "../engine/client.ts";
import type { Example } from "../engine/types.ts";
import * as project from "../project/project.ts";
import { runProject, seed } from "../project/running.ts";

export const examples = signal<Example[]>([]);

let asked: Promise<Example[]> | null = null;

export function loadExamples(): Promise<Example[]> {
  asked ??= run.client.ask<Example[]>({ examples: true });
  return asked.then(
    (found) => {
      examples.value = found;
      return found;
    },
    (error) => {
      asked = null;
      throw error;
    },
  );
}

export const titleOf = (example: Example): string =>
  /^title\s*=\s*"(.*)"/m.exec(example.files[example.scenario] ?? "")?.[1] ?? example.name;

/** Copies an example into a project and runs it. */
export async function openExample(name: string, { play = true } = {}): Promise<void> {
  const found = (await loadExamples()).find((example) => example.name === name);
  if (!found) {
    run.problem.value = new EngineError(`There is no example "${name}". The tab Examples shows all.`);
    return;
  }
  const { files, scenario } = found;
  seed.value = "";
  project.start({ name: titleOf(found), files: { ...files }, scenario, example: name });
  benchTab.value = "program";
  await runProject({ play });
}
