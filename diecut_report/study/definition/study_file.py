"""A study file: read and judged as a whole, against its base and the results that this has, with all that is wrong reported at once."""

from __future__ import annotations

import math
import os
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path, PurePath
from typing import Any, Literal

from diecut_report.config import yaml
from diecut_report.config.loader import Config, beside
from diecut_report.config.model import PRESS
from diecut_report.config.plugins import Discovery
from diecut_report.config.validation import ConfigPlace, as_typed, quoted, validate
from diecut_report.config.yaml import KeyPath, Tree
from diecut_report.errors import Problem, UserError, nearest
from diecut_report.formulas.condition_parts import Name
from diecut_report.formulas.conditions import ConditionError
from diecut_report.formulas.tree import Node
from diecut_report.press import Press
from diecut_report.study.definition.base_inputs import MECHANISMS, Input
from diecut_report.study.definition.constraints import Constraint, parse, term
from diecut_report.study.definition.sample import Sampled, SampleReader, misused
from diecut_report.study.definition.samples import ChoiceVariable, LatinHypercube, RangeVariable, Sample
from diecut_report.study.definition.schema import OptimiseForm, SampleForm, StudyDocument
from diecut_report.study.execution.variant_rows import columns_of
from diecut_report.text.phrases import Counted, Phrase, message, phrase

MAX_LISTED = 12  # known names that a message lists
Sort = Literal["number", "other", "check", "utilisation", "curve", "row", "unknown"]


@dataclass(frozen=True)
class Objective:
    """Name a quantity that is to be small or great: an output (``cylinder.mass``), ``NAME.checks.ID.utilisation`` or a varied input."""

    output: str
    minimise: bool


@dataclass(frozen=True)
class Reports:
    """Say which variants get a full report: none, the failed ones, the best by the objectives, all, or those with these numbers."""

    which: Literal["none", "failed", "best", "all", "ids"] = "none"
    best: int = 0
    ids: tuple[int, ...] = ()


