"""The state of one calculation: numbers, curves and their pieces, for one machine or an array of variants."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from copy import copy
from dataclasses import dataclass, field, replace
from functools import cached_property
from math import isfinite
from typing import Any, NamedTuple, Self, cast
from weakref import WeakKeyDictionary, proxy

import numpy as np

from diecut_report.errors import nearest
from diecut_report.formulas import Array
from diecut_report.machine.numerics.curves import MANY, Curves, CurveSampler, several
from diecut_report.machine.numerics.domain import Domain, Inside, PieceSeries, RecentPlaces, SharedPlaces
from diecut_report.machine.numerics.samples import SampleCache
from diecut_report.mechanism.chapters import in_form, taken
from diecut_report.mechanism.checks import Check
from diecut_report.mechanism.curve_inputs import InOtherUnit, TakenWhole
from diecut_report.mechanism.inputs import Extremes, Meta, Quantity, fields, texts_given
from diecut_report.mechanism.mechanism import Machines, Mechanism
from diecut_report.mechanism.names import Misdeclared, Written, formula_of
from diecut_report.mechanism.steps import Abscissa, FromCurve, ResultName, Step, named, names_ahead, numbered_symbol
from diecut_report.mechanism.steps.protocols import Impossible as Impossible
from diecut_report.mechanism.steps.protocols import ImpossibleTogether as ImpossibleTogether
from diecut_report.quantities.formatting import easy_unit
from diecut_report.quantities.units import unit
from diecut_report.text.phrases import Phrase

# Inputs as the engine holds them: those of repeated parts, and single ones.


def row(value: tuple[Any, ...], variants: int) -> Any:
    """Return the inputs of repeated parts as an array (variants, parts); as they are where some part has no number."""
    if not all(isinstance(v, int | float | np.ndarray | np.number) and not isinstance(v, bool) for v in value):
        return value  # texts, curves, what some parts leave out
    return np.stack([np.broadcast_to(np.asarray(v, dtype=float), (variants,)) for v in value], axis=1)


def alone(value: Any, variants: int) -> Any:
    """Return a single input as an array (variants, 1), of which only extremes are known as these."""
    return value if isinstance(value, Extremes) else np.full((variants, 1), value, dtype=float)


def column(value: Any, variants: int) -> Any:
    """Return an input as an array (variants, 1) or (variants, parts); texts, flags, curves and whole mechanisms stay as they are."""
    match value:
        case bool() | str():
            return value
        case tuple():
            return row(value, variants)
        case np.ndarray():
            return np.ascontiguousarray(value, dtype=float).reshape(variants, -1)
        case int() | float() | np.number():
            return alone(value, variants)
    return value


# The units that a report chose for its quantities.


@dataclass(frozen=True)
class ChosenUnits:
    """Hold the units that a report chose: for all quantities of an SI unit (``m``), and for single quantities by their ids."""

    by_si: Mapping[str, str] = field(default_factory=dict)
    by_id: Mapping[str, str] = field(default_factory=dict)

    def of(self, name: str, declared: str) -> str | None:
        """Return the unit chosen for a quantity that is declared in a unit; None where none is."""
        return self.by_id.get(name) or self.by_si.get(unit(declared).si)


NONE_CHOSEN = ChosenUnits()


# The unit in which a quantity is shown: the one that the report chose for it, else one in which its values are easy to read.


FEW = 20  # values up to which they are looked through one by one


def declared_unit(calc: Calculation, name: str, declared: str) -> str:
    """Return the chosen unit of a quantity, else the declared one."""
    return calc.chosen_units.of(name, declared) or declared


def unit_for(calc: Calculation, name: str, declared: str, values: Array | Iterable[float]) -> str:
    """Return the one unit in which values of a quantity are shown: the greatest of them is easy to read."""
    if chosen := calc.chosen_units.of(name, declared):
        return chosen
    if isinstance(values, np.ndarray) and values.size > FEW:
        sizes = np.abs(values.astype(float)).ravel()
        sizes = sizes[np.isfinite(sizes)]
        return easy_unit(float(sizes.max()), declared) if len(sizes) else declared
    few = np.ravel(values).tolist() if isinstance(values, np.ndarray) else map(float, values)
    return easy_unit(max(known), declared) if (known := [abs(size) for size in few if isfinite(size)]) else declared


def axis_unit(declared: str, heights: Iterable[float]) -> str:
    """Return the unit of what a diagram shows: of forces that in which the greatest of them is told, of anything else the declared one."""
    known = [abs(height) for height in heights if isfinite(height)] if unit(declared).si == "N" else []
    return easy_unit(max(known), declared) if known else declared


def number_unit(calc: Calculation, name: str, declared: Step | Quantity, value: float) -> str:
    """Return the unit of a number inside of a formula: what is typed stands as it was typed."""
    is_typed = name not in calc.values and name not in calc.curves
    return declared_unit(calc, name, declared.unit) if is_typed else unit_for(calc, name, declared.unit, [value])


# What declares a quantity of a calculation: the step that gives it, or the input; of one crossing or part and their number what follows from it.


class NamedQuantities:
    """Remember what the names of a calculation's quantities mean, as long as its steps are the same."""

    def __init__(self) -> None:
        self._steps: Mapping[str, Step] = {}
        self._numbered: tuple[Step, ...] = ()
        self._names: dict[str, ResultName | None] = {}
        self._declared: dict[str, Step | Quantity] = {}

    def result(self, name: str, steps: Mapping[str, Step]) -> ResultName | None:
        """Return which step gives a name, and what it is of it; None where none does."""
        if steps is not self._steps:
            self._steps, self._numbered = steps, tuple(step for step in steps.values() if step.numbered)
            self._names, self._declared = {}, {}
        if name not in self._names:
            self._names[name] = named(name, steps, self._numbered)
        return self._names[name]

    def declared(self, name: str, calc: Calculation) -> Step | Quantity:
        """Return the step or input with a quantity's symbol, unit and description; Misdeclared where there is nothing of this name."""
        if name in calc.steps:
            return calc.steps[name]
        found = self.result(name, calc.steps)
        if name not in self._declared:
            self._declared[name] = _of_input(name, calc) if found is None else _of_step(found, calc.steps, calc.axis)
        return self._declared[name]


