"""Many machines of one configuration, with other values of some inputs, calculated in one run: what each gives, and which checks hold."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from diecut_report.config.loader import Config
from diecut_report.config.model import PRESS
from diecut_report.config.references import as_file, reached, upstream
from diecut_report.config.yaml import Tree, dotted, key_of
from diecut_report.design.inputs import DesignInput
from diecut_report.errors import PluginError, Problem, UserError
from diecut_report.files import write_all
from diecut_report.formulas import Array
from diecut_report.machine.steps.soundness import is_made
from diecut_report.mechanism.inputs import Quantity
from diecut_report.press import Press
from diecut_report.results.checks import checks_of, is_of_machine, judged
from diecut_report.results.conclusion import SELF_TEST
from diecut_report.results.mechanism_record import CheckRecord
from diecut_report.results.press_run import Tell
from diecut_report.results.warm_press import WarmPress, WarmRun
from diecut_report.study.definition.base_inputs import Input
from diecut_report.study.execution.press_batch import CalculatedVariants, untold
from diecut_report.study.execution.variant_rows import Given, Rows, calculate_rows, columns_of, output_values
from diecut_report.study.storage.description import ResultColumn
from diecut_report.text.phrases import Phrase

CHECKS = ".checks."
AT_LIMIT = 1e-9
STATUS, UTILISATION, MARGIN, SIZE = ".status", ".utilisation", ".margin", ".size"


@dataclass
class VariedMachines(Rows):
    """Hold what came out of each machine, by name: ``drive.crank_torque_peak``, and by its path an input that was asked for.

    ``status`` is pass, warn, fail or error, ``errors`` why one cannot be calculated (None where it can).
    """

    @cached_property
    def exists(self) -> Array:
        """Return which machines can be calculated."""
        return np.asarray(self.status != "error")

    @cached_property
    def passes(self) -> Array:
        """Return which machines can be and have no check that fails."""
        return np.isin(self.status.astype(str), ["pass", "warn"])

    @cached_property
    def checks(self) -> list[str]:
        """Return the checks that are made of any machine, as ``drive.crank_torque``."""
        ends = (name for name in self.columns if name.endswith(MARGIN))
        return [name.removesuffix(MARGIN).replace(CHECKS, ".", 1) for name in ends]

    def values(self, name: str) -> Array:
        """Return a number of each machine (SI); NaN where it has none, also where the name is not known."""
        return self.columns.get(name, np.full(self.count, np.nan)).astype(float)

    def check(self, name: str, what: str = STATUS) -> Array:
        """Return of a check its status, utilisation, margin, or size of the greater side."""
        empty = np.full(self.count, None) if what == STATUS else np.full(self.count, np.nan)
        return self.columns.get(name.replace(".", CHECKS, 1) + what, empty)

    def failing(self, row: int) -> list[str]:
        """Return the checks of one machine that fail."""
        return [name for name in self.checks if self.check(name)[row] == "fail"]

    def least_slack(self, sizes: dict[str, float]) -> Array:
        """Return the slack of the failing check that is furthest beyond its limit, else of the one nearest to it; NaN without machine.

        A slack is a margin by a size that stays the same in all machines: ``sizes`` are those known, to which new ones are added.
        """
        slack = np.full(self.count, np.inf)
        for name in self.checks:
            size = sizes.setdefault(name, float(np.nanmax(self.check(name, SIZE).astype(float), initial=0.0)))
            fails, own = self.check(name) == "fail", self.check(name, MARGIN).astype(float) / (size or 1.0)
            # a warning is neither, and what is at its limit was sized to it
            holds = (self.check(name) == "pass") & (own > AT_LIMIT)
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
        own = {each.path: _input(config, made, each) for each in asked}
        return margins(made) | {path: values for path, values in own.items() if values is not None}

    made = VariedMachines(count)
    vars(made).update(vars(calculate_rows(config, given, count, further=further, tell=tell)))
    if made.broken and not made.exists.any():
        kind, words = next(iter(made.broken.items()))
        raise PluginError(words, kind)
    wanted = {each.path for each in asked if each.unit}
    made.columns |= {each.path: np.asarray(own, dtype=float) for each, own in given.items() if each.path in wanted}
    return made


def impossible(config: Config, reason: str, told: str = "") -> UserError:
    """Return the error of a machine that cannot be calculated, with the line of the key that the reason begins with."""
    line, column = config.tree.position(key_of(reason.partition(": ")[0]))
    return UserError(Problem(told or reason, config.tree.file, line, column))


def quantities(config: Config) -> dict[str, ResultColumn]:
    """Return all numbers that a machine gives, with their units, by name."""
    numbers = (each for each in columns_of(config) if each.kind in ("float", "int"))
    return {each.name: each for each in numbers if CHECKS not in each.name}


def narrowed(config: Config, names: Iterable[str]) -> Config:
    """Return the configuration with these mechanisms alone, and those that they follow from: what else there is need not be calculated."""
    wanted = {PRESS, *upstream(config.links, [PRESS, *names])}
    instances = {name: instance for name, instance in config.instances.items() if name in wanted}
    links = {node: target for node, target in config.links.items() if node[0] in wanted}
    return replace(config, instances=instances, links=links, order=tuple(n for n in config.order if n[0] in wanted))


def downstream(config: Config, name: str) -> list[str]:
    """Return the mechanism, or the press, and all mechanisms that follow from it."""
    followers: dict[str, set[str]] = {}
    for (own, *_), target in config.links.items():
        for each in target.single:
            followers.setdefault(each.instance, set()).add(str(own))
    found = reached(followers, [name])
    return [each for each in config.instances if each in found]


def margins(made: CalculatedVariants) -> dict[str, Array]:
    """Return how far each check is from its limit, and the size of the greater of demand and limit."""
    found: dict[str, Array] = {}
    for name, calc in made.calculations.items():
        for check in checks_of(calc):
            if not (is_of_machine(check) and is_made(calc, check)):
                continue
            sides = judged(calc, check)
            there, demand, limit = (sides.governing(part) for part in (sides.there, sides.demand, sides.limit))
            limit = check.reach(limit)
            size = np.maximum(np.abs(demand), np.abs(limit))
            for what, values in ((MARGIN, limit - demand), (SIZE, size)):
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
    name = dotted(asked.key)
    row = None if calc is None else calc.inputs.get(name)
    if not isinstance(row, np.ndarray):
        return None
    index = next((part for part in asked.key if isinstance(part, int)), 0)
    is_there = row.ndim == 2 and index < row.shape[1]
    return np.broadcast_to(row[:, index], (made.count,)).astype(float) if is_there else None


# Machines with other values of the free inputs, counted: no more of them are calculated than a search may spend.


MOST = 10_000  # machines of a search, unless the user says otherwise


Chosen = tuple[DesignInput, str]
"""An input that takes one of some values, with the one that is chosen, as it is typed."""


class Enough(Exception):
    """Report that a search has calculated as many machines as it may."""


@dataclass
class Spent:
    """Count the machines that were calculated; ``most`` is how many may be."""

    most: float = math.inf
    count: int = 0

    def take(self, count: int) -> None:
        """Note machines that are about to be calculated; Enough where they are too many."""
        if self.count + count > self.most:
            raise Enough
        self.count += count


@dataclass(frozen=True)
class ChangedMachines:
    """Calculate machines by the shares of their inputs that are changed, shape (machines, inputs).

    ``choices`` are texts and stepped numbers, as typed, by their paths. ``tell`` is called with what a search is doing.
    """

    config: Config
    inputs: Sequence[DesignInput]
    choices: Mapping[str, Chosen] = field(default_factory=dict)
    spent: Spent = field(default_factory=Spent)
    tell: Tell = untold

    def __call__(self, shares: Array) -> VariedMachines:
        count = len(shares)
        self.spent.take(count)
        given: dict[Input, Any] = {each.asked: each.changed(shares[:, index]) for index, each in enumerate(self.inputs)}
        for design, text in self.choices.values():
            is_text = design.asked.unit is None
            given[design.asked] = [text] * count if is_text else np.full(count, design.read(text))
        return varied(self.config, given, count)

    @property
    def present(self) -> Array:
        """Return the changes of today's machine: none."""
        return np.zeros(len(self.inputs))


