"""Checks of the platen press."""

from __future__ import annotations

from diecut_report.api import Check, Vary


def _pressure(name: str, key: str, demand: str, pins: str) -> Check:
    """The pressure of one kind of pins against what is allowed."""
    return Check(id=f"contact_stress_{name}", check_class="strength", title=f"Pressure on the {pins}",
                 demand=demand, limit="allowable_pin_pressure", unit="MPa",
                 demand_label="pressure", limit_label="allowed", source="input", needs=(key, "allowable_pin_pressure"),
                 consequence=f"the {pins} squeeze out their oil and seize; thicker ones bear more, at the price of more friction.",
                 advise=(Vary(key, "up"),))  # fmt: skip


CHECKS = (
    Check(id="torque_sign", check_class="function", title="Relaxing rods never drive the crank", demand="elastic_arm", limit="friction_arm",
        unit="mm", operator="<", demand_label="arm of the relaxing rods", limit_label="friction arm", source="001, conclusion 1",
        consequence="the relaxing rods drive the crank ahead and the play of the drive changes sides with a blow.",
        advise=(Vary("drive_deformation", "down"), Vary("rod_area", "up"))),
    Check(id="inertia", check_class="function", title="Inertia of the platen at the dead centre", demand="inertia_dead_center",
        limit="cutting_force_max", unit="kN", operator="<", demand_label="inertia force", limit_label="cutting force", source="this method",
        consequence="the platen presses on the die by its inertia, and the rods push it instead of pulling: the calculation does not hold about the "
            "dead centre.", advise=(Vary("cycles_per_hour", "down"), Vary("platen_mass", "down"))),
    Check(id="torque_max", check_class="strength", title="Torque at the main shaft", demand="torque_max", limit="allowable_torque", unit="N*m",
        demand_label="maximum torque", limit_label="allowed", source="input", needs=("allowable_torque",),
        consequence="the main shaft and its drive are overloaded; shorter rules or softer board lowers the force, and a stiffer drive the torque.",
        advise=(Vary("cutting_force_max", "down"), Vary("drive_deformation", "down"), Vary("cycles_per_hour", "down"))),
    _pressure("journal", "journal_length", "journal_pressure", "journals"),
    _pressure("crank_pin", "crank_pin_length", "crank_pin_pressure", "crank pins"),
    _pressure("platen_pin", "platen_pin_length", "platen_pin_pressure", "platen's pins"),
    Check(id="rod_stress", check_class="strength", title="Stress in the rods", demand="rod_stress", limit="allowable_rod_stress", unit="MPa",
        demand_label="tensile stress", limit_label="allowed", source="input", needs=("rod_net_area", "allowable_rod_stress"),
        consequence="the rods crack at their weakest section.", advise=(Vary("rod_net_area", "up"),)),
    Check(id="energy_balance", check_class="numerical", title="Energy balance over a cycle", demand="energy_residual", limit=1e-6, unit="1",
        demand_label="relative difference", limit_label="accepted", source="conservation of energy",
        consequence="the calculation contradicts itself; do not use it."),
)  # fmt: skip
