"""The browser page inside a notebook."""

from __future__ import annotations

import html
import json
import os
import re
from collections.abc import Mapping
from typing import Any, Optional
from urllib.parse import urlencode

from . import _engine
from ._arguments import file_name
from ._files import exists
from ._runs import PathName, Value

# Each page is in the package, or in the folder of the sources: is it the dish?
_PAGES = {
    False: ("lab.html", os.path.join("build", "lab", "laboratory.html")),
    True: ("dish.html", os.path.join("build", "lab", "index.html")),
}


class Lab:
    """The browser page with a simulation, as one self-contained HTML document. A notebook shows it
    in a frame.

    `html` is the document; save() writes it to a file, which runs without installation and network.
    """

    __slots__ = ("html", "height", "__weakref__")

    def __init__(self, document: str, height: int) -> None:
        self.html = document
        self.height = height

    def save(self, path: PathName) -> None:
        """Writes the page to a file."""
        with open(file_name("path", path), "w", encoding="utf-8") as opened:
            opened.write(self.html)

    def _repr_html_(self) -> str:
        # The frame has an origin of its own, so the page has no access to the notebook.
        return (
            f'<iframe srcdoc="{html.escape(self.html)}" title="swirl" width="100%" '
            f'height="{self.height}" '
            'sandbox="allow-scripts allow-downloads allow-modals" style="border: 0"></iframe>'
        )

    def __repr__(self) -> str:
        return f"<swirl.Lab: the browser page, {len(self.html) // 1000} kB>"


def lab(
    *,
    page: Optional[PathName] = None,
    height: int = 640,
    lang: Optional[str] = None,
    dish: bool = False,
    **parameters: Value,
) -> Lab:
    """Shows the browser page in a notebook, with these parameters of a run.

        swirl.lab(discs=48, mu=0.3)

    There is no server: the page is part of the notebook. It comes from the file `page`, from the
    environment variable SWIRL_LAB, or from the folder of the sources, where `./swirl lab` builds
    it. `height` is that of the frame in pixels, `lang` "en" or "de". `dish` shows the first page, the
    dish alone, instead of the Laboratory; that page states which parameters it has."""
    config = json.loads(_engine.resolve(parameters))  # rejects what a run would reject
    path = file_name("page", _path_of(page, dish))
    with open(path, encoding="utf-8") as opened:
        document = opened.read()
    known = re.search(r'<meta name="swirl-parameters" content="([^"]*)">', document)
    others = [name for name in parameters if known and name not in known[1].split()]
    if others:
        raise ValueError(
            f"the dish has no parameter {others[0]!r}.\n"
            "hint: leave dish out, for the Laboratory has all parameters."
        )
    values = {
        name: config[name] if hasattr(value, "dtype") else _text_of(value)
        for name, value in parameters.items()
        if value is not None
    }
    query = urlencode({**values, **({"lang": lang} if lang else {})})
    start = f'<meta name="swirl-start" content="{html.escape(query)}">'
    # A page that `swirl lab --out` wrote with parameters has such an entry, which is replaced.
    document = re.sub(r'<meta name="swirl-start"[^>]*>\s*', "", document)
    document = re.sub(r'<a id="to-dish".*?</a>', "", document)  # a notebook has no other page
    before, charset, after = document.partition('<meta charset="utf-8">')
    if not charset:
        raise ValueError(f"'{path}' is not the browser page of swirl.")
    document = f"{before}{charset}\n{start}{after}"
    return Lab(document, height)


def parameters_of(config: Mapping[str, Any]) -> dict[str, Value]:
    """The parameters of a run from its config, without its length and what follows from others."""
    standard = json.loads(_engine.resolve({}))
    omitted = {"events", "periods", "warmup", "speed", "omega"}
    found = {
        name: value
        for name, value in config.items()
        if name not in omitted and value is not None and value != standard.get(name)
    }
    if "mixture" in found:
        mixture = found["mixture"]
        number = f"{mixture['percent']}%" if "percent" in mixture else mixture["count"]
        found["mixture"] = (number, mixture["radius"], mixture["mass"])
    return found


def _text_of(value: Value) -> str:
    return ":".join(str(part) for part in value) if isinstance(value, tuple) else str(value)


def _path_of(page: Optional[PathName], dish: bool) -> PathName:
    if page is not None:
        return page
    given = os.environ.get("SWIRL_LAB")
    if given:
        return given
    package = os.path.dirname(os.path.realpath(__file__))
    sources = os.path.dirname(os.path.dirname(os.path.dirname(package)))
    packaged, built = _PAGES[dish]
    for path in (os.path.join(package, packaged), os.path.join(sources, built)):
        if exists(path):
            return path
    raise FileNotFoundError(
        "the browser page is not built.\n"
        "hint: run ./swirl lab --out laboratory.html in the folder of the sources, and use "
        'swirl.lab(page="laboratory.html").'
    )
