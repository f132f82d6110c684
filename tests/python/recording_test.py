"""Recordings and tracks in Python, compared with `swirl measure` and with the run."""

import json
import math
import threading

import numpy as np
import pandas
import pytest

import swirl
from scenes import command, options

SCENE = dict(discs=20, seed=3, periods=12, warmup=2)


@pytest.fixture(scope="module")
def file(tmp_path_factory):
    file = tmp_path_factory.mktemp("recorded") / "frames.h5"
    swirl.run(**SCENE, trajectory=file, frames_per_period=511)
    return file


def test_frames_equal_those_of_the_run(file):
    t = swirl.Trajectory(file)
    sim = swirl.Simulation(discs=20, seed=3)
    assert t.complete and t.same_discs and t.parameters["discs"] == 20
    frames = t[:100]
    assert frames.position.shape == (100, 20, 2)
    ours = sim.sample(1, 511)
    for name in ("whole_periods", "clock", "container_centre"):
        np.testing.assert_array_equal(getattr(ours, name)[:100], getattr(frames, name))
    np.testing.assert_allclose(ours.position[:100], frames.position, atol=1e-12)
    np.testing.assert_array_equal(t[7].position, frames.position[7])
    np.testing.assert_array_equal(t[-1].position, t[len(t) - 1].position)
    assert len(t[10:20:3]) == 4 and sum(1 for _ in t) == len(t)
    for wrong in (len(t), -len(t) - 1):
        with pytest.raises(IndexError, match="is out of range: there are"):
            t[wrong]
    with pytest.raises(TypeError):
        t["first"]
    with pytest.raises(ValueError):
        t[10:0:-1]
    assert len(t[5:5]) == 0 and t[5:5].position.size == 0


def estimates_of(measured):
    return {
        f"{name}.{row}": estimate
        for name, found in measured.items()
        for row, estimate in found.rows.items()
    }


def test_analysis_equals_that_of_the_command_line(file):
    found = swirl.analyse(swirl.Trajectory(file), "all", warmup=2)
    done = command("measure", file, "--measure", "all", "--warmup", 2, "--json", "-")
    theirs = json.loads(done.stdout)
    assert found.frames == theirs["frames"] and set(found.measured) == set(theirs["measured"])
    assert found.rotation.mean_by_time.mean == theirs["rotation"]["mean_by_time"]["mean"]
    compared = 0
    for name, estimate in estimates_of(found.measured).items():
        measurement, row = name.split(".")
        value = theirs["measured"][measurement][row]
        mean = value["mean"] if isinstance(value, dict) else value
        assert math.isnan(estimate.mean) if mean is None else estimate.mean == mean, name
        compared += 1
    assert compared > 20


def test_frames_have_the_pinned_and_resident_discs(file):
    t = swirl.Trajectory(file)
    frames = t[:]
    assert frames.pinned.shape == frames.resident.shape == (len(t), 20)
    assert np.isnan(frames.pinned[:7]).all() and not np.isnan(frames.pinned[7:-7]).any()
    assert set(np.unique(frames.pinned[7:-7])) == {0.0, 1.0}
    np.testing.assert_array_equal(t[600:620].pinned, frames.pinned[600:620])
    np.testing.assert_array_equal(t[611].resident, frames.resident[611])
    np.testing.assert_array_equal(frames[611].m_frame().resident, frames.resident[611])
    found = swirl.analyse(t, ["pinned", "residence"]).measured
    assert np.nanmean(frames.pinned) == pytest.approx(found["pinned"].rows["share"].mean, rel=1e-12)
    sampled = swirl.Simulation(discs=20, seed=3).sample(3, 511)
    np.testing.assert_array_equal(sampled.pinned[7:-7], frames.pinned[7 : 3 * 511 - 7])
    np.testing.assert_array_equal(sampled[20].pinned, sampled.pinned[20])
    assert np.isnan(swirl.Simulation(discs=20, seed=3).sample(3, 30).resident).all()


def test_values_that_need_more_frames_are_missing_with_the_reason():
    slow = swirl.Simulation(discs=20, seed=3).sample(5, 30)
    found = swirl.analyse(slow, ["residence", "order"])
    assert math.isnan(found.measured["residence"].rows["length"].mean)
    assert "residence (400)" in found.warnings[0] and "hint:" in found.warnings[0]
    assert swirl.analyse(slow, ["density"]).warnings == ()


def test_custom_measurement_of_a_recording_agrees_with_the_run(file):
    class Spread:
        def sample(self, snapshot):
            return snapshot.position.std()

    of_run = swirl.run(**SCENE, measure=[Spread]).measured["Spread"].estimate
    of_frames = (
        swirl.analyse(swirl.Trajectory(file), [Spread], warmup=2).measured["Spread"].estimate
    )
    assert of_frames.mean == pytest.approx(of_run.mean, rel=1e-9)
    assert of_frames.error == pytest.approx(of_run.error, rel=1e-6)


