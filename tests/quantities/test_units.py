"""Units and quantities: the table against pint, spellings, dimensions, and the wording of refusals."""

from __future__ import annotations

import json
import math
import subprocess
import sys
from typing import Any

import pint
import pytest

from diecut_report.config.plugins import Discovery
from diecut_report.quantities import units
from diecut_report.quantities.units import (
    UnitError,
    number_and_unit,
    parse_quantity,
    pretty,
    to_display,
    unit,
    with_point,
)

TABLE: dict[str, Any] = json.loads(units.TABLE_FILE.read_text(encoding="utf-8"))
PINT: Any = pint.LazyRegistry()
# In pint an angle is a pure number. A radian counts by its power in the root units, which pint keeps.
DIMENSION_OF_ROOT_UNIT = {
    "kilogram": "mass",
    "gram": "mass",
    "meter": "length",
    "second": "time",
    "kelvin": "temperature",
    "ampere": "current",
    "mole": "substance",
    "candela": "luminosity",
    "radian": "angle",
}


def measured_by_pint(text: str) -> tuple[float, dict[str, float]]:
    """SI factor and non-zero exponents by pint's own registry, which counts no angle among its dimensions."""
    in_si = PINT.Quantity(1.0, PINT.parse_units(text)).to_base_units()
    exponents = {DIMENSION_OF_ROOT_UNIT[name]: float(power) for name, power in in_si.unit_items()}
    return float(in_si.magnitude), exponents


def test_every_unit_of_the_table_agrees_with_pint() -> None:
    for text in TABLE["units"].keys() - {"1"}:
        factor, exponents = measured_by_pint(text)
        found = unit(text)
        assert found.text == text
        assert found.factor == pytest.approx(factor, rel=1e-12), text
        assert {name: power for name, power in zip(units.DIMENSIONS, found.kind, strict=True) if power} == exponents


def test_every_unit_that_a_built_in_kind_declares_is_in_the_table() -> None:
    """Pint is loaded for any other one, which takes a quarter of a second in each run."""
    known = Discovery([])
    declared = {step.unit for kind in known.origins for _, step in known.mechanism(kind).steps if hasattr(step, "unit")}
    assert sorted({unit(text).text for text in declared} - TABLE["units"].keys()) == []


def test_every_si_unit_of_the_table_is_coherent() -> None:
    for text in {family["si"] for family in TABLE["families"]} - {"1"}:
        assert (measured_by_pint(text)[0], unit(text).factor, unit(text).si) == (1.0, 1.0, text)


def test_a_unit_and_its_si_unit_are_of_one_kind() -> None:
    assert [text for text in TABLE["units"] if unit(unit(text).si).kind != unit(text).kind] == []


def test_aliases_lead_into_the_table() -> None:
    assert {*TABLE["aliases"].values()} <= {*TABLE["units"]}
    assert [spelling for spelling, text in TABLE["aliases"].items() if unit(spelling) != unit(text)] == []


def test_aliases_that_pint_reads_mean_the_same_there() -> None:
    read = {}
    for spelling, text in TABLE["aliases"].items():
        try:
            read[spelling] = (measured_by_pint(spelling), measured_by_pint(text))
        except pint.UndefinedUnitError:
            continue
    # pint reads "Nm" as a textile unit; "rev" and "r" are unknown to it or mean something else
    wrong = {spelling for spelling, (one, other) in read.items() if one[0] != pytest.approx(other[0], rel=1e-12)}
    assert wrong <= {"r/min", "Nm/rad"}
    assert len(read) > 30


@pytest.mark.parametrize(
    ("spelling", "text"),
    [
        ("kg*m^2", "kg*m**2"),
        ("kg·m²", "kg*m**2"),
        ("kg m2", "kg*m**2"),
        ("kgm²", "kg*m**2"),
        ("N·m", "N*m"),
        ("Nm", "N*m"),
        ("kNm", "kN*m"),
        ("Nmm", "N*mm"),
        ("Nm/rad", "N*m/rad"),
        ("m/s²", "m/s**2"),
        ("m·s⁻²", "m/s**2"),
        ("m s-2", "m/s**2"),
        ("N/mm2", "N/mm**2"),
        ("N / mm^2", "N/mm**2"),
        ("°", "deg"),
        ("°/s", "deg/s"),
        ("µm", "um"),
        ("μm", "um"),
        (" mm ", "mm"),
        ("J/(kg·K)", "J/(kg*K)"),
        ("/h", "1/h"),
        ("rev/h", "1/h"),
        ("rev/min", "rpm"),
        ("gmm", "g*mm"),
    ],
)
def test_usual_spellings_mean_the_unit_of_the_table(spelling: str, text: str) -> None:
    assert unit(spelling) == unit(text)
    assert unit(spelling).text == text


