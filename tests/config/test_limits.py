"""Caps on what a config holds: each is told with its number, and none costs time or memory before it is."""

from __future__ import annotations

import re
import time
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

import pytest

from diecut_report import errors
from diecut_report.config.loader import load_config
from diecut_report.errors import UserError
from diecut_report.press import Press
from diecut_report.quantities.units import UnitError, normalised, parse_quantity
from diecut_report.results.document import document
from diecut_report.results.press_run import compute
from tests.configs import DISCOVERY, HEAD, LEVER, problems, saved

PAGE = Path(__file__).parents[2] / "docs" / "limits.md"
CAM = "{kind: cam_gear_transport, dwell_angle: 160 deg, sector_dwell_sweep: 60 deg, sector_stop_sweep: 20 deg, center_distance: 300 mm, n_points: 36}"
GENEVA = "{kind: geneva_transport, slots: 6, center_distance: 200 mm, roller_radius: 10 mm, n_points: 36}"


def seconds(function: Callable[..., object], *given: object) -> float:
    """How long a call takes that may end in a unit error."""
    start = time.perf_counter()
    with suppress(UnitError):
        function(*given)
    return time.perf_counter() - start


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ("title: Test", f"title: {'M' * 501}", "2:18: project.title: has 501 characters; at most 500 are allowed"),
        ("title: Test", f"title: T, {'M' * 501}: 1", "is a key of 501 characters; at most 500 are allowed"),
        ("name: P", f"name: {'M' * 20_000}", "press.name: has 20000 characters; at most 500 are allowed"),
        ("title: Test", f"title: T, revisions: [{'{revision: A}, ' * 201}]", "project.revisions: has 201 entries; at most 200 are allowed"),
        ("force: 2 kN", f"force: 2 kN, parts: [{'{length: 1 m}, ' * 201}]", "mechanisms.a.parts: has 201 entries; at most 200"),
        ("force: 2 kN", f"force: 2 kN, load: [{'1, ' * 10_001}]", "mechanisms.a.load: has 10001 entries; at most 10000"),
        ("force: 2 kN", f"force: '2{' ' * 300}kN'", "mechanisms.a.force: '2{blanks}…' has 303 characters; a number with a unit has at most 200"),
    ],
)  # fmt: skip
def test_too_much_is_told_with_the_cap(old: str, new: str, told: str, tmp_path: Path) -> None:
    assert old in LEVER
    found = problems(tmp_path, LEVER.replace(old, new, 1))
    assert len(found) == 1 and told.replace("{blanks}", " " * 58) in found[0]
    assert len(found[0]) < 400


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("title: Test", f"title: {'M' * 500}"),
        ("title: Test", f"title: T, revisions: [{'{revision: A}, ' * 200}]"),
        ("force: 2 kN", f"force: 2 kN, load: [{'1, ' * 10_000}]"),
        ("force: 2 kN", f"force: '2{' ' * 190}kN'"),
    ],
)
def test_as_much_as_the_cap_is_taken(old: str, new: str, tmp_path: Path) -> None:
    load_config(saved(tmp_path, LEVER.replace(old, new, 1)), DISCOVERY)


def test_few_of_many_problems_are_told(tmp_path: Path) -> None:
    many = "".join(f"  m{index}: {{kind: {'k' * 600}}}\n" for index in range(150))
    assert len(problems(tmp_path, HEAD + many)) == 20


def test_mechanisms_are_counted(tmp_path: Path) -> None:
    many = "".join(f"  m{index}: {{kind: lever, force: 2 kN}}\n" for index in range(201))
    assert problems(tmp_path, HEAD + many) == [
        "5:3: mechanisms: has 201 mechanisms; at most 200 are allowed. Split the configuration."
    ]


def test_a_pdf_of_many_mechanisms_is_refused_before_it_is_calculated(tmp_path: Path) -> None:
    many = "".join(f"  m{index}: {{kind: lever, force: 2 kN}}\n" for index in range(81))
    path = saved(tmp_path, HEAD + many)
    template = r"81 mechanisms; the PDF of a report has at most 80\. Leave the PDF out with --format html,json"
    with pytest.raises(UserError, match=template):
        Press.read(path, DISCOVERY).require_reportable(("html", "pdf"))


def test_comparisons_beyond_the_cap_are_named_with_the_way_to_them(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert errors.MAX_COMPARISONS == 12
    for module in ("press_run", "document"):
        monkeypatch.setattr(f"diecut_report.results.{module}.MAX_COMPARISONS", 2)  # quicker
    feeders = "".join(f"  c{index}: {CAM}\n  g{index}: {GENEVA}\n" for index in range(2))
    config = load_config(saved(tmp_path, HEAD + feeders), DISCOVERY)
    results = document(compute(config, lambda _: None))
    assert len(results.comparisons) == 2
    assert results.comparisons_left_out.names == [f"transport_comparison-c1-g{index}" for index in range(2)]
    told = results.comparisons_left_out.message
    assert told.startswith("2 comparisons are omitted, the first is transport_comparison-c1-g0: at most 2 are made.")


@pytest.mark.parametrize(
    "text", ["3" + " " * 40_000 + "x", "3 m" + " \t" * 20_000 + "/ s", "1" * 40_000 + "_", "3 " + "m " * 20_000]
)
def test_a_long_quantity_takes_no_time(text: str) -> None:
    assert seconds(parse_quantity, text, "mm") < 0.5
    assert seconds(normalised, text) < 0.5  # 12 s where blanks are searched again and again


def test_blanks_within_a_unit_are_as_before() -> None:
    assert normalised(" kg \t * m  ** 2 ") == "kg*m**2" and normalised("kg  m^2") == "kg*m**2"


def test_the_page_tells_each_cap() -> None:
    page = re.sub(r"(?<=\d) (?=\d{3})", "", PAGE.read_text("utf-8"))
    for name, value in vars(errors).items():
        assert not name.startswith("MAX_") or re.search(rf"\| {value} \|", page), name


@pytest.mark.parametrize("ratio", ["20000", "1e9"])
def test_a_sector_that_turns_its_gear_for_ever_is_refused_before_it_is_calculated(ratio: str, tmp_path: Path) -> None:
    drive = f"  d: {{kind: cylinder_drive, crank_speed: 100 rpm, cylinder_radius: 105 mm, sector_ratio: {ratio}}}\n"
    (found,) = [line for line in problems(tmp_path, HEAD + drive) if "sector_ratio" in line]
    assert "plausible" in found
