"""What a study asks of the results: outputs and curves to keep, objectives, and which variants get a full report."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Literal

from diecut_report.config.loader import Config
from diecut_report.config.model import PRESS
from diecut_report.config.validation import ConfigPlace, quoted
from diecut_report.errors import Problem, nearest
from diecut_report.study.definition.base_inputs import MECHANISMS, Input
from diecut_report.study.execution.variant_rows import columns_of
from diecut_report.study.storage.description import ResultColumn
from diecut_report.text.phrases import Counted, Phrase, phrase

SHOWN = 12  # known names that a message lists


@dataclass(frozen=True)
class Objective:
    """Name a quantity that is to be small or great: an output (``cylinder.mass``), ``NAME.checks.ID.utilisation`` or a varied input."""

    output: str
    minimise: bool


@dataclass(frozen=True)
class Reports:
    """Say which variants get a full report: none, the failed ones, the best by the objectives, all, or those with these numbers."""

    which: Literal["none", "failed", "best", "all", "ids"] = "none"
    best: int = 0
    ids: tuple[int, ...] = ()


@dataclass(frozen=True)
class _Known:
    """What a mechanism gives, in any of the bases that a study's texts make."""

    numbers: frozenset[str]
    others: frozenset[str]
    curves: frozenset[str]
    rows: frozenset[str]
    checks: frozenset[str]
    utilisations: frozenset[str]

    def nearest(self, name: str, among: frozenset[str]) -> str:
        near = nearest(name, sorted(among))
        names = sorted(among)
        if near or not names:
            return Phrase("{near}.", near=near) if near else phrase(". Known: none.")
        more = len(names) - SHOWN
        listed = ", ".join(names[:SHOWN])
        return (
            Counted(more, ". Known: {names} and {n} more.", ". Known: {names} and {n} more.", names=listed)
            if more > 0
            else Phrase(". Known: {names}.", names=listed)
        )


