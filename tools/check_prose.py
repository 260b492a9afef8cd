"""Checks the project's pages, comments, messages and test names against its rules for plain English
(`tools/prose/rules.toml`).

    python3 tools/check_prose.py [FILE...]
"""

import pathlib
import re
import subprocess
import sys
import tomllib

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from prose.extract import Block, blocks_of, markdown  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent
KINDS = ["page", "heading", "comment", "message", "test"]


class Rule:
    """A rule of the vocabulary."""

    def __init__(self, name, pattern, write, finds, passes, where=None, unless=None):
        self.name, self.write, self.finds, self.passes = name, write, finds, passes
        self.where = where or KINDS
        self.pattern = re.compile(pattern.replace(" ", r"\s+"), re.I)
        self.unless = unless and re.compile(unless.replace(" ", r"\s+"), re.I)

    def problems(self, block):
        if block.kind not in self.where:
            return
        excused = {match.end() for match in self.unless.finditer(block.text)} if self.unless else set()
        for match in self.pattern.finditer(block.text):
            if match.end() not in excused:
                line = block.line + block.text.count("\n", 0, match.start())
                found = " ".join(match[0].split())
                yield line, f'"{found}": write {self.write}'


def sentences(block):
    """The sentences of a block, with their lines."""
    begin = 0
    for end in re.finditer(r"(?<![ (]e\.g)(?<![ (]i\.e)(?<!\bvs)(?<!\bpp)(?<! [A-Z])[.!?][\")\]*’”]*(?=\s+[^a-z\s]|\s*$)", block.text):
        yield block.line + block.text.count("\n", 0, begin), block.text[begin : end.end()].strip()
        begin = end.end() + 1
    if block.text[begin:].strip():
        yield block.line + block.text.count("\n", 0, begin), block.text[begin:].strip()


def sentence_problems(block, longest):
    """What is wrong with whole sentences."""
    if block.kind not in ("page", "comment"):
        return
    for line, sentence in sentences(block):
        words = sentence.split()
        if max(len(part.split()) for part in sentence.split(";")) > longest:
            yield line, f'a sentence of {len(words)} words, more than {longest}: "{" ".join(words[:6])} ..."'
        if re.match(r"(What|Who|Whom|Whoever|Whose)\b", sentence) and "?" not in sentence:
            yield line, f'begins with "{words[0]}" and is no question: "{" ".join(words[:6])} ..."'


def opening_problem(blocks, verbs):
    """A page begins with a sentence that has a verb."""
    opening = next((block for block in blocks if block.kind == "page"), None)
    if opening:
        line, sentence = next(sentences(opening))
        words = re.findall(r"\w+", sentence.lower())
        if not any(word in verbs or word.endswith("ed") for word in words):
            yield line, f'the page begins with a sentence without a verb: "{sentence}"'


def problems_of(name, text, rules, longest, verbs):
    blocks = list(blocks_of(name, text))
    for block in blocks:
        for rule in rules:
            yield from rule.problems(block)
        yield from sentence_problems(block, longest)
    if name.endswith(".md"):
        yield from opening_problem(blocks, verbs)


def test_rules(rules, longest, verbs):
    """Every rule finds what it is there for and lets pass what it is not."""
    for rule in rules:
        kind = rule.where[0]
        if not list(rule.problems(Block(kind, 1, rule.finds))):
            yield f"rules.toml: {rule.name}: does not find: {rule.finds}"
        if found := [text for block in markdown([rule.passes], 1, kind) for _, text in rule.problems(block)]:
            yield f"rules.toml: {rule.name}: finds {found} in: {rule.passes}"
    bad = {
        "a sentence that is too long": "word " * (longest + 1) + "is long.",
        "a sentence that begins with What": "It stops. What it knows is lost.",
        "a page that begins without a verb": "Short texts about one question each.",
    }
    for what, text in bad.items():
        if not list(problems_of("page.md", text, [], longest, verbs)):
            yield f"check_prose.py: does not find {what}: {text}"
    for good in ["This page shows what a robot knows. What does it do?"]:
        if list(problems_of("page.md", good, rules, longest, verbs)):
            yield f"check_prose.py: does not let pass: {good}"


def main(arguments):
    settings = tomllib.loads((ROOT / "tools/prose/rules.toml").read_text(encoding="utf-8"))
    rules = [Rule(**rule) for rule in settings["rule"]]
    longest = settings["longest_sentence"]
    verbs = set(settings["verbs"].split())
    problems = list(test_rules(rules, longest, verbs))
    tracked = ["git", "ls-files", "--cached", "--others", "--exclude-standard"]
    names = arguments or subprocess.run(tracked, cwd=ROOT, check=True, capture_output=True, text=True).stdout.split("\n")
    count = 0
    for name in names:
        path = ROOT / name
        if not name or name.startswith(tuple(settings["exclude"])) or not path.is_file():
            continue
        try:
            text = path.read_text(encoding="utf-8")
        except UnicodeDecodeError:
            continue
        count += 1
        problems += [f"{name}:{line}: {problem}" for line, problem in problems_of(name, text, rules, longest, verbs)]
    print("\n".join(problems) or f"{count} files: plain English by the rules of tools/prose/rules.toml")
    return bool(problems)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