def _of_input(name: str, calc: Calculation) -> Quantity:
    path, inputs = name.removeprefix("inputs."), calc.meta
    if path not in inputs:
        given = [each.name for step in calc.steps.values() for each in names_ahead(step)]
        near = nearest(path, [*given, *inputs])
        template = "{name} is not a quantity of this machine{near}; name a step or an input"
        raise Misdeclared(Phrase(template, name=repr(name), near=near), calc.mechanism.at)
    return cast(Quantity, inputs[path])


def _of_step(found: ResultName, steps: Mapping[str, Step], axis: Mapping[str, str]) -> Step:
    step = steps[found.id]
    match found.role:
        case "place":
            return steps[axis[step.asked_curve]]
        case "count":
            many = Phrase("{description}: how many", description=step.description)
            symbol = f"n_{step.symbol.replace('_', ',')}"
            return replace(step, id=found.name, symbol=symbol, unit="1", units=(), description=many)
        case "crossing" | "part":
            return replace(step, id=found.name, symbol=numbered_symbol(step, found.number))
    return step


Found = tuple[
    Array, Array, Array
]  # of an extreme: value, place, middle of its smooth piece; each of shape (variants, 1)


class Unproven(Exception):
    """Report that a result did not meet the equation or check that proves it; nothing is printed then. ``at`` is where it is declared."""

    def __init__(self, words: str, at: str = "") -> None:
        super().__init__(words)
        self.at = at


