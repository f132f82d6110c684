"""The figures of paper/: runs that are stored, reused, shared and combined."""

import csv
import fcntl
import json
import math
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import swirl

from paper import atomic_file, catalogue, combine, command, console, figure, study
from paper.claims import wording

SOURCE = os.environ["SWIRL_SOURCE"]
EVENTS = 2000


def made(out, *figures, part=None):
    """The counts of the runs of `swirl paper`, which also writes the tables unless it makes only a
    part."""
    paper = command.Paper(
        {"figures": list(figures), "quick": True, "events": EVENTS, "out": str(out)}
    )
    if part:
        points = [point for figure in paper.figures for point in figure.points(paper.settings)]
        return study.make(points, paper.settings, part=tuple(part))
    paper.run(lambda fraction, part="": None)
    return paper.counts


def rows(folder, name):
    with open(Path(folder, f"figure_{name}.csv"), newline="", encoding="utf-8") as file:
        return list(csv.reader(file))


@pytest.mark.parametrize(
    "name, folder", (("restitution", "runs/rotation/results"), ("energy", "parts"))
)
def test_runs_are_reused_and_a_damaged_result_is_made_again(tmp_path, name, folder):
    first = made(tmp_path, name)
    assert (first["reused"], first["failed"]) == (0, 0)
    table, files = rows(tmp_path, name), sorted(Path(tmp_path, folder).iterdir())
    assert len(files) == first["tasks"]
    whole, last = files[0].read_text(), files[-1].read_text()
    edited = re.sub(r"(\d\.)\d", lambda digits: digits[1] + "77", last)
    assert edited != last
    damages = "", "{", "[]", '{"key": 3}', '{"result": {}}', whole[:-20], whole[: len(whole) // 2]
    for file, text in zip(files, damages):
        file.write_text(text)
    files[-1].write_text(edited)
    again = made(tmp_path, name)
    assert again["reused"] == first["tasks"] - len(damages) - 1
    assert rows(tmp_path, name) == table


def test_a_file_that_is_written_again_leaves_no_temporary_file(tmp_path):
    left, other = (tmp_path / f"{name}.0123456789abcdef.partial" for name in ("a.json", "b.json"))
    for file in (left, other):
        file.write_text("half")
    atomic_file.write(str(tmp_path / "a.json"), "whole")
    assert not left.exists() and other.exists()
    with open(other, "rb") as locked:  # its writer still runs
        fcntl.flock(locked, fcntl.LOCK_EX)
        atomic_file.write(str(tmp_path / "b.json"), "whole")
    assert other.exists()


def test_what_cannot_be_read_is_not_absent(tmp_path):
    from paper import optional_file

    atomic_file.store(str(tmp_path / "a.json"), [1])
    assert atomic_file.stored(str(tmp_path / "a.json")) == [1]
    assert atomic_file.stored(str(tmp_path / "b.json")) is None
    folder_in_its_place = tmp_path / "c.json"
    folder_in_its_place.mkdir()
    with pytest.raises(IsADirectoryError):
        atomic_file.stored(str(folder_in_its_place))
    loop = tmp_path / "loop"
    loop.symlink_to("loop")
    with pytest.raises(OSError):
        optional_file.exists(loop)


@pytest.mark.parametrize(
    "name, folder", (("restitution", "runs/rotation/results"), ("energy", "parts"))
)
def test_results_of_another_version_are_kept(tmp_path, name, folder, capsys):
    first, (version, kept) = made(tmp_path, name), (
        "0.0.9 (abc/d)",
        Path(tmp_path, f"{folder}_of_0.0.9_abc_d"),
    )
    table, file = rows(tmp_path, name), sorted(Path(tmp_path, folder).iterdir())[0]
    text = file.read_text().replace(swirl.version(), version)
    if folder == "parts":
        atomic_file.store(str(file), {**json.loads(text)["content"]})
        text = file.read_text()
    file.write_text(text)
    capsys.readouterr()
    assert made(tmp_path, name)["reused"] == first["tasks"] - 1
    assert f"note: the results of swirl {version} are moved to '{kept}'" in capsys.readouterr().err
    assert [(one.name, one.read_text()) for one in kept.iterdir()] == [(file.name, text)]
    assert rows(tmp_path, name) == table
    assert made(tmp_path, name)["reused"] == first["tasks"]
    assert "note:" not in capsys.readouterr().err


def test_parts_share_the_runs(tmp_path):
    tasks = (
        made(tmp_path, "restitution", part=[1, 2])["tasks"]
        + made(tmp_path, "restitution", part=[2, 2])["tasks"]
    )
    assert not list(tmp_path.glob("*.csv"))
    all_of_them = made(tmp_path, "restitution")
    assert all_of_them["reused"] == all_of_them["tasks"] == tasks


def fails(parameters):
    raise study.swirl.Failure("it collapses")


def test_a_failed_run_leaves_a_gap(tmp_path):
    settings = study.Settings(quick=True, events=EVENTS, out=str(tmp_path))
    good, bad = study.Point(settings, "good", 2, {"discs": 5}), study.Point(
        settings, "bad", 2, {"discs": 5}, work=fails
    )
    counts = study.make([good, bad], settings)
    assert counts["failed"] == 2
    assert bad.result == {"failed": "it collapses", "point": "bad"} and bad.runs == []
    assert good.result["seeds"]["runs"] == 2
    assert study.remarks([good, bad])[0] == (
        "2 runs failed and are omitted: 2 of 2 at bad (no result). Reason of the "
        "first: it collapses"
    )


def test_a_point_with_measurements_serves_one_without(tmp_path):
    settings = study.Settings(quick=True, events=EVENTS, out=str(tmp_path))
    plain, measured = (
        study.Point(settings, "p", 2, {"discs": 5}, measure) for measure in ((), ("centre",))
    )
    assert study.make([plain, measured], settings)["tasks"] == 2
    assert plain.result["rotation"] == measured.result["rotation"]
    again = study.Point(settings, "p", 2, {"discs": 5})
    assert study.make([again], settings)["reused"] == 2


def test_runs_are_sweeps_that_other_programs_read_and_complete(tmp_path):
    settings = study.Settings(quick=True, events=EVENTS, out=str(tmp_path))
    # Two figures with the same run under different names, and a run of another call with
    # measurements.
    names = [
        study.Point(settings, name, 2, parameters)
        for name, parameters in (
            ("a", {"discs": 5}),
            ("b", {"discs": 5, "mu": 1}),
            ("c", {"discs": 6}),
        )
    ]
    assert study.make(names[:2], settings)["tasks"] == 2
    study.make([study.Point(settings, "d", 1, {"discs": 5}, ("slip",))], settings)
    # A part plans the runs of all parts, and makes its own.
    assert study.make(names, settings, part=(1, 2))["tasks"] == 2
    table = swirl.sweep(tmp_path / "runs" / "rotation")
    assert table.attrs["runs"]["done"] == 4 and table["discs"].tolist() == [5, 5, 6, 6]
    assert study.make(names, settings)["reused"] == 4
    assert names[0].result["rotation"] == names[1].result["rotation"]
    assert [run["rotation"]["mean_by_event"]["mean"] for run in names[2].runs] == table[
        "mean_by_event"
    ].tolist()[2:]
    assert sorted(os.listdir(tmp_path / "runs")) == ["lock", "rotation", "slip"]


def test_runs_of_other_calls_are_not_made(tmp_path):
    settings = study.Settings(quick=True, events=EVENTS, out=str(tmp_path))
    wanted, other = (study.Point(settings, f"p{n}", 2, {"discs": n}) for n in (5, 6))
    study.make([wanted, other], settings, part=(1, 4))
    study.make([wanted], settings)
    assert len(list((tmp_path / "runs" / "rotation" / "results").iterdir())) < 4


def test_runs_that_another_process_makes_are_awaited(tmp_path, monkeypatch):
    run, calls = swirl.SweepFolder.run, []

    def first_elsewhere(folder, **how):
        calls.append(how)
        return swirl.SweepCounts(0, 0, 2, "") if len(calls) == 1 else run(folder, **how)

    monkeypatch.setattr(swirl.SweepFolder, "run", first_elsewhere)
    settings = study.Settings(quick=True, events=EVENTS, out=str(tmp_path))
    point = study.Point(settings, "p", 2, {"discs": 5})
    assert study.make([point], settings)["failed"] == 0
    assert (len(calls), len(point.runs)) == (2, 2)


def test_more_seeds_for_a_single_point():
    settings = study.Settings(seeds_of_point={"p": 16})
    assert [len(study.Point(settings, name, 8, {"discs": 5}).tasks) for name in "pq"] == [16, 8]


@pytest.mark.parametrize("quick, seeds, most", ((False, 33, 32), (False, 0, 32), (True, 13, 12)))
def test_a_number_of_seeds_beyond_the_budget_of_a_point_is_rejected(quick, seeds, most):
    with pytest.raises(
        console.Problem, match=f"--replicates is {seeds}, but it must be from 2 to {most}"
    ) as problem:
        study.Settings(quick=quick, first_seeds=seeds)
    assert problem.value.code == 2


def raises(*_):
    raise LookupError("no such number")


@pytest.mark.parametrize(
    "broken",
    (
        figure.Figure("broken", "beyond", "", raises, None),
        figure.Figure(
            "broken",
            "beyond",
            "",
            lambda settings: [study.Point(settings, "b", 1, {"discs": 5}, work=raises)],
            None,
        ),
        figure.Figure("broken", "beyond", "", lambda settings: [], raises),
    ),
    ids=("points", "work", "table"),
)
def test_an_error_in_the_code_of_a_figure_does_not_end_the_others(
    tmp_path, monkeypatch, capsys, broken
):
    good = figure.Figure(
        "good",
        "beyond",
        "",
        lambda settings: [study.Point(settings, "g", 1, {"discs": 5})],
        lambda points, settings: ({"": [{"point": point.name} for point in points]}, []),
    )
    monkeypatch.setattr(catalogue, "named", lambda names: [broken, good])
    call = {
        "figures": ["beyond"],
        "quick": True,
        "events": EVENTS,
        "out": str(tmp_path),
        "quiet": True,
    }
    with pytest.raises(console.Problem, match="figures that could not be made: broken") as problem:
        command.make(call)
    assert problem.value.code == 1
    assert "LookupError: no such number" in capsys.readouterr().out
    assert rows(tmp_path, "good") == [["point"], ["g"]]
    if broken.points is raises:
        with pytest.raises(console.Problem, match="figure broken cannot be made: LookupError"):
            command.make(call | {"part": [1, 1]})


def test_tables_need_no_matplotlib(tmp_path):
    call = {"figures": ["5b"], "quick": True, "events": EVENTS, "out": str(tmp_path), "quiet": True}
    done = subprocess.run(
        [
            sys.executable,
            "-c",
            f"""
import sys
sys.modules["matplotlib"] = None
sys.path.insert(0, {SOURCE!r})
from paper import catalogue, command, study
for figure in catalogue.named(["all"]):
    figure.points(study.Settings(quick=True))
try:
    command.make({call})
except command.Problem as problem:
    sys.exit(problem.code)
""",
        ],
        capture_output=True,
        text=True,
    )
    assert done.returncode == 1, done.stdout + done.stderr
    assert "the figures need matplotlib; the tables are written" in done.stdout
    assert len(rows(tmp_path, "5b")) > 50


def test_angles_of_rows_and_of_tables_are_averaged_as_directions():
    """By their rows in the registry of quantities: 350 and 10 degrees make 0."""

    def residence(angle):
        row = {"mean": angle, "error": 1.0, "effective_samples": 9.0}
        return {
            "pinning": row,
            "share": {**row, "mean": angle / 360},
            "sensitivity": {
                "layer": [1.5],
                "pinning": [angle],
                "pinning_error": [1.0],
                "share": [angle / 360],
                "share_error": [0.1],
            },
        }

    found = combine.measured([residence(350.0), residence(10.0)], [0.5, 0.5], "residence")
    for mean in (found["pinning"]["mean"], found["sensitivity"]["pinning"][0]):
        assert math.remainder(mean, 360) == pytest.approx(0, abs=1e-9)
    for mean in (found["share"]["mean"], found["sensitivity"]["share"][0]):
        assert mean == pytest.approx(0.5)


def test_a_file_that_cannot_be_imported_fails_alone(tmp_path, monkeypatch):
    (tmp_path / "chapters").mkdir()
    (tmp_path / "chapters" / "scratch.py").write_text(
        "import nothing_of_this_name\n"
        'FIGURES = [Figure("scratch", "chapters", "chapter: a new one", points, table)]\n'
    )
    monkeypatch.setattr(catalogue, "FOLDER", str(tmp_path))
    (scratch,) = catalogue.named(["scratch"])
    with pytest.raises(ImportError, match="scratch"):
        scratch.points(study.Settings())


@settings(deadline=None)
@given(st.floats(), st.floats() | st.none(), st.integers(-13, 6), st.booleans())
def test_claims_round_as_reports_do(mean, error, power, is_near):
    """Claims are judged without the module, so they round by themselves."""
    if is_near and error is not None:
        mean, error = (
            math.remainder(mean, 100.0) if math.isfinite(mean) else mean,
            abs(error % 1.0) * 10.0**power,
        )
    assert wording.number(mean, error) == swirl.with_error(
        mean, math.nan if error is None else error
    )
