"""The cyclogram of the example press against the numbers of its method, brute force on a fine grid, and words of faults."""

from __future__ import annotations

import json
from dataclasses import replace
from functools import cache
from math import degrees, pi
from typing import Any

import numpy as np
import pytest
import yaml

from diecut_report.config.loader import load_config
from diecut_report.config.plugins import Discovery
from diecut_report.config.yaml import parse
from diecut_report.errors import UserError
from diecut_report.machine.calculation import Calculation, Impossible
from diecut_report.machine.mechanism import MechanismHandle
from diecut_report.machine.steps.run import calculate
from diecut_report.plugins.cyclogram import MECHANISM
from diecut_report.plugins.cyclogram.timing import Timing
from diecut_report.results.checks import check_results
from diecut_report.results.document import document
from diecut_report.results.press_run import Run
from diecut_report.results.warm_press import WarmPress
from diecut_report.study.definition.base_inputs import find_input
from diecut_report.study.execution.variant_rows import calculate_rows, columns_of
from tests.configs import EXAMPLE
from tests.machines import inputs, number

Data = dict[str, Any]
DISCOVERY = Discovery()
PASSING = [{"name": "passing", "from": "142.875 mm", "to": "428.625 mm"}]
STATION = {"cylinder": "drive", "carriage_stop": "285 mm", "carriage_width": "20 mm", "forward_direction": "with"}


def locks(which: str, transport: str, **margins: Any) -> list[Data]:
    """The interlocks of the method by their short names."""
    known = {
        "cutting": {"phase": "drive.cutting", "within": f"{transport}.dwell"},
        "contact": {"phase": "drive.contact", "within": f"{transport}.dwell"},
        "passing": {"phase": f"{transport}.passing", "within": "drive.carriage_window"},
    }
    return [{"name": name, **known[name], "margin": margins.get(name, 0)} for name in which.split()]


TEXT = EXAMPLE.read_text("utf-8")


@cache
def base() -> Run:
    """The cylinder, its drive and both transports of the example press."""
    return linked({})


LINKED = WarmPress(is_advised=False)


def linked(more: Data, *, printed: bool = False) -> Run:
    """The same with more mechanisms, by a configuration."""
    data = yaml.safe_load(TEXT)
    kept = {name: data["mechanisms"][name] for name in ("cylinder", "drive", "feeder", "cross")}
    kept["cross"]["driven_inertia"], kept["feeder"]["conveyor_mass"] = "3.57 kg*m**2", "12 kg"  # as the method has them
    data["mechanisms"] = kept | more
    config = load_config(parse(yaml.safe_dump(data, allow_unicode=True), "press.yaml"), DISCOVERY)
    return LINKED.printed(config) if printed else LINKED.calculate(config)


def taken_whole(value: Any) -> Any:
    """The keys with mechanisms in place of their names."""
    if isinstance(value, list):
        return [taken_whole(each) for each in value]
    if not isinstance(value, dict):
        return value
    known = base().calculations
    return {
        key: MechanismHandle(known[each], each) if key in ("mechanism", "cylinder", "transport") else taken_whole(each)
        for key, each in value.items()
    }


def keys_of(transport: str, interlocks: list[Data], offset: Any = "auto", **more: Any) -> Data:
    """The keys of a cyclogram of the cylinder and one transport."""
    lines = [
        {"mechanism": "drive", "turns_per_sheet": "1/2", "path_efficiency": 0.97},
        {"mechanism": transport, "offset": offset, "path_efficiency": 0.95, "passing": PASSING},
    ]
    return {"productivity": "6000 1/h", "lines": lines, "interlocks": interlocks} | more


def press(transport: str, interlocks: list[Data], offset: Any = "auto", **more: Any) -> Calculation:
    """The cyclogram of the example press with one transport."""
    return calculate(MECHANISM, inputs(MECHANISM, taken_whole(keys_of(transport, interlocks, offset, **more))))


