"""A kernel written by hand for ``cylinder_drive``: preallocated buffers, one chunk of variants at a time, 720 crank angles."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]
POINTS = 720
STEP = 2 * np.pi / POINTS
GRAVITY = 9.80665


class Kernel:
    """Buffers for chunks of a size; ``calculate`` gives numbers of shape (size,), crossings (size, most), and the checks."""

    def __init__(self, size: int) -> None:
        self.angle = np.arange(POINTS) * STEP
        self.cos, self.sin = np.cos(self.angle), np.sin(self.angle)
        self.work = [np.empty((size, POINTS)) for _ in range(14)]
        self.flag = [np.empty((size, POINTS), dtype=bool) for _ in range(4)]
        self.row = np.arange(size)

    def calculate(self, values: Mapping[str, Array], count: int) -> dict[str, Any]:
        """All numbers and checks of as many variants as the buffers are made for."""
        assert count == len(self.row)
        v = dict(values)
        _linkage(v)
        _window(v)
        self._motion(v)
        self._moments(v)
        self._torque(v)
        self._forces(v)
        _checks(v)
        return v

    def _motion(self, v: dict[str, Any]) -> None:
        """Rocker's angle, speed and acceleration; the law of cosines gives μ and γ₂, everything else follows from them."""
        span, cos_mu, sin_mu, gamma, theta, s, c, speed, rate, a = self.work[:10]
        f, b, r = (v[n][:, None] for n in ("frame_ratio", "coupler_ratio", "rocker_ratio"))
        np.multiply(self.cos, -2 * f, out=span)
        np.add(span, 1 + f**2, out=span)  # D²
        np.subtract(b**2 + r**2, span, out=cos_mu)
        np.divide(cos_mu, 2 * b * r, out=cos_mu)
        np.add(span, b**2 - r**2, out=gamma)
        np.sqrt(span, out=span)
        np.divide(gamma, span, out=gamma)
        np.divide(gamma, 2 * b, out=gamma)
        np.arccos(gamma, out=gamma)  # γ₂
        np.subtract(f, self.cos, out=a)
        np.arctan2(self.sin, a, out=a)
        np.subtract(gamma, a, out=gamma)  # γ
        np.arccos(cos_mu, out=theta)
        np.add(theta, gamma, out=theta)
        np.subtract(theta, v["outer_direction"][:, None], out=theta)  # δ
        np.multiply(cos_mu, cos_mu, out=sin_mu)
        np.subtract(1, sin_mu, out=sin_mu)
        np.sqrt(sin_mu, out=sin_mu)
        np.subtract(gamma, self.angle, out=gamma)
        _sine_and_cosine(gamma, s, c, a)
        np.divide(s, sin_mu, out=speed)
        np.divide(speed, -r, out=speed)  # ω₃ᵢ
        np.multiply(s, cos_mu, out=s)
        np.multiply(c, sin_mu, out=a)
        np.add(s, a, out=s)
        np.divide(s, sin_mu, out=s)  # −λ₂ω₂ᵢ
        np.multiply(s, s, out=s)
        np.divide(s, b, out=s)
        np.multiply(speed, speed, out=rate)
        np.multiply(rate, cos_mu, out=rate)
        np.multiply(rate, r, out=rate)
        np.subtract(rate, c, out=rate)
        np.subtract(rate, s, out=rate)
        np.divide(rate, sin_mu, out=rate)
        np.divide(rate, -r, out=rate)  # ε₃ᵢ
        rolled = v["sector_ratio"] * v["cylinder_radius"]
        self._greatest_size(v, "velocity_max", speed, v["crank_speed"] * rolled)
        self._greatest_size(v, "acceleration_max", rate, v["crank_speed"] ** 2 * rolled)

    def _moments(self, v: dict[str, Any]) -> None:
        _, _, _, _, theta, s, c, speed, rate, a, inertia, total = self.work[:12]
        cuts, forward = self.flag[:2]
        u, omega, radius, me = (v[n] for n in ("sector_ratio", "crank_speed", "cylinder_radius", "static_unbalance"))
        np.subtract(theta, (v["swing_angle"] / 2)[:, None], out=a)
        np.abs(a, out=a)
        np.less_equal(a, (v["cutting_arc_fraction"] * v["swing_angle"] / 2)[:, None], out=cuts)
        np.multiply(theta, u[:, None], out=theta)
        _sine_and_cosine(theta, s, c, a)
        np.multiply(c, (2 * radius * me)[:, None], out=inertia)
        np.add(inertia, v["reduced_inertia"][:, None], out=inertia)
        np.multiply(inertia, rate, out=inertia)
        np.multiply(inertia, (omega**2 * u)[:, None], out=inertia)
        np.multiply(speed, speed, out=a)
        np.multiply(a, (radius * me * (omega * u) ** 2)[:, None], out=a)
        np.add(a, (GRAVITY * me)[:, None], out=a)
        np.multiply(a, s, out=a)
        np.subtract(inertia, a, out=inertia)  # M_in
        np.sign(speed, out=total)
        np.multiply(total, v["cutting_moment"][:, None], out=total)
        np.multiply(total, cuts, out=total)
        np.add(total, inertia, out=total)  # M_Σ
        np.greater(speed, 0, out=forward)
        np.not_equal(cuts[:, 1:], cuts[:, :-1], out=self.flag[2][:, :-1])
        self.flag[2][:, -1] = cuts[:, 0] != cuts[:, -1]
        np.not_equal(forward[:, 1:], forward[:, :-1], out=self.flag[3][:, :-1])
        self.flag[3][:, -1] = forward[:, 0] != forward[:, -1]
        np.logical_or(self.flag[2], self.flag[3], out=self.flag[3])  # a jump lies between this angle and the next
        self._extreme(v, "inertia_moment_max", inertia, 1)
        self._extreme(v, "inertia_moment_min", inertia, -1)
        self._greatest_size(v, "tooth_force_max", total, 1 / v["pinion_radius"])
        self._crossings(v, "flank_change", total)
        np.multiply(inertia, speed, out=a)
        v["energy_turn"] = u * STEP * np.sum(a, axis=1) + v["technological_work"]
        v["kinetic_energy_max"] = v["reduced_inertia"] * (v["velocity_max"] / radius) ** 2 / 2
        v["energy_residual"] = np.abs(v["energy_turn"] - v["technological_work"]) / np.maximum(
            v["technological_work"], v["kinetic_energy_max"]
        )

    def _torque(self, v: dict[str, Any]) -> None:
        speed, a, total, torque = (self.work[i] for i in (7, 9, 11, 12))
        eta = v["efficiency_total"][:, None]
        np.multiply(total, speed, out=torque)
        np.multiply(torque, v["sector_ratio"][:, None], out=torque)
        np.multiply(torque, eta, out=a)
        np.divide(torque, eta, out=torque)
        np.maximum(torque, a, out=torque)  # the greater of both where the crank drives, and where it is driven
        self._extreme(v, "crank_torque_max", torque, 1)
        self._extreme(v, "crank_torque_min", torque, -1)
        upper = np.abs(v["crank_torque_max"]) >= np.abs(v["crank_torque_min"])
        v["crank_torque_peak"] = np.maximum(np.abs(v["crank_torque_max"]), np.abs(v["crank_torque_min"]))
        v["crank_torque_peak_at"] = np.where(upper, v["crank_torque_max_at"], v["crank_torque_min_at"])
        v["crank_torque_mean"] = np.mean(torque, axis=1)
        v["crank_torque_rms"] = np.sqrt(np.einsum("ij,ij->i", torque, torque) / POINTS)
        v["power_mean"] = v["crank_torque_mean"] * v["crank_speed"]
        v["power_peak"] = v["crank_torque_peak"] * v["crank_speed"]
        self._crossings(v, "torque_reversal", torque)

    def _forces(self, v: dict[str, Any]) -> None:
        sin_mu, a, total, force, sizes = (self.work[i] for i in (2, 9, 11, 12, 13))
        behind = v["efficiency_behind_rocker"][:, None]
        np.divide(total, behind, out=force)
        np.multiply(total, behind, out=a)
        np.less(self.work[7], 0, out=self.flag[0])
        np.maximum(force, a, out=sizes)
        np.minimum(force, a, out=force)
        np.copyto(force, sizes, where=~self.flag[0])
        np.divide(force, sin_mu, out=force)
        np.multiply(force, (v["sector_ratio"] / v["rocker_length"])[:, None], out=force)
        self._extreme(v, "coupler_tension_max", force, 1)
        self._extreme(v, "coupler_tension_min", force, -1)
        upper = np.abs(v["coupler_tension_max"]) >= np.abs(v["coupler_tension_min"])
        v["joint_force_max"] = np.maximum(np.abs(v["coupler_tension_max"]), np.abs(v["coupler_tension_min"]))
        v["joint_force_max_at"] = np.where(upper, v["coupler_tension_max_at"], v["coupler_tension_min_at"])
        cosine = np.cos(v["pressure_angle"])
        np.multiply(total, (1 / (v["pinion_radius"] * cosine))[:, None], out=a)
        np.abs(a, out=a)
        np.abs(force, out=sizes)
        np.add(sizes, a, out=sizes)
        self._extreme(v, "rocker_bearing_force_max", sizes, 1)
        v["tooth_normal_force_max"], v["tooth_normal_force_max_at"] = (
            v["tooth_force_max"] / cosine,
            v["tooth_force_max_at"],
        )
        v["tooth_radial_force_max"] = v["tooth_force_max"] * np.tan(v["pressure_angle"])

    # --- reductions ----------------------------------------------------------------------------------------------------

    def _extreme(self, v: dict[str, Any], name: str, curve: Array, sign: int) -> None:
        """Greatest or least sample, refined by the parabola through its neighbours where no jump lies between them."""
        k = np.argmax(curve, axis=1) if sign > 0 else np.argmin(curve, axis=1)
        left, here, right = (curve[self.row, (k + i) % POINTS] for i in (-1, 0, 1))
        smooth = ~(self.flag[3][self.row, k - 1] | self.flag[3][self.row, k]) if name[0] not in "vai" else True
        bend = left - 2 * here + right
        shift = np.where(smooth & (bend != 0), (left - right) / (2 * np.where(bend == 0, 1, bend)), 0)
        v[name], v[f"{name}_at"] = here - (left - right) * shift / 4, (k + shift) * STEP

    def _greatest_size(self, v: dict[str, Any], name: str, curve: Array, factor: Array) -> None:
        self._extreme(v, name, curve, 1)
        top, place = v[name], v[f"{name}_at"]
        self._extreme(v, name, curve, -1)
        v[f"{name}_at"] = np.where(np.abs(top) >= np.abs(v[name]), place, v[f"{name}_at"])
        v[name] = np.maximum(np.abs(top), np.abs(v[name])) * factor

    def _crossings(self, v: dict[str, Any], name: str, curve: Array) -> None:
        """Places where the curve changes its sign, by the line between samples."""
        above, changes = self.flag[1], self.flag[2]
        np.greater(curve, 0, out=above)
        np.not_equal(above[:, 1:], above[:, :-1], out=changes[:, :-1])
        changes[:, -1] = above[:, -1] != above[:, 0]
        row, k = np.divmod(np.flatnonzero(changes), POINTS)
        first, second = curve[row, k], curve[row, (k + 1) % POINTS]
        count = np.bincount(row, minlength=len(self.row))
        places = np.full((len(self.row), max(int(count.max(initial=0)), 1)), np.nan)
        places[row, np.arange(len(row)) - np.repeat(np.cumsum(count) - count, count)] = (
            k + first / (first - second)
        ) * STEP
        v[name], v[f"{name}_count"] = places, count


