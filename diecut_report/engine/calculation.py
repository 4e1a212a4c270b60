"""The state of one calculation: numbers, curves and their pieces, for one machine or an array of variants."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple
from weakref import proxy

import numpy as np

from diecut_report.contract.binding import Binding, bound
from diecut_report.contract.inputs import Meta, Quantity, fields, texts_given
from diecut_report.contract.mechanism import Mechanism
from diecut_report.contract.steps import Step
from diecut_report.contract.unit_variants import in_form
from diecut_report.engine.chosen_units import NONE_CHOSEN
from diecut_report.engine.curve_sampler import CurveSampler, CurveStep
from diecut_report.engine.input_rows import column
from diecut_report.engine.named_quantity import NamedQuantities
from diecut_report.engine.numerics.chebyshev import PieceSeries
from diecut_report.engine.numerics.curve_evaluation import MANY, Curves, several
from diecut_report.engine.numerics.domain import Domain, Inside
from diecut_report.engine.numerics.recent_places import RecentPlaces
from diecut_report.engine.numerics.sample_cache import SampleCache
from diecut_report.engine.numerics.shared_places import SharedPlaces
from diecut_report.engine.sampled_curve import SampledCurve
from diecut_report.expressions import Array

Found = tuple[Array, Array, Array]  # of an extreme: value, place, middle of its piece


class Impossible(Exception):
    """Report that the machine cannot exist: the keys to change, each with the reason in words."""

    def __init__(self, reasons: Sequence[tuple[str, str]]) -> None:
        super().__init__("; ".join(message for _, message in reasons))
        self.reasons = tuple(reasons)
        self.key, self.message = self.reasons[0]


class ImpossibleTogether(Impossible):
    """Report that plain code refuses many machines at once, which does not say whether each of them cannot exist."""


class Unproven(Exception):
    """Report that a result did not meet the equation or check that proves it; nothing is printed then. ``at`` is where it is declared."""

    def __init__(self, words: str, at: str = "") -> None:
        super().__init__(words)
        self.at = at


@dataclass(frozen=True)
class CurveHandle:
    """Hand a curve of one mechanism to the input of another: function, breakpoints and period travel together."""

    calculation: Calculation
    curve_id: str

    @property
    def domain(self) -> Domain:
        """Return the abscissa that the curve runs over."""
        return self.calculation.domains[self.calculation.axis[self.curve_id]]

    @property
    def abscissa(self) -> Step:
        """Return what the curve runs over, as it is declared."""
        return self.calculation.steps[self.calculation.axis[self.curve_id]]

    @property
    def cycle(self) -> str:
        """Return the id of what the curve runs over: of two curves over one cycle it is the same."""
        return self.abscissa.id

    def values(self, share: Array, middle: Array, rows: Array | None) -> Array:
        """Return values at shares of the period, shape (rows, points), each in the smooth piece of its middle (a share too).

        ``rows`` are variants (default all).
        """
        calc, domain, axis = self.calculation, self.domain, self.calculation.axis[self.curve_id]
        if calc.count > 1:
            places = share, middle, rows
            return calc.shared.at(
                self.curve_id, axis, places, lambda names: several(calc, axis, names, *domain.placed(*places), rows)
            )
        x, mid, inside = domain.placed(share, middle, rows)
        return calc.sampler_of(axis, x, mid, None, inside).over(self.curve_id)

    def gain(self, rows: Array | None) -> Array:
        """Return what the curve has more at the end of its period than at its start, shape (rows, 1); rows as in ``values``."""
        shares = np.tile([0.0, 1.0], (len(self.domain.edges), 1))
        ends = self.values(shares, shares, None)
        found: Array = ends[:, 1:] - ends[:, :1]
        return found if rows is None or len(found) == 1 else found[rows]

    @property
    def breakpoints(self) -> Array:
        """Return the inner edges of the curve's smooth pieces, as shares of the period, shape (variants, places)."""
        return self.domain.edges[:, 1:-1] / self.domain.period

    @property
    def joints(self) -> Array:
        """Return those of them where the curve jumps or has a corner."""
        return self.domain.joints[:, 1:-1] / self.domain.period


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
        self.curves, self.domains = dict[str, CurveStep](), dict[str, Domain]()
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
        self.unfounded: frozenset[str] = frozenset()  # inputs that checks ask a basis of, and that have none
        self.chosen_units = NONE_CHOSEN  # what a report chose to show quantities in
        self.withheld: dict[str, Array] = {}  # for each fact, which variants do not meet it

    def __getitem__(self, name: str) -> Array:
        """A number of all variants, shape (variants, 1) or (variants, parts)."""
        found: Array = self.values[name] if name in self.values else self.inputs[name.removeprefix("inputs.")]
        return found

    def apply(self, part: Binding) -> Array:
        """Return what a formula of numbers (or rows over repeated parts) gives, for all variants."""
        link = bound(part)
        result: Array = link.formula.function(*[self[n] if isinstance(n, str) else n for n in link.takes])
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
        return self.sampler(curve, x, middle, rows).over(curve)

    def sampler(self, curve: str, x: Array, middle: Array, rows: Array | None = None) -> CurveSampler:
        """Return all curves over the abscissa of this one, at x as in ``sample``: a mapping from id to values."""
        return CurveSampler(self, self.axis[curve], x, middle, rows)

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
        sampler = self.kept(
            "samples", self.axis[curve], lambda domain: (domain.samples, domain.middle_of(domain.samples))
        )
        with np.errstate(all="ignore"):  # among variants some may be impossible
            return np.broadcast_to(sampler[curve], sampler.x.shape)

    def table(self, axis: str) -> SampleCache:
        """Return what is known of the curves over an abscissa, piece by piece."""
        if axis not in self._tables:
            self._tables[axis] = SampleCache(self, axis)
        return self._tables[axis]

    def release(self) -> None:
        """Forget the curves at all places: they hold this calculation, and no reference count would ever free them."""
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
        own = self.row_of.get(name, name)
        return self.names.declared(own, self.steps, self.axis, self.meta, self.mechanism.at)


__all__ = ["Calculation", "CurveHandle", "CurveSampler", "Impossible", "SampledCurve", "Side", "Unproven"]
