"""Videos of a swirled dish by a renderer that shares no code with `swirl synthetic-video`.

Particles move as in a recording of `swirl run`. A pinhole camera sees spheres or flat coins, a floor
and a wall of some height in front of a table; every pixel is a ray, so perspective and tilt are
exact. A hand that wanders moves the dish as a whole: the inertia of the particles neglects it.

    other_scenes.make(folder, name)    writes NAME.mp4, NAME.truth.csv and NAME.truth.json, which
                                       have the columns and names of those of synthetic-video

Lengths are in particle radii; the plane of the centres is z = 0, and the floor is at z = -1.
"""

import json
import math
import os
import subprocess

import cv2
import h5py
import numpy

from program import HANG, swirl

RATIO = 8.6  # container radius
SHADES = 4  # instants of an exposure
USUAL = {
    "discs": 36,
    "per_period": 24,  # frames
    "periods": 4,
    "seed": 11,
    "size": (640, 480),
    "scale": 19.0,  # pixels per radius at the middle of the image
    "distance": 60.0,  # of the camera
    "tilt": 0.0,  # degrees
    "aim": (0.0, 0.0),  # what the camera aims at
    "held": 0.0,  # shake of a camera that a hand holds
    "wander": 0.0,  # of the hand that swirls
    "exposure": 0.15,  # of the frame interval
    "colours": ((60, 150, 235),),  # blue, green, red
    "floor": (45, 45, 48),
    "rim": (190, 185, 180),
    "table": (105, 120, 130),
    "look": "ball",  # ball, glass or coin
    "gain": 0.0,  # amplitude of the auto-exposure
    "rotated": False,
    "noise": 2.5,
    "crf": 23,
    "reason": None,  # what a true refusal may say, a pattern
}
SCENES = {
    "two colours": {"colours": ((200, 80, 30), (40, 140, 250)), "floor": (110, 112, 115)},
    "rim 15 % outside": {"aim": (5.9, 0.0), "reason": "outside|leaves"},
    "wandering hand": {"discs": 32, "per_period": 13, "periods": 8, "wander": 0.35, "scale": 17.0},
    "camera held above": {"held": 0.12, "scale": 17.0},
    "inclined, near": {"tilt": 14.0, "distance": 34.0, "scale": 17.0, "reason": "inclin|tilt"},
    "motion blur": {"discs": 28, "per_period": 15, "periods": 6, "exposure": 0.9, "reason": "blur"},
    "glass": {"discs": 30, "look": "glass", "floor": (120, 118, 112)},
    "coins": {
        "discs": 38,
        "look": "coin",
        "colours": ((90, 130, 175), (175, 180, 180)),
        "floor": (60, 75, 50),
    },
    "five balls": {"discs": 5, "periods": 6},
    "three balls": {"discs": 3, "periods": 6},
    "52 balls": {"discs": 52},
    "portrait": {"size": (480, 640), "scale": 17.0, "rotated": True},
    "auto-exposure": {"gain": 0.25},
}


def motion(folder, s):
    """Centres of the container and of the particles, and angles, SHADES for each frame."""
    path = os.path.join(folder, "motion.h5")
    call = ["--discs", s["discs"], "--seed", s["seed"], "--container-radius", RATIO]
    call += ["--motion", "circle", "--warmup", 10, "--periods", 11 + s["periods"]]
    call += ["--frames-per-period", SHADES * s["per_period"], "--trajectory", path]
    done = swirl("run", *call, "--quiet", "--overwrite", timeout=HANG)
    if done.returncode != 0:
        raise RuntimeError(done.stderr)
    with h5py.File(path) as file:
        there = file["particles/trajectory"]
        path = [file[f"observables/container_{a}/value"][()] for a in "xy"]
        first = len(path[0]) - SHADES * s["per_period"] * s["periods"]
        # Images have y down.
        p = there["position/value"][first:, :, :2] * (1, -1)
        c = numpy.stack(path, 1)[first:] * (1, -1)
        return c - c.mean(0), p - c.mean(0), -there["angle/value"][first:]


