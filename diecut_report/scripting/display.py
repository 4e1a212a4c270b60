"""What a notebook shows: the very texts, formulas and figures of a report, as HTML without scripts, on light and on dark paper."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from itertools import groupby
from typing import TYPE_CHECKING, Any, Protocol

from markupsafe import Markup

from diecut_report.languages.catalogues import SOURCE_LANGUAGE as ENGLISH
from diecut_report.languages.speech import said, speaking
from diecut_report.quantities.formatting import shown
from diecut_report.quantities.units import pretty
from diecut_report.report.html import Screen, filled_page
from diecut_report.report.i18n import Catalogue
from diecut_report.report.latex import Latex
from diecut_report.report.number_format import quantity
from diecut_report.report.scope import BRIEF, STANDARD
from diecut_report.report.symbols import symbol

if TYPE_CHECKING:
    from diecut_report.report.context import Material
    from diecut_report.report.model import PrintedChapter
    from diecut_report.scripting.printable import Printable
    from diecut_report.study.storage.description import ResultColumn


class DisplayedValue(Protocol):
    """Declare what is shown of a quantity."""

    @property
    def printed(self) -> tuple[str, str]: ...


TEMPLATE = "notebook.html.j2"
ROWS, COLUMNS = 12, 8  # of a table of machines


def results_html(results: Printable) -> str:
    """Return the verdict, what governs, and all checks."""
    material = results.material(BRIEF)
    return _page("results", material.words, doc=material.document)


def checks_html(results: Printable, names: set[str]) -> str:
    """Return some checks of results as a table."""
    material = results.material(STANDARD)
    rows = [row for part in material.document.chapters for row in part.checks if f"{row.mechanism}.{row.id}" in names]
    return _page("checks", material.words, rows=rows)


def mechanism_html(results: Printable, name: str) -> str:
    """Return a mechanism, or a comparison: key results, checks, its calculation with formulas and figures, results."""
    material = results.material(STANDARD, name)
    screen = Screen(material)
    return _page(
        "mechanism",
        material.words,
        c=_chapter(material, name),
        math=screen,
        figure=screen.figure,
        failed=material.failed,
    )


def _chapter(material: Material, name: str) -> PrintedChapter:
    return next(part for part in material.document.chapters if part.name == name)


def _page(part: str, words: Catalogue, **given: object) -> str:
    return filled_page(TEMPLATE, part=part, t=words, **given)


# --- inputs ----------------------------------------------------------------------------------------------------------


class ShownInput(Protocol):
    """Declare what is shown of an input."""

    @property
    def path(self) -> str: ...
    @property
    def kind(self) -> str: ...
    @property
    def description(self) -> str: ...
    @property
    def symbol(self) -> str: ...
    @property
    def value(self) -> DisplayedValue | None: ...
    @property
    def typed(self) -> str: ...
    @property
    def allowed(self) -> str: ...
    @property
    def basis(self) -> str: ...
    @property
    def note(self) -> str: ...


def inputs_html(inputs: Iterable[ShownInput], language: str | None, title: str = "") -> str:
    """Return the inputs of a press, by mechanism."""
    words = Catalogue(language or ENGLISH)
    by_home = groupby(inputs, lambda each: each.path.split(".")[0])
    with speaking(words.language):
        groups = [(home, [_told(each, words) for each in rows]) for home, rows in by_home]
    return _page("inputs", words, title=title, groups=groups)


def _told(each: ShownInput, words: Catalogue) -> Mapping[str, object]:
    """An input as a row of a table, in the language that is spoken."""
    value = "" if each.value is None else quantity(*each.value.printed, words["decimal"])
    return {
        "path": each.path, "description": said(each.description, each.kind), "symbol": symbol(each.symbol), "value": value, "typed": each.typed,
        "allowed": each.allowed, "basis": words[each.basis] if each.basis else "", "note": each.note,
    }  # fmt: skip


# --- single things ---------------------------------------------------------------------------------------------------


def value_html(letter: str, printed: tuple[str, str]) -> str:
    """Return a quantity as a report prints it: ``M = 523.4 N·m``."""
    head = Markup("{} = ").format(symbol(letter)) if letter else Markup("")
    return str(head + quantity(*printed))


def value_latex(letter: str, printed: tuple[str, str]) -> str:
    """Return the same as LaTeX."""
    latex = Latex(Catalogue(ENGLISH), ".")
    head = f"{latex.symbol(letter)} = " if letter else ""
    return f"${head}{latex.quantity(*printed)}$"


def drawing(figure: Mapping[str, Any], curves: Mapping[str, Any], language: str, key: str) -> str:
    """Return a figure of the results, drawn as SVG; any exception where it cannot be."""
    from diecut_report.report.figures.by_type import render  # with matplotlib, which takes half a second

    return render(figure, curves, Catalogue(language), key).text


def figure_html(svg: str, title: str) -> str:
    """Return a figure with its title."""
    # matplotlib escapes the texts within the drawing
    return _page("figure", Catalogue(ENGLISH), svg=Markup(svg), title=title)


# --- tables of machines ----------------------------------------------------------------------------------------------


def sweep_html(columns: Mapping[str, ResultColumn], values: Callable[[str], Any], counts: Mapping[str, int]) -> str:
    """Return the first machines of a table: what varies, some outputs, the verdict."""
    words, total = Catalogue(ENGLISH), sum(counts.values())
    names = [name for name in columns if ".checks." not in name and name != "error"]
    names = names if len(names) <= COLUMNS else [*names[: COLUMNS - 2], *names[-2:]]
    units = {name: columns[name].display or columns[name].unit for name in names}
    rows = list(zip(*(list(_cells(values(name)[:ROWS].tolist(), units[name])) for name in names), strict=True))
    told = f"{total}: " + ", ".join(f"{number} {words[status]}" for status, number in counts.items())
    heads = [(name, pretty(unit)) for name, unit in units.items()]
    return _page("sweep", words, told=told, columns=heads, rows=rows, more=total > ROWS)


def _cells(values: list[Any], unit: str) -> Iterator[str]:
    for value in values:
        is_number = isinstance(value, int | float) and not isinstance(value, bool)
        if value is None or (is_number and value != value):
            yield "–"
        else:
            yield quantity(shown(float(value), unit)["text"], "1") if is_number else str(value)
