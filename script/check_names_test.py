#!/usr/bin/env python3
"""Does check_names.py catch what it is for? One name for two things in a room must be named with both places; what may
share a name must pass."""
import shutil
import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True  # nothing is left beside the sources

import check_limits
import check_names

CONSTANT = "namespace spf {\nnamespace {\nconstexpr double kLimit = 1.0;\n}\n}\n"


class Names(unittest.TestCase):
    def breaches_of(self, **sources):
        with tempfile.TemporaryDirectory() as scratch:
            for name, text in sources.items():
                path = Path(scratch) / (name.replace("__", "/") + (".hpp" if name.endswith("header") else ".cpp"))
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text, encoding="utf-8")
            return check_names.check(Path(scratch))

    def test_a_constant_given_twice(self):
        found = self.breaches_of(spf__planning__a=CONSTANT, spf__planning__field__b=CONSTANT)
        self.assertEqual(len(found), 1, found)
        for part in ("spf/planning", "kLimit", "a.cpp:3", "field/b.cpp:3"):
            self.assertIn(part, found[0])

    def test_tests_meet_only_tests(self):
        self.assertEqual(len(self.breaches_of(sim__a_test=CONSTANT, sim__b_test=CONSTANT)), 1)
        self.assertEqual(self.breaches_of(sim__a=CONSTANT, sim__a_test=CONSTANT), [])

    def test_other_rooms_never_meet(self):
        self.assertEqual(self.breaches_of(spf__planning__a=CONSTANT, spf__team__a=CONSTANT), [])

    def test_a_constant_of_a_header_of_the_room(self):
        public = "namespace spf {\ninline constexpr double kLimit = 1.0;\n}\n"
        found = self.breaches_of(host__a=CONSTANT, host__some_header=public)
        self.assertEqual(len(found), 1, found)
        self.assertIn("host/some_header.hpp:2", found[0])
        self.assertEqual(self.breaches_of(host__a=CONSTANT, sim__some_header=public), [])

    def test_a_function_of_a_header_of_the_room(self):
        public = "namespace spf {\ninline double area(double side) { return side * side; }\n}\n"
        hidden = "namespace spf {\nnamespace {\ndouble area(double edge) { return edge * edge; }\n}\n}\n"
        self.assertEqual(len(self.breaches_of(host__a_test=hidden, host__some_header=public)), 1)
        self.assertEqual(self.breaches_of(host__a_test=hidden.replace("double edge", "float edge"),
                                          host__some_header=public), [])

    def test_functions_may_differ_by_their_parameters(self):
        one = "namespace {\ndouble area(double side) { return side * side; }\n}\n"
        other = "namespace {\ndouble area(double width, double height) { return width * height; }\n}\n"
        self.assertEqual(self.breaches_of(spf__map__a=one, spf__map__b=other), [])
        self.assertEqual(len(self.breaches_of(spf__map__a=one, spf__map__b=one)), 1)
        for before, after in (("double side", "double edge"), ("double side", "double side = 1.0")):
            self.assertEqual(len(self.breaches_of(spf__map__a=one, spf__map__b=one.replace(before, after))), 1)

    def test_a_signature_without_the_names_of_its_parameters(self):
        for signature, types in (
                ("()", ""),
                ("(double a, int b)", "double,int"),
                ("(const Eigen::Vector2d& point, const std::map<int, double>& all = {})",
                 "constEigen::Vector2d&,conststd::map<int,double>&"),
                ("(double *out)", "double*"),
                ("(std::vector<Box> boxes, Box)", "std::vector<Box>,Box"),
                ("(unsigned int, unsigned int a)", "unsignedint,unsignedint"),
                ("(const Box, const Box box)", "constBox,constBox"),
                ("(double v[3], const double *w[])", "double[3],constdouble*[]"),
                ("(bool b = x > 3, int c = f(1, 2))", "bool,int")):
            self.assertEqual(check_names.types_of(signature), types, signature)

    def test_members_and_public_names_are_free(self):
        member = "namespace {\nstruct %s {\n  double length = 1.0;\n};\n}\n"
        self.assertEqual(self.breaches_of(sim__a=member % "Rod", sim__b=member % "Beam"), [])


if __name__ == "__main__":
    if shutil.which("ctags") is None:
        print("ctags is not installed (script/setup check)", file=sys.stderr)
        sys.exit(check_limits.no_tool())
    unittest.main()
