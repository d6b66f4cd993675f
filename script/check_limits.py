#!/usr/bin/env python3
"""Fails where production code has grown beyond the house's measure: a file over 400 lines, a function over 60, a class
over 20 data members. Tests are free, and so are structs of plain values (parameters, records): only what hides its
members counts, by `class` or behind a pointer (`Implementation`).

Needs Universal Ctags; exit status 77 without it, 1 where SPF_REQUIRE_TOOLS is 1."""
import json
import os
import re
import shutil
import subprocess
import sys
from collections import Counter
from pathlib import Path

MOST_LINES_OF_FILE = 400
MOST_LINES_OF_FUNCTION = 60
MOST_MEMBERS = 20

CODE = {".cpp", ".hpp", ".js", ".py", ".sh"}
TESTS = re.compile(r"(^|/)(test|testing|test_data|fuzz|bench)/|_(ros)?test\.")
VENDORED = re.compile(r"(^|/)(third_party|vendor|node_modules)/")


def production_files(root):
    listed = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard"], cwd=root, text=True,
                            capture_output=True, check=False)
    names = listed.stdout.splitlines() if listed.returncode == 0 else [
        str(path.relative_to(root)) for path in root.rglob("*") if path.is_file()]
    return sorted(name for name in set(names) if Path(name).suffix in CODE and (root / name).is_file()
                  and not TESTS.search(name) and not VENDORED.search(name) and not name.startswith("build/"))


def tags_of(root, names):
    """What ctags finds in C++ files: functions with their first and last line, members with their class."""
    command = ["ctags", "-f", "-", "--output-format=json", "--language-force=C++", "--kinds-C++=fcsm",
               "--fields=+neKZ", "--fields-C++=+{properties}", *names]
    found = subprocess.run(command, cwd=root, text=True, capture_output=True, check=True).stdout
    return [json.loads(line) for line in found.splitlines()]


def scope_of(tag):
    return "::".join(part for part in (tag.get("scope"), tag["name"]) if part)


def check(root):
    """One sentence for each breach, with its place."""
    breaches = []
    names = production_files(root)
    for name in names:
        lines = (root / name).read_text(encoding="utf-8").count("\n")
        if lines > MOST_LINES_OF_FILE:
            breaches.append(f"{name}: {lines} lines, at most {MOST_LINES_OF_FILE}")
    cpp = [name for name in names if name.endswith((".cpp", ".hpp"))]
    tags = tags_of(root, cpp) if cpp else []
    members = Counter()
    for tag in tags:
        is_lambda = tag["name"].startswith("__anon")  # counts with the function that it stands in
        if tag["kind"] == "function" and "end" in tag and not is_lambda:
            lines = tag["end"] - tag["line"] + 1
            if lines > MOST_LINES_OF_FUNCTION:
                breaches.append(f"{tag['path']}:{tag['line']}: {scope_of(tag)} has {lines} lines, "
                                f"at most {MOST_LINES_OF_FUNCTION}")
        if tag["kind"] == "member" and "static" not in tag.get("properties", ""):
            members[tag["path"], tag.get("scope")] += 1
    for tag in tags:
        hides = tag["kind"] == "class" or (tag["kind"] == "struct" and tag["name"] == "Implementation")
        count = members[tag["path"], scope_of(tag)]
        if hides and count > MOST_MEMBERS:
            breaches.append(f"{tag['path']}:{tag['line']}: {scope_of(tag)} has {count} data members, "
                            f"at most {MOST_MEMBERS}")
    return breaches


def no_tool():
    """Exit status: the check is skipped, or it fails where nothing is to be skipped."""
    return 1 if os.environ.get("SPF_REQUIRE_TOOLS") == "1" else 77


def main():
    if shutil.which("ctags") is None:
        print("ctags is not installed (script/setup check)", file=sys.stderr)
        return no_tool()
    root = Path(__file__).resolve().parent.parent
    breaches = check(root)
    for breach in breaches:
        print(breach, file=sys.stderr)
    if not breaches:
        print("limits: no file, function or class is too large")
    return 1 if breaches else 0


if __name__ == "__main__":
    sys.exit(main())
