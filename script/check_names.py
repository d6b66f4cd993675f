#!/usr/bin/env python3
"""Fails where two sources of a room give one name to different things in their anonymous namespaces, or a source and a header
of its room give one to a constant or a type. Builds compile a room in batches of sources, in which such names meet; which ones
meet changes with every new file.

Needs Universal Ctags; exit status 77 without it, 1 where SPF_REQUIRE_TOOLS is 1."""
import re
import sys
from collections import defaultdict
from pathlib import Path

from check_limits import files_of, main, tags_of

BUILT_IN = (" int", " long", " char", " short", " double")  # may be a word of a type of several
ROOMS_WITHIN = ("spf", "apps", "ros2")  # folders whose folders are rooms; elsewhere each folder is one
NOT_BATCHED = ("bench", "fuzz", "examples", "python")


def batch_of(path):
    """Room of a source, and whether it is a test: what may be compiled together. None where each source stands alone."""
    parts = Path(path).parts
    if len(parts) < 2 or parts[0] in NOT_BATCHED:
        return None
    room = "/".join(parts[:2]) if parts[0] in ROOMS_WITHIN and len(parts) > 2 else parts[0]
    return room, path.endswith("_test.cpp")


def types_of(signature):
    """A signature as the compiler tells functions apart: without its parameters' names and defaults."""
    types, depth, start, default = [], 0, 1, None
    for at, letter in enumerate(signature):
        # In a default, < and > compare.
        opening, closing = ("([{", ")]}") if default is not None else ("([{<", ")]}>")
        depth += (letter in opening) - (letter in closing)
        if letter == "=" and depth == 1 and default is None:
            default = at
        if (letter == "," and depth == 1) or (letter == ")" and depth == 0):
            types.append(type_of(signature[start:at if default is None else default].strip()))
            start, default = at + 1, None
    return ",".join(types)


def type_of(parameter):
    """Without its name, which is the last word behind a type."""
    before = re.sub(r"\w+(?=(\[\w*\])*$)", "", parameter)
    words = re.findall(r"\w+", re.sub(r"<.*>", "", before))
    unnamed = all(word in ("const", "unsigned", "signed", "std") for word in words) or parameter.endswith(BUILT_IN)
    return (parameter if unnamed else before).replace(" ", "")


def names_in(root, files, kinds):
    """(tag, its namespace, whether that is an anonymous one within) for all that stands in a namespace."""
    for tag in tags_of(root, files, kinds) if files else []:
        if tag.get("scopeKind") == "namespace":
            outer, _, inner = tag["scope"].rpartition("::")
            hidden = inner.startswith("__anon")
            yield tag, outer if hidden else tag["scope"], hidden


def check(root):
    """One sentence for each name that two files give."""
    files = [name for name in files_of(root) if name.endswith((".cpp", ".hpp")) and batch_of(name)]
    places = defaultdict(dict)
    for tag, namespace, hidden in names_in(root, [name for name in files if name.endswith(".cpp")], "cfsuveg"):
        if hidden:  # functions may share a name as long as their parameters differ
            what = (tag["name"], types_of(tag.get("signature", "")))
            places[batch_of(tag["path"]), namespace, what].setdefault(tag["path"], tag["line"])
    for tag, namespace, hidden in names_in(root, [name for name in files if name.endswith(".hpp")], "csuvgfp"):
        for test in (False, True):
            place = (batch_of(tag["path"])[0], test), namespace, (tag["name"], types_of(tag.get("signature", "")))
            if not hidden and place in places:
                places[place].setdefault(tag["path"], tag["line"])
    return [f"{'room' if not test else 'tests of room'} {room}: '{name}' is declared in "
            + " and ".join(f"{path}:{line}" for path, line in found.items())
            for ((room, test), _, (name, _)), found in sorted(places.items()) if len(found) > 1]


if __name__ == "__main__":
    sys.exit(main(check, "names: none is given twice in a room"))
