// Play, pause, step, and how fast.

import { useEffect } from "preact/hooks";
import { run } from "../app/context.ts";
import { seconds } from "../app/format.ts";
import { clock, end } from "./clock.ts";
import { Back, Forward, ToEnd, ToStart } from "./icons.tsx";

const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 5, 10, 50, Infinity];

const name = (speed: number) => (speed === Infinity ? "as fast as it goes" : `${speed}×`);

export function toggle(): void {
  if (run.playing.value) return run.pause();
  if (run.over.value) void run.seek(0).then(() => run.play());
  else run.play();
}

export function Transport() {
  useEffect(() => {
    const onKeyDown = (event: KeyboardEvent) => {
      if (isTyping(event.target) || event.ctrlKey || event.metaKey || event.altKey || !run.opened.value)
        return;
      const act = KEYS[event.key];
      if (!act) return;
      event.preventDefault();
      act();
    };
    addEventListener("keydown", onKeyDown);
    return () => removeEventListener("keydown", onKeyDown);
  }, []);
  const none = !run.opened.value;
  const over = run.over.value;
  return (
    <div class="transport">
      <button
        type="button"
        class="primary play"
        disabled={none}
        onClick={toggle}
        title={run.playing.value ? "Pause (space)" : "Play (space)"}
      >
        {run.playing.value ? "Pause" : over ? "Play again" : "Play"}
      </button>
      <div class="group">
        <button
          type="button"
          disabled={none}
          onClick={() => run.seek(0)}
          title="To the start (Home)"
          aria-label="To the start"
        >
          <ToStart />
        </button>
        <button
          type="button"
          disabled={none}
          onClick={() => run.previous()}
          title="To the event before (,)"
          aria-label="To the event before"
        >
          <Back />
        </button>
        <button
          type="button"
          disabled={none}
          onClick={() => run.next()}
          title="To the next event (.)"
          aria-label="To the next event"
        >
          <Forward />
        </button>
        <button
          type="button"
          disabled={none}
          onClick={() => run.seek(run.known.value)}
          title="To the furthest known moment (End)"
          aria-label="To the furthest known moment"
        >
          <ToEnd />
        </button>
      </div>
      <label class="speed">
        <span class="label">Speed</span>
        <select
          value={String(run.speed.value)}
          onChange={(event) => setSpeed(Number(event.currentTarget.value))}
          aria-label="Speed of playback"
        >
          {SPEEDS.map((speed) => (
            <option key={speed} value={String(speed)}>
              {name(speed)}
            </option>
          ))}
        </select>
      </label>
      <output class="clock" aria-live="off">
        {seconds(clock.value.time)}
        {run.opened.value && <span class="muted"> of {seconds(end(), end() < 10 ? 2 : 0)}</span>}
      </output>
      {run.playing.value && clock.value.pace > 0 && (
        <span class="muted pace">{clock.value.pace.toPrecision(2)} times real time</span>
      )}
      {over && run.outcome.value && (
        <span class={`outcome ${run.outcome.value}`}>{OUTCOMES[run.outcome.value]}</span>
      )}
      {run.stopped.value && <span class="outcome stopped">Breakpoint: {run.stopped.value.text}</span>}
    </div>
  );
}

const OUTCOMES = {
  reached: "Goal reached",
  violated: "Property violated",
  timed_out: "Time is over",
  failed: "Program failed",
};

function setSpeed(speed: number): void {
  if (run.playing.value) run.play(speed);
  else run.speed.value = speed;
}

function faster(by: number): void {
  const index = SPEEDS.indexOf(run.speed.value);
  const speed = SPEEDS[Math.min(SPEEDS.length - 1, Math.max(0, index + by))];
  if (speed !== undefined) setSpeed(speed);
}

const KEYS: Record<string, () => void> = {
  " ": toggle,
  k: toggle,
  ",": () => void run.previous(),
  ".": () => void run.next(),
  "<": () => faster(-1),
  ">": () => faster(1),
  Home: () => void run.seek(0),
  End: () => void run.seek(run.known.value),
};

/** Whether keys belong to what has the focus. */
function isTyping(target: EventTarget | null): boolean {
  return (
    target instanceof HTMLElement &&
    (target.isContentEditable ||
      /^(INPUT|TEXTAREA|SELECT|BUTTON|A|SUMMARY)$/.test(target.tagName) ||
      target.role === "slider")
  );
}
