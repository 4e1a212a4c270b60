"""Quantities: in other units, compared, printed, and to pint and back."""

from __future__ import annotations

import math

import pint
import pytest

import diecut_report as dr

TORQUE = dr.QuantityValue(523.4, "N*m", "crank_torque_peak", "M_max", "Peak torque")


def test_a_quantity_is_told_in_any_unit_of_its_dimension() -> None:
    assert TORQUE.to("kN*mm").value == pytest.approx(523.4) and TORQUE.to("kN*m").value == 0.5234
    assert dr.QuantityValue(2 * math.pi, "rad/s").to("rpm").magnitude == pytest.approx(60)
    assert dr.QuantityValue(90, "deg").si == pytest.approx(math.pi / 2)
    assert TORQUE.to("kN*m").to("N*m") == TORQUE and TORQUE.to("kN*m").description == "Peak torque"


@pytest.mark.parametrize(
    ("other", "words"),
    [("mm", "crank_torque_peak: 523.4 N·m is a moment in N*m; mm is a length."), ("Nn", "is not a known unit")],
)
def test_another_dimension_is_refused_in_words(other: str, words: str) -> None:
    with pytest.raises(dr.ConfigError) as caught:
        TORQUE.to(other)
    assert words in str(caught.value)


def test_quantities_are_compared_by_what_they_are_not_by_their_units() -> None:
    assert dr.QuantityValue(0.5234, "kN*m") == TORQUE and hash(TORQUE) == hash(TORQUE.to("kN*m"))
    assert "500 N*m" < TORQUE <= dr.QuantityValue(1, "kN*m") and TORQUE > 0 and TORQUE != 523.4
    assert dr.QuantityValue(3) == 3 and dr.QuantityValue("steel") == "steel" and {dr.QuantityValue(3): 1}[3] == 1
    assert dr.QuantityValue(523.4, "J/rad") != TORQUE
    with pytest.raises(dr.ConfigError, match="a moment is needed"):
        assert TORQUE < "3 mm"
    with pytest.raises(TypeError, match="cannot be compared with"):
        assert TORQUE < []  # type: ignore[operator]


@pytest.mark.parametrize("number", [523, 523.4, -1, float("inf")])
def test_a_number_without_a_unit_is_not_compared_with_a_quantity(number: float) -> None:
    with pytest.raises(TypeError, match=r"523\.4 N·m has a unit, and .* has none; compare it with a text, such as '"):
        assert number > TORQUE
    assert dr.QuantityValue(0.5, "1") < 1
    with pytest.raises(TypeError, match="has none"):
        assert dr.QuantityValue(2, "%") > 1


def test_a_number_with_a_unit_is_no_plain_number() -> None:
    assert float(dr.QuantityValue(0.25)) == 0.25
    with pytest.raises(TypeError, match=r"523.4 N·m has a unit; take the number of one, as in .to\('N\*m'\).value"):
        float(TORQUE)
    with pytest.raises(dr.ConfigError, match="steel is not a number"):
        dr.QuantityValue("steel").m_as("mm")


def test_a_quantity_prints_as_a_report_does() -> None:
    assert (str(TORQUE), f"{TORQUE:.0f}", repr(TORQUE)) == ("523.4 N·m", "523 N·m", "<crank_torque_peak: 523.4 N·m>")
    assert f"{TORQUE.to('kN*m')}" == "0.5234 kN·m" and str(dr.QuantityValue(True)) == "yes"
    assert TORQUE._repr_html_() == "<i class=sy>M</i><sub>max</sub> = 523.4\N{NO-BREAK SPACE}N·m"
    assert TORQUE._repr_latex_() == r"$M_{\mathrm{max}} = 523.4\,\mathrm{N}{\cdot}\mathrm{m}$"
    assert "<script>" not in dr.QuantityValue("<script>")._repr_html_()


def test_a_quantity_goes_to_pint() -> None:
    registry = pint.UnitRegistry()
    assert TORQUE.to_pint().to("kN*m").magnitude == pytest.approx(0.5234)
    assert TORQUE.to_pint(registry) == registry.Quantity(523.4, "N*m") and dr.QuantityValue(3).to_pint().dimensionless


def test_quantities_are_reckoned_with_by_pint() -> None:
    arm = dr.QuantityValue(200, "mm")
    assert (TORQUE / arm).m_as("kN") == pytest.approx(2.617) and str((TORQUE / arm).to("kN")) == "2.617 kN"
    assert (2 * TORQUE + TORQUE * 1 - TORQUE / 2).m_as("N*m") == pytest.approx(2.5 * 523.4)
    assert (arm**2).m_as("m**2") == pytest.approx(0.04) and (-arm).m_as("m") == -0.2 == -abs(-arm).m_as("m")
    assert (1 / arm).m_as("1/m") == pytest.approx(5) and (arm - dr.QuantityValue(1, "m")).m_as("mm") == pytest.approx(
        -800
    )
    assert float(arm / arm) == 1 and TORQUE / arm / arm * arm * arm > "523 N*m"
    with pytest.raises(pint.DimensionalityError):
        TORQUE + arm
    with pytest.raises(dr.ConfigError, match="is not a number"):
        dr.QuantityValue("steel") * 2
