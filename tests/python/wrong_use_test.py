"""Wrong uses of the module: each raises an exception with a short sentence, and no assignment is
ignored."""

import copy
import pathlib
import pickle

import numpy as np
import pytest

import objects
import swirl
import swirl.plot
from objects import COLUMNS, DISH, public_classes

HALF = "\ud800"
LONG = "x" * 100_000


@pytest.fixture(scope="module")
def instances(tmp_path_factory):
    """An object of each public class."""
    return objects.instances(tmp_path_factory.mktemp("wrong_use"))


@pytest.mark.parametrize("kind", public_classes(), ids=lambda kind: kind.__name__)
def test_an_assignment_without_effect_raises_what_to_do(kind, instances):
    one = instances[kind]
    with pytest.raises(AttributeError, match="^swirl.* has no attribute 'muu'.\nhint: "):
        one.muu = 0


def test_parameters_of_a_simulation_cannot_be_assigned(instances):
    sim = instances[swirl.Simulation]
    for name in ("mu", "discs", "restitution"):
        with pytest.raises(
            AttributeError,
            match=rf"^{name} cannot be assigned: .*\nhint: .*swirl.Simulation\({name}=",
        ):
            setattr(sim, name, 0)
    with pytest.raises(
        AttributeError, match="^clock of swirl.Simulation cannot be assigned.\nhint: "
    ):
        sim.clock = 0.0
    with pytest.raises(AttributeError, match="hint: did you mean clock"):
        sim.clok = 0.0


def test_subclasses_have_attributes_of_their_own():
    class Mine(swirl.Simulation):
        def __init__(self, **parameters):
            super().__init__(**parameters)
            self.note = "mine"

    assert Mine(discs=3).note == "mine"


def test_objects_without_a_dictionary_are_copied_and_pickled(instances):
    result = instances[swirl.Result]
    for one in (result, instances[swirl.Lab], instances[swirl.Trajectory].parameters):
        for other in (copy.copy(one), copy.deepcopy(one), pickle.loads(pickle.dumps(one))):
            assert type(other) is type(one)
    assert copy.deepcopy(result).state_hash == result.state_hash


