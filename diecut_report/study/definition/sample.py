"""The sample of a study: the varied paths found in the base, their values read, and the variants that the method makes."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import BeforeValidator, Field, create_model

from diecut_report.config.loader import Config
from diecut_report.config.model import ConfigDocument
from diecut_report.config.validation import ConfigPlace, as_typed, quoted, validate
from diecut_report.config.yaml import KeyPath
from diecut_report.errors import Problem, UserError, nearest
from diecut_report.mechanism.inputs import Block, Quantity
from diecut_report.mechanism.names import SI, Pending, Text
from diecut_report.study.definition import samples
from diecut_report.study.definition.base_inputs import Input, UnknownPath, find_input, with_values
from diecut_report.study.definition.samples import Sample
from diecut_report.study.definition.variables import (
    ChoiceVariable,
    Normal,
    RangeVariable,
    SampleError,
    Triangular,
    Uniform,
    Values,
    Variable,
)
from diecut_report.study.tables.cells import Faults
from diecut_report.study.tables.reading import ReadColumn, TableFile, read_table
from diecut_report.text.phrases import Phrase, named, phrase

# The form of a study file: its fixed keys, and the forms in which the values of a varied path may be given.


DRAWN = ("latin_hypercube", "sobol")
LISTED = ("grid", "zip")
DISTRIBUTIONS = ("uniform", "normal", "triangular")

COUNT = Quantity("n", "1", "Number of variants of latin_hypercube and sobol", ge=1, le=1e12, integer=True)
SEED = Quantity(
    "", "1", "Seed of latin_hypercube and sobol; equal seeds give equal samples", ge=0, le=2**53, integer=True
)


class SampleForm(Block):
    """Declare how the variants are taken from what is varied."""

    method: Annotated[
        Literal["grid", "zip", "latin_hypercube", "sobol", "table"],
        Text(
            "grid: each value with each; zip: the first values together, the second together …; "
            "latin_hypercube, sobol: count variants spread over all; table: the rows of a file"
        ),
    ]
    count: Annotated[int | None, COUNT] = None
    seed: Annotated[int | None, SEED] = None
    indices: Annotated[
        bool, Text("For sobol: count groups of variants from which first and total Sobol indices follow")
    ] = False
    file: Annotated[
        str | None, Text("For table: a CSV, Parquet or XLSX file with paths and units as heads, `PATH [rpm]`")
    ] = None


class ObjectiveForm(Block):
    """Declare an output that is to be as small or as great as can be."""

    minimise: Annotated[str | None, Text("An output, such as cylinder.mass, that is to be small")] = None
    maximise: Annotated[str | None, Text("An output that is to be great")] = None


SEARCH_SEED = Quantity("", "1", "Seed of the search; equal seeds search alike", ge=0, le=2**53, integer=True)


class OptimiseForm(Block):
    """Declare what `optimise` searches for, and how long."""

    objectives: Annotated[
        list[ObjectiveForm] | None,
        Text("What is to be small or great: outputs, or varied inputs such as press.productivity; without it those of the study"),
    ] = None  # fmt: skip
    evaluations: Annotated[
        int, Quantity("", "1", "Machines that are tried", ge=1, le=1e8, integer=True)
    ] = 2000  # fmt: skip
    population: Annotated[
        int | None, Quantity("", "1", "Machines of a generation; without it a fortieth of all, 40 to 500", ge=4, le=1e5, integer=True)
    ] = None  # fmt: skip
    seed: Annotated[int, SEARCH_SEED] = 1
    passing: Annotated[bool, Text("Only machines of which no check fails")] = True
    points: Annotated[
        int, Quantity("", "1", "Points of the front that are listed, and calculated again one by one", ge=1, le=1000, integer=True)
    ] = 20  # fmt: skip


Texts = Annotated[list[Annotated[str, Field(min_length=1)]], Field(default_factory=list)]


class StudyDocument(Block):
    """Declare the whole study file; what is varied is judged path by path."""

    schema_version: Annotated[Literal[1], BeforeValidator(ConfigDocument.a_number)]
    base: Annotated[str, Text("The config that is varied, beside the study file"), Field(min_length=1)]
    sample: Annotated[SampleForm | None, Text("How the variants are taken; not needed beside optimise")] = None
    vary: Annotated[
        dict[str, Any], Text("For each varied path its values: a list, a range or a distribution"),
        Field(default_factory=dict),
    ]  # fmt: skip
    constraints: Annotated[
        Texts, Text("What must hold between inputs, and of outputs; variants where it does not are dropped")
    ]
    outputs: Annotated[
        list[str] | None, Text("The outputs to keep, such as drive.crank_torque_peak; without it all")
    ] = None
    curves: Annotated[Texts, Text("The curves to keep; without it none")]
    objectives: Annotated[list[ObjectiveForm], Text("What is to be small or great"), Field(default_factory=list)]
    optimise: Annotated[OptimiseForm | None, Text("What the command optimise searches for in what is varied")] = None
    reports: Annotated[  # judged as a whole where the sample is known: of each kind of value two faults would be told
        Any,
        Text("The variants that get a full report: none, failed, best N, all, or a list of numbers"),
    ] = None


def value_form(asked: Input) -> type[Block]:
    """Return one value of a list."""
    return create_model("One", __base__=Block, value=(asked.declared_as, ...))


def range_form(asked: Input) -> type[Block]:
    """Return values from … to."""
    keys: dict[str, Any] = {"from": (asked.declared_as, ...), "to": (asked.declared_as, ...)}
    keys["count"] = (
        Annotated[int | None, Quantity("", "1", "Number of values", ge=1, le=1e9, integer=True)],
        None,
    )
    keys["spacing"] = (Annotated[Literal["linear", "log"], Text("Equal steps, or equal ratios")], "linear")
    return create_model("Range", __base__=Block, **keys)


def distribution_form(asked: Input, name: str) -> type[Block]:
    """Return a distribution with its limits; its standard deviation has the input's unit, but not its bounds."""
    assert isinstance(asked.meta, Quantity)
    value = asked.declared_as
    limit = (Annotated[float | None, *asked.metadata], None)
    deviation = Annotated[float, Quantity("", asked.meta.unit, "Standard deviation", gt=0)]
    mean = Annotated[float, replace(asked.meta, integer=False)]
    keys: dict[str, dict[str, Any]] = {
        "uniform": {"low": (value, ...), "high": (value, ...)},
        "normal": {"mean": (mean, ...), "sd": (deviation, ...), "low": limit, "high": limit},
        "triangular": {"low": (value, ...), "mode": (value, ...), "high": (value, ...)},
    }
    given: Any = (Annotated[Literal["uniform", "normal", "triangular"], Text("Form of the distribution")], ...)
    return create_model(name.capitalize(), __base__=Block, **({"distribution": given} | keys[name]))


