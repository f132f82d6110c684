"""swirl.Simulation: states bitwise identical to the command line, custom discs and paths, copies,
views, threads, and rejection of invalid input."""

import copy
import gc
import math
import multiprocessing
import os
import pickle
import random
import resource
import struct
import subprocess
import sys
import threading
import time

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import swirl
from scenes import SCENES, options, result_of

RUNS = [scene for scene in SCENES if "warmup" not in scene]


@pytest.mark.parametrize("scene", RUNS, ids=lambda scene: " ".join(options(scene)))
def test_state_is_that_of_the_command_line_for_every_way_of_advancing(scene):
    expected = result_of(scene, "--events", 10000)["state_hash"]
    sims = [swirl.Simulation(**scene) for _ in range(3)]
    sims[0].advance(events=10000)
    rows = sims[1].step(10000)
    seen = list(sims[2].events(4000))
    # Snapshots, sampling and copies do not alter the trajectory.
    sims[2].snapshot().m_frame()
    sims[2] = copy.copy(sims[2])
    while sims[2].counts.total < 9000:
        sims[2].sample(0.1, 40)
        sims[2] = pickle.loads(pickle.dumps(sims[2]))
    if sims[2].counts.total <= 10000:
        sims[2].advance(events=10000 - sims[2].counts.total)
        assert sims[2].state_hash == expected
    assert [sim.state_hash for sim in sims[:2]] == [expected] * 2
    for name in ("whole_periods", "clock", "kind", "i", "j", "normal_impulse", "overlap"):
        np.testing.assert_array_equal(rows[name][:4000], [getattr(e, name) for e in seen])


RAMPS = [
    "mu=0.2:1:0.2@2..10",
    "amplitude=1.5:2.5@1..9;mu_wall=1:0.1@3..8",
    "period=12:8@2..10;restitution=1:0.9@2..4",
    "amplitude=0:2@3..4",
]


@pytest.mark.parametrize("ramp", RAMPS)
def test_a_ramp_is_that_of_the_command_line_for_every_way_of_advancing(ramp):
    given = dict(discs=30, ramp=ramp)
    expected = result_of(given, "--periods", 12)
    assert expected["events"]["total"] > 2000
    sims = [swirl.Simulation(**given) for _ in range(5)]
    sims[0].advance(periods=12)
    # Observed, copied and pickled within and between periods.
    while sims[1].periods < 11.5:
        sims[1].sample(0.37, 20) if sims[1].clock / sims[1].period < 0.6 else sims[1].advance(
            periods=0.21
        )
        sims[1].snapshot().m_frame()
        sims[1] = pickle.loads(pickle.dumps(copy.copy(sims[1])))
    sims[1].advance_to(12)
    while sims[2].whole_periods < 12:
        sims[2].step(1)
    for _ in sims[3].events(1000):
        sims[3].snapshot()
    sims[3].advance(events=expected["events"]["total"] - 1000)
    # By time, in one call: the sum of the periods.
    end = sims[0].time
    sims[4].advance(time=math.nextafter(end, math.inf))
    for sim in sims[:4]:
        assert sim.state_hash == expected["state_hash"]
        assert sim.counts == sims[0].counts
        assert sim.time == end
    assert sims[4].whole_periods == 12
    assert sims[4].clock == pytest.approx(0, abs=1e-9)
    assert sims[4].counts.total == sims[0].counts.total


def test_times_in_a_ramp_of_the_period_are_sums_of_its_periods():
    sim = swirl.Simulation(discs=3, ramp="period=10:6@1..3")
    lengths = [10, 10, 8, 6, 6]
    for whole, length in enumerate(lengths):
        assert sim.period == length
        assert sim.time == sum(lengths[:whole])
        sim.advance(periods=0.5)
        snapshot = sim.snapshot()
        assert snapshot.time == sim.time == sum(lengths[:whole]) + length / 2
        assert sim.periods == whole + 0.5
        # An event has the time at which it happened, also the last one of a period.
        rows = sim.step(1)
        while rows["whole_periods"][-1] == sim.whole_periods:
            rows = sim.step(1)
        assert rows["time"][-1] == pytest.approx(sum(lengths[: whole + 1]), abs=1e-9)
    # Half a period of 6 from here, and 2.5 of them by time.
    sim.advance(time=15)
    assert sim.periods == pytest.approx(7.5)
    with pytest.raises(ValueError, match="one period at a time"):
        swirl.Simulation(discs=3, ramp="period=10:6@1..3").sample(3, 10)


