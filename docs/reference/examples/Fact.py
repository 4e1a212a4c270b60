"""What steps stand on beside inputs: where the fact does not hold they are left out, and the words say why."""

from __future__ import annotations

from diecut_report.api import Chapter, Inputs, Mechanism, Quantity, inner, m, value


class Lines(Inputs):
    one = Quantity("n_1", "1/min", "Rate of one line", gt=0)
    other = Quantity("n_2", "1/min", "Rate of the other line", gt=0)
    length = Quantity("L", "mm", "Length of a sheet", gt=0)


rates = Chapter("Rates")
rates.error = inner(abs(m.one - m.other) / m.one), "δ", "%", "Difference of the rates"
rates.fact("rates_agree", m.error <= 1e-6, "not calculated: the lines run at different rates")
rates.speed = value(m.one * m.length, needs=("rates_agree",)), "v", "m/s", "Common speed"

MECHANISM = Mechanism(kind="lines", version="1.0", title="Lines", summary="Two lines.", inputs=Lines, chapters=(rates,))

PRESS = """
mechanisms:
  equal: {kind: lines, one: 60 1/min, other: 60 1/min, length: 700 mm}
  unlike: {kind: lines, one: 60 1/min, other: 50 1/min, length: 700 mm}
"""
GIVES = {"equal.speed": "0.7 m/s", "unlike.error": "16.67 %"}
