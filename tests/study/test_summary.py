"""The summary of stored variants: its numbers against counting by hand, influence and Pareto front against other ways, its pages."""

from __future__ import annotations

import json
import re
from functools import cache
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import scipy.stats
from pypdf import PdfReader

from diecut_report.config import yaml
from diecut_report.config.plugins import Discovery
from diecut_report.errors import UserError
from diecut_report.report.figures.style import Svg
from diecut_report.report.pages.pdf import printed_page
from diecut_report.study.analysis.answers import rounded
from diecut_report.study.analysis.variants import opened, titles
from diecut_report.study.storage.description import STATUSES, ResultColumn
from diecut_report.study.summary import best as influence
from diecut_report.study.summary import best as pareto
from diecut_report.study.summary import content as contents
from diecut_report.study.summary import data, figures, summarise
from diecut_report.study.summary.charts import near
from diecut_report.study.summary.content import page
from diecut_report.study.summary.data import WORST, display, utilised, value_text
from tests.hostile.bounded import PEAK
from tests.study.stored_study import (
    BORE,
    INPUTS,
    LAW,
    RESULTS,
    SPEED,
    STUDY,
    calculated,
    made,
    many,
    ten,
    variants,
    written,
)

GLOBAL = np.array([[0.3138, 0.4424, 0.0], [0.5574, 0.4424, 0.2436]])  # Ishigami: first and total indices, closed form


@pytest.fixture
def undrawn(monkeypatch: pytest.MonkeyPatch) -> None:
    """Charts have no drawing, which takes the most time: it is looked at in the large study and the small one."""
    monkeypatch.setattr(figures, "drawn", lambda _, told, key: Svg(f"<svg><title>{told}</title></svg>", 1.0, 1.0))


@pytest.fixture(scope="module")
def large(tmp_path_factory: pytest.TempPathFactory) -> Path:
    slow = {"my_kind": "its functions take one number at a time"}
    return many(tmp_path_factory.mktemp("large") / "out", 2000, slow=slow)


@cache
def rows_of(folder: Path) -> list[dict[str, Any]]:
    rows: list[dict[str, Any]] = json.loads("".join(variants(folder, format="json")))["variants"]
    return rows


def used_of_governing(row: dict[str, Any]) -> float:
    """The utilisation of a row's governing check, as the row's own column has it."""
    used: float = row[f"{row['governing']}.utilisation"]
    return used


@pytest.fixture(scope="module")
def large_summary(large: Path) -> contents.Summary:
    return summary_of(large)


def summary_of(folder: Path) -> contents.Summary:
    with opened(folder) as stored:
        return contents.content(stored, Discovery())


def words_of(found: contents.Summary) -> str:
    """What the page of a summary says, without its tags."""
    return " ".join(re.sub(r"<[^>]+>", "", page(found)).split())


def two(folder: Path, **changed: Any) -> contents.Summary:
    """The summary of two variants of which some columns have other values."""
    values = calculated(np.array([3.0, 3.5]), np.array([0.05, 0.06]), ["harmonic"] * 2) | changed
    return summary_of(written(folder, (*INPUTS, *RESULTS), values, varied=[SPEED, BORE]))


# --- numbers ---------------------------------------------------------------------------------------------------------


@pytest.mark.nightly
def test_counts_failures_and_utilisations_are_those_of_the_rows(large: Path, large_summary: contents.Summary) -> None:
    rows, found = rows_of(large), large_summary
    assert found.statuses == {status: sum(row["status"] == status for row in rows) for status in STATUSES}
    lost = [[check for check in found.checks if row[f"{check}.status"] == "fail"] for row in rows]
    assert {failure.check for failure in found.failures} == {check for each in lost for check in each}
    for failure in found.failures:
        assert failure.failing == sum(failure.check in each for each in lost)
        assert failure.only == sum(each == [failure.check] for each in lost)
        assert failure.governing == sum(row["status"] == "fail" and row["governing"] == failure.check for row in rows)
        assert failure.warning == sum(row[f"{failure.check}.status"] == "warn" for row in rows)
    assert sum(failure.governing for failure in found.failures) == found.statuses["fail"]
    assert found.failures == sorted(found.failures, key=lambda failure: -failure.failing)
    for used in found.utilisations:
        values = [row[f"{used.check}.utilisation"] for row in rows if row[f"{used.check}.status"]]
        there = np.array([value for value in values if value is not None])
        assert list(used.bands) == np.histogram(there, [0, *data.BANDS, np.inf])[0].tolist()
        assert used.without == values.count(None)
        assert used.greatest == there.max()
        states = [row[f"{used.check}.status"] for row in rows]
        assert [used.passing, used.warning, used.failing] == list(map(states.count, ("pass", "warn", "fail")))


