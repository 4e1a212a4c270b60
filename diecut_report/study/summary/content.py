"""What the summary of a study says, in its order (texts, tables and charts), and its page, for the screen and for paper."""

from __future__ import annotations

import base64
import json
import math
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple

from markupsafe import Markup

from diecut_report.config import yaml
from diecut_report.config.plugins import Discovery
from diecut_report.config.validation import ASSUMED
from diecut_report.config.yaml import KeyPath, printable
from diecut_report.quantities.units import pretty, unit
from diecut_report.report.pages import html
from diecut_report.report.pages.html import styled_page
from diecut_report.report.text import number
from diecut_report.study.analysis.variants import Stored, StoredColumn
from diecut_report.study.definition.base_inputs import MECHANISMS
from diecut_report.study.definition.constraints import why_dropped
from diecut_report.study.storage.description import StudySource, source_name
from diecut_report.study.summary import best, data
from diecut_report.study.summary.figures import Figures, Ranked, SummaryFigure, ranked
from diecut_report.text.phrases import phrase
from diecut_report.text.translation import decimal_sign, localised, said, say, say_counted

# What the study asks, as its file says it.


METHODS = {
    "grid": phrase("grid: all combinations of the values"),
    "zip": phrase("zip: the first values together, the second together, and so on"),
    "latin_hypercube": phrase("Latin hypercube"),
    "sobol": phrase("Sobol sequence"),
    "table": phrase("rows of a table"),
}
NAME = re.compile(r"[A-Za-z_][\w.]*")


class AskedInput(NamedTuple):
    """Hold a varied input: what people call it, its symbol, its path, and its values as written, a choice in words too."""

    text: str
    symbol: str
    path: str
    values: str


class Asked(NamedTuple):
    """Hold what was studied: facts, varied inputs, what ``reports`` asks for; objectives and constraints in words and as they are typed."""

    facts: list[tuple[str, str]]
    inputs: list[AskedInput]
    objectives: list[tuple[str, str]]
    constraints: list[tuple[str, str]]
    reports: str


def _parsed(source: StudySource) -> yaml.Tree | None:
    """Return what stands in the kept copy of a file; None where the copy is gone or changed."""
    return yaml.parse(source.content.decode("utf-8-sig"), source.file) if source.content is not None else None


def asked_questions(stored: Stored) -> Asked | None:
    """Return what the kept copy of the study file says; None where the copy is gone or changed."""
    tree = _parsed(stored.description.study)
    if tree is None:
        return None
    given: Mapping[str, Any] = tree.data
    objectives = [(way, str(name)) for each in given.get("objectives") or () for way, name in each.items()]
    return Asked(
        list(_asked_facts(stored, tree)),
        [_input(stored, tree, path) for path in stored.study.get("varied") or ()],
        [_objective(_column_of(stored, name), way, name) for way, name in objectives],
        [(_quantities(stored, str(each)), str(each)) for each in given.get("constraints") or ()],
        say("none") if given.get("reports") is None else written(tree, ("reports",)),
    )


def _asked_facts(stored: Stored, tree: yaml.Tree) -> Iterator[tuple[str, str]]:
    sample, counts = tree.data.get("sample") or {}, stored.study.get("counts") or {}
    method = str(sample.get("method", ""))
    yield say("Base"), str(tree.data.get("base", stored.description.base.file))
    yield say("Sample"), said(METHODS.get(method, method)) + (f": {sample['file']}" if "file" in sample else "")
    if "count" in sample:
        yield say("Count"), written(tree, ("sample", "count"))
    if method in ("latin_hypercube", "sobol"):
        yield say("Seed"), written(tree, ("sample", "seed")) if "seed" in sample else say("0 (none is given)")
    if sample.get("indices"):
        yield say("Sobol indices"), say("yes: each of the points above is a group of variants")
    if "sample" in counts and counts["sample"] != sample.get("count"):
        yield say("Variants of the sample"), data.variants(int(counts["sample"]))
    if tree.data.get("constraints"):
        yield say("Excluded by the constraints"), _dropped(counts)


def _dropped(counts: Mapping[str, Any]) -> str:
    return data.variants(int(counts.get("dropped") or 0)) + said(why_dropped(counts))


def _objective(column: StoredColumn | None, way: str, name: str) -> tuple[str, str]:
    typed = f"{way}: {name}"
    return (best.StoredObjective(column, way == "minimise").label, typed) if column else (typed, "")


