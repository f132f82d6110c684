"""swirl.lab(): the browser page inside a notebook."""

import html
import json
import os
import pickle
import re
from urllib.parse import parse_qs

import numpy as np
import pytest

import swirl
from scenes import SCENES
from swirl import _lab

PAGE = (
    '<!doctype html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n<title>swirl</title>\n'
    "</head></html>\n"
)


@pytest.fixture
def page(tmp_path):
    path = tmp_path / "page.html"
    path.write_text(PAGE, encoding="utf-8")
    return path


def start_of(document):
    (entry,) = re.findall(r'<meta name="swirl-start" content="([^"]*)">', document)
    return parse_qs(html.unescape(entry), strict_parsing=True)


def test_the_page_starts_with_the_parameters(page):
    shown = swirl.lab(page=page, discs=40, mu=0.3, mixture=(20, 0.6), lang="de")
    assert start_of(shown.html) == {
        "discs": ["40"],
        "mu": ["0.3"],
        "mixture": ["20:0.6"],
        "lang": ["de"],
    }
    assert re.sub(r'<meta name="swirl-start"[^>]*>\n', "", shown.html) == PAGE


def test_a_written_page_gets_other_parameters(page):
    path = page.parent / "other.html"
    swirl.lab(page=page, discs=40).save(path)
    assert start_of(swirl.lab(page=path, discs=12).html) == {"discs": ["12"]}


def test_a_notebook_shows_the_document_in_a_frame_of_its_own_origin(page):
    shown = swirl.lab(page=page, discs=8, height=500)
    frame = shown._repr_html_()
    (document,) = re.findall(r'srcdoc="([^"]*)"', frame)
    assert html.unescape(document) == shown.html
    assert 'height="500"' in frame
    (sandbox,) = re.findall(r'sandbox="([^"]*)"', frame)
    assert "allow-scripts" in sandbox and "allow-same-origin" not in sandbox


SHOWN = [
    *SCENES,
    dict(preset="experiment", discs=24, direction="clockwise"),
    dict(mixture="20%:1.3"),
    dict(discs=5, sizes=np.linspace(0.8, 1.2, 5)),
    dict(discs=40, cannot_spin=0.5),
    dict(motion="ellipse:0.5"),
    dict(ramp="amplitude=1:2@20..220"),
]


@pytest.mark.parametrize("scene", SHOWN, ids=str)
def test_the_page_of_a_simulation_has_its_parameters(page, scene):
    scene = {name: value for name, value in scene.items() if name != "warmup"}
    sim = swirl.Simulation(**scene)
    sim.advance(events=100)
    given = (
        {name: value for name, (value,) in start_of(sim.show(page=page).html).items()}
        if scene
        else {}
    )
    again = json.loads(swirl._engine.resolve(given))
    # The page has no length of a run, for which presets have a value of their own.
    assert {name for name, value in again.items() if value != sim.config[name]} <= {
        "events",
        "periods",
    }


def test_the_page_of_a_result_has_its_parameters(page):
    shown = swirl.run(discs=5, mu=0.3, seed=4, events=300).show(page=page, lang="de", height=300)
    assert start_of(shown.html) == {
        "discs": ["5"],
        "mu_disc": ["0.3"],
        "mu_wall": ["0.3"],
        "seed": ["4"],
        "lang": ["de"],
    }
    assert shown.height == 300


def test_custom_discs_cannot_be_shown(page):
    sim = swirl.Simulation(position=[[0, 0], [3, 0]], container_radius=8)
    for one in (sim, pickle.loads(pickle.dumps(sim))):
        with pytest.raises(ValueError, match="discs or a path of its own.\nhint: plot"):
            one.show(page=page)


def test_an_array_becomes_a_text(page):
    (entry,) = start_of(swirl.lab(discs=3, sizes=np.array([0.5, 1.0, 1.5]), page=page).html)[
        "sizes"
    ]
    assert json.loads(swirl._engine.resolve({"discs": 3, "sizes": entry})) == json.loads(
        swirl._engine.resolve({"discs": 3, "sizes": np.array([0.5, 1.0, 1.5])})
    )


def test_values_are_checked_as_for_a_run(page):
    for wrong in ({"discs": 1000}, {"mu": -1}, {"disks": 5}):
        with pytest.raises((ValueError, TypeError)) as by_lab:
            swirl.lab(page=page, **wrong)
        with pytest.raises((ValueError, TypeError)) as by_run:
            swirl.run(**wrong)
        assert (type(by_lab.value), str(by_lab.value)) == (type(by_run.value), str(by_run.value))


def test_the_page_is_found_or_the_error_has_a_hint(page, monkeypatch):
    monkeypatch.setenv("SWIRL_LAB", os.fspath(page))
    assert start_of(swirl.lab(discs=5).html) == {"discs": ["5"]}
    monkeypatch.delenv("SWIRL_LAB")
    monkeypatch.setattr(_lab, "__file__", os.fspath(page.parent / "a/b/c/swirl/_lab.py"))
    with pytest.raises(
        FileNotFoundError, match=r"(?s)is not built\.\nhint: run \./swirl lab --out "
    ):
        swirl.lab(discs=5)
    built = page.parent / "a" / "build" / "lab"
    built.mkdir(parents=True)
    (built / "laboratory.html").write_text(PAGE, encoding="utf-8")
    assert start_of(swirl.lab(discs=5).html) == {"discs": ["5"]}


def test_the_dish_is_the_first_page(page, monkeypatch):
    monkeypatch.delenv("SWIRL_LAB", raising=False)
    monkeypatch.setattr(_lab, "__file__", os.fspath(page.parent / "a/b/c/swirl/_lab.py"))
    built = page.parent / "a" / "build" / "lab"
    built.mkdir(parents=True)
    known = '<meta name="swirl-parameters" content="discs mu_wall">\n'
    for name, of_its_own in (("index", known), ("laboratory", "")):
        (built / f"{name}.html").write_text(
            PAGE.replace("<title>swirl", f"{of_its_own}<title>{name}"), encoding="utf-8"
        )
    assert "<title>index" in swirl.lab(dish=True, discs=40, mu_wall=0).html
    assert "<title>laboratory" in swirl.lab(discs=40).html
    with pytest.raises(ValueError, match="the dish has no parameter 'amplitude'"):
        swirl.lab(dish=True, amplitude=1.5)


def test_another_file_is_rejected(page):
    page.write_text("<html></html>", encoding="utf-8")
    with pytest.raises(ValueError, match="is not the browser page"):
        swirl.lab(page=page)
