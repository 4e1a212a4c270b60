"""What a check demands of a machine is not lowered to mend it, whichever side of the check it is, unless it is named."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from diecut_report.cli.main import main
from diecut_report.design.inputs import demanded
from tests.configs import DISCOVERY, HEAD, saved

PLUGIN = """
from diecut_report.api import Annotated, Chapter, Check, Inputs, Mechanism, Quantity


class Slide(Inputs):
    crank: Annotated[float, Quantity("r", "mm", "Radius of the crank", gt=0)]
    base: Annotated[float, Quantity("b", "mm", "Base of the slide", gt=0)] = 60
    stroke_needed: Annotated[float, Quantity("H_n", "mm", "Stroke that is needed", gt=0)] = 100
    room: Annotated[float, Quantity("H_r", "mm", "Room of the stroke", gt=0)] = 200


chapter = Chapter("Stroke")
chapter.value("stroke", "H", "mm", "Stroke", lambda crank, base: crank + base)
chapter.value("share", "s", "1", "Share of the stroke that is used", lambda stroke_needed, stroke: stroke_needed / stroke)
checks = (
    Check(id="stroke", check_class="function", title="Stroke", demand="stroke_needed", limit="stroke", unit="mm",
          demand_label="needed", limit_label="stroke", consequence="the sheet does not arrive."),
    Check(id="room", check_class="function", title="Room", demand="stroke", limit="room", unit="mm",
          demand_label="stroke", limit_label="room", consequence="the slide runs against the frame."),
    Check(id="crank", check_class="practice", title="Crank", demand="crank", limit="base", unit="mm",
          demand_label="crank", limit_label="base", severity="warn", consequence="the slide stands badly."),
)

MECHANISM = Mechanism(kind="slide", version="1.0", title="Slide", summary="Slides", inputs=Slide, chapters=(chapter,), checks=checks)
"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    saved(tmp_path, PLUGIN, "slide.py")
    return tmp_path


def changes(folder: Path, keys: str, capfd: pytest.CaptureFixture[str], *more: str) -> dict[str, Any]:
    """What advise changes at a slide with a crank of 60 mm, whose stroke is 120 mm, by the inputs' names."""
    press = saved(folder, HEAD + f"  a: {{kind: slide, crank: 60 mm, base: 60 mm, {keys}}}\n")
    assert main(["advise", str(press), "--plugins", str(folder), "--keep", "a.base", "--format", "json", *more]) == 0
    return {each["name"]: each["after"] for each in json.loads(capfd.readouterr().out)["changes"]}


# with less change of its own, the demand could be brought down to 120 mm, or the room up to it
@pytest.mark.parametrize(("keys", "crank"), [("stroke_needed: 125 mm", "65 mm"), ("room: 115 mm", "55 mm")])
def test_a_side_of_a_check_stays(folder: Path, keys: str, crank: str, capfd: pytest.CaptureFixture[str]) -> None:
    assert changes(folder, keys, capfd) == {"a.crank": crank}


def test_a_demand_that_is_named_is_changed(folder: Path, capfd: pytest.CaptureFixture[str]) -> None:
    press = saved(folder, HEAD + "  a: {kind: slide, crank: 60 mm, base: 60 mm, stroke_needed: 125 mm}\n")
    more = ["--free", "a.stroke_needed", "--format", "json", "--plugins", str(folder)]
    assert main(["advise", str(press), *more]) == 0
    [change] = json.loads(capfd.readouterr().out)["changes"]
    assert (change["name"], change["after"]) == ("a.stroke_needed", "120 mm")


def test_a_size_from_which_other_checks_follow_is_not_a_demand() -> None:
    """The bore and radius of the cylinder, the width of a gear: each is a side of a check, and the strength follows from it."""
    for kind, keys in {"cylinder_sizing": {"bore_radius", "radius"}, "gear_pair": {"face_width"}}.items():
        assert not keys & demanded(DISCOVERY.mechanism(kind))
    assert "min_wall" in demanded(DISCOVERY.mechanism("cylinder_sizing"))
