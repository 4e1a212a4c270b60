"""A key that takes a number or a curve: the curve stands under its own key, wherever it was typed."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import pytest

from diecut_report.config import references
from diecut_report.config.instances import Instance
from diecut_report.config.plugins import Discovery
from diecut_report.config.references import Linker
from diecut_report.config.schema import block_schema
from diecut_report.errors import UserError
from diecut_report.plugins.gear_pair.inputs import ExternalGearPair
from tests.configs import HEAD, loaded, problems

DRIVE = (
    "  drive: {kind: cylinder_drive, crank_speed: 100 rpm, cylinder_radius: 105 mm, cylinder_length: 700 mm, cylinder_mass: 80 kg,\n"
    "          cylinder_inertia: 0.973 kg*m**2, material_thickness: 0.6 mm}\n"
)
STEEL = "sigma_h_lim_1: 767 MPa, sigma_h_lim_2: 767 MPa, sigma_f_lim_1: 314 MPa, sigma_f_lim_2: 314 MPa"
PLUGINS = Discovery([])


def gears(name: str, torque: str, more: str = "") -> str:
    """A gear pair of a config."""
    return f"  {name}: {{kind: gear_pair, module: 4 mm, teeth_1: 35, teeth_2: 212, face_width: 40 mm, {torque}, {STEEL}{more}}}\n"


def test_a_reference_to_a_curve_stands_under_the_key_of_the_curve(tmp_path: Path) -> None:
    text = HEAD + gears("sector", 'torque: "${drive.total_moment}"') + DRIVE
    config = loaded(tmp_path, text, PLUGINS)
    instance = config.instances["sector"]
    assert instance is not None and "torque_curve" in instance.given and "torque" not in instance.given
    assert config.links["sector", "torque_curve"].is_curve
    assert instance.results["tangential_force_curve"] == ("N", True)


@pytest.mark.parametrize("torque", ["torque: 12 N*m", 'torque: "${drive.crank_torque_max}"'])
def test_a_number_stays_where_it_is(torque: str, tmp_path: Path) -> None:
    instance = loaded(tmp_path, HEAD + gears("sector", torque) + DRIVE, PLUGINS).instances["sector"]
    assert instance is not None and "torque" in instance.given and "torque_curve" not in instance.given


def test_a_list_is_a_curve(tmp_path: Path) -> None:
    instance = loaded(tmp_path, HEAD + gears("sector", "torque: [1, 2, 3, -4]"), PLUGINS).instances["sector"]
    assert instance is not None and instance.data["torque_curve"] == [1, 2, 3, -4]


def test_a_curve_of_a_pair_that_has_one_only_by_a_curve_is_found(tmp_path: Path) -> None:
    """The first one refers to a curve that the second gives only since its own torque is a curve."""
    first = gears("first", 'torque: "${second.torque_pinion_curve}"')
    text = HEAD + first + gears("second", 'torque: "${drive.total_moment}"') + DRIVE
    instance = loaded(tmp_path, text, PLUGINS).instances["first"]
    assert instance is not None and "torque_curve" in instance.given


def test_a_fault_is_told_where_the_curve_was_typed(tmp_path: Path) -> None:
    text = HEAD + gears("sector", 'torque: "${drive.transmission_angle}"') + DRIVE
    with pytest.raises(UserError) as refused:
        loaded(tmp_path, text, PLUGINS)
    [problem] = refused.value.problems
    assert problem.path == "mechanisms.sector.torque" and "is not a curve in N*m" in problem.message


def test_both_keys_are_too_many(tmp_path: Path) -> None:
    text = HEAD + gears("sector", 'torque: "${drive.total_moment}", torque_curve: "${drive.total_moment}"') + DRIVE
    with pytest.raises(UserError, match="torque and torque_curve are both given"):
        loaded(tmp_path, text, PLUGINS)


def test_the_schema_allows_a_list_too() -> None:
    ways = block_schema(ExternalGearPair, True)["properties"]["torque"]["anyOf"]
    assert any(way.get("type") == "array" for way in ways) and any(way.get("type") == "number" for way in ways)


def test_curves_of_several_mechanisms_are_laid_under_their_keys_together(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    made: list[Linker] = []

    class CountedLinker(Linker):
        def __init__(self, instances: Mapping[str, Instance | None]) -> None:
            made.append(self)
            super().__init__(instances)

    monkeypatch.setattr(references, "Linker", CountedLinker)
    torque = 'torque: "${drive.total_moment}"'
    text = HEAD + "".join(gears(name, torque) for name in ("first", "next", "last")) + DRIVE
    instances = loaded(tmp_path, text, PLUGINS).instances
    assert all("torque_curve" in instances[name].given for name in ("first", "next", "last") if instances[name])
    assert len(made) == 2


# A curve that comes from one of two inputs: where neither is given, or the list of points is empty, the configuration is at fault.


PLUGIN = '''"""A load over a way, point by point or as a curve."""

from typing import Any, ClassVar

import numpy as np

from diecut_report.api import (
    Block,
    Chapter,
    CurveInput,
    Inputs,
    Mechanism,
    OneOf,
    Quantity,
    abscissa,
    from_curve,
    m,
    parts,
    reduction,
    samples,
    total,
    value,
)


class Point(Block):
    force = Quantity("F_i", "N", "Load there")


class Way(Inputs):
    one_of = (OneOf(("points",), ("curve",)),)
    stroke = Quantity("s", "mm", "Stroke", gt=0, default=60)
    points = parts(Point, "Load, point by point", optional=True)
    curve = CurveInput("F_c", "N", "Load as a curve", optional=True)
    n_points = samples(36)


load = Chapter("Load")
load.place = abscissa(period="stroke"), "x", "mm", "Way"
load.greatest = total("max", of="points.force", needs=("points.force",)), "F_g", "N", "Greatest point"
load.force = value(m.greatest * m.place / m.stroke, needs=("points.force",)), "F", "N", "Load"
load.force = from_curve(given="curve", abscissa="place", needs=("curve",)), "F", "N", "Load"
load.peak = reduction("max", of="force"), "F_max", "N", "Greatest load"
MECHANISM = Mechanism(kind="way", version="1", title="Way", summary="A way.", inputs=Way, chapters=(load,))
'''
WAY = "schema_version: 1\nproject: {title: T}\npress: {name: P, productivity: 6000 1/h}\nmechanisms:\n  a: {kind: way%s}\n"


@pytest.mark.parametrize("given", ["", ", points: []"])
def test_neither_is_told_of_the_configuration(tmp_path: Path, given: str) -> None:
    (tmp_path / "way.py").write_text(PLUGIN, encoding="utf-8")
    (told,) = problems(tmp_path, WAY % given, Discovery([tmp_path]))
    assert told.endswith("mechanisms.a: points, or curve is needed.")
