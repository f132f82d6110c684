"""swirl.sweep(), crossing() and map() give the results of the command line, in the same folders."""

import io
import json
import os
import subprocess
import sys
import warnings

import numpy as np
import pandas
import pytest

import swirl
from scenes import command


def table_of(folder):
    done = command("collect", folder, "--csv", "-")
    assert done.returncode == 0, done.stderr
    return pandas.read_csv(
        io.StringIO(done.stdout),
        float_precision="round_trip",
        dtype={"state_hash": str, "steady_state": str},
    )


def test_sweep_equals_that_of_the_command_line(tmp_path):
    ours = swirl.sweep(
        tmp_path / "ours",
        discs=range(5, 8),
        mu=[0.1, 0.5],
        events=5000,
        replicates=2,
        measure=["slip", "density"],
    )
    done = command(
        "sweep",
        "--discs",
        "5:7",
        "--mu",
        "0.1,0.5",
        "--events",
        "5000",
        "--replicates",
        "2",
        "--measure",
        "slip,density",
        "--out",
        tmp_path / "theirs",
        "--quiet",
    )
    assert done.returncode == 0, done.stderr
    pandas.testing.assert_frame_equal(ours, table_of(tmp_path / "theirs"), check_exact=True)
    pandas.testing.assert_frame_equal(ours, table_of(tmp_path / "ours"), check_exact=True)
    assert len(ours) == 6 and ours.attrs["runs"] == dict(planned=12, done=12, running=0, failed=0)
    assert {"slip.cluster", "discs", "mu"} <= set(ours.columns)
    # Python and the command line can continue each other's sweeps.
    again = command("sweep", "--out", tmp_path / "ours", "--quiet")
    assert again.returncode == 0
    more = swirl.sweep(tmp_path / "theirs", discs=[8], replicates=3, grow=True)
    assert len(more) == 8 and more.attrs["runs"]["done"] == 24
    pandas.testing.assert_frame_equal(swirl.sweep(tmp_path / "theirs"), more)


TABLE = [{"discs": 5, "mu": 0.5}, {"discs": 7, "mu": 0.1, "replicates": 3}]


@pytest.mark.parametrize(
    "points",
    (
        TABLE,
        pandas.DataFrame({"discs": [5, 7], "mu": [0.5, 0.1], "replicates": [1, 3]}),
        {"discs": np.array([5, 7]), "mu": (0.5, 0.1), "replicates": [None, 3]},
    ),
)
def test_a_table_of_points_equals_that_of_the_command_line(tmp_path, points):
    ours = swirl.sweep(tmp_path / "ours", points=points, events=3000, measure="slip")
    (tmp_path / "points.csv").write_text("discs,mu,seeds\n5,0.5,1\n7,0.1,3\n")
    done = command(
        "sweep",
        "--points",
        tmp_path / "points.csv",
        "--events",
        3000,
        "--measure",
        "slip",
        "--out",
        tmp_path / "theirs",
        "--quiet",
    )
    assert done.returncode == 0, done.stderr
    pandas.testing.assert_frame_equal(ours, table_of(tmp_path / "theirs"), check_exact=True)
    assert ours["replicates"].tolist() == [1, 3]
    # Points that a row does not give have the default.
    more = swirl.sweep(
        tmp_path / "ours",
        points=[{"discs": 6, "replicates": 2}, {**TABLE[0], "replicates": 2}],
        events=3000,
        grow=True,
    )
    assert more["replicates"].tolist() == [2, 3, 2] and np.isnan(more["mu"][2])
    files = swirl._engine.result_files(
        str(tmp_path / "ours"), [{"discs": 6, "events": 3000}, {**TABLE[0], "events": 3000}], 2
    )
    assert [
        [json.loads(open(file).read())["config"]["discs"] for file, _ in row] for row in files
    ] == [[6, 6], [5, 5]]