def test_ranges_and_histograms_are_those_of_the_rows(large: Path) -> None:
    rows = rows_of(large)
    power = np.array([row["drive.power_peak"] for row in rows if row["drive.power_peak"] is not None])
    with opened(large) as stored:
        data.prepare(stored)
        spread = data.spreads(stored, [stored.columns["drive.power_peak"], WORST], len(rows))
        histogram = data.histogram(stored, spread["drive.power_peak"])
    assert spread["drive.power_peak"].values == pytest.approx(np.quantile(power, [0, 0.05, 0.5, 0.95, 1]), rel=1e-12)
    assert spread["drive.power_peak"].present == len(power)
    assert histogram.counts.sum(axis=0).tolist() == np.histogram(power, histogram.edges)[0].tolist()
    failing = [row["drive.power_peak"] for row in rows if row["status"] == "fail"]
    assert histogram.counts[STATUSES.index("fail")].tolist() == np.histogram(failing, histogram.edges)[0].tolist()
    governed = [row[f"{row['governing']}.utilisation"] for row in rows if row["governing"]]
    assert spread[WORST.name].values[-1] == max(filter(None, governed))  # a wall without one fails


@pytest.mark.nightly
def test_reasons_that_differ_in_numbers_alone_are_counted_together(
    large: Path, large_summary: contents.Summary
) -> None:
    rows = [row for row in rows_of(large) if row["error"]]
    (reason,) = large_summary.reasons
    assert (reason.variants, reason.example) == (len(rows), rows[0]["variant"])
    assert reason.text == rows[0]["error"]


def test_the_sample_is_the_same_each_time_and_holds_rows_as_they_are(large: Path) -> None:
    rows = rows_of(large)
    with opened(large) as stored:
        data.prepare(stored)
        columns = [stored.columns[name] for name in (SPEED, LAW, "drive.power_peak")]
        one, two = (data.sample(stored, columns, 200) for _ in range(2))
    assert one.variants.tolist() == two.variants.tolist()
    assert len(set(one.variants.tolist())) == 200
    for place, variant in enumerate(one.variants):
        assert one.values[SPEED][place] == rows[variant][SPEED]
        assert one.words[LAW][int(one.values[LAW][place])] == rows[variant][LAW]
        assert STATUSES[one.status[place]] == rows[variant]["status"]
        np.testing.assert_equal(one.values["drive.power_peak"][place], rows[variant]["drive.power_peak"] or np.nan)


def test_shares_that_pass_are_those_of_the_rows_by_value_and_by_class(
    large: Path, large_summary: contents.Summary
) -> None:
    rows = rows_of(large)
    found = {each.column.name: each.rows for each in large_summary.passing}
    assert list(found) == [SPEED, BORE, LAW]
    for name in (SPEED, BORE):
        values = np.array([row[name] for row in rows])
        good = np.array([row["status"] in ("pass", "warn") for row in rows])
        edges = np.linspace(values.min(), values.max(), 6)
        assert [row.variants for row in found[name]] == np.histogram(values, edges)[0].tolist()
        assert [row.passing for row in found[name]] == np.histogram(values[good], edges)[0].tolist()
    for row in found[LAW]:
        mine = [each["status"] for each in rows if each[LAW] == row.text]
        assert (row.variants, row.passing) == (len(mine), mine.count("pass") + mine.count("warn"))
    assert {row.text for row in found[LAW]} == {"harmonic", "cycloidal"}


@pytest.mark.nightly
def test_a_value_at_which_nothing_passes_is_marked(small_summary: contents.Summary) -> None:
    found = small_summary
    speeds = next(each.rows for each in found.passing if each.column.name == SPEED)
    assert speeds == [("35", 1, 0), ("40", 3, 3), ("50", 2, 0), ("60", 4, 0)]
    empty = sum(not row.passing for each in found.passing for row in each.rows)
    assert page(found).count("none passes</strong>") == empty > 3


