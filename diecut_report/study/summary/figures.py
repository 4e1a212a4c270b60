"""The charts of the summary with their captions and text alternatives."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from typing import NamedTuple

import numpy as np

from diecut_report.report.figures.style import Svg, drawn
from diecut_report.report.text import number
from diecut_report.study.analysis.variants import Stored, StoredColumn
from diecut_report.study.storage.description import STATUSES
from diecut_report.study.summary import charts, data
from diecut_report.study.summary.best import Front, Influence, Share
from diecut_report.study.summary.charts import Ends, evenly, near
from diecut_report.study.summary.data import (
    WORDS,
    SampledVariants,
    Spread,
    Utilisation,
    named,
    percent,
    quantity,
    variants,
)
from diecut_report.text.phrases import Phrase, phrase
from diecut_report.text.translation import localised, said, say, say_counted

DENSE = 5_000  # variants from which a chart counts them in cells
MAX_AXES, MAX_FAILURES, MAX_POINTS = 8, 15, 400  # upright axes, bars of failing checks, points of each small chart
PALE = "#e0a3a1"  # of failures that another check governs
FAR = phrase("Values far above the others are drawn at the edge.")


class SummaryFigure(NamedTuple):
    """Hold a chart, what stands below it, and what it shows in words."""

    svg: Svg
    caption: str
    alternative: str


@dataclass(frozen=True)
class Figures:
    stored: Stored
    states: dict[str, int]
    sample: SampledVariants
    front: Front | None
    main: list[StoredColumn]
    spreads: dict[str, Spread]

    @property
    def total(self) -> int:
        return sum(self.states.values())

    def all(
        self, failures: Sequence[Utilisation], spreads: Sequence[Spread], ranked: Sequence[Influence]
    ) -> dict[str, SummaryFigure]:
        """Return every chart that the study has something for, by its key."""
        found = {
            "counts": self._counts(),
            "failures": self._failures(failures) if failures else None,
            "distributions": self._distributions(spreads) if spreads else None,
            "parallel": self._parallel(),
            "pair": self._pair(),
            "grid": self._grid(ranked),
        }
        return {key: figure for key, figure in found.items() if figure is not None}

    def _counts(self) -> SummaryFigure:
        parts = self.states.items()
        told = ", ".join(f"{said(WORDS[status])} {count} ({percent(count, self.total)})" for status, count in parts)
        svg = drawn(partial(charts.shares, self.states), say("Variants by status: {told}.", told=told), "counts")
        return SummaryFigure(svg, say("Variants by status."), told)

    def _failures(self, failures: Sequence[Utilisation]) -> SummaryFigure:
        rows = [(row, said(self.stored.check_label(row.check))) for row in failures[:MAX_FAILURES]]
        template = "{check} fails in {failing}, governs {governing} of them, warns in {warning}"
        told = "; ".join(
            say(template, check=name, failing=row.failing, governing=row.governing, warning=row.warning)
            for row, name in rows
        )
        caption = say(
            "Variants in which a check fails: those that it governs (dark red) and those in which another check is "
            "overloaded more (pale red); those with a warning (yellow)."
        )
        if (left := len(failures) - MAX_FAILURES) > 0:
            one = "{n} less frequent check is omitted."
            caption += " " + say_counted(left, one, "{n} less frequent checks are omitted.")
        colours = [charts.COLOURS["fail"], PALE, charts.COLOURS["warn"]]
        parts = ((row.governing, row.failing - row.governing, row.warning) for row, _ in rows)
        bars = [(name, part, _behind(row)) for (row, name), part in zip(rows, parts, strict=True)]
        return SummaryFigure(drawn(partial(charts.stacked, bars, colours), f"{told}.", "failures"), caption, told)

    def _distributions(self, spreads: Sequence[Spread]) -> SummaryFigure:
        found = [data.histogram(self.stored, spread) for spread in spreads]
        told = "; ".join(map(_distributed, spreads))
        caption = say(
            "Distributions over all variants: pass (blue), warning (yellow), fail (red), stacked; bar heights are "
            "numbers of variants, the number shown is that of the highest bar."
        )
        if any(each.is_open for each in found):
            caption += " " + say("Where a few variants lie far above the others (≥), the last bar holds them all.")
        return SummaryFigure(drawn(partial(charts.distributions, found), f"{told}.", "distributions"), caption, told)

    def _parallel(self) -> SummaryFigure | None:
        values = self.sample.values
        inputs = [column for column in self.stored.varied if column.name in values][: MAX_AXES - 2]
        goals = [column for column in self.main if column.name in values][: max(2, MAX_AXES - len(inputs))]
        columns = [each for each in (*inputs, *goals) if np.isfinite(values[each.name]).any()][:MAX_AXES]
        status, fail = self.sample.status, STATUSES.index("fail")
        calculated = np.sum(status <= fail)
        if len(columns) < 2 or not calculated:
            return None
        sound, failing = evenly(status < fail), evenly(status == fail)
        lines = np.concatenate([failing, sound])
        names = ", ".join(map(named, columns))
        told = say("{variants} as lines over {names}", variants=variants(len(lines)), names=names)
        caption = say(
            "Each line is a variant, from input to result: passing variants are dark and in front, those with a warning dashed, failing ones "
            "pale. The darker a field of an axis, the larger the percentage of the variants there that pass. The ends of the axes are those of "
            "all variants."
        )
        rule = "Of {variants}, evenly selected from the sample, these are drawn: {sound} of those that pass, {failing} of those that fail."
        is_whole = len(lines) == calculated and len(status) == self.total
        counts = {"variants": variants(self.total), "sound": len(sound), "failing": len(failing)}
        which = say("All variants are drawn.") if is_whole else say(rule, **counts)
        build = partial(charts.parallel, self.sample, lines, columns, self._ends(columns))
        svg = drawn(build, say("Parallel coordinates: {told}.", told=told), "parallel")
        return SummaryFigure(svg, f"{caption} {which}{self._far(self.sample, columns)}", told)

    def _ends(self, columns: Sequence[StoredColumn]) -> dict[str, Ends]:
        found: dict[str, Ends] = {}
        for name in (column.name for column in columns):
            if name in self.spreads:
                spread = self.spreads[name]
                found[name] = (spread.values[0], spread.reach, spread.reach < spread.values[-1])
            else:
                last = len(self.sample.words[name]) - 1 if name in self.sample.words else 1
                found[name] = (0.0, float(last), False)
        return found

    def _pair(self) -> SummaryFigure | None:
        known = [column for column in self.main if column.name in self.sample.values]
        if len(known) < 2 or not self.stored.study.get("objectives"):
            return None
        x, y = known[:2]
        goals = {goal.column.name for goal in self.front.objectives} if self.front else set()
        front = self.front if {x.name, y.name} <= goals else None
        told = self._over(x, y)
        if front:
            template = "; Pareto front of {variants}, from variant {first} to {last}"
            first, last = front.variants[0], front.variants[-1]
            told += say(template, variants=variants(len(front.variants)), first=first, last=last)
        caption = say("{y} over {x}, with the Pareto front." if front else "{y} over {x}.", y=named(y), x=named(x))
        if self.total > DENSE and {x.name, y.name} <= self.spreads.keys():
            found = data.density(self.stored, self.spreads[x.name], self.spreads[y.name])
            template = "{variants} are counted in cells: the larger a square, the more variants; its colour shows the percentage that does not fail."
            counted = say(template, variants=variants(int(found.counts.sum())))
            svg = drawn(partial(charts.cells, found, front), say("Density of {told}.", told=told), "pair")
        else:
            counted = self._drawn(self.sample, [x, y])
            build = partial(charts.scatter, self.sample, [(x, y)], front)
            svg = drawn(build, say("Scatter of {told}.", told=told), "pair")
        return SummaryFigure(svg, f"{caption} {counted}", told)

    def _grid(self, ranked: Sequence[Influence]) -> SummaryFigure | None:
        """Return what matters over the inputs that move it most, as far as an axis of numbers can carry them."""
        values = self.sample.values
        known = [found for found in ranked[:3] if found.target.name in values]
        moving = [[each.column for each in found.telling if each.column.is_number] for found in known]
        drawable = [[column for column in columns if column.name in values][:2] for columns in moving]
        pairs = [(column, found.target) for found, some in zip(known, drawable, strict=True) for column in some]
        if not pairs:
            return None
        some = self.sample.thinned(MAX_POINTS)
        told = "; ".join(self._over(x, y) for x, y in pairs)
        which = self._drawn(some, [column for pair in pairs for column in pair])
        caption = f"{say('Each quantity over its most influential inputs.')} {which}"
        svg = drawn(partial(charts.scatter, some, pairs), say("Scatter: {told}.", told=told), "grid")
        return SummaryFigure(svg, caption, told)

    def _over(self, x: StoredColumn, y: StoredColumn) -> str:
        """Name two quantities, with their correlation where there is one."""
        one, two = self.sample.values[x.name], self.sample.values[y.name]
        there = np.isfinite(one) & np.isfinite(two)
        told = variants(int(there.sum()))
        if there.sum() >= 3 and np.ptp(one[there]) > 0 and np.ptp(two[there]) > 0:
            found = localised(f"{np.corrcoef(one[there], two[there])[0, 1]:.2f}")
            told = say("{variants}, correlation {found}", variants=told, found=found)
        return say("{y} over {x}, {told}", y=named(y), x=named(x), told=told)

    def _drawn(self, some: SampledVariants, columns: Sequence[StoredColumn]) -> str:
        count = len(some.variants)
        template = "All variants are drawn." if count == self.total else "Of {variants}, a sample of {drawn} is drawn."
        return say(template, variants=variants(self.total), drawn=variants(count)) + self._far(some, columns)

    def _far(self, some: SampledVariants, columns: Sequence[StoredColumn]) -> str:
        """Return what to add where some variants are out of a chart's reach."""
        is_far = any((near(values) < values).any() for values in (some.values[column.name] for column in columns))
        return f" {said(FAR)}" if is_far else ""


