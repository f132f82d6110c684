"""Layers of the browser page: a file of web/src imports only from its own folder and the folders
listed before it (docs/explanation/architecture.md), and no imports form a circle.

Types count as well as values: who reads one file should have to read only the files below it.
"""

import pathlib
import re
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[2]
PAGE = SOURCE / "web" / "src"

# The lowest layer first. The last one is the files beside the folders.
LAYERS = ("texts", "engine", "elements", "drawing", "first", "dish", "panels", "")
IMPORT = re.compile(r'^(?:import|export)\b[^;"]*?"(\.{1,2}/[^"?]+)', re.M)


def imports_of(text, folder):
    """The paths below web/src, without their endings, of the files that a source imports."""
    places = [(folder / what).resolve() for what in IMPORT.findall(text)]
    return {
        place.relative_to(PAGE).as_posix() for place in places if not place.suffix and inside(place)
    }


def inside(place):
    return PAGE in place.parents


def page():
    """{file: the files that it imports}, each as "dish/player"."""
    return {
        file.relative_to(PAGE)
        .with_suffix("")
        .as_posix(): imports_of(file.read_text(encoding="utf-8"), file.parent)
        for file in sorted(PAGE.rglob("*.ts"))
        if not file.name.endswith(".d.ts")
    }


def layer_of(name):
    return name.rpartition("/")[0]


def upwards(graph):
    """The imports from a higher layer."""
    return [
        f"{name} imports {other}"
        for name, others in graph.items()
        for other in sorted(others)
        if LAYERS.index(layer_of(other)) > LAYERS.index(layer_of(name))
    ]


def circles(graph):
    """The sets of files that import each other, over any number of files in between."""

    def reached(name):
        found, waiting = set(), [name]
        while waiting:
            for other in graph.get(waiting.pop(), ()):
                if other not in found:
                    found.add(other)
                    waiting.append(other)
        return found

    all_reached = {name: reached(name) for name in graph}
    return {
        frozenset(other for other in all_reached[name] if name in all_reached.get(other, ()))
        for name in graph
        if name in all_reached[name]
    }


class PageLayers(unittest.TestCase):
    def test_each_file_is_in_a_layer(self):
        graph = page()
        self.assertGreater(len(graph), 40)
        self.assertEqual([name for name in graph if layer_of(name) not in LAYERS], [])

    def test_each_import_is_a_file(self):
        graph = page()
        missing = {other for others in graph.values() for other in others} - set(graph)
        self.assertEqual(missing, set())

    def test_no_file_imports_from_a_higher_layer(self):
        self.assertEqual(upwards(page()), [])

    def test_no_imports_form_a_circle(self):
        self.assertEqual(circles(page()), set())

    def test_imports_are_found(self):
        text = (
            'import {a} from "./a";\nimport type {B} from "../texts/b";\nimport {\n    c,\n} from "./c";\n'
            'export {d} from "./d";\nimport "./e.css";\nimport W from "./w?worker&inline";\n'
            'import {f} from "uqr";\n'
        )
        self.assertEqual(
            imports_of(text, PAGE / "dish"), {"dish/a", "texts/b", "dish/c", "dish/d", "dish/w"}
        )

    def test_circles_and_imports_from_higher_layers_are_found(self):
        graph = {
            "texts/a": {"engine/b"},
            "engine/b": {"engine/c"},
            "engine/c": {"texts/a"},
            "main": {"texts/a"},
        }
        self.assertEqual(circles(graph), {frozenset({"texts/a", "engine/b", "engine/c"})})
        self.assertEqual(upwards(graph), ["texts/a imports engine/b"])


if __name__ == "__main__":
    unittest.main()
