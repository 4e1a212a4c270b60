"""The report as HTML: one file with its fonts, formulas as MathML, figures inline; scripts of its own for the reader, no network."""

from __future__ import annotations

import base64
from collections.abc import Callable, Mapping
from contextlib import nullcontext
from functools import cache, partial
from hashlib import sha256
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

from jinja2 import Environment, FileSystemLoader
from markupsafe import Markup

from diecut_report import __version__
from diecut_report.report.chapters.value_tables import ValueRow
from diecut_report.report.context import Material
from diecut_report.report.document import machine_named
from diecut_report.report.equations import Equation
from diecut_report.report.model import CheckRow, Item, PrintedChapter, in_lines
from diecut_report.report.pages.firm_templates import MAIN, OPTIONS, bounded_memory, in_words
from diecut_report.report.pages.page_policy import refuse_fetching
from diecut_report.report.reader_data import reader_data
from diecut_report.report.symbols import cited, in_blocks, letters_declared, own_words, pieces, prose, symbol
from diecut_report.report.text import Catalogue, joined, sentence, tidy
from diecut_report.results.results_file import encoded
from diecut_report.text.translation import said, say, spoken_language

if TYPE_CHECKING:
    from diecut_report.report.pages.frames import SheetBlocks

FACES = {  # family, weight, style: file
    ("Report Sans", 400, "normal"): "report-sans-regular",
    ("Report Sans", 600, "normal"): "report-sans-bold",
    ("Report Sans", 400, "italic"): "report-sans-italic",
    ("Report Mono", 400, "normal"): "report-mono",
    ("Report Symbols", 400, "italic"): "report-symbols",
}
POLICY = (
    "default-src 'none'", "style-src 'unsafe-inline'", "font-src data:", "img-src data:", "base-uri 'none'", "form-action 'none'",
)  # fmt: skip
READER = ("uplot/uPlot.min.css", "reader.css", "moving.css")
SCRIPTS = ("uplot/uPlot.iife.min.js", "level_names.js", "moving.js", "reader.js")
FORMS = {"screen": "woff2", "print": "truetype"}  # a page engine would unpack the smaller form at each report
FILTERS: dict[str, Callable[..., Any]] = {
    "prose": prose,
    "own_words": own_words,
    "cited": cited,
    "symbol": symbol,
    "tidy": tidy,
    "machine": machine_named,
    "in_blocks": in_blocks,
    "in_lines": in_lines,
    "pieces": pieces,
    "behind": partial(joined, ""),
    "sentence": sentence,
}
LARGER = 1.35  # of figures on a screen against paper
SMALL = 300.0  # points: a narrower figure is shown whole on a narrow screen
END = "</body>\n</html>"
MATH = {("Report Math", 400, "normal"): "report-math"}


class Screen:
    """Formulas as MathML, figures as inline SVG; ``style`` is for this report alone, ``frame`` that of sheets.

    ``is_part`` says that the report stands within another page: its style and contents alone.
    """

    style = ""
    frame: SheetBlocks | None = None

    def __init__(self, material: Material, *, is_part: bool = False) -> None:
        self.material, self.is_part = material, is_part

    def display(self, equation: Equation) -> Markup:
        """A typeset formula as MathML."""
        # math-core escapes the texts within the formula
        return Markup(self.material.typesetter.mathml(equation.latex))

    def beside(self, equation: Equation) -> Markup:
        """A typeset formula in the line of its description."""
        return self.display(equation)

    def fits_beside(self, item: Item) -> bool:
        """Whether a step's formula stands in the line of its description: never, as a screen may be narrow."""
        return False

    def has_room_beside(self, item: Item) -> bool:
        """Whether the description there has more room than usual."""
        return False

    def figure(self, number: str, title: str) -> Markup:
        """A figure at a size at which its texts are those of the page; a narrow one is not stretched over the page."""
        figure = self.material.figures[number]
        own = f'width="{figure.width:.2f}pt" height="{figure.height:.2f}pt"'
        grown = f'width="{LARGER * figure.width:.2f}pt" height="{LARGER * figure.height:.2f}pt"'
        # matplotlib escapes the texts within the drawing
        return Markup(figure.text.replace(own, f'class="small" {grown}' if figure.width < SMALL else grown, 1))


def page(material: Material, *, is_part: bool = False) -> str:
    """The whole HTML page: the report, which needs no script, and behind it what its scripts use; of a part of another page the report alone."""
    scripts = [_read(name) for name in SCRIPTS]
    report = filled(material, Screen(material, is_part=is_part), "screen", *scripts)
    if is_part:
        return report
    data = f'<script type="application/json" id="reader-data">{reader_data(material)}</script>\n'
    return report.replace(END, data + "".join(f"<script>{text}</script>\n" for text in scripts) + END)


