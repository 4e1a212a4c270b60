"""A bucket elevator that lifts the waste of a die cutter: a mechanism as somebody elsewhere writes it from the documentation."""

from __future__ import annotations

from typing import Any, ClassVar, Literal

import numpy as np

from diecut_report.api import (
    GRAVITY,
    POINTS,
    Abscissa,
    Accumulated,
    Annotated,
    BarGroup,
    Bars,
    Block,
    Breakpoints,
    Case,
    Chapter,
    Check,
    Choice,
    Computed,
    Crossings,
    Derivative,
    Drawing,
    Erratum,
    Inputs,
    Level,
    Lookup,
    Mark,
    Mechanism,
    OneOf,
    Panel,
    Part,
    Pick,
    Plot,
    Profile,
    Quantity,
    Reduction,
    Require,
    Root,
    Running,
    Series,
    Shape,
    Source,
    Text,
    Total,
    Value,
    View,
    Words,
    bind,
    circle,
    formula,
    point,
    polyline,
    standard_series,
    told,
)
from diecut_report.mechanics import common

# --- inputs


class Pulley(Block):
    diameter: Annotated[float, Quantity("D_i", "mm", "Diameter of the pulley", gt=0)]
    journal_diameter: Annotated[float, Quantity("d_i", "mm", "Diameter of its journals", gt=0)]
    journal_friction: Annotated[float, Quantity("f_i", "1", "Friction in its bearings", ge=0, lt=1)] = 0.02
    wrap: Annotated[float, Quantity("α_i", "deg", "Angle of wrap of the belt", gt=0, le=180)] = 180


class Backstop(Block):
    radius: Annotated[float, Quantity("r_b", "mm", "Radius at which the pawl holds", gt=0)]
    allowable_force: Annotated[float, Quantity("[F_p]", "kN", "Force that the pawl may carry", gt=0)]


class Elevator(Inputs):
    one_of: ClassVar[tuple[OneOf, ...]] = (OneOf(("capacity",), ("volume_rate",)),)

    capacity: Annotated[float | None, Quantity("Q", "t/h", "Waste that is to be lifted", gt=0)] = None
    volume_rate: Annotated[float | None, Quantity("V_t", "m**3/h", "Volume of waste that is to be lifted", gt=0)] = None
    material: Annotated[Literal["board", "paper", "foil"], Text("What the waste is made of")] = "board"
    bulk_density: Annotated[float, Quantity("γ", "kg/m**3", "Density of the loose waste", gt=0)] = 120
    height: Annotated[float, Quantity("H", "m", "Height of lift", gt=0, le=60)]
    head_diameter: Annotated[float, Quantity("D", "mm", "Diameter of the head drum", gt=0)] = 500
    head_speed: Annotated[float, Quantity("ω", "rpm", "Speed of the head drum", gt=0)]
    head_wrap: Annotated[float, Quantity("α", "deg", "Angle of wrap at the head drum", gt=0, le=270)] = 180
    lagging: Annotated[Literal["bare", "rubber"], Text("Lagging of the head drum")] = "rubber"
    belt_width: Annotated[float, Quantity("B", "mm", "Width of the belt", gt=0)] = 300
    belt_mass: Annotated[float, Quantity("q_b", "kg/m", "Mass of the belt", gt=0)] = 6
    bucket_mass: Annotated[float, Quantity("m_e", "kg", "Mass of an empty bucket", gt=0)] = 5
    bucket_volume: Annotated[float, Quantity("V", "L", "Volume of a bucket", gt=0)] = 14
    bucket_pitch: Annotated[float, Quantity("p", "mm", "Distance of the buckets", gt=0)] = 400
    filling: Annotated[float, Quantity("ψ", "%", "Share of a bucket that may be filled", gt=0, le=100)] = 75
    scoop_start: Annotated[
        float, Quantity("φ_1", "deg", "Turn of the drum at which a bucket enters the waste", ge=0, lt=360)
    ] = 100
    scoop_end: Annotated[
        float, Quantity("φ_2", "deg", "Turn of the drum at which it leaves the waste", gt=0, le=360)
    ] = 160
    pretension: Annotated[float | None, Quantity("T_0", "N", "Pull of the take-up on each strand", ge=0)] = None
    chute_drop: Annotated[float, Quantity("h", "mm", "Chute's edge below the top of the head drum", gt=0)] = 600
    efficiency: Annotated[float, Quantity("η", "%", "Efficiency of gear and belt drive", gt=0, le=100)] = 90
    small_pulley: Annotated[float, Quantity("d_1", "mm", "Smaller pulley of the belt drive", gt=0)] = 140
    large_pulley: Annotated[float, Quantity("d_2", "mm", "Greater pulley of the belt drive", gt=0)] = 280
    wanted_centre: Annotated[float, Quantity("C_w", "mm", "Wanted distance of the pulleys' shafts", gt=0)] = 500
    allowable_pull: Annotated[float, Quantity("[T]", "kN", "Pull that the belt may carry", gt=0)] = 10
    allowable_pulley_load: Annotated[
        float, Quantity("[F_i]", "kN", "Load that each pulley's shaft may carry", gt=0)
    ] = 6
    allowable_torque: Annotated[float | None, Quantity("[M]", "N*m", "Torque that the head shaft may carry", gt=0)] = (
        None
    )
    pulleys: Annotated[list[Pulley], Text("Pulleys that turn the belt, without the head drum")]
    backstop: Annotated[Backstop | None, Text("Backstop, which holds the belt when the drive stops")] = None
    n_points: Annotated[int, POINTS] = 360  # fmt: skip


