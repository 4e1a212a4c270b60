"""Many machines of a press, calculated together as the variants of a study, as one table."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import yaml
from numpy.typing import NDArray

from diecut_report.config.loader import Config
from diecut_report.config.plugins import Discovery
from diecut_report.config.yaml import parse
from diecut_report.errors import ConfigError, PluginError, Problem
from diecut_report.scripting.parts import NamedParts
from diecut_report.scripting.press_inputs import whole_path
from diecut_report.scripting.values import plain
from diecut_report.study.definition.study_file import Study, study_of
from diecut_report.study.execution.study_run import result_columns, varied_columns
from diecut_report.study.execution.worker import Chunk, Done, calculate
from diecut_report.study.storage.description import VARIANT, VERDICT, ResultColumn
from diecut_report.study.storage.parts import described_table
from diecut_report.text.phrases import Phrase, phrase

MOST = 1_000_000  # machines of a table in memory
FILE = "sweep"


@dataclass(frozen=True)
class AskedSweep:
    """Hold what is asked: what varies, by path, and as a study has it outputs, constraints and sample."""

    vary: Mapping[str, Any]
    outputs: list[str] | None
    constraints: list[str]
    method: str
    count: int | None
    seed: int | None

    def study(self, base: str) -> dict[str, Any]:
        """Return it as the file of a study."""
        sample = {"method": self.method, "count": self.count, "seed": self.seed}
        vary = {whole_path(path): plain(values, path) for path, values in self.vary.items()}
        made: dict[str, Any] = {"schema_version": 1, "base": base, "vary": vary, "constraints": self.constraints}
        made["sample"] = {key: value for key, value in sample.items() if value is not None}
        return made if self.outputs is None else made | {"outputs": self.outputs}


class SweepTable:
    """Hold a table of machines: a row each, with what varies, outputs, checks (``NAME.checks.ID.utilisation``, ``.status``) and the verdict.

    Numbers are SI; ``columns`` tells unit, symbol and description of each. The columns ``status`` (``pass``, ``warn``, ``fail``, ``error``),
    ``governing`` and ``error`` stand at the end; what varies is named as it was asked for, by its whole path where an output has that name.
    """

    def __init__(
        self, table: Any, columns: Mapping[str, ResultColumn], slow: Mapping[str, str], language: str | None
    ) -> None:
        self._table, self._language = table, language
        self.columns = NamedParts(columns, phrase("the table has no column"), language)
        self.slow = dict(slow)

    def __len__(self) -> int:
        return int(self._table.num_rows)

    def __getitem__(self, name: str) -> NDArray[Any]:
        """Return a column as an array of NumPy: floats with NaN, texts with None, where a machine has no value; UnknownName for another name."""
        about = self.columns[name]
        return _plain(self._table.column(name), about)

    def counts(self) -> dict[str, int]:
        """Return how many machines there are of each status."""
        names, numbers = np.unique(self["status"].astype(str), return_counts=True)
        return {str(name): int(number) for name, number in zip(names, numbers, strict=True)}

    def to_arrow(self) -> Any:
        """Return it as a table of pyarrow, each field with its unit, symbol and description as metadata."""
        return self._table

    def to_numpy(self) -> NDArray[Any]:
        """Return it as a structured array of NumPy, a field for each column."""
        found = {name: self[name] for name in self.columns}
        made = np.empty(len(self), dtype=[(name, values.dtype) for name, values in found.items()])
        for name, values in found.items():
            made[name] = values
        return made

    def to_pandas(self) -> Any:
        """Return it as a table of pandas; ConfigError where pandas is not installed."""
        from diecut_report.scripting.values import to_pandas

        return to_pandas(self._table, self._language)

    def to_polars(self) -> Any:
        """Return it as a table of polars; ConfigError where polars is not installed."""
        from diecut_report.scripting.values import to_polars

        return to_polars(self._table, self._language)

    def __repr__(self) -> str:
        told = ", ".join(f"{number} {status}" for status, number in self.counts().items())
        return f"<{len(self)} machines ({told}); {len(self.columns)} columns: {', '.join(list(self.columns)[:4])}, …>"

    def _repr_html_(self) -> str:
        from diecut_report.scripting.values import sweep_html

        return sweep_html(self.columns, self.__getitem__, self.counts())


def _plain(column: Any, about: ResultColumn) -> NDArray[Any]:
    if about.kind in ("text", "bool"):
        return np.array(column.to_pylist(), dtype=object)
    if about.name == VARIANT.name:
        return np.asarray(column.to_numpy())
    return np.asarray(column.cast("float64").to_numpy(zero_copy_only=False))


def swept(config: Config, discovery: Discovery, language: str | None, asked: AskedSweep) -> SweepTable:
    """Return the table of what is asked; UserError in words where that cannot be, PluginError where a plugin breaks on all machines."""
    for error in config.broken.values():
        raise error
    study = study_of(
        parse(yaml.safe_dump(asked.study(config.tree.name), allow_unicode=True, sort_keys=False), FILE),
        config,
        discovery,
    )
    if study.sample.count > MOST:
        words = Phrase("there are {count} machines; a table has at most {most}. Calculate them as a study, with the command batch.",
                       count=study.sample.count, most=MOST)  # fmt: skip
        raise ConfigError(Problem(words, path="vary"))
    done = calculate(study, Chunk(0, 0, study.sample.count))
    if done.broken and all(done.columns["status"] == "error"):
        kind, words_of_plugin = next(iter(done.broken.items()))
        raise PluginError(words_of_plugin, kind)
    return _table(study, done, language, {whole_path(path): path for path in asked.vary})


def _table(study: Study, done: Done, language: str | None, names: Mapping[str, str]) -> SweepTable:
    results = result_columns(study)
    taken = {column.name for column in results}
    varied = {
        column.name: _named(column, names.get(column.name, column.name), taken) for column in varied_columns(study)
    }
    columns = {varied.get(column.name, column): done.columns.get(column.name) for column in _all(study, results)}
    table = described_table(columns, len(done.columns["status"]))
    return SweepTable(table, {column.name: column for column in columns}, done.slow, language)


def _all(study: Study, results: list[ResultColumn]) -> Iterator[ResultColumn]:
    yield from (VARIANT, *varied_columns(study), *results, *VERDICT)


def _named(column: ResultColumn, name: str, taken: set[str]) -> ResultColumn:
    return column if name in taken else replace(column, name=name)
