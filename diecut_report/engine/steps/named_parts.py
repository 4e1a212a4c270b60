"""Rows and curves that are called by the names of their parts."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

from diecut_report.contract.checks import by_part
from diecut_report.contract.code_steps import ComputedCurve
from diecut_report.contract.input_lists import list_inputs
from diecut_report.contract.result_names import part_result, result_names
from diecut_report.contract.steps import Step
from diecut_report.engine.calculation import Calculation, Impossible
from diecut_report.languages.phrases import Phrase, phrase


def distinct(calc: Calculation) -> None:
    """Refuse parts of one name, and a part whose check would be called as another one: one of the two would be lost."""
    named_by = {step.named_by for step in calc.steps.values()} | {check.named_by for check in calc.mechanism.checks}
    named_by |= {path for path in list_inputs(calc.mechanism.inputs) if path.endswith(".name")}
    for path in sorted(named_by - {""}):
        names = calc.inputs.get(path) or ()
        for index, name in enumerate(names):
            if name is not None and name in names[:index]:
                home, first = path.rpartition(".")[0], names.index(name) + 1
                words = "is {name}, as is that of part {first} of {home}; give each part a name of its own"
                raise Impossible([(_key(path, index), Phrase(words, name=name, first=first, home=home))])
    _distinct_checks(calc)


def _distinct_checks(calc: Calculation) -> None:
    known: dict[str, tuple[str, str]] = {}
    for check in sorted(calc.mechanism.checks, key=lambda each: bool(each.named_by)):
        for made in by_part([check], calc.inputs.get):
            own = check.id, made.part_name
            if made.index is not None and known.get(made.id, own) != own:
                words = "is {name}, with which its check {id} would be called as another one; take another name"
                raise Impossible([(_key(check.named_by, made.index), Phrase(words, name=made.part_name, id=made.id))])
            known[made.id] = own


def _key(path: str, index: int) -> str:
    home, _, key = path.rpartition(".")
    return f"{home}.{index}.{key}"


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
    for index, name in enumerate(names or ()):
        called = part_result(name, step)
        is_given = called in calc.steps or called in calc.inputs or calc.names.result(called, calc.steps) is not None
        if is_given or calc.row_of.get(called, step.id) != step.id:
            words = Phrase(
                "is {name}, with which its result {called} would be called as another one; take another name",
                name=name,
                called=called,
            )
            raise Impossible([(_key(step.named_by, index), words)])
    return names
