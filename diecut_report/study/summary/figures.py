"""The charts of the summary with their captions and text alternatives."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from diecut_report.report.figures.style import Svg
from diecut_report.report.text import number
from diecut_report.study.analysis.variants import STATUSES, Stored, StoredColumn
from diecut_report.study.summary import charts, data
from diecut_report.study.summary.best import Front, Influence, Share
from diecut_report.study.summary.charts import DrawnLines, Ends, drawn_lines, near, parallel
from diecut_report.study.summary.data import (
    WORDS,
    Failure,
    Histogram,
    SampledVariants,
    Spread,
    named,
    percent,
    quantity,
    variants,
)
from diecut_report.text.phrases import Phrase, phrase
from diecut_report.text.translation import localised, said, say, say_counted

DENSE = 5_000  # variants from which a chart counts them in cells
AXES, GOVERNING, LINES = 8, 15, 400  # upright axes, bars of governing checks, lines between the axes

PALE = "#e0a3a1"  # of failures that another check governs
FAR = phrase("Values that lie far above the others stand at the edge.")


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
        told = ", ".join(
            f"{said(WORDS[status])} {count} ({percent(count, total)})" for status, count in self.states.items()
        )
        title = say("Variants by status: {told}.", told=told)
        return SummaryFigure(charts.shares(self.states, title), say("Variants by status."), told)

    def failures(self, failures: Sequence[Failure]) -> SummaryFigure:
        """Return in how many variants the checks fail and govern."""
        rows = failures[:GOVERNING]
        told = "; ".join(
            say(
                "{check} fails in {failing}, governs {governing} of them, warns in {warning}",
                check=self._check(row),
                failing=row.failing,
                governing=row.governing,
                warning=row.warning,
            )
            for row in rows
        )
        caption = say(
            "Variants in which a check fails: those that it governs (dark red) and those in which another check is "
            "overloaded more (pale red); those with a warning (yellow)."
        )
        if (left := len(failures) - GOVERNING) > 0:
            caption += " " + say_counted(left, "{n} rarer check is left out.", "{n} rarer checks are left out.")
        colours = [charts.COLOURS["fail"], PALE, charts.COLOURS["warn"]]
        bars = [
            charts.Bar(
                self._check(row),
                (row.governing, row.failing - row.governing, row.warning),
                _behind(row),
            )
            for row in rows
        ]
        return SummaryFigure(charts.stacked(bars, colours, f"{told}.", "failures"), caption, told)

    def _check(self, row: Failure) -> str:
        return said(self.stored.check_told(row.check))

    def distributions(self, spreads: Sequence[Spread]) -> SummaryFigure:
        """Return the distributions of the quantities that matter."""
        found = [data.histogram(self.stored, spread) for spread in spreads]
        told = "; ".join(_distributed(each, spread) for each, spread in zip(found, spreads, strict=True))
        caption = say(
            "Distributions over all variants: pass (blue), warning (yellow), fail (red), each on top of the other; "
            "heights count variants, the number is that of the highest bar."
        )
        if any(each.is_open for each in found):
            caption += " " + say("Where a few variants lie far above the others (≥), the last bar holds them all.")
        return SummaryFigure(charts.distributions(found, f"{told}."), caption, told)

    def influence(self, found: Influence) -> SummaryFigure:
        """Return the influence of the inputs on a quantity."""
        if found.is_sobol:
            told = "; ".join(
                say(
                    "{quantity}: first {first}, total {total}",
                    quantity=named(share.column),
                    first=localised(f"{share.first:.2f}"),
                    total=localised(f"{share.total or 0:.2f}"),
                )
                for share in found.telling
            )
            words = "Influence on {target}. Dark: first index; pale: total index; lines: 95 % intervals."
        else:
            told = "; ".join(localised(f"{named(share.column)}: {share.first:+.2f}") for share in found.telling)
            words = (
                "Influence on {target}: partial rank correlation; to the right, a greater input gives a greater result."
            )
        caption = say(words, target=named(found.target))
        told = say("Influence on {target}: {told}", target=named(found.target), told=told)
        return SummaryFigure(
            charts.influence(found, f"{told}.", Phrase("influence of {name}", name=found.target.name)), caption, told
        )

    def parallel(self) -> SummaryFigure | None:
        """Return parallel coordinates of inputs and of what matters."""
        inputs = [column for column in self.stored.varied if column.name in self.sample.values][: AXES - 2]
        goals = [column for column in self.main if column.name in self.sample.values][: max(2, AXES - len(inputs))]
        columns = [column for column in (*inputs, *goals) if np.isfinite(self.sample.values[column.name]).any()][:AXES]
        if len(columns) < 2 or not (self.sample.status != STATUSES.index("error")).any():
            return None
        lines = drawn_lines(self.sample)
        shown = variants(len(lines.sound) + len(lines.failing))
        told = say("{variants} as lines over {names}", variants=shown, names=", ".join(map(named, columns)))
        title = say("Parallel coordinates: {told}.", told=told)
        svg = parallel(self.sample, lines, columns, self._ends(columns), title)
        return SummaryFigure(svg, self._of_lines(lines, columns), told)

    def _of_lines(self, lines: DrawnLines, columns: Sequence[StoredColumn]) -> str:
        """What stands below the lines: what they are, and by which rule they were chosen."""
        caption = say(
            "Each line is a variant, from input to result: dark those that pass, in front; dashed those with a warning; pale "
            "those that fail. The darker a field of an axis, the larger the share of the variants there that pass. "
            "The ends of the axes are those of all variants."
        )
        rule = "Of {variants} so many are drawn, evenly taken from the sample: {sound} of those that pass, {failing} of those that fail."
        sound, failing = len(lines.sound), len(lines.failing)
        is_whole = lines.is_whole and sum(self.states.values()) == len(self.sample.status)
        drawn = say(rule, variants=variants(sum(self.states.values())), sound=sound, failing=failing)
        told = [caption, say("All variants are drawn.") if is_whole else drawn]
        return " ".join([*told, *([said(FAR)] if self._reach_far(self.sample, columns) else [])])

    def _ends(self, columns: Sequence[StoredColumn]) -> dict[str, Ends]:
        """The ends of upright axes over all variants."""
        found: dict[str, Ends] = {}
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
        told = self._over(x, y)
        if front:
            words = "; Pareto front of {variants}, from variant {first} to {last}"
            first, last = front.variants[0], front.variants[-1]
            told += say(words, variants=variants(len(front.variants)), first=first, last=last)
        words = "{y} over {x}, with the Pareto front." if front else "{y} over {x}."
        caption = say(words, y=named(y), x=named(x))
        if sum(self.states.values()) > DENSE and {x.name, y.name} <= self.spreads.keys():
            return self._cells(x, y, front, caption, told)
        caption = f"{caption} {self._drawn(self.sample, pair)}"
        return SummaryFigure(
            charts.scatter(self.sample, [pair], say("Scatter of {told}.", told=told), "pair", front),
            caption,
            told,
        )

    def _cells(self, x: StoredColumn, y: StoredColumn, front: Front | None, caption: str, told: str) -> SummaryFigure:
        found = data.density(self.stored, self.spreads[x.name], self.spreads[y.name])
        words = "Counted in cells are {variants}: the larger a square, the more variants; its colour is the share that does not fail."
        caption = f"{caption} {say(words, variants=variants(int(found.counts.sum())))}"
        title = say("Density of {told}.", told=told)
        return SummaryFigure(charts.cells(found, title, "pair", front), caption, told)

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
        told = "; ".join(self._over(x, y) for x, y in pairs)
        drawn = self._drawn(some, [column for pair in pairs for column in pair])
        caption = f"{say('Each quantity over the inputs that move it most.')} {drawn}"
        title = say("Scatter: {told}.", told=told)
        return SummaryFigure(charts.scatter(some, pairs, title, "grid"), caption, told)

    def _over(self, x: StoredColumn, y: StoredColumn) -> str:
        return say("{y} over {x}, {told}", y=named(y), x=named(x), told=self._correlated(x, y))

    def _drawable(self, found: Influence) -> list[Share]:
        """The inputs that an axis of numbers can carry."""
        return [share for share in found.telling if share.column.is_number and share.column.name in self.sample.values]

    def _correlated(self, x: StoredColumn, y: StoredColumn) -> str:
        one, two = self.sample.values[x.name], self.sample.values[y.name]
        there = np.isfinite(one) & np.isfinite(two)
        if there.sum() < 3 or not np.ptp(one[there]) > 0 or not np.ptp(two[there]) > 0:
            return variants(int(there.sum()))
        found = localised(f"{np.corrcoef(one[there], two[there])[0, 1]:.2f}")
        return say("{variants}, correlation {found}", variants=variants(int(there.sum())), found=found)

    def _drawn(self, some: SampledVariants, columns: Sequence[StoredColumn]) -> str:
        """How many of the variants a chart has, and whether some of them are out of its reach."""
        total, drawn = sum(self.states.values()), len(some.variants)
        of_all = say("Of {variants}, a sample of {drawn} is drawn.", variants=variants(total), drawn=variants(drawn))
        told = say("All variants are drawn.") if drawn == total else of_all
        return f"{told} {said(FAR)}" if self._reach_far(some, columns) else told

    def _reach_far(self, some: SampledVariants, columns: Sequence[StoredColumn]) -> bool:
        """Whether some variants are out of a chart's reach."""
        return any((near(values) < values).any() for values in (some.values[column.name] for column in columns))


