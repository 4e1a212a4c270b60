"""The configuration of one stored variant: the base with that variant's values in it."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path, PurePath
from typing import Any

from diecut_report.config import yaml
from diecut_report.config.own_tables import KEY as LOGO
from diecut_report.config.own_tables import OWN_TABLES_KEY as TABLES
from diecut_report.config.plugins import Discovery, DuplicateKind, UnknownKind
from diecut_report.config.references import as_file, written
from diecut_report.config.yaml import KeyPath, Scalar, Tree, printable, resolved, with_values
from diecut_report.errors import PluginError, Problem, UserError
from diecut_report.quantities.formatting import as_typed
from diecut_report.quantities.units import unit
from diecut_report.study.analysis.variants import Stored, StoredColumn, opened, other_code
from diecut_report.study.definition.base_inputs import MECHANISMS
from diecut_report.study.storage.state import kept
from diecut_report.text.phrases import Phrase, phrase


@dataclass(frozen=True)
class StoredVariant:
    """Hold a stored variant: the study's base and its file, the study's, the values by their places in the base, the verdict, the code."""

    base: Tree
    file: str
    study: str
    values: Mapping[KeyPath, tuple[StoredColumn, Any]]
    status: str
    governing: str
    sources: Mapping[str, str]


def variant_config(
    directory: Path, variant: int, discovery: Discovery, name: str, warn: Callable[[str], None] | None = None
) -> Tree:
    """Return the configuration of a variant: the study's base with the varied values in it, exactly as they were calculated.

    Problems of it name the base that the folder keeps; ``name`` is what documents call it. What calculates by other code than the
    study was calculated by is told to ``warn``, and stands above the configuration. UserError in words where the variant is not
    stored, and with its reason where it cannot be calculated.
    """
    with opened(directory) as stored:
        return variant_of(stored, variant, discovery, name, warn)


def variant_of(
    stored: Stored,
    variant: int,
    discovery: Discovery,
    name: str,
    warn: Callable[[str], None] | None = None,
    *,
    in_error: bool = False,
) -> Tree:
    """Return the configuration of a variant of an opened folder, as `variant_config` does; also of one that is ``in_error``."""
    found = _variant(stored, variant, discovery, in_error=in_error)
    base = found.base
    values = {place: as_config_value(value, column) for place, (column, value) in found.values.items()}
    values |= dict(_named(base, variant, found.study))
    values |= dict(_tables(base, stored.folder, found.file))
    heading = f"Variant {variant} of {found.study}: its values are exactly those that were calculated."
    kinds = (str(data.get("kind")) for data in (base.data.get(MECHANISMS) or {}).values())
    warnings = other_code(found.sources, kinds, discovery)
    if warn is not None:
        for words in warnings:
            warn(words)
    return with_values(base, values, name, "\n# ".join([heading, *warnings]))


def stored_variant(directory: Path, variant: int, discovery: Discovery) -> StoredVariant:
    """Return a variant with the base that its study keeps; UserError in words where it is not stored, or is in error."""
    with opened(directory) as stored:
        return _variant(stored, variant, discovery)


def _variant(stored: Stored, variant: int, discovery: Discovery, *, in_error: bool = False) -> StoredVariant:
    if not in_error:
        _refuse_error(stored, variant)
    row = _row(stored, variant)
    ((status, governing),) = stored.rows("SELECT status, governing FROM v WHERE variant = ?", [variant])
    description = stored.description
    base = yaml.load(kept(stored.folder)[description.base.file])
    values = {
        _value(base, _place(base, tuple(_keys(column.name)), discovery)): (column, value) for column, value in row
    }
    return StoredVariant(
        base, description.base.file, description.study.file, values, status, governing or "", description.sources
    )


def _place(base: Tree, path: KeyPath, discovery: Discovery) -> KeyPath:
    """Return where a value stands in the file: in a list, where the base gives one for several single keys."""
    mechanism = (base.data.get(MECHANISMS) or {}).get(path[1]) if path[0] == MECHANISMS and len(path) == 3 else None
    if mechanism is None:
        return path
    try:
        spread = discovery.mechanism(str(mechanism.get("kind"))).inputs.spread
    except (PluginError, UnknownKind, DuplicateKind):  # reported where the configuration is read
        return path
    homes = [
        (key, single.index(path[2]))
        for key, single in spread.items()
        if path[2] in single and isinstance(mechanism.get(key), list)
    ]
    return (*path[:2], *homes[0]) if homes else path


def _value(base: Tree, path: KeyPath) -> KeyPath:
    """Return where the value itself stands of a quantity that is a block with its basis."""
    home = base.data
    for key in path:
        known = key in home if isinstance(home, dict) else isinstance(home, list) and int(key) < len(home)
        home = home[key] if known else None
    return (*path, "value") if isinstance(home, dict) else path


def _tables(base: Tree, directory: Path, file: str) -> Iterator[tuple[KeyPath, str]]:
    """Return the copies of the tables, and of the logo, that the base names, which the folder keeps beside that of the base."""
    copies = kept(directory)
    given = base.data.get(TABLES)
    for index, name in enumerate(given if isinstance(given, list) else [given]):
        if isinstance(name, str):
            copy = copies[str(PurePath(file).parent / name)]
            yield (
                ((TABLES, index) if isinstance(given, list) else (TABLES,)),
                copy.relative_to(copies[file].parent).as_posix(),
            )
    report = base.data.get(LOGO[0])
    if isinstance(report, dict) and isinstance(logo := report.get(LOGO[1]), str):
        yield LOGO, copies[str(PurePath(file).parent / logo)].relative_to(copies[file].parent).as_posix()


def _named(base: Tree, variant: int, study: str) -> Iterator[tuple[KeyPath, str]]:
    """Return what the title block says, as typed, and which variant it is: no two documents are called alike."""
    title, number = ("project", "title"), ("project", "document_number")
    yield title, f"{base.typed(title) or ''} – variant {variant} of {printable(Path(study).stem)}"
    if (base.data.get("project") or {}).get("document_number") is not None:
        yield number, f"{base.typed(number)}/V{variant}"


def _refuse_error(stored: Stored, variant: int) -> None:
    for status, reason in stored.rows("SELECT status, error FROM v WHERE variant = ?", [variant]):
        if status == "error":
            words = Phrase(
                "Variant {variant} cannot be calculated: {reason}",
                variant=variant,
                reason=reason or phrase("no reason was stored"),
            )
            raise UserError(Problem(words, str(stored.folder)))


def _keys(path: str) -> Iterator[str | int]:
    for part in path.split("."):
        yield int(part) if part.isdecimal() else part


def _row(stored: Stored, variant: int) -> list[tuple[StoredColumn, Any]]:
    names = ", ".join(column.sql for column in stored.varied) or "variant"
    rows = stored.rows(f"SELECT {names} FROM v WHERE variant = ?", [variant])
    if not rows:
        first, last = stored.rows("SELECT min(variant), max(variant) FROM v")[0]
        is_whole = stored.study.get("state") == "complete"
        words = Phrase(
            "There is no variant {variant} here. The stored ones are within {first} … {last}; a number in "
            "between that is missing {why}",
            variant=variant,
            first=first,
            last=last,
            why=phrase("was dropped by a constraint.")
            if is_whole
            else phrase("was dropped by a constraint or is not calculated yet."),
        )
        raise UserError(Problem(words, str(stored.folder)))
    return [(column, value) for column, value in zip(stored.varied, rows[0], strict=False) if value is not None]


def as_config_value(value: Scalar, column: StoredColumn) -> Scalar:
    """Return the value as a configuration gives it; whole pure numbers (teeth) as integers."""
    if not isinstance(value, float):
        return value
    written = as_typed(value, column.display)
    is_whole = isinstance(written, float) and written.is_integer() and abs(written) < 1e15
    return int(value) if is_whole else written


# A stored variant as a configuration of its own: the text of the study's base, comments and order kept, with that variant's values.


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
    beside = {
        name: kept(directory)[str(PurePath(found.file).parent / name)] for name in _taken_config_named(found.base)
    }
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


def _taken_config_named(base: Tree) -> Iterator[str]:
    """The files that the base names, which are sought beside it."""
    given = base.data.get(TABLES)
    yield from (name for name in (given if isinstance(given, list) else [given]) if isinstance(name, str))
    report = base.data.get(LOGO[0])
    if isinstance(report, dict) and isinstance(logo := report.get(LOGO[1]), str):
        yield logo
