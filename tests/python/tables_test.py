"""Every table as a table of pandas and xarray, every class as one line, as HTML and as a plot."""

import csv
import enum
import html
import math
import re

import matplotlib
import numpy as np
import pandas
import pytest

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

import objects  # noqa: E402
import swirl  # noqa: E402
from objects import MEASURE, SCENE  # noqa: E402
from scenes import command, options  # noqa: E402


@pytest.fixture(autouse=True)
def closed():
    yield
    plt.close("all")


@pytest.fixture(scope="module")
def instances(tmp_path_factory):
    """An object of each public class."""
    return objects.instances(tmp_path_factory.mktemp("tables"))


@pytest.fixture
def result(instances):
    return instances[swirl.Result]


def shown_classes():
    return [kind for kind in objects.public_classes() if not issubclass(kind, enum.Enum)]


# --- text and HTML --------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", shown_classes(), ids=lambda kind: kind.__name__)
def test_every_class_has_one_line(kind, instances):
    one = instances[kind]
    texts = (str(one), repr(one))
    assert any(
        "\n" not in text and len(text) < 400 and "object at 0x" not in text for text in texts
    ), texts


@pytest.mark.parametrize("kind", shown_classes(), ids=lambda kind: kind.__name__)
def test_every_class_has_a_view_in_notebooks(kind, instances):
    one = instances[kind]
    shown = one._repr_svg_() if hasattr(one, "_repr_svg_") else one._repr_html_()
    assert re.match(r"<(p|svg|iframe)\b", shown) and "object at 0x" not in shown
    assert len(re.findall(r"<table\b", shown)) == shown.count("</table>")


def test_html_shows_one_rate(result):
    shown = html.unescape(result._repr_html_())
    assert shown.count("ϖ/Ω") == 1 and "rigid" not in shown
    assert html.unescape(result.rotation._repr_html_()) == f"<p>{result.rotation}</p>"
    assert str(result.rotation) == f"ϖ/Ω = {swirl.with_error(*result.rotation.mean_by_time)}"
    assert len(str(result.rotation)) < 40 < 400 < len(repr(result.rotation))


# --- pandas and xarray ----------------------------------------------------------------------------


@pytest.mark.parametrize(
    "kind",
    [
        swirl.Table,
        swirl.Series,
        swirl.Measured,
        swirl.Rotation,
        swirl.Result,
        swirl.Analysis,
        swirl.Crossing,
        swirl.Snapshot,
        swirl.Frames,
    ],
    ids=lambda kind: kind.__name__,
)
def test_every_table_has_both_forms(kind, instances):
    one = instances[kind]
    frame, data = one.to_pandas(), one.to_xarray()
    assert isinstance(frame, pandas.DataFrame) and len(frame) > 0
    known = set(data.variables)
    for name in set(frame.columns) & known:
        ours = frame[name].to_numpy()
        theirs = np.asarray(data[name].values)
        if theirs.size == len(ours):
            np.testing.assert_array_equal(
                np.sort(ours.ravel()), np.sort(theirs.ravel()), err_msg=name
            )
    assert len(set(frame.columns) & known) > 0
    data.to_dataframe()


def test_numbers_are_those_of_the_command_line(result, tmp_path):
    done = command(
        "run", *options(SCENE), "--measure", ",".join(MEASURE), "--tables", tmp_path, "--quiet"
    )
    assert done.returncode == 0, done.stderr
    with open(tmp_path / "numbers.csv", newline="") as file:
        theirs = list(csv.DictReader(file))
    ours = result.to_pandas().set_index("quantity")
    for row in theirs:
        for column in ("mean", "error", "effective_samples", "blocks"):
            value = ours[column][row["quantity"]]
            assert value == float(row[column]) if row[column] else math.isnan(value), row
        assert ours["unit"][row["quantity"]] == row["unit"]
    mean, _ = result.rotation.mean_by_time
    assert ours["mean"]["rotation.mean_by_time"] == mean
    assert ours["mean"]["speeds.value[1]"] == result.measured["speeds"]["value"].mean[1]
    assert len(ours) == len(theirs) + 4 + 2


def test_frames_as_tables_hold_every_disc():
    frames = swirl.Simulation(discs=5).sample(periods=1, per_period=20)
    table = frames.to_pandas().set_index(["frame", "disc"])
    data = frames.to_xarray()
    for k, disc in ((0, 0), (7, 3), (19, 4)):
        x, y = frames.position[k, disc]
        assert (table.loc[(k, disc), "x"], table.loc[(k, disc), "y"]) == (x, y)
        assert (
            data["position"][k, disc].sel(xy="y") == y
            and table.loc[(k, disc), "time"] == frames.time[k]
        )
        assert (
            table.loc[(k, disc), "spin"]
            == frames.spin[k, disc]
            == frames[k].to_pandas()["spin"][disc]
        )
    assert len(table) == 100 and table["can_spin"].eq(1).all()


