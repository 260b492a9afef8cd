// A project: the files that a person writes, and what of them is run.

import type { Diagnostic, Options } from "../engine/types.ts";

export interface Project {
  id: string;
  name: string;
  /** Texts by path. */
  files: Record<string, string>;
  /** The path of the file that is shown. */
  active: string;
  /** The path of the scenario that is run; null for the default one, an empty floor with a few robots. */
  scenario: string | null;
  /** The example that it is a copy of. */
  example: string | null;
  /** Whether a person has changed anything. */
  touched: boolean;
  /** ms since 1970 */
  changed: number;
}

export const LIMITS = { files: 64, characters: 2_000_000, path: 120 };

export type Kind = "program" | "library" | "scenario" | "other";

export function kindOf(path: string, text: string): Kind {
  if (path.endsWith(".toml")) return "scenario";
  if (!path.endsWith(".starl")) return "other";
  return /^\s*library\b/m.test(text.replace(/\/\/.*$/gm, "")) ? "library" : "program";
}

export const pathsOf = (files: Record<string, string>, kind: Kind): string[] =>
  Object.keys(files).filter((path) => kindOf(path, files[path] ?? "") === kind);

/** Why a file cannot have this path; null if it can. */
export function pathProblem(path: string): string | null {
  if (path === "") return "A file needs a name.";
  if (path.length > LIMITS.path) return `The name is longer than ${LIMITS.path} characters.`;
  if (!/^[\p{L}\p{N}_./ -]+$/u.test(path)) return "Use letters, digits, spaces and _ - . / only.";
  const parts = path.split("/");
  if (parts.some((part) => part.trim() === "" || part === "." || part === ".." || part !== part.trim())) {
    return "Write a path such as worlds/room.wpt.";
  }
  if (Object.hasOwn(Object.prototype, path)) return "This name is reserved.";
  return null;
}

/** The opened target among the files. */
export function optionsOf({ files, scenario, active }: Project, seed: string): Options {
  const options: Options = {};
  if (seed !== "") options.seed = seed;
  if (scenario !== null && files[scenario] !== undefined) return { ...options, scenario };
  const programs = pathsOf(files, "program");
  const program = programs.includes(active) ? active : programs[0];
  return program === undefined ? options : { ...options, program };
}

/** The scenario that is run, if the one that was chosen is no longer there. */
export function scenarioOf(files: Record<string, string>, chosen: string | null): string | null {
  if (chosen !== null && files[chosen] !== undefined) return chosen;
  return pathsOf(files, "scenario")[0] ?? null;
}

/** Why a project cannot be run: errors of the files that take part in the run. */
export function errorsOf({ files, scenario }: Project, diagnostics: Diagnostic[]): Diagnostic[] {
  return diagnostics.filter(
    ({ file, severity }) =>
      severity === "error" &&
      (file === null || file === scenario || kindOf(file, files[file] ?? "") !== "scenario"),
  );
}
