"""swirl.run() gives what `swirl run` gives, and refuses what it refuses, in the same words."""

import copy
import csv
import json
import math
import os
import pickle
import re
import signal
import subprocess
import sys

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import swirl
from scenes import SCENES, command, options, result_of, without_time


@pytest.mark.parametrize("scene", SCENES, ids=lambda scene: " ".join(options(scene)))
def test_json_is_that_of_the_command_line(scene):
    ours = swirl.run(**scene, events=30000)
    theirs = result_of(scene, "--events", 30000)
    assert ours.state_hash == theirs["state_hash"]
    assert without_time(json.loads(ours.to_json())) == without_time(theirs)
    assert list(json.loads(ours.to_json())) == list(theirs)


def test_what_the_result_says_is_what_the_json_says():
    r = swirl.run(discs=12, mu=0.5, events=20000)
    found = json.loads(r.to_json())
    assert r.config == found["config"]
    assert r.rotation.mean_by_time.mean == found["rotation"]["mean_by_time"]["mean"]
    assert r.rotation.rigid_by_event.error == found["rotation"]["rigid_by_event"]["error"]
    assert r.events.total == 20000 == r.events.disc_disc + r.events.disc_wall + r.events.path_vertex
    assert r.complete and r.steady_state == found["steady_state"]["verdict"]
    assert re.fullmatch("[0-9a-f]{16}", r.state_hash)
    assert float(r.rotation.mean_by_time) == r.rotation.mean_by_time.mean
    assert "12 discs rotate with the swirl" in repr(r) and "12 discs rotate" in r._repr_html_()
    assert pickle.loads(pickle.dumps(r)).to_json() == r.to_json()


@pytest.mark.parametrize(
    "copied",
    [lambda found: pickle.loads(pickle.dumps(found)), copy.deepcopy],
    ids=["pickled", "copied"],
)
def test_measurements_can_be_sent_to_another_process(copied):
    r = swirl.run(discs=12, events=20000, measure="all")
    again = copied(r)
    assert str(again) == str(r) and list(again.measured) == list(r.measured)
    for name, found in r.measured.items():
        # As text, for NaN is not equal to itself.
        assert repr(dict(again.measured[name].rows)) == repr(dict(found.rows))
        for table, values in found.tables.items():
            theirs = again.measured[name].tables[table]
            assert theirs.units == values.units and theirs.description == values.description
            np.testing.assert_array_equal(np.asarray(theirs), np.asarray(values))
            assert not theirs[theirs.columns[-1]].flags.writeable


def test_values_that_are_not_available_are_nan():
    r = swirl.run(discs=3, events=20)
    assert r.rotation.mean_by_time.blocks == 0 and math.isnan(r.rotation.mean_by_time.mean)


def test_saved_result_can_be_verified(tmp_path):
    swirl.run(discs=20, mu=0.3, events=20000, measure="slip").save(tmp_path / "r.json")
    done = command("verify", tmp_path / "r.json")
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.parametrize(
    "scene",
    [
        dict(discs=45, events=60000, seed=4),
        dict(preset="experiment", discs=24, periods=20),
        dict(discs=24, periods=20, mixture="25%:0.75", direction="clockwise"),
    ],
    ids=["discs", "spheres", "mixture"],
)
def test_every_measurement_equals_the_tables_of_the_command_line(scene, tmp_path):
    r = swirl.run(**scene, measure="all")
    done = command("run", *options(scene), "--measure", "all", "--tables", tmp_path, "--quiet")
    assert done.returncode == 0, done.stderr
    assert set(r.measured) == set(swirl.measurements())
    with open(tmp_path / "numbers.csv") as file:
        rows = {row["quantity"]: row for row in csv.DictReader(file)}
    tables = {name[:-4] for name in os.listdir(tmp_path)} - {"numbers"}
    compared = 0
    for name, measured in r.measured.items():
        for row, estimate in measured.rows.items():
            theirs = rows.pop(f"{name}.{row}")
            for column in ("mean", "error"):
                ours = getattr(estimate, column)
                assert (
                    math.isnan(ours) if theirs[column] == "" else ours == float(theirs[column])
                ), (name, row)
            assert estimate.unit == theirs["unit"]
        for table_name, table in measured.tables.items():
            file = f"{name}.{table_name}" if table_name else name
            theirs = np.genfromtxt(tmp_path / f"{file}.csv", delimiter=",", names=True)
            tables.remove(file)
            assert list(theirs.dtype.names) == table.columns
            for column in table:
                np.testing.assert_array_equal(table[column].ravel(), theirs[column])
                compared += 1
    assert not rows and not tables and compared > 30


