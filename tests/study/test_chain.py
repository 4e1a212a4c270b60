"""Many machines at once against each one alone: the same numbers, verdicts and reasons."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml

from diecut_report.config.instances import slots
from diecut_report.config.loader import Config, load_config
from diecut_report.config.model import PRESS
from diecut_report.config.plugins import Discovery
from diecut_report.config.yaml import parse
from diecut_report.errors import UserError
from diecut_report.mechanism.inputs import Quantity
from diecut_report.mechanism.names import SI
from diecut_report.results.document import document
from diecut_report.results.press_run import compute
from diecut_report.study.definition.base_inputs import find_input, with_values
from diecut_report.study.execution.variant_rows import Rows, calculate_rows, columns_of
from tests.configs import EXAMPLE, EXAMPLES, HEAD, loaded
from tests.examples import few

Values = Mapping[str, Any]
ELEMENTS = {"gear_pair", "parallel_key", "roller_chain", "rolling_bearing", "shaft"}  # kinds
VARIED: dict[str, dict[str, tuple[float, float] | list[str]]] = {
    "flat_cylinder_mechanisms.yaml": {
        "mechanisms.drive.crank_speed": (4.0, 12.0), "mechanisms.cylinder.bore_radius": (0.03, 0.12),
        "press.sheet.thickness": (3e-4, 1.2e-3), "press.productivity": (0.5, 2.5), "mechanisms.feeder.motion_law": ["cycloidal", "modified_sine"],
    },
    "flat_cylinder_press.yaml": {
        "press.productivity": (1.2, 2.2), "mechanisms.cylinder.bore_radius": (0.03, 0.12), "press.sheet.thickness": (3e-4, 1.2e-3),
        "mechanisms.feeder.motion_law": ["cycloidal", "modified_sine"],
    },
    "flat_cylinder_belt_press.yaml": {"press.productivity": (0.5, 1.6)},
    "folding_knife.yaml": {"mechanisms.knife.cylinder_rate": (2.0, 9.0), "mechanisms.knife.working_depth": (0.02, 0.06)},
    "platen_press_zppt30.yaml": {"mechanisms.platen.drive_deformation": (1e-4, 2e-3), "mechanisms.platen.friction": (0.01, 0.3)},
    "circular_knife.yaml": {"mechanisms.knife.eccentricity": (0.005, 0.06), "mechanisms.knife.front_distance": (0.01, 0.06)},
    "elastic_transport.yaml": {"mechanisms.conveyor.stiffness": (330.0, 6e3), "mechanisms.transport.motion_law": ["cycloidal", "polynomial_345"]},
}  # fmt: skip

pytestmark = pytest.mark.usefixtures("without_advice")  # rows have none


def config(name: str) -> Config:
    return load_config(next(path for path in EXAMPLES if path.name == name), Discovery([]))


def drawn(name: str, count: int) -> dict[str, Any]:
    """Random values, SI: a few inputs vary widely, all other numbers of the file a little."""
    random = np.random.default_rng(7)
    widely = {path: random.uniform(*limits, count) if isinstance(limits, tuple) else [limits[i % len(limits)] for i in range(count)]
              for path, limits in VARIED[name].items()}  # fmt: skip
    return {path: value * random.uniform(0.98, 1.02, count) for path, value in given_numbers(config(name))} | widely


def given_numbers(base: Config) -> Iterator[tuple[str, float]]:
    """The numbers that stand in the file, but for whole ones, by path, SI."""
    for instance in filter(None, base.instances.values()):
        for slot in slots(instance.model, instance.data):
            is_reference = isinstance(slot.value, str) and "${" in slot.value
            if not slot.is_given or is_reference or not isinstance(slot.meta, Quantity) or slot.meta.integer:
                continue
            home = PRESS if instance.name == PRESS else f"mechanisms.{instance.name}"
            value = instance.value(slot.key)
            if isinstance(value, int | float):  # no word, and no time in place of an angle
                yield ".".join(map(str, (home, *slot.key))), float(value)


def together(base: Config, values: Values, count: int, curves: Sequence[str] = ()) -> Rows:
    return calculate_rows(base, {find_input(base, path): column for path, column in values.items()}, count, curves)


def alone(base: Config, values: Values, row: int) -> dict[str, Any] | str:
    """The results document of the machine of one row, or why it cannot exist."""
    known: dict[Any, Any] = {}
    for path, column in values.items():
        asked, value = find_input(base, path), column[row]
        known[asked] = value if asked.unit is None else SI(float(value), asked.unit, asked.path)
    changed, problems = with_values(base, known)
    assert not problems
    try:
        return document(compute(changed, lambda _: None)).data()
    except UserError as error:
        return str(error)


def same(one: Any, other: Any, within: float) -> bool:
    if isinstance(one, float) and isinstance(other, int | float) and not isinstance(other, bool):
        return math.isclose(one, other, rel_tol=1e-12, abs_tol=within)
    return bool(one == other)


def rounding(mechanism: dict[str, Any], unit: str) -> float:
    """What two ways of calculating may differ by: 1e-12 of the greatest term of a formula, and 1e-6 in places of extremes."""
    if unit == "rad":
        return 1e-6
    known = [*mechanism["outputs"].values(), *mechanism["inputs"].values()]
    alike = [abs(k["value"]) for k in known if k["unit"] == unit and isinstance(k["value"], float)]
    return 1e-12 * max(alike, default=0.0)


@pytest.mark.parametrize(
    ("name", "count"),
    few([("flat_cylinder_press.yaml", 2), ("elastic_transport.yaml", 2)], keep=lambda one: "elastic" in one[0]),
)
def test_each_machine_among_many_is_the_one_alone(name: str, count: int) -> None:
    """Through references from mechanism to mechanism; each kind on its own is held to it in tests/plugins/test_contract.py."""
    check_rows(name, count)


@pytest.mark.nightly
@pytest.mark.parametrize("name", VARIED)
def test_each_machine_among_more_is_the_one_alone(name: str) -> None:
    check_rows(name, 16)


def check_rows(name: str, count: int) -> None:
    """Hold the rows of machines against the results of each."""
    base, values = config(name), drawn(name, count)
    rows = together(base, values, count)
    assert not rows.slow
    for row in range(count):
        found = alone(base, values, row)
        if isinstance(found, str):
            assert rows.status[row] == "error"
            assert rows.errors[row].split(": ", 1)[1] in found
            continue
        assert rows.status[row] == found["status"], rows.errors[row]
        _same_numbers(rows, row, found)


def without_elements() -> Config:
    """The press of the example without its machine elements, to which nothing else refers."""
    data = yaml.safe_load(EXAMPLE.read_text("utf-8"))
    kept = {name: block for name, block in data["mechanisms"].items() if block["kind"] not in ELEMENTS}
    text = yaml.safe_dump(data | {"mechanisms": kept}, sort_keys=False, allow_unicode=True)
    return load_config(parse(text, "press.yaml"), Discovery([]))


@pytest.mark.nightly
def test_machines_whose_lines_run_at_unlike_rates_are_told_apart() -> None:
    """What needs the sum of the torques is not calculated for them, and the others keep it."""
    base, values = without_elements(), {"mechanisms.drive.crank_speed": np.array([40.0, 50.0]) * math.pi / 30}
    rows = together(base, values, 2)
    assert list(rows.columns["timing.checks.equal_rates.status"]) == ["fail", "pass"]
    for row in range(2):
        found = alone(base, values, row)
        assert isinstance(found, dict)
        assert rows.status[row] == found["status"] == "fail"
        is_skipped = found["mechanisms"]["train"]["status"] == "skipped"
        assert is_skipped == bool(np.isnan(rows.columns["train.motor_power"][row]))
        kept = {name: each for name, each in found["mechanisms"].items() if each["status"] != "skipped"}
        _same_numbers(rows, row, {"mechanisms": kept})


def _same_numbers(rows: Rows, row: int, found: dict[str, Any]) -> None:
    for name, mechanism in found["mechanisms"].items():
        for key, output in mechanism["outputs"].items():
            if f"{name}.{key}" not in rows.columns:  # rows over places, which are known only once a shaft is calculated
                assert "place_" in key or "power_reversal_" in key
                continue
            value, within = output["value"], rounding(mechanism, output["unit"])
            own, is_residual = rows.columns[f"{name}.{key}"][row], key.endswith("_residual")  # judged by its check
            assert is_residual or same(own, value, within), (key, own, value)
        for check in mechanism["checks"]:
            if check["class"] == "numerical":  # one that fails makes the variant an error
                continue
            column, used = f"{name}.checks.{check['id']}", check["utilisation"]
            ratio, status = (rows.columns[f"{column}.{part}"][row] for part in ("utilisation", "status"))
            assert status == check["status"], column
            is_residual = max(ratio, used or 0) < 1e-3
            assert is_residual or same(ratio, used, 0) or (math.isnan(ratio) and used is None), column


def test_an_output_that_a_machine_does_not_have_is_empty() -> None:
    name, count = "flat_cylinder_mechanisms.yaml", 8
    base, values = config(name), drawn(name, count)
    rows = together(base, values, count)
    kept = {key: values for key, values in rows.columns.items() if key.startswith("drive.flank_change")}
    assert kept["drive.flank_change_count"].min() >= 1
    for row in range(count):
        places = [values[row] for key, values in kept.items() if not key.endswith("count")]
        assert np.isfinite(places).sum() == min(kept["drive.flank_change_count"][row], len(places))


@pytest.mark.nightly
def test_curves_come_on_demand_as_each_machine_alone_has_them() -> None:
    name, curves = "flat_cylinder_mechanisms.yaml", ("crank_torque", "crank_angle")
    base, values = config(name), drawn(name, 2)
    rows = together(base, values, 2, [f"drive.{curve}" for curve in curves])
    for row in np.flatnonzero(rows.status != "error"):
        found = alone(base, values, row)
        assert not isinstance(found, str)
        for curve in curves:
            own = np.array(found["mechanisms"]["drive"]["curves"][curve]["values"])
            within = 1e-12 * np.abs(own).max()
            np.testing.assert_allclose(rows.columns[f"drive.{curve}"][row], own, rtol=0, atol=within)


@pytest.mark.parametrize("name", VARIED)
def test_the_columns_are_known_before(name: str) -> None:
    base = config(name)
    first = {path: column[:1] for path, column in drawn(name, 1).items()}
    declared = {column.name for column in columns_of(base)}
    assert set(together(base, first, 1).columns) <= declared


@pytest.mark.nightly
def test_machines_with_unlike_numbers_of_samples_have_the_curves_that_they_ask_for() -> None:
    points = {"mechanisms.drive.n_points": np.array([90.0, 180.0, 90.0])}
    rows = together(config("flat_cylinder_mechanisms.yaml"), points, 3, ["drive.crank_torque"])
    assert not rows.slow
    assert [len(values) for values in rows.columns["drive.crank_torque"]] == [90, 180, 90]
    peaks = rows.columns["drive.crank_torque_peak"]
    np.testing.assert_allclose(peaks, peaks[0], rtol=1e-12)


GEARS = """\
  pair:
    {kind: gear_pair, module: 4 mm, teeth_1: 30, teeth_2: 60, face_width: 40 mm, torque: 300 N*m, speed: 1500 rpm, grade: 6,
     slope: 0.1 mrad, sigma_h_lim_1: 767 MPa, sigma_h_lim_2: 767 MPa, sigma_f_lim_1: 314 MPa, sigma_f_lim_2: 314 MPa}
"""


def test_gears_of_which_some_are_too_fast_for_their_method_are_rated_as_each_alone(tmp_path: Path) -> None:
    base = loaded(tmp_path, HEAD + GEARS, Discovery([]))
    values = {"mechanisms.pair.speed": np.array([1000.0, 2500.0, 9000.0, 40_000.0]) * math.pi / 30}
    rows = together(base, values, 4)
    for row in range(4):
        found = alone(base, values, row)
        assert not isinstance(found, str)
        assert rows.status[row] == found["status"], rows.errors[row]
        _same_numbers(rows, row, found)
        assert math.isnan(rows.columns["pair.pitting_safety_1"][row]) == (row > 0)
