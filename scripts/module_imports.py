"""Which modules of the program import which; for scripts/mutant_runs.py."""

from __future__ import annotations

import ast
from functools import cache
from pathlib import Path

from unit_tests import ROOT, units


def unmoved(unit: str) -> list[str]:
    """The modules of the program that do not import a plugin or module, themselves or through others."""
    changed, known = {module_of(file) for file in units()[unit]}, imports()
    while more := {name for name, names in known.items() if names & changed} - changed:
        changed |= more
    return sorted(name for name in known if name not in changed and not name.endswith("__main__"))


@cache
def imports() -> dict[str, frozenset[str]]:
    """The modules of the program and its plugins, with what each imports."""
    files = [*(ROOT / "diecut_report").rglob("*.py"), *(ROOT / "plugins").rglob("*.py")]
    found = {module_of(file): file for file in files}
    return {
        name: frozenset(with_packages({name, *named(ast.parse(file.read_bytes()))}) & set(found) - {name})
        for name, file in found.items()
    }


def named(tree: ast.Module) -> set[str]:
    """What may be modules among what a file imports."""
    found: set[str] = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and node.module:
            found |= {node.module, *(f"{node.module}.{alias.name}" for alias in node.names)}
        elif isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
    return found


def with_packages(names: set[str]) -> set[str]:
    """Modules with the packages that they lie in, which are imported before them."""
    return names | {name[:at] for name in names for at, letter in enumerate(name) if letter == "."}


def module_of(file: Path) -> str:
    """The name by which a file of the checkout is imported."""
    parts = file.relative_to(ROOT).with_suffix("").parts
    name = ".".join(parts if parts[0] == "diecut_report" else ("diecut_report", *parts))
    return name.removesuffix(".__init__")
