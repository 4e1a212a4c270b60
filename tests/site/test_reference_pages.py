"""What the hand-written pages of the reference say holds: each row of their tables is tried."""

from __future__ import annotations

import inspect
import itertools
import re
import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType

import pytest

from diecut_report import api
from diecut_report.config.plugins import Discovery, UnknownKind
from diecut_report.declaration.formula_checks import check_mechanism
from diecut_report.errors import PluginError, UserError
from diecut_report.formulas.tree import FUNCTIONS, OF_TWO, SAID
from diecut_report.mechanism.steps import Options
from diecut_report.quantities.units import UnitError, parse_quantity
from diecut_report.report.figures.drawing import ROLES
from tools import make_form_page
from tools.site import drawing_page, formulas
from tools.site.api_examples import TYPES
from tools.site.reference import GROUPS, TOLD, declared_by, signature

ROOT = Path(__file__).parents[2]
UNITS = (ROOT / "docs" / "reference" / "units.md").read_text(encoding="utf-8")
COUNT = itertools.count()


def rows(head: str) -> Iterator[list[str]]:
    """The cells of all tables whose first column is called so."""
    for table in re.findall(rf"^\| {head} \|.*?\n\|[- |]*\n((?:\|.*\n)+)", UNITS, re.MULTILINE):
        for line in table.splitlines():
            yield [cell.strip().strip("`") for cell in line.strip("|").split(" | ")]


@pytest.mark.parametrize(("typed", "unit", "told"), [pytest.param(*row, id=" ".join(row[:2])) for row in rows("typed")])
def test_a_typed_quantity_is_what_the_page_says(typed: str, unit: str, told: str) -> None:
    given = float(typed) if re.fullmatch(r"[\d.]+", typed) else typed
    if told.startswith("not "):
        with pytest.raises(UnitError if "zero" in told else ValueError):
            parse_quantity(given, unit)
    else:
        assert parse_quantity(given, unit) == pytest.approx(float(told), rel=1e-7)


def declared(folder: Path, formula: str, given: str, unit: str) -> ModuleType:
    """A plugin that has the formula as its only step."""
    inputs = re.findall(r"(\w+) in `(\S+)`", given.rstrip("`") + "`")
    keys = [f'    {name} = Quantity("s_{n}", "{own}", "Input", gt=0)' for n, (name, own) in enumerate(inputs)]
    file = folder / f"row_{next(COUNT)}.py"
    lines = [
        "import numpy as np",
        "from diecut_report.api import *",
        "class Given(Inputs):",
        *keys,
        'chapter = Chapter("Row")',
        f'chapter.result = {formula}, "r", "{unit}", "Result"',
        'MECHANISM = Mechanism(kind="row", version="1", title="Row", summary="A row.", inputs=Given, chapters=(chapter,))',
    ]
    file.write_text("\n".join(lines), encoding="utf-8")
    sys.modules[file.stem] = module = ModuleType(file.stem)
    module.__file__ = str(file)
    exec(compile(file.read_text(encoding="utf-8"), str(file), "exec"), module.__dict__)
    return module


@pytest.mark.parametrize(("formula", "given", "told"), [pytest.param(*row, id=row[0]) for row in rows("formula")])
def test_a_formula_has_the_dimension_that_the_page_says(tmp_path: Path, formula: str, given: str, told: str) -> None:
    unit = told.removeprefix("not `") if told != "refused" else "1"
    module = declared(tmp_path, formula, given, unit)
    if told == unit:
        check_mechanism(module.MECHANISM)
    else:
        with pytest.raises(AssertionError, match="result"):
            check_mechanism(module.MECHANISM)


PLUGIN = """
from diecut_report.api import Chapter, Inputs, Mechanism, Quantity, m


class Given(Inputs):
    force = Quantity("F", "N", "Force", gt=0)


chapter = Chapter("Force")
chapter.double = 2 * m.force, "D", "N", "Twice the force"


def made(kind):
    return Mechanism(kind=kind, version="1", title=kind, summary="A force.", inputs=Given, chapters=(chapter,))


"""


def own_kinds(folder: Path) -> set[str]:
    return set(Discovery([folder]).origins) - set(Discovery().origins)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    for name in ("_helpers", ".hidden"):
        (tmp_path / f"{name}.py").write_text("raise RuntimeError('this code is run')\n", encoding="utf-8")
    (tmp_path / "hook.py").write_text(f"{PLUGIN}MECHANISM = made('hook')\n", encoding="utf-8")
    for name in ("winch", "_old", "notes"):
        (tmp_path / name).mkdir()
    (tmp_path / "winch" / "__init__.py").write_text("from ._made import MECHANISM\n", encoding="utf-8")
    (tmp_path / "winch" / "_made.py").write_text(f"{PLUGIN}MECHANISM = made('winch')\n", encoding="utf-8")
    (tmp_path / "_old" / "__init__.py").write_text("raise RuntimeError('this code is run')\n", encoding="utf-8")
    (tmp_path / "extend_laws.py").write_text("RUN = True\n", encoding="utf-8")
    (tmp_path / "readme.txt").write_text("words\n", encoding="utf-8")
    return tmp_path


def test_names_that_begin_with_an_underscore_are_passed_over_and_not_run(folder: Path) -> None:
    assert own_kinds(folder) == {"hook", "winch"}
    found = Discovery([folder])
    found.extend()
    assert [found.mechanism(kind).kind for kind in ("hook", "winch")] == ["hook", "winch"]
    assert set(found.extended) == {"extend_laws"}


