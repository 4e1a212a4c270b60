"""The standard series: their values against second published tables, their order, sources and page."""

from __future__ import annotations

import runpy
import subprocess
import sys
from itertools import pairwise
from pathlib import Path

import pytest

from diecut_report.standards import standard_ids, standard_series, standard_series_by, standard_table
from diecut_report.standards.files import FORMS
from diecut_report.standards.tables import StandardSeries

ROOT = Path(__file__).parents[2]


def numbers(text: str) -> list[float]:
    return [float(word) for word in text.split()]


def named(text: str) -> dict[str, float]:
    words = text.split()
    return dict(zip(words[::2], map(float, words[1::2]), strict=True))


# --- second tables: typed from the sources named, as these print them ------------------------------------------------

MOTIVE = numbers(
    "0.06 0.09 0.13 0.18 0.25 0.37 0.55 0.75 1.1 1.5 2.2 3 4 5.5 7.5 9.2 11 15 18.5 22 30 37 45 55 75 90 110 132 160 200"
)
GOST_DIAMETERS = numbers(
    "100 106 112 118 125 132 140 150 160 170 180 190 200 212 224 236 250 265 280 300 315 335 355 375 400 425 450 475"
    " 500 530 560 600 630 670 710 750 800 850 900 950 1000"
)
BELTS_4_13 = numbers(
    "400 450 500 560 630 710 800 900 1000 1120 1250 1400 1600 1800 2000 2240 2500 2800 3150 3550 4000 4500 5000 5600"
    " 6300 7100 8000 9000 10000 11200 12500 14000"
)
OPTIBELT = {
    "SPZ": numbers(
        "487 512 562 587 612 630 637 662 670 687 710 722 737 750 762 772 787 800 812 825 837 850 862 875 887 900 912"
        " 925 937 950 962 987 1000 1012 1024 1037 1047 1060 1077 1087 1112 1120 1137 1162 1180 1187 1202 1212 1237"
        " 1250 1262 1287 1312 1320 1337 1347 1362 1387 1400 1412 1437 1462 1487 1500 1512 1537 1562 1587 1600 1612"
        " 1637 1662 1687 1700 1737 1762 1787 1800 1812 1837 1862 1887 1900 1937 1987 2000 2037 2120 2137 2187 2240"
        " 2287 2360 2500 2650 2800 3000 3150 3350 3550"
    ),
    "SPA": numbers(
        "732 757 782 800 807 832 850 857 882 900 907 932 950 957 982 1000 1007 1032 1060 1082 1107 1120 1132 1157 1180"
        " 1207 1232 1250 1257 1272 1282 1307 1320 1332 1357 1382 1400 1407 1432 1457 1482 1500 1507 1532 1557 1582 1600"
        " 1607 1632 1657 1682 1700 1707 1732 1757 1782 1800 1807 1832 1857 1882 1900 1907 1932 1957 1982 2000 2032 2057"
        " 2082 2120 2132 2182 2207 2232 2240 2282 2300 2307 2332 2360 2382 2432 2482 2500 2532 2582 2607 2632 2650 2682"
        " 2732 2782 2800 2832 2847 2882 2932 2982 3000 3032 3082 3150 3182 3282 3350 3382 3550 3750 4000 4250 4500"
    ),
    "SPB": numbers(
        "1250 1320 1400 1500 1600 1700 1800 1900 2000 2120 2240 2360 2500 2650 2800 3000 3150 3250 3350 3550 3750 4000"
        " 4250 4500 4750 5000 5300 5600 6000 6300 6700 7100 7500 8000"
    ),
    "SPC": numbers(
        "2000 2120 2240 2360 2500 2650 2800 3000 3150 3350 3550 3750 4000 4250 4500 4750 5000 5300 5600 6000 6300 6700"
        " 7100 7500 8000 8500 9000 9500 10000 10600 11200 12500"
    ),
}
RUBENA_SPB = numbers(
    "1250 1320 1400 1410 1450 1472 1500 1600 1700 1778 1800 1900 2000 2020 2100 2120 2150 2220 2240 2264 2280 2360 2391"
    " 2400 2480 2500 2518 2650 2680 2780 2800 2840 2850 3000 3130 3150 3250 3350 3550 3750 3800 4000 4050 4250 4300 4500"
    " 4560 4750 4820 4842 5000 5058 5070 5300 5600 6000 6300 6340 6700 7100 7250 7500 8000"
)
MEGADYNE_SPC = numbers(
    "2000 2120 2240 2360 2500 2650 2800 3000 3150 3350 3550 3750 4000 4250 4400 4500 4750 5000 5300 5600 6000 6300 6700"
    " 7100 7500 8000 8500 9000 9500 10000 10600 11200 11800 12000 12500"
)
PTI_INCHES = named("MXL 0.080 XL 0.200 L 0.375 H 0.500 XH 0.875 XXH 1.250")
SYNCHROFLEX = named("T2.5 2.5 T5 5 T10 10 T20 20 AT5 5 AT10 10 AT20 20")
GLOBALSPEC = named("3M 3 5M 5 8M 8 14M 14 20M 20")
RECORD = named(
    "05B 8 06B 9.525 08B 12.7 10B 15.875 12B 19.05 16B 25.4 20B 31.75 24B 38.1 28B 44.45 32B 50.8 40B 63.5 48B 76.2"
    " 08A 12.7 10A 15.875 12A 19.05 16A 25.4 20A 31.75 24A 38.1 28A 44.45 32A 50.8 40A 63.5"
)
AMETRIC = named(  # two decimals, cut off
    "05B 8.00 06B 9.52 08B 12.70 10B 15.87 12B 19.05 16B 25.40 20B 31.75 24B 38.10 28B 44.45 32B 50.80 40B 63.50"
    " 48B 76.20"
)
LEAST_DIAMETERS = {
    "Klein, table 441.1": named("Z 50 A 75 B 125 C 200 D 355 E 500"),
    "GOST 20889-88": named("Z 50 A 75 B 125 C 200 D 315 E 500"),
    "Optibelt": named("Z 50 A 71 B 112 C 180 D 355 E 500 SPZ 63 SPA 90 SPB 140 SPC 224"),
    "Megadyne": named("SPA 90 SPB 140 SPC 224"),
    "Mecha": named("SPZ 63"),
}


