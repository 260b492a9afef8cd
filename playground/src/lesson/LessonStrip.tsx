// The present step of the lesson, above what is written.

import { useSignal } from "@preact/signals";
import type { ComponentChildren } from "preact";
import { useEffect, useRef } from "preact/hooks";
import { close, goTo, isShown, progress, solve, step } from "./lesson.ts";
import { STEPS } from "./steps.tsx";
import "../styles/lesson.css";

export function LessonStrip() {
  const folded = useSignal(false);
  const shown = step.value;
  if (!isShown.value || !shown) return null;
  const { step: index, done } = progress.value;
  const isDone = done[index] ?? false;
  const isLast = index === STEPS.length - 1;
  return (
    <section class="lesson-strip" aria-label="Lesson">
      <div class="row">
        <h2>
          {index + 1}. {shown.title}
        </h2>
        <span class="muted">of {STEPS.length}</span>
        <span class="spread" />
        <button
          type="button"
          class="icon"
          aria-expanded={!folded.value}
          onClick={() => {
            folded.value = !folded.value;
          }}
        >
          {folded.value ? "Show" : "Hide"}
        </button>
        <button
          type="button"
          class="icon"
          aria-label="Leave the lesson"
          title="Leave the lesson"
          onClick={close}
        >
          ✕
        </button>
      </div>
      {!folded.value && (
        <div class="text">
          {shown.text}
          <div role="status">{isDone && <Done>{shown.after}</Done>}</div>
        </div>
      )}
      <div class="row">
        <button type="button" disabled={index === 0} onClick={() => goTo(index - 1)}>
          Back
        </button>
        {!isDone && shown.solution && (
          <button type="button" onClick={solve}>
            Write it for me
          </button>
        )}
        <span class="spread" />
        <span class={isDone ? "good" : "muted"}>{isDone ? "Done" : "Not done yet"}</span>
        {!isLast && (
          <button type="button" class={isDone ? "primary" : ""} onClick={() => goTo(index + 1)}>
            {isDone ? "Next" : "Skip"}
          </button>
        )}
      </div>
    </section>
  );
}

/** The result of a step. It scrolls into view, because the text above can be long. */
function Done({ children }: { children: ComponentChildren }) {
  const element = useRef<HTMLDivElement>(null);
  useEffect(() => element.current?.scrollIntoView({ block: "nearest" }), []);
  return (
    <div ref={element} class="done">
      {children}
    </div>
  );
}
