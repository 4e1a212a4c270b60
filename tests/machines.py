"""Machines that several tests calculate."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.formulas import Array
from diecut_report.machine.calculation import Calculation
from diecut_report.machine.steps.run import calculate
from diecut_report.mechanism.chapters import in_form
from diecut_report.mechanism.inputs import flatten
from diecut_report.mechanism.mechanism import Mechanism
from diecut_report.plugins.cylinder_drive import MECHANISM as DRIVE
from diecut_report.plugins.cylinder_sizing import MECHANISM as SIZING
from diecut_report.results.advice import possible_ways
from diecut_report.results.checks import check_results, holds, verdicts
from diecut_report.results.mechanism_record import CheckRecord

PUBLISHED_CYLINDER: dict[str, Any] = {
    "working_length": "470.7 mm",
    "segment_height": "40 mm",
    "generatrix_length": "700 mm",
    "bore_radius": "70 mm",
    "radius": "105 mm",
}
PUBLISHED_DRIVE: dict[str, Any] = {
    "crank_speed": "100 rpm",
    "cylinder_radius": "105 mm",
    "cylinder_length": "700 mm",
    "cylinder_mass": "80 kg",
    "cylinder_inertia": "0.973 kg*m**2",
    "material_thickness": "0.6 mm",
}
LOSSLESS: dict[str, Any] = {f"efficiency_{name}": 1 for name in ("sector", "gear", "four_bar", "bearings", "chain")}

UNBALANCED: dict[str, Any] = {
    "cylinder_mass": "80.9077 kg",
    "cylinder_inertia": "0.63623 kg*m**2",
    "static_unbalance": "1.97727 kg*m",
    "cutting_arc_fraction": 0.712481,
}


def inputs(mechanism: Mechanism, keys: dict[str, Any]) -> dict[str, Any]:
    """The validated inputs of a mechanism in SI, as the engine takes them."""
    return flatten(in_form(mechanism.inputs, keys).model_validate(keys))


def made_possible(mechanism: Mechanism, keys: dict[str, Any], key: str) -> list[str]:
    """The ways, in words, in which a machine that is refused for a key is made possible."""
    return [str(way.text) for way in possible_ways(mechanism, inputs(mechanism, keys), key, holds)]


def cylinder(**changes: Any) -> Calculation:
    """The published cylinder with changes."""
    return calculate(SIZING, inputs(SIZING, PUBLISHED_CYLINDER | changes))


def drive(**changes: Any) -> Calculation:
    """The published drive with changes."""
    return calculate(DRIVE, inputs(DRIVE, PUBLISHED_DRIVE | changes))


def number(calculation: Calculation, name: str) -> float:
    """A number of a single machine, SI."""
    return float(calculation[name][0, 0])


def at(calculation: Calculation, curve: str, places: Any) -> Array:
    """A curve of a single machine at any places of its abscissa, each in the smooth piece that it lies in."""
    domain = calculation.domains[calculation.axis[curve]]
    x = np.atleast_1d(np.asarray(places, dtype=float))[None, :] % float(domain.period[0, 0])
    middle = np.concatenate([domain.middle_of(part) for part in np.array_split(x, 20, axis=1)], axis=1)
    found: Array = calculation.sample(curve, x, middle)[0]
    return found


def checks(calculation: Calculation) -> dict[str, CheckRecord]:
    """The checks of a machine by their ids, without advice, which takes most of the time."""
    return {check.id: check for check in verdicts(calculation)}


def advised(calculation: Calculation) -> dict[str, CheckRecord]:
    """The checks of a machine by their ids, with advice."""
    return {check.id: check for check in check_results(calculation)}


def statuses(calculation: Calculation) -> dict[str, str]:
    """The statuses of a machine's checks by their ids."""
    return {check.id: check.status for check in verdicts(calculation)}
