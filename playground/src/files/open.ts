// Opens files of the person's machine: a trace is played as it is read, programs and scenarios become a project, of
// which the first scenario is run. Nothing is uploaded.

import { run } from "../app/context.ts";
import { benchTab, part } from "../app/shown.ts";
import { EngineError } from "../engine/client.ts";
import { LIMITS, pathProblem } from "../project/model.ts";
import { start } from "../project/project.ts";
import { runProject, seed } from "../project/running.ts";

/** For the dialog of the browser. */
export const ACCEPTED = ".mcap,.starl,.toml,.wpt,.zip";

const isTrace = ({ name }: File): boolean => name.toLowerCase().endsWith(".mcap");
const isArchive = ({ name }: File): boolean => name.toLowerCase().endsWith(".zip");

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
  const size = files.reduce((sum, file) => sum + file.size, 0);
  if (size > LIMITS.characters) throw new EngineError("These files are larger than 2 MB.");
  const contents: Record<string, Uint8Array> = {};
  for (const file of files) {
    const content = new Uint8Array(await file.arrayBuffer());
    Object.assign(contents, isArchive(file) ? await unpacked(file.name, content) : { [file.name]: content });
  }
  const count = Object.keys(contents).length;
  if (count > LIMITS.files) throw new EngineError(`These are ${count} files; open at most ${LIMITS.files}.`);
  const texts: Record<string, string> = {};
  for (const [path, content] of Object.entries(contents)) {
    const problem = pathProblem(path);
    if (problem) throw new EngineError(`${path}: ${problem}`);
    texts[path] = textOf(path, content);
  }
  if (!Object.keys(texts).some((name) => /\.(starl|toml)$/.test(name)))
    throw new EngineError(
      "Open a trace (.mcap), a program (.starl), a scenario (.toml), or an archive of them (.zip).",
    );
  const archive = files.find(isArchive)?.name;
  const [first = "project"] = archive ? [archive] : Object.keys(texts).sort();
  seed.value = "";
  start({ name: first.replace(/\.\w+$/, ""), files: texts, touched: true });
  benchTab.value = "program";
  await runProject({ play: false });
}

async function unpacked(name: string, content: Uint8Array): Promise<Record<string, Uint8Array>> {
  const { unzip } = await import("../share/zip.ts");
  try {
    return unzip(content, LIMITS.characters);
  } catch (error) {
    throw new EngineError(`${name}: this archive cannot be opened: ${(error as Error).message}.`);
  }
}

function textOf(path: string, content: Uint8Array): string {
  try {
    return new TextDecoder("utf-8", { fatal: true }).decode(content);
  } catch {
    throw new EngineError(`${path}: this is not a text file.`);
  }
}
