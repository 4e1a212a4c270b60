"""A check: what is demanded against what limits it, always as ``demand ≤ limit``."""

from __future__ import annotations

import reprlib
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import KW_ONLY, dataclass, replace
from functools import lru_cache, wraps
from inspect import signature
from typing import Any, Literal, TypeVar, get_args

import numpy as np

from diecut_report.errors import nearest
from diecut_report.formulas import Array
from diecut_report.formulas.expression import Expression
from diecut_report.mechanism.names import Misdeclared, placed
from diecut_report.standards.tables import StandardSeries
from diecut_report.text.phrases import Phrase, phrase

CheckClass = Literal["safety", "function", "strength", "practice", "numerical"]
ROUNDING = 1e-9  # relative: what is sized for its limit, or typed at it, reaches it
CURVE_ROUNDING = 1e-6  # relative: what is integrated or found on curves, which is proved to 1e-8 of their size


@dataclass(frozen=True)
class Vary:
    """Name an input that may be changed so that a check holds, where its key alone does not say enough.

    ``to`` is the direction where only one makes sense; ``series`` are the values that can be bought, ascending: a standard series, or
    numbers in the unit of the input; or those of its texts that are tried.
    """

    key: str
    to: Literal["up", "down", ""] = ""
    series: tuple[float | str, ...] | StandardSeries = ()

    @property
    def values(self) -> tuple[float | str, ...]:
        """Return the values that are tried alone; none where all are."""
        return self.series.values if isinstance(self.series, StandardSeries) else self.series


AdviceWay = str | Vary | tuple[str, ...]
"""An input that is changed alone, or several that are changed together in one proportion."""


# What an author may write wrongly in a check before anything is known of what it compares.


Declared = TypeVar("Declared")
ORDER = 'Check("id", "class", "title", m.demand, m.limit, consequence="…")'
WANTED = {
    "id": phrase("its id"), "check_class": Phrase("its class ({known})", known=", ".join(get_args(CheckClass))), "title": phrase("its title"),
    "demand": phrase("a quantity or a number as its demand"), "limit": phrase("a quantity or a number as its limit"),
}  # fmt: skip
"""What stands by its place, in words."""


def told_calls(declared: type[Declared]) -> type[Declared]:
    """Tell in words, with the author's line, what is wrong with how one is made."""
    init = declared.__init__

    @wraps(init)
    def told(self: Declared, *args: Any, **options: Any) -> None:
        try:
            init(self, *args, **options)
        except TypeError as wrong:
            if not isinstance(wrong, Misdeclared):
                _refuse_call(declared, args, options)
            raise

    declared.__init__ = told  # type: ignore[method-assign,assignment]
    return declared


def _refuse_call(declared: type, args: tuple[Any, ...], options: Mapping[str, Any]) -> None:
    own = signature(declared)
    given = {**dict(zip(own.parameters, args, strict=False)), **options}
    judge(given)
    for name in options.keys() - own.parameters.keys():
        template = "{id} has no option {name}{near}"
        raise Misdeclared(Phrase(template, id=given.get("id", ""), name=name, near=nearest(name, own.parameters)))
    try:
        own.bind(*args, **options)
    except TypeError as wrong:
        template = "check {id}: {wrong}; write {order}, and all else by its name"
        raise Misdeclared(Phrase(template, id=given.get("id", ""), wrong=str(wrong), order=ORDER)) from None


def judge(given: Mapping[str, Any]) -> None:
    """Raise Misdeclared where one of the first five parts of a check is of another kind: they may stand in another order."""
    for name in WANTED:
        if name in given and not _is_sound(name, part := given[name]):
            written = f"m.{part.id}" if isinstance(part, Expression) and part.id else reprlib.repr(part)
            template = "check {id} has {given} in the place of {wanted}; write {order}"
            told = {"id": "" if name == "id" else given.get("id", ""), "given": written, "order": ORDER}
            raise Misdeclared(Phrase(template, told, wanted=WANTED[name]))


def _is_sound(name: str, part: Any) -> bool:
    if name in ("id", "check_class", "title"):
        return isinstance(part, str) and (name != "check_class" or part in get_args(CheckClass))
    return isinstance(part, str | Expression | int | float | np.number) and not isinstance(part, bool)