def _sine_and_cosine(angle: Array, sine: Array, cosine: Array, work: Array) -> None:
    """Both from the tangent of half the angle, which NumPy computes many times faster than either."""
    np.multiply(angle, 0.5, out=sine)
    np.tan(sine, out=sine)
    np.multiply(sine, sine, out=cosine)
    np.add(cosine, 1, out=work)
    np.subtract(1, cosine, out=cosine)
    np.divide(cosine, work, out=cosine)
    np.add(sine, sine, out=sine)
    np.divide(sine, work, out=sine)


def _enclosed(one: Array, other: Array, opposite: Array) -> Array:
    found: Array = np.arccos((one**2 + other**2 - opposite**2) / (2 * one * other))
    return found


def _linkage(v: dict[str, Any]) -> None:
    f, b, r, radius = (v[n] for n in ("frame_ratio", "coupler_ratio", "rocker_ratio", "cylinder_radius"))
    longest = np.maximum(f, np.maximum(b, r))
    v["grashof_demand"], v["grashof_limit"] = 1 + longest, f + b + r - longest
    at_outer = _enclosed(f, r, 1 + b)
    v["outer_direction"], v["swing_angle"] = np.pi - at_outer, at_outer - _enclosed(f, r, b - 1)
    v["dead_center_outer"], v["dead_center_inner"] = _enclosed(f, 1 + b, r), np.pi + _enclosed(f, b - 1, r)
    forward = v["dead_center_inner"] - v["dead_center_outer"]
    v["time_ratio"] = forward / (2 * np.pi - forward)
    v["transmission_angle_min"], v["transmission_angle_max"] = _enclosed(b, r, f - 1), _enclosed(b, r, f + 1)
    v["transmission_angle_worst"] = np.minimum(v["transmission_angle_min"], np.pi - v["transmission_angle_max"])
    v["sector_ratio"] = u = v["sector_ratio"] if "sector_ratio" in v else 2 * np.pi / v["swing_angle"]
    v["stroke"], v["stroke_error"] = v["swing_angle"] * u * radius, np.abs(u * v["swing_angle"] - 2 * np.pi)
    v["cutting_length"] = np.sqrt(2 * radius * v["material_thickness"] - v["material_thickness"] ** 2)
    v["rolling_arm"] = v["rolling_coefficient"] * v["cutting_length"]
    v["cutting_force"] = (v["cutting_force_per_length"] + v["ejection_force_per_length"]) * v["cylinder_length"]
    v["cutting_moment"] = v["cutting_force"] * v["rolling_arm"]
    v["reduced_inertia"] = v["cylinder_inertia"] + v["cylinder_mass"] * radius**2
    v["greatest_unbalance"] = v["cylinder_mass"] * radius
    v["technological_work"] = 2 * v["cutting_arc_fraction"] * v["cutting_moment"] * u * v["swing_angle"]
    behind = v["efficiency_sector"] * v["efficiency_gear"] * v["efficiency_chain"] * v["efficiency_bearings"]
    v["efficiency_behind_rocker"], v["efficiency_total"] = behind, v["efficiency_four_bar"] * behind
    for name in ("frame", "coupler", "rocker"):
        v[f"{name}_length"] = v[f"{name}_ratio"] * v["crank_length"]
    v["sector_radius"] = u * v["pinion_radius"]
    begin, end = (v["swing_angle"] * (1 + side * v["cutting_arc_fraction"]) / 2 for side in (-1, 1))
    always = v["cutting_arc_fraction"] >= 1
    v["cut_begin_forward"] = np.where(always, v["dead_center_outer"], _crank_angle(v, begin, 1))
    v["cut_end_forward"] = np.where(always, v["dead_center_inner"], _crank_angle(v, end, 1))
    v["cut_begin_return"] = np.where(always, v["dead_center_inner"], _crank_angle(v, end, -1))
    v["cut_end_return"] = np.where(always, v["dead_center_outer"] + 2 * np.pi, _crank_angle(v, begin, -1))


