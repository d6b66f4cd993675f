#!/usr/bin/env python3
"""Fails where two sources of a room give one name to different things in their anonymous namespaces. The sanitizers' builds
and all tests compile a room in batches of sources, in which such names meet; which ones meet changes with every new file.

Needs Universal Ctags; exit status 77 without it, 1 where SPF_REQUIRE_TOOLS is 1."""
import sys
from collections import defaultdict
from pathlib import Path

from check_limits import files_of, main, tags_of

ROOMS_WITHIN = ("spf", "apps", "ros2")  # folders whose folders are rooms; elsewhere each folder is one
NOT_BATCHED = ("bench", "fuzz", "examples", "python", "ros")


def batch_of(path):
    """Room of a source, and whether it is a test: what may be compiled together. None where each source stands alone."""
    parts = Path(path).parts
    if len(parts) < 2 or parts[0] in NOT_BATCHED:
        return None
    room = "/".join(parts[:2]) if parts[0] in ROOMS_WITHIN and len(parts) > 2 else parts[0]
    return room, path.endswith("_test.cpp")


def check(root):
    """One sentence for each name that two sources give."""
    names = [name for name in files_of(root) if name.endswith(".cpp") and batch_of(name)]
    places = defaultdict(dict)
    for tag in tags_of(root, names, "cfsuveg") if names else []:
        if not tag.get("scope", "").rpartition("::")[2].startswith("__anon") or tag.get("scopeKind") != "namespace":
            continue
        # Functions may share a name as long as their parameters differ.
        what = (tag["name"], tag.get("signature", "").replace(" ", ""))
        namespace = tag["scope"].rpartition("::")[0]
        places[batch_of(tag["path"]), namespace, what].setdefault(tag["path"], tag["line"])
    return [f"{'room' if not test else 'tests of room'} {room}: '{name}' is declared in "
            + " and ".join(f"{path}:{line}" for path, line in found.items())
            for ((room, test), _, (name, _)), found in sorted(places.items()) if len(found) > 1]


if __name__ == "__main__":
    sys.exit(main(check, "names: none is given twice in a room"))
