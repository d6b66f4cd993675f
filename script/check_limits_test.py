#!/usr/bin/env python3
"""Does check_limits.py catch what it is for? What is one too large must be named with its place; what just fits must
pass."""
import shutil
import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True  # nothing is left beside the sources

import check_limits


class Limits(unittest.TestCase):
    def breaches_of(self, name, text):
        with tempfile.TemporaryDirectory() as scratch:
            path = Path(scratch) / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
            return check_limits.check(Path(scratch))

    def assert_caught(self, name, text, words):
        found = self.breaches_of(name, text)
        self.assertEqual(len(found), 1, found)
        self.assertTrue(found[0].startswith(name), found[0])
        self.assertIn(words, found[0])

    def assert_passes(self, name, text):
        self.assertEqual(self.breaches_of(name, text), [])

    def test_files(self):
        for name in ("host/long.cpp", "report/page.js", "tools/long.py"):
            self.assert_caught(name, "\n" * 401, "401 lines, at most 400")
            self.assert_passes(name, "\n" * 400)
        for first in ("#!/usr/bin/env bash", "#!/bin/sh", "#!/usr/bin/env python3"):
            self.assert_caught("tools/long", first + "\n" * 401, "401 lines, at most 400")
        self.assert_passes("data/long", "bash\n" * 401)

    def test_tests_may_be_long(self):
        for name in ("host/long_test.cpp", "report/test/sample.cpp", "fuzz/any.cpp", "ros/x/test/y_rostest.py"):
            self.assert_passes(name, "\n" * 1000)

    def test_functions(self):
        def source(lines):
            return "namespace spf {\nint Thing::act(int a) {\n" + "  ++a;\n" * (lines - 3) + "  return a;\n}\n}\n"
        self.assert_caught("spf/thing.cpp", source(61), "cpp:2: spf::Thing::act has 61 lines, at most 60")
        self.assert_passes("spf/thing.cpp", source(60))

    def test_functions_of_scripts(self):
        def source(head, line, lines, tail):
            return "\n" + head + "\n" + line * (lines - 1 - len(tail)) + "".join(tail) + "\n"
        for name, head, line, tail in (
                ("tools/act.py", "def act(a):", "    a += 1\n", []),
                ("report/act.js", "export function act(a) {", "  a += 1;\n", ["}\n"]),
                ("report/act.js", "const act = (a) => {", "  a += 1;\n", ["};\n"]),
                ("report/act.mjs", "  act(a) {", "    a += 1;\n", ["  }\n"]),
                ("tools/act.sh", "act() {", "  : 1\n", ["}\n"])):
            self.assert_caught(name, source(head, line, 61, tail), ":2: act has 61 lines, at most 60")
            self.assert_passes(name, source(head, line, 60, tail))

    def test_a_template_with_a_lambda_is_one_function(self):
        source = "template <class T>\nvoid act(T&& t) {\n  t([&] {\n" + "    f();\n" * 60 + "  });\n}\n"
        self.assert_caught("spf/thing.hpp", source, "act has 64 lines")

    def test_classes(self):
        def source(kind, members):
            return f"{kind} Thing {{\n public:\n  void act();\n  static const int a;\n private:\n" + "".join(
                f"  std::vector<int> member{i}_ = {{1, 2}};\n" for i in range(members)) + "};\n"
        self.assert_caught("spf/thing.hpp", source("class", 21), "hpp:1: Thing has 21 data members, at most 20")
        self.assert_passes("spf/thing.hpp", source("class", 20))
        self.assert_caught("spf/thing.hpp", source("struct", 21), "hpp:1: Thing has 21 data members, at most 20")
        self.assert_passes("spf/thing.hpp", source("struct", 20))

    def test_a_record_has_as_many_members_as_its_file_has_fields(self):
        source = "struct Thing {\n" + "".join(f"  int member{i} = 0;\n" for i in range(30)) + (
            "  template <class Self, class Visitor>\n  static void visit_fields(Self& self, Visitor&& visit) {\n"
            "    visit(self);\n  }\n};\n")
        self.assert_passes("spf/thing.hpp", source)

    def test_what_hides_behind_a_pointer(self):
        source = "struct Thing::Implementation {\n" + "".join(f"  int member{i} = 0;\n" for i in range(21)) + "};\n"
        self.assert_caught("spf/thing.cpp", source, "Implementation has 21 data members")


if __name__ == "__main__":
    if shutil.which("ctags") is None:
        print("ctags is not installed (script/setup check)", file=sys.stderr)
        sys.exit(check_limits.no_tool())
    unittest.main()