@told_calls
@dataclass(frozen=True, eq=False)
class Check:
    """Demand ``demand`` ≤ ``limit``, and ``at_least`` ≤ ``demand`` where that is given (quantities, or plain numbers in ``unit``).

    Where nothing else is said, ``unit`` is that of the demand, or of the limit where the demand is a number; ``source`` is that of the
    demand, or else of the limit. ``demand_label`` and ``limit_label`` are what the quantities are described as, beginning with a small
    letter; an input that limits a result is "allowed", a number that does "accepted", and a number that is demanded "at least".

    The utilisation is demand / limit, and null where the limit is not above zero; of a two-sided check it is the worse of
    that and at_least / demand. A row over repeated parts is judged part by part, and the worst one governs; a curve where
    it goes furthest beyond its limit. ``consequence`` may name the part of a row that governs: ``{part}``, counted from 1.

    For an upper bound the demand is the machine's and the limit the allowed value; for a lower bound the demand is
    what is required and the limit what there is, so that the utilisation is required / available.
    A demand at its limit holds, but for rounding, and one that must be below it (``operator`` "<") is below; ``tolerance`` is the share of
    the limit where other rounding is greater.
    ``severity`` "warn" makes a failing check a warning, beyond the utilisation ``fails_beyond`` still a failure.
    ``consequence`` says what a failure means; what to change besides the keys of ``advise`` may follow in words.
    ``advise`` names the inputs that may be changed, each way by itself: ("shaft_diameter", "key_length"). The values with
    which the check holds are found by calculating the mechanism with others, and are not written by hand.

    ``check_class`` is "safety" (somebody can be hurt), "function" (the machine does not do what it is for), "strength"
    (a part breaks, wears, slips or overheats), "practice" (a rule of experience is left) or "numerical" (a self-test of the calculation, which is
    not among the checks of the machine; where one fails the mechanism is in error).

    A check that needs an optional input which is not given is reported as not checked, with the keys that it needs. Where it does not apply
    at all it is left out: an option of a text, a block or an alternative of its inputs was not chosen, or a key of ``only_with`` is not
    given, or the press has no mechanism of the kinds ``only_beside``; a block of ``asks_for`` is missed like a key. ``sized_unless`` names
    the inputs in place of which the program sizes what is compared to its own limit; () where it always does. Such a check shows no reserve
    while they are not given. ``presumed`` says that it judges what the calculation presumes, such as the range of a method, or that two
    mechanisms are calculated with the same mass: that it holds is no reserve of the machine, so that it governs only where it does not.

    ``founded`` names optional inputs by which the check would hold because somebody typed them (a factor of a standard, a fact of the
    design): where one is given without a basis that can be looked up, the check that holds is reported as not checked.

    ``at_best`` names optional inputs without which the demand is the least that it can be: beyond its limit the check fails, and that it holds
    is not checked.

    A row whose parts have names is one check for each of them with ``named_by``, the text input of their names
    (``interlocks.name``): ``part_id`` makes the check's id of ``{id}`` and ``{name}``, and ``{part}`` is then the name.
    """

    id: str
    check_class: CheckClass
    title: str
    demand: str | float
    limit: str | float
    _: KW_ONLY
    unit: str = ""
    demand_label: str = ""
    limit_label: str = ""
    consequence: str
    source: str = ""
    operator: Literal["<=", "<"] = "<="
    severity: Literal["fail", "warn"] = "fail"
    fails_beyond: float | None = None
    tolerance: float = ROUNDING
    needs: tuple[str, ...] = ()
    only_with: tuple[str, ...] = ()
    only_beside: tuple[str, ...] = ()
    asks_for: tuple[str, ...] = ()
    sized_unless: tuple[str, ...] | None = None
    presumed: bool = False
    founded: tuple[str, ...] = ()
    at_best: tuple[str, ...] = ()
    at_least: str | float | None = None
    at_least_label: str = phrase("at least")
    named_by: str = ""
    part_id: str = "{id}_{name}"
    part_name: str = ""
    advise: tuple[AdviceWay, ...] = ()
    index: int | None = None
    at: str = placed()

    def __post_init__(self) -> None:
        judge(vars(self))

    @property
    def pairs(self) -> tuple[tuple[str | float, str | float], ...]:
        """Return what is held against what, the first not above the second: demand and limit, then the lower bound and demand."""
        upper = ((self.demand, self.limit),)
        return upper if self.at_least is None else (*upper, (self.at_least, self.demand))

    def reach(self, limit: Any) -> Any:
        """Return up to where a demand holds: at its limit but for rounding, or by ``tolerance``; below it where it must be below."""
        return limit if self.operator == "<" else limit + self.tolerance * np.abs(limit)

    def is_failure(self, utilisation: Array) -> Array:
        """Return whether the check fails where it does not hold; else that is a warning."""
        beyond = np.inf if self.fails_beyond is None else self.fails_beyond
        return np.full(np.shape(utilisation), True) if self.severity == "fail" else np.asarray(utilisation) > beyond

    @lru_cache(maxsize=4096)  # noqa: B019  # checks are declared once; what is known of each is kept by the object that it is
    def of_part(self, index: int, name: str) -> Check:
        """Return the check of one part alone."""
        own = self.part_id.format(id=self.id, name=name)
        return replace(
            self,
            id=own,
            title=Phrase("{title}: {name}", title=phrase(self.title), name=name),
            part_name=name,
            index=index,
        )

    @property
    def named(self) -> tuple[str, ...]:
        """Return the ids of the quantities that are compared, each once."""
        return tuple(dict.fromkeys(side for pair in self.pairs for side in pair if isinstance(side, str)))


def by_part(checks: Iterable[Check], names: Callable[[str], Sequence[str] | None]) -> Iterator[Check]:
    """Yield checks with those of named parts one by one; ``names`` gives the names of parts, None where they are not there."""
    for check in checks:
        found = names(check.named_by) if check.named_by else None
        yield from [check] if found is None else (check.of_part(index, name) for index, name in enumerate(found))


# What plain code says of a machine that cannot be.


class Refusal(Exception):
    """Say, out of plain code, that a machine cannot be: the key to change (``lines.0.offset``), and why in words."""

    def __init__(self, key: str, words: str) -> None:
        super().__init__(f"{key}: {words}")
        self.key, self.words = key, words
