"""The sample of a study: the varied paths found in the base, their values read, and the variants that the method makes."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from diecut_report.config.loader import Config
from diecut_report.config.validation import ConfigPlace
from diecut_report.contract.inputs import Pending
from diecut_report.errors import Problem
from diecut_report.languages.phrases import Phrase, named, phrase
from diecut_report.study.definition.base_inputs import Input, UnknownPath, find_input, with_values
from diecut_report.study.definition.form import DRAWN, SampleForm
from diecut_report.study.definition.tables import TableReader
from diecut_report.study.definition.values import ValueReader
from diecut_report.study.sampling import methods
from diecut_report.study.sampling.methods import Sample
from diecut_report.study.sampling.variables import SampleError, Variable
from diecut_report.study.tables.reading import ReadColumn

MOST_TEXTS = 50  # values of a text for each of which the names of the results are looked up


@dataclass
class Sampled:
    """Hold what is varied: the inputs by path, the sample (None where it has problems), and the files that were read.

    ``bases`` are the base with stand-ins for numbers and, one text at a time, each of its values; never empty.
    """

    inputs: dict[str, Input]
    sample: Sample | None
    bases: list[Config]
    tables: dict[str, str] = field(default_factory=dict)
    variables: list[Variable] | None = None  # None where they have problems, or where a table has the variants


class SampleReader:
    """Read ``sample`` and ``vary``; gathers ``problems``."""

    def __init__(self, place: ConfigPlace, find: Callable[[str], Path], base: Config) -> None:
        self.place, self.base = place, base
        self.problems: list[Problem] = []
        self.tables = TableReader(place, find)
        self.vary = ConfigPlace(place.tree, ("vary",))

    def sampled(self, form: SampleForm | None, vary: Mapping[str, Any]) -> Sampled:
        """Return all of it; ``form`` is None where the sample's keys are wrong, so that values alone can be judged."""
        is_table = form is not None and form.method == "table"
        found = self._tabled(str(form.file)) if form and is_table else self._varied(form, vary)
        self.problems += self.tables.problems
        return found

    def _varied(self, form: SampleForm | None, vary: Mapping[str, Any]) -> Sampled:
        """The sample of what stands under vary."""
        found = dict(self._found(vary))
        bases = self._bases({asked: _texts(vary[path]) for path, asked in found.items()})
        inputs = {path: find_input(bases[0], path) for path in found}
        reader = ValueReader(self.vary, self.tables)
        variables = [reader.variable(asked, vary[path]) for path, asked in inputs.items()]
        self.problems += reader.problems
        made = [variable for variable in variables if variable]
        is_whole = bool(vary) and len(made) == len(vary)
        sample = self._made(lambda: _sample(form, made)) if form and is_whole else None
        return Sampled(inputs, sample, bases, self.tables.hashes, made if is_whole else None)

    def _found(self, vary: Mapping[str, Any]) -> Iterator[tuple[str, Input]]:
        for path in vary:
            try:
                yield path, find_input(self.base, path)
            except UnknownPath as fault:
                self.problems.append(self.vary.problem((path,), str(fault), at_key=True))

    def _made(self, make: Callable[[], Sample]) -> Sample | None:
        try:
            return make()
        except SampleError as fault:
            key = ("vary", fault.path) if fault.path in self.place.tree.data.get("vary", {}) else ("sample",)
            self.problems.append(self.place.problem(key, str(fault)))
            return None

    # --- a table of variants -----------------------------------------------------------------------------------------

    def _tabled(self, name: str) -> Sampled:
        """The sample whose rows are those of a file."""
        table = self.tables.table(name, ("sample", "file"))
        columns = table.columns if table else {}
        found = dict(self._headed(columns))
        bases = self._bases({asked: _column_texts(asked, columns[path]) for path, asked in found.items()})
        inputs = {path: find_input(bases[0], path) for path in found}
        values = {path: self.tables.values(asked, columns[path]) for path, asked in inputs.items()}
        whole = {path: column for path, column in values.items() if column is not None}
        is_whole = table is not None and len(whole) == len(columns)
        sample = self._made(lambda: methods.table(whole)) if is_whole else None
        return Sampled(inputs, sample, bases, self.tables.hashes)

    def _headed(self, columns: Mapping[str, ReadColumn]) -> Iterator[tuple[str, Input]]:
        for path, column in columns.items():
            try:
                yield path, find_input(self.base, path)
            except UnknownPath as fault:
                round_ = re.fullmatch(r"([\w.-]+)\s*\(([^()]*)\)", path)
                unit = (
                    Phrase(" A unit stands in square brackets: {path} [{unit}].", path=round_[1], unit=round_[2])
                    if round_
                    else ""
                )
                self.problems.append(column.problem(Phrase("the column's name {fault}{unit}", fault=fault, unit=unit)))

    # --- the base with stand-ins -------------------------------------------------------------------------------------

    def _bases(self, texts: Mapping[Input, list[str]]) -> list[Config]:
        """The base with stand-ins; a problem where no variant can have these keys together."""
        numbers: dict[Input, Any] = {asked: Pending(asked.path, asked.unit) for asked in texts if asked.unit}
        first = numbers | {asked: given[0] for asked, given in texts.items() if given and not asked.unit}
        others = [first | {asked: text} for asked in first if not asked.unit for text in texts[asked][1:]]
        made = [with_values(self.base, values) for values in (first, *others)]
        if all(problems for _, problems in made):
            self.problems += [self._in_base(problem) for problem in made[0][1]]
        return [config for config, _ in made]

    def _in_base(self, problem: Problem) -> Problem:
        words = Phrase(
            "with these paths varied, the base is wrong: {path}: {message}", path=problem.path, message=problem.message
        )
        return self.place.problem(("vary",), words, at_key=True)


