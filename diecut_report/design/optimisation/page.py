"""An optimisation as HTML (one file, no network, no scripts) and as PDF, in the look of a study's summary."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from itertools import combinations
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from diecut_report.config import yaml
from diecut_report.design.optimisation.result import (
    FoundFront,
    InputPlace,
    OptimisationResult,
    SearchProgress,
    TriedMachines,
    signs,
)
from diecut_report.design.optimisation.run import asked_of
from diecut_report.design.optimisation.texts import (
    conflict_lines,
    counts,
    held,
    present,
    recheck_lines,
    row,
    suggested,
)
from diecut_report.files import room
from diecut_report.formulas import Array
from diecut_report.report.figures.diagram import WIDTH
from diecut_report.report.figures.style import ACCENT, FONT_SIZE, INK, SOFT, canvas, drawn, text_size
from diecut_report.report.pages.html import styled_page
from diecut_report.report.pages.pdf import printed_page
from diecut_report.report.text import number
from diecut_report.study.summary import best
from diecut_report.study.summary import content as questions
from diecut_report.study.summary.best import StoredObjective
from diecut_report.study.summary.charts import COLOURS, HEAD, LABEL, panel
from diecut_report.study.summary.data import (
    counted,
    display,
    factor,
    named,
    quantity,
    titled,
    utilised,
    value_text,
    wrapped,
)
from diecut_report.study.summary.figures import SummaryFigure
from diecut_report.text.phrases import capital
from diecut_report.text.translation import localised, said, say

# The figures of an optimisation, in the style of a study's summary: the front, how it was found, where it lies within the bounds.


LEGEND, MOST_PAIRS, MOST_POINTS = 16.0, 6, 3000
Pair = tuple[int, int]  # of objectives, by their places


def _front_chart(found: FoundFront, there: TriedMachines) -> Figure:
    """Each pair of objectives: what was tried, the front, the suggested machine and today's."""
    pairs = list(combinations(range(len(found.objectives)), 2))[:MOST_PAIRS]
    across = 1 if len(pairs) == 1 else 3
    wide, high = (WIDTH - 60, 230.0) if across == 1 else ((WIDTH - 3 * 44) / 3 - 4, 100.0)
    pitch, rows = high + 46 + HEAD, -(-len(pairs) // across)
    sheet = canvas(WIDTH, rows * pitch + LEGEND)
    for index, pair in enumerate(pairs):
        row, column = divmod(index, across)
        axes = panel(sheet, 44 + column * (wide + 44), (rows - row - 1) * pitch + 40 + LEGEND, wide, high)
        _pair(axes, found, there, pair, 24.0 if across == 1 else 9.0)
        x, y = (found.objectives[place].column for place in pair)
        axes.set_title(wrapped(titled(y), wide, 7.5, 2), pad=3, size=7.5, linespacing=1.05)
        axes.set_xlabel(wrapped(titled(x), wide, 7.5, 2), labelpad=1.5, size=7.5, linespacing=1.05)
        for axis in (axes.xaxis, axes.yaxis):
            axis.set_major_locator(MaxNLocator(6 if across == 1 else 4))
    handles, names = axes.get_legend_handles_labels()
    sheet.legend(handles, names, loc="lower left", bbox_to_anchor=(44 / WIDTH, 0), ncols=len(names), borderaxespad=0)
    return sheet


def _pair(axes: Axes, found: FoundFront, there: TriedMachines, pair: Pair, size: float) -> None:
    x, y = pair
    own = [found.objectives[place] for place in pair]
    scale = np.array([factor(goal.column) for goal in own])
    points = found.values[:, [x, y]] * scale
    calculated = np.flatnonzero(np.isfinite(there.costs).all(axis=1))
    rows = calculated[:: max(1, -(-len(calculated) // MOST_POINTS))]  # every so-manieth of very many
    behind, allowed = there.costs[rows][:, [x, y]] * signs(own) * scale, there.violations[rows] == 0
    for is_allowed, colour, words in (
        (False, "#dcc3c3", say("is not feasible")),
        (True, COLOURS["pass"], say("is feasible")),
    ):
        some = behind[allowed == is_allowed]
        axes.scatter(some[:, 0], some[:, 1], s=size / 3, c=colour, linewidths=0, alpha=0.7, label=words)
    line = "-" if len(found.objectives) == 2 else "none"
    step = "steps-post" if found.objectives[x].is_less else "steps-pre"  # round what the front betters
    order = np.argsort(points[:, 0], kind="stable")
    axes.plot(*points[order].T, linestyle=line, drawstyle=step, marker="D", color=INK, markersize=2.6, linewidth=0.8,
              label=say("Pareto front"))  # fmt: skip
    if found.suggested is not None:
        axes.plot(*points[[found.suggested]].T, "o", color="none", markeredgecolor=ACCENT, markeredgewidth=1.6,
                  markersize=9, label=say("suggestion"))  # fmt: skip
    shown = points
    if found.present is not None and np.isfinite(there.costs[0]).all():
        now = there.costs[0, [x, y]] * signs(own) * scale
        axes.plot([now[0]], [now[1]], "*", color="#b06a2c", markersize=9, label=say("present machine"))
        shown = np.vstack([points, now])  # a star of the legend that lies beside the plot compares nothing
    _limits(axes, shown, behind[allowed])


def _limits(axes: Axes, points: Array, allowed: Array) -> None:
    """Show the front, the present machine and the allowed machines near the front: what lies far off would press it into a corner."""
    low, high = points.min(axis=0), np.maximum(points.max(axis=0), np.quantile(allowed, 0.9, axis=0))
    low = np.minimum(low, np.quantile(allowed, 0.1, axis=0))
    room = 0.06 * np.where(high > low, high - low, np.maximum(np.abs(high), 1e-12))
    axes.set_xlim(low[0] - room[0], high[0] + room[0])
    axes.set_ylim(low[1] - room[1], high[1] + room[1])


def _progress_chart(found: SearchProgress, goals: Sequence[StoredObjective]) -> Figure:
    """How far the search was after each generation."""
    wide, high = WIDTH - 60, 120.0
    sheet = canvas(WIDTH, high + 40 + HEAD)
    axes = panel(sheet, 44, 36, wide, high)
    reached = np.array(found.reached)
    if len(goals) == 1:
        reached = reached * signs(goals) * factor(goals[0].column)
        title = titled(goals[0].column)
    else:
        reached, title = 100 * reached, say("Volume dominated by the front, % of the final volume")
    axes.plot(found.tried, reached, color=ACCENT, marker="o", markersize=2.4)
    axes.set_title(wrapped(title, wide, 7.5, 1), pad=3, size=7.5)
    axes.set_xlabel(say("machines tried"), labelpad=1.5, size=7.5)
    axes.set_xlim(0, max(found.tried))
    axes.yaxis.set_major_locator(MaxNLocator(5))
    return sheet


def _bounds_chart(found: Sequence[InputPlace]) -> Figure:
    """Where the front's points lie within the range of each number that varies."""
    labels = [wrapped(titled(each.column), LABEL, FONT_SIZE, 1) for each in found]
    ends = [(quantity(each.low, each.column), quantity(each.high, each.column)) for each in found]
    names = max(text_size(label)[0] for label in labels) + 14
    left, right = (max(text_size(each[side], 8)[0] for each in ends) + 10 for side in (0, 1))
    sheet = canvas(WIDTH, 20.0 * len(found) + 8)
    axes = panel(sheet, names + left, 4, WIDTH - names - left - right, 20.0 * len(found))
    for place, each, label, (low, high) in zip(range(len(found))[::-1], found, labels, ends, strict=True):
        axes.plot([0, 1], [place, place], color="#c3cbd3", linewidth=5, solid_capstyle="butt")
        for end, count in ((0, each.at_low), (1, each.at_high)):
            if count:
                axes.plot([end, end], [place - 0.33, place + 0.33], color=COLOURS["fail"], linewidth=2.2)
        axes.plot(each.shares, np.full(len(each.shares), place), "D", color=INK, markersize=2.6, linestyle="none")
        side: dict[str, Any] = {"textcoords": "offset points", "va": "center_baseline"}
        axes.annotate(low, (0, place), (-6, 0), ha="right", size=8, color=SOFT, **side)
        axes.annotate(high, (1, place), (6, 0), ha="left", size=8, color=SOFT, **side)
        axes.annotate(label, (0, place), (-left - 4, 0), ha="right", size=FONT_SIZE, **side)
    axes.set_xlim(-0.02, 1.02)
    axes.set_ylim(-0.6, len(found) - 0.4)
    axes.set_axis_off()
    return sheet


@dataclass(frozen=True)
class PageRow:
    """Hold a listed machine as texts: its number and report, verdict, governing check, objectives and inputs."""

    variant: int
    href: str
    status: str
    governing: str
    values: list[str]
    is_suggested: bool


def page(found: OptimisationResult) -> str:
    """Return the page as HTML."""
    return _filled(found, "screen")


def sheets(found: OptimisationResult) -> bytes:
    """Return it as PDF (A4, PDF/UA-1)."""
    with room():
        return printed_page(_filled(found, "print"))


def _filled(found: OptimisationResult, kind: str) -> str:
    asked = asked_of(found.study)
    return styled_page(
        "optimisation.html.j2", kind, ("summary", "optimisation"), r=found, o=asked, title=_title(found),
        figure=partial(questions.figure_markup, kind), figures=_figures(found),
        asked=questions.asked_questions(found.stored),
        heads=[titled(column) for column in found.front.columns],
        goals=[goal.label for goal in found.front.objectives], rows=[_row(found, place) for place in found.front.listed],
        counts=capital(counts(found)), suggested=capital(suggested(found)), present=capital(present(found, named)),
        held=_held(found), rechecked=[capital(line) for line in recheck_lines(found)],
        conflict=list(conflict_lines(found.conflict)) if found.conflict else [],
        words=[each for each in found.bounds if each.is_text], told=said, named=named, number=number, counted=counted,
        files=_files(found), localised=localised, value_text=value_text,
        example=int(found.front.variants[found.front.suggested or 0]) if found.conflict is None else found.conflict.nearest,
    )  # fmt: skip


def _title(found: OptimisationResult) -> str:
    """The title of the base's project, else the study's file."""
    content = found.stored.description.base.content
    project = yaml.parse(content.decode(), "base").data.get("project") if content else None
    return str((project or {}).get("title") or found.stored.description.study.file)


def _files(found: OptimisationResult) -> list[tuple[str, str]]:
    """The files that the study was made from, with their SHA-256."""
    made = found.stored.description
    return [(source.file, source.sha256) for source in (made.study, made.base, *made.tables)]


def _row(found: OptimisationResult, place: int) -> PageRow:
    variant, status, governing, *values = row(found, place)
    check, ratio = governing or "", None
    if check in found.stored.checks:
        asked = f"SELECT {found.stored.checks[check][0].sql} FROM v WHERE variant = ?"
        ((ratio,),) = found.stored.rows(asked, [variant])
    used = f"{utilised(ratio)} " if ratio is not None else ""
    shown = [
        display(value, column) if column.is_number else value_text(value)
        for value, column in zip(values, found.front.columns, strict=True)
    ]
    told = used + (said(found.stored.check_label(check)) if check else "–")
    is_suggested = not found.front.is_single and place == found.front.suggested
    return PageRow(variant, best.report_of(found.stored.folder, variant), status, told, shown, is_suggested)


def _held(found: OptimisationResult) -> list[str]:
    told = (held(each, found.front.is_single) for each in found.bounds)
    return [said(line) for line in told if line]


def _figures(found: OptimisationResult) -> dict[str, SummaryFigure]:
    """The charts that there is something for, by their keys."""
    if found.conflict is not None:
        return {}
    figures = {"progress": _progress(found)} | ({} if found.front.is_single else {"front": _front(found)})
    if listed := [each for each in found.bounds if not each.is_text]:
        told = "; ".join(_held(found)) or say("No point lies at a limit of its range.")
        template = (
            "Position of the front points within the search ranges; a red bar marks a limit that is active for some."
        )
        figures["bounds"] = SummaryFigure(drawn(partial(_bounds_chart, listed), told, "bounds"), say(template), told)
    return figures


def _front(found: OptimisationResult) -> SummaryFigure:
    goals = " / ".join(named(goal.column) for goal in found.front.objectives)
    template = "Pareto front for each pair of objectives: {goals}; {n} machines on it."
    told = say(template, goals=goals, n=len(found.front.variants))
    caption = say(
        "Machines tried and the Pareto front: no other machine is better than one on the front in all objectives. "
        "Machines far from it lie outside."
    )
    return SummaryFigure(drawn(partial(_front_chart, found.front, found.known), told, "front"), caption, told)


def _progress(found: OptimisationResult) -> SummaryFigure:
    gained, tried = found.progress.last_gain, found.tried
    template = "The last thousandth of the gain was reached after {n} of {all} machines."
    told = say(template, n=number(str(gained)), all=number(str(tried)))
    if gained > 0.9 * tried and not found.is_all:
        told += " " + say("The search was still improving: more evaluations may find better machines.")
    return SummaryFigure(
        drawn(partial(_progress_chart, found.progress, found.front.objectives), told, "progress"), told, told
    )
