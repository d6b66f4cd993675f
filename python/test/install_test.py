"""`pip install .` without network, in an environment of its own: the installed package runs, and goes again."""
import os
import subprocess
import sys
from pathlib import Path

import spf
from project import ROOT, SCENARIOS

BUILD = Path(spf._core.__file__).parents[2]
USE = f"""
import spf
assert spf.__version__ == "{spf.__version__}" and not spf.__file__.startswith("{ROOT}/")
print(spf.Scenario.load("{SCENARIOS / 't2.yaml'}").run(3).digest)
"""


def test_pip_installs_and_removes_the_package(tmp_path):
    environment = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
    environment.update(PIP_NO_INDEX="1", PIP_DISABLE_PIP_VERSION_CHECK="1", PIP_NO_CACHE_DIR="1")
    place = tmp_path / "place"
    subprocess.run([sys.executable, "-m", "venv", "--system-site-packages", "--without-pip", place], check=True)

    def run(*arguments, status=0):
        ended = subprocess.run([place / "bin" / "python", *arguments], cwd=tmp_path, env=environment, text=True,
                               capture_output=True, check=False)
        assert ended.returncode == status, ended.stdout + ended.stderr
        return ended.stdout

    run("-m", "pip", "install", "--config-settings", f"built={BUILD}", ROOT)
    assert run("-c", USE).strip() == spf.Scenario.load(SCENARIOS / "t2.yaml").run(3).digest
    assert f"Version: {spf.__version__}" in run("-m", "pip", "show", "spf")
    run("-m", "pip", "uninstall", "-y", "spf")
    run("-c", "import spf", status=1)
