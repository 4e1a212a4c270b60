"""Makes docs/reference/api.md, all names of ``diecut_report.api`` in one page, and mechanics.md: ``python -m tools.make_form_page``.

The site has the same in pages, with the examples in full; this one is to be read in the repository.
"""

from __future__ import annotations

import inspect
import pkgutil
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from typing import Any

from diecut_report import api, mechanics, testing
from diecut_report.formulas.formula import Formula
from diecut_report.mechanism.steps import Options, StepCondition
from tools.site.api_examples import FOLDER, TYPES, example_of
from tools.site.markup import code, plain, table
from tools.site.reference import (
    GROUPS,
    TOLD,
    call_of,
    declaration,
    declared_by,
    is_own,
    is_recipe,
    methods,
    named,
    paragraphs,
    short,
    signature,
    words_of,
)

PAGE = Path(__file__).parents[1] / "docs" / "reference" / "api.md"
MECHANICS = PAGE.with_name("mechanics.md")
LISTED = ("Chapter", "Steps")
INTRODUCTION = """\
# The author's form: all calls and their options

Made from signatures and docstrings by `python -m tools.make_form_page`. All names are those of `diecut_report.api`. Each has an example, a
whole plugin that the tests run, in [examples](examples/).

**Units**: what is declared (defaults, bounds, rows of tables, series) stands in the display unit that is written beside it. What a formula or plain
code gets is SI. A `StandardTable` holds its numbers in *its own* units, as typed: `TABLE.series("bore").values` are millimetres where the column is
`bore [mm]`; `si(25, "mm")` gives 0.025.
"""
STEPS = """\
## A chapter

`chapter = Chapter("Title")`, then one statement for each quantity, in the order in which they are calculated:

```python
chapter.stress = 32 * m.moment / (pi * m.diameter**3), "σ", "MPa", "Bending stress", "beam theory"
chapter.stress = value(m.force / m.area, needs=("area",)), "σ", "MPa", "Stress"
chapter[f"force_{side}"] = reduction("max", of=f"curve_{side}"), f"F_{side}", "N", "Greatest force"
```

That is what gives it, its symbol, unit, description and, where there is one, source. What gives it is a formula (`Written`: an expression of
quantities `m.ID`, a number, a `@formula`, a `ByText`) or one of the calls below.
"""
OTHERS = """\
## Calls of a chapter

What gives no single quantity is a call with an id.
"""
OPTIONS = """\
### Options of every step

Calls of a chapter take `needs` and `lacks` alone.
"""
STEPLESS = {"add": "Steps"}  # calls whose example is that of another name
MEANINGS = {
    "source": 'where the formula comes from, as it is printed beside it: `"ISO 281, 5.2"`, or the id of a `Source`',
    "source_symbol": "the letter that the source uses, where it is another one",
    "digits": "significant digits that are printed, at least",
    "shown_to": "a value above it (in the unit of the quantity) is shown as greater than it",
    "output": "among the `outputs` of the results file, which a study has columns of; else among its `values`",
    "needs": 'optional inputs with which the step takes part; `"medium=oil"` is a text input with that value',
    "lacks": "optional inputs without which it does; both together make alternatives of one id",
    "exists": "a condition on numbers: where it does not hold the quantity is absent",
    "numbered": 'how the parts of a row are called in the results: `"shaft_{}_speed"`',
    "first": "the number of the first part of those",
    "named_by": 'the text input with the parts\' names: `"bearings.name"`',
    "whole": "a count, an integer in the results",
    "printed": "whether reports show it; what is not serves messages, or how numbers are found, and may have the symbol of what it is taken for",
    "units": 'other units, each with the input beside which it holds: `(("mass", "N"),)`',
}


def pages() -> dict[Path, str]:
    """The text of the page by its file."""
    lines = [INTRODUCTION, STEPS, OPTIONS, *_options(), *_recipes(), OTHERS, *_calls()]
    for group in GROUPS:
        lines += [f"## {group.title}", "", _words(group.words), ""]
        lines += [line for name in group.names if not _is_step(name) for line in _name(name)]
    lines += ["## Tests", "", "Of `diecut_report.testing`.", ""]
    lines += [line for name, each in vars(testing).items() if is_own(name, each) for line in _told(name, each)]
    text = "\n".join(lines)
    while "\n\n\n" in text:
        text = text.replace("\n\n\n", "\n\n")
    return {PAGE: text.rstrip("\n") + "\n", MECHANICS: "\n".join(_mechanics()) + "\n"}


