"""The benchmark's kernel gives the numbers of ``cylinder_drive``: what the engine is measured against does the same work."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from diecut_report.machine.steps.run import calculate
from diecut_report.mechanism.steps import Crossings
from diecut_report.plugins.cylinder_drive import MECHANISM
from diecut_report.results.checks import applies, judged

COUNT = 48
OF_PHASES = {"contact_rotation", *(f"standstill_{end}_{side}" for end in ("outer", "inner") for side in ("start", "end")),
             *(f"contact_{side}_{stroke}" for side in ("begin", "end") for stroke in ("forward", "return"))}  # fmt: skip
LIMITS = {
    "crank_torque_mean": 4e-3,
    "crank_torque_rms": 4e-3,
    "power_mean": 4e-3,
    "power_peak": 2e-2,
}  # jumps lie between two samples
NEAR = 1.5 * 2 * np.pi / 720  # of places: one-sided limits at a jump lie up to an interval beside the sample


@pytest.fixture(scope="module")
def both(request: pytest.FixtureRequest) -> Any:
    """Numbers by the kernel, and the engine's calculation of the same variants."""
    sys.path.insert(0, str(Path(__file__).parents[2] / "benchmarks"))
    request.addfinalizer(lambda: sys.path.pop(0))
    from batch_kernel import variants
    from drive_kernel import Kernel

    inputs = variants(COUNT, seed=3)
    return Kernel(COUNT).calculate(inputs, COUNT), calculate(MECHANISM, inputs, COUNT)


def test_the_kernel_gives_every_output(both: Any) -> None:
    found, calc = both
    steps = {step.id: step for _, step in MECHANISM.active(calc.given)}
    outputs = [n for n, step in steps.items() if step.output and n in calc.values and not isinstance(step, Crossings)]
    names = [name for name in outputs if name not in OF_PHASES]
    assert set(outputs) >= OF_PHASES
    assert len(names) > 45
    for name in names:
        expected = calc[name][:, 0]
        limit = LIMITS.get(name, 2e-2 if "force" in name or "tension" in name or "torque" in name else 1e-4)
        if name != "energy_residual":
            np.testing.assert_allclose(found[name], expected, rtol=limit, atol=1e-9, err_msg=name)
    assert found["energy_residual"].max() < 1e-9


def test_smooth_extremes_lie_where_the_engine_finds_them(both: Any) -> None:
    found, calc = both
    for name in ("velocity_max", "acceleration_max", "inertia_moment_max", "inertia_moment_min"):
        apart = np.abs(found[f"{name}_at"] - calc[f"{name}_at"][:, 0])
        assert np.median(np.minimum(apart, 2 * np.pi - apart)) < NEAR, name


@pytest.mark.parametrize("name", ["flank_change", "torque_reversal"])
def test_the_kernel_finds_the_crossings(both: Any, name: str) -> None:
    found, calc = both
    assert (found[f"{name}_count"] == calc[f"{name}_count"][:, 0]).mean() > 0.9
    for here, expected in zip(found[name], calc[name], strict=True):
        for place in expected[np.isfinite(expected)]:
            assert np.nanmin(np.abs(np.angle(np.exp(1j * (here - place))))) < NEAR


def test_the_kernel_judges_as_the_engine(both: Any) -> None:
    found, calc = both
    checks = [check for check in MECHANISM.checks if applies(calc, check)]
    assert set(found["checks"]) == {check.id for check in checks}
    for check in checks:
        here = judged(calc, check)
        np.testing.assert_array_equal(found["checks"][check.id][0], here.governing(here.held))
        np.testing.assert_allclose(found["checks"][check.id][1], here.governing(here.ratio), rtol=1e-9, atol=1e-3)
