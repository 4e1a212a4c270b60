"""Many machines of a press, calculated together as the variants of a study, as one table."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np
import yaml
from numpy.typing import NDArray

from diecut_report.config.loader import Config
from diecut_report.config.plugins import Discovery
from diecut_report.config.yaml import parse
from diecut_report.errors import ConfigError, PluginError, Problem
from diecut_report.quantities.formatting import shown
from diecut_report.quantities.units import pretty, unit
from diecut_report.report.text import Catalogue, quantity
from diecut_report.scripting.parts import NamedParts, Tabular, axis_label
from diecut_report.scripting.values import notebook_page, plain, whole_path
from diecut_report.study.definition.study_file import Study, load_study
from diecut_report.study.execution.study_run import result_columns, varied_columns
from diecut_report.study.execution.worker import Chunk, Done, calculate
from diecut_report.study.storage.description import VARIANT, VERDICT, ResultColumn
from diecut_report.study.storage.store import described_table
from diecut_report.text.catalogues import SOURCE_LANGUAGE
from diecut_report.text.phrases import Phrase, phrase

MOST = 1_000_000  # machines of a table in memory
FILE = "sweep"
ROWS, COLUMNS = 12, 8  # that a notebook shows


class SweepTable(Tabular):
    """Hold a table of machines: a row each, with what varies, outputs, checks (``NAME.checks.ID.utilisation``, ``.status``) and the verdict.

    Numbers are SI; ``columns`` tells unit, symbol and description of each. The columns ``status`` (``pass``, ``warn``, ``fail``, ``error``),
    ``governing`` and ``error`` stand at the end; what varies is named as it was asked for, by its whole path where an output has that name.
    """

    def __init__(
        self, table: Any, columns: Mapping[str, ResultColumn], slow: Mapping[str, str], language: str | None
    ) -> None:
        self._table, self.language = table, language
        self.columns = NamedParts(columns, phrase("the table has no column"), language)
        self.slow = dict(slow)

    def __len__(self) -> int:
        return int(self._table.num_rows)

    def __getitem__(self, name: str) -> NDArray[Any]:
        """Return a column as an array of NumPy: floats with NaN, texts with None, where a machine has no value; UnknownName for another name."""
        about, column = self.columns[name], self._table.column(name)
        if about.kind in ("text", "bool"):
            return np.array(column.to_pylist(), dtype=object)
        if about.name == VARIANT.name:
            return np.asarray(column.to_numpy())
        return np.asarray(column.cast("float64").to_numpy(zero_copy_only=False))

    def counts(self) -> dict[str, int]:
        """Return how many machines there are of each status."""
        names, numbers = np.unique(self["status"].astype(str), return_counts=True)
        return {str(name): int(number) for name, number in zip(names, numbers, strict=True)}

    def plot(self, x: str, y: str, axes: Any = None, **style: Any) -> Any:
        """Draw one column over another, in the units of a report; return the axes of matplotlib, whose ``figure`` a notebook shows."""
        from diecut_report.report.figures.style import plotted

        units = self.units(shown=True)
        across, upwards = (self[name] / unit(units.get(name, "1")).factor for name in (x, y))
        first, second = (axis_label(self.columns[name].description or name, units.get(name, "1")) for name in (x, y))
        return plotted(across, upwards, (first, second), axes, **{"marker": "o", "linestyle": "", "label": y, **style})

    def units(self, *, shown: bool = False) -> dict[str, str]:
        """Return the unit of each column that has one: the SI unit, or that of a report."""
        found = {name: (shown and about.display) or about.unit for name, about in self.columns.items()}
        return {name: own for name, own in found.items() if own and own != "1"}

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

    def __repr__(self) -> str:
        told = ", ".join(f"{number} {status}" for status, number in self.counts().items())
        return f"<{len(self)} machines ({told}); {len(self.columns)} columns: {', '.join(list(self.columns)[:4])}, …>"

    def _repr_html_(self) -> str:
        words = Catalogue(SOURCE_LANGUAGE)
        names = [name for name in self.columns if ".checks." not in name and name != "error"]
        names = names if len(names) <= COLUMNS else [*names[: COLUMNS - 2], *names[-2:]]
        units = {name: self.columns[name].display or self.columns[name].unit for name in names}
        rows = list(
            zip(*([_cell(value, units[name]) for value in self[name][:ROWS].tolist()] for name in names), strict=True)
        )
        told = f"{len(self)}: " + ", ".join(f"{number} {words[status]}" for status, number in self.counts().items())
        heads = [(name, pretty(unit)) for name, unit in units.items()]
        return notebook_page("sweep", words, told=told, columns=heads, rows=rows, more=len(self) > ROWS)


def _cell(value: Any, unit: str) -> str:
    if value is None or value != value:  # NaN
        return "–"
    is_number = isinstance(value, int | float) and not isinstance(value, bool)
    return quantity(shown(float(value), unit)["text"], "1") if is_number else str(value)


def swept(
    config: Config, discovery: Discovery, language: str | None, vary: Mapping[str, Any], sample: Mapping[str, Any], asked: Mapping[str, Any]
) -> SweepTable:  # fmt: skip
    """Return the table of what is asked, the blocks of a study; UserError in words where that cannot be, PluginError where a plugin breaks
    on all machines.
    """
    for error in config.broken.values():
        raise error
    values = {whole_path(path): plain(given, path) for path, given in vary.items()}
    data = {"schema_version": 1, "base": config.tree.name, "sample": dict(sample), "vary": values, **asked}
    study = load_study(parse(yaml.safe_dump(data, allow_unicode=True, sort_keys=False), FILE), discovery, base=config)
    if study.sample.count > MOST:
        message = Phrase("there are {count} machines; a table has at most {most}. Calculate them as a study, with the command batch.",
                       count=study.sample.count, most=MOST)  # fmt: skip
        raise ConfigError(Problem(message, path="vary"))
    done = calculate(study, Chunk(0, 0, study.sample.count))
    if done.broken and all(done.columns["status"] == "error"):
        kind, words_of_plugin = next(iter(done.broken.items()))
        raise PluginError(words_of_plugin, kind)
    return _table(study, done, language, {whole_path(path): path for path in vary})


def _table(study: Study, done: Done, language: str | None, names: Mapping[str, str]) -> SweepTable:
    varied, results = varied_columns(study), result_columns(study)
    taken = {column.name for column in results}  # what varies has its short name where no result has that
    short = [names[column.name] if names[column.name] not in taken else column.name for column in varied]
    named = {replace(column, name=name): column.name for column, name in zip(varied, short, strict=True)}
    columns = {VARIANT: VARIANT.name, **named, **{column: column.name for column in (*results, *VERDICT)}}
    table = described_table(
        {column: done.columns.get(name) for column, name in columns.items()}, len(done.columns["status"])
    )
    return SweepTable(table, {column.name: column for column in columns}, done.slow, language)
