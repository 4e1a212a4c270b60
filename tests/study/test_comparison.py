"""Machines side by side: what they are called, which rows they have, in which units, and how many stand abreast."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from diecut_report.config.plugins import Discovery
from diecut_report.design.findings import decided
from diecut_report.errors import UserError
from diecut_report.press import Press
from diecut_report.report.office.workbook import book_of
from diecut_report.study.comparison import (
    AskedResults,
    ComparedRow,
    MachineComparison,
    Verdict,
    compared,
    names,
    refuse_units,
    refuse_unused_units,
)
from diecut_report.study.comparison_pages import blocks, page, sheets
from diecut_report.study.machines import CheckedMachine, calculated
from tests.config.parts.machines import FILE
from tests.configs import GOOD, HEAD, LEVER, saved

KNOWN = Discovery([GOOD])


@pytest.mark.parametrize(
    ("files", "expected"),
    [
        (["a/press.yaml", "b/press.yaml"], ["a/press", "b/press"]),
        (["press.yaml", "press.yml"], ["press.yaml", "press.yml"]),
        (["x/a/press.yaml", "y/a/press.yaml", "c.yaml"], ["x/a/press", "y/a/press", "c"]),
        (["study.v2#3", "study.v2#4"], ["study.v2#3", "study.v2#4"]),
        (["press.yaml", "old/press.yaml"], ["press", "old/press"]),
    ],
)
def test_no_two_machines_are_called_alike(files: list[str], expected: list[str]) -> None:
    assert names(files) == expected


@pytest.mark.parametrize(("count", "tables"), [(2, [2]), (12, [12]), (13, [6, 7]), (40, [10, 10, 10, 10])])
def test_at_most_twelve_machines_stand_abreast(count: int, tables: list[int]) -> None:
    found = list(blocks(count))
    assert [len(each) for each in found] == tables
    assert [index for each in found for index in each] == list(range(count))


def machine(folder: Path, name: str, text: str) -> CheckedMachine:
    return calculated(KNOWN, (0, str(saved(folder, text, name))), decided)


def side_by_side(
    folder: Path, *texts: str, show: tuple[str, ...] = (), units: tuple[str, ...] = ()
) -> MachineComparison:
    machines = [machine(folder, f"m{number}.yaml", text) for number, text in enumerate(texts)]
    asked = AskedResults(show, units) if show else AskedResults(units=units)
    return compared(machines, asked.rows(machines), units)


def lever(*changes: str, more: str = "") -> list[str]:
    """The lever with other keys in the place of its force of 2 kN, once for each change, and with more mechanisms."""
    return [LEVER.replace("2 kN", change) + more for change in changes]


def values(rows: list[ComparedRow]) -> dict[str, list[Any]]:
    return {row.path: [cell.value if cell else None for cell in row.cells] for row in rows}


FOLLOWS = "  b: {kind: lever, force: '${a.force}'}\n"
ASSUMED = "{value: 100, basis: assumed}"
OWN: dict[str, tuple[list[str], dict[str, list[Any]]]] = {  # machines, and what was typed differently
    "what follows is none": (
        [lever("2 kN", more=FOLLOWS.replace("}'}", "}', arm: 50}"))[0], lever("2500 N", more=FOLLOWS.replace("}'}", "}', arm: 0.06 m}"))[0]],
        {"a.force": [2, 2.5], "b.arm": [50, 60]},
    ),
    "a number in place of a reference": (
        [*lever("2 kN", more=FOLLOWS), *lever("3 kN", more=FOLLOWS.replace("'${a.force}'", "3 kN")), *lever("4 kN", more=FOLLOWS)],
        {"a.force": [2, 3, 4], "b.force": [2, 3, 4]},
    ),
    "a default that follows from the press": ([LEVER, LEVER.replace("6000 1/h", "7000 1/h")], {"press.productivity": [6000, 7000]}),
    "a typed default": (lever("2 kN", "2 kN, arm: 100"), {}),
    "another basis": (lever("2 kN, arm: 100", f"2 kN, arm: {ASSUMED}"), {"a.arm": [100, 100]}),
    "a key that one machine lacks": (lever("2 kN", "2 kN, width: 10"), {"a.width": [None, 10]}),
    "a bad file": ([LEVER, "a: [", *lever("3 kN")], {"a.force": [2, None, 3]}),
}  # fmt: skip


@pytest.mark.parametrize("name", OWN)
def test_only_what_was_typed_differently_is_an_own_change(tmp_path: Path, name: str) -> None:
    texts, changes = OWN[name]
    made = side_by_side(tmp_path, *texts)
    assert values(made.changes) == changes
    if name == "another basis":
        assert [cell.note for row in made.changes for cell in row.cells if cell] == ["", "assumed"]
    if name == "a bad file":  # it keeps its column
        assert [each.verdict for each in made.machines] == ["conditional", "bad", "conditional"]
        assert made.machines[1].messages[0].startswith(str(tmp_path / "m1.yaml"))


def test_a_mechanism_of_another_kind_is_compared_with_its_like_alone(tmp_path: Path) -> None:
    clutch = HEAD + "  a: {kind: clutch, torque: 300 N*m, shoe_radius: 120 mm, wedge_angle: 10 deg}\n"
    found = side_by_side(tmp_path, LEVER, clutch, LEVER.replace("2 kN", "5 kN"))
    assert values(found.kinds) == {"a": ["lever", "clutch", "lever"]}
    assert values(found.changes) == {"a.force": [2, None, 5]}


def test_results_are_shown_by_id_by_path_and_in_chosen_units(tmp_path: Path) -> None:
    two = LEVER + "  b: {kind: lever, force: 4 kN, width: 10}\n"
    made = side_by_side(tmp_path, LEVER, two, show=("moment", "b.pressure", "a.size"), units=("kN*mm",))
    assert values(made.results) == {
        "a.moment": [200, 200], "b.moment": [None, 400], "b.pressure": [None, 4], "a.size": ["large", "large"]
    }  # fmt: skip
    assert [row.unit for row in made.results] == ["kN*mm", "kN*mm", "MPa", "1"]


def test_the_short_words_are_the_default_and_say_of_what_they_are(tmp_path: Path) -> None:
    limited = LEVER.replace("2 kN", "2 kN, allowable_moment: 250 N*m") + "  b: {kind: lever, force: 4 kN}\n"
    made = side_by_side(tmp_path, LEVER, limited)
    assert values(made.results) == {"rate": [6000, 6000], "torque_max": [200, 400], "strength": [None, 0.8]}
    torque = next(row for row in made.results if row.path == "torque_max")
    assert [cell.note for cell in torque.cells if cell] == ["a", "b"]


def test_an_unknown_result_is_refused_with_the_nearest(tmp_path: Path) -> None:
    with pytest.raises(UserError, match=r"--show a\.momnt: no machine has this result .did you mean 'a\.moment'"):
        side_by_side(tmp_path, LEVER, show=("a.momnt",))


def test_nothing_is_refused_where_all_files_are_bad(tmp_path: Path) -> None:
    made = side_by_side(tmp_path, LEVER.replace("2 kN", "2 kg"), show=("anything",))
    assert [each.verdict for each in made.machines] == ["bad"] and made.results == []


def test_units_that_cannot_be_or_fit_nothing_are_refused(tmp_path: Path) -> None:
    for units, words in ((("kN", "N"), "units of the same dimension"), (("furlongs/x",), "--units furlongs/x: ")):
        with pytest.raises(UserError, match=words):
            refuse_units(units)
    made = side_by_side(tmp_path, LEVER, show=("moment",))
    refuse_unused_units(("kN*m",), made.results)
    with pytest.raises(UserError, match=r"--units kg: nothing that is shown has this dimension\. Shown are N·m"):
        refuse_unused_units(("kg",), made.results)


def test_a_page_shows_the_checks_that_do_not_hold_and_says_of_how_many(tmp_path: Path) -> None:
    limited = LEVER.replace("2 kN", "2 kN, allowable_moment: 150 N*m")
    held = limited.replace("150", "250") + "  b: {kind: lever, force: 1 kN, allowable_moment: 150 N*m}\n"
    made = side_by_side(tmp_path, limited, held)
    assert [row.path for row in made.telling_checks] == ["a.moment"]
    assert "1 of 2 checks" in page(made)
    assert values(made.telling_checks) == {"a.moment": [pytest.approx(200 / 150), 0.8]}


def test_a_tiny_utilisation_is_printed_as_nothing(tmp_path: Path) -> None:
    (row,) = side_by_side(tmp_path, *lever("2 kN, allowable_moment: 1e9 N*m")).checks
    assert row.cells[0] is not None and row.cells[0].text.split() == ["0.0", "%"]


def test_a_page_shows_no_more_rows_than_a_reader_reads(tmp_path: Path) -> None:
    parts = (", ".join(f"{{length: {first + n} mm}}" for n in range(60)) for first in (10, 20))
    made = side_by_side(tmp_path, *lever(*(f"2 kN, parts: [{each}]" for each in parts)))
    assert len(made.changes) > 40
    assert page(made).count('<span class="where">a.parts.') == 40
    assert f"{len(made.changes) - 40} more input" in page(made)
    assert len(sheets(made)[1].rows) == len(made.changes)


def test_the_parts_stand_there_where_they_are_known() -> None:
    known, unknown = (Verdict("a", "a.yaml", "pass", parts=parts, verdict="pass") for parts in ((54, 42), None))
    (row,) = [row for row in MachineComparison([known, unknown], []).verdicts if row.path == "parts"]
    assert [cell and (cell.value, cell.note) for cell in row.cells] == [(42, "of 54"), None]
    assert "parts" not in values(MachineComparison([unknown], []).verdicts)


@pytest.mark.nightly
def test_the_same_machines_give_the_same_workbook(tmp_path: Path) -> None:
    made = side_by_side(tmp_path, LEVER, LEVER.replace("2 kN", "3 kN"))
    first = book_of(sheets(made))
    time.sleep(1.1)  # a file that held the time would hold its seconds
    assert book_of(sheets(made)) == first


def test_names_of_strangers_stand_as_texts(tmp_path: Path) -> None:
    made = compared([machine(tmp_path, "<b>=1+1.yaml", LEVER), machine(tmp_path, "b\udcff.yaml", LEVER)], [])
    shown = page(made)
    assert "<b>=1" not in shown and "&lt;b&gt;=1+1" in shown
    shown.encode()


def test_the_press_of_a_comparison_is_that_of_its_report(tmp_path: Path) -> None:
    file = saved(tmp_path, LEVER.replace("2 kN", "{value: 2 kN, basis: assumed}, allowable_moment: 250 N*m"))
    whole = decided(Press.read(file, KNOWN).calculate()).results
    (found,) = compared([calculated(KNOWN, (0, str(file)), decided)], []).machines
    assert (found.conclusion, found.verdict) == (whole.summary.conclusion, whole.summary.verdict)


def test_a_torque_counts_whichever_way_it_turns(tmp_path: Path) -> None:
    shaft = (
        HEAD
        + """\
  pin:
    kind: shaft
    sections: [{length: 300 mm, diameter: 50 mm}]
    bearing_a: 20 mm
    bearing_b: 280 mm
    material: 42CrMo4+QT
    loads:
      - {name: a, position: 100 mm, torque: 500 N*m, gear: {pitch_radius: 100 mm, mesh_angle: 0 deg}}
      - {name: b, position: 200 mm, torque: balance}
