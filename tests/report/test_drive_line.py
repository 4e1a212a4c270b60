"""The drawing of the drive line: to scale, each part once, hatched where nothing rates it, and leading to its calculation."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cache
from itertools import combinations, pairwise
from types import SimpleNamespace
from typing import Any, cast
from xml.etree import ElementTree

import numpy as np
import pytest
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from diecut_report.report.chapters.drive_line import TONES, VIEWS, DriveLineFigure, drive_line_figures
from diecut_report.report.context import Material
from diecut_report.report.figures.by_type import DRAW, render
from diecut_report.report.figures.drive_line import FILLS, FRONT, WIDTH
from diecut_report.report.figures.style import SizesSize, overlap, styled, text_size
from diecut_report.report.pages import html
from diecut_report.report.pages.pdf_figures import FigurePicture
from diecut_report.report.scope import scope
from diecut_report.report.text import Catalogue
from diecut_report.results.drive_line import drive_line, unrated
from diecut_report.results.mechanism_record import CheckRecord
from diecut_report.results.model import (
    DriveLineRecord,
    JoinRecord,
    MachineShaftRecord,
    PlacedPartRecord,
    RatingRecord,
    ResultsRecord,
)
from diecut_report.results.press_run import Run
from diecut_report.results.results_file import encoded, results_text
from diecut_report.text.phrases import Phrase
from tests.config.parts.machines import whole
from tests.report.made_results import check
from tools.site.api_examples import example_of, run

HOSTILE = "<script>alert(1)</script>&\"'$x_1$"
PORTS = {
    "drive": {"crank_length": 0.1, "rocker_ratio": 2.05},
    "cross": {"crank_radius": 0.12, "wheel_radius": 0.2078, "slots": 6},
}


def judged(id: str, status: str, ratio: float | None = None, of: str = "strength") -> CheckRecord:
    return CheckRecord.model_validate(check(id) | {"status": status, "utilisation": ratio, "class": of})


def whole_line(*found: tuple[str, CheckRecord]) -> DriveLineRecord:
    """The drive line of the example, whose calculations have these checks alone."""
    config = whole()
    calculations = {
        name: SimpleNamespace(mechanism=cast(Any, config.instances[name]).mechanism, values={}, inputs=numbers)
        for name, numbers in PORTS.items()
    }
    checks: dict[str, list[CheckRecord]] = {}
    for name, each in found:
        checks.setdefault(name, []).append(each)
    made = drive_line(cast(Run, SimpleNamespace(config=config, calculations=calculations)), checks)
    assert made is not None
    return made


def views(line: DriveLineRecord, checks: Any = None, language: str = "en") -> list[DriveLineFigure]:
    return drive_line_figures(line, checks or {}, {name: f"#{name}" for name in checks or ()}, Catalogue(language))


def drawn(figure: DriveLineFigure, size: SizesSize = SizesSize.LARGE) -> Figure:
    with styled("x"):
        return DRAW[figure.type](figure, {}, figure.words, size)


def outlines(figure: DriveLineFigure, sheet: Figure) -> dict[tuple[str, str], Any]:
    """The corners of each part on the sheet, in points: left, bottom, right, top."""
    keys, found = list(figure.looks), {}
    for artist in sheet.axes[0].get_children():
        url = artist.get_url()
        if url is not None:
            key = keys[int(url.removeprefix("part-"))]
            assert key not in found, f"{key} is drawn twice"
            is_line = isinstance(artist, Line2D)
            points = cast(Any, artist).get_xydata() if is_line else cast(Any, artist).get_path().vertices
            found[key] = np.array([*points.min(axis=0), *points.max(axis=0)])
    return found


def middle(box: Any) -> Any:
    return (box[:2] + box[2:]) / 2


def test_wheels_and_shafts_stand_to_scale_where_the_frame_has_their_axes() -> None:
    line = whole_line()
    front = views(line)[0]
    found = outlines(front, drawn(front))
    axes = {shaft.name: np.array(shaft.axis) for shaft in line.shafts}
    scale = np.hypot(*(middle(found["shaft", "far"]) - middle(found["shaft", "main"]))) / np.hypot(
        *(axes["far"] - axes["main"])
    )
    at = {name: middle(found["shaft", "main"]) + (axis - axes["main"]) * scale for name, axis in axes.items()}
    for name in axes:
        assert middle(found["shaft", name]) == pytest.approx(at[name], abs=0.05)
    for (kind, name), radius in {
        ("gear", "main.wheel"): 0.174, ("gear", "flywheel.pinion"): 0.036, ("gear", "crank.wheel"): 0.12, ("pulley", "motor.small"): 0.0625,
        ("pulley", "flywheel.large"): 0.1875, ("clutch", "crank.clutch"): 0.18, ("sprocket", "far.left"): 0.01905 / 2 / np.sin(np.pi / 30),
    }.items():  # fmt: skip
        box = found[kind, name]
        assert (box[2] - box[0]) / 2 == pytest.approx(radius * scale, abs=0.2), name
        assert middle(box) == pytest.approx(at[name.partition(".")[0]], abs=0.2)
    pitch = found["gear", "rocker.sector"]  # its teeth reach down to the pinion's pitch circle
    assert pitch[1] == pytest.approx(at["pinion"][1] + 0.07 * scale, abs=0.2)
    assert middle(found["pin", "crank.disc.pin"]) == pytest.approx(at["crank"] + [0.1 * scale, 0], abs=0.1)
    assert middle(found["pin", "rocker.arm.pin"]) == pytest.approx(at["rocker"] - [0.205 * scale, 0], abs=0.1)


def test_a_belt_touches_both_of_its_pulleys_and_a_chain_both_sprockets() -> None:
    front = views(whole_line())[0]
    found = outlines(front, drawn(front))
    for band, one, other in (
        (("belt", "motor"), ("pulley", "motor.small"), ("pulley", "flywheel.large")),
        (("chain", "grippers"), ("sprocket", "conveyor.left"), ("sprocket", "far.left")),
    ):
        both = np.array([found[one], found[other]])
        assert found[band] == pytest.approx([*both[:, :2].min(axis=0), *both[:, 2:].max(axis=0)], abs=0.3)


def test_parts_stand_to_scale_along_the_axes() -> None:
    line = whole_line()
    side = views(line)[1]
    found = outlines(side, drawn(side))
    shafts = {shaft.name: shaft for shaft in line.shafts}
    far = found["shaft", "far"]
    scale = (far[2] - far[0]) / 0.7
    left = far[0] - shafts["far"].left * scale
    for shaft in line.shafts:
        for part in shaft.parts:
            if part.end > part.start:
                box = found[part.kind, part.name]
                ends = (shaft.left + part.start, shaft.left + part.end)
                assert (box[[0, 2]] - left) / scale == pytest.approx(ends, abs=2e-4), part.name
        for section in shaft.sections:
            assert found["shaft", shaft.name][3] - found["shaft", shaft.name][1] >= section.diameter * scale - 0.01
    bearing = found["bearing", "crank.b"]
    assert bearing[3] - bearing[1] == pytest.approx(0.11 * scale, abs=0.01)  # 6212
    gears = [middle(found["gear", name])[0] for name in ("rocker.sector", "pinion.pinion")]
    assert gears[0] == pytest.approx(gears[1], abs=0.01)  # which mesh in one plane


def of_the_file() -> Iterator[tuple[str, str]]:
    """The shafts, their parts, and what these hold, as the file of the example names them."""
    for shaft, block in whole().parts.reader.data["shafts"].items():
        yield "shaft", shaft
        for part in block["parts"]:
            kind, name = next(iter(part.items()))
            yield kind, f"{shaft}.{name}"
            if "key" in part:
                yield "key", f"{shaft}.{name}.key"
            if "pin" in part:
                yield "pin", f"{shaft}.{name}.pin"
                yield "pin_bearing", f"{shaft}.{name}.pin.bearing"


def test_each_part_of_the_model_is_drawn_once() -> None:
    front, side = views(whole_line())
    parts = [(part.kind, part.name) for shaft in side.line.shafts for part in shaft.parts]
    shafts = [("shaft", shaft.name) for shaft in side.line.shafts]
    assert {*parts, *shafts} == {*of_the_file()} and len(parts) + len(shafts) == len([*of_the_file()])
    assert outlines(side, drawn(side)).keys() == {*parts, *shafts}
    bodies = {
        key for key in parts if key[0] not in ("bearing", "key", "pin_bearing", "flywheel")
    }  # a rim whose radius nobody gives
    assert outlines(front, drawn(front)).keys() == {
        *bodies,
        *shafts,
        ("belt", "motor"),
        ("chain", "cylinder"),
        ("chain", "grippers"),
    }


def hatched(sheet: Figure) -> int:
    """How many parts have strokes over them."""
    return sum(isinstance(each, Line2D) and each.get_linewidth() == 0.35 for each in sheet.axes[0].get_children())


def test_what_nothing_rates_is_hatched_and_what_is_rated_is_not() -> None:
    rated = whole_line(*((name, judged("x", "pass", 0.3)) for name in whole().parts.calculations))
    legend = 1
    for line in (whole_line(), rated):
        side = views(line)[1]
        left = [
            key
            for key, look in side.looks.items()
            if look.state == "not_rated" and key[0] not in ("mesh", "chain", "belt")
        ]
        assert hatched(drawn(side)) - legend == len(left)
    bodies = {name for (kind, name), look in side.looks.items() if look.state == "not_rated"}
    assert bodies >= {"main.disc", "crank.clutch", "crank.disc", "rocker.arm", "geneva.cross"}  # no method rates a body
    assert {
        look.state for key, look in side.looks.items() if key in (("shaft", "motor"), ("flywheel", "flywheel.rim"))
    } == {"none"}


def test_a_part_has_the_tone_of_its_own_governing_check() -> None:
    own = {
        "shafts_crank": [judged("fatigue", "pass", 0.55), judged("notes", "warn", 3.0, "practice"), judged("own", "fail", 9.0, "numerical")],
        "shafts_crank_bearings": [
            judged("a_life", "fail", 1.7).with_(title=phrase_of("a")), judged("b_life", "pass", 0.2).with_(title=phrase_of("b")),
            judged("disc_pin_life", "warn", 0.4).with_(title=phrase_of("disc_pin")),
        ],
        "train": [judged("vbelt_slip", "pass", 0.81), judged("flywheel_rim_speed", "fail", 2.0)],
        "meshes_crank_drive": [judged("pitting", "fail", None)],
    }  # fmt: skip
    line = whole_line(*((name, each) for name, checks in own.items() for each in checks))
    looks = views(line, own)[1].looks
    told = {
        ("shaft", "crank"): "middle", ("bearing", "crank.a"): "fail", ("bearing", "crank.b"): "low",
        ("pin_bearing", "crank.disc.pin.bearing"): "high",
        ("belt", "motor"): "high", ("pulley", "flywheel.large"): "high", ("gear", "main.pinion"): "fail", ("gear", "crank.wheel"): "fail",
        ("key", "crank.disc.key"): "", ("shaft", "main"): "",
    }  # fmt: skip
    assert {key: looks[key].tone for key in told} == told
    assert (
        looks["bearing", "crank.a"].text.startswith("crank.a: ")
        and "170.0\N{NO-BREAK SPACE}%" in looks["bearing", "crank.a"].text
    )


def test_what_is_hatched_is_what_the_results_leave_open() -> None:
    parts = whole().parts
    assert parts is not None
    left = {cast(Phrase, each.why).values["part"] for each in unrated(parts, "train", {}, "")}
    looks = views(whole_line())[1].looks
    joined = ("gear", "pulley", "sprocket")  # whose mesh, belt or chain is what is open
    hatched_ones = {name for (kind, name), look in looks.items() if look.state == "not_rated" and kind not in joined}
    assert hatched_ones == left


def phrase_of(name: str) -> Phrase:
    return Phrase("{title}: {name}", title="Life", name=name)


def test_a_print_without_colours_tells_the_tones() -> None:
    grey = [np.dot(to_rgb(FILLS[tone]), (0.2126, 0.7152, 0.0722)) for tone in TONES]
    assert all(one - other > 0.08 for one, other in pairwise(grey))


@pytest.mark.parametrize("size", FRONT)
@pytest.mark.parametrize("language", ["en", "uk"])
def test_texts_cover_no_other_and_stay_on_a_page(size: SizesSize, language: str) -> None:
    for figure in views(whole_line(), language=language):
        sheet = drawn(figure, size)
        wide, high = sheet.get_size_inches() * 72
        assert wide <= WIDTH + 8 and high <= 480
        boxes = []
        for text in (each for each in sheet.axes[0].texts if each.get_alpha() != 0):
            size_of, (x, y) = text_size(text.get_text(), text.get_fontsize()), text.get_position()
            left = x - {"left": 0.0, "center": 0.5, "right": 1.0}[text.get_ha()] * size_of[0]
            boxes.append((left, y - 0.35 * size_of[1], left + size_of[0], y + 0.35 * size_of[1]))
        assert [overlap(one, other) for one, other in combinations(boxes, 2) if overlap(one, other) > 0.5] == []


def test_names_stand_in_the_drawing_as_text() -> None:
    none = RatingRecord(state="not_rated")
    part = PlacedPartRecord(
        name=f"{HOSTILE}.{HOSTILE}", kind="gear", start=0.0, end=0.05, seat=0.04, radius=0.06, rating=none
    )
    shaft = MachineShaftRecord(name=HOSTILE, axis=[0.0, 0.0], left=None, sections=[], parts=[part], rating=none)
    for figure in views(DriveLineRecord(shafts=[shaft], joins=[])):
        svg = render(figure, {}, figure.words, "1.1")
        root = ElementTree.fromstring(svg.text)
        assert [each.tag for each in root.iter() if "script" in each.tag] == []
        assert HOSTILE in "".join(
            text for each in root.iter() if each.tag.endswith("title") for text in each.itertext()
        )
        assert FigurePicture(*svg).pieces


@pytest.mark.parametrize("axis", [None, [1e9, -1e9], [0.0, 0.0]])
def test_odd_places_are_drawn_too(axis: list[float] | None) -> None:
    none = RatingRecord(state="none")
    shafts = [MachineShaftRecord(name=name, axis=axis, left=None, sections=[], parts=[], rating=none) for name in "ab"]
    found = views(DriveLineRecord(shafts=shafts, joins=[]))
    assert [each.type for each in found] == [*VIEWS[axis is None :]]
    assert all(render(each, {}, each.words, "1").width > 0 for each in found)


@pytest.mark.parametrize(
    "odd",
    [{}, {"end": -1e6, "seat": -1.0}, {"start": 0.1, "radius": 1e6, "width": -2.0}, {"slots": -3}, {"toothed": -1.0}],
)
def test_what_nobody_could_build_is_drawn_too(odd: dict[str, Any]) -> None:
    none, numbers = RatingRecord(state="not_rated"), {"start": 0.0, "end": 0.0, "seat": 0.0} | odd
    parts = [
        PlacedPartRecord.model_validate({"name": "a.b", "kind": kind, "rating": none} | numbers)
        for kind in ("gear", "crank", "pin", "bearing", "key", "geneva_wheel")
    ]
    shaft = MachineShaftRecord(name="a", axis=[0.0, 0.0], left=None, sections=[], parts=parts, rating=none)
    joins = [
        JoinRecord(name="c", kind=kind, drivers=["a.b"], driven=["gone.b"], rating=none)
        for kind in ("mesh", "chain", "belt")
    ]
    assert all(
        render(each, {}, each.words, "1").width > 0 for each in views(DriveLineRecord(shafts=[shaft], joins=joins))
    )


# A small machine, calculated: the report of its results.


@cache
def small() -> ResultsRecord:
    example = example_of("Port")
    assert example is not None
    made = run(example)
    assert made is not None
    return made


@pytest.mark.nightly
def test_each_part_leads_to_its_chapter_and_the_report_of_the_results_file_draws_the_same() -> None:
    results = small()
    page = html.page(Material(results))
    shown = re.findall(r'<svg[^>]*class="drive-line".*?</svg>', page, re.DOTALL)
    assert len(shown) == len(VIEWS)
    links = [each for svg in shown for each in re.findall(r'<a href="#([^"]+)"', svg)]
    assert links and {*links} <= {*re.findall(r'id="([^"]+)"', page)}
    rated = [each for shaft in results.drive_line.shafts for each in (shaft, *shaft.parts) if each.rating.calculation]
    assert len(re.findall("<a href", shown[1])) == len(rated)
    again = ResultsRecord.model_validate_json(encoded(results_text(results)))
    assert html.page(Material(again)) == page


@pytest.mark.nightly
def test_a_machine_of_parts_is_drawn_in_word_and_pdf_too() -> None:
    material = Material(small())
    assert [number for number, _ in material.document.drive_line] == ["1.1", "1.2"]
    assert all(material.rasters[number].content[1:4] == b"PNG" for number in ("1.1", "1.2"))
    assert all(FigurePicture(*material.figures[number]).pieces for number in ("1.1", "1.2"))


@pytest.mark.nightly
def test_a_report_of_some_mechanisms_draws_no_machine() -> None:
    results = small()
    part = results.with_(report=results.report.with_(only=["stamp"]))
    assert scope(part).results.drive_line is None and Material(part).document.drive_line == []