def test_a_custom_path_is_kept_by_other_ramps():
    square = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)]
    sim = swirl.Simulation(discs=12, motion=square, ramp="mu=0:1@1..3")
    steady = swirl.Simulation(discs=12, motion=square, mu=0)
    for each in (sim, steady):
        each.advance(periods=1)
    assert sim.state_hash == steady.state_hash
    assert sim.container_path().tolist() == steady.container_path().tolist()
    for each in (sim, steady):
        each.advance(periods=3)
    assert sim.state_hash != steady.state_hash
    assert sim.container_path().tolist() == steady.container_path().tolist()
    restored = pickle.loads(pickle.dumps(sim))
    for each in (sim, restored):
        each.advance(periods=1)
    assert restored.state_hash == sim.state_hash


def test_events_describe_collisions():
    sim = swirl.Simulation(discs=10, seed=3)
    rows = sim.step(5000)
    collisions = rows[rows["kind"] == swirl.EventKind.disc_disc]
    assert np.all(collisions["i"] < collisions["j"]) and np.all(np.diff(rows["time"]) >= 0)
    np.testing.assert_allclose(np.hypot(rows["normal_x"], rows["normal_y"])[rows["kind"] < 2], 1)
    # Coulomb's law with a friction coefficient of 1.
    assert np.all(
        np.abs(collisions["tangential_impulse"]) <= collisions["normal_impulse"] * (1 + 1e-12)
    )
    counts = sim.counts
    assert counts.disc_disc == len(collisions) and counts.total == 5000
    for event in sim.events(200):
        if event.kind == swirl.EventKind.disc_disc:
            s = sim.snapshot()
            apart = s.position[event.j] - s.position[event.i]
            np.testing.assert_allclose(apart, 2 * np.array(event.normal), atol=1e-9)


def test_advancing_by_periods_time_and_events():
    sim = swirl.Simulation(discs=20)
    sim.advance(periods=2)
    assert (sim.whole_periods, sim.clock) == (2, 0.0)
    sim.advance(periods=0.25)
    assert sim.periods == pytest.approx(2.25, abs=1e-12)
    sim.advance(time=sim.period)
    assert sim.time == pytest.approx(3.25 * sim.period, abs=1e-9)
    sim.advance_to(7, 1.5)
    assert (sim.whole_periods, sim.clock) == (7, 1.5)
    for whole_periods, clock, message in (
        (6, 0, "cannot go back"),
        (7, 1.25, "cannot go back"),
        (8, 12, "below the period"),
        (8, float("nan"), "finite"),
    ):
        with pytest.raises(ValueError, match=message):
            sim.advance_to(whole_periods, clock)
    for wrong in (dict(), dict(periods=1, time=1), dict(events=1, periods=1)):
        with pytest.raises(TypeError, match="exactly one of periods, time and events"):
            sim.advance(**wrong)
    for wrong in (
        dict(periods=-1),
        dict(periods=float("inf")),
        dict(events=-1),
        dict(events=0.5),
        dict(time=float("nan")),
        dict(time=1e300),
    ):
        with pytest.raises(ValueError):
            sim.advance(**wrong)
    with pytest.raises(TypeError):
        sim.advance(periods="2")
    with pytest.raises(TypeError, match="swirl.run"):
        swirl.Simulation(discs=4, events=100)
    for too_much in (
        lambda: sim.step(10**9),
        lambda: sim.sample(1e6),
        lambda: sim.sample(1, 10**7),
        lambda: sim.step(-1),
        lambda: sim.sample(-1),
    ):
        with pytest.raises(ValueError):
            too_much()
    with pytest.raises(ValueError, match="periods is -1, but it must be 0 or more"):
        sim.sample(-1)
    assert (sim.whole_periods, sim.clock) == (7, 1.5)


