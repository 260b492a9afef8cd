// The space-time diagram: the messages between robots, and the events in between.

import { signal } from "@preact/signals";
import { run } from "../app/context.ts";
import { Details } from "./Details.tsx";
import { Diagram, walk } from "./Diagram.tsx";
import { marked, markedPast } from "./known.ts";
import { follow, zoom } from "./view.ts";
import "../styles/messages.css";

const large = signal(false);

export function Messages() {
  if (!run.opened.value) return <p class="muted">Open a program to see its messages.</p>;
  return (
    <div class={`messages ${large.value ? "large" : ""}`}>
      <div class="tools">
        <label>
          <input
            type="checkbox"
            checked={follow.value}
            onChange={(event) => {
              follow.value = event.currentTarget.checked;
            }}
          />{" "}
          Follow
        </label>
        <span class="group">
          <button
            type="button"
            class="small"
            aria-label="Show less time"
            title="Show less time (+)"
            onClick={() => zoom(0.6)}
          >
            +
          </button>
          <button
            type="button"
            class="small"
            aria-label="Show more time"
            title="Show more time (-)"
            onClick={() => zoom(1.6)}
          >
            -
          </button>
        </span>
        <span class="group">
          <button
            type="button"
            class="small"
            title="The event or message before (up arrow)"
            onClick={() => walk(-1)}
          >
            Before
          </button>
          <button
            type="button"
            class="small"
            title="The event or message after (down arrow)"
            onClick={() => walk(1)}
          >
            After
          </button>
        </span>
        <button
          type="button"
          class="small"
          aria-pressed={large.value}
          onClick={() => {
            large.value = !large.value;
          }}
        >
          Large
        </button>
        {markedPast() && (
          <button
            type="button"
            class="small"
            onClick={() => {
              marked.value = null;
            }}
          >
            Remove the marks of the causal past
          </button>
        )}
      </div>
      <Diagram />
      <Details />
    </div>
  );
}