class ResultReader:
    """Read what is asked of the results of any of the bases that a study's texts make; adds to ``problems``."""

    def __init__(
        self, place: ConfigPlace, problems: list[Problem], bases: Sequence[Config], inputs: Mapping[str, Input]
    ) -> None:
        self.place, self.problems, self.inputs = place, problems, inputs
        self.mechanisms = [name for name in bases[0].instances if name != PRESS]
        self.columns = {column.name: column for base in bases for column in columns_of(base)}
        self.sorts: dict[str, Sort] = {}
        for name, column in self.columns.items():
            self.sorts[name] = "number" if column.is_number else "other"
            if ".checks." in name:
                self.sorts[name] = "utilisation" if name.endswith(".utilisation") else "check"
        instances = (base.instances[name] for base in bases for name in self.mechanisms)
        for instance in (each for each in instances if each):
            many = [key for key, (_, is_many) in instance.results.items() if is_many]
            self.sorts |= {f"{instance.name}.{key}": "row" if key in instance.rows else "curve" for key in many}

    def kept(self, key: Literal["outputs", "curves"], given: list[str]) -> tuple[str, ...]:
        """Return the outputs or the curves to keep."""
        is_one = self._is_output if key == "outputs" else self._is_curve
        return tuple(dict.fromkeys(name for index, name in enumerate(given) if is_one((key, index), name)))

    def objectives(self, given: list[dict[str, Any]], home: tuple[str, ...] = ()) -> tuple[Objective, ...]:
        """Return the objectives in their order; ``home`` is the block that they stand in."""
        found: dict[str, Objective] = {}
        for index, entry in enumerate(given):
            key: KeyPath = (*home, "objectives", index)
            made = self._objective(key, entry)
            if made and made.output in found:
                template = "{name} is an objective already; name each number once, to be minimised or maximised."
                self._fault(key, template, name=made.output)
            elif made:
                found[made.output] = made
        return tuple(found.values())

    def reports(self, given: Any, count: int | None, has_objectives: bool) -> Reports:
        """Return which variants get a full report; ``count`` is that of the sample, None where it is not known."""
        if isinstance(given, list):
            return Reports("ids", ids=tuple(dict.fromkeys(self._numbers(given, count))))
        match str("none" if given is None else given).split():
            case [("none" | "failed" | "all") as which]:
                return Reports(which)
            case ["best", number] if re.fullmatch(r"[1-9]\d{0,8}", number):
                if not has_objectives:
                    self._fault(("reports",), "best needs objectives, such as objectives: [{minimise: cylinder.mass}].")
                return Reports("best", int(number))
        template = "is {given}{nearest}; allowed: none, failed, best N (best 10), all, or a list of variants' numbers, as in [0, 17]."
        near = nearest(str(given), ("none", "failed", "all"))
        self._fault(("reports",), template, given=quoted(given), nearest=near)
        return Reports()

    def _numbers(self, given: list[Any], count: int | None) -> Iterator[int]:
        for index, number in enumerate(given):
            if not isinstance(number, int) or isinstance(number, bool):
                template = "is {number}; a variant has a whole number, as in [0, 17]."
                self._fault(("reports", index), template, number=quoted(number))
            elif count is not None and not 0 <= number < count:
                template = "there is no variant {number}; variants are numbered from 0 to {last}."
                self._fault(("reports", index), template, number=number, last=count - 1)
            elif number < 0:
                template = "there is no variant {number}; variants are numbered from 0."
                self._fault(("reports", index), template, number=number)
            else:
                yield number

    # --- one name ----------------------------------------------------------------------------------------------------

    def _objective(self, key: KeyPath, entry: dict[str, Any]) -> Objective | None:
        given = {name: value for name, value in entry.items() if value is not None}
        if len(given) != 1:
            template = "names {count} outputs; give minimise or maximise with one, and an entry for each."
            none = "names no outputs; give minimise or maximise with one, and an entry for each."
            self._fault(key, template if given else none, count=len(given))
            return None
        (way, name), = given.items()  # fmt: skip
        is_input = name.startswith((f"{MECHANISMS}.", f"{PRESS}."))
        is_known = self._is_varied_number((*key, way), name) if is_input else self._is_number((*key, way), name)
        return Objective(name, way == "minimise") if is_known else None

    def _is_varied_number(self, key: KeyPath, name: str) -> bool:
        """Return whether an input is a number that varies: one that does not is the same in all variants."""
        numbers = [path for path, asked in self.inputs.items() if asked.unit]
        if name in numbers:
            return True
        if name in self.inputs:
            template = "{name} is a text, a choice or a yes/no, which cannot be minimised or maximised; name a number."
            self._fault(key, template, name=name)
            return False
        template = "{name} is not varied, so it is the same in all variants{near}; an output is named as NAME.OUTPUT. Varied numbers: {known}."
        self._fault(key, template, name=name, near=nearest(name, numbers), known=", ".join(numbers) or "–")
        return False

    def _is_number(self, key: KeyPath, name: str) -> bool:
        sort = self._sort(key, name)
        if sort == "other":
            template = "{name} is a text or a yes/no, which cannot be minimised or maximised; name a number."
            self._fault(key, template, name=name)
        elif sort not in ("number", "utilisation", None):
            self._report_no_output(key, name)
        return sort in ("number", "utilisation")

    def _is_output(self, key: KeyPath, name: str) -> bool:
        sort = self._sort(key, name)
        if sort in ("check", "utilisation"):
            self._fault(key, "{name}: checks are kept in any case; remove it.", name=name)
        elif sort not in ("number", "other", None):
            self._report_no_output(key, name)
        return sort in ("number", "other")

    def _is_curve(self, key: KeyPath, name: str) -> bool:
        sort = self._sort(key, name)
        if sort in ("number", "other", "row"):
            self._fault(key, "{name} is a single value; name it in outputs.", name=name)
        elif sort not in ("curve", None):
            self._fault(key, "{name} is not a curve{nearest}", name=name, nearest=self._near(name, "curve"))
        return sort == "curve"

    def _report_no_output(self, key: KeyPath, name: str) -> None:
        sorts: tuple[Sort, ...] = ("utilisation",) if ".checks." in name else ("number", "other")
        template = "{name} is not an output{nearest}"
        if self.sorts.get(name) == "row":
            template = "{name} has a value for each part of a list; name one, as in {name}.0."
        elif self.sorts.get(name) == "curve":
            template = "{name} is a curve; only single values are kept here, curves by the key curves."
        self._fault(key, template, name=name, nearest=self._near(name, *sorts))

    def _sort(self, key: KeyPath, name: str) -> Sort | None:
        """Return what a name stands for; None, with the problem, where it names no mechanism, or nothing of one."""
        first, _, inner = str(name).partition(".")
        if first in self.mechanisms and inner:
            return self.sorts.get(name, "unknown")
        if first in self.mechanisms:
            example = next(iter(self._names(first, "number")), "output")
            template = "{name} names no output; add one, as in {first}.{example}."
            self._fault(key, template, name=name, first=first, example=example)
        elif first == MECHANISMS:
            template = "{name}: outputs are named without mechanisms., as in {inner}."
            self._fault(key, template, name=name, inner=inner or "drive.crank_torque_peak")
        else:
            template = "{name}: there is no mechanism {first}{nearest}. Known: {names}."
            near, known = nearest(first, self.mechanisms), ", ".join(self.mechanisms)
            self._fault(key, template, name=name, first=repr(first), nearest=near, names=known)
        return None

    def _names(self, mechanism: str, *sorts: Sort) -> list[str]:
        known = (name.partition(".") for name, sort in self.sorts.items() if sort in sorts)
        return sorted(inner for first, _, inner in known if first == mechanism)

    def _near(self, name: str, *sorts: Sort) -> Phrase:
        first, _, inner = name.partition(".")
        names = self._names(first, *sorts)
        near = nearest(inner, names)
        if near or not names:
            return Phrase("{near}.", near=near) if near else phrase(". Known: none.")
        more, listed = len(names) - MAX_LISTED, ", ".join(names[:MAX_LISTED])
        if more <= 0:
            return Phrase(". Known: {names}.", names=listed)
        return Counted(more, ". Known: {names} and {n} more.", ". Known: {names} and {n} more.", names=listed)

    def _fault(self, key: KeyPath, template: str, **values: object) -> None:
        self.problems.append(self.place.problem(key, message(template, values)))


