"""A session of the live page: what it shows of a file that is changed on disk and on the page, and what it never loses."""

from __future__ import annotations

import json
import os
import re
import shutil
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from diecut_report.config import yaml
from diecut_report.config.loader import load_config
from diecut_report.config.parts.reading import typed_changes, typed_text
from diecut_report.config.plugins import LIST, Discovery
from diecut_report.config.references import rewritten
from diecut_report.config.yaml import Tree, plain_text
from diecut_report.design.inputs import inputs_of_parts
from diecut_report.design.machines import UTILISATION, varied
from diecut_report.errors import UserError
from diecut_report.live.page import WORDS, Pictures, advice, assets, effect, page, page_data, slider
from diecut_report.live.session import LiveMachine, LiveSession, shown_inputs
from diecut_report.press import Press
from diecut_report.results.results_file import results_text
from diecut_report.results.warm_press import WarmRun
from diecut_report.text.translation import speaking
from tests.configs import DISCOVERY, EXAMPLES, GOOD, HEAD, saved
from tests.examples import few
from tests.live.conftest import KNIFE
from tools.site.api_examples import configuration, example_of

CYRILLIC = re.compile("[а-яіїєґ]")


def force(session: LiveSession) -> float:
    assert session.machine is not None
    return force_of(session.machine)


TABLE = "source: Works standard 12\ngear_materials: {own: {sigma_h_lim: 1500 MPa, sigma_f_lim: 500 MPa}}\n"


def force_of(machine: LiveMachine) -> float:
    return float(machine.run.outputs("knife")["force_max"].value)


def shown_of(session: LiveSession, mechanism: str) -> dict[str, Any]:
    found: dict[str, Any] = next(
        each for each in page_data(session)["machine"]["mechanisms"] if each["name"] == mechanism
    )
    return found


def replaced(session: LiveSession, old: str, new: str) -> None:
    session.file.write_text(session.file.read_text("utf-8").replace(old, new), encoding="utf-8")
    session.read()


def test_what_is_saved_while_the_file_is_read_is_read_as_well(
    session: LiveSession, monkeypatch: pytest.MonkeyPatch
) -> None:
    calculate, text = session._calculate, session.file.read_text("utf-8")

    def saved_meanwhile() -> None:
        calculate()
        session.file.write_text(text.replace("depth:", "depht:"), encoding="utf-8")

    assert not session.is_stale()
    session.file.write_text(f"{text}\n", encoding="utf-8")
    assert session.is_stale()
    monkeypatch.setattr(session, "_calculate", saved_meanwhile)
    session.read()
    assert session.is_stale() and not session.faults
    monkeypatch.undo()
    session.read()
    assert not session.is_stale() and "mechanisms.knife.depht" in [fault.path for fault in session.faults]


def test_a_table_that_the_file_names_makes_it_stale_when_it_is_named_and_when_it_changes(session: LiveSession) -> None:
    table = session.file.with_name("tables.yaml")
    table.write_text(
        "source: Works standard 12\ngear_materials: {own: {sigma_h_lim: 1500 MPa, sigma_f_lim: 500 MPa}}\n"
    )
    replaced(session, "schema_version: 1\n", "schema_version: 1\nmaterials: tables.yaml\n")
    assert session.files == {session.file, table} and not session.faults
    assert session.is_stale()  # it may have changed before it was known that it matters
    session.read()
    assert not session.is_stale()
    os.utime(table, ns=(0, 0))
    assert session.is_stale()


def test_it_shows_what_the_file_gives_when_it_is_calculated_by_itself(session: LiveSession) -> None:
    session.change({"knife.eccentricity": "22 mm", "press.sheet.thickness": "0.6 mm"})
    shown = page_data(session)["machine"]
    session.write()
    results = Press.read(session.file, Discovery([])).calculate().results
    assert (shown["status"], shown["summary"]["fail"]) == (results.status, results.summary.fail)
    (knife,) = (each for each in shown["mechanisms"] if each["name"] == "knife")
    checks = {check.id: check for check in results.mechanisms["knife"].checks}
    assert {check["id"]: check["utilisation"] for check in knife["checks"]} == {
        name: check.utilisation for name, check in checks.items() if check.check_class != "numerical"
    }
    assert force(session) == results.mechanisms["knife"].outputs["force_max"].value


def test_a_number_of_the_page_stands_over_the_file_until_it_is_written_into_it(session: LiveSession) -> None:
    before, text = force(session), session.file.read_text("utf-8")
    session.change({"knife.shear_resistance": "84 N/mm**2"})  # the force is in proportion
    assert force(session) == pytest.approx(2 * before, rel=1e-9)
    assert session.file.read_text("utf-8") == text and session.edits == {"knife.shear_resistance": "84 N/mm**2"}
    replaced(session, "thickness: 0.5 mm", "thickness: 0.55 mm")  # saved in the editor meanwhile
    assert session.edits and force(session) != pytest.approx(2 * before, rel=1e-3)
    session.write()
    new = text.replace("{value: 42 N/mm**2", "{value: 84 N/mm**2").replace("thickness: 0.5 mm", "thickness: 0.55 mm")
    assert session.file.read_text("utf-8") == new and session.edits == {}


def test_what_an_editor_saves_while_the_page_calculates_is_not_lost(
    session: LiveSession, monkeypatch: pytest.MonkeyPatch
) -> None:
    session.change({"knife.shear_resistance": "84 N/mm**2"})
    calculated = session._calculate

    def saved_meanwhile() -> None:
        calculated()
        text = session.file.read_text("utf-8")
        session.file.write_text(text.replace("thickness: 0.5 mm", "thickness: 0.55 mm"), encoding="utf-8")

    monkeypatch.setattr(session, "_calculate", saved_meanwhile)
    with pytest.raises(UserError, match=r"Another program has saved this file meanwhile\. Nothing was written"):
        session.write()
    assert "thickness: 0.55 mm" in session.file.read_text("utf-8") and session.edits
    monkeypatch.undo()
    session.write()
    assert "84 N/mm**2" in session.file.read_text("utf-8") and "thickness: 0.55 mm" in session.file.read_text("utf-8")


