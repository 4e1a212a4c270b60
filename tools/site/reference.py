"""The reference of ``diecut_report.api`` and ``diecut_report.testing``, from signatures and docstrings, with examples that are run."""

from __future__ import annotations

import dataclasses
import inspect
import re
from collections.abc import Iterator
from html import escape
from pathlib import PurePath
from typing import Any, NamedTuple

from diecut_report import api, testing
from diecut_report.mechanism.steps import Step
from diecut_report.report.figures.by_type import render
from diecut_report.report.figures.style import SizesSize
from diecut_report.report.text import Catalogue
from tools.site.api_examples import TYPES, ApiExample, example_of, run
from tools.site.drawing_page import drawing_page
from tools.site.formulas import functions_page
from tools.site.markup import code, contents, fenced, html, plain, table
from tools.site.sources import ROOT, Sources

PAGES = ROOT / "docs" / "reference"
WORDS = Catalogue("en")
LISTED = ("Chapter", "Steps")  # whose methods are told as the steps that they declare


def add_reference(sources: Sources) -> None:
    """Add the pages that are made; those of docs/reference are documents."""
    for group in GROUPS:
        sources.page(f"reference/{group.page}.md", _page(group))
    sources.page("reference/testing.md", _testing())
    sources.page("reference/functions.md", functions_page())
    sources.page("reference/drawings.md", drawing_page())
    sources.page("reference/index.md", _index())


def _index() -> Iterator[str]:
    yield from ("# Reference", "")
    yield (
        "All that a plugin may import of `diecut_report.api`, with examples. Each example is a whole plugin, which the tests run: `PRESS` is "
        "the block of a configuration with which it is run, `GIVES` is what then comes out. Figures that an example declares stand below it."
    )
    yield from (
        "",
        *(
            f"- [{group.title}]({group.page}.md): {', '.join(map(code, filter(has_place, group.names)))}"
            for group in GROUPS
        ),
        "",
    )
    own = sorted(file.stem for file in PAGES.glob("*.md"))
    yield from contents("", [*(group.page for group in GROUPS), "testing", "functions", "drawings", *own])


def _page(group: Group) -> Iterator[str]:
    yield from (f"# {group.title}", "", group.words, "")
    for name in group.names:
        yield from _place(name)
        if not has_place(name):
            continue
        yield from (f"## {code(name)}", "")
        yield from _told(name, named(name))
        yield from _example(name, group)


def _place(name: str) -> Iterator[str]:
    """A place by the very name: titles lose the difference of ``Point`` and ``point``."""
    yield from html(f'<span id="name-{name}"></span>')


def _told(name: str, thing: Any) -> Iterator[str]:
    declared = declared_by(name)
    if declared:
        yield from fenced("python", declaration(name))
        yield from (line for each in words_of(name) for line in described(each))
        return
    if name not in TOLD:
        yield from called(name, thing)
    yield from (TOLD[name], "") if name in TOLD else described(thing)
    if inspect.isclass(thing):
        yield from _methods(name, thing)


def named(name: str) -> Any:
    """Return what a name stands for: one of the interface, or a type of step."""
    return getattr(api, name, None) or TYPES[name]


def call_of(name: str) -> str:
    """Return the name of the call that declares a type of step, where the name is that of one: of ``MadeCurve`` it is ``made_curve``."""
    is_step = name in TYPES and name not in api.__all__
    return (
        "".join(f"_{letter.lower()}" if letter.isupper() else letter for letter in name).lstrip("_")
        if is_step
        else name
    )


def is_recipe(name: str) -> bool:
    """Return whether a call says how a quantity is given."""
    return name == "inner" or (name in api.__all__ and any(call_of(each) == name != each for each in TYPES))


def has_place(name: str) -> bool:
    """Return whether a name is told by itself: a type of step that gives a quantity is told with its call, which follows."""
    return name == call_of(name) or not is_recipe(call_of(name))


def declared_by(name: str) -> Any:
    """Return the call that declares a step of this name: one that gives a quantity, or a chapter's; None where there is none."""
    call = call_of(name)
    found = getattr(api, call) if is_recipe(call) else getattr(api.Steps, call, None) if call != name else None
    return found if inspect.isfunction(found) else None


