"""Samples against brute force, their distributions by moments and by the test of Kolmogorov and Smirnov."""

from __future__ import annotations

import itertools
import math
import pickle
import tracemalloc
from collections import Counter
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats

from diecut_report.formulas import Array
from diecut_report.study.definition.samples import (
    ChoiceVariable,
    Distribution,
    Grid,
    LatinHypercube,
    RangeVariable,
    Sample,
    SampleError,
    Sobol,
    TableSample,
    Variable,
    Zip,
)
from diecut_report.study.summary.best import sobol_indices
from tests.examples import examples

SPEED = RangeVariable("drive.crank_speed", 4.0, 12.0, 5)
RADIUS = ChoiceVariable("cylinder.bore_radius", (0.055, 0.06, 0.065))
LAW = ChoiceVariable("drive.motion_law", ("cycloidal", "harmonic"))
TEETH = RangeVariable("train.teeth", 17, 23, 4, integer=True)
MIXED: tuple[Variable, ...] = (
    SPEED,
    LAW,
    TEETH,
    Distribution("mass", "uniform", 2.0, 5.0),
    Distribution("gap", "normal", middle=1e-3, sd=1e-4, low=0.8e-3),
    Distribution("friction", "triangular", 0.1, 0.2, 0.12),
)
SAMPLES: dict[str, Callable[[int], Sample]] = {
    "latin hypercube": lambda count: LatinHypercube(MIXED, count, seed=3),
    "sobol": lambda count: Sobol(MIXED, count, seed=3),
    "indices": lambda count: Sobol(MIXED, count, seed=3, indices=True),
    "grid": lambda count: Grid((LAW, RangeVariable("x", 0.0, 1.0, count), TEETH)),
    "zip": lambda count: Zip((RangeVariable("y", 2.0, 5.0, count), RangeVariable("x", 1.0, 0.1, count, log=True))),
    "table": lambda count: TableSample({"x": np.arange(count) * 0.1, "law": [f"law {i}" for i in range(count)]}),
}
SHARES = (np.arange(200_000) + 0.5) / 200_000


def whole(sample: Sample) -> dict[str, Any]:
    return sample.rows(0, sample.count)


def numbers(variable: Variable, share: Array = SHARES) -> Array:
    values = variable.quantile(share)
    assert isinstance(values, np.ndarray)
    return values


def as_lists(rows: dict[str, Any]) -> dict[str, list[Any]]:
    return {path: list(values) for path, values in rows.items()}


# --- grid, zip, table ------------------------------------------------------------------------------------------------


def test_a_grid_is_the_product_with_the_first_path_slowest() -> None:
    sample = Grid((SPEED, LAW, RADIUS))
    expected = list(itertools.product([4.0, 6.0, 8.0, 10.0, 12.0], ["cycloidal", "harmonic"], [0.055, 0.06, 0.065]))
    assert sample.count == 30
    rows = whole(sample)
    assert list(rows) == ["drive.crank_speed", "drive.motion_law", "cylinder.bore_radius"]
    assert list(zip(*rows.values(), strict=True)) == expected


def test_a_grid_of_a_million_by_a_million_says_its_size_and_gives_its_last_row() -> None:
    sample = Grid((RangeVariable("a", 0.0, 1.0, 10**6), RangeVariable("b", 5.0, 7.0, 10**6), LAW))
    assert sample.count == 2 * 10**12
    last = sample.rows(sample.count - 3, sample.count)
    assert list(last["a"]) == [1.0, 1.0, 1.0]
    assert list(last["b"]) == [pytest.approx(7 - 2e-6, abs=1e-9), 7.0, 7.0]
    assert last["drive.motion_law"] == ["harmonic", "cycloidal", "harmonic"]


