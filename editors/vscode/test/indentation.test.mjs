// After a line that opens a block the next one is indented deeper, and after no other.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";

const path = new URL("../language-configuration.json", import.meta.url);
const { indentationRules, onEnterRules, wordPattern } = JSON.parse(readFileSync(path));
const increase = new RegExp(indentationRules.increaseIndentPattern);
const decrease = new RegExp(indentationRules.decreaseIndentPattern);

test("lines that open a block", () => {
  for (const line of [
    "pick()",
    "init",
    "    init",
    "    eff",
    "    eff // what it does",
    "        if x > 1 and y == 2",
    "        elif x",
    "        else",
    "        for i in 0..3",
    "        atomic",
    "on Reached(from, index)",
    "on radio.failed(number)",
    "role leader",
    "function f(x: Int) -> Int",
  ]) {
    assert.match(line, increase);
  }
});

test("lines that open none", () => {
  for (const line of [
    "program Race",
    "x: Int = 0",
    "    eff x = 1",
    "    pre x == 1",
    "        finish()",
    "        if x then y = 1",
    "        if x then y = 1 else y = 2",
    "        role = leader",
    "        else x = 1",
    "        onward = 1",
    "        format = 2",
    "        let ready = x",
    "function f(x: Int) -> Int = x",
    "invariant i: x == 1",
    "// if",
  ]) {
    assert.doesNotMatch(line, increase);
  }
});

test("else and elif stand where their if does", () => {
  assert.match("            else", decrease);
  assert.match("            elif x", decrease);
  assert.doesNotMatch("            elsewhere = 1", decrease);
});

test("a documenting comment goes on in the next line", () => {
  assert.match("    /// What it is.", new RegExp(onEnterRules[0].beforeText));
  assert.doesNotMatch("    // Why.", new RegExp(onEnterRules[0].beforeText));
});

test("a word is a name", () => {
  const word = new RegExp(`^${wordPattern}$`);
  assert.match("current_index2", word);
  assert.doesNotMatch("a.b", word);
});
