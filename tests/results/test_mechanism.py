"""The results of one mechanism: errata of the sources that touch it, and phases that are not longer than their period."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
import pytest

from diecut_report.api import Chapter, Erratum, Inputs, Mechanism, Quantity, Source, abscissa, computed, m, samples
from diecut_report.machine.calculation import Calculation, Unproven
from diecut_report.machine.steps.run import calculate
from diecut_report.plugins.damper import MECHANISM
from diecut_report.results.mechanism import mechanism_results, phases
from tests.machines import inputs

ERRATA = (
    Erratum("002", "always", ("stress",)),
    Erratum("002", "with a drive", ("driven_stress",)),
    Erratum("002", "in part with a drive", ("driven_stress", "strain")),
    Erratum("002", "a limit of the drive", ("driven_free_length",)),
    Erratum("002", "an input", ("ring_width",)),
    Erratum("002", "the whole paper"),
)
BLOCK = {"kinetic_energy": 30, "shore_hardness": 70, "ring_width": "60 mm", "pad_height": "50 mm"}
LEFT_OUT = {"with a drive", "a limit of the drive"}


def errata(**more: Any) -> dict[str, list[str]]:
    """What the results of a damper with made-up errata tell of each."""
    mechanism = dataclasses.replace(MECHANISM, errata=ERRATA, sources=(Source("002", "A paper."),))
    found = mechanism_results(calculate(mechanism, inputs(mechanism, BLOCK | more)), {}).errata
    return {erratum.text: erratum.touches for erratum in found}


def test_an_erratum_stands_where_the_machine_has_a_quantity_that_it_touches() -> None:
    assert errata(drive={"force": 300}).keys() == {erratum.text for erratum in ERRATA}


def test_an_erratum_whose_quantities_are_all_absent_is_left_out() -> None:
    found = errata()
    assert found.keys() == {erratum.text for erratum in ERRATA} - LEFT_OUT
    assert found["in part with a drive"] == ["Maximum strain"]


@pytest.mark.parametrize("force", [2900, 3100])
def test_a_quantity_that_does_not_apply_is_absent(force: float) -> None:
    """From 3 kN on, half of what two pads of 3000 mm² bear at 1 MPa, no length bears the drive."""
    assert ("a limit of the drive" in errata(drive={"force": force})) is (force < 3000)


# Ends that plain code gives in degrees would make a phase all of the turn.


class Cam(Inputs):
    rise = Quantity("φ_r", "deg", "Rise", gt=0)
    n_points = samples(36)


def cam(rise: float | list[float], start: float, way: float = 1.0) -> Calculation:
    chapter = Chapter("Turn")
    chapter.angle = abscissa(2 * np.pi), "φ", "deg", "Angle"
    chapter.start = computed(lambda rise: 0 * rise + start, ("rise",), "it is so"), "φ_1", "deg", "Start"
    chapter.end = m.start + way * m.rise, "φ_2", "deg", "End"
    chapter.phase("rising", "working", "The follower rises", "angle", ("start", "end"))
    mechanism = Mechanism(kind="cam", version="1", title="Cam", summary="", inputs=Cam, chapters=(chapter,))
    count = len(rise) if isinstance(rise, list) else 1
    return calculate(mechanism, {"rise": np.array(rise) if isinstance(rise, list) else rise, "n_points": 36}, count)


@pytest.mark.parametrize("rise", [0.5, np.pi, 2 * np.pi])
@pytest.mark.parametrize("start", [0.0, 1.0, 100.0])
def test_a_phase_up_to_a_whole_turn_is_one(rise: float, start: float) -> None:
    ((begin, end),) = phases(cam(rise, start))["rising"].intervals
    assert end - begin == pytest.approx(rise) and 0 <= begin < 2 * np.pi


def test_a_longer_one_is_refused() -> None:
    with pytest.raises(
        Unproven,
        match=r"The follower rises \(rising\) has ends 8594° apart, more than its period of 360°; ends that plain code gives are in SI",
    ):
        cam(150.0, 0.0)
    made = cam([1.0, 150.0, 2.0, 40.0], 0.0)
    assert sorted(made.flaws) == [1, 3] and "2292° apart" in made.flaws[3][1]


def test_ends_in_degrees_over_the_seam_are_refused_as_well() -> None:
    """From 350 to 10 it would have no length at all, and be no phase."""
    with pytest.raises(Unproven, match="has ends 19481° apart"):
        cam(340.0, 350.0, -1.0)
    ((begin, end),) = phases(cam(np.radians(340), np.radians(350), -1.0))["rising"].intervals
    assert np.degrees([begin, end]) == pytest.approx([350, 370])
