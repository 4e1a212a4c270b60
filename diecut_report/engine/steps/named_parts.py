"""Rows and curves that are called by the names of their parts."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

from diecut_report.contract.code_steps import ComputedCurve
from diecut_report.contract.result_names import part_result, result_names
from diecut_report.contract.steps import Step
from diecut_report.engine.calculation import Calculation, Impossible
from diecut_report.languages.phrases import Phrase, phrase


def name_row(calc: Calculation, step: Step) -> None:
    """Put the parts of a row under names of their own."""
    if (step.numbered or step.named_by) and step.id in calc.values:
        row, names = calc[step.id], names_of(calc, step)
        made = result_names(step, row.shape[1], names)
        calc.values |= {each.name: row[:, [each.index]] for each in made}
        if step.named_by:
            calc.row_of |= dict.fromkeys((each.name for each in made), step.id)


def curves_of(calc: Calculation, step: ComputedCurve) -> dict[str, ComputedCurve]:
    """Return the curve of each named part by its id; the step itself where it is of no parts."""
    names = names_of(calc, step)
    if names is None:
        return {step.id: step}
    made = (
        replace(step, id=part_result(name, step), description=Phrase("{quantity}: {part}", quantity=phrase(step.description), part=name), named_by="",
                function=partial(step.function, index))
        for index, name in enumerate(names)
    )  # fmt: skip
    return {each.id: each for each in made}


def names_of(calc: Calculation, step: Step) -> tuple[str, ...] | None:
    """Return the names of the parts of a row or curve; Impossible where a result would be called as another one."""
    names: tuple[str, ...] | None = calc.inputs.get(step.named_by)
    home, _, key = step.named_by.rpartition(".")
    for index, name in enumerate(names or ()):
        called = part_result(name, step)
        if called in calc.steps or called in calc.inputs:
            words = Phrase(
                "is {name}, with which its result {called} would be called as another one; take another name",
                name=name,
                called=called,
            )
            raise Impossible([(f"{home}.{index}.{key}", words)])
    return names
