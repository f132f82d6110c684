"""An independent event-driven simulation of spheres on a floor in Python, from the
three-dimensional physics and numpy's roots of polynomials. From the same initial state it must give
the logged events of the program: kind, partners, time and impulses. Trajectories diverge
exponentially and the two programs round differently, so the tolerance is strict at first and the
comparison is short."""

import math
import os
import subprocess
import sys

from program import InFolder, main

try:
    import h5py
    import numpy as np
except ImportError:
    print(
        "skipped: this test needs numpy and h5py; Debian's packages python3-numpy and python3-h5py "
        "provide them."
    )
    sys.exit(77)

# The paper's experiment in units of r and AΩ, as docs/explanation/spheres.md derives it.
CONTAINER_RADIUS, AMPLITUDE, SIDES = 25.5 / 3, 5.75 / 3, 30
GRAVITY, RESTITUTION, CONTACT_DURATION = 6.382, 0.9, 1e-3
PERIOD = 2 * math.pi * AMPLITUDE
UP = np.array([0.0, 0.0, 1.0])
KINDS = ("pair", "wall", "vertex", "rolls")
EXAMPLE = os.path.join(
    os.path.dirname(os.path.abspath(__file__)), "..", "..", "examples", "vertical_impulses.py"
)
SIMULTANEOUS = 1e-9  # undisturbed spheres start to roll at the same time, in any order


def first_contact(apart, velocity, acceleration, reach, inside):
    """The time at which |s + v t + a t²/2| reaches `reach`, from above, or from below if
    `inside`."""
    gap = [
        acceleration @ acceleration / 4,
        velocity @ acceleration,
        velocity @ velocity + apart @ acceleration,
        2 * apart @ velocity,
        apart @ apart - reach**2,
    ]
    falls = -1 if inside else 1
    while gap and gap[0] == 0:
        gap.pop(0)
    slope = np.polyder(gap) if len(gap) > 1 else []
    # A pair that has just collided is at a root with an increasing distance.
    times = [
        t.real
        for t in np.roots(gap)
        if abs(t.imag) < 1e-9 * max(1, abs(t))
        and t.real > 1e-9
        and falls * np.polyval(slope, t.real) < 0
    ]
    return min(times, default=math.inf)


