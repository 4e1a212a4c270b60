"""How much work the program does, in counts, which do not depend on the machine that counts: each number stands with its reason.

A number that has grown is made smaller again, or its limit raised with the reason beside it. Seconds are measured by `benchmarks/`.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path
from types import FrameType
from typing import Any

import numpy as np
import pytest

from diecut_report.config.loader import load_config
from diecut_report.config.plugins import Discovery
from diecut_report.press import Press
from diecut_report.study.definition.base_inputs import find_input
from diecut_report.study.execution.variant_rows import calculate_rows
from tests.configs import EXAMPLE, SMALL, saved
from tests.processes import in_another_process

MODULES, OWN_MODULES = 610, 196
"""Loaded to say that a small press is valid: 585 and 187. ``scipy.integrate`` alone would bring 300."""
CALLS = 475_000
"""Of Python's functions, for 64 variants of the published press: 466 000, of which 4000 look which variants are the same to a mechanism
and 22 000 where it is zero what curves are divided by; they are calculated in blocks, a few for each calculation."""
BOXES = 5_100
"""Laid out for the sheets of the circular knife, a dozen of them: 4839."""


def calls(work: Callable[[], object]) -> int:
    """How many functions of Python are called."""
    count = 0

    def seen(_: FrameType, event: str, __: Any) -> None:
        nonlocal count
        count += event == "call"

    before = sys.getprofile()
    sys.setprofile(seen)
    try:
        work()
    finally:
        sys.setprofile(before)
    return count


def test_few_modules_are_loaded_to_begin(tmp_path: Path) -> None:
    found = in_another_process("validate", saved(tmp_path, SMALL)).imported
    own = {name for name in found if name.partition(".")[0] == "diecut_report"}
    assert len(found) <= MODULES and len(own) <= OWN_MODULES


def test_variants_are_calculated_together() -> None:
    base = load_config(EXAMPLE, Discovery([]))
    speed = find_input(base, "mechanisms.drive.crank_speed")

    def rows(count: int) -> Callable[[], object]:
        return lambda: calculate_rows(base, {speed: np.linspace(4.0, 4.2, count)}, count)

    rows(64)()  # compiles what is compiled once, and fills what is kept
    assert calls(rows(64)) <= CALLS


def test_each_figure_is_drawn_once_and_few_boxes_are_laid_out(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from matplotlib.figure import Figure
    from weasyprint.formatting_structure.boxes import Box

    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))  # where no figure is kept yet
    drawn, boxes = list[Figure](), list[int]()
    save, make = Figure.savefig, Box.__init__
    monkeypatch.setattr(
        Figure, "savefig", lambda self, *given, **more: (drawn.append(self), save(self, *given, **more))[1]
    )
    monkeypatch.setattr(Box, "__init__", lambda self, *given, **more: (boxes.append(1), make(self, *given, **more))[1])
    made = Press.read(EXAMPLE.with_name("circular_knife.yaml"), Discovery([])).calculate()
    made.report(tmp_path, ("html", "pdf"))
    figures = sum(len(each.figures) for each in made.results.mechanisms.values())
    assert len(drawn) == figures > 0 and 0 < len(boxes) <= BOXES
    made.report(tmp_path, ("html",))
    assert len(drawn) == figures, "the same figures are drawn again for the next report"
