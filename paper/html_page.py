"""The building blocks of every report: one self-contained HTML file."""

import base64
import html
import json
import os
import re
import sys

from atomic_file import write_or_exit as write  # noqa: F401

CSS = """
:root { color-scheme: light; }
body { font: 16px/1.5 system-ui, "DejaVu Sans", sans-serif; color: #1b1b1b; background: #fff;
       max-width: 64rem; margin: 2.5rem auto; padding: 0 1.2rem; }
h1 { font-size: 1.7rem; line-height: 1.2; margin-bottom: .3rem; }
h2 { font-size: 1.25rem; margin-top: 2.4rem; border-bottom: 1px solid #ccc; }
h3 { font-size: 1rem; margin: 0 0 .3rem; }
table { border-collapse: collapse; width: 100%; font-size: .88rem; }
th, td { text-align: left; vertical-align: top; padding: .45rem .8rem .45rem 0;
         border-bottom: 1px solid #ddd; }
.verdict { font-weight: 600; }
.holds { color: #00694e; } .part { color: #8a5a00; } .fails { color: #a63c00; }
.other { color: #666; }
code { font-size: .85em; background: #f3f3f3; padding: .05em .3em; border-radius: 3px; }
td code { white-space: normal; overflow-wrap: anywhere; }
sub { line-height: 0; font-size: .72em; }
.figures { columns: 2; column-gap: 2rem; }
figure { margin: 0 0 1.6rem; break-inside: avoid; }
figure.wide { column-span: all; }
figcaption > code { display: block; width: fit-content; }
figure img { display: block; width: 100%; height: auto; max-height: 44rem; object-fit: contain;
             margin: 0 0 .5rem; }
img.first { display: block; max-width: min(100%, 34rem); margin: 1rem 0; }
figcaption { font-size: .88rem; }
figcaption p { margin: 0 0 .3rem; }
figcaption ul { padding-left: 1.1rem; margin: .3rem 0 .6rem; }
figcaption li { margin-bottom: .25rem; }
.small { color: #555; font-size: .92em; }
table.claims { table-layout: fixed; }
.claims th:nth-child(1) { width: 2.2em; }
.claims th:nth-child(2) { width: 26%; }
.claims th:nth-child(3) { width: 4.5em; }
.claims th:nth-child(5) { width: 18%; }
.question { color: #333; font-style: italic; margin: 0 0 .3rem; }
@media screen and (max-width: 50rem) { .figures { columns: 1; } }
@page { size: A4; margin: 16mm 15mm; }
@media print {
  body { font-size: 9.5pt; max-width: none; margin: 0; padding: 0; }
  .figures { column-gap: .7cm; }
  figure img { max-height: 15cm; }
  table { font-size: 8pt; }
  figcaption { font-size: 8pt; }
  tr { break-inside: avoid; }
  h3 { font-size: 10pt; }
  h2, h3, .heading { break-after: avoid; }
  code { background: none; padding: 0; }
}
"""


def opening(title):
    """The beginning of every page."""
    return ("<!doctype html>\n<html lang=en><head><meta charset=utf-8>"
            '<meta name=viewport content="width=device-width, initial-scale=1">'
            f"<title>{title}</title><style>{CSS}</style></head><body>\n")


def inline(path):
    """An image as a data URL."""
    kind = "svg+xml" if path.endswith(".svg") else "png"
    with open(path, "rb") as file:
        return f"data:image/{kind};base64," + base64.b64encode(file.read()).decode()


def table(head, rows, kind=""):
    top = "".join(f"<th>{html.escape(h)}</th>" for h in head)
    body = "".join("<tr>" + "".join(row) + "</tr>\n" for row in rows)
    return f"<table class='{kind}'><thead><tr>{top}</tr></thead><tbody>\n{body}</tbody></table>\n"


def pairs(rows):
    """A table of names and values."""
    return table(["", ""], [(td(a), td(b)) for a, b in rows])


def td(text, kind=""):
    kind = f' class="{kind}"' if kind else ""
    return f"<td{kind}>{rich(text)}</td>"


def bullets(texts):
    return "<ul>" + "".join(f"<li>{rich(text)}</li>" for text in texts) + "</ul>\n" if texts else ""


def grid(figures):
    """Figures in two columns; wide ones span both."""
    return "<div class=figures>\n" + "".join(figures) + "</div>\n"


SUBSCRIPT = re.compile(r"\b([NPRVϖμγ])_(container|cluster|ball|wall|[A-Za-z])\b")
# No line breaks inside "N = 48" and "0.5 ± 0.1".
LETTER_IS = re.compile(r"(?<![\w/])([^\W\d](?:_\w+)?) = (?=[\d−])")


def rich(text):
    """Escaped text with subscripts (N_c) and non-breaking spaces."""
    text = LETTER_IS.sub("\\1\u00a0=\u00a0", html.escape(str(text))).replace(" ± ", "\u00a0±\u00a0")
    return SUBSCRIPT.sub(r"\1<sub>\2</sub>", text)


def described_folder(name, command, what):
    """The folder in the command line, and the content of NAME there, which `command FOLDER` wrote."""
    if len(sys.argv) != 2 or sys.argv[1] in ("-h", "--help"):
        print(f"usage: /usr/bin/python3 {sys.argv[0]} FOLDER\n"
              f"{what} from the files that `{command} FOLDER` wrote", file=sys.stderr)
        sys.exit(0 if sys.argv[1:] in (["-h"], ["--help"]) else 2)
    folder = sys.argv[1]
    try:
        with open(os.path.join(folder, name), encoding="utf-8") as file:
            return folder, json.load(file)
    except FileNotFoundError:
        sys.exit(f"error: '{folder}/{name}' does not exist.\nhint: `{command.removesuffix(' --out')}` writes it.")
