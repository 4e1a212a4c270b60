"""Any knife: what must hold whatever its links are, and many knives at once."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from diecut_report.engine import Impossible, calculate
from diecut_report.expressions import Array
from diecut_report.plugins.knife_drive import MECHANISM
from tests.machines import inputs, number
from tests.plugins.test_knife_drive import INNER, OMEGA, OUTER, PLANETARY, SLIDER, at, knife


@given(
    crank=st.floats(10, 30), coupler=st.floats(60, 160), rocker=st.floats(40, 120), frame=st.floats(60, 160),
    arm=st.floats(60, 200), share=st.floats(0.05, 0.98), side=st.sampled_from(["outer", "inner"]),
)  # fmt: skip
@settings(max_examples=60, deadline=None)
def test_any_crank_rocker_covers_the_depth_in_its_working_stroke(
    crank: float, coupler: float, rocker: float, frame: float, arm: float, share: float, side: str
) -> None:
    longest = max(coupler, rocker, frame)
    assume(crank < min(coupler, rocker, frame) - 1 and crank + longest < coupler + rocker + frame - longest - 2)
    keys = {"crank": crank, "coupler": coupler, "rocker": rocker, "frame": frame, "knife_arm": arm}
    try:
        whole = knife(crank_rocker=keys | {"lowest_dead_center": side}, working_depth=1, grip_angle=0.01)
        depth = share * number(whole, "crank_rocker_stroke")
        calc = knife(crank_rocker=keys | {"lowest_dead_center": side}, working_depth=f"{depth!r} m", grip_angle=0.01)
    except Impossible as refused:
        assert refused.key == "working_depth"
        return
    nodes, weights = np.polynomial.legendre.leggauss(200)
    lowest, angle = number(calc, "crank_rocker_lowest_angle"), number(calc, "crank_rocker_working_angle")
    phi = lowest - angle / 2 + angle / 2 * nodes
    velocity, acceleration = (at(calc, f"crank_rocker_{name}", phi) for name in ("velocity", "acceleration"))
    assert (velocity < 0).all()
    assert np.sum(velocity * weights) * angle / 2 / OMEGA == pytest.approx(-depth, rel=1e-8)
    braked = np.sum(acceleration * weights) * angle / 2 / OMEGA
    assert braked == pytest.approx(number(calc, "crank_rocker_contact_velocity"), rel=1e-6, abs=1e-6)


@given(radius=st.floats(20, 100), ratio=st.floats(1.01, 8), share=st.floats(0.05, 1))
@settings(max_examples=60, deadline=None)
def test_any_crank_slider_stands_at_the_depth_at_contact(radius: float, ratio: float, share: float) -> None:
    rod, depth = radius * ratio, 2 * radius * share
    calc = knife(crank_slider={"crank_radius": radius, "rod_length": rod}, working_depth=depth, grip_angle=0.01)
    angle = number(calc, "crank_slider_working_angle")
    reach = radius * np.cos(angle) + np.sqrt(rod**2 - (radius * np.sin(angle)) ** 2)
    assert radius + rod - reach == pytest.approx(depth, rel=1e-7)


def random_machines(count: int) -> dict[str, Array]:
    """Machines as a designer might vary them, some of them impossible."""
    draw = np.random.default_rng(4)
    return {
        "working_depth": draw.uniform(0.005, 0.06, count),
        "cylinder_rate": draw.uniform(2, 12, count),
        "planetary.carrier_radius": draw.uniform(0.012, 0.08, count),
        "crank_slider.crank_radius": draw.uniform(0.02, 0.05, count),
        "crank_slider.rod_length": draw.uniform(0.045, 0.2, count),
        "crank_rocker.crank": draw.uniform(0.012, 0.04, count),
        "crank_rocker.knife_arm": draw.uniform(0.08, 0.25, count),
        "grip_angle": draw.uniform(0.02, 0.2, count),
    }


@pytest.mark.parametrize("rocker", [OUTER, INNER], ids=["outer", "inner"])
def test_many_variants_at_once_are_as_many_single_runs(rocker: dict[str, Any]) -> None:
    keys = {"working_depth": 40, "signature_length": 273, "n_points": 72}
    base = inputs(MECHANISM, keys | PLANETARY | SLIDER | rocker)
    varied, count = random_machines(60), 60
    together = calculate(MECHANISM, base | varied, variants=count)
    assert 3 < len(together.flaws) < 45
    names = [name for name, values in together.values.items() if values.shape == (count, 1)]
    for i in range(count):
        single = base | {name: float(values[i]) for name, values in varied.items()}
        if i in together.flaws:
            with pytest.raises(Impossible):
                calculate(MECHANISM, single)
            continue
        alone = calculate(MECHANISM, single)
        for name in names:
            value, expected = together[name][i, 0], alone[name][0, 0]
            same = (
                value == expected
                if isinstance(expected, str)
                else value == pytest.approx(expected, rel=1e-7, abs=1e-6 if name.endswith("_at") else 1e-12)
            )
            assert same, name
