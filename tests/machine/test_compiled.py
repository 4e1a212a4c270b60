"""Compiled curves against the plain formulas, each the other's proof: every mechanism of the examples, at random."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

from diecut_report.config.loader import Config, load_config
from diecut_report.config.model import PRESS
from diecut_report.config.plugins import Discovery
from diecut_report.machine.calculation import Calculation
from diecut_report.machine.numerics import curves as curve_evaluation
from diecut_report.machine.numerics.curves import MANY, Curves, Program
from diecut_report.mechanics.motion_laws import LAWS
from diecut_report.mechanism.inputs import Quantity
from diecut_report.mechanism.steps import Choice, Value
from diecut_report.study.definition.base_inputs import Input, UnknownPath, find_input, known_paths
from diecut_report.study.execution.press_batch import calculated
from tests.configs import ON_ARRAYS
from tests.examples import few

COUNT = 2 * MANY
SPREAD = 0.02  # of each number about that of the example
PLACES = 9  # in each smooth piece
KINDS = {"cam_gear_transport", "circular_knife", "cylinder_drive", "drive_train", "elastic_follower", "geneva_transport", "knife_drive",
         "platen_press"}  # fmt: skip

SLOW = ("flat_cylinder_elements", "platen_press_zppt30")
EXAMPLES_AT_HAND = few(
    ON_ARRAYS, keep=lambda path: path.stem != "flat_cylinder_elements"
)  # its curves are also in another


def stem(path: Any) -> str:
    """The name of a test by that of its file."""
    return str(path.stem)


def varied(base: Config, random: np.random.Generator) -> dict[Input, Any]:
    """All numbers that the example gives, each as an array about its value there."""
    found: dict[Input, Any] = {}
    for asked, value in numbers_given(base):
        found[asked] = float(asked.meta.validate(value)) * random.uniform(1 - SPREAD, 1 + SPREAD, COUNT)
    return found


def numbers_given(base: Config) -> Iterator[tuple[Input, Any]]:
    for name, instance in base.instances.items():
        for path in known_paths(base, name) if instance and name != PRESS else ():
            try:
                asked = find_input(base, path)
            except UnknownPath:  # a list that the example does not give
                continue
            value = _given(instance.data, asked.key) if instance else None
            words = getattr(asked.meta, "words", ())  # that stand for a number
            is_number = isinstance(value, int | float | str) and "${" not in str(value) and value not in words
            if is_number and asked.unit and isinstance(asked.meta, Quantity) and not asked.meta.integer:
                yield asked, value


def _given(data: Any, key: Any) -> Any:
    for part in key:
        data = data[part] if isinstance(data, list) else (data or {}).get(part)
    return data


def machines(base: Config, texts: dict[str, str], seed: int) -> dict[str, Calculation]:
    values = varied(base, np.random.default_rng(seed)) | {find_input(base, path): text for path, text in texts.items()}
    return calculated(base, values, COUNT).calculations


def axes(calc: Calculation) -> Iterator[tuple[str, list[str]]]:
    for axis in calc.domains:
        yield axis, [name for name in calc.curves if calc.axis[name] == axis]


def assert_alike(calc: Calculation, axis: str, curves: list[str], seed: int) -> None:
    """The compiled curves are the plain ones to 1e-12 of the greatest term, at random places of random pieces."""
    pieces = calc.table(axis).pieces()
    possible = [row for row in range(len(pieces.left)) if pieces.variant[row] not in calc.flaws]
    middle, variant = pieces.middle[possible], pieces.variant[possible]
    shares = np.random.default_rng(seed).uniform(0.001, 0.999, (len(possible), PLACES))
    x = pieces.left[possible][:, None] + pieces.width[possible][:, None] * shares
    with np.errstate(all="ignore"):
        compiled = Curves(calc, axis, curves, middle, variant)
        assert compiled.program is not None
        plain = calc.sampler_of(axis, x, middle[:, None], variant)
        for name, found in zip(curves, compiled.at(x), strict=True):
            expected = np.broadcast_to(plain[name], x.shape)
            scale = np.nanmax(np.abs(expected), initial=0) + _terms(calc, axis, name, plain)
            np.testing.assert_allclose(found, expected, rtol=1e-12, atol=1e-12 * scale, err_msg=name)


def _terms(calc: Calculation, axis: str, name: str, plain: Any) -> float:
    """The greatest of what a curve is made of, of any kind of quantity over the abscissa."""
    step = calc.curves[name]
    taken = [n for n in step.takes() if isinstance(n, str)] if isinstance(step, Value | Choice) else []
    sizes = [np.nanmax(np.abs(np.asarray(plain[n], dtype=float)), initial=0) for n in taken if calc.axis.get(n) == axis]
    return max(map(float, sizes), default=0.0)


@pytest.mark.parametrize("path", few(ON_ARRAYS, lambda path: path.stem not in SLOW), ids=stem)
def test_compiled_curves_are_the_plain_formulas(path: Any) -> None:
    base = load_config(path, Discovery([]))
    for seed in range(2):
        found = machines(base, {}, seed)
        assert found
        for calc in found.values():
            assert len(calc.flaws) < COUNT
            for axis, curves in axes(calc):
                assert_alike(calc, axis, curves, seed)


@pytest.mark.parametrize("law", few(LAWS, keep=lambda law: law == "modified_trapezoidal"))
def test_compiled_motion_laws_are_the_plain_formulas(law: str) -> None:
    base = load_config(next(path for path in ON_ARRAYS if path.stem == "flat_cylinder_mechanisms"), Discovery([]))
    calc = machines(base, {"mechanisms.feeder.motion_law": law}, 3)["feeder"]
    assert calc.inputs["motion_law"] == law
    for axis, curves in axes(calc):
        assert_alike(calc, axis, curves, 3)


def test_all_kinds_that_have_curves_are_compared() -> None:
    found = {
        instance.mechanism.kind
        for path in ON_ARRAYS
        for instance in load_config(path, Discovery([])).instances.values()
        if instance and instance.mechanism and instance.mechanism.axes(instance.given)
    }
    assert found >= KINDS


def test_the_comparison_sees_a_wrong_term(monkeypatch: pytest.MonkeyPatch) -> None:
    base = load_config(next(path for path in ON_ARRAYS if path.stem == "flat_cylinder_mechanisms"), Discovery([]))
    calc = machines(base, {}, 0)["drive"]

    class Wrong(Program):
        def _constant(self, value: float) -> str:
            return super()._constant(value * (1 + 1e-9))

    monkeypatch.setattr(curve_evaluation, "program", lambda curves, *rest: Wrong(dict(curves), *rest))
    with pytest.raises(AssertionError):
        assert_alike(calc, "crank_angle", ["rocker_speed_ratio"], 0)