class Simulation:
    def __init__(self, start, friction, floor_friction, coins, resistance=0.0):
        self.count = len(start["mass"])
        self.inertia, self.coins = start["moment_of_inertia"][0], coins
        flat = np.zeros((self.count, 1))
        self.position = np.hstack([start["position"][:], flat])
        self.velocity = np.hstack([start["velocity"][:], flat])
        rolling = np.zeros((self.count, 2)) if coins else start["rolling_spin"][:]
        self.spin = np.hstack([rolling, start["spin"][:].reshape(-1, 1)])
        self.friction, self.deceleration = friction, floor_friction * GRAVITY
        self.torque = resistance * GRAVITY
        self.vertices = [
            AMPLITUDE
            * np.array([math.cos(2 * math.pi * k / SIDES), math.sin(2 * math.pi * k / SIDES), 0])
            for k in range(SIDES)
        ]
        self.time, self.last = 0.0, [-math.inf] * self.count
        self.begin_segment(0)

    def begin_segment(self, segment):
        self.segment = segment % SIDES
        self.centre = self.vertices[self.segment].copy()
        self.container_velocity = (self.vertices[(self.segment + 1) % SIDES] - self.centre) / (
            PERIOD / SIDES
        )
        self.rolls, self.rests = [False] * self.count, [False] * self.count
        if self.segment == 0:  # the clock restarts
            self.last = [t - self.time for t in self.last]
            self.time = 0.0

    def on_floor(self, i):
        """Acceleration, angular acceleration, and the duration of sliding or slowing down."""
        over_floor = self.velocity[i] - self.container_velocity
        if self.rests[i] or self.rolls[i] and self.torque == 0:
            return np.zeros(3), np.zeros(3), math.inf
        if self.rolls[i] and np.linalg.norm(over_floor) < 1e-13:
            return np.zeros(3), np.zeros(3), 0.0
        if self.rolls[i]:
            # The torque against ω, and the floor friction that maintains v = R ω × ẑ.
            slows = -self.torque / (1 + self.inertia) * over_floor / np.linalg.norm(over_floor)
            return slows, np.cross(UP, slows), np.linalg.norm(over_floor) / np.linalg.norm(slows)
        slip = self.velocity[i] - self.container_velocity
        if not self.coins:
            slip = slip - np.cross(self.spin[i], UP)
        speed = np.linalg.norm(slip)
        if speed < 1e-13:
            return np.zeros(3), np.zeros(3), 0.0
        force = -self.deceleration * slip / speed  # acts at the floor, −ẑ
        if self.coins:
            return force, np.zeros(3), speed / self.deceleration
        return (
            force,
            np.cross(-UP, force) / self.inertia,
            speed / (self.deceleration * (1 + 1 / self.inertia)),
        )

    def pending(self, motions):
        yield (self.segment + 1) * PERIOD / SIDES - self.time, "vertex", 0, 0
        for i, (acceleration, _, slides) in enumerate(motions):
            yield slides, "rolls", i, i
            yield first_contact(
                self.position[i] - self.centre,
                self.velocity[i] - self.container_velocity,
                acceleration,
                CONTAINER_RADIUS - 1,
                True,
            ), "wall", i, i
            for j in range(i + 1, self.count):
                yield first_contact(
                    self.position[j] - self.position[i],
                    self.velocity[j] - self.velocity[i],
                    motions[j][0] - acceleration,
                    2.0,
                    False,
                ), "pair", i, j

    def step(self, kind_of_log, i_of_log):
        """(time, kind, i, impulses) of the next event; of simultaneous events, the one in the
        log."""
        motions = [self.on_floor(i) for i in range(self.count)]
        events = sorted(self.pending(motions))
        event = next(
            (
                e
                for e in events
                if e[0] < events[0][0] + SIMULTANEOUS
                and e[1] == kind_of_log
                and (kind_of_log == "vertex" or e[2] == i_of_log)
            ),
            events[0],
        )
        wait, kind, i, j = event
        for k, (acceleration, angular_acceleration, _) in enumerate(motions):
            self.position[k] += wait * self.velocity[k] + wait**2 / 2 * acceleration
            self.velocity[k] += wait * acceleration
            self.spin[k] += wait * angular_acceleration
        self.centre = self.centre + wait * self.container_velocity
        self.time += wait
        now, impulses = self.time, np.zeros(3)
        if kind == "vertex":
            self.begin_segment(self.segment + 1)
        elif kind == "rolls":
            self.rests[i] = self.rolls[i]
            self.rolls[i] = True
        else:
            impulses = self.collide(i, None if kind == "wall" else j)
        return now, kind, i, impulses

    def collide(self, i, j):
        """Normal, tangential and vertical impulse. The floor supports a sphere that is pushed
        down."""
        normal = (
            self.position[i] - self.centre if j is None else self.position[j] - self.position[i]
        )
        normal = normal / np.linalg.norm(normal)
        other = (
            self.container_velocity
            if j is None
            else self.velocity[j] + np.cross(self.spin[j], -normal)
        )
        relative = other - self.velocity[i] - np.cross(self.spin[i], normal)
        approach, bodies = -relative @ normal, 1 if j is None else 2
        partners = [i] if j is None else [i, j]
        restitution = RESTITUTION
        if self.time - max(self.last[k] for k in partners) < CONTACT_DURATION:
            restitution = max(1.0, self.deceleration * CONTACT_DURATION / 2 / approach)
        pressed = (1 + restitution) * approach / bodies
        along = relative - relative @ normal * normal
        vertical = along @ UP * UP
        if self.coins:
            vertical, along = 0 * vertical, along - vertical
        lifted = 1 if j is not None or vertical @ UP > 0 else 0
        level_mass = 1 / (bodies * (1 + 1 / self.inertia))
        upright_mass = 1 / (lifted + bodies / self.inertia)
        whole = level_mass * (along - vertical) + upright_mass * vertical
        allowed, stick = self.friction * pressed, np.linalg.norm(whole)
        friction = -whole
        if stick > allowed:
            slip = np.linalg.norm(along)
            horizontal = np.linalg.norm(along - vertical)
            stops = slip**3 / (
                horizontal**2 / level_mass + (vertical @ vertical) / upright_mass
            )
            turned = (allowed / stick) ** 2
            friction = -(
                (1 - turned) * min(allowed, stops) * along / slip + turned * allowed * whole / stick
            )
        level = friction - friction @ UP * UP
        for k, sign in zip(partners, (-1, 1)):
            self.velocity[k] += sign * (pressed * normal + level)
            self.spin[k] += np.cross(-sign * normal, sign * friction) / self.inertia
            self.rolls[k], self.rests[k], self.last[k] = False, False, self.time
        return np.array([pressed, level @ np.array([normal[1], -normal[0], 0]), friction[2]])


