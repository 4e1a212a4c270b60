"""Checks of the gripper chain."""

from __future__ import annotations

from diecut_report.api import Check, m

CHECKS = (
    Check("shift", "function", "Sheet meets the station", m.shift, m.allowable_shift, named_by="stations.name",
          consequence="the sheet is out of register at {part}; renew the chain before it is worn by {elongation_allowed}, or take "
                      "sprockets with more teeth."),
    Check("grip", "function", "Grippers hold the sheet", m.sheet_force, m.grip_total,
          consequence="the sheet slips out of the grippers; set grip_force to at least {grip_force_needed:up}, or take more grippers."),
    Check("safety", "strength", "Safety factor against breaking", m.required_safety, m.safety, source="iwis",
          consequence="the chain breaks by fatigue; take one with a breaking load of at least {breaking_load_needed:up}."),
    Check("pressure", "strength", "Pressure of the joints", m.joint_pressure, m.allowable_pressure,
          consequence="the joints wear fast; take a greater chain, or less pull."),
    Check("sag", "practice", "Sag of the slack strand", m.sag_share, m.sag_greatest, at_least=m.sag_least, limit_label="at most",
          source="practice", severity="warn",
          consequence="a tight chain wears its joints, a loose one jumps over teeth; move the sprockets."),
    Check("unevenness", "practice", "Smooth running", m.unevenness, 2, source="practice", severity="warn",
          consequence="the strand runs with jerks; take sprockets with more teeth, 16 or above."),
)  # fmt: skip