def test_the_motor_ratings_are_those_of_a_catalogue_but_for_0_13_and_9_2() -> None:
    assert set(standard_series("iec_60072_ratings").values) == set(MOTIVE) - {0.13, 9.2} | {0.12}


def test_the_synchronous_speeds_follow_from_frequency_and_poles() -> None:
    speeds = standard_table("motor_synchronous_speeds").values
    assert len(speeds) == 8
    for name, speed in speeds.items():
        poles, _, frequency, _ = name.replace(",", "").split()
        assert speed == 120 * float(frequency) / float(poles)


@pytest.mark.parametrize(("id", "count", "rounding"), [("r10", 10, 0.0126), ("r20", 20, 0.0126), ("r40", 40, 0.0127)])
def test_preferred_numbers_are_rounded_powers_of_ten(id: str, count: int, rounding: float) -> None:
    values = standard_series(f"renard_{id}").values
    assert len(values) == count + 1
    assert [v for i, v in enumerate(values) if abs(v / 10 ** (i / count) - 1) > rounding] == []


def test_preferred_numbers_are_those_of_the_published_tables() -> None:
    r10, r20, r40 = (standard_series(f"renard_{id}").values for id in ("r10", "r20", "r40"))
    assert r10 == (1.00, 1.25, 1.60, 2.00, 2.50, 3.15, 4.00, 5.00, 6.30, 8.00, 10.00)  # DIN 323-1
    assert [1000 * v for v in r20] == pytest.approx([v for v in BELTS_4_13 if 1000 <= v <= 10000])
    assert [100 * v for v in r40] == pytest.approx(GOST_DIAMETERS)
    assert {round(1000 * v) for v in r40} <= {*OPTIBELT["SPA"], *OPTIBELT["SPB"], *OPTIBELT["SPC"]}
    assert r10 == r20[::2] and r20 == r40[::2]


