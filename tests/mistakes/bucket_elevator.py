"""A bucket elevator that lifts the waste of a die cutter: a mechanism as somebody elsewhere writes it from the documentation."""

from __future__ import annotations

from typing import Any, ClassVar, Literal

import numpy as np

from diecut_report.api import (
    GRAVITY,
    POINTS,
    Annotated,
    BarGroup,
    Bars,
    Block,
    Chapter,
    Check,
    Drawing,
    Erratum,
    Inputs,
    Level,
    Mark,
    Mechanism,
    OneOf,
    Panel,
    Plot,
    Profile,
    Quantity,
    Series,
    Shape,
    Source,
    Text,
    View,
    as_angle,
    as_number,
    bind,
    case,
    circle,
    formula,
    point,
    polyline,
    standard_series,
    told,
)
from diecut_report.mechanics import common

# fmt: off

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
    scoop_start: Annotated[float, Quantity("φ_1", "deg", "Turn of the drum at which a bucket enters the waste", ge=0, lt=360)] = 100
    scoop_end: Annotated[float, Quantity("φ_2", "deg", "Turn of the drum at which it leaves the waste", gt=0, le=360)] = 160
    pretension: Annotated[float | None, Quantity("T_0", "N", "Pull of the take-up on each strand", ge=0)] = None
    chute_drop: Annotated[float, Quantity("h", "mm", "Chute's edge below the top of the head drum", gt=0)] = 600
    efficiency: Annotated[float, Quantity("η", "%", "Efficiency of gear and belt drive", gt=0, le=100)] = 90
    small_pulley: Annotated[float, Quantity("d_1", "mm", "Smaller pulley of the belt drive", gt=0)] = 140
    large_pulley: Annotated[float, Quantity("d_2", "mm", "Greater pulley of the belt drive", gt=0)] = 280
    wanted_centre: Annotated[float, Quantity("C_w", "mm", "Wanted distance of the pulleys' shafts", gt=0)] = 500
    allowable_pull: Annotated[float, Quantity("[T]", "kN", "Pull that the belt may carry", gt=0)] = 10
    allowable_pulley_load: Annotated[float, Quantity("[F_i]", "kN", "Load that each pulley's shaft may carry", gt=0)] = 6
    allowable_torque: Annotated[float | None, Quantity("[M]", "N*m", "Torque that the head shaft may carry", gt=0)] = None
    pulleys: Annotated[list[Pulley], Text("Pulleys that turn the belt, without the head drum")]
    backstop: Annotated[Backstop | None, Text("Backstop, which holds the belt when the drive stops")] = None
    n_points: Annotated[int, POINTS] = 360


# --- calculation

conveying = Chapter("Conveying")
conveying.value("mass_rate", "Q_m", "t/h", "Mass rate: as given", bind(common.same, quantity="capacity"), needs=("capacity",), source="input")
conveying.value("mass_rate", "Q_m", "t/h", "Mass rate: of the volume", lambda volume_rate, bulk_density: volume_rate * bulk_density,
                lacks=("capacity",))
conveying.value("belt_speed", "v", "m/s", "Speed of the belt", lambda head_speed, head_diameter: head_speed * head_diameter / 2,
                source="S1 eq. 1")
conveying.value("bucket_load", "m_w", "kg", "Waste in a bucket",
                lambda filling, bucket_volume, bulk_density: filling * bucket_volume * bulk_density, source="S1 eq. 2")
conveying.value("filling_needed", "ψ_n", "%", "Filling that the mass rate needs",
                lambda mass_rate, bucket_pitch, bulk_density, bucket_volume, belt_speed:
                    mass_rate * bucket_pitch / (bulk_density * bucket_volume * belt_speed))
conveying.value("waste_line_mass", "q_w", "kg/m", "Waste on the belt", lambda mass_rate, belt_speed: mass_rate / belt_speed)
conveying.value("strand_line_mass", "q_s", "kg/m", "Belt with empty buckets",
                lambda belt_mass, bucket_mass, bucket_pitch: belt_mass + bucket_mass / bucket_pitch)
conveying.value("bucket_count", "z", "1", "Buckets on the belt",
                lambda height, head_diameter, bucket_pitch: np.ceil((2 * height + np.pi * head_diameter) / bucket_pitch), whole=True)


def against_overfilling(filling: float, needed: float) -> str:
    return f"buckets that are {told(needed / filling - 1, '%', 2)} greater carry it"