# --- the method ------------------------------------------------------------------------------------------------------


def misused(form: SampleForm, has_vary: bool, place: ConfigPlace) -> Iterator[Problem]:
    """Yield what the method needs and lacks, and keys that have no use with it."""
    used = {"count": DRAWN, "seed": DRAWN, "indices": ("sobol",), "file": ("table",)}
    for key, users in used.items():
        if getattr(form, key) not in (None, False) and form.method not in users:
            words = Phrase(
                "has no use with method {method}; remove it, or choose {users}.",
                method=form.method,
                users=named(users, " or "),
            )
            yield place.problem(("sample", key), words, at_key=True)
    if form.method in DRAWN and form.count is None:
        yield place.absent(
            ("sample", "count"), Phrase("is missing; {method} needs the number of variants.", method=form.method)
        )
    if form.method == "table" and form.file is None:
        words = phrase("is missing; give a CSV, Parquet or XLSX file whose columns are paths.")
        yield place.absent(("sample", "file"), words)
    if form.method == "table" and has_vary:
        words = phrase(
            "has no use with method table, where the columns of the file say what varies; remove it, or choose zip."
        )
        yield place.problem(("vary",), words, at_key=True)
    elif form.method != "table" and not has_vary:
        yield place.absent(("vary",), "is missing or empty; vary at least one path.")


def _sample(form: SampleForm, variables: list[Variable]) -> Sample:
    count, seed = form.count or 0, form.seed or 0
    match form.method:
        case "grid":
            return methods.grid(variables)
        case "zip":
            return methods.zipped(variables)
        case "latin_hypercube":
            return methods.latin_hypercube(variables, count, seed)
    return methods.sobol(variables, count, seed, indices=form.indices)


def _texts(given: Any) -> list[str]:
    """The texts of a list, as far as it has any."""
    known = (
        (str(value).lower() if isinstance(value, bool) else value for value in given) if isinstance(given, list) else ()
    )
    return list(dict.fromkeys(value for value in known if isinstance(value, str)))[:MOST_TEXTS]


def _column_texts(asked: Input, column: ReadColumn) -> list[str]:
    """The texts of a column, as far as it has any; what is wrong with them is reported when they are judged."""
    return [] if asked.unit else list(dict.fromkeys(column.cells.texts()))[:MOST_TEXTS]
