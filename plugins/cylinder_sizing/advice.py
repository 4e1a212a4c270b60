"""What to change where a check of the cylinder fails: numbers that pass once they are typed in, also all at once."""

from __future__ import annotations

from math import pi

from scipy.optimize import brentq

from diecut_report.api import told
from diecut_report.plugins.cylinder_sizing import beam

ROUNDING = 1e-9  # relative


def against_radius(radius_exact: float, radius: float, working_length: float, segment_height: float) -> str:
    """Radius, or segment, with which the circumference beside the flat is the working length."""
    larger = f"set radius to at least {told(radius_exact, 'mm', up=True)}, or leave it out"
    if radius <= working_length / (2 * pi):
        return f"{larger}; no segment is so low that {told(radius, 'mm')} would do"
    return f"{larger}; or set segment_height to at most {told(segment_height, 'mm', up=False)}"


def against_thin_wall(
    bore_limit: float, radius_exact: float, radius: float, segment_height: float, bore_radius: float, min_wall: float
) -> str:
    """Bore, or segment, that keeps the wall; with a radius that is too small, those of the exact one."""
    small = radius < radius_exact * (1 - ROUNDING)
    beside = f", with a radius of at least {told(radius_exact, 'mm', up=True)}" if small else ""
    segment = max(radius, radius_exact) - bore_radius - min_wall
    ways = [f"set bore_radius to at most {told(bore_limit, 'mm', up=False)}{beside}"] if bore_limit > 0 else []
    if 0 < segment < segment_height and not small:
        ways.append(f"set segment_height to at most {told(segment, 'mm', up=False)}")
    return ", or ".join(ways) or "make the segment lower and the bore narrower together"


def against_deflection(
    generatrix: float,
    span: float,
    line_load: float,
    modulus: float,
    second_moment: float,
    deflection: float,
    allowed: float,
) -> str:
    """The bearing span with which the cylinder is stiff enough, and how much stiffer its section has to be."""

    def beyond(distance: float) -> float:
        return float(beam.deflection(line_load, generatrix, distance, modulus, second_moment)) - allowed

    stiffer = f"a section of {told(deflection / allowed, '1', up=True)} times this second moment is needed, by a narrower bore or a lower segment"
    if not beyond(generatrix) < 0 < beyond(span):
        return stiffer
    return f"set bearing_span to at most {told(brentq(beyond, generatrix, span), 'mm', up=False)}; or {stiffer}"
