"""Each mistake of the table is told where it must be, in words; the plugin without any is right.

CI tries each sixth row, which is some of each of the table's parts, and those that only a report or a study tells.
"""

from __future__ import annotations

import math
import re
from functools import cache
from pathlib import Path
from typing import Any

import pytest

from diecut_report.cli.main import main
from diecut_report.config.plugins import Discovery
from diecut_report.declaration.formula_checks import check_mechanism
from diecut_report.machine.calculation import Calculation
from diecut_report.machine.steps.run import calculate
from diecut_report.mechanism.mechanism import Mechanism
from diecut_report.results.checks import check_results
from tests.examples import few
from tests.machines import inputs, number
from tests.mistakes.runner import KIND, MACHINE, PLUGIN, Mistake, faults, tried, write_machine
from tests.mistakes.table import TABLE


@cache
def right() -> Mechanism:
    """Return the mechanism of the plugin without a mistake."""
    return Discovery([PLUGIN.parent]).mechanism(KIND)


def elevator(**changes: Any) -> Calculation:
    """The machine of the table with changes."""
    keys = {key: value for key, value in (MACHINE | changes).items() if key != "kind"}
    return calculate(right(), inputs(right(), keys))


SOME = {mistake.what for mistake in (*TABLE[::12], *(row for row in TABLE if row.told in ("report", "study")))}


@pytest.mark.usefixtures("without_summary")
@pytest.mark.parametrize(
    "mistake",
    few(TABLE, keep=lambda mistake: mistake.what in SOME),
    ids=lambda mistake: mistake.what.replace(" ", "_"),
)
def test_a_mistake_is_told(mistake: Mistake, tmp_path: Path) -> None:
    assert not faults(mistake, tried(mistake, tmp_path))


REFUSED = next(mistake for mistake in TABLE if mistake.what == "π as a number of NumPy")