def test_what_governs_those_that_pass_and_the_most_margin_are_those_of_the_rows(
    large: Path, large_summary: contents.Summary
) -> None:
    good = [row for row in rows_of(large) if row["status"] in ("pass", "warn")]
    worst = [used_of_governing(row) for row in good]
    assert sum(row.variants for row in large_summary.governing) == len(good)
    for row in large_summary.governing:
        mine = [used for used, each in zip(worst, good, strict=True) if each["governing"] == row.check]
        assert (row.variants, row.least, row.greatest) == (len(mine), min(mine), max(mine))
    assert (
        f"variant {good[int(np.argmin(worst))]['variant']}: utilisation {utilised(min(worst))} at most"
        in dict(large_summary.facts)["Largest margin"]
    )


@pytest.mark.usefixtures("undrawn")
def test_the_utilisation_beside_a_name_is_that_of_the_check_itself(tmp_path: Path) -> None:
    """A check at its limit that does not govern, as of what the program sized, lends its utilisation to no other."""
    wall = {"utilisation": np.ones(2), "status": np.array(["pass"] * 2, object)}
    found = two(tmp_path / "out", **{f"cylinder.checks.wall.{name}": values for name, values in wall.items()})
    used = calculated(np.array([3.0, 3.5]), np.array([0.05, 0.06]), ["harmonic"] * 2)["drive.checks.play.utilisation"]
    assert [(row.check, row.least, row.greatest) for row in found.governing] == [
        ("drive.checks.play", pytest.approx(used.min()), pytest.approx(used.max()))
    ]
    assert f"utilisation {used.min():.4f}"[:14] in dict(found.facts)["Largest margin"]


@pytest.mark.usefixtures("undrawn")
def test_a_check_that_fails_everywhere_is_told(tmp_path: Path) -> None:
    text = words_of(summary_of(made(tmp_path / "out", [6.3] * 3, [0.055, 0.06, 0.065])))
    assert "No variant can pass because of it: Play of the joints (drive) fails in all of them." in text
    assert "No variant passes, so no value of an input does." in text
    assert "among all that were calculated, since none passes" in text


@pytest.mark.usefixtures("undrawn")
def test_a_governing_check_that_nothing_moves_and_a_margin_that_several_share_are_told(tmp_path: Path) -> None:
    found = summary_of(made(tmp_path / "out", [3.0] * 4, [0.06] * 4))
    assert [(row.check, row.varies) for row in found.governing] == [("drive.checks.play", False)]
    assert "equal in all variants: no varied input affects it" in page(found)
    assert dict(found.facts)["Largest margin"].startswith("variant 0, and 3 other variants with the same: utilisation")
    moved = summary_of(made(tmp_path / "other", [3.0, 3.0, 3.2, 3.3], [0.06, 0.06, 0.065, 0.07]))
    assert [(row.check, row.varies) for row in moved.governing] == [("drive.checks.play", True)]


@pytest.mark.usefixtures("undrawn")
def test_outputs_that_a_study_asks_for_are_among_its_influences(tmp_path: Path) -> None:
    text = STUDY + "outputs: [drive.idle_ratio, cylinder.radius]\n"  # the radius is the same in all variants
    found = summary_of(many(tmp_path / "out", 300, text=text))
    names = [column.name for column in found.choices]
    assert names.index("drive.idle_ratio") == names.index("maximum utilisation") + 1
    assert found.ranked is not None and any("Idle" in title or "idle_ratio" in title for title in found.ranked.targets)


def test_classes_of_a_utilisation_do_not_lie_on_both_sides_of_one(large: Path) -> None:
    rows = rows_of(large)
    name = "drive.checks.play.utilisation"
    with opened(large) as stored:
        data.prepare(stored)
        found = data.histogram(stored, data.spreads(stored, [stored.columns[name]], len(rows))[name])
    (at,) = np.flatnonzero(np.isclose(found.edges, 1.0, rtol=0, atol=1e-12))
    sizes = [row[name] for row in rows if row[name] is not None]
    assert found.counts[:, :at].sum() == sum(size <= 1 for size in sizes)
    assert found.counts[:, at:].sum() == sum(size > 1 for size in sizes)