class TableForm(Block):
    """Declare the values of a column of a file."""

    table: Annotated[str, Text("A CSV, Parquet or XLSX file beside the study file"), Field(min_length=1)]
    column: Annotated[str | None, Text("The column; without it the one named as the path")] = None


# The tables that a study names: read once each, their columns judged by the bounds of the inputs that they vary.


DIFFERENT = 100  # wrong texts of a column after which no further ones are judged


class TableReader:
    """Read tables, found by ``find`` by their names in the study; gathers ``problems``, and each one's SHA-256 in ``hashes``."""

    def __init__(self, place: ConfigPlace, find: Callable[[str], Path]) -> None:
        self.place, self.find = place, find
        self.problems: list[Problem] = []
        self.hashes: dict[str, str] = {}
        self._read: dict[str, TableFile | None] = {}

    def table(self, name: str, key: KeyPath) -> TableFile | None:
        """Return the table that the study names at this key, or None where it cannot be read."""
        if name not in self._read:
            self._read[name] = self._opened(name, key)
        return self._read[name]

    def _opened(self, name: str, key: KeyPath) -> TableFile | None:
        path = self.find(name)
        try:
            if not os.path.exists(path):  # false also for a name that can be none
                words = Phrase(
                    "there is no file {path}. The table is sought from the study's folder; check its name.", path=path
                )
                raise UserError(self.place.problem(key, words))
            found = read_table(path)
            self.hashes[name] = found.sha256
        except UserError as error:
            self.problems += error.problems
            return None
        return found

    def column(self, asked: Input, name: str, column: str, key: KeyPath) -> Values | None:
        """Return a column of a table as the values of an input, or None with the problems."""
        table = self.table(name, key)
        try:
            return self.values(asked, table.column(column)) if table else None
        except UserError as error:
            self.problems += error.problems
            return None

    def values(self, asked: Input, column: ReadColumn) -> Values | None:
        """Return a column as the values of an input: SI numbers within its bounds, or texts that it takes."""
        before = len(self.problems)
        try:
            if isinstance(asked.meta, Quantity):
                numbers = column.si(asked.meta.unit)
                self.problems += _outside(asked.meta, column, numbers)
            else:
                numbers = None
                self.problems += self._wrong_texts(asked, column)
        except UserError as error:
            self.problems += error.problems
        if len(self.problems) > before:
            return None
        return column.texts() if numbers is None else numbers

    def _wrong_texts(self, asked: Input, column: ReadColumn) -> Iterator[Problem]:
        form, texts = value_form(asked), column.texts()
        wrong: dict[str, str] = {}
        for text in dict.fromkeys(texts):
            if found := validate(form, {"value": text}, self.place)[1]:
                wrong[text] = found[0].message
            if len(wrong) > DIFFERENT:
                words = Phrase(
                    "more than {different} different texts are none that {path} takes: {wrong}",
                    different=DIFFERENT,
                    path=asked.path,
                    wrong=wrong[text],
                )
                return iter([column.problem(words, column.cells.row(texts.index(text)))])
        places = (place for place, text in enumerate(texts) if text in wrong)
        return column.faulty(Faults.of(places, lambda place: wrong[texts[place]]))