@pytest.mark.usefixtures("without_summary")
@pytest.mark.parametrize(
    ("command", "code"),
    [
        (("check-plugin", KIND), 3),
        (("new", KIND), 3),
        (("validate", "press.yaml"), 3),
        (("calc", "press.yaml", "-o", "press.json"), 3),
        (("report", "press.yaml", "-o", "out", "--format", "html"), 3),
        (("batch", "study.yaml", "-o", "out"), 3),
    ],
    ids=lambda each: each[0] if isinstance(each, tuple) else str(each),
)
def test_each_command_tells_where_a_formula_cannot_be_printed_and_what_to_write(
    command: tuple[str, ...],
    code: int,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    Path(f"{KIND}.py").write_text(REFUSED.source, "utf-8")
    write_machine(REFUSED, tmp_path)
    assert main([*command, "--plugins", "."]) == code
    told = "".join(capsys.readouterr())
    assert re.search(
        rf"{KIND}\.py:{REFUSED.line}: in “conveying\.bucket_count = .*: holds 3\.14159, .* write pi of diecut_report\.api",
        told,
    )
    assert "Traceback" not in told


ID = r'\b(of|by|key|demand|limit|abscissa|curve|value|x|y|period)="([a-z_]+(?:\.[a-z_]+)?)"'


def test_a_quantity_stands_wherever_an_id_is_wanted(tmp_path: Path) -> None:
    texts = (
        ('takes=("belt_speed", "chute_drop")', "takes=(m.belt_speed, m.chute_drop)"),
        ('"angle", "scoop_start", "scoop_end")', "m.angle, m.scoop_start, m.scoop_end)"),
        ('("waste", "lift_force")', '("waste", m.lift_force)'),
        ('needs=("allowable_torque",)', "needs=(m.allowable_torque,)"),
        ('needs=("backstop",), absent', "needs=(m.backstop,), absent"),
        ('columns=("rim_x", "rim_y")', "columns=(m.rim_x, m.rim_y)"),
        ('Mark("press_max_at", "press_max"', "Mark(m.press_max_at, m.press_max"),
    )
    written, count = re.subn(ID, r"\1=m.\2", Mistake("none", texts, "", ()).source)
    assert count > 10
    (tmp_path / f"{KIND}.py").write_text(written, "utf-8")
    mechanism = Discovery([tmp_path]).mechanism(KIND)
    check_mechanism(mechanism)
    made = calculate(mechanism, inputs(mechanism, {key: value for key, value in MACHINE.items() if key != "kind"}))
    assert [(check.id, check.demand) for check in check_results(made)] == [
        (check.id, check.demand) for check in check_results(elevator())
    ]


def test_each_row_is_another_mistake() -> None:
    assert len({mistake.what for mistake in TABLE}) == len(TABLE) >= 85
    assert {mistake.source for mistake in TABLE} & {PLUGIN.read_text("utf-8")} == set()


def test_the_plugin_without_a_mistake_passes() -> None:
    check_mechanism(right())
    assert {check.status for check in check_results(elevator())} == {"pass"}


def test_its_numbers_are_those_of_plain_arithmetic() -> None:
    made = elevator()
    omega, radius, g = 46 * 2 * math.pi / 60, 0.25, 9.80665
    speed = omega * radius
    waste, strand = 12 / 3.6 / speed, 6 + 5 / 0.4
    weight = strand * g * 12
    load = [2 * weight * math.sin(math.radians(90)), 2 * weight * math.sin(math.radians(15))]
    losses = load[0] * 0.02 * 60 / 400 + load[1] * 0.02 * 40 / 200
    pull = waste * g * 12 + waste * g * 4 + losses
    scooping = waste * g * 4 * 360 / 60  # all of a turn's scooping in 60° of it
    expected = {
        "belt_speed": speed, "filling_needed": 12 / 3.6 * 0.4 / (120 * 0.014 * speed), "froude_number": omega**2 * radius / g,
        "release_1": math.acos(omega**2 * radius / g), "release_2": 2 * math.pi - math.acos(omega**2 * radius / g),
        "press_max": 0.75 * 0.014 * 120 * (g - omega**2 * radius), "fall_time": math.sqrt(2 * 0.6 / g),
        "bucket_count": math.ceil((24 + math.pi * 0.5) / 0.4), "journal_losses": losses, "circumferential_pull": pull,
        "slack_needed": pull / (math.exp(0.3 * math.pi) - 1), "tight_pull": weight + pull,
        "torque_max": (waste * g * 12 + scooping) * radius, "torque_mean": waste * g * 16 * radius,
        "power": pull * speed / 0.9, "motor_power": 750, "belt_length": 1.6, "pawl_force": waste * g * 12 * 0.25 / 0.15,
        "lagging_pressure": (2 * weight + pull) / (0.5 * 0.3),
    }  # fmt: skip
    assert {name: number(made, name) for name in expected} == pytest.approx(expected, rel=1e-9)
    assert made["pulley_load"][0] == pytest.approx(load, rel=1e-12)


def test_the_shafts_distance_carries_the_belt() -> None:
    centre = number(elevator(), "centre")
    lean = math.atan2(0.07, math.sqrt(centre**2 - 0.07**2))  # of the straight strands
    straight = math.sqrt(centre**2 - 0.07**2)
    assert 2 * straight + 0.14 * (math.pi + 2 * lean) + 0.07 * (math.pi - 2 * lean) == pytest.approx(1.6, rel=1e-9)


def test_each_declared_check_is_made() -> None:
    made = {check.id: check for check in check_results(elevator())}
    assert made.keys() == {check.id for check in right().checks}
    assert made["torque"].demand == pytest.approx(number(elevator(), "torque_max"))


def test_a_check_of_a_row_judges_each_part() -> None:
    made = {check.id: check for check in check_results(elevator(pulleys=[*reversed(MACHINE["pulleys"])]))}
    assert made["pulley_load"].demand == pytest.approx(4354, rel=1e-3)


def test_a_check_of_a_curve_fails_where_its_greatest_value_is_too_great() -> None:
    made = {check.id: check.status for check in check_results(elevator(allowable_torque="240 N*m"))}
    assert made["torque"] == "fail"
