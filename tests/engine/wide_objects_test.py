"""The object files for wide vectors define only the table that the program chooses at run time.

Any other shared symbol, such as an inline function that was not inlined, could be linked into code
for all processors. The program would then run AVX-512 instructions on a processor without them."""

import os
import re
import subprocess
import unittest

LIBRARIES = os.environ["SWIRL_LIBRARIES"]

# Library, member: the symbols (demangled) that it may define.
ALLOWED = {
    ("libswirl_engine.a", "event_loop_avx2.cpp.o"): ["swirl::event_loops_avx2"],
    ("libswirl_engine.a", "event_loop_avx512.cpp.o"): ["swirl::event_loops_avx512"],
    ("bench/libswirl_baselines.a", "all_pairs_search_avx2.cpp.o"): ["swirl::all_pairs_search_avx2"],
    ("bench/libswirl_baselines.a", "all_pairs_search_avx512.cpp.o"): [
        "swirl::all_pairs_search_avx512"
    ],
    ("libswirl_measure.a", "cluster_rotation_avx2.cpp.o"): ["swirl::rotation_avx2::kernel"],
    ("libswirl_measure.a", "cluster_rotation_avx512.cpp.o"): ["swirl::rotation_avx512::kernel"],
}


def shared_symbols(library):
    """The external symbols of each member of the library: {member: [symbol]}."""
    out = subprocess.run(
        ["nm", "-C", "--defined-only", "--extern-only", library],
        check=True,
        capture_output=True,
        text=True,
    ).stdout
    found, member = {}, None
    for line in out.splitlines():
        if line.endswith(":"):
            member = line[:-1]
            found[member] = []
        elif line.strip():
            found[member].append(line.split(None, 2)[2].split("(")[0])
    return found


@unittest.skipUnless(os.uname().machine == "x86_64", "wide vectors exist on x86-64 only")
class WideObjects(unittest.TestCase):
    def test_define_only_their_own_table(self):
        for (library, member), allowed in ALLOWED.items():
            with self.subTest(member=member):
                symbols = shared_symbols(os.path.join(LIBRARIES, library))
                self.assertEqual(symbols[member], allowed)

    def test_no_other_function_has_wide_instructions(self):
        """Registers of AVX and AVX-512 appear only in these objects, and in functions of which the
        compiler made several versions (their names end with .avx2 and the like)."""
        for library in sorted({library for library, _ in ALLOWED}):
            out = subprocess.run(
                ["objdump", "-d", "--no-show-raw-insn", os.path.join(LIBRARIES, library)],
                check=True,
                capture_output=True,
                text=True,
            ).stdout
            member, function, wide = "", "", set()
            for line in out.splitlines():
                if ".o:" in line:
                    member = line.split(":")[0]
                elif line.endswith(">:"):
                    function = line.split("<", 1)[1][:-2]
                elif "%ymm" in line or "%zmm" in line:
                    wide.add((member, function))
            self.assertTrue(wide, "the wide objects must have wide instructions")
            unexpected = [
                (m, f) for m, f in wide if "_avx" not in m and not re.search(r"\.(avx|arch_)\w*", f)
            ]
            self.assertEqual(unexpected, [])


if __name__ == "__main__":
    unittest.main()