@pytest.mark.usefixtures("undrawn")
def test_what_was_studied_stands_there_as_it_is_written(tmp_path: Path) -> None:
    folder = many(tmp_path / "out", 10, dropped=3)
    found = summary_of(folder)
    assert found.asked is not None
    assert [each.values for each in found.asked.inputs] == [
        "from 30 rpm to 6.6e1 rpm", "normal, mean 70 mm, sd 5 mm, low 50 mm", "harmonic, cycloidal",
    ]  # fmt: skip
    typed = "mechanisms.cylinder.bore_radius <= mechanisms.cylinder.radius - '1 mm'"
    assert found.asked.constraints == [("Radius of the bore (cylinder) R_b", typed)]
    facts = dict(found.asked.facts)
    assert (facts["Sample"], facts["Count"], facts["Seed"]) == ("Latin hypercube", "13", "4")
    assert facts["Excluded by the constraints"] == "3 variants"
    (folder / "study.yaml").write_text("changed", "utf-8")
    changed = summary_of(folder)
    assert changed.asked is None and "is missing or has changed" in page(changed)


@pytest.mark.usefixtures("undrawn")
def test_a_table_is_told_by_its_file(tmp_path: Path) -> None:
    text = "vary: {a.b: {table: motors.csv, column: n}, a.c: {from: 1, to: 9, count: 3, spacing: log}}"
    tree = yaml.parse(text, "study.yaml")
    assert contents.written(tree, ("vary", "a.b")) == "column n of the table motors.csv"
    assert contents.written(tree, ("vary", "a.c")) == "from 1 to 9, count 3, spacing log"
    study = "schema_version: 1\nbase: press.yaml\nsample: {method: table, file: motors.csv}\n"
    found = summary_of(made(tmp_path / "out", [3.0, 4.0], [0.06, 0.06], text=study)).asked
    assert found is not None and dict(found.facts)["Sample"] == "rows of a table: motors.csv"
    assert [each.values for each in found.inputs] == ["a column of motors.csv"] * 2


@pytest.mark.usefixtures("undrawn")
def test_what_was_studied_stands_there_in_words_with_its_symbol_and_the_key_beside(tmp_path: Path) -> None:
    study, laws = STUDY.replace("cycloidal", "modified_trapezoidal"), ["harmonic", "modified_trapezoidal"]
    summary = summary_of(made(tmp_path / "out", [3.0, 4.0], [0.06, 0.06], laws, text=study))
    assert summary.asked is not None
    *numbers, law = summary.asked.inputs
    names = [("Speed of the crank (drive)", "n"), ("Radius of the bore (cylinder)", "R_b")]
    assert [(each.text, each.symbol) for each in numbers] == names
    assert law.values == "harmonic, modified trapezoidal (modified_trapezoidal)"
    power, mass = ("Maximum power (drive) minimised", "minimise: drive.power_peak"), "Mass of the cylinder (cylinder)"
    assert summary.asked.objectives == [power, (f"{mass} minimised", "minimise: cylinder.mass")]
    shown = page(summary)
    assert "Radius of the bore (cylinder) <i class=sy>R</i><sub>b</sub>" in shown
    assert f'{power[0]}<span class="sub key">{power[1]}</span>' in shown
    assert value_text("free_end") == "free end" and value_text("EN 10025") == "EN 10025"


def test_the_matrix_begins_with_the_best_and_each_variant_stands_once(
    small_summary: contents.Summary, large_summary: contents.Summary
) -> None:
    assert large_summary.front is not None
    titles_ = [title for title, _ in large_summary.matrices[0].groups]
    assert titles_ == ["Best: on the Pareto front", "Fail: the 10 most overloaded variants"]
    best = large_summary.front.variants.tolist()
    assert [row.variant for row in large_summary.matrices[0].groups[0][1]] == best[:15]
    rows = [row.variant for row in small_summary.matrices[0].rows]
    assert sorted(rows) == list(range(10))


def test_best_variants_tell_status_and_what_governs(large: Path, large_summary: contents.Summary) -> None:
    rows = rows_of(large)
    assert large_summary.best
    for each in large_summary.best:
        mine = rows[each.variant]
        used = used_of_governing(mine)
        assert (each.status, each.utilisation) == (mine["status"], utilised(used))
        assert each.governing == large_summary.checks[mine["governing"]]


# --- Pareto front ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("objectives", [1, 2, 3, 4])
def test_the_front_is_what_comparing_all_pairs_gives(objectives: int) -> None:
    costs = np.random.default_rng(objectives).integers(0, 9, (600, objectives)).astype(float)
    beaten = [any((other <= row).all() and (other < row).any() for other in costs) for row in costs]
    assert sorted(pareto.pareto_best(costs)) == [index for index, lost in enumerate(beaten) if not lost]


