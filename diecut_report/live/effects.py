"""What an input does to every check: one vectorised run over the slider's range."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from diecut_report.design.design_inputs import DesignInput
from diecut_report.design.varied_machines import STATUS, UTILISATION, VariedMachines, varied
from diecut_report.errors import Problem, UserError
from diecut_report.languages.phrases import Phrase
from diecut_report.live.page_data import slider
from diecut_report.live.session import LiveMachine
from diecut_report.quantities.units import unit
from diecut_report.results.press_run import Tell
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
    found = varied(machine.config, {asked.asked: places}, len(places), tell=tell)
    own = unit(asked.unit)
    return {
        "input": name,
        "places": [float(f"{own.from_si(float(place)):.6g}") for place in places],
        "exists": found.exists.tolist(),
        "checks": {check: _line(found, check) for check in found.checks},
    }


def _places(asked: DesignInput) -> np.ndarray:
    low, high = slider(asked)
    if asked.is_whole:
        return np.arange(round(low), round(high) + 1, dtype=float)
    return np.linspace(low, high, POINTS)


def _line(found: VariedMachines, check: str) -> Data:
    ratios, statuses = found.check(check, UTILISATION), found.check(check, STATUS)
    known = [float(f"{ratio:.4g}") if math.isfinite(ratio) else None for ratio in ratios.astype(float)]
    return {"utilisation": known, "status": [status or "" for status in statuses]}
