"""Figures of the cam-gear stepper."""

from __future__ import annotations

from functools import partial
from math import cos, pi, sin

import numpy as np

from diecut_report.api import (
    Chart,
    Drawing,
    Level,
    Mark,
    Panel,
    Phrase,
    Plot,
    Point,
    Series,
    Shape,
    Span,
    View,
    arc,
    chart_panel,
    circle,
    dimension,
    label,
    line,
    mark,
    phrase,
    point,
    polyline,
    radius_dimension,
    rigid,
    vertical,
    worded,
)
from diecut_report.mechanics.motion_laws import LAWS, MotionLaw
from diecut_report.plugins.cam_gear_transport import formulas
from diecut_report.plugins.cam_gear_transport.cams import LOADED
from diecut_report.plugins.cam_gear_transport.inputs import CAMS, SHEET, TORQUE

MOST_POINTS = 720  # of a drawn curve
MOST_MOVING = 180  # of one beside which a drawing moves on a screen


def polar(center: Point, radius: float, angle: float) -> Point:
    """A point at a distance and direction from another one."""
    return center[0] + radius * cos(angle), center[1] + radius * sin(angle)


def _sector(view: View, disc_angle: float, role: str) -> list[Shape]:
    """The sector at a disc angle: its pin, and the arc that meshes with the gear over the whole cycle."""
    pin = polar((0.0, 0.0), view["center_distance"], disc_angle)
    turned = disc_angle + view.at("sector_angle", disc_angle)
    sector = polyline([(0.0, 0.0), *view.once(_rim)], role, closed=True)
    return [rigid([sector], pin, turned), point(pin, "pivot" if role == "body" else "joint")]


def _rim(view: View) -> list[Point]:
    """The sector's teeth about its pin, from where they mesh at the start of phase I to the end of phase III."""
    half_stop = view["sector_stop_sweep"] / 2
    start, end = pi - view["sector_dwell_sweep"] - half_stop, pi + half_stop
    return [polar((0.0, 0.0), view["sector_radius"], angle) for angle in np.linspace(start, end, 61)]


def rolling_at(view: View, disc_angle: float) -> list[Shape]:
    """Gear, disc and sector at a disc angle."""
    gear, pin = view["gear_radius"], polar((0.0, 0.0), view["center_distance"], disc_angle)
    wheel = [circle((0.0, 0.0), gear), polyline([(0.0, 0.0), (gear, 0.0)])]
    return [
        circle((0.0, 0.0), view["center_distance"], "centerline"),
        *_sector(view, disc_angle, "body"),
        rigid(wheel, (0.0, 0.0), view.at("gear_angle", disc_angle)),
        polyline([(0.0, 0.0), pin], "link"),
        point((0.0, 0.0), "pivot"),
    ]


def rolling(view: View) -> list[Shape]:
    """Gear and sector at the start of the dwell (dark) and at its end (light)."""
    distance, gear, dwell = view["center_distance"], view["gear_radius"], view["dwell_angle"]
    end = polar((0.0, 0.0), distance, dwell)
    return [
        polyline([(0.0, 0.0), end], "centerline"),
        polyline([(0.0, 0.0), (distance, 0.0)], "centerline"),
        circle((0.0, 0.0), distance, "centerline"),
        *_sector(view, dwell * (1 - 1e-12), "ghost"),
        *_sector(view, 0.0, "body"),
        circle((0.0, 0.0), gear, "outline"),
        arc((0.0, 0.0), gear, 0.0, dwell, "link"),
        arc((0.0, 0.0), 0.5 * gear, 0.0, dwell, "mark"),
        label(polar((0.0, 0.0), 0.5 * gear, dwell / 2), view.text("dwell_angle")),
        point((0.0, 0.0), "pivot", "O₁"),
        label((distance, 0.0), "O₃", "right"),
        point((gear, 0.0), "mark", "A₁"),
        point(polar((0.0, 0.0), gear, dwell), "mark", "A₂"),
        radius_dimension((0.0, 0.0), gear, -0.3 * pi, view.text("gear_radius")),
        radius_dimension((0.0, 0.0), distance, -0.45 * pi, view.text("center_distance")),
        dimension((distance, 0.0), (gear, 0.0), 0.75 * gear, view.text("sector_radius")),
    ]


