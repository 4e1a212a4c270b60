"""The declaration check: all that can be known of a plugin from what it declares, told before anything is calculated."""

from __future__ import annotations

from diecut_report.declaration import checks, code, figures, formulas, inputs, shape, texts
from diecut_report.declaration.names import DeclaredNames, Fault
from diecut_report.mechanism.mechanism import Mechanism

RULES = (
    inputs.faults,
    inputs.allowed_faults,
    texts.token_faults,
    formulas.faults,
    formulas.order_faults,
    checks.shared_names_faults,
    formulas.kinds_faults,
    figures.phases_faults,
    inputs.conditions_faults,
    formulas.units_faults,
    shape.doubled_faults,
    checks.idle_chapters_faults,
    code.impure_faults,
    checks.messages_faults,
    checks.faults,
    checks.advice_faults,
    figures.faults,
    figures.spectra_faults,
    texts.document_faults,
    texts.symbol_faults,
    inputs.examples_faults,
)

SOUND = "declarations"  # the folder that remembers which plugins are

__all__ = ["Fault", "faults", "faults_at_load"]


def faults_at_load(mechanism: Mechanism) -> list[Fault]:
    """Return what ``faults`` returns, and what a plugin imports that is none of its business.

    One that was found sound before is not judged again until one of its files changes.
    """
    key = "" if shape.faults(mechanism) else code.content(mechanism)
    if key and code.remembered(SOUND, key) is not None:
        return []
    found = [*faults(mechanism), *code.import_faults(mechanism)]
    if key and not found:
        code.remember(SOUND, key)
    return found


def faults(mechanism: Mechanism) -> list[Fault]:
    """Return every mistake in what a mechanism declares, and in its comparisons; in the order of reading."""
    found = shape.faults(mechanism) or [*shape.unknown_units_faults(mechanism), *formulas.unreadable_faults(mechanism)]
    if found:  # nothing can be asked of what is not a formula, cannot be printed, or in a unit that is none
        return found
    names = DeclaredNames(mechanism)
    found = [fault for rule in RULES for fault in rule(names)]
    for comparison in mechanism.comparisons:
        found += faults(comparison.mechanism)
    return list(dict.fromkeys(found))
