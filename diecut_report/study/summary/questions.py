"""What the study asks, as its file says it."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any, NamedTuple

from diecut_report.config import yaml_tree
from diecut_report.languages.phrases import phrase
from diecut_report.languages.speech import said, say
from diecut_report.study.analysis.stored_variants import Stored, StoredColumn
from diecut_report.study.analysis.titles import MECHANISMS
from diecut_report.study.conditions.constraints import why_dropped
from diecut_report.study.summary.quantity_names import named, value_told, variants

METHODS = {
    "grid": phrase("grid: each value with each"),
    "zip": phrase("zip: the first values together, the second together, and so on"),
    "latin_hypercube": phrase("Latin hypercube"),
    "sobol": phrase("Sobol sequence"),
    "table": phrase("rows of a table"),
}
Path = tuple[str | int, ...]
NAME = re.compile(r"[A-Za-z_][\w.]*")


class AskedInput(NamedTuple):
    """Hold a varied input: what people call it, its symbol, its path, and its values as written, a choice in words too."""

    told: str
    symbol: str
    path: str
    values: str


class AskedText(NamedTuple):
    """Hold an objective or a constraint: in words, and as the study file has it."""

    told: str
    typed: str


class Asked(NamedTuple):
    """Hold what was studied: facts, varied inputs, objectives, constraints, and what ``reports`` asks for."""

    facts: list[tuple[str, str]]
    inputs: list[AskedInput]
    objectives: list[AskedText]
    constraints: list[AskedText]
    reports: str


def asked(stored: Stored) -> Asked | None:
    """Return what the kept copy of the study file says; None where the copy is gone or changed."""
    content = stored.description.study.content
    if content is None:
        return None
    tree = yaml_tree.parse(content.decode("utf-8-sig"), stored.description.study.file)
    data: Mapping[str, Any] = tree.data
    return Asked(
        list(_facts(stored, tree, data)),
        [_input(stored, tree, path) for path in stored.study.get("varied") or ()],
        [_objective(stored, way, str(name)) for each in data.get("objectives") or () for way, name in each.items()],
        [AskedText(_quantities(stored, str(each)), str(each)) for each in data.get("constraints") or ()],
        _reports(tree, data.get("reports")),
    )


def outputs(stored: Stored) -> list[str]:
    """Return the outputs that the study file asks for by their names; none where it keeps all, or its copy is gone."""
    content = stored.description.study.content
    if content is None:
        return []
    data: Mapping[str, Any] = yaml_tree.parse(content.decode("utf-8-sig"), stored.description.study.file).data
    return [str(name) for name in data.get("outputs") or ()]


def _facts(stored: Stored, tree: yaml_tree.Tree, data: Mapping[str, Any]) -> list[tuple[str, str]]:
    sample, counts = data.get("sample") or {}, stored.study.get("counts") or {}
    method = str(sample.get("method", ""))
    facts = [(say("Base"), str(data.get("base", stored.description.base.file)))]
    facts.append(
        (say("Sample"), said(METHODS.get(method, method)) + (f": {sample['file']}" if "file" in sample else ""))
    )
    facts += [(name, written(tree, ("sample", key))) for key, name in (("count", say("Count")),) if key in sample]
    if method in ("latin_hypercube", "sobol"):
        facts.append((say("Seed"), written(tree, ("sample", "seed")) if "seed" in sample else say("0 (none is given)")))
    if sample.get("indices"):
        facts.append((say("Sobol indices"), say("yes: each of the points above is a group of variants")))
    if "sample" in counts and counts["sample"] != sample.get("count"):
        facts.append((say("Variants of the sample"), variants(int(counts["sample"]))))
    if data.get("constraints"):
        facts.append(
            (say("Dropped by the constraints"), variants(int(counts.get("dropped") or 0)) + said(why_dropped(counts)))
        )
    return facts


def _objective(stored: Stored, way: str, name: str) -> AskedText:
    column, typed = _column_of(stored, name), f"{way}: {name}"
    words = "least {quantity}" if way == "minimise" else "greatest {quantity}"
    return AskedText(say(words, quantity=named(column)) if column else typed, typed if column else "")


def _quantities(stored: Stored, expression: str) -> str:
    """What the names in an expression are called."""
    columns = [_column_of(stored, name) for name in dict.fromkeys(NAME.findall(expression))]
    return ", ".join(_with_symbol(column) for column in columns if column)


def _with_symbol(column: StoredColumn) -> str:
    return named(column) + (f" {column.symbol}" if column.symbol else "")


def _column_of(stored: Stored, name: str) -> StoredColumn | None:
    """The column that a study means by a name, with ``mechanisms.`` or without."""
    return stored.columns.get(name) or stored.columns.get(f"{MECHANISMS}{name}")


def _input(stored: Stored, tree: yaml_tree.Tree, path: str) -> AskedInput:
    column = stored.columns.get(path)
    given = path in (tree.data.get("vary") or {})
    values = _values(tree, ("vary", path)) if given else _column(tree)
    return AskedInput(named(column) if column else path, column.symbol if column else "", path, values)


def _values(tree: yaml_tree.Tree, place: Path) -> str:
    """Values as they are written; choices in words, with what is typed behind them."""
    value = tree.data
    for step in place:
        value = value[step]
    if not isinstance(value, list) or not any(isinstance(each, str) and value_told(each) != each for each in value):
        return written(tree, place)
    told = [(value_told(each), written(tree, (*place, index))) for index, each in enumerate(value)]
    return ", ".join(typed if words == typed else f"{words} ({typed})" for words, typed in told)


def _column(tree: yaml_tree.Tree) -> str:
    return say("a column of {table}", table=tree.typed(("sample", "file")) or phrase("the table"))


def written(tree: yaml_tree.Tree, path: Path) -> str:
    """Return a value as the file says it: lists with commas, a range as ``from A to B``, other keys with their names."""
    value = tree.data
    for step in path:
        value = value[step]
    if isinstance(value, list):
        return ", ".join(written(tree, (*path, index)) for index in range(len(value)))
    if not isinstance(value, dict):
        return tree.typed(path) or ""
    parts = {str(key): written(tree, (*path, key)) for key in value}
    head = (
        [say("from {least} to {most}", least=parts.pop("from"), most=parts.pop("to"))]
        if {"from", "to"} <= parts.keys()
        else []
    )
    kind = parts.pop("distribution", "")
    head += [kind] if kind else []
    if "table" in parts:
        table = parts.pop("table")
        column = parts.pop("column", "")
        head.append(
            say("column {column} of the table {table}", column=column, table=table)
            if column
            else say("the table {table}", table=table)
        )
    return ", ".join([*head, *(f"{key} {text}" for key, text in parts.items())])


def _reports(tree: yaml_tree.Tree, given: Any) -> str:
    return say("none") if given is None else written(tree, ("reports",))
