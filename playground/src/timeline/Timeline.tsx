// The whole run as a strip: how far it is known, the moment shown, and marks for what happened. One goes to a moment
// by clicking or dragging, or with the arrow keys.

import { useSignal, useSignalEffect } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { run } from "../app/context.ts";
import { seconds } from "../app/format.ts";
import { theme } from "../app/theme.ts";
import { nameOf } from "../inspect/names.ts";
import type { Event } from "../run/events.ts";
import { clock, end } from "./clock.ts";
import { describe, LANES } from "./lanes.ts";
import { first, Marks } from "./marks.ts";

const LANE_HEIGHT = 11;
const TOP = 4;
const AXIS = 16;
const HEIGHT = TOP + LANES.length * LANE_HEIGHT + AXIS;
/** A mark answers to a pointer this near, px. */
const NEAR = 6;
/** While the run continues, marks are drawn this often, ms; the line of the moment shown moves with it. */
const DRAW_EVERY = 250;

export function Timeline() {
  const canvas = useRef<HTMLCanvasElement>(null);
  const hint = useSignal<{ x: number; text: string } | null>(null);
  const width = useSignal(0);

  useEffect(() => {
    const element = canvas.current;
    if (!element) return;
    const observer = new ResizeObserver(() => {
      width.value = element.clientWidth;
    });
    observer.observe(element);
    return () => observer.disconnect();
  }, []);

  const drawn = useRef({ at: 0, later: 0 });
  useSignalEffect(() => {
    void [run.grown.value, run.ended.value, run.opened.value, theme.value, width.value];
    const redraw = () => {
      drawn.current = { at: performance.now(), later: 0 };
      if (canvas.current && width.peek() > 0) draw(canvas.current, width.peek());
    };
    const wait = drawn.current.at + DRAW_EVERY - performance.now();
    if (drawn.current.later) return;
    if (wait <= 0 || !run.playing.peek()) redraw();
    else drawn.current.later = window.setTimeout(redraw, wait);
  });
  useEffect(() => () => clearTimeout(drawn.current.later), []);

  const line = useRef<HTMLDivElement>(null);
  useSignalEffect(() => {
    const part = run.now.value / Math.max(1e-9, end());
    // Moved without a new layout of the page.
    if (line.current) line.current.style.transform = `translateX(${100 * part}%)`;
  });

  const timeAt = (event: PointerEvent) => {
    const box = (event.currentTarget as HTMLElement).getBoundingClientRect();
    return Math.min(1, Math.max(0, (event.clientX - box.left) / box.width)) * end();
  };
  const onPointerDown = (event: PointerEvent) => {
    (event.currentTarget as HTMLElement).setPointerCapture(event.pointerId);
    const mark = markAt(event);
    void (mark ? run.show(mark) : run.seek(timeAt(event)));
  };
  const onPointerMove = (event: PointerEvent) => {
    if (event.buttons & 1) void run.seek(timeAt(event));
    const mark = markAt(event);
    const box = (event.currentTarget as HTMLElement).getBoundingClientRect();
    hint.value = mark && {
      x: event.clientX - box.left,
      text: `${seconds(mark.time, 3)}  ${describe(mark, nameOf)}`,
    };
  };
  const onKeyDown = (event: KeyboardEvent) => {
    const step = { ArrowRight: 1, ArrowLeft: -1, PageUp: 10, PageDown: -10 }[event.key];
    if (!step) return;
    event.preventDefault();
    void run.seek(run.now.value + (step * end()) / 200);
  };
  return (
    <div class="timeline">
      <ul
        class="lane-names"
        aria-hidden="true"
        style={{ paddingTop: `${TOP}px`, lineHeight: `${LANE_HEIGHT}px` }}
      >
        {LANES.map(({ name }) => (
          <li key={name}>{name}</li>
        ))}
      </ul>
      <div class="strip">
        <canvas
          ref={canvas}
          style={{ height: `${HEIGHT}px` }}
          role="slider"
          tabIndex={0}
          aria-label="Moment of the run"
          aria-valuemin={0}
          aria-valuemax={Number(end().toFixed(2))}
          aria-valuenow={Number(clock.value.time.toFixed(2))}
          aria-valuetext={seconds(clock.value.time)}
          onPointerDown={onPointerDown}
          onPointerMove={onPointerMove}
          onPointerLeave={() => {
            hint.value = null;
          }}
          onKeyDown={onKeyDown}
        />
        <div class="over-strip">
          <div ref={line} class="now" />
        </div>
        {hint.value && (
          <div class="hint" style={{ left: `${hint.value.x}px` }}>
            {hint.value.text}
          </div>
        )}
      </div>
    </div>
  );
}

