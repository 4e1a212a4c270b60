"""What 000 prints for cylinder and drive beside its rows: shapes, extremes, and what follows from its mistakes."""

from __future__ import annotations

from math import degrees

import pytest

from diecut_report.machine.numerics.extremes import extreme
from tests.machines import UNBALANCED, drive, number
from tests.validation.source_000 import published_cylinder, published_drive, unsigned_braking_peak

SHEET_CYLINDER = {
    "radius_closed_form": (0.105000, 1e-6),
    "radius_exact": (0.105120, 1e-6),
    "chord": (0.16492, 5e-6),
    "arc_length": (0.18969, 5e-6),
    "segment_area": (4.5985e-3, 5e-8),
    "segment_mass": (25.108, 5e-4),
    "bore_mass": (84.050, 5e-4),
    "solid_mass": (189.113, 5e-4),
    "mass": (80.908, 5e-4),
    "inertia": (0.63623, 5e-6),
    "inertia_source": (0.67063, 5e-6),
    "center_of_mass_offset": (24.44e-3, 5e-6),
    "wall_at_flat": (-5e-3, 1e-12),
}


@pytest.mark.parametrize("name", SHEET_CYLINDER)
def test_the_cylinder_of_the_method_sheet(name: str) -> None:
    value, rounding = SHEET_CYLINDER[name]
    assert number(published_cylinder(), name) == pytest.approx(value, abs=rounding)


SHEET_DRIVE = {
    "crank_torque_max": (1145.9, 0.05),
    "crank_torque_min": (-1536.0, 0.05),
    "sector_ratio": (6.054735, 5e-7),
    "time_ratio": (1.048699, 5e-7),
}


@pytest.mark.parametrize("name", SHEET_DRIVE)
def test_the_drive_of_the_method_sheet(name: str) -> None:
    value, rounding = SHEET_DRIVE[name]
    assert number(published_drive(), name) == pytest.approx(value, abs=rounding)


def test_the_angles_of_the_method_sheet() -> None:
    angles = {
        "swing_angle": 59.4576,
        "dead_center_outer": 18.8043,
        "dead_center_inner": 203.0831,
        "transmission_angle_min": 49.907,
        "transmission_angle_max": 109.365,
    }
    for name, value in angles.items():
        assert degrees(number(published_drive(), name)) == pytest.approx(value, abs=5e-4)


def test_the_sources_unsigned_torque() -> None:
    assert unsigned_braking_peak() == pytest.approx(-1850.2, abs=0.05)


def test_extremes_of_the_transfer_functions() -> None:
    calc = published_drive()
    for curve, least, greatest in (
        ("rocker_speed_ratio", -0.552227, 0.488739),
        ("rocker_acceleration_ratio", -0.416592, 0.773399),
    ):
        found = [float(extreme(calc, curve, sign)[0][0, 0]) for sign in (-1.0, 1.0)]
        assert found == pytest.approx([least, greatest], abs=5e-7)


def test_the_unbalance_raises_the_braking_peak() -> None:
    exact = {"cylinder_mass": "80.908 kg", "cylinder_inertia": "0.63623 kg*m**2"}
    lossless = {f"efficiency_{n}": 1 for n in ("sector", "gear", "four_bar", "bearings", "chain")}
    level, heavy = (
        drive(**exact, **lossless),
        drive(**exact, **lossless, static_unbalance=UNBALANCED["static_unbalance"]),
    )
    assert number(level, "crank_torque_min") == pytest.approx(-1232, abs=1)
    assert number(heavy, "crank_torque_min") == pytest.approx(-1436, abs=1)
    assert number(level, "inertia_moment_max") == pytest.approx(785, abs=1)
    assert number(heavy, "inertia_moment_max") == pytest.approx(996, abs=1)
