"""The configuration of one stored variant: the base with that variant's values in it, to calculate it or as a file of its own."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path, PurePath
from typing import Any

from diecut_report.config import yaml
from diecut_report.config.own_tables import KEY as LOGO
from diecut_report.config.own_tables import OWN_TABLES_KEY as TABLES
from diecut_report.config.parts.reading import place_of, typed_changes
from diecut_report.config.plugins import Discovery, DuplicateKind, UnknownKind
from diecut_report.config.references import as_file, assumed_bases, rewritten
from diecut_report.config.yaml import KeyPath, Scalar, Tree, printable, resolved, with_values
from diecut_report.errors import PluginError, Problem, UserError, refusal
from diecut_report.quantities.formatting import as_typed
from diecut_report.quantities.units import unit
from diecut_report.study.analysis.variants import Stored, StoredColumn, opened, other_code
from diecut_report.study.definition.base_inputs import MECHANISMS
from diecut_report.study.storage.description import STATE, kept
from diecut_report.text.phrases import Phrase, phrase


@dataclass(frozen=True)
class StoredVariant:
    """Hold a stored variant: its study's base with the files that this names, the values by their places in the base, and its verdict."""

    base: Tree
    beside: Mapping[KeyPath, tuple[str, Path]]  # by the key that names a file: its name, and its copy in the folder
    values: Mapping[KeyPath, tuple[StoredColumn, Any]]
    status: str
    governing: str


LONGEST_NUMBER = 18  # digits of a variant's number


def variant_named(given: Path) -> tuple[Path, int] | None:
    """Return the folder and the number of ``DIR#N``, where DIR holds a study's results; None for any other name."""
    folder, _, number = str(given).rpartition("#")
    is_number = number.isascii() and number.isdecimal() and len(number) <= LONGEST_NUMBER
    if not folder or not is_number or os.path.exists(given) or not os.path.exists(Path(folder) / STATE):
        return None
    return Path(folder), int(number)


def variant_config(
    directory: Path, variant: int, discovery: Discovery, name: str, warn: Callable[[str], None] | None = None
) -> Tree:
    """Return the configuration of a variant: the study's base with the varied values in it, exactly as they were calculated.

    Problems of it name the base that the folder keeps; ``name`` is what documents call it. What calculates by other code than the
    study was calculated by is told to ``warn``, and stands above the configuration. UserError where the variant is not
    stored, and with its reason where it cannot be calculated.
    """
    with opened(directory) as stored:
        return variant_of(stored, variant, discovery, name, warn)


def variant_of(
    stored: Stored, variant: int, discovery: Discovery, name: str, warn: Callable[[str], None] | None = None, *, in_error: bool = False
) -> Tree:  # fmt: skip
    """Return the configuration of a variant of an opened folder, as `variant_config` does; also of one that is ``in_error``."""
    found = _variant(stored, variant, discovery, in_error=in_error)
    base, study = found.base, printable(stored.description.study.file)
    values = {place: as_config_value(value, column) for place, (column, value) in found.values.items()}
    units = {place: column.display for place, (column, _) in found.values.items()}
    typed = typed_changes(base, values)
    values = {**typed, **assumed_bases(base, typed, units)}
    values |= dict(_title_block(base, variant, study))
    home = kept(stored.folder)[stored.description.base.file].parent
    values |= {key: copy.relative_to(home).as_posix() for key, (_, copy) in found.beside.items()}
    kinds = (str(data.get("kind")) for data in (base.data.get(MECHANISMS) or {}).values())
    warnings = other_code(stored.description.sources, kinds, discovery)
    if warn is not None:
        for words in warnings:
            warn(words)
    heading = f"Variant {variant} of {study}: its values are exactly those that were calculated."
    return with_values(base, values, name, "\n# ".join([heading, *warnings]))


def taken_config(
    directory: Path, variant: int, discovery: Discovery, digits: int | None = None
) -> tuple[bytes, StoredVariant]:
    """Return a variant, and its configuration as a file: the text of the base, comments and order kept, with that variant's values.

    With ``digits`` its numbers are rounded, else read back as exactly those that were calculated. UserError where the variant is
    not stored or in error, or where a value cannot be put into the base's text.
    """
    with opened(directory) as stored:
        found, study = _variant(stored, variant, discovery), printable(stored.description.study.file)
    values = {place: _typed(value, column, digits) for place, (column, value) in found.values.items()}
    places = {place: str(value) for place, value in typed_changes(found.base, values).items()}
    units = {place: column.display for place, (column, _) in found.values.items()}
    changed = rewritten(found.base, places, units, over_references=True)
    text = f"# Variant {variant} of {study}\n" + changed.text
    return as_file(found.base, text), found


