// The marks of the timeline, in lanes from top to bottom, each with a colour and a shape of its own.

import type { TraceRecord } from "../engine/types.ts";
import { recorded, wordsOf } from "../meddle/words.ts";

export interface Lane {
  name: string;
  topics: string[];
  shape: "cross" | "triangle" | "dot" | "bar" | "diamond";
  /** A variable of the style sheet. */
  color: string;
}

export const LANES: Lane[] = [
  { name: "Violations", topics: ["violation", "collision"], shape: "cross", color: "--violation" },
  { name: "Faults", topics: ["fault", "intervention"], shape: "triangle", color: "--fault" },
  {
    name: "Programs",
    topics: ["program", "status", "thing", "discovered"],
    shape: "diamond",
    color: "--program",
  },
  { name: "Primitives", topics: ["primitive"], shape: "dot", color: "--primitive" },
  { name: "Log", topics: ["log"], shape: "bar", color: "--log" },
];

const LANE_OF = new Map(
  LANES.flatMap((lane, index) => lane.topics.map((topic) => [`/starl/${topic}`, index])),
);

export const laneOf = ({ topic }: TraceRecord): number | undefined => LANE_OF.get(topic);

/** The text of a mark. */
export function describe({ topic, message }: TraceRecord, name: (robot: number) => string): string {
  const who = message.robot === undefined ? "" : `${name(message.robot)}: `;
  const text = (member: string) => String(message[member] ?? "");
  switch (topic) {
    case "/starl/violation":
      return `${text("property")} violated: ${text("text")}`;
    case "/starl/collision": {
      const other = message.with_robot;
      return `${who}touched ${typeof other === "number" ? name(other) : `obstacle ${text("with_obstacle")}`}`;
    }
    case "/starl/fault":
      return `${who}${text("text")}`;
    case "/starl/intervention":
      return `${who}steered: ${steered(message.intervention, name)}`;
    case "/starl/status":
      return `${who}${text("status")}${message.reason ? `: ${text("reason")}` : ""}`;
    case "/starl/primitive":
      return `${who}${text("primitive")} ${text("name")}${fields(message.fields)}`;
    case "/starl/program":
      return `${who}${text("name")}${fields(message.fields)}`;
    case "/starl/action":
      return `${who}action ${text("name")}`;
    case "/starl/log":
      return `${who}${text("text")}`;
    case "/starl/discovered":
      return `${who}met an obstacle that it did not know`;
    case "/starl/thing":
      return `${who}${message.put_down ? "put down" : "took"} thing ${text("thing")}`;
    case "/starl/sent":
      return `${who}sent a message to ${typeof message.to === "number" ? name(message.to) : "all in reach"}`;
    case "/starl/delivered":
      return `${who}received a message from ${name(Number(message.from))}`;
    case "/starl/dropped":
      return `message of ${name(Number(message.from))} lost: ${text("reason")}`;
    default:
      return `${who}${topic.replace("/starl/", "")}`;
  }
}

function steered(text: unknown, name: (robot: number) => string): string {
  const intervention = recorded(text);
  return intervention ? wordsOf(intervention, name) : String(text);
}

/** The fields of an event: ` target=r2, at=(1.00, 2.00)`. */
function fields(list: unknown): string {
  if (!Array.isArray(list) || list.length === 0) return "";
  return ` ${list.map(({ name, ...value }) => `${name}=${short(Object.values(value)[0])}`).join(", ")}`;
}

function short(value: unknown): string {
  if (typeof value === "number") return Number.isInteger(value) ? String(value) : value.toFixed(2);
  if (Array.isArray(value))
    return value.length > 4 ? `${value.length} values` : `[${value.map(short).join(", ")}]`;
  if (value && typeof value === "object" && "x" in value && "y" in value) {
    return `(${short(value.x)}, ${short(value.y)})`;
  }
  return typeof value === "object" ? JSON.stringify(value) : String(value);
}
