"""Small studies for tests: a base of two levers, and studies of it."""

from __future__ import annotations

from pathlib import Path

from diecut_report.config.plugins import Discovery
from diecut_report.errors import UserError
from diecut_report.study.definition.study_file import Study, load_study
from tests.configs import DISCOVERY, HEAD, saved

BASE = HEAD + (
    "  a: {kind: lever, force: 2 kN, arm: 200 mm, parts: [{length: 10 mm}, {length: 20 mm}]}\n"
    "  b: {kind: lever, force: '${a.force}', arm: '${a.arm}', width: '${a.length}', grade: coarse}\n"
)
STUDY = """\
schema_version: 1
base: press.yaml
sample: {method: grid}
vary:
  mechanisms.a.force: [1 kN, 2, 3000 N]
  mechanisms.a.grade: [fine, coarse]
"""


def study(folder: Path, text: str = STUDY, base: str = BASE, discovery: Discovery = DISCOVERY) -> Study:
    """The study that a text gives, of this base."""
    saved(folder, base)
    return load_study(saved(folder, text, "study.yaml"), discovery)


def varied(values: str, *, sample: str = "{method: grid}", rest: str = "", path: str = "mechanisms.a.force") -> str:
    """The text of a study of one path."""
    return f"schema_version: 1\nbase: press.yaml\nsample: {sample}\nvary:\n  {path}: {values}\n{rest}"


def faults(folder: Path, text: str, base: str = BASE, discovery: Discovery = DISCOVERY) -> list[str]:
    """What is wrong with a study, each as FILE:LINE:COLUMN: KEY: MESSAGE; a study that is right fails the test."""
    try:
        study(folder, text, base, discovery)
    except UserError as error:
        return [str(problem).replace(f"{folder}/", "") for problem in error.problems]
    raise AssertionError("no problem was found")
