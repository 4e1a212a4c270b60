"""Whether a machine passes when the advice of all its failing checks is followed at once: for the first page of its report."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from diecut_report.config.loader import Config
from diecut_report.design.advised import advised
from diecut_report.design.varied_machines import varied
from diecut_report.errors import PluginError
from diecut_report.study.definition.base_inputs import MECHANISMS, Input

Data = dict[str, Any]


def followed(config: Config, results: Mapping[str, Any]) -> Data | None:
    """Return the changes that failing checks advise, and which checks fail in the machine with all of them; None where none is advised.

    ``error`` is why there is no such machine, None where there is one.
    """
    failing = [
        (f"{name}.{check['id']}", check)
        for name, data in results["mechanisms"].items()
        for check in data["checks"]
        if check["status"] == "fail"
    ]
    advice = advised(config, failing)
    if advice.is_empty:
        return None
    given: dict[Input, Any] = {design.asked: np.array([value]) for design, value in advice.numbers.values()}
    try:
        made = varied(config, given | {asked: [text] for asked, text in advice.choices.values()}, 1)
    except PluginError:  # told where the report is made; it says nothing of the advice
        return None
    told = {design.asked.path: design.told(value) for design, value in advice.numbers.values()}
    told |= {path: text for path, (_, text) in advice.choices.items()}
    changes = [{"path": path.removeprefix(f"{MECHANISMS}."), "value": text} for path, text in told.items()]
    return {"changes": changes, "failing": made.failing(0), "error": made.reasons[0]}
