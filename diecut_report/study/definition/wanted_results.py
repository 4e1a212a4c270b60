"""What a study asks of the results: outputs and curves to keep, objectives, and which variants get a full report."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal

from diecut_report.config.loader import Config
from diecut_report.config.model import PRESS
from diecut_report.config.validation import ConfigPlace, quoted
from diecut_report.config.yaml import KeyPath
from diecut_report.errors import Problem, nearest
from diecut_report.study.definition.base_inputs import MECHANISMS, Input
from diecut_report.study.execution.variant_rows import columns_of
from diecut_report.text.phrases import Counted, Phrase, message, phrase

MAX_LISTED = 12  # known names that a message lists
Sort = Literal["number", "other", "check", "utilisation", "curve", "row", "unknown"]


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


class ResultReader:
    """Read what is asked of the results of any of the bases that a study's texts make; adds to ``problems``."""

    def __init__(
        self, place: ConfigPlace, problems: list[Problem], bases: Sequence[Config], inputs: Mapping[str, Input]
    ) -> None:
        self.place, self.problems, self.inputs = place, problems, inputs
        self.mechanisms = [name for name in bases[0].instances if name != PRESS]
        self.columns = {column.name: column for base in bases for column in columns_of(base)}
        self.sorts: dict[str, Sort] = {}
        for name, column in self.columns.items():
            self.sorts[name] = "number" if column.is_number else "other"
            if ".checks." in name:
                self.sorts[name] = "utilisation" if name.endswith(".utilisation") else "check"
        instances = (base.instances[name] for base in bases for name in self.mechanisms)
        for instance in (each for each in instances if each):
            many = [key for key, (_, is_many) in instance.results.items() if is_many]
            self.sorts |= {f"{instance.name}.{key}": "row" if key in instance.rows else "curve" for key in many}

    def kept(self, key: Literal["outputs", "curves"], given: list[str]) -> tuple[str, ...]:
        """Return the outputs or the curves to keep."""
        is_one = self._is_output if key == "outputs" else self._is_curve
        return tuple(dict.fromkeys(name for index, name in enumerate(given) if is_one((key, index), name)))

    def objectives(self, given: list[dict[str, Any]], home: tuple[str, ...] = ()) -> tuple[Objective, ...]:
        """Return the objectives in their order; ``home`` is the block that they stand in."""
        found: dict[str, Objective] = {}
        for index, entry in enumerate(given):
            key: KeyPath = (*home, "objectives", index)
            made = self._objective(key, entry)
            if made and made.output in found:
                template = "{name} is an objective already; name each number once, to be minimised or maximised."
                self._fault(key, template, name=made.output)
            elif made:
                found[made.output] = made
        return tuple(found.values())

    def reports(self, given: Any, count: int | None, has_objectives: bool) -> Reports:
        """Return which variants get a full report; ``count`` is that of the sample, None where it is not known."""
        if isinstance(given, list):
            return Reports("ids", ids=tuple(dict.fromkeys(self._numbers(given, count))))
        match str("none" if given is None else given).split():
            case [("none" | "failed" | "all") as which]:
                return Reports(which)
            case ["best", number] if re.fullmatch(r"[1-9]\d{0,8}", number):
                if not has_objectives:
                    self._fault(("reports",), "best needs objectives, such as objectives: [{minimise: cylinder.mass}].")
                return Reports("best", int(number))
        template = "is {given}{nearest}; allowed: none, failed, best N (best 10), all, or a list of variants' numbers, as in [0, 17]."
        near = nearest(str(given), ("none", "failed", "all"))
        self._fault(("reports",), template, given=quoted(given), nearest=near)
        return Reports()

    def _numbers(self, given: list[Any], count: int | None) -> Iterator[int]:
        for index, number in enumerate(given):
            if not isinstance(number, int) or isinstance(number, bool):
                template = "is {number}; a variant has a whole number, as in [0, 17]."
                self._fault(("reports", index), template, number=quoted(number))
            elif count is not None and not 0 <= number < count:
                template = "there is no variant {number}; variants are numbered from 0 to {last}."
                self._fault(("reports", index), template, number=number, last=count - 1)
            elif number < 0:
                template = "there is no variant {number}; variants are numbered from 0."
                self._fault(("reports", index), template, number=number)
            else:
                yield number

    # --- one name ----------------------------------------------------------------------------------------------------

    def _objective(self, key: KeyPath, entry: dict[str, Any]) -> Objective | None:
        given = {name: value for name, value in entry.items() if value is not None}
        if len(given) != 1:
            template = "names {count} outputs; give minimise or maximise with one, and an entry for each."
            none = "names no outputs; give minimise or maximise with one, and an entry for each."
            self._fault(key, template if given else none, count=len(given))
            return None
        (way, name), = given.items()  # fmt: skip
        is_input = name.startswith((f"{MECHANISMS}.", f"{PRESS}."))
        is_known = self._is_varied_number((*key, way), name) if is_input else self._is_number((*key, way), name)
        return Objective(name, way == "minimise") if is_known else None

    def _is_varied_number(self, key: KeyPath, name: str) -> bool:
        """Return whether an input is a number that varies: one that does not is the same in all variants."""
        numbers = [path for path, asked in self.inputs.items() if asked.unit]
        if name in numbers:
            return True
        if name in self.inputs:
            template = "{name} is a text, a choice or a yes/no, which cannot be minimised or maximised; name a number."
            self._fault(key, template, name=name)
            return False
        template = "{name} is not varied, so it is the same in all variants{near}; an output is named as NAME.OUTPUT. Varied numbers: {known}."
        self._fault(key, template, name=name, near=nearest(name, numbers), known=", ".join(numbers) or "–")
        return False

    def _is_number(self, key: KeyPath, name: str) -> bool:
        sort = self._sort(key, name)
        if sort == "other":
            template = "{name} is a text or a yes/no, which cannot be minimised or maximised; name a number."
            self._fault(key, template, name=name)
        elif sort not in ("number", "utilisation", None):
            self._report_no_output(key, name)
        return sort in ("number", "utilisation")

    def _is_output(self, key: KeyPath, name: str) -> bool:
        sort = self._sort(key, name)
        if sort in ("check", "utilisation"):
            self._fault(key, "{name}: checks are kept in any case; remove it.", name=name)
        elif sort not in ("number", "other", None):
            self._report_no_output(key, name)
        return sort in ("number", "other")

    def _is_curve(self, key: KeyPath, name: str) -> bool:
        sort = self._sort(key, name)
        if sort in ("number", "other", "row"):
            self._fault(key, "{name} is a single value; name it in outputs.", name=name)
        elif sort not in ("curve", None):
            self._fault(key, "{name} is not a curve{nearest}", name=name, nearest=self._near(name, "curve"))
        return sort == "curve"

    def _report_no_output(self, key: KeyPath, name: str) -> None:
        sorts: tuple[Sort, ...] = ("utilisation",) if ".checks." in name else ("number", "other")
        template = "{name} is not an output{nearest}"
        if self.sorts.get(name) == "row":
            template = "{name} has a value for each part of a list; name one, as in {name}.0."
        elif self.sorts.get(name) == "curve":
            template = "{name} is a curve; only single values are kept here, curves by the key curves."
        self._fault(key, template, name=name, nearest=self._near(name, *sorts))

    def _sort(self, key: KeyPath, name: str) -> Sort | None:
        """Return what a name stands for; None, with the problem, where it names no mechanism, or nothing of one."""
        first, _, inner = str(name).partition(".")
        if first in self.mechanisms and inner:
            return self.sorts.get(name, "unknown")
        if first in self.mechanisms:
            example = next(iter(self._names(first, "number")), "output")
            template = "{name} names no output; add one, as in {first}.{example}."
            self._fault(key, template, name=name, first=first, example=example)
        elif first == MECHANISMS:
            template = "{name}: outputs are named without mechanisms., as in {inner}."
            self._fault(key, template, name=name, inner=inner or "drive.crank_torque_peak")
        else:
            template = "{name}: there is no mechanism {first}{nearest}. Known: {names}."
            near, known = nearest(first, self.mechanisms), ", ".join(self.mechanisms)
            self._fault(key, template, name=name, first=repr(first), nearest=near, names=known)
        return None

    def _names(self, mechanism: str, *sorts: Sort) -> list[str]:
        known = (name.partition(".") for name, sort in self.sorts.items() if sort in sorts)
        return sorted(inner for first, _, inner in known if first == mechanism)

    def _near(self, name: str, *sorts: Sort) -> Phrase:
        first, _, inner = name.partition(".")
        names = self._names(first, *sorts)
        near = nearest(inner, names)
        if near or not names:
            return Phrase("{near}.", near=near) if near else phrase(". Known: none.")
        more, listed = len(names) - MAX_LISTED, ", ".join(names[:MAX_LISTED])
        if more <= 0:
            return Phrase(". Known: {names}.", names=listed)
        return Counted(more, ". Known: {names} and {n} more.", ". Known: {names} and {n} more.", names=listed)

    def _fault(self, key: KeyPath, template: str, **values: object) -> None:
        self.problems.append(self.place.problem(key, message(template, values)))
