// In which order and under which headings examples are shown.

import type { Example } from "../engine/types.ts";

const GROUPS: [string, string[]][] = [
  ["Driving together", ["race", "line", "formation", "formation-space", "flocking", "crossing", "diffusion"]],
  ["Searching and sharing work", ["search", "search-building", "maze", "auction", "light-painting"]],
  ["Traffic", ["intersection", "intersection-stream", "traffic-signs"]],
];

/** All examples by heading; those under no heading above show one primitive each. */
export function grouped(examples: Example[]): [string, Example[]][] {
  const named = new Set(GROUPS.flatMap(([, names]) => names));
  const groups = GROUPS.map(([heading, names]): [string, Example[]] => [
    heading,
    names.flatMap((name) => examples.filter((example) => example.name === name)),
  ]);
  const others = examples.filter(({ name }) => !named.has(name));
  return [...groups, ["One primitive each", others] as [string, Example[]]].filter(
    ([, members]) => members.length > 0,
  );
}
