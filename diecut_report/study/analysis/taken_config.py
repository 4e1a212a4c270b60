"""A stored variant as a configuration of its own: the text of the study's base, comments and order kept, with that variant's values."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path, PurePath
from typing import Any

from diecut_report.config.discovery import Discovery
from diecut_report.config.logo import KEY as LOGO
from diecut_report.config.own_tables import KEY as TABLES
from diecut_report.config.written_values import as_file, written
from diecut_report.config.yaml_tree import Tree, resolved
from diecut_report.quantities.units import unit
from diecut_report.study.analysis.stored_variants import StoredColumn
from diecut_report.study.analysis.variant_config import as_config_value, stored_variant
from diecut_report.study.storage.state import kept


@dataclass(frozen=True)
class TakenConfig:
    """Hold a configuration taken from a study: its bytes, how the variant was judged, and the files that it names, with their copies."""

    content: bytes
    status: str
    governing: str
    beside: Mapping[str, Path]


def taken_config(directory: Path, variant: int, discovery: Discovery, digits: int | None = None) -> TakenConfig:
    """Return a variant's configuration; with ``digits`` its numbers are rounded, else read back as exactly those that were calculated.

    UserError in words where the variant is not stored or in error, or where a value cannot be put into the base's text.
    """
    found = stored_variant(directory, variant, discovery)
    values = {place: _typed(value, column, digits) for place, (column, value) in found.values.items()}
    text = written(found.base, values, over_references=True)
    heading = f"# Variant {variant} of {found.study}\n"
    beside = {name: kept(directory)[str(PurePath(found.file).parent / name)] for name in _named(found.base)}
    return TakenConfig(as_file(found.base, heading + text), found.status, found.governing, beside)


def _typed(value: Any, column: StoredColumn, digits: int | None) -> str:
    """A value as it stands in a file: a number with its unit, a text in quotes where it would be read as something else."""
    if digits is not None and isinstance(value, float):
        own = unit(column.display)
        number = f"{float(f'{own.from_si(value):.{digits}g}'):.15g}"
        return number if own.text == "1" else f"{number} {own.text}"
    given = as_config_value(value, column)
    if not isinstance(given, str):
        return repr(given)
    return given if _is_plain(given) else json.dumps(given, ensure_ascii=False)


def _is_plain(text: str) -> bool:
    """Whether a text stands without quotes for itself, also within braces."""
    return resolved(text) == text and not any(sign in text for sign in ",[]{}#:&*!|>'\"%@`\n")


def _named(base: Tree) -> Iterator[str]:
    """The files that the base names, which are sought beside it."""
    given = base.data.get(TABLES)
    yield from (name for name in (given if isinstance(given, list) else [given]) if isinstance(name, str))
    report = base.data.get(LOGO[0])
    if isinstance(report, dict) and isinstance(logo := report.get(LOGO[1]), str):
        yield logo