@pytest.mark.parametrize("line", ["import _helpers", "from . import _helpers"])
def test_a_plugin_of_one_file_cannot_import_a_file_beside_it(tmp_path: Path, line: str) -> None:
    (tmp_path / "_helpers.py").write_text("", encoding="utf-8")
    (tmp_path / "hook.py").write_text(f"{line}\n", encoding="utf-8")
    with pytest.raises(
        PluginError, match=r"(?:ImportError|ModuleNotFoundError).*; a plugin of one file .* make a folder hook/ of it"
    ):
        Discovery([tmp_path]).mechanism("hook")


def test_a_library_that_is_missing_is_told_alone(tmp_path: Path) -> None:
    (tmp_path / "hook.py").write_text("import no_such_library\n", encoding="utf-8")
    with pytest.raises(PluginError) as found:
        Discovery([tmp_path]).mechanism("hook")
    assert "no_such_library" in found.value.message and "one file" not in found.value.message


def test_with_a_list_only_what_it_names_is_a_kind(folder: Path) -> None:
    (folder / "hooks.py").write_text(
        f"{PLUGIN}SMALL = made('small_hook')\nLARGE = made('large_hook')\n", encoding="utf-8"
    )
    (folder / "_helpers.py").write_text(f"{PLUGIN}SHARED = made('shared')\n", encoding="utf-8")
    page = (ROOT / "docs" / "reference" / "plugin-folder.md").read_text(encoding="utf-8")
    listed = page.split("```yaml\n")[1].partition("```")[0]
    (folder / "kinds.yaml").write_text(listed.partition("\n")[2], encoding="utf-8")  # but for hook.py
    found = Discovery([folder])
    found.extend()
    assert own_kinds(folder) == {"small_hook", "large_hook", "winch", "shared"} and set(found.extended) == {
        "extend_laws"
    }
    assert {found.mechanism(kind).kind for kind in own_kinds(folder)} == own_kinds(folder)
    with pytest.raises(UnknownKind):
        found.mechanism("hook")


def test_a_listed_file_that_is_not_there_is_told_when_its_kind_is_used(tmp_path: Path) -> None:
    (tmp_path / "kinds.yaml").write_text("lost: lost.py\n", encoding="utf-8")
    found = Discovery([tmp_path])
    assert "lost" in found.origins
    with pytest.raises(PluginError, match=r"lost\.py"):
        found.mechanism("lost")


def test_a_list_of_another_form_is_an_error_at_once(tmp_path: Path) -> None:
    (tmp_path / "kinds.yaml").write_text("- hook.py\n", encoding="utf-8")
    with pytest.raises(UserError, match=r"kinds\.yaml"):
        _ = Discovery([tmp_path]).origins


UNIT_OF = {
    "an angle": ("deg", "rad"),
    "a number": ("1", "1"),
    "any": ("mm", "1"),
    "of one kind": ("mm", "m"),
    "the same kind": ("", "m"),
    "any, such as an area": ("mm**2", ""),
    "its root, a length": ("", "m"),
}


@pytest.mark.parametrize("name", sorted(formulas.MEANINGS))
def test_a_function_takes_and_gives_what_the_page_says(tmp_path: Path, name: str) -> None:
    meaning = formulas.MEANINGS[name]
    (given, _), (_, gives) = UNIT_OF[meaning.takes], UNIT_OF[meaning.gives]
    names = ("y", "x") if name in OF_TWO else ("x",)
    formula = f"np.{name}({', '.join(f'm.{each}' for each in names)})"
    module = declared(tmp_path, formula, ", ".join(f"{each} in `{given}`" for each in names), gives)
    check_mechanism(module.MECHANISM)


def test_each_function_and_each_role_has_a_meaning() -> None:
    assert formulas.MEANINGS.keys() == set(FUNCTIONS.values()) and formulas.SAYING.keys() == {*SAID}
    assert drawing_page.MEANINGS.keys() == ROLES.keys()


def test_the_page_of_the_authors_form_is_made_of_what_there_is() -> None:
    for file, text in make_form_page.pages().items():
        assert file.read_text(encoding="utf-8") == text, "run: python -m tools.make_form_page"
    form = make_form_page.PAGE.read_text(encoding="utf-8")
    told = set(re.findall(r"^### `(?:chapter\.)?(\w+)`", form, re.MULTILINE))
    called = {name for name in dir(api.Steps) if inspect.isfunction(getattr(api.Steps, name)) and name[0] != "_"}
    assert called <= told and make_form_page.MEANINGS.keys() == Options.__annotations__.keys()


def test_a_signature_leaves_out_nothing_that_must_be_given() -> None:
    for name in ("rigid", "point", "label"):
        needed = [
            each for each in inspect.signature(getattr(api, name)).parameters.values() if each.default is each.empty
        ]
        assert needed and all(re.search(rf"\b{each.name}:", signature(name, getattr(api, name))) for each in needed)
    assert "/" not in signature("standard_series", api.standard_series)  # no folder of the machine that made the page


def test_each_name_stands_on_one_page_of_the_reference() -> None:
    named = [name for group in GROUPS for name in group.names]
    declared = {step for step in TYPES if step not in api.__all__ and declared_by(step)}
    assert sorted(named) == sorted({*api.__all__, *declared})
    undescribed = [name for name in api.__all__ if name not in TOLD and not getattr(api, name).__doc__]
    assert undescribed == []