def test_samples_equal_snapshots():
    a, b = swirl.Simulation(discs=30, seed=5), swirl.Simulation(discs=30, seed=5)
    a.advance(periods=0.37)
    b.advance(periods=0.37)
    frames = a.sample(periods=1.5, per_period=40)
    assert len(frames) == 60 and frames.position.shape == (60, 30, 2)
    start = b.periods
    for k in range(60):
        assert frames.time[k] == pytest.approx((start + k / 40) * b.period, abs=1e-9)
        b.advance_to(int(frames.whole_periods[k]), frames.clock[k])
        s = b.snapshot()
        for name in (
            "position",
            "velocity",
            "angle",
            "spin",
            "container_centre",
            "clock",
            "time",
            "container_velocity",
        ):
            np.testing.assert_array_equal(getattr(frames, name)[k], getattr(s, name), name)
            np.testing.assert_array_equal(getattr(frames[k], name), getattr(s, name), name)
    assert a.periods == pytest.approx(start + 1.5)
    turned = frames.m_frame()
    np.testing.assert_array_equal(turned[7].position, frames[7].m_frame().position)
    with pytest.raises(IndexError):
        frames[60]
    assert frames[-1].time == frames[59].time


def test_m_frame_agrees_with_its_definition():
    sim = swirl.Simulation(discs=30, motion="circle")
    sim.advance(periods=3.3)
    s = sim.snapshot()
    m = s.m_frame()
    down = s.container_centre / np.hypot(*s.container_centre)
    across = np.array([-down[1], down[0]])
    relative = s.position - s.container_centre
    np.testing.assert_allclose(
        m.position, np.stack([relative @ across, -(relative @ down)], axis=1), atol=1e-12
    )
    np.testing.assert_allclose(m.spin, s.spin - sim.omega, atol=1e-12)
    np.testing.assert_array_equal(m.container_centre, [0, 0])


def test_rotation_of_a_rigid_rotation():
    angles = np.arange(6) * np.pi / 3
    position = 4 * np.stack([np.cos(angles), np.sin(angles)], axis=1) + [1.892, 0]
    sim = swirl.Simulation(position=position, amplitude=1.892)
    turning = 0.3 * sim.omega
    around = position - [1.892, 0]
    sim = swirl.Simulation(
        position=position, velocity=turning * np.stack([-around[:, 1], around[:, 0]], axis=1)
    )
    for found in sim.snapshot().rotation():
        assert found == pytest.approx(0.3, rel=1e-12)


# --- custom discs and paths ---------------------------------------------------------------------


def test_simulation_from_a_snapshot_continues_identically():
    first = swirl.Simulation(discs=40, mixture=(10, 1.3), seed=8)
    s = first.snapshot()
    again = swirl.Simulation(
        position=s.position,
        velocity=s.velocity,
        spin=s.spin,
        angle=s.angle,
        radius=s.radius,
        mass=s.mass,
        inertia=s.inertia,
    )
    first.advance(events=5000)
    again.advance(events=5000)
    assert first.state_hash == again.state_hash


def test_custom_polygon_equals_the_papers():
    first = swirl.Simulation(discs=30)
    path = first.container_path()
    again = swirl.Simulation(discs=30, motion=path[:, 1:], motion_times=path[:, 0])
    even = swirl.Simulation(discs=30, motion=path[:, 1:])
    for sim in (first, again, even):
        sim.advance(periods=0.5)
    # Speeds are computed from differences of vertices and times, so rounding errors may differ.
    for sim in (again, even):
        np.testing.assert_allclose(
            sim.snapshot().container_centre, first.snapshot().container_centre, atol=1e-12
        )


def test_the_polygon_as_an_array_gives_the_bitwise_identical_run(tmp_path):
    for parameters in (dict(discs=28), dict(discs=20, preset="experiment")):
        first = swirl.Simulation(**parameters)
        start = first.container_path()
        points = np.vstack([start, [first.period, *start[0, 1:]]])
        np.savetxt(
            tmp_path / "p.csv", points, delimiter=",", header="t,x,y", comments="", fmt="%.17g"
        )
        for path in (points, points.tolist(), str(tmp_path / "p.csv")):
            again = swirl.Simulation(**parameters, path=path)
            back = pickle.loads(pickle.dumps(again))
            for sim in (again, back):
                sim.advance(events=3000)
                assert sim.config["path"].startswith("points 0:")
            assert back.state_hash == again.state_hash
            whole = swirl.Simulation(**parameters)
            whole.advance(events=3000)
            assert again.state_hash == whole.state_hash


