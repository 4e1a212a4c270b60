"""What a machine of parts advises where a shaft must grow under its bearings, or a bearing wears out too soon: tried, and built."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import pytest

from diecut_report.config.loader import Config, load_config
from diecut_report.config.plugins import Discovery
from diecut_report.design.advice import mended
from diecut_report.press import Press
from diecut_report.results.checks import checks_of, verdicts
from diecut_report.results.machine_advice import advised
from diecut_report.results.mechanism_record import CheckRecord, KeyChangeRecord
from diecut_report.results.press_run import Run, compute
from diecut_report.standards import bearing_series, catalogue_size, stronger_bearings
from tests.configs import EXAMPLES, saved

TEXT = (EXAMPLES[0].parent / "machines" / "flat_cylinder_corrected.yaml").read_text("utf-8")
THIN_SEATS = (
    ("50x40 r2, 65x290 r2, 50x40", "30x40 r2, 65x290 r2, 30x40"),
    ('at: 27, designation: "6210"', 'at: 27, designation: "6206"'),
    ('at: 343, designation: "6210"', 'at: 343, designation: "6206"'),
)
SOFT_SHAFT = (("90x45 r2, 85x110", "65x45 r2, 60x110"), ("designation: NU218E", "designation: NU213E"))


@cache
def machine(folder: Path, changes: tuple[tuple[str, str], ...]) -> Run:
    text = TEXT
    for old, new in changes:
        assert text.count(old) == 1
        text = text.replace(old, new)
    return compute(load_config(saved(folder, text), Discovery([])), lambda _: None)


def advice(run: Run, mechanism: str, check: str) -> CheckRecord:
    """A failing check with what the whole machine advises."""
    [found] = [each for each in verdicts(run.calculations[mechanism]) if each.id == check]
    assert found.status == "fail" and checks_of(run.calculations[mechanism])
    return advised(run, {mechanism: [found]})[mechanism][0]


def followed(run: Run, mechanism: str, way: list[KeyChangeRecord]) -> Config:
    """The machine with an advice typed where it says; its parts agree."""
    parts = run.config.parts
    assert parts is not None
    places = {}
    for change in way:
        key = [int(step) if step.isdigit() else step for step in change.key.split(".")]
        place = parts.typed_at((change.mechanism or mechanism, *key))
        assert place is not None and not isinstance(change.value, list)
        places[place] = change.value if isinstance(change.value, str) else f"{change.value} {change.unit}"
    config, problems = run.config.retyped(places)
    assert problems == []
    return config


def status(config: Config, mechanism: str, check: str) -> str:
    return next(
        each.status for each in verdicts(compute(config, lambda _: None).calculations[mechanism]) if each.id == check
    )


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("machines")


@pytest.mark.nightly
def test_a_bearing_that_dents_is_a_stronger_one_of_its_bore(folder: Path) -> None:
    run = machine(folder, THIN_SEATS)
    found = advice(run, "shafts_pinion_bearings", "a_static")
    [[change]] = found.advice
    assert (change.key, change.value, change.mechanism) == ("bearings.0.designation", "6306", "")
    assert "Give limiting_speed of 6306, too" in str(found.message)
    assert status(followed(run, "shafts_pinion_bearings", [change]), "shafts_pinion_bearings", "a_static") == "pass"


@pytest.mark.nightly
def test_where_no_bearing_of_its_bore_lives_long_enough_its_seat_grows_with_it(folder: Path) -> None:
    """No 63 of 30 mm will do, nor 6207 and 6208 on 35 and 40 mm: it takes those of the machine that was thinned."""
    run = machine(folder, THIN_SEATS)
    for check, designation, bore in (("a_life", "6210", 50), ("b_life", "6209", 45)):
        found = advice(run, "shafts_pinion_bearings", check)
        [way] = found.advice
        assert [(each.value, each.unit) for each in way] == [(designation, "1"), (bore, "mm")]
        assert way[1].mechanism == "shafts_pinion" and "set shafts_pinion.sections." in str(found.message)
        assert status(followed(run, "shafts_pinion_bearings", way), "shafts_pinion_bearings", check) == "pass"
        smaller = followed(run, "shafts_pinion_bearings", [
            way[0].with_(value=f"62{bore // 5 - 1:02}"), way[1].with_(value=float(bore - 5))
        ])  # fmt: skip
        assert status(smaller, "shafts_pinion_bearings", check) == "fail"


@pytest.mark.nightly
def test_a_shaft_that_grows_takes_its_bearing_with_it(folder: Path) -> None:
    """Of the sections that are too soft one is the seat of a bearing: the next one of its series, all else in whole millimetres."""
    run = machine(folder, SOFT_SHAFT)
    found = advice(run, "shafts_geneva", "twist")
    [way] = found.advice
    *sections, bearing = way
    grown = {each.key: each.value for each in sections}
    assert grown["sections.2.diameter"] == 75 and (catalogue_size(str(bearing.value), "d") or 0) == pytest.approx(0.075)
    assert (bearing.value, bearing.mechanism) == ("NU215E", "shafts_geneva_bearings")
    assert all(float(value) == round(float(value)) for value in grown.values())
    assert "follow from shafts.geneva.sections; change them there" in str(found.message)
    config = followed(run, "shafts_geneva", way)
    assert status(config, "shafts_geneva", "twist") == "pass"
    failing = {each.id for each in verdicts(run.calculations["shafts_geneva"]) if each.status == "fail"}
    after = verdicts(compute(config, lambda _: None).calculations["shafts_geneva"])
    assert {each.id for each in after if each.status == "fail"} <= failing


@pytest.mark.nightly
def test_a_machine_is_mended_by_larger_bearings_on_thicker_seats(folder: Path) -> None:
    """The designations stand in the file as texts."""
    found = mended(Press(machine(folder, THIN_SEATS).config, Discovery([]), lambda _: None))
    assert {each.design.name: each.after for each in found.changes} == {
        "shafts.pinion.sections.0.diameter": "50 mm", "shafts.pinion.sections.2.diameter": "45 mm",
        "shafts.pinion.parts.0.designation": "6210", "shafts.pinion.parts.4.designation": "6209",
    }  # fmt: skip
    assert found.machine is not None and 'designation: "6210"' in found.machine.press.config.tree.text


def test_the_bearings_that_are_tried_are_stronger_ones_of_the_bore_then_larger_ones_of_the_series() -> None:
    assert stronger_bearings("6206") == ["6306"] and stronger_bearings("nu 206") == ["NU2206E", "NU306E", "NU2306E"]
    series = bearing_series("6206")
    assert list(series.values()) == sorted(series.values()) and series["6210"] == pytest.approx(0.05)
    assert not stronger_bearings("22212") and not bearing_series("22212")
