"""Advice that is printed can be typed where it says, the machine is not refused with it, and the check that gave it holds."""

from __future__ import annotations

import re
from functools import cache
from itertools import product
from pathlib import Path
from typing import Any

import pytest

from diecut_report.cli.main import main
from diecut_report.config.loader import Config, load_config
from diecut_report.config.parts.expansion import refused
from diecut_report.config.parts.reading import place_of, typed_changes
from diecut_report.config.plugins import Discovery
from diecut_report.config.yaml import KeyPath, parse
from diecut_report.design.advice import mended
from diecut_report.errors import UserError
from diecut_report.press import Press
from diecut_report.results import machine_advice
from diecut_report.results.advice import printed
from diecut_report.results.checks import checks_of, verdicts
from diecut_report.results.machine_advice import advised
from diecut_report.results.mechanism_record import CheckRecord, KeyChangeRecord
from diecut_report.results.press_run import Run, compute
from diecut_report.results.record import Value
from diecut_report.results.warm_press import WarmPress
from diecut_report.standards import bearing_series, catalogue_size, stronger_bearings
from tests.config.parts.machines import FILE
from tests.configs import DISCOVERY, EXAMPLE, EXAMPLES, saved


@cache
def checks(file: Path) -> dict[str, dict[str, CheckRecord]]:
    """The checks of an example that do not hold, by their mechanisms."""
    found = WarmPress().calculate(Press.read(file, DISCOVERY).config).checks
    return {name: {each.id: each for each in own if each.status in ("warn", "fail")} for name, own in found.items()}


def keys(check: CheckRecord) -> list[list[str]]:
    """The keys that a check advises to change, of each way."""
    return [[change.key for change in way] for way in check.advice]


def verdict(press: Press, mechanism: str, check: str) -> str:
    """What becomes of a check of a machine."""
    found = WarmPress(is_advised=False).calculate(press.config).checks[mechanism]
    return next(each.status for each in found if each.id == check)


def path_of(key: str) -> KeyPath:
    return tuple(int(part) if part.isdigit() else part for part in key.split("."))


def texts_of(change: KeyChangeRecord) -> list[str]:
    """The values of a change as they are typed."""
    return [printed(each, change.unit) for each in (change.value if isinstance(change.value, list) else [change.value])]


def typed(press: Press, mechanism: str, way: list[KeyChangeRecord], message: str = "") -> list[dict[KeyPath, str]]:
    """The texts of a way where they are typed, each of its values by itself; with a basis where the message asks for it."""
    places, texts = [], []
    for change in way:
        path: KeyPath = ("mechanisms", mechanism, *path_of(change.key))
        is_block = "value" in (press.config.tree.node(path).children or {})
        places.append((*path, "value") if is_block else path)
        given = texts_of(change)
        asks_basis = f"Say what {change.key} rests on" in message
        texts.append([f"{{value: {text}, basis: drawing}}" for text in given] if asks_basis else given)
    return [dict(zip(places, each, strict=True)) for each in product(*texts)]


@pytest.mark.nightly
def test_what_another_mechanism_refuses_is_not_advised() -> None:
    """A longer key leaves its section; at 30 mm the segment leaves the carriages no room below the cylinder's flat."""
    found = checks(EXAMPLE)
    assert keys(found["crank_key"]["pressure_hub"]) == [["key_count"]]
    assert keys(found["crank_key"]["pressure_key"]) == []
    assert "key_length" not in found["crank_key"]["pressure_hub"].message + found["crank_key"]["pressure_key"].message
    assert "Say what single_position rests on" in found["consistency"]["clutch_position"].message
    assert keys(found["cylinder"]["closed_section"]) == [["bore_radius"]]  # at 30 mm the carriages have no time to pass
    press = Press.read(EXAMPLE, DISCOVERY)
    for mechanism, key, text in (("crank_key", "key_length", "63 mm"), ("cylinder", "segment_height", "30 mm")):
        [values] = typed(press, mechanism, [KeyChangeRecord(key=key, relation="equal", value=text, unit="1")])
        with pytest.raises(UserError):
            press.with_values(values).calculate()