def _outside(meta: Quantity, column: ReadColumn, values: Iterable[float]) -> Iterator[Problem]:
    """Cells that the input's bounds refuse, with the words that a config has for them."""
    numbers = np.asarray(values)
    places = np.flatnonzero(~meta.holds(numbers))
    return column.faulty(Faults.of(places, lambda place: _refusal(meta, float(numbers[place]))))


def _refusal(meta: Quantity, value: float) -> str:
    try:
        meta.validate(SI(value, meta.parsed_unit.si, "the table"))
    except ValueError as fault:
        return str(fault)
    raise AssertionError(f"{value} is refused in a column, but not alone")


# The values that a study gives for a varied path: read, judged as in a config, and made a variable to sample.


NEEDED = phrase(
    "a list of values, a range {from: …, to: …, count: …}, a distribution {distribution: normal, "
    "mean: …, sd: …} or {table: FILE, column: …} is needed"
)
TEXTS = phrase("is a text or a choice; give a list of values")


class ValueReader:
    """Read the values of varied paths; gathers ``problems`` (those of tables are gathered there)."""

    def __init__(self, place: ConfigPlace, tables: TableReader) -> None:
        self.place, self.tables = place, tables
        self.problems: list[Problem] = []

    def variable(self, asked: Input, given: Any) -> Variable | None:
        """Return the variable that is given in the file, or None where there are problems."""
        before = len(self.problems)
        try:
            made = self._made(asked, given)
        except SampleError as fault:
            self._report(asked, str(fault))
            return None
        return made if len(self.problems) == before else None

    def _made(self, asked: Input, given: Any) -> Variable | None:
        if isinstance(given, list):
            return self._listed(asked, given)
        if not isinstance(given, dict):
            self._report(asked, Phrase("is {given}; {needed}.", given=quoted(given), needed=NEEDED))
            return None
        if "table" in given:
            return self._from_table(asked, given)
        if asked.unit is None:
            self._report(asked, Phrase("{texts}, as in [{example}].", texts=TEXTS, example=self._example(asked)))
            return None
        return self._distributed(asked, given) if "distribution" in given else self._range(asked, given)

    def _example(self, asked: Input) -> str:
        options = getattr(asked.meta, "options", ())
        return ", ".join(list(options)[:2]) or phrase("first, second")

    # --- forms -------------------------------------------------------------------------------------------------------

    def _listed(self, asked: Input, given: list[Any]) -> Variable | None:
        form = value_form(asked)
        values = [self._value(asked, form, index, value) for index, value in enumerate(given)]
        return ChoiceVariable(asked.path, tuple(values)) if None not in values else None

    def _value(self, asked: Input, form: type[Block], index: int, given: Any) -> Any:
        place = ConfigPlace(self.place.tree, (*self.place.root, asked.path), {("value",): (index,)})
        if given is None or (isinstance(given, str) and "${" in given):
            words = (
                phrase("has no value; write one, or remove the entry")
                if given is None
                else Phrase("is {given}; a reference does not vary", given=quoted(given))
            )
            self.problems.append(place.problem(("value",), Phrase("{words}.", words=words)))
            return None
        block = self._validated(form, {"value": given}, place)
        return stored(block.value) if block else None  # type: ignore[attr-defined]

    def _range(self, asked: Input, given: dict[str, Any]) -> Variable | None:
        block: Any = self._validated(range_form(asked), given, self._place(asked))
        if block is None:
            return None
        low, high = float(getattr(block, "from")), float(block.to)
        return RangeVariable(asked.path, low, high, block.count, block.spacing == "log", asked.is_integer)

    def _distributed(self, asked: Input, given: dict[str, Any]) -> Variable | None:
        name = given["distribution"]
        if name not in DISTRIBUTIONS:
            near = nearest(name, DISTRIBUTIONS) if isinstance(name, str) else ""
            words = Phrase(
                "is {name}{near}; allowed: {names}", name=quoted(name), near=near, names=", ".join(DISTRIBUTIONS)
            )
            self.problems.append(self._place(asked).problem(("distribution",), words))
            return None
        block: Any = self._validated(distribution_form(asked, name), given, self._place(asked))
        if block is None:
            return None
        limits = (None if limit is None else float(limit) for limit in (block.low, block.high))
        match name, *limits:
            case "uniform", float() as low, float() as high:
                return Uniform(asked.path, low, high, asked.is_integer)
            case "triangular", float() as low, float() as high:
                return Triangular(asked.path, low, float(block.mode), high, asked.is_integer)
        low_or_none, high_or_none = (None if limit is None else float(limit) for limit in (block.low, block.high))
        return Normal(asked.path, block.mean, block.sd, low_or_none, high_or_none, asked.is_integer)

    def _from_table(self, asked: Input, given: dict[str, Any]) -> Variable | None:
        block: Any = self._validated(TableForm, given, self._place(asked))
        if block is None:
            return None
        key = (*self.place.root, asked.path, "table")
        values = self.tables.column(asked, block.table, block.column or asked.path, key)
        return None if values is None else ChoiceVariable(asked.path, tuple(values))

    # --- problems ----------------------------------------------------------------------------------------------------

    def _place(self, asked: Input) -> ConfigPlace:
        return ConfigPlace(self.place.tree, (*self.place.root, asked.path))

    def _validated(self, form: type[Block], given: dict[str, Any], place: ConfigPlace) -> Block | None:
        block, problems = validate(form, as_typed(form, given, place), place)
        self.problems += problems
        return block

    def _report(self, asked: Input, message: str) -> None:
        self.problems.append(self.place.problem((asked.path,), message))


def stored(value: Any) -> float | str:
    """Return a value as a sample holds it: a yes/no as the text that YAML has for it, a whole number as a float."""
    if isinstance(value, bool):
        return str(value).lower()
    return value if isinstance(value, str) else float(value)


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
        sample = self._made(lambda: samples.table(whole)) if is_whole else None
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
            return samples.grid(variables)
        case "zip":
            return samples.zipped(variables)
        case "latin_hypercube":
            return samples.latin_hypercube(variables, count, seed)
    return samples.sobol(variables, count, seed, indices=form.indices)


def _texts(given: Any) -> list[str]:
    """The texts of a list, as far as it has any."""
    known = (
        (str(value).lower() if isinstance(value, bool) else value for value in given) if isinstance(given, list) else ()
    )
    return list(dict.fromkeys(value for value in known if isinstance(value, str)))[:MOST_TEXTS]


def _column_texts(asked: Input, column: ReadColumn) -> list[str]:
    """The texts of a column, as far as it has any; what is wrong with them is reported when they are judged."""
    return [] if asked.unit else list(dict.fromkeys(column.cells.texts()))[:MOST_TEXTS]
