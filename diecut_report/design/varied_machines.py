"""Many machines of one configuration, with other values of some inputs, calculated in one run: what each gives, and which checks hold."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from diecut_report.config.loader import Config
from diecut_report.config.model import PRESS
from diecut_report.contract.inputs import Quantity
from diecut_report.engine.steps.extreme_checks import is_made
from diecut_report.errors import PluginError
from diecut_report.expressions import Array
from diecut_report.results.checks import checks_of, is_sized, judged
from diecut_report.results.press_run import Tell
from diecut_report.results.unchecked import is_of_machine
from diecut_report.study.definition.base_inputs import Input
from diecut_report.study.execution.press_batch import CalculatedVariants, untold
from diecut_report.study.execution.result_columns import columns_of
from diecut_report.study.execution.variant_rows import Given, Rows, calculate_rows
from diecut_report.study.storage.description import ResultColumn

CHECKS = ".checks."
AT_LIMIT = 1e-9
STATUS, UTILISATION, SLACK, MARGIN, SIZE = ".status", ".utilisation", ".slack", ".margin", ".size"
NO_RESERVE = ".no_reserve"  # 1 where a check judges what was sized to its limit, or what is presumed


@dataclass(frozen=True)
class VariedMachines:
    """Hold what came out of each machine, by name: ``drive.crank_torque_peak``, and by its path an input that was asked for.

    ``status`` is pass, warn, fail or error, ``reasons`` why one cannot be calculated (None where it can).
    """

    rows: Rows

    @property
    def count(self) -> int:
        return self.rows.count

    @property
    def status(self) -> Array:
        return self.rows.status

    @property
    def reasons(self) -> Array:
        return self.rows.errors

    @cached_property
    def exists(self) -> Array:
        """Return which machines can be calculated."""
        return np.asarray(self.rows.status != "error")

    @cached_property
    def checks(self) -> list[str]:
        """Return the checks that are made of any machine, as ``drive.crank_torque``."""
        ends = (name for name in self.rows.columns if name.endswith(SLACK))
        return [name.removesuffix(SLACK).replace(CHECKS, ".", 1) for name in ends]

    def values(self, name: str) -> Array:
        """Return a number of each machine (SI); NaN where it has none, also where the name is not known."""
        found = self.rows.columns.get(name)
        return np.full(self.count, np.nan) if found is None else found.astype(float)

    def check(self, name: str, what: str = STATUS) -> Array:
        """Return of a check its status, utilisation, margin, size of the greater side, slack (margin by size), or whether it shows no reserve."""
        home, _, own = name.partition(".")
        found = self.rows.columns.get(f"{home}{CHECKS}{own}{what}")
        return (
            np.full(self.count, None if what == STATUS else np.nan, dtype=object if what == STATUS else float)
            if found is None
            else found
        )

    def failing(self, row: int, *, statuses: Sequence[str] = ("fail",)) -> list[str]:
        """Return the checks of one machine that fail, or have one of other statuses."""
        return [name for name in self.checks if self.check(name)[row] in statuses]

    @cached_property
    def least_slack(self) -> Array:
        """Return the slack of the failing check that is furthest beyond its limit, else of the one nearest to it; NaN without machine."""
        slack = np.full(self.count, np.inf)
        for name in self.checks:
            fails, own = self.check(name) == "fail", self.check(name, SLACK)
            holds = (self.check(name) == "pass") & (
                own > AT_LIMIT
            )  # a warning is neither, and what is at its limit was sized to it
            found = np.where(fails, np.minimum(own, -AT_LIMIT), own)
            slack = np.where((fails | holds) & np.isfinite(own), np.minimum(slack, found), slack)
        return np.where(self.exists, slack, np.nan)


def varied(
    config: Config, given: Given, count: int, inputs: Iterable[Input] = (), tell: Tell = untold
) -> VariedMachines:
    """Calculate so many machines of a configuration with other values: arrays of shape (count,), SI, or lists of texts.

    ``inputs`` are those whose values are to be among the results. ``tell`` is called with the name of each mechanism before
    it is calculated; what it raises ends the run. PluginError where a plugin breaks on every machine.
    """
    asked = list(inputs)

    def further(made: CalculatedVariants) -> dict[str, Array]:
        return _slack(made) | {
            each.path: values for each in asked if (values := _input(config, made, each)) is not None
        }

    rows = calculate_rows(config, given, count, further=further, tell=tell)
    if rows.broken and all(rows.status == "error"):
        kind, words = next(iter(rows.broken.items()))
        raise PluginError(words, kind)
    wanted = {each.path for each in asked if each.unit}
    rows.columns |= {
        each.path: np.asarray(values, dtype=float) for each, values in given.items() if each.path in wanted
    }
    return VariedMachines(rows)


def quantities(config: Config) -> dict[str, ResultColumn]:
    """Return all numbers that a machine gives, with their units, by name."""
    return {
        column.name: column
        for column in columns_of(config)
        if column.kind in ("float", "int") and CHECKS not in column.name
    }


def narrowed(config: Config, names: Iterable[str]) -> Config:
    """Return the configuration with these mechanisms alone, and those that they follow from: what else there is need not be calculated."""
    wanted = {PRESS, *upstream(config, [PRESS, *names])}
    instances = {name: instance for name, instance in config.instances.items() if name in wanted}
    links = {node: target for node, target in config.links.items() if node[0] in wanted}
    return replace(config, instances=instances, links=links, order=tuple(n for n in config.order if n[0] in wanted))


def upstream(config: Config, names: Iterable[str]) -> set[str]:
    """Return these mechanisms and all that they follow from, the press too where they do."""
    found: set[str] = set()
    left = list(names)
    while left:
        name = left.pop()
        found.add(name)
        own = (target for node, target in config.links.items() if node[0] == name)
        left += [each.instance for target in own for each in target.single if each.instance not in found]
    return found


def downstream(config: Config, name: str) -> list[str]:
    """Return the mechanism, or the press, and all mechanisms that follow from it."""
    return [each for each in config.instances if name in upstream(config, [each])]


def _slack(made: CalculatedVariants) -> dict[str, Array]:
    """How far each check is from its limit: the margin as a share of the greater of demand and limit."""
    found: dict[str, Array] = {}
    for name, calc in made.calculations.items():
        for check in checks_of(calc):
            if not (is_of_machine(check) and is_made(calc, check)):
                continue
            sides = judged(calc, check)
            there, demand, limit = (sides.governing(part) for part in (sides.there, sides.demand, sides.limit))
            limit = limit * (1 + check.tolerance)
            size = np.maximum(np.abs(demand), np.abs(limit))
            with np.errstate(all="ignore"):
                share = np.where(size > 0, (limit - demand) / size, 0.0)
            shows_none = np.full(share.shape, float(is_sized(calc.given, check) or check.presumed))
            for what, values in ((SLACK, share), (MARGIN, limit - demand), (SIZE, size), (NO_RESERVE, shows_none)):
                column = np.where(there, values, np.nan)
                found[f"{name}{CHECKS}{check.id}{what}"] = np.broadcast_to(column, (made.count,))
    return found


def _input(config: Config, made: CalculatedVariants, asked: Input) -> Array | None:
    """An input's value in each machine, as the calculation took it; of the press as the file gives it."""
    assert isinstance(asked.meta, Quantity)
    if asked.instance == PRESS:
        instance = config.instances[PRESS]
        value = instance.value(asked.key) if instance and (PRESS, *asked.key) not in config.links else None
        return np.full(made.count, float(value)) if isinstance(value, int | float) else None
    calc = made.calculations.get(asked.instance)
    name = ".".join(part for part in asked.key if isinstance(part, str))
    row = None if calc is None else calc.inputs.get(name)
    if not isinstance(row, np.ndarray):
        return None
    index = next((part for part in asked.key if isinstance(part, int)), 0)
    return (
        np.broadcast_to(row[:, index], (made.count,)).astype(float) if row.ndim == 2 and index < row.shape[1] else None
    )
