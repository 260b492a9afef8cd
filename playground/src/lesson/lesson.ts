// How far a person has come in the lesson.

import { computed, effect, signal } from "@preact/signals";
import { run } from "../app/context.ts";
import { benchTab } from "../app/shown.ts";
import { checked, diagnostics } from "../project/checking.ts";
import { addFile, open, project, setText, show, start } from "../project/project.ts";
import { remember, remembered } from "../project/storage.ts";
import { content } from "../scenario/document.ts";
import { type Seen, STEPS } from "./steps.tsx";

interface Progress {
  step: number;
  /** By step. */
  done: boolean[];
  /** The project in which it is done. */
  project: string | null;
  /** Whether its steps are shown above what is written. */
  isOpen: boolean;
}

const FRESH: Progress = { step: 0, done: [], project: null, isOpen: false };

function before(): Progress {
  const found = remembered("lesson") as Partial<Progress> | null;
  const isValid =
    Number.isInteger(found?.step) && Array.isArray(found?.done) && STEPS[found?.step ?? -1] !== undefined;
  return isValid ? { ...FRESH, ...found } : FRESH;
}

export const progress = signal<Progress>(before());
effect(() => remember("lesson", progress.value));

const NAME = "First lesson";

const change = (changes: Partial<Progress>): void => {
  progress.value = { ...progress.peek(), ...changes };
};

export const step = computed(() => STEPS[progress.value.step] ?? STEPS[0]);

/** Whether the project that is shown is the lesson's. */
export const isShown = computed(() => progress.value.isOpen && progress.value.project === project.value.id);

const seen = computed<Seen>(() => {
  const { files } = project.value;
  const source = run.source.value;
  const isCurrent = run.opened.value !== null && source?.kind === "files" && source.files === files;
  return {
    files,
    scenario: content.value,
    diagnostics: checked.value === files ? diagnostics.value : null,
    run: isCurrent
      ? {
          now: run.now.value,
          over: run.over.value,
          outcome: run.outcome.value,
          report: run.report.value,
          down: run.fleet.value.some(({ condition }) => condition === "down"),
        }
      : null,
  };
});

effect(() => {
  if (!isShown.value) return;
  const { step: index, done } = progress.value;
  if (done[index] || !STEPS[index]?.isDone(seen.value)) return;
  const now = [...done];
  now[index] = true;
  change({ done: now });
});

/** Begins with a step, in a project of its own if there is none yet. */
export function goTo(index: number): void {
  const wanted = STEPS[index];
  if (!wanted) return;
  change({ step: index, isOpen: true });
  const { done, project: own } = progress.value;
  const given = done[index] ? undefined : wanted.given;
  const isNew = index === 0 || index === STEPS.length - 1;
  if (given && isNew) begin(index === 0 ? NAME : wanted.title, given);
  else if (own !== project.value.id && !(own !== null && open(own))) begin(NAME, givenBefore(index));
  else if (given) write(given);
  benchTab.value = "program";
}

/** The files after all earlier steps. */
function givenBefore(index: number): Record<string, string> {
  return STEPS[index]?.given ?? STEPS[index - 1]?.solution ?? STEPS[0]?.given ?? {};
}

function begin(name: string, files: Record<string, string>): void {
  start({ name, files: { ...files }, touched: true });
  change({ project: project.value.id });
}

function write(files: Record<string, string>): void {
  for (const [path, text] of Object.entries(files)) {
    if (project.value.files[path] === undefined) addFile(path, text);
    else setText(path, text);
  }
}

/** Writes what the step asks for. */
export function solve(): void {
  const { solution } = step.value ?? {};
  if (!solution) return;
  write(solution);
  const [first] = Object.keys(solution);
  if (first) show(first);
}

export const close = (): void => change({ isOpen: false });

export function startOver(): void {
  change({ ...FRESH });
  goTo(0);
}