def test_the_front_over_several_blocks_is_a_staircase() -> None:
    x = np.random.default_rng(0).permutation(5 * pareto.BLOCK) / 1000.0
    on_front = np.column_stack([x, -x])
    behind = on_front + np.array([0.5, 0.5])
    assert sorted(pareto.pareto_best(np.concatenate([behind, on_front]))) == list(range(len(x), 2 * len(x)))


def test_only_variants_that_do_not_fail_are_on_the_front(large: Path, large_summary: contents.Summary) -> None:
    rows, found = rows_of(large), large_summary
    good = [row for row in rows if row["status"] in ("pass", "warn")]
    assert found.front is not None and found.front.is_passing and found.front.among == len(good)
    for variant in found.front.variants:
        mine = rows[variant]
        assert mine["status"] in ("pass", "warn")
        lighter = [row for row in good if row["cylinder.mass"] <= mine["cylinder.mass"]]
        assert not any(row["drive.power_peak"] < mine["drive.power_peak"] for row in lighter)
    cheapest = min(good, key=lambda row: row["drive.power_peak"])
    assert found.front.variants[0] == cheapest["variant"]


@pytest.mark.usefixtures("undrawn")
def test_where_none_passes_all_calculated_variants_are_compared(tmp_path: Path) -> None:
    wanted = [{"maximise": "cylinder.mass"}]
    found = summary_of(made(tmp_path / "out", [6.3] * 3, [0.055, 0.06, 0.065], objectives=wanted))
    assert found.front is not None and not found.front.is_passing
    assert found.front.variants.tolist() == [0, 1, 2]


def test_ten_digits_are_kept() -> None:
    given = np.array([0.0, -3.5550900582002396, 1.23456789012e-7, 9.99999999999e20, np.inf, np.nan])
    np.testing.assert_allclose(rounded(given), given, rtol=6e-10)
    assert rounded(np.array([3.5550900582002396]))[0] == rounded(np.array([3.555090058200241]))[0]
    assert rounded(np.array([1.0, 1.000000001])).tolist() == [1.0, 1.000000001]


def test_no_variant_stands_on_the_front_by_rounding() -> None:
    costs = np.array([[151.9, 1.925, 3.555090058200241], [187.3, 2.062, 3.5550900582002396]])
    assert sorted(pareto.pareto_best(costs).tolist()) == [0, 1]
    assert pareto.pareto_best(rounded(costs)).tolist() == [0]


# --- influence -------------------------------------------------------------------------------------------------------


def saltelli(folder: Path, n: int, lost: int = 0) -> influence.Influence:
    """The influence by a stored Saltelli sample of the Ishigami function, some of the second matrix in error."""
    draw = scipy.stats.qmc.Sobol(6, seed=1).random(n) * 2 * np.pi - np.pi
    a, b = draw[:, :3], draw[:, 3:]
    mixed = [np.column_stack([b[:, k] if k == i else a[:, k] for k in range(3)]) for i in range(3)]
    points = np.stack([a, b, *mixed], axis=1).reshape(-1, 3)  # the rows of a point lie one after the other
    gone = np.isin(np.arange(len(points)), 5 * np.arange(lost) + 1)
    names = [f"mechanisms.m.x{index}" for index in range(3)]
    one, two, three = points.T
    ishigami = np.sin(one) + 7 * np.sin(two) ** 2 + 0.1 * three**4 * np.sin(one)
    values: dict[str, Any] = {name: points[:, index] for index, name in enumerate(names)}
    values |= {"m.f": np.where(gone, np.nan, ishigami), "status": np.where(gone, "error", "pass").astype(object)}
    values |= {"error": np.where(gone, "cannot be", None).astype(object)}
    columns = [*(ResultColumn(name) for name in names), ResultColumn("m.f")]
    written(folder, columns, values, varied=names, design="saltelli", n=n, objectives=[{"minimise": "m.f"}])
    return influence_on(folder, "m.f")


def influence_on(folder: Path, target: str) -> influence.Influence:
    with opened(folder) as stored:
        data.prepare(stored)
        (found,) = influence.influences(stored, [stored.columns[target]])
    return found


