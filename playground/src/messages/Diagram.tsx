// The canvas of the space-time diagram, and how it is moved: drag, wheel, two fingers, keys.

import { signal, useSignalEffect } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { run } from "../app/context.ts";
import { seconds } from "../app/format.ts";
import { theme } from "../app/theme.ts";
import { nameOf } from "../inspect/names.ts";
import type { Event } from "../run/events.ts";
import { describe } from "../timeline/lanes.ts";
import { columnOf, robotsInOrder } from "./columns.ts";
import { Gestures } from "./gestures.ts";
import { knownTraffic, markedPast } from "./known.ts";
import { paint } from "./paint.ts";
import { type Arrow, hit, type Mark, type Scene, sceneOf } from "./scene.ts";
import * as view from "./view.ts";

/** The radius in which a pointer hits, px; a finger is broader. */
const NEAR = 7;
const NEAR_FINGER = 16;

/** The event that a person has chosen in the diagram. */
export const chosen = signal<Event | null>(null);

const hint = signal<{ x: number; y: number; text: string } | null>(null);

export function Diagram() {
  const canvas = useRef<HTMLCanvasElement>(null);
  const scene = useRef<Scene>({ arrows: [], marks: [], thinned: 1 });
  const thinned = useRef(signal(1)).current;

  useEffect(() => {
    const element = canvas.current;
    if (!element) return;
    const observer = new ResizeObserver(() => {
      view.size.value = { width: element.clientWidth, height: element.clientHeight };
    });
    observer.observe(element);
    const gestures = new Gestures(element, {
      onClick: (x, y, finger) => choose(hit(scene.current, x, y, finger ? NEAR_FINGER : NEAR)),
      onHover: (x, y) => {
        const found = hit(scene.current, x, y, NEAR);
        hint.value = found && {
          x,
          y,
          text: textOf("event" in found ? found.event : (found.end ?? found.datagram.sent)),
        };
      },
    });
    return () => {
      observer.disconnect();
      gestures.end();
      hint.value = null;
    };
  }, []);

  // Drawn at most once a frame, however many signals change.
  useSignalEffect(() => {
    void [run.now.value, run.grown.value, run.message.value, theme.value, chosen.value, markedPast()];
    void [
      view.size.value,
      view.from.value,
      view.span.value,
      view.left.value,
      view.follow.value,
      columnOf.value,
    ];
    const frame = requestAnimationFrame(() => {
      if (!canvas.current || view.size.peek().width === 0) return;
      if (view.follow.peek()) view.keepUp();
      scene.current = draw(canvas.current);
      thinned.value = scene.current.thinned;
    });
    return () => cancelAnimationFrame(frame);
  });

  return (
    <div class="diagram">
      {/* biome-ignore lint/a11y/noInteractiveElementToNoninteractiveRole: a canvas is not interactive by itself; this one hears keys */}
      <canvas
        ref={canvas}
        role="application"
        tabIndex={0}
        aria-label="Messages between robots over time"
        aria-describedby="diagram-keys"
        onKeyDown={onKeyDown}
        onPointerLeave={() => {
          hint.value = null;
        }}
      />
      <p id="diagram-keys" class="visually-hidden">
        Time runs downwards, each robot has a column. Up and down choose the event before or after, Enter goes
        to its moment, plus and minus zoom, page up and page down move in time, left and right show other
        robots.
      </p>
      {hint.value && (
        <div class="hint" style={{ left: `${hint.value.x}px`, top: `${hint.value.y}px` }}>
          {hint.value.text}
        </div>
      )}
      {thinned.value > 1 && (
        <p class="thinned">Too much to draw: one of {thinned.value} events is shown. Zoom in to see all.</p>
      )}
    </div>
  );
}

function draw(canvas: HTMLCanvasElement): Scene {
  const { width, height } = view.size.peek();
  const [from, to] = [view.from.peek(), view.from.peek() + view.span.peek()];
  const columns = columnOf.peek();
  const columnWidth = view.columnWidth();
  const scene = sceneOf(run.events, knownTraffic(), {
    from,
    to,
    xOf: (robot) => view.xOf(columns[robot] ?? -2),
    yOf: view.yOf,
    left: view.AXIS,
    right: width,
  });
  const first = Math.max(0, Math.floor(view.left.peek() / columnWidth));
  const seen = robotsInOrder.peek().slice(first, first + Math.ceil(width / columnWidth) + 1);
  const selected = new Set(run.selected.peek());
  paint(canvas, {
    scene,
    width,
    height,
    columns: seen.map((robot, index) => ({
      robot,
      name: nameOf(robot),
      x: view.xOf(first + index),
      chosen: selected.has(robot),
    })),
    robots: run.fleet.peek().length,
    columnWidth,
    from,
    to,
    yOf: view.yOf,
    now: run.now.peek(),
    known: run.known.peek(),
    past: markedPast(),
    message: run.message.peek(),
    chosen: chosen.peek(),
  });
  return scene;
}

const textOf = (event: Event): string => `${seconds(event.time, 3)}  ${describe(event, nameOf)}`;

/** A click on a message shows it; a click on an event jumps to its time. */
function choose(found: Mark | Arrow | null): void {
  if (!found) {
    chosen.value = null;
    run.message.value = null;
  } else if ("event" in found) {
    chosen.value = found.event;
    run.message.value = null;
    void run.show(found.event);
  } else {
    chosen.value = null;
    const { from, sequence } = found.datagram;
    run.message.value = { from, sequence };
  }
}

/** Chooses the event before or after the chosen one, at the robots that are chosen, or at all. */
export function walk(step: 1 | -1): void {
  const { list } = run.events;
  const robots = run.selected.value.length > 0 ? new Set(run.selected.value) : null;
  const now = run.events.from(run.now.value);
  const start = chosen.value ? run.events.before(chosen.value.index) : step === 1 ? now - 1 : now;
  for (let index = start + step; index >= 0 && index < list.length; index += step) {
    const event = list[index];
    if (!event || event.topic === "/starl/mark") continue;
    if (robots && !robots.has(event.message.robot ?? -1)) continue;
    chosen.value = event;
    const datagram = knownTraffic().of(event);
    run.message.value = datagram ? { from: datagram.from, sequence: datagram.sequence } : null;
    view.reveal(event.time);
    return;
  }
}

const KEYS: Record<string, () => void> = {
  ArrowDown: () => walk(1),
  ArrowUp: () => walk(-1),
  ArrowRight: () => view.panColumns(view.columnWidth()),
  ArrowLeft: () => view.panColumns(-view.columnWidth()),
  PageDown: () => view.panTime(view.span.value * 0.8),
  PageUp: () => view.panTime(-view.span.value * 0.8),
  "+": () => view.zoom(0.6),
  "=": () => view.zoom(0.6),
  "-": () => view.zoom(1.6),
  Enter: () => {
    if (chosen.value) void run.show(chosen.value);
  },
  Escape: () => choose(null),
};

function onKeyDown(event: KeyboardEvent): void {
  const act = KEYS[event.key];
  if (!act || event.ctrlKey || event.metaKey || event.altKey) return;
  event.preventDefault();
  event.stopPropagation();
  act();
}