def test_a_glued_product_in_a_denominator_stays_there() -> None:
    assert unit("1/Nm").kind == tuple(-exponent for exponent in unit("N*m").kind)


@pytest.mark.parametrize(
    ("value", "display", "expected"),
    [
        (40, "mm", 0.04),
        (470.7, "mm", 0.4707),
        ("40", "mm", 0.04),
        ("0.07 m", "mm", 0.07),
        ("700mm", "mm", 0.7),
        ("21 kN", "N", 21000.0),
        ("0.3 MPa", "Pa", 3e5),
        ("60 deg", "deg", math.pi / 3),
        ("60°", "rad", math.pi / 3),
        ("50 rpm", "rad/s", 50 * 2 * math.pi / 60),
        (50, "rpm", 50 * 2 * math.pi / 60),
        ("6000 1/h", "1/h", 6000 / 3600),
        ("100 1/min", "1/h", 100 / 60),
        ("6000/h", "1/h", 6000 / 3600),
        ("6000 rev/h", "1/h", 6000 / 3600),
        ("1e5", "N", 1e5),
        ("1e5 N/mm**2", "Pa", 1e11),
        ("2.1e+5 MPa", "MPa", 2.1e11),
        (".5 m", "m", 0.5),
        ("−5 mm", "mm", -0.005),
        ("+5 mm", "mm", 0.005),
        ("30 %", "1", 0.3),
        ("12 kgf", "N", 12 * 9.80665),
        ("5 kJ", "N*m", 5000.0),
        ("2 in", "mm", 0.0508),
        ("40*mm", "mm", 0.04),
    ],
)
def test_a_quantity_becomes_si(value: float | str, display: str, expected: float) -> None:
    assert parse_quantity(value, display) == pytest.approx(expected, rel=1e-15)


@pytest.mark.parametrize(
    ("typed", "expected"), [("470.7 mm", 0.4707), ("0.6 mm", 0.0006), ("7.3 um", 7.3e-6), ("2.3 kN/mm", 2.3e6)]
)
def test_decimal_prefixes_keep_the_typed_digits(typed: str, expected: float) -> None:
    assert parse_quantity(typed, typed.split()[1]) == expected


@pytest.mark.parametrize(
    ("value", "display", "message"),
    [
        ("12 kg", "rpm", "12 kg is a mass; an angular speed is needed, for example 50 rpm."),
        ("50 1/min", "rpm", "50 1/min is a frequency; an angular speed is needed, for example 50 rpm."),
        ("50 rpm", "1/h", "50 rpm is an angular speed; a frequency is needed, for example 6000 1/h."),
        ("5 N*m", "N*m/rad", "5 N*m is a moment; an angular stiffness is needed, for example 5000 N*m/rad."),
        ("5 mm", "1", "5 mm is a length; a pure number is needed, for example 0.5."),
        ("5 rad", "1", "5 rad is an angle; a pure number is needed, for example 0.5."),
        ("3 cd", "mm", "3 cd is a quantity in cd; a length is needed, for example 40 mm."),
    ],
)
def test_another_dimension_is_refused_with_an_example(value: str, display: str, message: str) -> None:
    with pytest.raises(UnitError) as caught:
        parse_quantity(value, display)
    assert str(caught.value) == message


@pytest.mark.parametrize(
    ("typed", "display", "plain"),
    [
        ("1,5 mm", "mm", "1.5 mm"), ("0,600", "mm", "0.600"), ("−2,5e-3 кг·м²", "kg*m**2", "-0.0025 kg·m²"), ("470,7 мм", "mm", "470.7 mm"),
        ("12 Н·м", "N*m", "12 N·m"), ("12 Нм", "N*m", "12 N*m"), ("50 об/хв", "rpm", "50 rpm"), ("50 об/мин", "rpm", "50 rpm"),
        ("6000 1/год", "1/h", "6000 1/h"), ("7,5 кВт", "W", "7.5 kW"), ("300 МПа", "Pa", "300 MPa"), ("3 с", "s", "3 s"),
        ("5 мм/с²", "m/s**2", "5 mm/s²"), ("20 К", "K", "20 K"), ("5 мН", "N", "5 mN"), ("5 МН", "N", "5 MN"),
    ],
)  # fmt: skip
def test_a_decimal_comma_and_cyrillic_units_are_read(typed: str, display: str, plain: str) -> None:
    assert parse_quantity(typed, display) == parse_quantity(plain, display)
    assert with_point(typed) == plain