# --- formulas


@formula
def mass_rate(volume_rate: Any, bulk_density: Any) -> Any:
    return volume_rate * bulk_density


@formula
def belt_speed(head_speed: Any, head_diameter: Any) -> Any:
    return head_speed * head_diameter / 2


@formula
def bucket_load(filling: Any, bucket_volume: Any, bulk_density: Any) -> Any:
    return filling * bucket_volume * bulk_density


@formula
def filling_needed(mass_rate: Any, bucket_pitch: Any, bulk_density: Any, bucket_volume: Any, belt_speed: Any) -> Any:
    return mass_rate * bucket_pitch / (bulk_density * bucket_volume * belt_speed)


@formula
def waste_line_mass(mass_rate: Any, belt_speed: Any) -> Any:
    return mass_rate / belt_speed


@formula
def strand_line_mass(belt_mass: Any, bucket_mass: Any, bucket_pitch: Any) -> Any:
    return belt_mass + bucket_mass / bucket_pitch


@formula
def froude_number(head_speed: Any, head_diameter: Any) -> Any:
    return head_speed**2 * head_diameter / (2 * GRAVITY)


@formula
def speed_limit(head_diameter: Any) -> Any:
    return np.sqrt(2 * GRAVITY / head_diameter)


@formula
def pole_distance(head_speed: Any) -> Any:
    return GRAVITY / head_speed**2


@formula
def normal_force(bucket_load: Any, angle: Any, head_speed: Any, head_diameter: Any) -> Any:
    centripetal = head_speed**2 * head_diameter / 2
    return bucket_load * (GRAVITY * np.cos(angle) - centripetal)


@formula
def hanging_weight(line_mass: Any, height: Any) -> Any:
    return line_mass * GRAVITY * height


@formula
def is_scooping(angle: Any, scoop_start: Any, scoop_end: Any) -> Any:
    return (angle > scoop_start) & (angle < scoop_end)


@formula
def scoop_pull(is_scooping: Any, scoop_force: Any, scoop_start: Any, scoop_end: Any) -> Any:
    return np.where(is_scooping > 0, scoop_force * 2 * np.pi / (scoop_end - scoop_start), 0 * scoop_force)


@formula
def shaft_torque(lift_force: Any, scoop_pull: Any, head_diameter: Any) -> Any:
    return (lift_force + scoop_pull) * head_diameter / 2


@formula
def rim_x(head_diameter: Any, angle: Any) -> Any:
    return head_diameter / 2 * np.sin(angle)


@formula
def rim_y(head_diameter: Any, angle: Any) -> Any:
    return head_diameter / 2 * np.cos(angle)


