#!/usr/bin/env python3
"""handbook.py [FOLDER]: builds the handbook in FOLDER (default build/handbook), from the pages that are in the repository.

Pages keep their links: one to another page stays one, one to a file of the repository leads to a page that shows the file. Equations
become MathML and the diagram of rooms a picture, so that a reader's browser needs nothing but the pages. Broken links are errors,
in the sources and on the built pages."""
import json
import os
import posixpath
import re
import shutil
import subprocess
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urldefrag

ROOT = Path(__file__).resolve().parent.parent
# Where pages of the repository stand in the handbook; those of docs/ keep their names.
PAGES = {"README.md": "index.md", "examples/README.md": "examples.md", "CHANGELOG.md": "changelog.md",
         "CONTRIBUTING.md": "contributing.md", "SECURITY.md": "security.md"}
NAVIGATION = [
    ("Start", ["index.md"]),
    ("Tutorials", ["examples.md", "ros_tutorial.md"]),
    ("How to", ["scenarios.md", "campaigns.md", "add_a_method.md", "drives.md", "python.md", "ros.md", "ros2.md"]),
    ("How it works", ["architecture.md", "paper_walk.md", "paper_notes.md", "notation.md", "space_time.md", "perception.md",
                      "protocol.md", "faults.md"]),
    ("Reference", ["parameters.md", "cpp.md", "changelog.md"]),
    ("Results", ["results/README.md", "results/claims.md"]),
    ("Taking part", ["contributing.md", "security.md"]),
]
API_PAGE = "# C++ reference\n\nEvery public header, by Doxygen: [classes, functions, files](api/index.html).\n"
LINK = re.compile(r'(!?\[(?:[^\[\]]|\[[^\]]*\])*\]\()([^)\s]+)(\))|((?:src|href)=")([^"]+)(")')
LANGUAGES = {".cpp": "cpp", ".hpp": "cpp", ".py": "python", ".yaml": "yaml", ".txt": "cmake", ".cmake": "cmake", ".sh": "bash"}
PICTURES = (".svg", ".png")


class BrokenLink(ValueError):
    """A link that leads nowhere."""


def page_names():
    """Paths in the handbook by paths in the repository."""
    names = dict(PAGES)
    for page in sorted((ROOT / "docs").rglob("*.md")):
        names[page.relative_to(ROOT).as_posix()] = page.relative_to(ROOT / "docs").as_posix()
    return names


class Assembly:
    """The folder of sources that mkdocs reads."""

    def __init__(self, folder):
        self.folder = folder
        self.names = page_names()
        self.shown = {}  # files of the repository that pages lead to, by their paths there

    def write(self, name, text):
        file = self.folder / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")

    def place_of(self, path):
        """Where a path of the repository is in the handbook; files that are no pages get one."""
        if (ROOT / path).is_dir():
            path = posixpath.join(path, "README.md") if (ROOT / path / "README.md").is_file() else path
        if path in self.names:
            return self.names[path]
        file = ROOT / path
        if file.suffix in PICTURES and file.is_file():
            target = self.folder / "files" / path
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(file, target)
            return f"files/{path}"
        if not file.exists() or not self.tracked(path):
            raise BrokenLink(path)
        self.shown[path] = f"source/{path}.md" if file.is_file() else f"source/{path}/index.md"
        return self.shown[path]

    @staticmethod
    def tracked(path):
        run = subprocess.run(["git", "-C", ROOT, "ls-files", "--cached", "--others", "--exclude-standard", "--", path],
                             capture_output=True, text=True, check=False)
        return run.returncode != 0 or bool(run.stdout.strip())

    def link(self, target, page):
        """A link of a page of the repository, as its page of the handbook needs it."""
        if re.match(r"[a-z]+:", target) or target.startswith("#"):
            return target
        path, anchor = urldefrag(target)
        path = posixpath.normpath(posixpath.join(posixpath.dirname(page), unquote(path)))
        try:
            place = self.place_of(path)
        except BrokenLink as broken:
            raise BrokenLink(f"{page}: {target} leads to {path}, which is not there") from broken
        relative = posixpath.relpath(place, posixpath.dirname(self.names[page]) or ".")
        return relative + ("#" + anchor if anchor and place not in self.shown.values() else "")

    def page_text(self, page):
        def linked(match):
            before, target, after = [part for part in match.groups() if part is not None]
            return before + self.link(target, page) + after

        text = (ROOT / page).read_text(encoding="utf-8")
        text = self.outside_code(text, lambda part: LINK.sub(linked, part))
        return with_pictures(with_equations(text))

    @staticmethod
    def outside_code(text, change):
        """A link's text may hold code: change the text with code put aside, then put it back."""
        code = []

        def put_aside(match):
            code.append(match.group(0))
            return "\1"

        text = re.sub(r"^```.*?^```[ ]*$|`[^`\n]+`", put_aside, text, flags=re.MULTILINE | re.DOTALL)
        pieces = change(text).split("\1")
        return "".join(piece + kept for piece, kept in zip(pieces, code + [""]))

    def assemble(self):
        for page, name in self.names.items():
            self.write(name, self.page_text(page))
        for path, name in self.shown.items():
            self.write(name, shown_file(path))
        self.write("cpp.md", API_PAGE)
        shutil.copyfile(ROOT / "handbook" / "handbook.css", self.folder / "handbook.css")