"""
    )
    made = side_by_side(tmp_path, shaft, shaft.replace("500 N*m", "-500 N*m"))
    assert values(made.results)["torque_max"] == pytest.approx([500, 500])


@pytest.mark.nightly
def test_the_parts_on_the_shafts_of_a_machine_are_weighed_once(tmp_path: Path) -> None:
    """All shafts with what is mounted on them, and the cylinder; a shaft that is none of the parts is weighed, too."""
    beside = """\
  feed_shaft:
    kind: shaft
    sections: [{length: 900 mm, diameter: 90 mm}]
    bearing_a: 50 mm
    bearing_b: 850 mm
    material: C45E+N
    loads: [{name: weight, position: 450 mm, force_y: 1 kN}]
"""
    text = FILE.with_stem("flat_cylinder_corrected").read_text("utf-8")
    found = machine(tmp_path, "m.yaml", text + beside)
    own = found.mechanisms
    one, two, three = (
        float(own[name].outputs[key].value)
        for name, key in (("machine_inertia", "mass"), ("cylinder", "mass"), ("feed_shaft", "shaft_mass"))
    )  # type: ignore[arg-type]
    rows = AskedResults(("mass",)).rows([found])
    assert three == pytest.approx(0.9 * np.pi * 0.045**2 * 7850)
    assert values(rows)["mass"] == pytest.approx([one + two + three])