def test_sobol_indices_are_those_of_the_closed_form(tmp_path: Path) -> None:
    found = saltelli(tmp_path / "out", 1 << 13)
    assert found.is_sobol
    shares = {share.column.name[-1]: share for share in found.shares}
    ours = np.array([[shares[name].first, shares[name].total] for name in "012"], dtype=float).T
    np.testing.assert_allclose(ours, GLOBAL, atol=0.02)
    for share, first in ((shares["0"], GLOBAL[0, 0]), (shares["1"], GLOBAL[0, 1])):
        assert share.first_error is not None and abs(share.first - first) < 2 * share.first_error


def test_sobol_indices_leave_out_base_rows_that_miss_a_variant(tmp_path: Path) -> None:
    found = saltelli(tmp_path / "out", 1 << 12, lost=96)
    assert found.variants == 5 * ((1 << 12) - 96)
    np.testing.assert_allclose(sorted(share.total or 0 for share in found.shares), sorted(GLOBAL[1]), atol=0.06)


def test_without_such_a_sample_partial_rank_correlation_is_told(large: Path) -> None:
    rows = [row for row in rows_of(large) if row["status"] != "error"]
    found = influence_on(large, "drive.power_peak")
    assert not found.is_sobol and found.variants == len(rows)
    shares = {share.column.name: share.first for share in found.shares}
    ranked = [scipy.stats.rankdata([row[name] for row in rows]) for name in (SPEED, BORE, "drive.power_peak")]
    is_first = [float(row[LAW] == "cycloidal") for row in rows]
    inverse = np.linalg.inv(np.corrcoef([*ranked[:2], is_first, ranked[2]]))  # gives partial correlations too
    expected = -inverse[3, :3] / np.sqrt(np.diag(inverse)[:3] * inverse[3, 3])
    expected[2] = abs(expected[2])  # words have no sign
    assert [shares[name] for name in (SPEED, BORE, LAW)] == pytest.approx(expected, abs=1e-9)


def test_an_input_that_a_constraint_ties_to_another_gets_no_influence_of_its_own() -> None:
    draw = np.random.default_rng(5)
    one = draw.uniform(size=4000)
    two = one + draw.uniform(-0.3, 0.3, 4000)  # goes with the first, and moves nothing
    goal = influence.ranks(one + draw.normal(0, 0.05, 4000))
    assert scipy.stats.spearmanr(two, goal).statistic > 0.8
    first, second = influence.partial([influence.ranks(one)[:, None], influence.ranks(two)[:, None]], goal)
    assert first is not None and first > 0.9
    assert second is not None and abs(second) < influence.WEAK


def test_inputs_that_go_together_share_their_influence_and_few_variants_tell_nothing() -> None:
    ranks = np.random.default_rng(6).permutation(50).astype(float)[:, None]
    assert influence.partial([ranks, -ranks], ranks[:, 0]) == pytest.approx([1.0, -1.0])
    assert influence.partial([ranks[:5], ranks[:5] ** 2], ranks[:5, 0]) == [None, None]


def test_an_influence_next_to_nothing_is_neither_printed_nor_drawn(large_summary: contents.Summary) -> None:
    assert large_summary.ranked is not None
    texts = dict(large_summary.ranked.rows)
    mass = large_summary.ranked.targets.index("Mass of the cylinder (cylinder)")
    assert texts["Speed of the crank (drive)"][mass] == "–"
    assert texts["Radius of the bore (cylinder)"][mass] == "−1.00"
    drawn = next(each for each in large_summary.ranked.figures if "on Mass of the cylinder" in each.alternative)
    assert "Speed of the crank" not in drawn.alternative
    assert "Mass of the cylinder (cylinder) over Speed" not in large_summary.figures["grid"].alternative


# --- pages -----------------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def small(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = ten(tmp_path_factory.mktemp("small") / "out", state="running", dropped=3)
    (folder / "reports").mkdir()
    (folder / "reports" / "6.html").write_text("the report")
    (folder / "reports" / "3.pdf").write_text("the report")
    return folder


@pytest.fixture(scope="module")
def small_summary(small: Path) -> contents.Summary:
    return summary_of(small)


@pytest.fixture(scope="module")
def small_page(small_summary: contents.Summary) -> str:
    return page(small_summary)


