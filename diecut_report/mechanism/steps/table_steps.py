"""What steps have in common that take from tables and series: a number given in their place, the key to change, units, sources."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from functools import cache
from typing import Any

import numpy as np

from diecut_report.errors import nearest
from diecut_report.formulas import Array
from diecut_report.mechanism.inputs import Quantity
from diecut_report.mechanism.steps.base import QuantityStep
from diecut_report.mechanism.steps.protocols import Item, MachineValues, Names, StepPrinter
from diecut_report.quantities.formatting import si
from diecut_report.quantities.units import unit
from diecut_report.standards.tables import Column, StandardSeries, StandardTable, sources_told
from diecut_report.text.phrases import Phrase, phrase

SAME = 1e-9  # relative difference within which a number is that of a row
AS_GIVEN = "as given"


@dataclass(frozen=True, eq=False)
class TableStep(QuantityStep):
    """Take a quantity from a table or series, unless the optional input ``given`` has it; ``key`` is the input to change where it cannot."""

    given: str = field(default="", kw_only=True)
    key: str = field(default="", kw_only=True)

    @property
    def own_names(self) -> frozenset[str]:
        return frozenset((self.given,))

    @property
    def instead(self) -> str:
        return self.given


def column_title(column: Column) -> str:
    """Return what messages call a column of a table, which is the table itself where it has but one."""
    return Phrase("the column {name} of the table", name=column.name) if column.name else phrase("the table")


def given_of(calc: MachineValues, given: str) -> Any:
    """Return what is given in place of the table's number: of all parts, or a tuple with None for those without; None where nothing is."""
    return calc.inputs.get(given.removeprefix("inputs.")) if given else None


def as_given(page: StepPrinter, given: str) -> Item:
    """Return what is printed of a number that is given in place of the table's."""
    declared = page.calc.meta[given.removeprefix("inputs.")]
    return {"type": "lookup", "by": declared.description, "key": AS_GIVEN, "table": ""}


def sources(taken_from: object) -> Item:
    """Return the published tables that agree on a standard value."""
    return {"note": sources_told(taken_from)} if isinstance(taken_from, StandardTable | StandardSeries) else {}


def given_faults(step: Any, other: str, taken: str, names: Names) -> Iterator[str]:
    """Yield what is wrong with the input that may stand in the table's place; ``other`` is the field of what is ``taken``."""
    path = step.given.removeprefix("inputs.")
    if not path:
        return
    keys = names.world.keys
    key, by = keys.get(path), keys.get(taken)
    if key is None or not isinstance(key.meta, Quantity):
        known = [name for name, each in keys.items() if isinstance(each.meta, Quantity)]
        template = "given is {path}, which is not an input that is a number{nearest}"
        yield Phrase(template, path=path, nearest=nearest(path, known))
        return
    if not key.may_be_absent or key.has_default:
        yield Phrase("given is {path}, which is always there; let it be float | None with the default None", path=path)
    if by is not None and by.home != key.home:
        template = "given is {path}, {other} is {second}; both must be inputs of one list, or of none"
        yield Phrase(template, path=path, other=other, second=by.path)
    yield from unlike_units(Phrase("given, {path},", path=path), key.meta.unit, step.all_units, phrase("the step"))


def key_faults(key: str, taken: str, names: Names, is_covered: bool, beyond: str) -> Iterator[str]:
    """Yield what is wrong with the input at which an impossible machine is told."""
    inputs = [name for name in names.world.keys if "=" not in name]
    if key and key not in inputs:
        yield Phrase("key is {key}, which is not an input{nearest}", key=key, nearest=nearest(key, inputs))
    elif not key and taken.removeprefix("inputs.") not in inputs and not is_covered:
        template = 'takes {taken}, which may {where}; name the input that is then to be changed, key="…"'
        yield Phrase(template, taken=taken, where=beyond)


def key_to_change(step: Any, taken: str, calc: MachineValues, part: int) -> str:
    """Return the input to change where a table has nothing for what is taken; of a list that of the part."""
    key: str = step.key or taken.removeprefix("inputs.")
    home = calc.axis.get(step.id)
    is_of_list = home and home not in calc.domains and key.startswith(f"{home}.")
    return f"{home}.{part}{key.removeprefix(str(home))}" if is_of_list else key


@cache
def si_values(values: Iterable[Any], unit_text: str) -> Array:
    """Return the SI values of a series or a column: 36 of mm are the 36 mm that somebody types, to the last digit."""
    return np.array([si(each, unit_text) for each in values])


def unlike_units(what: str, own: str, wanted: set[str], whose: str) -> Iterator[str]:
    """Yield the unit of a table beside that of the quantity it is for; unknown units are told where they are declared."""
    try:
        is_alike = not wanted or any(unit(each).kind == unit(own).kind for each in wanted)
    except ValueError:
        return
    if not is_alike:
        template = "{what} is in {own}, {whose} in {units}"
        yield Phrase(template, what=what, own=own, whose=whose, units=", ".join(sorted(wanted)))