@pytest.mark.parametrize(
    ("typed", "one", "other"),
    [
        ("1,000 mm", "1000 mm", "1.000 mm"), ("-12,345 mm", "-12345 mm", "-12.345 mm"), ("1 000 mm", "1000 mm", "1.000 mm"),
        ("1\u202f000 mm", "1000 mm", "1.000 mm"), ("1'000 mm", "1000 mm", "1.000 mm"), ("470,700", "470700", "470.700"),
    ],
)  # fmt: skip
def test_what_may_be_a_thousand_or_one_is_asked(typed: str, one: str, other: str) -> None:
    with pytest.raises(UnitError, match=f" may be {one} or {other}; write the one that is meant"):
        parse_quantity(typed, "mm")


@pytest.mark.parametrize(
    ("typed", "whole"),
    [("1,000.5 mm", "1000.5 mm"), ("1.000,5 mm", "1000.5 mm"), ("1,000,000 mm", "1000000 mm"), ("1 234,5", "1234.5")],
)
def test_separators_of_thousands_are_refused_with_the_number(typed: str, whole: str) -> None:
    with pytest.raises(UnitError, match=f"has separators within its number; write {whole}[.]$"):
        parse_quantity(typed, "mm")


@pytest.mark.parametrize("typed", ["470.7 mм", "470.7 мm"])
def test_a_letter_of_another_alphabet_in_a_unit_is_named(typed: str) -> None:
    with pytest.raises(UnitError, match=r"Did you mean mm\? “м” \(cyrillic small letter em\) only looks Latin"):
        parse_quantity(typed, "mm")


@pytest.mark.parametrize(
    "value", [math.nan, math.inf, -math.inf, "nan", ".nan", "inf mm", ".inf", "1e400", "1e308 km", 10**400, "", "mm"]
)
def test_what_is_no_finite_number_is_refused(value: float | str) -> None:
    with pytest.raises(UnitError, match=r"finite number|too large"):
        parse_quantity(value, "mm")


@pytest.mark.parametrize("value", ["0, 5", "5, mm", "1,5,5 mm", "2*3 mm", "5 - 3 mm", "5\nmm", "5\x85mm", "5\u2028mm"])
def test_several_numbers_are_refused(value: str) -> None:
    with pytest.raises(UnitError, match="is not one number and a unit; a length is needed, for example 40 mm"):
        parse_quantity(value, "mm")


SPLIT = [
    ("3 mm", (3.0, "mm")),
    (" −2.5e-3*kg·m² ", (-0.0025, "kg·m²")),
    ("50 %", (50.0, "%")),
    ("7", (7.0, "")),
    ("1 1/h", (1.0, "1/h")),
]


@pytest.mark.parametrize(("text", "parts"), SPLIT)
def test_a_quantity_is_split_into_number_and_unit(text: str, parts: tuple[float, str]) -> None:
    number, unit_text = number_and_unit(text)
    assert (float(number), unit_text) == parts


@pytest.mark.parametrize("text", ["wide", "", "mm 3", "1,5,5 mm", "3 4 mm", "1_000 mm"])
def test_what_is_not_one_number_and_a_unit_is_refused(text: str) -> None:
    with pytest.raises(UnitError, match="a number with a unit is needed, for example 90 mm"):
        number_and_unit(text)


@pytest.mark.parametrize("value", [True, False])
def test_a_boolean_is_no_quantity(value: bool) -> None:
    with pytest.raises(UnitError, match=f"{str(value).lower()} is not a quantity; a length is needed"):
        parse_quantity(value, "mm")


@pytest.mark.parametrize(
    ("text", "suggestion"), [("KN", "kN"), ("Mpa", "MPa"), ("RPM", "rpm"), ("rmp", "rpm"), ("rad/ss", "rad/s")]
)
def test_an_unknown_unit_is_refused_with_a_near_one(text: str, suggestion: str) -> None:
    with pytest.raises(UnitError) as caught:
        unit(text)
    assert f"{text!r} is not a known unit. Did you mean {suggestion}?" in str(caught.value)


