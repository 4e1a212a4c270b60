"""The sector's motion that arms are sought for obeys mechanics by itself; the words name what is found; an arm that passes stays."""

from __future__ import annotations

import numpy as np
import pytest

from diecut_report.mechanics.motion_laws import LAWS
from diecut_report.plugins.cam_gear_transport import arms
from diecut_report.plugins.cam_gear_transport.steps import rolling

DEGREE = np.pi / 180


def rocker(law: str, held: float = 40, stop: float = 15) -> arms.Rocker:
    """A sector with these sweeps in degrees."""
    return arms.Rocker(np.radians(200), np.radians(held), np.radians(stop), LAWS[law].B, LAWS[law].A, 0.01, 0.12, 0.06, 0.015,
                       1.5, 4.0, np.radians(45))  # fmt: skip


@pytest.mark.parametrize("law", ["cycloidal", "modified_sine"])
def test_speeds_and_accelerations_of_the_sector_are_those_of_its_angle(law: str) -> None:
    machine = rocker(law)
    cycle, count = arms.motion(machine), len(arms.PLACES)
    angle, speed, bend = cycle.angle[count:], cycle.turn[count:] - 1, cycle.bend[count:]
    middle = len(angle) // 2
    for part in (slice(0, middle), slice(middle, None)):  # stop and start, return
        dealt = np.concatenate([[0], np.cumsum((bend[part][1:] + bend[part][:-1]) / 2 * np.diff(angle[part]))])
        assert speed[part] ** 2 / 2 - speed[part][0] ** 2 / 2 == pytest.approx(dealt, abs=2e-3 * max(speed[part] ** 2))
    highest, lowest = machine.held + machine.stop / 2, -machine.stop / 2  # half a stop beyond each end of what is held
    assert angle[[0, middle - 1, middle, -1]] == pytest.approx([lowest, highest, highest, lowest], abs=1e-12)
    steady = cycle.turn[:count] - 1
    assert cycle.angle[count - 1] == pytest.approx(steady[0] * machine.dwell) and np.ptp(steady) == 0


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({"arm_length": "80 mm", "arm_angle_1": "70°"},
         "take an arm_length of 80 mm, an arm_angle_1 of 70°: the greatest pressure angle is then 30° (shorter arms raise the roller forces)"),
        ({"sector_dwell_sweep": "20°", "arm_angle_1": "70°"},
         "take a sector_dwell_sweep of 20°, an arm_angle_1 of 70°: the greatest pressure angle is then 30°"),
    ],
)  # fmt: skip
def test_the_words_have_their_articles_and_warn_of_shorter_arms_alone(values: dict[str, str], words: str) -> None:
    assert str(arms._told(values, 30 * DEGREE)) == words


@pytest.mark.parametrize("place", [20, 80, 110, -80, -130])
def test_an_arm_that_passes_stays_where_it_is(place: float) -> None:
    machine = rocker("cycloidal", held=10, stop=3)._replace(accepted=np.radians(88))
    left, arm = place > 0, place * DEGREE
    assert arms._best(machine, arms.motion(machine), machine.arm_length, arm, left)[0] == pytest.approx(place)


def test_wheels_of_one_tooth_are_some_and_of_none_are_not() -> None:
    (rule,) = [step for step in rolling.steps if step.id == "some_teeth"]
    condition = rule.condition.function
    assert [bool(condition(one, other)) for one, other in ((1, 9), (9, 1), (0, 9), (9, 0))] == [
        True,
        True,
        False,
        False,
    ]


def test_where_no_whole_degree_passes_a_tenth_does(monkeypatch: pytest.MonkeyPatch) -> None:
    """Stands for a machine whose pressure angle is the accepted one but at 37.3°, and by 0.2° to either side."""
    machine = rocker("cycloidal")
    accepted = machine.accepted - arms.CLEAR

    def steep(_: object, __: object, ___: float, places: np.ndarray) -> np.ndarray:
        return np.asarray(accepted + abs(places - 37.3 * DEGREE) - 0.2 * DEGREE)

    monkeypatch.setattr(arms, "pressure_angles", steep)
    found = arms._best(machine, arms.motion(machine), machine.arm_length, 100 * DEGREE, True)
    assert found == (37.3, pytest.approx(accepted - 0.2 * DEGREE, rel=1e-9))
