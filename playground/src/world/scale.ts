// Round lengths that suit a view.

/** How far grid lines are apart where a pixel is so many metres: 1, 2 or 5 times a power of ten, 28 px at the least. */
export const gridStep = (pixel: number): number => round(pixel * 28);

/** The length of a scale bar, m: 60 px at the least. */
export const barLength = (pixel: number): number => round(pixel * 60);

/** The next of 1, 2 or 5 times a power of ten. */
function round(least: number): number {
  const power = 10 ** Math.floor(Math.log10(least));
  return power * ([1, 2, 5, 10].find((factor) => factor * power >= least) ?? 10);
}

/** A length as people read it. */
export function metres(length: number): string {
  if (length >= 1000) return `${Number((length / 1000).toPrecision(4))} km`;
  if (length >= 1) return `${Number(length.toFixed(length < 10 ? 2 : 1))} m`;
  return `${Number((length * 100).toPrecision(3))} cm`;
}
