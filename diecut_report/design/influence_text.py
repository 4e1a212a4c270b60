"""What matters, told: as text, as plain data, and as a page with its figures."""

from __future__ import annotations

import html
import math
from collections.abc import Iterator, Sequence
from typing import Any

from diecut_report import __version__
from diecut_report.design.influence import IN_TOLERANCE, Bar, Chance, Tolerances, Tornado
from diecut_report.quantities.units import pretty, unit

SHOWN = 10  # inputs of a tornado
CAPTION = "In {unit}; blue: with the input raised, brown: lowered; ×: there is no such machine; the line: today."
PAGE = """<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>{title}</title>
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'unsafe-inline'; font-src data:">
<style>{faces}
body{{font:15px/1.5 sans-serif;max-width:52rem;margin:2rem auto;padding:0 1rem;color:#1d252c}}svg{{max-width:100%;height:auto}}
pre{{white-space:pre-wrap;background:#f3f5f7;padding:.7rem}}footer{{color:#5a6771;font-size:.85em}}</style></head><body>
<h1>{title}</h1>
{body}
<footer>diecut-report {version}</footer></body></html>
"""


def lines(found: Sequence[Tornado], tolerances: Tolerances | None) -> Iterator[str]:
    """Yield what moves each number most, and how probable it is that the checks hold."""
    for each in found:
        yield from _tornado(each)
    if tolerances is not None:
        yield from _tolerances(tolerances)


def _tornado(found: Tornado) -> Iterator[str]:
    asked = found.asked
    yield f"{asked.name}, today {asked.told(found.today, 4)}"
    bars = found.bars[:SHOWN]
    width = max((len(each.design.name) for each in bars), default=0)
    for each in bars:
        low, high = each.design.told(each.lowered, 4), each.design.told(each.raised, 4)
        yield f"  {each.design.name.ljust(width)}  {low} … {high}: {_value(found, each.low)} … {_value(found, each.high)}"
    more = len(found.bars) - len(bars)
    rest = [f"{more} more move it less" if more else "", f"{found.still} do not move it" if found.still else ""]
    yield f"  {', '.join(filter(None, rest)) or 'no other input moves it'}"


def _value(found: Tornado, value: float) -> str:
    return "no machine" if math.isnan(value) else found.asked.told(value, 4)


def _tolerances(found: Tolerances) -> Iterator[str]:
    way = f"normal, {IN_TOLERANCE:g} standard deviations" if found.distribution == "normal" else "uniform"
    given = ", ".join(
        f"{each.name} {each.told(each.today or 0.0)} ± {each.told(size)}" for each, size in found.by_input.items()
    )
    yield f"within tolerances ({way}; {found.count} machines, seed {found.seed}): {given}"
    yield f"  no check fails: {_chance(found.whole)}"
    unsure = [each for each in found.chances if each.held < each.count]
    width = max((len(each.check) for each in unsure), default=0)
    yield from (f"  {each.check.ljust(width)}  {_chance(each)}" for each in unsure)
    yield f"  {len(found.chances) - len(unsure)} checks hold in all of them"


def _chance(found: Chance) -> str:
    return f"{100 * found.probability:.4g} % (95 %: {100 * found.low:.4g} … {100 * found.high:.4g} %), {found.held} of {found.count}"


def data(found: Sequence[Tornado], tolerances: Tolerances | None) -> dict[str, Any]:
    """Return the same as plain data, SI."""
    return {
        "schema_version": 1,
        "tornados": [
            {"name": each.asked.name, "unit": each.asked.si, "today": each.today, "bars": [_bar(bar) for bar in each.bars], "still": each.still}
            for each in found
        ],
        "tolerances": None if tolerances is None else {
            "inputs": {each.asked.path: size for each, size in tolerances.by_input.items()},
            "distribution": tolerances.distribution, "seed": tolerances.seed, "count": tolerances.count,
            "no_check_fails": _plain(tolerances.whole), "checks": [_plain(each) for each in tolerances.chances],
        },
    }  # fmt: skip


def _bar(bar: Bar) -> dict[str, Any]:
    numbers = {"low": bar.low, "high": bar.high}
    ends = {
        "path": bar.design.asked.path,
        "unit": bar.design.meta.parsed_unit.si,
        "lowered": bar.lowered,
        "raised": bar.raised,
    }
    return ends | {name: None if math.isnan(value) else value for name, value in numbers.items()}


def _plain(found: Chance) -> dict[str, Any]:
    return {
        "check": found.check,
        "held": found.held,
        "count": found.count,
        "probability": found.probability,
        "interval": [found.low, found.high],
    }


def page(found: Sequence[Tornado], tolerances: Tolerances | None, name: str) -> str:
    """Return the same as one HTML file without scripts or network, with a figure for each number."""
    from diecut_report.report import html as report_html
    from diecut_report.report.figures.tornado import tornado

    faces = report_html._font_faces(tuple(report_html.FACES.items()))
    parts = []
    for index, each in enumerate(found):
        factor = unit(each.asked.unit).factor
        bars = [
            {"label": bar.design.name}
            | {
                side: None if math.isnan(value) else value / factor
                for side, value in (("low", bar.low), ("high", bar.high))
            }
            for bar in each.bars[:SHOWN]
        ]
        text = "\n".join(_tornado(each))
        figure = (
            tornado(each.today / factor, bars, f"Influence of inputs on {each.asked.name}", f"tornado-{index}").text
            if bars
            else ""
        )
        caption = CAPTION.format(unit=pretty(each.asked.unit) or "a share")
        words = f"<p>{caption}</p>\n<pre>{html.escape(text)}</pre>"
        parts.append(f"<h2>{html.escape(each.asked.name)}</h2>\n{figure}\n{words}")
    if tolerances is not None:
        parts.append("<h2>Tolerances</h2>\n<pre>" + html.escape("\n".join(_tolerances(tolerances))) + "</pre>")
    title = f"What matters: {html.escape(name)}"
    return PAGE.format(title=title, body="\n".join(parts), faces=faces, version=__version__)
