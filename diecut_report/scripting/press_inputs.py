"""The inputs of a loaded press as a script sees them: path, value, range, what they rest on."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from itertools import groupby
from typing import Any

from diecut_report.config.instances import Instance, Slot
from diecut_report.config.loader import Config
from diecut_report.config.model import PRESS
from diecut_report.config.parts.keys import WORDS
from diecut_report.config.validation import GIVEN, Basis
from diecut_report.config.yaml import KeyPath
from diecut_report.design.inputs import allowed_texts
from diecut_report.errors import ConfigError, Problem
from diecut_report.mechanism.curve_inputs import InOtherUnit
from diecut_report.mechanism.inputs import Quantity
from diecut_report.mechanism.names import Text
from diecut_report.quantities.formatting import given_shown
from diecut_report.quantities.units import UnitError, unit, with_point
from diecut_report.report.symbols import symbol
from diecut_report.report.text import Catalogue, quantity
from diecut_report.scripting.parts import PartList
from diecut_report.scripting.values import QuantityValue, notebook_page, scalar, typed
from diecut_report.study.definition.base_inputs import (
    MECHANISMS,
    Input,
    UnknownPath,
    find_input,
    typed_place,
    varied_input,
)
from diecut_report.text.catalogues import SOURCE_LANGUAGE
from diecut_report.text.phrases import phrase
from diecut_report.text.translation import said, speaking


@dataclass(frozen=True)
class PressInput:
    """Hold an input of the press or of a mechanism: its path (``drive.crank_length``), the kind of its mechanism, and its value (SI).

    ``value`` is None where it follows from something else: ``typed`` is what stands in the file, empty for a default. ``unit`` is that in
    which a bare number counts, ``allowed`` the range in it. ``basis`` is what it rests on, ``note`` what is noted of it.
    """

    path: str
    kind: str
    value: QuantityValue | None
    typed: str
    unit: str
    allowed: str
    symbol: str
    description: str
    basis: str
    note: str

    @property
    def is_given(self) -> bool:
        """Return whether it stands in the file; else it is a default."""
        return bool(self.typed)

    def row(self, words: Catalogue) -> dict[str, object]:
        """Return it as a row of a table, in the language that is spoken."""
        value = "" if self.value is None else quantity(*self.value.printed, words["decimal"])
        basis = words[self.basis] if self.basis else ""
        return vars(self) | {
            "description": said(self.description, self.kind),
            "symbol": symbol(self.symbol),
            "value": value,
            "basis": basis,
        }

    def __repr__(self) -> str:
        return f"<{self.path}: {self.typed if self.value is None else self.value}>"


class InputList(PartList[PressInput]):
    """Hold inputs in the order of the file: by number, or by path (``press.inputs["drive.crank_length"]``)."""

    _missing = phrase("there is no input")

    def _names(self, part: PressInput) -> tuple[str, ...]:
        return part.path, f"{MECHANISMS}.{part.path}"

    def _ipython_key_completions_(self) -> list[str]:
        return [each.path for each in self]

    def html(self, title: str = "") -> str:
        """Return them as a notebook shows them, by mechanism."""
        words = Catalogue(self.language or SOURCE_LANGUAGE)
        with speaking(words.language):
            by_home = groupby(self, lambda each: each.path.split(".")[0])
            groups = [(home, [each.row(words) for each in rows]) for home, rows in by_home]
        return notebook_page("inputs", words, title=title, groups=groups)

    _repr_html_ = html


def press_inputs(config: Config) -> Iterator[PressInput]:
    """Yield all inputs that have a value, those that are given and the defaults."""
    for instance in config.instances.values():
        for slot in instance.slots if instance else ():
            is_single = isinstance(slot.meta, Quantity | Text) and not isinstance(slot.value, list | dict)
            if instance is not None and is_single and slot.value is not None:
                yield _input(config, instance, slot)


def _input(config: Config, instance: Instance, slot: Slot) -> PressInput:
    path = ".".join(map(str, (instance.name, *slot.key)))
    typed = str(instance.place.typed(slot.key) or "")
    is_followed = (instance.name, *slot.key) in config.links
    basis, meta = instance.bases.get(slot.key, Basis()), slot.meta
    kind = instance.mechanism.kind if instance.mechanism else ""
    value = None if is_followed else _value(path, slot, instance.value(slot.key))
    rests, described = basis.basis, meta.description if meta else ""
    if not isinstance(meta, Quantity):
        choices: list[str] = []
        with suppress(UnknownPath):  # of a key that cannot be varied
            choices += allowed_texts(find_input(config, whole_path(path)).annotation)
        return PressInput(path, kind, value, typed, "1", ", ".join(choices), "", described, rests, basis.note)
    rests = rests or (GIVEN if typed else "")
    return PressInput(path, kind, value, typed, meta.unit, meta.allowed, meta.symbol, described, rests, basis.note)


def _value(path: str, slot: Slot, value: Any) -> QuantityValue | None:
    meta = slot.meta
    if isinstance(value, InOtherUnit):
        shown = given_shown(value.value, value.unit)
        words = (meta.symbol, meta.description) if meta else ("", "")
        return QuantityValue(value.value, unit(value.unit).si, path, *words, "", (shown["text"], shown["unit"]))
    if isinstance(meta, Quantity) and isinstance(value, int | float):
        shown = given_shown(float(value), meta.unit)
        printed = shown["text"], shown["unit"]
        return QuantityValue(value, meta.parsed_unit.si, path, meta.symbol, meta.description, "", printed)
    if isinstance(value, bool | int | float | str):
        return QuantityValue(value, "1", path, description=meta.description if meta else "")
    return None


def whole_path(name: str) -> str:
    """Return the path of an input in the file, where its mechanism may be named alone."""
    return name if name.split(".")[0] in (PRESS, MECHANISMS, *WORDS) else f"{MECHANISMS}.{name}"


def _typed_at_part(config: Config, found: Input, value: Any) -> str:
    """A value as it is typed at a part, where it may stand within a text of several numbers."""
    given = scalar(value, found.path)
    if not isinstance(found.meta, Quantity) or (isinstance(given, str) and "${" in given):
        return typed(value, found.path)
    try:
        found.meta.validate(given)
    except ValueError as fault:
        raise ConfigError(Problem(str(fault), config.tree.file, path=found.path)) from None
    return str(given)


def placed(config: Config, name: str, value: Any) -> tuple[KeyPath, str]:
    """Return the place in the file of what a path names (an input, or a field of ``project`` or ``report``), and the value as typed there.

    ConfigError in words for an unknown path.
    """
    first, *rest = name.removeprefix(f"{MECHANISMS}.").split(".")
    key: KeyPath = tuple(int(part) if part.isdigit() else part for part in rest)
    if first in ("project", "report"):
        return (first, *key), typed(value, name)
    is_of_parts = first in WORDS and config.parts is not None
    try:
        found = varied_input(config, name) if is_of_parts else find_input(config, whole_path(name))
    except UnknownPath as fault:
        raise ConfigError(Problem(str(fault), config.tree.file, path=name)) from None
    if isinstance(value, str) and isinstance(found.meta, Quantity):
        with suppress(UnitError):  # of an expression, or of what is judged when it is read
            value = with_point(value)
    if is_of_parts:
        return typed_place(config, found), _typed_at_part(config, found, value)
    instance = config.instances[found.instance]
    assert instance is not None, "an input of a broken plugin is not found"
    tree, place = instance.place.stands(found.key)
    return place if tree is config.tree else (*instance.place.root, *found.key), typed(value, name)
