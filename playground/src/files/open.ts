// Opens files of the person's machine: a trace is played as it is read, programs and scenarios become a project. Nothing
// is uploaded.

import { part } from "../app/App.tsx";
import { benchTab } from "../app/Bench.tsx";
import { run } from "../app/context.ts";
import { EngineError } from "../engine/client.ts";
import { LIMITS, pathProblem } from "../project/model.ts";
import { start } from "../project/project.ts";
import { runProject, seed } from "../project/running.ts";

/** For the dialog of the browser. */
export const ACCEPTED = ".mcap,.starl,.toml,.wpt";

const isTrace = ({ name }: File): boolean => name.toLowerCase().endsWith(".mcap");

/** Files that cannot be opened give a message and change nothing. */
export async function openFiles(files: File[]): Promise<void> {
  try {
    const traces = files.filter(isTrace);
    const [trace] = traces;
    if (!trace) return await openProject(files);
    if (files.length > 1) throw new EngineError("Open one trace at a time, without other files.");
    if (!(await run.open({ kind: "trace", name: trace.name, from: trace }))) return;
    part.value = "world";
  } catch (error) {
    run.complain(error);
  }
}

async function openProject(files: File[]): Promise<void> {
  if (files.length === 0) return;
  if (files.length > LIMITS.files) throw new EngineError(`These are more than ${LIMITS.files} files.`);
  const size = files.reduce((sum, file) => sum + file.size, 0);
  if (size > LIMITS.characters) throw new EngineError("These files are larger than 2 MB.");
  const texts: Record<string, string> = {};
  for (const file of files) {
    const problem = pathProblem(file.name);
    if (problem) throw new EngineError(`${file.name}: ${problem}`);
    texts[file.name] = await textOf(file);
  }
  if (!Object.keys(texts).some((name) => /\.(starl|toml)$/.test(name)))
    throw new EngineError("Open a trace (.mcap), a program (.starl) or a scenario (.toml).");
  const [first = "project"] = Object.keys(texts).sort();
  seed.value = "";
  start({ name: first.replace(/\.\w+$/, ""), files: texts, touched: true });
  benchTab.value = "program";
  await runProject({ play: false });
}

async function textOf(file: File): Promise<string> {
  try {
    return new TextDecoder("utf-8", { fatal: true }).decode(await file.arrayBuffer());
  } catch {
    throw new EngineError(`${file.name}: this is not a text file.`);
  }
}