@pytest.mark.parametrize(
    "points, kind, message",
    [
        ([], ValueError, "points has no rows"),
        ("points.csv", TypeError, "read_csv"),
        ([5, 6], TypeError, "DataFrame"),
        ({"discs": 5}, TypeError, "column"),
        ({"discs": "5:7"}, TypeError, "column"),
        ({"discs": [5, 6], "mu": [1]}, ValueError, "different lengths"),
        (
            [{"discs": 5}, {"disks": 6}],
            TypeError,
            "points, row 2: there is no parameter 'disks'.\nhint: did you mean 'discs'",
        ),
        ([{"discs": 5}, {"discs": [6]}], TypeError, "points, row 2: discs is"),
        ([{"discs": 5}, {"discs": True}], TypeError, "points, row 2: discs is"),
        ([{"discs": 5, "mu": ""}], ValueError, "points, row 1: mu is empty"),
        ([{"discs": 5, "replicates": 1.5}], ValueError, "points, row 1: replicates is '1.5'"),
        (
            [{"discs": 5}, {"discs": 5.0}],
            ValueError,
            "points, row 2: the run is that of points, row 1",
        ),
        (
            pandas.DataFrame({"discs": [5, 6], "mu": [1, np.nan]}),
            ValueError,
            "points, row 2: mu is 'nan'",
        ),
        (pandas.DataFrame([[5, 6]], columns=["discs", "discs"]), ValueError, "two columns discs"),
    ],
)
def test_invalid_tables_of_points_are_rejected(tmp_path, points, kind, message):
    with pytest.raises(kind, match=message):
        swirl.sweep(tmp_path / "s", points=points, events=1000)
    assert not (tmp_path / "s").exists()


def test_a_table_excludes_lists_and_chains(tmp_path):
    for call in (dict(mu=[0.1, 1]), dict(discs=5), dict(chain="discs", periods=3)):
        with pytest.raises(ValueError, match="points"):
            swirl.sweep(tmp_path / "s", points=TABLE, **call)
    swirl.sweep(tmp_path / "product", discs=[5, 6], events=1000)
    with pytest.raises(ValueError, match="points is given, but the folder holds a sweep of lists"):
        swirl.sweep(tmp_path / "product", points=TABLE, grow=True)


def test_sweep_without_a_folder_leaves_no_files(tmp_path, monkeypatch):
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    import tempfile

    tempfile.tempdir = None
    table = swirl.sweep(discs="5:7", events=2000)
    assert len(table) == 3 and os.listdir(tmp_path) == []
    tempfile.tempdir = None


def test_different_sweep_in_the_same_folder_is_rejected(tmp_path):
    swirl.sweep(tmp_path, discs=[5], events=1000)
    with pytest.raises(swirl.Failure, match="plan"):
        swirl.sweep(tmp_path, discs=[6], events=1000)


@pytest.mark.parametrize(
    "wrong, kind, message",
    [
        (dict(discs=[]), ValueError, "discs is an empty list"),
        (dict(discs=[5, 5]), ValueError, "5"),
        (dict(discs="5:x"), ValueError, "discs"),
        (dict(discs=[5, 900]), ValueError, "900 discs do not fit"),
        (dict(mu=[0.1, None]), TypeError, "mu"),
        (dict(discs=[5], replicates=0), ValueError, "replicates is 0"),
        (dict(discs=[5], replicates=1.5), TypeError, "replicates"),
        (dict(discs=[5], measure="nothing"), ValueError, "measure has 'nothing'"),
        (dict(discs=[5], measure=[print]), TypeError, "swirl.map"),
        (dict(discs=[5], frames_per_period=10), ValueError, "frames_per_period is given, but out"),
        (dict(disks=[5]), TypeError, "did you"),
        (dict(discs=[5], threads=-1), ValueError, "threads"),
        (dict(discs=[True]), TypeError, "True"),
    ],
)
def test_invalid_sweeps_are_rejected(wrong, kind, message):
    with pytest.raises(kind, match=message):
        swirl.sweep(**wrong)


def test_a_chain_equals_that_of_the_command_line(tmp_path):
    ours = swirl.sweep(
        tmp_path / "ours",
        discs=12,
        mu=[0.2, 0.6, 1],
        periods=6,
        replicates=2,
        chain="mu",
        series=True,
    )
    done = command(
        "sweep",
        "--discs",
        12,
        "--mu",
        "0.2,0.6,1",
        "--periods",
        6,
        "--replicates",
        2,
        "--chain",
        "mu",
        "--series",
        "--out",
        tmp_path / "theirs",
        "--quiet",
    )
    assert done.returncode == 0, done.stderr
    theirs = swirl.collect(tmp_path / "theirs")
    pandas.testing.assert_frame_equal(ours, theirs, check_exact=True)
    assert set(ours["direction"]) == {"up", "down"}
    # The area of the loop, by the trapezoidal rule.
    branches = [
        ours[ours["direction"] == name].set_index("mu")["mean_by_time"] for name in ("down", "up")
    ]
    difference = (branches[0] - branches[1]).sort_index()
    (loop,) = ours.attrs["loops"]
    means = (difference.to_numpy()[1:] + difference.to_numpy()[:-1]) / 2
    assert loop["mean_by_time"] == pytest.approx(
        (means * np.diff(difference.index)).sum(), abs=1e-12
    )
    assert loop["mean_by_time_error"] > 0 and loop["replicates"] == 2
    assert (
        {file.name: file.read_bytes() for file in (tmp_path / "ours/series").iterdir()}
        == {file.name: file.read_bytes() for file in (tmp_path / "theirs/series").iterdir()}
        != {}
    )


