"""Blocks of keys as lines: first the keys that have a value, then those that may be turned on."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from diecut_report.config.validation import ModelKey, keys_of
from diecut_report.contract.inputs import Block
from diecut_report.drafting.explanations import Explained, sample
from diecut_report.drafting.layout import DraftLine, shifted
from diecut_report.drafting.scalars import typed, with_basis

STEP = 2


@dataclass(frozen=True)
class BlockWriter:
    """Writes the keys of blocks of one kind."""

    explained: Explained

    def lines(self, model: type[Block], data: Mapping[str, Any], path: str = "") -> Iterator[DraftLine]:
        """Yield the lines of a block: its values, then the keys that it does not have, turned off."""
        yield from self.given(model, data, path)
        yield from self.off(model, data, path)

    def given(
        self, model: type[Block], data: Mapping[str, Any], path: str = "", *, is_told: bool = True
    ) -> Iterator[DraftLine]:
        """Yield the keys that have a value, in the order in which they are declared."""
        for name, known in keys_of(model).items():
            if name not in data:
                continue
            words = self.explained.words(model, name, data, path) if is_told else ""
            if known.block is None:
                yield DraftLine(0, f"{name}: {typed(with_basis(known.meta, data[name]))}", words)
                continue
            yield DraftLine(0, f"{name}:", words)
            own = f"{path}{name}."
            if known.is_list:
                yield from shifted(self._parts(known.block, data[name], own, is_told), STEP)
            else:
                inner = self.lines if is_told else self._bare
                yield from shifted(inner(known.block, data[name], own), STEP)

    def off(self, model: type[Block], data: Mapping[str, Any], path: str = "") -> Iterator[DraftLine]:
        """Yield the keys that a block does not have, as comments to be turned on."""
        for name, known in keys_of(model).items():
            if name not in data:
                yield from shifted(self._off(model, name, known, data, path), 0, off=True)

    def _off(
        self, model: type[Block], name: str, known: ModelKey, data: Mapping[str, Any], path: str
    ) -> Iterator[DraftLine]:
        words = self.explained.words(model, name, data, path)
        if known.block is None:
            yield DraftLine(0, f"{name}: {sample(known)}", words)
            return
        yield DraftLine(0, f"{name}:", words)
        own = f"{path}{name}."
        inner = [
            line for key, each in keys_of(known.block).items() for line in self._off(known.block, key, each, {}, own)
        ]
        yield from shifted(_as_part(inner) if known.is_list else inner, STEP)

    def _bare(self, model: type[Block], data: Mapping[str, Any], path: str) -> Iterator[DraftLine]:
        return self.given(model, data, path, is_told=False)

    def _parts(
        self, model: type[Block], parts: Sequence[Mapping[str, Any]], path: str, is_told: bool
    ) -> Iterator[DraftLine]:
        """The parts of a list; the keys of the first alone are explained."""
        for number, part in enumerate(parts):
            inner = self.lines if is_told and number == 0 else self._bare
            yield from _as_part(list(inner(model, part, path)))


def _as_part(lines: Sequence[DraftLine]) -> Iterator[DraftLine]:
    """The lines of a part of a list, the first behind a dash."""
    for number, line in enumerate(lines):
        if number == 0:
            yield DraftLine(line.indent, f"- {line.code}", line.comment, line.off)
        else:
            yield DraftLine(line.indent + STEP, line.code, line.comment, line.off)
