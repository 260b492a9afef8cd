// What a new file begins with.

/** A scenario that a person can go on from: as the default one, a floor with four robots and four places. */
export const SCENARIO = `# What is run: the robots, their world and the radio.
duration = "60s"

[[robots]]
model = "create"
count = 4

[world]
start_area = { low = [0, 0], high = [4, 4] }

[[world.way_point]]
name = "A"
position = [1, 1]

[[world.way_point]]
name = "B"
position = [3, 1]

[[world.way_point]]
name = "C"
position = [3, 3]

[network]
delay = "15ms"
jitter = "5ms"
`;

export function templateOf(path: string, program?: string): string {
  if (path.endsWith(".toml"))
    return program ? SCENARIO.replace("duration", `program = "${program}"\nduration`) : SCENARIO;
  if (!path.endsWith(".starl")) return "";
  const words = path.replace(/^.*\/|\.starl$/g, "").split(/[^A-Za-z0-9]+/);
  const name = words.map((word) => word.charAt(0).toUpperCase() + word.slice(1)).join("");
  return `program ${/^[A-Za-z]/.test(name) ? name : "Program"}\n`;
}
