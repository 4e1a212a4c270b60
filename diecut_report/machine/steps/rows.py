"""Steps over repeated parts (rows), and numbers from standard series, for all variants."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import cache, lru_cache, partial
from itertools import takewhile
from typing import Any, NamedTuple

import numpy as np

from diecut_report.formulas import Array
from diecut_report.machine.calculation import Calculation, Impossible
from diecut_report.machine.mechanism import MechanismHandle
from diecut_report.machine.numerics import extremes
from diecut_report.machine.steps.lookups import given_of
from diecut_report.machine.steps.soundness import possible, refuse
from diecut_report.mechanism.chapters import taken
from diecut_report.mechanism.checks import Refusal
from diecut_report.mechanism.mechanism import Machines, Mechanism, of_machine
from diecut_report.mechanism.part_steps import Interpolated, Neighbour, Part, Pick, Running, Total
from diecut_report.mechanism.steps import (
    SILENT,
    Abscissa,
    Accumulated,
    Breakpoints,
    Choice,
    Computed,
    Crossings,
    Derivative,
    Prepared,
    Reduction,
    Step,
    Value,
    named,
)
from diecut_report.quantities.formatting import told
from diecut_report.quantities.units import unit
from diecut_report.standards.tables import StandardSeries
from diecut_report.text.phrases import Counted, Phrase, phrase

NEUTRAL = {"sum": 0.0, "product": 1.0, "min": np.inf, "max": -np.inf}
REDUCE: dict[str, Any] = {"sum": np.sum, "product": np.prod, "min": np.min, "max": np.max}
SAME = 1e-12  # relative difference within which a quantity is the standard value


def total(calc: Calculation, step: Total) -> None:
    """Calculate the sum, product, least or greatest over the parts that count."""
    parts = calc[step.of]
    if step.among:
        parts = np.where(calc[step.among] > 0, parts, NEUTRAL[step.operation])
    calc.values[step.id] = REDUCE[step.operation](parts, axis=1, keepdims=True)


def neighbour(calc: Calculation, step: Neighbour) -> None:
    """Take the value of the next part, or of the one before, around the loop."""
    calc.values[step.id] = np.roll(calc[step.of], -step.shift, axis=1)


def running(calc: Calculation, step: Running) -> None:
    """Calculate the sum or product from the first part up to each."""
    cumulate: Any = np.cumsum if step.operation == "sum" else np.cumprod
    calc.values[step.id] = cumulate(calc[step.of], axis=1)


def part(calc: Calculation, step: Part) -> None:
    """Take the value of one part; a machine whose list is shorter is impossible."""
    count = calc[step.of].shape[1]
    if not -count <= step.index < count:
        which = (
            Phrase("part {number}", number=step.index + 1)
            if step.index >= 0
            else Phrase("part {number} from the last", number=-step.index)
        )
        words = Phrase(
            "has {count}, but {description} ({id}) takes {which}; add what is missing",
            count=Counted(count, "{n} entry", "{n} entries"),
            description=step.description,
            id=step.id,
            which=which,
        )
        raise Impossible([(calc.axis[step.of], words)])
    calc.values[step.id] = calc[step.of][:, [step.index]]


def series_of(calc: Calculation, step: Pick) -> tuple[tuple[float, ...], str, StandardSeries | None]:
    """Return the standard values that a step takes from, ascending; their unit; and the standard series, if it is one."""
    series = step.series[str(calc.inputs[step.by])] if isinstance(step.series, Mapping) else step.series
    if isinstance(series, StandardSeries):
        return series.values, series.unit, series
    return tuple(sorted(series)), step.unit, None


def pick(calc: Calculation, step: Pick) -> None:
    """Take the standard value; beyond the ends of the series its last one, or no machine."""
    given = given_of(calc, step)
    if given is not None:
        calc.values[step.id] = given
        return
    values, display, _ = series_of(calc, step)
    series: Array = np.asarray(values) * unit(display).factor
    sought = calc[step.of]
    if step.beyond == "impossible":
        _within(calc, step, sought, series)
    above = np.clip(np.searchsorted(series, sought * (1 - SAME)), 0, len(series) - 1)
    below = np.clip(np.searchsorted(series, sought * (1 + SAME), side="right") - 1, 0, len(series) - 1)
    nearer = np.where(sought - series[below] <= series[above] - sought, below, above)
    calc.branch[step.id] = {"above": above, "below": below, "nearest": nearer}[step.rule]
    calc.values[step.id] = series[calc.branch[step.id]]


def _within(calc: Calculation, step: Pick, sought: Array, series: Array) -> None:
    """Refuse a machine for which the series has no value by the rule: what is sought lies beyond its end; mark such variants."""
    over = sought > series[-1] * (1 + SAME) if step.rule != "below" else np.zeros_like(sought, dtype=bool)
    under = sought < series[0] * (1 - SAME) if step.rule != "above" else np.zeros_like(sought, dtype=bool)
    for variant in np.flatnonzero((over | under).any(axis=1)):
        part = int(np.argmax(over[variant] | under[variant]))
        end = (
            Phrase("the greatest value is {value}", value=told(series[-1], step.unit))
            if over[variant, part]
            else Phrase("the least value is {value}", value=told(series[0], step.unit))
        )
        title = getattr(series_of(calc, step)[2], "title", phrase("the series"))
        words = Phrase(
            "{description} ({id}): {sought} is beyond {title}, of which {end}",
            description=step.description,
            id=step.id,
            sought=_sought(calc, step, float(sought[variant, part])),
            title=title,
            end=end,
        )
        key = step.key or step.of.removeprefix("inputs.")
        if calc.count == 1:
            raise Impossible([(key if step.key or key in calc.inputs else "", words)])
        calc.flaws.setdefault(int(variant), (step.key or step.id, words))


def _sought(calc: Calculation, step: Pick, value: float) -> str:
    """Return what a step picks by, with its symbol and value."""
    declared = calc.step_or_input(step.of)
    return f"{declared.description}, {declared.symbol} = {told(value, declared.unit)},"


# Plain code that knows one machine, run for each of many: what it refuses is marked, what others refused is not asked of it.


def prepared(calc: Calculation, step: Prepared, known: Mapping[str, Any]) -> Machines:
    """Make an object of each machine, of a mapping of its values."""
    _without_broken(calc, known)

    def make(row: int) -> Any:
        return step.function({name: of_machine(value, row, calc.count) for name, value in known.items()})

    return Machines(_each(calc, make))


def computed(calc: Calculation, step: Computed, taken: Sequence[Any]) -> Array:
    """Return what a function gives for each machine, as rows; NaN for one that cannot be."""

    def make(row: int) -> Any:
        return np.ravel(step.function(*(of_machine(value, row, calc.count) for value in taken)))

    rows = _each(calc, make)
    width = max((len(row) for row in rows if row is not None), default=1)
    return np.stack([np.full(width, np.nan) if row is None else row for row in rows])


def _each(calc: Calculation, make: Callable[[int], Any]) -> list[Any]:
    """What is made of each machine, None of one that cannot be."""
    found: list[Any] = [None] * calc.count
    for row in np.flatnonzero(possible(calc)):
        try:
            found[row] = make(int(row))
        except Refusal as refused:
            refuse(calc, int(row), refused.key, refused.words)
    return found


def _without_broken(calc: Calculation, known: Mapping[str, Any]) -> None:
    """Mark the machines of which another mechanism cannot be."""
    for key, value in known.items():
        for each in value if isinstance(value, tuple) else (value,):
            if isinstance(each, MechanismHandle):
                for row in each.calculation.flaws:
                    refuse(calc, row, key, Phrase("is {name}, which cannot be", name=each.name))


# What coming steps will ask of the curves over an abscissa: it is computed together, as it shares most of its terms.


Asking = Reduction | Crossings | Accumulated | Derivative
SIGNS = {"max": (1.0,), "min": (-1.0,), "abs_max": (1.0, -1.0), "range": (1.0, -1.0)}


def look(calc: Calculation, first: Asking, steps: Sequence[Step]) -> None:
    """Note, before the first of these steps, the curves that it and the coming ones ask for, and search their extremes together."""
    axis = calc.axis[first.of]
    if first.of not in calc.ahead.get(axis, ()) or isinstance(first, Crossings):
        coming = [step for step in _computable(calc, steps, axis) if isinstance(step, Asking)]
        calc.ahead[axis] = tuple(dict.fromkeys(step.of for step in coming))
    if isinstance(first, Reduction) and first.operation in SIGNS:
        _search(calc, first, steps, axis)


def _search(calc: Calculation, first: Reduction, steps: Sequence[Step], axis: str) -> None:
    """Search the extremes of the coming reductions, up to where the abscissa is cut further: one search costs hardly less than many."""
    edges = calc.domains[axis].edges
    if all(calc.extremes.get((first.of, sign), (None,))[0] is edges for sign in SIGNS[first.operation]):
        return
    uncut = takewhile(lambda step: not _cuts(calc, step, axis), _computable(calc, steps, axis))
    extremes.search(
        calc,
        [
            (step.of, sign)
            for step in uncut
            if isinstance(step, Reduction) and step.operation in SIGNS
            for sign in SIGNS[step.operation]
        ],
    )


def _cuts(calc: Calculation, step: Step, axis: str) -> bool:
    """Whether a step cuts an abscissa into finer pieces; a value between the rows of a table has its corners there."""
    return getattr(step, "abscissa", "") == axis or (isinstance(step, Interpolated) and calc.axis.get(step.id) == axis)


def _computable(calc: Calculation, steps: Sequence[Step], axis: str) -> Iterator[Step]:
    """The coming steps that cut an abscissa, and those that ask for curves over it which need nothing that is not known yet.

    Among variants, numbers that are known already by their formulas are computed at once.
    """
    known = {axis, *calc.inputs, *calc.values, *calc.curves, *(f"inputs.{name}" for name in calc.inputs)}
    for step in steps:
        if _cuts(calc, step, axis):
            yield step
        elif isinstance(step, Value | Choice) and calc.axis.get(step.id) == axis and taken(step) <= known:
            known.add(step.id)
            calc.curves[step.id] = step
        elif isinstance(step, Asking) and step.of in known and calc.axis[step.of] == axis:
            yield step
        elif step.id not in calc.values and not _known_early(calc, step, known):
            known.discard(step.id)  # where an input has the same id, it is not what is meant from here on


def _known_early(calc: Calculation, step: Step, known: set[str]) -> bool:
    is_number = isinstance(step, Value) and calc.count > 1 and step.id not in calc.axis and not step.numbered
    if not is_number or not taken(step) <= known:
        return False
    assert isinstance(step, Value)
    calc.values[step.id] = calc.existing(step, calc.apply(step.formula))
    known.add(step.id)
    return True


# Which steps of a mechanism quantities need.


def needed(mechanism: Mechanism, given: frozenset[str], names: Iterable[str]) -> set[str]:
    """Return the ids of the steps that quantities need, and of what must hold for them."""
    known = _asking(mechanism, given)
    found: set[str] = set()
    pending = [giver_of(name, known.own) for name in names]
    while pending:
        giver = pending.pop()
        if giver and giver not in found:
            found.add(giver)
            pending += known.asks[giver]
    return found | {id for id, asked in known.silent if asked <= found}


class _Asking(NamedTuple):
    """Hold the steps of a mechanism by id, which steps each asks for, and those that give nothing, with what they ask for."""

    own: Mapping[str, Step]
    asks: Mapping[str, frozenset[str]]
    silent: Sequence[tuple[str, frozenset[str]]]


@lru_cache(maxsize=256)
def _asking(mechanism: Mechanism, given: frozenset[str]) -> _Asking:
    steps = [step for _, step in mechanism.active(given)]
    own = {step.id: step for step in steps}
    giver = cache(partial(giver_of, own=own))

    def givers(names: Iterable[str]) -> frozenset[str]:
        return frozenset(filter(None, map(giver, names)))

    asks = {}
    for id, step in own.items():
        asked = _asked(step) - {getattr(step, "shown_at", "")}  # where formulas are shown matters in print only
        asks[id] = givers([*asked, *_of_abscissa(steps, step)])
    silent = [(s.id, givers(_asked(s))) for s in steps if isinstance(s, SILENT) and not isinstance(s, Breakpoints)]
    return _Asking(own, asks, silent)


def _asked(step: Step) -> frozenset[str]:
    """Return the ids that a step takes, with those that plain code takes where they are there."""
    return taken(step) | frozenset(step.holds) if isinstance(step, Prepared) else taken(step)


def _of_abscissa(steps: Sequence[Step], step: Step) -> list[str]:
    """What cuts an abscissa into its pieces."""
    if not isinstance(step, Abscissa):
        return []
    return [s.id for s in steps if getattr(s, "abscissa", "") == step.id]


def giver_of(name: str, own: Mapping[str, Step]) -> str:
    """Return the id of the step of this id, or that gives this name; nothing where none does."""
    if name in own:
        return name
    found = named(name, own)
    return found.id if found else _of_named_part(name, own)


def _of_named_part(name: str, own: Mapping[str, Step]) -> str:
    """Return the id of the row that gives a part by the part's own name, ``NAME_ID``; nothing where none does."""
    rows = (id for id, step in own.items() if getattr(step, "named_by", "") and name.endswith(f"_{id}"))
    return max(rows, key=len, default="")
