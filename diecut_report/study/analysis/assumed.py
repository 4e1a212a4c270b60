"""How much the assumed values of a config matter: each is varied by a tenth, all at once, and the governing checks are looked at."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from diecut_report.config.loader import Config
from diecut_report.expressions import Array
from diecut_report.results.assumed import MOVES
from diecut_report.results.summary import governing
from diecut_report.study.definition.base_inputs import Input, UnknownPath, find_input
from diecut_report.study.execution.press_batch import CalculatedVariants, NotOnArrays, calculated
from diecut_report.study.execution.result_columns import verdicts

Data = Mapping[str, Any]
SHARE = 0.1  # of a value, downwards and upwards


def moves(config: Config, results: Data) -> list[dict[str, Any]]:
    """Return the assumed values that move a governing check of a mechanism: path, check and change of its utilisation.

    Nothing where a plugin cannot take arrays: then the order is that of the file.
    """
    varied = {path: found for path in results["summary"]["assumed"] if (found := _number(config, path))}
    names = _governing(results)
    if not varied or not names:
        return []
    try:
        made = calculated(config, dict(_columns(list(varied.values()))), 1 + 2 * len(varied))
    except NotOnArrays:
        return []
    try:
        return list(_moved(made, list(varied), names))
    finally:
        made.release()


def _number(config: Config, path: str) -> tuple[Input, float] | None:
    """An input with its value in the file; None for what is not a single number there, and for whole numbers, which have no tenth."""
    try:
        asked = find_input(config, path)
    except UnknownPath:
        return None
    instance = config.instances[asked.instance]
    if instance is None or (asked.instance, *asked.key) in config.links or asked.unit is None or asked.is_integer:
        return None
    return asked, float(instance.value(asked.key))


def _columns(varied: list[tuple[Input, float]]) -> Iterator[tuple[Input, Array]]:
    """A column for each input: the first row is the config itself, then two rows for each input."""
    for index, (asked, value) in enumerate(varied):
        column = np.full(1 + 2 * len(varied), value)
        column[1 + 2 * index : 3 + 2 * index] *= (1 - SHARE, 1 + SHARE)
        yield asked, column


def _governing(results: Data) -> list[str]:
    """The governing check of each mechanism, the press's first."""
    found = [governing({name: data}) for name, data in results["mechanisms"].items()]
    whole = [results.get("governing"), *found]
    return list(dict.fromkeys(f"{each['mechanism']}.checks.{each['check']}" for each in whole if each))


def _moved(made: CalculatedVariants, paths: list[str], names: list[str]) -> Iterator[dict[str, Any]]:
    found = verdicts(made.calculations, made.count)
    rows = {name: index for index, name in enumerate(found.names)}
    known = [name for name in names if name in rows]
    for index, path in enumerate(paths):
        at = [1 + 2 * index, 2 + 2 * index]
        changes = {name: _change(found.ratios[rows[name]], at) for name in known}
        name = max(changes, key=lambda each: changes[each], default="")
        if name and changes[name] > MOVES:
            yield {"path": path, "check": name.replace(".checks.", "."), "change": float(f"{changes[name]:.6g}")}


def _change(utilisation: Array, at: list[int]) -> float:
    """The greatest change of a utilisation; a machine that cannot be any more is changed most."""
    changes = np.abs(utilisation[at] - utilisation[0])
    return 0.0 if math.isnan(utilisation[0]) else float(np.where(np.isnan(changes), 1.0, changes).max())
