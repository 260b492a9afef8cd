// Runs the same scenarios natively and in WebAssembly and compares their digests and outcomes, and the
// digests with those written down in golden.json: a change that moves them must say so.
//
// Usage: node golden.mjs PATH-OF-STARL [--write]
//
// With --write the digests of the native runs are written down instead; those of WebAssembly must be
// the same even so. The module is taken from $CARGO_TARGET_DIR, or else from target/.

import { spawnSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";

const TARGET = process.env.CARGO_TARGET_DIR ?? new URL("../../target", import.meta.url).pathname;
const MODULE = `${TARGET}/wasm32-unknown-unknown/release/starl_wasm.wasm`;
const GOLDEN = new URL("./golden.json", import.meta.url);

const starl = process.argv[2];
const write = process.argv[3] === "--write";
const module = await WebAssembly.compile(readFileSync(MODULE));

async function inWebAssembly(request) {
  const { exports } = await WebAssembly.instantiate(module, {});
  const bytes = new TextEncoder().encode(JSON.stringify(request));
  const at = exports.buffer(bytes.length);
  new Uint8Array(exports.memory.buffer, at, bytes.length).set(bytes);
  const length = exports.run();
  const answer = new Uint8Array(exports.memory.buffer, exports.answer(), length);
  const { ran, refused } = JSON.parse(new TextDecoder().decode(answer));
  if (!ran) throw new Error(`WebAssembly refused ${JSON.stringify(request)}: ${refused}`);
  return ran;
}

function natively(request) {
  const { example, set = [], robots } = request;
  const options = set.flatMap((field) => ["--set", field]);
  if (robots) options.push("--robots", robots);
  // A run that violates a property ends with status 1 and is compared all the same.
  const { error, stdout, stderr } = spawnSync(starl, ["run", example, "--json", ...options], { encoding: "utf8" });
  if (!stdout) throw new Error(`${starl} refused ${JSON.stringify(request)}: ${error ?? stderr}`);
  return JSON.parse(stdout);
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
if (write) {
  const lines = golden.map((entry) => "  " + JSON.stringify(entry).replaceAll('":', '": ').replaceAll(',"', ', "'));
  writeFileSync(GOLDEN, `[\n${lines.join(",\n")}\n]\n`);
}
console.log(`${golden.length - failed} passed, ${failed} failed`);
process.exit(failed ? 1 : 0);