def test_zipped_lists_and_rows_of_a_table_go_together() -> None:
    sample: Sample = Zip((RADIUS, RangeVariable("x", 3.0, 1.0, 3)))
    assert as_lists(whole(sample)) == {"cylinder.bore_radius": [0.055, 0.06, 0.065], "x": [3.0, 2.0, 1.0]}
    sample = TableSample({"x": np.array([1.0, 2.0, 3.0]), "law": ["a", "b", "c"]})
    assert sample.count == 3
    assert as_lists(sample.rows(1, 3)) == {"x": [2.0, 3.0], "law": ["b", "c"]}


def test_a_range_has_equal_steps_or_ratios() -> None:
    even, ratios = RangeVariable("x", 0.1, 0.7, 7), RangeVariable("x", 0.1, 30.0, 7, log=True)
    np.testing.assert_allclose(even.at(np.arange(7)), np.linspace(0.1, 0.7, 7), rtol=1e-15)
    np.testing.assert_allclose(ratios.at(np.arange(7)), np.geomspace(0.1, 30.0, 7), rtol=1e-14)


@pytest.mark.parametrize("log", [False, True])
def test_the_ends_of_a_range_are_exactly_those_given_and_nothing_lies_beyond(log: bool) -> None:
    for low, high in np.random.default_rng(4).uniform(0.01, 3.0, (300, 2)).tolist():
        values = RangeVariable("x", low, high, 7, log=log).at(np.arange(7))
        assert (values[0], values[-1]) == (low, high)
        drawn = numbers(RangeVariable("x", low, high, log=log), np.array([1e-300, 1 - 1e-16]))
        assert min(low, high) <= drawn.min() <= drawn.max() <= max(low, high)


@pytest.mark.parametrize("integer", [False, True])
@pytest.mark.parametrize("log", [False, True])
def test_a_descending_range_descends(integer: bool, log: bool) -> None:
    drawn = numbers(RangeVariable("x", 9, 2, log=log, integer=integer), np.array([0.01, 0.3, 0.6, 0.99]))
    assert list(drawn) == sorted(drawn, reverse=True)
    assert drawn[0] > 8.5


@given(st.integers(-50, 50), st.integers(1, 60), st.data())
def test_whole_numbers_of_a_range_are_different_and_nearest_to_equal_steps(low: int, span: int, data: Any) -> None:
    count = data.draw(st.integers(2, span + 1))
    values = RangeVariable("x", low, low + span, count, integer=True).at(np.arange(count))
    assert len(set(values)) == count
    assert np.all(values == np.round(values))
    np.testing.assert_allclose(values, np.linspace(low, low + span, count), atol=0.5 + 1e-9)
    assert (values[0], values[-1]) == (low, low + span)


# --- chunks ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", SAMPLES)
@given(st.integers(2, 60), st.data())
@examples(15)
def test_chunks_give_the_same_rows_as_the_whole(kind: str, count: int, data: Any) -> None:
    sample = SAMPLES[kind](count)
    cuts = data.draw(st.lists(st.integers(0, sample.count), max_size=5).map(sorted))
    edges = [0, *cuts, sample.count]
    chunks = [as_lists(sample.rows(start, stop)) for start, stop in itertools.pairwise(edges)]
    joined = {path: [value for chunk in chunks for value in chunk[path]] for path in chunks[0]}
    assert joined == as_lists(whole(sample))


@pytest.mark.parametrize("kind", SAMPLES)
def test_another_process_would_get_the_same_rows(kind: str) -> None:
    sample = SAMPLES[kind](33)
    before = as_lists(sample.rows(5, 20))
    assert as_lists(pickle.loads(pickle.dumps(sample)).rows(5, 20)) == before
    assert as_lists(SAMPLES[kind](33).rows(5, 20)) == before


@pytest.mark.parametrize("method", [LatinHypercube, Sobol])
def test_another_seed_gives_other_rows(method: Callable[..., Sample]) -> None:
    one, two = (whole(method(MIXED, 16, seed))["mass"] for seed in (0, 1))
    assert not np.isclose(one, two).any()


MANY_ROWS = pytest.mark.parametrize("count", [200_000, pytest.param(1_000_000, marks=pytest.mark.nightly)])


