"""Videos of a swirled container, made without any code of the program: spheres repelled by springs,
frames painted with numpy. Options add faults; the ground truth is returned.

    video = make("video.mp4", seed=3, floor=40, ball=200, vignette=0.4)
    video.positions, video.centre, video.amplitude, …
"""

import math
import subprocess

import numpy

USUAL = {
    # The scene, lengths in pixels.
    "size": (320, 320),
    "balls": 20,
    "radius": 14.0,
    "dish": 92.0,
    "amplitude": 26.0,
    "middle": (0.0, 0.0),  # of the container's path, relative to the image centre
    "small": 0,
    "small_radius": 0.7,
    "frames_per_period": 60,
    "frames": 84,
    "still_for": 0,
    "wander": 0.0,  # of the centre of the container's path, as a hand moves it
    "clockwise": False,
    "seed": 1,
    # Appearance, in grey levels of 255.
    "table": 110.0,
    "floor": 45.0,
    "rim": 170.0,
    "rim_width": 5.0,
    "ball": 190.0,
    "colours": None,  # of the spheres, cyclically: (red, green, blue)
    "tint": (1.0, 1.0, 1.0),
    "table_tint": (1.0, 1.0, 1.0),
    "texture": "patches",  # none, patches, dot, stripe
    "contrast": 0.35,  # of the texture
    "flat": False,  # discs, not spheres
    "gloss": 60.0,
    "shine": 20.0,
    "lamp": (-0.4, -0.3),
    "ambient": 0.45,
    "shadow": 0.0,
    "shadow_to": (0.25, 0.25),
    "shadow_soft": 2.5,
    "uneven": 0.0,
    "vignette": 0.0,
    "clutter": 0.0,
    "label": False,
    "glare": 0.0,
    "grain": 0.0,  # of the container's floor, moves with it
    # The camera.
    "noise": 2.0,
    "blur": 0.8,
    "gamma": 1.0,
    "exposure": 0.2,
    "flicker": 0.0,
    "grey": False,
    "shake": 0.0,  # of the camera, rms of a coordinate, pixels
    "sway": 0.0,  # of what is seen on the table, as of the shadows of leaves, pixels
    # The file.
    "fps": "30",
    "codec": ("libx264", "-crf", "18"),
    "pixels": "yuv420p",
    "filter": None,
    "drop": (),
    "double": (),
}


MOTION = (
    "balls",
    "radius",
    "small",
    "small_radius",
    "dish",
    "amplitude",
    "frames_per_period",
    "frames",
    "still_for",
    "wander",
    "clockwise",
    "seed",
)
FILE = ("fps", "codec", "pixels", "filter", "grey", "drop", "double")
motions = {}  # cache: videos that differ only in appearance share their motion
paintings = {}  # cache: videos that differ only in their file share their frames


class Video:
    """The ground truth of a video."""


def random_ball(rng, kind):
    """A random texture: a function from directions, an array (…, 3), to levels from −1 to 1."""
    if kind == "dot":
        axis = rng.normal(size=3)
        axis /= numpy.linalg.norm(axis)
        return lambda n: numpy.where(n @ axis > 0.85, -1.0, 0.15)
    if kind == "stripe":
        axis = rng.normal(size=3)
        axis /= numpy.linalg.norm(axis)
        return lambda n: numpy.where(numpy.abs(n @ axis) < 0.2, -1.0, 0.2)
    waves, phases = rng.normal(size=(6, 3)) * 2.5, rng.uniform(0.0, 2.0 * math.pi, 6)
    return lambda n: numpy.cos(n @ waves.T + phases).sum(axis=-1) / 3.0


def course(s, frame):
    """The container's centre relative to that of its path, y down, at a time in frames."""
    t = max(0.0, frame - s["still_for"])
    turn = 2.0 * math.pi * t / s["frames_per_period"] + 0.7
    if not s["clockwise"]:
        turn = -turn
    drift = s["wander"] * numpy.array([math.sin(0.08 * t), math.cos(0.06 * t)])
    return s["amplitude"] * numpy.array([math.cos(turn), math.sin(turn)]) + drift


