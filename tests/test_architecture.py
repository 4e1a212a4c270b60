"""The rules of the source tree: who may import whom, how long things are, what a plugin does not contain."""

from __future__ import annotations

import ast
import re
import sys
from collections.abc import Iterator
from functools import cache
from graphlib import TopologicalSorter
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
FOLDERS = {  # folder of the repository: package or name under which its modules are known here
    "diecut_report": "diecut_report",
    "plugins": "diecut_report.plugins",
    "templates": "diecut_report.templates",
    "configs": "diecut_report.configs",
    "tools": "tools",
    "tests": "tests",
}

# A module of diecut_report may import modules of its own line and of the lines above it ("" is the package itself).
LAYERS = [
    {"", "errors", "text", "quantities", "time_limit"},
    {"standards", "formulas"},
    {"mechanics"},
    {"mechanism", "api"},
    {"files", "pictures", "declaration"},
    {"config"},
    {"machine"},
    {"results"},
    {"report"},
    {"press", "study", "firm_folder"},
    {"testing", "design", "exchange"},
    {"scripting", "live"},
    {"cli", "__main__"},
]
REPORT = LAYERS.index({"report"})
ONLY_IN = {  # library: the modules of the program that may import it
    "PIL": r"diecut_report\.pictures",
    "babel": r"diecut_report\.text\.\w+",
    "dask": r"(?!)",  # its client is all that is needed
    "distributed": r"diecut_report\.study\.execution\.dask_cluster",
    "duckdb": r"diecut_report\.study\.(analysis|summary)\.\w+",
    "matplotlib": r"diecut_report\.(report\.figures|study\.summary|design\.optimisation\.page)(\.\w+)?",
    "openpyxl": r"diecut_report\.(study\.tables\.formats|study\.storage\.spreadsheets|report\.office\.workbook)",
    "docx": r"diecut_report\.report\.office\.word_file",
    "pyarrow": r"diecut_report\.study\.(storage|tables)\.\w+",
    "threadpoolctl": r"diecut_report\.study\.execution\.engines",
    "pikepdf": r"diecut_report\.exchange\.(pdf_attachments|later_changes)",
    "pyhanko": r"diecut_report\.exchange\.signatures",
    "pyhanko_certvalidator": r"diecut_report\.exchange\.signatures",
    "cryptography": r"diecut_report\.exchange\.signatures",
    "asn1crypto": r"diecut_report\.exchange\.signatures",
    "starlette": r"diecut_report\.live\.(server|watched_plugin)",
    "uvicorn": r"diecut_report\.live\.server",
    "watchfiles": r"diecut_report\.live\.(server|watched_plugin)",
    "pymoo": r"diecut_report\.design\.optimisation\.(search|result)",
    "weasyprint": r"diecut_report\.report\.pages\.page_engine",
    "pydyf": r"diecut_report\.report\.pages\.page_engine",
    "ezdxf": r"diecut_report\.report\.profile_files",
    "jinja2": r"diecut_report\.report\.(document|pages\.(html|firm_templates))",
    "tinycss2": r"diecut_report\.(pictures|report\.pages\.page_policy)",
    "tinyhtml5": r"diecut_report\.report\.pages\.page_policy",
    "scipy.stats": r"diecut_report\.(study|design)\..*",  # slow to import, and needed by studies and tolerances alone
    "matplotlib.pyplot": r"(?!)",  # keeps global state
}
FOR_PLUGINS = {"diecut_report.api", "diecut_report.mechanics", "numpy", "scipy", *sys.stdlib_module_names}
FUNCTION_LINES, MODULE_LINES = 50, 600


def modules() -> dict[str, Path]:
    """All Python files of the repository by the name of their module."""
    found = {}
    for folder, package in FOLDERS.items():
        for path in sorted((ROOT / folder).rglob("*.py")):
            parts = path.relative_to(ROOT / folder).with_suffix("").parts
            found[".".join([package, *parts]).removesuffix(".__init__")] = path
    return found


MODULES = modules()
PROGRAM = {name: path for name, path in MODULES.items() if name.startswith("diecut_report")}
PLUGINS = {name: path for name, path in PROGRAM.items() if name.startswith("diecut_report.plugins.")}


@cache
def tree(name: str) -> ast.Module:
    return ast.parse(MODULES[name].read_text("utf-8"), str(MODULES[name]))


@cache
def statements(name: str) -> list[ast.AST]:
    """All statements of a module, and what holds some; expressions, which are most of a tree, hold none."""
    found: list[ast.AST] = [tree(name)]
    for node in found:
        inner = ast.iter_child_nodes(node)
        found += [child for child in inner if isinstance(child, ast.stmt | ast.excepthandler | ast.match_case)]
    return found


