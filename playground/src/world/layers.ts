// The visible layers of the world, as chosen; remembered by the browser.

import { type Signal, signal } from "@preact/signals";

export const LAYERS = {
  labels: "Names and states",
  paths: "Paths so far",
  plans: "Intended paths",
  beliefs: "Believed positions",
  messages: "Messages",
  range: "Radio range of selected robots",
  sensors: "Sensors of selected robots",
  marks: "Drawings of programs",
  wayPoints: "Waypoints",
  areas: "Areas",
  things: "Things",
  obstacles: "Obstacles",
  events: "Flashes at events",
  grid: "Grid and scale",
  shadows: "Shadows",
} as const;

export type Layer = keyof typeof LAYERS;

const KEY = "starl.world";

interface Remembered {
  hidden: Layer[];
  flat: boolean;
}

function remembered(): Remembered {
  try {
    const { hidden, flat } = JSON.parse(localStorage.getItem(KEY) ?? "{}");
    const known = Array.isArray(hidden) ? hidden.filter((name): name is Layer => name in LAYERS) : [];
    return { hidden: known, flat: flat === true };
  } catch {
    return { hidden: [], flat: false };
  }
}

const start = remembered();

export const hidden: Signal<ReadonlySet<Layer>> = signal(new Set(start.hidden));

/** Whether the world is seen from above rather than in 3-D. */
export const flat = signal(start.flat);

export const shows = (layer: Layer): boolean => !hidden.value.has(layer);

export function toggleLayer(layer: Layer): void {
  const next = new Set(hidden.value);
  if (!next.delete(layer)) next.add(layer);
  hidden.value = next;
  remember();
}

export function setFlat(value: boolean): void {
  flat.value = value;
  remember();
}

function remember(): void {
  try {
    localStorage.setItem(KEY, JSON.stringify({ hidden: [...hidden.value], flat: flat.value }));
  } catch {
    // Without storage the choice lasts as long as the page.
  }
}