def test_an_unknown_unit_of_a_quantity_says_what_is_needed() -> None:
    with pytest.raises(UnitError) as caught:
        parse_quantity("5 Mpa", "MPa")
    assert str(caught.value) == (
        "'Mpa' is not a known unit. Did you mean MPa? A pressure or stress is needed, for example 0.3 MPa."
    )


@pytest.mark.parametrize(
    "text", ["(((", "m**", "m**0.5", "m**999999999", "x" * 100_000, "blurb", "", "2", "pixel", "dB"]
)
def test_what_is_no_unit_is_refused_at_once(text: str) -> None:
    with pytest.raises(UnitError, match="is not a known unit"):
        unit(text)


@pytest.mark.parametrize(
    ("text", "one", "other"), [("10 grad", "deg", "gon"), ("0.026 ton", "t", "short_ton"), ("3 gr", "g", "grain")]
)
def test_a_name_of_two_units_is_asked_about(text: str, one: str, other: str) -> None:
    assert parse_quantity(f"1 {other}", one) > 0
    with pytest.raises(UnitError, match=f"may be {one} or {other}; write the one that is meant"):
        parse_quantity(text, one)


@pytest.mark.parametrize("text", ["degC", "°C", "degF"])
def test_a_unit_without_fixed_zero_is_refused(text: str) -> None:
    with pytest.raises(UnitError, match="has no fixed zero; give a temperature difference in K"):
        unit(text)


@pytest.mark.parametrize(
    ("text", "factor", "si"),
    [
        ("yard", 0.9144, "m"),
        ("lbf*ft", 4.4482216152605 * 0.3048, "N*m"),
        ("kg*m**2/s", 1.0, "kg*m**2/s"),
        ("turn/hour", 2 * math.pi / 3600, "rad/s"),
        ("N/A", 1.0, "kg*m/s**2/A"),
    ],
)
def test_units_outside_the_table_are_read_by_pint(text: str, factor: float, si: str) -> None:
    assert text not in TABLE["units"]
    found = unit(text)
    assert found.factor == pytest.approx(factor, rel=1e-14)
    assert found.si == si


def test_display_is_the_inverse_of_parsing() -> None:
    found = {text: to_display(parse_quantity(12.5, text), text) for text in TABLE["units"]}
    assert found == pytest.approx(dict.fromkeys(found, 12.5), rel=1e-15)


@pytest.mark.parametrize(("value", "text", "expected"), [(0.105, "mm", 105.0), (0.0006, "mm", 0.6), (2e4, "kN", 20.0)])
def test_display_values_have_no_stray_digits(value: float, text: str, expected: float) -> None:
    assert to_display(value, text) == expected


@pytest.mark.parametrize(
    ("text", "printed"),
    [
        ("kg*m**2", "kg·m²"),
        ("N/mm", "N/mm"),
        ("deg", "°"),
        ("deg/s", "°/s"),
        ("1/h", "1/h"),
        ("1", ""),
        ("%", "%"),
        ("m/s**2", "m/s²"),
        ("um", "µm"),
        ("J/(kg*K)", "J/(kg·K)"),
        ("mm**4", "mm⁴"),
        ("rev/s", "rev/s"),
        ("kg*s**-12", "kg·s⁻¹²"),
    ],
)
def test_pretty_units(text: str, printed: str) -> None:
    assert pretty(text) == printed


def test_every_printed_unit_is_read_back() -> None:
    assert [text for text in TABLE["units"] if text != "1" and unit(pretty(text)) != unit(text)] == []


def test_everyday_units_do_without_pint() -> None:
    script = """
import sys
from diecut_report.quantities.units import parse_quantity, pretty
assert parse_quantity("21 kN·m", "N*m") == 21000.0
assert parse_quantity("100 1/min", "1/h") > 1.6
assert pretty("kg*m**2") == "kg·m²"
print("pint" in sys.modules)
parse_quantity("1 furlong", "m")
print("pint" in sys.modules)
"""
    run = subprocess.run([sys.executable, "-X", "utf8", "-c", script], capture_output=True, text=True, check=True)
    assert run.stdout.split() == ["False", "True"]