def test_units_go_with_the_tables(result):
    assert result.series.to_pandas().attrs["units"] == dict(result.series.units)
    assert result.measured["wall"]["profile"].to_pandas().attrs["units"]["pressure"]
    assert result.series.to_xarray()["energy"].attrs["units"] == result.series.units["energy"]


# --- a table of tracks ----------------------------------------------------------------------------


@pytest.fixture(scope="module")
def tracks():
    """Positions of a run as a camera sees them: pixels, y downwards."""
    sim = swirl.Simulation(discs=8)
    frames = sim.sample(periods=6, per_period=120)
    count, discs = frames.position.shape[:2]
    table = pandas.DataFrame(
        {
            "frame": np.repeat(np.arange(count), discs),
            "particle": np.tile(np.arange(discs), count),
            "x": 500 + 30 * frames.position[..., 0].ravel(),
            "y": 400 - 30 * frames.position[..., 1].ravel(),
        }
    )
    return table, {
        "omega": sim.omega,
        "container_radius": sim.container_radius,
        "amplitude": 1.892,
        "scale": 30.0,
        "camera_fps": 120 / sim.period,
        "centre": (500.0, 400.0),
    }


def test_a_table_is_analysed_as_its_tracks(tracks):
    table, camera = tracks
    expected = swirl.analyse(swirl.Tracks(table, **camera), ["density"], warmup=1)
    assert expected.frames > 500 and expected.measured["density"]["by_time"].max() > 0
    for same in (table, table.set_index(table.index + 5), table.to_dict("series")):
        assert repr(swirl.analyse(same, ["density"], warmup=1, **camera).rotation) == repr(
            expected.rotation
        )


def test_a_table_needs_the_scale_of_its_camera(tracks):
    table, camera = tracks
    with pytest.raises(
        TypeError, match="needs omega and container_radius.\nhint: use swirl.analyse"
    ):
        swirl.analyse(table)
    with pytest.raises(TypeError, match="needs container_radius.\nhint: "):
        swirl.analyse(table, omega=1)
    with pytest.raises(ValueError, match="columns frame, particle, x and y"):
        swirl.analyse(table.drop(columns="y"), **camera)
    with pytest.raises(ValueError, match="columns frame, particle, x and y"):
        swirl.analyse(swirl.Simulation(discs=3).sample(1, 20).to_pandas(), **camera)
    for recording in (swirl.Tracks(table, **camera), swirl.Simulation(discs=3).sample(1, 20)):
        with pytest.raises(
            TypeError, match="omega is given, but only a table of tracks needs it.*\nhint: "
        ):
            swirl.analyse(recording, omega=1.0)
    with pytest.raises(TypeError, match="must be a swirl.Trajectory"):
        swirl.analyse([1, 2])


def with_cell(table, row, column, value):
    changed = table.astype(object)
    changed.loc[row, column] = value
    return changed


WRONG_TABLES = {
    "a second header": (
        lambda t: with_cell(t, 17, "frame", "frame"),
        TypeError,
        "must hold numbers, but row 17 has 'frame'",
    ),
    "a missing value": (
        lambda t: with_cell(t, 17, "particle", None),
        TypeError,
        "particle of .* but row 17 has None",
    ),
    "NaN in x": (
        lambda t: with_cell(t, 17, "x", math.nan),
        ValueError,
        "row 17 of the tracks has no finite position",
    ),
    "NaN in frame": (
        lambda t: with_cell(t, 9, "frame", math.nan),
        ValueError,
        "whole numbers, but row 9 has nan",
    ),
    "half a frame": (
        lambda t: t.assign(frame=t["frame"] / 2),
        ValueError,
        "whole numbers, but row 8 has 0.5",
    ),
    "a decimal comma": (
        lambda t: with_cell(t, 3, "y", "1,5"),
        TypeError,
        "column y of .* but row 3 has '1,5'",
    ),
    "no y": (
        lambda t: t.drop(columns="y"),
        ValueError,
        "there is no y.\nhint: it has frame, particle, x.",
    ),
    "upper case": (
        lambda t: t.rename(columns=str.upper),
        ValueError,
        "there is no frame.\nhint: rename 'FRAME' to 'frame'",
    ),
    "two columns x": (
        lambda t: t.rename(columns={"y": "x"}),
        TypeError,
        "column x of the tracks must hold numbers, but it",
    ),
    "a row twice": (
        lambda t: pandas.concat([t, t.iloc[[5]]]),
        ValueError,
        "particle 5 appears twice in frame 0",
    ),
    "metres": (
        lambda t: t.assign(x=t["x"] / 1e3, y=t["y"] / 1e3),
        swirl.Failure,
        "scale 30 is too large.\nhint: ",
    ),
    "complex": (
        lambda t: t.assign(x=t["x"] * 1j),
        TypeError,
        "column x of the tracks must hold numbers, but row 0 has",
    ),
    "truth values": (
        lambda t: t.assign(particle=t["particle"] > 2),
        TypeError,
        "particle of .* but row 0 has False",
    ),
    "no rows": (lambda t: t.iloc[:0], ValueError, "the tracks are empty"),
}


