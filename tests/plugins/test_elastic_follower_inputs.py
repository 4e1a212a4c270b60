"""What the elastic follower refuses, in which words; and what it takes at the ends of its ranges."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from diecut_report.api import Chapter, Inputs, Mechanism, Quantity, formula, m
from diecut_report.config.plugins import Discovery
from diecut_report.errors import UserError
from diecut_report.machine.calculation import Calculation, Impossible
from diecut_report.machine.steps.run import calculate
from diecut_report.mechanism.steps import Abscissa, Breakpoints, Value
from diecut_report.press import Press
from tests.configs import HEAD, saved
from tests.examples import few
from tests.machines import number
from tests.plugins.followers import driven, follower

TURNING: dict[str, Any] = {"inertia": 0.8, "stiffness": 5200, "rise": "1.2 rad", "rise_time": "0.2 s"}
SLIDING: dict[str, Any] = {"mass": 0.8, "stiffness": "5200 N/m", "rise": "20 mm", "rise_time": "0.2 s"}
BY_CURVE: dict[str, Any] = {"inertia": 0.8, "stiffness": 5200, "cycles_per_hour": 6000, "motion_curve": "${t.gear_angle}"}  # fmt: skip
OTHERS = {
    "t": "{kind: cam_gear_transport, dwell_angle: 160 deg, center_distance: 300 mm, sprocket_teeth: 20, chain_pitch: 25.4 mm}",
    "k": "{kind: knife_drive, working_depth: 40, crank_slider: {crank_radius: 35, rod_length: 140}}",
    "o": "{kind: elastic_follower, inertia: 0.8, stiffness: 5200, rise: 1 rad, rise_time: 0.2 s, damping_ratio: 0}",
}


def config(folder: Path, keys: dict[str, Any], changes: dict[str, Any]) -> Path:
    """A file with the follower ``f`` and the machine that it refers to; None leaves a key out."""
    given = {key: value for key, value in (keys | changes).items() if value is not None}
    other = str(given.get("motion_curve"))[2:3]
    beside = f"  {other}: {OTHERS[other]}\n" if other in OTHERS else ""
    own = "".join(f"    {key}: {value}\n" for key, value in given.items())
    return saved(folder, f"{HEAD}{beside}  f:\n    kind: elastic_follower\n{own}")


def stiffness(ratio: float) -> str:
    """The stiffness with so many natural periods within 0.2 s."""
    return f"{0.8 * (2 * np.pi * ratio / 0.2) ** 2!r} N*m/rad"


REFUSED = [
    (TURNING, {"stiffness": None}, "f.stiffness: is missing. Give it in N·m/rad"),
    (TURNING, {"inertia": None}, "f: inertia, or mass is needed"),
    (TURNING, {"mass": 3}, "f: inertia and mass are both given, but only one can hold"),
    (TURNING, {"stiffness": "5200 N/m"}, "f.stiffness: 5200 N/m is a line force or stiffness; an angular stiffness is needed"),
    (TURNING, {"rise": "20 mm"}, "f.rise: 20 mm is a length; an angle is needed"),
    (TURNING, {"inertia": "3 kg"}, "f.inertia: 3 kg is a mass; a moment of inertia is needed"),
    (SLIDING, {"stiffness": "5200 N*m/rad"}, "f.stiffness: 5200 N*m/rad is an angular stiffness"),
    (SLIDING, {"rise": "1 rad"}, "f.rise: 1 rad is an angle; a length is needed"),
    (TURNING, {"rise_time": 1.5, "cycles_per_hour": 6000}, "f.rise_time: is 1.5, more than the cycle"),
    (TURNING, {"cycles_per_hour": 6000}, "f.rise_time: 0.2 s is a time; a pure number is needed"),
    (TURNING, {"rise_time": 0.5, "cycles_per_hour": "100 rpm"}, "f.cycles_per_hour: 100 rpm is an angular speed"),
    (TURNING, {"rise_time": None}, "f: rise_time is missing beside rise"),
    (TURNING, {"rise": None}, "f: rise is missing beside rise_time"),
    (TURNING, {"rise": None, "rise_time": None}, "f: rise and rise_time, or motion_curve is needed"),
    (BY_CURVE, {"rise": "1 rad"}, "f: rise and motion_curve are both given, but only one can hold"),
    (BY_CURVE, {"rise_time": 0.3}, "f: rise_time has no use beside motion_curve"),
    (BY_CURVE, {"motion_law": "harmonic"}, "f: motion_law has no use beside motion_curve"),
    (BY_CURVE, {"cycles_per_hour": None}, "f.motion_curve: runs over disc_angle, in °; give cycles_per_hour"),
    (BY_CURVE, {"motion_curve": "${t.gear_speed_peak}"}, "f.motion_curve: ${t.gear_speed_peak} is not a curve in rad"),
    (BY_CURVE, {"motion_curve": "${t.sheet_position}"}, "f.motion_curve: ${t.sheet_position} is not a curve in rad"),
    (BY_CURVE, {"inertia": None, "mass": 1}, "f.motion_curve: ${t.gear_angle} is not a curve in m"),
    (BY_CURVE, {"motion_curve": 3}, "f.motion_curve: is 3; a reference to a curve in rad is needed"),
    (BY_CURVE, {"motion_curve": "[0, 1, 1, 0, 0]"}, "f.motion_curve: is [0, 1, 1, 0, 0]; a reference to a curve"),
    (BY_CURVE, {"motion_curve": "gear_angle"}, "f.motion_curve: is 'gear_angle'; a reference to a curve"),
    (BY_CURVE, {"motion_curve": "${t.gear_angel}"}, "did you mean 'gear_angle'?"),
    (BY_CURVE, {"motion_curve": "${q.gear_angle}"}, "there is no mechanism 'q'"),
    (BY_CURVE, {"motion_curve": "${f.response}"}, "refers to itself: f.motion_curve → f.response → f.motion_curve"),
    (BY_CURVE, {"motion_curve": "${t.sector_angle}"}, "f.motion_curve: never rests within its period"),
    (BY_CURVE, {"motion_curve": "${t.disc_angle}"}, "f.motion_curve: never rests within its period"),
    (BY_CURVE, {"motion_curve": "${o.response}", "cycles_per_hour": None}, "f.motion_curve: never rests within its period"),
    (BY_CURVE, {"motion_curve": "${k.crank_slider_displacement}", "inertia": None, "mass": 1, "cycles_per_hour": "50000 1/h"},
     "f.motion_curve: never rests"),
    (BY_CURVE, {"cycles_per_hour": "3000 1/h"}, "f.cycles_per_hour: is 3000 1/h, but the curve that motion_curve refers to comes again at 6000 1/h"),
    (BY_CURVE, {"stiffness": 1e-3}, "f.stiffness: leaves 0.001876 natural periods within the rise; at least 0.1"),
    (TURNING, {"stiffness": stiffness(0.0999)}, "f.stiffness: leaves 0.0999 natural periods within the rise; at least 0.1"),
    (TURNING, {"stiffness": stiffness(50.02)}, "f.stiffness: leaves 50.02 natural periods within the rise; with more than 50"),
    (TURNING, {"stiffness": 1e200}, "natural periods within the rise; with more than 50"),
    (TURNING, {"inertia": 1e200}, "natural periods within the rise; at least 0.1"),
    (TURNING, {"motion_law": "cyclodial"}, "f.motion_law: is “cyclodial” (did you mean 'cycloidal'?); allowed: cycloidal, harmonic"),
]  # fmt: skip


@pytest.mark.parametrize("keys, changes, words", REFUSED, ids=lambda part: str(part)[:60])
def test_bad_inputs_are_told_in_words(
    tmp_path: Path, keys: dict[str, Any], changes: dict[str, Any], words: str
) -> None:
    with pytest.raises(UserError) as refused:
        Press.read(config(tmp_path, keys, changes), Discovery([])).calculate()
    assert words in "\n".join(map(str, refused.value.problems))


def test_wrong_form_and_wrong_key_are_told_together(tmp_path: Path) -> None:
    with pytest.raises(UserError) as refused:
        Press.read(config(tmp_path, TURNING, {"mass": 3, "damping_ratio": 2}), Discovery([])).calculate()
    told = "\n".join(map(str, refused.value.problems))
    assert "both given" in told and "f.damping_ratio" in told


POSSIBLE: list[tuple[dict[str, Any], dict[str, Any]]] = [
    (SLIDING, {}), (TURNING, {"damping_ratio": 0.999999}), (TURNING, {"stiffness": stiffness(0.1001)}), (TURNING, {"rise": "1e150 rad"}),
    (BY_CURVE, {"motion_curve": "${t.sheet_position}", "inertia": None, "mass": 1}),
]  # fmt: skip
AT_NIGHT: list[tuple[dict[str, Any], dict[str, Any]]] = [  # other tests calculate them, or the like
    (TURNING, {}), (BY_CURVE, {}), (BY_CURVE, {"motion_curve": "${o.input}"}), (BY_CURVE, {"motion_curve": "${o.input}", "cycles_per_hour": None}),
    (SLIDING, {"stiffness": 5200, "rise": 0.02}), (TURNING, {"rise_time": 1, "cycles_per_hour": 6000}), (TURNING, {"dwell_cycles": 50}),
    (TURNING, {"stiffness": stiffness(49.99)}), (TURNING, {"rise": "1e-150 rad"}),
]  # fmt: skip


@pytest.mark.usefixtures("without_advice")
@pytest.mark.parametrize(
    "keys, changes",
    few([*POSSIBLE, *AT_NIGHT], keep=lambda machine: machine in POSSIBLE),
    ids=lambda part: str(part)[:60],
)
def test_what_is_possible_is_calculated(tmp_path: Path, keys: dict[str, Any], changes: dict[str, Any]) -> None:
    outcome = Press.read(config(tmp_path, keys, changes), Discovery([])).calculate()
    found = outcome.results.mechanisms["f"]
    assert not found.error
    assert 0.1 <= found.outputs["tuning_ratio"].value <= 50
    assert found.outputs["torque_peak"].unit == ("N" if "mass" in keys | changes else "N*m")
    assert found.curves["response"].unit == ("m" if "mass" in keys | changes else "rad")


@pytest.mark.parametrize("size", [1e-150, 1e-9, 1e9, 1e150])
def test_numbers_of_any_size_give_the_same_ratios(size: float) -> None:
    known = follower()
    others = [
        follower(inertia=0.8 * size, stiffness=5200 * size),
        follower(rise=1.2 * size),
        follower(rise_time=0.2 * size**0.5, stiffness=5200 / size),
    ]
    for calc in others:
        for name in ("peak_ratio", "residual_ratio", "overshoot", "tuning_ratio"):
            assert number(calc, name) == pytest.approx(number(known, name), rel=1e-10)


# --- motions that no drive can make ----------------------------------------------------------------------------------


class Turn(Inputs):
    """Samples alone."""

    n_points = Quantity("N", "1", "Samples", ge=36, integer=True, default=90)


same = formula(lambda angle: angle)


@pytest.mark.parametrize("curve", ["response", "acceleration", "deflection"])
def test_what_swings_on_never_rests(curve: str) -> None:
    with pytest.raises(Impossible, match="never rests") as refused:
        driven(follower(damping_ratio=0), curve)
    assert refused.value.key == "motion_curve"


standing = formula(lambda angle: 3 + 0 * angle)
hasty_start = formula(lambda angle, middle: np.where(middle < 2, angle - angle**2 / 4, 1))
hasty_end = formula(lambda angle, middle: np.where(middle < 2, 0, (angle - 2) ** 2))


@formula
def hasty_inside(angle: Any, middle: Any) -> Any:
    return np.where(middle < 2, 0, np.where(middle < 4, (angle - 2) ** 2 * (3 - angle / 2) / 2, 2 - (angle - 4) / 9))


@formula
def leaping(angle: Any, middle: Any) -> Any:
    return np.where(middle < 2, 0, np.where(middle < 4, 1 + angle * 0, 1 + (angle - 4) ** 2 * (5 - angle)))


at_two = formula(lambda: 2)
at_four = formula(lambda: 4)


def shaped(shape: Any) -> Calculation:
    """A toy whose place has joints at 2 and 4 rad of the turn."""
    steps = (
        Value(id="two", symbol="a", unit="rad", description="Two", formula=at_two),
        Value(id="four", symbol="b", unit="rad", description="Four", formula=at_four),
        Abscissa(id="angle", symbol="φ", unit="rad", description="Angle", period=2 * np.pi),
        Breakpoints(id="joints", abscissa="angle", places=("two", "four")),
        Value(id="middle", symbol="m", unit="rad", description="Middle", per_piece=True, formula=same.of(angle=m.angle)),
        Value(id="place", symbol="y", unit="rad", description="Place", formula=shape),
    )  # fmt: skip
    toy = Mechanism(
        kind="shaped", version="1", title="Shaped", summary="A place.", inputs=Turn, chapters=(Chapter("Motion", steps=steps),)
    )  # fmt: skip
    return calculate(toy, {"n_points": 90})


@pytest.mark.parametrize(
    "shape, words",
    [
        (standing, "does not move"),
        (hasty_start, "jumps in its position or speed"),
        (hasty_end, "jumps in its position or speed"),
        (hasty_inside, "jumps in its position or speed"),
        (leaping, "jumps in its position or speed"),
    ],
    ids=["standing", "starts at speed where the turn begins", "stops at speed where it ends", "corner", "leap"],
)
def test_a_motion_that_no_drive_can_make_is_refused(shape: Any, words: str) -> None:
    with pytest.raises(Impossible, match=words) as refused:
        driven(shaped(shape), "place", cycles_per_hour=6000)
    assert refused.value.key == "motion_curve"