def _curve(view: View, name: str, most: int = MOST_POINTS) -> list[Point]:
    x, y = view.curve(f"{name}x"), view.curve(f"{name}y")
    step = -(-len(x) // most)
    return list(zip(x[::step], y[::step], strict=True))


def _profile(view: View, number: str, most: int = MOST_POINTS) -> list[Shape]:
    """A cam with the path of its roller's centre and that of the pin."""
    return [
        circle((0.0, 0.0), view["center_distance"], "centerline"),
        polyline(_curve(view, f"cam_{number}_pitch_", most), "hidden", closed=True),
        polyline(_curve(view, f"cam_{number}_", most), "body", closed=True),
    ]


PROFILES = {number: partial(_profile, number=number, most=MOST_MOVING) for number in "12"}


def _arm(view: View, number: str, disc_angle: float) -> tuple[Point, Point]:
    """The pin O₃ and the roller's centre at a disc angle."""
    pin = polar((0.0, 0.0), view["center_distance"], disc_angle)
    return pin, polar(pin, view["arm_length"], disc_angle + view.at(f"arm_{number}_direction", disc_angle))


def one_cam(view: View, number: str) -> list[Shape]:
    """One cam with arm and roller in the middle of the dwell, and at the start of the return."""
    center = (0.0, 0.0)
    distance = view["center_distance"]
    shapes = _profile(view, number)
    for place, arm, wheel in ((view["angle_stop"], "ghost", "ghost"), (view["dwell_angle"] / 2, "link", "mark")):
        pin, roller = _arm(view, number, place)
        shapes += [polyline([pin, roller], arm), circle(roller, view["roller_radius"], wheel), point(pin, "joint")]
    return [
        *shapes,
        label(pin, "O₃", "right"),
        point(center, "pivot", "O₁"),
        radius_dimension(center, distance, -0.2 * pi, view.text("center_distance")),
        dimension(pin, roller, 0.12 * distance, view.text("arm_length")),
    ]


def _cam_at(view: View, disc_angle: float, number: str) -> list[Shape]:
    """One cam with disc, arm and roller at a disc angle."""
    pin, roller = _arm(view, number, disc_angle)
    return [
        *view.once(PROFILES[number]),
        polyline([(0.0, 0.0), pin], "outline"),
        polyline([pin, roller], "link"),
        circle(roller, view["roller_radius"], "mark"),
        point((0.0, 0.0), "pivot"),
        point(pin, "joint"),
    ]


BETWEEN = "Between the shaded phases II (dwell) and IV (return) the sector stops in phase III; after IV it starts again in phase I."
SHADED = "Shaded: dwell (phase II) and return (phase IV)."
LONGEST = 0.9  # share of a turn up to which dwells are drawn
POINTS = 241  # of the lines of a comparison


def ratio_over_dwell(view: View) -> list[Shape]:
    """Radius of the gear to that of the pin over the share of the dwell, with the same sweep of the sector."""
    shares = np.linspace(0.02, LONGEST, 177)
    ratios = formulas.radius_ratio(view["sector_dwell_sweep"], 2 * np.pi * shares)
    limits = (("dwell_angle_recommended", "return too short"), ("dwell_angle_limit", "no return"))
    return [
        chart_panel(
            "Ratio of gear radius to pin radius",
            "1",
            "Dwell fraction of the cycle",
            "T_2",
            "1",
            lines=[line(shares, ratios, "R₁/R₂")],
            marks=[mark(view["time_dwell"], view["radius_ratio"], "this machine")],
            verticals=[vertical(view[name] / (2 * np.pi), words) for name, words in limits if view[name] > 0],
        )
    ]


def peaks(view: View, law: MotionLaw) -> tuple[float, float]:
    """Greatest speed of the gear to the disc's and its greatest acceleration by a law; NaN where it does not suit the phases."""
    stop = formulas.time_stop(law.B, view["sector_stop_sweep"], view["sector_speed_dwell"])
    left = formulas.time_return(view["time_dwell"], stop)
    if left <= 0 or not formulas.is_symmetric(law.position(0.5), law.velocity(0.5), law.B):
        return np.nan, np.nan
    radii = view["sector_radius"], view["gear_radius"]
    speed = formulas.gear_speed(-formulas.return_peak(law.B, view["sector_sweep"], left), *radii)
    rises = ((view["sector_stop_sweep"], stop), (view["sector_sweep"], left))
    top = max(formulas.rise_acceleration(sweep, time, law.A, view["cycles_per_hour"]) for sweep, time in rises)
    return formulas.share_of_turn(speed), formulas.gear_acceleration(-top, *radii)


def laws_compared(view: View) -> list[Shape]:
    """Speed and acceleration of the gear by each law of motion that leaves a return, for the same dwell and sweeps."""
    speeds, accelerations = [], []
    for name, law in LAWS.items():
        ratio, top = peaks(view, law)
        if np.isnan(ratio):
            continue
        x, curves = view.varied_curves({"motion_law": name}, "gear_speed", "gear_acceleration", points=POINTS)
        speed, acceleration = curves["gear_speed"], curves["gear_acceleration"]
        moving, words = x >= view["dwell_angle"], phrase(worded(name))
        speeds.append(
            line(x[moving], speed[moving] / (2 * np.pi), Phrase("{law}, {peak}", law=words, peak=f"{ratio:.2f}"))
        )
        accelerations.append(
            line(x[moving], acceleration[moving], Phrase("{law}, {peak}", law=words, peak=f"{top:.0f}"))
        )
    across = ("Disc angle from the start of the dwell", "φ", "deg")
    return [
        chart_panel("Ratio of the gear's speed to that of the disc", "1", *across, lines=speeds),
        chart_panel("Acceleration of the gear", "rad/s**2", *across, lines=accelerations),
    ]


def _panel(
    title: str,
    unit: str,
    *series: tuple[str, str],
    marks: tuple[Mark, ...] = (),
    levels: tuple[Level, ...] = (),
    named: bool = False,
) -> Panel:
    """A panel with the phases II and IV shaded; ``named`` where no curve lies on the bottom edge, where their names stand."""
    drawn = tuple(Series(curve, words) for curve, words in series)
    phases = (("angle_dwell", "dwell_angle", "II"), ("angle_stop", "angle_start", "IV"))
    spans = tuple(Span(start, end, name if named else "") for start, end, name in phases)
    return Panel(title, unit, series=drawn, marks=marks, levels=levels, spans=spans)


FIGURES = (
    Drawing("rolling", "Gear and sector", build=rolling, moving=rolling_at, over="disc_angle",
            caption="Pitch circles to scale: the sector at the start of the dwell (dark) and at its end (light). The arc A₁A₂ of the gear equals "
                    "the arc of the sector that rolls off on it, so the gear stands still (figure 3 of 003)."),
    Plot("phase_diagram", "Phase diagram of the sector", abscissa="disc_angle",
         caption="Angle of the sector relative to the disc over a turn of the disc (figure 4 of 003). " + BETWEEN,
         panels=(_panel("Angle of the sector", "deg", ("sector_angle", "γ"), named=True),)),
    Chart("radius_ratio", "Radius of the gear over the dwell", build=ratio_over_dwell,
          caption="The longer the dwell, the smaller the gear (figure 5 of 003), for this sweep of the sector. Beyond the first line the return "
                  "is shorter than the accepted minimum, beyond the second one dwell, stop and start would take the whole revolution."),
    Plot("sector_speed", "Speed of the sector by phase", abscissa="disc_angle",
         caption="Speed and acceleration of the sector relative to the disc, speed per revolution of the disc (figure 6 of 003). " + SHADED,
         panels=(_panel("Speed", "rad", ("sector_speed", "ω₃")), _panel("Acceleration", "rad/s**2", ("sector_acceleration", "ε₃"), named=True))),
    Plot("gear_motion", "Motion of the gear over a turn", abscissa="disc_angle",
         caption="Angle, speed (per revolution of the disc, figure 7 of 003) and acceleration of the gear, which drives the conveyor. " + SHADED,
         panels=(_panel("Angle", "deg", ("gear_angle", "φ₁")),
                 _panel("Speed", "rad", ("gear_speed", "ω₁"), marks=(Mark("gear_speed_peak_at", "gear_speed_peak", "maximum"),)),
                 _panel("Acceleration", "rad/s**2", ("gear_acceleration", "ε₁"), named=True))),
    Plot("sheet", "Motion of the sheet", abscissa="disc_angle", needs=SHEET,
         caption="Position, velocity and acceleration of the sheet over a cycle. " + SHADED,
         panels=(_panel("Position", "mm", ("sheet_position", "x")), _panel("Velocity", "m/s", ("sheet_velocity", "V")),
                 _panel("Acceleration", "m/s**2", ("sheet_acceleration", "a_s"), named=True))),
    Chart("laws", "Motion laws for the same dwell", build=laws_compared,
          caption="Speed and acceleration of the gear by each law of motion, each with its maximum value, for the same dwell and the same sweeps "
                  "of the sector. A law with a lower peak velocity stops the sector sooner and leaves its return more time."),
    Plot("torque", "Torque", abscissa="disc_angle", needs=TORQUE,
         caption="Torque at the shafts of disc and gear, without losses; negative where the conveyor drives back. " + SHADED,
         panels=(_panel("Torque", "N*m", ("drive_torque", "disc"), ("gear_torque", "gear"), named=True),)),
    *(Drawing(f"cam_{number}", f"Cam {number}", build=partial(one_cam, number=number),
              moving=partial(_cam_at, number=number), over="disc_angle", needs=CAMS,
              caption=f"Cam {number} to scale, with the path of its roller's centre (dashed) and that of the pin O₃ (dash-dotted); arm and roller in "
              "the middle of the dwell, light: where the sector stops. The cam stands still, the disc turns counter-clockwise; its angle counts "
              "from the right.")
      for number in "12"),
    Plot("cam_angles", "Pressure angle and curvature of the cams", abscissa="disc_angle", needs=CAMS,
         caption="Pressure angle, and curvature of the pitch curves: positive where convex, negative where concave. " + SHADED,
         panels=(_panel("Pressure angle", "deg", ("cam_1_pressure_angle", "cam 1"), ("cam_2_pressure_angle", "cam 2"),
                        levels=(Level("max_pressure_angle", "accepted"),)),
                 _panel("Curvature", "1/m", ("cam_1_curvature", "cam 1"), ("cam_2_curvature", "cam 2"), named=True))),
    Plot("roller_forces", "Forces on the rollers", abscissa="disc_angle", needs=(*CAMS, *TORQUE),
         caption="Force of each cam on its roller: one pushes the sector one way, the other pushes it back. " + SHADED,
         panels=(_panel("Force", "N", ("roller_force_1", "roller 1"), ("roller_force_2", "roller 2")),)),
    Plot("contact", "Contact pressure of the rollers", abscissa="disc_angle", needs=(*CAMS, *LOADED),
         caption="Maximum pressure in the line contact of roller and cam. " + SHADED,
         panels=(_panel("Pressure", "MPa", ("contact_pressure_1", "cam 1"), ("contact_pressure_2", "cam 2")),)),
)  # fmt: skip
