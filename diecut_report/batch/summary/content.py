"""What the summary says, in its order: texts, tables and charts, ready for the template."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any, NamedTuple

from diecut_report import yaml_tree
from diecut_report.batch.stored import Column, Stored
from diecut_report.batch.summary import data, influence, matrix, pareto
from diecut_report.batch.summary.data import WORST, Failure, Reason, Spread, Utilisation
from diecut_report.batch.summary.figures import Figure, Figures
from diecut_report.batch.summary.names import counted, display, named, titled, utilised

SAMPLED = 1_500  # variants in the charts of points
NUMBERS, FEWEST = 200_000, 400  # that the page carries for the chart of any two quantities; variants of them at least
TARGETS, CHARTED = 5, 3  # quantities that influence is told of, and drawn for
PANELS, RANGES, POINTS = 12, 36, 30  # histograms, rows of ranges, quantities of the charts on paper


class Best(NamedTuple):
    """A variant on the front: its number, report, and its objectives and inputs as texts."""

    variant: int
    href: str
    values: list[str]


class Ranked(NamedTuple):
    """The influence of the inputs: quantities and, for each input, a text for each of them; charts of the first quantities."""

    targets: list[str]
    rows: list[tuple[str, list[str]]]
    figures: list[Figure]
    variants: str


class Report(NamedTuple):
    """A full report of a variant."""

    variant: int
    href: str
    status: str


@dataclass
class Summary:
    """The whole page."""

    title: str
    folder: str
    study: Any
    files: list[tuple[str, str]]
    checks: dict[str, str]
    total: int
    statuses: dict[str, int]
    facts: list[tuple[str, str]]
    failures: list[Failure]
    utilisations: list[Utilisation]
    unmade: list[str]
    idle: int
    matrices: list[matrix.Matrix]
    is_whole: bool
    spreads: list[Spread]
    more_spreads: int
    reasons: list[Reason]
    reports: list[Report]
    more_reports: int
    front: pareto.Front | None
    best_head: list[str]
    best: list[Best]
    is_sobol: bool
    ranked: Ranked | None
    slow: dict[str, str]
    figures: dict[str, Figure]
    any_two: data.Sample
    varied: list[Column]
    choices: list[Column]

    @property
    def example(self) -> int:
        """A variant to name in a command: the best, else the first of the matrix."""
        rows = self.matrices[0].rows if self.matrices else []
        return self.best[0].variant if self.best else rows[0].variant if rows else 0

    @property
    def status(self) -> str:
        """What the whole looks like: pass where some variant passes."""
        return "pass" if self.statuses["pass"] else "warn" if self.statuses["warn"] else "fail"


def content(stored: Stored) -> Summary:
    """The summary of the stored variants."""
    data.prepare(stored)
    states = data.statuses(stored)
    total = sum(states.values())
    spreads = _spreads(stored, total)
    goals = pareto.objectives(stored)
    front = pareto.front(stored, goals, states["pass"] + states["warn"])
    varying = [spread.column for spread in spreads.values() if _is_telling(spread)]
    used = data.utilisations(stored)
    main = _main(stored, goals, varying, [row.check for row in used if row.failing or row.warning])
    ranked = influence.influences(stored, main[:TARGETS])
    choices = _choices(stored, varying, main)
    sample = data.sample(stored, choices[:POINTS], SAMPLED)
    drawn = min(SAMPLED, max(FEWEST, NUMBERS // max(1, len(choices))))
    made, failures = [row for row in used if row.is_made], data.failures(stored)
    figures = Figures(stored, states, sample, front, main, spreads)
    best, reports = [int(variant) for variant in front.variants] if front else [], matrix.reported(stored.folder)
    ranges = [spreads[c.name] for c in (*stored.varied, *main) if c in varying and ".checks." not in c.name]
    return Summary(
        title=_title(stored),
        folder=stored.folder.resolve().name,
        study=stored.study,
        files=_files(stored),
        checks={check: stored.check_told(check) for check in stored.checks},
        total=total,
        statuses=states,
        facts=_facts(stored, total),
        failures=failures,
        utilisations=made,
        unmade=[row.check for row in used if not row.is_made],
        idle=len(made) - len(matrix.telling(made)),
        matrices=list(matrix.matrices(stored, matrix.chosen(stored, total, best), [row.check for row in matrix.telling(made)])),
        is_whole=total <= matrix.ALL,
        spreads=ranges[:RANGES],
        more_spreads=max(0, len(ranges) - RANGES),
        reasons=data.reasons(stored) if states["error"] else [],
        reports=_reports(stored, reports[: matrix.LISTED]),
        more_reports=max(0, len(reports) - matrix.LISTED),
        front=front,
        best_head=[titled(column) for column in _best_columns(stored, goals)],
        best=_best(stored, best[: matrix.BEST], _best_columns(stored, goals)),
        is_sobol=influence.is_saltelli(stored),
        ranked=_ranked(ranked, figures) if ranked else None,
        slow=dict(stored.study.get("slow") or {}),
        figures=figures.all(failures, [spreads[c.name] for c in main if c.name in spreads and spreads[c.name].varies][:PANELS], ranked),
        any_two=data.sample(stored, choices, drawn),
        varied=stored.varied,
        choices=choices,
    )  # fmt: skip


def _is_telling(spread: Spread) -> bool:
    """Whether a quantity varies; a utilisation that is next to nothing tells nothing."""
    return spread.varies and (".checks." not in spread.column.name or spread.values[-1] > matrix.IDLE)


def _spreads(stored: Stored, total: int) -> dict[str, Spread]:
    """The ranges of inputs and outputs, and of the greatest utilisation."""
    goals = [goal.column for goal in pareto.objectives(stored)]
    used = [value for value, _ in stored.checks.values()]
    columns = [*stored.varied, *([WORST] if stored.checks else []), *stored.outputs, *goals, *used]
    return data.spreads(stored, list(dict.fromkeys(columns)), total)


def _main(
    stored: Stored, goals: tuple[pareto.Objective, ...], varying: list[Column], failing: list[str]
) -> list[Column]:
    """What matters, the first most: objectives, utilisations of all checks and of those that fail most, other outputs."""
    inputs = {column.name for column in stored.varied}
    aims = [goal.column for goal in goals if goal.column in varying]
    worst = [WORST] if WORST in varying else []
    failed = [stored.checks[check][0] for check in failing if stored.checks[check][0] in varying]
    return list(dict.fromkeys([*aims, *worst, *failed, *(column for column in varying if column.name not in inputs)]))


def _choices(stored: Stored, varying: list[Column], main: list[Column]) -> list[Column]:
    """The quantities of the charts of points and lines: inputs, outputs, utilisations; what matters most first."""
    inputs = [column for column in stored.varied if column in varying or column.kind in ("text", "bool")]
    return list(dict.fromkeys([*inputs, *main]))


def _facts(stored: Stored, total: int) -> list[tuple[str, str]]:
    """The run in a few numbers."""
    study, counts = stored.study, stored.study.get("counts") or {}
    facts = [("Variants calculated", counted(total, "variant")), ("Varied", counted(len(stored.varied), "input"))]
    if counts.get("dropped"):
        facts.append(("Left out by constraints", counted(int(counts["dropped"]), "variant")))
    facts += _margin(stored)
    seconds = float(study.get("seconds") or 0)
    if seconds > 0:
        facts.append(("Calculated in", f"{seconds:.3g} s"))
    return facts


def _title(stored: Stored) -> str:
    """The title of the base's project, else the study's file."""
    content = stored.description.base.content
    project = yaml_tree.parse(content.decode(), "base").data.get("project") if content else None
    return str((project or {}).get("title") or stored.description.study.file)


def _margin(stored: Stored) -> list[tuple[str, str]]:
    """Which of the variants that do not fail keeps most from its limits."""
    if not stored.checks:
        return []
    sql = f"SELECT variant, {WORST.sql}, governing FROM w WHERE status IN ('pass', 'warn') AND {WORST.sql} IS NOT NULL ORDER BY 2, 1 LIMIT 1"
    return [
        ("Most margin", f"variant {one}: utilisation {utilised(used)} at most, by “{stored.check_told(check)}”")
        for one, used, check in stored.rows(sql)
    ]


def _files(stored: Stored) -> list[tuple[str, str]]:
    """The files that the study was made from, with their SHA-256."""
    made = stored.description
    return [(source.file, source.sha256) for source in (made.study, made.base, *made.tables)]


def _reports(stored: Stored, variants: list[int]) -> list[Report]:
    listed = ", ".join(map(str, variants)) or "NULL"
    states = dict(stored.rows(f"SELECT variant, status FROM v WHERE variant IN ({listed})"))
    return [Report(one, matrix.report_of(stored.folder, one), states[one]) for one in variants if one in states]


def _best_columns(stored: Stored, goals: tuple[pareto.Objective, ...]) -> list[Column]:
    return list(dict.fromkeys([*(goal.column for goal in goals), *stored.varied[:6]]))


def _best(stored: Stored, variants: list[int], columns: list[Column]) -> list[Best]:
    names, listed = ", ".join(column.sql for column in columns) or "NULL", ", ".join(map(str, variants)) or "NULL"
    rows = {row[0]: row[1:] for row in stored.rows(f"SELECT variant, {names} FROM v WHERE variant IN ({listed})")}
    return [
        Best(
            one,
            matrix.report_of(stored.folder, one),
            [_told(value, column) for value, column in zip(rows[one], columns, strict=True)],
        )
        for one in variants
    ]


def _told(value: Any, column: Column) -> str:
    if value is None:
        return "–"
    return display(float(value), column) if column.is_number else str(value)


def _ranked(found: list[influence.Influence], figures: Figures) -> Ranked:
    """One table for all quantities, its inputs in the order of the first of them."""
    by_target = [{share.column: share for share in each.shares} for each in found]
    inputs = list(dict.fromkeys(column for shares in by_target for column in shares))
    rows = [(named(column), [_share(shares.get(column)) for shares in by_target]) for column in inputs]
    drawn = [figures.influence(each) for each in found if each.is_certain][:CHARTED]
    return Ranked(
        [named(each.target) for each in found], rows, drawn, counted(max(each.variants for each in found), "variant")
    )


def _share(share: influence.Share | None) -> str:
    if share is None or not share.is_certain:
        return "–"
    if share.total is not None:
        text = f"{share.first:.2f} ± {share.first_error or 0:.2f} / {share.total:.2f} ± {share.total_error or 0:.2f}"
    else:
        text = f"{share.first:.2f}" if share.column.kind == "text" else f"{share.first:+.2f}"
    return re.sub(r"[-+](?=0\.00)", "", text).replace("-", "−")