@pytest.mark.nightly
def test_what_no_machine_has_is_not_advised(tmp_path: Path) -> None:
    """A module of 10 mm would be more than half the width of the gears; a clearance of zero is none."""
    file = tmp_path / "gears.yaml"
    assert main(["new", "gear_pair", "-o", str(file), "--quiet"]) == 0
    text = file.read_text("utf-8").replace("module: {value: 5 mm", "module: {value: 3 mm")
    file.write_text(text.replace("face_width: {value: 50 mm", "face_width: {value: 12 mm"), "utf-8")
    press = Press.read(file, DISCOVERY)
    [(name, own)] = [(name, own) for name, own in checks(file).items() if name in press.config.kinds and own]
    failing = [each for each in own.values() if each.status == "fail"]
    assert {each.id for each in failing} >= {"pitting_1", "pitting_2"}
    for check in failing:
        for values in (each for way in check.advice for each in typed(press, name, way, check.message)):
            press.with_values(values).calculate()  # which would refuse it
    [pinion] = [each for each in failing if each.id == "pitting_1"]
    assert ["module"] not in keys(pinion)  # of 10 mm, which 12 mm of width are too narrow for


@pytest.mark.nightly
@pytest.mark.parametrize("file", EXAMPLES, ids=lambda file: file.stem)
def test_all_advice_of_the_examples_holds_on_the_machine(file: Path) -> None:
    """Each value by itself, where its key is typed."""
    press, warm, tried = Press.read(file, DISCOVERY), WarmPress(is_advised=False), 0
    for mechanism, own in checks(file).items():
        for check in own.values():
            if "follows from" in check.message:
                continue  # it is typed elsewhere
            for values in (each for way in check.advice for each in typed(press, mechanism, way, check.message)):
                after = warm.calculate(press.with_values(values).config).checks[mechanism]
                assert next(each.status for each in after if each.id == check.id) == "pass", (check.message, values)
                tried += 1
    assert tried or file != EXAMPLE


@pytest.mark.nightly
def test_advice_on_parts_is_followed_where_it_says() -> None:
    """The published drive line: no module for which the frame has no room, no key longer than its hub, no seat thicker than its bearing's bore."""
    found, press = checks(FILE), Press.read(FILE, DISCOVERY)
    fatigue = found["shafts_crank"]["fatigue"]
    [[change]] = fatigue.advice
    assert change.key == "sections.3.diameter"
    assert "sections.3.diameter follows from shafts.crank.sections; change it there" in fatigue.message
    every = [check for own in found.values() for check in own.values()]
    assert not any("module" in key for check in every for [key, *_] in keys(check))
    assert keys(found["shafts_main"]["fatigue"]) == []
    assert isinstance(change.value, list)
    place, text = ("shafts", "crank", "sections"), press.config.parts.reader.tree.typed(("shafts", "crank", "sections"))  # type: ignore[union-attr]
    for value in change.value:
        after = press.with_values({place: str(text).replace("50x60", f"{value:g}x60")})
        assert verdict(after, "shafts_crank", "fatigue") == "pass"


def followed(press: Press, mechanism: str, check: CheckRecord) -> list[str]:
    """What becomes of a check with each of the values that it advises at the parts of the machine."""
    parts, found = press.config.parts, []
    assert parts is not None
    for [change] in check.advice:
        place = parts.typed_at((mechanism, *path_of(change.key)))
        assert place is not None
        found += [verdict(press.with_values({place: text}), mechanism, check.id) for text in texts_of(change)]
    return found


@pytest.mark.nightly
def test_a_shaft_is_advised_to_grow_where_no_bearing_sits_and_holds_with_its_own_weight(tmp_path: Path) -> None:
    """All sections together would leave the bearings' bores; the middle one alone grows by more, and by more again as it is heavier then."""
    text = FILE.with_stem("flat_cylinder_corrected").read_text("utf-8")
    start = text.index("  far:\n")
    file = saved(tmp_path, text[:start] + text[start:].replace("0.3 mm", "0.04 mm", 1))
    press = Press.read(file, DISCOVERY)
    [deflection] = [each for each in checks(file)["shafts_far"].values() if each.status == "fail"]
    [[change]] = deflection.advice
    assert change.key == "sections.1.diameter" and isinstance(change.value, float) and 68.8 < change.value < 70
    assert followed(press, "shafts_far", deflection) == ["pass"]


