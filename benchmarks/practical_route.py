"""The practical route of setting a report: mathra's SVG and matplotlib's SVG as ``<img>``, WeasyPrint as it is.

python benchmarks/practical_route.py RESULTS.json OUT.pdf
"""

from __future__ import annotations

import base64
import json
import sys
from pathlib import Path

from markupsafe import Markup
from weasyprint import HTML

from diecut_report.report.context import Material
from diecut_report.report.equations import Equation
from diecut_report.report.html import filled


def image(svg: str, title: str, depth: float | None = None) -> Markup:
    """An SVG as an image with embedded data."""
    data = base64.b64encode(svg.encode()).decode()
    style = "" if depth is None else f"vertical-align:{depth}em"
    return Markup('<img src="data:image/svg+xml;base64,{}" alt="{}" style="{}">').format(data, title, style)


class Practical:
    """Formulas and figures as images."""

    def __init__(self, material: Material) -> None:
        self.material = material

    def math(self, equation: Equation, *, display: bool = True) -> Markup:
        """A formula."""
        outline = self.material.typesetter.outline(equation.latex, display=display)
        return image(outline.svg, equation.text, None if display else outline.depth)

    def figure(self, number: str, title: str) -> Markup:
        """A figure."""
        return image(self.material.figures[number].text, title)


def main(results: Path, target: Path) -> None:
    """Set the results as PDF."""
    material = Material(json.loads(results.read_text(encoding="utf-8")))
    source = filled(material, Practical(material), "print")
    HTML(string=source).write_pdf(target)


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]))