def _behind(row: Failure) -> str:
    """What stands behind the bar of a check."""
    told = say("{n}, governs {governing}", n=number(str(row.failing)), governing=number(str(row.governing)))
    warned = say_counted(row.warning, "{n} warning", "{n} warnings", n=number(str(row.warning)))
    return ", ".join([*([told] if row.failing else []), *([warned] if row.warning else [])])


def _distributed(each: Histogram, spread: Spread) -> str:
    low, _, middle, _, high = (quantity(value, spread.column) for value in spread.values)
    words = "{quantity} from {low} to {high}, half of the variants below {middle}"
    return say(words, quantity=named(each.column), low=low, high=high, middle=middle)


def _thinned(sample: SampledVariants, most: int) -> SampledVariants:
    """Every so-manieth variant of a sample, which is in no order of sizes."""
    step = max(1, -(-len(sample.variants) // most))
    values = {name: column[::step] for name, column in sample.values.items()}
    return SampledVariants(sample.variants[::step], sample.status[::step], values, sample.words)


# The influence of the inputs as a table with charts.


CHARTED = 3  # quantities that influence is drawn for


class Ranked(NamedTuple):
    """Hold the influence of the inputs: quantities and, for each input, a text for each of them; charts of the first quantities."""

    targets: list[str]
    rows: list[tuple[str, list[str]]]
    figures: list[SummaryFigure]
    variants: str


def ranked(found: list[Influence], figures: Figures) -> Ranked:
    """Return one table for all quantities, its inputs in the order of the first of them."""
    by_target = [{share.column: share for share in each.shares} for each in found]
    inputs = list(dict.fromkeys(column for shares in by_target for column in shares))
    rows = [(named(column), [_share(shares.get(column)) for shares in by_target]) for column in inputs]
    drawn = [figures.influence(each) for each in found if each.is_certain and each.telling][:CHARTED]
    return Ranked([named(each.target) for each in found], rows, drawn, variants(max(each.variants for each in found)))


def _share(share: Share | None) -> str:
    if share is None or not share.is_certain or not share.is_telling:
        return "–"
    if share.total is not None:
        text = f"{share.first:.2f} ± {share.first_error or 0:.2f} / {share.total:.2f} ± {share.total_error or 0:.2f}"
    else:
        text = f"{share.first:.2f}" if share.column.kind == "text" else f"{share.first:+.2f}"
    return localised(re.sub(r"[-+](?=0\.00)", "", text).replace("-", "−"))
