"""Builds a wheel of the Python module with CMake: a build backend for pip (PEP 517).

    pip install .                       builds in build/wheel-… and installs
    pip wheel . --config-settings=build-dir=build/release
                                        uses the build in that folder

The wheel works on this machine only: it is linked to the system's libraries (HDF5, fmt).
"""

import base64
import hashlib
import os
import re
import subprocess
import sys
import sysconfig
import zipfile

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
# A fixed date, so that equal files give equal wheels.
DATE = (2020, 1, 1, 0, 0, 0)


def get_requires_for_build_wheel(config_settings=None):
    return []


def build_sdist(sdist_directory, config_settings=None):
    raise NotImplementedError("there is no source distribution.\nhint: use git archive HEAD.")


def _version():
    with open(os.path.join(ROOT, "CMakeLists.txt"), encoding="utf-8") as file:
        return re.search(r"project\(swirl VERSION ([0-9.]+)", file.read())[1]


def _built(settings):
    """Builds the module and returns the folder of the package."""
    folder = settings.get("build-dir")
    if folder is None:
        folder = os.path.join(ROOT, "build", f"wheel-{sys.implementation.cache_tag}")
        subprocess.run(["cmake", "-S", ROOT, "-B", folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                        "-DSWIRL_TESTS=OFF", f"-DPython_EXECUTABLE={sys.executable}"], check=True)
    subprocess.run(["cmake", "--build", folder, "--target", "swirl_python"], check=True)
    return os.path.join(folder, "python", "swirl")


def _metadata():
    with open(os.path.join(ROOT, "README.md"), encoding="utf-8") as file:
        readme = file.read()
    return ("Metadata-Version: 2.1\nName: swirl\n"
            f"Version: {_version()}\nSummary: A laboratory for swirled granular matter\n"
            "License: MIT\nRequires-Python: >=3.9\nRequires-Dist: numpy\n"
            "Provides-Extra: tables\nRequires-Dist: pandas; extra == 'tables'\n"
            "Requires-Dist: xarray; extra == 'tables'\n"
            "Provides-Extra: plots\nRequires-Dist: matplotlib; extra == 'plots'\n"
            f"Description-Content-Type: text/markdown\n\n{readme}")


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    package = _built(config_settings or {})
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    platform = sysconfig.get_platform().replace("-", "_").replace(".", "_")
    tag, folder = f"{python}-{python}-{platform}", f"swirl-{_version()}.dist-info"
    files = {}
    for name in sorted(os.listdir(package)):
        if name.endswith((".py", ".pyi", ".typed", sysconfig.get_config_var("EXT_SUFFIX"))):
            with open(os.path.join(package, name), "rb") as file:
                files[f"swirl/{name}"] = file.read()
    with open(os.path.join(ROOT, "LICENSE"), "rb") as file:
        files[f"{folder}/LICENSE"] = file.read()
    files[f"{folder}/METADATA"] = _metadata().encode()
    files[f"{folder}/WHEEL"] = ("Wheel-Version: 1.0\nGenerator: swirl\nRoot-Is-Purelib: false\n"
                                f"Tag: {tag}\n").encode()
    record = "".join(
        f"{name},sha256={base64.urlsafe_b64encode(hashlib.sha256(content).digest()).decode().rstrip('=')},"
        f"{len(content)}\n" for name, content in files.items())
    files[f"{folder}/RECORD"] = (record + f"{folder}/RECORD,,\n").encode()
    wheel = f"swirl-{_version()}-{tag}.whl"
    with zipfile.ZipFile(os.path.join(wheel_directory, wheel), "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            entry = zipfile.ZipInfo(name, DATE)
            entry.compress_type, entry.external_attr = zipfile.ZIP_DEFLATED, 0o644 << 16
            archive.writestr(entry, content)
    return wheel
