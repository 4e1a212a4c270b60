"""Ratio, radii, axes and chains, by other ways than their formulas: teeth counted round a circle, a chain laid round a polygon."""

from __future__ import annotations

from cmath import exp
from math import cos, pi, radians

import pytest

from diecut_report.mechanics import drive_line


def test_each_tooth_of_both_gears_passes_the_mesh() -> None:
    revolutions = drive_line.speed_ratio(driving=24, driven=48)
    assert pytest.approx(48 * revolutions) == 24 * 1.0


@pytest.mark.parametrize(("teeth", "helix"), [(18, 0.0), (87, 12.0)])
def test_the_teeth_of_a_gear_go_round_its_circle(teeth: int, helix: float) -> None:
    transverse_pitch = pi * 4 / cos(radians(helix))
    diameter = drive_line.reference_diameter(module=4, teeth=teeth, helix_angle=radians(helix))
    assert pi * diameter == pytest.approx(teeth * transverse_pitch)
    assert 2 * drive_line.pitch_radius(module=4, teeth=teeth, helix_angle=radians(helix)) == pytest.approx(diameter)


def test_two_gears_in_mesh_touch_between_their_axes() -> None:
    first, second = (drive_line.pitch_radius(module=5, teeth=teeth, helix_angle=0.0) for teeth in (24, 48))
    assert drive_line.center_distance(radius_1=first, radius_2=second) == pytest.approx(180)


@pytest.mark.parametrize("teeth", [9, 27, 52])
def test_a_chain_lies_on_its_sprocket_as_a_polygon(teeth: int) -> None:
    radius = drive_line.sprocket_diameter(pitch=25.4, teeth=teeth) / 2
    joints = [radius * exp(2j * pi * each / teeth) for each in range(teeth)]
    assert abs(joints[1] - joints[0]) == pytest.approx(25.4)
    travel = sum(abs(joints[each] - joints[each - 1]) for each in range(teeth))
    assert 2 * pi * drive_line.chain_travel(teeth=teeth, pitch=25.4) == pytest.approx(travel)
