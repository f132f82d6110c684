"""A map of a measurement, for a rotating and a counterrotating cluster."""

from combine import failed, steadiness
from paper_parameters import COUNTERROTATING_N, ROTATING_N
from runs import HIGH, measured_point


def points(settings):
    return [measured_point(settings, HIGH, discs) for discs in (ROTATING_N, COUNTERROTATING_N)]


def table_of(measurement, columns):
    def table(points, settings):
        rows = [{"discs": point.cells["discs"], "steady_state": steadiness(point.result), **dict(zip(columns, cells))}
                for point in points if not failed(point.result)
                for cells in zip(*(point.result["measured"][measurement][column] for column in columns))]
        return {"": (rows, ["discs", "steady_state", *columns])}, []
    return table
