"""The pages of all reports. A page is a title and a list of blocks (kind, value):

    section           a heading
    text, small       a paragraph
    picture           a PNG file, alone
    bullets           texts
    table             (head, rows of texts); the last cell of a short row spans the others
    figures           dictionaries with "title", and where there are any "images", "wide",
                      "question", "caption", "findings", "remarks" and "command"
    claims            dictionaries (report.claim_row)

The layout of HTML is report.html.j2, and that of Markdown report.md.j2.
"""

import base64
import html
import json
import os
import re
import struct
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
SUBSCRIPT = re.compile(r"\b([NPRVϖμγ])_(container|cluster|ball|wall|[A-Za-z])\b")
# No line breaks inside "N = 48" and "0.5 ± 0.1".
LETTER_IS = re.compile(r"(?<![\w/])([^\W\d](?:_\w+)?) = (?=[\d−])")


def rich(text):
    """Escaped text with subscripts (N_c) and non-breaking spaces."""
    text = LETTER_IS.sub("\\1\u00a0=\u00a0", html.escape(str(text))).replace(" ± ", "\u00a0±\u00a0")
    return SUBSCRIPT.sub(r"\1<sub>\2</sub>", text)


def cell(text):
    """Text in a table of Markdown."""
    return str(text).replace("|", "\\|").replace("\n", " ")


def rendered(layout, folder=".", **values):
    """The text of a page. `folder` has its images, which become part of HTML."""
    import jinja2
    import markupsafe

    def inline(name):
        with open(os.path.join(folder, name), "rb") as file:
            return "data:image/png;base64," + base64.b64encode(file.read()).decode()

    pages = jinja2.Environment(
        loader=jinja2.FileSystemLoader(HERE),
        autoescape=".html" in layout,
        trim_blocks=True,
        keep_trailing_newline=True,
    )
    pages.filters.update(
        rich=lambda text: markupsafe.Markup(rich(text)),
        cell=cell,
        inline=inline,
        bullet="- {}".format,
    )
    return pages.get_template(layout).render(**values)


def size_of(png):
    """Width and height in pixels, from the header of the file."""
    with open(png, "rb") as file:
        return struct.unpack(">16xII", file.read(24))


def described_folder(name, command, what):
    """The folder in the command line, and the content of NAME there, which `command FOLDER`
    wrote."""
    if len(sys.argv) != 2 or sys.argv[1] in ("-h", "--help"):
        print(
            f"usage: /usr/bin/python3 {sys.argv[0]} FOLDER\n"
            f"{what} from the files that `{command} FOLDER` wrote",
            file=sys.stderr,
        )
        sys.exit(0 if sys.argv[1:] in (["-h"], ["--help"]) else 2)
    folder = sys.argv[1]
    try:
        with open(os.path.join(folder, name), encoding="utf-8") as file:
            return folder, json.load(file)
    except FileNotFoundError:
        sys.exit(
            f"error: '{folder}/{name}' does not exist.\n"
            f"hint: `{command.removesuffix(' --out')}` writes it."
        )