WRONG = {
    "plot.snapshot": (
        lambda: swirl.plot.snapshot(swirl.run(discs=3, events=100)),
        TypeError,
        "must be a swirl.Snapshot or a swirl.Simulation",
    ),
    "plot.density": (
        lambda: swirl.plot.density(5),
        TypeError,
        "found is 5, but it must be a result",
    ),
    "plot.rotation": (lambda: swirl.plot.rotation(5), TypeError, "runs must be the table"),
    "plot.table": (
        lambda: swirl.plot.table(5),
        TypeError,
        "found is 5, but it must be a swirl.Table",
    ),
    "plot.measured": (
        lambda: swirl.plot.measured([LONG]),
        TypeError,
        "found is .*, but it must be a measurement",
    ),
    "plot.series": (
        lambda: swirl.plot.series(None),
        TypeError,
        "found is None, but it must be a swirl.Series",
    ),
    "plot.crossing": (
        lambda: swirl.plot.crossing(38.2),
        TypeError,
        "found is 38.2, but it must be a swirl.Crossing",
    ),
    "plot.result": (
        lambda: swirl.plot.result("a.json"),
        TypeError,
        "found is 'a.json', but it must be a result",
    ),
    "column of a table": (
        lambda: swirl.analyse(swirl.Simulation(discs=3).sample(2), "profile").plot(LONG),
        ValueError,
        "the result has no '",
    ),
    "analyse a table": (
        lambda: swirl.analyse(COLUMNS),
        TypeError,
        "needs omega and container_radius.\nhint: ",
    ),
    "analyse with a scale": (
        lambda: swirl.analyse(swirl.Simulation(discs=3).sample(2), scale=LONG),
        TypeError,
        "scale is given, but only a table",
    ),
    "zero_crossing without errors": (
        lambda: swirl.zero_crossing([3, 5], [0.1, -0.1]),
        TypeError,
        "rates contains 0.1, which has no error.\nhint: ",
    ),
    "zero_crossing of texts": (
        lambda: swirl.zero_crossing([3, LONG], [0.1, -0.1], [1, 1]),
        TypeError,
        "discs is .3, 'xxx",
    ),
    "zero_crossing, lengths": (
        lambda: swirl.zero_crossing([3], [0.1, -0.1], [1, 1]),
        ValueError,
        "the same length",
    ),
    "Tracks of a number": (
        lambda: swirl.Tracks(5, **DISH),
        TypeError,
        "table is 5, but it must be a DataFrame",
    ),
    "Tracks of a text": (
        lambda: swirl.Tracks("a.csv", **DISH),
        TypeError,
        "hint: read a file with swirl.Tracks.read",
    ),
    "Tracks of a list": (
        lambda: swirl.Tracks([1, 2], **DISH),
        ValueError,
        "columns frame, particle, x and y",
    ),
    "Tracks.read": (
        lambda: swirl.Tracks.read(5),
        TypeError,
        "file is 5, but it must be the name of a file",
    ),
    "load": (lambda: swirl.load(5), TypeError, "file is 5, but it must be the name of a file"),
    "save": (lambda: swirl.Simulation(discs=3).save(5), TypeError, "file is 5"),
    "trajectory": (
        lambda: swirl.run(discs=3, events=10, trajectory=5),
        TypeError,
        "trajectory is 5",
    ),
    "sweep": (lambda: swirl.sweep(5, discs=[3]), TypeError, "out is 5"),
    "measure": (
        lambda: swirl.run(discs=3, events=10, measure=[5]),
        TypeError,
        "measure contains 5",
    ),
    "rate": (lambda: swirl.crossing(rate=5), TypeError, "rate is 5, but it must be a text"),
    "half in discs": (lambda: swirl.run(discs=HALF), ValueError, "half of a surrogate pair"),
    "half in a name": (lambda: swirl.run(**{HALF: 1}), ValueError, "half of a surrogate pair"),
    "half in measure": (
        lambda: swirl.run(discs=3, measure=HALF),
        ValueError,
        "measure is '\\\\ud800', but half of a",
    ),
    "half in trajectory": (
        lambda: swirl.run(discs=3, events=10, trajectory=HALF),
        ValueError,
        "trajectory is '.ud800'",
    ),
    "half in Trajectory": (lambda: swirl.Trajectory(HALF), ValueError, "half of a surrogate pair"),
    "half in Tracks": (lambda: swirl.Tracks.read(HALF), ValueError, "half of a surrogate pair"),
    "half in load": (lambda: swirl.load(HALF), ValueError, "half of a surrogate pair"),
    "half in out": (lambda: swirl.sweep(HALF, discs=[3]), ValueError, "half of a surrogate pair"),
    "half in collect": (lambda: swirl.collect(HALF), ValueError, "half of a surrogate pair"),
    "half in rate": (lambda: swirl.crossing(rate=HALF), ValueError, "half of a surrogate pair"),
    "half in points": (
        lambda: swirl.sweep(points=[{"discs": HALF}]),
        ValueError,
        "half of a surrogate pair",
    ),
    "comma in points": (
        lambda: swirl.sweep(points=[{"discs": 3, "mu": "0,5"}]),
        ValueError,
        "points, row 1: mu is '0,5', but it must be a number.\n"
        "hint: read decimal commas with pandas",
    ),
    "columns of points": (
        lambda: swirl.sweep(points=[{"discs": 3, "MU": 1, "mu": 1}]),
        ValueError,
        "two columns mu",
    ),
    "long discs": (lambda: swirl.run(discs=LONG), ValueError, "must be a"),
    "long name": (lambda: swirl.run(**{LONG: 1}), TypeError, "there is no parameter"),
    "long measure": (lambda: swirl.run(discs=3, measure=LONG), ValueError, "measure"),
    "long list": (lambda: swirl.run(mu=list(range(100_000))), TypeError, "mu is .0, 1, 2"),
    "long points": (lambda: swirl.sweep(points=LONG), TypeError, "points is 'xxx"),
    "long recording": (
        lambda: swirl.analyse(np.zeros((100, 100)).tolist()),
        TypeError,
        "recording is .*swirl.Trajectory",
    ),
    "long periods": (
        lambda: swirl.Simulation(discs=3).advance(periods=LONG),
        TypeError,
        "periods is 'xxx",
    ),
}


@pytest.mark.parametrize("case", WRONG)
def test_a_wrong_argument_raises_one_short_sentence(case, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    call, kind, says = WRONG[case]
    with pytest.raises(kind, match=says) as raised:
        call()
    message = str(raised.value)
    message.encode()
    assert len(message) < 1000, message[:1000]  # the list of all measurements has 400
    assert "incompatible function arguments" not in message
    assert list(pathlib.Path(tmp_path).iterdir()) == []


def test_names_of_columns_may_be_in_upper_case():
    upper = swirl.sweep(points=[{"Discs": 3, "MU": "0.5"}], events=300)
    lower = swirl.sweep(points=[{"discs": 3, "mu": 0.5}], events=300)
    assert list(upper["state_hash"]) == list(lower["state_hash"])
