"""An optimisation as HTML (one file, no network, no scripts) and as PDF, in the look of a study's summary."""

from __future__ import annotations

import base64
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

from markupsafe import Markup

import diecut_report.report.figures  # noqa: F401  # before Matplotlib, for its settings
from diecut_report import __version__
from diecut_report.config import yaml_tree
from diecut_report.files import room
from diecut_report.languages.phrases import capital
from diecut_report.languages.speech import localised, said, say, say_counted, spoken_language
from diecut_report.optimisation import charts, texts
from diecut_report.optimisation.front import columns_shown
from diecut_report.optimisation.generation import asked_of
from diecut_report.optimisation.result import OptimisationResult
from diecut_report.report import html, pdf
from diecut_report.report.i18n import Catalogue
from diecut_report.report.number_format import number
from diecut_report.report.page_engine import HTML, URLFetcher
from diecut_report.study.summary import matrix, questions
from diecut_report.study.summary.figures import SummaryFigure
from diecut_report.study.summary.quantity_names import display, named, titled, utilised, value_told


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
    fetcher = URLFetcher(allowed_protocols={"data"}, allow_redirects=False, fail_on_errors=True)
    with room(), pdf._without_collection():
        content: bytes = HTML(string=_filled(found, "print"), url_fetcher=fetcher).write_pdf(pdf_variant="pdf/ua-1")
    return content


def _filled(found: OptimisationResult, kind: str) -> str:
    styles = ("report", kind, *(["strip"] if kind == "print" else []), "summary", "optimisation")
    style = "\n".join([html._font_faces(tuple(html.FACES.items())), *(html._read(f"{name}.css") for name in styles)])
    asked = asked_of(found.study)
    return html._environment().get_template("optimisation.html.j2").render(
        r=found, o=asked, t=Catalogue(spoken_language()), language=spoken_language(), kind=kind, policy=html.policy(),
        style=Markup(style), version=__version__, title=_title(found), figure=partial(_figure, kind), figures=_figures(found),
        asked=questions.asked(found.stored), heads=[titled(column) for column in columns_shown(found.front)],
        goals=[goal.told for goal in found.front.objectives], rows=[_row(found, place) for place in found.front.listed],
        counts=capital(texts.counts(found)), suggested=capital(texts.suggested(found)), today=capital(texts.today(found, named)),
        held=_held(found), rechecked=[capital(line) for line in texts.recheck_lines(found)],
        conflict=list(texts.conflict_lines(found, found.conflict)) if found.conflict else [],
        words=[each for each in found.bounds if each.is_text], told=said, named=named, number=number, say=say, counted=_counted,
        files=_files(found), localised=localised, value_told=value_told,
        example=int(found.front.variants[found.front.suggested or 0]) if found.conflict is None else found.conflict.nearest,
    )  # fmt: skip


def _counted(one: str, many: str, count: int, **more: object) -> str:
    """What a template says of a number of things."""
    return say_counted(count, one, many, n=number(str(count)), **more)


def _title(found: OptimisationResult) -> str:
    """The title of the base's project, else the study's file."""
    content = found.stored.description.base.content
    project = yaml_tree.parse(content.decode(), "base").data.get("project") if content else None
    return str((project or {}).get("title") or found.stored.description.study.file)


def _files(found: OptimisationResult) -> list[tuple[str, str]]:
    """The files that the study was made from, with their SHA-256."""
    made = found.stored.description
    return [(source.file, source.sha256) for source in (made.study, made.base, *made.tables)]


def _row(found: OptimisationResult, place: int) -> PageRow:
    variant, status, governing, *values = texts.row(found, place)
    check = governing or ""
    used = ""
    if check in found.stored.checks:
        ((ratio,),) = found.stored.rows(
            f"SELECT {found.stored.checks[check][0].sql} FROM v WHERE variant = ?", [variant]
        )
        used = f"{utilised(ratio)} " if ratio is not None else ""
    shown = [
        display(value, column) if column.is_number else value_told(value)
        for value, column in zip(values, columns_shown(found.front), strict=True)
    ]
    told = used + (said(found.stored.check_told(check)) if check else "–")
    is_suggested = not found.front.is_single and place == found.front.suggested
    return PageRow(variant, matrix.report_of(found.stored.folder, variant), status, told, shown, is_suggested)


def _held(found: OptimisationResult) -> list[str]:
    told = (texts.held(each, found.front.is_single) for each in found.bounds)
    return [said(line) for line in told if line]


def _figures(found: OptimisationResult) -> dict[str, SummaryFigure]:
    """The charts that there is something for, by their keys."""
    if found.conflict is not None:
        return {}
    goals = found.front.objectives
    listed = [each for each in found.bounds if not each.is_text]
    parts: dict[str, Callable[[], SummaryFigure]] = {"progress": lambda: _progress(found)}
    if len(goals) > 1:
        parts["front"] = lambda: _front(found)
    if listed:
        told = "; ".join(_held(found)) or say("No point stands at an end of a range.")
        caption = say(
            "Where the points of the front lie between the ends of what was searched; a red bar is an end that holds some."
        )
        parts["bounds"] = lambda: SummaryFigure(charts.bounds(listed, told), caption, told)
    return {key: make() for key, make in parts.items()}


def _front(found: OptimisationResult) -> SummaryFigure:
    goals = " / ".join(named(goal.column) for goal in found.front.objectives)
    words = "The front over each pair of objectives: {goals}; {n} machines on it."
    told = say(words, goals=goals, n=len(found.front.variants))
    caption = say(
        "What was tried and the front: a machine on it is bettered by no other. Machines far from it lie outside."
    )
    return SummaryFigure(charts.front(found.front, found.known, told), caption, told)


def _progress(found: OptimisationResult) -> SummaryFigure:
    gained, tried = found.progress.last_gain, found.tried
    told = say(
        "The last thousandth was gained after {n} of {all} machines.", n=number(str(gained)), all=number(str(tried))
    )
    if gained > 0.9 * tried and not found.is_all:
        told += " " + say("The search was still gaining: more evaluations may find more.")
    return SummaryFigure(charts.progress(found.progress, found.front.objectives, told), told, told)


def _figure(kind: str, fig: Any) -> Markup:
    """A chart inline on the screen, as an image with its alternative on paper."""
    if kind == "screen":
        return Markup(fig.svg.text)  # matplotlib escapes the texts within the drawing
    content = base64.b64encode(fig.svg.text.encode()).decode()
    return Markup('<img src="data:image/svg+xml;base64,{}" alt="{}">').format(content, fig.alternative)
