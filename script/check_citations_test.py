#!/usr/bin/env python3
"""Does check_citations.py see what is cited and not there?"""
import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True  # nothing is left beside the sources

import check_citations


class Citations(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.root = Path(scratch.name)
        (self.root / "docs").mkdir()
        (self.root / "docs/protocol.md").write_text("# Protocol\n\n## One step, and the end\n", encoding="utf-8")

    def problems(self, name, text):
        (self.root / name).write_text(text, encoding="utf-8")
        return check_citations.check(self.root)[0]

    def test_pages_and_headings_that_exist_pass(self):
        self.assertEqual(self.problems("a.hpp", "// the order of docs/protocol.md\n"), [])
        self.assertEqual(self.problems("docs/b.md", "[a](protocol.md#one-step-and-the-end), [b](https://example.org/x#y)\n"), [])

    def test_a_missing_page_is_seen(self):
        self.assertEqual(self.problems("a.hpp", "int a;  // see docs/gone.md\n"), ["a.hpp:1: cites docs/gone.md, which is not there"])

    def test_a_missing_script_is_seen(self):
        self.assertEqual(len(self.problems("a.md", "`script/gone` makes it\n")), 1)

    def test_a_missing_link_or_heading_is_seen(self):
        self.assertEqual(len(self.problems("docs/b.md", "[a](gone.md)\n[b](protocol.md#gone)\n[c](#gone)\n")), 3)

    def test_a_section_by_its_number_is_seen(self):
        self.assertEqual(len(self.problems("a.hpp", "// (protocol section 4)\n// (design: team)\n")), 2)


if __name__ == "__main__":
    unittest.main()
