"""Typeset formulas of one report: each LaTeX once as an outline picture (mathra) and once as MathML (math-core)."""

from __future__ import annotations

import re
from typing import NamedTuple

import mathra
from math_core import LatexToMathML

_SIZE = re.compile(r'viewBox="([-\d.]+) ([-\d.]+) ([-\d.]+) ([-\d.]+)".*?vertical-align: ([-\d.]+)em', re.DOTALL)
SHALLOW = 2000  # letters, in which no formula is nested too deep


class Outline(NamedTuple):
    """A formula as outlines: SVG, its viewbox (1000 units an em), and how far it reaches below the line, em (negative)."""

    svg: str
    left: float
    top: float
    width: float
    height: float
    depth: float


class Typesetter:
    """Keeps what it has set, so that a formula is converted once in a report."""

    def __init__(self) -> None:
        self._outlines: dict[tuple[str, bool], Outline] = {}
        self._mathml: dict[tuple[str, bool], str] = {}
        self._core = LatexToMathML()

    def outline(self, latex: str, *, display: bool = True) -> Outline:
        """The formula as outlines; invalid LaTeX raises ValueError."""
        key = latex, display
        if key not in self._outlines:
            svg = mathra.tex_to_svg(latex, display=display, strict=True)
            found = _SIZE.search(svg)
            if found is None:
                raise ValueError(f"a typeset formula without a size: {latex}")
            self._outlines[key] = Outline(svg, *map(float, found.groups()))
        return self._outlines[key]

    def measure(self, latex: str) -> float:
        """The width of a formula in em."""
        return self.outline(latex).width / 1000

    def mathml(self, latex: str, *, display: bool = True) -> str:
        """The formula as MathML."""
        key = latex, display
        if key not in self._mathml:
            if len(latex) > SHALLOW:
                self.outline(
                    latex, display=display
                )  # refuses what is nested so deep that the other library would overrun its stack
            self._mathml[key] = self._core.convert_with_local_state(latex, displaystyle=display)
        return self._mathml[key]
