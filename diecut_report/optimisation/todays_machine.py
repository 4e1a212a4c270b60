"""Today's machine among those that are searched: the values that the base has for what varies."""

from __future__ import annotations

from typing import Any

from diecut_report.config.loader import Config
from diecut_report.study.definition.base_inputs import Input
from diecut_report.study.definition.study_file import Study


def todays_values(study: Study) -> dict[str, Any]:
    """Return what the base gives for each varied path (SI, texts); what it does not give, or calculates, is left out."""
    found = {path: _value(study.base, asked) for path, asked in study.inputs.items()}
    return {path: value for path, value in found.items() if value is not None}


def _value(base: Config, asked: Input) -> float | str | None:
    instance = base.instances[asked.instance]
    if instance is None or (asked.instance, *asked.key) in base.links:
        return None
    value = instance.value(asked.key)
    if isinstance(value, bool):
        return str(value).lower()
    return float(value) if isinstance(value, int | float) else value if isinstance(value, str) else None
