"""Steps in one line each: what they give, without a formula, or with the place where it stands that is not printed again."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from typing import Any

from markupsafe import Markup

from diecut_report.report.given_names import in_words
from diecut_report.report.i18n import Catalogue
from diecut_report.report.number_format import number, quantity
from diecut_report.report.symbols import symbol
from diecut_report.report.told_before import Reference

Data = Mapping[str, Any]


@dataclass(frozen=True)
class ValueRow:
    """A step without its formula; ``letters`` are those that take the place of others in the formula that ``refers`` numbers."""

    number: str
    description: str
    symbol: Markup
    value: str
    at: Markup = field(default_factory=Markup)
    source: str = ""
    refers: str = ""
    letters: tuple[tuple[Markup, Markup], ...] = ()
    note: str = ""
    changed: str = ""

    def named_formula(self, words: Catalogue, *, linked: bool = False) -> Markup:
        """Where the formula stands that is not printed again, and which letters take the place of others in it."""
        number = Markup('<a href="#eq-{0}">{0}</a>').format(self.refers) if linked else self.refers
        letters = ", ".join(words.say("letter_for", new=new, old=old) for new, old in self.letters)
        key = "as_formula_with" if letters else "as_formula"
        return Markup(words.say(key, number=number, letters=letters))  # words of the catalogue, and symbols


def value_row(
    item: Data, step: str, refers: Reference | None, note: str, decimal: str, names: Collection[str] = ()
) -> ValueRow:
    """A step of the results in one line; ``names`` stand as they are."""
    at = item.get("at")
    place = symbol(at["symbol"]) + f" = {quantity(at['text'], at['unit'], decimal)}" if at else Markup("")
    result = item["result"]
    return ValueRow(
        number=step,
        description=item["description"],
        symbol=symbol(item["symbol"]),
        value=quantity(in_words(result["text"], names), result["unit"], decimal),
        at=place,
        source="" if refers else item["source"],
        refers=refers.number if refers else "",
        letters=tuple((symbol(new), symbol(old)) for new, old in refers.letters) if refers else (),
        note=note,
        changed=item.get("changed", ""),
    )


def listed_row(table: Data, decimal: str) -> ValueRow:
    """A table of one quantity of numbered parts in one line."""
    column = table["columns"][1]
    numbers = [number(row[1], decimal) for row in table["rows"]]
    value = quantity("", column["unit"]) if column["unit"] != "1" else ""
    return ValueRow("", table["title"], symbol(column["symbol"]), "; ".join(numbers) + value)