@pytest.mark.parametrize("case", WRONG_TABLES)
def test_a_wrong_table_raises_what_is_wrong_and_where(case, tracks):
    table, camera = tracks
    change, kind, says = WRONG_TABLES[case]
    with pytest.raises(kind, match=says):
        swirl.analyse(change(table), **camera)


@pytest.mark.parametrize(
    "given, kind, says",
    [
        (
            {"warmpu": 3},
            TypeError,
            "there is no argument 'warmpu'.\nhint: .*omega, container_radius",
        ),
        ({"clockwise": "no"}, TypeError, "clockwise is 'no', but it must be True or False"),
        ({"centre": 5}, TypeError, "centre is 5, but it must be two numbers"),
        ({"omega": "1"}, TypeError, "omega is '1', but it must be a number"),
        (
            {"scale": 1.0},
            swirl.Failure,
            "scale, centre, .*is wrong.\nhint: .*with scale 33.3 they would touch",
        ),
    ],
)
def test_a_wrong_scale_raises_what_is_wrong(given, kind, says, tracks):
    table, camera = tracks
    with pytest.raises(kind, match=says):
        swirl.analyse(table, **{**camera, **given})


def test_any_order_and_any_type_of_numbers_will_do(tracks):
    table, camera = tracks
    expected = repr(swirl.analyse(table, **camera))
    for same in (
        table.sample(frac=1, random_state=1),
        table.astype(float),
        table.astype(object),
        table.astype({"frame": "Int64", "particle": "Int64", "x": "Float64"}),
    ):
        assert repr(swirl.analyse(same, **camera)) == expected


# --- plots ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "kind",
    [
        swirl.Table,
        swirl.Series,
        swirl.Result,
        swirl.Analysis,
        swirl.Crossing,
        swirl.Snapshot,
        swirl.Simulation,
    ],
    ids=lambda kind: kind.__name__,
)
def test_what_can_be_drawn_draws_into_the_given_axes(kind, instances):
    one = instances[kind]
    _, ax = plt.subplots()
    assert one.plot(ax=ax) is ax and (ax.has_data() or ax.collections)
    assert one.plot() is not ax
    ax.figure.canvas.draw()


def test_a_result_draws_what_it_has(result):
    (line, counted, _) = result.plot().lines
    np.testing.assert_array_equal(line.get_ydata(), result.series["mean_by_time"])
    np.testing.assert_array_equal(
        counted.get_xdata(), result.series["period"][result.series["counted"] == 1]
    )
    (mesh,) = [c for c in result.plot("density").collections if c.get_array() is not None]
    np.testing.assert_array_equal(
        np.ravel(mesh.get_array()), result.measured["density"]["by_time"].ravel()
    )
    (line,) = result.plot("wall.profile").lines
    np.testing.assert_array_equal(line.get_ydata(), result.measured["wall"]["profile"]["pressure"])
    (line,) = result.measured["wall"].plot("traction").lines
    np.testing.assert_array_equal(line.get_ydata(), result.measured["wall"]["profile"]["traction"])
    (mesh,) = [
        c
        for c in result.measured["density"].table.plot("by_event").collections
        if c.get_array() is not None
    ]
    np.testing.assert_array_equal(
        np.ravel(mesh.get_array()), result.measured["density"]["by_event"].ravel()
    )
    assert result.plot("flow").collections
    alone = swirl.run(discs=5, events=3000)
    (point,) = alone.plot().containers
    assert (point.lines[0].get_xdata(), point.lines[0].get_ydata()) == (
        [5],
        [alone.rotation.mean_by_time.mean],
    )


def test_a_crossing_is_drawn_with_its_number(instances):
    found = instances[swirl.Crossing]
    ax = found.plot()
    np.testing.assert_array_equal(
        ax.containers[0].lines[0].get_ydata(), [point["mean"] for point in found.points]
    )
    assert swirl.with_error(found.discs, found.error) in ax.get_legend().get_texts()[0].get_text()


def test_what_cannot_be_drawn_is_said(result):
    with pytest.raises(ValueError, match="has no 'slip' to plot; it has series, density, flow"):
        result.plot("slip")
    with pytest.raises(ValueError, match="only numbers.\nhint: use to_pandas"):
        result.measured["slip"].plot()
    with pytest.raises(ValueError, match="no table to plot.\nhint: use measure"):
        swirl.analyse(swirl.Simulation(discs=5).sample(2, 100)).plot()
    with pytest.raises(ValueError, match="has no series.\nhint: use swirl.run\\(series=True"):
        swirl.plot.series(swirl.run(discs=5, events=300))
