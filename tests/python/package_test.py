"""Types, documentation, command and Debian package of the Python package."""

import inspect
import json
import os
import re
import shutil
import subprocess
import sys
import tomllib

import pytest

import swirl
from scenes import SOURCE, SWIRL

PACKAGE = os.path.dirname(swirl.__file__)


@pytest.fixture(scope="module")
def cache(tmp_path_factory):
    """Cache of mypy, which takes a minute to read numpy."""
    return os.environ.get("MYPY_CACHE_DIR") or str(tmp_path_factory.mktemp("mypy"))


def test_types_are_consistent(cache):
    """mypy --strict accepts the package. Packages without types, other than numpy, are ignored."""
    done = subprocess.run(
        [
            "/usr/bin/mypy",
            "--strict",
            "--ignore-missing-imports",
            "--cache-dir",
            cache,
            "-p",
            "swirl",
        ],
        cwd=os.path.dirname(PACKAGE),
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stdout


def test_mypy_infers_types_of_results(tmp_path, cache):
    (tmp_path / "use.py").write_text(
        "import swirl\nr = swirl.run(discs=48)\n"
        "reveal_type(r.rotation.mean_by_time.mean)\n"
        "reveal_type(swirl.Simulation(discs=3).snapshot().position)\n"
        "r.rotation.by_tim\n"
    )
    done = subprocess.run(
        ["/usr/bin/mypy", "--strict", "--ignore-missing-imports", "--cache-dir", cache, "use.py"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        env={**os.environ, "MYPYPATH": os.path.dirname(PACKAGE)},
    )
    assert 'Revealed type is "builtins.float"' in done.stdout, done.stdout
    assert re.search(
        r"numpy\.ndarray\[.*(floating\[numpy\._typing\._64Bit\]|numpy\.float64)", done.stdout
    )
    assert '"Rotation" has no attribute "by_tim"' in done.stdout and done.stdout.count("error") <= 2


def test_everything_public_has_a_docstring():
    for name in swirl.__all__:
        thing = getattr(swirl, name)
        if inspect.isclass(thing) or inspect.isfunction(thing):
            assert inspect.getdoc(thing), name


def test_import_needs_only_numpy():
    """pandas, matplotlib and xarray are imported on demand."""
    script = (
        "import sys, swirl; print(sorted({m.split('.')[0] for m in sys.modules} & "
        "{'pandas', 'matplotlib', 'xarray', 'h5py', 'tqdm'}))"
    )
    done = subprocess.run([sys.executable, "-B", "-c", script], capture_output=True, text=True)
    assert done.stdout == "[]\n", done.stderr


def test_bindings_include_only_allowed_layers():
    folder = os.path.join(SOURCE, "bindings", "python")
    for name in os.listdir(folder):
        if name.endswith((".cpp", ".hpp")):
            with open(os.path.join(folder, name), encoding="utf-8") as file:
                for layer in re.findall(r'#include "swirl/(\w+)/', file.read()):
                    assert layer not in (
                        "cli",
                        "paper",
                        "render",
                        "tracking",
                    ), f"{name} includes {layer}"


def test_version_of_the_python_package_is_the_version_of_the_project():
    """The pattern in pyproject.toml finds the version; pip_install.py tests the rest."""
    with open(os.path.join(SOURCE, "pyproject.toml"), encoding="utf-8") as file:
        settings = tomllib.loads(file.read())
    version = settings["tool"]["scikit-build"]["metadata"]["version"]
    with open(os.path.join(SOURCE, version["input"]), encoding="utf-8") as file:
        assert re.search(version["regex"], file.read())["value"] == swirl.__version__
    with open(os.path.join(SOURCE, "CITATION.cff"), encoding="utf-8") as file:
        assert f"\nversion: {swirl.__version__}\n" in file.read()
    with open(os.path.join(SOURCE, ".zenodo.json"), encoding="utf-8") as file:
        assert json.load(file)["version"] == swirl.__version__


def run_command(arguments, folder, **environment):
    return subprocess.run(
        [sys.executable, "-B", "-m", "swirl", *arguments],
        capture_output=True,
        text=True,
        cwd=folder,
        env={**os.environ, **environment},
    )


def test_command_runs_the_program_on_the_path(tmp_path):
    program = subprocess.run([SWIRL, "--version"], capture_output=True, text=True)
    done = run_command(["--version"], tmp_path, PATH=os.path.dirname(os.path.abspath(SWIRL)))
    assert (done.returncode, done.stdout) == (0, program.stdout), done.stderr
    done = run_command(
        ["run", "--no-such-option"], tmp_path, PATH=os.path.dirname(os.path.abspath(SWIRL))
    )
    assert done.returncode == 2 and "--no-such-option" in done.stderr


def test_command_without_program_is_an_error(tmp_path):
    done = run_command(["--version"], tmp_path, PATH=str(tmp_path))
    assert done.returncode == 1
    assert done.stderr.startswith("error: ") and "\nhint: " in done.stderr


@pytest.mark.skipif(not shutil.which("dpkg-shlibdeps"), reason="dpkg-dev is not installed")
def test_debian_package_can_be_built(tmp_path):
    build = os.path.dirname(os.path.dirname(PACKAGE))
    done = subprocess.run(
        ["cpack", "-G", "DEB", "-D", "CPACK_COMPONENTS_ALL=python", "-B", tmp_path],
        cwd=build,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    (package,) = tmp_path.glob("python3-swirl_*.deb")
    needed = subprocess.run(
        ["dpkg-deb", "--field", package, "Depends"], capture_output=True, text=True
    )
    python = "python3 (>= 3.{0}), python3 (<< 3.{1})".format(
        *(sys.version_info[1] + k for k in (0, 1))
    )
    for name in (python, "python3-numpy", "libhdf5", "libfmt", "libstdc++6"):
        assert name in needed.stdout
    subprocess.run(["dpkg-deb", "-x", package, tmp_path / "there"], check=True)
    folder = tmp_path / "there" / "usr" / "lib" / "python3" / "dist-packages"
    used = subprocess.run(
        [sys.executable, "-B", "-c", "import swirl; print(swirl.__file__)"],
        capture_output=True,
        text=True,
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(folder)},
    )
    assert used.stdout.startswith(str(folder)), used.stderr


def test_links_of_the_documentation_exist():
    with open(os.path.join(SOURCE, "docs", "tutorials", "python.md"), encoding="utf-8") as file:
        for link in re.findall(r"\]\(([^)#]+)[^)]*\)", file.read()):
            assert os.path.exists(os.path.join(SOURCE, "docs", "tutorials", link)), link
