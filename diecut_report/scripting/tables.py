"""Tables of pyarrow as those of pandas or polars, where these are installed."""

from __future__ import annotations

from importlib import import_module
from typing import Any

from diecut_report.errors import ConfigError, Problem
from diecut_report.languages.phrases import Phrase
from diecut_report.scripting.spoken import told_in


def to_pandas(table: Any, language: str | None) -> Any:
    """Return a table of pandas; ConfigError where it is not installed."""
    _require("pandas", language)
    return table.to_pandas(strings_to_categorical=False)


def to_polars(table: Any, language: str | None) -> Any:
    """Return a table of polars; ConfigError where it is not installed."""
    return _require("polars", language).from_arrow(table)


def _require(library: str, language: str | None) -> Any:
    try:
        return import_module(library)
    except ImportError as cause:
        words = Phrase("{library} is not installed; install it (pip install {library}), or take the table of pyarrow by to_arrow().",
                       library=library)  # fmt: skip
        with told_in(language):
            raise ConfigError(Problem(words)) from cause
