"""Constraints between inputs, and on outputs: a text such as ``mechanisms.a.bore <= 0.6 * a.radius_min``, read once, held on arrays."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from diecut_report.config.instances import Target
from diecut_report.config.loader import Config
from diecut_report.config.model import PRESS
from diecut_report.config.parts.keys import WORDS
from diecut_report.config.yaml import dotted
from diecut_report.formulas import Array
from diecut_report.formulas.condition_numpy import JudgedRows, judged, shortfall
from diecut_report.formulas.condition_parts import Name, read
from diecut_report.formulas.condition_tree import Node as Tree
from diecut_report.formulas.condition_tree import as_formula, names
from diecut_report.formulas.conditions import ConditionError
from diecut_report.formulas.formula import evaluate
from diecut_report.formulas.tree import Node, symbols, transform
from diecut_report.mechanism.curve_inputs import InOtherUnit
from diecut_report.study.definition.base_inputs import MECHANISMS, Input, UnknownPath, find_input, is_of_parts
from diecut_report.text.phrases import Phrase, phrase

WITHOUT_VALUE = phrase("a division by zero, or the root of a number below zero")
EXAMPLE = "mechanisms.NAME.KEY <= '90 mm'"


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
        return judged(self.tree, partial(self._value, rows), len(rows[self.paths[0]]))

    def shortfall(self, rows: Mapping[str, Any]) -> Array:
        """Return for each row 0 where it holds, else how far it is from that."""
        return shortfall(self.tree, partial(self._value, rows), len(rows[self.paths[0]]))

    def _value(self, rows: Mapping[str, Any], name: str) -> Any:
        def leaf_value(leaf: Node) -> Any:
            value = leaf.args[0]
            if leaf.op == "sym":
                return np.asarray(rows[value])
            return value if isinstance(value, str) else np.float64(value)

        node = self.values[name]
        if node.op == "sym":
            return rows[node.args[0]]
        value = evaluate(node, leaf_value)
        return value if isinstance(value, str) else np.where(np.isfinite(value), value, np.nan)


def why_dropped(counts: Mapping[str, Any]) -> str:
    """Return what to add where the dropped variants are counted: how many of them because a constraint has no value."""
    found = counts.get("without_value")
    template = ", {n} of them because a constraint has no value there ({why})"
    return Phrase(template, n=found, why=WITHOUT_VALUE) if found else ""


def parse(text: str, find: Callable[[str], tuple[Name, Node]], known: Collection[str] = ()) -> Constraint:
    """Read a constraint; ConditionError for what it may not hold, unlike dimensions, or no varied path in it.

    ``find`` says what a path stands for, and its value: ``sym`` of a varied path or of an output, ``qty`` of a value that the base
    fixes, or an expression of these; ConditionError where a constraint may not name it. ``known``: paths that are taken whole,
    whatever they are made of.
    """
    found: dict[str, Node] = {}

    def name(path: str) -> Name:
        if "." not in path and path not in known:
            template = "write the whole path of an input, such as mechanisms.NAME.KEY, an output as NAME.OUTPUT, and texts in quotes"
            advice = phrase(template)
            raise ConditionError("“{path}” is not a path of an input; {advice}.", path=path, advice=advice)
        named, found[path] = find(path)
        return named

    tree = read(text, known, name, EXAMPLE)
    outputs = tuple(path for path in found if path.partition(".")[0] not in (MECHANISMS, PRESS, *WORDS))
    made = Constraint(text, tree, found, outputs)
    if not made.paths:
        template = "“{text}” names no varied path, so it would keep all variants or none; name one of vary."
        raise ConditionError(template, text=text)
    return made


# What a path in a constraint stands for: a varied input, or what the base says of another one before calculating.


def term(base: Config, varied: Mapping[str, Input], path: str) -> tuple[Name, Node]:
    """Return what a path stands for, and its value; ConditionError where it is not known before the calculation.

    ``base`` has stand-ins for what is varied, so that its references are those of every variant.
    """
    if path in varied:
        return _name(varied[path]), Node("sym", (path,))
    try:
        asked = find_input(base, path)
    except UnknownPath as fault:
        raise ConditionError("“{path}”: {fault}", path=path, fault=fault) from None
    if (
        base.parts is not None
        and base.parts.follows(asked.node)
        and any(is_of_parts(base, each) for each in varied.values())
    ):
        raise ConditionError(
            "“{path}” follows from the parts of the machine, which vary; name what is typed there.", path=path
        )
    target = base.links.get(asked.node)
    if target is None:
        node = Node("qty", (_fixed(base, asked),))
    elif target.expression is None:
        node = _referred(base, varied, asked, target)
    else:
        nodes = [_referred(base, varied, asked, single) for single in target.terms]
        node = as_formula(target.expression.tree, dict(zip(target.expression.names, nodes, strict=True)))
    return _name(asked), node


def _name(asked: Input) -> Name:
    return Name(asked.path, "text") if asked.unit is None else Name(asked.path, "number", asked.unit, asked.display)


def _referred(base: Config, varied: Mapping[str, Input], asked: Input, target: Target) -> Node:
    """Return the value of what an input refers to, by the formula of its default where it has one."""
    if target.result is not None or target.is_broken:
        template = (
            "“{path}” refers to ${{target}}, which is known only after calculating; in a constraint an output is named by "
            "itself, as in NAME.OUTPUT."
        )
        raise ConditionError(template, path=asked.path, target=target.path)
    head = PRESS if target.instance == PRESS else f"{MECHANISMS}.{target.instance}"
    _, node = term(base, varied, ".".join([head, *map(str, target.key)]))
    if target.formula is None:
        return node
    known = {name: Node("qty", (float(value),)) for name, value in target.formula.constants.items()}
    known |= {"π": Node("qty", (math.pi,)), target.formula.parameters[0]: node}
    return transform(target.formula.tree, lambda leaf: known[leaf.args[0]] if leaf.op == "sym" else leaf)


def _fixed(base: Config, asked: Input) -> float | str:
    instance = base.instances[asked.instance]
    assert instance is not None, "an input of a broken plugin is not found"
    name = dotted(asked.key)
    value = instance.value(asked.key) if name in instance.given else None
    if value is None:
        raise ConditionError("“{path}” has no value in the base; give it there, or vary it.", path=asked.path)
    return stored_value(value)


def stored_value(value: Any) -> float | str:
    """Return a value as a sample holds it: a yes/no as the text that YAML has for it, a whole number as a float."""
    if isinstance(value, bool):
        return str(value).lower()
    value = value.value if isinstance(value, InOtherUnit) else value
    return value if isinstance(value, str) else float(value)
