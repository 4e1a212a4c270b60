"""An implicit equation: the sag of a chain, found between two bounds and proved by another form of the relation."""

from __future__ import annotations

import numpy as np

from diecut_report.api import Chapter, Inputs, Mechanism, Quantity, m, root


class Chain(Inputs):
    span = Quantity("a", "m", "Distance of the chain's ends", gt=0)
    length = Quantity("L", "m", "Length of the chain", gt=0)


catenary = Chapter("Catenary")
catenary.require("hangs", m.length > m.span, key="length", message="is {length}; it must be longer than {span}")
half = m.span / (2 * m.parameter)  # a name for what stands several times; it is printed in each place
solved = root(
    2 * m.parameter * np.sinh(half) - m.length,
    low=0.05 * m.span,
    high=100 * m.span,
    left=np.sinh(half),
    right=m.length / (2 * m.parameter),
)
catenary.parameter = solved, "c", "m", "Parameter of the catenary"
catenary.sag = m.parameter * (np.cosh(half) - 1), "f", "m", "Sag"

MECHANISM = Mechanism(
    kind="chain", version="1.0", title="Chain", summary="Sag of a chain.", inputs=Chain, chapters=(catenary,)
)

PRESS = """
mechanisms:
  chain: {kind: chain, span: 2 m, length: 2.3504 m}
"""
GIVES = {"chain.parameter": "1 m", "chain.sag": "0.5431 m"}
