"""A configuration or a study from standard input."""

from __future__ import annotations

from pathlib import Path

from diecut_report.config.yaml_tree import MAX_BYTES, Tree, read
from diecut_report.given_files import standard_input

SHOWN, NAME = "<stdin>", "stdin.yaml"  # what messages and documents call it


def load_standard_input() -> Tree:
    """Read YAML from standard input, up to its end; what its text names is sought from the current folder."""
    tree = read(Path(SHOWN), standard_input(MAX_BYTES, SHOWN))
    tree.name = NAME
    return tree
