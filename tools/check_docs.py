"""Checks that every relative link of the project's Markdown files leads to a file, and to a heading of it, that the paths
which the maps of the code name exist, and that programs are quoted as they are.

    python3 tools/check_docs.py
"""

import pathlib
import re
import subprocess
import sys

MAPS = ["ARCHITECTURE.md", "CONTRIBUTING.md"]
ROOT = pathlib.Path(__file__).resolve().parent.parent


def text_of(path):
    """The page without its code, in which brackets are no links."""
    text = path.read_text(encoding="utf-8")
    return re.sub(r"^```.*?^```$|`[^`\n]+`", lambda m: re.sub(r"[\[\]()#]", " ", m[0]), text, flags=re.M | re.S)


def anchors_of(path):
    """The anchors of a page's headings, as GitHub makes them."""
    titles = re.findall(r"^#+ +(.+?) *$", text_of(path), re.M)
    return {re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") for title in titles}


def problems_of(page):
    for number, line in enumerate(text_of(page).splitlines(), 1):
        for link in re.findall(r"\]\(([^)\s]+)\)", line):
            if re.match(r"[a-z]+:", link):
                continue
            name, _, anchor = link.partition("#")
            target = (page.parent / name).resolve() if name else page
            where = f"{page.relative_to(ROOT)}:{number}"
            if not target.exists():
                yield f"{where}: {link}: there is no such file"
            elif anchor and target.suffix == ".md" and anchor not in anchors_of(target):
                yield f"{where}: {link}: there is no such heading"


def missing_paths_of(page):
    for number, line in enumerate(page.read_text(encoding="utf-8").splitlines(), 1):
        for path in re.findall(r"`((?:crates|apps|examples|docs|fuzz|tools)/[\w./-]*)`", line):
            if "NAME" not in path and not (ROOT / path).exists():
                yield f"{page.name}:{number}: {path}: there is no such file or folder"


def code_of(text):
    """The lines of a program, without comments, indentation and white space at their ends."""
    return "\n".join(re.sub(r"\s*//.*", "", line).strip() for line in text.splitlines())


def misquotes_of(page):
    """The quoted parts of programs that no program of the page's example has; `...` stands for anything on a line."""
    programs = page.parent.glob("*.starl" if page.parent != ROOT else "examples/*/*.starl")
    sources = [code_of(path.read_text(encoding="utf-8")) for path in programs]
    text = page.read_text(encoding="utf-8")
    for block in re.finditer(r"^```starl\n(.*?)^```$", text, re.M | re.S):
        for part in re.split(r"\n{2,}", code_of(block[1])):
            pattern = r"[^\n]*".join(re.escape(piece) for piece in part.strip().split("..."))
            if not any(re.search(f"^{pattern}$", source, re.M) for source in sources):
                line = text.count("\n", 0, block.start()) + 1
                yield f"{page.relative_to(ROOT)}:{line}: no program has: {part.strip().splitlines()[0]}"


tracked = ["git", "ls-files", "--cached", "--others", "--exclude-standard", "*.md"]
names = subprocess.run(tracked, cwd=ROOT, check=True, capture_output=True, text=True).stdout.splitlines()
pages = [ROOT / name for name in names if (ROOT / name).exists()]
problems = [problem for page in pages for problem in problems_of(page)]
examples = [ROOT / "README.md", *ROOT.glob("examples/*/README.md")]
problems += [problem for page in examples for problem in misquotes_of(page)]
problems += [problem for name in MAPS for problem in missing_paths_of(ROOT / name)]
print("\n".join(problems) or f"{len(pages)} pages: all links lead somewhere, and programs are quoted as they are")
sys.exit(bool(problems))
