// Why the worker does not do what the page asks.

import type { Diagnostic } from "./types.ts";

/** The page draws and lists each robot; more than this would freeze it. */
export const MOST_ROBOTS = 10_000;

/** An error of the server, or of what the page asked for. */
export class Refused extends Error {
  constructor(
    message: string,
    readonly diagnostics: Diagnostic[] = [],
  ) {
    super(message);
  }
}

export function refuseTooMany(robots: number): void {
  if (robots <= MOST_ROBOTS) return;
  throw new Refused(
    `There are ${robots} robots. The page shows at most ${MOST_ROBOTS}; run more with the command \`starl run\`.`,
  );
}
