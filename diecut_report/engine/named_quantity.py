"""What declares a quantity of a calculation: the step that gives it, or the input; of one crossing or part and their number what follows from it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import cast

from diecut_report.contract.inputs import Meta, Quantity
from diecut_report.contract.place import Misdeclared
from diecut_report.contract.result_names import ResultName, named, names_ahead, numbered_symbol
from diecut_report.contract.steps import Reduction, Step
from diecut_report.errors import nearest
from diecut_report.languages.phrases import Phrase


class NamedQuantities:
    """Remember what the names of a calculation's quantities mean, as long as its steps are the same."""

    def __init__(self) -> None:
        self._steps: Mapping[str, Step] = {}
        self._numbered: tuple[Step, ...] = ()
        self._names: dict[str, ResultName | None] = {}
        self._declared: dict[str, Step | Quantity] = {}

    def result(self, name: str, steps: Mapping[str, Step]) -> ResultName | None:
        """Return which step gives a name, and what it is of it; None where none does."""
        if steps is not self._steps:
            self._steps, self._numbered = steps, tuple(step for step in steps.values() if step.numbered)
            self._names, self._declared = {}, {}
        if name not in self._names:
            self._names[name] = named(name, steps, self._numbered)
        return self._names[name]

    def declared(
        self, name: str, steps: Mapping[str, Step], axis: Mapping[str, str], inputs: Mapping[str, Meta], at: str
    ) -> Step | Quantity:
        """Return the step or input with a quantity's symbol, unit and description.

        ``axis`` is the abscissa of each curve, ``at`` the mechanism's place. Misdeclared where there is nothing of this name.
        """
        if name in steps:
            return steps[name]
        found = self.result(name, steps)
        if name not in self._declared:
            self._declared[name] = _declared(name, found, steps, axis, inputs, at)
        return self._declared[name]


def _declared(
    name: str,
    found: ResultName | None,
    steps: Mapping[str, Step],
    axis: Mapping[str, str],
    inputs: Mapping[str, Meta],
    at: str,
) -> Step | Quantity:
    if found is not None:
        return _of_step(found, steps, axis)
    path = name.removeprefix("inputs.")
    if path not in inputs:
        given = [each.name for step in steps.values() for each in names_ahead(step)]
        near = nearest(path, [*given, *inputs])
        raise Misdeclared(
            Phrase(
                "{name} is not a quantity of this machine{near}; name a step or an input", name=repr(name), near=near
            ),
            at,
        )
    return cast(Quantity, inputs[path])


def _of_step(found: ResultName, steps: Mapping[str, Step], axis: Mapping[str, str]) -> Step:
    step = steps[found.id]
    match found.role:
        case "place":
            return steps[axis[cast(Reduction, step).of]]
        case "count":
            many = Phrase("{description}: how many", description=step.description)
            return replace(
                step, id=found.name, symbol=f"n_{step.symbol.replace('_', ',')}", unit="1", units=(), description=many
            )
        case "crossing" | "part":
            return replace(step, id=found.name, symbol=numbered_symbol(step, found.number))
    return step