def _mechanics() -> Iterator[str]:
    """What the modules of shared mechanics offer: formulas, and functions that give expressions or compute."""
    yield from (
        "# Shared mechanics",
        "",
        "Made from docstrings by `python -m tools.make_form_page`. What stands in `diecut_report.mechanics`; all",
    )
    yield "values are SI. A formula is called with expressions or numbers; [geometry and sections](../how-to/geometry-and-sections.md) shows how."
    for found in pkgutil.iter_modules(mechanics.__path__):
        module = import_module(f"{mechanics.__name__}.{found.name}")
        own = {name: each for name, each in vars(module).items() if _is_shared(name, each, module.__name__)}
        rows = [
            (code(_called(name, each)), plain(next(paragraphs(each)).replace("``", ""))) for name, each in own.items()
        ]
        if rows:
            yield from ("", f"## `{found.name}`", "", _text(next(paragraphs(module))), "")
            yield from table(("call", "gives"), rows)


def _is_shared(name: str, each: Any, home: str) -> bool:
    is_called = isinstance(each, Formula) or inspect.isfunction(each)
    return is_called and not name.startswith("_") and each.__module__ == home


def _called(name: str, each: Any) -> str:
    parameters = each.parameters if isinstance(each, Formula) else inspect.signature(each).parameters
    return f"{name}({', '.join(parameters)})"


def _words(text: str) -> str:
    """The words of a group; its pages of the site are not files of the repository."""
    return text.replace("[shapes and roles](drawings.md)", "the site's page of drawings")


def _options() -> Iterator[str]:
    rows = []
    for name, kind in Options.__annotations__.items():
        default = inspect.signature(api.Step).parameters[name].default
        only = "all" if name in StepCondition.__annotations__ else "those with a quantity"
        rows.append(
            (code(name), code(kind.__forward_arg__), code(repr(default)), only, MEANINGS[name].replace("|", "\\|"))
        )
    yield from table(("option", "type", "default", "steps", "means"), rows)


def _recipes() -> Iterator[str]:
    """What gives a quantity, in the order of the groups."""
    for name in (name for group in GROUPS for name in group.names if is_recipe(name)):
        yield from (f"### `{name}`", "", "```python", declaration(name), "```", "")
        yield from (_text(line) for each in words_of(name) for line in paragraphs(each))
        yield from _example(name)


def _calls() -> Iterator[str]:
    """The calls of a chapter, in the order of the form."""
    offered = methods(api.Steps)
    for name in dict.fromkeys([*(name for name in vars(api.Steps) if name in offered), *offered]):
        if inspect.isfunction(offered[name]):
            step = "".join(part.capitalize() for part in name.split("_"))
            yield from _call(name, offered[name], step if step in TYPES else "")


def _call(name: str, method: Any, step: str) -> Iterator[str]:
    """A call with the words of the step that it declares, where there is one."""
    yield from (f"### `chapter.{name}`", "", *_signature(f"chapter.{name}", method))
    own = list(paragraphs(method))
    if step:  # whose words are the longer ones; of the call's those that name nothing else anew
        is_same = inspect.getdoc(method) == inspect.getdoc(TYPES[step])
        own = [] if is_same else [each for each in own[1:] if not each.startswith("``")]
    yield from (_text(each) for each in ((*paragraphs(TYPES[step]), *own) if step else own))
    yield from _example(step or STEPLESS.get(name, ""))


def _is_step(name: str) -> bool:
    return declared_by(name) is not None or is_recipe(call_of(name))


def _name(name: str) -> Iterator[str]:
    thing = named(name)
    if name in TOLD:
        yield from (f"### `{name}`", "", TOLD[name], "")
    else:
        yield from _told(name, thing)
    yield from _example(name)


def _told(name: str, thing: Any) -> Iterator[str]:
    yield from (f"### `{name}`", "", *_signature(name, thing))
    yield from (_text(each) for each in paragraphs(thing))
    if inspect.isclass(thing) and name not in LISTED:
        rows = [(code(short(own, each)), plain(next(paragraphs(each)))) for own, each in methods(thing).items()]
        yield from table(("it offers", "which does"), rows)


def _signature(name: str, thing: Any) -> Iterator[str]:
    found = signature(name, thing)
    if found:
        yield from ("```python", found, "```", "")


def _text(words: str) -> str:
    return words.replace("``", "`")


def _example(name: str) -> Iterator[str]:
    example = example_of(name) if name else None
    if example:
        yield from (f"Example: [{example.name}.py]({FOLDER.name}/{example.name}.py). {example.words}", "")


if __name__ == "__main__":
    for file, text in pages().items():
        file.write_text(text, encoding="utf-8")
