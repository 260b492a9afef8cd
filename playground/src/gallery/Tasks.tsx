// The tasks for learning, which run in Python: each with a picture; a click shows its code.

import { signal } from "@preact/signals";
import { Dialog } from "../project/Dialog.tsx";
import { type Task, taskOf } from "./tasks.ts";

const PICTURES: Record<string, string> = import.meta.glob("../../../docs/pictures/tasks/*.svg", {
  query: "?url",
  import: "default",
  eager: true,
});

const SOURCES: Record<string, string> = import.meta.glob(
  "../../../apps/starl-py/python/starl/env/tasks/[a-z]*.py",
  { query: "?raw", import: "default", eager: true },
);

const TASKS: Task[] = Object.values(SOURCES).map(taskOf);

const shown = signal<Task | null>(null);

export function Tasks() {
  const task = shown.value;
  return (
    <section>
      <h2>Learning tasks, in Python</h2>
      <ul class="cards">
        {TASKS.map((each) => (
          <li key={each.name}>
            <button
              type="button"
              class="card"
              onClick={() => {
                shown.value = each;
              }}
            >
              <Picture task={each} />
              <span class="name">{each.name}</span>
              <span class="muted">{each.summary}</span>
            </button>
          </li>
        ))}
      </ul>
      {task && (
        <Dialog
          title={task.name}
          close={() => {
            shown.value = null;
          }}
        >
          <div class="task">
            <Picture task={task} />
            <p>{task.rules}</p>
            <p class="muted">
              Tasks run in Python, not in the browser: <code>pip install starl[env]</code>, then{" "}
              <code>VectorEnv(tasks.{task.name}(), num_envs=4096)</code> with <code>starl.env</code>.
            </p>
            <pre>{task.code}</pre>
          </div>
        </Dialog>
      )}
    </section>
  );
}

function Picture({ task }: { task: Task }) {
  const picture = PICTURES[`../../../docs/pictures/tasks/${task.name.toLowerCase()}.svg`];
  return <img src={picture} alt="" width="240" height="150" loading="lazy" />;
}
