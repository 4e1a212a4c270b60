"""A cyclogram of one line of a kind of which the program knows neither way nor torque: its figures, and how its torque is named."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from diecut_report.cli.main import main
from diecut_report.config.loader import load_config
from diecut_report.config.plugins import Discovery
from diecut_report.live.page import Pictures
from diecut_report.live.session import LiveSession
from diecut_report.results.document import document
from diecut_report.results.figure_record import MovedRecord, PolylineRecord
from diecut_report.results.press_run import compute
from tests.configs import HEAD, problems, saved

PLUGIN = """
import numpy as np

from diecut_report.api import POINTS, Annotated, Chapter, Inputs, Mechanism, Quantity


class Feeder(Inputs):
    end: Annotated[float, Quantity("φ_e", "deg", "End of the carrying")] = 120
    rate: Annotated[float, Quantity("n", "1/h", "Turns")] = 6000
    n_points: Annotated[int, POINTS] = 36


chapter = Chapter("Motion")
chapter.value("speed", "ω", "rad/s", "Speed", lambda rate: 2 * np.pi * rate)
chapter.value("start", "φ_0", "deg", "Start of the carrying", lambda end: end / 4)
chapter.abscissa("angle", "φ", "deg", "Angle", 2 * np.pi, speed="speed")
chapter.phase("carrying", "working", "A sheet is carried", "angle", ("start", "end"))
chapter.phase("returning", "moving", "Back without a sheet", "angle", rest_of=("carrying",))
chapter.value("load", "F", "N", "Load", lambda angle: 2 + np.sin(angle))

MECHANISM = Mechanism(kind="small_feeder", version="1.0", title="Feeder", summary="Carries", inputs=Feeder, chapters=(chapter,))
"""
LINES = """\
  feeder: {kind: small_feeder}
  cyc:
    kind: cyclogram
    lines: [{mechanism: feeder}]
    interlocks: [{name: returns_free, phase: feeder.returning, apart_from: feeder.carrying}]
