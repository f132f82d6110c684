"""What a figure is: one file of paper/figures or paper/chapters with FIGURES, a list of Figure."""

import dataclasses
import os
from collections.abc import Callable
from typing import Optional

from paper.curves import write_table


@dataclasses.dataclass
class Figure:
    """`points(settings)` lists study.Point; `table(points, settings)` returns ({ending: rows},
    findings), where the ending "" is that of the table figure_NAME.csv; `draw(file)` draws this
    table to PNG and PDF next to it. The first three are literal strings without keywords, since
    catalogue.ENTRY reads them from the text of the file."""

    name: str
    group: str  # one of catalogue.GROUPS
    description: str  # one line; its first words select one of captions.SECTIONS
    points: Callable
    table: Callable
    draw: Optional[Callable] = None
    caption: str = ""  # in the report; those of older figures are in captions.py

    def write(self, points, settings):
        """Writes the tables. Returns (findings, files)."""
        tables, findings = self.table(points, settings)
        files = []
        for ending, rows in tables.items():
            files.append(os.path.join(settings.out, f"figure_{self.name}{ending}.csv"))
            rows, columns = rows if isinstance(rows, tuple) else (rows, None)
            write_table(files[-1], rows, columns)
        return findings, files
