"""A made-up loop of posts with a rope around it: rows in a block, texts that choose, a running integral, a comparison."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import (
    Block,
    ByText,
    Chapter,
    Chart,
    Comparison,
    CurveInput,
    FromPress,
    Inputs,
    Mechanism,
    OneOf,
    Profile,
    Quantity,
    StandardSeries,
    Text,
    View,
    abscissa,
    accumulated,
    block,
    chart_panel,
    formula,
    from_curve,
    line,
    lookup,
    m,
    neighbour,
    own_table,
    part,
    parts,
    pick,
    reduction,
    running,
    total,
    value,
)

SERIES = {
    "rope": StandardSeries("rope", "Rope lengths", "m", (5, 10, 20), ("Table one", "Table two")),
    "chain": StandardSeries("chain", "Chain lengths", "m", (8, 16), ("Table three", "Table four")),
}
WEIGHTS = own_table(title="Weights", unit="kg", rows={"rope": 0.5, "chain": 2.0}, sources=("Table one", "Table two"))


class Post(Block):
    x = Quantity("x", "m", "Place of the post")
    grip = Text("Surface of the post", ("smooth", "rough"), default="smooth")


class Fence(Block):
    posts = parts(Post, "Posts in order")


class Loop(Inputs):
    one_of = (OneOf(("pull",), ("mass", "gravity")),)

    fence = block(Fence, "The fence", optional=True)
    material = Text("What is laid around", ("rope", "chain"), default="rope")
    pull = Quantity("F", "N", "Pull", gt=0, optional=True)
    mass = Quantity("m", "kg", "Mass that pulls", gt=0, optional=True)
    gravity = Quantity("g", "m/s**2", "Gravity", gt=0, optional=True)
    visits = Quantity("n", "1/h", "Visits an hour", press=FromPress("press.productivity", optional=True), optional=True)
    swing = Quantity("a", "m", "Swing of the rope", gt=0, default=1)
    wave = CurveInput("w", "m", "Wave over a turn", optional=True)
    n_points = Quantity("N", "1", "Samples", ge=36, le=100_000, integer=True, default=90)


limp = formula(lambda turn, swing: swing * np.sin(turn))
stiff = formula(lambda turn, swing: swing * np.sin(turn) ** 2)


FORMS = {"rope": limp, "chain": stiff}


def crowded(x: Any) -> Any:
    """For each post the index of another one at the same place, -1 for none."""
    same = np.isclose(x[:, :, None], x[:, None, :]) & ~np.eye(x.shape[1], dtype=bool)
    return np.where(same.any(axis=2), same.argmax(axis=2), -1)


def in_words(length: float) -> str:
    return "long" if length > 10 else "short"


def sweep(view: View) -> list[dict[str, Any]]:
    swing = np.linspace(0.5, 2, 4)
    lines = [line(swing, view.varied({"swing": swing, "material": m}, "height_max")["height_max"], m) for m in FORMS]
    turn, curves = view.varied_curves({"material": "chain"}, "height", points=5)
    return [chart_panel("Height", "m", "Swing", "a", "m", lines=lines),
            chart_panel("Height", "m", "Turn", "φ", "deg", lines=[line(turn, curves["height"], "chain")])]  # fmt: skip


# fmt: off

POSTS = Chapter("Posts", needs=("fence",), absent="no fence is given")
POSTS.x_next = neighbour(of="fence.posts.x"), "x_n", "m", "Place of the next post"
POSTS.gap = abs(m.x_next - m.fence.posts.x), "d", "m", "Gap"
POSTS.require("apart", m.gap > 0, key="fence.posts.{index}.x", message="post {part} stands at {fence.posts.x}, where post {next} stands")
POSTS.clash("crowd", function=crowded, takes=("fence.posts.x",), key="fence.posts.{index}", message="posts {part} and {other} stand at one place")
POSTS.friction = lookup({"smooth": 0.1, "rough": 0.4}, by="fence.posts.grip"), "μ", "1", "Friction of the post"
POSTS.way = running("sum", of="gap", numbered="way_{}", first=2), "s", "m", "Way to the next post"
POSTS.length = total("sum", of="gap"), "L", "m", "Length"
POSTS.narrowest = total("min", of="gap"), "d_min", "m", "Narrowest gap"
POSTS.friction_max = total("max", of="friction"), "μ_max", "1", "Greatest friction"
POSTS.first_gaps = total("max", of="gap", among="fence.posts.x"), "d_+", "m", "Greatest gap of posts right of the origin"
POSTS.last_gap = part(of="gap", index=-1), "d_l", "m", "Last gap"
POSTS.stock = pick(of="length", rule="above", series=SERIES, by="material"), "L_s", "mm", "Length in stock"
POSTS.words("told", function=in_words, takes=("length",))

ROPE = Chapter("Rope")
ROPE.weight = lookup(WEIGHTS, by="material"), "m_1", "g", "Weight of the stuff"
ROPE.force = value(m.pull, needs=("pull",)), "F_1", "N", "Force"
ROPE.force = value(m.mass * m.gravity, lacks=("pull",)), "F_1", "N", "Force"
ROPE.chained = value(0, needs=("material=chain",)), "c", "1", "Only of chains"
ROPE.visited = value(m.visits, needs=("visits",)), "n_1", "1/h", "Visits"
ROPE.turn = abscissa(2 * np.pi), "φ", "deg", "Turn"
ROPE.height = ByText("material", FORMS), "h", "m", "Height"
ROPE.area = accumulated(of="height"), "A", "m", "Area under the height"
ROPE.height_max = reduction("max", of="height"), "h_max", "m", "Greatest height"
ROPE.area_range = reduction("range", of="area"), "ΔA", "m", "Range of the area"
ROPE.wave_here = from_curve("wave", abscissa="turn", needs=("wave",)), "w", "m", "Wave"
ROPE.wave_area = accumulated(of="wave_here", needs=("wave",)), "A_w", "m", "Area of the wave"

# fmt: on


class Two(Inputs):
    one = Quantity("L_1", "m", "Length of the loop", gt=0, optional=True)
    other = Quantity("h_1", "m", "Height of the loop", gt=0)
    shape = CurveInput("h", "m", "Its height", optional=True)


BOTH = Chapter("Both")
BOTH.ratio = value(abs(m.other - m.one), needs=("one",)), "r", "m", "Ratio"
BOTH.height = m.other, "h", "m", "Height"

COMPARED = Mechanism(
    kind="loop_comparison",
    version="1",
    title="Comparison of loops",
    summary="Which is longer.",
    inputs=Two,
    chapters=(BOTH,),
)

MECHANISM = Mechanism(
    kind="loop",
    version="1",
    title="Loop",
    summary="A rope around posts.",
    inputs=Loop,
    chapters=(POSTS, ROPE),
    figures=(Chart("sweep", "Sweep", "Height over the swing.", build=sweep),),
    exports=(Profile(id="rope", title="Rope", columns=("height", "area")),),
    comparisons=(
        Comparison(
            kinds=("loop",),
            mechanism=COMPARED,
            takes={"one": ("loop", "length"), "other": ("loop", "height_max"), "shape": ("loop", "height")},
        ),
    ),
)