def test_density_map_has_axes():
    density = swirl.run(discs=30, events=60000, measure="density").measured["density"]
    assert density["by_time"].shape == (100, 100)
    axes = density.table.axes
    assert list(axes) == ["y", "x"] and axes["x"][0] == pytest.approx(-axes["x"][-1])
    # The map contains all thirty discs.
    cell = (axes["x"][1] - axes["x"][0]) ** 2
    assert density["by_time"].sum() * cell == pytest.approx(30, rel=1e-9)
    with pytest.raises(ValueError):
        density["by_time"][0, 0] = 1
    with pytest.raises(KeyError, match="by_time"):
        density["by_tim"]
    set_ = density.table.to_xarray()
    assert set_["by_time"].dims == ("y", "x") and set_["by_time"].attrs["units"] == "1/r²"
    assert list(density.table.to_pandas().columns) == density.table.columns


BAD = [
    dict(discs=0),
    dict(discs=-5),
    dict(discs=2.5),
    dict(discs="many"),
    dict(mu=-1),
    dict(mu="nan"),
    dict(mu_disc=-0.1),
    dict(container_radius=2, discs=40),
    dict(container_radius=0.5),
    dict(restitution=1.5),
    dict(inertia="iron"),
    dict(mixture="12"),
    dict(mixture=(12, 0)),
    dict(mixture=(60, 1.2)),
    dict(motion="square"),
    dict(motion="circle", sides=7),
    dict(sides=2),
    dict(events=10, periods=3),
    dict(periods=3, warmup=3),
    dict(warmup="long"),
    dict(seed=-1),
    dict(seed=2**64),
    dict(speed=1, amplitude=1, period=1),
    dict(period=0),
    dict(amplitude=1e9),
    dict(preset="other"),
    dict(body="sphere", motion="circle"),
    dict(body="sphere", discs=65),
    dict(floor="sliding", motion="circle"),
    dict(contact_duration=100),
    dict(events=0),
    dict(events=1e20),
]


@pytest.mark.parametrize("bad", BAD, ids=lambda bad: " ".join(options(bad)))
def test_errors_equal_those_of_the_command_line(bad):
    done = command("run", *options(bad))
    assert done.returncode == 2, done.stdout + done.stderr
    with pytest.raises(ValueError) as raised:
        swirl.run(**bad)
    words = lambda text: re.sub(r"[-_]+", " ", text).split()
    said = words(str(raised.value))
    # The command line gets numbers as text; for Python, 2.5 and 2.50 are the same number.
    assert said == words(done.stderr.removeprefix("error: "))
    assert "--" not in str(raised.value)


@pytest.mark.parametrize(
    "bad, sentence",
    [
        (dict(disks=3), "no parameter 'disks'.\nhint: did you mean 'discs'\\?$"),
        (
            dict(flavour=3),
            "no parameter 'flavour'.\nhint: swirl.parameters\\(\\) lists all parameters.",
        ),
        (dict(mu=True), "mu is True, but it must be a number or a text."),
        (dict(mu=[0.1, 0.5]), "mu is \\[0.1, 0.5\\], but it must be one number or text"),
        (dict(mu=1j), "mu is 1j, but"),
        (dict(mu=object), "mu is <class 'object'>, but"),
        (dict(mu=b"1"), "mu is b'1', but"),
        (dict(mu=np.array([1.0])), "mu is array"),
        (dict(measure=[3]), "measure contains 3, but each element must be a name"),
    ],
)
def test_wrong_types_and_names_are_rejected(bad, sentence):
    with pytest.raises(TypeError, match=sentence):
        swirl.run(events=10, **bad)


