// A chart as an SVG file. It is self-contained, so it can be put into a paper or a page.

import { type Chart, type Line, marksOf, type Range, rangeOf, thin, ticksOf } from "./chart.ts";

export interface Look {
  width: number;
  /** With a legend of at most two rows. */
  height: number;
  ground: string;
  text: string;
  grid: string;
}

/** Colours for a paper. */
export const PAPER: Look = { width: 720, height: 440, ground: "#ffffff", text: "#1b2530", grid: "#d5dbe1" };

const LEFT = 58;
const RIGHT = 14;
const TOP = 30;
const BOTTOM = 44;
const LEGEND_ROW = 16;
const ROWS_WITHIN = 2;
/** A line and a gap, and about what a letter takes. */
const LEGEND_ENTRY = 42;
const LETTER = 6.6;
const MOST_POINTS = 4000;
/** A longer legend would be larger than the chart. */
const MOST_ENTRIES = 24;

export function svgOf(chart: Chart, look: Look): string {
  const { width } = look;
  const entries = chart.lines.slice(0, MOST_ENTRIES);
  const entry = LEGEND_ENTRY + LETTER * Math.max(0, ...entries.map(({ name }) => name.length));
  const perRow = Math.max(1, Math.floor((width - LEFT - RIGHT) / entry));
  const legend = Math.ceil(entries.length / perRow) * LEGEND_ROW;
  // A long legend makes the picture higher, not the chart smaller.
  const height = look.height + Math.max(0, legend - ROWS_WITHIN * LEGEND_ROW);
  const marks = marksOf(chart, rangeOf(chart.lines.map((line) => line.y)), chart.names ? 16 : 6);
  const widest = Math.max(0, ...marks.map(([, text]) => text.length));
  const left = Math.max(LEFT, 34 + LETTER * widest);
  const box = { left, right: width - RIGHT, top: TOP, bottom: height - BOTTOM - legend };
  const [x, y] = scales(chart, box);
  const parts = [
    `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" viewBox="0 0 ${width} ${height}" font-family="sans-serif" font-size="12" fill="${look.text}">`,
    `<rect width="${width}" height="${height}" fill="${look.ground}"/>`,
    `<text x="${width / 2}" y="18" text-anchor="middle" font-weight="bold">${escaped(chart.title)}</text>`,
    ...ticksOf(x.range, 7).map(
      (tick) =>
        `<path d="M${fixed(x.at(tick))} ${box.top}V${box.bottom}" stroke="${look.grid}"/>` +
        `<text x="${fixed(x.at(tick))}" y="${box.bottom + 15}" text-anchor="middle">${tick}</text>`,
    ),
    ...marks.map(
      ([place, text]) =>
        `<path d="M${box.left} ${fixed(y.at(place))}H${box.right}" stroke="${look.grid}"/>` +
        `<text x="${box.left - 6}" y="${fixed(y.at(place) + 4)}" text-anchor="end">${escaped(text)}</text>`,
    ),
    `<text x="${(box.left + box.right) / 2}" y="${box.bottom + 33}" text-anchor="middle">${escaped(chart.xLabel)}</text>`,
    `<text transform="translate(14 ${(box.top + box.bottom) / 2}) rotate(-90)" text-anchor="middle">${escaped(chart.yLabel)}</text>`,
    ...chart.lines.map((line) => path(thin(line, MOST_POINTS), x.at, y.at)),
    ...entries.map((line, index) => {
      const at = {
        x: LEFT + (index % perRow) * entry,
        y: height - legend + Math.floor(index / perRow) * LEGEND_ROW,
      };
      return (
        `<path d="M${at.x} ${at.y}h18" stroke="${line.color}" stroke-width="2.5"${dash(line)}/>` +
        `<text x="${at.x + 23}" y="${at.y + 4}">${escaped(line.name)}</text>`
      );
    }),
    "</svg>",
  ];
  return parts.join("\n");
}

type Box = { left: number; right: number; top: number; bottom: number };
type Scale = { range: Range; at: (value: number) => number };

function scales({ lines, square }: Chart, { left, right, top, bottom }: Box): [Scale, Scale] {
  let x = rangeOf(lines.map((line) => line.x));
  let y = rangeOf(lines.map((line) => line.y));
  if (square) {
    const metres = Math.max((x.high - x.low) / (right - left), (y.high - y.low) / (bottom - top)) * 1.08;
    x = around(x, metres * (right - left));
    y = around(y, metres * (bottom - top));
  }
  return [
    { range: x, at: (value) => left + ((value - x.low) / (x.high - x.low)) * (right - left) },
    { range: y, at: (value) => bottom - ((value - y.low) / (y.high - y.low)) * (bottom - top) },
  ];
}

function around({ low, high }: Range, length: number): Range {
  const middle = (low + high) / 2;
  return { low: middle - length / 2, high: middle + length / 2 };
}

function path(line: Line, xAt: (value: number) => number, yAt: (value: number) => number): string {
  let d = "";
  let before = Number.NaN;
  for (const [index, value] of line.x.entries()) {
    const y = line.y[index] ?? Number.NaN;
    if (!Number.isFinite(y)) {
      before = Number.NaN;
      continue;
    }
    const [px, py] = [fixed(xAt(value)), fixed(yAt(y))];
    if (Number.isNaN(before)) d += `M${px} ${py}`;
    else d += line.steps ? `H${px}V${py}` : `L${px} ${py}`;
    before = y;
  }
  return (
    d &&
    `<path d="${d}" fill="none" stroke="${line.color}" stroke-width="${line.kept ? 1 : 1.6}"${dash(line)}/>`
  );
}

const dash = ({ kept }: Line): string => (kept ? ' stroke-dasharray="4 3"' : "");
const fixed = (value: number): string => String(Number(value.toFixed(1)));

const escaped = (text: string): string =>
  text.replaceAll("&", "&amp;").replaceAll("<", "&lt;").replaceAll(">", "&gt;").replaceAll('"', "&quot;");

/** The chart as a PNG, twice as fine as its size. */
export async function pngOf(svg: string): Promise<Blob> {
  const url = URL.createObjectURL(new Blob([svg], { type: "image/svg+xml" }));
  try {
    const image = new Image();
    image.src = url;
    await image.decode();
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [2 * image.naturalWidth, 2 * image.naturalHeight];
    canvas.getContext("2d")?.drawImage(image, 0, 0, canvas.width, canvas.height);
    const blob = await new Promise<Blob | null>((resolve) => canvas.toBlob(resolve, "image/png"));
    if (!blob) throw new Error("this browser cannot make a PNG");
    return blob;
  } finally {
    URL.revokeObjectURL(url);
  }
}