class Camera:
    """Rays of all pixels, and the projection of points."""

    def __init__(self, s, shift=(0.0, 0.0), turn=0.0):
        t = math.radians(s["tilt"])
        forward = numpy.array([0.0, math.sin(t), -math.cos(t)])
        right = numpy.array([math.cos(turn), math.sin(turn), 0.0])
        down = numpy.cross(right, forward) * -1.0
        down /= numpy.linalg.norm(down)
        right = numpy.cross(down, forward) * -1.0
        self.axes = numpy.stack([right, down if down[1] > 0 else -down, forward])
        aim = numpy.array([*numpy.add(s["aim"], shift), 0.0])
        self.eye = aim - s["distance"] * forward
        self.focal = s["scale"] * s["distance"]
        self.middle = (numpy.array(s["size"]) - 1) / 2
        x, y = numpy.meshgrid(*(numpy.arange(n, dtype=numpy.float32) for n in s["size"]))
        u, v = (x - self.middle[0]) / self.focal, (y - self.middle[1]) / self.focal
        rays = u[..., None] * self.axes[0] + v[..., None] * self.axes[1] + self.axes[2]
        self.rays = rays / numpy.linalg.norm(rays, axis=-1, keepdims=True)
        self.planes = {z: self.plane(z).astype(numpy.float32) for z in (-1.3, -1.0, 0.0, 0.5)}
        self.table = None

    def project(self, points):
        seen = (points - self.eye) @ self.axes.T
        return self.middle + self.focal * seen[:, :2] / seen[:, 2:]

    def plane(self, z):
        """Where the rays meet a horizontal plane: x and y."""
        t = (z - self.eye[2]) / self.rays[..., 2]
        return self.eye[:2] + t[..., None] * self.rays[..., :2]


