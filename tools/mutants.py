"""Plants bugs in the protocols and checkers, one at a time, and looks whether tests with faults catch them.

    python3 tools/mutants.py [--only NAME]... [--keep] [--write]    the campaign, as `make mutants` runs it
    python3 tools/mutants.py --list                                 the bugs
    python3 tools/mutants.py --check                                whether the place of each is found; builds nothing

The bugs are listed in tools/mutants.toml. All of them are built into one binary, and an environment variable says
which one is on (mutant schemata: Untch, Offutt and Harrold 1993, "Mutation analysis using mutant schemata"). So the
tracked sources are copied into a folder under the target folder, and only the copy is rewritten. The campaign goes on
where it was stopped, unless sources have changed; `--keep` keeps results even so. `--write` puts the table into
docs/reference/testing.md. A run that goes wrong is done again without the bug: if it goes wrong all the same it does not
count, and the campaign says so and fails at its end, since then the fault is in the sources themselves.

A checker that is too lenient finds nothing where all is well. Such a bug `hides` another one: it is caught if a run goes
wrong with the other bug alone, and not with both.

A bug that no run with faults has caught in its time meets the tests of its crate. What only these catch is counted
apart: a test of one case shows that the bug would be noticed, and not that the workloads find such bugs.
"""

import argparse
import hashlib
import json
import os
import pathlib
import re
import resource
import shlex
import signal
import subprocess
import sys
import textwrap
import tomllib

ROOT = pathlib.Path(__file__).resolve().parent.parent
TARGET = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target")).resolve() / "mutants"
COPY = TARGET / "sources"
BUILD = TARGET / "build"
STARL = BUILD / "release" / "starl"
PAGE = ROOT / "docs" / "reference" / "testing.md"
VARIABLE = "STARL_PLANTED"

# Added to starl-core in the copy. `starl_core` also names the crate itself, so that one path serves everywhere.
PLANTED = f"""
extern crate self as starl_core;
extern crate std;
/// Whether the bug of this number is on.
pub fn planted(number: u32) -> bool {{
    static CHOSEN: std::sync::OnceLock<std::vec::Vec<u32>> = std::sync::OnceLock::new();
    let read = |text: &str| text.split(',').map(|number| number.parse().expect("a number")).collect();
    let choose = || read(&std::env::var("{VARIABLE}").unwrap_or("0".into()));
    CHOSEN.get_or_init(choose).contains(&number)
}}
"""


def fail(text):
    sys.exit(f"tools/mutants.toml: {text}")


# The list


def read_workloads():
    """Name to the arguments of `starl test`, of all lists."""
    found = {}
    for name in ["workloads.txt", "loads.txt", "storage.txt"]:
        for line in (ROOT / "tools" / name).read_text(encoding="utf-8").splitlines():
            if line and not line.startswith("#"):
                workload, scenario, *options = shlex.split(line)
                found[workload] = [f"examples/primitives/{scenario}.toml", *options]
    return found


def read_mutants():
    """The bugs, with the numbers that turn them on, their places, and the commands that are to catch them."""
    with open(ROOT / "tools" / "mutants.toml", "rb") as file:
        listed = tomllib.load(file)
    known, mutants = read_workloads(), listed["mutant"]
    for number, mutant in enumerate(mutants, 1):
        name = mutant["name"]
        path = ROOT / mutant["file"]
        text = path.read_text(encoding="utf-8") if path.exists() else fail(f"{name}: there is no {mutant['file']}")
        mutant["number"] = number
        mutant["right"], mutant["wrong"] = mutant["right"].strip("\n"), mutant["wrong"].strip("\n")
        mutant["start"] = place_of(mutant, text)
        usual = of_folder(listed["workloads"], mutant)
        mutant["tests"] = of_folder(listed["tests"], mutant)
        commands = mutant.get("caught_by", usual) or fail(f"{name}: it has no workload")
        mutant["commands"] = [command_of(name, known, command) for command in commands]
    names = [mutant["name"] for mutant in mutants]
    for mutant in mutants:
        other = mutant.get("hides")
        if other and other not in names:
            fail(f"{mutant['name']} hides {other}, which is not listed")
        # The bugs with which a run is to go wrong, and those with which the same run is not to.
        number, shown = mutant["number"], other and names.index(other) + 1
        mutant["wrong_with"], mutant["right_with"] = (shown, f"{shown},{number}") if other else (number, 0)
    if len(set(names)) < len(names):
        fail(f"two bugs have the same name: {next(name for name in names if names.count(name) > 1)}")
    return mutants


