"""Paths as the operators of a PDF."""

from __future__ import annotations

from typing import Any

from fontTools.pens.basePen import BasePen


class OperatorPen(BasePen):  # type: ignore[misc]  # fontTools has no types
    """Writes a path as PDF operators; quadratic curves come as cubic ones."""

    def __init__(self, glyphs: Any = None) -> None:
        super().__init__(glyphs)
        self.operators: list[str] = []

    def _moveTo(self, pt: tuple[float, float]) -> None:  # noqa: N802
        self.operators.append(f"{_number(*pt)} m")

    def _lineTo(self, pt: tuple[float, float]) -> None:  # noqa: N802
        self.operators.append(f"{_number(*pt)} l")

    def _curveToOne(self, *points: tuple[float, float]) -> None:  # noqa: N802
        self.operators.append(f"{_number(*(n for point in points for n in point))} c")

    def _closePath(self) -> None:  # noqa: N802
        self.operators.append("h")


def _number(*values: float) -> str:
    return " ".join(f"{value:g}" for value in values)