"""


def test_a_line_without_a_known_way_is_reported_without_the_figure_of_ways(tmp_path: Path) -> None:
    saved(tmp_path, PLUGIN, "small_feeder.py")
    more = ["--plugins", str(tmp_path), "-o", str(tmp_path / "out"), "--format", "html", "--quiet"]
    assert main(["report", str(saved(tmp_path, HEAD + LINES)), *more]) == 0
    page = (tmp_path / "out" / "press.html").read_text("utf-8")
    assert "Circular cyclogram" in page and "Displacements and slack" not in page


def test_a_line_across_all_rows_follows_the_angle_and_the_bars_that_it_passes_are_filled(tmp_path: Path) -> None:
    """The feeder carries from 30° to 120°; of the period of 360° a twelfth and a third."""
    saved(tmp_path, PLUGIN, "small_feeder.py")
    config = load_config(saved(tmp_path, HEAD + LINES), Discovery([tmp_path]))
    [figure] = [each for each in document(compute(config, lambda _: None)).mechanisms["cyc"].figures if each.moving]
    shapes, places = figure.moving.shapes, np.array(figure.moving.places)
    [cursor] = [np.array(shape.moves) for shape in shapes if isinstance(shape, MovedRecord)]
    assert cursor[:, 0] == pytest.approx(places / (2 * np.pi) * 8) and cursor[:, 0] == pytest.approx(cursor[:, 2])
    heights = [y for shape in shapes if isinstance(shape, PolylineRecord) for _, y in shape.points]
    assert set(cursor[:, 1]) == {max(heights)} and set(cursor[:, 3]) == {min(heights)}
    filled = [during for shape in shapes if (during := getattr(shape, "during", None))]
    assert np.degrees(filled) == pytest.approx(np.array([[30, 120], [120, 360], [0, 30]]))
    assert [shape.text for shape in shapes if shape.shape == "label"][5:8] == [
        "feeder:",
        "A sheet is carried",
        "Back without a sheet",
    ]


def test_bars_are_dragged_with_the_offset_of_their_line_and_by_as_much(tmp_path: Path) -> None:
    saved(tmp_path, PLUGIN, "small_feeder.py")

    def bars(offset: str) -> list[PolylineRecord]:
        text = HEAD + LINES.replace("{mechanism: feeder}", f"{{mechanism: feeder, offset: {offset}}}")
        [figure] = [
            each
            for each in document(compute(load_config(saved(tmp_path, text), Discovery([tmp_path])), lambda _: None))
            .mechanisms["cyc"]
            .figures
            if each.id == "cyclogram"
        ]
        return [each for each in figure.shapes if isinstance(each, PolylineRecord) and each.grip]

    (before, *_), (after, *_) = bars("0 deg"), bars("45 deg")
    assert before.grip is not None and before.grip.input == "lines.0.offset"
    assert (after.points[0][0] - before.points[0][0]) * before.grip.per_metre == pytest.approx(np.pi / 4)


def test_what_can_be_dragged_is_told_to_the_live_page_alone(tmp_path: Path) -> None:
    """A report carries no grips, and is the page that is made of what it carries."""
    saved(tmp_path, PLUGIN, "small_feeder.py")
    config, plugins = saved(tmp_path, HEAD + LINES), ["--plugins", str(tmp_path)]
    assert main(["report", str(config), *plugins, "-o", str(tmp_path / "out"), "--format", "html", "--quiet"]) == 0
    page = tmp_path / "out" / "press.html"
    assert "data-grip" not in page.read_text("utf-8")
    assert main(["verify", str(page), *plugins]) == 0
    session = LiveSession(config, Discovery([tmp_path]))
    assert session.machine is not None
    assert "lines.0.offset" in str(Pictures().figure(session.machine, "cyc", 0)["moving"]["shapes"])
    assert "lines.0.offset" not in page.read_text("utf-8").partition('id="reader-data"')[2]


def test_the_lines_move_with_the_cyclogram_by_their_offsets_and_rates(tmp_path: Path) -> None:
    """A line of two turns a sheet runs through its period in half of one; an offset that is found is the one that is told."""
    saved(tmp_path, PLUGIN, "small_feeder.py")
    lines = "[{mechanism: feeder, turns_per_sheet: 2, offset: 40 deg}, {mechanism: other, turns_per_sheet: 1/2, offset: auto}]"
    text = LINES.replace("[{mechanism: feeder}]", lines).replace(
        "apart_from: feeder.carrying", "apart_from: other.carrying"
    )
    text = "  other: {kind: small_feeder, end: 20 deg, rate: 3000}\n" + text.replace(
        "small_feeder}", "small_feeder, rate: 12000}"
    )
    config = load_config(saved(tmp_path, HEAD + text), Discovery([tmp_path]))
    told = document(compute(config, lambda _: None)).mechanisms["cyc"]
    [moving] = [figure.moving for figure in told.figures if figure.moving]
    drives = [(each.mechanism, each.offset, each.period) for each in moving.drives]
    found = told.outputs["offset_found"].value
    assert found and drives == [
        ("feeder", pytest.approx(np.radians(40)), pytest.approx(np.pi)),
        ("other", found, pytest.approx(4 * np.pi)),
    ]


def test_a_grip_in_a_results_file_is_refused(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    saved(tmp_path, PLUGIN, "small_feeder.py")
    config, file = saved(tmp_path, HEAD + LINES), tmp_path / "press.json"
    assert main(["calc", str(config), "--plugins", str(tmp_path), "-o", str(file), "--quiet"]) == 0
    data = json.loads(file.read_text("utf-8"))
    [figure] = [each for each in data["mechanisms"]["cyc"]["figures"] if each["id"] == "cyclogram"]
    next(each for each in figure["shapes"] if each["shape"] == "polyline")["grip"] = {"input": "x", "per_metre": 1.0}
    file.write_text(json.dumps(data), "utf-8")
    assert main(["render", str(file), "--plugins", str(tmp_path), "-o", str(tmp_path / "out")]) == 2
    assert "shapes" in (told := capfd.readouterr().err) and "grip" in told


def test_a_cyclogram_of_lines_at_other_rates_than_the_press_stands_still(tmp_path: Path) -> None:
    saved(tmp_path, PLUGIN, "small_feeder.py")
    config = load_config(
        saved(tmp_path, HEAD + LINES.replace("small_feeder}", "small_feeder, rate: 5000}")), Discovery([tmp_path])
    )
    figures = document(compute(config, lambda _: None)).mechanisms["cyc"].figures
    assert "cyclogram" in [each.id for each in figures if each.shapes] and not any(each.moving for each in figures)


def test_a_curve_in_place_of_its_name_is_told(tmp_path: Path) -> None:
    saved(tmp_path, PLUGIN, "small_feeder.py")
    text = HEAD + LINES.replace("{mechanism: feeder}", "{mechanism: feeder, torque_curve: '${feeder.load}'}")
    [told] = problems(tmp_path, text, Discovery([tmp_path]))
    assert told.endswith(
        "${feeder.load} is a curve in N; a text (Name of a torque curve of the line, such as `torque`, if not the "
        "default of its kind) is needed here"
    )
