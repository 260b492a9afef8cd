// Runs the same scenarios natively and in WebAssembly and compares their digests and outcomes, and the
// digests with those written down in golden.json: a change that moves them must say so. In WebAssembly a run goes
// in pieces, with a step back to a snapshot. Then runs that are steered and looked into are compared: every answer
// of the native host, `examples/answer.rs`, must be that of the module to the last byte.
//
// Usage: node golden.mjs PATH-OF-STARL PATH-OF-ANSWER [--write]
//
// With --write the digests of the native runs are written down instead; those of WebAssembly must be
// the same even so.

import { spawnSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { load } from "./starl.mjs";
import { moduleFile } from "./tests/module.mjs";

const GOLDEN = new URL("./golden.json", import.meta.url);

const [starl, answer] = process.argv.slice(2);
const write = process.argv[4] === "--write";
const module = await WebAssembly.compile(readFileSync(moduleFile));

async function inWebAssembly({ example, set, robots }) {
  const simulation = (await load(module)).open({}, { scenario: example, set, robots });
  simulation.run({ until: simulation.duration / 8 });
  const snapshot = simulation.snapshot();
  simulation.run({ steps: 333 });
  simulation.restore(snapshot);
  simulation.drop(snapshot);
  while (!simulation.run({ steps: 997 }).over);
  const { digest, outcome, now } = simulation.report();
  simulation.close();
  return { digest, outcome, sim_seconds: now };
}

function natively(request) {
  const { example, set = [], robots } = request;
  const options = set.flatMap((field) => ["--set", field]);
  if (robots) options.push("--robots", robots);
  // A run that violates a property ends with status 1 and is compared too.
  const { error, stdout, stderr } = spawnSync(starl, ["run", example, "--json", ...options], { encoding: "utf8" });
  if (!stdout) throw new Error(`${starl} refused ${JSON.stringify(request)}: ${error ?? stderr}`);
  return JSON.parse(stdout);
}

// The actions of a page: it steers the run, goes back, and inspects robots.
function* visit(example) {
  const about = { simulation: 0 };
  const at = { x: 1.5, y: 1.0, z: 0 };
  const pose = { position: { x: -4, y: -4, z: 0 }, yaw: 1, pitch: 0, roll: 0 };
  const circle = { Circle: { center: { x: 0.5, y: 0.5, z: 0 }, radius: 0.2, height: null } };
  const look = () => [{ robot: { ...about, robot: 0 } }, { report: about }, { world: about }, { fleet: about }];
  const apply = (intervention, time) => ({ apply: { ...about, at: time, intervention } });
  yield { open: { options: { scenario: example, seed: "21", robots: "create=3" } } };
  yield { run: { ...about, until: 1 } };
  yield* look();
  yield { snapshot: about };
  yield apply({ fault: { crash: [1] } });
  yield apply({ fault: { restart: [1] } }, 3);
  yield apply({ network: [{ loss: 0.3 }, { delay: 40_000_000 }] }, 1.5);
  yield apply({ push: { robot: 0, by: { x: 0.2, y: -0.1, z: 0 } } }, 2);
  yield apply({ add_obstacle: { obstacle: circle, hidden: true } }, 2.5);
  yield apply({ set_way_point: { name: "new", position: at, group: 0 } }, 3);
  yield apply({ join: { like: 0, name: "late", pose } }, 3.5);
  yield apply({ leave: [2] }, 4);
  yield { run: { ...about, until: 6 } };
  yield* look();
  yield { records: { ...about, max: 100_000 } };
  yield { scenario: about };
  yield { restore: { ...about, snapshot: 0 } };
  yield { run: { ...about, until: 4 } };
  yield* look();
}

async function compareVisit(example) {
  const starl = await load(module);
  const requests = [...visit(example)];
  const answers = requests.map((request) => starl.request(request));
  const input = requests.map((request) => JSON.stringify(request) + "\n").join("");
  const { error, stdout, stderr } = spawnSync(answer, { input, encoding: "utf8", maxBuffer: 1 << 30 });
  if (!stdout) throw new Error(`${answer} does not answer: ${error ?? stderr}`);
  const native = stdout.trimEnd().split("\n").map((line) => JSON.parse(line).ok);
  const first = requests.findIndex((_, index) => JSON.stringify(native[index]) !== JSON.stringify(answers[index]));
  if (first >= 0) console.log(`  native and wasm differ at ${JSON.stringify(requests[first])}`);
  return first < 0;
}

let failed = 0;
const golden = JSON.parse(readFileSync(GOLDEN, "utf8"));
for (const entry of golden) {
  const { digest, ...request } = entry;
  const native = natively(request);
  const web = await inWebAssembly(request);
  const same = ["digest", "outcome", "sim_seconds"].every((key) => native[key] === web[key]);
  if (write) entry.digest = native.digest;
  const passed = same && native.digest === entry.digest;
  failed += !passed;
  const tell = ({ digest, outcome, sim_seconds }) => `${digest} (${outcome} after ${sim_seconds} s)`;
  console.log(`${passed ? "same" : "DIFFERENT"}: ${JSON.stringify(request)}`);
  if (!passed) console.log(`  native ${tell(native)}\n  wasm   ${tell(web)}\n  golden ${entry.digest}`);
}
const visited = ["race", "formation", "mutex", "search", "memory"];
for (const example of visited) {
  const passed = await compareVisit(example);
  failed += !passed;
  console.log(`${passed ? "same" : "DIFFERENT"}: ${example}, steered and looked into`);
}
if (write) {
  const lines = golden.map((entry) => "  " + JSON.stringify(entry).replaceAll('":', '": ').replaceAll(',"', ', "'));
  writeFileSync(GOLDEN, `[\n${lines.join(",\n")}\n]\n`);
}
console.log(`${golden.length + visited.length - failed} passed, ${failed} failed`);
process.exit(failed ? 1 : 0);
