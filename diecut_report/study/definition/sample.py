"""The sample of a study: the varied paths found in the base, their values read, and the variants that the method makes."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from diecut_report.config.loader import Config
from diecut_report.config.validation import ConfigPlace, as_typed, quoted, validate
from diecut_report.config.yaml import KeyPath
from diecut_report.errors import Problem, UserError, nearest
from diecut_report.mechanism.inputs import Block, Quantity
from diecut_report.mechanism.names import SI, Pending
from diecut_report.study.definition import base_inputs, samples, schema
from diecut_report.study.definition.constraints import stored_value
from diecut_report.study.tables.reading import ReadColumn, TableFile, read_table
from diecut_report.text.phrases import Phrase, named, phrase

MAX_WRONG_TEXTS = 100  # different wrong texts of a column after which no further ones are judged
MAX_LOOKED_UP = 50  # values of a text for each of which the names of the results are looked up
NO_VALUE = phrase("has no value; write one, or remove the entry")
NEEDED = phrase(
    "a list of values, a range {from: …, to: …, count: …}, a distribution {distribution: normal, "
    "mean: …, sd: …} or {table: FILE, column: …} is needed"
)
TEXTS = phrase("is a text or a choice; give a list of values")


@dataclass
class Sampled:
    """Hold what is varied: the inputs by path, the sample (None where it has problems), and the SHA-256 of the tables that were read.

    ``bases`` are the base with stand-ins for numbers and, one text at a time, each of its values; never empty.
    """

    inputs: dict[str, base_inputs.Input]
    sample: samples.Sample | None
    bases: list[Config]
    tables: dict[str, str] = field(default_factory=dict)
    variables: list[samples.Variable] | None = None  # None where they have problems, or where a table has the variants


class SampleReader:
    """Read ``sample`` and ``vary``; adds to ``problems``. ``find`` says where a file is that the study names."""

    def __init__(self, place: ConfigPlace, problems: list[Problem], find: Callable[[str], Path], base: Config) -> None:
        self.place, self.problems, self.find, self.base = place, problems, find, base
        self.vary = ConfigPlace(place.tree, ("vary",))
        self._tables: dict[str, TableFile | None] = {}

    def sampled(self, form: schema.SampleForm | None, vary: Mapping[str, Any]) -> Sampled:
        """Return all of it; ``form`` is None where the sample's keys are wrong, so that values alone can be judged."""
        table = self._table(str(form.file), ("sample", "file")) if form and form.method == "table" else None
        if form and form.method == "table":
            columns = table.columns if table else {}
            found = dict(self._headed(columns))
            listed = {asked: [] if asked.unit else columns[path].cells.texts() for path, asked in found.items()}
            bases = self._bases({asked: list(dict.fromkeys(texts))[:MAX_LOOKED_UP] for asked, texts in listed.items()})
        else:
            found = dict(self._found(vary))
            bases = self._bases({asked: _texts(vary[path]) for path, asked in found.items()})
        inputs = {path: base_inputs.varied_input(bases[0], path) for path in found}
        self._require_once(inputs)
        made = Sampled(inputs, None, bases)
        if table:
            values = {path: self._column_values(asked, table.columns[path]) for path, asked in inputs.items()}
            whole = {path: column for path, column in values.items() if column is not None}
            made.sample = samples.TableSample(whole) if len(whole) == len(table.columns) else None
        else:
            variables = [self._variable(asked, vary[path]) for path, asked in inputs.items()]
            known = [variable for variable in variables if variable]
            made.variables = known if vary and len(known) == len(vary) else None
            made.sample = self._sample(form, made.variables) if form and made.variables else None
        made.tables = {name: table.sha256 for name, table in self._tables.items() if table}
        return made

    def _found(self, vary: Mapping[str, Any]) -> Iterator[tuple[str, base_inputs.Input]]:
        for path in vary:
            try:
                yield path, base_inputs.varied_input(self.base, path)
            except base_inputs.UnknownPath as fault:
                self.problems.append(self.vary.problem((path,), str(fault), at_key=True))

    def _headed(self, columns: Mapping[str, ReadColumn]) -> Iterator[tuple[str, base_inputs.Input]]:
        for path, column in columns.items():
            try:
                yield path, base_inputs.varied_input(self.base, path)
            except base_inputs.UnknownPath as fault:
                round_ = re.fullmatch(r"([\w.-]+)\s*\(([^()]*)\)", path)
                template = " A unit stands in square brackets: {path} [{unit}]."
                unit = Phrase(template, path=round_[1], unit=round_[2]) if round_ else ""
                self.problems.append(column.problem(Phrase("the column's name {fault}{unit}", fault=fault, unit=unit)))

    def _require_once(self, inputs: Mapping[str, base_inputs.Input]) -> None:
        """Note what is varied under two names."""
        known: dict[Any, str] = {}
        for path, asked in inputs.items():
            if (first := known.setdefault(asked.node, path)) != path:
                key = ("vary",) if path in self.place.tree.data.get("vary", {}) else ("sample",)
                message = Phrase("{path} is the same place as {first}; vary it once.", path=path, first=first)
                self.problems.append(self.place.problem(key, message, at_key=True))

    def _sample(self, form: schema.SampleForm, variables: list[samples.Variable]) -> samples.Sample | None:
        try:
            return _made(form, tuple(variables))
        except samples.SampleError as fault:
            key = ("vary", fault.path) if fault.path in self.place.tree.data.get("vary", {}) else ("sample",)
            self.problems.append(self.place.problem(key, str(fault)))
            return None

    def _bases(self, texts: Mapping[base_inputs.Input, list[str]]) -> list[Config]:
        """Return the base with stand-ins; a problem where no variant can have these keys together."""
        numbers: dict[base_inputs.Input, Any] = {
            asked: Pending(asked.path, asked.unit) for asked in texts if asked.unit
        }
        first = numbers | {asked: given[0] for asked, given in texts.items() if given and not asked.unit}
        others = [first | {asked: text} for asked in first if not asked.unit for text in texts[asked][1:]]
        made = [_with_stand_ins(self.base, values) for values in (first, *others)]
        if all(problems for _, problems in made):
            template = "with these paths varied, the base is wrong: {path}: {message}"
            wrong = [Phrase(template, path=problem.path, message=problem.message) for problem in made[0][1]]
            self.problems += [self.place.problem(("vary",), each, at_key=True) for each in wrong]
        return [config for config, _ in made]

    # --- the values of a path ----------------------------------------------------------------------------------------

    def _variable(self, asked: base_inputs.Input, given: Any) -> samples.Variable | None:
        try:
            if isinstance(given, list):
                return self._listed(asked, given)
            if not isinstance(given, dict):
                raise samples.SampleError("is {given}; {needed}.", given=quoted(given), needed=NEEDED)
            if "table" in given:
                return self._from_table(asked, given)
            if asked.unit is None:
                options = list(getattr(asked.meta, "options", ()))[:2]
                example = ", ".join(options) or phrase("first, second")
                raise samples.SampleError("{texts}, as in [{example}].", texts=TEXTS, example=example)
            if empty := [key for key, value in given.items() if value is None]:
                place = self._place(asked)
                self.problems += [place.problem((key,), "{words}.", words=NO_VALUE) for key in empty]
                return None
            return self._distribution(asked, given) if "distribution" in given else self._range(asked, given)
        except samples.SampleError as fault:
            self.problems.append(self.vary.problem((asked.path,), str(fault)))
            return None

    def _listed(self, asked: base_inputs.Input, given: list[Any]) -> samples.Variable | None:
        form = schema.value_form(asked)
        values = [self._value(asked, form, index, value) for index, value in enumerate(given)]
        return samples.ChoiceVariable(asked.path, tuple(values)) if None not in values else None

    def _value(self, asked: base_inputs.Input, form: type[Block], index: int, given: Any) -> Any:
        place = ConfigPlace(self.place.tree, ("vary", asked.path), {("value",): (index,)})
        if given is None or (isinstance(given, str) and "${" in given):
            words = NO_VALUE if given is None else Phrase("is {given}; a reference does not vary", given=quoted(given))
            self.problems.append(place.problem(("value",), "{words}.", words=words))
            return None
        block = self._validated(form, {"value": given}, place)
        if block and asked.unit is not None and isinstance(block.value, str):
            template = "is {given}, which stands in place of a number: a study varies numbers. Write a study for each word, with it in the base."
            self.problems.append(place.problem(("value",), template, given=quoted(given)))
            return None
        return stored_value(block.value) if block else None

    def _range(self, asked: base_inputs.Input, given: dict[str, Any]) -> samples.Variable | None:
        block = self._validated(schema.range_form(asked), given, self._place(asked))
        if block is None:
            return None
        low, high = float(getattr(block, "from")), float(block.to)
        return samples.RangeVariable(asked.path, low, high, block.count, block.spacing == "log", asked.is_integer)

    def _distribution(self, asked: base_inputs.Input, given: dict[str, Any]) -> samples.Variable | None:
        law, place = given["distribution"], self._place(asked)
        if law not in list(schema.DISTRIBUTIONS):  # a list or a block, too
            near = nearest(law, schema.DISTRIBUTIONS) if isinstance(law, str) else ""
            template = "is {name}{near}; allowed: {names}"
            self.problems.append(
                place.problem(
                    ("distribution",), template, name=quoted(law), near=near, names=", ".join(schema.DISTRIBUTIONS)
                )
            )
            return None
        block = self._validated(schema.distribution_form(asked, law), given, place)
        if block is None:
            return None
        keys = {"low": "low", "high": "high", "mean": "middle", "mode": "middle", "sd": "sd"}
        values = {keys[name]: float(value) for name, value in block if name in keys and value is not None}
        return samples.Distribution(asked.path, law, integer=asked.is_integer, **values)

    def _from_table(self, asked: base_inputs.Input, given: dict[str, Any]) -> samples.Variable | None:
        block = self._validated(schema.TableForm, given, self._place(asked))
        table = self._table(block.table, ("vary", asked.path, "table")) if block else None
        if block is None or table is None:
            return None
        try:
            column = table.column(block.column or asked.path)
        except UserError as error:
            self.problems += error.problems
            return None
        values = self._column_values(asked, column)
        return None if values is None else samples.ChoiceVariable(asked.path, tuple(values))

    def _place(self, asked: base_inputs.Input) -> ConfigPlace:
        return ConfigPlace(self.place.tree, ("vary", asked.path))

    def _validated(self, form: type[Block], given: dict[str, Any], place: ConfigPlace) -> Any:
        block, problems = validate(form, as_typed(form, given, place), place)
        self.problems += problems
        return block

    # --- tables ------------------------------------------------------------------------------------------------------

    def _table(self, name: str, key: KeyPath) -> TableFile | None:
        """Return the table that the study names at this key, read once; None where it cannot be read."""
        if name not in self._tables:
            self._tables[name] = None
            path = self.find(name)
            if not os.path.exists(path):  # false also for a name that can be none
                template = "there is no file {path}. The table is sought from the study's folder; check its name."
                self.problems.append(self.place.problem(key, template, path=path))
                return None
            try:
                self._tables[name] = read_table(path)
            except UserError as error:
                self.problems += error.problems
        return self._tables[name]

    def _column_values(self, asked: base_inputs.Input, column: ReadColumn) -> samples.Values | None:
        """Return a column as the values of an input: SI numbers within its bounds, or texts that it takes; None with its problems."""
        try:
            values: samples.Values
            if isinstance(asked.meta, Quantity):
                values = column.si(asked.meta.unit)
                wrong = list(_outside(asked.meta, column, values))
            else:
                values = column.texts()
                wrong = list(self._wrong_texts(asked, column, values))
        except UserError as error:
            wrong = list(error.problems)
        self.problems += wrong
        return None if wrong else values

    def _wrong_texts(self, asked: base_inputs.Input, column: ReadColumn, texts: list[str]) -> Iterator[Problem]:
        form = schema.value_form(asked)
        wrong: dict[str, str] = {}
        for text in dict.fromkeys(texts):
            if found := validate(form, {"value": text}, self.place)[1]:
                wrong[text] = found[0].message
            if len(wrong) > MAX_WRONG_TEXTS:
                template = "more than {different} different texts are none that {path} takes: {wrong}"
                message = Phrase(template, different=MAX_WRONG_TEXTS, path=asked.path, wrong=wrong[text])
                yield column.problem(message, column.cells.row(texts.index(text)))
                return
        places = [place for place, text in enumerate(texts) if text in wrong]
        yield from column.faulty(places, lambda place: wrong[texts[place]])


