// The grammar colours a sample as it is meant to, with the engine that the editor uses.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { test } from "node:test";

const require = createRequire(import.meta.url);
const oniguruma = require("vscode-oniguruma");
const { INITIAL, Registry } = require("vscode-textmate");

const read = (path) => readFileSync(new URL(path, import.meta.url));
const grammarText = read("../syntaxes/starl.tmLanguage.json").toString();

await oniguruma.loadWASM(read("../node_modules/vscode-oniguruma/release/onig.wasm"));
const registry = new Registry({
  onigLib: Promise.resolve({
    createOnigScanner: (sources) => new oniguruma.OnigScanner(sources),
    createOnigString: (text) => new oniguruma.OnigString(text),
  }),
  loadGrammar: async () => JSON.parse(grammarText),
});
const grammar = await registry.loadGrammar("source.starl");

/** The words of a text, each with the innermost scope that it has. */
function words(text) {
  const found = [];
  let state = INITIAL;
  for (const line of text.split("\n")) {
    const { tokens, ruleStack } = grammar.tokenizeLine(line, state);
    for (const { startIndex, endIndex, scopes } of tokens) {
      const word = line.slice(startIndex, endIndex).trim();
      if (word) found.push([word, scopes.at(-1).replace(/\.starl$/, "")]);
    }
    state = ruleStack;
  }
  return found;
}

/** Checks that the words of a line have these scopes, in this order; others may stand between. */
function expect(line, ...expected) {
  const found = words(line);
  let at = 0;
  for (const [word, scope] of expected) {
    const next = found.findIndex(([own], index) => index >= at && own === word);
    assert.notEqual(next, -1, `no word "${word}" in "${line}": ${JSON.stringify(found)}`);
    assert.equal(found[next][1], scope, `"${word}" in "${line}"`);
    at = next + 1;
  }
}

test("declarations", () => {
  expect("program Race", ["program", "keyword.other"], ["Race", "entity.name.namespace"]);
  expect("import geometry", ["import", "keyword.other"], ["geometry", "entity.name.namespace"]);
  expect("enum Location {init, pick}", ["enum", "storage.type"], ["Location", "entity.name.type"], ["init", "variable.other"]);
  expect("message Reached(index: Int)", ["message", "storage.type"], ["Reached", "entity.name.type"], ["Int", "support.type"]);
  expect("param vicinity: Float = 75mm", ["param", "storage.modifier"], ["vicinity", "variable.other.constant"], ["Float", "support.type"], ["75", "constant.numeric"], ["mm", "keyword.other.unit"]);
  expect("allread[causal] pos[RobotId]: Point", ["allread", "storage.modifier"], ["causal", "constant.language"], ["pos", "variable.other.readwrite"], ["RobotId", "support.type"]);
  expect("function half(x: Float) -> Float = x / 2.0", ["function", "storage.type.function"], ["half", "entity.name.function"], ["->", "keyword.operator.arrow"], ["2.0", "constant.numeric.float"]);
  expect("motion = ReachAvoid(vicinity = vicinity)", ["motion", "variable.other"], ["ReachAvoid", "entity.name.type"], ["vicinity", "variable.parameter"], ["=", "keyword.operator.assignment"], ["vicinity", "variable.other"]);
  expect("on input go_home(to: Point)", ["on", "keyword.control"], ["input", "keyword.control"], ["go_home", "entity.name.type.event"], ["Point", "support.type"]);
  expect("on input(from)", ["on", "keyword.control"], ["input", "entity.name.type.event"]);
  expect("role leader", ["role", "storage.type.class"], ["leader", "entity.name.class"]);
  expect("loc: enum {a, b} = a", ["loc", "variable.other"], ["enum", "storage.type"]);
});