@cache
def example(transport: str, which: str) -> Calculation:
    """The press with interlocks of the method, without margins."""
    return press(transport, locks(which, transport))


def check_of(calc: Calculation, name: str) -> Data:
    """A check of the cyclogram."""
    return next(check for check in check_results(calc) if check.id == name)


def rows(calc: Calculation, name: str) -> list[float]:
    """A row, in degrees."""
    return [degrees(value) for value in calc[name][0]]


ROWS = [
    ("feeder", "cutting", 141.0056, -23.8309, None),
    ("feeder", "contact", 140.6270, -28.9031, None),
    ("feeder", "passing", 138.1164, 9.7280, (128.3884, 147.8444)),
    ("feeder", "cutting passing", 141.0056, -23.8309, None),
    ("feeder", "contact passing", 140.6270, -28.9031, None),
    ("cross", "cutting", 41.0056, 16.1691, (24.8365, 57.1747)),
    ("cross", "contact", 40.6270, 11.0969, (29.5301, 51.7238)),
    ("cross", "passing", 38.1164, 11.3273, (26.7891, 49.4437)),
    ("cross", "cutting passing", 38.1164, 11.3273, (26.7891, 49.4437)),
    ("cross", "contact passing", 39.4869, 9.9568, (29.5301, 49.4437)),
]


@pytest.mark.parametrize(("transport", "which", "offset", "slack", "feasible"), ROWS)
def test_the_automatic_offset_is_that_of_the_method(
    transport: str, which: str, offset: float, slack: float, feasible: Any
) -> None:
    calc = example(transport, which)
    assert rows(calc, "line_offset") == pytest.approx([0.0, offset], abs=6e-5)
    assert degrees(number(calc, "best_margin")) == pytest.approx(slack, abs=6e-5)
    found = [degrees(number(calc, f"offset_feasible_{end}")) for end in ("start", "end")]
    assert found == pytest.approx(feasible, abs=6e-5) if feasible else np.isnan(found).all()


SUMS = {
    "feeder": (70.9560, 149.9328, 363.1615, -332.8959, 277.0757, 3803.0, 191.087),
    "cross": (71.3934, 155.6199, 379.1602, -355.4616, 277.8589, 3970.6, 218.014),
}
SUM_NAMES = (
    "torque_mean",
    "torque_rms",
    "torque_max",
    "torque_min",
    "energy_fluctuation",
    "power_peak",
    "energy_exchange",
)


@pytest.mark.parametrize("transport", SUMS)
def test_torques_add_up_to_those_of_the_method(transport: str) -> None:
    calc = example(transport, "cutting passing")
    assert [number(calc, name) for name in SUM_NAMES] == pytest.approx(SUMS[transport], rel=2e-5)


@pytest.mark.parametrize("transport", SUMS)
def test_the_greatest_consumer_alone_is_the_cylinder_of_the_method(transport: str) -> None:
    calc = example(transport, "cutting passing")
    names = ("greatest_mean", "greatest_rms", "greatest_max", "greatest_min", "greatest_fluctuation")
    assert [number(calc, name) for name in names] == pytest.approx(
        [68.1960, 117.6007, 254.6962, -158.7909, 289.7135], rel=2e-5
    )
    mean, rms, *_, fluctuation = (SUMS[transport][index] for index in (0, 1, 4))
    assert number(calc, "peak_ratio") == pytest.approx(1.43 if transport == "feeder" else 1.49, abs=0.005)
    ratios = [number(calc, name) for name in ("mean_ratio", "rms_ratio", "fluctuation_ratio")]
    assert ratios == pytest.approx([mean / 68.1960, rms / 117.6007, fluctuation / 289.7135], rel=3e-5)