@MANY_ROWS
@pytest.mark.parametrize("kind", ["sobol", "indices", "grid", "zip"])
def test_many_rows_need_no_more_memory_than_a_chunk(kind: str, count: int) -> None:
    sample, size = SAMPLES[kind](count), count // 50
    sample.rows(0, size)  # imports and caches
    tracemalloc.start()
    for start in range(0, count, size):
        sample.rows(start, start + size)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 60 * 8 * size


@MANY_ROWS
def test_a_latin_hypercube_holds_one_number_for_each_row_and_path(count: int) -> None:
    sample = LatinHypercube(MIXED, count, seed=77)
    tracemalloc.start()
    for start in range(0, count, 10_000):
        sample.rows(start, start + 10_000)
    held, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert held < 1.1 * 8 * count * len(MIXED)
    assert peak < 2 * 8 * count * len(MIXED)


# --- drawn samples ---------------------------------------------------------------------------------------------------


def unit_cube(names: str) -> tuple[Variable, ...]:
    return tuple(Distribution(name, "uniform", 0.0, 1.0) for name in names)


@pytest.mark.parametrize("sample", [LatinHypercube(unit_cube("xy"), 512, seed=9), Sobol(unit_cube("abcde"), 256)])
def test_each_part_of_each_variable_is_taken_once(sample: Sample) -> None:
    rows = whole(sample)
    for values in rows.values():
        assert sorted(np.floor(values * sample.count)) == list(range(sample.count))
    assert abs(np.corrcoef(*list(rows.values())[:2])[0, 1]) < 0.2


def test_sobol_points_are_those_of_scipy_in_the_middle_of_their_cells() -> None:
    rows = whole(Sobol(unit_cube("xy"), 64, seed=5))
    expected = stats.qmc.Sobol(2, rng=np.random.default_rng(5)).random(64)
    np.testing.assert_allclose(np.stack([rows["x"], rows["y"]], axis=1), expected + 2**-31, rtol=0, atol=1e-15)


def test_a_count_that_is_no_power_of_two_is_noted_and_not_warned_of() -> None:
    whole(Sobol(MIXED, 1000))  # a warning is an error
    assert "512 or 1024" in str(Sobol(MIXED, 1000).note)
    assert Sobol(MIXED, 1024).note is None
    assert Grid((SPEED,)).note is None


def test_a_large_latin_hypercube_says_how_much_it_holds() -> None:
    assert "458 MB" not in str(LatinHypercube(MIXED, 10_000_000).note)
    assert "763 MB" in str(LatinHypercube((*MIXED, *unit_cube("abcd")), 10_000_000).note)


# --- distributions ---------------------------------------------------------------------------------------------------

CUT = stats.truncnorm(-1.5, 2.0, loc=3.0, scale=0.2)
DISTRIBUTIONS: list[tuple[Variable, Any]] = [
    (Distribution("x", "uniform", 2.0, 5.0), stats.uniform(2.0, 3.0)),
    (RangeVariable("x", 2.0, 5.0), stats.uniform(2.0, 3.0)),
    (RangeVariable("x", 5.0, 2.0), stats.uniform(2.0, 3.0)),
    (RangeVariable("x", 0.1, 10.0, log=True), stats.loguniform(0.1, 10.0)),
    (Distribution("x", "normal", middle=3.0, sd=0.2), stats.norm(3.0, 0.2)),
    (Distribution("x", "normal", middle=3.0, sd=0.2, low=2.7, high=3.4), CUT),
    (Distribution("x", "normal", middle=3.0, sd=0.2, low=2.9), stats.truncnorm(-0.5, np.inf, loc=3.0, scale=0.2)),
    (Distribution("x", "triangular", 1.0, 4.0, 1.5), stats.triang(1 / 6, loc=1.0, scale=3.0)),
]


