// The runs in which something went wrong, and what can be done with one of them.

import { signal } from "@preact/signals";
import { seconds } from "../app/format.ts";
import { VirtualList } from "../inspect/VirtualList.tsx";
import { addFile } from "../project/project.ts";
import { openAsItIs, openedTrial, shrinkAndOpen, shrinking, stopShrinking } from "./open.ts";
import type { Shrunk, Tried } from "./protocol.ts";
import { running, shown, sweep } from "./sweep.ts";

const ROW = 44;
const MOST_ROWS = 5;

/** The run that a person has picked; until then, the first one counts. */
const picked = signal<Tried | null>(null);

export function Failures() {
  void shown.value;
  const current = sweep.value;
  if (!current) return null;
  const { wrong } = current.results;
  if (wrong.length === 0)
    return (
      <p role="status" class="fine">
        {running.value ? "Nothing went wrong so far." : "Nothing went wrong."}
      </p>
    );
  const chosen = picked.value && wrong.includes(picked.value) ? picked.value : wrong[0];
  return (
    <section aria-label="Runs that went wrong">
      <h3>
        {wrong.length} {wrong.length === 1 ? "run" : "runs"} went wrong
      </h3>
      <div class="failures" style={{ height: `${Math.min(wrong.length, MOST_ROWS) * ROW + 2}px` }}>
        <VirtualList
          label="Runs that went wrong"
          count={wrong.length}
          rowHeight={ROW}
          choose={(index) => {
            picked.value = wrong[index] ?? null;
          }}
          selected={(index) => wrong[index] === chosen}
          row={(index) => {
            const tried = wrong[index];
            if (!tried) return null;
            return (
              <span class="grow" title={tried.text}>
                {tried.profile}, seed {tried.seed}: <strong>{whatWentWrong(tried)}</strong> at{" "}
                {seconds(tried.now)}
                <br />
                <span class="muted">{tried.text}</span>
              </span>
            );
          }}
        />
      </div>
      <div class="tools">
        <button
          type="button"
          class="primary"
          disabled={!chosen || shrinking.value !== null}
          onClick={() => chosen && void shrinkAndOpen(current.target, chosen)}
        >
          Shrink and open
        </button>
        <button
          type="button"
          disabled={!chosen || shrinking.value !== null}
          onClick={() => chosen && void openAsItIs(current.target, chosen)}
        >
          Open as it is
        </button>
      </div>
      <ShrinkProgress />
      <Opened />
    </section>
  );
}

function whatWentWrong({ wrong }: Tried): string {
  if (wrong === "failed") return "a program failed";
  return wrong === "unreached" ? "the goal was not reached" : `${wrong} violated`;
}

const sizeOf = ({ robots, faults, duration_seconds }: Shrunk["before"]): string =>
  `${robots} ${robots === 1 ? "robot" : "robots"}, ${faults} ${faults === 1 ? "fault" : "faults"}, ${seconds(duration_seconds)}`;

function ShrinkProgress() {
  const state = shrinking.value;
  if (!state) return null;
  const { smallest } = state;
  return (
    <div class="tools">
      <span role="status">
        {smallest
          ? `Shrinking: ${smallest.trials} scenarios tried, now ${sizeOf(smallest.after)}`
          : "Shrinking: the first scenario is being tried"}
      </span>
      <button type="button" class="small" onClick={stopShrinking}>
        Open the smallest so far
      </button>
    </div>
  );
}

const note = signal("");

function Opened() {
  const opened = openedTrial.value;
  if (!opened || shrinking.value) return null;
  const { shrunk } = opened;
  const add = () => {
    note.value = addFile(opened.path, opened.text) ?? "";
    if (note.value === "") openedTrial.value = null;
  };
  return (
    <div class="opened">
      <p role="status">
        {shrunk
          ? `Shrunk from ${sizeOf(shrunk.before)} to ${sizeOf(shrunk.after)} in ${shrunk.trials} tries${shrunk.minimal ? "" : "; it might be smaller still"}. It is open in the viewer.`
          : "The run is open in the viewer."}
      </p>
      <button type="button" class="small" onClick={add}>
        Add {opened.path} to the project
      </button>
      {note.value && <p role="alert">{note.value}</p>}
    </div>
  );
}