def _with_stand_ins(base: Config, values: Mapping[base_inputs.Input, Any]) -> tuple[Config, list[Problem]]:
    """Return the base with other texts and stand-ins for numbers; the parts keep their numbers, by which they are made."""
    tied = {asked: value for asked, value in values.items() if base_inputs.is_of_parts(base, asked)}
    texts = {
        base_inputs.typed_place(base, asked): base_inputs.typed_data(asked, str(value))
        for asked, value in tied.items()
        if not asked.unit
    }
    config, problems = base.retyped(texts) if texts else (base, [])
    if problems:  # which are the reason of such machines
        config = base
    return base_inputs.with_values(config, {asked: value for asked, value in values.items() if asked not in tied})


def _outside(meta: Quantity, column: ReadColumn, values: samples.Values) -> Iterator[Problem]:
    """Yield the cells that the input's bounds refuse, with the message that a config has for them."""
    numbers = np.asarray(values)

    def refusal(place: int) -> str:
        value = float(numbers[place])
        try:
            meta.validate(SI(value, meta.parsed_unit.si, "the table"))
        except ValueError as fault:
            return str(fault)
        raise AssertionError(f"{value} is refused in a column, but not alone")

    return column.faulty(np.flatnonzero(~meta.holds(numbers)), refusal)


