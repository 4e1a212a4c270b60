"""What is said of a formula where it is first needed in a chapter: what its names stand for, how its units are converted."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from diecut_report.report.equations import Equation, Equations
from diecut_report.report.i18n import Catalogue
from diecut_report.report.number_format import quantity

Data = Mapping[str, Any]


class SaidOnce:
    """Remembers what a chapter has said already."""

    def __init__(self, equations: Equations, words: Catalogue) -> None:
        self.equations, self.words = equations, words
        self.defined: set[str] = set()

    def definitions(self, item: Data) -> Iterator[Equation]:
        """What names in the formula stand for, where that was not said already."""
        for equation in self.equations.definitions(item):
            if equation.text not in self.defined:
                self.defined.add(equation.text)
                yield equation

    def condition(self, item: Data) -> Equation | None:
        """Return the condition of the branch taken, with its numbers, where it says something and the chapter has not shown it already."""
        if item.get("words") and _says_nothing(item.get("condition_substituted")):
            return None
        equation = self.equations.condition(item)
        told = "" if equation is None else f"{item.get('words', '')}: {equation.text}"
        if not told or (told in self.defined and item.get("words")):
            return None
        self.defined.add(told)
        return equation

    def conversions(self, item: Data) -> Iterator[str]:
        """How numbers of the formula follow from what stands elsewhere in another unit, where that was not said already."""
        told = [self._converted(each) for each in item.get("conversions", ())]
        new = [each for each in told if each not in self.defined]
        self.defined.update(new)
        if new:
            yield f"{self.words['where']} {self.words.listed(new)}"

    def _converted(self, conversion: Data) -> str:
        """A quantity in its own unit, and in the formula's."""
        sides = (conversion[key] for key in ("shown", "converted"))
        texts = [quantity(side["text"], side["unit"], self.words["decimal"]) for side in sides]
        return " = ".join((conversion["symbol"], *texts))


def _says_nothing(condition: Any) -> bool:
    """Whether a condition is, with its numbers, that a number equals itself: a flag that is 1."""
    match condition:
        case ["cmp", "==", ["qty" | "num", left, *_], ["qty" | "num", right, *_]]:
            return bool(left == right)
    return False
