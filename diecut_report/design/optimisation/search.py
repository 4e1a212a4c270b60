"""How a search sees what varies: shares of ranges, whole numbers, places in a list, and texts; and back."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from pymoo.algorithms.moo.nsga2 import binary_tournament
from pymoo.algorithms.soo.nonconvex.de import DE
from pymoo.algorithms.soo.nonconvex.ga import FitnessSurvival, comp_by_cv_and_fitness
from pymoo.config import Config
from pymoo.core.duplicate import HashDuplicateElimination
from pymoo.core.evaluator import Evaluator
from pymoo.core.mixed import MixedVariableGA, MixedVariableMating, MixedVariableSampling
from pymoo.core.population import Population
from pymoo.core.problem import Problem
from pymoo.core.termination import NoTermination
from pymoo.core.variable import Choice, Integer, Real
from pymoo.operators.selection.tournament import TournamentSelection
from pymoo.operators.survival.rank_and_crowding import RankAndCrowding
from pymoo.problems.static import StaticProblem

from diecut_report.formulas import Array
from diecut_report.study.definition.samples import ChoiceVariable, Values
from diecut_report.study.definition.study_file import Free, Optimise, count_of

Kind = Literal["share", "whole", "text", "fixed"]
Codes = list[dict[str, Any]]
"""Of machines, by the paths of what is free."""
NEAR = 1e-9  # share of a range by which a value may lie beside one of a list


@dataclass(frozen=True)
class Gene:
    """Hold how one variable is searched: as a share of its range, as a whole number from 0, or as one of its texts.

    ``options`` are the different values of a list, numbers in their order: a standard size has neighbours, a text has none.
    """

    variable: Free
    kind: Kind
    options: tuple[Any, ...] = ()
    last: int = 0  # the greatest whole number

    @property
    def path(self) -> str:
        return self.variable.path

    @property
    def is_free(self) -> bool:
        return self.kind != "fixed"

    @property
    def ends(self) -> tuple[float, float]:
        """Return the ends of a range, as they stand in the study."""
        assert not isinstance(self.variable, ChoiceVariable)
        return self.variable.low, self.variable.high

    def column(self, rows: Codes) -> Values:
        """Return the values (SI floats, or texts) that rows of codes stand for."""
        if self.is_free:
            return self._values([row[self.path] for row in rows])
        only = self.options[0] if self.options else self.variable.quantile(np.array([0.5]))[0]
        return [only] * len(rows) if isinstance(only, str) else np.full(len(rows), float(only))

    def _values(self, codes: Sequence[Any]) -> Values:
        if self.kind == "text":
            return [str(code) for code in codes]
        if self.kind == "share":
            return self.variable.quantile(np.asarray(codes, dtype=float))
        numbers = np.asarray(codes, dtype=float).astype(int)
        if self.options:
            return ChoiceVariable(self.path, self.options).at(numbers)
        return min(self.ends) + numbers.astype(float)

    def code(self, value: Any) -> Any:
        """Return the code of a value; None for one that is not among those that are searched."""
        if isinstance(self.variable, ChoiceVariable):
            number = next((n for n, option in enumerate(self.options) if is_alike(option, value)), None)
            return self.options[number] if self.kind == "text" and number is not None else number
        first, last = self.ends
        if isinstance(value, str) or not min(self.ends) <= value <= max(self.ends):
            return None
        if self.kind != "share":
            return round(value - min(self.ends))
        if self.variable.log:
            return float(np.log(value / first) / np.log(last / first))
        return (value - first) / (last - first)


def is_alike(one: Any, other: Any) -> bool:
    """Return whether two values are the same, numbers but for rounding."""
    if isinstance(one, str) or isinstance(other, str):
        return bool(one == other)
    return bool(abs(one - other) <= NEAR * max(abs(one), abs(other)))


def gene(variable: Free) -> Gene:
    """Return how a variable is searched."""
    count = count_of(variable)
    if isinstance(variable, ChoiceVariable):
        is_text = isinstance(variable.values[0], str)
        options = tuple(dict.fromkeys(variable.values)) if is_text else tuple(sorted(set(variable.values)))  # type: ignore[type-var]
        return Gene(variable, "fixed" if count == 1 else "text" if is_text else "whole", options, len(options) - 1)
    if count is None:
        return Gene(variable, "share")
    return Gene(variable, "fixed" if count == 1 else "whole", (), count - 1)


def combinations(genes: Sequence[Gene], start: int, stop: int) -> Codes:
    """Return some of all machines that lists and whole numbers make; the last path changes first."""
    free = [each for each in genes if each.is_free]
    rest: Array = np.arange(start, stop, dtype=np.int64)
    columns: dict[str, list[Any]] = {}
    for each in reversed(free):
        rest, numbers = np.divmod(rest, each.last + 1)
        columns[each.path] = [each.options[n] if each.kind == "text" else int(n) for n in numbers]
    return [{path: column[row] for path, column in columns.items()} for row in range(stop - start)]


# The search itself: which machines to try next, from what is known of those that were tried (pymoo: NSGA-II, differential evolution).
#
# It is asked for a generation and told what came of it. Equal answers make equal questions, so that a search goes on where it ended
# by being told again what is stored.


CROSSED = 0.9  # share of the values that a trial of differential evolution takes from elsewhere: sizes act together
Config.warnings["not_compiled"] = False


def search(asked: Optimise, present: Mapping[str, Any]) -> Search:
    """Return the search that fits; ``present`` has today's values by path, as far as there are any: that machine is tried first."""
    genes = [gene(variable) for variable in asked.variables]
    if asked.is_exhaustive:
        return _All(genes, asked)
    first = _first(genes, asked, present)
    if len(asked.objectives) == 1 and all(each.kind in ("share", "fixed") for each in genes):
        return _Differential(genes, asked, first)
    return _Genetic(genes, asked, first)


