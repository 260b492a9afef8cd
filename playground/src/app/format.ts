// Numbers as people read them.

/** A moment or a length of time: `12.34 s`, `3:07.5 min`. */
export function seconds(time: number, digits = 2): string {
  if (time < 100) return `${time.toFixed(digits)} s`;
  const minutes = Math.floor(time / 60);
  const rest = (time % 60).toFixed(1).padStart(4, "0");
  return `${minutes}:${rest} min`;
}
