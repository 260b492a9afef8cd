// The kinds of events that a person can choose between.

export interface Kind {
  name: string;
  topics: string[];
}

export const KINDS: Kind[] = [
  { name: "Violations", topics: ["violation", "collision"] },
  { name: "Faults", topics: ["fault", "intervention"] },
  { name: "Programs", topics: ["program", "status", "thing", "discovered"] },
  { name: "Log lines", topics: ["log"] },
  { name: "Primitives", topics: ["primitive"] },
  { name: "Actions", topics: ["action"] },
  { name: "Messages", topics: ["sent", "delivered", "dropped"] },
  { name: "Drawings", topics: ["mark"] },
];

/** `/starl/action` as `action`. */
export const kindOf = (topic: string): string => topic.slice(topic.lastIndexOf("/") + 1);

const KIND_OF = new Map(KINDS.flatMap(({ name, topics }) => topics.map((topic) => [topic, name])));

export const kindNameOf = (topic: string): string => KIND_OF.get(kindOf(topic)) ?? "Programs";
