#!/usr/bin/env python3
"""check_blocks_test.py PROGRAM: check_blocks.py catches each kind of error that it is there for."""
import sys
import unittest

from check_blocks import ROOT, Commands, Sources, blocks_of, scenario_problems

PROGRAM = sys.argv.pop() if len(sys.argv) > 1 else "spf"


class Catches(unittest.TestCase):
    def test_a_line_that_is_in_no_source_or_not_in_the_named_one(self):
        sources = Sources(ROOT)
        line = "double ProbabilityField::density(const Eigen::Vector2d& position_world) const {\n"
        self.assertEqual(sources.problems("spf/field/probability_field.cpp", line), [])
        self.assertTrue(sources.problems("spf/trajectory/minco.cpp", line))
        self.assertTrue(sources.problems(None, line.replace("density", "intensity")))
        self.assertTrue(sources.problems("spf/nothing.cpp", line))

    def test_a_script_a_verb_an_option_a_method_a_file_that_are_not_there(self):
        commands = Commands(PROGRAM)
        for good in ("script/test --all", "spf run scenarios/t2.yaml --trials 50 --method orca", "spf check scenarios/*.yaml"):
            self.assertEqual(commands.problems(good), [], good)
        for bad in (f"script/{'tset'}", "spf runs scenarios/t2.yaml", "spf run scenarios/t2.yaml --trails 50",
                    "spf run scenarios/t2.yaml --method orcas", f"spf run scenarios/{'t3'}.yaml"):
            self.assertEqual(len(commands.problems(bad)), 1, bad)

    def test_a_scenario_or_a_part_of_one_with_a_wrong_key_or_value(self):
        self.assertEqual(scenario_problems(PROGRAM, "people:\n  - {waypoints: [[0, 0], [4, 0]], speed: 1}\n"), [])
        self.assertTrue(scenario_problems(PROGRAM, "people:\n  - {waypoints: [[0, 0], [4, 0]], sped: 1}\n"))
        self.assertTrue(scenario_problems(PROGRAM, "family: explicit\nrobots: [{start: [0, 0], goal: [1e9, 0]}]\n"))

    def test_it_finds_the_blocks_of_a_page(self):
        named = {name for name, language, _ in blocks_of(ROOT / "docs" / "paper_walk.md") if language == "cpp"}
        self.assertIn("spf/planning/costs/field_cost.cpp", named)
        self.assertNotIn(None, named)
        kinds = [language for _, language, _ in blocks_of(ROOT / "docs" / "scenarios.md")]
        self.assertGreaterEqual(kinds.count("yaml"), 6)


if __name__ == "__main__":
    unittest.main()