@pytest.mark.parametrize(("variable", "law"), DISTRIBUTIONS)
def test_a_distribution_has_its_moments_and_its_shape(variable: Variable, law: Any) -> None:
    values = numbers(variable)
    assert values.mean() == pytest.approx(law.mean(), rel=1e-4)
    assert values.std() == pytest.approx(law.std(), rel=2e-3)
    drawn = numbers(variable, np.random.default_rng(1).random(20_000))
    assert stats.kstest(drawn, law.cdf).pvalue > 1e-3


def test_a_truncated_normal_has_the_mean_of_its_formula() -> None:
    # E[X | a < X < b] = µ + σ (φ(α) - φ(β)) / (Φ(β) - Φ(α))
    density = [math.exp(-z * z / 2) / math.sqrt(2 * math.pi) for z in (-1.5, 2.0)]
    below = [(1 + math.erf(z / math.sqrt(2))) / 2 for z in (-1.5, 2.0)]
    expected = 3 + 0.2 * (density[0] - density[1]) / (below[1] - below[0])
    found = numbers(Distribution("x", "normal", middle=3.0, sd=0.2, low=2.7, high=3.4))
    assert found.mean() == pytest.approx(expected, rel=1e-7)


@given(st.floats(0.0, 1.0, exclude_min=True, exclude_max=True))
def test_values_never_leave_their_limits(share: float) -> None:
    for variable, low, high in (
        (Distribution("x", "uniform", 0.1, 0.7), 0.1, 0.7),
        (RangeVariable("x", 0.7, 0.1, log=True), 0.1, 0.7),
        (Distribution("x", "normal", middle=0.1, sd=0.2, low=0.1, high=0.7), 0.1, 0.7),
        (Distribution("x", "triangular", 0.1, 0.7, 0.1), 0.1, 0.7),
        (Distribution("x", "normal", middle=5, sd=3, low=1, high=9, integer=True), 1, 9),
    ):
        value = numbers(variable, np.array([share]))[0]
        assert low <= value <= high