def declaration(name: str) -> str:
    """Return how a step is declared: the statement, or the call of a chapter."""
    call, declared = call_of(name), declared_by(name)
    if not is_recipe(call):
        return signature(f"chapter.{call}", declared)
    return f"chapter.ID = {signature(call, declared).removesuffix(' -> Recipe')}, symbol, unit, description, source"


def words_of(name: str) -> list[Any]:
    """Return what tells of a step: of what gives a quantity its call, of others the type, and the call where it says something else."""
    own = declared_by(name)
    thing = named(name)
    return (
        [own] if is_recipe(call_of(name)) else [thing, *([own] if inspect.getdoc(own) != inspect.getdoc(thing) else [])]
    )


def _methods(name: str, thing: type) -> Iterator[str]:
    """What a class offers, a line for each: of chapters by the names of the steps alone."""
    rows = [(code(short(method, each)), plain(next(paragraphs(each)))) for method, each in methods(thing).items()]
    if rows and name != "Steps":
        yield from table(("it offers", "which does"), rows, "offers")


def short(name: str, each: Any) -> str:
    """Return a call with the names of what it takes, or a property."""
    if isinstance(each, property):
        return name
    taken = [
        p.name for p in inspect.signature(each).parameters.values() if p.name != "self" and p.kind is not p.VAR_KEYWORD
    ]
    return f"{name}({', '.join(taken)})"


def _example(name: str, group: Group) -> Iterator[str]:
    """The example, where it is called so; else where it stands."""
    example = example_of(name)
    if example is None:
        raise LookupError(f"{name} has no example; write docs/reference/examples/{name}.py")
    if example.name == name:
        yield from html(f'<p id="example-{name}"><b>Example.</b> {escape(example.words)}</p>')
        yield from fenced("python", example.code)
        yield from _figures(example)
        return
    home = next(each for each in GROUPS if example.name in each.names)
    address = f"{'' if home is group else f'{home.page}.html'}#example-{example.name}"
    yield from html(f'<p>Example: <a href="{address}">{escape(example.words)}</a></p>')


def _figures(example: ApiExample) -> Iterator[str]:
    results = run(example) if "figures=" in example.text else None
    for name, mechanism in results.mechanisms.items() if results else ():
        for figure in mechanism.figures:
            svg = render(figure, mechanism.curves, WORDS, f"{example.name}-{name}-{figure.id}", SizesSize.HALF)
            yield from html(f'<figure class="drawn"><div class="fig">{svg.text}</div></figure>')


def _testing() -> Iterator[str]:
    yield from ("# Testing a plugin", "")
    yield from ("`diecut_report.testing` has what a plugin's own tests need.", "")
    offered = {name: each for name, each in vars(testing).items() if is_own(name, each)}
    for name, each in offered.items():
        yield from (f"## {code(name)}", "")
        yield from (*called(name, each), *described(each))
    yield from fenced("python", TESTED)


def is_own(name: str, each: Any) -> bool:
    """Return whether it is meant for authors: named in ``__all__`` where there is one, else told of in the package's own words."""
    named = getattr(testing, "__all__", None)
    return name in named if named is not None else callable(each) and f"{name}(" in (testing.__doc__ or "")


TESTED = """
from diecut_report.testing import check_mechanism
from my_plugins.hook import MECHANISM


def test_the_hook_keeps_the_contract() -> None:
    check_mechanism(MECHANISM)
"""


# Signatures and docstrings of what is documented, as Markdown.


WIDEST = 100
HIDDEN = ("self", "cls")


def signature(name: str, thing: Any) -> str:
    """Return how something is called, on several lines where one would be too wide; empty where it is not called."""
    if _is_protocol(thing) or not callable(thing):
        return ""
    try:
        found = inspect.signature(
            thing.__init__ if inspect.isclass(thing) and not dataclasses.is_dataclass(thing) else thing
        )
    except (TypeError, ValueError):
        return ""
    taken = [each for each in found.parameters.values() if each.name not in HIDDEN and not _is_place(each)]
    parts: list[str] = []
    is_keyed = False
    for each in taken:
        if each.kind is each.KEYWORD_ONLY and not is_keyed:
            parts, is_keyed = [*parts, "*"], True
        is_keyed = is_keyed or each.kind is each.VAR_POSITIONAL
        parts.append(_parameter(each))
    gives = (
        ""
        if inspect.isclass(thing) or found.return_annotation in (found.empty, None, "None")
        else f" -> {_type(found.return_annotation)}"
    )
    whole = f"{name}({', '.join(parts)}){gives}"
    return whole if len(whole) <= WIDEST else f"{name}(\n    " + ",\n    ".join(parts) + f",\n){gives}"


