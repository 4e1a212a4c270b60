"""The values that a study gives for a varied path: read, judged as in a config, and made a variable to sample."""

from __future__ import annotations

from typing import Any

from diecut_report.config.loader import as_typed
from diecut_report.config.validation import ConfigPlace, told, validate
from diecut_report.contract.inputs import Block
from diecut_report.errors import Problem, nearest
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.study.definition.base_inputs import Input
from diecut_report.study.definition.form import DISTRIBUTIONS, TableForm, distribution_form, range_form, value_form
from diecut_report.study.definition.tables import TableReader
from diecut_report.study.sampling.variables import (
    ChoiceVariable,
    Normal,
    RangeVariable,
    SampleError,
    Triangular,
    Uniform,
    Variable,
)

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
            self._report(asked, Phrase("is {given}; {needed}.", given=told(given), needed=NEEDED))
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
                else Phrase("is {given}; a reference does not vary", given=told(given))
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
                "is {name}{near}; allowed: {names}", name=told(name), near=near, names=", ".join(DISTRIBUTIONS)
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
