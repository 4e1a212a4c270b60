"""The sheets of a report's workbook: summary, inputs, results, checks, phases, and the curves of each mechanism."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from diecut_report.quantities.units import pretty, to_display
from diecut_report.report.context import Material
from diecut_report.report.model import STATUSES
from diecut_report.report.scope import parts, scope
from diecut_report.report.text import Catalogue, significant
from diecut_report.report.text import parts as sheet_parts
from diecut_report.results.mechanism_record import (
    CheckRecord,
    CurveRecord,
    MechanismRecord,
    QuantityRecord,
    ShownRecord,
)
from diecut_report.results.model import ResultsRecord
from diecut_report.text.phrases import worded

# A sheet of a workbook as data: its name, its heads, and rows of texts and numbers with the digits that they show.


LONGEST_NAME = 31  # letters of a sheet's name
LONGEST_TEXT = 32_767  # letters of a cell
_FORBIDDEN = re.compile(r"[\[\]:*?/\\\x00-\x1f]")
_NOT_IN_A_NAME = re.compile(r"[^\w.]", re.ASCII)


class CellNumber(NamedTuple):
    """A number with the format in which a cell shows it."""

    value: float
    form: str = "General"


Cell = str | CellNumber | None


@dataclass
class WorkSheet:
    """A sheet; its heads stay in view. ``names`` are names by which formulas find a cell: name, row and column, counted from 1.

    ``bars`` are the columns, counted from 0, that a chart below the rows draws as bars over the names in the first column.
    """

    title: str
    heads: list[list[str]]
    rows: list[list[Cell]]
    widths: list[int]
    names: dict[str, tuple[int, int]] = field(default_factory=dict)
    held: int = 1  # columns that stay in view
    is_filtered: bool = False  # whether its heads choose among its rows
    bars: list[int] = field(default_factory=list)


def form_of(text: str) -> str:
    """Return the format of a cell that shows as many digits as a number's text has: ``105.0`` → 0.0, ``1.2e-05`` → 0.0E+00."""
    found = sheet_parts(text)
    if found is None:
        return "General"
    decimals = "." + "0" * len(found[2]) if found[2] else ""
    return f"0{decimals}" + ("E+00" if found[3] else "")


def shown(value: Any, display: ShownRecord) -> CellNumber | str:
    """Return a value of the results in its display unit, a number with its digits where it is one, else its text."""
    if isinstance(value, bool) or not isinstance(value, int | float) or sheet_parts(display.text) is None:
        return str(display.text)
    return CellNumber(converted(value, display.unit), form_of(display.text))


def converted(value: float, unit: str) -> float:
    """Return an SI value in a display unit, to 15 digits: no more are right."""
    return float(f"{to_display(value, unit):.15g}")


def printed(text: str) -> Cell:
    """Return what stands as a text in the results as a number, where it is one."""
    return CellNumber(float(text), form_of(text)) if sheet_parts(text) is not None else text


def sheet_names(titles: Iterable[str]) -> list[str]:
    """Return names that a workbook takes: without the signs of references, short, no two alike whatever the case of their letters."""
    found: dict[str, str] = {"history": ""}  # which spreadsheets keep for themselves
    for title in titles:
        plain = _FORBIDDEN.sub("_", title).strip("' ") or "_"
        name, number = plain[:LONGEST_NAME], 1
        while name.casefold() in found:
            number += 1
            name = f"{plain[: LONGEST_NAME - len(str(number)) - 1]} {number}"
        found[name.casefold()] = name
    return list(found.values())[1:]


def defined_name(path: str, taken: Iterable[str]) -> str:
    """Return a name of a cell: ``drive.crank_torque_peak`` as it is, what a name may not hold as ``_``; unlike those that are taken."""
    plain = _NOT_IN_A_NAME.sub("_", path)[:200]
    plain = plain if re.match(r"[A-Za-z_]", plain) and "." in plain else f"_{plain}"
    others, name, number = {each.casefold() for each in taken}, plain, 1
    while name.casefold() in others:
        number += 1
        name = f"{plain}_{number}"
    return name


MOST_CURVE_ROWS = 400  # of a curve; of one with more points every second, third … is given
PROJECT = {
    "document": "document_number",
    "revision": "revision",
    "date": "date",
    "organisation": "organisation",
    "department": "department",
}
DIGITS = 6  # of a curve's greatest value
SHARE = "0.0%"
# heads of `_quantity`, its mechanism and key
QUANTITY = "mechanism path description symbol value unit si_value si_unit"


