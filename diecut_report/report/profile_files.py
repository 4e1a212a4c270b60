"""Files for other programs that stand beside a report: profiles as tables (CSV) and as drawings (DXF)."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import TYPE_CHECKING

from diecut_report.quantities.units import unit
from diecut_report.report.chapters.tables import period_of
from diecut_report.report.scope import suffixes
from diecut_report.results.mechanism_record import CurveRecord, ExportRecord
from diecut_report.results.model import ResultsRecord

if TYPE_CHECKING:
    from ezdxf.document import Drawing

Point = tuple[float, float]
VERSION = "R2010"
PROFILE, PITCH_CURVE, CENTER = "PROFILE", "PITCH_CURVE", "CENTER"
LAYERS = {PROFILE: (7, "Continuous"), PITCH_CURVE: (5, "CENTER"), CENTER: (1, "Continuous")}  # colour, line type
AXIS = 0.02  # radius of the circle at the axis, of the greatest radius of the profile
MM = unit("mm")


Fault = tuple[str, ExportRecord, Exception]  # the mechanism's name, the export, and what went wrong


def written(results: ResultsRecord) -> tuple[dict[str, bytes], list[Fault]]:
    """Return the files of all exports, by what follows the report's name in theirs, and those exports that cannot be written.

    One that failed before is left out.
    """
    files: dict[str, bytes] = {}
    faults: list[Fault] = []
    for name, mechanism in results.calculated.items():
        for export in mechanism.exports:
            if export.error:
                continue
            try:
                curves = {column: mechanism.curves[column] for column in (export.abscissa, *export.columns)}
                own = suffixes(name, export)
                drawing = {own["dxf"]: profile_drawing(curves, export)} if export.type == "profile" else {}
                files |= drawing | {own["csv"]: table(curves)}
            except Exception as cause:
                faults.append((name, export, cause))
    return files, faults


def table(curves: Mapping[str, CurveRecord]) -> bytes:
    """Curves as columns in their display units; one row of heads, a row for each sample, to 15 digits."""
    units = [unit(curve.display_unit) for curve in curves.values()]
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n", quoting=csv.QUOTE_NONNUMERIC)
    writer.writerow(f"{name} [{curve.display_unit}]" for name, curve in curves.items())
    for row in zip(*(curve.values for curve in curves.values()), strict=True):
        writer.writerow(float(f"{shown.from_si(value):.15g}") for shown, value in zip(units, row, strict=True))
    return text.getvalue().encode()


def profile_drawing(curves: Mapping[str, CurveRecord], export: ExportRecord) -> bytes:
    """A profile, its pitch curve where it has one, and its axis, as DXF in millimetres; the same bytes for the same curves."""
    from ezdxf import units  # with the whole library, which takes half a second
    from ezdxf.filemanagement import new

    columns = export.columns
    closed = period_of(curves[export.abscissa]) is not None
    with _without_dates():
        drawing = new(VERSION, setup=["linetypes"], units=units.MM)
        drawing.header["$MEASUREMENT"] = 1
        for layer, (colour, line) in LAYERS.items():
            drawing.layers.add(layer, color=colour, linetype=line)
        paths = [_points(curves, *pair) for pair in zip(columns[0:4:2], columns[1:4:2], strict=True)]
        for layer, points in zip((PROFILE, PITCH_CURVE), paths, strict=False):
            drawing.modelspace().add_lwpolyline(points, close=closed, dxfattribs={"layer": layer})
        radius = AXIS * max(math.hypot(*point) for point in paths[0])
        drawing.modelspace().add_circle((0.0, 0.0), radius, dxfattribs={"layer": CENTER})
        _zoom(drawing, [point for points in paths for point in points])
        for kind in sorted(drawing.entitydb.dxf_types_in_use()):  # of itself ezdxf takes them in the order of a set
            drawing.classes.add_class(kind)
        text = io.StringIO()
        drawing.write(text)
        return text.getvalue().encode(drawing.output_encoding)


def _points(curves: Mapping[str, CurveRecord], x: str, y: str) -> list[Point]:
    strange = [name for name in (x, y) if unit(curves[name].unit).kind != MM.kind]
    if strange:
        raise ValueError(f"{strange[0]} is not a length and cannot be drawn")
    return [(MM.from_si(a), MM.from_si(b)) for a, b in zip(curves[x].values, curves[y].values, strict=True)]


def _zoom(drawing: Drawing, points: list[Point]) -> None:
    """What is drawn fills the view when the file is opened."""
    low, high = ([pick(point[axis] for point in points) for axis in (0, 1)] for pick in (min, max))
    drawing.header["$EXTMIN"], drawing.header["$EXTMAX"] = (*low, 0.0), (*high, 0.0)
    space = drawing.modelspace()
    space.dxf.extmin, space.dxf.extmax = (*low, 0.0), (*high, 0.0)
    middle = (low[0] + high[0]) / 2, (low[1] + high[1]) / 2
    drawing.set_modelspace_vport(1.1 * max(high[0] - low[0], high[1] - low[1]), middle)


@contextmanager
def _without_dates() -> Iterator[None]:
    """Without the time of writing and random identifiers, which ezdxf writes into every file."""
    from ezdxf import options  # type: ignore[attr-defined]  # public by its manual, not by its types

    before = options.write_fixed_meta_data_for_testing
    options.write_fixed_meta_data_for_testing = True
    try:
        yield
    finally:
        options.write_fixed_meta_data_for_testing = before
