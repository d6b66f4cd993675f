#!/usr/bin/env python3
"""check_paper_notes.py [ROOT] : does every reading in docs/paper_notes.md name a test that exists?

A row is a table line whose first cell is a number; its last cell names tests as `path/to/file_test.cpp` `Suite.Name`,
one file followed by its tests, as often as needed. Prints each row that names no test, or one that is not there; exit
status 1 if there is one.
"""
import re
import sys
from pathlib import Path

NOTES = Path("docs/paper_notes.md")
CODE_SPAN = re.compile(r"`([^`]+)`")
MACRO = r"\b(?:TYPED_)?TEST(?:_F|_P)?\s*\(\s*{}\s*,\s*{}\s*\)"


def rows(text):
    """(line number, row number, last cell) of every numbered table line."""
    for line_number, line in enumerate(text.splitlines(), start=1):
        cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
        if line.lstrip().startswith("|") and cells[0].isdigit():
            yield line_number, int(cells[0]), cells[-1]


def problems_of(root, cell):
    source, tests = None, 0
    for span in CODE_SPAN.findall(cell):
        if "/" in span:
            path = root / span
            source = path.read_text(encoding="utf-8") if path.is_file() else None
            if source is None:
                yield f"there is no {span}"
        elif re.fullmatch(r"\w+\.\w+", span):
            tests += 1
            suite, name = span.split(".")
            if source is not None and not re.search(MACRO.format(suite, name), source):
                yield f"there is no test {span} in the file named before it"
        else:
            yield f"`{span}` is neither a file nor Suite.Name"
    if not tests:
        yield "names no test"


def check(root):
    notes = list(rows((root / NOTES).read_text(encoding="utf-8")))
    found = [f"{NOTES}:{line}: note {number}: {problem}" for line, number, cell in notes for problem in problems_of(root, cell)]
    numbers = [number for _, number, _ in notes]
    if numbers != list(range(1, len(numbers) + 1)) or not numbers:
        found.append(f"{NOTES}:1: the notes are not numbered 1, 2, 3, ...")
    return found, len(notes)


def main(arguments):
    root = Path(arguments[0]) if arguments else Path(__file__).resolve().parent.parent
    found, count = check(root)
    print("\n".join(found) if found else f"paper notes: {count}, each pinned by a test that exists")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
