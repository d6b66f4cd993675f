#!/usr/bin/env python3
"""Fails where production code has grown beyond the house's measure: a file over 400 lines, a function over 60 (C++, Python,
JavaScript, shell), a class or struct over 20 data members. Tests are free, and so are structs that list their members in
`visit_fields`: parameters and rows of results, which have as many members as the file that they stand for has fields, and
no behaviour.

Needs Universal Ctags; exit status 77 without it, 1 where SPF_REQUIRE_TOOLS is 1."""
import ast
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

CODE = {".cpp", ".hpp", ".js", ".mjs", ".py", ".sh"}
INTERPRETERS = {"bash": ".sh", "sh": ".sh", "python3": ".py"}  # of files without a suffix
TESTS = re.compile(r"(^|/)(test|testing|test_data|fuzz|bench)/|_(ros)?test\.")
VENDORED = re.compile(r"(^|/)(third_party|vendor|node_modules)/")


def files_of(root):
    """What the repository holds, or the folder where it is none."""
    listed = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard"], cwd=root, text=True,
                            capture_output=True, check=False)
    names = listed.stdout.splitlines() if listed.returncode == 0 else [
        str(path.relative_to(root)) for path in root.rglob("*") if path.is_file()]
    return sorted(name for name in set(names) if (root / name).is_file() and not name.startswith("build/"))


def production_files(root):
    return [name for name in files_of(root) if not TESTS.search(name) and not VENDORED.search(name)
            and language_of(root / name) in CODE]


def language_of(path):
    """The suffix, or what the first line of a file without one says."""
    if path.suffix:
        return path.suffix
    with path.open("rb") as file:
        first = file.readline(100).decode("utf-8", "replace")
    return INTERPRETERS.get(re.split(r"[/ ]", first.strip())[-1], "") if first.startswith("#!") else ""


def tags_of(root, names, kinds="fcsm"):
    """What ctags finds in C++ files: functions with their first and last line, members with their class."""
    command = ["ctags", "-f", "-", "--output-format=json", "--language-force=C++", f"--kinds-C++={kinds}",
               "--fields=+neKSZ", "--fields-C++=+{properties}", *names]
    found = subprocess.run(command, cwd=root, text=True, capture_output=True, check=True).stdout
    return [json.loads(line) for line in found.splitlines()]


# Where a function begins, by its indentation: it ends with a brace as far to the left.
BRACED = {
    ".js": re.compile(r"^( *)(?:export )?(?:async )?(?:static )?(?:function (\w+)\(|(?:const|let) (\w+) = .*=> \{$|"
                      r"(?!if|for|while|switch|catch|else|do)(\w+)\([^;]*\) \{$)"),
    ".sh": re.compile(r"^( *)(\w+)\(\) \{"),
}
BRACED[".mjs"] = BRACED[".js"]


def functions_of_script(language, text):
    """Name, first and last line of every function."""
    if language == ".py":
        for node in ast.walk(ast.parse(text)):
            if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
                yield node.name, node.lineno, node.end_lineno
        return
    lines = text.splitlines()
    for first, line in enumerate(lines):
        begins = BRACED[language].match(line)
        if not begins:
            continue
        end = begins.group(1) + "}"
        last = next((number for number in range(first + 1, len(lines)) if lines[number].startswith(end)), first)
        yield next(filter(None, begins.groups()[1:])), first + 1, last + 1


def scope_of(tag):
    return "::".join(part for part in (tag.get("scope"), tag["name"]) if part)


def check(root):
    """One sentence for each breach, with its place."""
    breaches = []
    names = production_files(root)
    for name in names:
        text = (root / name).read_text(encoding="utf-8")
        lines = text.count("\n")
        if lines > MOST_LINES_OF_FILE:
            breaches.append(f"{name}: {lines} lines, at most {MOST_LINES_OF_FILE}")
        language = language_of(root / name)
        if language == ".py" or language in BRACED:
            breaches += [f"{name}:{first}: {function} has {last - first + 1} lines, at most {MOST_LINES_OF_FUNCTION}"
                         for function, first, last in functions_of_script(language, text)
                         if last - first + 1 > MOST_LINES_OF_FUNCTION]
    cpp = [name for name in names if name.endswith((".cpp", ".hpp"))]
    tags = tags_of(root, cpp) if cpp else []
    members = Counter()
    records = {(tag["path"], tag.get("scope")) for tag in tags if tag["name"] == "visit_fields"}
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
        is_record = tag["kind"] == "struct" and (tag["path"], scope_of(tag)) in records
        count = members[tag["path"], scope_of(tag)]
        if tag["kind"] in ("class", "struct") and not is_record and count > MOST_MEMBERS:
            breaches.append(f"{tag['path']}:{tag['line']}: {scope_of(tag)} has {count} data members, "
                            f"at most {MOST_MEMBERS}")
    return breaches


def no_tool():
    """Exit status: the check is skipped, or it fails where nothing is to be skipped."""
    return 1 if os.environ.get("SPF_REQUIRE_TOOLS") == "1" else 77


def main(check_root, well):
    """Exit status of a check that needs ctags and returns one sentence for each breach; `well` is said where there is none."""
    if shutil.which("ctags") is None:
        print("ctags is not installed (script/setup check)", file=sys.stderr)
        return no_tool()
    breaches = check_root(Path(__file__).resolve().parent.parent)
    for breach in breaches:
        print(breach, file=sys.stderr)
    if not breaches:
        print(well)
    return 1 if breaches else 0


if __name__ == "__main__":
    sys.exit(main(check, "limits: no file, function or class is too large"))