def _quantities(stored: Stored, expression: str) -> str:
    found = (_column_of(stored, name) for name in dict.fromkeys(NAME.findall(expression)))
    return ", ".join(f"{data.named(column)} {column.symbol}".rstrip() for column in found if column)


def _column_of(stored: Stored, name: str) -> StoredColumn | None:
    """Return the column that a study means by a name, with ``mechanisms.`` or without."""
    return stored.columns.get(name) or stored.columns.get(f"{MECHANISMS}.{name}")


def _input(stored: Stored, tree: yaml.Tree, path: str) -> AskedInput:
    """Return a varied input with its values as they are written; choices in words, with what is typed behind them."""
    column, place = stored.columns.get(path), ("vary", path)
    given = (tree.data.get("vary") or {}).get(path)
    if given is None:
        values = say("a column of {table}", table=tree.typed(("sample", "file")) or phrase("the table"))
    elif isinstance(given, list) and any(isinstance(each, str) and data.value_text(each) != each for each in given):
        told = [(data.value_text(each), written(tree, (*place, index))) for index, each in enumerate(given)]
        values = ", ".join(typed if words == typed else f"{words} ({typed})" for words, typed in told)
    else:
        values = written(tree, place)
    return AskedInput(data.named(column) if column else path, column.symbol if column else "", path, values)


def written(tree: yaml.Tree, path: KeyPath) -> str:
    """Return a value as the file says it: lists with commas, a range as ``from A to B``, other keys with their names."""
    value = tree.data
    for step in path:
        value = value[step]
    if isinstance(value, list):
        return ", ".join(written(tree, (*path, index)) for index in range(len(value)))
    if not isinstance(value, dict):
        return tree.typed(path) or ""
    parts = {str(key): written(tree, (*path, key)) for key in value}
    head = []
    if {"from", "to"} <= parts.keys():
        head.append(say("from {least} to {most}", least=parts.pop("from"), most=parts.pop("to")))
    if law := parts.pop("distribution", ""):
        head.append(law)
    if "table" in parts:
        table, column = parts.pop("table"), parts.pop("column", "")
        template = "column {column} of the table {table}" if column else "the table {table}"
        head.append(say(template, column=column, table=table))
    return ", ".join([*head, *(f"{key} {text}" for key, text in parts.items())])


# --- the whole page --------------------------------------------------------------------------------------------------

SAMPLED = 1_500  # variants in the charts of points
# numbers that the page carries for the chart of any two quantities, and variants of them at least
MAX_NUMBERS, MIN_DRAWN = 200_000, 400
TARGETS, MAX_TARGETS = 5, 12  # quantities that influence is reported of, and with the outputs that the study asks for
# histograms, checks of them, ranges, quantities of charts
MAX_PANELS, MAX_CHECKS, MAX_RANGES, MAX_QUANTITIES = 12, 4, 36, 30


@dataclass
class Summary:
    """Hold what the template of the summary shows."""

    title: str
    folder: str
    study: Any
    files: list[tuple[str, str]]
    checks: dict[str, str]
    total: int
    statuses: dict[str, int]
    facts: list[tuple[str, str]]
    asked: Asked | None
    failures: list[data.Utilisation]
    governing: list[data.Governing]
    passing: list[data.PassingValues]
    utilisations: list[data.Utilisation]
    unmade: list[str]
    proved: int  # variants whose verdict is pass
    unchecked: int
    assumed: int
    idle: int
    matrices: list[best.Matrix]
    is_whole: bool
    spreads: list[data.Spread]
    more_spreads: int
    reasons: list[data.Reason]
    reports: list[best.MatrixRow]
    more_reports: int
    front: best.Front | None
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
        """Return what the whole looks like: the best verdict on a variant, by formulas without faults."""
        if self.proved and not self.doubtful:
            return "pass"
        return "conditional" if self.sound else "fail"


