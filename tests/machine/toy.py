"""A made-up mechanism that uses everything the plugin contract can say."""

from __future__ import annotations

import numpy as np

from diecut_report.api import (
    Block,
    Case,
    Chapter,
    Check,
    Constant,
    CurveInput,
    Inputs,
    Mechanism,
    Quantity,
    Text,
    block,
    formula,
    m,
    parts,
    prefixed,
)
from diecut_report.mechanism.steps import (
    Abscissa,
    Breakpoints,
    Choice,
    Crossings,
    FromCurve,
    Pick,
    Reduction,
    Require,
    Root,
    Total,
    Value,
    Words,
)

HEAVY = Constant(5000, "F_h", "N")
LIGHT = Constant(500, "M_l", "N*m")
LONG = Constant(0.5, "a_l", "m")


class Pair(Block):
    driver_teeth = Quantity("z_1", "1", "Teeth of the driver", ge=12, integer=True)
    driven_teeth = Quantity("z_2", "1", "Number of teeth of the driven gear", ge=12, integer=True)
    label = Text("Name of the pair", optional=True)


class Spring(Block):
    stiffness = Quantity("c", "N/mm", "Stiffness", gt=0)


class Toy(Inputs):
    force = Quantity("F", "kN", "Force", gt=0, default=2)
    arm = Quantity("a", "mm", "Arm", gt=0, lt=1000, default=100)
    step_angle = Quantity("φ_s", "deg", "Place of the step", ge=0, lt=360, default=120)
    gears = parts(Pair, "Gear pairs", optional=True)
    spring = block(Spring, "Spring, if there is one", optional=True)
    torque_curve = CurveInput("M", "N*m", "Torque over a turn", optional=True)
    target = Quantity("t", "1", "What the root is of", gt=0, default=2000)
    grade = Text("Grade of the toy", ("fine", "coarse"), default="fine")
    n_points = Quantity("N", "1", "Samples", ge=36, le=100_000, integer=True, default=90)


moment = formula(lambda force, arm: force * arm)
wave = formula(lambda place, moment, on: moment * (np.sin(place) + on))
is_on = formula(lambda place, step_angle: place >= step_angle)
one = formula(lambda: 1)
zero = formula(lambda: 0)
ratio = formula(lambda driver_teeth, driven_teeth: driven_teeth / driver_teeth)
cube = formula(lambda x, target: x**3 - target)
cubed = formula(lambda x: x * x * x)
same = formula(lambda quantity: quantity)
plus_one = formula(lambda target: 1 + target)
heavy = formula(lambda force: force > HEAVY)
sag = formula(lambda force, stiffness: force / stiffness)
doubled = formula(lambda moment: 2 * moment)
is_light = formula(lambda moment: moment < LIGHT)
shorter = formula(lambda arm: arm < LONG)


FAMILY = (
    Value(id="load", symbol="P", unit="kN", description="Load of the variant", formula=same.of(quantity=m.force)),
    Value(id="load_moment", symbol="M_P", unit="N*m", description="Its moment", formula=moment.of(force=m.load)),
)

MECHANISM = Mechanism(
    kind="toy",
    version="1",
    title="Toy",
    summary="Everything that can be said.",
    inputs=Toy,
    chapters=(
        Chapter(
            "Numbers",
            steps=(
                Value(id="moment", symbol="M_0", unit="N*m", description="Moment", formula=moment),
                Require(id="arm_limit", condition=shorter, key="arm", message="is {arm}, too long for {force}"),
                Value(id="twice", symbol="2M_0", unit="N*m", description="Doubled, where it is light", formula=doubled, exists=is_light),
                Choice(unit="1", id="verdict", symbol="v", description="In words",
                       cases=(Case("heavy", "F > 5 kN", heavy), Case("light", "F ≤ 5 kN"))),
                Pick(id="rated", symbol="M_r", unit="N*m", description="Rated moment", of="moment", rule="above", series=(100, 200, 400, 800),
                     beyond="last"),
                *prefixed("first_", FAMILY, shared=()),
                *prefixed("second_", FAMILY, shared=(), symbol_suffix="_2"),
            ),
        ),
        Chapter(
            "Gears",
            needs=("gears",),
            absent="no gears are given",
            steps=(
                Value(unit="1", id="pair_ratio", symbol="i", description="Ratio of the pair",
                      formula=ratio.of(driver_teeth=m.gears.driver_teeth, driven_teeth=m.gears.driven_teeth)),
                Total(unit="1", id="total_ratio", symbol="i_Σ", description="Total ratio", of="pair_ratio", operation="product"),
                Total(unit="1", id="total_teeth", symbol="z_Σ", description="Teeth of all drivers", of="gears.driver_teeth", operation="sum"),
            ),
        ),
        Chapter("Spring", needs=("spring",), absent="no spring is given",
                steps=(Value(id="sag", symbol="f", unit="mm", description="Sag", formula=sag.of(stiffness=m.spring.stiffness)),)),
        Chapter(
            "Curve",
            steps=(
                Abscissa(id="place", symbol="φ", unit="deg", description="Place", period=2 * np.pi),
                Breakpoints(id="step", abscissa="place", places=("step_angle",)),
                Choice(unit="1", id="on", symbol="s", description="Switched", per_piece=True, output=False,
                       cases=(Case(one, "after the step", is_on), Case(zero, "before the step"))),
                Value(id="torque", symbol="T", unit="N*m", description="Torque", formula=wave),
                Reduction(id="torque_max", symbol="M_max", unit="N*m", description="Maximum torque", of="torque", operation="max"),
                Reduction(id="torque_min", symbol="M_min", unit="N*m", description="Minimum torque", of="torque", operation="min"),
                Reduction(id="torque_range", symbol="ΔM", unit="N*m", description="Range", of="torque", operation="range"),
                Reduction(id="torque_mean", symbol="M_m", unit="N*m", description="Mean", of="torque", operation="mean"),
                Reduction(id="torque_rms", symbol="M_q", unit="N*m", description="Root mean square", of="torque", operation="rms"),
                Reduction(id="work", symbol="W", unit="J", description="Work", of="torque", operation="integral"),
                Crossings(id="turns", symbol="φ_0", unit="deg", description="Changes of sign", of="torque"),
            ),
        ),
        Chapter("Taken over", needs=("torque_curve",),
                steps=(FromCurve(id="taken", symbol="M_t", unit="N*m", description="Torque taken over", given="torque_curve", abscissa="place"),
                       Reduction(id="taken_max", symbol="M_tmax", unit="N*m", description="Its greatest value", of="taken", operation="max"),
                       Reduction(id="taken_mean", symbol="M_tm", unit="N*m", description="Its mean", of="taken", operation="mean"))),
    ),
    checks=(Check("rated", "strength", "Rated", "moment", "rated", unit="N*m", demand_label="moment",
                  limit_label="rated", consequence="take a greater one."),
            Check("light", "strength", "Light", "twice", 900.0, unit="N*m", demand_label="twice", limit_label="most",
                  consequence="too much.", severity="warn", operator="<")),
)  # fmt: skip


READ = Words(id="samples_told", function="{:.0f} samples".format, takes=("n_points",))
ROOTED = Mechanism(
    kind="rooted",
    version="1",
    title="A root",
    summary="A number found.",
    inputs=Toy,
    chapters=(
        Chapter(
            "Root",
            steps=(
                Root(unit="1", id="x", symbol="x", description="Cube root", equation=cube, unknown="x", low=zero.of(), high=plus_one,
                     left=cubed, right=same.of(quantity=m.target)),
                READ,
            ),
        ),
    ),
)  # fmt: skip
