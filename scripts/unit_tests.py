"""Which tests are about a plugin or a module of mechanics; for scripts/change_signs.py and scripts/mutate.py."""

from __future__ import annotations

import ast
from functools import cache
from pathlib import Path

ROOT = Path(__file__).parents[1]
PLUGINS, MECHANICS = ROOT / "plugins", ROOT / "diecut_report" / "mechanics"
SHARED = {"tests.machines", "tests.configs", "tests.plugins.cases"}  # helpers of everything: they tell nothing
BY_NAME = {"cylinder_drive", "cylinder_sizing"}  # reached through tests.machines: their tests are found by their names
THROUGH = {  # what has no test file of its own, or one that tests a part: what it is tested through
    "mechanics.chebyshev_sums": ("mechanics.piece_rows",),
    "mechanics.circular_segment": ("cylinder_sizing", "cylinder_drive", "circular_knife"),
    "mechanics.common": ("cylinder_sizing", "damper", "drive_train", "cylinder_drive", "circular_knife"),
    "mechanics.gripping": ("geneva_transport",),
    "mechanics.load_cases": ("parallel_key", "gear_pair"),
    "mechanics.modified_laws": ("mechanics.motion_laws",),
    "mechanics.polynomial_laws": ("mechanics.motion_laws",),
    "mechanics.shaft_curves": ("cyclogram",),
    "mechanics.triangle": ("drive_train", "mechanics.four_bar"),
    "mechanics.turn_samples": ("cyclogram",),
    "press_consistency": ("cyclogram",),
}
OF_ALL = {"test_contract", "test_rows", "test_page"}  # of every plugin
PAPERS = {"cylinder_drive": "source_000", "cylinder_sizing": "source_000"}


@cache
def units() -> dict[str, list[Path]]:
    """The files of each plugin and of each module of mechanics, by its name."""
    found = {}
    for path in sorted(PLUGINS.iterdir()):
        if not path.name.startswith(("_", ".")) and (path.is_dir() or path.suffix == ".py"):
            found[path.stem] = sorted(path.rglob("*.py")) if path.is_dir() else [path]
    modules = [path for path in sorted(MECHANICS.rglob("*.py")) if path.name != "__init__.py"]
    return found | {f"mechanics.{path.stem}": [path] for path in modules}


def tests_of(unit: str) -> list[str]:
    """The test files that use a plugin or module."""
    through = [file for other in THROUGH.get(unit, ()) for file in tests_of(other)]
    place = (
        units()[unit][0].relative_to(ROOT).with_suffix("") if unit.startswith("mechanics.") else Path("plugins") / unit
    )
    package = ".".join(["diecut_report", *(part for part in place.parts if part != "diecut_report")])
    found = [
        path
        for name in ("validation", package.split(".")[1])
        for path in sorted((ROOT / "tests" / name).rglob("test_*.py"))
    ]
    files = [path for path in found if path.stem not in OF_ALL and is_about(path, unit, package)]
    return [*(str(path.relative_to(ROOT)) for path in files), *through]


def tests_asked(unit: str) -> list[list[str]]:
    """What pytest is asked for, one run after the other."""
    rows = ["tests/validation/test_rows.py", "-k", PAPERS.get(unit, f"rows_{unit}")]
    has_rows = unit in PAPERS or (ROOT / "tests" / "validation" / f"rows_{unit}.py").is_file()
    contract = ["tests/plugins/test_contract.py", "-k", unit] if (ROOT / "plugins" / unit).is_dir() else []
    asked = [some for some in (rows if has_rows else [], tests_of(unit), contract) if some]
    if not asked:
        raise SystemExit(f"{unit} has no tests")
    return asked


def is_about(test: Path, unit: str, package: str) -> bool:
    """Whether a test file is about a plugin or module: by its name, or because it or a helper of it imports that."""
    if unit in BY_NAME:
        return unit in test.stem or test.stem == PAPERS[unit].replace("source", "test")
    module = ".".join(test.relative_to(ROOT).with_suffix("").parts)
    return any(f"{name}.".startswith(f"{package}.") for name in reached(module))


@cache
def reached(module: str) -> frozenset[str]:
    """The modules that a module of the tests imports, itself or through others of the tests."""
    path = ROOT.joinpath(*module.split(".")).with_suffix(".py")
    if module in SHARED or not path.is_file():
        return frozenset()
    found: set[str] = set()
    for node in ast.walk(ast.parse(path.read_bytes())):
        if isinstance(node, ast.ImportFrom) and node.module:
            found |= {node.module} | {f"{node.module}.{alias.name}" for alias in node.names}
        elif isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
    own = {name for name in found if name.startswith("tests.")}
    return frozenset(found).union(*map(reached, own)) if own else frozenset(found)