GENERATIONS, MIN_POPULATION, MAX_POPULATION = 40, 40, 500  # by which the default size of a generation is found
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
        return LatinHypercube(self.variables, self.population, self.seed)

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


@dataclass(frozen=True)
class Study:
    """Hold a valid study. ``inputs`` has each varied path's input.

    ``base`` is the config as it stands in its file; ``bases`` are the base with stand-ins for the varied numbers and, one at
    a time, each varied text, so that all of them have the columns of all variants; ``tables`` holds the
    SHA-256 of each table that the sample or the base reads, by its name in the study; ``files`` where base and tables were found.
    ``optimise`` is what is searched for; without a sample of its own the study's is what that search begins with.
    """

    tree: Tree
    base: Config
    bases: tuple[Config, ...]
    sample: Sample
    inputs: Mapping[str, Input]
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
        return self.tree.data.get("sample") is not None


def load_study(
    given: Path | Tree, discovery: Discovery, places: Mapping[str, Path] | None = None, base: Config | None = None
) -> Study:
    """Read a study (or take what was read of it) and its base; UserError with all problems of both, each with file, line, column and key.

    PluginError where a plugin of the base is broken.

    ``places``: where the files are that the study names, where they are not sought from its folder. ``base``: what was read of it.
    """
    tree = given if isinstance(given, Tree) else yaml.read(given)
    reader = _StudyReader(tree, discovery, places or {}, base)
    study = reader.study()
    if study is None or reader.problems or tree.problems:
        found = dict.fromkeys(beside(tree, reader.problems))  # of the study first, then of its base and its tables
        raise UserError(sorted(found, key=lambda p: (p.file != tree.file, p.file, p.line or 0, p.column or 0)))
    return study


