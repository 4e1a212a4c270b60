"""Defaults that inputs take from the press: each names a number that a press may give, of the input's kind."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from diecut_report.config.model import Press
from diecut_report.contract.inputs import Block, FromPress, Quantity, fields, nested
from diecut_report.contract.mechanism import Mechanism
from diecut_report.declaration.input_places import of_input
from diecut_report.declaration.words import Fault
from diecut_report.errors import nearest
from diecut_report.languages.phrases import Phrase
from diecut_report.quantities.units import unit

NUMBERS = {f"press.{path}": meta for path, meta in fields(Press) if isinstance(meta, Quantity)}


def faults(mechanism: Mechanism) -> Iterator[Fault]:
    """Yield the inputs with a default that the press can never give, and what the press of an example cannot be."""
    for path, meta in fields(mechanism.inputs):
        if isinstance(meta, Quantity) and meta.press is not None:
            for text in _wrong(meta, meta.press, _is_required(mechanism.inputs, path)):
                yield Fault(of_input(mechanism.inputs, path, mechanism.at), f"input {path}", text)
    example = mechanism.example
    for path, value in example.press.items() if example else ():
        if example and (text := _refused(path, value)):
            yield Fault(example.at, f"example {example.name}", f"press {path} {text}")


def _refused(path: str, value: Any) -> str:
    """What is wrong with a value of the press, in words."""
    if f"press.{path}" not in NUMBERS:
        return Phrase("is not a number of the press; it has {numbers}", numbers=", ".join(NUMBERS))
    try:
        NUMBERS[f"press.{path}"].validate(value)
    except ValueError as fault:
        return str(fault)
    return ""


def _is_required(model: type[Block], path: str) -> bool:
    head, _, rest = path.partition(".")
    field = model.model_fields[head]
    inner = nested(field.annotation) if rest else None
    return _is_required(inner[0], rest) if inner else field.is_required()


def _wrong(meta: Quantity, press: FromPress, is_required: bool) -> Iterator[str]:
    if is_required:
        yield Phrase(
            "must be given, so that {path} is never taken; write Annotated[float | None, …] = None", path=press.path
        )
    given = NUMBERS.get(press.path)
    if given is None:
        known = ", ".join(NUMBERS)
        yield Phrase(
            "takes {path}, which is not a number of the press{nearest}; it has {known}",
            path=press.path,
            nearest=nearest(press.path, NUMBERS),
            known=known,
        )
        return
    units = [meta.unit, *(other for _, other in meta.units)]
    if press.formula is None and all(unit(given.unit).kind != unit(other).kind for other in units):
        yield Phrase(
            "in {unit} takes {path}, which is in {own}; name a formula between them: FromPress(…, formula)",
            unit=meta.unit,
            path=press.path,
            own=given.unit,
        )
