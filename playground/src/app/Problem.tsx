// Says what went wrong, and offers to stop a program that keeps the simulator busy.

import { run } from "./context.ts";

export function Problem() {
  if (run.busy.value) {
    return (
      <div class="problem" role="alert">
        <p>The simulator has not answered for ten seconds: a program keeps it busy.</p>
        <button type="button" onClick={() => run.abort()}>
          Stop the run
        </button>
      </div>
    );
  }
  const problem = run.problem.value;
  if (!problem) return null;
  return (
    <div class="problem" role="alert">
      <div>
        <p>{problem.message}</p>
        {problem.diagnostics.length > 0 && (
          <ul>
            {problem.diagnostics.slice(0, 8).map((problem, index) => (
              <li key={index}>
                {problem.file && `${problem.file}:${problem.line}:${problem.column}: `}
                {problem.message}
                {problem.help && <span class="muted">; {problem.help}</span>}
              </li>
            ))}
          </ul>
        )}
      </div>
      <button
        type="button"
        class="icon"
        aria-label="Close the message"
        onClick={() => {
          run.problem.value = null;
        }}
      >
        ✕
      </button>
    </div>
  );
}