def content(stored: Stored, discovery: Discovery) -> Summary:
    data.prepare(stored)
    states = data.statuses(stored)
    total = sum(states.values())
    goals = best.objectives(stored)
    aims = [goal.column for goal in goals]
    shares = [data.WORST, *(value for value, _ in stored.checks.values())] if stored.checks else []
    spreads = data.spreads(stored, list(dict.fromkeys([*stored.varied, *stored.outputs, *aims, *shares])), total)
    front = best.front(stored, goals, states["pass"] + states["warn"])
    varying = [spread.column for spread in spreads.values() if _is_telling(spread)]
    used = data.utilisations(stored)
    made, failures = [row for row in used if row.is_made], data.failures(stored, used)
    fixed = {name for name, spread in spreads.items() if not spread.varies}
    still = {check for check, (each, _) in stored.checks.items() if each.name in fixed}
    governing = data.governing(stored, still)
    main, asked = _main(stored, aims, varying, used)
    found = best.influences(stored, main[: min(TARGETS + len(asked), MAX_TARGETS)])
    inputs = [column for column in stored.varied if column in varying or column.kind in ("text", "bool")]
    choices = list(dict.fromkeys([*inputs, *main]))
    sample = data.sample(stored, choices[:MAX_QUANTITIES], SAMPLED)
    drawn = min(SAMPLED, max(MIN_DRAWN, MAX_NUMBERS // max(1, len(choices))))
    first, reports = [int(variant) for variant in front.variants] if front else [], best.reported(stored.folder)
    ranges = [spreads[c.name] for c in (*stored.varied, *main) if c in varying and ".checks." not in c.name]
    # the quantities of histograms: objectives, utilisations of failing and governing checks, inputs, then the others
    limiting = dict.fromkeys([*(row.check for row in failures), *(row.check for row in governing)])
    limits = [stored.checks[check][0] for check in limiting if check in stored.checks]
    drawable = dict.fromkeys([*aims, data.WORST, *limits[:MAX_CHECKS], *stored.varied, *limits, *varying])
    panels = [spreads[column.name] for column in drawable if column in varying][:MAX_PANELS]
    groups, shown, matrix = best.chosen(stored, total, first), best.columns(stored, goals), best.telling(made)
    base = _parsed(stored.description.base)
    return Summary(
        title=_title(stored, base), folder=printable(stored.folder.resolve().name), study=stored.study, files=_files(stored),
        checks={check: said(stored.check_label(check)) for check in stored.checks},
        total=total, statuses=states, facts=list(_facts(stored, total)), asked=asked_questions(stored),
        failures=failures, governing=governing, passing=data.passing_values(stored),
        utilisations=made, unmade=[row.check for row in used if not row.is_made],
        proved=data.proved(stored), unchecked=sum(row.unchecked > 0 for row in used), assumed=_assumed(base.data if base else None),
        idle=len(made) - len(matrix), matrices=list(best.matrices(stored, groups, [row.check for row in matrix])),
        is_whole=total <= best.ALL,
        spreads=ranges[:MAX_RANGES], more_spreads=max(0, len(ranges) - MAX_RANGES),
        reasons=data.reasons(stored, discovery) if states["error"] else [],
        reports=best.reports(stored, reports[: best.MAX_REPORTS]), more_reports=max(0, len(reports) - best.MAX_REPORTS),
        front=front, best_head=[data.titled(column) for column in shown], best=best.best(stored, first[: best.BEST], shown),
        is_sobol=best.is_saltelli(stored), ranked=ranked(found) if found else None,
        slow=dict(stored.study.get("slow") or {}), doubtful=list(stored.study.get("doubtful") or ()),
        figures=Figures(stored, states, sample, front, main, spreads).all(failures, panels, found),
        any_two=data.sample(stored, choices, drawn), varied=stored.varied, choices=choices,
    )  # fmt: skip


def _main(
    stored: Stored, aims: list[StoredColumn], varying: list[StoredColumn], used: list[data.Utilisation]
) -> tuple[list[StoredColumn], list[StoredColumn]]:
    """Return what matters, the first most, and of it the outputs that the study file asks for by their names.

    These are objectives, utilisation of all checks, outputs that are asked for, checks that fail most, others.
    """
    study = _parsed(stored.description.study)
    wanted = {str(name) for name in study.data.get("outputs") or ()} if study else set()
    asked = [column for column in varying if column.name in wanted]
    failing = [stored.checks[row.check][0] for row in used if row.failing or row.warning]
    outputs = [column for column in varying if column not in stored.varied]
    return [
        column for column in dict.fromkeys([*aims, data.WORST, *asked, *failing, *outputs]) if column in varying
    ], asked


def _is_telling(spread: data.Spread) -> bool:
    """Return whether a quantity varies; a utilisation that is next to nothing tells nothing."""
    return spread.varies and (".checks." not in spread.column.name or spread.values[-1] > best.IDLE)


def _facts(stored: Stored, total: int) -> Iterator[tuple[str, str]]:
    counts = stored.study.get("counts") or {}
    yield say("Variants calculated"), data.variants(total)
    yield say("Varied"), say_counted(len(stored.varied), "{n} input", "{n} inputs")
    if counts.get("dropped"):
        yield say("Excluded by constraints"), _dropped(counts)
    found = data.margin(stored) if stored.checks else None
    if found is not None:
        variant, utilisation, governing, shared = found
        others = shared - 1
        words = ", and {n} other variant with the same", ", and {n} other variants with the same"
        more = say_counted(others, *words, n=number(str(others))) if others else ""
        check, used = said(stored.check_label(governing)), data.utilised(utilisation)
        template = "variant {n}{more}: utilisation {used} at most, by “{check}”"
        yield say("Largest margin"), say(template, n=variant, more=more, used=used, check=check)
    seconds = float(stored.study.get("seconds") or 0)
    if seconds > 0:
        yield say("Calculated in"), localised(f"{seconds:.3g} s")


def _title(stored: Stored, base: yaml.Tree | None) -> str:
    project = base.data.get("project") if base else None
    return str((project or {}).get("title") or printable(stored.description.study.file))


def _assumed(given: Any) -> int:
    parts = given.values() if isinstance(given, dict) else given if isinstance(given, list) else ()
    return (isinstance(given, dict) and given.get("basis") == ASSUMED) + sum(map(_assumed, parts))


def _files(stored: Stored) -> list[tuple[str, str]]:
    made = stored.description
    code = [(say("the source of the {name}", name=source_name(name)), digest) for name, digest in made.sources.items()]
    return [*((printable(source.file), source.sha256) for source in (made.study, made.base, *made.tables)), *code]


DIGITS = 4  # of the numbers that a browser draws


def page(summary: Summary, kind: str = "screen") -> str:
    """Return the summary as one self-contained HTML page."""

    def figure(key: str | SummaryFigure) -> Markup:
        return figure_markup(kind, summary.figures[key] if isinstance(key, str) else key)

    return styled_page(
        "summary.html.j2", kind, ("summary",), _script(), s=summary, figure=figure,
        points=Markup(_points(summary)) if kind == "screen" else "", named=data.named, titled=data.titled, display=data.display,
        counted=data.counted, variants=data.variants, percent=data.percent, utilised=data.utilised, number=number, pretty=pretty, localised=localised,
    )  # fmt: skip


def _script() -> str:
    """Return the page's own script, to the letter: it is no template, and all that it tells of a study is data beside it."""
    found = re.search(r"<script>(.*?)</script>", html._read("summary_scatter.html.j2"), re.DOTALL)
    assert found is not None
    return found[1]


def figure_markup(kind: str, figure: SummaryFigure) -> Markup:
    """Return a chart inline on the screen, as an image with its alternative on paper."""
    if kind == "screen":
        return Markup(figure.svg.text)  # matplotlib escapes the texts within the drawing
    content = base64.b64encode(figure.svg.text.encode()).decode()
    return Markup('<img src="data:image/svg+xml;base64,{}" alt="{}">').format(content, figure.alternative)


def _points(summary: Summary) -> str:
    """Return the sample for the page's own chart of any two quantities, in display units, as JSON that cannot end a script."""
    sample, choices = summary.any_two, summary.choices
    template = (
        "{y} over {x}: {n} of {total} variants are drawn; dots pass, triangles have a warning, crosses fail. "
        "A point names its variant."
    )
    made = {
        "words": {
            "decimal": decimal_sign(),
            "states": [said(data.WORDS[status]) for status in ("pass", "warn", "fail")],
            "point": say("variant {n}, {status}"),
            "over": say("{y} over {x}"),
            "told": say(template),
        },
        "upwards": next((n for n, column in enumerate(choices) if column not in summary.varied), len(choices) - 1),
        "total": summary.total,
        "variants": sample.variants.tolist(),
        "status": sample.status.tolist(),
        "columns": [
            {
                "title": data.titled(column),
                "words": sample.words.get(column.name),
                "values": [_short(value, column) for value in sample.values[column.name]],
            }
            for column in choices
        ],
    }
    return json.dumps(made, ensure_ascii=False, allow_nan=False).replace("<", "\\u003c")


def _short(value: float, column: StoredColumn) -> float | None:
    return float(f"{value / unit(column.display).factor:.{DIGITS}g}") if math.isfinite(value) else None
