// The fields of an order, as a person types them: one `name = value` a line.

/** A value as interventions have it: one member that says its kind. */
export type Value =
  | { bool: boolean }
  | { int: number }
  | { float: number }
  | { text: string }
  | { point: { x: number; y: number; z: number } }
  | { robot: number };

export type Field = [name: string, value: Value];

/** Reads fields. Throws an Error that says which line is wrong. */
export function readFields(text: string, robots: Map<string, number>): Field[] {
  return text
    .split("\n")
    .map((line, index) => ({ line: line.trim(), number: index + 1 }))
    .filter(({ line }) => line !== "")
    .map(({ line, number }) => {
      const [, name, value] = /^([A-Za-z_]\w*)\s*=\s*(\S.*)$/.exec(line) ?? [];
      if (!name || !value)
        throw new Error(`line ${number}: write a field as name = value, such as count = 3`);
      return [name, readValue(value, robots)];
    });
}

function readValue(text: string, robots: Map<string, number>): Value {
  if (text === "true" || text === "false") return { bool: text === "true" };
  if (/^[-+]?\d+$/.test(text) && Number.isSafeInteger(Number(text))) return { int: Number(text) };
  if (/^[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?$/i.test(text)) return { float: Number(text) };
  const point = /^\(([^,]+),([^,]+)(?:,([^,]+))?\)$/.exec(text);
  if (point) {
    const [x, y, z] = [point[1], point[2], point[3] ?? "0"].map(Number);
    if ([x, y, z].every(Number.isFinite)) return { point: { x: x ?? 0, y: y ?? 0, z: z ?? 0 } };
  }
  const robot = robots.get(text);
  if (robot !== undefined) return { robot };
  return { text: /^".*"$/.test(text) ? text.slice(1, -1) : text };
}

/** Robots as a person lists them, by name or number, separated by commas or spaces. */
export function readRobots(text: string, robots: Map<string, number>): number[] {
  const count = Math.max(-1, ...robots.values()) + 1;
  return text
    .split(/[\s,]+/)
    .filter((word) => word !== "")
    .map((word) => {
      const robot = robots.get(word) ?? (/^\d+$/.test(word) ? Number(word) : undefined);
      if (robot === undefined || robot >= count) throw new Error(`there is no robot ${word}`);
      return robot;
    });
}

/** Groups of robots, separated by `|`. */
export const readGroups = (text: string, robots: Map<string, number>): number[][] =>
  text
    .split("|")
    .map((group) => readRobots(group, robots))
    .filter((group) => group.length > 0);
