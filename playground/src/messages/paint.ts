// Draws the space-time diagram: lifelines, messages, marks, the moment shown.

import { colorOf } from "../app/colors.ts";
import type { Event } from "../run/events.ts";
import { LANES, laneOf } from "../timeline/lanes.ts";
import { drawMark } from "../timeline/Timeline.tsx";
import { isPast, type Past } from "./past.ts";
import type { Arrow, Scene } from "./scene.ts";
import { AXIS, HEAD } from "./view.ts";

export interface Picture {
  scene: Scene;
  width: number;
  height: number;
  /** The robots of the columns from the first to the last that is seen, with their places. */
  columns: { robot: number; name: string; x: number; chosen: boolean }[];
  robots: number;
  columnWidth: number;
  /** The times at the top and the bottom, s, and the moment shown. */
  from: number;
  to: number;
  yOf: (time: number) => number;
  now: number;
  known: number;
  past: Past | null;
  message: { from: number; sequence: number } | null;
  chosen: Event | null;
}

const FADED = 0.13;
/** The height of a label of time, px. */
const LABEL = 13;

export function paint(canvas: HTMLCanvasElement, picture: Picture): void {
  const { width, height } = picture;
  const ratio = devicePixelRatio || 1;
  if (canvas.width !== Math.round(width * ratio)) canvas.width = Math.round(width * ratio);
  if (canvas.height !== Math.round(height * ratio)) canvas.height = Math.round(height * ratio);
  const context = canvas.getContext("2d");
  if (!context) return;
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, width, height);
  const style = getComputedStyle(canvas);
  const color = (name: string) => style.getPropertyValue(name);
  paintGround(context, picture, color);
  context.save();
  context.beginPath();
  context.rect(AXIS, HEAD, width - AXIS, height - HEAD);
  context.clip();
  paintArrows(context, picture, color);
  paintMarks(context, picture, color);
  context.restore();
  paintHead(context, picture, color);
}

type Color = (name: string) => string;

function paintGround(context: CanvasRenderingContext2D, picture: Picture, color: Color): void {
  const { width, height, from, to, yOf } = picture;
  context.font = "11px system-ui, sans-serif";
  context.textBaseline = "middle";
  context.textAlign = "right";
  const step = niceStep((to - from) / Math.max(1, height / 55));
  const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  for (let index = Math.max(0, Math.ceil(from / step)); index * step <= to; index++) {
    const y = yOf(index * step);
    if (y < HEAD) continue;
    context.fillStyle = color("--grid");
    context.fillRect(AXIS, y, width - AXIS, 1);
    context.fillStyle = color("--muted");
    // The head would hide half of a label that is level with its lower edge.
    context.fillText(
      `${(index * step).toFixed(Math.min(digits, 6))} s`,
      AXIS - 6,
      Math.max(y, HEAD + LABEL / 2),
    );
  }
  for (const { robot, x, chosen } of picture.columns) {
    context.fillStyle = colorOf(robot, picture.robots);
    const bottom = Math.min(height, yOf(picture.known));
    const top = Math.max(HEAD, yOf(0));
    if (bottom > top) context.fillRect(x - (chosen ? 1.5 : 0.75), top, chosen ? 3 : 1.5, bottom - top);
  }
}

function paintArrows(context: CanvasRenderingContext2D, picture: Picture, color: Color): void {
  const { scene, past, message } = picture;
  const [plain, lost] = [color("--muted"), color("--violation")];
  for (const arrow of scene.arrows) {
    const chosen = message?.from === arrow.datagram.from && message.sequence === arrow.datagram.sequence;
    const [sent, end] = [arrow.datagram.sent, arrow.end];
    const faded = past && !chosen && !(isPast(past, sent) && end && (arrow.lost || isPast(past, end)));
    context.globalAlpha = faded ? FADED : 1;
    context.strokeStyle = context.fillStyle = chosen ? color("--accent") : arrow.lost ? lost : plain;
    context.lineWidth = chosen ? 3 : 1;
    context.setLineDash(arrow.end ? [] : [3, 3]);
    context.beginPath();
    context.moveTo(arrow.x1, arrow.y1);
    context.lineTo(arrow.x2, arrow.y2);
    context.stroke();
    paintEnd(context, arrow);
  }
  context.setLineDash([]);
  context.globalAlpha = 1;
}