def misused(form: schema.SampleForm, has_vary: bool, place: ConfigPlace) -> Iterator[Problem]:
    """Yield what the method needs and lacks, and keys that have no use with it."""
    used = {"count": schema.DRAWN, "seed": schema.DRAWN, "indices": ("sobol",), "file": ("table",)}
    for key, users in used.items():
        if getattr(form, key) not in (None, False) and form.method not in users:
            template = "has no use with method {method}; remove it, or choose {users}."
            yield place.problem(("sample", key), template, at_key=True, method=form.method, users=named(users, " or "))
    if form.method in schema.DRAWN and form.count is None:
        template = "is missing; {method} needs the number of variants."
        yield place.absent(("sample", "count"), template, method=form.method)
    if form.method == "table" and form.file is None:
        yield place.absent(("sample", "file"), "is missing; give a CSV, Parquet or XLSX file whose columns are paths.")
    if form.method == "table" and has_vary:
        template = (
            "has no use with method table, where the columns of the file say what varies; remove it, or choose zip."
        )
        yield place.problem(("vary",), template, at_key=True)
    elif form.method != "table" and not has_vary:
        yield place.absent(("vary",), "is missing or empty; vary at least one path.")


def _made(form: schema.SampleForm, variables: tuple[samples.Variable, ...]) -> samples.Sample:
    count, seed = form.count or 0, form.seed or 0
    if form.method == "latin_hypercube":
        return samples.LatinHypercube(variables, count, seed)
    if form.method == "sobol":
        return samples.Sobol(variables, count, seed, form.indices)
    return samples.Grid(variables) if form.method == "grid" else samples.Zip(variables)


def _texts(given: Any) -> list[str]:
    known = [stored_value(value) for value in given if isinstance(value, str | bool)] if isinstance(given, list) else []
    return [str(value) for value in dict.fromkeys(known)][:MAX_LOOKED_UP]
