#!/usr/bin/env python3
"""program_pages_test.py PROGRAM: the man page and the completion hold every verb and option of the help, and work."""
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from program_pages import FormError, help_of, sections_of, write_pages

PROGRAM = sys.argv.pop() if len(sys.argv) > 1 else "spf"


class Pages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        write_pages(PROGRAM, cls.folder.name)
        cls.verbs = re.findall(r"^  ([a-z]+) {2,}", help_of(PROGRAM).split("Subcommands:")[1].split("\n\n")[0], re.MULTILINE)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def completed(self, *words):
        script = f'source {self.folder.name}/spf; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _spf; printf "%s\\n" "${{COMPREPLY[@]}}"'
        run = subprocess.run(["bash", "-c", script, "_", *words], capture_output=True, text=True, check=True)
        return run.stdout.split()

    def test_every_option_of_every_verb_is_in_both(self):
        man = (Path(self.folder.name) / "spf.1").read_text(encoding="utf-8").replace("\\", "")
        self.assertGreaterEqual(len(self.verbs), 6)
        for verb in self.verbs:
            options = re.findall(r"^  (?:-\w,)?(--[\w-]+)", help_of(PROGRAM, verb), re.MULTILINE)
            self.assertIn("--help", options)
            self.assertCountEqual(self.completed("spf", verb, "-"), options)
            section = man.split(f".SH {verb.upper()}\n")[1].split("\n.SH ")[0]
            for option in options:
                self.assertRegex(section, rf"\.B .*{option}\b")

    def test_verbs_options_and_files_are_completed(self):
        self.assertEqual(self.completed("spf", "exp"), ["experiment"])
        self.assertEqual(self.completed("spf", "run", "--tri"), ["--trials"])
        self.assertEqual(self.completed("spf", "run", self.folder.name + "/spf."), [self.folder.name + "/spf.1"])
        self.assertEqual(self.completed("spf", "run", "--seed", self.folder.name + "/spf."), [])

    def test_the_page_is_good_roff(self):
        try:
            run = subprocess.run(["man", "--warnings", "-l", self.folder.name + "/spf.1"], capture_output=True, text=True,
                                 env={"LC_ALL": "C.UTF-8", "MANWIDTH": "100", "PATH": "/usr/bin:/bin"}, check=False)
        except FileNotFoundError:
            self.skipTest("man is not installed")
        self.assertEqual((run.stderr, run.returncode), ("", 0))
        self.assertIn("--trials", run.stdout.replace("\b-", ""))

    def test_help_of_another_form_is_refused(self):
        with self.assertRaises(FormError):
            sections_of("Options:\n -x  something\n")


if __name__ == "__main__":
    unittest.main()
