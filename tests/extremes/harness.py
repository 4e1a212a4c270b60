"""Puts single extreme values into a machine's inputs and calculates it in this process: numbers, or an error in words, and nothing else."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any, NamedTuple

from diecut_report.config.model import PressBlock
from diecut_report.config.yaml import KeyPath
from diecut_report.mechanism.inputs import Quantity, meta_of
from diecut_report.results.warm_press import WarmPress
from diecut_report.testing.extreme_inputs import extreme_values as values
from diecut_report.testing.extreme_inputs import numeric_inputs as quantities
from diecut_report.testing.extreme_inputs import outcome_of, with_value
from tests.plugins.cases import DISCOVERY, FULL, OF_KINDS

ALONE = {
    kind: machines for kind, machines in FULL.items() if not OF_KINDS[kind].partners
}  # others take curves of a whole press
REMEMBERED = WarmPress()  # of an example's press an extreme changes little
SHEET = {"length": "700 mm", "width": "500 mm", "thickness": "0.6 mm"}


class Extreme(NamedTuple):
    """One input of a kind's machine, or of an example, and the extreme value that it gets, in its display unit."""

    home: tuple[str, ...]
    key: KeyPath
    value: float | int
    unit: str = "1"

    @property
    def name(self) -> str:
        """What a failure calls it."""
        return f"{'-'.join(self.home)} {'.'.join(map(str, self.key))} = {self.value!r}"


def extremes(kind: str, *, short: bool = False) -> Iterator[Extreme]:
    """Every single extreme of the machines of a kind (``short``: of one): each numeric input of it, of the press and its sheet."""
    written = {machine: keys for machine, keys in FULL[kind].items() if _can_be_written(keys)}
    for machine, keys in list(written.items())[: 1 if short else None]:
        config = _config(kind, keys)
        for key, quantity in (*quantities(OF_KINDS[kind].inputs, config["mechanisms"]["a"], ("mechanisms", "a")),
                              *(quantities(PressBlock, config["press"], ("press",)) if from_press(kind) else ())):  # fmt: skip
            for value in dict.fromkeys(map(repr, values(quantity))):
                yield Extreme((kind, machine), key, json.loads(value), quantity.unit)


def _can_be_written(keys: dict[str, Any]) -> bool:
    """Whether a config file can give a machine: not where a test gives it a curve as a function."""
    try:
        json.dumps(keys)
    except TypeError:
        return False
    return True


def _config(kind: str, keys: dict[str, Any]) -> dict[str, Any]:
    machine = json.loads(json.dumps(keys)) | {"kind": kind}
    if "n_points" in OF_KINDS[kind].inputs.model_fields:
        machine["n_points"] = 36
    press = {"name": "P", "productivity": "6000 1/h", "sheet": dict(SHEET)}
    return {"schema_version": 1, "project": {"title": "T"}, "press": press, "mechanisms": {"a": machine}}


def fault(case: Extreme) -> str | None:
    """What is wrong with the machine, or None where it is a machine with numbers, or is refused in words."""
    kind, machine = case.home
    config = _config(kind, FULL[kind][machine])
    for name in from_press(kind) if case.key[0] == "press" else ():
        config["mechanisms"]["a"].pop(name, None)
    return judged(with_value(config, case.key, case.value, case.unit))


def from_press(kind: str) -> list[str]:
    """The inputs of a kind that the press stands in for."""
    own = OF_KINDS[kind].inputs
    metas = ((name, meta_of(own, name)) for name in own.model_fields)
    return [name for name, meta in metas if isinstance(meta, Quantity) and meta.press]


def judged(text: str) -> str | None:
    """What is wrong with the outcome of a config's text."""
    return outcome_of(text, DISCOVERY, REMEMBERED).fault
