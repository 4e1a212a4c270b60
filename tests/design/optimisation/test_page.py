"""The page of a search: on one it says what was found, in the language of the project, and asks for nothing from outside."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace
from typing import Any

import matplotlib.figure
import numpy as np
import pytest

from diecut_report.design.optimisation.page import _pair
from tests.design.optimisation.searches import BASE, optimised, search_file


@pytest.mark.nightly
def test_the_page_tells_front_bounds_and_proof(tmp_path: Path) -> None:
    assert optimised(search_file(tmp_path), tmp_path / "1" / "out", "--quiet") == 0
    assert optimised(search_file(tmp_path), tmp_path / "2" / "out", "--quiet") == 0
    page = (tmp_path / "1" / "out" / "optimisation.html").read_text("utf-8")
    for words in (
        "The best machines",
        "Position within the ranges",
        "widen the range",
        "all 3 agree",
        "suggestion",
        "<svg",
    ):
        assert words in page
    assert "http://" not in page.split("</style>")[1].replace("http://www.w3.org", "") and "<script" not in page
    for name in ("optimisation.html", "optimisation.pdf"):
        assert (tmp_path / "1" / "out" / name).read_bytes() == (tmp_path / "2" / "out" / name).read_bytes()
    assert (tmp_path / "1" / "out" / "optimisation.pdf").read_bytes().startswith(b"%PDF")


@pytest.mark.nightly
def test_a_page_without_a_front_tells_why(tmp_path: Path) -> None:
    study = search_file(
        tmp_path,
        base=BASE.replace("width: 10 mm", "width: 10 mm, allowable_moment: 40 N*m"),
        goals="[{minimise: a.moment}]",
    )
    assert optimised(study, tmp_path / "out", "--quiet", "--language", "uk") == 1
    page = (tmp_path / "out" / "optimisation.html").read_text("utf-8")
    assert "Жодна машина не допустима." in page and 'lang="uk"' in page


def test_the_present_machine_lies_in_the_plot_and_is_called_so() -> None:
    goals = [SimpleNamespace(column=SimpleNamespace(display="mm"), is_less=True)] * 2
    found: Any = SimpleNamespace(
        objectives=goals, values=np.array([[0.001, 0.002], [0.002, 0.001]]), suggested=None, present=0
    )
    costs = np.array([[0.009, 0.009], [0.001, 0.002], [0.002, 0.001]])
    there: Any = SimpleNamespace(costs=costs, violations=np.array([1.0, 0.0, 0.0]))
    axes = matplotlib.figure.Figure().add_subplot()
    _pair(axes, found, there, (0, 1), 9.0)
    assert axes.get_xlim()[1] > 9 and axes.get_ylim()[1] > 9
    assert "present machine" in axes.get_legend_handles_labels()[1]
