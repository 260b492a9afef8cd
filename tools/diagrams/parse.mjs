// Reads state diagrams with Mermaid's own parser, and compares what it understood with what was meant:
// each line of the drawing that is a step.
//
//     node parse.mjs FILE.mmd...

import fs from "node:fs";
import { JSDOM } from "jsdom";

const page = new JSDOM("<body></body>");
globalThis.window = page.window;
globalThis.document = page.window.document;
const { default: mermaid } = await import("mermaid");

for (const file of process.argv.slice(2)) {
  const text = fs.readFileSync(file, "utf8");
  const steps = text.split("\n").filter((line) => line.includes("-->"));
  await mermaid.parse(text);
  const diagram = await mermaid.mermaidAPI.getDiagramFromText(text);
  const read = diagram.db.getRelations();
  const ends = (name) => (name === "[*]" ? undefined : name);
  steps.forEach((line, number) => {
    const [, from, to, cause] = line.match(/^ *(\S+) --> ([^\s:]+)(?:: (.*))?$/);
    const { id1, id2, relationTitle } = read[number];
    const isSame =
      (ends(from) ?? id1) === id1 && (ends(to) ?? id2) === id2 && (cause ?? "") === (relationTitle ?? "");
    if (!isSame) throw new Error(`${file}: ${line.trim()} is read as ${JSON.stringify(read[number])}`);
  });
  if (read.length !== steps.length) throw new Error(`${file}: ${read.length} steps, not ${steps.length}`);
  console.log(`${file}: ${read.length} steps`);
}