def _is_place(each: inspect.Parameter) -> bool:
    """Whether it is where a declaration stands, which the program finds by itself."""
    return each.name == "at" and each.default is not each.empty


def _parameter(each: inspect.Parameter) -> str:
    stars = "*" if each.kind is each.VAR_POSITIONAL else "**" if each.kind is each.VAR_KEYWORD else ""
    kind = "" if each.annotation is each.empty else f": {_type(each.annotation)}"
    default = "" if each.default is each.empty else f" = {_default(each.default)}"
    return f"{stars}{each.name}{kind}{default}"


def _type(annotation: Any) -> str:
    text = annotation if isinstance(annotation, str) else inspect.formatannotation(annotation)
    return re.sub(r"\b(?:diecut_report|collections|typing|numpy)\.(?:\w+\.)*", "", text)


def _default(value: Any) -> str:
    text = repr(value)
    return "..." if text.startswith("<") or "0x" in text or isinstance(value, PurePath) else text


def _is_protocol(thing: Any) -> bool:
    return bool(getattr(thing, "_is_protocol", False))


def described(thing: Any) -> Iterator[str]:
    """Yield the docstring as Markdown."""
    yield from ("", *(_marked(paragraph) for paragraph in paragraphs(thing)), "")


def paragraphs(thing: Any) -> Iterator[str]:
    """Yield the paragraphs of a docstring, each followed by an empty line."""
    for paragraph in (inspect.getdoc(thing) or "").split("\n\n"):
        yield from (" ".join(paragraph.split()), "")


def _marked(text: str) -> str:
    """A text of a docstring, its code in double backticks, as Markdown."""
    parts = re.split(r"``(.+?)``", text)
    return "".join(code(part) if index % 2 else _spaced(part) for index, part in enumerate(parts))


def _spaced(text: str) -> str:
    """A text between code, with the spaces at its ends."""
    return f"{' ' * text.startswith(' ')}{plain(text)}{' ' * (text.strip() != '' and text.endswith(' '))}"


def called(name: str, thing: Any) -> Iterator[str]:
    """Yield the signature as a block of code; nothing where there is none."""
    found = signature(name, thing)
    if found:
        yield from fenced("python", found)


def methods(thing: type) -> dict[str, Any]:
    """Return what a class offers beside its making: methods and properties with words of their own, in their order."""
    own: dict[str, Any] = {}
    if issubclass(thing, Step):  # what it offers is for the rooms of the program
        return own
    for base in reversed(thing.__mro__):
        if base.__module__.startswith("diecut_report"):
            own |= {name: each for name, each in vars(base).items() if not name.startswith("_") and _is_offered(each)}
    return own


def _is_offered(each: Any) -> bool:
    return isinstance(each, property) or (inspect.isfunction(each) and bool(each.__doc__))


# Which page of the reference tells of which names of ``diecut_report.api``, and what is said of those that have no words of their own.


class Group(NamedTuple):
    """A page of the reference: its name, its title, what it is about, and the names in their order."""

    page: str
    title: str
    words: str
    names: tuple[str, ...]