@pytest.mark.parametrize(
    "wrong, message",
    [
        (
            dict(mu=[0.1, 1], periods=4, chain="mu", frames_per_period=8),
            "chain and frames_per_period cannot be combined",
        ),
        (dict(mu=[0.1, 1], chain="amplitude"), "amplitude"),
        (dict(mu=[0.1, 1], chain="mu", grow=True), "chain and series cannot be used with grow"),
    ],
)
def test_invalid_chains_are_rejected(tmp_path, wrong, message):
    with pytest.raises(ValueError, match=message):
        swirl.sweep(tmp_path / "s", **wrong)
    with pytest.raises(ValueError, match="series is given, but out"):
        swirl.sweep(mu=[0.1, 1], series=True)


def test_sweep_without_parameters_is_rejected(tmp_path):
    with pytest.raises(ValueError, match="no parameter to sweep over"):
        swirl.sweep(tmp_path / "empty")
    with pytest.raises(swirl.FileError):
        swirl.collect(tmp_path / "nowhere")


def test_ctrl_c_keeps_finished_runs(tmp_path):
    script = f"""
import swirl, os, pathlib, signal, threading, time
def interrupt():
    while len(list(pathlib.Path({str(tmp_path / "s/results")!r}).glob("*.json"))) < 2:
        time.sleep(0.005)
    os.kill(os.getpid(), signal.SIGINT)
threading.Thread(target=interrupt).start()
try:
    swirl.sweep({str(tmp_path / "s")!r}, discs=[5, 6], events=[20000, 3e10])
except KeyboardInterrupt:
    print("stopped", swirl.collect({str(tmp_path / "s")!r}).attrs["runs"]["planned"])
"""
    done = subprocess.run([sys.executable, "-B", "-c", script], capture_output=True, text=True)
    assert done.stdout.split() == ["stopped", "4"], done.stderr
    status = command("sweep", "--out", tmp_path / "s", "--status")
    assert "4 runs done, 0 running, 0 failed" in status.stdout


def test_crossing_equals_that_of_the_command_line():
    call = dict(min_discs=30, max_discs=46, tolerance=1.0)
    ours = swirl.crossing(**call, mu=1, events=20000)
    done = command(
        "crossing",
        "--from",
        30,
        "--to",
        46,
        "--tolerance",
        1.0,
        "--mu",
        1,
        "--events",
        20000,
        "--json",
        "-",
        "--quiet",
    )
    assert done.returncode == 0, done.stderr
    theirs = json.loads(done.stdout)
    for found in (ours.found, theirs):
        for of_the_call in ("command", "seconds"):
            found.pop(of_the_call, None)
    assert ours.found == theirs
    assert ours.verdict == "crosses" and float(ours) == theirs["N_c"]
    assert str(ours) in done.stderr + ours.sentence and ours.sentence.startswith("N_c = ")


def test_a_crossing_and_the_command_line_continue_each_other(tmp_path):
    call = dict(min_discs=34, max_discs=40, tolerance=2.0, mu=1, events=4000, warmup=2)
    ours = swirl.crossing(tmp_path / "search", **call)
    made = {file: file.stat().st_mtime_ns for file in (tmp_path / "search/results").iterdir()}
    assert len(made) == ours.found["runs"]
    done = command(
        "crossing",
        "--from",
        34,
        "--to",
        40,
        "--tolerance",
        2,
        "--mu",
        1,
        "--events",
        4000,
        "--warmup",
        2,
        "--out",
        tmp_path / "search",
        "--json",
        "-",
        "--quiet",
    )
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout)["N_c"] == ours.found["N_c"]
    assert swirl.crossing(tmp_path / "search", **call).found["points"] == ours.found["points"]
    assert {
        file: file.stat().st_mtime_ns for file in (tmp_path / "search/results").iterdir()
    } == made
    with pytest.raises(swirl.Failure, match="another"):
        swirl.crossing(tmp_path / "search", **{**call, "mu": 0.5})


