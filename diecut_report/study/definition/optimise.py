"""What a study asks of an optimisation: its objectives, what is free, and how long it is searched."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from diecut_report.config.validation import ConfigPlace
from diecut_report.errors import Problem
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.study.definition.form import OptimiseForm
from diecut_report.study.definition.wanted_results import Objective
from diecut_report.study.sampling import methods
from diecut_report.study.sampling.methods import Sample
from diecut_report.study.sampling.variables import ChoiceVariable, RangeVariable, Variable

# population by default: so many generations, each of at least and at most so many machines
SHARE, LEAST, MOST = 40, 40, 500
Free = ChoiceVariable | RangeVariable


@dataclass(frozen=True)
class Optimise:
    """Hold what is searched for: objectives, the variables, how many machines are tried, how many of them in a generation.

    ``is_passing``: only machines of which no check fails; ``points``: how many of the front are listed.
    """

    objectives: tuple[Objective, ...]
    variables: tuple[Free, ...]
    evaluations: int
    population: int
    seed: int
    is_passing: bool
    points: int

    @property
    def first(self) -> Sample:
        """Return the machines that the search begins with, spread evenly."""
        return methods.latin_hypercube(self.variables, self.population, self.seed)

    @property
    def combinations(self) -> int | None:
        """Return how many machines there are at all; None where a range has any number of them."""
        counts = [count_of(variable) for variable in self.variables]
        return None if None in counts else math.prod(count or 1 for count in counts)

    @property
    def is_exhaustive(self) -> bool:
        """Return whether every machine there is can be tried."""
        return self.combinations is not None and self.combinations <= self.evaluations


def count_of(variable: Free) -> int | None:
    """Return how many different values a variable has, None where it is a range of any."""
    if isinstance(variable, ChoiceVariable):
        return len(set(variable.values))
    if variable.low == variable.high:
        return 1
    return round(abs(variable.high - variable.low)) + 1 if variable.integer else None


class OptimiseReader:
    """Judge the key ``optimise`` beside what is varied; gathers ``problems``."""

    def __init__(self, place: ConfigPlace) -> None:
        self.place = place
        self.problems: list[Problem] = []

    def optimise(
        self, form: OptimiseForm, variables: Sequence[Variable] | None, objectives: tuple[Objective, ...]
    ) -> Optimise | None:
        """Return what is searched for, or None with the problems; ``variables`` are None where they have problems of their own."""
        if variables is None:
            return None
        free = tuple(each for each in variables if isinstance(each, Free))
        for each in variables:
            if not isinstance(each, Free):
                words = "is a distribution, which scatters; an optimisation searches within a range {from: …, to: …} or a list."
                self._report(("vary", each.path), phrase(words))
        if len(free) == len(variables) and all(count_of(each) == 1 for each in free):
            single = "leaves nothing free: each path has a single value. Give one a range or more values."
            self._report(("vary",), phrase(single))
        if form.population is not None and form.population > form.evaluations:
            words = Phrase(
                "is {population}, more than the evaluations, {evaluations}; give fewer here, or more of those.",
                population=form.population, evaluations=form.evaluations,
            )  # fmt: skip
            self._report(("optimise", "population"), words)
        if self.problems or not objectives:
            return None
        usual = min(max(form.evaluations // SHARE, LEAST), MOST)
        population = min(form.population or usual, form.evaluations)
        return Optimise(
            objectives, free, form.evaluations, population, form.seed, form.passing, form.points
        )  # fmt: skip

    def _report(self, key: tuple[str, ...], words: str) -> None:
        self.problems.append(self.place.problem(key, phrase(words), at_key=key == ("vary",)))


def without_objectives(place: ConfigPlace) -> Problem:
    """Return the problem of an optimisation that has nothing to search for."""
    words = "is missing; name what is to be small or great, such as objectives: [{minimise: cylinder.mass}]."
    return place.absent(("optimise", "objectives"), phrase(words))