class ResultReader:
    """Read what is asked of the results; gathers ``problems``."""

    def __init__(self, place: ConfigPlace, bases: Sequence[Config], inputs: Mapping[str, Input] | None = None) -> None:
        self.place, self.bases, self.inputs = place, bases, inputs or {}
        self.problems: list[Problem] = []

    def column(self, name: str) -> ResultColumn | None:
        """Return the column of a single result, also of a check, by its name; None where there is none."""
        return self._columns.get(name)

    @property
    def known(self) -> list[str]:
        """Return the names of all single results."""
        return list(self._columns)

    def outputs(self, given: list[str] | None) -> tuple[str, ...] | None:
        """Return the outputs to keep; None for all."""
        if given is None:
            return None
        kept = [name for i, name in enumerate(given) if self._is_number_or_text(("outputs", i), name)]
        return tuple(dict.fromkeys(kept))

    def curves(self, given: list[str]) -> tuple[str, ...]:
        """Return the curves to keep."""
        return tuple(dict.fromkeys(name for i, name in enumerate(given) if self._is_curve(("curves", i), name)))

    def objectives(self, given: list[dict[str, Any]], home: tuple[str, ...] = ()) -> tuple[Objective, ...]:
        """Return the objectives in their order; ``home`` is the block that they stand in."""
        found: list[Objective] = []
        for index, entry in enumerate(given):
            key: tuple[str | int, ...] = (*home, "objectives", index)
            made = self._objective(key, entry)
            if made and made.output in {each.output for each in found}:
                words = "{name} is an objective already; name each number once, to be small or to be great."
                self._report(key, Phrase(words, name=made.output))
            elif made:
                found.append(made)
        return tuple(found)

    def reports(self, given: Any, count: int | None, has_objectives: bool) -> Reports:
        """Return which variants get a full report; ``count`` is that of the sample, None where it is not known."""
        if isinstance(given, list):
            return Reports("ids", ids=tuple(dict.fromkeys(self._listed(given, count))))
        match str("none" if given is None else given).split():
            case [("none" | "failed" | "all") as which]:
                return Reports(which)
            case ["best", number] if re.fullmatch(r"[1-9]\d{0,8}", number):
                if not has_objectives:
                    self._report(
                        ("reports",), phrase("best needs objectives, such as objectives: [{minimise: cylinder.mass}].")
                    )
                return Reports("best", int(number))
        words = Phrase(
            "is {given}{nearest}; allowed: none, failed, best N (best 10), all, or a list of variants' "
            "numbers, as in [0, 17].",
            given=quoted(given),
            nearest=nearest(str(given), ("none", "failed", "all")),
        )
        self._report(("reports",), words)
        return Reports()

    def _listed(self, given: list[Any], count: int | None) -> Iterator[int]:
        for index, number in enumerate(given):
            if not isinstance(number, int) or isinstance(number, bool):
                self._report(
                    ("reports", index),
                    Phrase("is {number}; a variant has a whole number, as in [0, 17].", number=quoted(number)),
                )
            elif number < 0 or (count is not None and number >= count):
                self._report(("reports", index), _no_variant(number, count))
            else:
                yield number

    # --- one name ----------------------------------------------------------------------------------------------------

    def _objective(self, key: tuple[str | int, ...], entry: dict[str, Any]) -> Objective | None:
        given = {name: value for name, value in entry.items() if value is not None}
        if len(given) != 1:
            self._report(
                key,
                Phrase(
                    "names {count} outputs; give minimise or maximise with one, and an entry for each.",
                    count=len(given),
                )
                if given
                else phrase("names no outputs; give minimise or maximise with one, and an entry for each."),
            )
            return None
        (way, name), = given.items()  # fmt: skip
        is_known = self._is_objective((*key, way), name)
        return Objective(name, way == "minimise") if is_known else None

    def _is_objective(self, key: tuple[str | int, ...], name: str) -> bool:
        if name.startswith((f"{MECHANISMS}.", f"{PRESS}.")):
            return self._is_varied_number(key, name)
        found = self._split(key, name)
        if found is None:
            return False
        known, inner = found
        if inner in known.utilisations:
            return True
        if inner in known.others:
            self._report(
                key, Phrase("{name} is a text or a yes/no, which is neither small nor great; name a number.", name=name)
            )
            return False
        return self._is_output(key, name, known, inner)

    def _is_varied_number(self, key: tuple[str | int, ...], name: str) -> bool:
        """Whether an input is a number that varies: one that does not is the same in all variants."""
        numbers = [path for path, asked in self.inputs.items() if asked.unit]
        if name in numbers:
            return True
        if name in self.inputs:
            words = "{name} is a text, a choice or a yes/no, which is neither small nor great; name a number."
            self._report(key, Phrase(words, name=name))
            return False
        words = "{name} is not varied, so it is the same in all variants{near}; an output is named as NAME.OUTPUT. Varied numbers: {known}."
        self._report(key, Phrase(words, name=name, near=nearest(name, numbers), known=", ".join(numbers) or "–"))
        return False

    def _is_number_or_text(self, key: tuple[str | int, ...], name: str) -> bool:
        found = self._split(key, name)
        if found is None:
            return False
        known, inner = found
        if inner in known.checks:
            self._report(key, Phrase("{name}: checks are kept in any case; remove it.", name=name))
            return False
        return inner in known.others or self._is_output(key, name, known, inner)

    def _is_output(self, key: tuple[str | int, ...], name: str, known: _Known, inner: str) -> bool:
        if inner in known.numbers:
            return True
        among = known.utilisations if inner.startswith("checks.") else known.numbers | known.others
        words = Phrase("{name} is not an output{nearest}", name=name, nearest=known.nearest(inner, among))
        if inner in known.rows:
            words = Phrase("{name} has a value for each part of a list; name one, as in {name}.0.", name=name)
        elif inner in known.curves:
            words = Phrase("{name} is a curve; only single values are kept here, curves by the key curves.", name=name)
        self._report(key, words)
        return False

    def _is_curve(self, key: tuple[str | int, ...], name: str) -> bool:
        found = self._split(key, name)
        if found is None:
            return False
        known, inner = found
        if inner not in known.curves:
            is_single = inner in known.numbers | known.others | known.rows
            words = (
                Phrase("{name} is a single value; name it in outputs.", name=name)
                if is_single
                else Phrase("{name} is not a curve{nearest}", name=name, nearest=known.nearest(inner, known.curves))
            )
            self._report(key, words)
        return inner in known.curves

    def _split(self, key: tuple[str | int, ...], name: str) -> tuple[_Known, str] | None:
        """What the mechanism of an output gives, and the output's name there."""
        first, _, inner = str(name).partition(".")
        names = [instance for instance in self.bases[0].instances if instance != PRESS]
        if first in names and inner:
            return self._all[first], inner
        if first in names:
            example = next(iter(sorted(self._all[first].numbers)), "output")
            words = Phrase(
                "{name} names no output; add one, as in {first}.{example}.", name=name, first=first, example=example
            )
        elif first == "mechanisms":
            words = Phrase(
                "{name}: outputs are named without mechanisms., as in {inner}.",
                name=name,
                inner=inner or "drive.crank_torque_peak",
            )
        else:
            words = Phrase(
                "{name}: there is no mechanism {first}{nearest}. Known: {names}.",
                name=name,
                first=repr(first),
                nearest=nearest(first, names),
                names=", ".join(names),
            )
        self._report(key, words)
        return None

    @cached_property
    def _columns(self) -> dict[str, ResultColumn]:
        return {column.name: column for base in self.bases for column in columns_of(base)}

    @cached_property
    def _all(self) -> dict[str, _Known]:
        """What each mechanism gives, by its name."""
        names = [name for name in self.bases[0].instances if name != PRESS]
        return {
            name: self._of(name, [c for c in self._columns.values() if c.name.startswith(f"{name}.")]) for name in names
        }

    def _of(self, name: str, columns: list[ResultColumn]) -> _Known:
        inner = {column.name.removeprefix(f"{name}."): column for column in columns}
        checks = {key for key in inner if key.startswith("checks.")}
        instances = [instance for base in self.bases if (instance := base.instances[name])]
        many = {key: key in i.rows for i in instances for key, (_, is_many) in i.results.items() if is_many}
        return _Known(
            numbers=frozenset(key for key, column in inner.items() if column.kind in ("float", "int")) - checks,
            others=frozenset(key for key, column in inner.items() if column.kind in ("text", "bool")) - checks,
            curves=frozenset(key for key, is_row in many.items() if not is_row),
            rows=frozenset(key for key, is_row in many.items() if is_row),
            checks=frozenset(checks),
            utilisations=frozenset(key for key in checks if key.endswith(".utilisation")),
        )

    def _report(self, key: tuple[str | int, ...], message: str) -> None:
        self.problems.append(self.place.problem(key, message))


def _no_variant(number: int, count: int | None) -> str:
    if count is None:
        return Phrase("there is no variant {number}; variants are numbered from 0.", number=number)
    words = "there is no variant {number}; variants are numbered from 0 to {last}."
    return Phrase(words, number=number, last=count - 1)
