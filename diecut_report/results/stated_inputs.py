"""The inputs of a mechanism as results hold them: value, unit, where each comes from and what was typed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from diecut_report.contract.inputs import CurveInput, Quantity, TakenWhole
from diecut_report.contract.varying import Varying
from diecut_report.engine import Calculation
from diecut_report.engine.shown_units import declared_unit
from diecut_report.quantities.formatting import given_shown
from diecut_report.quantities.units import unit
from diecut_report.results.varying_inputs import varying

Data = dict[str, Any]
Origin = Literal["given", "default", "reference", "expression"]


@dataclass(frozen=True)
class Provenance:
    """Hold where an input comes from, the path it refers to (an expression: the ``paths``), its text as typed, and what it rests on."""

    origin: Origin
    path: str = ""
    text: str | None = None
    paths: tuple[str, ...] = ()
    basis: str = ""
    note: str = ""


GIVEN = Provenance("given")


def inputs(calc: Calculation, provenance: Mapping[str, Provenance]) -> Data:
    """Return each input with value, unit, origin and typed text; the parts of a list as ``gears.0.driver_teeth``."""
    found: Data = {}
    for path, name, index, value in placed_inputs(calc):
        meta = calc.meta[name]
        display = declared_unit(calc, name, meta.unit) if isinstance(meta, Quantity) else "1"
        found[path] = _input(meta, value, display) | _origin(provenance.get(path))
        if index is not None:
            home = calc.axis[name]
            found[path]["part"] = {"family": home, "index": index, "quantity": name.removeprefix(f"{home}.")}
    return found


def placed_inputs(calc: Calculation) -> Iterator[tuple[str, str, int | None, Any]]:
    """Yield each input that has a value: its path, its id, for a part of a list which one, and the value."""
    for name in calc.meta:
        if name not in calc.inputs:
            continue
        row = calc.inputs[name]
        if name not in calc.axis:
            if row is not None:
                yield name, name, None, row
            continue
        home = calc.axis[name]
        for index, part in enumerate(row[0] if isinstance(row, np.ndarray) else row):
            if part is not None:  # else left out of this part of the list
                yield f"{home}.{index}{name.removeprefix(home)}", name, index, part


def _origin(provenance: Provenance | None) -> Data:
    known = provenance or Provenance("default")
    return (
        {"origin": known.origin}
        | ({"path": known.path} if known.path else {})
        | ({"paths": list(known.paths)} if known.paths else {})
        | ({"text": known.text} if known.text else {})
        | ({"basis": known.basis} if known.basis else {})
        | ({"note": known.note} if known.note else {})
    )


def _as_text(value: Any) -> str:
    """A choice as one would say it: texts after one another, yes or no."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    return ", ".join(value) if isinstance(value, tuple) else str(value)


def _input(meta: Any, value: Any, display: str) -> Data:
    if isinstance(value, TakenWhole) or (isinstance(meta, Quantity) and isinstance(value, str)):
        return {"value": str(value), "unit": "1", "symbol": meta.symbol, "description": meta.description,
                "display": {"text": str(value), "unit": "1"}}  # fmt: skip
    if not isinstance(meta, Quantity):
        is_curve = isinstance(meta, CurveInput)
        text = "a curve" if is_curve else _as_text(value)
        plain = list(value) if isinstance(value, tuple) else value
        return {"value": text if is_curve else plain, "unit": unit(meta.unit).si if is_curve else "1", "symbol": meta.symbol,
                "description": meta.description, "display": {"text": text, "unit": "1"}}  # fmt: skip
    if isinstance(meta, Varying) and not isinstance(value, float | np.ndarray):
        return varying(meta, value, display)
    number = float(np.ravel(value)[0])
    return {
        "value": int(number) if meta.integer else number,
        "unit": meta.parsed_unit.si,
        "symbol": meta.symbol,
        "description": meta.description,
        "display": given_shown(number, display),
    }
