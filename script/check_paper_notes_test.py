#!/usr/bin/env python3
"""Does check_paper_notes.py see a note without a test?"""
import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True  # nothing is left beside the sources

import check_paper_notes


class Notes(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.root = Path(scratch.name)
        (self.root / "docs").mkdir()
        (self.root / "x").mkdir()
        (self.root / "x/a_test.cpp").write_text(
            "TEST(Unit, Holds) {}\nTEST_P(Cases, Hold) {}\nTYPED_TEST(Kinds,\n           Hold) {}\n", encoding="utf-8")

    def problems(self, *rows):
        text = "| no. | text | test |\n|---|---|---|\n" + "".join(row + "\n" for row in rows)
        (self.root / "docs/paper_notes.md").write_text(text, encoding="utf-8")
        return check_paper_notes.check(self.root)[0]

    def test_resolved_rows_pass(self):
        self.assertEqual(self.problems("| 1 | a | `x/a_test.cpp` `Unit.Holds`, `Cases.Hold` |",
                                       "| 2 | b | `x/a_test.cpp` `Kinds.Hold` |"), [])

    def test_breaches_are_named(self):
        for row, words in [
            ("| 1 | a | `x/a_test.cpp` `Unit.Fails` |", "no test Unit.Fails"),
            ("| 1 | a | `x/gone_test.cpp` `Unit.Holds` |", "no x/gone_test.cpp"),
            ("| 1 | a | to come |", "names no test"),
            ("| 1 | a | `x/a_test.cpp` |", "names no test"),
            ("| 2 | a | `x/a_test.cpp` `Unit.Holds` |", "not numbered"),
        ]:
            with self.subTest(row=row):
                found = self.problems(row)
                self.assertEqual(len(found), 1, found)
                self.assertIn(words, found[0])

    def test_a_page_without_rows_fails(self):
        self.assertEqual(len(self.problems()), 1)


if __name__ == "__main__":
    unittest.main()
