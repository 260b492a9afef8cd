// A chart over time, drawn by uPlot. Dragging zooms, a double click shows all again, a click goes to the moment.

import { useSignalEffect } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import type uPlot from "uplot";
import { run } from "../app/context.ts";
import { theme } from "../app/theme.ts";
import type { Chart } from "./chart.ts";
import { marksOf, thin } from "./chart.ts";
import "uplot/dist/uPlot.min.css";

const MOST_POINTS = 4000;
const HEIGHT = 300;
const MOST_NAMES = 14;
/** The width of a letter, px. */
const LETTER = 6.6;
/** A pointer that moves less than this clicks, px. */
const STILL = 3;

export function TimePlot({ chart }: { chart: Chart }) {
  const box = useRef<HTMLDivElement>(null);
  const plot = useRef<{ of: string; plot: uPlot } | null>(null);

  useEffect(() => {
    let dropped = false;
    void import("uplot").then(({ default: Plot }) => {
      const element = box.current;
      if (dropped || !element) return;
      const of = JSON.stringify([
        theme.peek(),
        chart.title,
        chart.yLabel,
        chart.names,
        chart.lines.map(({ name, color }) => [name, color]),
      ]);
      const data = dataOf(Plot, chart);
      if (plot.current?.of === of) {
        // While a person looks at a part, it stays.
        const { min, max } = plot.current.plot.scales.x ?? {};
        const times = plot.current.plot.data[0];
        const whole = min === times?.[0] && max === times?.at(-1);
        plot.current.plot.setData(data, whole);
        if (!whole) plot.current.plot.redraw();
        return;
      }
      plot.current?.plot.destroy();
      plot.current = { of, plot: new Plot(optionsOf(Plot, chart, element), data, element) };
    });
    return () => {
      dropped = true;
    };
  }, [chart]);

  // The line of the moment shown.
  useSignalEffect(() => {
    void run.now.value;
    const frame = requestAnimationFrame(() => plot.current?.plot.redraw(false));
    return () => cancelAnimationFrame(frame);
  });

  useEffect(() => {
    const observer = new ResizeObserver(() => {
      const width = box.current?.clientWidth;
      if (width) plot.current?.plot.setSize({ width, height: HEIGHT });
    });
    if (box.current) observer.observe(box.current);
    return () => {
      observer.disconnect();
      plot.current?.plot.destroy();
      plot.current = null;
    };
  }, []);

  return (
    <div ref={box} class="time-plot" role="img" aria-label={`${chart.title}: ${chart.yLabel} over time`} />
  );
}

/** All lines over the times of all. */
function dataOf(Plot: typeof uPlot, { lines }: Chart): uPlot.AlignedData {
  const thinned = lines.map((line) => thin(line, MOST_POINTS));
  const [first] = thinned;
  // Robots of one run share their times.
  if (first && lines.every((line) => line.x === lines[0]?.x)) return [first.x, ...thinned.map(({ y }) => y)];
  return Plot.join(thinned.map(({ x, y }) => [x, y] as uPlot.AlignedData));
}

function optionsOf(Plot: typeof uPlot, chart: Chart, element: HTMLElement): uPlot.Options {
  const { lines, yLabel, names } = chart;
  const style = getComputedStyle(element);
  const [text, grid] = [style.getPropertyValue("--muted"), style.getPropertyValue("--grid")];
  const axis = { stroke: text, grid: { stroke: grid, width: 1 }, ticks: { stroke: grid, width: 1 } };
  const namedMarks = names ? marksOf(chart, { low: 0, high: 1 }, MOST_NAMES) : [];
  const shown = (value: number) => names?.[value] ?? String(Number(value.toFixed(3)));
  return {
    width: element.clientWidth,
    height: HEIGHT,
    scales: { x: { time: false } },
    axes: [
      { ...axis, label: "time, s", labelSize: 20, size: 36 },
      names
        ? {
            ...axis,
            label: yLabel,
            labelSize: 20,
            size: 30 + LETTER * Math.max(...namedMarks.map(([, text]) => text.length)),
            splits: namedMarks.map(([place]) => place),
            values: namedMarks.map(([, text]) => text),
          }
        : { ...axis, label: yLabel, labelSize: 20, size: 48 },
    ],
    series: [
      { label: "time, s" },
      ...lines.map(({ name, color, kept, steps }) => ({
        label: name,
        stroke: color,
        width: kept ? 1 : 1.6,
        dash: kept ? [4, 3] : [],
        spanGaps: true,
        points: { show: false },
        value: (_: uPlot, value: number | null) => (value === null ? "-" : shown(value)),
        ...(steps ? { paths: Plot.paths.stepped?.({ align: 1 }) } : {}),
      })),
    ],
    cursor: { drag: { x: true, y: false } },
    hooks: {
      ready: [
        (plot) => {
          let down = 0;
          plot.over.addEventListener("pointerdown", (event) => {
            down = event.clientX;
          });
          plot.over.addEventListener("click", (event) => {
            if (Math.abs(event.clientX - down) < STILL) void run.seek(plot.posToVal(event.offsetX, "x"));
          });
        },
      ],
      draw: [
        (plot) => {
          const x = plot.valToPos(run.now.peek(), "x", true);
          const { left, top, width, height } = plot.bbox;
          if (x < left || x > left + width) return;
          plot.ctx.fillStyle = style.getPropertyValue("--accent");
          plot.ctx.fillRect(x - 1, top, 2, height);
        },
      ],
    },
  };
}
