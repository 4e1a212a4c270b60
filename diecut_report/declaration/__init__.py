"""The declaration check: all that can be known of a plugin from what it declares, told before anything is calculated."""

from __future__ import annotations

from diecut_report.contract.mechanism import Mechanism
from diecut_report.declaration import (
    allowed,
    checks,
    conditions,
    documents,
    doubled,
    examples,
    figures,
    formulas,
    idle_chapters,
    imports,
    impure,
    inputs,
    kinds,
    messages,
    order,
    phases,
    remembered,
    shape,
    shared_names,
    spectra,
    symbols,
    tables,
    tokens,
    units,
    unknown_units,
)
from diecut_report.declaration.names import DeclaredNames
from diecut_report.declaration.words import Fault

PARTS = (
    inputs,
    allowed,
    tokens,
    formulas,
    order,
    shared_names,
    kinds,
    phases,
    conditions,
    units,
    tables,
    doubled,
    idle_chapters,
    impure,
    messages,
    checks,
    figures,
    spectra,
    documents,
    symbols,
    examples,
)

__all__ = ["Fault", "faults", "faults_at_load"]


def faults_at_load(mechanism: Mechanism) -> list[Fault]:
    """Return what ``faults`` returns, and what a plugin imports that is none of its business.

    One that was found sound before is not judged again until one of its files changes.
    """
    key = "" if shape.faults(mechanism) or list(formulas.unmarked(mechanism)) else remembered.content(mechanism)
    if key and remembered.is_sound(key):
        return []
    found = [*faults(mechanism), *imports.faults(mechanism)]
    if key and not found:
        remembered.remember(key)
    return found


def faults(mechanism: Mechanism) -> list[Fault]:
    """Return every mistake in what a mechanism declares, and in its comparisons; in the order of reading."""
    found = shape.faults(mechanism) or list(formulas.unmarked(mechanism)) or list(unknown_units.faults(mechanism))
    if found:  # nothing can be asked of what is not a formula, or in a unit that is none
        return found
    names = DeclaredNames(mechanism)
    found = [fault for part in PARTS for fault in part.faults(mechanism, names)]
    for comparison in mechanism.comparisons:
        found += faults(comparison.mechanism)
    return list(dict.fromkeys(found))