def test_a_run_takes_a_path_sizes_and_states_as_arrays():
    triangle = np.array([[0, 1, 0], [4, -1, 1], [8, -1, -1], [12, 1, 0]], dtype=float)
    run = swirl.run(discs=10, motion=triangle, events=3000)
    assert run.config["period"] == 12 and run.config["path"].startswith("points 0")
    assert swirl.run(discs=10, path=run.config["path"], events=3000).state_hash == run.state_hash
    sizes = swirl.run(sizes=[1, 0.5, 0.8], events=1000)
    assert sizes.config["discs"] == 3
    with_mass = swirl.Simulation(sizes=[[1, 1], [0.5, 3]])
    np.testing.assert_array_equal(with_mass.snapshot().mass, [1, 3])
    spheres = swirl.Simulation(sizes=[1, 0.5], body="sphere")
    np.testing.assert_array_equal(spheres.snapshot().mass, [1, 0.125])
    start = swirl.Simulation(discs=9).snapshot()
    states = np.column_stack((start.position, start.velocity, start.spin))
    assert (
        swirl.run(initial=states, events=1000).state_hash
        == swirl.run(discs=9, events=1000).state_hash
    )
    with pytest.raises(TypeError, match="columns x, y, vx, vy and spin"):
        swirl.run(initial=states[:, :4])
    with pytest.raises(ValueError, match="initial and position are both given"):
        swirl.Simulation(initial=states, position=start.position)
    with pytest.raises(ValueError, match="times must increase"):
        swirl.run(discs=3, motion=triangle[[0, 2, 1, 3]])
    with pytest.raises(ValueError, match="not closed"):
        swirl.run(discs=3, motion=triangle[:3])
    with pytest.raises(TypeError, match="columns t, x and y"):
        swirl.run(discs=3, motion=[[0, 1], [1, 2]])
    with pytest.raises(ValueError, match="motion_times is given, but motion has"):
        swirl.Simulation(discs=3, motion=triangle, motion_times=[0, 4, 8])
    with pytest.raises(ValueError, match="M-frame"):
        swirl.run(discs=3, motion="line", measure="slip", events=100)


def test_particles_that_cannot_spin():
    share = swirl.Simulation(discs=40, cannot_spin=0.25)
    share.advance(periods=2)
    now = share.snapshot()
    assert (now.can_spin == 0).sum() == 10
    assert np.all(now.spin[now.can_spin == 0] == 0) and np.all(now.spin[now.can_spin == 1] != 0)
    again = pickle.loads(pickle.dumps(share))
    np.testing.assert_array_equal(again.snapshot().can_spin, now.can_spin)
    given = swirl.Simulation(
        position=[[-3, 0], [2, 0]], velocity=[[1, 0.3], [0, 0]], cannot_spin=[1, 0]
    )
    given.step(200)
    np.testing.assert_array_equal(given.snapshot().can_spin, [0, 1])
    assert given.snapshot().spin[0] == 0 and given.snapshot().spin[1] != 0
    np.testing.assert_array_equal(
        pickle.loads(pickle.dumps(given)).snapshot().spin, given.snapshot().spin
    )


def test_radii_without_masses_are_of_one_material():
    two_sizes = swirl.Simulation(position=[[0, 0], [4, 0]], radius=[1, 2])
    np.testing.assert_array_equal(two_sizes.snapshot().mass, [1, 4])
    np.testing.assert_array_equal(two_sizes.snapshot().inertia, [10, 160])
    given = swirl.Simulation(position=[[0, 0], [4, 0]], radius=[1, 2], mass=[1, 1])
    np.testing.assert_array_equal(given.snapshot().mass, [1, 1])


def test_container_follows_a_custom_path():
    square = np.array([[2, 2], [-2, 2], [-2, -2], [2, -2]], dtype=float)
    sim = swirl.Simulation(discs=20, motion=square, period=16)
    frames = sim.sample(periods=3, per_period=16)
    np.testing.assert_allclose(
        frames.container_centre[:5], [[2, 2], [1, 2], [0, 2], [-1, 2], [-2, 2]], atol=1e-12
    )
    inside = np.linalg.norm(frames.position - frames.container_centre[:, None], axis=2)
    assert inside.max() <= sim.container_radius - 1 + 1e-9
    back = pickle.loads(pickle.dumps(sim))
    for each in (sim, back):
        each.advance(periods=2)
    assert back.state_hash == sim.state_hash
    np.testing.assert_array_equal(back.container_path(), sim.container_path())