@pytest.mark.parametrize(
    ("variable", "values"),
    [
        (Distribution("x", "uniform", 17, 23, integer=True), range(17, 24)),
        (RangeVariable("x", 23, 17, 4, integer=True), range(17, 24)),
        (ChoiceVariable("x", (17.0, 20.0, 23.0)), (17, 20, 23)),
        (LAW, ("cycloidal", "harmonic")),
    ],
)
def test_whole_numbers_and_lists_are_drawn_evenly(variable: Variable, values: Sequence[Any]) -> None:
    counted = Counter(variable.quantile((np.arange(2100) + 0.5) / 2100))
    assert counted == dict.fromkeys(values, 2100 // len(values))


def test_whole_numbers_of_a_normal_take_the_share_of_their_step() -> None:
    counted = Counter(numbers(Distribution("x", "normal", middle=20, sd=2, low=17, high=24, integer=True)))
    below = stats.norm(20, 2).cdf(np.arange(17, 26) - 0.5)
    expected = np.diff(below) / (below[-1] - below[0])
    assert [counted[value] / len(SHARES) for value in range(17, 25)] == pytest.approx(expected, abs=1e-5)


def test_whole_numbers_of_a_log_range_take_the_share_of_their_ratio() -> None:
    counted = Counter(numbers(RangeVariable("x", 1, 8, log=True, integer=True)))
    expected = np.diff(np.log(np.arange(1, 10) - 0.5)) / math.log(8.5 / 0.5)
    assert [counted[value] / len(SHARES) for value in range(1, 9)] == pytest.approx(expected, abs=1e-5)


# --- Sobol indices ---------------------------------------------------------------------------------------------------


def test_the_rows_for_indices_mix_two_matrices_one_column_at_a_time() -> None:
    sample = Sobol(MIXED, 16, seed=2, indices=True)
    assert (sample.size, sample.count) == (8, 16 * 8)
    point, place = np.divmod(np.arange(sample.count), 8)
    columns = {path: np.array(values) for path, values in whole(sample).items()}
    for i, path in enumerate(columns):
        a, b = columns[path][place == 0], columns[path][place == 1]
        assert (a != b).any()
        assert list(point[place == 2 + i]) == list(range(16))
        for j in range(len(MIXED)):
            assert list(columns[path][place == 2 + j]) == list(b if i == j else a)


def ishigami_values(points: int, seed: int = 0) -> Array:
    """Values of Ishigami's function; what its indices are in closed form is held by the summary of such a study."""
    sample = Sobol(tuple(Distribution(n, "uniform", -math.pi, math.pi) for n in "xyz"), points, seed, indices=True)
    x, y, z = whole(sample).values()
    return np.reshape(np.sin(x) + 7 * np.sin(y) ** 2 + 0.1 * z**4 * np.sin(x), (points, 5))


def test_the_indices_are_those_of_scipy() -> None:
    values = ishigami_values(256)
    f_ab = values[:, 2:].T[:, np.newaxis, :]
    by_scipy: Any = stats.sobol_indices(func={"f_A": values[:, :1].T, "f_B": values[:, 1:2].T, "f_AB": f_ab}, n=256)
    found = sobol_indices(values)
    assert found is not None
    np.testing.assert_allclose(found[0], by_scipy.first_order, rtol=1e-10)
    np.testing.assert_allclose(found[1], by_scipy.total_order, rtol=1e-10)


def test_a_point_with_a_missing_value_is_left_out_whole() -> None:
    values = ishigami_values(64)
    holed = values.copy()
    holed[5, 3] = np.nan
    holed[9, 0] = np.inf
    found, without = sobol_indices(holed), sobol_indices(np.delete(values, [5, 9], axis=0))
    assert found is not None and without is not None
    np.testing.assert_array_equal(found, without)


@pytest.mark.parametrize("values", [np.full((8, 4), 3.3), np.full((8, 4), np.nan), np.zeros((8, 4)), np.ones((1, 4))])
def test_what_does_not_vary_has_no_indices(values: Array) -> None:
    assert sobol_indices(values) is None


# --- what cannot be --------------------------------------------------------------------------------------------------

WRONG: dict[str, Callable[[], object]] = {
    "the list is empty": lambda: ChoiceVariable("x", ()),
    "mixes numbers and texts": lambda: ChoiceVariable("x", (1.0, "a")),  # type: ignore[arg-type]
    "from and to above zero": lambda: RangeVariable("x", 0.0, 1.0, 3, log=True),
    "from and to differ": lambda: RangeVariable("x", 0.0, 1.0, 1),
    "holds 4 whole numbers, count: 5": lambda: RangeVariable("x", 1, 4, 5, integer=True),
    "only 7 different whole numbers": lambda: RangeVariable("x", 1, 10, 8, log=True, integer=True),
    "low must be below high": lambda: Distribution("x", "uniform", 2.0, 2.0),
    "more than 8 standard deviations": lambda: Distribution("x", "normal", middle=2.0, sd=0.1, low=3.0),
    "mode must lie between": lambda: Distribution("x", "triangular", 1.0, 2.0, 5.0),
    "no list of values for sample: grid": lambda: Grid((SPEED, Distribution("x", "uniform", 0.0, 1.0))),
    "no list of values for sample: zip": lambda: Zip((Distribution("x", "normal", middle=0.0, sd=1.0),)),
    "count is missing; sample: grid": lambda: Grid((RangeVariable("x", 0.0, 1.0),)),
    "drive.crank_speed has 5, cylinder.bore_radius has 3": lambda: Zip((SPEED, RADIUS)),
    "at most 1073741824 different points": lambda: Sobol((SPEED,), 2**30 + 1),
    "at most 21201 dimensions": lambda: Sobol((SPEED,) * 10601, 2, indices=True),
}


@pytest.mark.parametrize("words", WRONG)
def test_what_cannot_be_is_reported_with_its_path(words: str) -> None:
    with pytest.raises(SampleError, match=words) as caught:
        WRONG[words]()
    assert caught.value.path in ("x", "")