@dataclass
class _StudyReader:
    """Read the parts of a study one by one, each as far as what it needs is sound."""

    tree: Tree
    discovery: Discovery
    places: Mapping[str, Path]
    given: Config | None
    problems: list[Problem] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.place = ConfigPlace(self.tree)
        data = as_typed(StudyDocument, self.tree.data, self.place)
        self.problems += validate(StudyDocument, data, self.place)[1]
        self.wrong = {problem.path.split(".")[0] for problem in self.problems}
        known = data.items() if isinstance(data, dict) else ()
        self.data: dict[str, Any] = {key: value for key, value in known if key not in self.wrong and value is not None}

    def study(self) -> Study | None:
        """Return the study, or None where there are problems."""
        base, form = self._base(), self._sample_form()
        if base is None:
            return None
        sampled = SampleReader(self.place, self.problems, self._find, base).sampled(form, self.data.get("vary", {}))
        results = ResultReader(self.place, self.problems, sampled.bases, sampled.inputs)
        constraints = tuple(self._constraints(sampled, results))
        objectives = results.objectives(self.data.get("objectives", []))
        optimise = self._optimise(sampled, results, objectives)
        sample = sampled.sample or (optimise.first if optimise and "sample" not in self.data else None)
        wanted = [each.output for each in (*objectives, *(optimise.objectives if optimise else ()))]
        if optimise:  # it is judged by what is stored
            wanted += [name for each in constraints for name in each.outputs]
        outputs = self._outputs(results, [name for name in wanted if name not in sampled.inputs])
        curves = results.kept("curves", self.data.get("curves", []))
        count = max(sample.count if sample else 0, optimise.evaluations if optimise else 0) or None
        has_objectives = bool(self.data.get("objectives") or optimise)
        reports = results.reports(self.data.get("reports"), count, has_objectives)
        if sample is None or self.problems:
            return None
        tables = sampled.tables | {self._beside_base(name): digest for name, digest in base.files.items()}
        files = {name: self._find(name) for name in (self.data["base"], *tables)}
        return Study(self.tree, base, tuple(sampled.bases), sample, sampled.inputs, constraints, outputs, curves, objectives, reports,
                     tables, files, optimise)  # fmt: skip

    def _outputs(self, results: ResultReader, wanted: list[str]) -> tuple[str, ...] | None:
        """Return the outputs to keep, None for all; those that the study itself needs are kept in any case."""
        if "outputs" not in self.data:
            return None
        needed = (name for name in wanted if ".checks." not in name)
        return tuple(dict.fromkeys([*results.kept("outputs", self.data["outputs"]), *needed]))

    def _fault(self, key: KeyPath, template: str, *, at_key: bool = False, **values: object) -> None:
        self.problems.append(self.place.problem(key, message(template, values), at_key=at_key))

    def _find(self, name: str) -> Path:
        return self.places.get(name, Path(self.tree.file).parent / name)

    def _beside_base(self, name: str) -> str:
        return str(PurePath(self.data["base"]).parent / name)

    def _base(self) -> Config | None:
        if self.given is not None or "base" not in self.data:
            return self.given
        path = self._find(self.data["base"])
        if path.resolve() == Path(self.tree.file).resolve():
            self._fault(("base",), "is this study itself; name the configuration whose inputs it varies.")
            return None
        if not os.path.exists(path):
            template = "there is no file {path}. The base is sought from the study's folder; check its name."
            self._fault(("base",), template, path=path)
            return None
        try:
            base = Press.read(path, self.discovery, find=lambda name: self._find(self._beside_base(name)))
        except UserError as error:
            template = "the base has problems, which are reported with its own name; what is varied in it is judged when they are fixed."
            self.problems += [self.place.problem(("base",), template), *error.problems]
            return None
        return base.usable().config  # with a broken plugin its author must act, not that of the study

    def _sample_form(self) -> SampleForm | None:
        """Return the key sample, or None where it, or what it needs, is wrong."""
        if "vary" in self.wrong or "sample" in self.wrong:
            return None
        if "sample" not in self.data:
            if "optimise" not in self.data and "optimise" not in self.wrong:
                template = "is missing; say how the variants are taken, or by optimise what is searched for."
                self.problems.append(self.place.absent(("sample",), template))
            elif not self.data.get("vary"):
                self.problems.append(self.place.absent(("vary",), "is missing or empty; vary at least one path."))
            return None
        form = SampleForm.model_validate(self.data["sample"])
        problems = list(misused(form, bool(self.data.get("vary")), self.place))
        self.problems += problems
        return None if problems else form

    def _optimise(self, sampled: Sampled, results: ResultReader, own: tuple[Objective, ...]) -> Optimise | None:
        """Return what is searched for, None where nothing is or where it has problems."""
        given = self.data.get("optimise")
        if given is None:
            return None
        form = OptimiseForm.model_validate(given)
        named = given.get("objectives")
        objectives = results.objectives(named, ("optimise",)) if named else own
        before = len(self.problems)
        if not named and not self.data.get("objectives"):
            template = "is missing; name what is to be minimised or maximised, such as objectives: [{minimise: cylinder.mass}]."
            self.problems.append(self.place.absent(("optimise", "objectives"), template))
        if sampled.variables is None:
            if self.data.get("sample", {}).get("method") == "table":
                template = "searches in what is varied, and a table has its machines already; give vary, and another sample or none."
                self._fault(("optimise",), template, at_key=True)
            return None
        free = tuple(each for each in sampled.variables if isinstance(each, Free))
        self._judge_freedom(form, sampled, free)
        if len(self.problems) > before or not objectives:
            return None
        usual = min(max(form.evaluations // GENERATIONS, MIN_POPULATION), MAX_POPULATION)
        population = min(form.population or usual, form.evaluations)
        return Optimise(objectives, free, form.evaluations, population, form.seed, form.passing, form.points)

    def _judge_freedom(self, form: OptimiseForm, sampled: Sampled, free: tuple[Free, ...]) -> None:
        """Require ranges and lists, one of which has several values, and no more machines in a generation than in all."""
        scattered = [each.path for each in sampled.variables or () if not isinstance(each, Free)]
        for path in scattered:
            template = "is a distribution; an optimisation searches within a range {from: …, to: …} or a list."
            self._fault(("vary", path), template)
        if not scattered and all(count_of(each) == 1 for each in free):
            template = "leaves nothing free: each path has a single value. Give one a range or more values."
            self._fault(("vary",), template, at_key=True)
        if form.population is not None and form.population > form.evaluations:
            template = "is {population}, more than the evaluations, {evaluations}; give fewer here, or more of those."
            self._fault(("optimise", "population"), template, population=form.population, evaluations=form.evaluations)

    def _constraints(self, sampled: Sampled, results: ResultReader) -> Iterator[Constraint]:
        def find(path: str) -> tuple[Name, Node]:
            return _output(path, results) or term(sampled.bases[0], sampled.inputs, path)

        for index, text in enumerate(self.data.get("constraints", [])):
            try:
                yield parse(text, find, sampled.inputs)
            except ConditionError as fault:
                self._fault(("constraints", index), str(fault))


def _output(path: str, results: ResultReader) -> tuple[Name, Node] | None:
    """Return what a constraint names by NAME.OUTPUT, or by NAME.checks.ID.utilisation; None where that is not a result."""
    first = path.partition(".")[0]
    if first in (MECHANISMS, PRESS):
        return None
    column = results.columns.get(path)
    if column is None and first in results.mechanisms:
        template = "“{path}” is not an output{near}; an input is named by its whole path, as in mechanisms.{path}."
        raise ConditionError(template, path=path, near=nearest(path, results.columns))
    return (column.in_condition, Node("sym", (path,))) if column else None