const marks = new Marks();

function markAt(event: PointerEvent): Event | null {
  const box = (event.currentTarget as HTMLElement).getBoundingClientRect();
  const lane = Math.floor((event.clientY - box.top - TOP) / LANE_HEIGHT);
  const scale = box.width / end();
  marks.follow(run.events);
  return marks.nearest(lane, (event.clientX - box.left) / scale, NEAR / scale);
}

function draw(canvas: HTMLCanvasElement, width: number): void {
  const ratio = devicePixelRatio || 1;
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(HEIGHT * ratio);
  const context = canvas.getContext("2d");
  if (!context) return;
  context.scale(ratio, ratio);
  const style = getComputedStyle(canvas);
  const color = (name: string) => style.getPropertyValue(name);
  const scale = width / Math.max(1e-9, end());
  const lanes = LANES.length * LANE_HEIGHT;

  context.fillStyle = color("--known");
  context.fillRect(0, TOP, run.known.value * scale, lanes);
  context.fillStyle = color("--line");
  for (let lane = 0; lane <= LANES.length; lane++) context.fillRect(0, TOP + lane * LANE_HEIGHT, width, 1);
  drawAxis(context, width, scale, color("--muted"));

  marks.follow(run.events);
  for (const [index, lane] of LANES.entries()) {
    context.fillStyle = context.strokeStyle = color(lane.color);
    const list = marks.lanes[index] ?? [];
    // Of marks that would cover each other one is drawn.
    for (let at = 0; at < list.length; ) {
      const x = Math.round((list[at]?.time ?? 0) * scale * 2) / 2;
      drawMark(context, lane.shape, x, TOP + (index + 0.5) * LANE_HEIGHT);
      const next = first(list, (x + 0.5) / scale);
      at = Math.max(at + 1, next);
    }
  }
}

/** Draws a mark with its middle at a place, in the present colours. */
export function drawMark(context: CanvasRenderingContext2D, shape: string, x: number, y: number): void {
  context.beginPath();
  switch (shape) {
    case "cross":
      context.lineWidth = 2;
      context.moveTo(x - 3.5, y - 3.5);
      context.lineTo(x + 3.5, y + 3.5);
      context.moveTo(x + 3.5, y - 3.5);
      context.lineTo(x - 3.5, y + 3.5);
      return context.stroke();
    case "triangle":
      context.moveTo(x, y - 4);
      context.lineTo(x + 4, y + 3.5);
      context.lineTo(x - 4, y + 3.5);
      break;
    case "diamond":
      context.moveTo(x, y - 4);
      context.lineTo(x + 3, y);
      context.lineTo(x, y + 4);
      context.lineTo(x - 3, y);
      break;
    case "bar":
      context.rect(x - 1, y - 4, 2, 8);
      break;
    default:
      context.arc(x, y, 2, 0, 2 * Math.PI);
  }
  context.fill();
}

function drawAxis(context: CanvasRenderingContext2D, width: number, scale: number, color: string): void {
  const rough = 90 / scale;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = power * ([1, 2, 5, 10].find((factor) => factor * power >= rough) ?? 10);
  context.fillStyle = color;
  context.font = "11px system-ui, sans-serif";
  context.textBaseline = "bottom";
  for (let index = 0; index * step * scale <= width; index++) {
    const [time, x] = [index * step, index * step * scale];
    context.fillRect(x, HEIGHT - AXIS, 1, 4);
    const label = `${Number(time.toPrecision(6))} s`;
    if (x + context.measureText(label).width < width) context.fillText(label, x + 3, HEIGHT - 1);
  }
}