def shown_file(path):
    file = ROOT / path
    if file.is_dir():
        return f"# {path}/\n\n" + "".join(f"- `{entry.name}`\n" for entry in sorted(file.iterdir()) if entry.name[0] != ".")
    language = LANGUAGES.get(file.suffix, "bash" if file.parent.name == "script" else "text")
    text = file.read_text(encoding="utf-8")
    return f"# {file.name}\n\n`{path}`\n\n````{language}\n{text}````\n"


def with_equations(text):
    """Of ```math blocks, and of $...$ on pages that have such blocks."""
    if "```math" not in text:
        return text
    found = []

    def kept(match):
        found.append((match.group(1), match.group(0).startswith("```")))
        return f"\2{len(found) - 1}\2"

    text = re.sub(r"^```math\n(.*?)^```$", kept, text, flags=re.MULTILINE | re.DOTALL)
    text = re.sub(r"\$([^$\n]+)\$", kept, text)
    program = """const k = require('katex'), found = JSON.parse(require('fs').readFileSync(0, 'utf8'));
try { console.log(JSON.stringify(found.map(([t, d]) => k.renderToString(t, {output: 'mathml', displayMode: d})))); }
catch (error) { console.error(String(error)); process.exit(1); }"""
    run = subprocess.run(["node", "-e", program], input=json.dumps(found), capture_output=True, text=True, check=False,
                         env={**os.environ, "NODE_PATH": "/usr/share/nodejs:/usr/share/javascript"})
    if run.returncode:
        raise BrokenLink(f"an equation was not understood:\n{run.stderr}")
    made = [re.search(r"<math.*</math>", text, re.DOTALL).group(0) for text in json.loads(run.stdout)]
    return re.sub("\2(\\d+)\2", lambda match: made[int(match.group(1))], text)


def with_pictures(text):
    """Of ```mermaid graphs, by Graphviz."""
    def picture(match):
        edges = re.findall(r"(\w+) --> (\w+)", match.group(1))
        graph = "digraph{rankdir=BT;node[shape=box,fontname=sans];" + "".join(f'"{a}"->"{b}";' for a, b in edges) + "}"
        svg = subprocess.run(["dot", "-Tsvg"], input=graph, capture_output=True, text=True, check=True).stdout
        return re.sub(r"\n\s*\n", "\n", svg[svg.index("<svg"):]).replace("<svg", '<svg class="rooms"', 1)

    return re.sub(r"^```mermaid\n(.*?)^```$", picture, text, flags=re.MULTILINE | re.DOTALL)


