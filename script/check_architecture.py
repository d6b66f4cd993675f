#!/usr/bin/env python3
"""check_architecture.py [ROOT] : do the rooms keep to the house rules of docs/architecture.md?

Arrows: an #include from the repository's root must be covered by the DEPENDS of the file's room, directly or through
other rooms (in tests by TEST_DEPENDS too); rooms form no circle; a core room uses core rooms and Eigen alone.
Purity: the sources of spf/ hold no file, stream, clock, thread, outside randomness, changeable static or global, and
no ROS. spf/testing is free of this, and so are tests: what is named *_test or lies in a folder called test.
Apart: the simulated world includes, by whatever detour, nothing of agents and planners, so that any host can use it.
Threads: outside tests, room `parallel` alone starts and guards them.
Page: the diagram of docs/architecture.md has the arrows of the DEPENDS and no others, its table every room.
Prints FILE:LINE: sentence for each breach; exit status 1 if there is one.
"""
import functools
import os
import re
import sys
from pathlib import Path

CORE = "spf"
PAGE = "docs/architecture.md"
SKIPPED_FOLDERS = {"build", "node_modules", ".git", "results"}
SOURCE_SUFFIXES = {".cpp", ".hpp"}

# Threads belong to one room; the others hand it their jobs.
THREADS_ROOM = "parallel"
THREAD_HEADERS = {"thread", "mutex", "shared_mutex", "atomic", "condition_variable", "future", "latch", "barrier",
                  "semaphore", "stop_token"}

