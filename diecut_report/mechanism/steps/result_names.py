"""The names of what steps give: made here for all who show or store results, and read back for all who are given a name.

A step gives one quantity, its value under the step's id. An extreme also gives its place, ``ID_at``. Crossings are
``ID_count`` and then ``ID_1``, ``ID_2`` … A row over repeated parts is ``ID.0``, ``ID.1`` …, or has names of its own by the
pattern ``numbered`` (``shaft_{}_speed``), counted from ``first`` on; or, with ``named_by``, after the parts: ``NAME_ID``.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain

from diecut_report.mechanism.steps.base import ResultName, Role, SilentStep, Step

MOST_NAMED = 99
"""So many crossings or parts may be named before a machine is calculated; how many it has shows in calculating."""

CROSSING_COLUMNS = 8
"""So many crossings of a curve have columns of their own in a study, where each column is there for all variants."""

INDEX = re.compile(r"(?<=[_,])[ijk]$")
"""The letter that stands for a part's number at the end of a row's symbol: ``ω_k``, ``P_V,k``."""


@dataclass(frozen=True)
class Pattern:
    """Describe how the parts of a row, or the crossings of a curve, are named: a number from ``first`` on between head and tail."""

    head: str
    tail: str
    first: int

    @property
    def is_path(self) -> bool:
        """Return whether the number is a key of its own, as a list's parts have it."""
        return self.head.endswith(".")

    @property
    def family(self) -> str:
        """Return what is numbered: ``shaft`` of ``shaft_{}_speed``."""
        return self.head.rstrip("._")

    @property
    def quantity(self) -> str:
        """Return what is said of each: ``speed`` of ``shaft_{}_speed``; none where the family is of one quantity alone."""
        return self.tail.lstrip("._")

    def name(self, step: Step, index: int) -> ResultName:
        """Return the name of a part or crossing."""
        number = self.first + index
        role: Role = "crossing" if step.is_counted else "part"
        printed = number + 1 if self.is_path and not self.first else number
        return ResultName(f"{self.head}{number}{self.tail}", step.id, role, index, printed)

    def index(self, name: str) -> int | None:
        """Return which part has a name, None where it is not of this pattern."""
        inner = name[len(self.head) : len(name) - len(self.tail)]
        is_number = inner.isascii() and inner.isdecimal() and str(int(inner)) == inner
        if not is_number or name != f"{self.head}{inner}{self.tail}" or int(inner) < self.first:
            return None
        return int(inner) - self.first


def pattern(step: Step) -> Pattern:
    """Return how a step's parts or crossings are named."""
    if step.is_counted:
        return Pattern(f"{step.id}_", "", 1)
    if not step.numbered:
        return Pattern(f"{step.id}.", "", 0)
    head, _, tail = step.numbered.partition("{}")
    return Pattern(head, tail, step.first)


def has_own_names(step: Step) -> bool:
    """Return whether the parts or crossings that a step gives are quantities of their own, which formulas and references name."""
    return bool(step.numbered) or step.is_counted


def result_names(step: Step, parts: int | None = None, names: Sequence[str] | None = None) -> tuple[ResultName, ...]:
    """Return all names that a step gives, in the order of the results.

    ``parts`` says how many parts a row has, or how many crossings there are; None for a single number or a curve. ``names`` are those of
    the parts, after which a row with ``named_by`` is named.
    """
    if isinstance(step, SilentStep):
        return ()
    if step.named_by and names is not None:
        return tuple(ResultName(part_result(name, step), step.id, "part", i, i + 1) for i, name in enumerate(names))
    if parts is None and not step.is_counted:
        return (ResultName(step.id, step.id), *step.beside())
    made = pattern(step)
    return (*step.beside(), *(made.name(step, index) for index in range(parts or 0)))


def names_ahead(step: Step) -> tuple[ResultName, ...]:
    """Return the names that a step may give, known before a machine is calculated; of a row without own names its id."""
    return result_names(step, MOST_NAMED if has_own_names(step) else None)


def numbered_symbol(step: Step, number: int) -> str:
    """Return the symbol of one part or crossing: with its number behind it, or, of a row, in the place of its index (``ω_k``)."""
    symbol, indices = (step.symbol, 0) if step.is_counted else INDEX.subn(str(number), step.symbol)
    return symbol if indices else f"{symbol}{',' if '_' in symbol else '_'}{number}"


def part_result(name: str, step: Step) -> str:
    """Return what a row or curve with ``named_by`` is called of the part of a name."""
    return f"{name}_{step.id}"


def place_name(id: str) -> str:
    """Return what the place of an extreme is called."""
    return f"{id}_at"


def count_name(id: str) -> str:
    """Return what the number of crossings is called."""
    return f"{id}_count"


def read(name: str, step: Step) -> ResultName | None:
    """Return what a name is of a step, None where the step does not give it."""
    if isinstance(step, SilentStep):
        return None
    if name == step.id:
        return ResultName(name, step.id)
    known = next((beside for beside in step.beside() if beside.name == name), None)
    index = pattern(step).index(name)
    return known if index is None else pattern(step).name(step, index)


def named(name: str, steps: Mapping[str, Step], numbered: Iterable[Step] | None = None) -> ResultName | None:
    """Return which of steps, by their ids, gives a name, and what it is of it; None where none does.

    A part that has a name of its own may also be asked for as part of its row, ``ID.0``. ``numbered`` are the steps with such parts,
    where they are known.
    """
    with_parts = (step for step in steps.values() if step.numbered) if numbered is None else numbered
    heads = (name, name.rpartition("_")[0], name.rpartition(".")[0])
    found = (read(name, step) for step in chain((steps[head] for head in heads if head in steps), with_parts))
    return next((each for each in found if each is not None), None) or _part_of_row(name, steps)


def _part_of_row(name: str, steps: Mapping[str, Step]) -> ResultName | None:
    step = steps.get(name.rpartition(".")[0])
    if step is None or not step.numbered or pattern(step).head == f"{step.id}.":
        return None
    index = Pattern(f"{step.id}.", "", 0).index(name)
    return None if index is None else ResultName(name, step.id, "part", index, pattern(step).first + index)