def moved(s, radii, rng):
    """Positions and rotations in each frame: spring contacts, friction, drag on the floor,
    rolling."""
    n, steps = len(radii), 60
    dish = s["dish"]
    positions = []
    grid = [
        (x, y)
        for x in numpy.arange(-dish, dish, 2.05 * radii.max())
        for y in numpy.arange(-dish, dish, 2.05 * radii.max())
        if math.hypot(x, y) + radii.max() < dish
    ]
    assert len(grid) >= n, "the container is too small"
    start = rng.permutation(len(grid))[:n]
    p = numpy.array([grid[k] for k in start]) + rng.normal(size=(n, 2)) * 0.01 * radii.max()
    p = p + course(s, 0.0)
    v = numpy.zeros((n, 2))
    # Units: pixels and frames. The stiffness limits overlaps to about a hundredth of a radius.
    speed = 2.0 * math.pi * s["amplitude"] / s["frames_per_period"]
    stiff = (speed / (0.012 * radii.mean())) ** 2
    dt = 1.0 / steps
    while stiff * dt * dt > 0.03:
        dt *= 0.5
        steps *= 2
    lossy, drag = 0.25 * math.sqrt(stiff), 0.5 * 2.0 * math.pi / s["frames_per_period"]
    turned = numpy.tile(numpy.eye(3), (n, 1, 1))
    spin = numpy.zeros(n)
    rotations = []
    sums = radii[:, None] + radii[None, :]
    warm = int(s["frames_per_period"])
    for frame in range(-warm, s["frames"]):
        if frame >= 0:
            positions.append(p.copy())
            u = (course(s, frame + 0.01) - course(s, frame - 0.01)) / 0.02
            roll = v - u
            for i in range(n):
                w = numpy.array([roll[i, 1], -roll[i, 0], 0.0]) / radii[i] * 0.7
                w[2] = spin[i]
                angle = numpy.linalg.norm(w)
                if angle > 1e-9:
                    a = w / angle
                    cross = numpy.array([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]])
                    turned[i] = (
                        numpy.eye(3)
                        + math.sin(angle) * cross
                        + (1.0 - math.cos(angle)) * cross @ cross
                    ) @ turned[i]
            rotations.append(turned.copy())
        for k in range(steps):
            now = frame + k * dt if s["still_for"] == 0 else max(frame, 0.0) + k * dt
            c = course(s, now)
            u = (course(s, now + 0.01) - course(s, now - 0.01)) / 0.02
            d = p[:, None, :] - p[None, :, :]
            r = numpy.sqrt((d * d).sum(-1)) + numpy.eye(n) * 1e9
            over = numpy.maximum(0.0, sums - r)
            e = d / r[..., None]
            rel = v[:, None, :] - v[None, :, :]
            normal = (rel * e).sum(-1)
            push = numpy.where(over > 0.0, numpy.maximum(0.0, stiff * over - lossy * normal), 0.0)
            slide = rel - normal[..., None] * e
            slip = slide + (spin[:, None] * radii[:, None] + spin[None, :] * radii[None, :])[
                ..., None
            ] * numpy.stack([e[..., 1], -e[..., 0]], -1)
            rub = numpy.minimum(lossy * numpy.sqrt((slip * slip).sum(-1)), 0.3 * push)
            slip_unit = slip / (numpy.sqrt((slip * slip).sum(-1))[..., None] + 1e-9)
            force = (push[..., None] * e - rub[..., None] * slip_unit).sum(1)
            w = p - c
            far = numpy.sqrt((w * w).sum(-1)) + 1e-9
            out = w / far[:, None]
            over_wall = numpy.maximum(0.0, far + radii - dish)
            rel_wall = v - u
            normal = (rel_wall * out).sum(-1)
            press = numpy.where(
                over_wall > 0.0, numpy.maximum(0.0, stiff * over_wall + lossy * normal), 0.0
            )
            tangent = numpy.stack([-out[:, 1], out[:, 0]], -1)
            slip_wall = ((rel_wall * tangent).sum(-1)) + spin * radii
            rub_wall = numpy.clip(-lossy * slip_wall, -0.4 * press, 0.4 * press)
            force += -press[:, None] * out + rub_wall[:, None] * tangent - drag * (v - u)
            v = v + dt * force
            p = p + dt * v
            spin = spin + dt * (2.5 * rub_wall / radii - 0.5 * drag * spin)
    return positions, rotations