FORBIDDEN_HEADERS = {
    "fstream": "files belong to hosts", "iostream": "printing belongs to hosts", "ostream": "printing belongs to hosts",
    "cstdio": "files belong to hosts", "filesystem": "files belong to hosts",
    "chrono": "time is an argument", "ctime": "time is an argument",
    "thread": "core objects are single-threaded", "mutex": "core objects are single-threaded",
    "shared_mutex": "core objects are single-threaded", "atomic": "core objects are single-threaded",
    "condition_variable": "core objects are single-threaded", "future": "core objects are single-threaded",
    "random": "chance is a RandomStream argument",
}
FORBIDDEN_WORDS = [
    (re.compile(r"\b(system_clock|steady_clock|high_resolution_clock|clock_gettime|gettimeofday)\b"), "reads a clock"),
    (re.compile(r"\bstd::(cout|cerr|clog|cin)\b|(?<![\w.>])(printf|puts|fopen)\s*\("), "prints or opens a file"),
    (re.compile(r"\brandom_device\b|(?<![\w.>])s?rand\s*\("), "draws randomness that no seed repeats"),
    (re.compile(r"(?<![\w.>])getenv\s*\("), "reads the environment"),
    (re.compile(r"\bthread_local\b"), "keeps hidden state"),
]
# What a file may not include, however indirectly.
APART = {"sim/world.cpp": ("spf/planning/", "spf/team/robot_agent.hpp", "spf/tracking/", "host/planner_host.hpp",
                          "host/tracker_host.hpp", "host/robot_host.hpp")}
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*(["<])([^">]+)[">]', re.MULTILINE)
ROOM_CALL = re.compile(r"\bspf_room\s*\(([^)]*)\)")
ROOM_KEYWORDS = {"STANDARD", "HEADERS", "DEPENDS", "TEST_DEPENDS"}
# `static` up to the point where the declaration shows what it is: a function has its parenthesis first.
STATIC = re.compile(r"\bstatic\b(?P<declaration>[^;={}()]*)(?P<end>[;={(])")
# A variable at namespace scope; declarations there start in the first column (clang-format keeps it so).
GLOBAL = re.compile(r"^(?P<declaration>(?:inline\s+)?[A-Za-z_][\w:]*(?:<[^;={}()]*>)?[\s*&]+\w+)\s*(?:=(?!=)|\{|;)", re.MULTILINE)
NOT_A_VARIABLE = re.compile(
    r"\b(const|constexpr|constinit|using|namespace|struct|class|union|enum|extern|friend|typedef|template|return|static|"
    r"concept|goto|case)\b")


class Room:
    """One spf_room: its folder, and the rooms that it may use."""

    def __init__(self, name, folder, depends, test_depends):
        self.name, self.folder, self.depends, self.test_depends = name, folder, depends, test_depends

    @property
    def is_core(self):
        return self.folder.parts[0] == CORE

    @property
    def is_pure(self):
        return self.is_core and self.name != "testing"


def project_files(root):
    """Paths from the root of all files that can matter, in order."""
    found = []
    for folder, subfolders, names in os.walk(root):
        subfolders[:] = [name for name in subfolders if name not in SKIPPED_FOLDERS]
        found += [Path(folder, name).relative_to(root) for name in names
                  if name == "CMakeLists.txt" or Path(name).suffix in SOURCE_SUFFIXES]
    return sorted(found)


def read_rooms(root, files):
    rooms = {}
    for file in files:
        if file.name != "CMakeLists.txt" or file == Path("CMakeLists.txt"):
            continue
        text = re.sub(r"#.*", "", (root / file).read_text(encoding="utf-8"))
        for call in ROOM_CALL.finditer(text):
            name, *words = call.group(1).split()
            lists, current = {keyword: [] for keyword in ROOM_KEYWORDS}, None
            for word in words:
                if word in ROOM_KEYWORDS:
                    current = word
                elif current:
                    lists[current].append(word)
            rooms[name] = Room(name, file.parent, lists["DEPENDS"], lists["TEST_DEPENDS"])
    return rooms


def room_names(targets):
    """spf::field and spf_field both mean the room `field`; other words are libraries."""
    return [match.group(1) for match in (re.fullmatch(r"spf(?:::|_)(\w+)", target) for target in targets) if match]


def reachable(rooms, name, with_tests):
    """The rooms that `name` may include, itself among them."""
    found, waiting = set(), [name]
    while waiting:
        current = waiting.pop()
        if current in found or current not in rooms:
            continue
        found.add(current)
        waiting += room_names(rooms[current].depends)
        if with_tests and current == name:
            waiting += room_names(rooms[current].test_depends)
    return found


@functools.lru_cache(maxsize=None)
def without_comments_and_strings(text):
    """The same text with both blanked out, so that positions stay where they were; include lines keep their names."""
    token = re.compile(
        r'//[^\n]*|/\*.*?\*/|R"(?P<mark>[^()\\\s]{0,16})\(.*?\)(?P=mark)"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'',
        re.DOTALL)
    include_names = {match.start(1) for match in INCLUDE.finditer(text)}

    def blank(match):
        if match.start() in include_names:
            return match.group()
        # 1'000'000 is a number, not a character.
        if match.group()[0] == "'" and match.start() and text[match.start() - 1].isalnum():
            return match.group()
        return re.sub(r"[^\n]", " ", match.group())

    return token.sub(blank, text)


def line_of(text, position):
    return text.count("\n", 0, position) + 1


def is_test(file):
    return file.stem.endswith("_test") or "test" in file.parts


def check_rooms(rooms):
    for room in rooms.values():
        where = room.folder / "CMakeLists.txt"
        for used in room_names(room.depends):
            if used not in rooms:
                yield f"{where}:1: room {room.name} uses {used}, which is no room"
            elif room.name in reachable(rooms, used, with_tests=False):
                yield f"{where}:1: room {room.name} uses {used}, and {used} uses {room.name}: a circle"
            elif used == "testing":
                yield f"{where}:1: room {room.name} uses testing, which is for TEST_DEPENDS alone"
            elif room.is_core and not rooms[used].is_core:
                yield f"{where}:1: core room {room.name} uses {used}, which is no core room"
        if room.is_core:
            for library in room.depends:
                if not room_names([library]) and library != "Eigen3::Eigen":
                    yield f"{where}:1: core room {room.name} uses {library}; the core uses Eigen alone"


def check_page(root, rooms):
    """Does docs/architecture.md show the rooms and arrows that there are?"""
    page = root / PAGE
    if not page.is_file():
        yield f"{PAGE}:1: is missing"
        return
    drawn, listed, in_diagram = {}, set(), False
    for number, line in enumerate(page.read_text(encoding="utf-8").splitlines(), 1):
        if line.startswith("```"):
            in_diagram = line == "```mermaid"
        arrow = re.fullmatch(r"\s*(\w+) --> (\w+)", line)
        if in_diagram and arrow:
            drawn[arrow.groups()] = number
        row = re.match(r"\| `([\w/]+)` \|", line)
        if row:
            listed.add(row.group(1))
    meant = {(room.name, used) for room in rooms.values() for used in room_names(room.depends)}
    for arrow in sorted(drawn.keys() - meant):
        yield f"{PAGE}:{drawn[arrow]}: draws {arrow[0]} --> {arrow[1]}, but room {arrow[0]} does not depend on {arrow[1]}"
    for name, used in sorted(meant - drawn.keys()):
        yield f"{PAGE}:1: does not draw {name} --> {used}, though room {name} depends on {used}"
    for room in rooms.values():
        if str(room.folder) not in listed:
            yield f"{PAGE}:1: its table of rooms lacks {room.folder}"


def owner_of(rooms, file):
    """The room of the nearest folder above the file that is one."""
    by_folder = {str(room.folder): room for room in rooms.values()}
    folder = os.path.dirname(file)
    while folder and folder not in by_folder:
        folder = os.path.dirname(folder)
    return by_folder.get(folder)


def check_includes(rooms, room, file, code):
    allowed = reachable(rooms, room.name, with_tests=is_test(file))
    tops = {other.folder.parts[0] for other in rooms.values()}
    for include in INCLUDE.finditer(code):
        where, quote, header = f"{file}:{line_of(code, include.start())}", include.group(1), include.group(2)
        if header.split("/")[0] in tops:
            target = owner_of(rooms, header)
            if target is None:
                yield f"{where}: includes {header}, which lies in no room"
            elif target.name not in allowed:
                yield f"{where}: room {room.name} includes {header}, but does not depend on {target.name}"
            elif quote == "<":
                yield f"{where}: includes <{header}>; the project's own headers stand in quotation marks"
        elif quote == '"':
            yield f'{where}: includes "{header}", which is not written from the root of the repository'
        elif room.is_pure and not is_test(file):
            yield from check_foreign_header(where, header)
        elif header in THREAD_HEADERS and not (room.is_core or room.name == THREADS_ROOM or is_test(file)):
            yield f"{where}: includes <{header}>; threads belong to room {THREADS_ROOM} alone"


def check_apart(root):
    """Files of APART, followed through the project's own headers."""
    for file, others in APART.items():
        waiting, seen = [(file, [])], {file}
        while waiting:
            current, chain = waiting.pop(0)
            if not (root / current).is_file():
                continue
            code = without_comments_and_strings((root / current).read_text(encoding="utf-8"))
            for header in (include.group(2) for include in INCLUDE.finditer(code)):
                if header in seen:
                    continue
                seen.add(header)
                if header.startswith(others):
                    yield f"{file}:1: includes {header} by {' -> '.join(chain + [current])}; it stands apart from agents"
                else:
                    waiting.append((header, chain + [current]))


def check_foreign_header(where, header):
    if header in FORBIDDEN_HEADERS:
        yield f"{where}: includes <{header}> in the core: {FORBIDDEN_HEADERS[header]}"
    elif not header.startswith("Eigen/") and not re.fullmatch(r"[a-z_]+", header):
        yield f"{where}: includes <{header}> in the core, which uses Eigen and the standard library alone"


def check_purity(file, code):
    for pattern, breach in FORBIDDEN_WORDS:
        for match in pattern.finditer(code):
            yield f"{file}:{line_of(code, match.start())}: the core {breach} ({match.group().strip()})"
    for match in STATIC.finditer(code):
        if match.group("end") != "(" and not re.search(r"\bconst(expr|init)?\b", match.group("declaration")):
            yield f"{file}:{line_of(code, match.start())}: a changeable static variable in the core"
    for match in GLOBAL.finditer(code):
        if not NOT_A_VARIABLE.search(match.group("declaration")):
            yield f"{file}:{line_of(code, match.start())}: a changeable global variable in the core"


def check(root):
    """Every breach below `root`, as one sentence each."""
    files = list(project_files(root))
    rooms = read_rooms(root, files)
    if not rooms:
        return ["CMakeLists.txt:1: found no rooms"]
    breaches = list(check_rooms(rooms)) + list(check_page(root, rooms)) + list(check_apart(root))
    for file in files:
        room = owner_of(rooms, file)
        if room is None or file.suffix not in SOURCE_SUFFIXES:
            continue
        code = without_comments_and_strings((root / file).read_text(encoding="utf-8"))
        breaches += check_includes(rooms, room, file, code)
        if room.is_pure and not is_test(file):
            breaches += check_purity(file, code)
        if file.suffix == ".hpp" and "#pragma once" not in code:
            breaches.append(f"{file}:1: a header without #pragma once")
    return breaches


def main(arguments):
    root = Path(arguments[0]) if arguments else Path(__file__).resolve().parent.parent
    breaches = check(root)
    print("\n".join(breaches) if breaches else "architecture: all rooms keep to their arrows")
    return 1 if breaches else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