def test_a_file_with_several_names_is_written_under_all_of_them(tmp_path: Path) -> None:
    file, second, link = tmp_path / "knife.yaml", tmp_path / "second.yaml", tmp_path / "page" / "link.yaml"
    file.write_bytes(KNIFE.read_bytes())
    second.hardlink_to(file)
    link.parent.mkdir()
    link.symlink_to(file)
    session = LiveSession(link, Discovery([]))
    session.change({"knife.shear_resistance": "84 N/mm**2"})
    session.write()
    assert link.is_symlink() and file.samefile(second) and "84 N/mm**2" in second.read_text("utf-8")
    assert [each.name for each in link.parent.iterdir()] == ["link.yaml"] and session.edits == {}


def test_what_is_typed_as_the_file_has_it_is_no_change(session: LiveSession) -> None:
    session.change({"knife.eccentricity": "22 mm"})
    session.change({"knife.eccentricity": "20 mm"})
    assert session.edits == {}
    session.change({"knife.eccentricity": "22 mm"})
    replaced(session, "20 mm, basis", "22 mm, basis")
    assert session.edits == {} and session.faults == []


SECOND = """\
    loads: [{name: gear, position: 100 mm, torque: balance, mass: 2 kg, gear: {pitch_radius: 60 mm, mesh_angle: 0 deg}},
            {name: crank, position: 130 mm, torque: 300 N*m, force_y: 3 kN, mass: 8 kg}]
"""
SHAFT = f"""\
schema_version: 1
project: {{title: a shaft}}
press: {{name: P}}
mechanisms:
  s:
    kind: shaft
    sections: [{{length: 90 mm, diameter: 50 mm}}, {{length: 150 mm, diameter: 60 mm}},
               {{length: {{value: 60 mm, basis: drawing}}, diameter: {{value: 50 mm, basis: drawing}}}}]
    bearing_a: 20 mm
    bearing_b: 200 mm
    allowable_deflection: 0.1 mm
    material: 42CrMo4+QT
    speed: 50 rpm
    notches: [{{position: 100 mm, type: press_fit}}, {{position: 130 mm, type: press_fit}}]
{SECOND}"""


def of_a_shaft(folder: Path) -> LiveSession:
    (folder / "s.yaml").write_text(SHAFT, encoding="utf-8")
    return LiveSession(folder / "s.yaml", Discovery([]))


@pytest.mark.parametrize(
    ("changed", "old", "new"),
    [
        ("s.loads.1.mass", "[{name: gear,", "[{name: new, position: 50 mm, mass: 1 kg}, {name: gear,"),
        ("s.loads.1.mass", "name: crank", "name: disc"),
        ("s.sections.1.length", "{length: 90 mm, diameter: 50 mm}, ", ""),
        ("s.notches.1.position", "[{position: 100 mm", "[{position: 50 mm, type: press_fit}, {position: 100 mm"),
        (
            "s.notches.1.position",
            "{position: 100 mm, type: press_fit}, {position: 130 mm",
            "{position: 130 mm, type: press_fit}, {position: 100 mm",
        ),
        ("s.loads.1.mass", "mass: 8 kg", "mass: 7 kg"),  # the same number, changed in the editor too
        ("s.sections.2.diameter", "{length: 90 mm, diameter: 50 mm}, ", ""),
        ("s.sections.0.diameter", "90 mm", "95 mm"),  # nothing else tells one section from another one
    ],
)
def test_a_change_of_the_page_goes_to_no_other_item_of_a_list(tmp_path: Path, changed: str, old: str, new: str) -> None:
    session = of_a_shaft(tmp_path)
    session.change({changed: "9 kg" if "mass" in changed else "132 mm" if "position" in changed else "55 mm"})
    replaced(session, old, new)
    saved = session.file.read_text("utf-8")
    assert saved == SHAFT.replace(old, new)
    assert [f"{changed} changed on this page" in str(each.message) for each in session.faults] == [True]
    with pytest.raises(UserError, match="Nothing is saved"):
        session.write()
    assert session.file.read_text("utf-8") == saved and changed in session.edits
    session.take_back([changed])
    assert session.faults == []


def test_a_change_goes_to_the_item_that_the_page_shows_while_the_file_is_at_fault(tmp_path: Path) -> None:
    """The page shows the last machine that could be calculated; meanwhile other items may stand in the file."""
    session = of_a_shaft(tmp_path)
    moved = SHAFT.replace("[{name: gear,", "[{name: new, position: 50 mm, mass: 1 kg}, {name: gear,")
    session.file.write_text(moved.replace("bearing_a: 20 mm", "bearing_a: x20 mm"), encoding="utf-8")
    session.read()
    session.change({"s.loads.1.mass": "9 kg"})
    replaced(session, "bearing_a: x20 mm", "bearing_a: 20 mm")
    assert ["s.loads.1.mass changed on this page" in str(each.message) for each in session.faults] == [True]
    session.take_back()
    assert session.faults == []


def test_a_change_stays_over_a_list_that_grows_behind_its_named_item(tmp_path: Path) -> None:
    session = of_a_shaft(tmp_path)
    session.change({"s.loads.1.mass": "9 kg"})
    replaced(session, "mass: 8 kg}", "mass: 8 kg}, {name: new, position: 50 mm, mass: 1 kg}")
    session.write()
    assert "force_y: 3 kN, mass: 9 kg}" in session.file.read_text("utf-8") and session.edits == {}


def test_steps_are_undone_and_redone_and_a_stroke_of_a_slider_is_one(session: LiveSession) -> None:
    seen = [dict(session.edits)]
    session.change({"knife.eccentricity": "21 mm"})
    seen.append(dict(session.edits))
    for typed in ("50 N/mm**2", "60 N/mm**2", "70 N/mm**2"):
        session.change({"knife.shear_resistance": typed}, "knife.shear_resistance 1")
    seen.append(dict(session.edits))
    session.take_back()
    seen.append(dict(session.edits))
    for edits in reversed(seen[:-1]):
        session.undo()
        assert session.edits == edits and not session.faults
    session.undo()  # nothing is left
    for edits in seen[1:]:
        session.redo()
        assert session.edits == edits
    session.undo()
    session.change({"knife.eccentricity": "22 mm"})
    session.redo()  # what was undone is another machine's now
    assert session.edits == {**seen[2], "knife.eccentricity": "22 mm"}
    session.write()
    assert not session.past and not page_data(session)["can"]["undo"]