def of_folder(listed, mutant):
    """What is listed for the innermost folder of a bug's file; nothing if there is none."""
    folders = [folder for folder in listed if mutant["file"].startswith(folder)]
    return listed[max(folders, key=len)] if folders else []


def place_of(mutant, text):
    """Where the text to replace begins: the only place where it stands, or the first one after the text `after`."""
    unique = mutant.get("after", mutant["right"])
    for part in ("right", "wrong"):
        if any(mutant[part].count(left) != mutant[part].count(right) for left, right in ("()", "[]", "{}")):
            fail(f"{mutant['name']}: `{part}` is no whole expression or statement: {mutant[part]}")
    if (times := text.count(unique)) != 1:
        fail(f"{mutant['name']}: this is {times} times in {mutant['file']}, but must be there once: {unique}")
    start = text.find(mutant["right"], text.index(unique))
    return start if start >= 0 else fail(f"{mutant['name']}: this is not in {mutant['file']}: {mutant['right']}")


def command_of(mutant, known, text):
    """A workload's name and more options, or `explore` and its arguments, as arguments of `starl`."""
    first, *more = shlex.split(text)
    if first == "explore":
        return [text, ["explore", *more]]
    if first not in known:
        fail(f"{mutant}: there is no workload {first} in tools/workloads.txt, tools/loads.txt or tools/storage.txt")
    return [text, ["test", *known[first], *more]]


# The copy


def planted(text, mutants):
    """The text of a file with its bugs, each behind a condition."""
    places = {}
    for mutant in mutants:
        places.setdefault((mutant["start"], mutant["start"] + len(mutant["right"])), []).append(mutant)
    end = len(text) + 1
    for (start, stop), here in sorted(places.items(), reverse=True):
        if stop > end:
            fail(f"{here[0]['name']}: its place overlaps with that of another bug")
        right, end = text[start:stop], start
        cases = "".join(f"if starl_core::planted({m['number']}) {{ {m['wrong']} }} else " for m in here)
        choice = f"{cases}{{ {right} }}"
        # An expression may stand among others.
        is_statement = right.rstrip().endswith((";", "}"))
        text = text[:start] + (choice if is_statement else f"({choice})") + text[stop:]
    return text


def copy_sources(mutants):
    """Writes the copy, and returns a digest of what it is made of. Files that are the same keep their times."""
    tracked = ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
    names = subprocess.run(tracked, cwd=ROOT, check=True, capture_output=True, text=True).stdout.split("\0")
    digest, kept = hashlib.sha256(), set()
    for name in filter(None, names):
        source, copy = ROOT / name, COPY / name
        if not source.is_file() or name.startswith(("docs/reference/testing", "tools/")):
            continue
        content = source.read_bytes()
        digest.update(name.encode() + b"\0" + content)
        here = [mutant for mutant in mutants if mutant["file"] == name]
        if here:
            content = planted(content.decode(), here).encode()
        if name == "crates/starl-core/src/lib.rs":
            content += PLANTED.encode()
        if name == "Cargo.toml":
            # Planted bugs are no clean code. Without other flags what cargo built of the sources serves the copy too.
            content = re.sub(rb"(?ms)^\[workspace\.lints\.(\w+)\]\n.*?(?=^\[)", rb"[workspace.lints.\1]\n\n", content)
        kept.add(copy)
        if not copy.exists() or copy.read_bytes() != content:
            copy.parent.mkdir(parents=True, exist_ok=True)
            copy.write_bytes(content)
    for path in COPY.rglob("*"):
        if path.is_file() and path not in kept:
            path.unlink()
    return digest.hexdigest()


def build():
    """Builds the command with all bugs in it."""
    if cargo("build", "--release", "--locked", "--quiet").returncode:
        sys.exit("the copy with the bugs in it does not build; the messages above say where")