test("actions and handlers", () => {
  expect("pick()", ["pick", "entity.name.function.action"]);
  expect("    pre loc == init and not motion.done // why", ["pre", "keyword.control.clause"], ["==", "keyword.operator.comparison"], ["and", "keyword.operator.logical"], ["not", "keyword.operator.logical"], ["done", "variable.other.property"], ["// why", "comment.line.double-slash"]);
  expect("    eff motion.reach_avoid(p, obstacles()); loc = wait", ["eff", "keyword.control.clause"], ["reach_avoid", "entity.name.function.member"], ["obstacles", "entity.name.function"], [";", "punctuation.separator"]);
  expect("on Reached(from, index)", ["on", "keyword.control"], ["Reached", "entity.name.type.event"], ["from", "variable.other"]);
  expect("on radio.failed(number)", ["on", "keyword.control"], ["radio", "variable.other.object"], ["failed", "entity.name.type.event"]);
  expect("init", ["init", "keyword.control"]);
  expect("        atomic", ["atomic", "keyword.control"]);
});

test("words that have a meaning only in their place are names elsewhere", () => {
  expect("loc = init", ["init", "variable.other"]);
  expect("let message = program + within", ["message", "variable.other"], ["program", "variable.other"]);
  expect("pre role == leader", ["role", "variable.language"], ["leader", "variable.other"]);
  expect("role = follower", ["role", "variable.language"], ["=", "keyword.operator.assignment"]);
  expect("x = a.on + b.in_order", ["on", "variable.other.property"], ["in_order", "variable.other.property"]);
});

test("properties", () => {
  expect("invariant in_order: currentIndex <= target.size()", ["invariant", "keyword.other.property"], ["in_order", "entity.name.function.property"], ["<=", "keyword.operator.comparison"]);
  expect("eventually all_done: forall r: r.finished within 120s", ["eventually", "keyword.other.property"], ["forall", "keyword.other.quantifier"], ["finished", "variable.other.property"], ["within", "keyword.other.property"], ["120", "constant.numeric"], ["s", "keyword.other.unit"]);
  expect("always: exists r, s: r.a == 1 leads_to s.b", ["always", "keyword.other.property"], ["exists", "keyword.other.quantifier"], ["leads_to", "keyword.other.property"]);
});

test("statements and expressions", () => {
  expect("if some p = pos[me] and p.x > 1.5e-3 then return none", ["if", "keyword.control"], ["some", "keyword.other.some"], ["me", "variable.language"], ["1.5e-3", "constant.numeric.float"], ["then", "keyword.control"], ["return", "keyword.control"], ["none", "constant.language"]);
  expect('log("{} \\"a\\" \\u{e9} // b", k ?? v!)', ["log", "entity.name.function"], ["{}", "constant.other.placeholder"], ['\\"', "constant.character.escape"], ["\\u{e9}", "constant.character.escape"], ["// b", "string.quoted.double"], ["??", "keyword.operator.optional"], ["!", "keyword.operator.optional"]);
  expect("for i in 0..limit", ["for", "keyword.control"], ["in", "keyword.control"], ["0", "constant.numeric.integer"], ["..", "keyword.operator.range"]);
  expect("let x: List[Point?] = []", ["let", "storage.type"], ["List", "support.type"], ["?", "keyword.operator.optional"]);
});

test("comments", () => {
  expect("/// What it is.", ["/// What it is.", "comment.line.documentation"]);
  expect("x: Int // how many", ["// how many", "comment.line.double-slash"]);
});

test("a text that does not end in its line goes no further", () => {
  const found = words('log("open\nlet x = 1');
  assert.deepEqual(found.find(([word]) => word === "let"), ["let", "storage.type"]);
});

test("every word of every listing has a scope", () => {
  const folder = "../../../crates/starl-lang/tests/listings/";
  for (const name of ["race", "formation", "mutex_usage", "intersection", "every_form"]) {
    for (const [word, scope] of words(read(`${folder}${name}.starl`).toString())) {
      if (/^[A-Za-z_]\w*$/.test(word)) assert.notEqual(scope, "source", `"${word}" in ${name}`);
    }
  }
});
