"""Every code block of docs/python.md runs, and every name in its tables exists."""
import re

import pytest

import spf
from project import ROOT

PAGE = (ROOT / "docs" / "python.md").read_text()
BLOCKS = re.findall(r"^```python\n(.*?)^```", PAGE, re.MULTILINE | re.DOTALL)


@pytest.mark.parametrize("number", range(len(BLOCKS)))
def test_a_block_runs(number, monkeypatch):
    monkeypatch.chdir(ROOT)
    exec(compile(BLOCKS[number], f"docs/python.md, block {number + 1}", "exec"), {})


def test_there_are_blocks_and_the_classes_exist():
    assert len(BLOCKS) == 9
    rows = re.findall(r"^\| (`\w+`(?:, `\w+`)*) \|", PAGE, re.MULTILINE)
    names = [name for row in rows for name in re.findall(r"\w+", row)]
    assert len(names) > 8 and all(hasattr(spf, name) for name in names)
