// Records for tests; times are in seconds.

import type { TraceRecord } from "../../src/engine/types.ts";

const record = (time: number, topic: string, message: TraceRecord["message"]): TraceRecord => ({
  time_ns: Math.round(time * 1e9),
  topic: `/starl/${topic}`,
  message,
});

export const acted = (time: number, robot: number, name: string) => record(time, "action", { robot, name });

export const sent = (time: number, robot: number, sequence: number, to?: number) =>
  record(time, "sent", { robot, sequence, port: 1, payload: "AQID", ...(to === undefined ? {} : { to }) });

export const delivered = (time: number, robot: number, from: number, sequence: number) =>
  record(time, "delivered", { robot, from, sequence });

export const dropped = (time: number, from: number, sequence: number, to: number, reason = "loss") =>
  record(time, "dropped", { robot: from, from, sequence, to, reason });
