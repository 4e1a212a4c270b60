"""Comparisons over the results of named kinds, calculated when all mechanisms are known."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import product
from typing import Any

import numpy as np
from pydantic import ValidationError

from diecut_report.contract.inputs import SI, Block, Quantity, flatten, meta_of
from diecut_report.contract.mechanism import Comparison
from diecut_report.contract.unit_variants import in_form
from diecut_report.engine import Calculation, CurveHandle, calculate
from diecut_report.engine.chosen_units import NONE_CHOSEN, ChosenUnits
from diecut_report.languages.phrases import Phrase
from diecut_report.quantities.plausible import without_rounding
from diecut_report.quantities.units import unit
from diecut_report.results.mechanism import mechanism_results
from diecut_report.results.stated_inputs import Provenance

Data = dict[str, Any]


class Uncomparable(ValueError):
    """A result or an input of an instance that a comparison cannot be made with, in words."""

    def __init__(self, words: str, instance: str, name: str) -> None:
        super().__init__(words)
        self.instance, self.name = instance, name


@dataclass(frozen=True)
class Found:
    """Hold a comparison with the instances that it is between, by their kinds."""

    comparison: Comparison
    between: Mapping[str, str]

    @property
    def name(self) -> str:
        """Return what the results know it by: its kind and the instances."""
        return "-".join([self.comparison.mechanism.kind, *self.between.values()])


def found(calculations: Mapping[str, Calculation]) -> Iterator[Found]:
    """Yield the comparisons that the calculated mechanisms declare, for each choice of one instance of each kind."""
    by_kind: dict[str, list[str]] = {}
    for name, calc in calculations.items():
        by_kind.setdefault(calc.mechanism.kind, []).append(name)
    declared = {c.mechanism.kind: c for calc in calculations.values() for c in calc.mechanism.comparisons}
    for comparison in declared.values():
        for names in product(*(by_kind.get(kind, []) for kind in comparison.kinds)):
            yield Found(comparison, dict(zip(comparison.kinds, names, strict=True)))


def compared(case: Found, calculations: Mapping[str, Calculation], chosen: ChosenUnits = NONE_CHOSEN) -> Data:
    """Return the results of a comparison, in the form of a mechanism's, shown in the chosen units, and between which instances it is."""
    values, origins = {}, {}
    for key, (kind, name) in case.comparison.takes.items():
        instance = case.between[kind]
        value = _taken(calculations[instance], name)
        if value is not None:
            values[key], origins[key] = value, Provenance("reference", f"{instance}.{name}")
    block = _block(case, values)
    calculation = calculate(case.comparison.mechanism, flatten(block))
    calculation.chosen_units = chosen
    return mechanism_results(calculation, origins) | {"between": list(case.between.values())}


def _block(case: Found, values: Mapping[str, Any]) -> Block:
    """Return the validated inputs; Uncomparable in words where a result is none that they may have."""
    try:
        return in_form(case.comparison.mechanism.inputs, values).model_validate(values)
    except ValidationError as error:
        fault = error.errors(include_url=False)[0]
        key = str(fault["loc"][0])
        if not _is_of_its_kind(case, key, values.get(key)):
            raise  # a fault of what is declared
        kind, name = case.comparison.takes[key]
        instance = case.between[kind]
        words = Phrase(
            "The comparison {name} takes {output}: {fault}.",
            name=case.name,
            output=f"{instance}.{name}",
            fault=fault["msg"].removeprefix("Value error, "),
        )
        raise Uncomparable(words, instance, name) from error


def _is_of_its_kind(case: Found, key: str, value: Any) -> bool:
    """Return whether a result is a number of the kind that an input takes."""
    meta = meta_of(case.comparison.mechanism.inputs, key)
    return isinstance(meta, Quantity) and isinstance(value, SI) and unit(value.unit).kind == meta.parsed_unit.kind


def _taken(calc: Calculation, name: str) -> Any:
    """A number with its SI unit, a text, a curve; None where there is none."""
    if calc.axis.get(name) in calc.domains:
        return CurveHandle(calc, name)
    values = calc.values.get(name, calc.inputs.get(name))
    if not isinstance(values, np.ndarray):
        return values
    value = values[0, 0]
    if isinstance(value, str):
        return value
    si = unit(calc.step_or_input(name).unit).si
    return None if np.isnan(value) else SI(float(without_rounding(value, si)), si, name)
