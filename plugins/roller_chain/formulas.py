"""Formulas of roller chains: geometry, tension of a strand, power rating."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import GRAVITY, Constant, as_number, formula

INCH = Constant(0.0254, "inch", "m")
SPEED = Constant(2 * np.pi / 60, "rpm", "rad/s")
HORSEPOWER = Constant(745.7, "hp", "W")


@formula
def exact_links(center: Any, pitch: Any, teeth_1: Any, teeth_2: Any) -> Any:
    """Links over two sprockets, by the formula of all catalogues."""
    return (
        2 * center / pitch
        + (teeth_1 + teeth_2) / 2
        + ((teeth_2 - teeth_1) / (2 * as_number(np.pi))) ** 2 * pitch / center
    )


@formula
def even_links(exact: Any) -> Any:
    """Next even number of links, so that none is cranked; a chain that fits exactly takes no more."""
    return 2 * np.ceil(exact / 2 - 1e-9)


@formula
def polygon_links(center: Any, pitch: Any, teeth_1: Any, teeth_2: Any, diameter_1: Any, diameter_2: Any) -> Any:
    """Links over two sprockets: two straight runs, and the teeth that each sprocket has in its wrap."""
    slope = np.arcsin((diameter_2 - diameter_1) / (2 * center))
    wrapped = teeth_1 * (np.pi - 2 * slope) / (2 * np.pi) + teeth_2 * (np.pi + 2 * slope) / (2 * np.pi)
    return 2 * center * np.cos(slope) / pitch + wrapped


@formula
def bearing_area(pin_diameter: Any, inner_width: Any, plate_thickness: Any) -> Any:
    """Area of pin and bush, which is as long as the inner link is wide."""
    return pin_diameter * (inner_width + 2 * plate_thickness)


@formula
def mean_velocity(teeth: Any, pitch: Any, speed: Any) -> Any:
    """Mean velocity of a chain: so many pitches a turn."""
    return teeth * pitch * speed / (2 * np.pi)


@formula
def sag_tension(mass_per_length: Any, center: Any, sag: Any, inclination: Any) -> Any:
    """Tension of a strand by its weight, at its upper end: a parabola."""
    return mass_per_length * GRAVITY * center * (np.cos(inclination) / (8 * sag) + np.sin(inclination))


@formula
def centrifugal(mass_per_length: Any, velocity: Any) -> Any:
    """Tension that keeps the chain on its circles."""
    return mass_per_length * velocity**2


@formula
def chordal_step(angular_speed: Any, pitch: Any) -> Any:
    """Acceleration of the chain where a joint meets the sprocket."""
    return as_number(angular_speed) ** 2 * pitch / 2


@formula
def chordal(mass_per_length: Any, center: Any, step: Any) -> Any:
    """Force that the acceleration asks of the free strand."""
    return mass_per_length * center * step


@formula
def drive_tension(torque: Any, strands: Any, diameter: Any) -> Any:
    """Useful tension of a strand of a drive."""
    return 2 * abs(torque) / (strands * diameter)


@formula
def conveyor_tension(total: Any, acceleration: Any, moving: Any, resistance: Any, strands: Any) -> Any:
    """Useful tension of a strand of a conveyor: the mass is accelerated, and what moves rubs."""
    return (abs(total * acceleration) + moving * resistance) / strands


@formula
def resistance(friction: Any, mass: Any, process_force: Any) -> Any:
    """Force against the motion of a conveyor."""
    return friction * mass * GRAVITY + process_force


@formula
def hanging_mass(mass: Any, strands: Any, mass_per_length: Any, length: Any) -> Any:
    """Mass that moves with a conveyor's chains, and they themselves."""
    return mass + strands * mass_per_length * length


@formula
def total_mass(hanging: Any, inertia: Any, diameter: Any) -> Any:
    """Mass that is accelerated, with what turns at the driven sprocket."""
    return hanging + inertia / (diameter / 2) ** 2


@formula
def whole_tension(application: Any, useful: Any, centrifugal: Any, sag: Any, chordal: Any, pretension: Any) -> Any:
    """Tension of the tight strand."""
    return application * useful + centrifugal + sag + chordal + pretension


@formula
def quiet_tension(useful: Any, centrifugal: Any, sag: Any, pretension: Any) -> Any:
    """Tension of the tight strand without shocks."""
    return useful + centrifugal + sag + pretension


@formula
def plate_power(teeth: Any, speed: Any, pitch: Any) -> Any:
    """Power up to which the plates last, one strand (ANSI B29.1)."""
    turns = speed / SPEED
    inches = pitch / INCH
    return HORSEPOWER * 0.004 * teeth**1.08 * turns**0.9 * inches ** (3 - 0.07 * inches)


@formula
def roller_power(teeth: Any, speed: Any, pitch: Any) -> Any:
    """Power up to which rollers and bushes last, one strand (ANSI B29.1)."""
    turns = speed / SPEED
    return HORSEPOWER * 17000 * teeth**1.5 * (pitch / INCH) ** 0.8 / turns**1.5