def test_friction_adds_to_the_mean_and_leaves_the_fluctuation() -> None:
    friction = [{"name": "feeder", "torque": "5 N*m"}]
    calc = press("feeder", locks("cutting passing", "feeder"), friction=friction)
    assert number(calc, "torque_mean") == pytest.approx(75.9560, abs=6e-5)
    assert number(calc, "energy_fluctuation") == pytest.approx(277.0757, abs=6e-5)
    power = [{"name": "fan", "power": f"{5 * 2 * pi * 100 / 60} W", "turns_per_sheet": "3"}]
    assert number(press("feeder", locks("cutting", "feeder"), friction=power), "torque_mean") == pytest.approx(
        75.956, abs=6e-4
    )


@pytest.mark.parametrize(
    ("transport", "offset", "direction", "least"),
    [
        ("cross", "48 deg", "with", 28.9877),
        ("cross", "auto", "with", 23.5725),
        ("cross", "auto", "against", 23.7585),
        ("feeder", "auto", "with", 14.7183),
        ("feeder", "auto", "against", 11.6557),
    ],
)
def test_the_exact_clearance_is_that_of_the_method(transport: str, offset: str, direction: str, least: float) -> None:
    station = STATION | {"transport": transport, "forward_direction": direction}
    calc = press(transport, locks("cutting passing", transport), offset, station=station)
    assert 1000 * number(calc, "clearance_least") == pytest.approx(least, abs=6e-5)
    check = check_of(calc, "carriage_height")
    assert (check.status, check.demand) == ("fail", pytest.approx(0.030))


def test_the_largest_productivity_is_that_of_the_method() -> None:
    both = {"cutting": "10 ms", "passing": "10 ms"}
    assert 3600 * number(
        press("cross", locks("cutting passing", "cross", **both)), "productivity_limit"
    ) == pytest.approx(11327.29, abs=6e-3)
    unlike = {"cutting": "15 ms", "passing": "5 ms"}
    auto = press("cross", locks("cutting passing", "cross", **unlike))
    assert 3600 * number(auto, "productivity_limit") == pytest.approx(10779.4, abs=0.06)
    fixed = press("cross", locks("cutting passing", "cross", **unlike), "38.1164 deg")
    assert 3600 * number(fixed, "productivity_limit") == pytest.approx(8853.3, abs=0.06)
    assert np.isnan(press("feeder", locks("cutting", "feeder", cutting="5 ms"))["productivity_limit"]).all()


def test_each_interlock_is_a_check_of_its_own() -> None:
    calc = example("feeder", "cutting passing")
    cutting, passing = (check_of(calc, f"interlock_{name}") for name in ("cutting", "passing"))
    assert degrees(cutting.demand) == pytest.approx(190.7232, abs=2e-4)
    assert degrees(cutting.limit) == pytest.approx(190.7232 - 2 * 23.8309, abs=3e-4)
    assert (cutting.status, passing.status) == ("fail", "pass")
    assert cutting.utilisation == pytest.approx(190.7232 / 143.0614, rel=1e-5)
    assert degrees(passing.limit) == pytest.approx(277.7732 - 242.2268 + 2 * 6.8388, abs=3e-4)
    assert not cutting.parts
    assert cutting.title == "Interlock: cutting"


def test_a_phase_apart_from_itself_fails_and_within_itself_passes() -> None:
    drawn = [{"name": "never", "phase": "cross.dwell", "apart_from": "cross.dwell"},
             {"name": "both", "phase": "drive.cutting", "within": "drive.cutting"}]  # fmt: skip
    calc = press("cross", drawn)
    never, both = (check_of(calc, f"interlock_{name}") for name in ("never", "both"))
    assert (never.status, never.utilisation) == ("fail", None)
    assert (both.status, both.utilisation) == ("pass", pytest.approx(1))
    assert "no offset changes it" in never.message


WHOLE = ((0.0, 4 * pi),)