class Painter:
    def __init__(self, s):
        self.s, rng = s, numpy.random.default_rng(s["seed"])
        self.wood = cv2.GaussianBlur(rng.normal(size=(900, 900)).astype(numpy.float32), (0, 0), 4)
        self.wood *= 12.0 / self.wood.std()
        for _ in range(40):  # things on the table
            x, y, a = rng.integers(0, 900), rng.integers(0, 900), rng.integers(5, 25)
            cv2.circle(self.wood, (int(x), int(y)), int(a), float(rng.normal() * 25), -1)
        self.relief = [
            cv2.GaussianBlur(rng.normal(size=(96, 96)).astype(numpy.float32), (0, 0), 4) * 120
            for _ in range(s["discs"])
        ]
        self.lamp = numpy.array([-0.45, -0.35, 1.0])
        self.lamp /= numpy.linalg.norm(self.lamp)
        colours = numpy.array(s["colours"], float)
        spread = 1.0 + 0.06 * rng.normal(size=(s["discs"], 1))
        self.colours = colours[numpy.arange(s["discs"]) % len(colours)] * spread

    def paint(self, camera, c, points, angles):
        """One instant, without noise."""
        s = self.s
        if camera.table is None:
            at = camera.planes[-1.3] * 15 + 450
            wood = cv2.remap(self.wood, at, None, cv2.INTER_LINEAR, borderMode=cv2.BORDER_WRAP)
            camera.table = numpy.array(s["table"], numpy.float32) + wood[..., None]
        image = camera.table
        floor, top = (camera.planes[z] - c.astype(numpy.float32) for z in (-1.0, 0.5))
        low, high = (numpy.hypot(p[..., 0], p[..., 1]) for p in (floor, top))
        width = s["scale"]

        def inside(far, radius):
            return numpy.clip((radius - far) * width + 0.5, 0, 1)[..., None]

        side = (top @ self.lamp[:2].astype(numpy.float32) / numpy.maximum(high, 1e-6))[..., None]
        rim, ground = (numpy.array(s[name], numpy.float32) for name in ("rim", "floor"))
        image = blend(image, inside(low, RATIO + 0.35), 0.6 * rim)
        image = blend(image, inside(high, RATIO + 0.35), (1 + 0.3 * side) * rim)
        within = inside(high, RATIO)
        image = blend(image, within, (0.55 - 0.3 * side) * rim)
        if s["look"] != "coin":
            ground = ground * self.shadows(camera, floor, points - c)
        image = blend(image, within * inside(low, RATIO), ground)
        order = numpy.argsort(-numpy.linalg.norm(points - camera.eye[:2], axis=1))
        for i in order:
            self.particle(image, camera, points[i], angles[i], i, within)
        return image

    def shadows(self, camera, floor, points):
        dark = numpy.ones(floor.shape[:2] + (1,), numpy.float32)
        offset = -self.lamp[:2] / self.lamp[2]
        for p, (x, y) in zip(points, self.centres):
            box = self.box(x, y, 2.2)
            far = numpy.hypot(*numpy.moveaxis(floor[box] - p - offset * 0.9, -1, 0))
            depth = 0.25 if self.s["look"] == "glass" else 0.45
            dark[box] *= 1 - depth * numpy.clip((1.25 - far) / 0.5, 0, 1)[..., None]
        return dark

    def box(self, x, y, reach):
        high, wide = self.s["size"][1], self.s["size"][0]
        a = reach * self.s["scale"] * 1.3
        rows = slice(int(numpy.clip(y - a, 0, high)), int(numpy.clip(y + a + 2, 0, high)))
        return rows, slice(int(numpy.clip(x - a, 0, wide)), int(numpy.clip(x + a + 2, 0, wide)))

    def particle(self, image, camera, p, angle, i, within):
        s = self.s
        box = self.box(*self.centres[i], 1.0)
        rays = camera.rays[box]
        if rays.size == 0:
            return
        if s["look"] == "coin":
            at = (camera.planes[0.0][box] - p) @ [
                [math.cos(angle), -math.sin(angle)],
                [math.sin(angle), math.cos(angle)],
            ]
            far = numpy.hypot(at[..., 0], at[..., 1])
            relief = cv2.remap(
                self.relief[i], (at * 38 + 48).astype(numpy.float32), None, cv2.INTER_LINEAR
            )
            ring = 1 + 0.25 * numpy.exp(-(((far - 0.9) / 0.05) ** 2))
            colour = ((1 + 0.02 * relief) * ring)[..., None] * self.colours[i]
        else:
            to = numpy.array([*p, 0.0]) - camera.eye
            along = rays @ to
            nearest = along[..., None] * rays - to
            far = numpy.linalg.norm(nearest, axis=-1)
            depth = numpy.sqrt(numpy.clip(1 - far**2, 0, 1))
            normal = nearest - depth[..., None] * rays
            normal /= numpy.maximum(numpy.linalg.norm(normal, axis=-1, keepdims=True), 1e-9)
            half = self.lamp - rays
            half /= numpy.linalg.norm(half, axis=-1, keepdims=True)
            gloss = 130 * numpy.clip((normal * half).sum(-1), 0, 1) ** 60
            lit = 0.45 + 0.55 * numpy.clip(normal @ self.lamp, 0, 1)
            if s["look"] == "glass":  # dark edge, and the lamp's light behind the ball
                behind = numpy.exp(-((normal[..., :2] + 0.5 * self.lamp[:2]) ** 2).sum(-1) / 0.12)
                shade = 0.35 + 0.75 * depth + 0.35 * behind
                colour = shade[..., None] * numpy.array(s["floor"]) + 1.4 * gloss[..., None]
            else:
                colour = lit[..., None] * self.colours[i] + gloss[..., None]
        cover = numpy.clip((1 - far) * s["scale"] + 0.5, 0, 1)[..., None] * within[box]
        image[box] = blend(image[box], cover, colour)


def blend(below, cover, above):
    return below * (1 - cover) + cover * above


def make(folder, name):
    """Writes the video and its truth; returns the path of the video."""
    s = {**USUAL, **SCENES[name]}
    path = os.path.join(folder, name.replace(" ", "_").replace(",", "").replace("%", "pc") + ".mp4")
    if os.path.exists(path[:-4] + ".truth.json"):
        return path
    rng = numpy.random.default_rng(s["seed"])
    c, p, angle = motion(folder, s)
    frames = s["per_period"] * s["periods"]
    t = numpy.arange(frames)
    shake = s["held"] * smooth(rng.normal(size=(frames, 3)), 4.0)
    wander = numpy.repeat(s["wander"] * smooth(rng.normal(size=(frames, 2)), 9.0), SHADES, 0)
    c, p = c + wander, p + wander[:, None]
    painter, truth = Painter(s), []
    writer = Writer(path, s)
    camera = Camera(s)
    for k in t:
        if s["held"]:
            camera = Camera(s, shake[k, :2], 0.1 * shake[k, 2])
        # An exposure is centred at the time of its frame.
        now = SHADES * k
        v = (p[min(now + 1, len(p) - 1)] - p[now]) * SHADES
        w = (c[min(now + 1, len(c) - 1)] - c[now]) * SHADES
        exposed = 0.0
        shades = numpy.linspace(-0.5, 0.5, 9 if s["exposure"] > 0.5 else 2) * s["exposure"]
        for part in shades:
            points = p[now] + part * v
            painter.centres = camera.project(numpy.c_[points, numpy.zeros(len(points))])
            exposed = exposed + painter.paint(camera, c[now] + part * w, points, angle[now])
        gain = 1 + s["gain"] * math.sin(0.13 * k) * math.sin(0.05 * k + 1)
        writer.write(exposed / len(shades) * gain, rng)
        seen = camera.project(numpy.c_[p[now], numpy.zeros(s["discs"])])
        truth.append(numpy.c_[seen, p[now]])
    writer.close()
    write_truth(path, s, numpy.array(truth), c[::SHADES], writer.turned)
    return path


