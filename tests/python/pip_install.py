"""Source distribution and `pip install` with build isolation in a new virtual environment. Needs PyPI.

The environment is created without pip; Debian's pip installs into it (`pip --python`)."""

import os
import subprocess
import sys
import tarfile

import pytest

from scenes import SOURCE, result_of

PACKAGE = ("swirl/__init__.py", "swirl/py.typed", "swirl/_engine.pyi", "swirl/__main__.py")


def output_of(*words, **more):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, **more)
    assert done.returncode == 0, f"{words}: {done.stdout}{done.stderr}"
    return done.stdout


@pytest.fixture(scope="module")
def environment(tmp_path_factory):
    """A virtual environment with the package `build`."""
    folder = tmp_path_factory.mktemp("environment")
    output_of(sys.executable, "-m", "venv", "--without-pip", folder)
    done = subprocess.run([sys.executable, "-m", "pip", "--python", folder / "bin" / "python", "install",
                           "build"], capture_output=True, text=True)
    if done.returncode:
        pytest.skip("PyPI cannot be reached")
    return folder


@pytest.fixture(scope="module")
def sdist(environment):
    output_of(environment / "bin" / "python", "-m", "build", "--sdist", "--outdir", environment, SOURCE)
    (file,) = environment.glob("swirl-*.tar.gz")
    return file


def test_sdist_contains_the_sources_and_no_build(sdist):
    with tarfile.open(sdist) as archive:
        names = {name.partition("/")[2] for name in archive.getnames()}
        top = sdist.name[:-len(".tar.gz")]
        metadata = archive.extractfile(f"{top}/PKG-INFO").read().decode()
    tracked = set(output_of("git", "-C", SOURCE, "ls-files").split("\n")) - {""}
    hidden = {name for name in tracked if name.startswith((".ci/", ".github/"))}
    assert tracked - hidden <= names, sorted(tracked - hidden - names)
    assert not {name for name in names if name.startswith(("build/", "out/", ".git/", ".github/"))}
    for line in ("Name: swirl", "License", "Requires-Python: >=3.9", "Requires-Dist: numpy",
                 "Provides-Extra: plots", "Provides-Extra: tables", "Classifier: ", "Keywords: ",
                 "Project-URL: ", "Description-Content-Type: text/markdown"):
        assert line in metadata, line


def test_pip_installs_the_sdist(environment, sdist, tmp_path):
    python = environment / "bin" / "python"
    output_of(sys.executable, "-m", "pip", "--python", python, "install", sdist)
    installed = output_of(python, "-c", "import swirl; print(swirl.__path__[0])", cwd=tmp_path).strip()
    assert installed.startswith(str(environment))
    for name in PACKAGE:
        assert os.path.exists(os.path.join(os.path.dirname(installed), name)), name
    packages = output_of(sys.executable, "-m", "pip", "--python", python, "list", "--format", "freeze")
    assert {line.partition("==")[0] for line in packages.split()} >= {"numpy", "swirl"}
    assert "matplotlib" not in packages and "pandas" not in packages

    # Module, command of the environment, and program built here give the same state.
    scene = dict(discs=5, events=1000)
    expected = result_of(scene)["state_hash"]
    assert output_of(python, "-c", f"import swirl; print(swirl.run(**{scene}).state_hash)",
                     cwd=tmp_path).strip() == expected
    command = environment / "bin" / "swirl"
    assert f'"{expected}"' in output_of(command, "run", "--discs", 5, "--events", 1000, "--quiet", "--json",
                                        "-", cwd=tmp_path)
    checked = output_of(python, os.path.join(SOURCE, "packaging", "test_installation.py"), cwd=tmp_path)
    assert "expected state hashes" in checked

    # Figures are drawn by this environment's Python, which has no matplotlib.
    done = subprocess.run([command, "paper", "--figure", "5b", "--quick", "--events", "2000"],
                          capture_output=True, text=True, cwd=tmp_path)
    assert done.returncode == 1 and "the figures need matplotlib" in done.stdout
    assert (tmp_path / "out" / "figure_5b.csv").exists()
