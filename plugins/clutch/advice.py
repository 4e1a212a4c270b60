"""What to change where a check of the clutch fails: numbers that pass once they are typed in, and break no other check."""

from __future__ import annotations

from math import cbrt, inf, sqrt, tan

from diecut_report.api import Phrase, joined, phrase, told

LARGEST = 2.0  # radius and width of shoes beyond which no advice is given: nobody builds them, m
MARGIN = 1e-3  # relative: what has to lie beyond a limit is named a little beyond it


def against_jamming(wedge_angle_limit: float, wedge_friction_limit: float) -> str:
    """Angle and friction with which the cone lifts the shoes."""
    angle = told(wedge_angle_limit * (1 - MARGIN), "deg", up=False)
    return Phrase(
        "set wedge_angle to at most {angle}, or set wedge_friction to at most {less}",
        angle=angle,
        less=_less(wedge_friction_limit),
    )


def against_locking(friction_angle: float, wedge_slope: float) -> str:
    """Angle and friction with which the wedge opens by itself."""
    angle = told(friction_angle * (1 + MARGIN), "deg", up=True)
    return Phrase(
        "set wedge_angle to at least {angle}, or set wedge_friction to at most {less}",
        angle=angle,
        less=_less(wedge_slope),
    )


def _less(limit: float) -> str:
    return told(limit * (1 - MARGIN), "1", up=False)


def against_pressure(
    shoe_width: float, lining_width: float, shoe_radius: float, least_radius: float, shoe_coverage: float
) -> str:
    """Words where the given shoes are too narrow for the pressure; their width is at most the radius."""
    changes = [_width(shoe_width, shoe_radius)] if shoe_width <= shoe_radius else []
    changes.append(against_given_width(least_radius))
    coverage = shoe_coverage * shoe_width / lining_width
    if coverage <= 1 and lining_width <= shoe_radius:
        changes.append(Phrase("set shoe_coverage to at least {coverage}", coverage=told(coverage, "1", up=True)))
    return joined(changes, ", or ")


def against_sized_width(lining_width: float) -> str:
    """Words where the pressure of shoes that are sized for it lies above it by rounding."""
    return Phrase("set shoe_width to at least {width}", width=told(lining_width, "mm", up=True))


def _width(low: float, high: float) -> str:
    low_text, high_text = told(low, "mm", up=True), told(high, "mm", up=False)
    return Phrase("set shoe_width to between {low_text} and {high_text}", low_text=low_text, high_text=high_text)


def against_width(shoe_radius: float, lining_width: float, pv: float = 0.0, allowable_pv: float = inf) -> str:
    """Words where the sized shoes are too wide: with this radius and width the lining has as much area, and q·v is allowed."""
    return _square(max(sqrt(shoe_radius * lining_width), lining_width * pv / allowable_pv))


def against_given_width(least_radius: float) -> str:
    """Words where the given shoes are too wide."""
    return Phrase("set shoe_radius to at least {least_radius}", least_radius=told(least_radius, "mm", up=True))


def _square(size: float) -> str:
    if size > LARGEST:
        return phrase("design for less torque")
    text = told(size, "mm", up=True)
    return Phrase("set shoe_radius to at least {text} with shoe_width: {text}", text=text)


def against_glazing(shoe_radius: float, shoe_width: float, lining_width: float, pv: float, allowable_pv: float) -> str:
    """Words where pressure times sliding speed, which falls with the width alone, is too great."""
    width = max(lining_width * pv / allowable_pv, shoe_width)
    if width <= shoe_radius:
        return _width(width, shoe_radius)
    return _square(max(width, cbrt(shoe_radius**2 * shoe_width)))


def against_glazing_of_torque(
    shoe_radius: float, shoe_width: float, lining_width: float, pv: float, allowable_pv: float, speed: float
) -> str:
    """The same where the torque is given: of a given power the product is the same at each speed."""
    wider = against_glazing(shoe_radius, shoe_width, lining_width, pv, allowable_pv)
    return Phrase(
        "{wider}, or set speed to at most {speed}", wider=wider, speed=told(speed * allowable_pv / pv, "rpm", up=False)
    )


def against_travel(
    wedge_angle: float,
    wedge_angle_limit: float,
    travel_angle: float,
    axial_travel: float,
    available_travel: float,
    radial_gap: float,
) -> str:
    """Words where the cone meets its stop before the lining is worn."""
    changes = [
        Phrase("set available_travel to at least {axial_travel}", axial_travel=told(axial_travel, "mm", up=True))
    ]
    wear = available_travel * tan(wedge_angle) - radial_gap
    if wear >= 0:
        changes.append(Phrase("set wear_allowance to at most {wear}", wear=told(wear, "mm", up=False)))
    if travel_angle < wedge_angle_limit * (1 - MARGIN):
        changes.append(
            Phrase(
                "set wedge_angle to at least {travel_angle}, which asks for more force",
                travel_angle=told(travel_angle, "deg", up=True),
            )
        )
        return joined(changes, ", or ")
    return joined(changes, ", or ") + phrase("; with a wedge that still lifts the shoes no angle alone helps")
