"""The summary of a study as HTML and PDF."""

from __future__ import annotations

import base64
import json
import math
import re
from functools import partial
from typing import Any

from markupsafe import Markup

from diecut_report import __version__
from diecut_report.files import room
from diecut_report.quantities.units import pretty, unit
from diecut_report.report.pages import html, pdf
from diecut_report.report.pages.page_engine import HTML, URLFetcher
from diecut_report.report.text import Catalogue, number
from diecut_report.study.analysis.variants import StoredColumn
from diecut_report.study.summary.content import Summary
from diecut_report.study.summary.data import (
    WORDS,
    display,
    named,
    percent,
    titled,
    utilised,
    variants,
)
from diecut_report.text.translation import decimal_sign, localised, said, say, say_counted, spoken_language

DIGITS = 4  # of the numbers that a browser draws


def page(summary: Summary) -> str:
    """Return the summary as one self-contained HTML page."""
    return _filled(summary, "screen")


def sheets(summary: Summary) -> bytes:
    """Return the summary as PDF (A4, PDF/UA-1)."""
    fetcher = URLFetcher(allowed_protocols={"data"}, allow_redirects=False, fail_on_errors=True)
    source = _filled(summary, "print")
    with room(), pdf._without_collection():
        content: bytes = HTML(string=source, url_fetcher=fetcher).write_pdf(pdf_variant="pdf/ua-1")
    return content


def _filled(summary: Summary, kind: str) -> str:
    style = "\n".join(
        [
            html._font_faces(tuple(html.FACES.items())),
            *(
                html._read(f"{name}.css")
                for name in ("report", kind, *(["strip"] if kind == "print" else []), "summary")
            ),
        ]
    )
    return html._environment().get_template("summary.html.j2").render(
        s=summary, t=Catalogue(spoken_language()), language=spoken_language(), kind=kind, policy=html.policy(_script()),
        style=Markup(style), version=__version__, figure=partial(_figure, summary, kind),
        points=Markup(_points(summary)) if kind == "screen" else "", named=named, titled=titled, display=display,
        counted=_counted, variants=variants, percent=percent, utilised=utilised, number=number, pretty=pretty, say=say, localised=localised,
    )  # fmt: skip


def _counted(one: str, many: str, count: int, **named: object) -> str:
    """What a template says of a number of things."""
    return say_counted(count, one, many, n=number(str(count)), **named)


def _script() -> str:
    """The page's own script, to the letter: it is no template, and all that it tells of a study is data beside it."""
    found = re.search(r"<script>(.*?)</script>", html._read("summary_scatter.html.j2"), re.DOTALL)
    assert found is not None
    return found[1]


def _figure(summary: Summary, kind: str, key: str | Any) -> Markup:
    """A chart inline on the screen, as an image with its alternative on paper."""
    figure = summary.figures[key] if isinstance(key, str) else key
    if kind == "screen":
        return Markup(figure.svg.text)  # matplotlib escapes the texts within the drawing
    content = base64.b64encode(figure.svg.text.encode()).decode()
    return Markup('<img src="data:image/svg+xml;base64,{}" alt="{}">').format(content, figure.alternative)


def _points(summary: Summary) -> str:
    """The sample for the page's own chart of any two quantities, in display units, as JSON that cannot end a script."""
    sample = summary.any_two
    columns = [
        {
            "title": titled(column),
            "words": sample.words.get(column.name),
            "values": [_short(v, column) for v in sample.values[column.name]],
        }
        for column in summary.choices
    ]
    upwards = next(
        (index for index, column in enumerate(summary.choices) if column not in summary.varied), len(columns) - 1
    )
    data = {
        "words": {
            "decimal": decimal_sign(),
            "states": [said(WORDS[status]) for status in ("pass", "warn", "fail")],
            "point": say("variant {n}, {status}"),
            "over": say("{y} over {x}"),
            "told": say(
                "{y} over {x}: {n} of {total} variants are drawn; dots pass, triangles have a warning, crosses fail. "
                "A point names its variant."
            ),
        },
        "upwards": upwards,
        "total": summary.total,
        "variants": sample.variants.tolist(),
        "status": sample.status.tolist(),
        "columns": columns,
    }
    text = json.dumps(data, ensure_ascii=False, allow_nan=False)
    return text.replace("<", "\\u003c")


def _short(value: float, column: StoredColumn) -> float | None:
    return float(f"{value / unit(column.display).factor:.{DIGITS}g}") if math.isfinite(value) else None