def test_an_input_at_default_is_changed_where_it_stands_and_goes_into_its_block(tmp_path: Path) -> None:
    file = tmp_path / "press.yaml"
    file.write_bytes(next(path for path in EXAMPLES if path.stem == "elastic_transport").read_bytes())
    session = LiveSession(file, Discovery([]))
    assert session.machine is not None
    own = [each for each in session.machine.inputs.values() if session.machine.tree.typed(each.stands) is None]
    number = next(each for each in own if each.present and each.unit == "1" and not each.is_whole)
    order = [each["name"] for each in shown_of(session, number.asked.instance)["inputs"]]
    session.change({number.name: f"{0.9 * (number.present or 0):g}"})
    shown = {each["name"]: each for each in shown_of(session, number.asked.instance)["inputs"]}
    assert not session.faults and [*shown] == order and shown[number.name]["is_default"]
    assert shown[number.name]["start"] == number.typed(number.present or 0)
    session.write()
    assert f"{number.key}: {0.9 * (number.present or 0):g}" in file.read_text("utf-8") and not session.faults


@pytest.mark.parametrize("file", few(EXAMPLES, lambda path: path.stem in ("elastic_transport", "platen_press_zppt30")))
def test_what_stands_at_default_may_be_typed_as_it_is(file: Path) -> None:
    tree, config = yaml.read(file), load_config(file, Discovery([]))
    at_default = [each for each in shown_inputs(config, tree).values() if tree.typed(each.stands) is None]
    at_default = [
        each for each in at_default if each.name != "conveyor.motion_law"
    ]  # of no use beside a motion's curve
    typed = {each.stands: each.written or each.typed(each.present or 0.0) for each in at_default}
    found = shown_inputs(load_config(rewritten(tree, typed), Discovery([])), rewritten(tree, typed))
    assert {each.name: each.present for each in at_default if each.asked.unit} == pytest.approx(
        {name: found[name].present for name in (each.name for each in at_default) if found[name].asked.unit}
    )
    assert at_default or file.stem in ("circular_knife", "folding_knife")


PRESS_OF_LINES = next(path for path in EXAMPLES if path.stem == "flat_cylinder_press")


def test_a_word_that_stands_for_a_number_is_offered_and_gives_way_to_one(tmp_path: Path) -> None:
    """``offset: auto`` has no slider and no effect; a number takes its place, and the word comes back."""
    file, name = tmp_path / "press.yaml", "timing.lines.1.offset"
    file.write_bytes(PRESS_OF_LINES.read_bytes())
    session = LiveSession(file, Discovery([]))

    def shown() -> dict[str, Any]:
        return next(each for each in shown_of(session, "timing")["inputs"] if each["name"] == name)

    assert (shown()["typed"], shown()["value"], shown()["low"]) == ("auto", None, None)
    assert session.machine is not None
    with pytest.raises(UserError, match="not a number"):
        effect(session.machine, name)
    session.change({name: "45 deg"})
    assert (shown()["typed"], shown()["value"], shown()["start"]) == ("45 deg", 45, "auto")
    session.write()
    assert "offset: 45 deg" in file.read_text("utf-8")
    session.change({name: "auto"})
    assert shown()["value"] is None and not session.faults
    with pytest.raises(UserError):
        session.change({name: "automatic"})


def test_the_press_moves_as_a_whole_with_its_cyclogram() -> None:
    """The sheet shows the lines in their own drawings, which are drawn again where the line is another one."""
    session, pictures = LiveSession(PRESS_OF_LINES, Discovery([])), Pictures()
    assert session.machine is not None and shown_of(session, "press")["figures"] == ["Press in motion"]
    made = pictures.figure(session.machine, "press", 0)
    assert made["moving"]["mechanism"] == "timing"
    assert [each["mechanism"] for each in made["driven"]] == [
        "drive",
        "feeder",
    ]
    assert pictures.figure(session.machine, "timing", 0) is made
    session.change({"drive.crank_length": "150 mm"})
    again = pictures.figure(session.machine, "press", 0)
    assert again["driven"][0] != made["driven"][0]
    with pytest.raises(UserError):
        pictures.figure(session.machine, "press", 1)


def test_a_press_without_a_cyclogram_has_no_figure_of_its_own(session: LiveSession) -> None:
    assert shown_of(session, "press")["figures"] == []
    assert session.machine is not None
    with pytest.raises(UserError):
        Pictures().figure(session.machine, "press", 0)


@pytest.mark.nightly
def test_advice_is_that_of_the_report_and_comes_when_it_is_asked_for() -> None:
    session = LiveSession(KNIFE.parent / "flat_cylinder_mechanisms.yaml", Discovery([]))
    assert session.machine is not None
    results = Press.read(session.file, Discovery([])).calculate().results
    advised = {}
    for name in session.machine.run.calculations:
        found = advice(session.machine, name)["messages"]
        checks = {check.id: check for check in results.mechanisms[name].checks}
        shown = {each["id"]: each["message"] for each in shown_of(session, name)["checks"]}
        assert found.keys() == {id for id, check in checks.items() if check.advice}
        assert all(text != shown[id] and text.split()[:3] == shown[id].split()[:3] for id, text in found.items())
        advised |= found
    assert advised["wall_at_flat"].endswith("Set bore_radius to at most 60 mm.")
    with pytest.raises(UserError, match="no mechanism 'nife'"):
        advice(session.machine, "nife")


def test_a_state_is_kept_compared_returned_to_and_saved(session: LiveSession) -> None:
    first = force(session)
    session.change({"knife.shear_resistance": "84 N/mm**2"})
    session.keep("stiff board")
    session.change({"knife.eccentricity": "22 mm"})
    assert [each["name"] for each in page_data(session)["states"]] == ["Initially", "stiff board", "Now"]
    assert [force_of(each) for each in session.machines.values()] == [first, pytest.approx(2 * first), force(session)]
    assert dict(session.unsaved) == {"": session.edits, "stiff board": {"knife.shear_resistance": "84 N/mm**2"}}
    session.return_to("stiff board")
    assert session.edits == {"knife.shear_resistance": "84 N/mm**2"} and force(session) == pytest.approx(2 * first)
    session.undo()
    assert session.edits["knife.eccentricity"] == "22 mm"
    session.write()
    session.return_to("stiff board")  # what was written meanwhile is taken back
    assert session.edits == {"knife.eccentricity": "20 mm"} and not session.faults
    saved = session.save("stiff board")
    assert Press.read(saved, Discovery([])).calculate().results.mechanisms["knife"].outputs[
        "force_max"
    ].value == pytest.approx(2 * first)
    assert dict(session.unsaved) == {"": session.edits}
    with pytest.raises(UserError, match="There is a file of this name already"):
        session.save("stiff board")
    replaced(session, "thickness: 0.5 mm", "thickness: 0.55 mm")
    with pytest.raises(UserError, match="changed since 'stiff board' was kept"):
        session.return_to("stiff board")
    session.forget("stiff board")
    with pytest.raises(UserError, match="There is no state 'stiff board'"):
        session.save("stiff board")


