"""tracks.camera.json, the calibration next to tracks: every field is required, once, with its
type."""

import json
import math
import unittest

from program import InFolder, swirl

FRAMES, PERIOD, SCALE = 80, 64, 20.0
CAMERA = {
    "camera-fps": 60.0,
    "scale": SCALE,
    "omega": 2.0 * math.pi * 60.0 / PERIOD,
    "centre": [100.0, 90.0],
    "phase": 30.0,
    "amplitude": 1.9,
    "container-radius": 4.0,
    "clockwise": False,
}


class CameraFile(InFolder):
    def setUp(self):
        super().setUp()
        # Two discs at rest relative to the container.
        with open(self.path("tracks.csv"), "w", encoding="utf-8") as table:
            table.write("frame,particle,x,y\n")
            for frame in range(FRAMES):
                angle = math.radians(30.0) + 2.0 * math.pi * frame / PERIOD
                for disc, offset in enumerate((-1.5, 1.5)):
                    x = 100.0 + SCALE * (1.9 * math.cos(angle) + offset)
                    y = 90.0 - SCALE * 1.9 * math.sin(angle)
                    table.write(f"{frame},{disc},{x!r},{y!r}\n")

    def measured(self, camera, *more):
        text = camera if isinstance(camera, str) else json.dumps({"camera": camera})
        with open(self.path("tracks.camera.json"), "w", encoding="utf-8") as file:
            file.write(text)
        # These discs never touch the wall, which --max-invalid 1 permits.
        return swirl(
            "measure", self.path("tracks.csv"), "--max-invalid", 1, "--quiet", "--json", "-", *more
        )

    def rejected(self, camera, *words, more=()):
        done = self.measured(camera, *more)
        self.assertEqual(done.returncode, 1, done.stdout)
        for word in ("tracks.camera.json", *words):
            self.assertIn(word, done.stderr)

    def test_valid_file_is_read(self):
        done = self.measured(CAMERA)
        self.assertEqual(done.returncode, 0, done.stderr)
        # The phase changes the result, so the checks below matter.
        self.assertNotEqual(done.stdout, self.measured({**CAMERA, "phase": 31.0}).stdout)

    def test_fields_of_another_type_are_rejected(self):
        wrong = {
            "clockwise": (1, 0, None, "false", []),
            "centre": (
                None,
                100.0,
                [],
                [100.0],
                [100.0, 90.0, 0.0],
                ["100", 90.0],
                [None, 90.0],
                {"x": 100.0, "y": 90.0},
            ),
        }
        for name in ("camera-fps", "scale", "omega", "phase", "amplitude", "container-radius"):
            wrong[name] = (None, True, "1.0", [1.0], {})
        for name, values in wrong.items():
            for value in values:
                with self.subTest(name=name, value=value):
                    self.rejected({**CAMERA, name: value}, f"{name} is ", "must be")
        # Rejected even if an option overrides the field.
        self.rejected({**CAMERA, "phase": None}, "phase is null", more=("--phase", 30))

    def test_fields_out_of_range_are_rejected(self):
        for name in ("camera-fps", "scale", "omega", "amplitude", "container-radius"):
            with self.subTest(name=name):
                self.rejected({**CAMERA, name: -1.0}, f"{name} is -1", "at least")

    def test_missing_and_repeated_fields_are_rejected(self):
        for name in CAMERA:
            with self.subTest(name=name):
                self.rejected(
                    {key: value for key, value in CAMERA.items() if key != name},
                    f"{name} is missing",
                )
                text = json.dumps({"camera": CAMERA})
                self.rejected(
                    text.replace(f'"{name}"', f'"{name}": 1.0, "{name}"'), f"'{name}' appears twice"
                )
        self.rejected(
            json.dumps({"camera": CAMERA})[:-1] + ', "camera": {}}', "'camera' appears twice"
        )

    def test_other_json_is_rejected(self):
        for text in ("", "{}", "[]", "null", '{"camera": []}', '{"camera": {', '{"camera": 1e999}'):
            with self.subTest(text=text):
                self.rejected(text, "is not a calibration by `swirl track`")

    def test_a_table_with_a_column_twice_is_rejected(self):
        with open(self.path("tracks.csv"), "r+", encoding="utf-8") as table:
            lines = [
                line.rstrip("\n") + (",x" if k == 0 else ",1.0") + "\n"
                for k, line in enumerate(table)
            ]
            table.seek(0)
            table.writelines(lines)
        done = self.measured(CAMERA)
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertIn("line 1: there are two columns 'x'", done.stderr)


if __name__ == "__main__":
    unittest.main()
