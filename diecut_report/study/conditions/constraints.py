"""Constraints between inputs, and on outputs: a text such as ``mechanisms.a.bore <= 0.6 * a.radius_min``, read once, held on arrays."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from diecut_report.conditions.numpy_emitter import JudgedRows, judged
from diecut_report.conditions.parts import Name
from diecut_report.conditions.reading import read
from diecut_report.conditions.shortfall import shortfall
from diecut_report.conditions.tree import Node as Tree
from diecut_report.conditions.tree import names
from diecut_report.conditions.words import ConditionError
from diecut_report.expressions import Array, Node, evaluate, symbols
from diecut_report.languages.phrases import Phrase, phrase

WITHOUT_VALUE = phrase("a division by zero, or the root of a number below zero")
EXAMPLE = "mechanisms.NAME.KEY <= '90 mm'"


@dataclass(frozen=True)
class Term:
    """Hold what a path stands for in a constraint: its SI unit (None for a text or a yes/no), its value, and the unit that people read.

    The value is ``sym`` of a varied path or of an output, ``qty`` of a value that the base fixes, or an expression of these.
    """

    unit: str | None
    node: Node
    display: str = ""
    is_output: bool = False
    is_truth: bool = False  # an output that is a yes or a no; an input of that sort is a text


Find = Callable[[str], Term]
"""What a path stands for; ConditionError in words where it stands for nothing that a constraint may name."""


@dataclass(frozen=True)
class Constraint:
    """Hold what must hold of a variant; ``values`` says what each name in its tree stands for.

    With ``outputs``, the results that it names, it is judged when the variant is calculated; else before.
    """

    text: str
    tree: Tree
    values: Mapping[str, Node]
    outputs: tuple[str, ...] = ()

    @property
    def paths(self) -> tuple[str, ...]:
        """Return the varied paths and the outputs that it names."""
        return tuple(dict.fromkeys(path for name in names(self.tree) for path in symbols(self.values[name])))

    def judged(self, rows: Mapping[str, Any]) -> JudgedRows:
        """Return for each row whether it holds and whether it fails; what has no value (a division by zero) does neither."""

        return judged(self.tree, partial(self._value_of, rows), len(rows[self.paths[0]]))

    def shortfall(self, rows: Mapping[str, Any]) -> Array:
        """Return for each row 0 where it holds, else how far it is from that."""
        return shortfall(self.tree, partial(self._value_of, rows), len(rows[self.paths[0]]))

    def _value_of(self, rows: Mapping[str, Any], name: str) -> Any:
        node = self.values[name]
        if node.op == "sym":
            return rows[node.args[0]]
        found = evaluate(node, lambda leaf: _value(leaf, rows))
        return found if isinstance(found, str) else np.where(np.isfinite(found), found, np.nan)

    def holds(self, rows: Mapping[str, Any]) -> Array:
        """Return for each row whether it holds."""
        return self.judged(rows).holds


def why_dropped(counts: Mapping[str, Any]) -> str:
    """Return what to add where the dropped variants are counted: how many of them because a constraint has no value."""
    found = counts.get("without_value")
    words = ", {n} of them because a constraint has no value there ({why})"
    return Phrase(words, n=found, why=WITHOUT_VALUE) if found else ""


def _value(leaf: Node, rows: Mapping[str, Any]) -> Any:
    value = leaf.args[0]
    return np.asarray(rows[value]) if leaf.op == "sym" else value if isinstance(value, str) else np.float64(value)


def parse(text: str, find: Find, known: Collection[str] = ()) -> Constraint:
    """Read a constraint; ConditionError in words for what it may not hold, unlike dimensions, or no varied path in it.

    ``known``: paths that are taken whole, whatever they are made of.
    """
    found: dict[str, Node] = {}
    outputs: list[str] = []

    def name(path: str) -> Name:
        if "." not in path and path not in known:
            advice = phrase(
                "write the whole path of an input, such as mechanisms.NAME.KEY, an output as NAME.OUTPUT, and "
                "texts in quotes"
            )
            raise ConditionError(Phrase("“{path}” is not a path of an input; {advice}.", path=path, advice=advice))
        term = find(path)
        found[path] = term.node
        if term.is_output:
            outputs.append(path)
        if term.is_truth:
            return Name(path, "truth")
        return Name(path, "text") if term.unit is None else Name(path, "number", term.unit, term.display)

    made = Constraint(text, read(text, known, name, EXAMPLE), found, tuple(dict.fromkeys(outputs)))
    if not made.paths:
        words = Phrase(
            "“{text}” names no varied path, so it would keep all variants or none; name one of vary.", text=text
        )
        raise ConditionError(words)
    return made