def sheets(material: Material) -> list[WorkSheet]:
    """Return all sheets of a report, whatever its detail; of the mechanisms that it shows."""
    results, words = scope(material.said).results, material.words
    whole = [_summary(material), _inputs(results, words), _results(results, words), _checks(results, words)]
    phases = _phases(results, words)
    curves = [_curves(name, data, words) for name, data in parts(results) if data.curves]
    return [*whole, *([phases] if phases.rows else []), *curves]


def _summary(material: Material) -> WorkSheet:
    document, words = material.document, material.words
    project = [(words[key], document.project[name]) for key, name in PROJECT.items() if document.project[name]]
    project += [(words["status"], document.block.status)]
    project += [(words[role], who) for role, who in document.block.signers if who]
    governing = document.governing
    told = [
        (words["press"], document.press.name),
        *document.facts,
        *project,
        (words["verdict"], " ".join([document.verdict, *(f"{count}." for count in document.counts)])),
        *([(words["governing"], f"{governing.mechanism}: {governing.title}, {governing.used}")] if governing else []),
        *((words["fail"], f"{row.mechanism}: {row.title}. {row.message}") for row in document.failures),
        *(("", note) for note in document.notes),
        *(
            (words["not_covered"], f"{each.text} {words.say('owned_by', owner=each.owner or words['no_owner'])}")
            for each in document.not_covered
        ),
        (words["calculated_by"], f"{document.program.name} {document.program.version}"),
        (words["config_file"], document.config.file),
        (words["sha256"], document.config.sha256),
    ]
    heads = ["mechanism", "description", *STATUSES, "verdict"]
    rows: list[list[Cell]] = [*([name, text] for name, text in told), [], [words[head] for head in heads]]
    for c in document.chapters:
        counts = (CellNumber(c.count(status), "0") for status in STATUSES)
        rows.append([c.name, c.title, *counts, words[c.face]])
    title = [document.project["document_type"], document.title]
    return WorkSheet(words["summary"], [title], rows, [22, 70, 12, 12, 12, 14, 14])


def _sheet(words: Catalogue, title: str, heads: str, rows: list[list[Cell]], widths: list[int], held: int) -> WorkSheet:
    """A sheet by words of the catalogue; a column without one is headed by a dot."""
    named = ["" if head == "." else words[head] for head in heads.split()]
    return WorkSheet(words[title], [named], rows, widths, held=held)


def _inputs(results: ResultsRecord, words: Catalogue) -> WorkSheet:
    given = [("", row.path, row) for row in results.press.fields]
    given += [(name, key, row) for name, data in parts(results) for key, row in data.inputs.items()]
    rows: list[list[Cell]] = []
    for name, key, row in given:
        origin = row.origin or "given"
        typed = row.text or (row.path if origin != "given" else "")
        rows.append(
            [name, key, *_quantity(row), words[row.basis or "given"], row.note, words[origin], str(typed or "")]
        )
    widths = [16, 28, 52, 9, 14, 11, 16, 11, 14, 30, 16, 30]
    return _sheet(words, "inputs", f"{QUANTITY} basis note origin typed", rows, widths, 2)


def _quantity(row: QuantityRecord) -> list[Cell]:
    cell, named = shown(row.value, row.display), [row.description, row.symbol]
    if isinstance(cell, CellNumber) and isinstance(row.value, int | float):
        return [*named, cell, pretty(row.display.unit), CellNumber(row.value), pretty(row.unit)]
    return [*named, worded(str(cell)), pretty(row.display.unit), None, ""]


def _results(results: ResultsRecord, words: Catalogue) -> WorkSheet:
    """The results; each value has its name: ``drive.crank_torque_peak``."""
    widths = [16, 30, 52, 9, 14, 11, 16, 11, 14, 11, 10, 40]
    sheet = _sheet(words, "results", f"{QUANTITY} place unit key_result source", [], widths, 2)
    for name, data in parts(results):
        for key, row in data.outputs.items():
            place: list[Cell] = [None, ""]
            if at := row.at:
                is_number = at.value is not None
                value = (
                    CellNumber(converted(at.value or 0.0, at.unit), form_of(at.text)) if is_number else printed(at.text)
                )
                place = [value, f"{pretty(at.unit)} ({at.symbol})"]
            is_key = words["yes"] if row.key else ""
            sheet.rows.append([name, key, *_quantity(row), *place, is_key, row.source])
            sheet.names[defined_name(f"{name}.{key}", sheet.names)] = (len(sheet.rows) + 1, 5)
    return sheet


