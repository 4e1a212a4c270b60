"""One chapter shows its curves at one place, and marks what is taken elsewhere; constants stand with their values."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated, Any

import numpy as np
import pytest

from diecut_report.api import POINTS, Chapter, Inputs, Mechanism, Quantity
from diecut_report.config.loader import load_config
from diecut_report.config.plugins import Discovery
from diecut_report.machine.printing.page import items, section_items
from diecut_report.machine.steps.run import calculate
from diecut_report.mechanism.inputs import flatten
from diecut_report.report.chapters.chapters import chapter as chapter_of
from diecut_report.report.equations import Equations, Typesetter
from diecut_report.report.mathematics import Linear
from diecut_report.report.text import Catalogue
from diecut_report.results.mechanism import mechanism_results
from diecut_report.results.press_run import compute
from tests.configs import MECHANISMS
from tests.machines import UNBALANCED, drive


def chapters(calc: Any) -> dict[str, dict[str, Any]]:
    return {chapter["title"]: chapter for chapter in section_items(calc)}


def places(chapter: dict[str, Any]) -> set[str]:
    """Where its formulas are shown that are not marked as shown elsewhere."""
    shown = [i for i in chapter["items"] if i["type"] in ("formula", "choice") and i.get("at")]
    return {i["at"]["text"] for i in shown if not i.get("note", "").startswith("Shown at ")}


@pytest.fixture(scope="module")
def run() -> Any:
    return compute(load_config(MECHANISMS, Discovery()), lambda _: None)


def test_every_chapter_of_an_example_shows_one_place_and_says_which(run: Any) -> None:
    seen = 0
    for calc in run.calculations.values():
        for chapter in section_items(calc):
            assert places(chapter) <= {at["text"] for at in chapter.get("shown", ())}
            assert len({at["symbol"] for at in chapter.get("shown", ())}) == len(chapter.get("shown", ()))
            seen += "shown" in chapter
    assert seen > 10


def test_the_moments_of_the_drive_add_up_where_they_are_shown() -> None:
    """M_Σ = M_in + M_t·s: all of them at the crank angle of the greatest torque, not two of them in the middle of a stroke."""
    calc = drive(**UNBALANCED)
    chapter = chapters(calc)["Moments on the cylinder"]
    (place,) = chapter["shown"]
    assert float(place["text"]) == pytest.approx(np.degrees(calc["crank_torque_peak_at"][0, 0]), rel=1e-5)
    assert places(chapter) == {place["text"]}
    direction = next(item for item in chapter["items"] if item["id"] == "direction")
    speed = calc.sample("cylinder_speed", calc["crank_torque_peak_at"], calc.middle["crank_torque_peak_at"])[0, 0]
    assert f"{speed:.2f}" == direction["substituted"][2][1]


def test_what_is_taken_in_the_middle_of_a_piece_is_marked_with_its_place(run: Any) -> None:
    calc = run.calculations["feeder"]
    assert items(calc, calc.steps["law_middle"]) == []  # which serves how numbers are found
    [item] = items(calc, replace(calc.steps["law_middle"], printed=True))
    assert Linear()(item["equation"]) == "k(φ = 260°)"
    assert item["note"].startswith("Shown at φ = 260°, in the middle of its smooth piece")


def test_constants_stand_with_their_value_and_unit_among_the_numbers() -> None:
    items = [item for chapter in section_items(drive(**UNBALANCED)) for item in chapter["items"]]
    moment = next(item for item in items if item["id"] == "inertia_moment")
    assert "g" in Linear()(moment["equation"]) and "9.80665 m/s²" in Linear()(moment["substituted"])


def test_the_report_says_at_the_chapters_head_where_curves_are_shown() -> None:
    results = mechanism_results(drive(**UNBALANCED), {})
    part = chapter_of("A", "drive", results, Equations(Catalogue("en"), Typesetter().measure), Catalogue("en"))
    said = [section.shown for section in part.sections if section.shown]
    assert said and all(words.startswith("Curves are shown at φ = ") and words.endswith("°.") for words in said)


class Turned(Inputs):
    """A crank that is shown at an angle of its own."""

    shown: Annotated[float, Quantity("φ_0", "deg", "Where it is shown", ge=0)] = 30
    radius: Annotated[float, Quantity("r", "mm", "Radius", gt=0)] = 100
    n_points: Annotated[int, POINTS] = 36


@pytest.mark.parametrize(("shown", "printed"), [(30, "30"), (390, "30")])
def test_curves_are_shown_at_any_number_that_an_abscissa_names(shown: float, printed: str) -> None:
    motion = Chapter("Motion")
    motion.abscissa("angle", "φ", "deg", "Angle", 2 * np.pi, shown_at="shown")
    motion.value("height", "y", "mm", "Height", lambda radius, angle: radius * np.sin(angle))
    crank = Mechanism(kind="crank", version="1", title="Crank", summary="", inputs=Turned, chapters=(motion,))
    calc = calculate(crank, flatten(Turned.model_validate({"shown": shown})))
    assert places(chapters(calc)["Motion"]) == {printed}