@formula
def pulley_load(strand_weight: Any, wrap: Any) -> Any:
    return 2 * strand_weight * np.sin(wrap / 2)


@formula
def journal_loss(pulley_load: Any, friction: Any, journal: Any, diameter: Any) -> Any:
    return pulley_load * friction * journal / diameter


@formula
def circumferential_pull(lift_force: Any, scoop_force: Any, journal_losses: Any) -> Any:
    return lift_force + scoop_force + journal_losses


@formula
def euler_ratio(head_friction: Any, head_wrap: Any) -> Any:
    return np.exp(head_friction * head_wrap)


@formula
def slack_needed(circumferential_pull: Any, euler_ratio: Any) -> Any:
    return circumferential_pull / (euler_ratio - 1)


@formula
def lagging_pressure(tight_pull: Any, slack_pull: Any, head_diameter: Any, belt_width: Any) -> Any:
    return (tight_pull + slack_pull) / (head_diameter * belt_width)


@formula
def power(circumferential_pull: Any, belt_speed: Any, efficiency: Any) -> Any:
    return circumferential_pull * belt_speed / efficiency


@formula
def length_wanted(wanted_centre: Any, small_pulley: Any, large_pulley: Any) -> Any:
    around = np.pi / 2 * (large_pulley + small_pulley)
    return 2 * wanted_centre + around + (large_pulley - small_pulley) ** 2 / (4 * wanted_centre)


@formula
def length_mismatch(centre: Any, small_pulley: Any, large_pulley: Any, belt_length: Any) -> Any:
    slope = np.arcsin((large_pulley - small_pulley) / (2 * centre))
    straight = 2 * centre * np.cos(slope)
    around = np.pi / 2 * (large_pulley + small_pulley) + (large_pulley - small_pulley) * slope
    return straight + around - belt_length


@formula
def least_centre(small_pulley: Any, large_pulley: Any) -> Any:
    return (large_pulley - small_pulley) / 2


@formula
def greatest_centre(belt_length: Any) -> Any:
    return belt_length / 2


@formula
def length_by_wraps(centre: Any, small_pulley: Any, large_pulley: Any) -> Any:
    half_wrap = np.arccos((large_pulley - small_pulley) / (2 * centre))
    straight = np.sqrt(4 * centre**2 - (large_pulley - small_pulley) ** 2)
    return straight + large_pulley * (np.pi - half_wrap) + small_pulley * half_wrap


@formula
def small_wrap(centre: Any, small_pulley: Any, large_pulley: Any) -> Any:
    return 2 * np.arccos((large_pulley - small_pulley) / (2 * centre))


@formula
def over_arm(force: Any, diameter: Any, arm: Any) -> Any:
    return force * diameter / (2 * arm)


@formula
def ratio_of_speeds(small_pulley: Any, large_pulley: Any) -> Any:
    return large_pulley / small_pulley


@formula
def bucket_count(height: Any, head_diameter: Any, bucket_pitch: Any) -> Any:
    return np.ceil((2 * height + np.pi * head_diameter) / bucket_pitch)


def falling_time(speed: Any, drop: Any) -> Any:
    """Seconds in which a body that leaves the drum's top level falls to the chute's edge."""
    return np.sqrt(2 * drop / GRAVITY) + 0 * speed


def against_overfilling(filling: float, needed: float) -> str:
    return f"buckets that are {told(needed / filling - 1, '%', 2)} greater carry it"


def head_drawing(view: View) -> list[Shape]:
    radius = view["head_diameter"] / 2
    rim = list(zip(view.curve("rim_x"), view.curve("rim_y"), strict=True))
    return [circle((0.0, 0.0), radius, "outline"), polyline(rim, "hidden"), point((0.0, radius), "mark", view.text("head_diameter"))]  # fmt: skip


# --- calculation