def test_unknown_measurements_are_rejected():
    with pytest.raises(
        ValueError, match="measure has 'dens' in its list, but each must be one of: d"
    ):
        swirl.run(events=10, measure="dens")


def test_numpy_scalars_are_accepted():
    r = swirl.run(
        discs=np.int64(7), mu=np.float64(0.25), events=np.float32(1000), seed=np.uint64(3)
    )
    assert r.state_hash == swirl.run(discs=7, mu=0.25, events=1000, seed=3).state_hash


def test_none_counts_as_not_given():
    assert (
        swirl.run(discs=7, mu=None, events=1000).state_hash
        == swirl.run(discs=7, events=1000).state_hash
    )


anything = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(),
    st.floats(),
    st.text(max_size=8),
    st.complex_numbers(),
    st.binary(max_size=4),
    st.tuples(st.integers(), st.floats()),
    st.lists(st.integers(), max_size=3),
    st.sampled_from([1, 2, 5, 0.5, "1e2", "12:1.3", "circle", "ring", (3, 0.7), np.float64(2)]),
)


@settings(
    max_examples=300,
    deadline=None,
    derandomize=True,
    database=None,
    suppress_health_check=list(HealthCheck),
)
@given(
    st.dictionaries(
        st.sampled_from([p.name for p in swirl.parameters()] + ["nonsense", "", "--mu"]),
        anything,
        max_size=4,
    )
)
def test_random_arguments_run_or_are_rejected_with_a_message(given_):
    length = {} if {"events", "periods"} & set(given_) else {"events": 50}
    # Larger values are valid, but the run would take too long.
    for name, most in (("events", 5000), ("periods", 3), ("discs", 200)):
        value = given_.get(name)
        if isinstance(value, (int, float)) and value > most:
            given_[name] = most
    try:
        swirl.run(**given_, **length)
    except (TypeError, ValueError, swirl.Failure) as error:
        text = str(error)
        assert text.endswith((".", "?", ")")) and "--" not in text.replace("--mu'", ""), text


def test_docstring_lists_every_parameter():
    for p in swirl.parameters():
        assert f"    {p.name}: " in swirl.run.__doc__
    import inspect

    assert {"discs", "mu", "seed", "measure"} <= set(inspect.signature(swirl.run).parameters)


# --- custom measurements ------------------------------------------------------------------------


class MeanX:
    """Mean position of the discs in the M-frame."""

    def sample(self, snapshot):
        x, y = snapshot.m_frame().position.mean(axis=0)
        return {"x": x, "y": y}


class MeanXByBlock:
    name = "by_block"

    def block(self, frames):
        x, y = frames.m_frame().position.mean(axis=(0, 1))
        return {"x": x, "y": y}


def test_custom_measurements_by_sample_and_by_block_agree_with_built_in_ones():
    scene = dict(discs=20, events=30000, seed=2)
    r = swirl.run(**scene, measure=["centre", MeanX, MeanXByBlock()])
    alone = swirl.run(**scene, measure="centre")
    assert without_time(json.loads(r.to_json())) == without_time(json.loads(alone.to_json())) | {}
    built_in = r.measured["centre"]
    for name in ("x", "y"):
        sampled, block = r.measured["MeanX"][name], r.measured["by_block"][name]
        assert sampled.mean == pytest.approx(block.mean, rel=1e-12)
        assert sampled.error == pytest.approx(block.error, rel=1e-9)
        assert sampled.blocks == r.rotation.mean_by_time.blocks
        assert sampled.error > 0
    # `centre` takes each sample seven samples later, when it is known which discs are pinned
    # (observation.hpp). It misses seven of ten thousand samples at the end of the run.
    assert built_in["x"].mean == pytest.approx(r.measured["MeanX"]["x"].mean, abs=1e-3 * 8.6)
    assert built_in["x"].error == pytest.approx(r.measured["MeanX"]["x"].error, rel=0.05)


