"""Small studies that are searched: a lever whose moment and pressure pull apart, with a front in closed form."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from diecut_report.cli.main import main
from tests.configs import GOOD, HEAD, saved

WIDTH = 0.01  # m
BASE = HEAD + "  a: {kind: lever, force: 2 kN, arm: 100 mm, width: 10 mm}\n"
FORCE, ARM = "mechanisms.a.force", "mechanisms.a.arm"
VARY = f"  {FORCE}: {{from: 1 kN, to: 3 kN}}\n  {ARM}: {{from: 50 mm, to: 200 mm}}\n"
GOALS = "[{minimise: a.moment}, {minimise: a.pressure}]"


def search_file(
    folder: Path, *, vary: str = VARY, goals: str = GOALS, more: str = "evaluations: 120, population: 30, points: 3", rest: str = "",
    base: str = BASE,
) -> Path:  # fmt: skip
    """The study of a search, beside its base."""
    saved(folder, base)
    given = f"objectives: {goals}, {more}" if goals else more
    text = f"schema_version: 1\nbase: press.yaml\nvary:\n{vary}{rest}optimise: {{{given}}}\n"
    return saved(folder, text, "search.yaml")


def optimised(study: Path | None, folder: Path, *more: str) -> int:
    """Run the command on one process; its exit code."""
    where = ["-o", str(folder)] if "--resume" not in more else []
    named: Sequence[str] = [str(study)] if study else []
    return main(["optimise", *named, *where, "--plugins", str(GOOD), "--jobs", "1", *more])
