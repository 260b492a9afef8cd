// The panel in which many runs are made, with many seeds and kinds of faults.

import { useEffect } from "preact/hooks";
import { download } from "../app/download.ts";
import { project } from "../project/project.ts";
import { Distribution } from "./Distribution.tsx";
import { Failures } from "./Failures.tsx";
import { Outcomes } from "./Outcomes.tsx";
import { csvOf } from "./results.ts";
import { Settings } from "./Settings.tsx";
import * as state from "./sweep.ts";
import { left, loadProfiles, outdated, passed, problem, running, start, stop, sweep } from "./sweep.ts";
import "../styles/sweep.css";

export function Sweep() {
  useEffect(() => {
    void loadProfiles().catch((error) => {
      problem.value = error;
    });
  }, []);
  void state.shown.value;
  const results = sweep.value?.results;
  const wrong = state.seedsProblem.value ?? state.firstSeedProblem.value;
  return (
    <div class="sweep">
      <p class="muted">
        Runs the project many times, each with another seed and with faults that the seed draws, and shows
        what went wrong.
      </p>
      <Settings />
      <div class="tools">
        {running.value ? (
          <button type="button" onClick={stop}>
            Stop the sweep
          </button>
        ) : (
          <button
            type="button"
            class="primary"
            disabled={wrong !== null || state.chosen.value.length === 0}
            onClick={() => void start()}
          >
            Start the sweep
          </button>
        )}
        <button
          type="button"
          disabled={!results || results.runs.length === 0}
          onClick={() =>
            results && download(`${nameOf(project.value.name)}-sweep.csv`, "text/csv", csvOf(results.runs))
          }
        >
          Save as CSV
        </button>
      </div>
      <Progress />
      <Problem />
      {outdated.value && !running.value && (
        <p class="note">The project has changed since: these are the runs of the project as it was.</p>
      )}
      {results && results.runs.length > 0 && (
        <>
          <Failures />
          <Outcomes />
          <Distribution />
        </>
      )}
    </div>
  );
}

const nameOf = (title: string): string => title.toLowerCase().replace(/[^a-z0-9]+/g, "-");

function Progress() {
  const current = sweep.value;
  if (!current) return null;
  const { results, total } = current;
  const done = results.runs.length;
  const rate = passed.value > 0 ? Math.round(done / passed.value) : 0;
  return (
    <div class="progress">
      <progress max={total} value={done} aria-label="Runs that are done" />
      <span role="status">
        {done} of {total} runs
        {running.value
          ? left.value !== null && `, about ${time(left.value)} left`
          : `${done < total ? ", stopped" : ""}, ${time(passed.value)}, ${rate} runs a second`}
      </span>
    </div>
  );
}

function time(seconds: number): string {
  if (seconds < 10) return `${seconds.toFixed(1)} s`;
  return seconds < 120 ? `${Math.round(seconds)} s` : `${Math.round(seconds / 60)} min`;
}

function Problem() {
  const found = problem.value;
  if (!found) return null;
  return (
    <div class="wrong-note" role="alert">
      <p>{found.message}</p>
      <ul class="plain">
        {found.diagnostics.slice(0, 5).map(({ file, line, message }) => (
          <li key={`${file}:${line}:${message}`}>
            {file && `${file}:${line}: `}
            {message}
          </li>
        ))}
      </ul>
    </div>
  );
}
