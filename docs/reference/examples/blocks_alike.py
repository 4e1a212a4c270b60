"""Two blocks of one class: each has its suffix for the symbols, and its words for the descriptions."""

from __future__ import annotations

from diecut_report.api import Block, Chapter, Inputs, Mechanism, Quantity, block, m


class Link(Block):
    length = Quantity("l", "mm", "Length of the {link}", gt=0)


class Toggle(Inputs):
    lower = block(Link, "Lower link", suffix="a", link="lower link")
    upper = block(Link, "Upper link", suffix="b", link="upper link")


links = Chapter("Links")
links.length = m.lower.length + m.upper.length, "L", "mm", "Length of both links in one line"
for link, suffix in (("lower", "a"), ("upper", "b")):
    links[f"{link}_share"] = m[link].length / m.length, f"k_{suffix}", "%", f"Share of the {link} link"

MECHANISM = Mechanism(
    kind="toggle",
    version="1.0",
    title="Toggle",
    summary="Links of a toggle.",
    inputs=Toggle,
    chapters=(links,),
)

PRESS = """
mechanisms:
  toggle: {kind: toggle, lower: {length: 300 mm}, upper: {length: 500 mm}}
"""
GIVES = {"toggle.length": "800 mm", "toggle.lower_share": "37.5 %"}