CONVEYING = Chapter(
    "Conveying",
    steps=(
        Value(id="mass_rate", symbol="Q_m", unit="t/h", description="Mass rate: as given", source="input", needs=("capacity",),
              formula=bind(common.same, quantity="capacity")),
        Value(id="mass_rate", symbol="Q_m", unit="t/h", description="Mass rate: of the volume", lacks=("capacity",), formula=mass_rate),
        Value(id="belt_speed", symbol="v", unit="m/s", description="Speed of the belt", source="S1 eq. 1", formula=belt_speed),
        Value(id="bucket_load", symbol="m_w", unit="kg", description="Waste in a bucket", source="S1 eq. 2", formula=bucket_load),
        Value(id="filling_needed", symbol="ψ_n", unit="%", description="Filling that the mass rate needs", formula=filling_needed),
        Value(id="waste_line_mass", symbol="q_w", unit="kg/m", description="Waste on the belt", formula=waste_line_mass),
        Value(id="strand_line_mass", symbol="q_s", unit="kg/m", description="Belt with empty buckets", formula=strand_line_mass),
        Value(id="bucket_count", symbol="z", unit="1", description="Buckets on the belt", whole=True, formula=bucket_count),
        Words(id="filling_advice", description="What to change where the buckets are too small", function=against_overfilling,
              takes=("filling", "filling_needed")),
    ),
)  # fmt: skip

DISCHARGE = Chapter(
    "Discharge",
    text="The waste stays in the bucket as long as the bucket presses on it.",
    steps=(
        Value(id="froude_number", symbol="Fr", unit="1", description="Froude number of the head drum", source="S2 eq. 4",
              formula=froude_number),
        Value(id="speed_limit", symbol="ω_lim", unit="rad/s", description="Speed from which waste is thrown at once", formula=speed_limit,
              output=False),
        Require(id="not_thrown", key="head_speed", condition=bind(common.is_below, smaller="froude_number", greater=1),
                message="is {head_speed}, but from {speed_limit:down} on the waste is thrown before it is at the top; turn slower"),
        Value(id="pole_distance", symbol="h_p", unit="mm", description="Distance of the pole of discharge", formula=pole_distance),
        Choice(id="discharge", symbol="K", description="Discharge is", source="S2 table 1",
               cases=(Case("by gravity", "the pole is above the buckets",
                           bind(common.is_below, smaller="head_diameter", greater="pole_distance")),
                      Case("mixed", "the pole is among the buckets"))),
        Abscissa(id="angle", symbol="φ", unit="deg", description="Turn of the head drum from the top", period=2 * np.pi),
        Value(id="normal_force", symbol="N_w", unit="N", description="Force of the bucket on the waste", formula=normal_force),
        Crossings(id="release", symbol="φ_r", unit="deg", description="Where the waste leaves the bucket", of="normal_force"),
        Derivative(id="force_slope", symbol="N_w′", unit="N/rad", description="Change of that force", of="normal_force"),
        Reduction(id="press_max", symbol="N_max", unit="N", description="Greatest force on the waste", of="normal_force", operation="max"),
        Value(id="rim_x", symbol="x", unit="mm", description="Rim of the drum, across", formula=rim_x),
        Value(id="rim_y", symbol="y", unit="mm", description="Rim of the drum, upwards", formula=rim_y),
        Computed(id="fall_time", symbol="t_f", unit="s", description="Fall of the waste to the chute", function=falling_time,
                 takes=("belt_speed", "chute_drop"), method="the root of the free fall's parabola"),
        Value(id="throw", symbol="s_f", unit="mm", description="How far the waste flies meanwhile",
              formula=bind(common.product, first="belt_speed", second="fall_time")),
    ),
)  # fmt: skip

