"""Fills an example with what the other mechanisms of a draft give: names in the place of kinds, other values where a kind is absent."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from diecut_report.config.validation import keys_of
from diecut_report.contract.example import KIND, ForEach, Wired, kinds_named
from diecut_report.contract.inputs import Block
from diecut_report.drafting.choices import Drafted


@dataclass(frozen=True)
class LeftOut:
    """Stand for a value that is left out; a mechanism of ``kind`` would give it, where that is told."""

    kind: str = ""


class NeedsKind(LookupError):
    """Report that a mechanism cannot be without one of another ``kind``."""

    def __init__(self, chosen: Drafted, kind: str) -> None:
        super().__init__(f"{chosen.name} needs {kind}")
        self.kind = kind


@dataclass(frozen=True)
class Wiring:
    """Knows the names of the mechanisms of each kind, and which of them the example is of."""

    names: Mapping[str, Sequence[str]]
    own: Drafted

    def inputs(self, data: Mapping[str, Any]) -> dict[str, Any]:
        """Return the values of a mechanism's keys; NeedsKind where one that is needed comes from a kind that is not there."""
        model, found = self.own.mechanism.inputs, {}
        for key, value in data.items():
            known = keys_of(model).get(key)
            made = self.value(value, known.block if known else None)
            if not isinstance(made, LeftOut):
                found[key] = made
            elif known and known.field.is_required() and made.kind:
                raise NeedsKind(self.own, made.kind)
        return found

    def value(self, value: Any, model: type[Block] | None) -> Any:
        """Return what stands for a declared value, ``LeftOut`` where nothing does."""
        match value:
            case Wired():
                return self._wired(value, model)
            case str():
                return self._text(value)
            case dict():
                return self._block(value, model)
            case list() | tuple():
                return self._list(value, model)
        return value

    def _text(self, text: str) -> str | LeftOut:
        if missing := self._missing(kinds_named(text)):
            return LeftOut(missing)
        return KIND.sub(lambda found: self._name(found[1]), text)

    def _wired(self, wired: Wired, model: type[Block] | None) -> Any:
        missing = self._missing(wired.kinds)
        if wired.value is None and not missing:
            return LeftOut()
        made = LeftOut(missing) if missing else self.value(wired.value, model)
        if not isinstance(made, LeftOut) or wired.otherwise is None:
            return made
        other = self.value(wired.otherwise, model)
        return made if isinstance(other, LeftOut) else other

    def _block(self, data: Mapping[str, Any], model: type[Block] | None) -> Any:
        known = keys_of(model) if model else {}
        found: dict[str, Any] = {}
        for key, value in data.items():
            made = self.value(value, known[key].block if key in known else None)
            if not isinstance(made, LeftOut):
                found[key] = made
            elif key not in known or known[key].field.is_required():
                return made
        return found

    def _list(self, parts: Sequence[Any], model: type[Block] | None) -> Any:
        made = [each for part in parts for each in self._parts(part, model)]
        found = [part for part in made if not isinstance(part, LeftOut)]
        absent = [part for part in made if isinstance(part, LeftOut)]
        return absent[0] if absent and not found else found

    def _parts(self, part: Any, model: type[Block] | None) -> list[Any]:
        if not isinstance(part, ForEach):
            return [self.value(part, model)]
        names = self.names.get(part.kind, ())
        one_by_one = [replace(self, names={**self.names, part.kind: (name,)}) for name in names]
        return [wiring.value(part.part, model) for wiring in one_by_one] or [LeftOut(part.kind)]

    def _missing(self, kinds: Iterable[str]) -> str:
        """The first of these kinds that is not there."""
        return next((kind for kind in kinds if kind != self.own.kind and not self.names.get(kind)), "")

    def _name(self, kind: str) -> str:
        """The mechanism of a kind: the first belongs to the first, the second to the second; of the own kind the own one."""
        if kind == self.own.kind:
            return self.own.name
        names = self.names[kind]
        own = self.names[self.own.kind]
        place = own.index(self.own.name) if self.own.name in own else 0
        return names[min(place, len(names) - 1)]
