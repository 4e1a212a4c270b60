"""The formulas of a driven link on an elastic drive, against its equation of motion by finite differences."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.interpolate import make_interp_spline

from diecut_report.formulas import Array
from diecut_report.formulas.formula import Formula, evaluate
from diecut_report.mechanics import followers as follower
from diecut_report.mechanics.followers import peaks
from diecut_report.mechanics.motion_laws import LAWS


@pytest.mark.parametrize("name, damping", [("cycloidal", 0), ("polynomial_345", 0.05), ("polynomial_4567", 0.9)])
def test_the_formulas_satisfy_the_equation_of_motion(name: str, damping: float) -> None:
    """Running integrals by quintic splines, derivatives of the link's place by finite differences; a real shaft in SI."""
    stiffness, inertia, rise, rise_time, law = 5200.0, 0.8, 1.2, 0.09, LAWS[name]
    omega = follower.natural_angular_frequency(stiffness, inertia)
    assert omega == pytest.approx(80.6225774829855)
    assert follower.tuning_ratio(omega, rise_time) == pytest.approx(80.6225774829855 / 6.283185307179586 * 0.09)
    constant = follower.damping_constant(damping, inertia, omega)
    assert constant == pytest.approx(2 * damping * np.sqrt(5200 * 0.8))
    damped = follower.damped_angular_frequency(omega, damping)
    time = np.linspace(0, rise_time, 3001)
    step, k = time[1], time / rise_time
    swing = (follower.decay(time, omega, damping), follower.phase(time, damped))
    input_acceleration = rise / rise_time**2 * law.acceleration(k)
    parts = [part(*swing, input_acceleration) for part in (follower.in_phase_part, follower.quadrature_part)]
    running = [make_interp_spline(time, part, 5).antiderivative()(time) for part in parts]
    z = follower.deflection(*swing, damped, *running)
    rate = follower.deflection_velocity(follower.swing_speed(*swing, *running), omega, damping, z)
    x, v = rise * law.position(k) + z, rise / rise_time * law.velocity(k) + rate
    found = follower.response_acceleration(omega, damping, z, rate)
    torque = follower.drive_torque(stiffness, constant, z, rate)
    scale = rise / rise_time**2 * law.A
    np.testing.assert_allclose(inertia * found, torque, atol=1e-10 * inertia * scale)

    def slope(values: Array) -> Array:
        return (values[:-4] - 8 * values[1:-3] + 8 * values[3:-1] - values[4:]) / (12 * step)

    np.testing.assert_allclose(slope(x), v[2:-2], atol=1e-9 * rise / rise_time)
    np.testing.assert_allclose(slope(v), found[2:-2], atol=1e-8 * scale)
    assert np.abs(found).max() / scale == pytest.approx(peaks(law, omega * rise_time / 6.283185307179586, damping).rise, rel=1e-6)  # fmt: skip


FORMULAS = [part for part in vars(follower).values() if isinstance(part, Formula)]


@pytest.mark.parametrize("part", FORMULAS, ids=lambda part: part.__name__)
def test_what_is_printed_is_what_is_computed(part: Formula) -> None:
    values = {name: 0.1 + 0.13 * place for place, name in enumerate(part.parameters)}
    assert evaluate(part.tree, lambda leaf: values[leaf.args[0]]) == pytest.approx(part(**values), rel=1e-14)