conveying.words("filling_advice", against_overfilling, takes=("filling", "filling_needed"))

discharge = Chapter("Discharge", text="The waste stays in the bucket as long as the bucket presses on it.")
discharge.value("froude_number", "Fr", "1", "Froude number of the head drum",
                lambda head_speed, head_diameter: as_number(head_speed) ** 2 * head_diameter / (2 * GRAVITY), source="S2 eq. 4")
discharge.value("speed_limit", "ω_lim", "rad/s", "Speed from which waste is thrown at once",
                lambda head_diameter: as_angle(np.sqrt(2 * GRAVITY / head_diameter)), output=False)
discharge.require("not_thrown", lambda froude_number: froude_number < 1, key="head_speed",
                  message="is {head_speed}, but from {speed_limit:down} on the waste is thrown before it is at the top; turn slower")
discharge.value("pole_distance", "h_p", "mm", "Distance of the pole of discharge", lambda head_speed: GRAVITY / as_number(head_speed) ** 2)
discharge.choice("discharge", "K", "1", "Discharge is",
                 case("by gravity", "the pole is above the buckets", lambda head_diameter, pole_distance: head_diameter < pole_distance),
                 case("mixed", "the pole is among the buckets"), source="S2 table 1")
discharge.abscissa("angle", "φ", "deg", "Turn of the head drum from the top", period=2 * np.pi)


@formula
def normal_force(bucket_load: Any, angle: Any, head_speed: Any, head_diameter: Any) -> Any:
    centripetal = as_number(head_speed) ** 2 * head_diameter / 2
    return bucket_load * (GRAVITY * np.cos(angle) - centripetal)


def falling_time(speed: Any, drop: Any) -> Any:
    """Seconds in which a body that leaves the drum's top level falls to the chute's edge."""
    return np.sqrt(2 * drop / GRAVITY) + 0 * speed


discharge.value("normal_force", "N_w", "N", "Force of the bucket on the waste", normal_force)
discharge.crossings("release", "φ_r", "deg", "Where the waste leaves the bucket", of="normal_force")
discharge.derivative("force_slope", "N_w′", "N/rad", "Change of that force", of="normal_force")
discharge.reduction("press_max", "N_max", "N", "Greatest force on the waste", "max", of="normal_force")
discharge.value("rim_x", "x", "mm", "Rim of the drum, across", lambda head_diameter, angle: head_diameter / 2 * np.sin(angle))
discharge.value("rim_y", "y", "mm", "Rim of the drum, upwards", lambda head_diameter, angle: head_diameter / 2 * np.cos(angle))
discharge.computed("fall_time", "t_f", "s", "Fall of the waste to the chute", falling_time, takes=("belt_speed", "chute_drop"),
                   method="the root of the free fall's parabola")
discharge.value("throw", "s_f", "mm", "How far the waste flies meanwhile", lambda belt_speed, fall_time: belt_speed * fall_time)


@formula
def hanging_weight(line_mass: Any, height: Any) -> Any:
    return line_mass * GRAVITY * height


pull = Chapter("Pull")
pull.lookup("scoop_height", "h_s", "m", "Height that scooping counts for", {"board": 4, "paper": 3, "foil": 6}, by="material",
            source="S1 table 3")
pull.lookup("head_friction", "f", "1", "Friction of the belt on the drum", {"bare": 0.2, "rubber": 0.3}, by="lagging", source="S1 table 5")
pull.value("lift_force", "F_l", "N", "Weight of the waste that is lifted", bind(hanging_weight, line_mass="waste_line_mass"))
pull.value("scoop_force", "F_s", "N", "Mean force of scooping",
           bind(hanging_weight, line_mass="waste_line_mass", height="scoop_height"))
pull.value("strand_weight", "G_s", "N", "Weight of a strand", bind(hanging_weight, line_mass="strand_line_mass"))
pull.value("pulley_load", "F_i", "N", "Load of a pulley's shaft",
           bind(lambda strand_weight, wrap: 2 * strand_weight * np.sin(wrap / 2), wrap="pulleys.wrap"), source="S1 eq. 7")
pull.value("journal_loss", "U_i", "N", "Pull that a pulley's journals take",
           bind(lambda pulley_load, friction, journal, diameter: pulley_load * friction * journal / diameter,
                friction="pulleys.journal_friction", journal="pulleys.journal_diameter", diameter="pulleys.diameter"))