class Spheres(InFolder):
    def compare(
        self, events, strict, *more, friction=0.2, floor_friction=0.3, coins=False, resistance=0.0
    ):
        log = self.path("events.h5")
        if resistance:
            more += ("--rolling-resistance", resistance)
        self.assert_works(
            "run",
            "--preset",
            "experiment-half",
            "--events",
            events,
            "--warmup",
            0,
            "--mu",
            friction,
            "--floor-friction",
            floor_friction,
            *more,
            "--log-events",
            log,
            "--quiet",
            "--overwrite",
        )
        collisions = 0
        with h5py.File(log) as file:
            simulation = Simulation(file["initial"], friction, floor_friction, coins, resistance)
            rows = {name: column[:] for name, column in file["events"].items()}
        for k in range(events):
            logged_kind = KINDS[rows["kind"][k]]
            time, kind, i, impulses = simulation.step(logged_kind, rows["i"][k])
            off = abs(time - rows["clock"][k])
            self.assertEqual(kind, logged_kind, f"event {k}")
            # Rounding errors of 10⁻¹⁵ grow by a factor of a few with every collision of two bodies.
            bound = 1e-10 if k < strict else 1e-5
            self.assertLess(min(off, abs(off - PERIOD)), bound, f"event {k}, {kind}")
            if kind != "vertex":
                self.assertEqual(i, rows["i"][k], f"event {k}")
            if kind in ("pair", "wall"):
                collisions += 1
                logged = [rows[name][k] for name in ("normal_impulse", "tangential_impulse")]
                logged.append(rows["vertical_impulse"][k] if "vertical_impulse" in rows else 0.0)
                np.testing.assert_allclose(
                    impulses, logged, rtol=0, atol=bound, err_msg=f"event {k}"
                )
        return collisions

    def test_five_spheres(self):
        self.assertGreater(self.compare(1300, 500, "--discs", 5), 40)

    def test_shells_with_high_friction(self):
        self.assertGreater(
            self.compare(400, 250, "--discs", 12, "--inertia", "shell", friction=0.5), 20
        )

    def test_rolling_resistance_that_stops_spheres(self):
        self.assertGreater(self.compare(800, 400, "--discs", 15, resistance=0.05), 20)

    def test_coins(self):
        self.assertGreater(
            self.compare(
                300,
                150,
                "--discs",
                12,
                "--body",
                "disc",
                "--inertia",
                "solid",
                floor_friction=0.03,
                coins=True,
            ),
            30,
        )

    def test_vertical_impulses_of_a_log(self):
        log = self.path("events.h5")
        self.assert_works(
            "run",
            "--preset",
            "experiment-half",
            "--discs",
            20,
            "--events",
            20000,
            "--warmup",
            0,
            "--log-events",
            log,
            "--quiet",
        )
        output = subprocess.run(
            [sys.executable, EXAMPLE, log], capture_output=True, text=True, check=True
        ).stdout
        shares = {line[:56].strip(): float(line[56:]) for line in output.splitlines()}
        with h5py.File(log) as file:
            J, kind = file["events/vertical_impulse"][:], file["events/kind"][:]
            clock, swirls = file["events/clock"][:], file["events/swirls"][:]
        time = swirls * PERIOD + clock
        weight = 20 * GRAVITY * (time[-1] - time[0])
        # In a pair one sphere is lifted and one pushed down; at the wall (kind 1), J_z acts on the
        # wall.
        pairs = np.abs(J[kind == 0]).sum()
        for name, wall in (
            ("push down", J[(kind == 1) & (J > 0)].sum()),
            ("lift", -J[(kind == 1) & (J < 0)].sum()),
        ):
            # Printed with four digits.
            self.assertAlmostEqual(
                shares[f"impulses that {name} / weight x time"] * weight / (pairs + wall),
                1,
                delta=1e-3,
            )
        in_air = shares["share of the time in flight, if lifted spheres could fly"]
        # Each flight would take 2 J/(m g); overlapping flights count once.
        self.assertLessEqual(in_air, 2.001 * shares["impulses that lift / weight x time"])
        self.assertGreater(in_air, shares["impulses that lift / weight x time"])

    def test_overlapping_flights_count_once(self):
        sys.path.insert(0, os.path.dirname(EXAMPLE))
        from vertical_impulses import union

        self.assertEqual(union(np.array([0.0, 1.0, 5.0]), np.array([2.0, 3.0, 6.0])), 4)
        self.assertEqual(union(np.array([0.0, 1.0, 3.0]), np.array([5.0, 2.0, 7.0])), 7)


if __name__ == "__main__":
    main()
