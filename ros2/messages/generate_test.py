#!/usr/bin/env python3
"""Does generate.py read what ROS 2's definitions may hold, and refuse the rest with its place?"""
import contextlib
import io
import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True  # nothing is left beside the sources

import generate


class Generator(unittest.TestCase):
    def made_of(self, files):
        """Exit status, messages, and what was made, by name."""
        with tempfile.TemporaryDirectory() as scratch:
            for name, text in files.items():
                path = Path(scratch, "in", name)
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text, encoding="utf-8")
            said = io.StringIO()
            with contextlib.redirect_stderr(said):
                status = generate.main([str(Path(scratch, "out")), str(Path(scratch, "in"))])
            out = Path(scratch, "out")
            made = {str(path.relative_to(out)): path.read_text(encoding="utf-8") for path in out.rglob("*.hpp")}
            return status, said.getvalue().replace(str(Path(scratch, "in")) + "/", ""), made

    def struct_of(self, text):
        status, said, made = self.made_of({"p/msg/M.msg": text})
        self.assertEqual(status, 0, said)
        return made["p/M.hpp"]

    def assert_refused(self, text, sentence):
        self.assertEqual(self.made_of({"p/msg/M.msg": text})[:2], (1, sentence + "\n"))

    def test_fields(self):
        struct = self.struct_of("# a comment\nint8 ONE=1  # why\nstring NAME='x'\nfloat32 w 0.5\nstring<=5[<=3] names\n"
                                "bool[4] flags\nfloat64[] values\n")
        for line in ("static constexpr std::int8_t ONE = 1;", 'static constexpr const char* NAME = "x";',
                     "float w{static_cast<float>(0.5)};", "std::vector<std::string> names{};",
                     "std::array<bool, 4> flags{};", "std::vector<double> values{};", 'visit("values", self.values);'):
            self.assertIn(line, struct)

    def test_an_empty_message_has_a_member(self):
        self.assertIn("std::uint8_t structure_needs_at_least_one_member{};", self.struct_of(""))

    def test_types_of_other_packages_and_of_the_same(self):
        made = self.made_of({"a/msg/A.msg": "int32 x\n", "b/msg/B.msg": "a/A one\nC two\n", "b/msg/C.msg": "bool y\n"})[2]
        self.assertIn("::ros2::a::A one{};", made["b/B.hpp"])
        self.assertIn("#include <ros2_messages/a/A.hpp>", made["b/B.hpp"])
        self.assertIn("::ros2::b::C two{};", made["b/B.hpp"])

    def test_a_message_knows_its_whole_definition(self):
        made = self.made_of({"a/msg/A.msg": "b/B one\nC two\n", "a/msg/C.msg": "bool y\n", "b/msg/B.msg": "a/C[] all\n"})[2]
        rule = "=" * 80
        self.assertIn(f"b/B one\nC two\n{rule}\nMSG: a/C\nbool y\n{rule}\nMSG: b/B\na/C[] all\n)ros2msg", made["a/A.hpp"])

    def test_a_distribution_has_its_own_namespace_and_hash(self):
        files = {"p/msg/M.msg": "int32 x\n", "old/p/msg/M.msg": "int64 x\n"}
        made = self.made_of(files)[2]
        self.assertIn("namespace ros2::old::p {", made["old/p/M.hpp"])
        self.assertNotEqual(*(text[text.index("RIHS01_"):][:71] for text in made.values()))

    def test_what_is_none_is_refused_by_its_place(self):
        self.assert_refused("int32 x\nint32\n", "p/msg/M.msg:2: 'int32' is neither a field nor a constant")
        self.assert_refused("int32<=4 x\n", "p/msg/M.msg:1: 'int32<=4 x': only strings are bounded by <=")
        self.assert_refused("int32[] x [1]\n", "p/msg/M.msg:1: 'int32[] x [1]': defaults of arrays are not supported")
        self.assert_refused("q/N x=3\n", "p/msg/M.msg:1: 'q/N x=3': only primitive types have constants and defaults")
        self.assert_refused("q/N x\n", "p/msg/M: x is of type q/msg/N, which is not defined")
        self.assert_refused("int32 x\n---\nint32 y\n", "p/msg/M.msg:1: has 2 parts, must have 1")


if __name__ == "__main__":
    unittest.main()