GROUPS = (
    Group("mechanism", "A mechanism", "What a plugin's module declares: the mechanism as a whole, its chapters, checks, sources.", (
        "Mechanism", "Chapter", "Steps", "Step", "prefixed", "Check", "Vary", "AdviceWay", "Source", "Erratum", "Partner", "Comparison", "Port",
        "Profile", "CurveTable", "ExampleBlock", "Wired", "ForEach", "CONTRACT",
    )),
    Group("inputs", "Inputs", "What a user may give: keys that are declared by assignment; validated values are SI.", (
        "Inputs", "Block", "Quantity", "samples", "Text", "parts", "block", "InOtherUnit", "OneOf", "CurveInput", "Varying", "Extremes", "Curve",
        "PhaseInput", "MechanismInput", "FromPress", "FromTable",
    )),
    Group("formulas", "Formulas", "What computes, prints and is checked for its dimensions: an expression of quantities.", (
        "m", "Expression", "formula", "Formula", "ByText", "number", "pi", "Constant", "GRAVITY", "arccos", "as_number", "as_angle",
    )),
    Group("steps", "Numbers and conditions", "What gives a number or a text, and what must hold. One statement declares a quantity: "
    "`chapter.ID =` what gives it, its symbol, unit, description and source, which may be left out; a formula alone stands for `value(formula)`.", (
        "Recipe", "Value", "value", "inner", "Choice", "choice", "case", "Case", "Root", "root", "Computed", "computed", "Refusal", "Require",
        "SelfTest", "self_test", "ROUNDING", "CURVE_ROUNDING", "Words", "Fact",
    )),
    Group("curves", "Curves", "What gives a curve over an abscissa, or a number of one.", (
        "Abscissa", "abscissa", "Breakpoints", "Reduction", "reduction", "Derivative", "derivative", "Accumulated", "accumulated", "Crossings",
        "crossings", "FromCurve", "from_curve", "CurvePeriod", "curve_period", "MadeCurve", "made_curve", "Spectrum", "SpectrumLine",
    )),
    Group("parts", "Repeated parts", "Rows over a list of blocks, with a number for each part.", (
        "Total", "total", "Neighbour", "neighbour", "Running", "running", "Part", "part", "Clash",
    )),
    Group("plain-code", "Plain code", "Objects that plain code makes once, and what several steps take of them.", (
        "Prepared", "ComputedCurve", "computed_curve", "PartNames", "PartTable", "PartCurves", "Listing", "ListedColumn", "Cell",
    )),
    Group("phases", "Phases", "When a mechanism does something, and how others take part in it.", ("Phase", "GivenPhase", "GivenMechanism")),
    Group("tables", "Tables and series", "Numbers of standards and of an author's own tables.", (
        "Lookup", "lookup", "Interpolated", "interpolated", "Pick", "pick", "standard_table", "standard_series", "standard_series_by", "own_table",
        "own_series", "table_beside", "StandardTable", "StandardSeries", "StandardFault",
    )),
    Group("figures", "Figures", "Diagrams and drawings; [shapes and roles](drawings.md) has each shape and role as a picture.", (
        "Plot", "Panel", "Series", "Level", "Mark", "Span", "Polar", "Bars", "BarGroup", "Chart", "chart_panel", "line", "fill", "mark", "level",
        "vertical", "Drawing", "View", "Driven", "Grip", "Shape", "Point", "polyline", "region", "circle", "arc", "dimension", "radius_dimension",
        "label", "arrow", "box", "point", "rigid",
    )),
    Group("texts", "Texts and numbers", "Texts that code makes, and numbers in them.", (
        "Phrase", "phrase", "joined", "named", "worded", "told", "si", "outward", "below",
    )),
)  # fmt: skip

TOLD = {  # names without a docstring of their own
    "AdviceWay": "A way in which a check may be made to hold: an input that is changed alone, by its key or as a `Vary`, "
    "or several keys whose inputs are changed together in one proportion.",
    "CURVE_ROUNDING": "1e-6, the relative difference within which what is integrated or found on curves is the same but for rounding.",
    "CONTRACT": "The number of the contract of this program; a module says by `CONTRACT = 2` for which it is written.",
    "Cell": "What stands in a cell of a listing: a number in SI, a text, or `None` where there is nothing.",
    "GRAVITY": "The standard acceleration of free fall, 9.80665 m/s², a `Constant`.",
    "ROUNDING": "1e-9, the relative difference within which two numbers are the same but for rounding.",
    "Expression": "What arithmetic with quantities gives: it is printed, computes, and is checked for its dimensions. For annotations.",
    "Point": "A place in a drawing: across and upwards, in metres.",
    "Recipe": "What `value(…)`, `reduction(…)` and the like give: how a quantity comes about, before it has an id. For annotations.",
    "Shape": "A shape of a drawing, or a panel of a chart, as plain data: made by the functions of this page.",
    "m": 'The quantities by their ids: `m.radius`; `m[f"force_{side}"]` where an id is made; `m.inputs.torque` for an input whose id a step has too; '
    "`m.rods.length` for the row over a list, `m.rods[0].length` for one of it.",
    "pi": "π as it is printed, half a turn: an angle. `np.pi` in a formula is refused; plain code uses it.",
}
