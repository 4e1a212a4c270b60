"""A study file: read and judged as a whole, against its base, with all that is wrong reported at once."""

from __future__ import annotations

import codecs
import math
import os
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from hashlib import sha256
from pathlib import Path, PurePath
from typing import Any

from diecut_report.config import yaml
from diecut_report.config.loader import Config, beside, load_config
from diecut_report.config.model import PRESS
from diecut_report.config.plugins import Discovery
from diecut_report.config.validation import ConfigPlace, as_typed, validate
from diecut_report.config.yaml import Tree
from diecut_report.errors import Problem, UserError, nearest
from diecut_report.formulas.conditions import ConditionError
from diecut_report.formulas.tree import Node
from diecut_report.study.definition import samples
from diecut_report.study.definition.base_inputs import MECHANISMS, Input
from diecut_report.study.definition.constraints import Constraint, Term, parse, term
from diecut_report.study.definition.sample import (
    OptimiseForm,
    Sampled,
    SampleForm,
    SampleReader,
    StudyDocument,
    misused,
)
from diecut_report.study.definition.samples import Sample
from diecut_report.study.definition.variables import ChoiceVariable, RangeVariable, Variable
from diecut_report.study.definition.wanted_results import Objective, Reports, ResultReader
from diecut_report.text.phrases import Phrase, phrase

# What a study asks of an optimisation: its objectives, what is free, and how long it is searched.


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
        return samples.latin_hypercube(self.variables, self.population, self.seed)

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


@dataclass(frozen=True)
class Study:
    """Hold a valid study. ``inputs`` has each varied path's input, ``units`` its SI unit (None for a text, a choice, a yes/no).

    ``base`` is the config as it stands in its file; ``bases`` are the base with stand-ins for the varied numbers and, one at
    a time, each varied text, so that all of them have the columns of all variants; ``tables`` holds the
    SHA-256 of each table that the sample or the base reads, by its name in the study; ``files`` where base and tables were found.
    ``optimise`` is what is searched for; without a sample of its own the study's is what that search begins with.
    """

    file: Path
    data: dict[str, Any]
    text: str
    sha256: str
    base: Config
    bases: tuple[Config, ...]
    sample: Sample
    inputs: Mapping[str, Input]
    units: Mapping[str, str | None]
    constraints: tuple[Constraint, ...]
    outputs: tuple[str, ...] | None
    curves: tuple[str, ...]
    objectives: tuple[Objective, ...]
    reports: Reports
    tables: Mapping[str, str]
    files: Mapping[str, Path]
    optimise: Optimise | None = None

    @property
    def is_sampled(self) -> bool:
        """Return whether the study says which variants there are, and not only what is searched for."""
        return self.data.get("sample") is not None

    @property
    def content(self) -> bytes:
        """Return its bytes as they were read, with the byte order mark that they began with."""
        own = self.text.encode()
        return own if sha256(own).hexdigest() == self.sha256 else codecs.BOM_UTF8 + own


def load_study(given: Path | Tree, discovery: Discovery, places: Mapping[str, Path] | None = None) -> Study:
    """Read a study (or take what was read of it) and its base; UserError with all problems of both, each with file, line, column and key.

    PluginError where a plugin of the base is broken.

    ``places``: where the files are that the study names, where they are not sought from its folder.
    """
    tree = given if isinstance(given, Tree) else yaml.read(given)
    reader = _StudyReader(Path(tree.file), tree, discovery, places or {})
    study = reader.study()
    if study is None or reader.problems or tree.problems:
        raise UserError(_in_order(beside(tree, reader.problems), tree.file))
    return study


def study_of(tree: Tree, base: Config, discovery: Discovery) -> Study:
    """Return the study of a text, of a base that is read already; UserError with all problems of it."""
    reader = _StudyReader(Path(tree.file), tree, discovery, {}, base)
    study = reader.study()
    if study is None or reader.problems:
        raise UserError(_in_order(reader.problems, tree.file))
    return study


def _in_order(problems: list[Problem], file: str) -> list[Problem]:
    """Those of the study first, then those of its base and its tables."""
    return sorted(dict.fromkeys(problems), key=lambda p: (p.file != file, p.file, p.line or 0, p.column or 0))


