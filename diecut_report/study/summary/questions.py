"""What the study asks, as its file says it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

from diecut_report.config import yaml_tree
from diecut_report.languages.phrases import phrase
from diecut_report.languages.speech import said, say
from diecut_report.study.analysis.stored_variants import Stored
from diecut_report.study.conditions.constraints import why_dropped
from diecut_report.study.summary.quantity_names import named, variants

METHODS = {
    "grid": phrase("grid: each value with each"),
    "zip": phrase("zip: the first values together, the second together, and so on"),
    "latin_hypercube": phrase("Latin hypercube"),
    "sobol": phrase("Sobol sequence"),
    "table": phrase("rows of a table"),
}
Path = tuple[str | int, ...]


class Asked(NamedTuple):
    """Hold what was studied: facts, each varied input (title, path, values as written), constraints, and what ``reports`` asks for."""

    facts: list[tuple[str, str]]
    inputs: list[tuple[str, str, str]]
    constraints: list[str]
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
        [str(each) for each in data.get("constraints") or ()],
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
    goals = [f"{way} {name}" for each in data.get("objectives") or () for way, name in each.items()]
    return [*facts, *([(say("Objectives"), "; ".join(goals))] if goals else [])]


def _input(stored: Stored, tree: yaml_tree.Tree, path: str) -> tuple[str, str, str]:
    column = stored.columns.get(path)
    place: Path = ("vary", path)
    given = path in (tree.data.get("vary") or {})
    return (named(column) if column else path, path, written(tree, place) if given else _column(tree))


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