def _checks(results: ResultsRecord, words: Catalogue) -> WorkSheet:
    heads = "mechanism path check class verdict demand . limit unit utilisation margin message missing source"
    rows = [_check(name, check, words) for name, data in parts(results) for check in data.checks]
    return _sheet(words, "checks", heads, rows, [16, 24, 44, 11, 12, 14, 4, 14, 11, 11, 14, 70, 30, 40], 3)


def _check(name: str, check: CheckRecord, words: Catalogue) -> list[Cell]:
    sides, share = (check.demand_display, check.limit_display, check.margin_display), check.utilisation
    unit = next((display.unit for display in sides if display), "1")
    demand, limit = _side(check.demand, sides[0], unit), _side(check.limit, sides[1], unit)
    margin: Cell = None  # with the digits that the report prints
    if sides[2] and isinstance(demand, CellNumber) and isinstance(limit, CellNumber):
        form = form_of(sides[2].text) if sides[2].unit == unit else "General"
        margin = CellNumber(float(f"{limit.value - demand.value:.15g}"), form)
    return [
        name, check.id, check.title, words[f"class_{check.check_class}"], words[check.status],
        demand, check.operator, limit, pretty(unit), None if share is None else CellNumber(share, SHARE), margin,
        check.message, ", ".join(check.missing), check.source,
    ]  # fmt: skip


def _side(value: float | None, display: ShownRecord | None, unit: str) -> Cell:
    """Return a side of a check as a number of the unit that all of the check stands in."""
    if value is None or display is None:
        return None
    return shown(value, display) if display.unit == unit else CellNumber(converted(value, unit))


def _phases(results: ResultsRecord, words: Catalogue) -> WorkSheet:
    rows: list[list[Cell]] = []
    every = ((name, key, phase) for name, data in parts(results) for key, phase in data.phases.items())
    for name, key, phase in every:
        unit = phase.display.unit
        for (start, end), shown in zip(phase.intervals, phase.display.intervals, strict=True):
            places = ((shown.begin, start), (shown.to, end), (shown.length, end - start))
            ends = [CellNumber(converted(value, unit), form_of(text)) for text, value in places]
            time = printed(shown.time) if shown.time else None
            rows.append([name, key, phase.description, words[f"role_{phase.role}"], *ends, pretty(unit), time])
    heads = "mechanism path phase role from to length unit time_ms"
    return _sheet(words, "phases", heads, rows, [16, 20, 50, 18, 12, 12, 12, 9, 12], 2)


def _curves(name: str, data: MechanismRecord, words: Catalogue) -> WorkSheet:
    columns = list(_columns(data.curves))
    heads = [[f"{key} [{pretty(curve.display_unit) or '1'}]" for key, curve in columns]]
    heads.append([f"{curve.description} {curve.symbol}".strip() for _, curve in columns])
    values = [_samples(curve) for _, curve in columns]
    longest = max(map(len, values), default=0)
    rows: list[list[Cell]] = [[each[row] if row < len(each) else None for each in values] for row in range(longest)]
    return WorkSheet(name, heads, rows, [18] * len(columns))


def _columns(curves: Mapping[str, CurveRecord]) -> Iterator[tuple[str, CurveRecord]]:
    axes = dict.fromkeys(curve.abscissa for curve in curves.values() if curve.abscissa)
    for axis in axes:
        yield axis, curves[axis]
        yield from ((key, curve) for key, curve in curves.items() if curve.abscissa == axis and key not in axes)


def _samples(curve: CurveRecord) -> list[Cell]:
    """Return a curve's values in its display unit, with as many digits as its greatest one asks for; of very many some, evenly."""
    step = -(-len(curve.values) // MOST_CURVE_ROWS) or 1
    values = [converted(value, curve.display_unit) for value in curve.values[::step]]
    form = form_of(significant(max(map(abs, values), default=0.0), DIGITS))
    return [CellNumber(value, form) for value in values]
