#!/usr/bin/env python3
"""Does check_architecture.py catch what it is for? Deliberate breaches in a copy of the rooms must be named, with their
place; look-alikes must pass."""
import shutil
import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True  # nothing is left beside the sources

import check_architecture

ROOT = Path(__file__).resolve().parent.parent
PURE = "spf/math/probe.cpp"


class Copy(unittest.TestCase):
    """A scratch copy of the core's rooms, which each test spoils in its own way."""

    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.root = Path(scratch.name)
        for file in check_architecture.project_files(ROOT / "spf"):
            file = "spf" / file
            (self.root / file).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / file, self.root / file)
        self.before = set(check_architecture.check(self.root))

    def breaches_of(self, file, text):
        """What the check says about a file with this text, beyond what it said before."""
        path = self.root / file
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        return sorted(set(check_architecture.check(self.root)) - self.before)

    def assert_caught(self, file, text, line, words):
        found = self.breaches_of(file, text)
        self.assertEqual(len(found), 1, found)
        self.assertTrue(found[0].startswith(f"{file}:{line}: "), found[0])
        self.assertIn(words, found[0])

    def assert_passes(self, file, text):
        self.assertEqual(self.breaches_of(file, text), [])


class Apart(Copy):
    def test_the_world_knows_no_agent_by_a_detour(self):
        self.breaches_of("sim/clock.hpp", '#pragma once\n#include "spf/team/robot_agent.hpp"\n')
        found = [line for line in self.breaches_of("sim/world.cpp", '#include "sim/clock.hpp"\n') if "apart" in line]
        self.assertEqual(len(found), 1, found)
        self.assertTrue(found[0].startswith("sim/world.cpp:1: includes spf/team/robot_agent.hpp by sim/world.cpp -> "), found)

    def test_the_world_may_know_why_a_robot_stops(self):
        self.assertEqual([line for line in self.breaches_of("sim/world.cpp", '#include "spf/team/stop_cause.hpp"\n')
                          if "apart" in line], [])


class Page(unittest.TestCase):
    """The page of a house with two rooms."""

    def breaches_with(self, page):
        with tempfile.TemporaryDirectory() as scratch:
            root = Path(scratch)
            for room, depends in (("low", "Eigen3::Eigen"), ("high", "spf::low")):
                (root / "spf" / room).mkdir(parents=True)
                (root / "spf" / room / "CMakeLists.txt").write_text(f"spf_room({room} DEPENDS {depends})\n", encoding="utf-8")
            if page is not None:
                (root / "docs").mkdir()
                (root / "docs" / "architecture.md").write_text(page, encoding="utf-8")
            return check_architecture.check(root)

    TABLE = "| `spf/low` | ground |\n| `spf/high` | roof |\n"

    def test_what_there_is_passes(self):
        self.assertEqual(self.breaches_with(self.TABLE + "```mermaid\ngraph BT\n  high --> low\n```\n"), [])

    def test_a_missing_page_or_arrow_or_room_is_caught(self):
        self.assertEqual(len(self.breaches_with(None)), 1)
        self.assertEqual(self.breaches_with(self.TABLE + "```mermaid\ngraph BT\n```\nhigh --> low\n"),
                         ["docs/architecture.md:1: does not draw high --> low, though room high depends on low"])
        self.assertEqual(self.breaches_with("| `spf/low` | ground |\n```mermaid\n  high --> low\n```\n"),
                         ["docs/architecture.md:1: its table of rooms lacks spf/high"])

    def test_an_arrow_that_is_none_is_caught(self):
        found = self.breaches_with(self.TABLE + "```mermaid\n  high --> low\n  low --> high\n```\n")
        self.assertEqual(found, ["docs/architecture.md:5: draws low --> high, but room low does not depend on high"])


