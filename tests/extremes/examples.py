"""The same within the example configs, where what an input changes goes on by references into other mechanisms and comparisons."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

from diecut_report.config.model import Press
from tests.extremes.harness import Extreme, judged, quantities, values
from tests.plugins.cases import CONFIGS, OF_KINDS


def example_extremes(stem: str) -> Iterator[Extreme]:
    """Every single extreme of an example."""
    config = _data(stem)
    homes = [quantities(Press, config["press"], ("press",))]
    for name, body in config["mechanisms"].items():
        homes.append(quantities(OF_KINDS[body["kind"]].inputs, body, ("mechanisms", name)))
    for key, quantity in (found for home in homes for found in home):
        if key[-1] != "n_points":
            for value in dict.fromkeys(map(repr, values(quantity))):
                yield Extreme((stem,), key, json.loads(value))


def example_fault(case: Extreme) -> str | None:
    """What is wrong with the press, or None where all is numbers, or it is refused in words."""
    config = _data(*case.home)
    home: Any = config
    for part in case.key[:-1]:
        home = home.setdefault(part, {}) if isinstance(home, dict) else home[part]
    home[case.key[-1]] = case.value
    return judged(json.dumps(config))


def _data(stem: str) -> dict[str, Any]:
    """An example's plain data, with few samples of its curves."""
    data: dict[str, Any] = json.loads(json.dumps(CONFIGS[stem].tree.data))
    for body in data["mechanisms"].values():
        if "n_points" in OF_KINDS[body["kind"]].inputs.model_fields:
            body["n_points"] = 36
    return data
