"""Verdicts of many machines are those of each alone; of a self-test the rounding may be another, not the verdict."""

from __future__ import annotations

import numpy as np
import pytest

from diecut_report.api import Chapter, Check, Inputs, Mechanism, Quantity, abscissa, computed, m, samples
from diecut_report.machine.steps.run import calculate
from diecut_report.mechanism.checks import CheckClass
from diecut_report.mechanism.steps import Computed
from diecut_report.testing.contract import constant
from diecut_report.testing.machines import MachineCase, unlike_curves, unlike_verdicts
from tests.declaration.test_faults import check, made


class Rounded(Inputs):
    """An input that only says how many machines there are."""

    length = Quantity("l", "mm", "Length", gt=0, default=10)


def differences(check_class: CheckClass, each: float) -> list[str]:
    """The checks that differ between three machines together and one alone; their error grows with their number."""
    chapter = Chapter("Error")
    chapter.error = (
        computed(lambda length: np.full(length.shape, each * len(length)), ("length",), "made up"),
        "e",
        "1",
        "Error",
    )
    check = Check("error", check_class, "Error", "error", 1e-9, unit="1", demand_label="error", limit_label="accepted",
                  consequence="it is wrong.")  # fmt: skip
    rounded = Mechanism(
        kind="rounded", version="1", title="Rounded", summary="", inputs=Rounded, chapters=(chapter,), checks=(check,)
    )
    together, alone = (
        calculate(rounded, {"length": np.array([0.01, 0.02, 0.03])}, 3),
        calculate(rounded, {"length": 0.01}),
    )
    return [id for id, _ in unlike_verdicts(together, alone, 0)]


@pytest.mark.parametrize(("check_class", "each", "found"), [
    ("numerical", 1e-13, []), ("practice", 1e-13, ["error"]), ("numerical", 6e-10, ["error"]),
])  # fmt: skip
def test_a_self_test_compares_rounding_which_is_not_the_same_twice(
    check_class: CheckClass, each: float, found: list[str]
) -> None:
    assert differences(check_class, each) == found


class Turned(Inputs):
    """A length on a turn."""

    length = Quantity("l", "mm", "Length", gt=0, default=10)
    n_points = samples(36)


@pytest.mark.parametrize(("size", "found"), [(1e-15, []), (1e-6, ["apart"])])
def test_a_curve_that_is_rounding_beside_its_quantities_may_be_another_one(size: float, found: list[str]) -> None:
    """As the difference of a formula and its derivative; the one here grows with the number of machines."""
    chapter = Chapter("A turn")
    chapter.turn = abscissa(2 * np.pi), "φ", "deg", "Turn"
    chapter.offset = (
        computed(lambda length: np.full(length.shape, size * len(length)), ("length",), "made up"),
        "o",
        "mm",
        "Offset",
    )
    chapter.apart = m.offset * np.cos(m.turn), "Δ", "mm", "Difference"
    turned = Mechanism(kind="turned", version="1", title="", summary="", inputs=Turned, chapters=(chapter,))
    many = calculate(turned, {"length": np.array([0.01, 0.02, 0.03]), "n_points": 36}, 3)
    alone = calculate(turned, {"length": 0.01, "n_points": 36})
    assert [name for name, _ in unlike_curves(many, alone, 0)] == found


# A check whose verdict is the same for every machine is noted.


def test_a_check_that_no_machine_fails_is_noted_and_one_that_some_fail_is_not() -> None:
    sound = made(
        Computed(
            id="nothing",
            symbol="n",
            unit="N*m",
            description="Nothing",
            function=lambda arm: arm - arm,
            takes=("arm",),
            method="m",
        ),
        checks=(
            check(limit=0.06),
            check(id="never", limit=1e9),
            check(id="always", limit=0.0),
            check(id="assumed", limit=1e9, presumed=True),
            check(id="two_ways", check_class="numerical", limit=1e9),
            check(id="zero", check_class="numerical", demand="nothing", limit=1e9),
        ),
    )
    found = dict(constant(MachineCase(sound, {"force": 5.0, "arm": 0.01, "mode": "near", "n_points": 36}), 80, 1))
    assert set(found) == {"never", "always", "zero"}
    assert "passes in all 80" in found["never"] and "fails in all 80" in found["always"]
