// The projects that the browser keeps.

import { benchTab } from "../app/shown.ts";
import { OpenButton } from "../files/OpenFiles.tsx";
import { emptyDraft, forget, open, project, recent, start } from "./project.ts";

export function Projects() {
  const kept = recent.value;
  return (
    <section class="projects">
      <div class="row">
        <h2>Your programs</h2>
        <span class="spread" />
        <OpenButton />
        <button type="button" onClick={() => begin(() => start(emptyDraft()))}>
          New program
        </button>
      </div>
      {kept.length === 0 && (
        <p class="muted">What you write is kept in this browser. Nothing is sent anywhere.</p>
      )}
      <ul class="recent">
        {kept.slice(0, 12).map(({ id, name, changed }) => (
          <li key={id}>
            <button
              type="button"
              class="entry"
              aria-current={id === project.value.id}
              onClick={() => begin(() => open(id))}
            >
              <span class="name">{name}</span>
              <span class="muted">{when(changed)}</span>
            </button>
            <button
              type="button"
              class="icon"
              aria-label={`Delete ${name}`}
              title="Delete"
              onClick={() => ask(id, name)}
            >
              ✕
            </button>
          </li>
        ))}
      </ul>
    </section>
  );
}

function begin(act: () => void): void {
  act();
  benchTab.value = "program";
}

function ask(id: string, name: string): void {
  if (confirm(`Delete "${name}"? This cannot be undone.`)) forget(id);
}

const when = (time: number) =>
  new Date(time).toLocaleString(undefined, { dateStyle: "medium", timeStyle: "short" });