@dataclass(frozen=True)
class CurveHandle:
    """Hand a curve of one mechanism to the input of another: function, breakpoints and period travel together.

    ``rows`` says for each machine which variant of the calculation it is, where they are not one by one the same.
    """

    calculation: Calculation
    curve_id: str
    rows: Array | None = field(default=None, compare=False)

    @cached_property
    def domain(self) -> Domain:
        """Return the abscissa that the curve runs over."""
        return self._own_domain if self.rows is None else self._own_domain.of_rows(self.rows)

    @property
    def _own_domain(self) -> Domain:
        return self.calculation.domains[self.calculation.axis[self.curve_id]]

    def of_rows(self, rows: Array) -> CurveHandle:
        """Return the curve of machines each of which is one of these; that of a single machine is the same for all."""
        if self.calculation.count == 1:
            return self
        return replace(self, rows=rows if self.rows is None else self.rows[rows])

    def of_machine(self, row: int) -> CurveHandle:
        """Return the curve of one of the machines."""
        return self.of_rows(np.array([row]))

    @property
    def abscissa(self) -> Step:
        """Return what the curve runs over, as it is declared."""
        return self.calculation.steps[self.calculation.axis[self.curve_id]]

    @property
    def cycle(self) -> str:
        return self.abscissa.id

    def is_in(self, unit_text: str) -> bool:
        return unit(self.calculation.curves[self.curve_id].unit).kind == unit(unit_text).kind

    @property
    def rate(self) -> Array:
        found = cycle_rate(self.calculation, self.cycle)
        return found if self.rows is None else found[self.rows]

    @property
    def turns(self) -> Array:
        period = self.domain.period
        return period / (2 * np.pi) if unit(self.abscissa.unit).si == "rad" else np.ones_like(period)

    def values(self, share: Array, middle: Array, rows: Array | None) -> Array:
        calc, domain, axis = self.calculation, self._own_domain, self.calculation.axis[self.curve_id]
        if self.rows is not None:
            rows = np.broadcast_to(self.rows if rows is None else self.rows[rows], len(share))
        places = share, middle, rows
        if calc.count == 1:
            x, mid, inside = domain.placed(*places)
            return calc.sampler_of(axis, x, mid, None, inside).over(self.curve_id)

        def evaluate(names: Sequence[str]) -> Sequence[Array]:
            return several(calc, axis, names, *domain.placed(*places), rows)

        return calc.shared.at(self.curve_id, axis, places, evaluate)

    def gain(self, rows: Array | None) -> Array:
        """Return what the curve has more at the end of its period than at its start, shape (rows, 1); rows as in ``values``."""
        shares = np.tile([0.0, 1.0], (len(self.domain.edges), 1))
        ends = self.values(shares, shares, None)
        found: Array = ends[:, 1:] - ends[:, :1]
        return found if rows is None or len(found) == 1 else found[rows]

    @property
    def breakpoints(self) -> Array:
        return self.domain.edges[:, 1:-1] / self.domain.period

    @property
    def joints(self) -> Array:
        return self.domain.joints[:, 1:-1] / self.domain.period


@dataclass(frozen=True)
class TakenOfMachines(TakenWhole):
    """Be something of a calculated mechanism that an input of another one takes whole."""

    calculation: Calculation


def of_rows(value: Any, rows: Array, count: int) -> Any:
    """Return what an input or a result of so many variants is of machines each of which is one of them."""
    match value:
        case np.ndarray() if value.shape[:1] == (count,):
            return value[rows]
        case Machines():
            return Machines(value[row] for row in rows)
        case tuple():
            return tuple(of_rows(part, rows, count) for part in value)
        case Extremes(low=low, high=high):
            return replace(value, low=of_rows(low, rows, count), high=of_rows(high, rows, count))
        case InOtherUnit(value=own):
            return replace(value, value=of_rows(own, rows, count))
        case CurveHandle():
            return value.of_rows(rows)
        case TakenOfMachines(calculation=calc) if calc.count > 1:
            return replace(value, calculation=calc.of_rows(rows))
    return value


def cycle_rate(calc: Calculation, axis: str) -> Array:
    """Return how often an abscissa is run through, as ``CurveHandle.rate``: by its speed, or that of a curve laid over the whole of it."""
    declared = calc.steps[axis]
    assert isinstance(declared, Abscissa)
    if declared.speed:
        found = 2 * np.pi * calc[declared.speed] / calc.domains[axis].period
    else:
        laid = (each for each in calc.curves.values() if isinstance(each, FromCurve) and each.abscissa == axis)
        rates = (calc.inputs[each.given].rate for each in laid if not each.lasts)
        found = next((rate for rate in rates if rate.all()), np.zeros((1, 1)))
    return np.broadcast_to(found, (calc.count, 1))