def blurred(image, sigma):
    if sigma <= 0.0:
        return image
    reach = int(math.ceil(3.0 * sigma))
    x = numpy.arange(-reach, reach + 1)
    kernel = numpy.exp(-0.5 * (x / sigma) ** 2)
    kernel /= kernel.sum()
    for axis in (0, 1):
        wide = numpy.pad(
            image, [(reach, reach) if a == axis else (0, 0) for a in range(image.ndim)], mode="edge"
        )
        image = sum(
            w * numpy.take(wide, range(k, k + image.shape[axis]), axis)
            for k, w in enumerate(kernel)
        )
    return image


def moved_image(image, shift):
    """The image moved right and down by a fraction of pixels, by linear interpolation."""
    height, width = image.shape[:2]
    for axis, size, by in ((1, width, shift[0]), (0, height, shift[1])):
        at = numpy.clip(numpy.arange(size) - by, 0, size - 1)
        low = numpy.minimum(at.astype(int), size - 2)
        share = (at - low).reshape((-1, 1) if axis == 1 else (-1, 1, 1))
        image = (1 - share) * numpy.take(image, low, axis) + share * numpy.take(
            image, low + 1, axis
        )
    return image


class Painter:
    def __init__(self, s, radii, rng):
        self.s, self.radii, self.rng = s, radii, rng
        width, height = s["size"]
        self.x, self.y = numpy.meshgrid(
            numpy.arange(width, dtype=float), numpy.arange(height, dtype=float)
        )
        self.table = s["table"] * numpy.ones((height, width, 3)) * numpy.array(s["table_tint"])
        if s["clutter"] > 0.0:  # bars, coins and wood grain on the table
            wood = blurred(rng.normal(size=(height, width)), 3.0)
            self.table += s["clutter"] * 2.0 * wood[..., None]
            for _ in range(14):
                cx, cy, size = rng.uniform(0, width), rng.uniform(0, height), rng.uniform(8, 30)
                level = s["clutter"] * rng.choice([-1.0, 1.0])
                if rng.uniform() < 0.5:
                    self.table[numpy.hypot(self.x - cx, self.y - cy) < size] += level
                else:
                    turn = rng.uniform(0, math.pi)
                    a = (self.x - cx) * math.cos(turn) + (self.y - cy) * math.sin(turn)
                    b = -(self.x - cx) * math.sin(turn) + (self.y - cy) * math.cos(turn)
                    self.table[(abs(a) < 2.0 * size) & (abs(b) < 0.3 * size)] += level
        self.grain = blurred(rng.normal(size=(height * 2, width * 2)), 1.5)
        self.textures = [random_ball(rng, s["texture"]) for _ in radii]
        self.light = numpy.ones((height, width))
        if s["uneven"] > 0.0:
            self.light *= 1.0 + s["uneven"] * (
                (self.x - 0.5 * width) / width + 0.6 * (self.y - 0.5 * height) / height
            )
        if s["vignette"] > 0.0:
            far = numpy.hypot(self.x - 0.5 * width, self.y - 0.5 * height) / (0.5 * width)
            self.light *= 1.0 - s["vignette"] * 0.5 * far**2
        self.lamp = numpy.array([s["lamp"][0], s["lamp"][1], 1.0])
        self.lamp /= numpy.linalg.norm(self.lamp)

    def colour(self, i):
        s = self.s
        return (
            numpy.array(s["colours"][i % len(s["colours"])], float)
            if s["colours"]
            else s["ball"] * numpy.array(s["tint"])
        )

    def paint(self, middle, positions, turned, shake):
        s = self.s
        image = moved_image(self.table, shake)
        far = numpy.hypot(self.x - middle[0], self.y - middle[1])
        inner, outer = s["dish"], s["dish"] + s["rim_width"]
        in_dish = numpy.clip(inner - far + 0.5, 0.0, 1.0)[..., None]
        in_rim = numpy.clip(outer - far + 0.5, 0.0, 1.0)[..., None]
        floor = numpy.full(self.x.shape, s["floor"])
        if s["grain"] > 0.0:
            gx = (self.x - middle[0] + self.grain.shape[1] / 2).astype(int) % self.grain.shape[1]
            gy = (self.y - middle[1] + self.grain.shape[0] / 2).astype(int) % self.grain.shape[0]
            floor = floor + s["grain"] * 5.0 * self.grain[gy, gx]
        if s["shadow"] > 0.0:
            for p, a in zip(positions, self.radii):
                q = p + a * numpy.array(s["shadow_to"])
                d = numpy.hypot(self.x - q[0], self.y - q[1])
                floor = floor * (
                    1.0
                    - s["shadow"] * numpy.clip(0.5 + (a - d) / (2.0 * s["shadow_soft"]), 0.0, 1.0)
                )
        # The wall is lit from one side.
        side = (
            (self.x - middle[0]) * self.lamp[0] + (self.y - middle[1]) * self.lamp[1]
        ) / numpy.maximum(far, 1.0)
        rim = s["rim"] * (1.0 + 0.25 * side)
        image = image * (1.0 - in_rim) + in_rim * rim[..., None]
        image = image * (1.0 - in_dish) + in_dish * floor[..., None]
        for i, p in enumerate(positions):
            self.paint_ball(image, p, self.radii[i], turned[i], i)
        return image

    def paint_ball(self, image, p, a, turned, i):
        s = self.s
        x0, x1 = max(0, int(p[0] - a - 2)), min(image.shape[1], int(p[0] + a + 3))
        y0, y1 = max(0, int(p[1] - a - 2)), min(image.shape[0], int(p[1] + a + 3))
        if x0 >= x1 or y0 >= y1:
            return
        dx, dy = (self.x[y0:y1, x0:x1] - p[0]) / a, (self.y[y0:y1, x0:x1] - p[1]) / a
        r = numpy.hypot(dx, dy)
        cover = numpy.clip((1.0 - r) * a + 0.5, 0.0, 1.0)
        shrink = numpy.where(r > 0.999, 0.999 / numpy.maximum(r, 1e-9), 1.0)
        nx, ny = dx * shrink, dy * shrink
        nz = numpy.sqrt(numpy.maximum(0.0, 1.0 - nx * nx - ny * ny))
        n = numpy.stack([nx, ny, nz], -1)
        pattern = 0.0 if s["texture"] == "none" else self.textures[i](n @ turned)
        if s["flat"]:
            lit = 1.0
        else:
            lit = s["ambient"] + (1.0 - s["ambient"]) * numpy.maximum(0.0, n @ self.lamp)
        level = (1.0 + s["contrast"] * pattern) * lit
        colour = (
            level[..., None] * self.colour(i)
            if numpy.ndim(level)
            else numpy.ones(r.shape + (1,)) * level * self.colour(i)
        )
        if not s["flat"]:
            half = self.lamp + numpy.array([0.0, 0.0, 1.0])
            half /= numpy.linalg.norm(half)
            colour = (
                colour
                + (s["gloss"] * numpy.maximum(0.0, n @ half) ** (4.0 * s["shine"]))[..., None]
            )
        c = cover[..., None]
        image[y0:y1, x0:x1] = (1.0 - c) * image[y0:y1, x0:x1] + c * colour

    def finished(self, image, frame):
        s, rng = self.s, self.rng
        image = image * self.light[..., None]
        if s["glare"] > 0.0:
            width, height = s["size"]
            gx = (0.4 + 0.2 * math.sin(0.05 * frame)) * width
            image = (
                image
                + s["glare"]
                * numpy.exp(
                    -((self.x - gx) ** 2 + (self.y - 0.42 * height) ** 2) / (0.02 * width * width)
                )[..., None]
            )
        image = blurred(image, s["blur"])
        image = image * (1.0 + s["flicker"] * rng.normal())
        image = 255.0 * numpy.clip(image / 255.0, 0.0, None) ** s["gamma"]
        image = (
            image
            + s["noise"] * rng.normal(size=image.shape[:2])[..., None]
            + 0.5 * s["noise"] * rng.normal(size=image.shape)
        )
        if s["label"]:
            height = image.shape[0]
            digits = numpy.kron(
                (numpy.arange(60) * (frame + 7) % 5 > 1).reshape(5, 12), numpy.ones((3, 6))
            )
            image[height - 20 : height - 5, 6:78] = 0.0
            image[height - 20 : height - 5, 6:78][digits > 0] = 255.0
        return numpy.clip(image + 0.5, 0.0, 255.0).astype(numpy.uint8)


