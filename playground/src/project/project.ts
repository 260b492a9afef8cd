// The project that the page shows, and everything that is done to it. Every change is kept in the browser at once.

import { batch, effect, signal } from "@preact/signals";
import { type Project, pathProblem, scenarioOf } from "./model.ts";
import * as storage from "./storage.ts";

/** Between a change and its being kept, ms. */
const REST = 300;

const FIRST = `/// Robots drive to the first waypoint.
program Hello

motion = ReachAvoid()

go()
    pre not motion.active and not motion.done and some place = way_points().first()
    eff motion.reach_avoid(place, obstacles())

arrive()
    pre motion.done
    eff finish()
`;

export type Draft = Pick<Project, "name" | "files"> &
  Partial<Pick<Project, "active" | "scenario" | "example" | "touched">>;

function make(draft: Draft): Project {
  const scenario = scenarioOf(draft.files, draft.scenario ?? null);
  const programs = Object.keys(draft.files).filter((path) => path.endsWith(".starl"));
  const named =
    scenario && programs.find((path) => path.replace(".starl", "") === scenario.replace(".toml", ""));
  return {
    id: crypto.randomUUID?.() ?? `${Date.now()}-${Math.random()}`,
    name: draft.name,
    files: draft.files,
    active: draft.active ?? named ?? programs[0] ?? Object.keys(draft.files)[0] ?? "",
    scenario,
    example: draft.example ?? null,
    touched: draft.touched ?? false,
    changed: Date.now(),
  };
}

export const emptyDraft = (): Draft => ({ name: "My program", files: { "hello.starl": FIRST } });

const kept = storage.load(storage.current() ?? "");

/** Whether this page was opened with a project of an earlier visit. */
export const returning = kept !== null;
export const project = signal<Project>(kept ?? make(emptyDraft()));
/** The projects that are kept, the latest first. */
export const recent = signal(storage.list());
/** Why the project is not kept. */
export const notKept = signal<string | null>(null);

let waiting: ReturnType<typeof setTimeout> | undefined;

function keep(): void {
  clearTimeout(waiting);
  waiting = undefined;
  try {
    storage.save(project.peek());
    notKept.value = null;
  } catch {
    notKept.value = "The browser has no room left to keep this project. Download it, or delete old ones.";
  }
  recent.value = storage.list();
}

effect(() => {
  if (!project.value.touched && !project.value.example) return;
  clearTimeout(waiting);
  waiting = setTimeout(keep, REST);
});
addEventListener("pagehide", () => waiting !== undefined && keep());

function change(changes: Partial<Project>): void {
  project.value = { ...project.value, ...changes, touched: true, changed: Date.now() };
}

/** Opens a new project. The previous one is kept if it was changed. */
export function start(draft: Draft): void {
  leave();
  project.value = make(draft);
}

export function open(id: string): boolean {
  const found = storage.load(id);
  if (!found) return false;
  leave();
  storage.setCurrent(id);
  project.value = found;
  return true;
}

function leave(): void {
  const { touched, id } = project.peek();
  if (touched) {
    keep();
    return;
  }
  clearTimeout(waiting);
  waiting = undefined;
  storage.remove(id);
  recent.value = storage.list();
}

export function forget(id: string): void {
  storage.remove(id);
  recent.value = storage.list();
  if (id !== project.peek().id) return;
  const next = recent.value[0];
  const found = next && storage.load(next.id);
  project.value = found || make(emptyDraft());
}

export const rename = (name: string): void => change({ name: name.trim() || "Without a name" });

export function setText(path: string, text: string): void {
  if (project.peek().files[path] !== text) change({ files: { ...project.peek().files, [path]: text } });
}

export function show(path: string): void {
  const shown = project.peek();
  if (shown.files[path] !== undefined && shown.active !== path) project.value = { ...shown, active: path };
}

/** Returns why it cannot be added. */
export function addFile(path: string, text: string): string | null {
  const { files, scenario } = project.peek();
  const problem = refuse(path, files);
  if (problem) return problem;
  const all = { ...files, [path]: text };
  change({ files: all, active: path, scenario: scenarioOf(all, scenario) });
  return null;
}

/** Returns why it cannot be renamed. */
export function renameFile(path: string, to: string): string | null {
  if (path === to) return null;
  const { files, active, scenario } = project.peek();
  const problem = refuse(to, files);
  if (problem) return problem;
  const all = Object.fromEntries(
    Object.entries(files).map(([name, text]) => [name === path ? to : name, text]),
  );
  const follow = (name: string | null) => (name === path ? to : name);
  change({ files: all, active: follow(active) ?? to, scenario: scenarioOf(all, follow(scenario)) });
  return null;
}

export function removeFile(path: string): void {
  const { [path]: _, ...files } = project.peek().files;
  const { active, scenario } = project.peek();
  batch(() => {
    change({ files, scenario: scenarioOf(files, scenario) });
    if (active === path) project.value = { ...project.value, active: Object.keys(files)[0] ?? "" };
  });
}

export const chooseScenario = (path: string): void => change({ scenario: path });

function refuse(path: string, files: Record<string, string>): string | null {
  return pathProblem(path) ?? (files[path] === undefined ? null : `There is a file ${path} already.`);
}
