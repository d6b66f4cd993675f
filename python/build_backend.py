"""Builds the wheel of the Python package by CMake, for pip (PEP 517). It needs nothing of Python but its library.

`pip install .` calls it. It builds in build/wheel, so that a second call is quick; --config-settings built=FOLDER takes the
package of a build tree as it is, and other settings go to CMake (--config-settings KEY=VALUE as -D KEY=VALUE).
"""
import base64
import hashlib
import re
import subprocess
import sys
import sysconfig
import tarfile
import tempfile
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
CMAKE_PROJECT = re.compile(r"^project\(\w+ VERSION ([0-9.]+)", re.MULTILINE)


def version():
    return CMAKE_PROJECT.search((ROOT / "CMakeLists.txt").read_text(encoding="utf-8")).group(1)


def get_requires_for_build_wheel(config_settings=None):
    return []


get_requires_for_build_sdist = get_requires_for_build_wheel


def metadata():
    return "\n".join(["Metadata-Version: 2.1", "Name: spf", f"Version: {version()}",
                      "Summary: Safety probability field and extended-state MPC planner for robot fleets",
                      "Requires-Python: >=3.9", "Requires-Dist: numpy", ""])


def tag():
    """Of a module that runs with this very Python alone."""
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    platform = re.sub(r"[-.]", "_", sysconfig.get_platform())
    return f"{python}-{python}-{platform}"


def build(settings):
    """The build tree, with the package built."""
    tree = ROOT / "build" / "wheel"
    options = [f"-D{key}={value}" for key, value in settings.items()]
    subprocess.run(["cmake", "-S", ROOT, "-B", tree, "-G", "Ninja", "-D", "CMAKE_BUILD_TYPE=Release",
                    "-D", "CMAKE_CXX_FLAGS_RELEASE=-O2 -DNDEBUG", "-D", "SPF_BUILD_TESTS=OFF", "-D", "SPF_BUILD_PYTHON=ON",
                    "-D", f"Python_EXECUTABLE={sys.executable}", *options], check=True)
    subprocess.run(["cmake", "--build", tree, "--target", "spf_python"], check=True)
    return tree


def package_files(settings):
    """Of the installed package, by their paths in the wheel."""
    settings = dict(settings or {})
    tree = settings.pop("built", None) or build(settings)
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(["cmake", "--install", tree, "--component", "python", "--prefix", folder], check=True)
        top = next(Path(folder).rglob("spf/__init__.py")).parent.parent
        return {str(path.relative_to(top)): path.read_bytes() for path in sorted(top.rglob("*")) if path.is_file()}


def record_line(name, content):
    digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
    return f"{name},sha256={digest},{len(content)}"


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    info = f"spf-{version()}.dist-info"
    name = f"spf-{version()}-{tag()}.whl"
    files = package_files(config_settings)
    files[f"{info}/METADATA"] = metadata().encode()
    files[f"{info}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: spf\nRoot-Is-Purelib: false\nTag: {tag()}\n".encode()
    files[f"{info}/LICENSE"] = (ROOT / "LICENSE").read_bytes()
    record = [record_line(path, content) for path, content in files.items()] + [f"{info}/RECORD,,", ""]
    files[f"{info}/RECORD"] = "\n".join(record).encode()
    with zipfile.ZipFile(Path(wheel_directory, name), "w", zipfile.ZIP_DEFLATED) as wheel:
        for path, content in files.items():
            wheel.writestr(path, content)
    return name


def build_sdist(sdist_directory, config_settings=None):
    """The repository's files, as git knows them."""
    listed = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, check=True, capture_output=True).stdout
    base = f"spf-{version()}"
    with tarfile.open(Path(sdist_directory, f"{base}.tar.gz"), "w:gz") as archive:
        for path in filter(None, listed.decode().split("\0")):
            archive.add(ROOT / path, f"{base}/{path}", recursive=False)
        with tempfile.NamedTemporaryFile("w") as info:
            info.write(metadata())
            info.flush()
            archive.add(info.name, f"{base}/PKG-INFO")
    return f"{base}.tar.gz"
