"""Finds the text that people read in the project's files: pages, comments, messages, and names of tests."""

import re
from typing import NamedTuple


class Block(NamedTuple):
    """A run of text: a paragraph, a list item, a cell of a table, a comment, a message or a name."""

    kind: str  # page, heading, comment, message or test
    line: int  # where it begins, from 1
    text: str  # with inline code replaced, and one line of text for each line of the file


INLINE_CODE = re.compile(r"``.+?``|`[^`]+`", re.S)
LINK = re.compile(r"!?\[((?:[^\[\]]|\[[^\]]*\])*)\]\([^)\s]*\)")


def plain(text):
    """Text without its inline code and the targets of its links."""
    text = INLINE_CODE.sub(lambda code: "`x`" + "\n" * code[0].count("\n"), text)
    text = LINK.sub(r"\1", text)
    return re.sub(r"\]\[[\w:`-]*\]|\*\*|(?<!\w)[*_](?=\w)|(?<=\w)[*_](?!\w)|<[^>\s]*>", "", text)


def markdown(lines, first, kind):
    """The blocks of Markdown lines, of which the first has the number `first`. Tables after an HTML comment are
    generated, so their source is checked instead."""
    fenced, generated, begin, block = False, False, first, []

    def close():
        if block:
            yield Block(kind, begin, plain("\n".join(block)))
        block.clear()

    for number, line in enumerate(lines, first):
        fence = line.lstrip().startswith("```")
        item = re.match(r"\s*(?:[-*+]|\d+\.)\s+", line)
        if fence or fenced or not line.strip():
            yield from close()
            fenced = fenced != fence
        elif heading := re.match(r"#+ +(.*)", line):
            yield from close()
            generated = False
            yield Block("heading", number, plain(heading[1]))
        elif line.startswith("<!--"):
            yield from close()
            generated = True
        elif line.lstrip().startswith("|"):
            yield from close()
            if generated:
                continue
            for cell in re.split(r"(?<!\\)\|", INLINE_CODE.sub("`x`", line.strip().strip("|"))):
                if re.search(r"\w", cell):
                    yield Block(kind, number, plain(cell.strip()))
        else:
            if item:
                yield from close()
            if not block:
                begin = number
            block.append(line[item.end() :] if item else line.strip())
    yield from close()


TOKEN = re.compile(
    r"""(?P<comment>//[^\n]*(?:\n[ \t]*//[^\n]*)*)
    |(?P<block>/\*.*?\*/)
    |r(?P<hashes>\#*)"(?P<raw>.*?)"(?P=hashes)
    |"(?P<string>(?:[^"\\]|\\.)*)"
    |'(?:[^'\\\n]|\\[^\n]{1,9})'
    |\#\[(?:tokio::)?test\](?:\s*\#\[[^\n]*\])*\s*(?:async\s+)?fn\s+(?P<test>\w+)""",
    re.S | re.X,
)


def rust(text, in_tests):
    """The blocks of a file in Rust."""
    line, at = 1, 0
    for token in TOKEN.finditer(text):
        line, at = line + text.count("\n", at, token.start()), token.start()
        yield from token_blocks(token, line, in_tests)


def token_blocks(token, line, in_tests):
    if token["comment"]:
        lines = [re.sub(r"^\s*//[/!]? ?", "", part) for part in token["comment"].split("\n")]
        yield from markdown(lines, line, "comment")
    elif token["block"]:
        lines = [re.sub(r"^\s*(/\*+!?|\*/|\*)? ?|\*/$", "", part) for part in token["block"].split("\n")]
        yield from markdown(lines, line, "comment")
    elif token["test"]:
        yield Block("test", line + token[0].count("\n"), token["test"].replace("_", " "))
    elif not in_tests:
        text = token["string"] or token["raw"] or ""
        if re.match(r"[A-Za-z`{][^\n]*? \S+ \S", text):
            text = re.sub(r"\\\n\s*", "\n", text)
            yield Block("message", line, plain(re.sub(r"\\n|\\\"|\{[^{}]*\}", " ", text)))


SCRIPT = re.compile(
    r"""(?P<comment>//[^\n]*(?:\n[ \t]*//[^\n]*)*)|(?P<block>/\*.*?\*/)
    |"(?:[^"\\\n]|\\.)*"|'(?:[^'\\\n]|\\.)*'|`(?:[^`\\]|\\.)*`(?P<test>(?!))(?P<string>(?!))(?P<raw>(?!))""",
    re.S | re.X,
)


def typescript(text):
    """The comments of a file in TypeScript or JavaScript."""
    for token in SCRIPT.finditer(text):
        if token["comment"] or token["block"]:
            yield from token_blocks(token, 1 + text.count("\n", 0, token.start()), in_tests=True)


def hashed(text, marker="#"):
    """The comments of a file in which `marker` begins one."""
    begin, block = 1, []
    for number, line in enumerate(text.split("\n"), 1):
        if line.lstrip().startswith(marker) and not line.startswith("#!"):
            if not block:
                begin = number
            block.append(line.strip().lstrip(marker).strip())
        else:
            yield from markdown(block, begin, "comment")
            block = []
    yield from markdown(block, begin, "comment")


def blocks_of(path, text):
    """The blocks of a file, by what kind of file it is."""
    name = str(path)
    if name.endswith(".md"):
        yield from markdown(text.split("\n"), 1, "page")
    elif name.endswith(".rs"):
        yield from rust(text, in_tests="/tests/" in name or "/benches/" in name)
    elif name.endswith((".ts", ".tsx", ".mjs", ".js")):
        yield from typescript(text)
    elif name.endswith(".starl"):
        yield from hashed(text, "/")
    elif name.endswith((".py", ".sh", ".toml", ".yml", "Makefile", "Dockerfile")):
        yield from hashed(text)
