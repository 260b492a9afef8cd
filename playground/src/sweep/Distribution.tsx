// How the length of runs, or the number of their messages, is distributed.

import { signal } from "@preact/signals";
import { type Bin, histogram, type Quantity } from "./results.ts";
import { shown, sweep } from "./sweep.ts";

const [WIDTH, HEIGHT, FOOT] = [360, 110, 18];
const MOST_BINS = 24;

const quantity = signal<Quantity>("end");

const WORDS: Record<Quantity, { title: string; unit: string }> = {
  end: { title: "when runs ended", unit: " s" },
  messages: { title: "messages sent", unit: "" },
};

export function Distribution() {
  void shown.value;
  const results = sweep.value?.results;
  if (!results) return null;
  const bins = histogram(results.runs, quantity.value, MOST_BINS);
  return (
    <section aria-label="Distribution">
      <label class="tools">
        <h3>Distribution of</h3>
        <select
          value={quantity.value}
          onChange={(event) => {
            quantity.value = event.currentTarget.value as Quantity;
          }}
        >
          <option value="end">{WORDS.end.title}</option>
          <option value="messages">{WORDS.messages.title}</option>
        </select>
      </label>
      <Bars bins={bins} />
      <p class="muted legend">
        <span class="key right" aria-hidden="true" /> nothing went wrong{" "}
        <span class="key wrong" aria-hidden="true" /> something went wrong
        {quantity.value === "end" && ": the run ends then"}
      </p>
    </section>
  );
}

function Bars({ bins }: { bins: Bin[] }) {
  const { title, unit } = WORDS[quantity.value];
  const most = Math.max(1, ...bins.map(({ right, wrong }) => right + wrong));
  const width = WIDTH / Math.max(1, bins.length);
  const [first, last] = [bins[0], bins.at(-1)];
  const tall = (count: number) => (count / most) * (HEIGHT - 12);
  const number = (value: number) => `${Number(value.toPrecision(4))}${unit}`;
  const top = quantity.value === "messages" ? -1 : 0;
  return (
    <svg
      viewBox={`0 0 ${WIDTH} ${HEIGHT + FOOT}`}
      class="histogram"
      role="img"
      aria-label={`Histogram: ${title}`}
    >
      <defs>
        <pattern id="sweep-wrong" width="5" height="5" patternUnits="userSpaceOnUse">
          <rect width="5" height="5" class="wrong-fill" />
          <path d="M0 5L5 0" class="wrong-line" />
        </pattern>
      </defs>
      {bins.map(({ low, high, right, wrong }, index) => (
        <g key={low}>
          <title>
            {`${number(low)} to ${number(high + top)}: ${right + wrong} runs, ${wrong} of them with something wrong`}
          </title>
          <rect x={index * width} width={width} y={0} height={HEIGHT} class="hover" />
          <rect
            x={index * width + 1}
            width={Math.max(1, width - 2)}
            y={HEIGHT - tall(right)}
            height={tall(right)}
            class="right"
          />
          <rect
            x={index * width + 1}
            width={Math.max(1, width - 2)}
            y={HEIGHT - tall(right) - tall(wrong)}
            height={tall(wrong)}
            class="wrong"
          />
        </g>
      ))}
      <path d={`M0 ${HEIGHT + 0.5}H${WIDTH}`} class="axis" />
      <text x={0} y={9}>
        {most} {most === 1 ? "run" : "runs"}
      </text>
      {first && last && (
        <>
          <text x={0} y={HEIGHT + 14}>
            {number(first.low)}
          </text>
          <text x={WIDTH} y={HEIGHT + 14} text-anchor="end">
            {number(last.high + top)}
          </text>
        </>
      )}
    </svg>
  );
}