class Side(NamedTuple):
    """Hold what a check on a curve compares, each of shape (variants, 1), SI: where on the abscissa it is furthest beyond."""

    demand: Array
    limit: Array
    axis: str
    place: Array


class Calculation:
    """Hold all that is known of a mechanism's machines; filled by ``engine.run``."""

    def __init__(self, mechanism: Mechanism, inputs: Mapping[str, Any], variants: int) -> None:
        self.mechanism = mechanism
        self.count = variants
        self.is_partial = False  # whether only some steps are run: messages may lack their numbers
        self.given = frozenset(inputs) | texts_given(inputs) | mechanism.facts
        self.meta: dict[str, Meta] = dict(fields(in_form(mechanism.inputs, self.given)))
        self.inputs: dict[str, Any] = {name: column(value, variants) for name, value in inputs.items()}
        self.steps: dict[str, Step] = mechanism.steps_by_id(self.given)
        self.axis = mechanism.axes(self.given)
        self.names, self.values = NamedQuantities(), dict[str, Array]()
        self.curves, self.domains = dict[str, Step](), dict[str, Domain]()
        self.part_names: dict[str, tuple[str, ...]] = {}  # of the repeated parts that follow from the inputs
        self.row_of: dict[str, str] = {}  # for each number that is called by the name of its part, the row
        self.series, self.branch = dict[str, PieceSeries](), dict[str, Array]()  # the latter: for each choice its case
        self.middle: dict[str, Array] = {}  # for each place of an extreme, the middle of its smooth piece
        self.proof: dict[str, float] = {}  # for each result that is not a closed formula, its greatest residual
        self._kept: dict[tuple[str, str], tuple[Array, CurveSampler]] = {}  # curves already known at often used places
        self.ahead: dict[str, tuple[str, ...]] = {}  # for each abscissa the curves that coming steps ask for
        self.searches: dict[str, Any] = {}  # for each abscissa, of jumps in its pieces (switches)
        self.recent, self.shared = RecentPlaces[CurveSampler](32), SharedPlaces()  # of a single machine; of many
        self._tables: dict[str, SampleCache] = {}
        self.extremes: dict[tuple[str, float], tuple[Array, Found]] = {}  # with the pieces they are of
        self.judged: dict[tuple[str, int], Side] = {}  # for each check on a curve and its sides, where it governs
        self.flaws: dict[int, tuple[str, str]] = {}  # for each impossible variant the key and the message
        # keys of inputs that checks ask a basis of and that have none, each with the machines of which that is so: True, or (variants,)
        self.unfounded: Mapping[tuple[str | int, ...], Any] = {}
        self.further_checks: tuple[Check, ...] = ()  # beside those of its mechanism
        # for each failing check what was found and advised, before the whole machine is asked
        self.advised: dict[str, Any] = {}
        self.chosen_units = NONE_CHOSEN  # what a report chose to show quantities in
        self.withheld: dict[str, Array] = {}  # for each fact, which variants do not meet it
        # of machines that are some of another calculation's variants: that one, by which its curves go on, and which variant each is
        self.made_of: tuple[Calculation, Array] | None = None

    def __getitem__(self, name: str) -> Array:
        """A number of all variants, shape (variants, 1) or (variants, parts)."""
        return self.values[name] if name in self.values else self.inputs[name.removeprefix("inputs.")]

    def part_count(self, over: str) -> int | None:
        """Return how many parts a list of the inputs has, or declared parts; None of a list that is not given."""
        if over in self.part_names:
            return len(self.part_names[over])
        rows = (value for name, value in self.inputs.items() if name.startswith(f"{over}."))
        return next((each.shape[1] if isinstance(each, np.ndarray) else len(each) for each in rows), None)

    def of_rows(self, rows: Array) -> Self:
        """Return the calculation of machines each of which is one of these variants; its curves stay those of the variants."""
        found, count = copy(self), len(rows)
        found.count, found.made_of = (
            count,
            (self, rows) if self.made_of is None else (self.made_of[0], self.made_of[1][rows]),
        )
        found.inputs = {name: of_rows(value, rows, self.count) for name, value in self.inputs.items()}
        found.values = {name: of_rows(value, rows, self.count) for name, value in self.values.items()}
        found.domains = {name: domain.of_rows(rows) for name, domain in self.domains.items()}
        found.judged = {
            name: Side(*(of_rows(part, rows, self.count) for part in side)) for name, side in self.judged.items()
        }
        found.withheld = {name: missed[rows] for name, missed in self.withheld.items()}
        found.flaws = {row: self.flaws[int(own)] for row, own in enumerate(rows) if int(own) in self.flaws}
        found._kept, found._tables, found.searches, found.extremes = {}, {}, {}, {}
        found.recent, found.shared = RecentPlaces[CurveSampler](32), SharedPlaces()
        return found

    def handle(self, curve: str) -> CurveHandle:
        """Return a curve as the input of another mechanism takes it."""
        calc, rows = self.made_of or (self, None)
        return CurveHandle(calc, curve, rows)

    @property
    def possible(self) -> Array:
        """Which variants are possible, as far as is known."""
        found = np.ones(self.count, dtype=bool)
        found[list(self.flaws)] = False
        return found

    def apply(self, part: Written) -> Array:
        """Return what a formula of numbers (or rows over repeated parts) gives, for all variants."""
        formula = formula_of(part)
        result: Array = formula.function(*map(self.__getitem__, formula.parameters))
        if np.ndim(result) == 2 and len(result) == self.count:
            return result
        return np.broadcast_to(result, (self.count, *np.shape(result)[1:]) if np.ndim(result) == 2 else (self.count, 1))

    def existing(self, step: Step, values: Array) -> Array:
        """Return a quantity's numbers, NaN for the machines that do not have it."""
        return values if step.exists is None else np.where(self.apply(step.exists), values, np.nan)

    def sample(self, curve: str, x: Array, middle: Array, rows: Array | None = None) -> Array:
        """Return a curve at x (rows, points), each x being in the smooth piece whose middle is given; rows are variants (default all)."""
        if self.count >= MANY and rows is not None and middle.shape == (len(x), 1):
            return Curves(self, self.axis[curve], [curve], middle[:, 0], rows).at(x)[0]
        return CurveSampler(self, self.axis[curve], x, middle, rows).over(curve)

    def sampler_of(
        self, axis: str, x: Array, middle: Array, rows: Array | None, inside: Inside | None = None
    ) -> CurveSampler:
        """Return all curves over an abscissa at x (rows, points), in pieces of these middles (rows, points) or (rows, 1)."""
        if self.count > 1:
            return CurveSampler(self, axis, x, middle, rows, inside)
        places = x, middle, None
        return self.recent.at(axis, places, lambda: CurveSampler(proxy(self), axis, x, middle, None, inside))

    def kept(
        self, use: str, axis: str, places: Callable[[Domain], tuple[Array, Array]], rows: Array | None = None
    ) -> CurveSampler:
        """Return a sampler that is used again (for the search grid, the samples, the shown place) until the pieces change."""
        domain = self.domains[axis]
        edges, sampler = self._kept.get((use, axis), (None, None))
        if sampler is None or edges is not domain.edges:
            sampler = CurveSampler(proxy(self), axis, *places(domain), rows)
            self._kept[use, axis] = domain.edges, sampler
        return sampler

    def of_pieces(self, axis: str) -> CurveSampler:
        """Return all curves over an abscissa at the middles of its pieces."""
        return self.kept("middles", axis, lambda domain: (domain.middles, domain.middles))

    def curve_samples(self, curve: str) -> Array:
        """Return a curve at the samples of its abscissa, shape (variants, points)."""
        if self.made_of:
            calc, rows = self.made_of
            return calc.curve_samples(curve)[rows]
        axis = self.axis[curve]
        sampler = self.kept("samples", axis, lambda domain: (domain.samples, domain.middle_of(domain.samples)))
        with np.errstate(all="ignore"):  # among variants some may be impossible
            return np.broadcast_to(sampler[curve], sampler.x.shape)

    def table(self, axis: str) -> SampleCache:
        """Return what is known of the curves over an abscissa, piece by piece."""
        if axis not in self._tables:
            self._tables[axis] = SampleCache(self, axis)
        return self._tables[axis]

    def release(self) -> None:
        """Forget the curves at all places: they hold this calculation, and no reference count would ever free them."""
        if self.made_of:
            self.made_of[0].release()
        self._tables.clear()
        self.searches.clear()
        self._kept.clear()
        self.recent.forget()
        self.shared.forget()

    def on_search_grid(self, curve: str) -> Array:
        """Return a curve on the search grid of its smooth pieces, shape (variants, pieces, points); zero in pieces without a width."""
        table = self.table(self.axis[curve])
        return table.pieces().spread(table.on_grid([curve])[0])

    def step_or_input(self, name: str) -> Step | Quantity:
        """Return what declares a quantity: its symbol, unit and description."""
        return self.names.declared(self.row_of.get(name, name), self)


