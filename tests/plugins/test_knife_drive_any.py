"""Any knife: what must hold whatever its links are, and many knives at once."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from diecut_report.machine.calculation import Impossible
from tests.examples import examples
from tests.machines import number
from tests.plugins.test_knife_drive import OMEGA, at, knife


@given(
    crank=st.floats(10, 30), coupler=st.floats(60, 160), rocker=st.floats(40, 120), frame=st.floats(60, 160),
    arm=st.floats(60, 200), share=st.floats(0.05, 0.98), side=st.sampled_from(["outer", "inner"]),
)  # fmt: skip
@examples(60)
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


@given(radius=st.floats(20, 100), ratio=st.floats(1.01, 8), share=st.floats(0.05, 0.999))
@examples(60)
def test_any_crank_slider_stands_at_the_depth_at_contact(radius: float, ratio: float, share: float) -> None:
    rod, depth = radius * ratio, 2 * radius * share
    calc = knife(crank_slider={"crank_radius": radius, "rod_length": rod}, working_depth=depth, grip_angle=0.01)
    angle = number(calc, "crank_slider_working_angle")
    reach = radius * np.cos(angle) + np.sqrt(rod**2 - (radius * np.sin(angle)) ** 2)
    assert radius + rod - reach == pytest.approx(depth, rel=1e-7)
