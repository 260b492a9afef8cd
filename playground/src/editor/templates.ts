// The initial text of a new file.

import scenario from "../../../apps/starl-catalog/src/default.toml?raw";

/** The scenario of programs that have none, which a person can extend. */
const SCENARIO = `# What is run: the robots, their world and the radio.\n${scenario.replace(/^#.*\n/gm, "")}
[network]
delay = "15ms"
jitter = "5ms"
`;

/** With the program that a scenario is to run. */
export function templateOf(path: string, program?: string): string {
  if (path.endsWith(".toml"))
    return program ? SCENARIO.replace("duration =", `program = "${program}"\nduration =`) : SCENARIO;
  if (!path.endsWith(".starl")) return "";
  const words = path.replace(/^.*\/|\.starl$/g, "").split(/[^A-Za-z0-9]+/);
  const name = words.map((word) => word.charAt(0).toUpperCase() + word.slice(1)).join("");
  return `program ${/^[A-Za-z]/.test(name) ? name : "Program"}\n`;
}