def painted(s, radii):
    """The bytes of each frame, and the positions in it."""
    rng = numpy.random.default_rng((s["seed"], 1))
    motion = tuple(s[name] for name in MOTION)
    if motion not in motions:
        motions[motion] = moved(s, radii, numpy.random.default_rng(s["seed"]))
    positions, rotations = motions[motion]
    painter = Painter(s, radii, rng)
    frames = []
    for k in range(s["frames"]):
        shake = s["shake"] * rng.normal(size=2)
        between = [
            (course(s, k + o) - course(s, k), o)
            for o in (
                numpy.array([-0.33, 0.0, 0.33]) * s["exposure"] if s["exposure"] > 0 else [0.0]
            )
        ]
        sway = s["sway"] * numpy.array([math.sin(0.11 * k), math.cos(0.17 * k)])
        middle, sum_of = path_centre(s) + shake, 0.0
        for shift, o in between:
            v = positions[min(k + 1, s["frames"] - 1)] - positions[max(k - 1, 0)]
            sum_of = sum_of + painter.paint(
                middle + course(s, k) + shift,
                positions[k] + 0.5 * o * v + middle,
                rotations[k],
                shake + sway,
            )
        frames.append((painter.finished(sum_of / len(between), k).tobytes(), positions[k] + middle))
    return frames