numbers = st.one_of(st.floats(), st.integers(-9, 9), st.sampled_from([0.0, 1.0, 1e-7, 1e300]))
arrays = st.one_of(
    st.lists(st.tuples(numbers, numbers).map(list), max_size=4),
    st.lists(numbers, max_size=4),
    numbers,
    st.text(max_size=3),
    st.none(),
    st.lists(st.sampled_from([[1, 0], [4, 0], [-3, 2]]), unique_by=str),
    st.sampled_from(
        [
            np.zeros((2, 2, 2)),
            np.array([[1, 0]], dtype="U3"),
            np.zeros((3, 2), dtype=bool),
            np.ma.masked_invalid([[np.nan, 1]]),
            np.zeros(0),
            object(),
        ]
    ),
)


@settings(
    max_examples=150,
    deadline=None,
    derandomize=True,
    database=None,
    suppress_health_check=list(HealthCheck),
)
@given(
    st.dictionaries(
        st.sampled_from(
            [
                "position",
                "velocity",
                "angle",
                "spin",
                "radius",
                "mass",
                "inertia",
                "path",
                "motion_times",
                "mu",
                "discs",
            ]
        ),
        arrays,
    )
)
def test_random_arguments_are_accepted_or_rejected(given_):
    if isinstance(given_.get("discs"), (int, float)) and given_["discs"] > 60:
        given_["discs"] = 60
    try:
        sim = swirl.Simulation(**given_)
    except (TypeError, ValueError, swirl.Failure) as error:
        assert str(error)
        return
    sim.advance(events=30)
    assert len(sim.snapshot().position) == len(sim)


two = [[1.0, 0.0], [4.0, 0.0]]


@pytest.mark.parametrize(
    "wrong, message",
    [
        (
            dict(position=[[0, 0], [1, 0]]),
            "discs 0 and 1 overlap: their distance is 1, but their radii add up to 2",
        ),
        (
            dict(position=[[0, 0], [20, 0]]),
            "disc 1 at \\(20, 0\\) extends 10.5 beyond the container",
        ),
        (dict(position=[[0, 0, 0]]), "position has shape 1 × 3, but it must be N × 2"),
        (dict(position=3), "position has shape one number, but"),
        (dict(motion=3), "motion has shape one number, but"),
        (dict(position=[]), "position has shape 0, but it must be N × 2"),
        (dict(position=np.zeros((0, 2))), "at least one disc"),
        (dict(position=[[0, float("nan")]]), "y of disc 0 is nan"),
        (dict(position=two, velocity=[[1, 1]]), "velocity has shape 1 × 2, but it must be 2 × 2"),
        (dict(position=two, velocity=[[1, 1], [np.inf, 0]]), "vx of disc 1 is inf"),
        (dict(position=two, spin=[1, 2, 3]), "spin has shape 3, but it must be 2 numbers"),
        (dict(position=two, radius=[1, -1]), "radius of disc 1 is -1"),
        (dict(position=two, mass=[1, 0]), "mass of disc 1 is 0"),
        (dict(position=two, inertia=[1, 0]), "inertia of disc 1 is 0"),
        (dict(position=two, cannot_spin=[0, 0.5]), "can_spin of disc 1 is 0.5"),
        (
            dict(position=two, cannot_spin=1, spin=[0, 2]),
            "disc 1 has the spin 2, but it cannot spin",
        ),
        (dict(position=two, discs=2), "discs and position are both given"),
        (dict(velocity=two), "velocity is given for each disc, but position is not"),
        (dict(position=two, body="sphere"), "only for discs without a floor"),
        (dict(motion=[[0, 0]]), "at least two"),
        (dict(motion=[[1, 1], [1, 1]]), "the same point"),
        (dict(motion=[[0, 0], [1, 0], [1, 0]]), "consecutive vertices must differ"),
        (dict(motion=two, motion_times=[0, 20]), "times must increase"),
        (dict(motion=two, motion_times=[1, 2]), "begins with 1"),
        (dict(motion=two, motion_times=[0, 1, 2]), "motion_times has shape 3, but"),
        (dict(motion=[[0, 0], [1e9, 0]]), "motion contains 1000000000"),
        (dict(position=two, spin=1e200), "spin of disc 0 is 1e"),
        (dict(motion=two, amplitude=2), "both define the path"),
        (dict(motion_times=[0, 1]), "motion_times is given, but motion is not"),
        (dict(motion="spiral"), "motion is 'spiral'"),
        (dict(position=two, mu=-1), "mu is '-1'"),
    ],
)
def test_invalid_custom_scenes_are_rejected(wrong, message):
    with pytest.raises(ValueError, match=message):
        swirl.Simulation(**wrong)


