"""The gallery: a page of each kind of mechanism, made of what its plugin declares and of an example that has it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from markupsafe import escape

from diecut_report.mechanism.chapters import Chapter
from diecut_report.mechanism.checks import Check
from diecut_report.mechanism.mechanism import Mechanism
from diecut_report.mechanism.steps import (
    Abscissa,
    Breakpoints,
    Clash,
    FromCurve,
    Interpolated,
    Lookup,
    Phase,
    Pick,
    Prepared,
    Require,
    Step,
    Words,
)
from diecut_report.quantities.formatting import NAMED
from diecut_report.quantities.units import pretty
from diecut_report.report.figures.style import Svg
from diecut_report.standards.tables import StandardSeries, StandardTable
from diecut_report.text.catalogues import Catalogues
from tools.make_mechanism_pages import check_id, choices, input_rows, output_rows
from tools.site.examples import Shown, block, drawn
from tools.site.formulas import Formulas
from tools.site.markup import bullets, code, contents, fenced, html, plain, section, symbols, table
from tools.site.sources import Sources

Sketch = tuple[Svg, str]  # with its caption
UKRAINIAN = Catalogues("uk")
UNTOLD = (Breakpoints, Clash, Phase, Prepared, Words)  # what a reader of formulas does not miss
SAID = {"above": "the next value at or above", "below": "the next value at or below", "nearest": "the value nearest to"}


def add_gallery(sources: Sources, mechanisms: list[Mechanism], shown: Mapping[str, Shown]) -> None:
    """Add the overview and the page of each mechanism."""
    figures = {kind: found for kind, each in shown.items() if (found := drawn(each))}
    for each in mechanisms:
        sources.page(f"gallery/{each.kind}.md", page(each, shown.get(each.kind), figures.get(each.kind)))
    sources.page("gallery/index.md", _overview(mechanisms, figures))


def page(mechanism: Mechanism, shown: Shown | None, figure: Sketch | None) -> Iterator[str]:
    """Yield the page of a mechanism; ``shown`` is where an example has it, ``figure`` its sketch there."""
    yield from (f"# {plain(mechanism.title)}", "", f"`{mechanism.kind}`, version {mechanism.version}")
    ukrainian = _ukrainian(mechanism)
    yield from (f"· Ukrainian: *{plain(ukrainian)}*",) if ukrainian else ()
    yield from ("", plain(mechanism.summary))
    yield from _sketch(figure)
    yield from section("Inputs", _inputs(mechanism))
    yield from section("Example", _example(shown))
    yield from section("Formulas", _formulas(mechanism))
    yield from section("Outputs", _outputs(mechanism))
    yield from section("Checks", _checks(mechanism))
    yield from section("Phases", _phases(mechanism))
    yield from section("Assumptions", bullets(map(plain, mechanism.assumptions)))
    yield from section(
        "Errata in the sources", bullets(f"{plain(e.source)}: {plain(e.text)}" for e in mechanism.errata)
    )
    yield from section("Sources", bullets(f"{plain(s.id)}: {plain(s.citation)}" for s in mechanism.sources))


def _ukrainian(mechanism: Mechanism) -> str:
    found = UKRAINIAN.of(mechanism.kind)
    return (found and found.text(mechanism.title)) or ""


def _sketch(figure: Sketch | None) -> Iterator[str]:
    if figure:
        svg, caption = figure
        yield from html(f'<figure class="drawn"><div class="fig">{svg.text}</div></figure>')
        yield from (f"*{plain(caption)}*", "")


def _inputs(mechanism: Mechanism) -> Iterator[str]:
    head = ("key", "symbol", "unit", "default", "allowed", "meaning")
    rows = input_rows(mechanism.inputs)
    yield from table(
        head, ((code(r.key), symbols(r.symbol), r.unit, r.default, r.allowed, plain(r.meaning)) for r in rows), "inputs"
    )
    yield from choices(mechanism.inputs)


def _example(shown: Shown | None) -> Iterator[str]:
    if shown is None:
        return
    title = f"“{plain(shown.example.title)}” (`configs/{shown.example.name}.yaml`)"
    if not shown.is_own:
        yield f"It is calculated by itself in {title}, which has a mechanism of each of the kinds that it compares."
    else:
        yield f"In {title}:"
        yield from fenced("yaml", block(shown))
    if shown.example.report:
        yield from html(
            f'<p><a href="../reports/{shown.example.name}.html#m-{shown.letter}">Its chapter in the report</a></p>'
        )


def _formulas(mechanism: Mechanism) -> Iterator[str]:
    typeset = Formulas(mechanism)
    for chapter in mechanism.chapters:
        yield from section(plain(chapter.title), _chapter(chapter, typeset), 3)


def _chapter(chapter: Chapter, typeset: Formulas) -> Iterator[str]:
    """A chapter's words, and each step with how it is found."""
    yield from (plain(chapter.text), "") if chapter.text else ()
    needs = [code(key) for key in chapter.needs]
    yield from (f"Only with {', '.join(needs)}.", "") if needs else ()
    for step in chapter.steps:
        formulas = typeset.of(step)
        if formulas or not (isinstance(step, UNTOLD) or not step.description):
            yield from _step(step, formulas, typeset)