@pytest.mark.parametrize(
    "name", ["", "..", "a/b", "a\\b", ".hidden", "a.", " a", "a\nb", "a\u202eb", "x" * 41, "Initially", "Now"]
)
def test_a_state_has_a_name_that_a_file_may_have_and_no_other_state_has(session: LiveSession, name: str) -> None:
    with pytest.raises(UserError, match=r"cannot be the name of a state|There is a state"):
        session.keep(name)
    assert not session.states


@pytest.mark.parametrize(("in_file", "before"), [("20 mm", "2.2 cm"), ("20", "2.2 cm"), ("2 cm", "22 mm")])
def test_a_bare_number_is_in_the_unit_that_is_shown(session: LiveSession, in_file: str, before: str) -> None:
    replaced(session, "eccentricity: {value: 20 mm", f"eccentricity: {{value: {in_file}")
    session.change({"knife.eccentricity": before})
    shown = next(each for each in shown_of(session, "knife")["inputs"] if each["name"] == "knife.eccentricity")
    number, unit = before.split()
    assert (shown["typed"], shown["unit"]) == (before, unit)
    session.change({"knife.eccentricity": f"{0.95 * float(number):.6g}"})
    assert session.edits == {"knife.eccentricity": f"{0.95 * float(number):.6g} {unit}"} and not session.faults


@pytest.mark.parametrize("act", ["change", "undo", "take_back"])
def test_a_fault_of_the_file_stands_until_it_is_mended_whatever_the_page_does(session: LiveSession, act: str) -> None:
    session.change({"knife.eccentricity": "22 mm"})
    right = session.file.read_text("utf-8")
    for spoil in (lambda: session.file.write_text("a: [", "utf-8"), session.file.unlink):
        spoil()
        session.read()
        serial = session.serial
        {
            "change": lambda: session.change({"knife.eccentricity": "21 mm"}),
            "undo": session.undo,
            "take_back": session.take_back,
        }[act]()
        assert session.faults and session.serial >= serial
        with pytest.raises(UserError, match="not kept"):
            session.keep("x")
    session.file.write_text(right, "utf-8")
    session.read()
    assert not session.faults and session.edits == ({"knife.eccentricity": "21 mm"} if act == "change" else {})


def test_undo_takes_a_change_to_no_other_item_of_a_list(tmp_path: Path) -> None:
    session = of_a_shaft(tmp_path)
    session.change({"s.loads.1.mass": "9 kg"})
    session.take_back()
    replaced(session, "[{name: gear,", "[{name: new, position: 50 mm, mass: 1 kg}, {name: gear,")
    session.change({"s.loads.1.mass": "3 kg"})  # of another load, which stands there now
    session.undo()
    assert not session.faults
    session.undo()
    assert "something else stands there in the file now" in str(session.faults[0].message)
    with pytest.raises(UserError, match="Nothing is saved"):
        session.write()


def test_of_a_state_that_was_not_saved_all_that_the_file_has_otherwise_is_told(session: LiveSession) -> None:
    session.keep("good")
    replaced(session, "{value: 20 mm", "{value: 20.4 mm")
    replaced(session, "thickness: 0.5 mm", "thickness: 0.55 mm")
    assert dict(session.unsaved)["good"] == {"press.sheet.thickness": "0.5 mm", "knife.eccentricity": "20 mm"}


def test_a_state_is_that_of_the_tables_that_it_was_made_with(tmp_path: Path) -> None:
    table, file = tmp_path / "own.yaml", tmp_path / "knife.yaml"
    table.write_text(TABLE, "utf-8")
    file.write_text(
        KNIFE.read_text("utf-8").replace("schema_version: 1\n", "schema_version: 1\nmaterials: own.yaml\n"), "utf-8"
    )
    session = LiveSession(file, Discovery([]))
    with pytest.raises(UserError, match=r"names a file 'own\.yaml'"):
        session.keep("own")
    session.keep("A")
    table.write_text(TABLE.replace("1500", "1400"), "utf-8")
    session.read()
    for act in (session.return_to, session.save):
        with pytest.raises(UserError, match=r"own\.yaml: This file has been changed since 'A' was kept"):
            act("A")
    assert sorted(each.name for each in tmp_path.iterdir()) == ["knife.yaml", "own.yaml"]
    table.write_text(TABLE, "utf-8")
    session.read()
    session.return_to("A")
    assert session.save("A").exists()


def test_a_machine_that_cannot_be_calculated_is_not_kept_and_states_have_an_end(session: LiveSession) -> None:
    for number in range(20):
        session.keep(f"{number}")
    with pytest.raises(UserError, match="At most 20 states"):
        session.keep("one more")
    replaced(session, "depth:", "depht:")
    with pytest.raises(UserError, match="not kept"):
        session.keep("broken")


MACHINE = KNIFE.parent / "machines" / "flat_cylinder_corrected.yaml"


def test_of_a_machine_of_parts_it_offers_the_numbers_that_the_mechanisms_give() -> None:
    file = MACHINE.with_name("flat_cylinder.yaml")
    tree, config = yaml.read(file), load_config(file, Discovery([]))
    offered = shown_inputs(config, tree)
    given = {each.stands: str(each.written) for each in offered.values() if tree.typed(each.stands) is not None}
    assert "drive.crank_length" in offered and 20 < len(given) < 100
    assert "drive.efficiency_sector" not in offered  # which its mesh makes
    assert rewritten(tree, given).text == tree.text


