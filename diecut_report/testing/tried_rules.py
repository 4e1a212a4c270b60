"""What the contract test tells of each rule, and where in a plugin something stands."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import islice
from typing import Literal

from diecut_report.languages.phrases import Counted, Phrase, phrase

RuleStatus = Literal["pass", "note", "not_tried", "fail", "broke"]
WORST_LAST = ("pass", "not_tried", "note", "fail", "broke")
TOLD = 5  # faults of a rule that a short list tells
TITLES = {
    "declaration": phrase("Declarations"),
    "dimensions": phrase("Dimensions of formulas"),
    "printed": phrase("Printed as computed"),
    "inputs": phrase("Inputs that are taken"),
    "doubts": phrase("Doubtful declarations"),
    "example": phrase("Example machine"),
    "alone": phrase("Many machines as each alone"),
    "verdicts": phrase("Checks that can fail"),
    "hostile": phrase("Extreme inputs"),
    "figures": phrase("Figures and report"),
    "languages": phrase("Words in all languages"),
    "speed": phrase("Time of 1000 variants"),
}
"""The rules of the contract, in the order in which they are tried."""


@dataclass(frozen=True)
class TriedRule:
    """Hold a rule of the contract that was tried: what was found in words, and each fault with its place and what to do.

    ``note`` is no fault, but what an author should know; ``broke`` is a plugin that raises where it should not.
    """

    id: str
    status: RuleStatus
    told: str = ""
    faults: tuple[str, ...] = ()

    @property
    def title(self) -> Phrase:
        """Return what the rule is about."""
        return TITLES[self.id]

    @property
    def short_list(self) -> tuple[str, ...]:
        """Return the first faults, and how many more there are."""
        left = len(self.faults) - TOLD
        if left <= 0:
            return self.faults
        if self.status == "note":
            return (*self.faults[:TOLD], Counted(left, "{n} more note", "{n} more notes"))
        return (*self.faults[:TOLD], Counted(left, "{n} more fault", "{n} more faults"))


def rule(id: str, told: str, faults: Iterable[str], otherwise: RuleStatus = "fail") -> TriedRule:
    """Return a rule that passes where there is no fault; of many faults the first thousand."""
    found = tuple(dict.fromkeys(islice(faults, 1000)))
    return TriedRule(id, otherwise if found else "pass", told, found)
