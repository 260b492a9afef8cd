// Shows what a link holds, before anything of it is opened.

import { signal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { benchTab } from "../app/shown.ts";
import { Dialog } from "../project/Dialog.tsx";
import { project, start } from "../project/project.ts";
import { runProject, seed } from "../project/running.ts";
import type { Shared } from "./link.ts";

const incoming = signal<Shared | null>(null);
const problem = signal<string | null>(null);

/** Looks at the address of the page, and takes the link out of it. */
async function look(): Promise<void> {
  const fragment = location.hash.slice(1);
  if (!fragment.startsWith("p=")) return;
  history.replaceState(null, "", location.pathname + location.search);
  const { BadLink, read } = await import("./link.ts");
  try {
    incoming.value = read(fragment);
  } catch (error) {
    problem.value = error instanceof BadLink ? error.message : "This link cannot be read.";
  }
}

export function Incoming() {
  useEffect(() => {
    void look();
    addEventListener("hashchange", look);
    return () => removeEventListener("hashchange", look);
  }, []);
  const close = () => {
    incoming.value = null;
    problem.value = null;
  };
  if (problem.value) {
    return (
      <Dialog title="This link cannot be opened" close={close}>
        <p role="alert">{problem.value}</p>
        <button type="button" class="primary" onClick={close}>
          Close
        </button>
      </Dialog>
    );
  }
  const shared = incoming.value;
  if (!shared) return null;
  const accept = () => {
    const { seed: theirs, ...draft } = shared;
    close();
    start({ ...draft, touched: true });
    seed.value = theirs;
    benchTab.value = "program";
    void runProject({ play: false });
  };
  return (
    <Dialog title={`Open "${shared.name}"?`} close={close}>
      <p>
        Somebody has shared this project with you. It runs in this page only and cannot reach anything else.
      </p>
      <ul class="shared-files">
        {Object.entries(shared.files).map(([path, text]) => (
          <li key={path}>
            <span class="mono">{path}</span> <span class="muted">{text.split("\n").length} lines</span>
          </li>
        ))}
      </ul>
      {project.value.touched && (
        <p class="muted">"{project.value.name}" is kept: see Your programs under Examples.</p>
      )}
      <div class="row">
        <button type="button" class="primary" onClick={accept}>
          Open
        </button>
        <button type="button" onClick={close}>
          Cancel
        </button>
      </div>
    </Dialog>
  );
}
