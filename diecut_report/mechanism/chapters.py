"""A chapter of the calculation, written quantity by quantity in the order in which they are calculated.

A quantity is declared by assigning what gives it, its symbol, unit, description and source to its id:
``chapter.depth = m.radius - m.height, "h", "mm", "Depth", "geometry"``. What gives no single quantity is a call of the chapter.
"""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import dataclass, field, replace
from functools import cache
from typing import Annotated, Any, TypeVar

from pydantic import create_model

from diecut_report.mechanism.curve_inputs import CurveInput
from diecut_report.mechanism.inputs import Block, Meta, Quantity, meta_of
from diecut_report.mechanism.names import placed
from diecut_report.mechanism.steps import Step, Steps
from diecut_report.mechanism.steps.naming import prefixed, taken

MISSING = "{missing}"  # in the words of a chapter that is left out: the keys that are not given


@dataclass(eq=False)
class Chapter(Steps):
    """Declare a chapter of the calculation; ``absent`` says in words what it lacks: ``{missing}`` are the needed keys not given."""

    title: str
    text: str = field(default="", kw_only=True)
    needs: tuple[str, ...] = field(default=(), kw_only=True)
    absent: str = field(default="", kw_only=True)
    at: str = placed()


# Inputs and steps whose unit depends on which other input is given: angles or lengths, seconds or a share of the cycle.


Declared = TypeVar("Declared", bound="Meta | Step | None")


def in_form(model: type[Block], given: Collection[str]) -> type[Block]:
    """Return the inputs with the units that hold when these keys are given."""
    keys = form_keys(model).intersection(given)
    return _formed(model, keys) if keys else model


def in_unit(declared: Declared, given: Collection[str]) -> Declared:
    """Return what is declared, in the unit that holds when these keys are given."""
    if not isinstance(declared, Quantity | CurveInput | Step):
        return declared
    other = next((unit for key, unit in declared.units if key in given), None)
    return replace(declared, unit=other) if other else declared


def in_all_units(declared: Quantity | CurveInput | Step, told: Callable[[Any], str]) -> str:
    """Return what is said of a declaration, and of it in its other units with the key of each: ``N·m (with mass: N)``."""
    others = [f"with {key}: {told(in_unit(declared, [key]))}" for key, _ in declared.units]
    return told(declared) + (f" ({'; '.join(others)})" if others else "")


@cache
def form_keys(model: type[Block]) -> frozenset[str]:
    """Return the keys on which units of a model's inputs depend."""
    return frozenset(key for name in model.model_fields for key, _ in getattr(meta_of(model, name), "units", ()))


@cache
def _formed(model: type[Block], given: frozenset[str]) -> type[Block]:
    changed: dict[str, Any] = {}
    for name, declared in model.model_fields.items():
        meta = meta_of(model, name)
        other = in_unit(meta, given)
        if other is not meta:
            told = (other if part is meta else part for part in declared.metadata)
            changed[name] = (Annotated[declared.annotation, *told], ... if declared.is_required() else declared.default)
    return create_model(model.__name__, __base__=model, __module__=model.__module__, **changed)


__all__ = ["Chapter", "Steps", "in_all_units", "in_form", "in_unit", "prefixed", "taken"]