@pytest.mark.parametrize(("outer", "status"), [((), "fail"), (WHOLE, "pass")])
def test_an_interlock_with_nothing_or_all_to_lie_in(outer: Any, status: str, monkeypatch: pytest.MonkeyPatch) -> None:
    kept = Timing._interlock
    monkeypatch.setattr(Timing, "_interlock", lambda *given: replace(kept(*given), outer=outer))
    check = check_of(press("cross", locks("cutting", "cross", cutting="5 ms")), "interlock_cutting")
    assert check.status == status
    if status == "fail":
        assert check.utilisation is None
        assert "leaves nothing that could hold it" in check.message


def test_a_failed_interlock_says_by_how_much_and_what_would_do() -> None:
    check = check_of(press("feeder", locks("cutting passing", "feeder", cutting="5 ms")), "interlock_cutting")
    assert check.status == "fail"
    for words in (
        "“Cutting” of drive does not lie within “Dwell of gear and sheet” of feeder: the margins are",
        "3° (5 ms) are required",
        "The best offset of feeder is 141.006°",
        "no offset holds all",
        "“Dwell of gear and sheet” of feeder must be 213.7°",
        "press.productivity does not help: angles decide",
    ):
        assert words in check.message


def test_an_interlock_at_a_fixed_offset_is_told_the_best_one() -> None:
    check = check_of(press("cross", locks("cutting passing", "cross"), "0 deg"), "interlock_cutting")
    assert check.status == "fail"
    assert "The best offset of cross is 38.1164" in check.message
    assert "leaves a slack of 11.33°" in check.message


def test_a_dwell_of_the_length_that_is_needed_holds_the_cutting() -> None:
    run = linked({"timing": {"kind": "cyclogram"} | keys_of("feeder", locks("cutting", "feeder"))})
    assert (
        "“Dwell of gear and sheet” of feeder must be 207.7°"
        in check_of(run.calculations["timing"], "interlock_cutting").message
    )
    data = yaml.safe_load(TEXT)["mechanisms"]["feeder"] | {"dwell_angle": "207.662 deg"}
    run = linked({"feeder": data, "timing": {"kind": "cyclogram"} | keys_of("feeder", locks("cutting", "feeder"))})
    assert 0 <= degrees(number(run.calculations["timing"], "best_margin")) < 1e-3


def test_a_name_that_no_check_can_bear_is_told() -> None:
    with pytest.raises(Impossible, match="must be letters, digits and _"):
        press("cross", [{"name": "sheet rests", "phase": "drive.cutting", "within": "cross.dwell"}])


def test_a_press_whose_lines_run_at_other_rates_is_told() -> None:
    check = check_of(press("cross", locks("cutting", "cross"), productivity="5000 1/h"), "equal_rates")
    assert (check.status, check.demand) == ("fail", pytest.approx(0.2))
    assert "press.productivity" in check.message


LINK: Data = {"kind": "elastic_follower", "inertia": "0.5 kg*m**2", "stiffness": "50772 N*m/rad", "damping_ratio": 0.05, "rise": "1 rad",
              "rise_time": 0.1, "cycles_per_hour": "3600 1/h", "rest_tolerance": "0.0113 deg"}  # fmt: skip


@pytest.mark.parametrize("cycles", [2, 12])
def test_the_rate_of_a_line_is_that_of_its_cycle_whatever_is_calculated_of_it(cycles: int) -> None:
    """A driven link is followed for some natural periods of a longer cycle."""
    interlock = {"name": "rests", "phase": "feeder.moving", "within": "link.rest"}
    timing = {
        "kind": "cyclogram",
        "productivity": "3600 1/h",
        "lines": [{"mechanism": "link"}, {"mechanism": "feeder"}],
    }
    feeder = yaml.safe_load(TEXT)["mechanisms"]["feeder"] | {"cycles_per_hour": "3600 1/h"}
    run = linked(
        {"feeder": feeder, "link": LINK | {"dwell_cycles": cycles}, "timing": timing | {"interlocks": [interlock]}}
    )
    check = check_of(run.calculations["timing"], "equal_rates")
    assert check.status == "pass" and check.demand == pytest.approx(0, abs=1e-9)
    line = {"mechanism": "link", "torque_curve": "torque"}
    lines = {"lines": [line, timing["lines"][1]], "interlocks": [interlock]}
    with pytest.raises(UserError, match="is over a part of the cycle of link alone"):
        linked({"feeder": feeder, "link": LINK | {"dwell_cycles": cycles}, "timing": timing | lines})