def test_custom_measurement_may_be_a_function_and_return_arrays():
    def speeds(snapshot):
        return np.hypot(*snapshot.velocity.T)

    found = swirl.run(discs=6, events=20000, measure=[speeds]).measured["speeds"].estimate
    assert found.mean.shape == found.error.shape == (6,)
    assert np.all(found.error > 0) and np.all((found.mean > 0.1) & (found.mean < 10))


def test_exceptions_of_custom_measurements_are_raised():
    class Broken:
        def block(self, frames):
            raise LookupError("not today")

    with pytest.raises(LookupError, match="not today"):
        swirl.run(discs=6, events=20000, measure=[Broken])

    class Changing:
        def block(self, frames):
            return np.zeros(int(frames.whole_periods[0]) % 3 + 1)

    with pytest.raises(ValueError, match="different shapes"):
        swirl.run(discs=6, events=20000, measure=[Changing])

    # Also within the first period, when no block has been stored yet.
    class ChangingAtOnce:
        samples = 0

        def sample(self, snapshot):
            self.samples += 1
            return np.zeros(self.samples % 2 + 1)

    with pytest.raises(ValueError, match="different shapes"):
        swirl.run(discs=6, events=20000, measure=[ChangingAtOnce])


def test_frames_outlive_the_run():
    stored = []

    class Store:
        def block(self, frames):
            stored.append((frames, frames.position, frames[3].velocity))

    swirl.run(discs=6, events=20000, measure=[Store])
    frames, position, velocity = stored[0]
    assert position.shape == (511, 6, 2) and np.array_equal(velocity, frames.velocity[3])
    assert len({k[1].ctypes.data for k in stored}) == len(stored)


# --- threads, signals, files --------------------------------------------------------------------


def test_progress_is_reported_and_may_raise():
    reported = []
    swirl.run(discs=48, events=1500000, progress=lambda *what: reported.append(what))
    assert reported == sorted(reported)
    assert all(0 <= fraction <= 1 for fraction, _, _ in reported)

    def stop(fraction, events, periods):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        swirl.run(discs=48, events=1e9, progress=stop)


# Another thread sends the signal after a hundred steps of its own, while the call works: the engine
# does not block other threads. A call that missed the signal would not end, or would end without an
# exception.
INTERRUPTED = """
import swirl, os, signal, threading, time
def interrupt():
    begin, steps = time.process_time(), 0
    while steps < 100 or time.process_time() < begin + 0.3:
        time.sleep(0.005)
        steps += 1
    os.kill(os.getpid(), signal.SIGINT)
threading.Thread(target=interrupt).start()
try:
    {call}
except KeyboardInterrupt as raised:
    print(type(raised).__name__, {found})
"""


@pytest.mark.parametrize(
    "call, found, said",
    [
        (
            "swirl.run(discs=48, events=1e12)",
            "raised.result.events.total > 1000, raised.result.complete",
            "Interrupted True False",
        ),
        ("swirl.run(discs=7000000, container_radius=3300)", "1", "KeyboardInterrupt 1"),
        (
            "sim = swirl.Simulation(discs=48); sim.advance(periods=1e9)",
            "sim.periods > 0.1, sim.step(10)['time'][0] > 0",
            "KeyboardInterrupt True True",
        ),
        (
            "sim = swirl.Simulation(discs=48); sim.step(10**6); sim.advance(events=1e12)",
            "sim.counts.total > 10**5",
            "KeyboardInterrupt True",
        ),
    ],
)
def test_ctrl_c_interrupts(call, found, said):
    done = subprocess.run(
        [sys.executable, "-B", "-c", INTERRUPTED.format(call=call, found=found)],
        capture_output=True,
        text=True,
    )  # no call ends by itself
    assert done.returncode == 0, done.stderr
    assert done.stdout.split() == said.split()


