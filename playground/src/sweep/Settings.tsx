// How many runs are made, and with which kinds of faults.

import type { Signal } from "@preact/signals";
import { chosen, firstSeed, firstSeedProblem, profiles, running, seeds, seedsProblem } from "./sweep.ts";

export function Settings() {
  const toggle = (name: string, on: boolean) => {
    chosen.value = on ? [...chosen.value, name] : chosen.value.filter((other) => other !== name);
  };
  return (
    <fieldset class="settings" disabled={running.value}>
      <legend class="visually-hidden">Settings of the sweep</legend>
      <div class="numbers">
        <Whole label="Seeds" value={seeds} problem={seedsProblem.value} />
        <Whole label="First seed" value={firstSeed} problem={firstSeedProblem.value} />
      </div>
      <fieldset class="profiles">
        <legend class="visually-hidden">Profiles of faults</legend>
        {profiles.value.map(({ name, summary }) => (
          <label key={name}>
            <input
              type="checkbox"
              checked={chosen.value.includes(name)}
              onChange={(event) => toggle(name, event.currentTarget.checked)}
            />
            <strong>{name}</strong>
            <span class="muted">{summary}</span>
          </label>
        ))}
      </fieldset>
    </fieldset>
  );
}

function Whole({ label, value, problem }: { label: string; value: Signal<string>; problem: string | null }) {
  return (
    <label>
      <span>{label}</span>
      <input
        value={value.value}
        inputMode="numeric"
        size={6}
        maxLength={10}
        aria-invalid={problem !== null}
        onInput={(event) => {
          value.value = event.currentTarget.value.trim();
        }}
      />
      {problem && <span class="wrong-text">{problem}</span>}
    </label>
  );
}
