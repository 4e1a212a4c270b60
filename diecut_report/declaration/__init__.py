"""The declaration check: all that can be known of a plugin from what it declares, told before anything is calculated."""

from __future__ import annotations

from diecut_report.contract.mechanism import Mechanism
from diecut_report.declaration import (
    checks,
    documents,
    figures,
    formulas,
    inputs,
    kinds,
    messages,
    order,
    symbols,
    tokens,
)
from diecut_report.declaration.names import Names
from diecut_report.declaration.words import Fault

PARTS = (inputs, tokens, formulas, order, kinds, messages, checks, figures, documents, symbols)

__all__ = ["Fault", "faults"]


def faults(mechanism: Mechanism) -> list[Fault]:
    """Return every mistake in what a mechanism declares, and in its comparisons; in the order of reading."""
    found = list(formulas.unmarked(mechanism))
    if found:  # nothing can be asked of what is no formula
        return found
    names = Names(mechanism)
    found = [fault for part in PARTS for fault in part.faults(mechanism, names)]
    for comparison in mechanism.comparisons:
        found += faults(comparison.mechanism)
    return list(dict.fromkeys(found))
