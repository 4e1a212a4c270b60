"""How much the assumed values of a config matter: each is varied by a tenth, all at once, and the governing checks are looked at."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from diecut_report.config.loader import Config
from diecut_report.errors import PluginError
from diecut_report.expressions import Array
from diecut_report.results.assumed import MOVES
from diecut_report.results.summary import governing
from diecut_report.study.definition.base_inputs import Input, UnknownPath, find_input
from diecut_report.study.execution.press_batch import CalculatedVariants, Mixed, NotOnArrays, calculated
from diecut_report.study.execution.result_columns import verdicts

Data = Mapping[str, Any]
SHARE = 0.1  # of a value, downwards and upwards


def moves(config: Config, results: Data) -> list[dict[str, Any]]:
    """Return the assumed values that move a governing check of a mechanism: path, check and change of its utilisation.

    Mechanisms whose plugin cannot take arrays are left out, with those that refer to them.
    """
    varied = {path: found for path in results["summary"]["assumed"] if (found := _number(config, path))}
    names = _governing(results)
    if not varied or not names:
        return []
    try:
        made = _calculated(config, dict(_columns(list(varied.values()))), 1 + 2 * len(varied))
    except (NotOnArrays, Mixed):  # not of one mechanism that could be left out: the order is that of the file
        return []
    try:
        return list(_moved(made, list(varied), names))
    finally:
        made.release()


def _calculated(config: Config, values: dict[Input, Array], count: int) -> CalculatedVariants:
    """All variants of what can be calculated together; the others are as if their plugins were broken."""
    left_out: dict[str, PluginError] = dict(config.broken)
    while True:
        try:
            return calculated(replace(config, broken=left_out), dict(values), count)
        except NotOnArrays as fault:
            names = [name for name, kind in config.kinds.items() if kind == fault.kind and name not in left_out]
            if not names:
                raise
            left_out |= {name: PluginError(fault.words, fault.kind, name) for name in names}


def _number(config: Config, path: str) -> tuple[Input, float] | None:
    """An input with its value in the file; None for what is not a single number there (also words, and a time in place of an angle), and
    for whole numbers, which have no tenth.
    """
    try:
        asked = find_input(config, path)
    except UnknownPath:
        return None
    instance = config.instances[asked.instance]
    if instance is None or (asked.instance, *asked.key) in config.links or asked.unit is None or asked.is_integer:
        return None
    value = instance.value(asked.key)
    return (asked, float(value)) if isinstance(value, int | float) else None


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
