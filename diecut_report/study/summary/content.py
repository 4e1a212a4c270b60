"""What the summary says, in its order: texts, tables and charts, ready for the template."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from diecut_report.config import yaml_tree
from diecut_report.config.basis import ASSUMED
from diecut_report.config.discovery import Discovery
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.languages.speech import localised, said, say, say_counted
from diecut_report.report.number_format import number
from diecut_report.study.analysis.stored_variants import Stored, StoredColumn
from diecut_report.study.conditions.constraints import why_dropped
from diecut_report.study.summary import best, data, influence, matrix, pareto, passing_values, questions, verdict_counts
from diecut_report.study.summary.data import Reason, Spread, Utilisation
from diecut_report.study.summary.figures import Figures, SummaryFigure
from diecut_report.study.summary.influence_table import Ranked, ranked
from diecut_report.study.summary.quantity_names import WORST, titled, utilised, variants
from diecut_report.study.summary.verdict_counts import Failure

SAMPLED = 1_500  # variants in the charts of points
NUMBERS, FEWEST = 200_000, 400  # that the page carries for the chart of any two quantities; variants of them at least
TARGETS, MOST_TARGETS = 5, 12  # quantities that influence is reported of, and with the outputs that the study asks for
PANELS, CHECKS, RANGES, POINTS = (
    12,
    4,
    36,
    30,
)  # histograms, checks of them, rows of ranges, quantities of the charts on paper


@dataclass
class Summary:
    """Hold the whole page."""

    title: str
    folder: str
    study: Any
    files: list[tuple[str, str]]
    checks: dict[str, str]
    total: int
    statuses: dict[str, int]
    facts: list[tuple[str, str]]
    asked: questions.Asked | None
    failures: list[Failure]
    governing: list[verdict_counts.Governing]
    passing: list[passing_values.PassingValues]
    utilisations: list[Utilisation]
    unmade: list[str]
    unchecked: int
    assumed: int
    idle: int
    matrices: list[matrix.Matrix]
    is_whole: bool
    spreads: list[Spread]
    more_spreads: int
    reasons: list[Reason]
    reports: list[best.ListedReport]
    more_reports: int
    front: pareto.Front | None
    best_head: list[str]
    best: list[best.Best]
    is_sobol: bool
    ranked: Ranked | None
    slow: dict[str, str]
    doubtful: list[str]
    figures: dict[str, SummaryFigure]
    any_two: data.SampledVariants
    varied: list[StoredColumn]
    choices: list[StoredColumn]

    @property
    def example(self) -> int:
        """Return a variant to name in a command: the best, else the first of the matrix."""
        rows = self.matrices[0].rows if self.matrices else []
        return self.best[0].variant if self.best else rows[0].variant if rows else 0

    @property
    def calculated(self) -> int:
        """Return how many variants can exist."""
        return self.total - self.statuses["error"]

    @property
    def sound(self) -> int:
        """Return how many variants do not fail."""
        return self.statuses["pass"] + self.statuses["warn"]

    @property
    def status(self) -> str:
        """Return what the whole looks like: pass where some variant passes all checks, on nothing assumed and by formulas without faults."""
        return (
            "incomplete"
            if (self.doubtful or self.unchecked or self.assumed) and self.statuses["pass"]
            else "pass"
            if self.statuses["pass"]
            else "warn"
            if self.statuses["warn"]
            else "fail"
        )


def content(stored: Stored, discovery: Discovery) -> Summary:
    """Return the summary of the stored variants."""
    data.prepare(stored)
    states = data.statuses(stored)
    total = sum(states.values())
    spreads = _spreads(stored, total)
    goals = pareto.objectives(stored)
    front = pareto.front(stored, goals, states["pass"] + states["warn"])
    varying = [spread.column for spread in spreads.values() if _is_telling(spread)]
    used = data.utilisations(stored)
    asked = [column for column in varying if column.name in questions.outputs(stored)]
    main = _main(stored, goals, varying, asked, [row.check for row in used if row.failing or row.warning])
    found = influence.influences(stored, main[: min(TARGETS + len(asked), MOST_TARGETS)])
    choices = _choices(stored, varying, main)
    sample = data.sample(stored, choices[:POINTS], SAMPLED)
    drawn = min(SAMPLED, max(FEWEST, NUMBERS // max(1, len(choices))))
    made, failures = [row for row in used if row.is_made], verdict_counts.failures(stored, used)
    governing = verdict_counts.governing(
        stored,
        {
            check
            for check, (column, _) in stored.checks.items()
            if column.name in spreads and not spreads[column.name].varies
        },
    )
    figures = Figures(stored, states, sample, front, main, spreads)
    first, reports = [int(variant) for variant in front.variants] if front else [], matrix.reported(stored.folder)
    ranges = [spreads[c.name] for c in (*stored.varied, *main) if c in varying and ".checks." not in c.name]
    panels = _panels(stored, goals, [*(row.check for row in failures), *(row.check for row in governing)], varying)
    groups = matrix.chosen(stored, total, first)
    shown = best.columns(stored, goals)
    return Summary(
        title=_title(stored), folder=stored.folder.resolve().name, study=stored.study, files=_files(stored),
        checks={check: said(stored.check_told(check)) for check in stored.checks},
        total=total, statuses=states, facts=_facts(stored, total), asked=questions.asked(stored),
        failures=failures, governing=governing, passing=passing_values.values(stored),
        utilisations=made, unmade=[row.check for row in used if not row.is_made],
        unchecked=len(verdict_counts.unchecked(stored)), assumed=_assumed(_base(stored)),
        idle=len(made) - len(matrix.telling(made)),
        matrices=list(matrix.matrices(stored, groups, [row.check for row in matrix.telling(made)])),
        is_whole=total <= matrix.ALL,
        spreads=ranges[:RANGES], more_spreads=max(0, len(ranges) - RANGES),
        reasons=data.reasons(stored, discovery) if states["error"] else [],
        reports=best.reports(stored, reports[: matrix.LISTED]), more_reports=max(0, len(reports) - matrix.LISTED),
        front=front, best_head=[titled(column) for column in shown], best=best.best(stored, first[: matrix.BEST], shown),
        is_sobol=influence.is_saltelli(stored), ranked=ranked(found, figures) if found else None,
        slow=dict(stored.study.get("slow") or {}), doubtful=list(stored.study.get("doubtful") or ()),
        figures=figures.all(failures, [spreads[column.name] for column in panels][:PANELS], found),
        any_two=data.sample(stored, choices, drawn), varied=stored.varied, choices=choices,
    )  # fmt: skip


def _panels(
    stored: Stored, goals: tuple[pareto.StoredObjective, ...], checks: list[str], varying: list[StoredColumn]
) -> list[StoredColumn]:
    """The quantities of histograms: objectives, utilisations of failing and governing checks, inputs, then the others."""
    limits = [stored.checks[check][0] for check in dict.fromkeys(checks) if check in stored.checks]
    wanted = [*(goal.column for goal in goals), WORST, *limits[:CHECKS], *stored.varied, *limits, *varying]
    return [column for column in dict.fromkeys(wanted) if column in varying]


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
    stored: Stored,
    goals: tuple[pareto.StoredObjective, ...],
    varying: list[StoredColumn],
    asked: list[StoredColumn],
    failing: list[str],
) -> list[StoredColumn]:
    """What matters, the first most: objectives, utilisation of all checks, outputs that are asked for, checks that fail most, other outputs."""
    inputs = {column.name for column in stored.varied}
    aims = [goal.column for goal in goals if goal.column in varying]
    worst = [WORST] if WORST in varying else []
    failed = [stored.checks[check][0] for check in failing if stored.checks[check][0] in varying]
    return list(
        dict.fromkeys([*aims, *worst, *asked, *failed, *(column for column in varying if column.name not in inputs)])
    )


def _choices(stored: Stored, varying: list[StoredColumn], main: list[StoredColumn]) -> list[StoredColumn]:
    """The quantities of the charts of points and lines: inputs, outputs, utilisations; what matters most first."""
    inputs = [column for column in stored.varied if column in varying or column.kind in ("text", "bool")]
    return list(dict.fromkeys([*inputs, *main]))


def _facts(stored: Stored, total: int) -> list[tuple[str, str]]:
    """The run in a few numbers."""
    study, counts = stored.study, stored.study.get("counts") or {}
    facts = [
        (say("Variants calculated"), variants(total)),
        (say("Varied"), say_counted(len(stored.varied), "{n} input", "{n} inputs")),
    ]
    if counts.get("dropped"):
        facts.append((say("Left out by constraints"), variants(int(counts["dropped"])) + said(why_dropped(counts))))
    facts += _margin(stored)
    seconds = float(study.get("seconds") or 0)
    if seconds > 0:
        facts.append((say("Calculated in"), localised(f"{seconds:.3g} s")))
    return facts


def _title(stored: Stored) -> str:
    """The title of the base's project, else the study's file."""
    return str((_base(stored).get("project") or {}).get("title") or stored.description.study.file)


def _base(stored: Stored) -> Any:
    """What stands in the base; nothing where its copy is not as it was."""
    content = stored.description.base.content
    return yaml_tree.parse(content.decode(), "base").data if content else {}


def _assumed(data: Any) -> int:
    """How many values of a configuration say that they are assumed."""
    parts = data.values() if isinstance(data, dict) else data if isinstance(data, list) else ()
    return (isinstance(data, dict) and data.get("basis") == ASSUMED) + sum(map(_assumed, parts))


def _margin(stored: Stored) -> list[tuple[str, str]]:
    """Which of the variants that do not fail keeps most from its limits."""
    found = verdict_counts.margin(stored) if stored.checks else None
    if found is None:
        return []
    others = found.shared - 1
    words = ", and {n} other variant with the same", ", and {n} other variants with the same"
    more = say_counted(others, *words, n=number(str(others))) if others else ""
    check, used = said(stored.check_told(found.check)), utilised(found.utilisation)
    told = "variant {n}{more}: utilisation {used} at most, by “{check}”"
    return [(say("Most margin"), say(told, n=found.variant, more=more, used=used, check=check))]


def _files(stored: Stored) -> list[tuple[str, str]]:
    """The files that the study was made from, and the code that calculated it, with their SHA-256."""
    made = stored.description
    code = [(say("the source of the {name}", name=_code(name)), digest) for name, digest in made.sources.items()]
    return [*((source.file, source.sha256) for source in (made.study, made.base, *made.tables)), *code]


def _code(name: str) -> Phrase:
    """What a part of the code is called: ``plugin cylinder_drive``."""
    kind = name.removeprefix("plugin ")
    return phrase(name) if kind == name else Phrase("plugin {kind}", kind=kind)