@dataclass
class _StudyReader:
    """Reads the parts of a study one by one, each as far as what it needs is sound."""

    path: Path
    tree: Tree
    discovery: Discovery
    places: Mapping[str, Path]
    given: Config | None = None
    problems: list[Problem] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.place = ConfigPlace(self.tree)
        data = as_typed(StudyDocument, self.tree.data, self.place)
        self.problems += validate(StudyDocument, data, self.place)[1]
        self.wrong = {problem.path.split(".")[0] for problem in self.problems}
        known = data if isinstance(data, dict) else {}
        self.data: dict[str, Any] = {
            key: value for key, value in known.items() if key not in self.wrong and value is not None
        }

    def study(self) -> Study | None:
        """The study, or None where there are problems."""
        base, form = self._base(), self._form()
        if base is None:
            return None
        reader = SampleReader(self.place, self._find, base)
        sampled = reader.sampled(form, self.data.get("vary", {}))
        self.problems += reader.problems
        results = ResultReader(self.place, sampled.bases, sampled.inputs)
        constraints = tuple(self._constraints(sampled, results))
        objectives = results.objectives(self.data.get("objectives", []))
        optimise = self._optimise(sampled, results, objectives)
        sampled.sample = sampled.sample or (optimise.first if optimise and "sample" not in self.data else None)
        outputs, curves, reports = self._results(sampled, results, objectives, optimise)
        if outputs is not None and optimise:  # it is judged by what is stored
            outputs = tuple(
                dict.fromkeys([*outputs, *(n for each in constraints for n in each.outputs if ".checks." not in n)])
            )
        if sampled.sample is None or self.problems:
            return None
        tables = sampled.tables | {self._beside_base(name): digest for name, digest in base.files.items()}
        files = {name: self._find(name) for name in (self.data["base"], *tables)}
        units = {path: asked.unit for path, asked in sampled.inputs.items()}
        return Study(self.path, self.tree.data, self.tree.text, self.tree.sha256, base, tuple(sampled.bases), sampled.sample, sampled.inputs, units,
                     constraints, outputs, curves, objectives, reports, tables, files, optimise)  # fmt: skip

    def _find(self, name: str) -> Path:
        """Where a file is that the study names."""
        return self.places.get(name, self.path.parent / name)

    def _beside_base(self, name: str) -> str:
        """What a table that the base names is called in the study."""
        return str(PurePath(self.data["base"]).parent / name)

    def _form(self) -> SampleForm | None:
        """The key sample, or None where it, or what it needs, is wrong."""
        if "sample" not in self.data or "vary" in self.wrong:
            self._without_sample()
            return None
        form = SampleForm.model_validate(self.data["sample"])
        problems = list(misused(form, bool(self.data.get("vary")), self.place))
        self.problems += problems
        return None if problems else form

    def _without_sample(self) -> None:
        """Require a sample, or what is searched for in its place."""
        if "vary" in self.wrong or "sample" in self.wrong:
            return
        if "optimise" not in self.data and "optimise" not in self.wrong:
            words = "is missing; say how the variants are taken, or by optimise what is searched for."
            self.problems.append(self.place.absent(("sample",), phrase(words)))
        elif not self.data.get("vary"):
            self.problems.append(self.place.absent(("vary",), phrase("is missing or empty; vary at least one path.")))

    def _optimise(
        self, sampled: Sampled, results: ResultReader, own: tuple[Objective, ...]
    ) -> Optimise | None:  # fmt: skip
        """What is searched for, None where nothing is or where it has problems."""
        given = self.data.get("optimise")
        if given is None:
            return None
        form = OptimiseForm.model_validate(given)
        named = given.get("objectives")
        objectives = results.objectives(named, ("optimise",)) if named else own
        if not named and not self.data.get("objectives"):
            self.problems.append(without_objectives(self.place))
        reader = OptimiseReader(self.place)
        found = reader.optimise(form, sampled.variables, objectives)
        if sampled.variables is None and self.data.get("sample", {}).get("method") == "table":
            words = "searches in what is varied, and a table has its machines already; give vary, and another sample or none."
            reader.problems.append(self.place.problem(("optimise",), phrase(words), at_key=True))
        self.problems += reader.problems
        return found

    def _base(self) -> Config | None:
        """The base, or None with its problems; these name its own file."""
        if self.given is not None or "base" not in self.data:
            return self.given
        path = self._find(self.data["base"])
        if not os.path.exists(path):
            words = Phrase(
                "there is no file {path}. The base is sought from the study's folder; check its name.", path=path
            )
            self.problems.append(self.place.problem(("base",), words))
            return None
        try:
            base = load_config(path, self.discovery, find=lambda name: self._find(self._beside_base(name)))
        except UserError as error:
            words = phrase(
                "the base has problems, which are reported with its own name; what is varied in it is judged "
                "when they are fixed."
            )
            self.problems += [self.place.problem(("base",), words), *error.problems]
            return None
        if base.broken:  # no variant can be calculated: the author of the plugin must act, not that of the study
            raise next(iter(base.broken.values()))
        return base

    def _constraints(self, sampled: Sampled, results: ResultReader) -> Iterator[Constraint]:
        def find(path: str) -> Term:
            return _output(path, results) or term(sampled.bases[0], sampled.inputs, path)

        for index, text in enumerate(self.data.get("constraints", [])):
            try:
                yield parse(text, find, sampled.inputs)
            except ConditionError as fault:
                self.problems.append(self.place.problem(("constraints", index), str(fault)))

    def _results(
        self, sampled: Sampled, reader: ResultReader, objectives: tuple[Objective, ...], optimise: Optimise | None
    ) -> tuple[tuple[str, ...] | None, tuple[str, ...], Reports]:
        """What is kept of the results; the outputs of objectives are kept in any case."""
        outputs, curves = reader.outputs(self.data.get("outputs")), reader.curves(self.data.get("curves", []))
        count = max((sampled.sample.count if sampled.sample else 0), optimise.evaluations if optimise else 0) or None
        wanted = (*objectives, *(optimise.objectives if optimise else ()))
        reports = reader.reports(self.data.get("reports"), count, bool(self.data.get("objectives")) or bool(optimise))
        self.problems += reader.problems
        kept = [each.output for each in wanted if ".checks." not in each.output and each.output not in sampled.inputs]
        return None if outputs is None else tuple(dict.fromkeys([*outputs, *kept])), curves, reports


def _output(path: str, results: ResultReader) -> Term | None:
    """What a constraint names by NAME.OUTPUT, or by NAME.checks.ID.utilisation; None where that is not a result."""
    if path.startswith((f"{MECHANISMS}.", f"{PRESS}.")):
        return None
    column = results.column(path)
    if column is None and path.partition(".")[0] in results.bases[0].instances:
        near = nearest(path, results.known)
        raise ConditionError(
            Phrase(
                "“{path}” is not an output{near}; an input is named by its whole path, as in mechanisms.{path}.",
                path=path,
                near=near,
            )
        )
    if column is None:
        return None
    node, is_number = Node("sym", (path,)), column.kind in ("float", "int")
    return Term(
        column.unit if is_number else None, node, column.display, is_output=True, is_truth=column.kind == "bool"
    )
