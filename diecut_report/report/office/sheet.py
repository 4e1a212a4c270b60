"""A sheet of a workbook as data: its name, its heads, and rows of texts and numbers with the digits that they show."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from diecut_report.quantities.units import to_display
from diecut_report.report.number_format import parts

Data = Mapping[str, Any]
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
    """A sheet; its heads stay in view. ``names`` are names by which formulas find a cell: name, row and column, counted from 1."""

    title: str
    heads: list[list[str]]
    rows: list[list[Cell]]
    widths: list[int]
    names: dict[str, tuple[int, int]] = field(default_factory=dict)
    held: int = 1  # columns that stay in view


def form_of(text: str) -> str:
    """Return the format of a cell that shows as many digits as a number's text has: ``105.0`` → 0.0, ``1.2e-05`` → 0.0E+00."""
    found = parts(text)
    if found is None:
        return "General"
    decimals = "." + "0" * len(found[2]) if found[2] else ""
    return f"0{decimals}" + ("E+00" if found[3] else "")


def shown(value: Any, display: Data) -> Cell:
    """Return a value of the results in its display unit, a number with its digits where it is one, else its text."""
    if isinstance(value, bool) or not isinstance(value, int | float) or parts(display["text"]) is None:
        return str(display["text"])
    return CellNumber(converted(value, display["unit"]), form_of(display["text"]))


def converted(value: float, unit: str) -> float:
    """Return an SI value in a display unit, to 15 digits: no more are right."""
    return float(f"{to_display(value, unit):.15g}")


def si(value: Any) -> Cell:
    """Return a value as it is calculated."""
    if isinstance(value, bool) or not isinstance(value, int | float):
        return None
    return CellNumber(value)


def printed(text: str) -> Cell:
    """Return what stands as a text in the results as a number, where it is one."""
    return CellNumber(float(text), form_of(text)) if parts(text) is not None else text


def sheet_names(titles: Iterable[str]) -> list[str]:
    """Return names that a workbook takes: without the signs of references, short, no two alike whatever the case of their letters."""
    found: dict[str, str] = {}
    for title in titles:
        plain = _FORBIDDEN.sub("_", title).strip("' ") or "_"
        name, number = plain[:LONGEST_NAME], 1
        while name.casefold() in found or name.casefold() == "history":  # which spreadsheets keep for themselves
            number += 1
            name = f"{plain[: LONGEST_NAME - len(str(number)) - 1]} {number}"
        found[name.casefold()] = name
    return list(found.values())


def defined_name(path: str, taken: Iterable[str]) -> str:
    """Return a name of a cell: ``drive.crank_torque_peak`` as it is, what a name may not hold as ``_``; unlike those that are taken."""
    plain = _NOT_IN_A_NAME.sub("_", path)[:200]
    plain = plain if re.match(r"[A-Za-z_]", plain) and "." in plain else f"_{plain}"
    others, name, number = {each.casefold() for each in taken}, plain, 1
    while name.casefold() in others:
        number += 1
        name = f"{plain}_{number}"
    return name