class Arrows(Copy):
    def test_upward_include_is_caught(self):
        self.assert_caught(PURE, '#include <cmath>\n#include "spf/team/robot_agent.hpp"\n', 2, "does not depend on team")

    def test_sideways_include_is_caught(self):
        self.assert_caught("spf/planning/probe.cpp", '#include "spf/tracking/mpc.hpp"\n', 1, "depend on tracking")

    def test_include_through_other_rooms_passes(self):
        self.assert_passes("spf/team/probe.cpp", '#include "spf/math/angles.hpp"\n#include "spf/world/peer.hpp"\n')

    def test_testing_is_for_tests(self):
        text = '#include "spf/testing/anything.hpp"\n'
        self.assert_caught(PURE, text, 1, "does not depend on testing")
        (self.root / PURE).unlink()
        self.assert_passes("spf/math/probe_test.cpp", text)

    def test_include_relative_to_the_folder_is_caught(self):
        self.assert_caught(PURE, '#include "angles.hpp"\n', 1, "root of the repository")

    def test_include_of_no_room_is_caught(self):
        self.assert_caught(PURE, '#include "spf/cellar/wine.hpp"\n', 1, "in no room")

    def test_circle_is_caught(self):
        found = self.breaches_of("spf/math/CMakeLists.txt", "spf_room(math DEPENDS Eigen3::Eigen spf::world)\n")
        self.assertTrue(any("a circle" in breach for breach in found), found)

    def test_foreign_library_in_the_core_is_caught(self):
        self.assert_caught("spf/math/CMakeLists.txt",
                           "spf_room(math\n  DEPENDS Eigen3::Eigen yaml-cpp # for files\n  TEST_DEPENDS spf::testing)\n", 1,
                           "yaml-cpp")

    def test_core_room_may_not_use_a_host(self):
        (self.root / "host").mkdir()
        (self.root / "host/CMakeLists.txt").write_text("spf_room(host DEPENDS spf::math)\n", encoding="utf-8")
        self.assert_caught("spf/robot/CMakeLists.txt", "spf_room(robot DEPENDS spf::math spf::host)\n", 1, "no core room")


    def test_threads_belong_to_one_room(self):
        for name in ("parallel", "sim"):
            (self.root / name).mkdir()
            (self.root / name / "CMakeLists.txt").write_text(f"spf_room({name} DEPENDS spf::math)\n", encoding="utf-8")
        text = "#include <thread>\n"
        self.assert_caught("sim/probe.cpp", text, 1, "room parallel alone")
        (self.root / "sim/probe.cpp").unlink()
        self.assert_passes("sim/probe_test.cpp", text)
        self.assert_passes("parallel/probe.cpp", text)


class Purity(Copy):
    def test_breaches_are_caught(self):
        for text, line, words in [
            ("#include <iostream>\n", 1, "printing"),
            ("#include <fstream>\n", 1, "files"),
            ("#include <mutex>\n", 1, "single-threaded"),
            ("#include <thread>\n", 1, "single-threaded"),
            ("#include <filesystem>\n", 1, "files"),
            ("#include <chrono>\n", 1, "time is an argument"),
            ("#include <ros/ros.h>\n", 1, "Eigen and the standard library"),
            ("#include <yaml-cpp/yaml.h>\n", 1, "Eigen and the standard library"),
            ("\ndouble now() { return f(std::chrono::steady_clock::now()); }\n", 2, "clock"),
            ('#include "ros/node.hpp"\n', 1, "root of the repository"),
            ("double now() { return system_clock::now(); }\n", 1, "clock"),
            ("int draw() { return rand(); }\n", 1, "randomness"),
            ("int draw() {\n  std::random_device source;\n  return f(source);\n}\n", 2, "randomness"),
            ("int count() {\n  static int calls = 0;\n  return ++calls;\n}\n", 2, "static"),
            ("int count() {\n  static std::vector<double> seen;\n  return f(seen);\n}\n", 2, "static"),
            ("class A {\n  static int count_;\n};\n", 2, "static"),
            ("int count() {\n  thread_local int calls{};\n  return ++calls;\n}\n", 2, "hidden state"),
            ("namespace {\ndouble counter = 0.0;\n}\n", 2, "global"),
            ("namespace {\nstd::vector<double> cache;\n}\n", 2, "global"),
            ("inline int level{3};\n", 1, "global"),
            ("void f() { std::cout << 1; }\n", 1, "prints"),
        ]:
            with self.subTest(text=text):
                self.assert_caught(PURE, text, line, words)

    def test_lookalikes_pass(self):
        for text in [
            "// system_clock, rand(), static int x = 0; and ros/ in a comment\n",
            "/* #include <iostream>\n   std::random_device */\n",
            'constexpr const char* kText = "rand() ros/";\n',
            'constexpr const char* kRaw = R"(static int x = 1;\nsteady_clock)";\n',
            "static double helper(double x) { return x; }\n",
            "class A {\n  static constexpr int kMax = 16;\n  [[nodiscard]] static A make(int x = 3);\n};\n",
            "void f() { static const double table[3] = {1.0, 2.0, 3.0}; }\n",
            "double f(int x) { return static_cast<double>(x); }\nstatic_assert(sizeof(int) == 4);\n",
            "double operand(double x);\ndouble y() { return stream.rand(); }\n",
            "inline constexpr double kPi = 3.14;\nconst int kCount = 1'000'000;\nclass Forward;\nenum class E { a };\n",
            "using Vector = Eigen::Vector2d;\nstruct Plain {\n  double x = 0.0;\n};\nextern template class A<int>;\n",
            "Trajectory Trajectory::standing(double x,\n                                double y) {\n  return {};\n}\n",
        ]:
            with self.subTest(text=text):
                self.assert_passes(PURE, text)

    def test_tests_and_hosts_are_free(self):
        text = "#pragma once\n#include <chrono>\n#include <IpTNLP.hpp>\nstatic int calls = 0;\n"
        for file in ["spf/math/probe_test.cpp", "spf/math/oracle_test.hpp", "spf/math/test/probe.hpp",
                     "spf/testing/probe.cpp"]:
            with self.subTest(file=file):
                self.assert_passes(file, text)

    def test_header_needs_pragma_once(self):
        self.assert_caught("spf/math/probe.hpp", "double f();\n", 1, "pragma once")


if __name__ == "__main__":
    unittest.main()
