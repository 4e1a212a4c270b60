"""The pins of a press's linkage, as shafts under the forces of its joints: those of 5 mm fail, and the report says what would hold."""

from __future__ import annotations

import pytest
import yaml

from diecut_report.config.plugins import Discovery
from diecut_report.press import Press
from diecut_report.results.model import ResultsRecord
from tests.configs import EXAMPLES, saved

ELEMENTS = next(path for path in EXAMPLES if path.stem == "flat_cylinder_elements").read_text(encoding="utf-8")
PINS = ("crank_pin", "rocker_pin")
LOADED = ("cylinder", "drive", *PINS)  # the pins, and what their forces come from
GIVEN = "diameter: {value: 40 mm, basis: assumed, note: bore of its bearing}"
BORED = "        designation: NU 2208\n"  # which a pin of another diameter contradicts


def press(tmp_path_factory: pytest.TempPathFactory, diameter: str, *only: str) -> ResultsRecord:
    """The press with pins of one diameter, or some mechanisms of it."""
    assert ELEMENTS.count(GIVEN) == len(PINS)
    assert ELEMENTS.count(BORED) == len(PINS)
    data = yaml.safe_load(ELEMENTS.replace(GIVEN, diameter).replace(BORED, ""))
    data["mechanisms"] = {name: data["mechanisms"][name] for name in only or data["mechanisms"]}
    file = saved(tmp_path_factory.mktemp("pins"), yaml.safe_dump(data, sort_keys=False))
    return Press.read(file, Discovery([])).calculate().results


@pytest.fixture(scope="module")
def thin(tmp_path_factory: pytest.TempPathFactory) -> ResultsRecord:
    return press(tmp_path_factory, "diameter: 5 mm")


def failed(results: ResultsRecord, name: str) -> dict[str, str]:
    """The messages of the checks that fail."""
    return {check.id: check.message for check in results.mechanisms[name].checks if check.status == "fail"}


@pytest.mark.nightly
def test_a_press_with_pins_of_five_millimetres_fails_for_its_pins(thin: ResultsRecord) -> None:
    elements = {
        name: data.status
        for name, data in thin.mechanisms.items()
        if data.kind in ("shaft", "gear_pair", "parallel_key")
    }
    faults = {name for name, status in elements.items() if status == "fail"}
    assert faults == {*PINS, "crank_key"}  # the published press's own key fails by its reversals
    assert all(set(failed(thin, name)) == {"fatigue", "yield"} for name in PINS)
    assert thin.status == "fail"


@pytest.mark.parametrize("name", PINS)
@pytest.mark.nightly
def test_the_stress_of_a_pin_is_that_of_a_beam_in_the_middle(thin: ResultsRecord, name: str) -> None:
    force = 9994.35  # N, the greatest of the coupler, as the method's worked example has it
    expected = force * 60e-3 / 4 * 32 / (3.141592653589793 * 5e-3**3)  # F l/4 over π d³/32
    assert thin.mechanisms[name].outputs["von_mises_max"].value == pytest.approx(expected, rel=1e-5)


@pytest.mark.nightly
def test_pins_that_have_grown_as_the_report_says_hold(
    thin: ResultsRecord, tmp_path_factory: pytest.TempPathFactory
) -> None:
    advised = [check.advice for name in PINS for check in thin.mechanisms[name].checks if check.status == "fail"]
    changes = [change for ((change,),) in advised]
    assert {change.key for change in changes} == {"sections.0.diameter"}
    thick = press(tmp_path_factory, f"diameter: {max(change.value[0] for change in changes)} mm", *LOADED)
    assert all(not failed(thick, name) for name in PINS)


@pytest.mark.nightly
def test_pins_without_a_diameter_get_the_least_that_holds(tmp_path_factory: pytest.TempPathFactory) -> None:
    sized = press(tmp_path_factory, "bore: 0 mm", *LOADED)
    sizes = [sized.mechanisms[name].outputs["section_diameter.0"].value for name in PINS]
    assert all(not failed(sized, name) for name in PINS) and all(0.015 < size < 0.032 for size in sizes)