@pytest.mark.nightly
def test_all_advice_on_the_parts_of_the_published_drive_line_holds_with_all_that_follows_from_it() -> None:
    press, tried = Press.read(FILE, DISCOVERY), list[str]()
    for mechanism, own in checks(FILE).items():
        for check in own.values():
            is_single = all(len(way) == 1 for way in check.advice)
            if check.status == "fail" and "follows from" in check.message and is_single:
                tried += followed(press, mechanism, check)
    assert len(tried) >= 9 and set(tried) == {"pass"}


def test_parts_refuse_what_they_would_refuse_in_the_file() -> None:
    press = Press.read(FILE, DISCOVERY)
    parts = press.config.parts
    instances = [each for each in press.config.instances.values() if each is not None]
    kinds = {each.mechanism.kind: each.mechanism for each in instances if each.mechanism is not None}
    assert parts is not None
    assert parts.typed_at(("shafts_crank", "sections", 3, "diameter")) == ("shafts", "crank", "sections", 3, "diameter")
    assert parts.typed_at(("drive_line", "meshes", 0, "module")) == ("meshes", "main_drive", "module")
    assert parts.typed_at(("chains_cylinder", "pretension")) == ("chains", "cylinder", "pretension")
    assert parts.typed_at(("shafts_main", "downwards")) is None
    diameter = ("shafts", "crank", "sections", 3, "diameter")
    assert not refused(parts, {diameter: "64 mm"}, kinds)
    assert refused(parts, {("shafts", "crank", "sections", 2, "diameter"): "61 mm"}, kinds)  # the bore of its bearing
    assert refused(parts, {("meshes", "main_drive", "module"): "8 mm"}, kinds)  # the frame
    assert refused(parts, {diameter: "thick"}, kinds)


def test_a_number_within_a_text_is_typed_into_that_text() -> None:
    tree = parse(
        """\
shafts: {a: {sections: "45x50 r1.5, 60/30x170", parts: [{crank: disc, pin: {span: [15, 75]}, hub: {value: 60 mm, basis: drawing}}]}}
meshes: {m: {teeth: 18/87}}
chains: {two: {teeth: 30, to: [b.left]}, one: {teeth: 27}}
""",
        "a.yaml",
    )
    sections = ("shafts", "a", "sections")
    both = {(*sections, 0, "diameter"): "4.6 cm", (*sections, 1, "fillet_radius"): "2 mm"}
    assert typed_changes(tree, both) == {sections: "46x50 r1.5, 60/30x170 r2"}
    assert typed_changes(tree, {("meshes", "m", "teeth_2"): "86"}) == {("meshes", "m", "teeth"): "18/86"}
    assert typed_changes(tree, {("chains", "two", "teeth_1"): "29"}) == {("chains", "two", "teeth"): "29/30"}
    assert typed_changes(tree, {("chains", "one", "teeth_1"): "29"}) == {("chains", "one", "teeth"): "29"}
    part = place_of(tree.data, "shafts.a.parts.disc")
    assert part == ("shafts", "a", "parts", 0)
    assert typed_changes(tree, {(*part, "pin", "span_end"): "70 mm"}) == {(*part, "pin", "span", 1): "70 mm"}
    assert typed_changes(tree, {(*part, "hub"): "70 mm"}) == {(*part, "hub", "value"): "70 mm"}


@pytest.mark.nightly
def test_advice_holds_where_a_mechanism_refers_to_the_value_itself(tmp_path: Path) -> None:
    """The gear ratio and the inertia of the mended press follow the slots of its cross: with 7 of them the sheets still fly off."""
    text = EXAMPLE.with_name("flat_cylinder_press_mended.yaml").read_text("utf-8")
    assert "gear_ratio: ${cross.slots}" in text and "  productivity: 6090 1/h" in text
    file = saved(tmp_path, text.replace("  productivity: 6090 1/h", "  productivity: 7500 1/h"))
    press = Press.read(file, DISCOVERY)
    found = {each.id: each for each in WarmPress().calculate(press.config).advised_checks("cross")}
    for name in ("sheet_acceleration", "torque"):
        (slots,) = (change.value for way in found[name].advice for change in way if change.key == "slots")
        assert slots == [8, 9]
        for value in slots:
            changed = press.with_values({("mechanisms", "cross", "slots"): f"{value}"})
            assert verdict(changed, "cross", name) == "pass", (name, value)