FAULTS: dict[str, tuple[Data, str]] = {
    "a line twice": (
        {"lines": [{"mechanism": "drive"}, {"mechanism": "drive"}]},
        "lines.1.mechanism: is drive, which is a line already",
    ),
    "a mechanism without phases": (
        {"lines": [{"mechanism": "cylinder"}]},
        "lines.0.mechanism: is cylinder, which runs over nothing that comes again",
    ),
    "a ratio that is none": (
        {"lines": [{"mechanism": "drive", "turns_per_sheet": "half"}]},
        "lines.0.turns_per_sheet: is “half”; a number or a ratio",
    ),
    "an odd ratio": (
        {"lines": [{"mechanism": "drive", "turns_per_sheet": "1/97"}]},
        "with a denominator of at most 64",
    ),
    "a curve that there is not": (
        {"lines": [{"mechanism": "cross", "torque_curve": "torqe"}]},
        "lines.0.torque_curve: is “torqe”, but cross has no curve of this name",
    ),
    "a curve of another quantity": (
        {"lines": [{"mechanism": "cross", "torque_curve": "wheel_acceleration"}]},
        "lines.0.torque_curve: is “wheel_acceleration” of cross, which is not a curve in N*m",
    ),
    "two automatic offsets": (
        {"lines": [{"mechanism": "drive", "offset": "auto"}, {"mechanism": "cross", "offset": "auto"}]},
        "lines.1.offset: is auto, and so is another line's",
    ),
    "a phase that there is not": (
        {"interlocks": [{"name": "a", "phase": "drive.cuting", "within": "cross.dwell"}]},
        "interlocks.0.phase: is “drive.cuting”, but drive has no phase “cuting”; it has contact,",
    ),
    "a phase without its key": (
        {"interlocks": [{"name": "a", "phase": "drive.cutting", "within": "cross.rest"}]},
        "interlocks.0.within: is “cross.rest”, but cross has this phase only if rest_tolerance is given there",
    ),
    "no line": (
        {"interlocks": [{"name": "a", "phase": "feeder.dwell", "within": "cross.dwell"}]},
        "feeder is not a line; the lines are drive, cross",
    ),
    "an interval that there is not": (
        {"interlocks": [{"name": "a", "phase": "drive.cutting.2", "within": "cross.dwell"}]},
        "the phase has 2 intervals, counted from 0",
    ),
    "nothing to lie in": (
        {"interlocks": [{"name": "a", "phase": "drive.cutting"}]},
        "interlocks.0: needs one of within and apart_from",
    ),
    "a way beyond the step": (
        {"lines": [{"mechanism": "cross", "passing": [{"name": "p", "from": "1 mm", "to": "600 mm"}]}]},
        "lines.0.passing.0: goes from 1 mm to 600 mm; it must go forward, and no further than the step of 571.5 mm",
    ),
}


@pytest.mark.parametrize("what", FAULTS)
def test_what_cannot_be_is_told_in_words(what: str) -> None:
    changes, words = FAULTS[what]
    lines = [{"mechanism": "drive", "turns_per_sheet": "1/2"}, {"mechanism": "cross"}]
    default = (
        [{"name": "a", "phase": f"{changes['lines'][0]['mechanism']}.moving", "within": "cross.dwell"}]
        if "lines" in changes
        else []
    )
    with pytest.raises(Impossible) as error:
        press("cross", changes.get("interlocks", default), lines=changes.get("lines", lines))
    key, message = error.value.reasons[0]
    assert words in f"{key}: {message}"


