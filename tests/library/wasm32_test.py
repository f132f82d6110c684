"""The engine's floors compile for a browser, without exceptions and run-time types, ask the system
for nothing that a page cannot give, and give the same bits there as here."""

import glob
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE = os.environ["SWIRL_SOURCE"]
LIBRARIES = os.environ["SWIRL_LIBRARIES"]
DOOR = os.path.join(SOURCE, "tests", "library", "door.cpp")
INCLUDES = [f"-I{SOURCE}/include", f"-I{SOURCE}/examples"]

# Whatever the C library would ask of the system is refused (52 is its ENOSYS).
NODE = """
const asked = new Set();
const refuse = new Proxy({}, {get: (_, name) => (...words) => { asked.add(name); return 52; }});
const bytes = require("fs").readFileSync(process.argv[1]);
WebAssembly.instantiate(bytes, {wasi_snapshot_preview1: refuse}).then(({instance}) => {
    const door = instance.exports;
    door._initialize();
    const hex = (bits) => BigInt.asUintN(64, bits).toString(16).padStart(16, "0");
    for (const discs of [1, 28, 50])
        console.log(discs, hex(door.state_hash(discs, 5000)), hex(door.rotation_bits(discs, 5000)));
    if (asked.size) console.log("asked for", [...asked].join(", "));
});
"""


def engine_sources():
    for floor in ("math", "physics", "simulation", "measure"):
        for source in sorted(glob.glob(f"{SOURCE}/src/{floor}/**/*.cpp", recursive=True)):
            if not source.endswith(("_avx2.cpp", "_avx512.cpp")):
                yield source


class Wasm32(unittest.TestCase):
    def test_compiles_and_gives_the_same_bits(self):
        if not shutil.which("clang++-19") or not shutil.which("node"):
            print("skipped: this test needs clang-19 with wasi-libc, and nodejs")
            sys.exit(77)
        with tempfile.TemporaryDirectory() as folder:
            wasm, native = os.path.join(folder, "door.wasm"), os.path.join(folder, "door")
            subprocess.run(["clang++-19", "--target=wasm32-wasi", "-mexec-model=reactor",
                            "-std=c++20", "-O1", "-ffp-contract=off", "-fno-exceptions",
                            "-fno-rtti", "-Wall", "-Wextra", "-Werror", *INCLUDES, DOOR,
                            *engine_sources(), "-o", wasm], check=True)
            subprocess.run(["g++", "-std=c++20", "-O1", "-ffp-contract=off", *INCLUDES, DOOR,
                            os.path.join(LIBRARIES, "libswirl_measure.a"),
                            os.path.join(LIBRARIES, "libswirl_simulation.a"), "-o", native],
                           check=True)
            here = subprocess.run([native], check=True, capture_output=True, text=True).stdout
            there = subprocess.run(["node", "-e", NODE, wasm], check=True, capture_output=True,
                                   text=True).stdout
            self.assertEqual(len(here.splitlines()), 3)
            self.assertEqual(there, here)


if __name__ == "__main__":
    unittest.main()
