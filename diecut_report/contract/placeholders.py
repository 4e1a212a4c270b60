"""What may stand in for a typed value: a number that is known already, a reference, a default of the press, one of several."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

from diecut_report.expressions import Array, Formula
from diecut_report.languages.phrases import Phrase


@dataclass(frozen=True)
class SI:
    """Hold a number (of many machines an array of them) that is already in SI, from a reference or a default of the press.

    ``told`` says from where.
    """

    value: Any
    unit: str
    told: str


@dataclass(frozen=True)
class Pending:
    """Stand for a reference whose value is not known yet; ``unit`` is that of what it refers to, None where it is not a number.

    ``phase_unit`` is that of what a phase runs over.
    """

    path: str
    unit: str | None
    is_curve: bool = False
    phase_unit: str | None = None
    is_mechanism: bool = False


class Curve(Protocol):
    """Hold a curve that an input refers to, over shares of its period."""

    def values(self, share: Array, middle: Array, rows: Array | None) -> Array:
        """Return values at shares, shape (variants, points), each in the smooth piece that the share ``middle`` lies in."""

    @property
    def breakpoints(self) -> Array:
        """Return the inner edges of the curve's smooth pieces, as shares, ascending, shape (variants, places)."""

    @property
    def joints(self) -> Array:
        """Return those of them where the curve jumps or has a corner."""

    @property
    def cycle(self) -> str:
        """Return the id of what the curve runs over: of two curves over one cycle it is the same."""


@dataclass(frozen=True)
class FromPress:
    """Name a default that the press gives: a press field's path and, where it is not that number itself, a formula of it.

    An ``optional`` one leaves the input without a value where the press does not give the field; else that is an error.
    """

    path: str
    formula: Formula | None = None
    optional: bool = False


class OneOf:
    """Name inputs of which one group is needed: ``OneOf(("torque",), ("power", "speed"))``.

    One group must be given completely, and nothing of another one, but for the keys that are ``shared``: these have a use
    beside each group. Where it is ``optional`` a default holds without any of the keys. With ``when`` it is asked only where
    a text of the same block is chosen: ``when="use=drive"``.
    """

    def __init__(
        self, *groups: tuple[str, ...], shared: tuple[str, ...] = (), optional: bool = False, when: str = ""
    ) -> None:
        self.groups, self.shared, self.optional, self.when = groups, shared, optional, when

    def is_asked(self, texts: Mapping[str, Any]) -> bool:
        """Return whether the text is chosen with which the rule holds, of the values of a block with their defaults."""
        key, _, text = self.when.partition("=")
        return not key or texts.get(key) == text

    def fault(self, given: Iterable[str]) -> str:
        """Return what is wrong with the keys that are given, in words; empty where nothing is."""
        known = set(given)
        told = ", or ".join(listed(group) for group in self.groups)
        heads = list(dict.fromkeys(group[0] for group in self.groups if group[0] in known))
        if len(heads) > 1:
            return Phrase(
                "{listed} are both given, but only one can hold; give {told}.", listed=listed(heads), told=told
            )
        complete = [group for group in self.groups if known.issuperset(group)]
        idle = known & {key for group in self.groups for key in group} - {*self.shared}.union(*complete[:1])
        if complete and not idle:
            return ""
        fuller = [group for group in self.groups if complete and {*complete[0], *idle} <= {*group}]
        if complete and not fuller:
            unused = [key for group in self.groups for key in group if key in idle]
            without = Phrase("has no use beside {listed}; remove it", listed=listed(complete[0]))
            return Phrase("{listed} {without}, or give {told}.", listed=listed(unused), without=without, told=told)
        begun = fuller or [group for group in self.groups if known & set(group) - set(self.shared)]
        if begun:
            nearest = min(begun, key=lambda group: len(set(group) - known))
            missing = [key for key in nearest if key not in known]
            beside = [key for key in nearest if key in known]
            return Phrase(
                "{listed} is missing beside {present}; give {told}.",
                listed=listed(missing),
                present=listed(beside),
                told=told,
            )
        chosen = Phrase(" with {key}", key=self.when.replace("=", ": ")) if self.when else ""
        return "" if self.optional else Phrase("{told} is needed{chosen}.", told=told, chosen=chosen)


def listed(keys: Sequence[str]) -> str:
    """Return keys in words: ``mass, inertia and velocity``."""
    return Phrase("{first} and {next}", first=", ".join(keys[:-1]), next=keys[-1]) if len(keys) > 1 else "".join(keys)
