#!/usr/bin/env python3
"""check_citations.py [ROOT] : does every page that is cited exist?

Comments and pages cite pages of docs/, scenario files and scripts by their path from the repository's root, and pages link to each
other, with headings behind a #. Prints each citation of something that is not there; exit status 1 if there is one.
"""
import os
import re
import subprocess
import sys
from pathlib import Path

ENDINGS = {".hpp", ".cpp", ".h", ".py", ".md", ".yaml", ".cmake", ".txt", ".js", ".mjs", ".sh", ".msg", ".srv", ".launch"}
PATH = re.compile(r"(?<![\w./-])((?:docs|scenarios)/[\w./-]+\.(?:md|yaml|csv|png)|script/[a-z_-]+(?:\.py|\.sh)?)(?![\w/])")
LINK = re.compile(r"\]\(([^()\s]+)\)")
NUMBERED = re.compile(r"\bprotocol,? sections? \d|\(design: ")


def files(root):
    listed = subprocess.run(["git", "ls-files"], cwd=root, capture_output=True, text=True)
    names = listed.stdout.splitlines() if listed.returncode == 0 else [str(path.relative_to(root)) for path in root.rglob("*")]
    for name in names:
        path = root / name
        text = Path(name).suffix in ENDINGS or (name.startswith("script/") and "." not in name)
        if text and path.is_file() and not name.startswith("build/"):
            yield name, path


def anchors(page):
    """Names of a page's headings, as the usual viewers of Markdown make them."""
    titles = re.findall(r"^#+ (.*)$", page.read_text(encoding="utf-8"), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", title.strip().lower()).replace(" ", "-") for title in titles}


def problems_of_link(page, link):
    if "://" in link or link.startswith("mailto:"):
        return
    target, _, anchor = link.partition("#")
    path = page.parent / target if target else page
    if not path.exists():
        yield f"links to {link}, which is not there"
    elif anchor and path.suffix == ".md" and anchor not in anchors(path):
        yield f"links to {link}, a heading that is not there"


def problems_of_line(root, path, line):
    for cited in PATH.findall(line):
        if not (root / cited).exists():
            yield f"cites {cited}, which is not there"
    if NUMBERED.search(line):
        yield "cites a section by a number or a design that is no page"
    if path.suffix == ".md":
        for link in LINK.findall(line):
            yield from problems_of_link(path, link)


def check(root):
    found, count = [], 0
    for name, path in files(root):
        if os.path.basename(name).startswith("check_citations"):
            continue
        count += 1
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), start=1):
            found += [f"{name}:{number}: {problem}" for problem in problems_of_line(root, path, line)]
    return found, count


def main(arguments):
    root = Path(arguments[0]) if arguments else Path(__file__).resolve().parent.parent
    found, count = check(root)
    print("\n".join(found) if found else f"citations: {count} files cite nothing that is not there")
    return 1 if found or not count else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
