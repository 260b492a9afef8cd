// Keeps projects in the browser. Where it may not keep anything, a project lasts as long as the page.

import type { Project } from "./model.ts";

/** A project as the list of recent ones shows it. */
export interface Entry {
  id: string;
  name: string;
  changed: number;
}

const LIST = "starl.projects";
const CURRENT = "starl.current";
const key = (id: string) => `starl.project.${id}`;
const MOST = 50;

/** The projects that are kept, the latest first. */
export function list(): Entry[] {
  const entries = read(LIST);
  if (!Array.isArray(entries)) return [];
  const known = entries.filter(
    (entry): entry is Entry => typeof entry?.id === "string" && typeof entry?.name === "string",
  );
  return known.sort((one, other) => other.changed - one.changed);
}

export function load(id: string): Project | null {
  const found = read(key(id)) as Project | null;
  return found && typeof found.files === "object" && found.id === id ? found : null;
}

/** Throws if the browser does not keep it, for example because there is no room left. */
export function save(project: Project): void {
  localStorage.setItem(key(project.id), JSON.stringify(project));
  const { id, name, changed } = project;
  const entries = [{ id, name, changed }, ...list().filter((entry) => entry.id !== id)];
  for (const { id } of entries.splice(MOST)) localStorage.removeItem(key(id));
  localStorage.setItem(LIST, JSON.stringify(entries));
  setCurrent(id);
}

export function remove(id: string): void {
  attempt(() => {
    localStorage.removeItem(key(id));
    localStorage.setItem(LIST, JSON.stringify(list().filter((entry) => entry.id !== id)));
  });
}

/** The project that this page shows; in a new window, the one that was last shown in any. */
export const current = (): string | null =>
  attempt(() => sessionStorage.getItem(CURRENT) ?? localStorage.getItem(CURRENT)) ?? null;

export function setCurrent(id: string): void {
  attempt(() => {
    sessionStorage.setItem(CURRENT, id);
    localStorage.setItem(CURRENT, id);
  });
}

export const remembered = (name: string): unknown => read(`starl.${name}`);

export function remember(name: string, value: unknown): void {
  attempt(() => localStorage.setItem(`starl.${name}`, JSON.stringify(value)));
}

function read(name: string): unknown {
  return attempt(() => JSON.parse(localStorage.getItem(name) ?? "null")) ?? null;
}

function attempt<Result>(act: () => Result): Result | undefined {
  try {
    return act();
  } catch {
    return undefined;
  }
}
