"""Files of studies, which are no configurations: known by their keys, and refused where a configuration is needed."""

from __future__ import annotations

from pathlib import PurePath

from diecut_report.config.yaml_tree import Tree
from diecut_report.errors import Problem, UserError
from diecut_report.languages.phrases import Phrase

KEYS = frozenset({"base", "vary", "sample"})
"""By each of which a study is known, also where another is forgotten or mistyped."""


def is_study(tree: Tree) -> bool:
    """Return whether a file is a study rather than a configuration."""
    return isinstance(tree.data, dict) and "mechanisms" not in tree.data and not KEYS.isdisjoint(tree.data)


def refuse_study(tree: Tree) -> None:
    """Raise UserError where a study is given for a configuration: with the command that takes it, and its base."""
    if is_study(tree):
        command = "optimise" if "optimise" in tree.data else "batch"
        words = "This is a study: calculate it with diecut-report {command} {file}, or give its base, {base}"
        base = PurePath(tree.file).parent / str(tree.data.get("base", "…"))
        raise UserError(Problem(Phrase(words, command=command, file=tree.file, base=base), tree.file))
