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
    block,
    chart_panel,
    formula,
    line,
    m,
    own_table,
    parts,
)
from diecut_report.mechanism.steps import (
    Abscissa,
    Accumulated,
    Clash,
    FromCurve,
    Lookup,
    Neighbour,
    Part,
    Pick,
    Reduction,
    Require,
    Running,
    Total,
    Value,
    Words,
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


gap = formula(lambda x, x_next: abs(x_next - x))
is_apart = formula(lambda gap: gap > 0)
limp = formula(lambda turn, swing: swing * np.sin(turn))
stiff = formula(lambda turn, swing: swing * np.sin(turn) ** 2)
weight = formula(lambda mass, gravity: mass * gravity)


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


POSTS = Chapter(
    "Posts",
    needs=("fence",),
    absent="no fence is given",
    steps=(
        Neighbour(id="x_next", symbol="x_n", unit="m", description="Place of the next post", of="fence.posts.x"),
        Value(id="gap", symbol="d", unit="m", description="Gap", formula=gap.of(x=m.fence.posts.x)),
        Require(id="apart", condition=is_apart, key="fence.posts.{index}.x",
                message="post {part} stands at {fence.posts.x}, where post {next} stands"),
        Clash(id="crowd", function=crowded, takes=("fence.posts.x",), key="fence.posts.{index}",
              message="posts {part} and {other} stand at one place"),
        Lookup(unit="1", id="friction", symbol="μ", description="Friction of the post", by="fence.posts.grip", table={"smooth": 0.1, "rough": 0.4}),
        Running(id="way", symbol="s", unit="m", description="Way to the next post", of="gap", operation="sum", numbered="way_{}", first=2),
        Total(id="length", symbol="L", unit="m", description="Length", of="gap", operation="sum"),
        Total(id="narrowest", symbol="d_min", unit="m", description="Narrowest gap", of="gap", operation="min"),
        Total(unit="1", id="friction_max", symbol="μ_max", description="Greatest friction", of="friction", operation="max"),
        Total(id="first_gaps", symbol="d_+", unit="m", description="Greatest gap of posts right of the origin", of="gap",
              operation="max", among="fence.posts.x"),
        Part(id="last_gap", symbol="d_l", unit="m", description="Last gap", of="gap", index=-1),
        Pick(id="stock", symbol="L_s", unit="mm", description="Length in stock", of="length", rule="above", series=SERIES, by="material"),
        Words(id="told", description="Length in words", function=in_words, takes=("length",)),
    ),
)  # fmt: skip

ROPE = Chapter(
    "Rope",
    steps=(
        Lookup(id="weight", symbol="m_1", unit="g", description="Weight of the stuff", by="material", table=WEIGHTS),
        Value(id="force", symbol="F_1", unit="N", description="Force", needs=("pull",), formula=m.pull),
        Value(id="force", symbol="F_1", unit="N", description="Force", lacks=("pull",), formula=weight),
        Value(unit="1", id="chained", symbol="c", description="Only of chains", needs=("material=chain",), formula=0),
        Value(id="visited", symbol="n_1", unit="1/h", description="Visits", needs=("visits",), formula=m.visits),
        Abscissa(id="turn", symbol="φ", unit="deg", description="Turn", period=2 * np.pi),
        Value(id="height", symbol="h", unit="m", description="Height", formula=ByText("material", FORMS)),
        Accumulated(id="area", symbol="A", unit="m", description="Area under the height", of="height"),
        Reduction(id="height_max", symbol="h_max", unit="m", description="Greatest height", of="height", operation="max"),
        Reduction(id="area_range", symbol="ΔA", unit="m", description="Range of the area", of="area", operation="range"),
        FromCurve(id="wave_here", symbol="w", unit="m", description="Wave", given="wave", abscissa="turn", needs=("wave",)),
        Accumulated(id="wave_area", symbol="A_w", unit="m", description="Area of the wave", of="wave_here", needs=("wave",)),
    ),
)  # fmt: skip


class Two(Inputs):
    one = Quantity("L_1", "m", "Length of the loop", gt=0, optional=True)
    other = Quantity("h_1", "m", "Height of the loop", gt=0)
    shape = CurveInput("h", "m", "Its height", optional=True)


COMPARED = Mechanism(
    kind="loop_comparison", version="1", title="Comparison of loops", summary="Which is longer.", inputs=Two,
    chapters=(Chapter("Both", steps=(
        Value(id="ratio", symbol="r", description="Ratio", needs=("one",), formula=gap.of(x=m.one, x_next=m.other), unit="m"),
        Value(id="height", symbol="h", unit="m", description="Height", formula=m.other))),),
)  # fmt: skip

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