@pytest.mark.parametrize(
    "wrong",
    [
        dict(position="here"),
        dict(position=[["a", "b"]]),
        dict(position=[[1], [2, 3]]),
        dict(position=two, spin=object()),
        dict(motion=[[1j, 0], [0, 0]]),
        dict(position=np.array(two, dtype=object)),
        dict(nonsense=3),
        dict(mu=[1, 2]),
    ],
)
def test_arguments_of_wrong_types_are_rejected(wrong):
    with pytest.raises(TypeError):
        swirl.Simulation(**wrong)


def test_arrays_of_any_memory_layout_are_accepted():
    position = np.array([[1, 0], [4, 0], [-3, 2]], dtype=np.int8)
    spread = np.zeros((6, 4))
    spread[::2, ::2] = position
    states = set()
    for given in (
        position,
        position.astype(np.float32),
        np.asfortranarray(position, dtype=float),
        spread[::2, ::2],
        position.tolist(),
        position.astype(">f8"),
    ):
        sim = swirl.Simulation(position=given)
        sim.advance(events=100)
        states.add(sim.state_hash)
    assert len(states) == 1


# --- saving -------------------------------------------------------------------------------------


def test_loaded_simulation_continues_bitwise_identically(tmp_path):
    sim = swirl.Simulation(discs=48, seed=2)
    sim.advance(periods=1.7)
    sim.save(tmp_path / "saved")
    sim.advance(events=3000)
    again = swirl.load(tmp_path / "saved")
    assert again.config == sim.config
    again.advance(events=3000)
    assert (again.state_hash, again.time) == (sim.state_hash, sim.time)


def test_damaged_files_are_rejected(tmp_path):
    file = tmp_path / "saved"
    swirl.Simulation(discs=5).save(file)
    whole = file.read_bytes()
    random.seed(1)
    for _ in range(60):
        bad = bytearray(whole)
        if random.random() < 0.5:
            bad[random.randrange(len(bad))] ^= 1 << random.randrange(8)
        else:
            bad = bad[: random.randrange(len(bad))]
        file.write_bytes(bad)
        with pytest.raises(swirl.FileError, match="not a swirl simulation that can continue"):
            swirl.load(file)
    with pytest.raises(FileNotFoundError):
        swirl.load(tmp_path / "nothing")


def _crc64(data):
    """CRC-64 of ECMA-182, reflected (src/swirl/io/checksum.hpp)."""
    crc = 2**64 - 1
    for byte in data:
        crc ^= byte
        for _ in range(8):
            crc = crc >> 1 ^ (0xC96C5795D7870F42 if crc & 1 else 0)
    return ~crc & 2**64 - 1


HEAD = b"swirl simulation 3\n"


def _forged(archive, at, word):
    """The archive with eight bytes replaced by `word`, and a valid checksum."""
    body = archive[len(HEAD) + 8 :]
    body = body[:at] + word[: max(0, len(body) - at)] + body[at + 8 :]
    return HEAD + struct.pack("<Q", _crc64(body)) + body


SPECIAL = [
    struct.pack("<d", x)
    for x in (math.nan, math.inf, -math.inf, 1e308, 1e18, -1.0, 0.0, 0.5, 1e-300)
] + [struct.pack("<Q", n) for n in (0, 1, 2, 255, 2**31, 2**61, 2**63, 2**64 - 1)]