CLUTCH = """\
schema_version: 1
project: {{title: T}}
press: {{name: P, productivity: 6000 1/h, sheet: {{length: 700 mm, width: 500 mm, thickness: 0.4 mm}}}}
mechanisms:
  clutch:
    kind: clutch
    torque: 300 N*m
    wedge_angle: 10 deg
    allowable_pressure: 0.2 MPa
    shoe_radius: {radius}
    shoe_width: 3600 mm**2 / ${{clutch.shoe_radius}}
"""


@pytest.mark.parametrize("radius", ["120 mm", "1.5 * ${press.sheet.thickness} * 200"])
def test_a_way_that_what_follows_undoes_is_not_advised_whether_its_key_is_a_number_or_calculated(
    radius: str, tmp_path: Path
) -> None:
    """The pressure goes with one over radius squared and width, and so with one over the radius alone: 284 mm are needed, 185 were told."""
    pressure = checks(saved(tmp_path, CLUTCH.format(radius=radius)))["clutch"]["pressure"]
    assert pressure.status == "fail" and keys(pressure) == [["shoe_width"]]


def test_a_warning_that_no_value_mends_advises_none(tmp_path: Path) -> None:
    """The rule needs 0.6 of what the board resists, and is calculated with half of it, whatever that is."""
    text = EXAMPLE.with_name("circular_knife.yaml").read_text("utf-8")
    rule = "    rule_force: 0.6 mm * ${knife.shear_resistance}"
    assert text.count("    rule_force:") <= 1
    text = re.sub("^    rule_force:.*\n", "", text, flags=re.MULTILINE)
    text = text.replace("    shear_resistance:", f"{rule}\n    shear_resistance:", 1)
    resistance = checks(saved(tmp_path, text))["knife"]["shear_resistance"]
    assert resistance.status == "warn" and not resistance.advice


# Where a shaft must grow under its bearings, or a bearing wears out too soon: tried, and built.


CORRECTED = (EXAMPLES[0].parent / "machines" / "flat_cylinder_corrected.yaml").read_text("utf-8")
THIN_SEATS = (
    ("50x40 r2, 65x290 r2, 50x40", "30x40 r2, 65x290 r2, 30x40"),
    ('at: 27, designation: "6210"', 'at: 27, designation: "6206"'),
    ('at: 343, designation: "6210"', 'at: 343, designation: "6206"'),
)
SOFT_SHAFT = (("90x45 r2, 85x110", "65x45 r2, 60x110"), ("designation: NU218E", "designation: NU213E"))


@cache
def machine(folder: Path, changes: tuple[tuple[str, str], ...]) -> Run:
    text = CORRECTED
    for old, new in changes:
        assert text.count(old) == 1
        text = text.replace(old, new)
    return compute(load_config(saved(folder, text), DISCOVERY), lambda _: None)


def advice(run: Run, mechanism: str, check: str) -> CheckRecord:
    """A failing check with what the whole machine advises."""
    [found] = [each for each in verdicts(run.calculations[mechanism]) if each.id == check]
    assert found.status == "fail" and checks_of(run.calculations[mechanism])
    return advised(run, {mechanism: [found]})[mechanism][0]


def retyped(run: Run, mechanism: str, way: list[KeyChangeRecord]) -> Config:
    """The machine with an advice typed where it says; its parts agree."""
    parts = run.config.parts
    assert parts is not None
    places = {}
    for change in way:
        place = parts.typed_at((change.mechanism or mechanism, *path_of(change.key)))
        assert place is not None and not isinstance(change.value, list)
        places[place] = change.value if isinstance(change.value, str) else f"{change.value} {change.unit}"
    config, problems = run.config.retyped(places)
    assert problems == []
    return config


def status(config: Config, mechanism: str, check: str) -> str:
    return verdict(Press(config, DISCOVERY), mechanism, check)


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
    assert status(retyped(run, "shafts_pinion_bearings", [change]), "shafts_pinion_bearings", "a_static") == "pass"