def _step(step: Step, formulas: list[str], typeset: Formulas) -> Iterator[str]:
    unit = pretty(step.unit)
    named = _must_hold(step) if isinstance(step, Require) else plain(step.description)
    told = [named, code(step.id), f"in {unit}" if unit and step.symbol else "", plain(_found(step, typeset))]
    told += [f"with {', '.join(map(code, step.needs))}"] if step.needs else []
    told += [f"without {', '.join(map(code, step.lacks))}"] if step.lacks else []
    told += [f"source: {plain(step.source)}"] if step.source else []
    yield from (" · ".join(filter(None, told)), "")
    if formulas:
        yield from html(*(f'<div class="eq">{formula}</div>' for formula in formulas))


def _must_hold(step: Require) -> str:
    """What is said where it does not hold, without its numbers."""
    words = NAMED.sub("…", step.message)
    return f"Must hold, else {code(step.key)} {plain(words)}"


def _found(step: Step, typeset: Formulas) -> str:
    """In words how a quantity is found that no formula tells."""
    match step:
        case Abscissa(period=period):
            return f"from 0 to {period if isinstance(period, str) else f'{period:g}'}"
        case FromCurve() if step.given:
            return f"the curve that {step.given} gives"
        case Interpolated(of=of):
            return f"between the rows of “{step.table.title}” by {typeset.symbol(of, step)}"
        case Lookup(by=by):
            return f"from {_titled(step.table)} by {by}"
        case Pick(of=of):
            return f"{SAID[step.rule]} {typeset.symbol(of, step)} of {_titled(step.series)}"
    return str(getattr(step, "method", ""))


def _titled(table: object) -> str:
    return f"“{table.title}”" if isinstance(table, StandardTable | StandardSeries) else "a table"


def _outputs(mechanism: Mechanism) -> Iterator[str]:
    yield "Units are those of the results file. What needs an input is there with it alone."
    head = ("id", "symbol", "unit", "meaning", "source", "needs")
    rows = output_rows(mechanism)
    yield from table(
        head, ((r.name, symbols(r.symbol), r.unit, plain(r.meaning), plain(r.source), r.needs) for r in rows), "outputs"
    )


def _checks(mechanism: Mechanism) -> Iterator[str]:
    yield from table(
        ("check", "class", "demanded", "is", "limited by", "where it fails", "source"),
        (
            (f"{plain(c.title)}<br>{code(check_id(c))}", c.check_class, plain(c.demand_label), _sign(c), plain(c.limit_label),
             plain(str(c.consequence)), plain(c.source))
            for c in mechanism.checks
        ),
        "checks",
    )  # fmt: skip


def _sign(check: Check) -> str:
    return "≤" if check.operator == "<=" else "\\<"


def _phases(mechanism: Mechanism) -> Iterator[str]:
    found = {step.id: step for _, step in mechanism.steps if isinstance(step, Phase)}
    yield from table(
        ("phase", "role", "meaning", "over", "from … to"),
        ((code(s.id), s.role, plain(s.description), code(s.abscissa), _ends(s)) for s in found.values()),
        "phases",
    )


def _ends(step: Phase) -> str:
    if step.union or step.rest_of:
        word = "together:" if step.union else "what is left by"
        return f"{word} {', '.join(code(name) for name in step.union or step.rest_of)}"
    return "; ".join(f"{code(str(start))} … {code(str(end))}" for start, end in step.spans)


def _overview(mechanisms: list[Mechanism], figures: Mapping[str, Sketch]) -> Iterator[str]:
    yield from (
        "# Gallery",
        "",
        "Each mechanism, made from what its plugin declares: its sketch, inputs, formulas, checks and sources.",
    )
    yield from html('<div class="cards">', *(_card(each, figures.get(each.kind)) for each in mechanisms), "</div>")
    yield from contents("", (each.kind for each in mechanisms))


def _card(mechanism: Mechanism, figure: Sketch | None) -> str:
    """A mechanism's place on the overview."""
    ukrainian = _ukrainian(mechanism)
    second = f'<span class="uk" lang="uk">{escape(ukrainian)}</span>' if ukrainian else ""
    picture = f'<span class="fig">{figure[0].text}</span>' if figure else ""
    title = f"{picture}<b>{escape(mechanism.title)}</b>{second}"
    return f'<a class="card" href="{mechanism.kind}.html">{title}<code>{mechanism.kind}</code></a>'
