"""The summary of stored variants: its numbers against counting by hand, influence and Pareto front against other ways, its pages."""

from __future__ import annotations

import io
import json
import re
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import scipy.stats
from pypdf import PdfReader

from diecut_report.batch.description import Column
from diecut_report.batch.query import variants
from diecut_report.batch.stored import STATUSES, opened
from diecut_report.batch.summary import content as contents
from diecut_report.batch.summary import data, influence, pareto, summarise
from diecut_report.batch.summary.charts_points import near
from diecut_report.batch.summary.names import utilised
from diecut_report.batch.summary.pages import page, sheets
from diecut_report.batch.titles import titles
from diecut_report.errors import UserError
from tests.batch.stored_study import BORE, LAW, SPEED, made, many, ten, written

GLOBAL = np.array([[0.3138, 0.4424, 0.0], [0.5574, 0.4424, 0.2436]])  # Ishigami: first and total indices, closed form


@pytest.fixture(scope="module")
def large(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return many(
        tmp_path_factory.mktemp("large") / "out", 3000, slow={"my_kind": "its functions take one number at a time"}
    )


def rows_of(folder: Path) -> list[dict[str, Any]]:
    rows: list[dict[str, Any]] = json.loads("".join(variants(folder, format="json")))["variants"]
    return rows


@pytest.fixture(scope="module")
def large_summary(large: Path) -> contents.Summary:
    return summary_of(large)


def summary_of(folder: Path) -> contents.Summary:
    with opened(folder) as stored:
        return contents.content(stored)


# --- numbers ---------------------------------------------------------------------------------------------------------


def test_counts_failures_and_utilisations_are_those_of_the_rows(large: Path, large_summary: contents.Summary) -> None:
    rows, found = rows_of(large), large_summary
    assert found.statuses == {status: sum(row["status"] == status for row in rows) for status in STATUSES}
    for failure in found.failures:
        governed = [row["status"] for row in rows if row["governing"] == failure.check]
        assert (failure.failing, failure.warning) == (governed.count("fail"), governed.count("warn"))
    assert sum(failure.failing for failure in found.failures) == found.statuses["fail"]
    for used in found.utilisations:
        values = [row[f"{used.check}.utilisation"] for row in rows if row[f"{used.check}.status"]]
        there = np.array([value for value in values if value is not None])
        assert list(used.bands) == np.histogram(there, [0, *data.BANDS, np.inf])[0].tolist()
        assert used.without == values.count(None)
        assert used.greatest == there.max()
        states = [row[f"{used.check}.status"] for row in rows]
        assert (used.passing, used.warning, used.failing) == tuple(
            states.count(one) for one in ("pass", "warn", "fail")
        )


def test_ranges_and_histograms_are_those_of_the_rows(large: Path) -> None:
    rows = rows_of(large)
    power = np.array([row["drive.power_peak"] for row in rows if row["drive.power_peak"] is not None])
    with opened(large) as stored:
        data.prepare(stored)
        spread = data.spreads(stored, [stored.columns["drive.power_peak"], data.WORST], len(rows))
        histogram = data.histogram(stored, spread["drive.power_peak"])
    assert spread["drive.power_peak"].values == pytest.approx(np.quantile(power, [0, 0.05, 0.5, 0.95, 1]), rel=1e-12)
    assert spread["drive.power_peak"].present == len(power)
    assert histogram.counts.sum(axis=0).tolist() == np.histogram(power, histogram.edges)[0].tolist()
    failing = [row["drive.power_peak"] for row in rows if row["status"] == "fail"]
    assert histogram.counts[STATUSES.index("fail")].tolist() == np.histogram(failing, histogram.edges)[0].tolist()
    checks = [(row["drive.checks.play.utilisation"], row["cylinder.checks.wall.utilisation"]) for row in rows]
    worst = max(max(pair) for pair in checks if None not in pair)  # a wall without a utilisation fails
    assert spread[data.WORST.name].values[-1] == worst


def test_reasons_that_differ_in_numbers_alone_are_counted_together(
    large: Path, large_summary: contents.Summary
) -> None:
    rows = [row for row in rows_of(large) if row["error"]]
    (reason,) = large_summary.reasons
    assert (reason.variants, reason.example) == (len(rows), rows[0]["variant"])
    assert reason.told == rows[0]["error"]


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


# --- Pareto front ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("objectives", [1, 2, 3, 4])
def test_the_front_is_what_comparing_all_pairs_gives(objectives: int) -> None:
    costs = np.random.default_rng(objectives).integers(0, 9, (600, objectives)).astype(float)
    beaten = [any((other <= row).all() and (other < row).any() for other in costs) for row in costs]
    assert sorted(pareto.best(costs)) == [index for index, lost in enumerate(beaten) if not lost]


def test_the_front_over_several_blocks_is_a_staircase() -> None:
    x = np.random.default_rng(0).permutation(5 * pareto.BLOCK) / 1000.0
    on_front = np.column_stack([x, -x])
    behind = on_front + np.array([0.5, 0.5])
    assert sorted(pareto.best(np.concatenate([behind, on_front]))) == list(range(len(x), 2 * len(x)))


def test_only_variants_that_do_not_fail_are_on_the_front(large: Path, large_summary: contents.Summary) -> None:
    rows, found = rows_of(large), large_summary
    good = [row for row in rows if row["status"] in ("pass", "warn")]
    assert found.front is not None and found.front.is_passing and found.front.among == len(good)
    for variant in found.front.variants:
        mine = rows[variant]
        assert mine["status"] in ("pass", "warn")
        better = [
            row
            for row in good
            if row["drive.power_peak"] < mine["drive.power_peak"] and row["cylinder.mass"] <= mine["cylinder.mass"]
        ]
        assert not better
    cheapest = min(good, key=lambda row: row["drive.power_peak"])
    assert found.front.variants[0] == cheapest["variant"]


def test_where_none_passes_all_calculated_variants_are_compared(tmp_path: Path) -> None:
    found = summary_of(
        made(tmp_path / "out", [6.3] * 3, [0.055, 0.06, 0.065], objectives=[{"maximise": "cylinder.mass"}])
    )
    assert found.front is not None and not found.front.is_passing
    assert found.front.variants.tolist() == [0, 1, 2]


# --- influence -------------------------------------------------------------------------------------------------------


def ishigami(points: Any) -> Any:
    one, two, three = points
    return np.sin(one) + 7 * np.sin(two) ** 2 + 0.1 * three**4 * np.sin(one)


def saltelli(folder: Path, n: int, lost: int = 0) -> Path:
    """A stored Saltelli sample of the Ishigami function, some of the second matrix in error."""
    draw = scipy.stats.qmc.Sobol(6, seed=1).random(n) * 2 * np.pi - np.pi
    a, b = draw[:, :3], draw[:, 3:]
    mixed = [np.column_stack([b[:, k] if k == i else a[:, k] for k in range(3)]) for i in range(3)]
    points = np.stack([a, b, *mixed], axis=1).reshape(-1, 3)  # the rows of a point lie one after the other
    gone = np.isin(np.arange(len(points)), 5 * np.arange(lost) + 1)
    names = [f"mechanisms.m.x{index}" for index in range(3)]
    values: dict[str, Any] = {name: points[:, index] for index, name in enumerate(names)}
    values |= {
        "m.f": np.where(gone, np.nan, ishigami(points.T)),
        "status": np.where(gone, "error", "pass").astype(object),
    }
    values |= {"error": np.where(gone, "cannot be", None).astype(object)}
    columns = [*(Column(name) for name in names), Column("m.f")]
    return written(folder, columns, values, varied=names, design="saltelli", n=n, objectives=[{"minimise": "m.f"}])


def test_sobol_indices_are_those_of_the_closed_form_and_of_scipy(tmp_path: Path) -> None:
    with opened(saltelli(tmp_path / "out", 1 << 13)) as stored:
        data.prepare(stored)
        (found,) = influence.influences(stored, [stored.columns["m.f"]])
    assert found.is_sobol
    shares = {share.column.name[-1]: share for share in found.shares}
    ours = np.array([[shares[name].first, shares[name].total] for name in "012"], dtype=float).T
    np.testing.assert_allclose(ours, GLOBAL, atol=0.02)
    uniform = scipy.stats.uniform(loc=-np.pi, scale=2 * np.pi)
    other = scipy.stats.sobol_indices(func=ishigami, n=1 << 13, dists=[uniform] * 3, rng=3)
    np.testing.assert_allclose(ours, [other.first_order, other.total_order], atol=0.02)
    for share, first in ((shares["0"], GLOBAL[0, 0]), (shares["1"], GLOBAL[0, 1])):
        assert share.first_error is not None and abs(share.first - first) < 2 * share.first_error


def test_sobol_indices_leave_out_base_rows_that_miss_a_variant(tmp_path: Path) -> None:
    with opened(saltelli(tmp_path / "out", 1 << 12, lost=96)) as stored:
        data.prepare(stored)
        (found,) = influence.influences(stored, [stored.columns["m.f"]])
    assert found.variants == 5 * ((1 << 12) - 96)
    np.testing.assert_allclose(sorted(share.total or 0 for share in found.shares), sorted(GLOBAL[1]), atol=0.06)


def test_without_such_a_sample_rank_correlation_is_told(large: Path) -> None:
    rows = [row for row in rows_of(large) if row["status"] != "error"]
    with opened(large) as stored:
        data.prepare(stored)
        (found,) = influence.influences(stored, [stored.columns["drive.power_peak"]])
    shares = {share.column.name: share.first for share in found.shares}
    power = [row["drive.power_peak"] for row in rows]
    for name in (SPEED, BORE):
        assert shares[name] == pytest.approx(
            scipy.stats.spearmanr([row[name] for row in rows], power).statistic, abs=1e-12
        )
    ranked = scipy.stats.rankdata(power)
    groups = [ranked[[row[LAW] == law for row in rows]] for law in ("harmonic", "cycloidal")]
    between = sum(len(group) * (group.mean() - ranked.mean()) ** 2 for group in groups) / len(ranked)
    assert shares[LAW] == pytest.approx(np.sqrt(between / ranked.var()), abs=1e-12)
    assert not found.is_sobol


def test_equal_values_share_their_rank() -> None:
    values = np.random.default_rng(2).integers(0, 5, 40).astype(float)
    np.testing.assert_array_equal(influence.ranks(values), scipy.stats.rankdata(values))


# --- pages -----------------------------------------------------------------------------------------------------------


class Tags(HTMLParser):
    """All start tags with their attributes."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.found: list[tuple[str, dict[str, str | None]]] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.found.append((tag, dict(attrs)))


@pytest.fixture(scope="module")
def small(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = ten(
        tmp_path_factory.mktemp("small") / "out",
        title="Ten <variants>",
        state="running",
        counts={"sample": 13, "variants": 10, "dropped": 3},
    )
    (folder / "reports").mkdir()
    (folder / "reports" / "6.html").write_text("the report")
    (folder / "reports" / "3.pdf").write_text("the report")
    return folder


def test_the_pages_are_written_and_say_the_counts(small: Path) -> None:
    assert summarise(small) == [small / "summary.html", small / "summary.pdf"]
    text = re.sub(r"<[^>]+>", "", (small / "summary.html").read_text("utf-8"))
    assert "3 of 10 variants pass all checks, 6 fail, 1 cannot exist." in text
    assert "The run is not complete." in text
    assert re.search(r"Left out by constraints\s*3 variants", text)
    assert "bore_radius 0.104 m leaves no wall" in text
    paper = " ".join("\n".join(sheet.extract_text() for sheet in PdfReader(small / "summary.pdf").pages).split())
    assert "3 of 10 variants pass all checks" in paper
    assert "Spearman’s rank correlation" in paper


def test_links_lead_to_the_reports_that_exist(small: Path) -> None:
    tags = Tags(page(summary_of(small))).found
    links = {a["href"] for tag, a in tags if tag == "a" and "href" in a}
    assert {link for link in links if link and not link.startswith("#")} == {"reports/6.html", "reports/3.pdf"}
    anchors = {a.get("id") for _, a in tags}
    assert all(link and link[1:] in anchors for link in links if link and link.startswith("#"))


def test_the_html_page_needs_nothing_from_elsewhere(large_summary: contents.Summary) -> None:
    for tag, attributes in Tags(page(large_summary)).found:
        for name in ("src", "href", "xlink:href"):
            value = attributes.get(name) or "#"
            assert value.startswith(("#", "data:")), (tag, value)


def test_what_a_user_wrote_cannot_end_a_script_or_a_tag(tmp_path: Path) -> None:
    law = ["</script><b>", "harmonic"] * 5
    text = page(
        summary_of(made(tmp_path / "out", np.linspace(3, 7, 10), np.linspace(0.05, 0.09, 10), law, title="<i>x</i>"))
    )
    assert "<b>" not in text and "<i>x" not in text
    data_ = text.split('id="any-data">')[1].split("</script>")[0]
    assert json.loads(data_)["columns"][2]["words"] == ["</script><b>", "harmonic"]


def test_every_chart_has_a_text_alternative(large_summary: contents.Summary) -> None:
    found = large_summary
    charts = [*found.figures.values(), *(found.ranked.figures if found.ranked else [])]
    assert len(charts) == 9
    for figure in charts:
        assert len(figure.alternative) > 20
        assert re.search(r"<title>[^<]{20,}</title>", figure.svg.text)
    document = PdfReader(io.BytesIO(sheets(found)))
    assert "/StructTreeRoot" in document.trailer["/Root"]


def test_a_large_study_is_aggregated_and_says_so(large_summary: contents.Summary) -> None:
    found = large_summary
    assert len(found.any_two.variants) == contents.SAMPLED
    assert "a sample of 1500 variants is drawn" in found.figures["pair"].caption
    assert not found.is_whole and len(found.matrices[0].rows) < 45
    assert len(page(found)) < 3_000_000
    assert "its functions take one number at a time" in page(found)


def test_objectives_and_failing_checks_come_before_other_outputs(tmp_path: Path) -> None:
    names = [column.name for column in summary_of(ten(tmp_path / "out")).choices]
    assert names[2:6] == ["drive.power_peak", "cylinder.mass", "greatest utilisation", "drive.checks.play.utilisation"]
    assert {"drive.crank_torque_peak", "drive.idle_ratio"} <= set(names[6:])


def test_what_people_read_are_titles_and_units_not_names(small: Path) -> None:
    text = re.sub(r"<[^>]+>", " ", page(summary_of(small)))
    assert "Most failures: Play of the joints (drive)" in " ".join(text.split())
    assert "Speed of the crank (drive), rpm" in text and "Mass of the cylinder (cylinder), kg" in text
    assert re.search(r"diecut-report report out#\d", text)


def test_titles_are_unlike_each_other() -> None:
    gear = [Column(f"mechanisms.train.gears.{i}.teeth", description="Teeth of the gear") for i in range(2)]
    force = [Column(f"{name}.force", description=f"Force ({end})") for name, end in (("a", "up"), ("b", "up"))]
    both = [Column(f"a.force_{end}", description=f"Force ({end})") for end in ("mean", "peak")]
    found = titles([*gear, *force, *both, Column("status", description="Status")])
    assert list(found.values()) == [
        "Teeth of the gear: no. 1 of gears (train)", "Teeth of the gear: no. 2 of gears (train)",
        "Force (up) (a)", "Force (b)", "Force (mean) (a)", "Force (peak) (a)", "",
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("value", "text"),
    [(0.0, "0.00"), (1e-9, "< 0.01"), (0.996, "0.9960"), (1.0, "1.00"), (1.003, "1.0030"), (120, "120")],
)
def test_a_utilisation_shows_on_which_side_of_one_it_is(value: float, text: str) -> None:
    assert utilised(value) == text


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


def test_the_same_variants_give_the_same_page(small: Path) -> None:
    assert page(summary_of(small)) == page(summary_of(small))


@pytest.mark.parametrize("count", [1, 2, 3])
def test_few_variants_have_a_summary_too(tmp_path: Path, count: int) -> None:
    folder = many(tmp_path / "out", count, seed=3)
    summarise(folder)
    assert (folder / "summary.pdf").read_bytes().startswith(b"%PDF")


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


@pytest.mark.slow
def test_three_hundred_thousand_variants_stay_within_memory(tmp_path: Path) -> None:
    import subprocess
    import sys

    folder = many(tmp_path / "out", 300_000)
    code = (
        "import resource, sys; from pathlib import Path; from diecut_report.batch.summary import summarise; "
        "summarise(Path(sys.argv[1])); print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)"
    )
    done = subprocess.run([sys.executable, "-c", code, str(folder)], capture_output=True, text=True, check=True)
    assert int(done.stdout) < 600_000  # kB