def smooth(noise, sigma):
    """Noise of standard deviation 1 that is correlated over sigma frames."""
    noise = cv2.GaussianBlur(noise, (1, 0), sigmaX=1e-3, sigmaY=sigma)
    return noise / noise.std(0)


class Writer:
    def __init__(self, path, s):
        self.path, self.s = path, s
        size = s["size"][::-1] if s["rotated"] else s["size"]
        raw = ["-f", "rawvideo", "-pix_fmt", "bgr24", "-s", "%dx%d" % size, "-r", "30", "-i", "-"]
        code = ["-c:v", "libx264", "-crf", str(s["crf"]), "-pix_fmt", "yuv420p", "-threads", "1"]
        self.made = path[:-4] + ".made.mp4" if s["rotated"] else path
        self.process = subprocess.Popen(
            ["ffmpeg", "-v", "error", "-y", *raw, *code, self.made], stdin=subprocess.PIPE
        )
        self.turned = False

    def write(self, image, rng):
        image = cv2.GaussianBlur(image, (0, 0), 0.7)
        image = image + self.s["noise"] * rng.normal(size=image.shape[:2] + (1,))
        image = numpy.clip(image + 0.5, 0, 255).astype(numpy.uint8)
        if self.s["rotated"]:  # stored lying; a player turns it by 90 degrees clockwise
            image = numpy.ascontiguousarray(numpy.rot90(image))
        self.process.stdin.write(image.tobytes())

    def close(self):
        self.process.stdin.close()
        if self.process.wait() != 0:
            raise RuntimeError("ffmpeg failed")
        if self.s["rotated"]:
            call = ["-i", self.made, "-c", "copy", "-metadata:s:v:0", "rotate=90", self.path]
            subprocess.run(["ffmpeg", "-v", "error", "-y", *call], check=True)
            probe = ["-select_streams", "v", "-show_entries", "stream_side_data=rotation"]
            angle = subprocess.run(
                ["ffprobe", "-v", "error", *probe, "-of", "csv=p=0", self.path],
                capture_output=True,
                check=True,
                encoding="utf-8",
            ).stdout
            # Versions of ffmpeg differ in the direction that they write.
            self.turned = float(angle.strip().strip(",")) > 0.0
            os.unlink(self.made)


def write_truth(path, s, truth, c, turned):
    """`x_ideal` and `y_ideal` are pixels of the upright image, `x_plane` and `y_plane` radii."""
    if turned:  # upside down
        truth[:, :, :2] = numpy.array(s["size"]) - 1 - truth[:, :, :2]
    with open(path[:-4] + ".truth.csv", "w", encoding="utf-8") as file:
        file.write("frame,particle,x_ideal,y_ideal,x_plane,y_plane\n")
        for k, i in numpy.ndindex(truth.shape[:2]):
            file.write("%d,%d,%.4f,%.4f,%.6f,%.6f\n" % (k, i, *truth[k, i]))
    amplitude = float(numpy.hypot(*(c - c.mean(0)).T).mean())
    about = {
        "discs": s["discs"],
        "scale": s["scale"],
        "container_radius": RATIO * s["scale"],
        "omega": 2 * math.pi / s["per_period"],
        "amplitude": amplitude * s["scale"],
        "reason": s["reason"],
        "path": c.tolist(),
    }
    with open(path[:-4] + ".truth.json", "w", encoding="utf-8") as file:
        json.dump(about, file)