def test_a_configuration_takes_mechanisms_by_their_names_and_tells_what_is_wrong_where_it_stands() -> None:
    keys = {"kind": "cyclogram"} | keys_of("cross", locks("cutting", "cross", cutting="5 ms"))
    run = linked({"timing": keys}, printed=True)
    assert not run.errors
    assert degrees(number(run.calculations["timing"], "best_margin")) == pytest.approx(16.1691 - 3, abs=6e-5)
    found = run.results["timing"].inputs
    assert (found["lines.1.mechanism"].value, found["lines.1.offset"].value) == ("cross", "auto")
    assert found["interlocks.0.margin"].display.text == "5 ms"
    again = document(run).config.resolved["mechanisms"]["timing"]
    assert again["lines"][1] | {"path_efficiency": 0.95} == again["lines"][1]
    assert (again["lines"][1]["mechanism"], again["lines"][1]["offset"]) == ("cross", "auto")
    json.dumps(document(run).data())


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        (
            {"lines": [{"mechanism": "driv"}]},
            "timing.lines.0.mechanism: there is no mechanism 'driv' (did you mean 'drive'?)",
        ),
        (
            {"lines": [{"mechanism": "drive", "offset": "automatic"}]},
            "an angle is needed, for example 60 deg. Allowed, too: auto.",
        ),
        (
            {"interlocks": [{"name": "a", "phase": "drive.cutting", "within": "cross.dwell", "margin": "5 mm"}]},
            "5 mm is a length; an angle is needed, for example 60 deg. Allowed, too: 10 ms.",
        ),
        (
            {"lines": [{"mechanism": "${drive.crank_speed}"}]},
            "timing.lines.0.mechanism: ${drive.crank_speed} is not a mechanism",
        ),
        (
            {"interlocks": [{"name": "a", "phase": "drive.cutting", "within": "cross.rest"}]},
            "timing.interlocks.0.within: is “cross.rest”",
        ),
    ],
)
def test_a_fault_of_a_configuration_names_its_place(changes: Data, words: str) -> None:
    with pytest.raises(UserError) as error:
        linked({"timing": {"kind": "cyclogram"} | keys_of("cross", locks("cutting", "cross")) | changes})
    assert words in str(error.value), str(error.value)


def test_one_interval_alone_may_be_held() -> None:
    """The longer stroke's cutting governs; the shorter one's alone leaves more."""
    alone = [{"name": "a", "phase": "drive.cutting.1", "within": "cross.dwell"}]
    both = number(example("cross", "cutting"), "best_margin")
    assert number(press("cross", alone), "best_margin") > both


def test_apart_from_is_within_the_rest() -> None:
    within = example("cross", "cutting")
    apart = press("cross", [{"name": "a", "phase": "drive.cutting", "apart_from": "cross.moving"}])
    assert apart["slack"] == pytest.approx(within["slack"])
    assert apart["line_offset"] == pytest.approx(within["line_offset"])


def test_the_drive_train_takes_the_sum_over_all_turns_of_the_main_shaft() -> None:
    train = {
        "kind": "drive_train", "motor_speed": "1450 rpm", "output_speed": "${timing.main_shaft_speed}", "torque_mean": "${timing.torque_mean}",
        "torque_peak": "${timing.torque_peak}", "torque_curve": "${timing.main_shaft_torque}", "torque_curve_turns": "${timing.torque_curve_turns}",
        "vbelt": {"section": "SPA", "driver_diameter": "125 mm", "center_distance": "600 mm"}, "power_per_belt": "3.5 kW",
        "gears": [{"driver_teeth": 20, "driven_teeth": 98, "efficiency": 1}], "speed_fluctuation": 0.1,
    }  # fmt: skip
    run = linked(
        {"timing": {"kind": "cyclogram"} | keys_of("cross", locks("cutting passing", "cross")), "train": train}
    )
    assert not run.errors
    assert number(run.calculations["train"], "energy_fluctuation") == pytest.approx(277.8589, abs=6e-5)