# Whether a curve of a mechanism that was calculated twice is the same to the last bit: all that it follows from is then.


DOMAIN = ("period", "samples", "edges", "joints")


def same_curve(one: CurveHandle, other: CurveHandle) -> bool:
    """Return whether two curves give the same values everywhere, to the last bit; False also where that cannot be told."""
    if one.curve_id != other.curve_id:
        return False
    if one.calculation is other.calculation:
        return True
    pairs = _KNOWN.setdefault(one.calculation, WeakKeyDictionary())
    if other.calculation not in pairs:
        pairs[other.calculation] = {}
    return _Pair(one.calculation, other.calculation, pairs[other.calculation]).holds(one.curve_id)


_KNOWN: WeakKeyDictionary[Calculation, WeakKeyDictionary[Calculation, dict[str, bool]]] = WeakKeyDictionary()
"""Of two calculations which quantities are the same, as several mechanisms take curves of one."""


class _Pair:
    """Hold two calculations of one mechanism, of one machine each."""

    def __init__(self, one: Calculation, other: Calculation, known: dict[str, bool]) -> None:
        self.one, self.other, self.known = one, other, known

    def holds(self, name: str) -> bool:
        """Return whether a quantity is the same in both."""
        if name not in self.known:
            self.known[name] = self._compared(name)
        return self.known[name]

    def _compared(self, name: str) -> bool:
        one, other = self.one, self.other
        if name in one.domains:
            return one.steps[name] is other.steps.get(name) and self._domain(name)
        if name not in one.curves:
            return self.is_given(name)
        if one.curves[name] is not other.curves.get(name) or not self.holds(one.axis[name]):
            return False
        return one.curves[name].is_same(self)

    def holds_all(self, step: Step) -> bool:
        """Return whether all that a step takes is the same in both."""
        return all(map(self.holds, taken(step)))

    def same_series(self, name: str) -> bool:
        """Return whether the series of a curve are the same in both."""
        series = self.one.series[name], self.other.series[name]
        return all(_same(*(getattr(each, part) for each in series)) for part in ("edges", "series"))

    def _domain(self, name: str) -> bool:
        one, other = self.one.domains[name], self.other.domains[name]
        is_alike = one.intervals == other.intervals and all(_same(getattr(one, n), getattr(other, n)) for n in DOMAIN)
        return is_alike and _same(cycle_rate(self.one, name), cycle_rate(self.other, name))

    def is_given(self, name: str) -> bool:
        """Return whether a number, or what was given, is the same."""
        try:
            one, other = self.one[name], self.other[name]
        except KeyError:
            return False
        return _same(one, other)


def _same(one: Any, other: Any) -> bool:
    if isinstance(one, CurveHandle) and isinstance(other, CurveHandle):
        return same_curve(one, other)
    if not isinstance(one, np.ndarray) or not isinstance(other, np.ndarray) or one.dtype == object:
        return one is other
    return (one.dtype, one.shape, one.tobytes()) == (other.dtype, other.shape, other.tobytes())
