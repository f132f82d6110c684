"""Copies the libraries that a wheel needs into it (auditwheel), and the licence text of each part.

    repair.py WHEEL FOLDER        writes the repaired wheel into FOLDER

CMAKE_PREFIX_PATH is the prefix of build_cairo.sh and build_hdf5.sh. The other texts are those of
the packages of Debian, or of Fedora, that are installed here.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile

PREFIX = pathlib.Path(os.environ["CMAKE_PREFIX_PATH"])
# Libraries that are compiled into the module and the program: their packages on Debian and on
# Fedora.
HEADERS = {
    "nlohmann-json3-dev": "json-devel",
    "libcli11-dev": "cli11-devel",
    "libtomlplusplus-dev": "tomlplusplus-devel",
    "pybind11-dev": "pybind11-devel",
}
ON_DEBIAN = shutil.which("dpkg-query") is not None


def output(*words):
    return subprocess.run(
        [str(word) for word in words], capture_output=True, text=True, check=True
    ).stdout


def repaired(wheel, folder):
    environment = dict(os.environ, LD_LIBRARY_PATH=str(PREFIX / "lib"))
    subprocess.run(
        ["auditwheel", "repair", "--wheel-dir", str(folder), str(wheel)],
        check=True,
        env=environment,
    )
    (file,) = pathlib.Path(folder).glob("*.whl")
    return file


def package_of(library):
    """The package with this library ("libfmt.so.9"); None if it was built in the prefix."""
    if (PREFIX / "lib" / library).exists():
        return None
    line = next(
        line
        for line in output("/sbin/ldconfig", "-p").splitlines()
        if line.split()[:1] == [library]
    )
    file = os.path.realpath(line.split()[-1])
    if not ON_DEBIAN:
        return output("rpm", "-qf", "--queryformat", "%{NAME}", file)
    # A package of Debian may list /lib instead of /usr/lib.
    found = subprocess.run(
        ["dpkg-query", "-S", file, file.removeprefix("/usr")], capture_output=True, text=True
    ).stdout
    return found.partition(":")[0]


def texts_of(package):
    if ON_DEBIAN:
        return [f"/usr/share/doc/{package}/copyright"]
    return output("rpm", "-q", "--licensefiles", package).split()


def main(wheel, folder):
    wheel = pathlib.Path(wheel)
    with tempfile.TemporaryDirectory() as temporary:
        first = repaired(wheel, pathlib.Path(temporary, "first"))
        with zipfile.ZipFile(first) as archive:
            # "swirl.libs/libfmt-1a2b3c4d.so.9.1.0"; the file's own name has no more than the main
            # version.
            libraries = [
                re.sub(r"-[0-9a-f]{8}(?=\.so)", "", name.partition("/")[2])
                for name in archive.namelist()
                if re.match(r"[^/]+\.libs/.*\.so", name)
            ]
        packages = {
            package_of(
                name if (PREFIX / "lib" / name).exists() else re.sub(r"(\.so\.\d+).*", r"\1", name)
            )
            for name in libraries
        }
        packages |= set(HEADERS if ON_DEBIAN else HEADERS.values())
        texts = {package: texts_of(package) for package in packages - {None}}
        texts |= {part.name: sorted(part.glob("*")) for part in PREFIX.glob("share/licenses/*")}
        complete = pathlib.Path(temporary, wheel.name)
        shutil.copy(wheel, complete)
        with zipfile.ZipFile(complete, "a", zipfile.ZIP_DEFLATED) as archive:
            info = next(name for name in archive.namelist() if name.endswith(".dist-info/METADATA"))
            for name, files in sorted(texts.items()):
                for file in files:
                    archive.write(
                        file, f"{os.path.dirname(info)}/licenses/{name}/{os.path.basename(file)}"
                    )
        # This writes the list of files again. The folder may have wheels of other Pythons.
        second = repaired(complete, pathlib.Path(temporary, "second"))
        os.makedirs(folder, exist_ok=True)
        print(shutil.move(second, os.path.join(folder, second.name)))


if __name__ == "__main__":
    main(*sys.argv[1:])