def test_what_is_typed_at_the_parts_is_offered_beside_each_mechanism_that_is_made_of_it() -> None:
    tree, config = yaml.read(MACHINE), load_config(MACHINE, Discovery([]))
    found = inputs_of_parts(config)
    names = {name: {each.name for each in own} for name, own in found.items()}
    assert {"shafts.main.sections.1.diameter", "shafts.main.parts.wheel.at"} <= names["shafts_main"]
    assert {"shafts.main.parts.wheel.key", "machine.gears.hub_yield"} <= names["shafts_main_wheel_key"]
    assert "meshes.crank_drive.width" in names["meshes_crank_drive"]
    every = {each.stands: each for own in found.values() for each in own}
    typed = {place: str(each.written) for place, each in every.items()}
    assert len(every) > 200 and {place: typed_text(tree, place) for place in typed} == typed
    told = {place: plain_text(text) if every[place].is_text else text for place, text in typed.items()}
    placed = {place: str(text) for place, text in typed_changes(tree, told).items()}
    assert rewritten(tree, placed).data == tree.data
    bearing = next(each for each in every.values() if each.name == "shafts.main.parts.a.designation")
    assert {"NU217E", "6217", "NU218E"} <= {*bearing.options} and "6218" not in bearing.options


@pytest.mark.nightly
def test_the_effect_of_what_is_typed_at_a_part_is_that_of_machines_made_anew() -> None:
    session = LiveSession(MACHINE, Discovery([]))
    assert session.machine is not None
    found = effect(session.machine, "meshes.crank_drive.width")
    session.change({"meshes.crank_drive.width": f"{found['places'][0]} mm"})
    check = next(each for each in session.machine.run.checks["meshes_crank_drive"] if each.id == "root_2")
    line = found["checks"]["meshes_crank_drive.root_2"]["utilisation"]
    assert len(line) == 9 and line[0] == pytest.approx(check.utilisation, rel=1e-3) and line[0] > line[-1]


def test_a_part_is_changed_in_its_place_with_all_that_is_made_of_it(tmp_path: Path) -> None:
    file = tmp_path / "machine.yaml"
    file.write_bytes(MACHINE.read_bytes())
    session = LiveSession(file, Discovery([]))
    session.change({"shafts.main.sections.1.diameter": "9 cm"})
    assert "take a bearing of that bore" in str(session.faults[0].message)
    session.change({"shafts.main.parts.a.designation": "NU218E", "shafts.main.sections.2.diameter": "95"})
    session.change({"meshes.crank_drive.width": "60 mm"})
    session.change({"shafts.main.parts.b.designation": "6017"})
    assert not session.faults and 'designation: "6017", limiting' in session.machine.changed.text  # not a number
    session.undo()
    assert session.machine is not None
    session.keep("larger seat")
    shown = {each["name"]: each for each in shown_of(session, "shafts_main")["inputs"]}
    assert shown["shafts.main.sections.1.diameter"]["start"] == "85 mm" and session.machine.run.outputs("shafts_main")
    session.undo()
    assert session.edits.keys() == {
        "shafts.main.sections.1.diameter", "shafts.main.parts.a.designation", "shafts.main.sections.2.diameter",
    }  # fmt: skip
    session.write()
    session.return_to("larger seat")
    assert session.edits == {"meshes.crank_drive.width": "60 mm"}
    text = MACHINE.read_text("utf-8")
    new = text.replace("80x100 r2, 85x45 r2, 90x330 r2, 85x45", "80x100 r2, 90x45 r2, 95x330 r2, 85x45")
    assert (
        file.read_text("utf-8") == new.replace("at: 122, designation: NU217E", "at: 122, designation: NU218E") != text
    )
    saved = session.save("larger seat")
    assert "module: 6, width: 60 mm," in saved.read_text("utf-8")
    replaced(
        session, "80x100 r2, 90x45 r2", "80x60 r2, 80x40 r2, 90x45 r2"
    )  # another section: the number stands elsewhere
    session.take_back()
    session.change({"shafts.main.sections.2.diameter": "92"})
    replaced(session, "80x60 r2, 80x40 r2, 90x45 r2", "80x30 r2, 80x30 r2, 80x40 r2, 90x45 r2")
    assert "something else stands there in the file now" in str(session.faults[0].message)


@pytest.mark.parametrize("spoilt", ["- 1\n", "schema_version: 1\nmechanisms: []\n", "mechanisms:\n  - knife: {}\n"])
def test_a_block_that_becomes_a_list_is_a_fault_until_it_is_right(session: LiveSession, spoilt: str) -> None:
    right = session.file.read_text("utf-8")
    session.change({"knife.eccentricity": "22 mm"})
    session.file.write_text(spoilt, encoding="utf-8")
    session.read()
    assert session.faults and session.edits
    session.file.write_text(right, encoding="utf-8")
    session.read()
    assert session.faults == [] and session.edits == {"knife.eccentricity": "22 mm"}


