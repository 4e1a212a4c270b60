"""What an input does to every check: one vectorised run over the slider's range, of the mechanisms that follow from it.

The checks of all others are those of the machine as it stands.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from diecut_report.config.loader import Config
from diecut_report.design.design_inputs import DesignInput
from diecut_report.design.varied_machines import STATUS, UTILISATION, VariedMachines, downstream, narrowed, varied
from diecut_report.errors import Problem, UserError
from diecut_report.languages.phrases import Phrase
from diecut_report.live.page_data import slider
from diecut_report.live.session import LiveMachine
from diecut_report.quantities.units import unit
from diecut_report.results.press_run import Tell
from diecut_report.results.unchecked import NOT_CHECKED
from diecut_report.study.execution.press_batch import untold

Data = dict[str, Any]
POINTS = 25  # of a line: fine enough for its size, and quick enough for a hand on a slider


def effect(machine: LiveMachine, name: str, tell: Tell = untold) -> Data:
    """Return the checks' utilisations and statuses along an input's slider, with the places in the input's unit.

    UserError where the file gives no such number. A place where the machine cannot exist has neither. ``tell`` is called with
    the name of each mechanism before it is calculated; what it raises ends the run.
    """
    asked = machine.inputs.get(name)
    if asked is None:
        raise UserError(Problem(Phrase("{name} is not a number that the file gives.", name=repr(name))))
    places = _places(asked)
    moved = narrowed(machine.config, downstream(machine.config, asked.asked.instance))
    found = varied(moved, {asked.asked: places}, len(places), tell=tell)
    own = unit(asked.unit)
    return {
        "input": name,
        "places": [float(f"{own.from_si(float(place)):.6g}") for place in places],
        "exists": found.exists.tolist(),
        "checks": _unmoved(machine, moved, found) | {check: _line(found, check) for check in found.checks},
    }


def _unmoved(machine: LiveMachine, moved: Config, found: VariedMachines) -> Data:
    """The lines of the checks that are not calculated again: today's, where the machine exists."""
    checks = ((name, check) for name, own in machine.run.checks.items() if name not in moved.instances for check in own)
    return {
        f"{name}.{check['id']}": {
            "utilisation": [_told(check["utilisation"]) if there else None for there in found.exists],
            "status": [check["status"] if there else "" for there in found.exists],
        }
        for name, check in checks
        if check["class"] != "numerical" and check["status"] != NOT_CHECKED
    }


def _told(ratio: float | None) -> float | None:
    return float(f"{ratio:.4g}") if ratio is not None and math.isfinite(ratio) else None


def _places(asked: DesignInput) -> np.ndarray:
    low, high = slider(asked)
    if asked.is_whole:
        return np.arange(round(low), round(high) + 1, dtype=float)
    return np.linspace(low, high, POINTS)


def _line(found: VariedMachines, check: str) -> Data:
    ratios, statuses = found.check(check, UTILISATION), found.check(check, STATUS)
    return {
        "utilisation": [_told(ratio) for ratio in ratios.astype(float)],
        "status": [status or "" for status in statuses],
    }
