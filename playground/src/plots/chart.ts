// A chart as data: what uPlot draws on the page, and what is exported.

export interface Line {
  name: string;
  color: string;
  /** A run that was kept is drawn thin and dashed. */
  kept: boolean;
  x: number[];
  y: number[];
  /** Each value stays until the next one. */
  steps?: boolean;
}

export interface Chart {
  title: string;
  xLabel: string;
  yLabel: string;
  lines: Line[];
  /** The values of y are places in this list, from 0. */
  names?: string[] | undefined;
  /** Both axes have the same scale. */
  square: boolean;
}

/** The table of a chart, as RFC 4180 has it. */
export function csvOf({ lines, xLabel, yLabel, names }: Chart): string {
  const shown = (y: number | undefined) =>
    y === undefined || !Number.isFinite(y) ? "" : names ? quoted(names[y] ?? "") : y;
  const rows = lines.flatMap(({ name, x, y }) =>
    x.map((value, index) => [quoted(name), value, shown(y[index])].join(",")),
  );
  return [["series", quoted(xLabel), quoted(yLabel)].join(","), ...rows, ""].join("\r\n");
}

/** A cell of a table. */
export const quoted = (text: string): string =>
  /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;

/** Marks of the y axis, at most about so many, with their texts. */
export function marksOf({ names }: Chart, range: Range, about: number): [number, string][] {
  if (!names) return ticksOf(range, about).map((tick) => [tick, String(tick)]);
  const step = Math.ceil(names.length / about);
  const marks = briefly(names).map((name, place): [number, string] => [place, name]);
  return marks.filter(([place]) => place % step === 0);
}

/** Texts that fit beside an axis: their starts, or their ends if the starts are alike, as those of records. */
function briefly(names: string[]): string[] {
  const cut = (text: string, part: (text: string) => string) => (text.length > 16 ? part(text) : text);
  const starts = names.map((name) => cut(name, (text) => `${text.slice(0, 15)}…`));
  if (new Set(starts).size === names.length) return starts;
  return names.map((name) => cut(name, (text) => `…${text.slice(-15)}`));
}

/** Lines with at most so many points: every so manyth of them, and the last. */
export function thin(line: Line, most: number): Line {
  const step = Math.ceil(line.x.length / most);
  if (step <= 1) return line;
  const keep = (_: number, index: number) => index % step === 0 || index === line.x.length - 1;
  return { ...line, x: line.x.filter(keep), y: line.y.filter(keep) };
}

export interface Range {
  low: number;
  high: number;
}

export function rangeOf(lists: number[][]): Range {
  let [low, high] = [Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY];
  for (const list of lists) {
    for (const value of list) {
      if (!Number.isFinite(value)) continue;
      low = Math.min(low, value);
      high = Math.max(high, value);
    }
  }
  if (low > high) return { low: 0, high: 1 };
  return low === high ? { low: low - 0.5, high: high + 0.5 } : { low, high };
}

/** Round values within a range, about so many. */
export function ticksOf({ low, high }: Range, about: number): number[] {
  const rough = (high - low) / about;
  const power = 10 ** Math.floor(Math.log10(rough));
  // The round step that is nearest by ratio: between 1, 2, 5 and 10 lie the roots of 2, 10 and 50.
  const share = rough / power;
  const step = power * (share < Math.SQRT2 ? 1 : share < Math.sqrt(10) ? 2 : share < Math.sqrt(50) ? 5 : 10);
  const ticks = [];
  for (let index = Math.ceil(low / step - 1e-9); index * step <= high + step * 1e-9; index++) {
    ticks.push(Number((index * step).toPrecision(10)));
  }
  return ticks;
}