def _crank_angle(v: Mapping[str, Any], swing: Array, side: int) -> Array:
    """Crank angle at a rocker angle, on the forward stroke (side 1) or on the return stroke (-1)."""
    f, b, r, direction = v["frame_ratio"], v["coupler_ratio"], v["rocker_ratio"], v["outer_direction"] + swing
    x, y = f + r * np.cos(direction), r * np.sin(direction)
    distance = np.sqrt(x**2 + y**2)
    bend = np.arccos(np.clip((1 + distance**2 - b**2) / (2 * distance), -1, 1))
    found: Array = np.arctan2(y, x) + side * bend + (0 if side > 0 else 2 * np.pi)
    return found


def _window(v: dict[str, Any]) -> None:
    radius, u = v["cylinder_radius"], v["sector_ratio"]
    clear = np.arccos(1 - v["segment_height"] / radius) - np.arccos(1 - v["carriage_clearance"] / radius)
    v["clear_rotation"] = clear
    leaves, arrives = clear <= u * v["swing_angle"], np.abs(u * v["swing_angle"] - 2 * np.pi) <= clear
    outer, inner = clear / u, (2 * np.pi - clear) / u
    v["clearance_outer_start"] = np.where(leaves, _crank_angle(v, outer, -1) - 2 * np.pi, np.nan)
    v["clearance_outer_end"] = np.where(leaves, _crank_angle(v, outer, 1), np.nan)
    v["clearance_inner_start"] = np.where(arrives, _crank_angle(v, inner, 1), np.nan)
    v["clearance_inner_end"] = np.where(arrives, _crank_angle(v, inner, -1), np.nan)
    for end in ("outer", "inner"):
        v[f"clearance_{end}_time"] = (v[f"clearance_{end}_end"] - v[f"clearance_{end}_start"]) / v["crank_speed"]


def _checks(v: dict[str, Any]) -> None:
    compared = {
        "grashof": (v["grashof_demand"], v["grashof_limit"], np.less),
        "transmission_angle": (v["min_transmission_angle"], v["transmission_angle_worst"], np.less_equal),
        "stroke": (v["stroke_error"], np.full_like(v["stroke_error"], np.radians(0.5)), np.less_equal),
        "unbalance": (v["static_unbalance"], v["greatest_unbalance"], np.less),
        "energy_balance": (v["energy_residual"], np.full_like(v["energy_residual"], 1e-6), np.less_equal),
    }
    v["checks"] = {name: (held(demand, limit), demand / limit) for name, (demand, limit, held) in compared.items()}