@pytest.mark.nightly
@pytest.mark.parametrize(
    ("enough", "tried"),
    [
        (("6306",), ["6306", "6306"]),
        (("6209", "6210"), ["6306", "6210", "6207", "6208", "6209"]),
        ((), ["6306", "6210"]),
    ],
    ids=["heavier", "larger", "none"],
)
def test_a_heavier_bearing_of_the_bore_is_sought_then_a_larger_one_and_none_where_the_strongest_is_not_enough(
    folder: Path, monkeypatch: pytest.MonkeyPatch, enough: tuple[str, ...], tried: list[str]
) -> None:
    asked = list[Value]()

    def suits(*given: Any, **_: Any) -> bool:
        asked.append(given[-1][0].value)
        return asked[-1] in enough

    run = machine(folder, THIN_SEATS)
    monkeypatch.setattr(machine_advice._WholeMachine, "_suits", suits)
    found = advice(run, "shafts_pinion_bearings", "a_life").advice
    assert asked == tried and [way[0].value for way in found] == tried[-1:] * bool(enough)


@pytest.mark.nightly
def test_where_no_bearing_of_its_bore_lives_long_enough_its_seat_grows_with_it(folder: Path) -> None:
    """No 63 of 30 mm will do, nor 6207 and 6208 on 35 and 40 mm: it takes those of the machine that was thinned."""
    run = machine(folder, THIN_SEATS)
    for check, designation, bore in (("a_life", "6210", 50), ("b_life", "6209", 45)):
        found = advice(run, "shafts_pinion_bearings", check)
        [way] = found.advice
        assert [(each.value, each.unit) for each in way] == [(designation, "1"), (bore, "mm")]
        assert way[1].mechanism == "shafts_pinion" and "set shafts_pinion.sections." in str(found.message)
        assert status(retyped(run, "shafts_pinion_bearings", way), "shafts_pinion_bearings", check) == "pass"
        smaller = retyped(run, "shafts_pinion_bearings", [
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
    config = retyped(run, "shafts_geneva", way)
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


# Advice on a key that follows from another one says where that one begins.


STEPPER = """
    kind: geneva_transport
    center_distance: 240 mm
    roller_radius: 16 mm
    gear_ratio: 6
    sprocket_teeth: 30
    chain_pitch: 19.05 mm
    allowable_sheet_acceleration: 10 m/s**2
"""
HEAD = """schema_version: 1
project: {title: T}
press: {name: P, productivity: 6000 1/h, sheet: {length: 700 mm, width: 470 mm, thickness: 0.6 mm}}
mechanisms:
"""


def told(tmp_path: Path, speed: str, first: str = "") -> str:
    """The failing check of a second stepper, whose crank's speed is given so."""
    text = f"{HEAD}  cross:{STEPPER}{first}  next:{STEPPER}    crank_speed: {speed}\n"
    results = Press.read(saved(tmp_path, text), DISCOVERY).calculate().results
    (check,) = (c for c in results.mechanisms["next"].checks if c.status == "fail")
    return check.message


def test_a_chain_of_references_is_followed_to_its_beginning(tmp_path: Path) -> None:
    assert "crank_speed follows from press.productivity" in told(tmp_path, "${cross.crank_speed}")


def test_a_key_of_another_mechanism_is_where_a_reference_begins(tmp_path: Path) -> None:
    """The first stepper's own speed is typed: the second one's begins there."""
    text = told(tmp_path, "${cross.crank_speed}", first="    crank_speed: 90 rpm\n")
    assert "crank_speed follows from cross.crank_speed; change it there" in text


def test_a_typed_key_follows_from_nothing(tmp_path: Path) -> None:
    assert "follows from" not in told(tmp_path, "100 rpm")


def test_a_key_that_is_only_spoken_of_is_not_traced(tmp_path: Path) -> None:
    """The roller's width is a reference too; the advice on the acceleration does not ask to change it."""
    found = told(tmp_path, "${cross.crank_speed}\n    roller_width: ${cross.roller_radius}")
    assert "crank_speed follows" in found and "roller_width follows" not in found