def test_the_lengths_are_the_preferred_numbers_laid_over_the_decades() -> None:
    lengths = standard_series("renard_r40_lengths").values
    assert [v for v in lengths if 100 <= v <= 1000] == GOST_DIAMETERS
    assert [v for v in lengths if v <= 100] == [round(d / 10, 1) for d in GOST_DIAMETERS]
    assert [v for v in lengths if v >= 1000] == [10 * d for d in GOST_DIAMETERS if d <= 500]
    assert standard_series("renard_r20_lengths").values == lengths[::2]


def test_the_belt_pitches_are_those_of_other_tables() -> None:
    pitches = standard_table("toothed_belt_pitches").values
    inches = {name: round(25.4 * inch, 3) for name, inch in PTI_INCHES.items()}
    assert dict(pitches) == {**inches, **SYNCHROFLEX, **GLOBALSPEC}


LIBRARY = {
    "08B": (8.51, None, 4.45),
    "10B": (10.16, 9.65, 5.08),
    "12B": (12.07, 11.68, 5.72),
    "16B": (15.88, 17.02, 8.28),
}
"""Roller, inner width and pin of a public library of chains, in mm; its width of 08B is that of the roller, a slip."""


@pytest.mark.parametrize(
    ("column", "id"), [(0, "iso_606_roller_diameters"), (1, "iso_606_inner_widths"), (2, "iso_606_pin_diameters")]
)
def test_the_dimensions_of_chains_are_those_of_a_third_table(column: int, id: str) -> None:
    found = standard_table(id).values
    assert list(found) == ["08B", "10B", "12B", "16B", "20B", "24B"]
    known = {name: row[column] for name, row in LIBRARY.items() if row[column] is not None}
    assert {name: found[name] for name in known} == known


def test_a_chain_is_made_of_what_goes_together() -> None:
    tables = [
        standard_table(f"iso_606_{name}").values
        for name in ("pitches", "roller_diameters", "inner_widths", "pin_diameters")
    ]
    for name in tables[3]:
        pitch, roller, width, pin = (table[name] for table in tables)
        assert pin < roller < pitch and 0.55 < roller / pitch < 0.7 and 0.55 < width / pitch < 0.7


def test_the_chain_pitches_are_those_of_other_tables_and_sixteenths_of_an_inch() -> None:
    pitches = standard_table("iso_606_pitches").values
    assert dict(pitches) == RECORD
    assert {name: int(100 * pitches[name] + 1e-6) / 100 for name in AMETRIC} == AMETRIC
    inches = {name: round(int(name[:2]) * 25.4 / 16, 4) for name in pitches if name != "05B"}
    assert inches == {name: pitch for name, pitch in pitches.items() if name != "05B"}


@pytest.mark.parametrize("section", ["SPZ", "SPA", "SPB", "SPC"])
def test_the_belt_lengths_are_every_r20_number_of_their_range_and_sold(section: str) -> None:
    series = standard_series_by("iso_4184_lengths")[section]
    assert list(series.values) == [v for v in BELTS_4_13 if series.values[0] <= v <= series.values[-1]]
    assert set(series.values) <= set(OPTIBELT[section])


@pytest.mark.parametrize(("section", "sold"), [("SPB", RUBENA_SPB), ("SPC", MEGADYNE_SPC)])
def test_the_lengths_that_one_price_list_lacks_are_sold_by_another_maker(section: str, sold: list[float]) -> None:
    assert set(standard_series_by("iso_4184_lengths")[section].values) <= set(sold)


