"""The charts of the summary with their captions and text alternatives."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from diecut_report.report.figures.style import Svg
from diecut_report.report.number_format import number
from diecut_report.study.analysis.stored_variants import Stored, StoredColumn
from diecut_report.study.summary import charts, data, point_charts
from diecut_report.study.summary.data import Histogram, SampledVariants, Spread
from diecut_report.study.summary.influence import Influence, Share
from diecut_report.study.summary.pareto import Front
from diecut_report.study.summary.point_charts import near
from diecut_report.study.summary.quantity_names import counted, named, percent, quantity
from diecut_report.study.summary.verdict_counts import Failure

DENSE = 5_000  # variants from which a chart counts them in cells
AXES, GOVERNING, LINES = 8, 15, 400  # upright axes, bars of governing checks, lines between the axes

PALE = "#e0a3a1"  # of failures that another check governs
FAR = "Values that lie far above the others stand at the edge."


class SummaryFigure(NamedTuple):
    """Hold a chart, what stands below it, and what it shows in words."""

    svg: Svg
    caption: str
    alternative: str


@dataclass(frozen=True)
class Figures:
    """Make the charts of a study."""

    stored: Stored
    states: dict[str, int]
    sample: SampledVariants
    front: Front | None
    main: list[StoredColumn]
    spreads: dict[str, Spread]

    def all(
        self, failures: Sequence[Failure], spreads: Sequence[Spread], ranked: Sequence[Influence]
    ) -> dict[str, SummaryFigure]:
        """Return every chart that the study has something for, by its key."""
        found = {
            "counts": self.counts(),
            "failures": self.failures(failures) if failures else None,
            "distributions": self.distributions(spreads) if spreads else None,
            "parallel": self.parallel(),
            "pair": self.pair(),
            "grid": self.grid(ranked),
        }
        return {key: figure for key, figure in found.items() if figure is not None}

    def counts(self) -> SummaryFigure:
        """Return the variants by status."""
        total = sum(self.states.values())
        told = ", ".join(f"{status} {count} ({percent(count, total)})" for status, count in self.states.items())
        return SummaryFigure(charts.shares(self.states, f"Variants by status: {told}."), "Variants by status.", told)

    def failures(self, failures: Sequence[Failure]) -> SummaryFigure:
        """Return in how many variants the checks fail and govern."""
        rows = failures[:GOVERNING]
        told = "; ".join(
            f"{self.stored.check_told(row.check)} fails in {row.failing}, governs {row.governing} of them, warns in {row.warning}"
            for row in rows
        )
        more = f" {len(failures) - GOVERNING} rarer checks are left out." if len(failures) > GOVERNING else ""
        caption = (
            "Variants in which a check fails: those that it governs (dark red) and those in which another check is "
            f"overloaded more (pale red); those with a warning (yellow).{more}"
        )
        colours = [charts.COLOURS["fail"], PALE, charts.COLOURS["warn"]]
        bars = [
            charts.Bar(
                self.stored.check_told(row.check),
                (row.governing, row.failing - row.governing, row.warning),
                _behind(row),
            )
            for row in rows
        ]
        return SummaryFigure(charts.stacked(bars, colours, f"{told}.", "failures"), caption, told)

    def distributions(self, spreads: Sequence[Spread]) -> SummaryFigure:
        """Return the distributions of the quantities that matter."""
        found = [data.histogram(self.stored, spread) for spread in spreads]
        told = "; ".join(_distributed(each, spread) for each, spread in zip(found, spreads, strict=True))
        caption = (
            "Distributions over all variants: pass (blue), warning (yellow), fail (red), each on top of the other; "
            "heights count variants, the number is that of the highest bar."
        )
        if any(each.is_open for each in found):
            caption += " Where a few variants lie far above the others (≥), the last bar holds them all."
        return SummaryFigure(charts.distributions(found, f"{told}."), caption, told)

    def influence(self, found: Influence) -> SummaryFigure:
        """Return the influence of the inputs on a quantity."""
        if found.is_sobol:
            told = "; ".join(
                f"{named(share.column)}: first {share.first:.2f}, total {share.total or 0:.2f}"
                for share in found.telling
            )
            caption = (
                f"Influence on {named(found.target)}. Dark: first index; pale: total index; lines: 95 % intervals."
            )
        else:
            told = "; ".join(f"{named(share.column)}: {share.first:+.2f}" for share in found.telling)
            caption = f"Influence on {named(found.target)}: partial rank correlation; to the right, a greater input gives a greater result."
        told = f"Influence on {named(found.target)}: {told}"
        return SummaryFigure(charts.influence(found, f"{told}.", f"influence of {found.target.name}"), caption, told)

    def parallel(self) -> SummaryFigure | None:
        """Return parallel coordinates of inputs and of what matters."""
        inputs = [column for column in self.stored.varied if column.name in self.sample.values][: AXES - 2]
        goals = [column for column in self.main if column.name in self.sample.values][: max(2, AXES - len(inputs))]
        columns = [column for column in (*inputs, *goals) if np.isfinite(self.sample.values[column.name]).any()][:AXES]
        drawn = self.sample.status != 3
        if len(columns) < 2 or not drawn.any():
            return None
        some = _thinned(self.sample, LINES)
        told = (
            f"{counted(len(some.variants), 'variant')} as lines over {', '.join(named(column) for column in columns)}"
        )
        caption = (
            "Each line is a variant, from input to result: pass blue (in front), warning yellow, fail red. "
            f"The ends of the axes are those of all variants. {self._drawn(some, columns)}"
        )
        return SummaryFigure(
            point_charts.parallel(some, columns, self._ends(columns), f"Parallel coordinates: {told}."), caption, told
        )

    def _ends(self, columns: Sequence[StoredColumn]) -> dict[str, point_charts.Ends]:
        """The ends of upright axes over all variants."""
        found: dict[str, point_charts.Ends] = {}
        for name in (column.name for column in columns):
            if name in self.spreads:
                low, _, _, most, high = self.spreads[name].values
                top = data.reach(low, most, high)
                found[name] = (low, top, top < high)
            else:
                last = len(self.sample.words[name]) - 1 if name in self.sample.words else 1
                found[name] = (0.0, float(last), False)
        return found

    def pair(self) -> SummaryFigure | None:
        """Return the first two quantities that matter, with the front."""
        pair = self._goals()
        if pair is None or not self.stored.study.get("objectives"):
            return None
        x, y = pair
        front = (
            self.front
            if self.front and {x.name, y.name} <= {goal.column.name for goal in self.front.objectives}
            else None
        )
        told = f"{named(y)} over {named(x)}, {self._correlated(x, y)}"
        if front:
            told += f"; Pareto front of {counted(len(front.variants), 'variant')}, from variant {front.variants[0]} to {front.variants[-1]}"
        caption = f"{named(y)} over {named(x)}{', with the Pareto front' if front else ''}."
        if sum(self.states.values()) > DENSE and {x.name, y.name} <= self.spreads.keys():
            return self._cells(x, y, front, caption, told)
        caption = f"{caption} {self._drawn(self.sample, pair)}"
        return SummaryFigure(
            point_charts.scatter(self.sample, [pair], f"Scatter of {told}.", "pair", front), caption, told
        )

    def _cells(self, x: StoredColumn, y: StoredColumn, front: Front | None, caption: str, told: str) -> SummaryFigure:
        found = data.density(self.stored, self.spreads[x.name], self.spreads[y.name])
        counted_ = counted(int(found.counts.sum()), "variant")
        caption = f"{caption} Counted in cells are {counted_}: the larger a square, the more variants; its colour is the share that does not fail."
        return SummaryFigure(point_charts.cells(found, f"Density of {told}.", "pair", front), caption, told)

    def _goals(self) -> tuple[StoredColumn, StoredColumn] | None:
        known = [column for column in self.main if column.name in self.sample.values]
        return (known[0], known[1]) if len(known) > 1 else None

    def grid(self, ranked: Sequence[Influence]) -> SummaryFigure | None:
        """Return what matters over the inputs that move it most."""
        known = [found for found in ranked[:3] if found.target.name in self.sample.values]
        pairs = [(share.column, found.target) for found in known for share in self._drawable(found)[:2]]
        if not pairs:
            return None
        some = _thinned(self.sample, LINES)
        told = "; ".join(f"{named(y)} over {named(x)}, {self._correlated(x, y)}" for x, y in pairs)
        caption = (
            f"Each quantity over the inputs that move it most. {self._drawn(some, [c for pair in pairs for c in pair])}"
        )
        return SummaryFigure(point_charts.scatter(some, pairs, f"Scatter: {told}.", "grid"), caption, told)

    def _drawable(self, found: Influence) -> list[Share]:
        """The inputs that an axis of numbers can carry."""
        return [share for share in found.telling if share.column.is_number and share.column.name in self.sample.values]

    def _correlated(self, x: StoredColumn, y: StoredColumn) -> str:
        one, two = self.sample.values[x.name], self.sample.values[y.name]
        there = np.isfinite(one) & np.isfinite(two)
        if there.sum() < 3 or not np.ptp(one[there]) > 0 or not np.ptp(two[there]) > 0:
            return f"{counted(int(there.sum()), 'variant')}"
        return f"{counted(int(there.sum()), 'variant')}, correlation {np.corrcoef(one[there], two[there])[0, 1]:.2f}"

    def _drawn(self, some: SampledVariants, columns: Sequence[StoredColumn]) -> str:
        """How many of the variants a chart has, and whether some of them are out of its reach."""
        total, drawn = sum(self.states.values()), len(some.variants)
        of_all = f"Of {counted(total, 'variant')}, a sample of {counted(drawn, 'variant')} is drawn."
        told = "All variants are drawn." if drawn == total else of_all
        is_far = any((near(values) < values).any() for values in (some.values[column.name] for column in columns))
        return f"{told} {FAR}" if is_far else told


def _behind(row: Failure) -> str:
    """What stands behind the bar of a check."""
    told = f"{number(str(row.failing))}, governs {number(str(row.governing))}" if row.failing else ""
    return ", ".join(part for part in (told, counted(row.warning, "warning") if row.warning else "") if part)


def _distributed(each: Histogram, spread: Spread) -> str:
    low, _, middle, _, high = (quantity(value, spread.column) for value in spread.values)
    return f"{named(each.column)} from {low} to {high}, half of the variants below {middle}"


def _thinned(sample: SampledVariants, most: int) -> SampledVariants:
    """Every so-manieth variant of a sample, which is in no order of sizes."""
    step = max(1, -(-len(sample.variants) // most))
    values = {name: column[::step] for name, column in sample.values.items()}
    return SampledVariants(sample.variants[::step], sample.status[::step], values, sample.words)
