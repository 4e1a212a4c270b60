"""How a value is shown: unit and digits by what they mean."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from diecut_report.quantities.formatting import (
    FAMILIES,
    easy_unit,
    listed_text,
    number_text,
    place_shown,
    shortest,
    shown,
    si,
    told,
    with_unit,
)
from diecut_report.quantities.units import parse_quantity, unit


def printed(quantity: str, declared: str) -> str:
    """A computed quantity as a report shows it, in ASCII."""
    value = parse_quantity(quantity, declared)
    text = shown(value, easy_unit(value, declared))
    return f"{text['text']} {text['unit']}"


@pytest.mark.parametrize(
    ("quantity", "declared", "text"),
    [
        ("0.0259123 mm", "mm", "26 um"),  # a micrometre is the finest that is made
        ("0.05 mm", "mm", "0.05 mm"),  # as somebody wrote it
        ("0.10512345 m", "mm", "105.1 mm"),
        ("12345.6 mm", "mm", "12.35 m"),
        ("1100 W", "kW", "1.1 kW"),
        ("38.8012 W", "kW", "38.80 W"),  # its zero is rounded to, and stands
        ("11764.5 N", "N", "11.76 kN"),
        ("36028.5 MPa", "MPa", "36.03 GPa"),
        ("44.22 N", "N", "44.2 N"),
        ("5.9831 deg", "deg", "5.98 deg"),
        ("0.0288012 deg", "deg", "0.0288 deg"),
        ("-5e-14 deg", "deg", "0 deg"),
        ("2.2e-14 %", "%", "0 %"),
        ("0.95266 kg", "kg", "0.953 kg"),
        ("1.3351 K", "K", "1.34 K"),
        ("3.596e-16", "1", "0 1"),  # what rounding left; a note beside it says so
        ("3596 1/h", "1/h", "3596 1/h"),
        ("5e-324", "1", "0 1"),
        ("3.596e-9", "1", "3.596e-9 1"),  # a residual that is more
        ("0.000198 m/s", "m/s", "0.198 mm/s"),
        ("0.0275 m/s", "m/s", "27.5 mm/s"),
    ],
)
def test_digits_and_unit_say_what_is_meant(quantity: str, declared: str, text: str) -> None:
    assert printed(quantity, declared) == text


@pytest.mark.parametrize(
    ("degrees", "text"), [(38.84648, "38.85"), (356.8784, "356.88"), (0.123456, "0.123"), (180.0, "180")]
)
def test_a_place_has_no_more_digits_than_mean_something(degrees: float, text: str) -> None:
    assert place_shown(math.radians(degrees), "deg") == {"text": text, "unit": "deg"}


@given(st.sampled_from([(each, family) for family in FAMILIES for each in family]), st.floats(1e-5, 1e7))
def test_an_easy_number_lies_in_its_range_where_its_family_reaches(
    declared: tuple[str, tuple[str, ...]], number: float
) -> None:
    own, family = declared
    value = unit(own).to_si(number)
    chosen = easy_unit(value, own)
    shown_number = value / unit(chosen).factor
    if chosen == own:
        return
    assert unit(chosen).si == unit(own).si and chosen in family
    assert 0.1 * (1 - 1e-9) <= shown_number < 1e4 * (1 + 1e-9) or chosen in (family[0], family[-1])


@given(st.floats(1e-6, 1e6), st.sampled_from(["mm", "deg", "N", "s", "kg", "m/s", "K", "%", "kW", "1"]))
def test_a_shown_number_is_its_value_rounded_at_its_last_digit(number: float, declared: str) -> None:
    value = unit(declared).to_si(number)
    text = shown(value, declared)["text"]
    mantissa, _, power = text.partition("e")
    last = 10.0 ** (int(power or 0) - len(mantissa.partition(".")[2]))
    assert math.isclose(float(text), value / unit(declared).factor, abs_tol=0.5 * last * (1 + 1e-9), rel_tol=1e-12)


@pytest.mark.parametrize("text", ["0.05", "123.456789", "1450", "0.1234567", "2000.250", "12.5"])
def test_a_typed_number_is_never_rounded(text: str) -> None:
    assert float(shortest(unit("mm").from_si(parse_quantity(f"{text} mm", "mm")))) == float(text)


@pytest.mark.parametrize(
    ("hours", "text"), [(173102.3, "173000"), (9876.5, "9880"), (20000, "20000"), (3.781e6, "3.78e6")]
)
def test_a_life_is_told_with_three_digits(hours: float, text: str) -> None:
    assert shown(hours * 3600, "h")["text"] == text


def test_fewer_digits_than_usual_are_so_many_before_the_decimal_sign_too() -> None:
    assert (number_text(12345.6, 3), number_text(12345.6), number_text(12345, 3)) == ("12300", "12346", "12345")


def test_revolutions_a_minute_are_printed_as_the_standard_writes_them() -> None:
    assert with_unit("60", "rpm") == "60 r/min" and unit("r/min") == unit("rpm")


@pytest.mark.parametrize(
    ("quantity", "display", "text"),
    [
        ("314.10237 deg", "deg", "314.1"),
        ("-28.90312 deg", "deg", "-28.9"),
        ("0.921246 deg", "deg", "0.92"),
        ("1149.2213 ms", "ms", "1149.2"),
        ("-0.00001 ms", "ms", "0"),
        ("160 deg", "deg", "160"),
        ("1.2345678", "1", "1.23457"),  # of a pure number nobody knows the step
    ],
)
def test_numbers_of_a_column_stop_at_the_step_that_can_be_made_or_measured(
    quantity: str, display: str, text: str
) -> None:
    assert listed_text(si(float(quantity.split()[0]), display), display) == text


# Numbers in advice: rounded so that they are enough, and where only some are allowed one of these.


BORES = (25.0, 32.0, 40.0, 50.0)


@pytest.mark.parametrize(
    ("value", "up", "words"),
    [
        (0.0333, True, "40 mm"),
        (0.0333, False, "32 mm"),
        (0.0333, None, "32 mm"),
        (0.032, True, "32 mm"),
        (0.032, False, "32 mm"),
        (np.float64(0.0411), True, "50 mm"),
        (0.0612, True, "61.2 mm"),
        (0.02, False, "20 mm"),
    ],
)
def test_of_listed_numbers_the_next_one_is_told(value: float, up: bool | None, words: str) -> None:
    assert told(value, "mm", up=up, listed=BORES) == words


def test_without_a_list_the_number_is_rounded_outwards() -> None:
    assert (told(0.0333333, "mm", up=True), told(0.0333333, "mm", up=False)) == ("33.34 mm", "33.33 mm")
