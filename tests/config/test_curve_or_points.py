"""A curve that comes from one of two inputs: where neither is given, or the list of points is empty, the configuration is at fault."""

from __future__ import annotations

from pathlib import Path

import pytest

from diecut_report.config.plugins import Discovery
from tests.configs import problems

PLUGIN = '''"""A load over a way, point by point or as a curve."""

from typing import Any, ClassVar

import numpy as np

from diecut_report.api import POINTS, Annotated, Block, Chapter, CurveInput, Inputs, Mechanism, OneOf, Quantity, Text


class Point(Block):
    force: Annotated[float, Quantity("F_i", "N", "Load there")]


class Way(Inputs):
    one_of: ClassVar[tuple[OneOf, ...]] = (OneOf(("points",), ("curve",)),)
    stroke: Annotated[float, Quantity("s", "mm", "Stroke", gt=0)] = 60
    points: Annotated[list[Point] | None, Text("Load, point by point")] = None
    curve: Annotated[Any | None, CurveInput("F_c", "N", "Load as a curve")] = None
    n_points: Annotated[int, POINTS] = 36


load = Chapter("Load")
load.abscissa("place", "x", "mm", "Way", period="stroke")
load.total("greatest", "F_g", "N", "Greatest point", "max", of="points.force", needs=("points.force",))
load.value("force", "F", "N", "Load", lambda greatest, place, stroke: greatest * place / stroke, needs=("points.force",))
load.from_curve("force", "F", "N", "Load", given="curve", abscissa="place", needs=("curve",))
load.reduction("peak", "F_max", "N", "Greatest load", "max", of="force")
MECHANISM = Mechanism(kind="way", version="1", title="Way", summary="A way.", inputs=Way, chapters=(load,))
'''
HEAD = "schema_version: 1\nproject: {title: T}\npress: {name: P, productivity: 6000 1/h}\nmechanisms:\n  a: {kind: way%s}\n"


@pytest.mark.parametrize("given", ["", ", points: []"])
def test_neither_is_told_of_the_configuration(tmp_path: Path, given: str) -> None:
    (tmp_path / "way.py").write_text(PLUGIN, encoding="utf-8")
    (told,) = problems(tmp_path, HEAD % given, Discovery([tmp_path]))
    assert told.endswith("mechanisms.a: points, or curve is needed.")