@pytest.mark.nightly
def test_the_pages_say_the_counts(small_summary: contents.Summary, small_page: str) -> None:
    """The PDF, which takes longest, has the tags of its alternative texts too."""
    text = re.sub(r"<[^>]+>", "", small_page)
    assert "3 of 10 variants pass all performed checks, 6 fail, 1 cannot exist." in text
    assert "The run is not complete." in text
    assert re.search(r"Excluded by constraints\s*3 variants", text)
    assert "bore_radius 0.104 m leaves no wall" in text
    document = PdfReader(BytesIO(printed_page(page(small_summary, "print"))))
    assert "/StructTreeRoot" in document.trailer["/Root"]
    paper = " ".join("\n".join(sheet.extract_text() for sheet in document.pages).split())
    assert "3 of 10 variants pass all performed checks" in paper
    assert "Partial rank correlation" in paper
    for number, sheet in enumerate(document.pages, 1):
        assert re.search(rf"\b{number}\s+of\s+{len(document.pages)}\b", sheet.extract_text())


def test_links_lead_to_the_reports_that_exist(small_page: str) -> None:
    links, anchors = set(re.findall('<a [^>]*href="([^"]*)"', small_page)), re.findall('id="([^"]*)"', small_page)
    assert {link for link in links if not link.startswith("#")} == {"reports/6.html", "reports/3.pdf"}
    assert {link[1:] for link in links if link.startswith("#")} <= set(anchors)


@pytest.fixture(scope="module")
def large_page(large_summary: contents.Summary) -> str:
    return page(large_summary)


def test_the_html_page_needs_nothing_from_elsewhere(large_page: str) -> None:
    found = re.findall(r"""<[^>]*\b(?:src|href)=["']?([^"'\s>]*)""", large_page)
    assert found and all(value.startswith(("#", "data:")) for value in found)


@pytest.mark.usefixtures("undrawn")
def test_what_a_user_wrote_cannot_end_a_script_or_a_tag(tmp_path: Path) -> None:
    law = ["</script><b>", "harmonic"] * 5
    text = page(summary_of(made(tmp_path / "out", np.linspace(3, 7, 10), np.linspace(0.05, 0.09, 10), law)))
    assert "<b>" not in text
    data_ = text.split('id="any-data">')[1].split("</script>")[0]
    assert json.loads(data_)["columns"][2]["words"] == ["</script><b>", "harmonic"]


def test_every_chart_has_a_text_alternative(large_summary: contents.Summary) -> None:
    found = large_summary
    figures = [*found.figures.values(), *(found.ranked.figures if found.ranked else [])]
    assert len(figures) == 9
    for figure in figures:
        assert len(figure.alternative) > 20
        assert re.search(r"<title>[^<]{20,}</title>", figure.svg.text)


def test_a_large_study_is_aggregated_and_says_so(large_summary: contents.Summary, large_page: str) -> None:
    found = large_summary
    assert len(found.any_two.variants) == contents.SAMPLED
    assert "a sample of 1500 variants is drawn" in found.figures["pair"].caption
    assert not found.is_whole and len(found.matrices[0].rows) < 45
    assert len(large_page) < 3_000_000
    assert "its functions take one number at a time" in large_page


def test_objectives_and_failing_checks_come_before_other_outputs(small_summary: contents.Summary) -> None:
    names = [column.name for column in small_summary.choices]
    assert names[2:6] == ["drive.power_peak", "cylinder.mass", "maximum utilisation", "drive.checks.play.utilisation"]
    assert {"drive.crank_torque_peak", "drive.idle_ratio"} <= set(names[6:])


def test_what_people_read_are_titles_and_units_not_names(small_page: str) -> None:
    text = re.sub(r"<[^>]+>", " ", small_page)
    assert (
        "Fails most often: Play of the joints (drive) (in 5 of 9 variants, 55.6 %); the only failing check in 5."
        in " ".join(text.split())
    )
    assert "Speed of the crank (drive), r/min" in text and "Mass of the cylinder (cylinder), kg" in text
    assert re.search(r"diecut-report report &#34;out#\d&#34;|diecut-report report \"out#\d\"", text)


def test_titles_are_unlike_each_other() -> None:
    teeth = [f"mechanisms.train.gears.{i}.teeth" for i in range(2)]
    gear = [ResultColumn(name, description="Number of teeth of the gear") for name in teeth]
    force = [ResultColumn(f"{name}.force", description=f"Force ({end})") for name, end in (("a", "up"), ("b", "up"))]
    both = [ResultColumn(f"a.force_{end}", description=f"Force ({end})") for end in ("mean", "peak")]
    of_gears = [f"Number of teeth of the gear: no. {number} of gears (train)" for number in (1, 2)]
    assert list(titles(gear[:1]).values()) == of_gears[:1]  # one alone that is varied, too
    found = titles([*gear, *force, *both, ResultColumn("status", description="Status")])
    forces = ["Force (up) (a)", "Force (b)", "Force (mean) (a)", "Force (peak) (a)"]
    assert list(found.values()) == [*of_gears, *forces, ""]


