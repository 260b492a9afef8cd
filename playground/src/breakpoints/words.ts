// A breakpoint in words.

import type { Breakpoint } from "../engine/types.ts";

export function breakpointWords(breakpoint: Breakpoint, name: (robot: number) => string): string {
  if ("when" in breakpoint) return `when ${breakpoint.when.expression} becomes true`;
  const at = (robot: number | null) => (robot === null ? "any robot" : name(robot));
  if ("action" in breakpoint) return `action ${breakpoint.action.name} of ${at(breakpoint.action.robot)}`;
  const { name: message, robot } = breakpoint.message;
  return `${message ?? "any message"} delivered to ${at(robot)}`;
}
