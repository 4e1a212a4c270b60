"""Which letters a report declares as symbols, and which names its configuration gives: sentences hold both."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

from diecut_report.report.given_names import given_names
from diecut_report.report.scope import parts
from diecut_report.report.symbol_list import GROUPS, used_symbols
from diecut_report.report.symbols import SYMBOL, lone_letters

Data = Mapping[str, Any]


class DeclaredLetters(NamedTuple):
    """Letters that are symbols, alone or with an index (a sentence may speak of the k of k_a), and the names that a configuration gives."""

    symbols: frozenset[str]
    names: frozenset[str]


def declared_letters(results: Data) -> DeclaredLetters:
    """Return those of all mechanisms of a report and of what compares them."""
    mechanisms = results["mechanisms"]
    own = {name for data in mechanisms.values() for name in given_names(data, mechanisms)}
    found = (SYMBOL.fullmatch(name) for _, data in parts(results) for name in _symbols(data))
    symbols = {each["base"] for each in found if each and len(each["base"].rstrip("′'")) == 1}
    for data in mechanisms.values():  # what was found wrong in a source speaks of the source's letters
        symbols.update(letter for each in data.get("errata", ()) for letter in lone_letters(each["text"]))
    return DeclaredLetters(frozenset(symbols), frozenset(own | set(mechanisms)))


def _symbols(mechanism: Data) -> Iterator[str]:
    """What its quantities and formulas are written with."""
    yield from (row["symbol"] for group in GROUPS for row in mechanism.get(group, {}).values())
    yield from used_symbols(mechanism.get("sections", ()))
