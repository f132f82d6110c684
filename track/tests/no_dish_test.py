"""Videos without a dish: `swirl track` says so, and does not measure.

no_dish_test.py            three kinds of them
no_dish_test.py --all      all six
"""

import subprocess

import numpy
from program import ONE_ERROR, InFolder, main, some, swirl

WIDE, HIGH, FRAMES = 320, 240, 60
X, Y = numpy.meshgrid(numpy.arange(WIDE, dtype=float), numpy.arange(HIGH, dtype=float))


def disc(x, y, radius, soft=1.0):
    """1 within a circle, 0 outside, and a soft edge."""
    return numpy.clip((radius - numpy.hypot(X - x, Y - y)) / soft + 0.5, 0.0, 1.0)


def text_page(k, rng):
    """Lines of letters, scrolling upwards."""
    letters = numpy.random.default_rng(1).uniform(size=(60, 80)) < 0.45
    lines = numpy.kron(letters, numpy.ones((6, 4)))
    lines[numpy.arange(len(lines)) % 12 >= 8] = 0
    shown = lines[k // 2 : k // 2 + HIGH, :WIDE]
    return 235.0 - 200.0 * shown


def faces(k, rng):
    """Two ovals with eyes and mouths that nod."""
    image = 90.0 + 0.2 * X
    for x, y, turn in ((100, 120, 0.17), (220, 110, 0.23)):
        x, y = x + 6 * numpy.sin(turn * k), y + 4 * numpy.cos(0.7 * turn * k)
        oval = numpy.clip(1.5 - numpy.hypot((X - x) / 42, (Y - y) / 56), 0.0, 0.5) * 2
        image = image * (1 - oval) + oval * 190
        for eye in (-16, 16):
            image = image * (1 - disc(x + eye, y - 14, 6)) + 40 * disc(x + eye, y - 14, 6)
        mouth = (numpy.abs(X - x) < 16) & (numpy.abs(Y - y - 24) < 3)
        image[mouth] = 80
    return image


def street(k, rng):
    """A road with cars that pass, under a sky."""
    image = numpy.where(Y < 90, 200 - 0.5 * Y, 110 + 0.2 * (Y - 90))
    for row, speed, level in ((130, 5.0, 40), (170, -7.0, 220), (205, 9.0, 140)):
        x = (speed * k + 3 * row) % (WIDE + 120) - 60
        image[(numpy.abs(X - x) < 34) & (numpy.abs(Y - row) < 12)] = level
        for wheel in (-20, 20):
            image *= 1 - 0.9 * disc(x + wheel, row + 12, 7)
    return image


def noise(k, rng):
    return rng.uniform(0.0, 255.0, size=(HIGH, WIDE))


def bars(k, rng):
    """Bars that move to the right."""
    return 128 + 90 * numpy.sign(numpy.sin(2 * numpy.pi * (X - 3 * k) / 50))


def wheel(k, rng):
    """A wheel with spokes that turns about its fixed hub."""
    far = numpy.hypot(X - 160, Y - 120)
    angle = numpy.arctan2(Y - 120, X - 160) - 0.21 * k
    spokes = (numpy.abs(numpy.sin(4 * angle)) < 6 / numpy.maximum(far, 1)) & (far < 90)
    rim = numpy.abs(far - 92) < 6
    return numpy.where(rim | spokes | (far < 12), 50.0, 190.0)


CLIPS = (wheel, text_page, noise, bars, street, faces)


def write(path, clip):
    rng = numpy.random.default_rng(5)
    call = f"ffmpeg -v error -y -f rawvideo -pix_fmt gray -s {WIDE}x{HIGH} -r 30 -i -".split()
    writer = subprocess.Popen(
        [*call, "-pix_fmt", "yuv420p", "-crf", "20", path], stdin=subprocess.PIPE
    )
    for k in range(FRAMES):
        image = clip(k, rng) + 2.0 * rng.normal(size=(HIGH, WIDE))
        writer.stdin.write(numpy.clip(image + 0.5, 0, 255).astype(numpy.uint8).tobytes())
    writer.stdin.close()
    assert writer.wait() == 0


class NoDish(InFolder):
    def test_a_video_of_something_else_is_rejected(self):
        for clip in some(CLIPS, 3):
            with self.subTest(clip=clip.__name__):
                video = self.path(f"{clip.__name__}.mp4")
                write(video, clip)
                done = swirl("track", video, "--out", self.path("tracks.csv"), "--quiet")
                if "no camera support" in done.stderr:
                    self.skipTest("this build has no camera support")
                self.assertEqual(done.returncode, 1, done.stderr)
                self.assertRegex(done.stderr, ONE_ERROR)
                self.assertIn("no dish was found", done.stderr)


if __name__ == "__main__":
    main()