def test_a_study_of_the_timing_takes_all_machines_at_once() -> None:
    keys = {"kind": "cyclogram"} | keys_of("cross", locks("cutting passing", "cross"), "30 deg")
    base_config = linked({"timing": keys}).config
    offset = find_input(base_config, "mechanisms.timing.lines.1.offset")
    rows_found = calculate_rows(base_config, {offset: np.radians([38.1164, 60.0])}, 2)
    assert np.degrees(rows_found.columns["timing.best_margin"]) == pytest.approx(
        [11.3273, 11.3273 - (60 - 38.1164)], abs=6e-4
    )
    assert list(rows_found.columns["timing.checks.interlock_cutting.status"]) == ["pass", "fail"]
    assert list(rows_found.columns["timing.checks.interlock_passing.status"]) == ["pass", "fail"]
    known = {column.name for column in columns_of(base_config)}
    assert {name for name in rows_found.columns if ".checks." in name} <= known
    assert not rows_found.slow


def clutched(**changes: Any) -> Data:
    """The checks and outputs of the consistency of a press with a clutch and a cyclogram."""
    keys = {"kind": "cyclogram"} | keys_of("cross", locks("cutting passing", "cross"))
    block = {"kind": "press_consistency", "transport": "cross", "clutch_torque": "741 N*m", "productivity": "6000 1/h",
             "output_speed": f"{100 * 5918.367 / 6000} rpm", "output_turns_per_sheet": 1} | changes  # fmt: skip
    run = linked({"timing": keys, "consistency": block}, printed=True)
    assert not run.errors
    return run.results["consistency"]


@pytest.mark.parametrize(
    ("changes", "status", "demand"),
    [
        ({"clutch_drives": ["drive"]}, "fail", 1),
        ({"clutch_drives": ["drive"], "single_position": {"value": True, "basis": "drawing"}}, "pass", 0),
        ({"clutch_drives": ["drive"], "single_position": True}, "not_checked", 0),
        ({"clutch_drives": ["cross", "drive"]}, "pass", 0),
    ],
)
def test_a_friction_clutch_loses_the_offset_of_the_lines_that_it_drives_alone(
    changes: Data, status: str, demand: float
) -> None:
    check = next(each for each in clutched(**changes).checks if each.id == "clutch_position")
    assert (check.status, check.demand) == (status, demand)
    assert status != "fail" or "out of step with the other lines: drive; let" in check.message


def test_lines_of_a_clutch_must_be_lines() -> None:
    keys = {"kind": "cyclogram"} | keys_of("cross", locks("cutting", "cross"))
    block = {"kind": "press_consistency", "transport": "cross", "clutch_torque": "741 N*m", "clutch_drives": ["feeder"]}
    with pytest.raises(
        UserError, match="clutch_drives: names feeder, which is not a line of timing; these are drive, cross"
    ):
        linked({"timing": keys, "consistency": block})


def test_without_the_lines_of_the_clutch_its_position_is_not_checked() -> None:
    check = next(each for each in clutched().checks if each.id == "clutch_position")
    assert (check.status, check.missing) == ("not_checked", ["clutch_drives"])


def test_all_times_are_told_at_the_rate_that_the_gears_give() -> None:
    times = {row[0]: row[1:] for row in clutched().listings["times"].rows}
    assert times["sheet"] == pytest.approx([0.6, 3600 / 5918.367])
    assert times["passing, margin at the end"][0] == pytest.approx(29.2308 * 0.6 / 360, abs=1e-6)
    assert times["passing, margin at the end"][1] == pytest.approx(29.2308 / 360 * 3600 / 5918.367, abs=1e-6)


