"""Whether the machines of a config can exist, without their results: only the steps run on which that depends, or a reference."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from diecut_report.config.instances import Instance
from diecut_report.config.loader import Config
from diecut_report.config.model import PRESS
from diecut_report.config.targets import Target
from diecut_report.contract.inputs import Block, flatten, texts_given
from diecut_report.contract.mechanism import Mechanism
from diecut_report.contract.sections import taken
from diecut_report.contract.steps import Clash, Require
from diecut_report.engine import Calculation, Impossible, calculate
from diecut_report.engine.steps.rerun import needed
from diecut_report.errors import PluginError, Problem
from diecut_report.languages.phrases import phrase
from diecut_report.results.press_run import Run
from diecut_report.results.taken_over import Unavailable


def impossible(config: Config, known: Sequence[Problem]) -> tuple[list[Problem], list[PluginError]]:
    """Return what cannot be in a config, beside the ``known`` problems of it, and the plugins that break on it.

    Mechanisms with a known problem are left out, with those that refer to them.
    """
    run = _FeasibilityRun(config, known)
    return run.problems, [error for name, error in run.errors.items() if name not in config.broken]


class _FeasibilityRun(Run):
    """One way through the graph that stops at what must hold."""

    def __init__(self, config: Config, known: Sequence[Problem]) -> None:
        self.known = known
        self.wrong = {name for name in config.instances for problem in known if _concerns(problem, name)}
        super().__init__(config, lambda _: None)

    def _mechanism(self, name: str) -> None:
        if name in self.wrong:
            self.skipped[name] = phrase("It has problems of its own.")
        else:
            super()._mechanism(name)

    def _referred(self, target: Target) -> Any:
        """Return what a reference stands for; Unavailable where the value there has a problem of its own, for it cannot be read."""
        path = ".".join(map(str, (*_home(target.instance), *target.key)))
        if target.instance in self.wrong and any(_overlap(problem.path, path) for problem in self.known):
            raise Unavailable(target.instance)
        return super()._referred(target)

    def _comparisons(self) -> None:
        """A comparison needs results."""

    def _made(self, instance: Instance, mechanism: Mechanism, block: Block) -> Calculation:
        inputs = flatten(block)
        given = frozenset(inputs) | texts_given(inputs)
        names = [*self._referred_to(instance.name), *_conditions(mechanism, given)]
        if self._is_taken_whole(instance.name):
            return calculate(mechanism, inputs)
        try:
            return calculate(mechanism, inputs, 1, needed(mechanism, given, names))
        except Impossible:  # its words may name what these steps do not know
            return calculate(mechanism, inputs)

    def _printed(self, instance: Instance, calculation: Calculation) -> None:
        """Nothing is printed."""

    def _referred_to(self, name: str) -> Iterator[str]:
        for target in self.config.links.values():
            yield from (str(single.result) for single in target.single if single.instance == name and single.result)

    def _is_taken_whole(self, name: str) -> bool:
        """Whether another mechanism takes it, or a phase of it, which is more than a few of its results."""
        links = self.config.links.values()
        return any(link.instance == name and (link.is_mechanism or link.phase_unit is not None) for link in links)


def _concerns(problem: Problem, name: str) -> bool:
    return f"{problem.path}.".startswith(f"{'.'.join(_home(name))}.")


def _home(name: str) -> tuple[str, ...]:
    """Return the key path of the press or a mechanism."""
    return (PRESS,) if name == PRESS else ("mechanisms", name)


def _overlap(one: str, other: str) -> bool:
    """Return whether one of two key paths is the other or lies within it."""
    return f"{one}.".startswith(f"{other}.") or f"{other}.".startswith(f"{one}.")


def _conditions(mechanism: Mechanism, given: frozenset[str]) -> Iterator[str]:
    """What must be known of what must hold."""
    for step in mechanism.active(given):
        if isinstance(step[1], Require | Clash):
            yield from taken(step[1])
