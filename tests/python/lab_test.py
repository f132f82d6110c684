"""swirl.lab(): the browser page inside a notebook."""

import html
import os
import re
from urllib.parse import parse_qs

import pytest

import swirl
from swirl import _lab

PAGE = '<!doctype html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n<title>swirl</title>\n</head></html>\n'


@pytest.fixture
def page(tmp_path):
    path = tmp_path / "page.html"
    path.write_text(PAGE, encoding="utf-8")
    return path


def start_of(document):
    entry, = re.findall(r'<meta name="swirl-start" content="([^"]*)">', document)
    return parse_qs(html.unescape(entry), strict_parsing=True)


def test_the_page_starts_with_the_parameters(page):
    shown = swirl.lab(page=page, discs=40, mu=0.3, mixture=(20, 0.6), lang="de")
    assert start_of(shown.html) == {"discs": ["40"], "mu": ["0.3"], "mixture": ["20:0.6"], "lang": ["de"]}
    assert re.sub(r'<meta name="swirl-start"[^>]*>\n', "", shown.html) == PAGE


def test_a_written_page_gets_other_parameters(page):
    path = page.parent / "other.html"
    swirl.lab(page=page, discs=40).save(path)
    assert start_of(swirl.lab(page=path, discs=12).html) == {"discs": ["12"]}


def test_a_notebook_shows_the_document_in_a_frame_of_its_own_origin(page):
    shown = swirl.lab(page=page, discs=8, height=500)
    frame = shown._repr_html_()
    document, = re.findall(r'srcdoc="([^"]*)"', frame)
    assert html.unescape(document) == shown.html
    assert 'height="500"' in frame
    sandbox, = re.findall(r'sandbox="([^"]*)"', frame)
    assert "allow-scripts" in sandbox and "allow-same-origin" not in sandbox


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
    with pytest.raises(FileNotFoundError, match=r"(?s)is not built\.\nhint: run \./swirl lab --out "):
        swirl.lab(discs=5)
    built = page.parent / "a" / "build" / "lab"
    built.mkdir(parents=True)
    (built / "index.html").write_text(PAGE, encoding="utf-8")
    assert start_of(swirl.lab(discs=5).html) == {"discs": ["5"]}


def test_another_file_is_rejected(page):
    page.write_text("<html></html>", encoding="utf-8")
    with pytest.raises(ValueError, match="is not the browser page"):
        swirl.lab(page=page)