def influence_figure(found: Influence) -> SummaryFigure:
    target = named(found.target)
    if found.is_sobol:
        template = (
            "Influence on {target}. Dark: first-order index; light: total index; lines: 95 % confidence intervals."
        )
        each = "{quantity}: first-order {first}, total {total}"
        numbers = [(named(share.column), f"{share.first:.2f}", f"{share.total or 0:.2f}") for share in found.telling]
        told = "; ".join(
            say(each, quantity=name, first=localised(one), total=localised(all_)) for name, one, all_ in numbers
        )
    else:
        template = (
            "Influence on {target}: partial rank correlation; bars to the right: the result increases with the input."
        )
        told = "; ".join(localised(f"{named(share.column)}: {share.first:+.2f}") for share in found.telling)
    told = say("Influence on {target}: {told}", target=target, told=told)
    key = Phrase("influence of {name}", name=found.target.name)
    svg = drawn(partial(charts.influence, found), f"{told}.", key)
    return SummaryFigure(svg, say(template, target=target), told)


def _behind(row: Utilisation) -> str:
    told = say("{n}, governs {governing}", n=number(str(row.failing)), governing=number(str(row.governing)))
    warned = say_counted(row.warning, "{n} warning", "{n} warnings", n=number(str(row.warning)))
    return ", ".join([*([told] if row.failing else []), *([warned] if row.warning else [])])