pull.total("journal_losses", "U_j", "N", "Pull that all journals take", "sum", of="journal_loss")
pull.running("losses_so_far", "ΣU_i", "N", "Losses up to each pulley", "sum", of="journal_loss")
pull.part("foot_load", "F_f", "N", "Load of the first pulley's shaft", of="pulley_load", index=0)
pull.value("circumferential_pull", "U", "N", "Pull at the head drum",
           lambda lift_force, scoop_force, journal_losses: lift_force + scoop_force + journal_losses)
pull.value("euler_ratio", "k_e", "1", "Ratio of pulls that friction holds",
           lambda head_friction, head_wrap: np.exp(head_friction * as_number(head_wrap)))
pull.value("slack_needed", "T_n", "N", "Pull of the slack strand that is needed",
           lambda circumferential_pull, euler_ratio: circumferential_pull / (euler_ratio - 1))
pull.value("slack_pull", "T_2", "N", "Pull of the slack strand: its weight", bind(common.same, quantity="strand_weight"),
           lacks=("pretension",))
pull.value("slack_pull", "T_2", "N", "Pull of the slack strand: weight and take-up",
           lambda strand_weight, pretension: strand_weight + pretension, needs=("pretension",))
pull.value("tight_pull", "T_1", "N", "Pull of the tight strand",
           lambda slack_pull, circumferential_pull: slack_pull + circumferential_pull)
pull.value("lagging_pressure", "p_L", "MPa", "Pressure on the rubber",
           lambda tight_pull, slack_pull, head_diameter, belt_width: (tight_pull + slack_pull) / (head_diameter * belt_width),
           needs=("lagging=rubber",))

shaft = Chapter("Head shaft")
shaft.breakpoints("scooping", "angle", "scoop_start", "scoop_end")
shaft.value("is_scooping", "S", "1", "Whether a bucket scoops",
            lambda angle, scoop_start, scoop_end: (angle > scoop_start) & (angle < scoop_end), per_piece=True, output=False)
shaft.value("scoop_pull", "U_s", "N", "Force of scooping",
            lambda is_scooping, scoop_force, scoop_start, scoop_end:
                np.where(is_scooping > 0, scoop_force * 2 * np.pi / (scoop_end - scoop_start), 0 * scoop_force))
shaft.value("shaft_torque", "M", "N*m", "Torque of the head shaft",
            lambda lift_force, scoop_pull, head_diameter: (lift_force + scoop_pull) * head_diameter / 2)
shaft.reduction("torque_max", "M_max", "N*m", "Maximum torque", "max", of="shaft_torque")
shaft.reduction("torque_mean", "M_m", "N*m", "Mean torque", "mean", of="shaft_torque")
shaft.accumulated("work", "W", "J", "Work since the top", of="shaft_torque")


@formula
def length_mismatch(centre: Any, small_pulley: Any, large_pulley: Any, belt_length: Any) -> Any:
    slope = np.arcsin((large_pulley - small_pulley) / (2 * centre))
    straight = 2 * centre * np.cos(slope)
    around = np.pi / 2 * (large_pulley + small_pulley) + (large_pulley - small_pulley) * slope
    return straight + around - belt_length


@formula
def length_by_wraps(centre: Any, small_pulley: Any, large_pulley: Any) -> Any:
    half_wrap = np.arccos((large_pulley - small_pulley) / (2 * centre))
    straight = np.sqrt(4 * centre**2 - (large_pulley - small_pulley) ** 2)
    return straight + large_pulley * (np.pi - half_wrap) + small_pulley * half_wrap


drive = Chapter("Drive")
drive.value("power", "P", "kW", "Power at the motor",
            lambda circumferential_pull, belt_speed, efficiency: circumferential_pull * belt_speed / efficiency, source="S1 eq. 9")
drive.pick("motor_power", "P_m", "kW", "Power of the motor", "above", of="power", series=standard_series("iec_60072_ratings"))
drive.value("length_wanted", "L_w", "mm", "Length for the wanted distance",
            lambda wanted_centre, small_pulley, large_pulley:
                2 * wanted_centre + np.pi / 2 * (large_pulley + small_pulley) + (large_pulley - small_pulley) ** 2 / (4 * wanted_centre))
drive.pick("belt_length", "L", "mm", "Length of the belt", "nearest", of="length_wanted", series=(1400, 1600, 1800, 2000))
drive.root("centre", "C", "mm", "Distance of the shafts", length_mismatch,
           low=lambda small_pulley, large_pulley: (large_pulley - small_pulley) / 2, high=lambda belt_length: belt_length / 2,
           left=bind(common.same, quantity="belt_length"), right=length_by_wraps)
