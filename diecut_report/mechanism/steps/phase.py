"""When, over the period of an abscissa, a mechanism works, rests, moves or leaves room."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any, ClassVar, Literal, Unpack, get_args

from diecut_report.mechanism.steps.base import SilentStep, StepCondition, tuple_faults
from diecut_report.mechanism.steps.protocols import AN_ABSCISSA, ANY, NUMBER, Kinds, TakenName
from diecut_report.text.phrases import Phrase, phrase

PhaseRole = Literal["working", "rest", "moving", "window"]
ROLES: tuple[str, ...] = get_args(PhaseRole)
PREFIX = "phases."
"""What the name of a phase begins with, where quantities are named too: in references and among the ids of steps."""


@dataclass(frozen=True, eq=False)
class Phase(SilentStep):
    """Declare when, over the period of an abscissa, the mechanism does something; its id is ``phases.NAME``.

    ``role`` is what it does: ``working`` (a tool on the product), ``rest``, ``moving``, ``window`` (room for another part). Each of
    ``spans`` goes from one place to another: ids of numbers, or 0; a place that does not exist for a machine leaves its
    span out. ``period`` is the id of what repeats, where that is not the abscissa's own. ``union`` names phases that are taken
    together instead, ``rest_of`` those that leave it the rest of the period.
    """

    role: str
    abscissa: str
    spans: tuple[tuple[str | float, str | float], ...] = ()
    union: tuple[str, ...] = field(default=(), kw_only=True)
    rest_of: tuple[str, ...] = field(default=(), kw_only=True)
    period: str = field(default="", kw_only=True)

    TAKES: ClassVar[dict[str, Kinds]] = {"abscissa": AN_ABSCISSA, "period": NUMBER, "spans": ANY}
    is_run = False

    @classmethod
    def of(
        cls, name: str, role: PhaseRole, description: str, abscissa: str, *spans: tuple[str | float, str | float],
        union: tuple[str, ...] = (), rest_of: tuple[str, ...] = (), period: str = "", **when: Unpack[StepCondition],
    ) -> Phase:  # fmt: skip
        """Declare when the mechanism works, rests, moves or leaves room, over the period of ``abscissa``.

        Each of ``spans`` goes from one place to another, both ids of numbers (0 for the start of the period), the end counted on
        where it passes the period. Instead of spans ``union`` names phases that this one holds together, ``rest_of`` those
        that it leaves out.
        """
        own: dict[str, Any] = {"union": union, "rest_of": rest_of, "period": period, "description": description}
        return cls(f"{PREFIX}{name}", role, abscissa, spans, **own, **when)

    def takes_ids(self) -> Iterator[TakenName]:
        yield from super().takes_ids()
        for end in (end for span in self.spans for end in span if isinstance(end, str)):
            yield TakenName(phrase("an end"), end, NUMBER)

    def shape_faults(self) -> Iterator[str]:
        yield from super().shape_faults()
        spans: tuple[Any, ...] = self.spans
        for span in spans:
            if (
                not isinstance(span, tuple)
                or len(span) != 2
                or not all(isinstance(end, str | int | float) for end in span)
            ):
                template = 'goes between {span}; write a start and an end in brackets: ("begins", "ends")'
                yield Phrase(template, span=repr(span))
        yield from tuple_faults(self, "union", "rest_of")