@cache
def imports(name: str) -> set[str]:
    """The modules that a module imports, anywhere in it; ``from package import module`` gives both."""
    package = name if MODULES[name].name == "__init__.py" else name.rpartition(".")[0]
    found: set[str] = set()
    for node in statements(name):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            above = package.split(".")[: len(package.split(".")) + 1 - node.level] if node.level else []
            source = ".".join([*above, *([node.module] if node.module else [])])
            found |= {source} | {f"{source}.{alias.name}" for alias in node.names}
    return found


def within(module: str, package: str) -> bool:
    return module == package or module.startswith(package + ".")


def own_imports(name: str) -> set[str]:
    if (
        name == "diecut_report"
    ):  # what it offers to scripts is loaded when it is asked for (tests/scripting/test_press.py)
        return set()
    return {module for module in imports(name) if module in PROGRAM} - {name}


def layer(name: str) -> int | None:
    """The place of a module of the program in the table; None for the three folders of plugins, templates, configs."""
    part = [*name.split("."), ""][1]
    return next((index for index, names in enumerate(LAYERS) if part in names), None)


def test_a_configuration_is_loaded_by_the_press_alone() -> None:
    loading = [name for name in PROGRAM if "diecut_report.config.loader.load_config" in imports(name)]
    assert loading == ["diecut_report.press"]


def test_each_module_of_the_program_has_its_place_in_the_table() -> None:
    outside = {"plugins", "templates", "configs"}
    assert [name for name in PROGRAM if layer(name) is None and name.split(".")[1] not in outside] == []


def test_imports_run_one_way() -> None:
    def allowed(mine: int, imported: str) -> bool:
        other = layer(imported)
        return other is not None and other <= mine

    places = {name: place for name in PROGRAM if (place := layer(name)) is not None}
    wrong = [(name, other) for name, mine in places.items() for other in own_imports(name) if not allowed(mine, other)]
    assert wrong == []


def test_imports_make_no_loop() -> None:
    # "from package import module" needs the module; the package's __init__ is counted only where it is meant
    graph = {name: {m for m in own_imports(name) if not within(name, m)} for name in PROGRAM}
    TopologicalSorter(graph).prepare()


def test_a_report_is_made_of_results_alone() -> None:
    allowed = {"report", "results", "text", "quantities", "errors", "files", "pictures", "time_limit", ""}
    parts = {(name, [*m.split("."), ""][1]) for name in PROGRAM if layer(name) == REPORT for m in own_imports(name)}
    assert {(name, part) for name, part in parts if part not in allowed} == set()


@pytest.mark.parametrize("library", ONLY_IN)
def test_a_library_is_imported_only_in_its_place(library: str) -> None:
    users = [name for name in PROGRAM if any(within(module, library) for module in imports(name))]
    assert [name for name in users if not re.match(ONLY_IN[library], name)] == []


def test_a_plugin_imports_only_what_it_may() -> None:
    for name in PLUGINS:
        allowed = FOR_PLUGINS | {".".join(name.split(".")[:3])}
        strange = {m for m in imports(name) if not any(within(m, package) or within(package, m) for package in allowed)}
        assert strange == set(), name


def test_a_plugin_holds_no_latex() -> None:
    def texts(name: str) -> Iterator[str]:
        return (n.value for n in ast.walk(tree(name)) if isinstance(n, ast.Constant) and isinstance(n.value, str))

    # a forgotten r before "\frac", "\theta", "\beta", "\rho" or "\alpha" leaves a control character
    latex = re.compile(r"\\[A-Za-z]|[\a\b\f\r\t\v]")
    assert [f"{name}: {text!r}" for name in PLUGINS for text in texts(name) if latex.search(text)] == []


def test_a_plugin_converts_no_units() -> None:
    converters = re.compile(r"\b(radians|degrees|deg2rad|rad2deg|to_display|parse_quantity)\b")
    assert [name for name, path in PLUGINS.items() if converters.search(path.read_text("utf-8"))] == []


def test_a_class_name_means_one_thing() -> None:
    homes: dict[str, list[str]] = {}
    for name in PROGRAM:
        for node in statements(name):
            if isinstance(node, ast.ClassDef):
                homes.setdefault(node.name, []).append(name)
    assert {name: modules for name, modules in homes.items() if len(modules) > 1} == {}


def test_functions_are_short() -> None:
    def too_long(name: str) -> Iterator[str]:
        for node in statements(name):
            if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef) and node.end_lineno is not None:
                lines = node.end_lineno - node.lineno + 1
                if lines > FUNCTION_LINES:
                    yield f"{MODULES[name].relative_to(ROOT)}:{node.lineno}: {node.name} has {lines} lines"

    assert [line for name in MODULES for line in too_long(name)] == []


def test_modules_are_short() -> None:
    paths = [path for name, path in MODULES.items() if not within(name, "tests")]  # a test's tables may be long
    lengths = {path.relative_to(ROOT): len(path.read_text("utf-8").splitlines()) for path in paths}
    assert {path: lines for path, lines in lengths.items() if lines > MODULE_LINES} == {}
