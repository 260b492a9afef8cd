// The files of the project.

import { signal } from "@preact/signals";
import { Dialog } from "../project/Dialog.tsx";
import { kindOf, pathsOf } from "../project/model.ts";
import { addFile, chooseScenario, project, removeFile, renameFile, show } from "../project/project.ts";
import { reading } from "./jump.ts";
import { templateOf } from "./templates.ts";

const naming = signal<{ path: string | null; name: string; problem: string | null } | null>(null);

export function FileTabs({ faulty }: { faulty: Set<string> }) {
  const { files, active, scenario } = project.value;
  const several = pathsOf(files, "scenario").length > 1;
  const read = reading.value;
  return (
    <nav class="files" aria-label="Files">
      {Object.keys(files).map((path) => (
        <button
          key={path}
          type="button"
          class="file"
          aria-pressed={!read && path === active}
          onClick={() => {
            reading.value = null;
            show(path);
          }}
          onDblClick={() => ask(path)}
          title={faulty.has(path) ? `${path}: has errors` : path}
        >
          {path}
          {faulty.has(path) && <span class="fault-mark" />}
          {several && path === scenario && <span class="badge">runs</span>}
        </button>
      ))}
      {read && (
        <button
          type="button"
          class="file"
          aria-pressed="true"
          onClick={() => (reading.value = null)}
          title="Close"
        >
          {read.path} <span class="badge">read only</span> ✕
        </button>
      )}
      <button type="button" class="icon" title="Add a file" aria-label="Add a file" onClick={() => ask(null)}>
        +
      </button>
      {active !== "" && !read && (
        <button type="button" class="icon" onClick={() => ask(active)}>
          Rename
        </button>
      )}
      {several && active !== scenario && kindOf(active, "") === "scenario" && (
        <button type="button" onClick={() => chooseScenario(active)}>
          Run this scenario
        </button>
      )}
      <Naming />
    </nav>
  );
}

function ask(path: string | null): void {
  naming.value = { path, name: path ?? "", problem: null };
}

function Naming() {
  const asked = naming.value;
  if (!asked) return null;
  const close = () => {
    naming.value = null;
  };
  const { path } = asked;
  const submit = (event: Event) => {
    event.preventDefault();
    const name = asked.name.trim();
    const problem = path === null ? addFile(name, templateOf(name)) : renameFile(path, name);
    naming.value = problem ? { ...asked, problem } : null;
  };
  return (
    <Dialog title={path === null ? "Add a file" : `Rename ${path}`} close={close}>
      <form onSubmit={submit} class="naming">
        <label>
          Name
          <input
            value={asked.name}
            placeholder="program.starl"
            onInput={(event) => {
              naming.value = { ...asked, name: event.currentTarget.value, problem: null };
            }}
          />
        </label>
        {asked.problem && (
          <p class="error" role="alert">
            {asked.problem}
          </p>
        )}
        <p class="muted">
          Programs and libraries end in .starl, scenarios in .toml, files of waypoints and obstacles in .wpt.
        </p>
        <div class="row">
          <button type="submit" class="primary">
            {path === null ? "Add" : "Rename"}
          </button>
          <button type="button" onClick={close}>
            Cancel
          </button>
          <span class="spread" />
          {path !== null && (
            <button
              type="button"
              onClick={() => {
                if (!confirm(`Delete ${path}? This cannot be undone.`)) return;
                removeFile(path);
                close();
              }}
            >
              Delete this file
            </button>
          )}
        </div>
      </form>
    </Dialog>
  );
}