def build_tests(crates):
    """The binaries of the tests of these crates, with all bugs in them, by crate."""
    found = {}
    for crate in crates:
        arguments = ["--release", "--locked", "--package", crate, "--no-run", "--message-format=json"]
        built = cargo("test", *arguments, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        if built.returncode:
            sys.exit(f"the tests of {crate} with the bugs in it do not build")
        told = [json.loads(line) for line in built.stdout.splitlines() if line.startswith("{")]
        found[crate] = [line["executable"] for line in told if line.get("profile", {}).get("test") and line["executable"]]
    return found


def cargo(*arguments, **options):
    """Runs cargo on the copy."""
    environment = os.environ | {"CARGO_TARGET_DIR": str(BUILD), "CARGO_BUILD_WARNINGS": "allow"}
    return subprocess.run(["cargo", *arguments], cwd=COPY, env=environment, **options)


# The campaign

# Failures without any bug.
WITHOUT_BUGS = []
# The tests of a crate may take this long, seconds.
LONGEST_TESTS = 600


def core_seconds():
    """Time that all commands so far had of the processors."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def run(number, arguments, seconds):
    """Runs the command with a bug on, for so long at most: status, what it printed, and its errors."""
    environment = os.environ | {VARIABLE: str(number), "RUST_BACKTRACE": "0"}
    command = [STARL, *arguments, "--json"]
    pipe = subprocess.PIPE
    with subprocess.Popen(command, cwd=ROOT, env=environment, stdout=pipe, stderr=pipe, text=True) as process:
        try:
            output, errors = process.communicate(timeout=seconds)
        except subprocess.TimeoutExpired:
            process.send_signal(signal.SIGINT)  # it tells what it has found until now
            try:
                output, errors = process.communicate(timeout=120)
            except subprocess.TimeoutExpired:
                process.kill()
                process.communicate()
                return "hung", "", ""
    return process.returncode, output, errors


def judge(name, status, output, errors):
    """What a command has found: how many runs there were, what went wrong, and how to see it again."""
    if status == "hung":
        return 0, "a run without end", None
    if status == -signal.SIGINT:  # stopped before it began
        return 0, None, None
    if status == 101 or status < 0:
        return 0, "panic: " + next(iter(errors.splitlines()), f"signal {-status}"), None
    if status == 2:
        sys.exit(f"{name}: {errors}")
    told = json.loads(output)
    if "findings" not in told:
        violation = told["violation"]
        return 1, violation and violation["property"], None
    first = next(iter(told["findings"]), None)
    return told["runs"], first and first["property"], first and [first["profile"], first["seed"]]


def attempt(mutant, seconds):
    """Runs what is to catch a bug, with more and more seeds, until something goes wrong or time is up."""
    begun, runs = core_seconds(), 0
    plans = [[text, arguments, 1, 1] for text, arguments in mutant["commands"]]
    while plans:
        for plan in list(plans):
            left = seconds - (core_seconds() - begun)
            if left <= 0:
                return {"runs": runs, "seconds": core_seconds() - begun}
            text, arguments, first, seeds = plan
            is_exploration = arguments[0] == "explore"
            if is_exploration:
                block = ["--within", "1min", "--save", str(TARGET / "found.json")]
                plans.remove(plan)
            else:
                block = ["--seeds", str(seeds), "--first-seed", str(first), "--shrink", "0"]
            before = core_seconds()
            out = [] if is_exploration else ["--out", str(TARGET / "found" / mutant["name"])]
            found = judge(text, *run(mutant["wrong_with"], [*arguments, *block, *out], left))
            runs += found[0]
            if found[1] and (is_exploration or goes_wrong_only_with_it(mutant, arguments, block, found)):
                profile = found[2] and found[2][0]
                spent = core_seconds() - begun
                return {"what": found[1], "by": text, "profile": profile, "runs": runs, "seconds": spent}
            plan[2] += seeds
            if found[0] and core_seconds() - before < 5:
                plan[3] *= 2
    return {"runs": runs, "seconds": core_seconds() - begun}


def try_tests(mutant, binaries):
    """The first test of the bug's crate that fails with the bug and not without it."""
    crate = crate_of(mutant)
    for binary in binaries.get(crate, []):
        for test in failures(crate, binary, mutant["number"], mutant["tests"]):
            if not failures(crate, binary, 0, ["--exact", test]):
                return f"test {test}"
    return None


def failures(crate, binary, number, names):
    """The tests of a binary with these names that fail with a bug on."""
    environment = os.environ | {VARIABLE: str(number), "RUST_BACKTRACE": "0"}
    command = [binary, *names]
    pipe, folder = subprocess.PIPE, COPY / "crates" / crate
    with subprocess.Popen(command, cwd=folder, env=environment, stdout=pipe, stderr=pipe, text=True) as process:
        try:
            output, _ = process.communicate(timeout=LONGEST_TESTS)
        except subprocess.TimeoutExpired:
            process.kill()
            output, _ = process.communicate()
    ended = dict(re.findall(r"^test (\S+) \.\.\. (\w+)", output, re.MULTILINE))
    return [test for test, result in ended.items() if result == "FAILED"]


def crate_of(mutant):
    """The crate of a bug's file."""
    return pathlib.PurePath(mutant["file"]).parts[1]


def goes_wrong_only_with_it(mutant, arguments, block, found):
    """Whether the run that went wrong with a bug does not without it, or with a checker that hides the bug."""
    if found[2]:
        profile, seed = found[2]
        if "--profile" in arguments:
            at = arguments.index("--profile")
            arguments = arguments[:at] + arguments[at + 2 :]
        block = ["--profile", profile, "--first-seed", str(seed), "--seeds", "1", "--shrink", "0"]
    out = ["--out", str(TARGET / "found" / "none")]
    what = judge(mutant["name"], *run(mutant["right_with"], [*arguments, *block, *out], 600))[1]
    if what and "hides" not in mutant:
        WITHOUT_BUGS.append(f"{what} without any bug: {shlex.join(['starl', *arguments, *block])}")
        print(WITHOUT_BUGS[-1], flush=True)
    return not what


def try_without_bugs(mutants):
    """Stops where a workload goes wrong on the sources as they are."""
    texts = {text: arguments for mutant in mutants for text, arguments in mutant["commands"]}
    for text, arguments in texts.items():
        if arguments[0] == "test":
            print(f"without bugs: {text}", flush=True)
            found = judge(text, *run(0, [*arguments, "--seeds", "2", "--out", str(TARGET / "found" / "none")], 600))
            if found[1]:
                sys.exit(f"{text}: {found[1]} without any bug planted, in the first two seeds")


def campaign(mutants, options):
    TARGET.mkdir(parents=True, exist_ok=True)
    digest = copy_sources(mutants)
    build()
    path = TARGET / "results.json"
    known = json.loads(path.read_text(encoding="utf-8")) if path.exists() else {"results": {}}
    if known.get("sources") != digest and not options.keep:
        known = {"results": {}}
        try_without_bugs(mutants)
    known["sources"] = digest
    results, binaries = known["results"], {}
    for mutant in mutants:
        name = mutant["name"]
        # One that survived is tried again where its workloads have changed, or it has more time.
        mark, commands = [mutant["file"], mutant["right"], mutant["wrong"]], mutant["commands"]
        before = results.get(name, {})
        is_tried = before.get("commands") == commands and before.get("seconds", 0) >= options.seconds
        is_known = before.get("mark") == mark and ("what" in before or is_tried)
        is_wanted = name in options.only if options.only else not is_known
        if is_wanted:
            print(f"{name}: ", end="", flush=True)
            results[name] = attempt(mutant, options.seconds) | {"mark": mark, "commands": commands}
            if "what" not in results[name] and "equivalent" not in mutant:
                binaries = binaries or build_tests({crate_of(mutant) for mutant in mutants})
                results[name]["test"] = try_tests(mutant, binaries)
            path.write_text(json.dumps(known, indent=1), encoding="utf-8")
            print(describe(results[name]), flush=True)
    report(mutants, results, options)
    sys.exit(bool(WITHOUT_BUGS))


# The report


def describe(result):
    """How a bug fared, in a few words."""
    spent = f"{result['runs']:,} runs, {result['seconds']:.0f} s"
    if "what" not in result:
        return f"{result.get('test') or 'nothing'} catches it; SURVIVES {spent}"
    where = result["by"] + (f", {result['profile']}" if result["profile"] else "")
    return f"{result['what']} ({where}) after {spent}"


def table(mutants, results):
    """The table as Markdown."""
    lines = ["| bug | what is wrong then | caught by | workload, profile | runs | s |", "| --- | --- | --- | --- | ---: | ---: |"]
    for mutant in mutants:
        result = results[mutant["name"]]
        what, where = result.get("what"), result.get("by", "")
        if what is None:
            what = f"equivalent: {mutant['equivalent']}" if "equivalent" in mutant else "**survives**"
            what, where = ("**survives runs**", result["test"]) if result.get("test") else (what, where)
        elif result["profile"]:
            where = re.sub(r" --profile \S+", "", where) + ", " + result["profile"]
        cells = [f"`{mutant['name']}`", mutant["flaw"], what.replace("|", "\\|"), where]
        lines.append("| " + " | ".join(cells) + f" | {result['runs']:,} | {result['seconds']:.0f} |")
    return "\n".join(lines)


def report(mutants, results, options):
    listed = len(mutants)
    mutants = [mutant for mutant in mutants if mutant["name"] in results]
    caught = [mutant for mutant in mutants if "what" in results[mutant["name"]]]
    left = [mutant for mutant in mutants if mutant not in caught]
    equivalent = [mutant for mutant in left if "equivalent" in mutant]
    judged = max(1, len(mutants) - len(equivalent))
    tested = [mutant for mutant in left if mutant not in equivalent and results[mutant["name"]].get("test")]
    percent = [f"{100 * count / judged:.0f} %" for count in (len(caught), len(caught) + len(tested))]
    summary = (
        f"{len(mutants)} of {listed} bugs tried, {len(equivalent)} of them equivalent. Of the other {judged}, runs with "
        f"faults or explorations catch {len(caught)} ({percent[0]}), and with the tests of the crates "
        f"{len(caught) + len(tested)} are caught ({percent[1]})"
    )
    text = f"{textwrap.fill(summary, 120)}.\n\n{table(mutants, results)}\n"
    (TARGET / "table.md").write_text(text, encoding="utf-8")
    if options.write:
        page = PAGE.read_text(encoding="utf-8")
        begin, end = "<!-- written by tools/mutants.py -->\n", "<!-- end -->"
        head, rest = page.split(begin)
        PAGE.write_text(head + begin + text + end + rest.split(end)[1], encoding="utf-8")
    print(f"\n{summary}\nthe table is in {TARGET / 'table.md'}")
    for mutant in left:
        if mutant not in equivalent:
            print(f"SURVIVES{' runs' if mutant in tested else ''}: {mutant['name']}: {mutant['flaw']}")


parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("--only", action="append", default=[], metavar="NAME", help="run this bug alone, again if need be")
parser.add_argument("--seconds", type=float, default=240, help="core seconds for each; the default is 2 min of 2 cores")
parser.add_argument("--keep", action="store_true", help="keep results though sources have changed")
parser.add_argument("--write", action="store_true", help="put the table into docs/reference/testing.md")
parser.add_argument("--list", action="store_true", help="list the bugs")
parser.add_argument("--check", action="store_true", help="look whether the place of each bug is found")
chosen = parser.parse_args()
all_mutants = read_mutants()
if unknown := set(chosen.only) - {mutant["name"] for mutant in all_mutants}:
    fail(f"there is no bug {', '.join(sorted(unknown))}")
if chosen.list:
    for listed_mutant in all_mutants:
        print(f"{listed_mutant['name']:40} {listed_mutant['flaw']}")
elif chosen.check:
    for path_of_file in {mutant["file"] for mutant in all_mutants}:
        source_text = (ROOT / path_of_file).read_text(encoding="utf-8")
        planted(source_text, [mutant for mutant in all_mutants if mutant["file"] == path_of_file])
    print(f"{len(all_mutants)} bugs: the place of each is found")
else:
    campaign(all_mutants, chosen)
