"""With which inputs ``diecut-report new`` begins a configuration of a kind, wired to the other mechanisms that the press has."""

from __future__ import annotations

from diecut_report.api import (
    CONTRACT as KNOWN,
)  # fmt: skip
from diecut_report.api import Block, Chapter, ExampleBlock, ForEach, Inputs, Mechanism, Quantity, Wired, m, parts, total

CONTRACT = 2  # the contract for which this module is written; a program with another one says so
assert CONTRACT == KNOWN


class Load(Block):
    mass = Quantity("m_k", "kg", "Mass on the hook", gt=0)


class Hoist(Inputs):
    loads = parts(Load, "What hangs on the hook")
    own_mass = Quantity("m_0", "kg", "Mass of the hook", gt=0)


masses = Chapter("Masses")
masses.load = total("sum", of="loads.mass"), "m_Σ", "kg", "Mass of all loads"
masses.mass = m.load + m.own_mass, "m", "kg", "Mass with the hook"

MECHANISM = Mechanism(
    kind="hoist",
    version="1.0",
    title="Hoist",
    summary="Mass on a hoist.",
    inputs=Hoist,
    chapters=(masses,),
    example=ExampleBlock(
        "hoist",
        {
            "loads": [ForEach("cylinder_sizing", {"mass": "${<cylinder_sizing>.mass}"}), {"mass": "5 kg"}],
            "own_mass": Wired("0.1 * ${<cylinder_sizing>.mass}", otherwise="3 kg"),
        },
    ),
)

PRESS = """
mechanisms:
  hoist: {kind: hoist, loads: [{mass: 5 kg}, {mass: 20 kg}], own_mass: 3 kg}
"""
GIVES = {"hoist.mass": "28 kg"}
