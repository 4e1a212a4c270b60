"""Small configs for tests, with the kinds of tests/plugins_for_tests."""

from __future__ import annotations

from pathlib import Path

from diecut_report import configs
from diecut_report.config.loader import Config, load_config
from diecut_report.config.plugins import Discovery
from diecut_report.errors import UserError
from diecut_report.results.warm_press import WarmPress

PLUGINS = Path(__file__).parent / "plugins_for_tests"
GOOD, BROKEN, LISTED = PLUGINS / "good", PLUGINS / "broken", PLUGINS / "listed"
YAML = sorted(path for folder in configs.__path__ for path in Path(folder).glob("*.yaml"))
STUDIES = [path for path in YAML if path.stem.endswith("_study")]
EXAMPLES = [path for path in YAML if path not in STUDIES]
EXAMPLE = next(path for path in EXAMPLES if path.name == "flat_cylinder_press.yaml")
MECHANISMS = EXAMPLE.with_name("flat_cylinder_mechanisms.yaml")  # the same without its timing
PARTS = (
    "flat_cylinder_elements",
    "flat_cylinder_mechanisms",
    "flat_cylinder_press_mended",
)  # have the kinds of EXAMPLE alone
ON_ARRAYS = [path for path in EXAMPLES if "kind: cyclogram" not in path.read_text(encoding="utf-8")]
DISCOVERY = Discovery([GOOD])
WARM = WarmPress(is_advised=False)  # calculates of a press only what is not as in the last few, and prints nothing

HEAD = """\
schema_version: 1
project: {title: Test}
press: {name: P, productivity: 6000 1/h, sheet: {length: 700 mm, thickness: 0.6 mm}}
mechanisms:
"""
SMALL = HEAD + "  clutch: {kind: clutch, torque: 300 N*m, shoe_radius: 120 mm, wedge_angle: 10 deg}\n"
LEVER = HEAD + "  a: {kind: lever, force: 2 kN}\n"


def saved(folder: Path, text: str, name: str = "press.yaml") -> Path:
    """The text as a file in the folder."""
    path = folder / name
    path.write_text(text, "utf-8")
    return path


def loaded(folder: Path, text: str, discovery: Discovery = DISCOVERY) -> Config:
    """The config that a text gives."""
    return load_config(saved(folder, text), discovery)


def problems(folder: Path, text: str, discovery: Discovery = DISCOVERY) -> list[str]:
    """What is wrong with a text, each as LINE:COLUMN: PATH: MESSAGE; a text that is right fails the test."""
    try:
        loaded(folder, text, discovery)
    except UserError as error:
        return [str(problem).removeprefix(f"{folder / 'press.yaml'}:") for problem in error.problems]
    raise AssertionError("no problem was found")
