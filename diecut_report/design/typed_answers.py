"""Values that were found, as they are typed: with few digits where these answer as well, each calculated as it is typed."""

from __future__ import annotations

from typing import Protocol

import numpy as np

from diecut_report.design.answers import FoundValue, Role
from diecut_report.design.design_inputs import DesignInput
from diecut_report.design.questions import DesignQuestion
from diecut_report.design.varied_machines import VariedMachines
from diecut_report.expressions import Array

EXACT, ALL = 9, 17  # digits of a root; of one beside a jump
REACHED = 1e-5  # share of its size by which a root as it is typed may miss the value
FEW = 5  # digits of the end of a range
SAME_END = 1e-6  # share of an end by which a rounded one may lie beyond it, where it holds all the same
SAME_EXTREME = 2e-5  # share of an extreme that rounding the input may take from it
BEYOND = 1e-4  # share of a value by which it is left to see what fails there


class Searched(Protocol):
    """What typed values are calculated by."""

    design: DesignInput
    question: DesignQuestion
    passing: bool

    def machines(self, x: Array) -> VariedMachines:
        """Return the machines with these values."""

    def holds(self, made: VariedMachines, y: Array) -> Array:
        """Return how far what is asked holds, not below zero where it does."""

    def missed(self, y: Array) -> Array:
        """Return by what share of its size each misses the value that is asked for."""


def typed_answers(search: Searched, places: list[tuple[float, Role]]) -> list[FoundValue]:
    """Return for each place what is typed there, all calculated in one run."""
    texts = [_candidates(search.design, value, role) for value, role in places]
    rows = [(number, search.design.read(text)) for number, each in enumerate(texts) for text in each]
    beyond = [(number, value) for number, (value, role) in enumerate(places) for value in _outside(search, value, role)]
    if not rows:
        return []
    x = np.array([value for _, value in (*rows, *beyond)])
    made = search.machines(x)
    y = made.values(search.question.quantity.column)
    held, missed = search.holds(made, y) >= 0, search.missed(y)
    owner = np.array([number for number, _ in (*rows, *beyond)])
    found = []
    for number, (value, role) in enumerate(places):
        own = np.flatnonzero(owner[: len(rows)] == number)
        best = _chosen(own, x, y, held, missed, value, role)
        text = texts[number][best - own[0]]
        outside = np.flatnonzero(owner[len(rows) :] == number) + len(rows)
        failing = tuple(made.failing(int(best))) if search.passing else ()
        limits = tuple(dict.fromkeys(name for row in outside for name in made.failing(int(row)) if name not in failing))
        found.append(FoundValue(float(x[best]), text, float(y[best]), role, failing, limits))
    return found


def _candidates(design: DesignInput, value: float, role: Role) -> list[str]:
    """What may be typed, the best first."""
    exact = design.typed(value, EXACT)
    if design.is_whole or role == "today" or value == design.today:
        return [exact]
    inwards = [design.typed_inwards(value, EXACT, up=up) for up in (True, False)]
    few = {
        "root": [exact, *inwards, design.typed(value, ALL)],  # beside a jump rounding may fall over its edge
        "lower": [design.typed(value, FEW), design.typed_inwards(value, FEW, up=True), inwards[0], exact],
        "upper": [design.typed(value, FEW), design.typed_inwards(value, FEW, up=False), inwards[1], exact],
        "extreme": [*(design.typed(value, digits) for digits in (3, 4, 5, 6, 7)), exact],
    }.get(role, [exact])
    return [text for text in dict.fromkeys(few) if design.allows(np.array(_number(design, text)))]


def _number(design: DesignInput, text: str) -> float:
    try:
        return design.read(text)
    except ValueError:  # rounded beyond what its declaration allows
        return float("nan")


def _chosen(own: Array, x: Array, y: Array, held: Array, missed: Array, value: float, role: Role) -> int:
    """The first of the candidates that is as good as the exact one, which is the last."""
    exact = int(own[-1])
    if role in ("lower", "upper"):
        near = np.abs(x[own] - value) <= SAME_END * abs(value)
        inside = x[own] >= value if role == "lower" else x[own] <= value
        good = held[own] & (near | inside)
    elif role == "extreme":
        good = held[own] & (np.abs(y[own] - y[exact]) <= SAME_EXTREME * abs(y[exact]))
    elif role == "root":
        good = missed[own] <= REACHED
    else:
        return exact
    return int(own[np.argmax(good)]) if good.any() else exact


def _outside(search: Searched, value: float, role: Role) -> list[float]:
    """Values just beyond the end of what passes."""
    if not search.passing or role in ("root", "today", "nearest"):
        return []
    step = 1.0 if search.design.is_whole else BEYOND * abs(value)
    ways = {"lower": (-step,), "upper": (step,)}.get(role, (-step, step))
    beyond = np.array([value + way for way in ways])
    return [float(each) for each in beyond[search.design.allows(beyond)]]
