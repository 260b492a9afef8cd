// The steps of the lesson, and which are done.

import { goTo, progress, startOver } from "./lesson.ts";
import { STEPS } from "./steps.tsx";
import "../styles/lesson.css";

export function Lesson() {
  const { step, done, project } = progress.value;
  const count = STEPS.filter((_, index) => done[index]).length;
  const next = STEPS.findIndex((_, index) => !done[index]);
  return (
    <div class="lesson">
      <h2>Your first program</h2>
      <p>
        In ten minutes you run a program, find two mistakes with the help of the checker and the simulator,
        turn robots into a team, break one of them, and write a program of your own. There is nothing to
        install.
      </p>
      <div class="row">
        <button
          type="button"
          class="primary"
          onClick={() => (project ? goTo(next < 0 ? step : next) : startOver())}
        >
          {project ? "Go on" : "Begin"}
        </button>
        {project && (
          <button type="button" onClick={startOver}>
            Start over
          </button>
        )}
        <span class="muted">
          {count} of {STEPS.length} done
        </span>
      </div>
      <progress max={STEPS.length} value={count} aria-label="Steps that are done" />
      <ol>
        {STEPS.map(({ title }, index) => (
          <li key={title}>
            <button
              type="button"
              onClick={() => goTo(index)}
              aria-current={project !== null && index === step ? "step" : undefined}
            >
              {title}
              {done[index] && <span class="good"> – done</span>}
            </button>
          </li>
        ))}
      </ol>
    </div>
  );
}