def _variant(stored: Stored, variant: int, discovery: Discovery, *, in_error: bool = False) -> StoredVariant:
    """Return a variant with the base that its study keeps; UserError where it is not stored, or is in error."""
    names = ", ".join(["status", "governing", "error", *(column.sql for column in stored.varied)])
    rows = stored.rows(f"SELECT {names} FROM v WHERE variant = ?", [variant])
    if not rows:
        raise UserError(Problem(_missing(stored, variant), str(stored.folder)))
    status, governing, reason, *row = rows[0]
    if status == "error" and not in_error:
        why = reason or phrase("no reason was stored")
        raise refusal("Variant {variant} cannot be calculated: {reason}", stored.folder, variant=variant, reason=why)
    copies, file = kept(stored.folder), stored.description.base.file
    base = yaml.load(copies[file])
    given = ((column, value) for column, value in zip(stored.varied, row, strict=True) if value is not None)
    values = {_place(base, column.name, discovery): (column, value) for column, value in given}
    beside = {key: (name, copies[str(PurePath(file).parent / name)]) for key, name in _named_files(base)}
    return StoredVariant(base, beside, values, status, governing or "")


def _missing(stored: Stored, variant: int) -> Phrase:
    first, last = stored.rows("SELECT min(variant), max(variant) FROM v")[0]
    template = "There is no variant {variant} here. The stored ones are within {first} … {last}; a number in between that is missing {why}"
    is_complete = stored.study.get("state") == "complete"
    unfinished = phrase("was excluded by a constraint or is not calculated yet.")
    why = phrase("was excluded by a constraint.") if is_complete else unfinished
    return Phrase(template, variant=variant, first=first, last=last, why=why)


def _place(base: Tree, name: str, discovery: Discovery) -> KeyPath:
    """Return where a value stands in the file: in a list where the base gives one for several single keys, or in a block with its basis."""
    path = place_of(base.data, name)
    mechanism = (base.data.get(MECHANISMS) or {}).get(path[1]) if path[0] == MECHANISMS and len(path) == 3 else None
    if mechanism is not None:
        try:
            spread = discovery.mechanism(str(mechanism.get("kind"))).inputs.spread
        except (PluginError, UnknownKind, DuplicateKind):  # reported where the configuration is read
            spread = {}
        homes = [key for key, single in spread.items() if path[2] in single and isinstance(mechanism.get(key), list)]
        path = (*path[:2], homes[0], spread[homes[0]].index(path[2])) if homes else path
    home = base.data
    for key in path:
        known = key in home if isinstance(home, dict) else isinstance(home, list) and int(key) < len(home)
        home = home[key] if known else None
    return (*path, "value") if isinstance(home, dict) else path


def _named_files(base: Tree) -> Iterator[tuple[KeyPath, str]]:
    """Yield the tables, and the logo, that the base names, which are sought beside it."""
    given = base.data.get(TABLES)
    for index, name in enumerate(given if isinstance(given, list) else [given]):
        if isinstance(name, str):
            yield ((TABLES, index) if isinstance(given, list) else (TABLES,)), name
    report = base.data.get(LOGO[0])
    if isinstance(report, dict) and isinstance(logo := report.get(LOGO[1]), str):
        yield LOGO, logo


def _title_block(base: Tree, variant: int, study: str) -> Iterator[tuple[KeyPath, str]]:
    """Yield what the title block says, as typed, and which variant it is: no two documents are called alike."""
    title, number = ("project", "title"), ("project", "document_number")
    yield title, f"{base.typed(title) or ''} – variant {variant} of {Path(study).stem}"
    if (base.data.get("project") or {}).get("document_number") is not None:
        yield number, f"{base.typed(number)}/V{variant}"


def as_config_value(value: Scalar, column: StoredColumn) -> Scalar:
    """Return the value as a configuration gives it; whole pure numbers (teeth) as integers."""
    if not isinstance(value, float):
        return value
    typed = as_typed(value, column.display)
    is_whole = isinstance(typed, float) and typed.is_integer() and abs(typed) < 1e15
    return int(value) if is_whole else typed


def _typed(value: Any, column: StoredColumn, digits: int | None) -> str:
    """Return a value as it stands in a file: a number with its unit, a text in quotes where it would be read as something else."""
    if digits is not None and isinstance(value, float):
        own = unit(column.display)
        number = f"{float(f'{own.from_si(value):.{digits}g}'):.15g}"
        return number if own.text == "1" else f"{number} {own.text}"
    given = as_config_value(value, column)
    if not isinstance(given, str):
        return repr(given)
    # whether it stands without quotes for itself, also within braces
    is_plain = resolved(given) == given and not any(sign in given for sign in ",[]{}#:&*!|>'\"%@`\n")
    return given if is_plain else json.dumps(given, ensure_ascii=False)
