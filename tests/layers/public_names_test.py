"""paper, examples and bench are customers of the Python module: they use its public names only."""

import ast
import json
import os
import pathlib
import unittest

SOURCE = pathlib.Path(os.environ.get("SWIRL_SOURCE", pathlib.Path(__file__).parents[2]))
CUSTOMERS = ("paper", "examples", "bench")


def is_private(name):
    return any(
        part.startswith("_") and not part.startswith("__") for part in (name or "").split(".")
    )


def root_of(node):
    """The name at the beginning of a chain of attributes, such as swirl.plot.density."""
    while isinstance(node, ast.Attribute):
        node = node.value
    return node.id if isinstance(node, ast.Name) else None


def private_names(code):
    """The private names of the module in this code."""
    for node in ast.walk(ast.parse(code)):
        if isinstance(node, ast.Attribute) and is_private(node.attr) and root_of(node) == "swirl":
            yield f"swirl.{node.attr}"
        elif isinstance(node, ast.Import):
            names = [alias.name for alias in node.names if alias.name.split(".")[0] == "swirl"]
            yield from filter(is_private, names)
        elif isinstance(node, ast.ImportFrom) and (node.module or "").split(".")[0] == "swirl":
            yield from filter(is_private, [f"{node.module}.{name.name}" for name in node.names])


def code_of(file):
    text = file.read_text(encoding="utf-8")
    if file.suffix == ".py":
        return text
    cells = [cell for cell in json.loads(text)["cells"] if cell["cell_type"] == "code"]
    lines = "".join("".join(cell["source"]) + "\n" for cell in cells).splitlines(keepends=True)
    return "".join(line for line in lines if not line.lstrip().startswith(("%", "!")))


class PublicNames(unittest.TestCase):
    def test_customers_of_the_module_use_no_private_name(self):
        files = [
            file
            for folder in CUSTOMERS
            for file in sorted((SOURCE / folder).rglob("*"))
            if file.suffix in (".py", ".ipynb")
        ]
        self.assertGreater(len(files), 100)
        wrong = {
            f"{file.relative_to(SOURCE)}: {name}"
            for file in files
            for name in private_names(code_of(file))
        }
        self.assertEqual(wrong, set())

    def test_private_names_are_found(self):
        for code in (
            "swirl._engine.version()",
            "swirl.plot._axes(None)",
            "from swirl import _engine",
            "from swirl._means import mean",
            "import swirl._engine as engine",
        ):
            self.assertTrue(list(private_names(code)), code)
        for code in (
            "swirl.mean([1, 2])",
            "swirl.__version__",
            "self._engine",
            "import swirl.plot",
        ):
            self.assertFalse(list(private_names(code)), code)


if __name__ == "__main__":
    unittest.main()
