// The diagnostics of the files.

import { diagnostics } from "../project/checking.ts";
import { explain } from "./explain.tsx";
import { goToDiagnostic } from "./jump.ts";

const SHOWN = 50;

export function Problems() {
  const found = diagnostics.value;
  if (found.length === 0) {
    return (
      <p class="problems-none muted" role="status">
        No problems
      </p>
    );
  }
  const errors = found.filter(({ severity }) => severity === "error").length;
  return (
    <section class="problems" aria-label="Problems">
      <p role="status" class="muted">
        {[count(errors, "error"), count(found.length - errors, "warning")].filter(Boolean).join(", ")}
      </p>
      <ul>
        {found.slice(0, SHOWN).map((diagnostic) => {
          const { file, line, column, severity, code, message, help, field } = diagnostic;
          return (
            <li key={`${file}:${line}:${column}:${message}`} class={severity}>
              <button type="button" onClick={() => goToDiagnostic(diagnostic)}>
                <span class="where">
                  {severity === "error" ? "Error" : "Warning"} {file}:{line}
                </span>{" "}
                {field && `${field}: `}
                {message}
                {help && <span class="muted">; {help}</span>}
              </button>
              {code && (
                <button type="button" class="code" onClick={() => explain(code)} aria-label={`About ${code}`}>
                  {code}
                </button>
              )}
            </li>
          );
        })}
      </ul>
    </section>
  );
}

const count = (number: number, what: string) => number > 0 && `${number} ${what}${number === 1 ? "" : "s"}`;
