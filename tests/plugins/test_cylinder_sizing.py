"""The impression cylinder against brute-force integration of its section, and its impossible machines."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

from diecut_report.machine.calculation import Impossible
from diecut_report.machine.steps.run import calculate
from diecut_report.plugins.cylinder_sizing import MECHANISM
from diecut_report.results.mechanism import mechanism_results
from diecut_report.results.mechanism_record import CheckRecord
from tests.examples import examples
from tests.machines import cylinder, inputs, number


def strips(radius: float, flat: float, bore: float, moment: Any) -> float:
    """∫ of a moment over the section, strip by strip parallel to the flat, which lies at y = −flat.

    ``moment(y, half_width)`` is that of a strip from −half_width to half_width; the bore's strip is taken away.
    """

    def strip(y: float) -> float:
        outer = moment(y, np.sqrt(max(radius**2 - y**2, 0)))
        return float(outer - (moment(y, np.sqrt(bore**2 - y**2)) if abs(y) < bore else 0))

    breaks = sorted({-flat, max(-bore, -flat), 0.0, bore, radius})
    return sum(quad(strip, a, b, epsabs=0, epsrel=1e-11, limit=400)[0] for a, b in pairwise(breaks) if b > a)


SECTIONS = [(105, 40, 70), (105, 40, 50), (105, 40, 0), (105, 60, 90), (200, 20, 150), (105, 104, 30)]


@pytest.mark.parametrize("radius, height, bore", SECTIONS)
def test_mass_inertia_and_unbalance_are_the_integrals_over_the_section(
    radius: float, height: float, bore: float
) -> None:
    calc = cylinder(
        radius=f"{radius} mm",
        segment_height=f"{height} mm",
        bore_radius=f"{bore} mm",
        working_length="700 mm",
        bearing_span="900 mm",
    )
    r, d, b = radius / 1e3, (radius - height) / 1e3, bore / 1e3
    prism = 7800 * 0.7
    area = strips(r, d, b, lambda y, w: 2 * w)
    first = strips(r, d, b, lambda y, w: 2 * w * y)
    about_x = strips(r, d, b, lambda y, w: 2 * w * y**2)
    about_y = strips(r, d, b, lambda y, w: 2 * w**3 / 3)
    assert number(calc, "mass") == pytest.approx(prism * area, rel=1e-9)
    assert number(calc, "inertia") == pytest.approx(prism * (about_x + about_y), rel=1e-9)
    assert number(calc, "static_unbalance") == pytest.approx(prism * first, rel=1e-9)
    assert number(calc, "center_of_mass_offset") == pytest.approx(first / area, rel=1e-9)
    least = min(about_x - first**2 / area, about_y)
    assert number(calc, "second_moment_min") == pytest.approx(least, rel=1e-9)


def test_the_deflection_is_that_of_the_integrated_bending_line() -> None:
    calc = cylinder(bearing_span="900 mm", line_load="30 N/mm", elastic_modulus="210 GPa")
    span, length, load = 0.9, 0.7, 30e3
    x = np.linspace(0, span, 200_001)
    start = (span - length) / 2
    moment = load * length / 2 * x - load / 2 * np.clip(x - start, 0, length) ** 2
    moment -= load * length * np.clip(x - start - length, 0, None)
    stiffness = 210e9 * number(calc, "second_moment_min")
    step = x[1]
    slope = np.concatenate([[0], np.cumsum((moment[1:] + moment[:-1]) / 2 * step)]) / stiffness
    bent = np.concatenate([[0], np.cumsum((slope[1:] + slope[:-1]) / 2 * step)])
    middle = bent[-1] / 2 - bent[len(x) // 2]
    assert number(calc, "deflection") == pytest.approx(middle, rel=1e-8)
    assert number(calc, "bending_moment") == pytest.approx(moment.max(), rel=1e-9)


@given(working=st.floats(50, 3000), share=st.floats(0.001, 0.97))
@examples(60)
def test_the_sized_radius_is_the_exact_one_rounded_up(working: float, share: float) -> None:
    height = share * working / np.pi
    keys = {"working_length": working, "segment_height": height, "generatrix_length": 500}
    calc = calculate(MECHANISM, inputs(MECHANISM, keys))
    exact, adopted = number(calc, "radius_exact") * 1e3, number(calc, "radius") * 1e3
    flat_arc = 2 * exact * np.arccos((exact - height) / exact)
    assert 2 * np.pi * exact - flat_arc == pytest.approx(working, rel=1e-9)
    assert -1e-6 < adopted - exact < 0.5 + 1e-6
    assert adopted / 0.5 == pytest.approx(round(adopted / 0.5), abs=1e-6)


def test_a_radius_that_is_a_multiple_of_the_step_stays() -> None:
    radius, height = 500.5, 100.0
    working = 2 * np.pi * radius - 2 * radius * np.arccos((radius - height) / radius)
    keys = {"working_length": float(working), "segment_height": height, "generatrix_length": 500}
    assert number(calculate(MECHANISM, inputs(MECHANISM, keys)), "radius") == pytest.approx(0.5005, abs=1e-12)


@pytest.mark.parametrize(
    "changes, key, words",
    [
        ({"segment_height": "150 mm"}, "segment_height", "149.8 mm"),
        ({"radius": "39 mm"}, "segment_height", "lower than the radius"),
        ({"bore_radius": "105 mm"}, "bore_radius", "narrower than the cylinder"),
        ({"bore_radius": "200 mm"}, "bore_radius", "R = 105 mm"),
        ({"bearing_span": "600 mm"}, "bearing_span", "700 mm"),
    ],
)
def test_an_impossible_cylinder_is_refused_in_words(changes: dict[str, str], key: str, words: str) -> None:
    with pytest.raises(Impossible) as refused:
        cylinder(**changes)
    assert refused.value.key == key
    assert words in refused.value.message


def test_a_wall_of_exactly_nothing_fails_without_a_utilisation() -> None:
    checks = {c.id: c for c in mechanism_results(cylinder(bore_radius="65 mm"), {}).checks}
    assert (checks["wall_at_flat"].status, checks["wall_at_flat"].utilisation) == ("fail", None)


def verdicts(**changes: Any) -> dict[str, CheckRecord]:
    """The checks of the published cylinder with changes."""
    return {c.id: c for c in mechanism_results(cylinder(**changes), {}).checks}


@pytest.mark.parametrize(("bore", "status"), [("64.9 mm", "pass"), ("65 mm", "fail"), ("70 mm", "fail")])
def test_the_bending_of_a_closed_section_is_not_believed_of_an_open_one(bore: str, status: str) -> None:
    found = verdicts(bore_radius=bore, bearing_span="860 mm")
    assert found["closed_section"].status == status
    assert "closed_section" not in verdicts(bore_radius=bore)
