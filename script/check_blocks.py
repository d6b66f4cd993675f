#!/usr/bin/env python3
"""check_blocks.py PROGRAM: holds the code blocks of the documents to what there is.

C++: every line stands in a source, in the one that the line before the block names, if any. Commands: scripts and files exist, and
the program knows the verb and its options; what `spf run` and `spf check` are given passes `spf check`. YAML of docs/scenarios.md:
passes `spf check`, a part of a scenario within one. (Blocks in Python run in python/test.)"""
import re
import shlex
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BLOCK = re.compile(r"(?:^`([\w./]+)`\n\n)?^```(\w*)\n(.*?)^```", re.MULTILINE | re.DOTALL)
OPTIONS_OF_CHECK = ("--set", "--method", "--noise", "--level", "--tracking", "--seed")
OWN_FILES = re.compile(r"FILE|my_scene|{}|\$|~|dense\.csv|DIR")  # names that stand for a reader's
BASE = """family: explicit
border: {low: [-10, -10], high: [40, 20]}
robots: [%s]
""" % ", ".join(f"{{start: [{x}, 18], goal: [{x}, -8]}}" for x in (-8, -5, 25, 30, 37))


def pages():
    names = ["README.md", "CONTRIBUTING.md", "examples/README.md"]
    return [ROOT / name for name in names] + sorted((ROOT / "docs").glob("*.md"))


def blocks_of(page):
    return [(match.group(1), match.group(2), match.group(3)) for match in BLOCK.finditer(page.read_text(encoding="utf-8"))]


def squeezed(line):
    return re.sub(r"\s+", "", line.split("//")[0])


class Sources:
    """The text of all C++ sources, without blanks, comments and line breaks, within strings neither."""

    def __init__(self, root):
        listed = subprocess.run(["git", "-C", root, "ls-files", "--cached", "--others", "--exclude-standard", "*.cpp", "*.hpp"],
                                capture_output=True, text=True, check=True).stdout.split()
        self.texts = {name: "".join(map(squeezed, (root / name).read_text(encoding="utf-8").splitlines())).replace('""', "")
                      for name in listed if (root / name).is_file()}

    def problems(self, named, block):
        if named is not None and named not in self.texts:
            return [f"{named} is no source"]
        texts = [self.texts[named]] if named else self.texts.values()
        return [f"'{line.strip()}' is not in {named or 'any source'}" for line in block.splitlines()
                if not any(squeezed(line) in text for text in texts)]


class Commands:
    """What the program understands."""

    def __init__(self, program):
        self.program = program
        self.helps = {}

    def options(self, verb):
        if verb not in self.helps:
            run = subprocess.run([self.program, verb, "--help"], capture_output=True, text=True, check=False)
            known = f"Usage: {Path(self.program).name} {verb} " in run.stdout  # else it is the help of the program as a whole
            self.helps[verb] = set(re.findall(r"^  (?:-\w,)?(--[\w-]+)", run.stdout, re.MULTILINE)) if known else None
        return self.helps[verb]

    def problems(self, block):
        found = []
        for line in block.replace("\\\n", " ").splitlines():
            line = line.split(" #")[0].strip()
            if line.startswith("script/") and not (ROOT / line.split()[0]).is_file():
                found.append(f"{line.split()[0]} is not there")
            elif line.startswith("spf ") and not OWN_FILES.search(line):
                found += self.problems_of(shlex.split(line)[1:], line)
        return found

    def problems_of(self, words, line):
        if "VERB" in words[0] or words[0].startswith("-"):
            return []
        if self.options(words[0]) is None:
            return [f"'{line}': there is no verb {words[0]}"]
        unknown = [word for word in words if word.startswith("--") and word not in self.options(words[0])]
        if unknown:
            return [f"'{line}': {words[0]} has no option {unknown[0]}"]
        if words[0] not in ("run", "check"):
            return []
        kept, files = [], []
        for before, word in zip(words, words[1:]):
            if before in OPTIONS_OF_CHECK and not word.startswith("--"):
                kept += [before, word]
            elif word.endswith(".yaml") and not before.startswith("--"):
                files += [str(path) for path in sorted(ROOT.glob(word))] or [word]
        return checked(self.program, [*files, *kept], ROOT, line) if files else []


def checked(program, arguments, folder, what):
    run = subprocess.run([program, "check", *arguments], capture_output=True, text=True, cwd=folder, check=False)
    return [] if run.returncode == 0 else [f"'{what}' is refused: {(run.stderr or run.stdout).strip()[:500]}"]


def scenario_problems(program, block):
    """Of a scenario, or of a part of one; the files that it names are made: a hall of 20 m by 10 m, and the shipped crowd."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for part in ("maps", "crowds"):
            (folder / part).mkdir()
        (folder / "maps" / "hall.pgm").write_bytes(b"P5\n400 200\n255\n" + b"\xfe" * 80000)
        (folder / "maps" / "hall.yaml").write_text("image: hall.pgm\nresolution: 0.05\norigin: [0, 0, 0]\n")
        (folder / "crowds" / "plaza.csv").write_bytes((ROOT / "scenarios" / "crowds" / "plaza.csv").read_bytes())
        text = block if block.startswith("family:") else BASE + block
        if "robots:" not in text:
            text += "robots: [{start: [1, 1], goal: [18, 9]}]\n"
        (folder / "scene.yaml").write_text(text, encoding="utf-8")
        return checked(program, ["scene.yaml"], folder, block.splitlines()[0] + " ...")


def check(program):
    sources, commands, found, count = Sources(ROOT), Commands(program), [], 0
    for page in pages():
        for named, language, block in blocks_of(page):
            problems = None
            if language == "cpp":
                problems = sources.problems(named, block)
            elif language in ("", "sh", "bash"):
                problems = commands.problems(block)
            elif language == "yaml" and page.name == "scenarios.md":
                problems = scenario_problems(program, block)
            count += problems is not None
            found += [f"{page.relative_to(ROOT)}: {problem}" for problem in problems or []]
    return found, count


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    all_found, blocks = check(str(Path(sys.argv[1]).resolve()))
    if all_found:
        sys.exit("\n".join(all_found))
    print(f"documents: {blocks} code blocks hold")