# One machine of a configuration with values written into its text, read again and calculated by itself, as its report would.


@dataclass(frozen=True)
class ProvedMachine:
    """Hold a machine that was calculated alone: the press that it was read as, its calculations and checks."""

    press: Press
    run: WarmRun

    @cached_property
    def outputs(self) -> dict[str, float]:
        """Return its numbers by name, SI."""
        found = {n: v for name, calc in self.run.calculations.items() for n, v in output_values(name, calc).items()}
        return {name: float(v[0]) for name, v in found.items() if v.dtype.kind in "fi" and v[0] == v[0]}

    def checks(self, status: str) -> dict[str, CheckRecord]:
        """Return its checks of a status by name: ``drive.crank_torque``."""
        found = ((f"{name}.{each.id}", each) for name, own in self.run.checks.items() for each in own)
        return {name: each for name, each in found if each.status == status and each.check_class != SELF_TEST}

    @property
    def failing(self) -> tuple[str, ...]:
        """Return the names of the checks that fail."""
        return tuple(self.checks("fail"))

    @property
    def governing(self) -> str | None:
        """Return the check that governs."""
        found = self.run.governing
        return str(found) if found else None


def proved(press: Press, *, is_advised: bool = False) -> ProvedMachine:
    """Return a machine calculated alone; UserError where it cannot exist, PluginError where a plugin breaks.

    ``is_advised`` says whether its failing checks come with advice, which takes longer than all the rest.
    """
    run = WarmPress(is_advised=is_advised).calculate(press.config)
    for error in run.errors.values():
        raise error
    return ProvedMachine(press, run)


def write_config(tree: Tree, machine: ProvedMachine, target: Path) -> None:
    """Write the machine's text as a file: whole, or not at all. UserError where it could not be read there as it is here."""
    home, config = Path(tree.file).resolve().parent, machine.press.config
    if config.files and target.resolve().parent != home:
        template = "The configuration names files beside it ({files}), which would not be found there. Write it into the folder {folder}."
        raise UserError(Problem(Phrase(template, files=", ".join(config.files), folder=home), str(target)))
    write_all({target: as_file(tree, config.tree.text)}, keep=Path(tree.file), through=True)
