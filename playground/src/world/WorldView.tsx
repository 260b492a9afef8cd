// The world of the run, in 3-D or from above.

import { effect, useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { expectsRun, run } from "../app/context.ts";
import { loadScreen } from "../app/loads.ts";
import "../styles/world.css";
import { measured, pointed, tool } from "./pick.ts";
import { Toolbar } from "./Toolbar.tsx";
import type { WorldScreen } from "./world.ts";

export function WorldView() {
  const element = useRef<HTMLDivElement>(null);
  const screen = useRef<WorldScreen | null>(null);
  const onlyFlat = useSignal(false);
  useEffect(() => {
    let isGone = false;
    const make = async () => {
      const { WorldScreen } = await loadScreen();
      if (isGone || !element.current) return;
      screen.current = new WorldScreen(element.current, (isFlat) => {
        onlyFlat.value = isFlat;
      });
    };
    let isMade = false;
    const stop = effect(() => {
      if (isMade || !(expectsRun.value || run.opening.value || run.opened.value)) return;
      isMade = true;
      make().catch((error) => run.complain(error));
    });
    return () => {
      isGone = true;
      stop();
      screen.current?.dispose();
      screen.current = null;
    };
  }, [onlyFlat]);
  const robots = run.fleet.value.length;
  return (
    <div class="world">
      <div
        ref={element}
        class="world-picture"
        role="application"
        // biome-ignore lint/a11y/noNoninteractiveTabindex: an application takes keys
        tabIndex={0}
        aria-label={`World with ${robots} ${robots === 1 ? "robot" : "robots"}`}
        aria-describedby="world-keys"
      />
      <p id="world-keys" class="visually-hidden">
        Arrow keys move the view, with Shift they turn it. Plus and minus zoom. F shows what moves, Shift F
        everything. Escape ends a tool or clears the selection.
      </p>
      <Toolbar fit={(whole) => screen.current?.fit(whole)} onlyFlat={onlyFlat.value} />
      {onlyFlat.value && (
        <p class="world-note" role="status">
          This browser has no WebGL now, so the world is shown from above.
        </p>
      )}
      {!run.opened.value && !run.opening.value && (
        <p class="world-empty">Choose an example, or press Run, to see robots here.</p>
      )}
      <Hint />
      <Coordinates />
    </div>
  );
}

/** Instructions for the chosen tool. */
function Hint() {
  if (tool.value === "measure") {
    const text = ["Click the first place.", "Click the second place.", "Click to measure again."][
      measured.value.length
    ];
    return <p class="world-note">{text}</p>;
  }
  if (tool.value === "move")
    return <p class="world-note">Drag a robot, a waypoint, a thing or an obstacle.</p>;
  return null;
}

function Coordinates() {
  const place = pointed.value;
  if (!place) return null;
  return (
    <output class="world-place" aria-live="off">
      {place.x.toFixed(2)}, {place.y.toFixed(2)} m
    </output>
  );
}
