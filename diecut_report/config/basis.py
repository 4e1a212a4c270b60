"""What a value rests on: a quantity as a block ``{value: 0.8 kg*m**2, basis: assumed, note: …}``, and the weakest of a chain."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

from diecut_report.config.validation import ConfigPlace, keys_of, told
from diecut_report.config.yaml_tree import KeyPath
from diecut_report.contract.inputs import Block, CurveInput, Quantity, Text
from diecut_report.contract.varying import Varying
from diecut_report.errors import Problem, nearest
from diecut_report.languages.phrases import Phrase

ASSUMED, GIVEN = "assumed", "given"
BASES = (ASSUMED, GIVEN, "catalogue", "drawing", "standard", "measured")
"""From the weakest to the strongest: an assumption can be anything; what is only given says nothing of where it comes from; a
maker's catalogue tells what is sold, a drawing what is to be made, a standard what is agreed, a measurement what is there."""
KEYS = ("value", "basis", "note")


@dataclass(frozen=True)
class Basis:
    """Hold what a value rests on ("" where that is not said), and what the user notes of it."""

    basis: str = ""
    note: str = ""


def is_founded(basis: str, note: str) -> bool:
    """Return whether somebody can look a value up: measured, on a drawing, or by a standard or a catalogue that the note names."""
    return basis in ("measured", "drawing") or (basis in ("standard", "catalogue") and bool(note.strip()))


def weakest(bases: Iterable[str]) -> str:
    """Return the weakest basis; nothing where there are none."""
    return min(bases, key=BASES.index, default="")


@dataclass
class BasisReader:
    """Takes the blocks of quantities apart: ``data`` has their values, ``place`` where these stand, ``bases`` what they rest on."""

    place: ConfigPlace
    data: dict[str, Any] = field(default_factory=dict)
    bases: dict[KeyPath, Basis] = field(default_factory=dict)
    problems: list[Problem] = field(default_factory=list)

    @staticmethod
    def read(model: type[Block], data: Mapping[str, Any], place: ConfigPlace) -> BasisReader:
        """Return what the data of a block say."""
        reader = BasisReader(place)
        reader.data = reader._block(model, data, ())
        return reader

    def _block(self, model: type[Block], data: Mapping[str, Any], key: KeyPath) -> dict[str, Any]:
        known = keys_of(model)
        return {
            name: self._value(known[name], given, (*key, name)) if name in known else given
            for name, given in data.items()
        }

    def _value(self, known: Any, given: Any, key: KeyPath) -> Any:
        if known.block and isinstance(given, list):
            return [self._inner(known.block, part, (*key, index)) for index, part in enumerate(given)]
        if known.block:
            return self._inner(known.block, given, key)
        if (
            isinstance(known.meta, Varying)
            and known.meta.extremes
            and {"min", "max"} & set(given if isinstance(given, dict) else ())
        ):
            return given
        if isinstance(known.meta, Quantity | CurveInput) and isinstance(given, dict):
            return self._stated(known.meta.unit, given, key)
        if isinstance(known.meta, Text) and isinstance(given, dict) and "value" in given:
            return self._stated("1", given, key)
        return given

    def _inner(self, model: type[Block], given: Any, key: KeyPath) -> Any:
        return self._block(model, given, key) if isinstance(given, dict) else given

    def _stated(self, unit: str, given: dict[str, Any], key: KeyPath) -> Any:
        """The value of a quantity that stands as a block; the block itself where it is not one."""
        faults = list(self._faults(unit, given, key))
        self.problems += faults
        if given.get("value") is None:
            return 1.0 if faults else given  # what is wrong has been told
        own = self.place.inner(key)
        self.place = replace(self.place, listed={**self.place.listed, key: (*own, "value")})
        if not faults:
            self.bases[key] = Basis(given.get("basis") or "", given.get("note") or "")
        return given["value"]

    def _faults(self, unit: str, given: dict[str, Any], key: KeyPath) -> Iterator[Problem]:
        if given.get("value") is None:
            words = Phrase(
                "is a block without a value; write {value: 10 {unit}, basis: assumed}, or the value alone",
                unit=unit,
            )
            yield self.place.problem(key, words.replace("10 1,", "10,"))
        for name in given:
            if name not in KEYS:
                words = Phrase(
                    "is an unknown key{nearest}. A quantity that stands as a block has {keys}.",
                    nearest=nearest(name, KEYS),
                    keys=", ".join(KEYS),
                )
                yield self.place.problem((*key, name), words, at_key=True)
        basis, note = given.get("basis"), given.get("note")
        if "basis" in given and basis not in BASES:
            near = nearest(basis, BASES) if isinstance(basis, str) else ""
            yield self.place.problem(
                (*key, "basis"),
                Phrase("is {basis}{near}; allowed: {bases}", basis=told(basis), near=near, bases=", ".join(BASES)),
            )
        if note is not None and not isinstance(note, str):
            yield self.place.problem(
                (*key, "note"), Phrase("is {note}; a text is needed, in quotes where it is a number", note=told(note))
            )
