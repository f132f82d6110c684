"""swirl verify: every change of one entry of a result is rejected, or listed as not verifiable."""

import copy
import json

from program import ALL, ONE_ERROR, InFolder, main, read_json, some, swirl, write_text

# Entries that only the file knows. A repeated run gives all others.
OF_EVERY_RESULT = {"command", "seconds"}
OF_THE_PROGRAM = {"version", "build", "simd"}
# Elastic collisions do not depend on it: the changed file is the result of the changed run.
WITHOUT_EFFECT = {"config.contact_duration"}


def entries(value, path=()):
    """(path, value) of each number, text, null, true and false in a JSON value, and of each empty
    list."""
    if isinstance(value, (dict, list)) and value:
        for key, part in value.items() if isinstance(value, dict) else enumerate(value):
            yield from entries(part, (*path, key))
    else:
        yield path, value


def changed(value):
    if isinstance(value, bool):
        return not value
    if isinstance(value, str):
        return value + "x"
    if isinstance(value, (int, float)):
        return value + 1
    return 1


def edited(result, path, change):
    """A copy of the result in which change(container, key) has changed one entry."""
    copied = copy.deepcopy(result)
    container = copied
    for key in path[:-1]:
        container = container[key]
    change(container, path[-1])
    return copied


class Verify(InFolder):
    def verify(self, text):
        write_text(self.path("changed.json"), text)
        return swirl("verify", self.path("changed.json"))

    def listed(self, done):
        """The entries that the report lists as not verifiable."""
        line = done.stdout.splitlines()[1]
        self.assertTrue(line.startswith("not verifiable: "), line)
        return set(line.removeprefix("not verifiable: ").split(" (")[0].split(", "))

    def assert_every_change_is_noticed(self, result, unverifiable, removable, sampled):
        """Changes, removes and adds one entry at a time, of the parts `sampled` every 20th.
        `removable` ones may be absent in a result."""
        done = self.verify(json.dumps(result))
        self.assertEqual((done.returncode, self.listed(done)), (0, unverifiable), done.stderr)
        rejected = 0
        for path, value in [
            entry
            for number, entry in enumerate(entries(result))
            if ALL or entry[0][0] not in sampled or number % 20 == 0 or entry[0][-1] == "file"
        ]:
            name = ".".join(map(str, path))
            done = self.verify(
                json.dumps(
                    edited(
                        result,
                        path,
                        lambda container, key: container.__setitem__(key, changed(value)),
                    )
                )
            )
            if name in unverifiable | OF_THE_PROGRAM and name != "seconds":
                self.assertEqual(done.returncode, 0, (name, done.stderr))
                self.assertIn(name, self.listed(done))
            elif name not in WITHOUT_EFFECT:
                self.assertEqual(done.returncode, 1, (name, done.stdout))
                self.assertRegex(done.stderr, ONE_ERROR)
                rejected += 1
            done = self.verify(
                json.dumps(edited(result, path, lambda container, key: container.pop(key)))
            )
            self.assertEqual(done.returncode, 0 if name in removable else 1, (name, done.stdout))
        for path in some(sorted({path[:-1] for path, value in entries(result)}, key=len), 10):
            done = self.verify(
                json.dumps(
                    edited(
                        result,
                        (*path, "more"),
                        lambda container, key: container.append(1)
                        if isinstance(container, list)
                        else container.__setitem__(key, 1),
                    )
                )
            )
            self.assertEqual(done.returncode, 1, (path, done.stdout))
        return rejected

    def test_every_change_of_a_result_is_noticed(self):
        write_text(self.path("a.toml"), "discs = 6\nseed = 2\n")
        self.assert_works(
            "run",
            self.path("a.toml"),
            "--periods",
            4,
            "--warmup",
            1,
            "--measure",
            "slip",
            "--series",
            self.path("s.csv"),
            "--json",
            self.path("r.json"),
            "--quiet",
        )
        result = read_json(self.path("r.json"))
        self.assertTrue(result["warnings"])
        # The averages of a series and of a measurement have many entries, which one comparison
        # covers.
        rejected = self.assert_every_change_is_noticed(
            result,
            OF_EVERY_RESULT | {"config_text", "series.file"},
            {"series.file"},
            ("series", "measured"),
        )
        self.assertGreater(rejected, 70)
        # An entry that is a list or an object, as a whole.
        for name in result:
            with self.subTest(name=name):
                done = self.verify(
                    json.dumps(edited(result, (name,), lambda all, key: all.pop(key)))
                )
                # Without `measured`, the columns of the series differ.
                self.assertEqual(done.returncode, 0 if name == "series" else 1, done.stdout)
        twice = json.dumps(result).replace('"warnings": ', '"warnings": [], "warnings": ', 1)
        done = self.verify(twice)
        self.assertEqual(done.returncode, 1)
        self.assertIn("holds 'warnings' twice", done.stderr)

    def test_every_change_of_a_result_of_a_sweep_is_noticed(self):
        self.assert_works(
            "sweep",
            "--discs",
            "6",
            "--mu",
            "0,1",
            "--periods",
            4,
            "--warmup",
            1,
            "--series",
            "--out",
            self.path("study"),
            "--quiet",
        )
        result = read_json(self.path("study/results/000001.json"))
        # The test above has the entries that the result of a run has, too.
        own = {"point", "replicate"}
        checksum = {"series_checksum"}
        self.assert_every_change_is_noticed(
            result, OF_EVERY_RESULT | own, checksum, set(result) - own - checksum - OF_EVERY_RESULT
        )

    def test_deeply_nested_results_are_rejected(self):
        for entry in ("config", "format", "version", "measured", "warnings"):
            result = {"config": {}, "state_hash": "0", "complete": True, entry: "DEEP"}
            deep = "[" * 200_000 + "]" * 200_000
            done = self.verify(json.dumps(result).replace('"DEEP"', deep))
            self.assertEqual(done.returncode, 1)
            self.assertIn("is not the result of a run", done.stderr)


if __name__ == "__main__":
    main()
