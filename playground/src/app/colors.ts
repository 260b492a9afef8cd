// Colours of robots, which people with and without colour blindness tell apart: those of `starl run --plot`.

/** Okabe and Ito (2008), "Color Universal Design", as the command draws them. */
const EIGHT = ["#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#785e28", "#5a3ca0", "#beaf00"];

/** The colour of one robot among so many, as CSS has it. */
export function colorOf(index: number, of: number): string {
  if (of <= EIGHT.length) return EIGHT[index % EIGHT.length] ?? "#0072b2";
  // Hues spread by the golden ratio, so that neighbours differ most; three lightnesses, for the colour-blind.
  const hue = (0.58 + index * 0.618033988749895) % 1;
  const lightness = [36, 52, 66][index % 3];
  return `hsl(${(hue * 360).toFixed(1)} 75% ${lightness}%)`;
}