def navigation(names):
    lines, listed = ["nav:"], {page for _, pages in NAVIGATION for page in pages}
    more = sorted(name for name in names.values() if "/" not in name and name not in listed)
    for title, pages in NAVIGATION + ([("More", more)] if more else []):
        lines.append(f"  - {title}:")
        lines += [f"    - {page}" for page in pages]
    lines.append("  - Decisions:")
    lines += [f"    - {name}" for name in sorted(names.values()) if name.startswith("decisions/")]
    return "\n".join(lines) + "\n"


def run(command, **options):
    done = subprocess.run(command, capture_output=True, text=True, check=False, **options)
    if done.returncode:
        sys.exit(f"handbook.py: {command[0]} failed:\n{done.stdout[-3000:]}{done.stderr[-3000:]}")


def main():
    folder = Path(sys.argv[1]).resolve() if len(sys.argv) > 1 else ROOT / "build" / "handbook"
    shutil.rmtree(folder, ignore_errors=True)
    assembly = Assembly(folder / "pages")
    try:
        assembly.assemble()
    except BrokenLink as broken:
        sys.exit(f"handbook.py: {broken}")
    doxyfile = (ROOT / "handbook" / "Doxyfile").read_text(encoding="utf-8")
    run(["doxygen", "-"], input=f"{doxyfile}\nOUTPUT_DIRECTORY = {folder}/pages\nHTML_OUTPUT = api\n", cwd=ROOT)
    settings = (ROOT / "handbook" / "mkdocs.yml").read_text(encoding="utf-8")
    (folder / "mkdocs.yml").write_text(f"{settings}docs_dir: pages\nsite_dir: site\n{navigation(assembly.names)}", encoding="utf-8")
    run(["mkdocs", "build", "--strict", "--quiet", "--config-file", folder / "mkdocs.yml"])
    problems = check_site(folder / "site")
    if problems:
        sys.exit("handbook.py: " + "\n".join(problems))
    pages = sum(1 for _ in (folder / "site").rglob("*.html"))
    print(f"{folder}/site/index.html: {pages} pages, {sum(1 for p in assembly.shown)} of them files that others show")


class Addresses(HTMLParser):
    """What a page leads to, what it loads, and its anchors."""

    def __init__(self):
        super().__init__()
        self.links, self.loads, self.anchors = [], [], set()

    def handle_starttag(self, tag, attrs):
        attrs = dict(attrs)
        self.anchors.update(filter(None, (attrs.get("id"), attrs.get("name"))))
        if tag == "a" and attrs.get("href"):
            self.links.append(attrs["href"])
        elif tag in ("script", "img", "iframe") and attrs.get("src"):
            self.loads.append(attrs["src"])
        elif tag == "link" and attrs.get("href") and attrs.get("rel") not in ("canonical", "next", "prev"):
            self.loads.append(attrs["href"])


def check_site(site):
    """What is wrong with the links of the built pages: loads from elsewhere, files and anchors that are not there."""
    pages = {}
    for file in sorted(site.rglob("*.html")):
        if (site / "api") in file.parents or file.name == "404.html":
            continue
        pages[file] = Addresses()
        pages[file].feed(file.read_text(encoding="utf-8"))
    problems = []
    for file, page in pages.items():
        name = file.relative_to(site)
        problems += [f"{name} loads {address} from elsewhere" for address in page.loads if re.match(r"(https?:)?//", address)]
        for address in page.links + page.loads:
            if re.match(r"[a-z]+:|//", address):
                continue
            path, anchor = urldefrag(address)
            target = (file.parent / unquote(path)).resolve() if path else file
            if target.is_dir():
                target = target / "index.html"
            if not target.is_file():
                problems.append(f"{name}: {address} leads nowhere")
            elif anchor and target in pages and unquote(anchor) not in pages[target].anchors:
                problems.append(f"{name}: {address} has no such place")
    return problems


if __name__ == "__main__":
    main()