PULL = Chapter(
    "Pull",
    steps=(
        Lookup(id="scoop_height", symbol="h_s", unit="m", description="Height that scooping counts for", by="material", source="S1 table 3",
               table={"board": 4, "paper": 3, "foil": 6}),
        Lookup(id="head_friction", symbol="f", unit="1", description="Friction of the belt on the drum", by="lagging", source="S1 table 5",
               table={"bare": 0.2, "rubber": 0.3}),
        Value(id="lift_force", symbol="F_l", unit="N", description="Weight of the waste that is lifted",
              formula=bind(hanging_weight, line_mass="waste_line_mass")),
        Value(id="scoop_force", symbol="F_s", unit="N", description="Mean force of scooping",
              formula=bind(hanging_weight, line_mass="waste_line_mass", height="scoop_height")),
        Value(id="strand_weight", symbol="G_s", unit="N", description="Weight of a strand",
              formula=bind(hanging_weight, line_mass="strand_line_mass")),
        Value(id="pulley_load", symbol="F_i", unit="N", description="Load of a pulley's shaft", source="S1 eq. 7",
              formula=bind(pulley_load, wrap="pulleys.wrap")),
        Value(id="journal_loss", symbol="U_i", unit="N", description="Pull that a pulley's journals take",
              formula=bind(journal_loss, friction="pulleys.journal_friction", journal="pulleys.journal_diameter",
                           diameter="pulleys.diameter")),
        Total(id="journal_losses", symbol="U_j", unit="N", description="Pull that all journals take", of="journal_loss", operation="sum"),
        Running(id="losses_so_far", symbol="ΣU_i", unit="N", description="Losses up to each pulley", of="journal_loss", operation="sum"),
        Part(id="foot_load", symbol="F_f", unit="N", description="Load of the first pulley's shaft", of="pulley_load", index=0),
        Value(id="circumferential_pull", symbol="U", unit="N", description="Pull at the head drum", formula=circumferential_pull),
        Value(id="euler_ratio", symbol="k_e", unit="1", description="Ratio of pulls that friction holds", formula=euler_ratio),
        Value(id="slack_needed", symbol="T_n", unit="N", description="Pull of the slack strand that is needed", formula=slack_needed),
        Value(id="slack_pull", symbol="T_2", unit="N", description="Pull of the slack strand: its weight", lacks=("pretension",),
              formula=bind(common.same, quantity="strand_weight")),
        Value(id="slack_pull", symbol="T_2", unit="N", description="Pull of the slack strand: weight and take-up", needs=("pretension",),
              formula=bind(common.sum_of, first="strand_weight", second="pretension")),
        Value(id="tight_pull", symbol="T_1", unit="N", description="Pull of the tight strand",
              formula=bind(common.sum_of, first="slack_pull", second="circumferential_pull")),
        Value(id="lagging_pressure", symbol="p_L", unit="MPa", description="Pressure on the rubber", needs=("lagging=rubber",),
              formula=lagging_pressure),
    ),
)  # fmt: skip

SHAFT = Chapter(
    "Head shaft",
    steps=(
        Breakpoints(id="scooping", abscissa="angle", places=("scoop_start", "scoop_end")),
        Value(id="is_scooping", symbol="S", unit="1", description="Whether a bucket scoops", per_piece=True, output=False,
              formula=is_scooping),
        Value(id="scoop_pull", symbol="U_s", unit="N", description="Force of scooping", formula=scoop_pull),
        Value(id="shaft_torque", symbol="M", unit="N*m", description="Torque of the head shaft", formula=shaft_torque),
        Reduction(id="torque_max", symbol="M_max", unit="N*m", description="Greatest torque", of="shaft_torque", operation="max"),
        Reduction(id="torque_mean", symbol="M_m", unit="N*m", description="Mean torque", of="shaft_torque", operation="mean"),
        Accumulated(id="work", symbol="W", unit="J", description="Work since the top", of="shaft_torque"),
    ),
)  # fmt: skip

DRIVE = Chapter(
    "Drive",
    steps=(
        Value(id="power", symbol="P", unit="kW", description="Power at the motor", source="S1 eq. 9", formula=power),
        Pick(id="motor_power", symbol="P_m", unit="kW", description="Power of the motor", of="power", rule="above",
             series=standard_series("iec_60072_ratings")),
        Value(id="length_wanted", symbol="L_w", unit="mm", description="Length for the wanted distance", formula=length_wanted),
        Pick(id="belt_length", symbol="L", unit="mm", description="Length of the belt", of="length_wanted", rule="nearest",
             series=(1400, 1600, 1800, 2000)),
        Root(id="centre", symbol="C", unit="mm", description="Distance of the shafts", equation=length_mismatch, unknown="centre",
             low=least_centre, high=greatest_centre, left=bind(common.same, quantity="belt_length"), right=length_by_wraps),
        Value(id="small_wrap", symbol="α_1", unit="deg", description="Wrap of the smaller pulley", formula=small_wrap),
        Value(id="ratio_of_speeds", symbol="i", unit="1", description="Ratio of the belt drive", formula=ratio_of_speeds),
    ),
)  # fmt: skip

