"""A bucket elevator that lifts the waste of a die cutter: a mechanism as somebody elsewhere writes it from the documentation."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import (
    CURVE_ROUNDING,
    GRAVITY,
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
    abscissa,
    accumulated,
    as_angle,
    as_number,
    block,
    case,
    choice,
    circle,
    computed,
    crossings,
    derivative,
    formula,
    inner,
    lookup,
    m,
    part,
    parts,
    pi,
    pick,
    point,
    polyline,
    reduction,
    root,
    running,
    samples,
    self_test,
    standard_series,
    told,
    total,
    value,
)

# fmt: off

# --- inputs


class Pulley(Block):
    diameter = Quantity("D_i", "mm", "Diameter of the pulley", gt=0)
    journal_diameter = Quantity("d_i", "mm", "Diameter of its journals", gt=0)
    journal_friction = Quantity("f_i", "1", "Friction in its bearings", ge=0, lt=1, default=0.02)
    wrap = Quantity("α_i", "deg", "Angle of wrap of the belt", gt=0, le=180, default=180)


class Backstop(Block):
    radius = Quantity("r_b", "mm", "Radius at which the pawl holds", gt=0)
    allowable_force = Quantity("[F_p]", "kN", "Force that the pawl may carry", gt=0)


class Elevator(Inputs):
    one_of = (OneOf(("capacity",), ("volume_rate",)),)

    capacity = Quantity("Q", "t/h", "Waste that is to be lifted", gt=0, optional=True)
    volume_rate = Quantity("V_t", "m**3/h", "Volume of waste that is to be lifted", gt=0, optional=True)
    material = Text("What the waste is made of", ("board", "paper", "foil"), default="board")
    bulk_density = Quantity("γ", "kg/m**3", "Density of the loose waste", gt=0, default=120)
    height = Quantity("H", "m", "Height of lift", gt=0, le=60)
    head_diameter = Quantity("D", "mm", "Diameter of the head drum", gt=0, default=500)
    head_speed = Quantity("ω", "rpm", "Speed of the head drum", gt=0)
    head_wrap = Quantity("α", "deg", "Angle of wrap at the head drum", gt=0, le=270, default=180)
    lagging = Text("Lagging of the head drum", ("bare", "rubber"), default="rubber")
    belt_width = Quantity("B", "mm", "Width of the belt", gt=0, default=300)
    belt_mass = Quantity("q_b", "kg/m", "Mass of the belt", gt=0, default=6)
    bucket_mass = Quantity("m_e", "kg", "Mass of an empty bucket", gt=0, default=5)
    bucket_volume = Quantity("V", "L", "Volume of a bucket", gt=0, default=14)
    bucket_pitch = Quantity("p", "mm", "Distance of the buckets", gt=0, default=400)
    filling = Quantity("ψ", "%", "Share of a bucket that may be filled", gt=0, le=100, default=75)
    scoop_start = Quantity("φ_1", "deg", "Turn of the drum at which a bucket enters the waste", ge=0, lt=360, default=100)
    scoop_end = Quantity("φ_2", "deg", "Turn of the drum at which it leaves the waste", gt=0, le=360, default=160)
    pretension = Quantity("T_0", "N", "Pull of the take-up on each strand", ge=0, optional=True)
    chute_drop = Quantity("h", "mm", "Chute's edge below the top of the head drum", gt=0, default=600)
    efficiency = Quantity("η", "%", "Efficiency of gear and belt drive", gt=0, le=100, default=90)
    small_pulley = Quantity("d_1", "mm", "Smaller pulley of the belt drive", gt=0, default=140)
    large_pulley = Quantity("d_2", "mm", "Greater pulley of the belt drive", gt=0, default=280)
    wanted_centre = Quantity("C_w", "mm", "Wanted distance of the pulleys' shafts", gt=0, default=500)
    allowable_pull = Quantity("[T]", "kN", "Pull that the belt may carry", gt=0, default=10)
    allowable_pulley_load = Quantity("[F_i]", "kN", "Load that each pulley's shaft may carry", gt=0, default=6)
    allowable_torque = Quantity("[M]", "N*m", "Torque that the head shaft may carry", gt=0, optional=True)
    pulleys = parts(Pulley, "Pulleys that turn the belt, without the head drum")
    backstop = block(Backstop, "Backstop, which holds the belt when the drive stops", optional=True)
    n_points = samples(360)


# --- calculation

conveying = Chapter("Conveying")
conveying.mass_rate = value(m.capacity, needs=("capacity",)), "Q_m", "t/h", "Mass rate: as given", "input"
conveying.mass_rate = value(m.volume_rate * m.bulk_density, lacks=("capacity",)), "Q_m", "t/h", "Mass rate: of the volume"
conveying.belt_speed = m.head_speed * m.head_diameter / 2, "v", "m/s", "Speed of the belt", "S1 eq. 1"
conveying.bucket_load = m.filling * m.bucket_volume * m.bulk_density, "m_w", "kg", "Waste in a bucket", "S1 eq. 2"
conveying.filling_needed = (m.mass_rate * m.bucket_pitch / (m.bulk_density * m.bucket_volume * m.belt_speed),
    "ψ_n", "%", "Filling that the mass rate needs")
conveying.waste_line_mass = m.mass_rate / m.belt_speed, "q_w", "kg/m", "Waste on the belt"
conveying.strand_line_mass = m.belt_mass + m.bucket_mass / m.bucket_pitch, "q_s", "kg/m", "Belt with empty buckets"
conveying.bucket_count = value(np.ceil((2 * m.height + pi * m.head_diameter) / m.bucket_pitch), whole=True), "z", "1", "Buckets on the belt"


def against_overfilling(filling: float, needed: float) -> str:
    return f"buckets that are {told(needed / filling - 1, '%', 2)} greater carry it"


conveying.words("filling_advice", against_overfilling, takes=("filling", "filling_needed"))

discharge = Chapter("Discharge", text="The waste stays in the bucket as long as the bucket presses on it.")
discharge.froude_number = as_number(m.head_speed) ** 2 * m.head_diameter / (2 * GRAVITY), "Fr", "1", "Froude number of the head drum", "S2 eq. 4"
discharge.speed_limit = inner(as_angle(np.sqrt(2 * GRAVITY / m.head_diameter))), "ω_lim", "rad/s", "Speed from which waste is thrown at once"
discharge.require("not_thrown", m.froude_number < 1, key="head_speed",
    message="is {head_speed}, but from {speed_limit:down} on the waste is thrown before it is at the top; turn slower")
discharge.pole_distance = GRAVITY / as_number(m.head_speed) ** 2, "h_p", "mm", "Distance of the pole of discharge"
discharge.discharge = (choice(
    case("by gravity", "the pole is above the buckets", m.head_diameter < m.pole_distance),
    case("mixed", "the pole is among the buckets"),
), "K", "1", "Discharge is", "S2 table 1")
discharge.angle = abscissa(period=2 * np.pi), "φ", "deg", "Turn of the head drum from the top"


@formula
def normal_force(bucket_load: Any, angle: Any, head_speed: Any, head_diameter: Any) -> Any:
    centripetal = as_number(head_speed) ** 2 * head_diameter / 2
    return bucket_load * (GRAVITY * np.cos(angle) - centripetal)


def falling_time(speed: Any, drop: Any) -> Any:
    """Seconds in which a body that leaves the drum's top level falls to the chute's edge."""
    return np.sqrt(2 * drop / GRAVITY) + 0 * speed


discharge.normal_force = normal_force, "N_w", "N", "Force of the bucket on the waste"
discharge.release = crossings(of="normal_force"), "φ_r", "deg", "Where the waste leaves the bucket"
discharge.force_slope = derivative(of="normal_force"), "N_w′", "N/rad", "Change of that force"
discharge.press_max = reduction("max", of="normal_force"), "N_max", "N", "Greatest force on the waste"
discharge.rim_x = m.head_diameter / 2 * np.sin(m.angle), "x", "mm", "Rim of the drum, across"
discharge.rim_y = m.head_diameter / 2 * np.cos(m.angle), "y", "mm", "Rim of the drum, upwards"
discharge.fall_time = (computed(falling_time, takes=("belt_speed", "chute_drop"), method="the root of the free fall's parabola"),
    "t_f", "s", "Fall of the waste to the chute")
discharge.throw = m.belt_speed * m.fall_time, "s_f", "mm", "How far the waste flies meanwhile"


@formula
def hanging_weight(line_mass: Any, height: Any) -> Any:
    return line_mass * GRAVITY * height


pull = Chapter("Pull")
pull.scoop_height = lookup({"board": 4, "paper": 3, "foil": 6}, by="material"), "h_s", "m", "Height that scooping counts for", "S1 table 3"
pull.head_friction = lookup({"bare": 0.2, "rubber": 0.3}, by="lagging"), "f", "1", "Friction of the belt on the drum", "S1 table 5"
pull.lift_force = hanging_weight.of(line_mass=m.waste_line_mass), "F_l", "N", "Weight of the waste that is lifted"
pull.scoop_force = hanging_weight.of(line_mass=m.waste_line_mass, height=m.scoop_height), "F_s", "N", "Mean force of scooping"
pull.strand_weight = hanging_weight.of(line_mass=m.strand_line_mass), "G_s", "N", "Weight of a strand"
pull.pulley_load = 2 * m.strand_weight * np.sin(m.pulleys.wrap / 2), "F_i", "N", "Load of a pulley's shaft", "S1 eq. 7"
pull.journal_loss = (m.pulley_load * m.pulleys.journal_friction * m.pulleys.journal_diameter / m.pulleys.diameter,
    "U_i", "N", "Pull that a pulley's journals take")
pull.journal_losses = total("sum", of="journal_loss"), "U_j", "N", "Pull that all journals take"
pull.losses_so_far = running("sum", of="journal_loss"), "ΣU_i", "N", "Losses up to each pulley"
pull.foot_load = part(of="pulley_load", index=0), "F_f", "N", "Load of the first pulley's shaft"
pull.circumferential_pull = m.lift_force + m.scoop_force + m.journal_losses, "U", "N", "Pull at the head drum"
pull.euler_ratio = np.exp(m.head_friction * as_number(m.head_wrap)), "k_e", "1", "Ratio of pulls that friction holds"
pull.slack_needed = m.circumferential_pull / (m.euler_ratio - 1), "T_n", "N", "Pull of the slack strand that is needed"
pull.slack_pull = value(m.strand_weight, lacks=("pretension",)), "T_2", "N", "Pull of the slack strand: its weight"
pull.slack_pull = value(m.strand_weight + m.pretension, needs=("pretension",)), "T_2", "N", "Pull of the slack strand: weight and take-up"
pull.tight_pull = m.slack_pull + m.circumferential_pull, "T_1", "N", "Pull of the tight strand"
pull.lagging_pressure = (value((m.tight_pull + m.slack_pull) / (m.head_diameter * m.belt_width), needs=("lagging=rubber",)),
    "p_L", "MPa", "Pressure on the rubber")

shaft = Chapter("Head shaft")
shaft.breakpoints("scooping", "angle", "scoop_start", "scoop_end")
shaft.is_scooping = inner((m.angle > m.scoop_start) & (m.angle < m.scoop_end), per_piece=True), "S", "1", "Whether a bucket scoops"
shaft.scoop_pull = (np.where(m.is_scooping > 0, m.scoop_force * 2 * pi / (m.scoop_end - m.scoop_start), 0 * m.scoop_force),
    "U_s", "N", "Force of scooping")
shaft.shaft_torque = (m.lift_force + m.scoop_pull) * m.head_diameter / 2, "M", "N*m", "Torque of the head shaft"
shaft.torque_max = reduction("max", of="shaft_torque"), "M_max", "N*m", "Maximum torque"
shaft.torque_mean = reduction("mean", of="shaft_torque"), "M_m", "N*m", "Mean torque"
shaft.mean_error = (self_test(m.torque_mean, (m.lift_force + m.scoop_force) * m.head_diameter / 2, within=CURVE_ROUNDING), "e_M", "1",
    "Mean torque against that of the pull", "statics")
shaft.work = accumulated(of="shaft_torque"), "W", "J", "Work since the top"


@formula
def length_mismatch(centre: Any, small_pulley: Any, large_pulley: Any, belt_length: Any) -> Any:
    slope = np.arcsin((large_pulley - small_pulley) / (2 * centre))
    straight = 2 * centre * np.cos(slope)
    around = pi / 2 * (large_pulley + small_pulley) + (large_pulley - small_pulley) * slope
    return straight + around - belt_length


@formula
def length_by_wraps(centre: Any, small_pulley: Any, large_pulley: Any) -> Any:
    half_wrap = np.arccos((large_pulley - small_pulley) / (2 * centre))
    straight = np.sqrt(4 * centre**2 - (large_pulley - small_pulley) ** 2)
    return straight + large_pulley * (pi - half_wrap) + small_pulley * half_wrap


drive = Chapter("Drive")
drive.power = m.circumferential_pull * m.belt_speed / m.efficiency, "P", "kW", "Power at the motor", "S1 eq. 9"
drive.motor_power = pick("above", of="power", series=standard_series("iec_60072_ratings")), "P_m", "kW", "Power of the motor"
offset = m.large_pulley - m.small_pulley
drive.length_wanted = (2 * m.wanted_centre + pi / 2 * (m.large_pulley + m.small_pulley) + offset**2 / (4 * m.wanted_centre),
    "L_w", "mm", "Length for the wanted distance")
drive.belt_length = pick("nearest", of="length_wanted", series=(1400, 1600, 1800, 2000)), "L", "mm", "Length of the belt"
drive.centre = (root(length_mismatch, low=offset / 2, high=m.belt_length / 2, left=m.belt_length, right=length_by_wraps),
    "C", "mm", "Distance of the shafts")
drive.small_wrap = 2 * np.arccos(offset / (2 * m.centre)), "α_1", "deg", "Wrap of the smaller pulley"
drive.ratio_of_speeds = m.large_pulley / m.small_pulley, "i", "1", "Ratio of the belt drive"

holding = Chapter("Backstop", needs=("backstop",), absent="no backstop is given")
holding.pawl_force = m.lift_force * m.head_diameter / (2 * m.backstop.radius), "F_p", "N", "Force of the pawl"


# --- report


def head_drawing(view: View) -> list[Shape]:
    radius = view["head_diameter"] / 2
    rim = list(zip(view.curve("rim_x"), view.curve("rim_y"), strict=True))
    return [circle((0.0, 0.0), radius, "outline"), polyline(rim, "hidden"), point((0.0, radius), "mark", view.text("head_diameter"))]


CHECKS = (
    Check("filling", "strength", "Filling of the buckets", m.filling_needed, m.filling,
          consequence="the buckets run over; {filling_advice}, or raise head_speed from {head_speed}."),
    Check("slip", "strength", "Slip of the belt", m.slack_needed, m.slack_pull, demand_label="slack strand needs", limit_label="it has",
          consequence="the belt slips: raise pretension."),
    Check("pull", "strength", "Pull of the belt", m.tight_pull, m.allowable_pull, unit="kN", consequence="a stronger belt is needed.", source="S1"),
    Check("pulley_load", "strength", "Load of the pulleys", m.pulley_load, m.allowable_pulley_load, consequence="stronger shafts are needed."),
    Check("torque", "strength", "Torque of the head shaft", m.shaft_torque, m.allowable_torque, consequence="a stronger shaft is needed.",
          needs=("allowable_torque",)),
    Check("pawl", "strength", "Force of the pawl", m.pawl_force, m.backstop.allowable_force, consequence="place the pawl farther out.",
          needs=("backstop",)),
    Check("wrap", "practice", "Wrap of the smaller pulley", 120, m.small_wrap, consequence="move the shafts apart.", severity="warn"),
)

FIGURES = (
    Plot("turn", "One turn of the head drum", "Force on the waste and torque over a turn.", abscissa="angle",
         panels=(Panel("Force on the waste", "N", series=(Series("normal_force", "N_w"),),
                       marks=(Mark("press_max_at", "press_max", "greatest"),)),
                 Panel("Torque", "N*m", series=(Series("shaft_torque", "M"),),
                       levels=(Level("torque_mean", "mean"),)))),
    Drawing("head", "Head drum", "The head drum, to scale.", build=head_drawing),
    Bars("pulls", "Pulls", "Components of the pull.",
         groups=(BarGroup("Pull", "N", bars=(("waste", "lift_force"), ("scooping", "scoop_force"), ("all", "circumferential_pull"))),)),
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