@pytest.mark.parametrize("custom", [False, True])
def test_forged_archives_are_rejected_or_continue(custom, tmp_path):
    sim = (
        swirl.Simulation(discs=3, seed=2, sides=3)
        if not custom
        else swirl.Simulation(position=[[0, 0], [3, 0], [0, 3]], motion=[[0, 0], [2, 1], [-1, 2]])
    )
    sim.advance(events=1000)
    sim.save(tmp_path / "good")
    archive = (tmp_path / "good").read_bytes()
    body = archive[len(HEAD) + 8 :]
    text = struct.unpack_from("<Q", body)[0]
    numbers = 8 + text + 1  # after the parameters and the flag for custom scenes
    assert _forged(archive, 0, body[:8]) == archive
    rejected = 0
    # Every number after the parameters: number of segments, segments, whole periods and clock,
    # number of the segment (four bytes) and event counts, discs. Each is replaced by three special
    # values.
    offsets = [*range(0, 8, 8), *range(numbers, len(body) - 7, 8)]
    offsets += [
        numbers + 8 + 3 * 56 + 16 + 4 + 8 * k for k in range((len(body) - numbers - 196) // 8)
    ]
    chosen = random.Random(4)
    tried = [(at, word) for at in offsets for word in chosen.sample(SPECIAL, 3)]
    for at, word in tried:
        (tmp_path / "forged").write_bytes(_forged(archive, at, word))
        try:
            forged = swirl.load(tmp_path / "forged")
        except swirl.FileError:
            rejected += 1
            continue
        forged.advance(events=300)
        assert np.all(np.isfinite(forged.snapshot().position))
    assert len(tried) / 4 < rejected < len(tried)


def test_copies_are_independent():
    sim = swirl.Simulation(discs=10)
    for make in (copy.copy, copy.deepcopy):
        other = make(sim)
        other.advance(periods=1)
        assert sim.whole_periods == 0 and other.whole_periods == 1


def advanced(sim):
    sim.advance(events=2000)
    return sim.state_hash


def test_another_process_continues_bitwise_identically():
    sim = swirl.Simulation(discs=30, seed=9)
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        elsewhere = pool.apply(advanced, (sim,))
    assert elsewhere == advanced(sim)


# --- views, threads -----------------------------------------------------------------------------


def test_views_are_read_only_and_never_change():
    sim = swirl.Simulation(discs=48)
    s = sim.snapshot()
    position = s.position
    before = position.copy()
    for name in ("position", "velocity", "spin", "angle", "radius", "container_centre"):
        view = getattr(s, name)
        assert not view.flags.writeable and not view.flags.owndata
        with pytest.raises(ValueError):
            view[...] = 0
        with pytest.raises(ValueError):
            view.flags.writeable = True
    count = sys.getrefcount(s)
    more = [s.position for _ in range(100)]
    assert sys.getrefcount(s) == count + 100
    del more
    assert sys.getrefcount(s) == count
    sim.advance(periods=5)
    del s, sim
    gc.collect()
    [np.full((48, 2), 7.0) for _ in range(100)]
    np.testing.assert_array_equal(position, before)


def test_memory_does_not_leak():
    def resident():
        with open("/proc/self/statm") as file:
            return int(file.read().split()[1]) * resource.getpagesize()

    def work():
        sim = swirl.Simulation(discs=48)
        for _ in range(40):
            sim.step(500)["time"].sum()
            sim.sample(0.5).position.sum()
            sim.snapshot().m_frame().position.sum()

    for _ in range(3):
        work()
    before = resident()
    for _ in range(10):
        work()
    # The frames of one round take 40 MB, so a leak in any of ten rounds would exceed 20 MB.
    assert resident() - before < 20e6


def test_two_threads_use_two_simulations():
    alone = [swirl.Simulation(discs=48, seed=seed) for seed in (1, 2)]
    for sim in alone:
        sim.advance(events=100000)
    sims = [swirl.Simulation(discs=48, seed=seed) for seed in (1, 2)]
    threads = [threading.Thread(target=sim.advance, kwargs=dict(events=100000)) for sim in sims]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert [sim.state_hash for sim in sims] == [sim.state_hash for sim in alone]


def test_threads_share_one_simulation():
    sim = swirl.Simulation(discs=48)
    raised = []

    def use(k):
        try:
            for _ in range(30):
                [
                    lambda: sim.step(500),
                    lambda: sim.advance(events=500),
                    lambda: sim.snapshot().position,
                    lambda: pickle.dumps(sim),
                    lambda: list(sim.events(20)),
                    lambda: sim.state_hash,
                    lambda: sim.sample(0.01),
                ][k % 7]()
        except Exception as error:
            raised.append(error)

    threads = [threading.Thread(target=use, args=(k,)) for k in range(14)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not raised
    total = sim.counts.total
    fresh = swirl.Simulation(discs=48)
    fresh.advance(events=total)
    assert fresh.state_hash == sim.state_hash


LEAVING = """
import swirl, threading, time
def work():
    while True:
        swirl.Simulation(discs=48).advance(events=10**6)
for _ in range(3):
    threading.Thread(target=work, daemon=True).start()
threading.Thread(target=swirl.run, kwargs=dict(events=1e12), daemon=True).start()
time.sleep(0.3)
print("leaving")
"""


def test_python_exits_while_threads_work():
    for _ in range(3):
        done = subprocess.run([sys.executable, "-B", "-c", LEAVING], capture_output=True, text=True)
        assert (done.returncode, done.stdout, done.stderr) == (0, "leaving\n", "")


def test_uninitialised_objects_raise_errors():
    bare = swirl.Simulation.__new__(swirl.Simulation)
    with pytest.raises(AttributeError):
        bare.step(1)
    for kind in (swirl.Snapshot, swirl.Frames, swirl.Event):
        with pytest.raises(TypeError):
            kind()
        with pytest.raises(TypeError):
            kind.__new__(kind)


def test_snapshots_and_frames_can_be_pickled():
    sim = swirl.Simulation(discs=7, body="sphere", floor="sliding")
    sim.advance(periods=0.3)
    for seen in (sim.snapshot(), sim.sample(0.5)):
        again = pickle.loads(pickle.dumps(seen))
        for name in ("position", "velocity", "spin", "time", "mass"):
            np.testing.assert_array_equal(getattr(again, name), getattr(seen, name))
    with pytest.raises(swirl.FileError):
        swirl._engine.frames_from_bytes(b"nonsense")


def test_simulation_has_an_svg():
    svg = swirl.Simulation(discs=7)._repr_svg_()
    assert svg.startswith("<svg") and svg.count("<circle") == 8


def test_a_collapse_ends_every_call_with_the_reason():
    """Without friction and restitution, discs collide ever faster; no call may wait for a time
    then."""

    def new():
        return swirl.Simulation(discs=48, mu=0, restitution=0, period=10)

    calls = (
        lambda s: s.advance(periods=30),
        lambda s: s.advance(time=300.5),
        lambda s: s.advance(events=10**8),
        lambda s: s.advance_to(30),
        lambda s: s.sample(periods=30),
        lambda s: s.step(10**6),
        lambda s: [None for _ in s.events(10**6)],
    )
    for call in calls:
        simulation = new()
        with pytest.raises(
            swirl.Failure, match="inelastic collapse.*\nhint: use a contact_duration"
        ):
            call(simulation)
        # Later calls fail, too.
        with pytest.raises(swirl.Failure, match="inelastic collapse"):
            simulation.advance(periods=30)


def test_half_of_a_surrogate_pair_is_rejected():
    for given in ({"mu": "\ud800"}, {"ramp": ("mu=0:1@1..2", "\ud800")}, {"path": "\ud800"}):
        with pytest.raises(ValueError, match=r"is '\\ud800', but half of a surrogate pair"):
            swirl.Simulation(**given)
    with pytest.raises(ValueError, match="the name of a parameter"):
        swirl.Simulation(**{"\ud800": 1})


@pytest.mark.filterwarnings("ignore:.*fork")
def test_a_fork_during_a_call_is_reported_in_the_child():
    simulation = swirl.Simulation()
    thread = threading.Thread(target=simulation.advance, kwargs={"events": 10**7})
    thread.start()
    begin = time.process_time()
    while time.process_time() < begin + 0.05:  # the thread needs far more time for its events
        time.sleep(0.001)
    child = os.fork()
    if child == 0:
        try:
            simulation.advance(events=1)
        except swirl.Failure as failure:
            os._exit(0 if "forked" in str(failure) else 1)
        os._exit(2)
    assert os.waitpid(child, 0)[1] == 0
    thread.join()
    simulation.advance(events=1)  # the parent is not affected


def test_time_with_a_ramp_of_the_period_is_that_of_a_loaded_simulation():
    """A loaded simulation computes the time from the ramp, an advanced one from period to
    period."""
    simulation = swirl.Simulation(discs=5, ramp="period=10:12:9@2..40")
    for _ in range(45):
        simulation.advance(periods=1)
        assert pickle.loads(pickle.dumps(simulation)).time == simulation.time