@pytest.mark.parametrize(
    "wrong, kind",
    [
        (dict(min_discs=10, max_discs=5), ValueError),
        (dict(tolerance=0), ValueError),
        (dict(min_discs=0), ValueError),
        (dict(discs=40), TypeError),
        (dict(max_discs=2.5), TypeError),
        (dict(tolerance=float("nan")), ValueError),
        (dict(min_discs=400, max_discs=500), ValueError),
    ],
)
def test_invalid_crossings_are_rejected(wrong, kind):
    with pytest.raises(kind):
        swirl.crossing(**wrong)


def test_parameter_map_equals_that_of_the_command_line(tmp_path):
    reported = []
    ours = swirl.parameter_map(
        tmp_path / "ours",
        x=("mu", [0, 0.5, 1]),
        y="discs=4:40",
        steps=5,
        level=0.5,
        replicates=4,
        periods=12,
        progress=lambda *numbers: reported.append(numbers),
    )
    done = command(
        "map",
        "--x",
        "mu=0,0.5,1",
        "--y",
        "discs=4:40",
        "--steps",
        5,
        "--level",
        0.5,
        "--replicates",
        4,
        "--periods",
        12,
        "--out",
        tmp_path / "theirs",
        "--no-figure",
        "--quiet",
    )
    assert done.returncode == 0, done.stderr
    theirs = pandas.read_csv(tmp_path / "theirs/map.csv", float_precision="round_trip")
    pandas.testing.assert_frame_equal(ours, theirs, check_exact=True)
    assert "points needed" in ours.attrs["summary"] and all(
        len(numbers) == 3 for numbers in reported
    )
    # Each continues the map of the other.
    again = swirl.parameter_map(tmp_path / "theirs")
    pandas.testing.assert_frame_equal(ours, again, check_exact=True)
    # Both grow alike, and keep their runs.
    larger = swirl.parameter_map(tmp_path / "ours", grow=True, x="mu=0:1.5", steps=7, replicates=8)
    done = command(
        "map",
        "--out",
        tmp_path / "theirs",
        "--grow",
        "--x",
        "mu=0:1.5",
        "--steps",
        7,
        "--replicates",
        8,
        "--no-figure",
        "--quiet",
    )
    assert done.returncode == 0, done.stderr
    theirs = pandas.read_csv(tmp_path / "theirs/map.csv", float_precision="round_trip")
    pandas.testing.assert_frame_equal(larger, theirs, check_exact=True)
    assert larger["mu"].max() == 1.5 and len(larger) > len(ours)
    with pytest.raises(ValueError, match="all else stays"):
        swirl.parameter_map(tmp_path / "ours", grow=True, x="mu=0:2", mu_wall=1)
    with pytest.raises(ValueError, match="not an axis"):
        swirl.parameter_map(tmp_path / "ours", grow=True, x="period=1:2")
    with pytest.raises(ValueError, match="maps of N_c"):
        swirl.parameter_map(tmp_path / "ours", grow=True, max_discs=60)


def test_the_range_of_a_map_of_crossings_grows(tmp_path):
    call = dict(quantity="N_c", periods=40, tolerance=5)
    table = swirl.parameter_map(tmp_path / "map", x=("mu", [1]), min_discs=24, max_discs=30, **call)
    assert table["verdict"].tolist() == ["always rotates"]
    with pytest.raises(ValueError, match="24 to 30"):
        swirl.parameter_map(tmp_path / "map", grow=True, max_discs=29)
    table = swirl.parameter_map(tmp_path / "map", grow=True, max_discs=46)
    assert table["verdict"].tolist() == ["crosses"] and 30 < table["N_c"][0] < 46


def test_failed_runs_of_a_map_are_reported():
    with pytest.warns(swirl.SweepWarning, match="inelastic collapse"):
        table = swirl.parameter_map(
            x=("restitution", [0.1, 1]), contact_duration=0, periods=10, replicates=2
        )
    assert table["failed"].tolist() == [2, 0]


