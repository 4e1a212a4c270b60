"""What a path in a constraint stands for: a varied input, or what the base says of another one before calculating."""

from __future__ import annotations

import math
from collections.abc import Mapping

from diecut_report.conditions.formula_tree import as_formula
from diecut_report.conditions.words import ConditionError
from diecut_report.config.loader import Config
from diecut_report.config.model import PRESS
from diecut_report.config.targets import Target
from diecut_report.contract.inputs import Quantity
from diecut_report.expressions import Formula, Node, transform
from diecut_report.languages.phrases import Phrase
from diecut_report.study.conditions.constraints import Term
from diecut_report.study.definition.base_inputs import (
    MECHANISMS,
    Input,
    UnknownPath,
    find_input,
)


def term(base: Config, varied: Mapping[str, Input], path: str) -> Term:
    """Return what a path stands for; ConditionError in words where it is not known before the calculation.

    ``base`` has stand-ins for what is varied, so that its references are those of every variant.
    """
    if path in varied:
        return Term(varied[path].unit, Node("sym", (path,)), _display(varied[path]))
    try:
        asked = find_input(base, path)
    except UnknownPath as fault:
        raise ConditionError(f"“{path}”: {fault}") from None
    target = base.links.get((asked.instance, *asked.key))
    if target is None:
        return Term(asked.unit, Node("qty", (_fixed(base, asked),)), _display(asked))
    if target.expression is None:
        return _referred(base, varied, asked, target)
    nodes = [_referred(base, varied, asked, single).node for single in target.terms]
    known = dict(zip(target.expression.names, nodes, strict=True))
    return Term(asked.unit, as_formula(target.expression.tree, known), _display(asked))


def _display(asked: Input) -> str:
    return asked.meta.unit if isinstance(asked.meta, Quantity) else ""


def _referred(base: Config, varied: Mapping[str, Input], asked: Input, target: Target) -> Term:
    if target.result is not None or target.is_broken:
        raise ConditionError(
            Phrase(
                "“{path}” refers to ${{target}}, which is known only after calculating; in a constraint an "
                "output is named by itself, as in NAME.OUTPUT.",
                path=asked.path,
                target=target.path,
            )
        )
    head = PRESS if target.instance == PRESS else f"{MECHANISMS}.{target.instance}"
    found = term(base, varied, ".".join([head, *map(str, target.key)]))
    if target.formula is None:
        return found
    assert isinstance(asked.meta, Quantity), "only quantities have a default that the press gives"
    return Term(asked.meta.parsed_unit.si, _applied(target.formula, found.node), _display(asked))


def _applied(formula: Formula, to: Node) -> Node:
    """The formula of a default, of what it is derived from."""
    known = {name: Node("qty", (float(value),)) for name, value in formula.constants.items()}
    known |= {"π": Node("qty", (math.pi,)), formula.parameters[0]: to}
    return transform(formula.tree, lambda leaf: known[leaf.args[0]] if leaf.op == "sym" else leaf)


def _fixed(base: Config, asked: Input) -> float | str:
    instance = base.instances[asked.instance]
    assert instance is not None, "an input of a broken plugin is not found"
    name = ".".join(part for part in asked.key if isinstance(part, str))
    value = instance.value(asked.key) if name in instance.given else None
    if value is None:
        raise ConditionError(Phrase("“{path}” has no value in the base; give it there, or vary it.", path=asked.path))
    return str(value).lower() if isinstance(value, bool) else value if isinstance(value, str) else float(value)