def test_the_brake_takes_the_energy_of_flywheel_and_lines() -> None:
    found = clutched(brake_torque="50 N*m", flywheel_inertia="1.15 kg*m**2", flywheel_speed="483.3 rpm").outputs
    timing = example("cross", "cutting passing")
    energy = 1.15 * (483.3 * 2 * pi / 60) ** 2 / 2 + number(timing, "kinetic_energy_mean")
    angle = energy / (50 + 71.3934)
    assert found["stopping_angle"].value == pytest.approx(angle, rel=1e-5)
    assert found["stopping_time"].value == pytest.approx(2 * angle / (2 * pi * 5918.367 / 3600), rel=1e-5)


def test_what_is_not_given_is_listed() -> None:
    lines = [{"mechanism": "drive", "turns_per_sheet": "1/2"}, {"mechanism": "cross"}]
    calc = press("cross", locks("cutting", "cross"), lines=lines)
    said = {f"{what}: {because}" for what, because in listed(calc, "lacking")}
    assert said == {
        "carriages of cross against the window: passing of cross is not given",
        "height over the carriages of cross, carriage_height: station is not given",
        "margin of cutting: margin is not given; 0 is taken",
    }
    station = STATION | {"transport": "cross"}
    full = press("cross", locks("cutting", "cross", cutting="5 ms"), station=station)
    assert listed(full, "lacking") == []


def test_a_line_without_a_torque_makes_the_sum_too_small_and_is_named() -> None:
    data = yaml.safe_load(TEXT)["mechanisms"]["feeder"]
    data.pop("conveyor_mass")
    keys = {"kind": "cyclogram"} | keys_of("feeder", locks("cutting", "feeder"))
    timing = linked({"feeder": data, "timing": keys}).calculations["timing"]
    said = [f"{what}: {because}" for what, because in listed(timing, "lacking")]
    assert "kinetic energy of feeder: conveyor_mass of feeder is not given; it contributes nothing" in said


def listed(calc: Calculation, name: str) -> list[list[Any]]:
    """The rows of a table."""
    return MechanismHandle(calc, "timing").listing(name)


def test_torques_add_up_to_those_of_a_fine_grid() -> None:
    calc, drive, cross = (
        example("cross", "cutting passing"),
        *(base().calculations[name] for name in ("drive", "cross")),
    )
    main = (np.arange(200_000) + 0.5) / 200_000 * 4 * pi
    total = np.zeros_like(main)
    for line, turns, offset, curve, efficiency in (
        (drive, 0.5, 0.0, "crank_torque", 0.97),
        (cross, 1.0, float(calc["line_offset"][0, 1]), "torque", 0.95),
    ):
        own = ((main - offset) * turns % (2 * pi))[None, :]
        torque = line.sample(curve, own, line.domains["crank_angle"].middle_of(own))[0]
        total += turns * np.where(torque > 0, torque / efficiency, torque * efficiency)
    assert number(calc, "torque_mean") == pytest.approx(total.mean(), rel=1e-5)
    assert number(calc, "torque_rms") == pytest.approx(np.sqrt((total**2).mean()), rel=1e-5)
    excess = np.cumsum(total - total.mean()) * 4 * pi / len(main)
    assert number(calc, "energy_fluctuation") == pytest.approx(np.ptp(excess), rel=1e-4)


def test_the_mean_energy_is_that_of_a_fine_grid() -> None:
    drive, cross = (base().calculations[name] for name in ("drive", "cross"))
    own = (np.arange(100_000)[None, :] + 0.5) / 100_000 * 2 * pi

    def curve(calc: Calculation, name: str) -> Any:
        return calc.sample(name, own, calc.domains["crank_angle"].middle_of(own))[0]

    turned, speed = curve(drive, "cylinder_rotation"), curve(drive, "cylinder_speed")
    unbalance = 2 * number(drive, "cylinder_radius") * number(drive, "static_unbalance") * np.cos(turned)
    energy = (number(drive, "reduced_inertia") + unbalance) * speed**2 / 2
    wheel = 3.57 * curve(cross, "wheel_speed") ** 2 / 2
    assert number(example("cross", "cutting"), "kinetic_energy_mean") == pytest.approx(
        energy.mean() + wheel.mean(), rel=1e-5
    )
