// Measures how fast the WebAssembly module runs beside the same simulator natively, on one thread: the same requests,
// in turns, so that both meet the same load of the machine. Prints the ratio of times for each example, the median of
// all pairs, and the geometric mean.
//
// Usage: node speed.mjs PATH-OF-ANSWER [PAIRS]
//
// PATH-OF-ANSWER is the example `answer` of this crate, built with --release.

import { spawn } from "node:child_process";
import { readFileSync } from "node:fs";
import { createInterface } from "node:readline";
import { load } from "./starl.mjs";
import { moduleFile } from "./tests/module.mjs";

const [answer, pairs = "5"] = process.argv.slice(2);
const module = await WebAssembly.compile(readFileSync(moduleFile));
const CASES = [
  ["race", "create=40", 60],
  ["intersection-stream", undefined, 10],
  ["search", undefined, 60],
  ["intersection", undefined, 60],
  ["formation-space", undefined, 60],
  ["flocking", undefined, 60],
];

const child = spawn(answer, { stdio: ["pipe", "pipe", "inherit"] });
const lines = createInterface({ input: child.stdout })[Symbol.asyncIterator]();
async function ask(request) {
  child.stdin.write(`${JSON.stringify(request)}\n`);
  const answer = JSON.parse((await lines.next()).value);
  if (answer.error) throw new Error(answer.error.message);
  return answer.ok;
}

// Several runs count as one, since one alone is over before the browser has compiled what is used most.
const RUNS = 10;

async function natively(options, until) {
  let [took, end] = [0, 0];
  for (let run = 0; run < RUNS; run++) {
    const { simulation } = await ask({ open: { options, topics: [] } });
    const began = performance.now();
    end = (await ask({ run: { simulation, until } })).now;
    took += performance.now() - began;
    await ask({ close: { simulation } });
  }
  return { took, end };
}

const starl = await load(module);
function inWebAssembly(options, until) {
  let [took, end] = [0, 0];
  for (let run = 0; run < RUNS; run++) {
    const simulation = starl.open({}, { ...options, topics: [] });
    const began = performance.now();
    end = simulation.run({ until }).now;
    took += performance.now() - began;
    simulation.close();
  }
  return { took, end };
}

const median = (list) => list.sort((a, b) => a - b)[Math.floor(list.length / 2)];
let product = 1;
for (const [scenario, robots, until] of CASES) {
  const options = { scenario, robots };
  inWebAssembly(options, until);
  const ratios = [];
  let best = Number.POSITIVE_INFINITY;
  for (let pair = 0; pair < Number(pairs); pair++) {
    const native = await natively(options, until);
    const web = inWebAssembly(options, until);
    if (web.end !== native.end) throw new Error(`${scenario}: ends at ${web.end} s, natively at ${native.end} s`);
    ratios.push(web.took / native.took);
    best = Math.min(best, native.took);
  }
  const ratio = median(ratios);
  product *= ratio;
  console.log(`${scenario.padEnd(18)} ${ratio.toFixed(2)} times the native time (native ${(best / RUNS).toFixed(1)} ms at best)`);
}
console.log(`geometric mean     ${(product ** (1 / CASES.length)).toFixed(2)}`);
child.stdin.end();
