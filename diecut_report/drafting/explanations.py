"""What is said of a key beside it: symbol, meaning, what is allowed, its default, and what is not checked without it."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import dataclass
from typing import Any

from diecut_report.config.validation import ModelKey, keys_of
from diecut_report.contract.inputs import Block, CurveInput, PhaseInput, Quantity
from diecut_report.contract.mechanism import Mechanism
from diecut_report.drafting.guesses import options
from diecut_report.drafting.layout import UNBROKEN
from diecut_report.drafting.scalars import typed
from diecut_report.languages.speech import localised, said, say
from diecut_report.quantities.units import pretty

OPEN = "…"  # stands for a value that is one's own to give


@dataclass(frozen=True)
class Explained:
    """Explains the keys of one kind, in the language that is spoken; without a mechanism those of the press."""

    kind: str = ""
    mechanism: Mechanism | None = None

    def words(self, model: type[Block], name: str, given: Collection[str], path: str = "") -> str:
        """Return what is said of a key of a block; ``given`` are the keys that the block has."""
        known = keys_of(model)[name]
        return "; ".join(filter(None, (self._meaning(known), *self._more(model, known, name, given, path))))

    def _meaning(self, known: ModelKey) -> str:
        meta = known.meta
        described, symbol = getattr(meta, "description", ""), getattr(meta, "symbol", "")
        return ": ".join(filter(None, (symbol, said(described, self.kind))))

    def _more(self, model: type[Block], known: ModelKey, name: str, given: Collection[str], path: str) -> Iterator[str]:
        meta = known.meta
        if isinstance(meta, Quantity) and meta.allowed:
            in_typed_units = meta.allowed.replace(pretty(meta.unit) or "\0", meta.unit)
            yield localised(in_typed_units).replace(" ", UNBROKEN)
        if allowed := options(known):
            yield say("one of {options}", options=", ".join(map(str, allowed)))
        if name in given or known.field.is_required():
            return
        if others := _others(model, name, given):
            yield say("instead of {keys}", keys=", ".join(others))
        if default(known) not in (None, []):
            yield say("default")
        elif isinstance(meta, Quantity) and meta.press is not None:
            yield say("default: from {path}", path=meta.press.path)
        elif titles := self._checks(f"{path}{name}"):
            yield say("without it not checked: {titles}", titles=", ".join(titles))

    def _checks(self, key: str) -> list[str]:
        """The titles of the checks that a key alone makes possible: it is their limit, or one of their needs."""
        if self.mechanism is None:
            return []
        checks = [check for check in self.mechanism.checks if key == check.limit or key in check.needs]
        return list(dict.fromkeys(said(check.title, self.kind) for check in checks))


def default(known: ModelKey) -> Any:
    """Return the default of a key; None where it has none."""
    return None if known.field.is_required() else known.field.get_default(call_default_factory=True)


def sample(known: ModelKey) -> str:
    """Return what stands behind a key that is not given: its default with its unit, else a place to fill."""
    found, meta = default(known), known.meta
    if isinstance(meta, Quantity):
        if found is None and meta.press is not None and meta.press.formula is None:
            return f"${{{meta.press.path}}}"
        return _with_unit(OPEN if found is None else found, meta)
    if found not in (None, "", []):
        return typed(found)
    if isinstance(meta, CurveInput):
        return "${" + OPEN + "}"
    return "${" + OPEN + ".phases." + OPEN + "}" if isinstance(meta, PhaseInput) else OPEN


def _with_unit(value: Any, meta: Quantity) -> str:
    if isinstance(value, str) and value in meta.words:
        return value
    shown = typed(value if isinstance(value, str) else float(value))
    return shown if meta.unit == "1" else f"{shown} {meta.unit}"


def _others(model: type[Block], name: str, given: Collection[str]) -> list[str]:
    """The given keys of another alternative, beside which a key has no use."""
    for rule in model.one_of:
        own = [group for group in rule.groups if name in group]
        if own and name not in rule.shared and not any(set(group) <= set(given) for group in own):
            found = [key for group in rule.groups if group not in own and set(group) <= set(given) for key in group]
            if found := [key for key in found if key not in rule.shared]:
                return found
    return []
