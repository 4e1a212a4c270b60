"""Checks of the Geneva drive."""

from __future__ import annotations

from diecut_report.api import Check, Vary
from diecut_report.plugins.geneva_transport.inputs import GRIPPED
from diecut_report.plugins.geneva_transport.motion import CONVEYOR_NEEDS

LOCKING = ("locking_radius", Vary("roller_radius", "down"), Vary("locking_clearance", "down"))

CHECKS = (
    Check(id="roller_clearance", check_class="function", title="Wall between two slots", demand="slot_width", limit="slot_spacing", unit="mm",
        operator="<", demand_label="width of the slots", limit_label="distance of their inner ends", source="geometry",
        consequence="neighbouring slots run into each other at their inner ends, the wall between them is {roller_clearance}.",
        advise=(Vary("roller_radius", "down"), Vary("center_distance", "up"))),
    Check(id="arm_thickness", check_class="function", title="Arm between locking arc and slot", demand="locking_radius", limit="flank_distance",
        unit="mm", operator="<", demand_label="radius of the locking arc", limit_label="distance of the slot's flank", source="geometry",
        consequence="the locking arc cuts into the slots, the tips of the wheel's arms would be {arm_tip} thick.", advise=LOCKING[:2]),
    Check(id="locking_reach", check_class="function", title="Locking disc reaches the wheel", demand="rim_distance", limit="disc_radius", unit="mm",
        operator="<", demand_label="distance of the wheel's rim", limit_label="radius of the locking disc", source="geometry",
        consequence="the disc turns clear of the wheel, nothing holds it in the dwell.", advise=LOCKING),
    Check(id="cutout", check_class="function", title="Arm tips clear the locking disc", demand="cutout_overlap", limit=0.01, unit="mm",
        demand_label="overlap", limit_label="accepted", source="geometry",
        consequence="in the engagement the tips of the arms meet the disc beside its cut-out, unless they are rounded off.", advise=LOCKING),
    Check(id="sheet_acceleration", check_class="function", title="Acceleration of the sheet", demand="sheet_acceleration_max",
        limit="allowable_sheet_acceleration", unit="m/s**2", demand_label="maximum acceleration", limit_label="allowed",
        source="input", needs=(*CONVEYOR_NEEDS, "allowable_sheet_acceleration"),
        consequence="the sheet slips from the grippers or tears; a shorter step lowers it, too.",
        advise=(Vary("crank_speed", "down"), Vary("slots", "up"))),
    Check(id="grippers", check_class="function", title="Holding force of the grippers", demand="sheet_force", limit="gripper_force", unit="N",
        demand_label="force of the sheet on the grippers", limit_label="holding force of the grippers", source="mechanics",
        needs=(*GRIPPED, "gripper_force"), consequence="the sheet slips out of the grippers, and the register is lost.",
        advise=(Vary("crank_speed", "down"),)),
    Check(id="contact_pressure", check_class="strength", title="Contact pressure of the roller", demand="contact_pressure",
        limit="allowable_contact_pressure", unit="MPa", demand_label="contact pressure", limit_label="allowed", source="Hertz",
        needs=("driven_inertia", "roller_width", "allowable_contact_pressure"),
        consequence="roller and slot wear and pit; a smaller inertia lowers it, too.",
        advise=(Vary("roller_width", "up"), Vary("center_distance", "up"), Vary("slots", "up"))),
    Check(id="torque", check_class="strength", title="Torque at the crank", demand="torque_peak", limit="allowable_torque", unit="N*m",
        demand_label="maximum torque", limit_label="allowed", source="input",
        consequence="the crank's shaft and what drives it are overloaded; a smaller inertia lowers it, too.",
        advise=(Vary("crank_speed", "down"), Vary("slots", "up"))),
    Check(id="sheet_play", check_class="function", title="Play of the sheet in the dwell", demand="sheet_play", limit="allowable_sheet_play",
        unit="mm", demand_label="play", limit_label="allowed", source="input",
        consequence="the sheets lie out of register, unless an index pin holds the wheel.", advise=(Vary("locking_clearance", "down"),)),
    Check(id="energy_balance", check_class="numerical", title="Energy balance over a revolution", demand="energy_residual", limit=1e-6, unit="1",
        needs=("driven_inertia",), demand_label="ratio of work", limit_label="accepted", source="conservation of energy",
        consequence="the calculation contradicts itself; do not use it."),
)  # fmt: skip
