"""The sheet stop, by another way: its motion is followed in small steps of time."""

from __future__ import annotations

from pathlib import Path

import pytest

from diecut_report.testing import calculate, check_mechanism, load

STOP = load("sheet_stop", Path(__file__).parents[1] / "plugins")
KEYS = {"sheet_mass": "200 g", "stop_mass": "300 g", "speed": "2 m/s", "stiffness": "2 N/mm", "room": "15 mm"}


def test_the_declaration() -> None:
    check_mechanism(STOP)


def test_the_way_of_small_steps() -> None:
    mass, step, way, speed = 0.5, 1e-6, 0.0, 0.2 * 2 / 0.5
    while speed > 0:
        speed -= 2000 * way / mass * step
        way += speed * step
    assert calculate(STOP, KEYS)["way"].value == pytest.approx(way, rel=1e-4)