def path_centre(s):
    return numpy.array([0.5 * (size - 1) + shift for size, shift in zip(s["size"], s["middle"])])


def make(path, **faults):
    unknown = set(faults) - set(USUAL)
    assert not unknown, unknown
    s = {**USUAL, **faults}
    radii = numpy.full(s["balls"], float(s["radius"]))
    radii[: s["small"]] *= s["small_radius"]
    look = tuple(value for name, value in s.items() if name not in FILE)
    if look not in paintings:
        paintings[look] = painted(s, radii)
    width, height = s["size"]
    command = [
        "ffmpeg",
        "-v",
        "error",
        "-y",
        "-f",
        "rawvideo",
        "-pix_fmt",
        "rgb24",
        "-s",
        f"{width}x{height}",
        "-r",
        s["fps"],
        "-i",
        "-",
    ]
    if s["filter"]:
        command += ["-vf", s["filter"]]
    command += ["-pix_fmt", "gray" if s["grey"] else s["pixels"], "-c:v", *s["codec"], str(path)]
    video = Video()
    video.settings, video.radii, video.positions = s, radii, []
    writer = subprocess.Popen(command, stdin=subprocess.PIPE)
    for k, (image, positions) in enumerate(paintings[look]):
        for _ in range(0 if k in s["drop"] else 2 if k in s["double"] else 1):
            writer.stdin.write(image)
            video.positions.append(positions)
    writer.stdin.close()
    assert writer.wait() == 0, "ffmpeg failed"
    video.centre, video.amplitude, video.container = path_centre(s), s["amplitude"], s["dish"]
    video.frames_per_period, video.clockwise = s["frames_per_period"], s["clockwise"]
    return video