def test_recordings_equal_those_of_the_command_line(tmp_path):
    import h5py

    scene = dict(discs=12, events=20000)
    ours = swirl.run(
        **scene, trajectory=tmp_path / "ours.h5", frames_per_period=20, event_log=tmp_path / "e.h5"
    )
    done = command(
        "run", *options(scene), "--trajectory", tmp_path / "theirs.h5", "--frames-per-period", 20
    )
    assert done.returncode == 0, done.stderr
    with h5py.File(tmp_path / "ours.h5") as a, h5py.File(tmp_path / "theirs.h5") as b:
        path = "particles/trajectory/position/value"
        np.testing.assert_array_equal(a[path][:], b[path][:])
    with h5py.File(tmp_path / "e.h5") as file:
        assert len(file["events/clock"]) == 20000
    assert ours.state_hash == swirl.run(**scene).state_hash
    with pytest.raises(FileExistsError, match="already exists"):
        swirl.run(**scene, trajectory=tmp_path / "ours.h5")
    swirl.run(**scene, trajectory=tmp_path / "ours.h5", overwrite=True)
    with pytest.raises(ValueError, match="cannot have custom measurements"):
        swirl.run(**scene, trajectory=tmp_path / "more.h5", measure=[MeanX])


def test_impossible_runs_raise_failures(tmp_path):
    with pytest.raises(swirl.FileError):
        swirl.run(discs=5, events=100, trajectory=tmp_path / "no" / "such" / "folder.h5")
    with pytest.raises(swirl.Failure, match="within the warm-up of warmup 400"):
        swirl.run(discs=48, events=20000, warmup=400)


def test_the_series_is_that_of_the_command_line(tmp_path):
    given = {"discs": 16, "mu": 0.5, "periods": 20}
    file = tmp_path / "s.csv"
    ours = swirl.run(**given, measure="slip", series=True, ramp="amplitude=1:2@3..12")
    written = swirl.run(**given, measure="slip", series=file, ramp=("amplitude=1:2@3..12",))
    with open(file, newline="") as opened:
        rows = list(csv.DictReader(opened))
    assert list(ours.series) == list(rows[0])
    for name, values in ours.series.items():
        assert np.array_equal(values, [float(row[name] or "nan") for row in rows], equal_nan=True)
        assert np.array_equal(values, written.series[name], equal_nan=True)
    assert ours.series["ramp.amplitude"][[0, 3, 12, 19]].tolist() == [1, 1, 2, 2]
    assert ours.series["events"].sum() == ours.events.total
    assert ours.autocorrelation_times["mean_by_time"] >= 1
    assert ours.fluctuations == {}
    assert swirl.run(**given).series is None
    copied = pickle.loads(pickle.dumps(ours.series))
    assert np.array_equal(copied["energy"], ours.series["energy"])


def test_the_fluctuations_of_a_series_are_estimates():
    r = swirl.run(discs=16, periods=60, series=True)
    counted = r.series["counted"] == 1
    values = r.series["rigid_by_time"][counted]
    found = r.fluctuations["rigid_by_time"]
    tau = r.autocorrelation_times["rigid_by_time"]
    assert found["correlation_time"].mean == tau
    assert found["n_variance"].mean == pytest.approx(
        16 * values.var() / (1 - tau / len(values)), rel=1e-10
    )
    assert found["binder"].mean == pytest.approx(
        1 - ((values - values.mean()) ** 4).mean() / (3 * values.var() ** 2), abs=1e-12
    )
    assert set(r.fluctuations) >= {"mean_by_time", "spin", "energy"}


def test_a_ramp_is_rejected_where_it_cannot_be():
    with pytest.raises(ValueError, match="property of the particles"):
        swirl.run(ramp="inertia=1:2@3..4")
    square = [(1, 1), (-1, 1), (-1, -1), (1, -1)]
    with pytest.raises(ValueError, match="path defines the path"):
        swirl.Simulation(discs=5, motion=square, ramp="amplitude=1:2@3..4")
    with pytest.raises(ValueError, match="needs a steady state"):
        swirl.crossing(ramp="mu=0:1@3..4")
    with pytest.raises(ValueError, match="must end in .csv"):
        swirl.run(series="s.json")