def _distributed(spread: Spread) -> str:
    low, _, middle, _, high = (quantity(value, spread.column) for value in spread.values)
    template = "{quantity} from {low} to {high}, half of the variants below {middle}"
    return say(template, quantity=named(spread.column), low=low, high=high, middle=middle)


# The influence of the inputs as a table with charts.


CHARTED = 3  # quantities that influence is drawn for


class Ranked(NamedTuple):
    """Hold the influence of the inputs: quantities and, for each input, a text for each of them; charts of the first quantities."""

    targets: list[str]
    rows: list[tuple[str, list[str]]]
    figures: list[SummaryFigure]
    variants: str


def ranked(found: list[Influence]) -> Ranked:
    """Return one table for all quantities, its inputs in the order of the first of them."""
    by_target = [{share.column: share for share in each.shares} for each in found]
    inputs = list(dict.fromkeys(column for shares in by_target for column in shares))
    rows = [(named(column), [_share(shares.get(column)) for shares in by_target]) for column in inputs]
    figures = [influence_figure(each) for each in found if each.is_certain and each.telling][:CHARTED]
    return Ranked([named(each.target) for each in found], rows, figures, variants(max(each.variants for each in found)))


def _share(share: Share | None) -> str:
    if share is None or not share.is_certain or not share.is_telling:
        return "–"
    if share.total is not None:
        text = f"{share.first:.2f} ± {share.first_error or 0:.2f} / {share.total:.2f} ± {share.total_error or 0:.2f}"
    else:
        text = f"{share.first:.2f}" if share.column.kind == "text" else f"{share.first:+.2f}"
    return localised(re.sub(r"[-+](?=0\.00)", "", text).replace("-", "−"))
