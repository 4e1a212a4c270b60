"""``calculate`` gives the numbers of one machine by their ids, as a report has them, and errors in words."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from diecut_report.api import Chapter, Mechanism, Step, formula, m
from diecut_report.config.loader import load_config
from diecut_report.declaration.formula_checks import check_mechanism
from diecut_report.errors import PluginError
from diecut_report.mechanism.steps import Value
from diecut_report.results.document import document
from diecut_report.results.press_run import compute
from diecut_report.testing.machines import Refused, calculate, load
from diecut_report.testing.values import MechanismFound, NotGiven, PrintedValue, compare
from tests.configs import BROKEN, DISCOVERY, GOOD, HEAD, saved
from tests.machine.toy import MECHANISM, READ, ROOTED, Toy, same

LEVER = load("lever", GOOD)


def lever(**changes: Any) -> MechanismFound:
    """The lever of these tests with changes."""
    return calculate(LEVER, {"force": "2 kN", "arm": "150 mm", "speed": "10 rpm", **changes})


def test_a_number_has_its_value_in_si_and_in_other_units() -> None:
    found = lever()["moment"]
    assert (found.value, found.unit, found.symbol, found.shown) == (300.0, "N*m", "M", "300 N·m")
    assert found.to("kN*m") == pytest.approx(0.3) and float(found) == 300
    with pytest.raises(ValueError, match=r"moment is in N·m, which is not of the kind of mm"):
        found.to("mm")


def test_it_is_what_a_report_has(tmp_path: Path) -> None:
    text = (
        HEAD
        + "  lever: {kind: lever, force: 2 kN, arm: 150 mm, width: 20 mm, parts: [{length: 2 mm}, {length: 3 mm}]}\n"
    )
    run = compute(load_config(saved(tmp_path, text), DISCOVERY), lambda _: None)
    keys = {"force": "2 kN", "arm": "150 mm", "width": "20 mm", "parts": [{"length": "2 mm"}, {"length": "3 mm"}]}
    press = {"productivity": "6000 1/h", "sheet": {"length": "700 mm", "thickness": "0.6 mm"}}
    found, whole = calculate(LEVER, keys, press=press).data, document(run).mechanisms["lever"]
    written, in_report = ({id: each.data() for id, each in of.outputs.items()} for of in (found, whole))
    assert written and json.dumps(written) == json.dumps(in_report) and found.curves == whole.curves


def test_numbers_of_numpy_are_numbers() -> None:
    assert (
        calculate(LEVER, {"force": np.float64(2), "teeth": np.int64(30), "speed": "10 rpm"})["inputs.arm"].to("mm")
        == 100
    )
    with pytest.raises(TypeError, match="is not what a configuration may hold"):
        calculate(LEVER, {"force": object()})


def test_inputs_texts_places_curves_and_rows_are_there() -> None:
    found = lever(parts=[{"length": "2 mm"}, {"length": "3 mm"}])
    assert found["size"].value == "large" and found["grade"].value == "fine" and "pressure" not in found
    assert found["torque_max_at"].to("deg") == pytest.approx(90)
    assert found.row("parts.length", "mm") == (2, 3) and found["parts.1.length"].to("mm") == 3
    curve = found.curves["torque"]
    assert curve.abscissa == "angle" and max(curve.to("kN*m")) == pytest.approx(0.3)
    assert found.curves["angle"].values[9] == pytest.approx(math.pi / 2)


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("momnt", r"lever gives no 'momnt' \(did you mean 'moment'\?\)"),
        ("torque", r"torque is a curve; ask .curves\['torque'\]"),
        ("parts.length", r"parts.length has a number for each part; ask .row\('parts.length'\), or one of them as"),
    ],
)
def test_what_is_not_there_is_told_with_what_is(name: str, words: str) -> None:
    with pytest.raises(NotGiven, match=words):
        lever(parts=[{"length": "2 mm"}])[name]


def test_checks_have_their_verdicts() -> None:
    made = lever(allowable_moment="200 N*m").checks["moment"]
    assert (made.status, made.demand, made.limit, made.utilisation) == ("fail", 300.0, 200.0, 1.5)
    assert lever().checks["moment"].status == "not_checked" and lever().checks["moment"].limit is None


def test_phases_have_their_intervals() -> None:
    keys = {"slots": 6, "center_distance": "200 mm", "crank_speed": "100 rpm", "roller_radius": "10 mm"}
    found = calculate(load("geneva_transport"), keys)
    phase = next(each for each in found.phases.values() if each.role == "working" or each.role == "moving")
    turn = sum(end - start for start, end in phase.intervals)
    assert turn == pytest.approx(2 * math.pi * (6 - 2) / 12)  # the crank's share of motion of a six-slot cross


def test_other_mechanisms_and_their_curves_may_be_referred_to() -> None:
    first = {"kind": "lever", "force": "1 kN"}
    keys, press = {"force": "2 kN", "load": "${first.torque}"}, {"productivity": "6000 1/h"}
    found = calculate(LEVER, keys, press=press, others={"first": first}, plugins=[GOOD])
    assert found["taken_max"].value == pytest.approx(100)


def test_inputs_that_are_not_allowed_are_told_in_words() -> None:
    with pytest.raises(Refused) as caught:
        lever(arm="-3 mm", teth=12)
    first, second = sorted(caught.value.problems)
    assert first == "arm: -3 mm is out of range; allowed: > 0 mm, ≤ 1000 mm"
    assert second.startswith("teth: is an unknown key (did you mean 'teeth'?).")


def test_a_machine_that_cannot_be_is_told_in_words() -> None:
    with pytest.raises(Refused, match="teeth: is 120; a hundred at most"):
        lever(teeth=120)


def test_a_plugin_that_breaks_is_told_with_file_and_line() -> None:
    with pytest.raises(PluginError, match=r"RuntimeError: the plugin fell over \(breaks_in_calculation.py:15\)"):
        calculate(load("breaks_in_calculation", BROKEN), {})


def test_a_kind_that_is_not_there_is_told() -> None:
    with pytest.raises(LookupError, match="'levr' is not a known kind"):
        load("levr", GOOD)
    with pytest.raises(PluginError, match="No module named 'library_that_is_not_there'"):
        load("breaks_at_import", BROKEN)


# Printed numbers of a source are held against the calculated ones within their last digit.


FOUND = calculate(
    load("lever", GOOD), {"force": "2 kN", "arm": "152.35 mm", "width": "20 mm", "speed": "10 rpm"}
)  # 304.7 N·m


@pytest.mark.parametrize(
    ("printed", "agrees"),
    [
        ("304.7 N*m", True), ("304.70 N*m", True), ("305 N*m", True), ("304 N*m", False), ("0.3 kN*m", True),
        ("3.05e2 N*m", True), ("3.0e2 N*m", True), ("3.1e2 N*m", False), ("0.305 kN*m", True), ("−304.7 N*m", False),
    ],
)  # fmt: skip
def test_a_number_agrees_when_ours_rounds_to_it(printed: str, agrees: bool) -> None:
    found = compare(FOUND, {"moment": printed})
    assert found[0].agrees is agrees and found.agree is agrees


def test_the_table_names_each_number_with_its_difference() -> None:
    found = compare(FOUND, {"moment": PrintedValue("300 N*m", place="eq. 3"), "pressure": "0.66 MPa"})
    assert found[0].difference == pytest.approx(4.7 / 300)
    assert str(found) == (
        "→ moment (eq. 3): printed 300 N·m, calculated 304.7 N·m, differs by +4.7 N·m (+1.57%)\n"
        "  pressure: printed 0.66 MPa, calculated 0.65638 MPa, agrees"
    )
    with pytest.raises(AssertionError, match="→ moment"):
        assert found.agree, str(found)


def test_a_difference_in_the_last_digits_is_seen() -> None:
    assert str(compare(FOUND, {"moment": "304.7002 N*m"})) == (
        "→ moment: printed 304.7002 N·m, calculated 304.7 N·m, differs by -0.0002 N·m (-0.00%)"
    )
    assert "calculated 0.65638333 MPa" in str(compare(FOUND, {"pressure": "0.656381 MPa"}))
    assert "printed 0 N·m, calculated 304.7 N·m, differs by +305 N·m" in str(compare(FOUND, {"moment": "0 N*m"}))


def test_a_difference_whose_reason_is_known_is_expected_and_no_other() -> None:
    mistake = PrintedValue("300 N*m", why="the source takes an arm of 150 mm")
    assert compare(FOUND, {"moment": mistake}).agree
    assert "differs by +4.7 N·m (+1.57%): the source takes an arm" in str(compare(FOUND, {"moment": mistake}))
    mended = compare(FOUND, {"moment": PrintedValue("304.7 N*m", why="the source takes an arm of 150 mm")})
    assert not mended.agree and "though a reason is told why not: take it away" in str(mended)


def test_what_is_not_a_printed_number_is_told() -> None:
    with pytest.raises(ValueError, match="moment: 'about 3 N' is not a printed number with its unit, such as"):
        compare(FOUND, {"moment": "about 3 N"})
    with pytest.raises(ValueError, match="moment is in N·m, which is not of the kind of mm"):
        compare(FOUND, {"moment": "300 mm"})


# The contract test for plugin authors finds each kind of flaw.


@formula
def moment(force: Any, arm: Any) -> Any:
    return force * arm


def mechanism(*steps: Step) -> Mechanism:
    """A mechanism of these steps on the toy's inputs."""
    return replace(MECHANISM, inputs=Toy, chapters=(Chapter("Steps", steps=(*steps, READ)),), checks=(), figures=())