def filled(material: Material, medium: Screen, kind: str, *scripts: str) -> str:
    """The report's template with the document in it, for ``screen`` or ``print``; a browser may run these scripts."""
    document = material.document
    faces = FACES | (MATH if kind == "screen" else {})
    own = {"changes.css": material.changes, "influence.css": document.influence}
    sheets = ["report.css", f"{kind}.css", *(name for name, part in own.items() if part), *(READER if scripts else ())]
    sheets += [f"frame_{document.block.frame}.css"] if kind == "print" else []
    style = "\n".join([_font_faces(tuple(faces.items()), FORMS[kind]), *map(_read, sheets), medium.style])
    house = material.house
    style += f"\n{house.css}" if house else ""
    given = template_variables(material, medium, kind, style, policy(*scripts))
    environment = _environment() if house is None else house.environment(folder(), FILTERS, template_functions(given))
    with in_words(house), letters_declared(*material.letters), bounded_memory() if house else nullcontext():
        made = environment.get_template(MAIN).render(given)
        if house:
            refuse_fetching(made, house.folder, given["policy"] if kind == "screen" else "", MAIN)
    return made


METHODS = (CheckRow.repeats, PrintedChapter.count, ValueRow.named_formula)
"""What templates may call of the data that they see."""


def template_variables(material: Material, medium: Screen, kind: str, style: str, policy: str) -> dict[str, Any]:
    """Return what templates see: plain data, and plain functions."""
    document = material.document
    return {
        "doc": document, "t": document.words, "kind": kind, "style": Markup(style), "policy": policy,
        "math": {name: getattr(medium, name) for name in ("display", "beside", "fits_beside", "has_room_beside")},
        "figure": medium.figure, "failed": material.failed, "abreast": material.are_abreast, "frame": medium.frame, "logo": material.logo,
        "carried": material.carried, "changes": material.changes, "is_part": medium.is_part,
    }  # fmt: skip


def template_functions(given: Mapping[str, Any]) -> list[Callable[..., Any]]:
    """Return what templates may call of what they see."""
    return [*METHODS, *given["math"].values(), given["figure"], given["failed"], given["abreast"]]


def filled_page(template: str, **given: object) -> str:
    """Return a page of its own of the program's templates, filled with these values; what they hold stands as text."""
    return _environment().get_template(template).render(**given)


def styled_page(template: str, kind: str, styles: tuple[str, ...], script: str = "", **values: Any) -> str:
    """Return a template as one self-contained HTML page, for the ``screen`` or for ``print``; ``styles`` come after those of a report.

    What no page can hold, bytes of a file's name that are not UTF-8, stands as an escape.
    """
    sheets = ("report", kind, *(["strip"] if kind == "print" else []), *styles)
    style = "\n".join([_font_faces(tuple(FACES.items())), *(_read(f"{name}.css") for name in sheets)])
    language = spoken_language()
    page = filled_page(template, t=Catalogue(language), language=language, kind=kind, policy=policy(script), style=Markup(style),
        version=__version__, say=say, said=said, **values)  # fmt: skip
    return encoded(page).decode()


def policy(*scripts: str) -> str:
    """What a browser may load and run for a page: its own styles, fonts and pictures, and of scripts only these."""
    hashes = (base64.b64encode(sha256(script.encode()).digest()).decode() for script in scripts)
    allowed = " ".join(["script-src", *(f"'sha256-{found}'" for found in hashes)])
    return "; ".join([*POLICY, allowed] if scripts else POLICY)


def folder() -> Path:
    """The folder of the templates."""
    return Path(import_module("diecut_report.templates").__path__[0])


@cache
def _read(name: str) -> str:
    return (folder() / name).read_text(encoding="utf-8")


@cache
def _font_faces(faces: tuple[tuple[tuple[str, int, str], str], ...], form: str = "woff2") -> str:
    rules, ending = [], {"woff2": "woff2", "truetype": "ttf"}[form]
    for (family, weight, style), name in faces:
        data = base64.b64encode((folder() / "fonts" / f"{name}.{ending}").read_bytes()).decode()
        source = f'url("data:font/{ending};base64,{data}") format("{form}")'
        rules.append(f'@font-face{{font-family:"{family}";font-weight:{weight};font-style:{style};src:{source}}}')
    return "\n".join(rules)


@cache
def _environment() -> Environment:
    environment = Environment(loader=FileSystemLoader(folder()), **OPTIONS)
    environment.filters.update(FILTERS)
    return environment