function paintEnd(context: CanvasRenderingContext2D, { x1, y1, x2, y2, lost, end }: Arrow): void {
  if (lost) drawMark(context, "cross", x2, y2);
  if (lost || !end) return;
  const angle = Math.atan2(y2 - y1, x2 - x1);
  context.beginPath();
  context.moveTo(x2, y2);
  context.lineTo(x2 - 7 * Math.cos(angle - 0.4), y2 - 7 * Math.sin(angle - 0.4));
  context.lineTo(x2 - 7 * Math.cos(angle + 0.4), y2 - 7 * Math.sin(angle + 0.4));
  context.fill();
}

function paintMarks(context: CanvasRenderingContext2D, picture: Picture, color: Color): void {
  const { scene, past, chosen, width } = picture;
  const colors = LANES.map((lane) => color(lane.color));
  const action = color("--muted");
  for (const { event, x, y } of scene.marks) {
    context.globalAlpha = past && !isPast(past, event) ? FADED : 1;
    const lane = laneOf(event);
    context.fillStyle = context.strokeStyle = lane === undefined ? action : (colors[lane] ?? action);
    if (x === null) context.fillRect(AXIS, y, width - AXIS, 1.5);
    else if (lane === undefined) context.fillRect(x - 4, y - 0.6, 8, 1.2);
    else drawMark(context, LANES[lane]?.shape ?? "dot", x, y);
    if (event !== chosen || x === null) continue;
    context.globalAlpha = 1;
    context.strokeStyle = color("--accent");
    context.lineWidth = 2;
    context.beginPath();
    context.arc(x, y, 8, 0, 2 * Math.PI);
    context.stroke();
  }
  context.globalAlpha = 1;
  context.fillStyle = color("--accent");
  context.fillRect(AXIS, picture.yOf(picture.now) - 1, width - AXIS, 2);
}

function paintHead(context: CanvasRenderingContext2D, picture: Picture, color: Color): void {
  const { width, columns, columnWidth } = picture;
  context.fillStyle = color("--panel");
  context.fillRect(0, 0, width, HEAD);
  context.fillStyle = color("--line");
  context.fillRect(0, HEAD - 1, width, 1);
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.save();
  context.beginPath();
  context.rect(AXIS, 0, width - AXIS, HEAD);
  context.clip();
  for (const { robot, name, x, chosen } of columns) {
    context.font = `${chosen ? "bold " : ""}12px system-ui, sans-serif`;
    context.fillStyle = color("--text");
    context.fillText(shortened(context, name, columnWidth - 6), x, HEAD / 2 - 2);
    context.fillStyle = colorOf(robot, picture.robots);
    context.fillRect(x - 9, HEAD - 5, 18, 4);
  }
  context.restore();
}

/** A name that is too long loses its middle: numbers at its end tell robots apart. */
function shortened(context: CanvasRenderingContext2D, name: string, width: number): string {
  if (context.measureText(name).width <= width) return name;
  for (let kept = name.length - 2; kept > 2; kept--) {
    const head = Math.ceil(kept / 3);
    const short = `${name.slice(0, head)}..${name.slice(name.length - (kept - head))}`;
    if (context.measureText(short).width <= width) return short;
  }
  return name.slice(-3);
}

function niceStep(rough: number): number {
  const power = 10 ** Math.floor(Math.log10(rough));
  return power * ([1, 2, 5, 10].find((factor) => factor * power >= rough) ?? 10);
}
