"""swirl.plot draws the data, into the given axes."""

import sys
import types

import matplotlib
import numpy as np
import pytest

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

import swirl  # noqa: E402
import swirl.plot  # noqa: E402


@pytest.fixture(autouse=True)
def closed():
    yield
    plt.close("all")


@pytest.fixture(scope="module")
def result():
    return swirl.run(discs=30, events=60000, measure="density,flow,profile")


def test_snapshot_shows_discs_at_their_positions():
    sim = swirl.Simulation(discs=20, mixture=(5, 1.4))
    sim.advance(periods=1.3)
    for m_frame in (False, True):
        s = sim.snapshot().m_frame() if m_frame else sim.snapshot()
        axes = swirl.plot.snapshot(sim, m_frame=m_frame, color="spin", velocities=True)
        (discs,) = [c for c in axes.collections if hasattr(c, "_widths")]
        np.testing.assert_array_equal(discs.get_offsets(), s.position)
        np.testing.assert_allclose(discs._widths, s.radius)
        np.testing.assert_allclose(discs.get_array(), s.spin / (2 * np.pi / s.period))
        (wall,) = axes.patches
        np.testing.assert_allclose(wall.center, s.container_centre)
        assert wall.radius == s.container_radius
        axes.figure.canvas.draw()


def test_given_axes_are_used():
    figure, axes = plt.subplots()
    for color in ("red", "speed", np.arange(7)):
        assert swirl.plot.snapshot(swirl.Simulation(discs=7), ax=axes, color=color) is axes
    figure.canvas.draw()
    with pytest.raises(ValueError, match="color has 3 values, but there are 7 discs"):
        swirl.plot.snapshot(swirl.Simulation(discs=7), color=[1, 2, 3])


def test_maps_show_the_tables(result):
    for by in ("time", "event"):
        axes = swirl.plot.density(result, by=by)
        (mesh,) = [c for c in axes.collections if c.get_array() is not None]
        np.testing.assert_array_equal(
            np.ravel(mesh.get_array()), result.measured["density"][f"by_{by}"].ravel()
        )
        axes.figure.canvas.draw()
    axes = swirl.plot.density(result.measured["density"])
    swirl.plot.flow(result.measured["flow"].table).figure.canvas.draw()
    with pytest.raises(ValueError, match="by is 'disc'"):
        swirl.plot.density(result, by="disc")
    with pytest.raises(ValueError, match="use swirl.run"):
        swirl.plot.density(swirl.run(discs=5, events=100))


def test_profile_shows_the_table(result):
    axes = swirl.plot.profile(result)
    (line,) = axes.lines
    np.testing.assert_array_equal(line.get_ydata(), result.measured["profile"]["varpi_m"])
    assert "θ" in axes.get_xlabel() or "theta" in axes.get_xlabel()


def test_rotation_against_a_parameter():
    table = swirl.sweep(discs=[5, 9, 13], mu=[0.1, 1], events=5000)
    axes = swirl.plot.rotation(table, by="mu")
    assert len(axes.containers) == 2 and len(axes.get_legend().get_texts()) == 2
    line = axes.containers[0].lines[0]
    np.testing.assert_array_equal(line.get_ydata(), table[table.mu == 0.1]["mean_by_time"])
    runs = swirl.map(discs=[13, 5, 9], mu=0.1, events=5000)
    line = swirl.plot.rotation(runs).containers[0].lines[0]
    np.testing.assert_array_equal(line.get_xdata(), [5, 9, 13])
    with pytest.raises(TypeError):
        swirl.plot.rotation([1, 2])
    with pytest.raises(ValueError, match="no parameter 'disks'"):
        swirl.plot.rotation(runs, against="disks")


def test_progress_uses_tqdm_if_installed(monkeypatch):
    shown = []

    class Bar:
        def __init__(self, **given):
            self.n = 0.0

        def update(self, more):
            self.n += more
            shown.append(self.n)

        def close(self):
            shown.append("closed")

    monkeypatch.setitem(sys.modules, "tqdm", types.ModuleType("tqdm"))
    monkeypatch.setitem(sys.modules, "tqdm.auto", types.SimpleNamespace(tqdm=Bar))
    swirl.map(discs=[5, 6], events=1000, progress=True)
    assert shown == [0.5, 1.0, "closed"]
    monkeypatch.setitem(sys.modules, "tqdm.auto", None)
    swirl.map(discs=[5, 6], events=1000, progress=True)
