// Runs what is written: the button, and the seed.

import { useEffect } from "preact/hooks";
import { run } from "../app/context.ts";
import "../styles/project.css";
import { drawSeed, runProject, seed, seedProblem, starting } from "./running.ts";

export function RunBar() {
  useEffect(() => {
    const onKeyDown = (event: KeyboardEvent) => {
      if (event.key !== "Enter" || !(event.ctrlKey || event.metaKey)) return;
      event.preventDefault();
      void runProject();
    };
    addEventListener("keydown", onKeyDown);
    return () => removeEventListener("keydown", onKeyDown);
  }, []);
  const wrong = seedProblem(seed.value);
  return (
    <div class="run-bar">
      <label class="seed">
        <span class="label muted">Seed</span>
        <input
          value={seed.value}
          placeholder={run.opened.value?.seed ?? "1"}
          inputMode="numeric"
          size={6}
          maxLength={19}
          aria-invalid={wrong !== null}
          title={wrong ?? "Decides every random draw. Empty: the scenario's seed."}
          onInput={(event) => {
            seed.value = event.currentTarget.value.trim();
          }}
        />
      </label>
      <button
        type="button"
        class="another"
        title="Draw another seed and run"
        onClick={() => {
          drawSeed();
          void runProject();
        }}
      >
        New seed
      </button>
      <button
        type="button"
        class="primary run"
        aria-busy={starting.value}
        onClick={() => runProject()}
        title="Run the program with this seed (Ctrl+Enter)"
      >
        Run
      </button>
    </div>
  );
}