def test_sampled_frames_can_be_analysed(file):
    sim = swirl.Simulation(discs=20, seed=3)
    found = swirl.analyse(sim.sample(12), ["density", "slip"], warmup=2)
    theirs = swirl.analyse(swirl.Trajectory(file), ["density", "slip"], warmup=2)
    # The recording has one more frame: the first one of a further period.
    assert found.rotation.mean_by_time.mean == pytest.approx(
        theirs.rotation.mean_by_time.mean, rel=1e-3
    )
    square = [[2, 2], [-2, 2], [-2, -2], [2, -2]]
    custom = swirl.Simulation(discs=20, motion=square)
    found = swirl.analyse(custom.sample(30), "all", warmup=5)
    assert found.frames == 25 * 511 and found.rotation.mean_by_time.blocks == 25
    assert set(found.measured) < set(swirl.measurements()) and "density" in found.measured
    with pytest.raises(ValueError, match="no frames"):
        swirl.analyse(custom.sample(0))


def test_impossible_analyses_are_rejected(file, tmp_path):
    t = swirl.Trajectory(file)
    with pytest.raises(ValueError, match="measure contains 'collisions', which needs every"):
        swirl.analyse(t, ["collisions"])
    with pytest.raises(ValueError, match="warmup"):
        swirl.analyse(t, warmup=-1)
    with pytest.raises(ValueError, match="the recording ends earlier"):
        swirl.analyse(t, warmup=100)
    with pytest.raises(TypeError, match="but it must be a swirl.Trajectory"):
        swirl.analyse(str(file))
    with pytest.raises(swirl.FileError):
        swirl.Trajectory(tmp_path / "nothing.h5")
    (tmp_path / "text.h5").write_text("no trajectory")
    with pytest.raises(swirl.FileError):
        swirl.Trajectory(tmp_path / "text.h5")


def test_threads_share_one_recording(file):
    t = swirl.Trajectory(file)
    expected = [t[k].position.copy() for k in range(0, 600, 50)]
    wrong = []

    def read(first):
        for _ in range(20):
            for k in range(12):
                at = (k * 5 + first) % 12
                if not np.array_equal(t[50 * at].position, expected[at]):
                    wrong.append(at)

    threads = [threading.Thread(target=read, args=(n,)) for n in range(4)]
    threads.append(threading.Thread(target=swirl.analyse, args=(t, ["density"])))
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not wrong


# --- tracks -------------------------------------------------------------------------------------

SCALE = dict(
    omega=2 * math.pi / 11.866071,
    container_radius=8.6,
    amplitude=1.892,
    scale=20.0,
    camera_fps=511 / 11.866071,
    centre=(400.0, 300.0),
)


@pytest.fixture(scope="module")
def table(file):
    """Tracks that trackpy would find in a video of the run."""
    rows = [
        (k, i, 400 + 20 * x, 300 - 20 * y)
        for k, s in enumerate(swirl.Trajectory(file)[:3000:1].position)
        for i, (x, y) in enumerate(s)
    ]
    return pandas.DataFrame(rows, columns=["frame", "particle", "x", "y"])


def test_tracks_equal_those_of_the_command_line(table, tmp_path):
    tracks = swirl.Tracks(table, **SCALE)
    table.to_csv(tmp_path / "tracks.csv", index=False)
    done = command(
        "measure",
        tmp_path / "tracks.csv",
        "--measure",
        "density,slip,profile",
        "--json",
        "-",
        "--camera-fps",
        repr(SCALE["camera_fps"]),
        "--scale",
        20,
        "--omega",
        repr(SCALE["omega"]),
        "--centre",
        "400,300",
        "--amplitude",
        1.892,
        "--container-radius",
        8.6,
    )
    assert done.returncode == 0, done.stderr
    theirs = json.loads(done.stdout)
    found = swirl.analyse(tracks, ["density", "slip", "profile"])
    assert found.frames == theirs["frames"]
    assert found.rotation.mean_by_time.mean == theirs["rotation"]["mean_by_time"]["mean"]
    for name, estimate in estimates_of(found.measured).items():
        measurement, row = name.split(".")
        assert estimate.mean == theirs["measured"][measurement][row]["mean"], name
    density = found.measured["density"]["by_time"].ravel()
    np.testing.assert_array_equal(density, theirs["measured"]["density"]["by_time"])


def test_order_of_rows_does_not_matter(table):
    shuffled = table.sample(frac=1, random_state=1)
    for k in (0, 17, 400):
        np.testing.assert_array_equal(
            swirl.Tracks(shuffled, **SCALE)[k].position, swirl.Tracks(table, **SCALE)[k].position
        )