def value(**changes: Any) -> Value:
    """A sound step with changes."""
    sound: dict[str, Any] = {"id": "m", "symbol": "M", "unit": "N*m", "description": "Moment", "formula": moment}
    return Value(**sound | changes)


@pytest.mark.parametrize("sound", [mechanism(value()), MECHANISM, ROOTED])
def test_a_sound_mechanism_passes(sound: Mechanism) -> None:
    check_mechanism(sound)


def rooted(**changes: Any) -> Mechanism:
    """The mechanism with a root, its step changed."""
    step = replace(ROOTED.chapters[0].steps[0], **changes)
    return replace(ROOTED, chapters=(Chapter("Root", steps=(step,)),))


FLAWS = {
    "a length added to a force": (
        mechanism(value(formula=lambda force, arm: force + arm)),
        "brings together N .force. and m .arm.",
    ),
    "another unit than declared": (mechanism(value(unit="N")), "declared is N"),
    "a bracket in another unit than the root": (rooted(low=same.of(quantity=m.force)), "gives"),
    "a relation between unlike quantities": (rooted(right=same.of(quantity=m.force)), "the relation equals"),
}


@pytest.mark.parametrize("flaw", FLAWS)
def test_a_flaw_is_named(flaw: str) -> None:
    broken, words = FLAWS[flaw]
    with pytest.raises(AssertionError, match=words):
        check_mechanism(broken)
