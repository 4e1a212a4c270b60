"""What matters, told: as text, as plain data, and as a page with its figures."""

from __future__ import annotations

import html
import math
from collections.abc import Iterator, Sequence
from typing import Any

from diecut_report import __version__
from diecut_report.design.influence import IN_TOLERANCE, Chance, InputEffect, Tolerances, Tornado
from diecut_report.languages.phrases import Counted, Phrase, joined, phrase
from diecut_report.languages.speech import decimal_sign, localised, said, say, spoken_language
from diecut_report.quantities.units import pretty, unit

SHOWN = 10  # inputs of a tornado
PAGE = """<!doctype html>
<html lang="{language}"><head><meta charset="utf-8"><title>{title}</title>
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'unsafe-inline'; font-src data:">
<style>{faces}
body{{font:15px/1.5 sans-serif;max-width:52rem;margin:2rem auto;padding:0 1rem;color:#1d252c}}svg{{max-width:100%;height:auto}}
pre{{white-space:pre-wrap;background:#f3f5f7;padding:.7rem}}footer{{color:#5a6771;font-size:.85em}}</style></head><body>
<h1>{title}</h1>
{body}
<footer>diecut-report {version}</footer></body></html>
"""


def lines(found: Sequence[Tornado], tolerances: Tolerances | None, option: str = "--defaults") -> Iterator[str]:
    """Yield what moves each number most, and how probable it is that the checks hold; ``option`` is what changes defaults too."""
    for each in found:
        yield from _tornado(each)
    yield from _left_out(found, option)
    if tolerances is not None:
        yield from _tolerances(tolerances)


def _tornado(found: Tornado) -> Iterator[Phrase]:
    asked = found.asked
    yield Phrase("{asked}, today {value}", asked=asked.name, value=localised(asked.told(found.today, 4)))
    bars = found.bars[:SHOWN]
    width = max((len(each.design.name) for each in bars), default=0)
    for each in bars:
        ends = {
            "low": localised(each.design.told(each.lowered, 4)),
            "high": localised(each.design.told(each.raised, 4)),
        }
        gives = {"first": _value(found, each.low), "second": _value(found, each.high)}
        yield Phrase(
            "  {input}  {low} … {high}: {first} … {second}", input=each.design.name.ljust(width), **ends, **gives
        )
    more = len(found.bars) - len(bars)
    rest = [Phrase("{n} more move it less", n=more)] if more else []
    rest += [Phrase("{n} do not move it", n=found.still)] if found.still else []
    yield Phrase("  {rest}", rest=joined(rest, ", ") or phrase("no other input moves it"))


def _left_out(found: Sequence[Tornado], option: str) -> Iterator[Phrase]:
    """How many inputs nobody gave, so that they were not changed."""
    if left := max((each.at_default for each in found), default=0):
        one = "{n} input stands at its default and is not changed; {option} changes it too"
        many = "{n} inputs stand at their default and are not changed; {option} changes them too"
        yield Counted(left, one, many, option=option)


def _value(found: Tornado, value: float) -> str:
    return phrase("no machine") if math.isnan(value) else localised(found.asked.told(value, 4))


def _tolerances(found: Tolerances) -> Iterator[Phrase]:
    is_normal = found.distribution == "normal"
    way = Phrase("normal, {n} standard deviations", n=f"{IN_TOLERANCE:g}") if is_normal else phrase("uniform")
    given = ", ".join(
        f"{each.name} {localised(each.told(each.today or 0.0))} ± {localised(each.told(size))}"
        for each, size in found.by_input.items()
    )
    words = "within tolerances ({way}; {n} machines, seed {seed}): {inputs}"
    yield Phrase(words, way=way, n=found.count, seed=found.seed, inputs=given)
    yield Phrase("  no check fails: {chance}", chance=_chance(found.whole))
    unsure = [each for each in found.chances if each.held < each.count]
    width = max((len(each.check) for each in unsure), default=0)
    yield from (Phrase("  {check}  {chance}", check=each.check.ljust(width), chance=_chance(each)) for each in unsure)
    yield Phrase("  {n} checks hold in all of them", n=len(found.chances) - len(unsure))


def _chance(found: Chance) -> Phrase:
    shares = {"share": found.probability, "low": found.low, "high": found.high}
    percents = {name: localised(f"{100 * value:.4g}") for name, value in shares.items()}
    return Phrase("{share} % (95 %: {low} … {high} %), {n} of {total}", n=found.held, total=found.count, **percents)


def data(found: Sequence[Tornado], tolerances: Tolerances | None) -> dict[str, Any]:
    """Return the same as plain data, SI."""
    return {
        "schema_version": 1,
        "tornados": [
            {"name": each.asked.name, "unit": each.asked.si, "today": each.today, "bars": [_bar(bar) for bar in each.bars], "still": each.still,
             "at_default": each.at_default}
            for each in found
        ],
        "tolerances": None if tolerances is None else {
            "inputs": {each.asked.path: size for each, size in tolerances.by_input.items()},
            "distribution": tolerances.distribution, "seed": tolerances.seed, "count": tolerances.count,
            "no_check_fails": _plain(tolerances.whole), "checks": [_plain(each) for each in tolerances.chances],
        },
    }  # fmt: skip


def _bar(bar: InputEffect) -> dict[str, Any]:
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
        text = "\n".join(map(said, _tornado(each)))
        figure = (
            tornado(
                each.today / factor,
                bars,
                say("Influence of inputs on {asked}", asked=each.asked.name),
                f"tornado-{index}",
                decimal_sign(),
            ).text
            if bars
            else ""
        )
        words = "In {unit}; blue: with the input raised, brown: lowered; ×: there is no such machine; the line: today."
        caption = say(words, unit=pretty(each.asked.unit) or phrase("a share"))
        below = f"<p>{html.escape(caption)}</p>\n<pre>{html.escape(text)}</pre>"
        parts.append(f"<h2>{html.escape(each.asked.name)}</h2>\n{figure}\n{below}")
    parts += [f"<p>{html.escape(said(each))}</p>" for each in _left_out(found, "--defaults")]
    if tolerances is not None:
        parts.append(
            f"<h2>{say('Tolerances')}</h2>\n<pre>"
            + html.escape("\n".join(map(said, _tolerances(tolerances))))
            + "</pre>"
        )
    title = html.escape(say("What matters: {file}", file=name))
    return PAGE.format(title=title, body="\n".join(parts), faces=faces, version=__version__, language=spoken_language())
