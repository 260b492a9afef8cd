// A chart as a picture, drawn as its SVG file is.

import { useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import type { Chart } from "./chart.ts";
import { svgOf } from "./svg.ts";

export function Picture({ chart }: { chart: Chart }) {
  const box = useRef<HTMLDivElement>(null);
  const url = useSignal("");
  useEffect(() => {
    const element = box.current;
    if (!element) return;
    const style = getComputedStyle(element);
    const width = Math.max(240, Math.round(element.clientWidth));
    const look = {
      width,
      height: Math.round(Math.min(width * 1.05, 620)),
      ground: style.getPropertyValue("--panel"),
      text: style.getPropertyValue("--text"),
      grid: style.getPropertyValue("--grid"),
    };
    const made = URL.createObjectURL(new Blob([svgOf(chart, look)], { type: "image/svg+xml" }));
    url.value = made;
    return () => URL.revokeObjectURL(made);
  }, [chart]);
  return (
    <div ref={box} class="picture">
      {url.value && (
        <img src={url.value} alt={`${chart.title}: ${chart.lines.map(({ name }) => name).join(", ")}`} />
      )}
    </div>
  );
}