UTILISED = {0.0: "0.00", 1e-9: "< 0.01", 0.996: "0.9960", 1.0: "1.00", 1.0003: "1.0003", 120: "120"}
UTILISED |= {0.99999998: "< 1", 1.00000002: "> 1", 1.02: "1.02"}


@pytest.mark.parametrize(("value", "text"), UTILISED.items())
def test_a_utilisation_shows_on_which_side_of_one_it_is(value: float, text: str) -> None:
    assert utilised(value) == text
    assert display(value, WORST) == text


def test_cells_count_every_variant_once(large: Path) -> None:
    rows = [row for row in rows_of(large) if row["status"] != "error"]
    with opened(large) as stored:
        data.prepare(stored)
        mass, power = (stored.columns[name] for name in ("cylinder.mass", "drive.power_peak"))
        spread = data.spreads(stored, [mass, power], len(rows))
        found = data.density(stored, spread[mass.name], spread[power.name])
    points = np.array([(row["drive.power_peak"], row["cylinder.mass"]) for row in rows])
    expected = np.histogram2d(*points.T, [found.y_edges, found.x_edges])[0]
    np.testing.assert_array_equal(found.counts, expected)
    assert found.sound.sum() == sum(row["status"] in ("pass", "warn") for row in rows)


def test_a_few_values_far_out_do_not_press_the_others_together() -> None:
    values = np.r_[np.linspace(0, 1, 99), 60.0]
    assert near(values).max() == pytest.approx(data.reach(0, float(np.quantile(values, 0.95)), 60.0))
    assert near(values).max() < 1.3
    np.testing.assert_array_equal(near(values[:-1]), values[:-1])


@pytest.mark.nightly
def test_the_same_variants_give_the_same_page(small: Path, small_page: str) -> None:
    assert page(summary_of(small)) == small_page


@pytest.mark.nightly
@pytest.mark.parametrize("count", [1, 2, 3])
def test_few_variants_have_a_summary_too(tmp_path: Path, count: int) -> None:
    folder = many(tmp_path / "out", count, seed=3)
    summarise(folder)
    assert (folder / "summary.pdf").read_bytes().startswith(b"%PDF")


@pytest.mark.usefixtures("undrawn")
def test_what_passes_is_told_to_pass_what_is_made_where_checks_are_not(tmp_path: Path) -> None:
    wall = {"utilisation": np.full(2, np.nan), "status": np.array(["not_checked"] * 2, object)}
    found = two(tmp_path / "out", **{f"cylinder.checks.wall.{name}": values for name, values in wall.items()})
    text = words_of(found)
    assert found.status == "conditional" and "2 of 2 variants pass all performed checks." in text
    assert "1 check is not performed in some or all variants because a limit or another key is not given." in text


@pytest.mark.usefixtures("undrawn")
def test_a_study_of_errors_alone_has_a_summary(tmp_path: Path) -> None:
    folder = made(tmp_path / "out", [3.0, 4.0, 5.0], [0.104] * 3)
    summarise(folder, ["html"])
    text = re.sub(r"<[^>]+>", "", (folder / "summary.html").read_text("utf-8"))
    assert "0 of 3 variants pass all checks, 3 cannot exist" in text
    assert "No variant was calculated that has the objectives." in text


def test_a_folder_without_variants_has_no_summary(tmp_path: Path) -> None:
    with pytest.raises(UserError, match="no results of a study"):
        summarise(tmp_path)
    assert not list(tmp_path.iterdir())


@pytest.mark.nightly
def test_three_hundred_thousand_variants_stay_within_memory(tmp_path: Path) -> None:
    import subprocess
    import sys

    folder = many(tmp_path / "out", 300_000)
    code = (
        f"import sys\n{PEAK}\nfrom diecut_report.study.summary import summarise\n"
        "summarise(Path(sys.argv[1]))\nprint(memory())"
    )
    done = subprocess.run([sys.executable, "-c", code, str(folder)], capture_output=True, text=True, check=True)
    assert int(done.stdout) < 1_000_000_000
