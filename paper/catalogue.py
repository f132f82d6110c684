"""All figures: the files of paper/figures and paper/chapters. As a script, it lists them, or
checks the names in its arguments."""

import difflib
import glob
import importlib
import os
import re
import sys

from paper.console import Problem

FOLDER = os.path.dirname(os.path.abspath(__file__))
# The first words of each figure in its file, which can be listed without importing it.
ENTRY = re.compile(r'Figure\(\s*"([^"]+)",\s*"([^"]+)",\s*"([^"]+)"')
# Pinning and depinning have no figure in the paper; they follow Figure 3.
SORTED_AS = {"pinning": "3c"}
# The order of the report within a group. A figure that is not listed here comes last.
ORDER = (
    "ball states times 5b-start 5b-steady averages friction inertia restitution tangential polygon "
    "map transient energy "
    "condensation spheres spheres_friction spheres_few settling spheres_ingredients "
    "spheres_ingredients_rough size amplitude "
    "critical hysteresis lifetimes coexistence turns cause torque gears gear_order contacts "
    "material_inertia material_friction "
    "material_tangential fields closure cooling scherer"
).split()
GROUPS = {
    "paper": "the figures of the paper",
    "beyond": "parameters, averages and times that the paper does not show",
    "rolling": "spheres that roll on the floor",
    "chapters": "questions that the paper leaves open",
}


def entries():
    """[(name, group, description, module)] in the order of the report."""
    found = []
    for folder in ("figures", "chapters"):
        for file in glob.glob(os.path.join(FOLDER, folder, "*.py")):
            with open(file, encoding="utf-8") as text:
                module = f"{folder}.{os.path.basename(file)[:-len('.py')]}"
                found += [(*entry, module) for entry in ENTRY.findall(text.read())]
    for name, group, _, module in found:
        if group not in GROUPS:
            raise Problem(
                f"the figure '{name}' in {module.replace('.', '/')}.py has the group '{group}'.\n"
                f"hint: the groups are {', '.join(GROUPS)}.",
                2,
            )
    return sorted(
        found,
        key=lambda entry: (
            list(GROUPS).index(entry[1]),
            SORTED_AS.get(entry[0], entry[0]) if entry[1] == "paper" else "",
            ORDER.index(entry[0]) if entry[0] in ORDER else len(ORDER),
            entry[0],
        ),
    )


def drawing(name):
    """The function that draws the table figure_NAME.csv; None if there is no such drawing."""
    known = any(entry[0] == name for entry in entries())
    return named([name])[0].draw if known else None


def check(names):
    """Raises Problem if one of these names is not that of a figure, of a group, or "all"."""
    known = ["all", *GROUPS, *(entry[0] for entry in entries())]
    for name in names:
        if name not in known:
            near = difflib.get_close_matches(name, known, 1)
            raise Problem(
                f"--figure is '{name}', but it must be one of: {', '.join(known)}."
                + (f"\nhint: did you mean '{near[0]}'?" if near else ""),
                2,
            )


def named(names):
    """The figures with these names, which may be names of groups or "all"; each once."""
    check(names)
    wanted = [entry for name in names for entry in entries() if name in ("all", entry[0], entry[1])]
    return [loaded(*entry) for entry in dict.fromkeys(wanted)]


def loaded(name, group, description, module):
    """The figure. If its file cannot be imported, one whose points and drawing raise the error: it
    fails alone."""
    try:
        return next(
            figure
            for figure in importlib.import_module(f"paper.{module}").FIGURES
            if figure.name == name
        )
    except Exception as error:
        from paper.figure import Figure

        def fail(*_, error=error):
            raise error

        return Figure(name, group, description, fail, fail, fail)


def main():
    if sys.argv[1:]:
        try:
            return check(sys.argv[1:])
        except Problem as problem:
            print(problem, end="")
            sys.exit(problem.code)
    print("Groups of figures:\n  all                 all figures, and the report")
    for name, description in GROUPS.items():
        print(f"  {name:<19} {description}")
    print("\nFigures:")
    for name, _, description, _ in entries():
        print(f"  {name:<19} {description}")
