// The colours of the picture: those of the style sheet, and those of robots, as numbers from 0 to 1.

import { colorOf } from "../app/colors.ts";

const NAMES = [
  "page",
  "panel",
  "line",
  "text",
  "muted",
  "accent",
  "violation",
  "fault",
  "program",
  "good",
  "floor",
  "grid",
  "obstacle",
  "way-point",
] as const;

export type Name = (typeof NAMES)[number];

export type Rgb = [red: number, green: number, blue: number];

export interface Palette {
  dark: boolean;
  /** As CSS has them. */
  css: Record<Name, string>;
  rgb: Record<Name, Rgb>;
}

export function readPalette(element: Element, dark: boolean): Palette {
  const style = getComputedStyle(element);
  const css = Object.fromEntries(NAMES.map((name) => [name, style.getPropertyValue(`--${name}`).trim()]));
  const rgb = Object.fromEntries(NAMES.map((name) => [name, parse(css[name] ?? "")]));
  return { dark, css: css as Palette["css"], rgb: rgb as Palette["rgb"] };
}

/** The colours of so many robots. On a dark floor they are lighter. */
export function robotColors(robots: number, dark: boolean): { css: string[]; rgb: Rgb[] } {
  const rgb: Rgb[] = [];
  for (let robot = 0; robot < robots; robot++) {
    const color = parse(colorOf(robot, robots));
    rgb.push(dark ? mix(color, [1, 1, 1], 0.28) : color);
  }
  return { rgb, css: rgb.map(toCss) };
}

export const mix = (from: Rgb, to: Rgb, share: number): Rgb => [
  from[0] + (to[0] - from[0]) * share,
  from[1] + (to[1] - from[1]) * share,
  from[2] + (to[2] - from[2]) * share,
];

export const toCss = (color: Rgb): string => `rgb(${color.map((part) => Math.round(part * 255)).join(" ")})`;

/** Reads `#rrggbb` and `hsl(h s% l%)`. */
export function parse(color: string): Rgb {
  if (color.startsWith("#")) {
    const digits =
      color.length === 4 ? [...color.slice(1)].map((digit) => digit + digit).join("") : color.slice(1);
    const number = Number.parseInt(digits, 16);
    return [(number >> 16) / 255, ((number >> 8) & 255) / 255, (number & 255) / 255];
  }
  const [hue = 0, saturation = 0, lightness = 0] = (color.match(/[\d.]+/g) ?? []).map(Number);
  const [s, l] = [saturation / 100, lightness / 100];
  const part = (offset: number) => {
    const place = (offset + hue / 30) % 12;
    return l - s * Math.min(l, 1 - l) * Math.max(-1, Math.min(place - 3, 9 - place, 1));
  };
  return [part(0), part(8), part(4)];
}
