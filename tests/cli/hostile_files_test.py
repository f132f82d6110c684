"""Malicious files: recordings with impossible values, datasets whose size is not what they declare,
crashes inside the HDF5 library, pipes without a reader and endless devices. Each call ends with an
error."""

import json
import os
import re
import shutil
import signal
import struct
import subprocess
import unittest

from program import (
    HANG,
    SWIRL,
    InFolder,
    read_bytes,
    read_json,
    read_text,
    swirl,
    wait_until,
    write_text,
)

DISCS = [
    "run",
    "--discs",
    "4",
    "--periods",
    "3",
    "--frames-per-period",
    "5",
    "--warmup",
    "1",
    "--quiet",
]
# HDF5 1.14 itself rejects what 1.10 opens.
WRONG_SHAPE = re.compile("does not match its shape|cannot be read as a dataset")
SPHERES = [*DISCS, "--body", "sphere", "--floor", "sliding"]


class HostileFiles(InFolder):
    def recorded(self, *run):
        """A trajectory, an event log and a result."""
        self.assert_works(
            *run,
            "--trajectory",
            self.path("t.h5"),
            "--log-events",
            self.path("e.h5"),
            "--json",
            self.path("r.json"),
        )

    def edited(self, name, code):
        """A copy of a recording, changed by Python code in which `f` is the open file."""
        copy = self.path("edited.h5")
        shutil.copyfile(self.path(name), copy)
        self.edit_hdf5(copy, code)
        return copy

    def expect_error(self, saying, *call):
        done = swirl(*call, timeout=HANG)
        self.assertEqual(done.returncode, 1, (call, done.stdout, done.stderr))
        self.assertRegex(
            done.stderr, saying if isinstance(saying, re.Pattern) else re.escape(saying), call
        )
        return done

    # --- impossible values ----------------------------------------------------------------------

    def test_impossible_values_in_a_recording_are_rejected(self):
        self.recorded(*DISCS)
        commands = (
            ["measure"],
            ["export", "--format", "csv", "--out", self.path("o.csv")],
            ["image", "--size", "64x64", "--out", self.path("o.svg")],
        )
        edits = [
            (f"particles['radius'][3] = {value}", "radius of disc 3")
            for value in ("inf", "nan", "0", "-1", "1e308", "9")
        ]
        edits += [
            (f"particles['mass'][1] = {value}", "mass of disc 1") for value in ("0", "nan", "inf")
        ]
        edits += [("particles['moment_of_inertia'][0] = nan", "moment of inertia of disc 0")]
        edits += [
            (f"f['parameters'].attrs['container_radius'] = {value}", "container radius")
            for value in ("nan", "0.0", "-8.6", "1e308")
        ]
        edits += [
            (f"f['parameters'].attrs['period'] = {value}", "period") for value in ("nan", "0.0")
        ]
        edits += [
            (f"particles['position/value'][7, 2, 0] = {value}", "position of disc 2")
            for value in ("nan", "inf", "-1e300")
        ]
        edits += [
            ("particles['velocity/value'][7, 2, 1] = inf", "velocity of disc 2"),
            ("particles['angular_velocity/value'][7, 0] = nan", "spin of disc 0"),
            ("f['observables/clock/value'][7] = 1e9", "clock"),
            ("f['observables/container_x/value'][7] = inf", "the container reaches as far as inf"),
        ]
        for number, (edit, saying) in enumerate(edits):
            file = self.edited("t.h5", edit)
            # All commands share one check, so each edit is tried with one command.
            verb, *more = commands[number % 3]
            self.expect_error(
                saying, verb, file, *(more if number % 9 != 2 else [*more, "--start", "1.4"])
            )
        self.assert_works("measure", self.path("t.h5"), "--quiet")

    def test_a_recording_of_impossible_motion_is_rejected(self):
        commands = (["measure"], ["export", "--format", "csv", "--out", self.path("o.csv")])
        edits = (
            (
                "clock = f['observables/clock/value']; clock[...] = clock[()][::-1]",
                "is before that of frame",
            ),
            ("f['observables/swirls/value'][9:] = 0", "is before that of frame"),
            ("f['observables/events/value'][9] = 0", "is before that of frame 8"),
            ("p = particles['position/value']; p[...] = p[()][:, :1]", "discs 0 and 1 overlap"),
            ("p = particles['position/value']; p[7, 2] = p[7, 3] + 1", "discs 2 and 3 overlap"),
            ("particles['position/value'][7, 1, 0] += 20", "disc 1 is outside of the container"),
            ("particles['radius'][...] = 4", "outside of the container"),
        )
        for run in (DISCS, [*SPHERES, "--overwrite"]):
            self.recorded(*run)
            for number, (edit, saying) in enumerate(edits):
                verb, *more = commands[number % 2]
                self.expect_error(saying, verb, self.edited("t.h5", edit), *more)

    def test_every_reader_rejects_a_recording_of_overlapping_bodies(self):
        self.recorded(*DISCS)
        file = self.edited("t.h5", "p = particles['position/value']; p[...] = p[()][:, :1]")
        for verb, *more in (
            ["measure"],
            ["export", "--format", "csv"],
            ["image", "--out", self.path("o.svg")],
            ["movie", "--out", self.path("o.mp4")],
        ):
            with self.subTest(verb):
                self.expect_error("discs 0 and 1 overlap", verb, file, *more)
        self.assertFalse(os.path.exists(self.path("o.svg")) or os.path.exists(self.path("o.mp4")))

    def test_impossible_values_in_a_dump_are_rejected(self):
        for column, value in (("radius", "0"), ("mass", "-1"), ("x", "1e300")):
            row = {"id": "1", "x": "0", "y": "0", "radius": "1", "mass": "1", column: value}
            with open(self.path("d.dump"), "w") as dump:
                for step in range(2):
                    dump.write(
                        f"ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF ATOMS\n1\n"
                        f"ITEM: ATOMS {' '.join(row)}\n{' '.join(row.values())}\n"
                    )
            done = swirl(
                "measure", self.path("d.dump"), "--omega", 1, "--container-radius", 8, timeout=HANG
            )
            self.assertEqual(done.returncode, 1, (column, done.stdout, done.stderr))

    def test_an_impossible_initial_state_of_an_event_log_is_rejected(self):
        self.recorded(*DISCS)
        file = self.edited("e.h5", "f['initial/radius'][2] = nan")
        self.expect_error("radius of disc 2", "verify", file)

    # --- the HDF5 library -----------------------------------------------------------------------

    def forged(self, name, before, after):
        """A copy in which the first occurrence of `before` is replaced by `after`."""
        content = read_bytes(self.path(name))
        self.assertIn(before, content)
        with open(self.path("forged.h5"), "wb") as opened:
            opened.write(content.replace(before, after, 1))
        return self.path("forged.h5")

    def test_a_dataset_larger_than_the_file_is_rejected_before_allocation(self):
        self.recorded(*DISCS)
        # The shape 4 × 2 of /initial/position, and as many rows as make 4 GB.
        file = self.forged("e.h5", struct.pack("<QQ", 4, 2), struct.pack("<QQ", 1 << 28, 2))
        self.expect_error(WRONG_SHAPE, "verify", file)

    def test_a_compact_dataset_smaller_than_its_shape_is_rejected(self):
        self.recorded(*DISCS)
        copy = self.edited(
            "t.h5",
            """
del particles['mass']
create = h5py.h5p.create(h5py.h5p.DATASET_CREATE)
create.set_layout(h5py.h5d.COMPACT)
space = h5py.h5s.create_simple((57,))
made = h5py.h5d.create(particles.id, b'mass', h5py.h5t.IEEE_F64LE, space, create)
made.write(h5py.h5s.ALL, h5py.h5s.ALL, np.ones(57))""",
        )
        os.rename(copy, self.path("compact.h5"))
        file = self.forged("compact.h5", struct.pack("<QQ", 57, 57), struct.pack("<QQ", 5000, 5000))
        for verb in (["verify"], ["measure"]):
            self.expect_error(WRONG_SHAPE, *verb, file)

    @unittest.skipUnless(shutil.which("cc"), "no C compiler")
    def test_a_crash_inside_the_library_becomes_an_error(self):
        self.recorded(*DISCS)
        write_text(
            self.path("crash.c"),
            "#include <signal.h>\nint H5Dread(void) { raise(SIGSEGV); return -1; }\n",
        )
        shim = self.path("crash.so")
        subprocess.run(["cc", "-shared", "-fPIC", "-o", shim, self.path("crash.c")], check=True)
        for call in (
            ["export", self.path("t.h5"), "--format", "csv", "--out", self.path("o.csv")],
            ["measure", self.path("t.h5")],
            ["verify", self.path("t.h5")],
            ["verify", self.path("e.h5")],
            ["image", self.path("t.h5"), "--out", self.path("o.svg")],
        ):
            done = swirl(*call, environment={"LD_PRELOAD": shim})
            if "Segmentation" not in done.stderr and done.returncode == 0:
                self.skipTest("the library is linked in, and no shim comes before it")
            self.assertEqual(done.returncode, 1, (call, done.stderr))
            self.assertIn("reading it crashes the HDF5 library (Segmentation fault)", done.stderr)
        self.assertFalse(os.path.exists(self.path("o.csv")))

    # --- endless files --------------------------------------------------------------------------

    def polls(self, pid):
        """Whether a process waits in poll(), as it does for the reader of a pipe."""
        waits_in = read_text(f"/proc/{pid}/wchan")
        if read_text("/proc/self/wchan") == waits_in == "":
            self.skipTest("the kernel does not report where a process waits")
        return "poll" in waits_in

    def test_writing_to_a_pipe_without_a_reader_ends_at_a_signal(self):
        os.mkfifo(self.path("pipe"))
        call = [
            SWIRL,
            "run",
            "--discs",
            "4",
            "--events",
            "2000",
            "--quiet",
            "--json",
            self.path("pipe"),
        ]
        for signal_sent in (signal.SIGTERM, signal.SIGINT):
            started = subprocess.Popen(call, stderr=subprocess.PIPE, text=True)
            wait_until(lambda: self.polls(started.pid), started)
            started.send_signal(signal_sent)
            _, errors = started.communicate(timeout=HANG)
            self.assertEqual(started.returncode, 130)
            self.assertIn("waiting for a reader", errors)
        started = subprocess.Popen(call, stderr=subprocess.PIPE, text=True)
        self.assertEqual(read_json(self.path("pipe"))["events"]["total"], 2000)
        started.communicate(timeout=HANG)
        self.assertEqual(started.returncode, 0)

    def test_an_endless_configuration_is_rejected(self):
        self.assert_fails(2, "run", "/dev/zero", timeout=HANG, says="longer than 1048576 bytes")

    # --- verify ---------------------------------------------------------------------------------

    def test_verify_rejects_changed_step_and_time(self):
        self.recorded(*DISCS)
        for edit in (
            "del f['observables/clock/step']",
            "del f['observables/clock/time']",
            "del f['observables/clock/time']; f['observables/clock/time'] = np.zeros(16)",
            "del f['observables/events/step']; f['observables/events/step'] = np.arange(16) + 1",
            "del f['observables/clock/time']; "
            "f['observables/clock/time'] = h5py.ExternalLink('other.h5', '/time')",
            "del f['observables/swirls/step']; "
            "f['observables/swirls/step'] = h5py.ExternalLink('other.h5', '/step')",
            "del particles['angle/time']; particles['angle/time'] = np.arange(17) * 0.2",
        ):
            done = swirl("verify", self.edited("t.h5", edit))
            self.assertEqual(done.returncode, 1, (edit, done.stdout))
            self.assertRegex(done.stderr, "/(step|time)", edit)

    def test_verify_rejects_a_missing_or_changed_floor(self):
        self.recorded(*DISCS)
        self.expect_error(
            "/floor",
            "verify",
            self.edited(
                "e.h5",
                "f['floor/velocity'] = np.zeros((30, 2)); f['floor'].attrs['deceleration'] = 1.0",
            ),
        )
        self.recorded(*SPHERES, "--overwrite")
        for attribute, value in (("floor", 0), ("lie_flat", 1)):
            self.expect_error(
                "differs from frame 0",
                "verify",
                self.edited("t.h5", f"f['parameters'].attrs['{attribute}'] = {value}"),
            )
        self.assert_works("verify", self.path("e.h5"))
        for edit in (
            "del f['floor']",
            "del f['floor/velocity']",
            "v = f['floor/velocity'][()]; v[29, 1] = -v[29, 1]; f['floor/velocity'][()] = v",
            "v = f['floor/velocity'][()]; del f['floor/velocity']; "
            "f['floor/velocity'] = np.vstack([v, v[:1]])",
            "v = f['floor/velocity'][()]; del f['floor/velocity']; "
            "f['floor/velocity'] = v.reshape(-1)",
        ):
            self.expect_error("floor", "verify", self.edited("e.h5", edit))

    def test_verify_detects_every_change_of_a_recording(self):
        self.recorded(*DISCS)
        of_trajectory = [
            ("radius of disc 3 is nan", "particles['radius'][3] = nan"),
            ("container radius is 0", "f['parameters'].attrs['container_radius'] = 0.0"),
            ("period is 0", "f['parameters'].attrs['period'] = 0.0"),
            ("differ in length", "particles['velocity/value'].resize(5, axis=0)"),
            *(
                (
                    "must have one value per frame",
                    "rows = len(particles['position/step']); del particles['position/step']; "
                    f"particles['position/step'] = np.zeros((rows, {columns}), 'i8')",
                )
                for columns in (0, 2)
            ),
            *(
                ("differs from", change)
                for change in (
                    "particles['mass'][3] *= 2",
                    "f['observables/events/value'][7] += 1",
                    "f['observables/container_x/value'][7] += 1e-9",
                    "cut(particles, 0); cut(f['observables'], 0)",
                    *(
                        f"particles['{name}'][2] += 1"
                        for name in ("id", "particle", "species", "xyz")
                    ),
                    "particles['position/value'][7, 3, 2] = 1.0",
                    "particles['velocity/value'][7, 3, 2] = 1.0",
                    "particles['position/step'][7] += 1",
                    "particles['position/time'][7] += 1",
                )
            ),
        ]
        of_log = [
            ("radius of disc 0 is nan", "f['initial/radius'][0] = nan"),
            ("differ in length", "f['events/normal_impulse'].resize(5, axis=0)"),
            ("event 7 is damaged", "f['events/sticks'][7] = 2"),
            *of_trajectory[1:3],
            *(("differs from", f"cut(f['events'], {part})") for part in (0, 0.25)),
        ]
        cut = """
def cut(group, part):
    def shorten(name, x):
        if isinstance(x, h5py.Dataset) and x.maxshape and x.maxshape[0] is None:
            x.resize(int(x.shape[0] * part), axis=0)
    group.visititems(shorten)
"""
        for name, changes in (("t.h5", of_trajectory), ("e.h5", of_log)):
            for says, change in changes:
                with self.subTest(change):
                    self.expect_error(says, "verify", self.edited(name, cut + change))

    def test_verify_names_every_text_that_it_cannot_compare(self):
        self.recorded(*DISCS)
        of_the_call = {"command", "config", "run"}
        for file, unverifiable in (("t.h5", of_the_call), ("e.h5", of_the_call | {"frames"})):
            for name in ("command", "config", "run", "frames"):
                if name == "frames" and name not in unverifiable:
                    continue
                edit = f"del f['parameters/{name}']; f['parameters/{name}'] = np.bytes_('changed')"
                for path in (self.path(file), self.edited(file, edit)):
                    done = self.assert_works("verify", path)
                    listed = done.stdout.split("not verifiable: ")[1].strip().split(", ")
                    self.assertEqual(set(listed) - {"build"}, unverifiable)
        # The frames confirm a text that says nothing else.
        self.assert_works(
            "verify",
            self.edited(
                "t.h5",
                "del f['parameters/frames']; f['parameters/frames'] = "
                'np.bytes_(\'{"by":1,"per_swirl":5}\')',
            ),
        )

    def test_verify_rejects_surplus_rows(self):
        self.recorded(*DISCS)
        for name, edit in (
            (
                "t.h5",
                "for s in ('step', 'time'):\n    rows = f['observables/clock/' + s][()]\n"
                "    del f['observables/clock/' + s]\n"
                "    f['observables/clock/' + s] = np.append(rows, rows[-1])",
            ),
            ("t.h5", "v = f['observables/clock/value']; v.resize((v.shape[0] + 1,))"),
            ("e.h5", "v = f['events/clock']; v.resize((v.shape[0] + 1,))"),
            (
                "e.h5",
                "v = f['initial/radius'][()]; del f['initial/radius']; "
                "f['initial/radius'] = np.append(v, 1.0)",
            ),
        ):
            self.expect_error("edited.h5", "verify", self.edited(name, edit))

    def test_verify_reports_which_measurements_were_compared(self):
        self.recorded(*DISCS, "--measure", "slip,profile")
        done = swirl("verify", self.path("r.json"))
        self.assertIn("measured slip, profile", done.stdout)
        result = read_json(self.path("r.json"))
        del result["measured"]
        write_text(self.path("r.json"), json.dumps(result))
        done = self.assert_works("verify", self.path("r.json"))
        self.assertIn("no measurements in the file", done.stdout)


if __name__ == "__main__":
    unittest.main()