HOLDING = Chapter(
    "Backstop",
    needs=("backstop",),
    absent="no backstop is given",
    steps=(
        Value(id="pawl_force", symbol="F_p", unit="N", description="Force of the pawl",
              formula=bind(over_arm, force="lift_force", diameter="head_diameter", arm="backstop.radius")),
    ),
)  # fmt: skip

CHECKS = (
    Check(id="filling", title="Filling of the buckets", demand="filling_needed", limit="filling", unit="%", demand_label="needed",
          limit_label="allowed", consequence="the buckets run over; {filling_advice}, or raise head_speed from {head_speed}."),
    Check(id="slip", title="Slip of the belt", demand="slack_needed", limit="slack_pull", unit="N", demand_label="slack strand needs",
          limit_label="it has", consequence="the belt slips: raise pretension."),
    Check(id="pull", title="Pull of the belt", demand="tight_pull", limit="allowable_pull", unit="kN", demand_label="pull",
          limit_label="allowed", consequence="a stronger belt is needed.", source="S1"),
    Check(id="pulley_load", title="Load of the pulleys", demand="pulley_load", limit="allowable_pulley_load", unit="kN",
          demand_label="load", limit_label="allowed", consequence="stronger shafts are needed."),
    Check(id="torque", title="Torque of the head shaft", demand="shaft_torque", limit="allowable_torque", unit="N*m",
          demand_label="torque", limit_label="allowed", consequence="a stronger shaft is needed.", needs=("allowable_torque",)),
    Check(id="pawl", title="Force of the pawl", demand="pawl_force", limit="backstop.allowable_force", unit="kN", demand_label="force",
          limit_label="allowed", consequence="place the pawl farther out.", needs=("backstop",)),
    Check(id="wrap", title="Wrap of the smaller pulley", demand=120, limit="small_wrap", unit="deg", demand_label="at least",
          limit_label="has", consequence="move the shafts apart.", severity="warn"),
)  # fmt: skip

FIGURES = (
    Plot(id="turn", title="One turn of the head drum", caption="Force on the waste and torque over a turn.", abscissa="angle",
         panels=(Panel(title="Force on the waste", unit="N", series=(Series(curve="normal_force", label="N_w"),),
                       marks=(Mark(x="press_max_at", y="press_max", label="greatest"),)),
                 Panel(title="Torque", unit="N*m", series=(Series(curve="shaft_torque", label="M"),),
                       levels=(Level(value="torque_mean", label="mean"),)))),
    Drawing(id="head", title="Head drum", caption="The head drum, to scale.", build=head_drawing),
    Bars(id="pulls", title="Pulls", caption="What the pull consists of.",
         groups=(BarGroup(label="Pull", unit="N", bars=(("waste", "lift_force"), ("scooping", "scoop_force"), ("all", "circumferential_pull"))),)),
)  # fmt: skip

MECHANISM = Mechanism(
    kind="bucket_elevator",
    version="1.0",
    title="Bucket elevator",
    summary="Pull, discharge and drive of a bucket elevator.",
    inputs=Elevator,
    chapters=(CONVEYING, DISCHARGE, PULL, SHAFT, DRIVE, HOLDING),
    key_results=("belt_speed", "power", "motor_power"),
    checks=CHECKS,
    figures=FIGURES,
    assumptions=("Buckets are small beside the drum.",),
    sources=(Source("S1", "Rules for bucket elevators"), Source("S2", "Discharge of bucket elevators")),
    errata=(Erratum("S2", "Table 1 has its columns exchanged.", touches=("discharge", "pole_distance")),),
    exports=(Profile(id="rim", title="Rim of the head drum", columns=("rim_x", "rim_y")),),
)
