"""Figures on paper: outlines from their SVG that look as the SVG does, with words that are found by search."""

from __future__ import annotations

import base64
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from diecut_report.report.figures.style import Svg
from diecut_report.report.pages.page_engine import HTML
from diecut_report.report.pages.pdf import Paper
from diecut_report.report.pages.pdf_figures import FigurePicture, NotDrawn
from diecut_report.report.rendering import Rendering
from tests.report.made_results import typed

HEAD = '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" viewBox="0 0 100 50">'
PAGE = '<html lang="en"><style>@page {{ size: 200mm 120mm; margin: 5mm }} img {{ display: block }}</style><img alt="" src="{}">'


def _svg(body: str) -> str:
    return f"{HEAD}{body}</svg>"


def _drawn(tmp_path: Path, source: str, cache: dict[str, Any]) -> Any:
    """The sheet with an image as an array of greys."""
    (tmp_path / "x.pdf").write_bytes(HTML(string=PAGE.format(source)).write_pdf(cache=cache))
    subprocess.run(
        ["pdftoppm", "-r", "60", "-gray", "-singlefile", str(tmp_path / "x.pdf"), str(tmp_path / "x")], check=True
    )
    return np.asarray(Image.open(tmp_path / "x.pgm"), dtype=float)


def _chosen(rendering: Rendering) -> list[Svg]:
    """A plot with a legend, marks and shades, and a drawing with hatching, dimensions and symbols."""
    kinds = {number: figure.type for part in rendering.document.chapters for number, figure in part.figures}
    figures = rendering.figures
    return [
        next(figures[number] for number in figures if kinds[number] == kind) for kind in ("plot", "drawing", "polar")
    ]


def test_the_outlines_look_as_the_page_engine_draws_the_svg(rendering: Rendering, tmp_path: Path) -> None:
    for figure in _chosen(rendering):
        ours = _drawn(tmp_path, "data:formula,0", {"data:formula,0": FigurePicture(*figure)})
        data = base64.b64encode(figure.text.encode()).decode()
        theirs = _drawn(tmp_path, f"data:image/svg+xml;base64,{data}", {})
        ink = np.abs(theirs - 255).sum()
        assert ink > 0 and abs(np.abs(ours - 255).sum() - ink) < 0.12 * ink
        near = np.abs(ours - theirs) < 100
        assert near.mean() > 0.985


def test_words_of_a_figure_are_told() -> None:
    style = "font-size: 8px; font-family: 'Report Sans'; text-anchor: middle; fill: #1b232c"
    parts = f'<tspan x="0 4" y="0" style="{style}">ab</tspan><tspan x="8" y="0" style="{style}">c</tspan>'
    picture = FigurePicture(
        _svg(
            f'<text style="{style}" x="5" y="9" transform="rotate(-90 5 9)">crank pin</text><g><text>\n{parts}</text></g>'
        ),
        100,
        50,
    )
    assert picture.texts == ["crank pin", "abc"]


@pytest.mark.parametrize("body", [
    '<path d="M 0 0 L 9 9 z" style="fill: url(#h1)"/>', '<path d="M 0 0 Q 1 1 2 2 " style="fill: #000000"/>', '<circle r="3"/>',
    '<path d="M 0 0 L 9 9 " style="fill: red"/>', '<g transform="skewX(3)"/>',
    '<text style="font-size: 8px; font-family: \'Report Sans\'" x="0" y="0">\U0001f600</text>',
])  # fmt: skip
def test_what_cannot_be_drawn_is_left_to_the_page_engine(body: str, plain: dict[str, Any]) -> None:
    with pytest.raises(NotDrawn):
        FigurePicture(_svg(body), 100, 50)
    material = Rendering(typed(plain))
    material.__dict__["figures"] = {"A.1": Svg(_svg(body), 100, 50)}
    assert 'src="data:image/svg+xml;base64,' in Paper(material).figure("A.1", "Title")


def test_opacity_is_set_and_taken_back() -> None:
    picture = FigurePicture(_svg('<path d="M 0 0 L 9 9 " style="fill: #ffffff; opacity: 0.8"/>'), 100, 50)
    assert picture.pieces[0] == "q" and picture.pieces[1] == 0.8 and picture.pieces[-1] == "Q"