drive.value("small_wrap", "α_1", "deg", "Wrap of the smaller pulley",
            lambda centre, small_pulley, large_pulley: 2 * np.arccos((large_pulley - small_pulley) / (2 * centre)))
drive.value("ratio_of_speeds", "i", "1", "Ratio of the belt drive", lambda small_pulley, large_pulley: large_pulley / small_pulley)

holding = Chapter("Backstop", needs=("backstop",), absent="no backstop is given")
holding.value("pawl_force", "F_p", "N", "Force of the pawl",
              bind(lambda lift_force, head_diameter, arm: lift_force * head_diameter / (2 * arm), arm="backstop.radius"))


# --- report


def head_drawing(view: View) -> list[Shape]:
    radius = view["head_diameter"] / 2
    rim = list(zip(view.curve("rim_x"), view.curve("rim_y"), strict=True))
    return [circle((0.0, 0.0), radius, "outline"), polyline(rim, "hidden"), point((0.0, radius), "mark", view.text("head_diameter"))]


CHECKS = (
    Check(id="filling", check_class="strength", title="Filling of the buckets",
          demand="filling_needed", limit="filling", unit="%", demand_label="needed",
          limit_label="allowed", consequence="the buckets run over; {filling_advice}, or raise head_speed from {head_speed}."),
    Check(id="slip", check_class="strength", title="Slip of the belt",
          demand="slack_needed", limit="slack_pull", unit="N", demand_label="slack strand needs",
          limit_label="it has", consequence="the belt slips: raise pretension."),
    Check(id="pull", check_class="strength", title="Pull of the belt", demand="tight_pull", limit="allowable_pull", unit="kN", demand_label="pull",
          limit_label="allowed", consequence="a stronger belt is needed.", source="S1"),
    Check(id="pulley_load", check_class="strength", title="Load of the pulleys", demand="pulley_load", limit="allowable_pulley_load", unit="kN",
          demand_label="load", limit_label="allowed", consequence="stronger shafts are needed."),
    Check(id="torque", check_class="strength", title="Torque of the head shaft", demand="shaft_torque", limit="allowable_torque", unit="N*m",
          demand_label="torque", limit_label="allowed", consequence="a stronger shaft is needed.", needs=("allowable_torque",)),
    Check(id="pawl", check_class="strength", title="Force of the pawl",
          demand="pawl_force", limit="backstop.allowable_force", unit="kN", demand_label="force",
          limit_label="allowed", consequence="place the pawl farther out.", needs=("backstop",)),
    Check(id="wrap", check_class="strength", title="Wrap of the smaller pulley", demand=120, limit="small_wrap", unit="deg", demand_label="at least",
          limit_label="has", consequence="move the shafts apart.", severity="warn"),
)

FIGURES = (
    Plot(id="turn", title="One turn of the head drum", caption="Force on the waste and torque over a turn.", abscissa="angle",
         panels=(Panel(title="Force on the waste", unit="N", series=(Series(curve="normal_force", label="N_w"),),
                       marks=(Mark(x="press_max_at", y="press_max", label="greatest"),)),
                 Panel(title="Torque", unit="N*m", series=(Series(curve="shaft_torque", label="M"),),
                       levels=(Level(value="torque_mean", label="mean"),)))),
    Drawing(id="head", title="Head drum", caption="The head drum, to scale.", build=head_drawing),
    Bars(id="pulls", title="Pulls", caption="Components of the pull.",
         groups=(BarGroup(label="Pull", unit="N", bars=(("waste", "lift_force"), ("scooping", "scoop_force"), ("all", "circumferential_pull"))),)),
)

MECHANISM = Mechanism(
    kind="bucket_elevator",
    version="1.0",
    title="Bucket elevator",
    summary="Pull, discharge and drive of a bucket elevator.",
    inputs=Elevator,
    chapters=(conveying, discharge, pull, shaft, drive, holding),
    key_results=("belt_speed", "power", "motor_power"),
    checks=CHECKS,
    figures=FIGURES,
    assumptions=("Buckets are small beside the drum.",),
    sources=(Source("S1", "Rules for bucket elevators"), Source("S2", "Discharge of bucket elevators")),
    errata=(Erratum("S2", "Table 1 has its columns exchanged.", touches=("discharge", "pole_distance")),),
    exports=(Profile(id="rim", title="Rim of the head drum", columns=("rim_x", "rim_y")),),
)