def _first(genes: Sequence[Gene], asked: Optimise, present: Mapping[str, Any]) -> Codes:
    """The codes of the first generation: spread evenly, with today's machine before them where it is within what varies."""
    rows = asked.first.rows(0, asked.population)
    free = [each for each in genes if each.is_free]
    columns = {each.path: [each.code(value) for value in rows[each.path]] for each in free}
    codes = [{path: column[row] for path, column in columns.items()} for row in range(asked.population)]
    own = {each.path: each.code(present[each.path]) if each.path in present else None for each in free}
    return codes if None in own.values() else [own, *codes[1:]]


class Search:
    """Propose machines, a generation after the other."""

    def __init__(self, genes: Sequence[Gene]) -> None:
        self.genes, self.free = genes, [each for each in genes if each.is_free]

    def ask(self) -> dict[str, Values]:
        """Return the next generation: a column of values for each path."""
        codes = self._codes()
        return {each.path: each.column(codes) for each in self.genes}

    def _codes(self) -> Codes:
        raise NotImplementedError

    def tell(self, costs: Array, violations: Array) -> None:
        """Take what came of it: the objectives (machines, objectives), less is better, and by how much each is not allowed."""


class _All(Search):
    """Every machine there is: what comes of one changes nothing about the others."""

    def __init__(self, genes: Sequence[Gene], asked: Optimise) -> None:
        super().__init__(genes)
        self.size, self.count, self.done = asked.population, asked.combinations or 0, 0

    def _codes(self) -> Codes:
        start, self.done = self.done, min(self.done + self.size, self.count)
        return combinations(self.genes, start, self.done)


class _Evolution(Search):
    """A search by pymoo."""

    def __init__(self, genes: Sequence[Gene], asked: Optimise, problem: Problem, algorithm: Any) -> None:
        super().__init__(genes)
        self.problem, self.algorithm, self.asked = problem, algorithm, Population.empty()
        self.algorithm.setup(problem, seed=asked.seed, termination=NoTermination())

    def tell(self, costs: Array, violations: Array) -> None:
        known = StaticProblem(self.problem, F=costs, G=violations[:, None])
        Evaluator().eval(known, self.asked)
        self.algorithm.tell(infills=self.asked)


class _Differential(_Evolution):
    """Differential evolution: one objective, ranges alone."""

    def __init__(self, genes: Sequence[Gene], asked: Optimise, first: Codes) -> None:
        free = [each.path for each in genes if each.is_free]
        problem = Problem(n_var=len(free), n_obj=1, n_ieq_constr=1, xl=0.0, xu=1.0)
        sampling = np.array([[row[path] for path in free] for row in first])
        super().__init__(genes, asked, problem, DE(pop_size=len(first), sampling=sampling, CR=CROSSED))

    def _codes(self) -> Codes:
        self.asked = self.algorithm.ask()
        return [{each.path: code for each, code in zip(self.free, row, strict=True)} for row in self.asked.get("X")]


class _Genetic(_Evolution):
    """NSGA-II over ranges, whole numbers, lists and texts; for one objective a genetic algorithm."""

    def __init__(self, genes: Sequence[Gene], asked: Optimise, first: Codes) -> None:
        variables = {each.path: _variable(each) for each in genes if each.is_free}
        problem = Problem(vars=variables, n_obj=len(asked.objectives), n_ieq_constr=1)
        is_single = len(asked.objectives) == 1
        chosen = TournamentSelection(func_comp=comp_by_cv_and_fitness if is_single else binary_tournament)
        unlike = HashDuplicateElimination(_told)
        algorithm = MixedVariableGA(
            pop_size=asked.population, sampling=Population.new(X=first), eliminate_duplicates=unlike,
            mating=MixedVariableMating(selection=chosen, eliminate_duplicates=unlike),
            survival=FitnessSurvival() if is_single else RankAndCrowding(), advance_after_initial_infill=True,
        )  # fmt: skip
        algorithm.tournament_type = "comp_by_dom_and_crowding"
        self.size = asked.population
        super().__init__(genes, asked, problem, algorithm)

    def _codes(self) -> Codes:
        """Where few machines are left that were not tried, others fill the generation up."""
        found = self.algorithm.ask()
        self.asked = Population.empty() if found is None else found
        if missing := self.size - len(self.asked):
            more = MixedVariableSampling().do(self.problem, missing, random_state=self.algorithm.random_state)
            self.asked = Population.merge(self.asked, more)
        return list(self.asked.get("X"))


def _variable(each: Gene) -> Any:
    if each.kind == "share":
        return Real(bounds=(0.0, 1.0))
    return Choice(options=list(each.options)) if each.kind == "text" else Integer(bounds=(0, each.last))


def _told(individual: Any) -> Any:
    """What two equal machines have in common."""
    return hash(tuple(individual.X.items())) if hasattr(individual, "X") else individual
