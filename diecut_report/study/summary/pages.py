"""The summary of a study as HTML, for the screen and for paper."""

from __future__ import annotations

import base64
import json
import math
import re
from functools import partial
from typing import Any

from markupsafe import Markup

from diecut_report.quantities.units import pretty, unit
from diecut_report.report.pages import html
from diecut_report.report.pages.html import styled_page
from diecut_report.report.text import number
from diecut_report.study.analysis.variants import StoredColumn
from diecut_report.study.summary.content import Summary
from diecut_report.study.summary.data import WORDS, counted, display, named, percent, titled, utilised, variants
from diecut_report.text.translation import decimal_sign, localised, said, say

DIGITS = 4  # of the numbers that a browser draws


def page(summary: Summary, kind: str = "screen") -> str:
    """Return the summary as one self-contained HTML page."""
    return styled_page(
        "summary.html.j2", kind, ("summary",), _script(), s=summary, figure=partial(_figure, summary, kind),
        points=Markup(_points(summary)) if kind == "screen" else "", named=named, titled=titled, display=display,
        counted=counted, variants=variants, percent=percent, utilised=utilised, number=number, pretty=pretty, localised=localised,
    )  # fmt: skip


def _script() -> str:
    """Return the page's own script, to the letter: it is no template, and all that it tells of a study is data beside it."""
    found = re.search(r"<script>(.*?)</script>", html._read("summary_scatter.html.j2"), re.DOTALL)
    assert found is not None
    return found[1]


def _figure(summary: Summary, kind: str, key: str | Any) -> Markup:
    """Return a chart inline on the screen, as an image with its alternative on paper."""
    figure = summary.figures[key] if isinstance(key, str) else key
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
    data = {
        "words": {
            "decimal": decimal_sign(),
            "states": [said(WORDS[status]) for status in ("pass", "warn", "fail")],
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
                "title": titled(column),
                "words": sample.words.get(column.name),
                "values": [_short(value, column) for value in sample.values[column.name]],
            }
            for column in choices
        ],
    }
    return json.dumps(data, ensure_ascii=False, allow_nan=False).replace("<", "\\u003c")


def _short(value: float, column: StoredColumn) -> float | None:
    return float(f"{value / unit(column.display).factor:.{DIGITS}g}") if math.isfinite(value) else None