def test_a_fault_of_the_program_is_shown_and_ends_with_what_is_saved_next(
    session: LiveSession, monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(_: object) -> None:
        raise ZeroDivisionError("of the program")

    monkeypatch.setattr(session, "_made", broken)
    session.read()
    assert ["ZeroDivisionError: of the program" in str(each.message) for each in session.faults] == [True]
    monkeypatch.undo()
    session.read()
    assert session.faults == []


@pytest.mark.parametrize("spoil", ["a fault", "no file", "a folder", "not YAML"])
def test_the_last_machine_stays_while_the_file_is_at_fault(session: LiveSession, spoil: str) -> None:
    right, before = session.file.read_bytes(), force(session)
    session.change({"knife.eccentricity": "22 mm"})
    changed = force(session)
    session.file.unlink()
    if spoil == "a folder":
        session.file.mkdir()
    elif spoil != "no file":
        session.file.write_text("mechanisms: [" if spoil == "not YAML" else "schema_version: 1\n", encoding="utf-8")
    session.read()
    data = page_data(session)
    assert data["faults"] and data["faults"][0]["text"] and force(session) == changed != before
    assert data["edits"] == {"knife.eccentricity": "22 mm"}
    with pytest.raises(UserError):
        session.write()
    if spoil == "a folder":
        session.file.rmdir()
    session.file.write_bytes(right)
    session.read()
    assert session.faults == [] and force(session) == changed


def test_a_file_that_is_at_fault_from_the_start_is_shown_when_it_is_mended(tmp_path: Path) -> None:
    file = tmp_path / "knife.yaml"
    file.write_text("schema_version: 1\n", encoding="utf-8")
    session = LiveSession(file, Discovery([]))
    assert page_data(session)["machine"] is None and session.faults
    with pytest.raises(UserError, match="before the file can be calculated"):
        session.change({"knife.eccentricity": "22 mm"})
    file.write_bytes(KNIFE.read_bytes())
    session.read()
    assert session.faults == [] and session.start is session.machine is not None


@pytest.mark.parametrize(
    ("name", "typed", "words"),
    [("knife.eccentricity", "5 kg", "mass"), ("knife.eccentricity", "", "number"), ("knife.none", "5 mm", "not a number"),
     ("knife.thickness", "1 mm", "not a number"), ("knife.eccentricity", "5 mm # a remark", "mm"),
     ("knife.eccentricity", "1" * 200, "letters"), ("knife.eccentricity", "5 mm\n  depth: 3", "mm"),
     *(("knife.eccentricity", f"5{end}mm", "not one number") for end in "\n\x85\u2028")],
)  # fmt: skip
def test_what_is_no_number_for_an_input_is_refused_and_changes_nothing(
    session: LiveSession, name: str, typed: str, words: str
) -> None:
    before = session.serial
    with pytest.raises(UserError, match=words):
        session.change({name: typed})
    assert session.edits == {} and session.serial == before


def test_a_bare_number_is_in_the_unit_that_stands_there(session: LiveSession) -> None:
    session.change({"knife.eccentricity": "22"})
    assert session.edits == {"knife.eccentricity": "22 mm"}
    session.take_back()
    replaced(session, "20 mm, basis", "2 cm, basis")
    before = force(session)
    session.change({"knife.eccentricity": " 2.2 "})
    assert session.edits == {"knife.eccentricity": "2.2 cm"} and force(session) != before


def test_a_choice_is_one_of_its_values_and_is_written_like_a_number(tmp_path: Path) -> None:
    file = tmp_path / "knife.yaml"
    text = next(path for path in EXAMPLES if path.stem == "folding_knife").read_text("utf-8")
    file.write_text(text, encoding="utf-8")
    session, name = LiveSession(file, Discovery([])), "knife.crank_rocker.lowest_dead_center"
    (shown,) = (each for each in shown_of(session, "knife")["inputs"] if each["name"] == name)
    assert (shown["typed"], shown["options"]) == ("inner", ["outer", "inner"])
    with pytest.raises(UserError, match=r"'middle' is not a value of .*; allowed: outer, inner"):
        session.change({name: "middle"})
    before = session.serial
    session.change({name: "outer"})
    assert session.edits == {name: "outer"} and session.serial > before
    (shown,) = (each for each in shown_of(session, "knife")["inputs"] if each["name"] == name)
    assert (shown["typed"], shown["start"]) == ("outer", "inner")
    session.take_back()
    assert session.edits == {} and session.faults == []


def test_a_number_out_of_bounds_is_told_with_its_place_and_can_be_taken_back(session: LiveSession) -> None:
    before = force(session)
    session.change({"knife.eccentricity": "-3 mm"})
    (fault,) = page_data(session)["faults"]
    line = next(n for n, text in enumerate(session.file.read_text("utf-8").splitlines(), 1) if "eccentricity:" in text)
    assert (fault["path"].removesuffix(".value"), fault["line"]) == ("mechanisms.knife.eccentricity", line)
    assert force(session) == before
    with pytest.raises(UserError, match="Nothing is saved"):
        session.write()
    session.take_back(["knife.eccentricity"])
    assert session.faults == [] and session.edits == {}


def test_the_effect_of_an_input_is_that_of_machines_calculated_one_by_one(session: LiveSession) -> None:
    assert session.machine is not None
    found = effect(session.machine, "knife.shear_resistance")
    lines = {name: line["utilisation"] for name, line in found["checks"].items()}
    for place in (0, 7, len(found["places"]) - 1):
        session.change({"knife.shear_resistance": f"{found['places'][place]} N/mm**2"})
        for check in session.machine.run.checks["knife"]:
            if (name := f"knife.{check.id}") in lines and check.status != "not_checked":
                assert lines[name][place] == pytest.approx(check.utilisation, rel=1e-3), name


CLUTCH = """
  clutch:
    kind: clutch
    torque: 300 N*m
    shoe_radius: 120 mm
    shoe_width: 30 mm
    wedge_angle: 10 deg
    allowable_pressure: 0.2 MPa
"""


@pytest.mark.parametrize("name", ["clutch.shoe_radius", "press.sheet.thickness"])
def test_an_effect_calculates_what_follows_from_the_input_and_leaves_the_other_checks_as_they_are(
    tmp_path: Path, name: str
) -> None:
    file = tmp_path / "two.yaml"
    file.write_text(KNIFE.read_text("utf-8").rstrip() + CLUTCH, encoding="utf-8")
    machine = LiveSession(file, Discovery([])).machine
    assert machine is not None
    asked, told = machine.inputs[name], list[str]()
    found = effect(machine, name, told.append)
    places = np.linspace(*slider(asked), len(found["places"]))
    every = varied(machine.config, {asked.asked: places}, len(places))
    assert told == (["clutch"] if name.startswith("clutch") else ["knife"])
    assert found["checks"].keys() == set(every.checks) and found["exists"] == every.exists.tolist()
    for check, line in found["checks"].items():
        whole = every.check(check, UTILISATION).astype(float)
        known = [np.nan if ratio is None else ratio for ratio in line["utilisation"]]
        np.testing.assert_allclose(known, whole, rtol=1e-3, err_msg=check)
        assert line["status"] == [status or "" for status in every.check(check)], check


def test_an_effect_ends_where_what_it_tells_ends_it(session: LiveSession) -> None:
    assert session.machine is not None
    told: list[str] = []

    def tell(mechanism: str) -> None:
        told.append(mechanism)
        raise TimeoutError

    with pytest.raises(TimeoutError):
        effect(session.machine, "knife.eccentricity", tell)
    assert told == ["knife"]


def test_the_page_names_the_figures_of_a_mechanism_and_makes_none(
    session: LiveSession, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert session.machine is not None
    titles = [figure.title for figure in session.machine.run.figures("knife")]
    session.change({"knife.eccentricity": "22 mm"})
    monkeypatch.setattr(WarmRun, "figures", lambda *_: pytest.fail("a figure is made that nobody looks at"))
    assert shown_of(session, "knife")["figures"] == titles


def test_what_it_shows_is_told_in_the_language_that_is_spoken(session: LiveSession) -> None:
    with speaking("uk"):
        knife = shown_of(session, "knife")
    described = [each["text"] for part in ("inputs", "outputs") for each in knife[part]]
    told = [knife["title"], *knife["figures"], *described]
    told += [text for check in knife["checks"] for text in (check["title"], check["message"]) if text]
    assert len(told) > 30 and [text for text in told if not CYRILLIC.search(text)] == []


def test_figures_are_curves_or_drawings_and_drawn_once_for_a_machine(session: LiveSession) -> None:
    assert session.machine is not None
    pictures, machine = Pictures(), session.machine
    drawing, chart = pictures.figure(machine, "knife", 0), pictures.figure(machine, "knife", 2)
    assert drawing["svg"].startswith("<svg") and len(chart["plot"]["panels"]) == 4
    assert pictures.figure(machine, "knife", 0) is drawing
    with pytest.raises(UserError, match="no figure 99"):
        pictures.figure(machine, "knife", 99)


def test_a_change_reads_its_text_once_and_makes_nothing_that_is_not_shown_at_once(
    session: LiveSession, monkeypatch: pytest.MonkeyPatch
) -> None:
    read: list[str] = []
    parse = yaml._parse

    def counted(text: str, *given: str) -> Tree:
        read.append(text)
        return parse(text, *given)

    monkeypatch.setattr(yaml, "_parse", counted)
    for what in ("outputs", "curves", "figures", "sections", "document"):
        monkeypatch.setattr(WarmRun, what, lambda *_, what=what: pytest.fail(f"{what} are made that nobody looks at"))
    for value in ("22 mm", "23 mm"):
        session.change({"knife.eccentricity": value})
        assert session.faults == [] and shown_of(session, "knife")["outputs"]
    assert len([text for text in read if "mechanisms:" in text]) == 2


def test_figures_are_in_the_language_that_is_spoken(session: LiveSession) -> None:
    assert session.machine is not None
    with speaking("uk"):
        pictures = Pictures()
        drawing, chart = pictures.figure(session.machine, "knife", 0), pictures.figure(session.machine, "knife", 2)
    panels = chart["plot"]["panels"]
    told = [text for panel in panels for text in (panel["title"], panel["across"]["title"])]
    assert [text for text in told if not CYRILLIC.search(text)] == [] and CYRILLIC.search(drawing["svg"])


def test_what_breaks_only_where_results_are_shown_is_a_fault_and_the_last_machine_stays(
    session: LiveSession, monkeypatch: pytest.MonkeyPatch
) -> None:
    machine, outputs = session.machine, WarmRun.key_outputs

    def broken(run: WarmRun, name: str) -> dict[str, object]:
        raise ArithmeticError("the numbers contradict the result")

    monkeypatch.setattr(WarmRun, "key_outputs", broken)
    session.change({"knife.eccentricity": "22 mm"})
    assert "the numbers contradict the result" in session.faults[0].message and session.machine is machine
    monkeypatch.setattr(WarmRun, "key_outputs", outputs)
    session.read()
    assert session.faults == [] and session.machine is not machine


# The live page's template and script: each of their words is translated, and the script has those that it says.


FILE = "knife.yaml"
SAME = {FILE, "PDF"}  # in each language
BY_STATE = {
    "status_": {"pass", "warn", "fail", "not_checked"},
    "verdict_": {"pass", "conditional", "fail"},
    "state_": {"return", "save", "forget"},
}


class Read(HTMLParser):
    """What a reader of a page is told: its texts and names, the words of its script."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.texts: list[str] = []
        self.words: dict[str, str] = {}
        self.feed(text)

    def handle_starttag(self, _tag: str, attrs: list[tuple[str, str | None]]) -> None:
        given = dict(attrs)
        self.texts += [given["aria-label"] or ""] if "aria-label" in given else []
        self.words |= json.loads(given.get("data-words") or "{}")

    def handle_data(self, data: str) -> None:
        self.texts += [data.strip()] if data.strip() else []


def test_all_that_stands_on_it_is_in_the_language_that_is_spoken() -> None:
    with speaking("uk"):
        read = Read(page(FILE).decode())
    assert len(read.texts) > 20 and read.words.keys() == WORDS.keys()
    assert [
        text for text in (*read.texts, *read.words.values()) if text not in SAME and not CYRILLIC.search(text)
    ] == []


def test_the_words_of_the_script_are_those_that_it_says_with_the_same_places() -> None:
    script = assets()["live.js"].content.decode()
    said = set(re.findall(r'\bt\("(\w+)"[,)]', script))
    for start in re.findall(r'\bt\("(\w+)" \+', script):
        said |= {start + state for state in BY_STATE[start]}
    assert said == set(WORDS)
    for name, places in re.findall(r'\bt\("(\w+)", \{([^}]*)\}', script):
        assert set(re.findall(r"(\w+):", places)) == set(re.findall(r"\{(\w+)\}", WORDS[name])), name


# The drive line on the live page: the views of a machine of parts, whose parts lead to mechanisms of the page.


@pytest.fixture(scope="module")
def parts(tmp_path_factory: pytest.TempPathFactory) -> LiveSession:
    """The small machine of parts of the reference."""
    folder, example = tmp_path_factory.mktemp("parts"), example_of("Port")
    assert example is not None
    shutil.copy(example.file, folder)
    listed = [f"{kind}: {example.file.name}:{name}\n" for kind, name in example.kinds.items()]
    (folder / LIST).write_text("".join(listed), encoding="utf-8")
    file = folder / "machine.yaml"
    file.write_text(configuration(example), encoding="utf-8")
    return LiveSession(file, Discovery([folder]))


def test_a_part_leads_to_its_calculation_on_the_page(parts: LiveSession) -> None:
    assert parts.machine is not None
    shown = page_data(parts)["machine"]
    names = {each["name"] for each in shown["mechanisms"]}
    assert shown["views"] == ["Drive line, front view", "Shafts of the drive line, side by side"]
    svg = "".join(Pictures().view(parts.machine, index)["svg"] for index in (0, 1))
    links = {*re.findall(r'<a href="#([^"]+)"', svg)}
    assert links == {
        "shafts_main", "shafts_main_bearings", "shafts_main_wheel_key", "shafts_main_disc_key", "meshes_drive",
    } and links <= names  # fmt: skip


@pytest.mark.nightly
def test_a_change_on_the_page_changes_the_colour_of_the_part_that_it_overloads(parts: LiveSession) -> None:
    def told(name: str) -> str:
        assert parts.machine is not None
        found = re.search(rf"<title>{name}: ([^<]*)</title>", Pictures().view(parts.machine, 1)["svg"])
        assert found is not None
        return found[1]

    before = told("main.disc.key")
    parts.change({"stamp.force": "80 kN"})
    assert parts.faults == []
    assert "fail" not in before and told("main.disc.key").endswith(", fail")
    parts.take_back()
    assert told("main.disc.key") == before


def test_the_views_speak_the_language_of_the_page(parts: LiveSession) -> None:
    with speaking("uk"):
        assert parts.machine is not None
        assert page_data(parts)["machine"]["views"][0] == "Привод, вигляд спереду"
        assert "не перевірено на міцність" in Pictures().view(parts.machine, 0)["svg"]


def test_a_machine_without_parts_has_no_views(file: Path) -> None:
    alone = LiveSession(file, Discovery([]))
    assert alone.machine is not None and page_data(alone)["machine"]["views"] == []
    for index in (0, 2):
        with pytest.raises(UserError, match="There is no figure"):
            Pictures().view(alone.machine, index)


def test_a_click_on_a_part_opens_its_calculation() -> None:
    script = assets()["live.js"].content.decode()
    assert re.search(r'byId\("views"\).addEventListener\("click".*?closest\("a"\).*?preventDefault\(\).*?visit\(', script, re.DOTALL)  # fmt: skip


# What was read and calculated before is kept where nothing of it has changed.


LEVERS = HEAD + (
    "  a: {kind: lever, force: 2 kN, arm: 100 mm, allowable_moment: 150}\n"
    '  b: {kind: lever, force: "2 * ${a.force}", arm: "${a.arm}"}\n'
    "  g: {kind: gear_pair, module: 4 mm, teeth_1: 35, teeth_2: 212, face_width: 40 mm, torque: 12 N*m, shift_1: 0.1,\n"
    "      sigma_h_lim_1: 767 MPa, sigma_h_lim_2: 767 MPa, sigma_f_lim_1: 314 MPa, sigma_f_lim_2: 314 MPa}\n"
)
OF_LEVERS = [
    ("", ""),
    ("force: 2 kN", "force: 2500 N"),
    ("arm: 100 mm", "arm: {value: 100 mm, basis: assumed}"),  # the same number, of which something is said
    (", allowable_moment: 150", ""),
    ("2500 N", "2500 kg"),  # wrong
    ("2500 kg", "2500 N # N\n   "),  # right again, a line further down
    ("2 * ${a.force}", "2 * ${c.force}"),  # which is not there
    ("  g:", "  c: {kind: lever, force: 1 kN, arm: 1 m}\n  g:"),  # now it is
    ("torque: 12 N*m", "torque: [1, 2, 3, -4]"),  # a curve stands under another key
    ("torque: [1, 2, 3, -4]", 'torque: "${c.moment} / 100"'),
    (" shift_1: 0.1,", ""),
    ("sigma_f_lim_1: 314 MPa", "sigma_f_lim_1: 510 MPa"),  # unusual
    ("sigma_f_lim_1: 510 MPa", "sigma_f_lim_1: 600 MPa"),  # wrong: no steel has it
    ("sigma_f_lim_1: 600 MPa", "sigma_f_lim_1: 320 MPa"),
    ("productivity: 6000 1/h", "productivity: 6000.5 1/h"),
    ("teeth_1: 35", "teeth_1: 35.0"),
    ("teeth_1: 35.0", "teeth_1: 35.5"),  # wrong
    ("teeth_1: 35.5", "teeth_1: 36"),
    ("  c: {kind: lever, force: 1 kN", "  c: {kind: lever, force: 1 kN, force: 1 kN"),  # wrong
    ("force: 1 kN, force: 1 kN", "force: -0.0 kN"),
]
OF_PARTS = [
    ("", ""),
    ("r1, 60x320 r1", "r1, 60x320 r1.2"),
    ("mass: 9 kg", "mass: 9.5 kg"),
    ("shoe_friction: 0.35", "shoe_friction: 0.34"),
    ("60x320 r1.2", "60x320"),  # without its fillet
    ("hub: 60, key: 50, plane: 20", "hub: 60, key: 51, plane: 20"),  # wrong: no length of a key
    ("key: 51", "key: 45"),
    ('at: 440, designation: "6210"', "at: 440, designation: NU210E"),
    ("flywheel_material: cast_iron", "flywheel_material: steel"),
    ("    service_factor: 1.5\n", ""),
    ("cutting_force_per_length: 25 N/mm", "cutting_force_per_length: ${cuts.force}"),  # wrong
    ("cutting_force_per_length: ${cuts.force}", "cutting_force_per_length: 26 N/mm"),
    ("productivity: 6090 1/h", "productivity: 6080 1/h"),
]


@pytest.mark.usefixtures("without_advice")
@pytest.mark.parametrize(
    ("text", "changes"),
    [
        pytest.param(LEVERS, OF_LEVERS, id="levers"),
        pytest.param(MACHINE.with_name("flat_cylinder.yaml").read_text("utf-8"), OF_PARTS, id="parts", marks=pytest.mark.nightly),
    ],
)  # fmt: skip
def test_after_each_of_many_changes_it_has_what_the_file_gives_by_itself(
    text: str, changes: list[tuple[str, str]], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """To the last letter, or the same words where it is wrong; bearings are not sought for what fails, which takes minutes."""
    monkeypatch.setattr("diecut_report.results.machine_advice._WholeMachine.advised", lambda self, name, check: check)
    file, wrong = saved(tmp_path, text), 0
    session = LiveSession(file, DISCOVERY)
    for old, new in changes:
        assert old in file.read_text("utf-8"), old
        replaced(session, old, new) if old else session.read()
        try:
            wanted = Press.read(file, Discovery([GOOD])).calculate().text
        except UserError as fault:
            assert session.faults == [*fault.problems]
            wrong += 1
        else:
            assert not session.faults and session.machine is not None
            assert results_text(session.machine.run.document()) == wanted
    assert 1 < wrong < len(changes) / 2
