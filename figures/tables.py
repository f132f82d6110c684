"""Reading the tables that `swirl paper` writes. Python's standard library only."""

import csv


def read(table):
    """The rows of a CSV table: numbers as floats, an empty cell as NaN, anything else as text."""

    def value(cell):
        if cell == "":
            return float("nan")
        try:
            return float(cell)
        except ValueError:
            return cell

    with open(table, newline="") as file:
        return [{name: value(cell) for name, cell in row.items()} for row in csv.DictReader(file)]


def select(rows, **wanted):
    return [row for row in rows if all(row[name] == value for name, value in wanted.items())]


def column(rows, name):
    return [row[name] for row in rows]
