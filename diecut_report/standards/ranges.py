"""Plausible values of inputs: in which range a quantity usually lies, and outside which it is a slip or needs a reason.

One table, ``data/ranges.yaml``, holds them for all kinds that come with the program; its head tells how it is written.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Annotated

import yaml
from pydantic import BaseModel, BeforeValidator, ConfigDict

from diecut_report.quantities.units import unit
from diecut_report.standards import DATA
from diecut_report.text.phrases import phrase

EVERY = "*"  # in place of a kind: a key of this name in any
SOURCES = {
    "H": phrase("handbooks of machine elements"),
    "M": phrase("makers' catalogues"),
    "P": phrase("practice of die-cutting"),
    "G": phrase("the mass of a full steel disc"),
    "I": phrase("the press itself"),
}


@dataclass(frozen=True)
class UsualRange:
    """Hold the usual range of a quantity and the hard one outside which no machine has it, both (least, greatest) in SI.

    ``unit`` is the one in which both are shown. ``of`` is empty where they bound the key itself; else it is the expression,
    such as ``${yield_strength} / ${tensile_strength}``, that they bound. A value of a key that ``needs_basis`` counts as assumed
    unless it rests on what can be looked up.
    """

    usual: tuple[float, float]
    hard: tuple[float, float]
    source: str
    needs_basis: bool
    unit: str
    of: str = ""


class _Row(BaseModel):
    """Hold a row as it is written, in ``unit``."""

    model_config = ConfigDict(extra="forbid")
    usual: tuple[float, float]
    hard: tuple[float, float]
    unit: str
    by: str
    needs_basis: bool = False
    keys: Annotated[dict[str, dict[str, str]], BeforeValidator(lambda given: _with_expressions(given))]

    def made(self, of: str) -> UsualRange:
        """Return the row for what a key or an expression gives."""
        (low, high), (least, most), factor = self.usual, self.hard, unit(self.unit).factor
        usual, hard = (low * factor, high * factor), (least * factor, most * factor)
        return UsualRange(usual, hard, SOURCES.get(self.by, self.by), self.needs_basis, self.unit, of)


class _Without(BaseModel):
    """Hold the keys that have no row, and why."""

    model_config = ConfigDict(extra="forbid")
    reason: str
    keys: dict[str, list[str]]
    needs_basis: bool = False
    by_reference: bool = False
    zero_is_open: bool = False
    unless: list[str] = []


class Choices(BaseModel):
    """Hold texts of keys that take something out of a calculation, and why they are open without a basis.

    They are so only where the keys of ``given`` are given too; where the parts of a machine make the calculation, ``typed_in_parts``
    says that they do not make this text.
    """

    model_config = ConfigDict(extra="forbid")
    reason: str
    keys: dict[str, dict[str, list[str]]]
    given: list[str] = []
    typed_in_parts: bool = False


class RangeTable(BaseModel):
    """Hold the table as it is written."""

    model_config = ConfigDict(extra="forbid")
    ranges: list[_Row]
    without: list[_Without]
    choices: list[Choices]


def _with_expressions(given: dict[str, list[str] | dict[str, str]]) -> dict[str, dict[str, str]]:
    return {kind: keys if isinstance(keys, dict) else dict.fromkeys(keys, "") for kind, keys in given.items()}


@cache
def range_table() -> RangeTable:
    """Return the table as it stands in its file."""
    loader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
    return RangeTable.model_validate(yaml.load((DATA / "ranges.yaml").read_text(encoding="utf-8"), loader))


@cache
def ranges_of(kind: str) -> Mapping[str, tuple[UsualRange, ...]]:
    """Return all rows of a kind of mechanism (or of ``press``) by key; none for a kind of somebody else."""
    found: dict[str, tuple[UsualRange, ...]] = {}
    for row in range_table().ranges:
        for key, of in row.keys.get(kind, {}).items():
            found[key] = (*found.get(key, ()), row.made(of))
    return found


def range_of(kind: str, path: str) -> UsualRange | None:
    """Return the range of an input by its dotted key without places in lists (``gears.efficiency``); None where it has no row.

    Of several rows it is the one that bounds the key itself.
    """
    return min(ranges_of(kind).get(path, ()), key=lambda row: bool(row.of), default=None)


@cache
def unranged(kind: str, is_alone: bool = True) -> Mapping[str, str]:
    """Return the keys of a kind that have no row, and ask for a basis all the same, each with the reason.

    Beside others a mechanism takes its loads and speeds from them; alone they are what it is calculated for.
    """
    groups = (group for group in range_table().without if group.needs_basis or (group.by_reference and not is_alone))
    return {key: phrase(group.reason) for group in groups for key in group.keys.get(kind, ())}


@cache
def by_reference(kind: str, path: str) -> bool:
    """Return whether a key takes what another mechanism of the machine gives, which no drawing founds."""
    return any(path in group.keys.get(kind, ()) for group in range_table().without if group.by_reference)


@cache
def zero_is_open(kind: str, path: str) -> Sequence[str] | None:
    """Return whether the default of a key is open although it is zero, which leaves something out: unless one of these keys stands beside it."""
    groups = (group for group in range_table().without if group.zero_is_open and path in group.keys.get(kind, ()))
    return next((group.unless for group in groups), None)


def asks_basis(kind: str, path: str, is_alone: bool = True) -> bool:
    """Return whether a value of a key counts as assumed unless it rests on what can be looked up."""
    usual = range_of(kind, path)
    return path in unranged(kind, is_alone) or (usual is not None and usual.needs_basis)


@cache
def open_choices(kind: str) -> Mapping[tuple[str, str], Choices]:
    """Return the texts of keys of a kind that ask for a basis, each with its row."""
    rows = ((row, row.keys.get(kind, {})) for row in range_table().choices)
    return {(key, text): row for row, own in rows for key, texts in own.items() for text in texts}
