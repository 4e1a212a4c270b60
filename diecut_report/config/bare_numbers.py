"""Numbers without a unit that their key's own unit makes absurd and another unit usual: crank_length: 0.16 is 0.16 mm, and 0.16 m is meant.

What is usual of a key is near the value of the example and the default of its mechanism kind. Only bare numbers are asked about: who types
the unit has answered.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from contextlib import suppress
from typing import Any

from diecut_report.config.instances import Instance, Slot
from diecut_report.config.validation import keys_of
from diecut_report.errors import Problem
from diecut_report.mechanism.inputs import Quantity
from diecut_report.mechanism.mechanism import Wired
from diecut_report.quantities.units import Unit, UnitError, decades, number_and_unit, parse_quantity, pretty

FAR = 100  # times greater or less than what is usual: a number that is asked about
NEAR = 10  # and one in the unit that may be meant


def bare_numbers(instance: Instance) -> Iterator[Problem]:
    """Yield a question for each number of a mechanism, or of the press, that its unit makes absurd and another one usual."""
    for slot in instance.slots:
        if slot.is_given and isinstance(slot.meta, Quantity) and slot.meta.unit != "1":
            number = _bare(slot.value)
            usual = _usual(instance, slot, slot.meta) if number else []
            meant = _meant(number, slot.meta.parsed_unit, usual)
            if meant is not None:
                template = "is {number} without a unit, which is {own} here; {other} is usual. Write the one that is meant, with its unit."
                own, other = (f"{number:.15g} {pretty(each.text)}" for each in (slot.meta.parsed_unit, meant))
                yield instance.place.problem(slot.key, template, number=f"{number:.15g}", own=own, other=other)


def _bare(value: Any) -> float:
    """The number of a value that has no unit; 0, of which nothing is asked, for anything else."""
    if isinstance(value, str):
        with suppress(UnitError):
            number, own = number_and_unit(value)
            return 0.0 if own else float(number)
        return 0.0
    return float(value) if isinstance(value, int | float) and not isinstance(value, bool) else 0.0


def _meant(number: float, own: Unit, usual: list[float]) -> Unit | None:
    """The unit in which a number is near a usual value, where it is far from all of them in its own."""
    sizes = [abs(value) for value in usual if value]

    def distance(given: Unit) -> float:
        return min(abs(math.log10(abs(number) * given.factor / size)) for size in sizes)

    if not number or not sizes or distance(own) < math.log10(FAR):
        return None
    near = min(decades(own), key=distance, default=own)
    return near if distance(near) <= math.log10(NEAR) else None


def _usual(instance: Instance, slot: Slot, meta: Quantity) -> list[float]:
    """The values of a key in the example of its kind, and its default, SI."""
    example = instance.mechanism.example if instance.mechanism else None
    found = list(_numbers(example.inputs, slot.name.split("."), meta)) if example else []
    known = keys_of(instance.model).get(str(slot.key[0])) if len(slot.key) == 1 else None
    return [*found, *_numbers(known.default if known else None, [], meta)]


def _numbers(given: Any, path: list[str], meta: Quantity) -> Iterator[float]:
    """Yield the quantities at a path of an example, of the parts of a list each; what is referred to has none."""
    match given:
        case Wired():
            yield from _numbers(given.value, path, meta)
            yield from _numbers(given.otherwise, path, meta)
        case list() | tuple():
            for part in given:
                yield from _numbers(part, path, meta)
        case Mapping():
            key, *rest = path or ["value"]
            yield from _numbers(given.get(key), rest, meta)
        case str() | int() | float() if not path:
            with suppress(UnitError):
                yield parse_quantity(given, meta.unit)
