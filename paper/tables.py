"""Reads the tables that `swirl paper` writes, with Python's standard library only."""

import csv
import os

from paper import optional_file

# The columns of the rotation rates.
RATES = ("mean_by_time", "mean_by_event", "rigid_by_time", "rigid_by_event")


def read(table):
    """The rows of a CSV table as dictionaries: numbers are floats, an empty cell is NaN, anything
    else is text."""

    def value(cell):
        if cell == "":
            return float("nan")
        try:
            return float(cell)
        except ValueError:
            return cell

    with open(table, newline="", encoding="utf-8") as file:
        return [{name: value(cell) for name, cell in row.items()} for row in csv.DictReader(file)]


def companion(table, ending):
    """The rows of a second table of a figure, such as figure_5b_crossings.csv; none if it does not
    exist."""
    stem, kind = os.path.splitext(table)
    file = f"{stem}{ending}{kind}"
    return read(file) if optional_file.exists(file) else []


def select(rows, **columns):
    """The rows whose columns have these values."""
    return [row for row in rows if all(row[name] == value for name, value in columns.items())]


def distinct(rows, name):
    """The distinct values of a column, sorted."""
    return sorted({row[name] for row in rows})


def column(rows, name):
    return [row[name] for row in rows]