@pytest.mark.parametrize(
    "wrong, kind",
    [
        (dict(), ValueError),
        (dict(replicates=3), ValueError),
        (dict(x="mu"), TypeError),
        (dict(x=("mu", 1, 2)), TypeError),
        (dict(x="mu=1:0"), ValueError),
        (dict(x="mu=0:1", y="mu=0:1"), ValueError),
        (dict(x="mu=0:1", quantity="slip"), ValueError),
        (dict(x="mu=0:1", steps=1), ValueError),
        (dict(x="mu=0:1", replicates=0), ValueError),
        (dict(x="mu=0:1", discs=[3, 4]), TypeError),
        (dict(x="mu=0:1", quantity="N_c", discs=30), ValueError),
    ],
)
def test_invalid_maps_are_rejected(wrong, kind, tmp_path):
    with pytest.raises(kind):
        swirl.parameter_map(tmp_path / "map", **wrong)
    assert not os.path.exists(tmp_path / "map")


def test_map_has_the_seeds_of_a_sweep(tmp_path):
    reported = []
    results = swirl.map(
        discs=[5, 9],
        mu=[0.1, 1],
        events=4000,
        replicates=2,
        measure=["slip"],
        progress=lambda done, runs: reported.append((done, runs)),
    )
    assert [(r.config["discs"], r.config["mu_disc"]) for r in results] == [
        (n, mu) for n in (5, 9) for mu in (0.1, 1) for _ in range(2)
    ]
    assert reported == [(k, 8) for k in range(1, 9)]
    command(
        "sweep",
        "--discs",
        "5,9",
        "--mu",
        "0.1,1",
        "--events",
        "4000",
        "--replicates",
        "2",
        "--out",
        tmp_path,
        "--quiet",
    )
    hashes = []
    for name in sorted(os.listdir(tmp_path / "results")):
        with open(tmp_path / "results" / name) as file:
            hashes.append(json.load(file)["state_hash"])
    assert [r.state_hash for r in results] == hashes
    assert all("slip" in r.measured for r in results)


def test_map_takes_custom_measurements_and_raises_their_errors():
    class Fast:
        def sample(self, snapshot):
            return float(np.hypot(*snapshot.velocity.T).max())

    found = swirl.map(discs=[5, 6], events=5000, measure=[Fast])
    assert all(r.measured["Fast"].estimate.mean > 0 for r in found)

    def broken(snapshot):
        raise LookupError("no")

    with pytest.raises(LookupError):
        swirl.map(discs=[5, 6], events=[5000, 10**10], measure=[broken])


@pytest.mark.parametrize(
    "call",
    (
        lambda folder: swirl.sweep(folder, mu=[0, 1], events=1000),
        lambda folder: swirl.collect(folder),
        lambda folder: swirl.parameter_map(folder, x="mu=0:1"),
    ),
)
def test_a_missing_package_is_reported_before_the_first_run(tmp_path, monkeypatch, call):
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(ImportError, match="needs the package pandas.*\nhint: pip install pandas"):
        call(tmp_path / "study")
    assert not list(tmp_path.iterdir())


def test_a_crossing_of_lists_is_a_table(tmp_path):
    call = {"min_discs": 5, "max_discs": 7, "tolerance": 5, "events": 1000, "warmup": 2}
    table = swirl.crossing(tmp_path, mu=[0.5, 1], container_radius=np.array([8.6]), **call)
    assert table["mu"].tolist() == [0.5, 1] and table["container_radius"].tolist() == [8.6, 8.6]
    assert table["from"].tolist() == [5, 5] and table["to"].tolist() == [7, 7]
    alone = swirl.crossing(mu=1, container_radius=8.6, **call)
    assert table["verdict"][1] == alone.verdict
    assert table.attrs["searches"][1].found["points"] == alone.found["points"]


def test_points_are_compared_with_a_table(tmp_path):
    rows = [
        {
            "discs": n,
            "mu": mu,
            "replicates": 1,
            "mean_by_time": 0.3 - mu * n / 40,
            "mean_by_time_error": 0.001,
        }
        for mu in (0.4, 0.2)
        for n in (32, 8, 16)
    ]
    table = pandas.DataFrame(rows)
    points = {"N": [8, 24, 60], "rate": [0.24, 0.12, 1], "error": [0.01, 0.01, 0.1]}
    found = swirl.compare_points(points, table)
    assert found.parameter == "mu" and found.left_out == 1 and found.freedom == 1
    assert found.value == pytest.approx(0.3, abs=1e-3) and found.lower < 0.3 < found.upper
    assert list(found.curves) == ["mu = 0.2", "mu = 0.4"] and str(found).startswith("mu = 0.3 ± ")
    file = tmp_path / "mine.csv"
    pandas.DataFrame(points).to_csv(file, index=False)
    for same in (file, pandas.DataFrame(points)):
        assert swirl.compare_points(same, table) == found
    counted = swirl.compare_points([(8, 4.8, 20), (24, 2.4, 20)], table[table["mu"] == 0.2])
    assert counted.parameter is None and np.isnan(counted.value) and len(counted.points) == 2
    assert found.plot() is not None
    with pytest.raises(ValueError, match="line 3"):
        swirl.compare_points([(8, 4.8, 20), (24, 2.4, 0)], table)


