"""An implicit equation: the sag of a chain, found between two bounds and proved by another form of the relation."""

from __future__ import annotations

import numpy as np

from diecut_report.api import Annotated, Chapter, Inputs, Mechanism, Quantity


class Chain(Inputs):
    span: Annotated[float, Quantity("a", "m", "Distance of the chain's ends", gt=0)]
    length: Annotated[float, Quantity("L", "m", "Length of the chain", gt=0)]


catenary = Chapter("Catenary")
catenary.require(
    "hangs", lambda span, length: length > span, key="length", message="is {length}; a chain hangs where it is longer than {span}",
)  # fmt: skip
catenary.root(
    "parameter", "c", "m", "Parameter of the catenary",
    lambda parameter, span, length: 2 * parameter * np.sinh(span / (2 * parameter)) - length,
    low=lambda span: 0.05 * span,
    high=lambda span: 100 * span,
    left=lambda parameter, span: np.sinh(span / (2 * parameter)),
    right=lambda parameter, length: length / (2 * parameter),
)  # fmt: skip
catenary.value("sag", "f", "m", "Sag", lambda parameter, span: parameter * (np.cosh(span / (2 * parameter)) - 1))

MECHANISM = Mechanism(
    kind="chain", version="1.0", title="Chain", summary="Sag of a chain.", inputs=Chain, chapters=(catenary,)
)

PRESS = """
mechanisms:
  chain: {kind: chain, span: 2 m, length: 2.3504 m}
"""
GIVES = {"chain.parameter": "1 m", "chain.sag": "0.5431 m"}