def test_the_least_diameters_stand_in_two_tables() -> None:
    for section, diameter in standard_table("vbelt_least_diameter").values.items():
        agreeing = [source for source, table in LEAST_DIAMETERS.items() if table.get(section) == diameter]
        assert len(agreeing) >= 2, section


# Saarstahl, material specification sheets by DIN EN 10083: up to a diameter (mm) the least tensile and yield strength (MPa).
SAARSTAHL = {
    "42CrMo4+QT": {16: (1100, 900), 40: (1000, 750), 100: (900, 650), 160: (800, 550), 250: (750, 500)},
    "C45E+QT": {16: (700, 490), 40: (650, 430), 100: (630, 370)},
    "C45E+N": {16: (620, 340), 100: (580, 305), 250: (560, 275)},
}


@pytest.mark.parametrize(("id", "column"), [("steel_tensile_strengths", 0), ("steel_yield_strengths", 1)])
def test_the_strengths_of_steels_are_those_of_another_maker(id: str, column: int) -> None:
    known = {f"{grade} ≤ {size} mm": both[column] for grade, sizes in SAARSTAHL.items() for size, both in sizes.items()}
    assert dict(standard_table(id).values) == known


# --- every file ------------------------------------------------------------------------------------------------------


def listed(*forms: str) -> list[StandardSeries]:
    return [standard_series(id) for form in forms for id in standard_ids(form)]


BY_NAME = [series for id in standard_ids("by") for series in standard_series_by(id).values()]


@pytest.mark.parametrize("series", [*listed("values", "table"), *BY_NAME], ids=lambda series: series.id)
def test_a_file_names_two_sources_and_what_it_left_out(series: StandardSeries) -> None:
    assert len(set(series.sources)) >= 2
    assert not any("confirmed" in source or "://" in source for source in series.sources)
    assert series.left_out.endswith(".")


@pytest.mark.parametrize("series", [*listed("values"), *BY_NAME], ids=lambda series: series.id)
def test_a_series_ascends_without_a_gap(series: StandardSeries) -> None:
    steps = [after / before for before, after in pairwise(series.values)]
    assert min(steps) > 1 and max(steps) <= 1.5


@pytest.mark.wheel
def test_the_files_are_the_documented_ones() -> None:
    assert {form: standard_ids(form) for form in FORMS} == {
        "values": ("din_6885_lengths", "iec_60072_ratings", "iso_54_modules", "renard_r10", "renard_r20",
                   "renard_r20_lengths", "renard_r40", "renard_r40_lengths"),
        "table": ("iso_606_inner_widths", "iso_606_pin_diameters", "iso_606_pitches", "iso_606_roller_diameters", "motor_synchronous_speeds",
                  "steel_tensile_strengths", "steel_yield_strengths", "toothed_belt_pitches", "vbelt_least_diameter"),
        "by": ("iso_4184_lengths",),
    }  # fmt: skip


def test_a_series_is_read_once_and_cannot_be_changed() -> None:
    table = standard_table("iso_606_pitches")
    assert table is standard_table("iso_606_pitches")
    assert standard_series_by("iso_4184_lengths") is standard_series_by("iso_4184_lengths")
    with pytest.raises(TypeError):
        table.values["08B"] = 12.0  # type: ignore[index]


def test_nothing_is_read_at_import() -> None:
    program = (
        "import sys; opened = []; sys.addaudithook(lambda e, a: opened.append(str(a[0])) if e == 'open' else None);"
        " from diecut_report.standards import standard_series; before = [f for f in opened if 'standards/data' in f];"
        " standard_series('renard_r10'); print(len(before), sum('standards/data' in f for f in opened))"
    )
    run = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert run.stdout.split() == ["0", "1"]


def test_the_page_is_made_from_the_data_files() -> None:
    tool = runpy.run_path(str(ROOT / "tools" / "make_standards_page.py"))
    for file, text in tool["pages"]().items():
        assert file.read_text(encoding="utf-8") == text, "run: python tools/make_standards_page.py"