def test_a_sweep_in_steps_is_that_of_one_call(tmp_path):
    points = [{"discs": 8}, {"discs": 12, "replicates": 2}]
    whole = swirl.sweep(tmp_path / "whole", points=points, measure="slip", events=3000)
    steps = swirl.SweepFolder(tmp_path / "steps")
    assert not steps.is_planned and "without a plan" in repr(steps)
    steps.plan(points=[{"discs": 8, "events": 3000}], measure=["slip"])
    steps.grow(points=[{"discs": 12, "replicates": 2, "events": 3000}])
    with pytest.raises(swirl.Failure, match="holds another sweep"):
        steps.plan(points=[{"discs": 9}])
    counts = steps.run(points=[{"discs": 8, "events": 3000}], threads=1)
    assert counts == (1, 0, 0, "")
    done, planned = steps.files(
        [{"discs": 8, "events": 3000}, {"discs": 12, "replicates": 2, "events": 3000}]
    )
    assert [os.path.exists(file.result) for file in [*done, *planned]] == [True, False, False]
    assert steps.files([{"discs": 9, "events": 3000}]) == [[]]
    assert steps.run().failed == 0 and steps.is_planned
    pandas.testing.assert_frame_equal(swirl.collect(steps.path), whole)


def test_keys_and_parameters_of_a_run():
    parameters = {"preset": "experiment", "discs": 9, "events": 2000}
    result = swirl.run(**parameters)
    assert swirl.resolve(**parameters) == json.loads(result.to_json())["config"]
    assert swirl.version() == json.loads(result.to_json())["version"]
    key = swirl.run_identity(discs=48)
    assert key == swirl.run_identity(mu=1, discs=48) != swirl.run_identity(discs=47)
    assert swirl.checksum("123456789") == "995dc9bbdf1939fa"  # src/swirl/io/checksum.hpp
    with pytest.raises(TypeError, match="did you mean 'discs'"):
        swirl.run_identity(disc=48)


def test_a_series_and_directions_have_the_means_of_the_program():
    result = swirl.run(discs=24, periods=60, warmup=10, measure="centre", series=True)
    averages = json.loads(result.to_json())["series"]["averages"]["rigid_by_time"]
    spins = result.series["rigid_by_time"][result.series["counted"] > 0]
    found = swirl.series_mean(spins)
    assert found.blocks == len(spins) == 50
    # The program's series has weights and sums in another order.
    assert found.mean == pytest.approx(averages["mean"], rel=1e-9)
    assert found.error == pytest.approx(averages["error"], rel=1e-9)
    time = averages["autocorrelation_time"]
    assert found.details["autocorrelation_time"] == pytest.approx(time, rel=1e-9)
    assert swirl.is_direction("centre.theta") and not swirl.is_direction("slip.cluster")
    with pytest.raises(TypeError, match="name is 3"):
        swirl.is_direction(3)


def test_mean_is_the_mean_of_a_sweep(tmp_path):
    table = swirl.sweep(tmp_path / "sweep", discs=8, events=[3000], warmup=1, replicates=3)
    found = swirl.map(discs=8, events=[3000], warmup=1, replicates=3)
    rates = [run.rotation.mean_by_time for run in found]
    mean = swirl.mean(
        [r.mean for r in rates],
        [r.error for r in rates],
        periods=[run.periods - run.warmup for run in found],
        effective_samples=[r.effective_samples for r in rates],
    )
    assert mean.mean == pytest.approx(table["mean_by_time"][0], rel=1e-12)
    assert mean.error == pytest.approx(table["mean_by_time_error"][0], rel=1e-9)
    # Short runs are left out, unless all are short.
    assert swirl.mean([1, 3, 99], periods=[10, 10, 2]).mean == 2
    assert swirl.mean([1, 3], periods=[1, 3], by_time=False).mean == 2
    assert swirl.mean([[1, 3], [2, 4]]).mean.tolist() == [2, 3]
    assert np.cos(np.radians(swirl.mean([350, 10], directions=True).mean)) == pytest.approx(1)
