// The whole run as a strip: how far it is known, the moment shown, and marks for what happened. One goes to a moment
// by clicking or dragging, or with the arrow keys.

import { useSignal, useSignalEffect } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { run } from "../app/context.ts";
import { seconds } from "../app/format.ts";
import { theme } from "../app/theme.ts";
import type { Event } from "../run/events.ts";
import { describe, LANES, laneOf } from "./lanes.ts";
import { end } from "./Transport.tsx";

const LANE_HEIGHT = 11;
const TOP = 4;
const AXIS = 16;
const HEIGHT = TOP + LANES.length * LANE_HEIGHT + AXIS;
/** A mark answers to a pointer this near, px. */
const NEAR = 6;

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

  useSignalEffect(() => {
    void [run.grown.value, run.now.value, run.over.value, theme.value, width.value];
    if (canvas.current && width.value > 0) draw(canvas.current, width.value);
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
      <canvas
        ref={canvas}
        style={{ height: `${HEIGHT}px` }}
        role="slider"
        tabIndex={0}
        aria-label="Moment of the run"
        aria-valuemin={0}
        aria-valuemax={Number(end().toFixed(2))}
        aria-valuenow={Number(run.now.value.toFixed(2))}
        aria-valuetext={seconds(run.now.value)}
        onPointerDown={onPointerDown}
        onPointerMove={onPointerMove}
        onPointerLeave={() => {
          hint.value = null;
        }}
        onKeyDown={onKeyDown}
      />
      {hint.value && (
        <div class="hint" style={{ left: `${hint.value.x}px` }}>
          {hint.value.text}
        </div>
      )}
    </div>
  );
}

const nameOf = (robot: number) => run.fleet.value[robot]?.name ?? `robot ${robot}`;

function markAt(event: PointerEvent): Event | null {
  const box = (event.currentTarget as HTMLElement).getBoundingClientRect();
  const lane = Math.floor((event.clientY - box.top - TOP) / LANE_HEIGHT);
  const scale = box.width / end();
  const x = event.clientX - box.left;
  const events = run.events;
  let found: Event | null = null;
  let distance = NEAR;
  for (let index = events.from((x - NEAR) / scale); index < events.list.length; index++) {
    const mark = events.list[index];
    if (!mark || mark.time * scale > x + NEAR) break;
    const off = Math.abs(mark.time * scale - x);
    if (laneOf(mark) !== lane || off > distance) continue;
    [found, distance] = [mark, off];
  }
  return found;
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

  const colors = LANES.map((lane) => color(lane.color));
  // A mark that would cover another one entirely is left out.
  const last = LANES.map(() => -1);
  for (const event of run.events.list) {
    const lane = laneOf(event);
    if (lane === undefined) continue;
    const x = Math.round(event.time * scale * 2) / 2;
    if (x === last[lane]) continue;
    last[lane] = x;
    context.fillStyle = context.strokeStyle = colors[lane] ?? "";
    drawMark(context, LANES[lane]?.shape ?? "dot", x, TOP + (lane + 0.5) * LANE_HEIGHT);
  }
  const now = run.now.value * scale;
  context.fillStyle = color("--accent");
  context.fillRect(now - 1, 0, 2, TOP + lanes + 3);
  context.beginPath();
  context.arc(now, TOP + lanes + 4, 4, 0, 2 * Math.PI);
  context.fill();
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