@pytest.mark.parametrize(
    "change, kind, said",
    [
        (dict(omega=0), ValueError, "omega is 0"),
        (dict(scale=float("nan")), ValueError, "scale is nan"),
        (dict(container_radius="8"), TypeError, "container_radius is '8'"),
        (dict(centre=(0, float("inf"))), ValueError, "centre"),
        (dict(amplitude=-1), ValueError, "amplitude"),
    ],
)
def test_invalid_scales_are_rejected(table, change, kind, said):
    with pytest.raises(kind, match=said):
        swirl.Tracks(table, **{**SCALE, **change})


def test_invalid_tables_are_rejected(table):
    few = table[:60].copy()
    with pytest.raises(ValueError, match="the columns frame, particle, x and y"):
        swirl.Tracks(few.drop(columns="x"), **SCALE)
    for column, value, said in (
        ("x", float("nan"), "no finite position"),
        ("particle", 0, "appears twice in frame 0"),
        ("frame", 0.5, "whole numbers"),
    ):
        bad = few.copy().astype(float)
        bad.loc[:3, column] = value
        with pytest.raises(ValueError, match=said):
            swirl.Tracks(bad, **SCALE)
    with pytest.raises(ValueError, match="the tracks are empty"):
        swirl.Tracks(few[:0], **SCALE)
    with pytest.raises(ValueError, match="single frame"):
        swirl.Tracks(few[:20], **SCALE)
    with pytest.raises(TypeError):
        swirl.Tracks(few.assign(x="here"), **SCALE)
    with pytest.raises(ValueError, match="columns frame"):
        swirl.Tracks(np.zeros((4, 4)), **SCALE)


@pytest.mark.parametrize(
    "change, said",
    [
        (dict(scale=25.0), "scale 25 is too large"),
        (dict(phase=180), "phase that fits best is phase 0"),
        (dict(container_radius=12.0), "hardly ever come near the wall"),
    ],
)
def test_tracks_that_do_not_fit_the_container_are_rejected(table, change, said):
    with pytest.raises(swirl.Failure, match=said):
        swirl.Tracks(table, **{**SCALE, **change})
    unchecked = swirl.Tracks(table, **{**SCALE, **change}, max_invalid=1)
    assert len(unchecked) == len(swirl.Tracks(table, **SCALE))


def test_remarks_report_filled_gaps_and_noise(table):
    (noise,) = swirl.Tracks(table, **SCALE).remarks
    assert noise.startswith("Positions have a noise of ")
    gap = table[~((table.particle == 3) & table.frame.isin([100, 101]))]
    mended, noise = swirl.Tracks(gap, **SCALE).remarks
    assert mended == "2 positions missing for up to five frames were filled in."
    assert noise.startswith("Positions have a noise of ")


def test_tracks_of_swirl_track_need_no_scale(table, tmp_path):
    table.assign(radius=20.0, seen=1).to_csv(tmp_path / "tracks.csv", index=False)
    camera = {name.replace("_", "-"): value for name, value in SCALE.items()}
    camera.update({"phase": 0.0, "clockwise": False})
    (tmp_path / "tracks.camera.json").write_text(json.dumps({"camera": camera}))
    read, given = swirl.Tracks.read(tmp_path / "tracks.csv"), swirl.Tracks(table, **SCALE)
    np.testing.assert_array_equal(read[200].position, given[200].position)
    np.testing.assert_array_equal(read[200].radius, np.ones(20))
    good = json.dumps({"camera": camera})
    wrong = ["{}", "[" * 100_000, good.replace('"clockwise"', '"clockwise": true, "clockwise"')]
    wrong += [
        json.dumps({"camera": {**camera, name: value}})
        for name, value in (("phase", None), ("clockwise", 1), ("centre", [1.0]), ("scale", "20"))
    ]
    for text in wrong:
        (tmp_path / "tracks.camera.json").write_text(text)
        with pytest.raises(swirl.Failure, match="is not a valid file of `swirl track`"):
            swirl.Tracks.read(tmp_path / "tracks.csv")
    (tmp_path / "tracks.camera.json").write_text(good)
    text = (tmp_path / "tracks.csv").read_text().splitlines()
    twice = [text[0] + ",x", *(line + ",0" for line in text[1:])]
    (tmp_path / "tracks.csv").write_text("\n".join(twice) + "\n")
    with pytest.raises(swirl.FileError, match="two columns 'x'"):
        swirl.Tracks.read(tmp_path / "tracks.csv")
    semicolons = [line.replace(",", ";").replace(".", ",") for line in text]
    (tmp_path / "tracks.csv").write_text("\n".join(semicolons) + "\n", encoding="utf-8-sig")
    np.testing.assert_array_equal(
        swirl.Tracks.read(tmp_path / "tracks.csv")[200].position, read[200].position
    )
