"""A value chosen by conditions: the branch taken is printed with its condition; a text may be chosen too."""

from __future__ import annotations

from diecut_report.api import Case, Chapter, Inputs, Mechanism, Quantity, case, choice, m


class Column(Inputs):
    slenderness = Quantity("λ", "1", "Slenderness", gt=0)


buckling = Chapter("Buckling")
BRANCHES: tuple[Case, ...] = (
    case(1 + m.slenderness / 200, "of a short column", m.slenderness < 60),
    case((m.slenderness / 50) ** 2, "of a slender column"),
)
buckling.factor = choice(*BRANCHES), "ω", "1", "Factor of buckling"
KINDS = case("short", "below 60", m.slenderness < 60), case("slender", "60 and above")
buckling.kind = choice(*KINDS), "K", "1", "Kind of column"

MECHANISM = Mechanism(
    kind="column", version="1.0", title="Column", summary="Buckling of a column.", inputs=Column, chapters=(buckling,)
)

PRESS = """
mechanisms:
  one: {kind: column, slenderness: 40}
  other: {kind: column, slenderness: 100}
"""
GIVES = {"one.factor": "1.2", "other.factor": "4", "other.kind": "slender"}
