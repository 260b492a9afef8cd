"""Checks the project's pages, comments, messages and test names against its rules for plain English
(`tools/prose/rules.toml`).

    python3 tools/check_prose.py [FILE...]
"""

import pathlib
import re
import subprocess
import sys
import tomllib
from fnmatch import fnmatch
from typing import NamedTuple

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


class Style(NamedTuple):
    """All rules."""

    rules: list
    longest: int  # words of a sentence
    verbs: set  # of which the first sentence of a page has one


# A full stop that is not part of an abbreviation or an initial, and what follows it.
SENTENCE_END = re.compile(
    r"(?<![ (]e\.g)(?<![ (]i\.e)(?<!\bvs)(?<!\bpp)(?<! [A-Z])[.!?][\")\]*’”]*(?=\s+[^a-z\s]|\s*$)"
)


def sentences(block):
    """The sentences of a block, with their lines."""
    begin = 0
    for end in SENTENCE_END.finditer(block.text):
        yield block.line + block.text.count("\n", 0, begin), block.text[begin : end.end()].strip()
        begin = end.end() + 1
    if block.text[begin:].strip():
        yield block.line + block.text.count("\n", 0, begin), block.text[begin:].strip()


def sentence_problems(block, longest):
    """Problems of whole sentences: too long, or no main clause."""
    if block.kind not in ("page", "comment"):
        return
    for line, sentence in sentences(block):
        words = sentence.split()
        if max(len(part.split()) for part in sentence.split(";")) > longest:
            yield line, f'a sentence of {len(words)} words, more than {longest}: "{" ".join(words[:6])} ..."'
        if re.match(r"(What|Who|Whom|Whoever|Whose)\b", sentence) and "?" not in sentence:
            yield line, f'begins with "{words[0]}" and is not a question: "{" ".join(words[:6])} ..."'


def opening_problem(blocks, verbs):
    """A page begins with a sentence that has a verb."""
    opening = next((block for block in blocks if block.kind == "page"), None)
    if opening:
        line, sentence = next(sentences(opening))
        words = re.findall(r"\w+", sentence.lower())
        if not any(word in verbs or word.endswith("ed") for word in words):
            yield line, f'the page begins with a sentence without a verb: "{sentence}"'


def repetitions(text, blocks):
    """A page has no section twice, and no sentence of more than twelve words."""
    seen = set()
    for section in re.finditer(r"^## .*", re.sub(r"^```.*?^```", "", text, flags=re.M | re.S), re.M):
        if section[0] in seen:
            yield text.count("\n", 0, text.rindex(section[0])) + 1, f'the page has the heading "{section[0]}" twice'
        seen.add(section[0])
    for block in blocks:
        if block.kind == "page":
            for line, sentence in sentences(block):
                text = " ".join(sentence.split())
                if len(text.split()) > 12 and text in seen:
                    yield line, f'the page has this sentence twice: "{text}"'
                seen.add(text)


def problems_of(name, text, style):
    blocks = list(blocks_of(name, text))
    for block in blocks:
        for rule in style.rules:
            yield from rule.problems(block)
        yield from sentence_problems(block, style.longest)
    if name.endswith(".md"):
        yield from opening_problem(blocks, style.verbs)
        yield from repetitions(text, blocks)


def failed_examples(style):
    """The examples that a rule should find and does not, or should accept and does not."""
    for rule in style.rules:
        kind = rule.where[0]
        if not list(rule.problems(Block(kind, 1, rule.finds))):
            yield f"rules.toml: {rule.name}: does not find: {rule.finds}"
        accepted = list(markdown([rule.passes], 1, kind))
        if found := [text for block in accepted for _, text in rule.problems(block)]:
            yield f"rules.toml: {rule.name}: finds {found} in: {rule.passes}"
    bad = {
        "a sentence that is too long": "word " * (style.longest + 1) + "is long.",
        "a sentence that begins with What": "It stops. What it knows is lost.",
        "a page that begins without a verb": "Short texts about one question each.",
        "a section that a page has twice": "It stops.\n\n## End\n\nIt stops.\n\n## End\n",
        "a sentence that a page has twice": 2 * "A robot that has lost its leader waits for one second before it asks. ",
        "a word in a comment": ("x.rs", "/// Mends it.\nfn x() {}"),
        "a word in a message": ("x.rs", 'fn x() { panic!("the robot mends it") }'),
        "a word in the name of a test": ("x.rs", "#[test]\nfn it_mends() {}"),
    }
    for what, example in bad.items():
        name, text = example if isinstance(example, tuple) else ("page.md", example)
        if not list(problems_of(name, text, style)):
            yield f"check_prose.py: does not find {what}: {text}"
    good = "This page shows what a robot knows. What does it do?\n\n```text\nmends\n```\n\nThe field `mend` is code."
    if found := list(problems_of("page.md", good, style)):
        yield f"check_prose.py: finds {found} in: {good}"


def texts(names, excluded):
    """The text files among these, with their texts."""
    for name in names:
        path = ROOT / name
        if path.is_file() and not any(fnmatch(name, pattern) for pattern in excluded):
            try:
                yield name, path.read_text(encoding="utf-8")
            except UnicodeDecodeError:
                continue


def main(arguments):
    settings = tomllib.loads((ROOT / "tools/prose/rules.toml").read_text(encoding="utf-8"))
    rules = [Rule(**rule) for rule in settings["rule"]]
    style = Style(rules, settings["longest_sentence"], set(settings["verbs"].split()))
    tracked = ["git", "ls-files", "--cached", "--others", "--exclude-standard"]
    names = arguments or subprocess.run(tracked, cwd=ROOT, check=True, capture_output=True, text=True).stdout.split("\n")
    problems, count = list(failed_examples(style)), 0
    for name, text in texts(names, settings["exclude"]):
        count += 1
        problems += [f"{name}:{line}: {problem}" for line, problem in problems_of(name, text, style)]
    print("\n".join(problems) or f"{count} files: plain English by the rules of tools/prose/rules.toml")
    return bool(problems)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
