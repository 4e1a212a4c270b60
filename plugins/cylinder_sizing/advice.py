"""What to change where a check of the cylinder fails: numbers that pass once they are typed in, also all at once."""

from __future__ import annotations

from math import pi

from diecut_report.api import Phrase, joined, phrase, told
from diecut_report.plugins.cylinder_sizing import beam

ROUNDING = 1e-9  # relative


def against_radius(radius_exact: float, radius: float, working_length: float, segment_height: float) -> str:
    """Radius, or segment, with which the circumference beside the flat is the working length."""
    larger = Phrase(
        "set radius to at least {radius_exact}, or leave it out", radius_exact=told(radius_exact, "mm", up=True)
    )
    if radius <= working_length / (2 * pi):
        return Phrase("{larger}; no segment is so low that {radius} would do", larger=larger, radius=told(radius, "mm"))
    return Phrase(
        "{larger}; or set segment_height to at most {segment_height}",
        larger=larger,
        segment_height=told(segment_height, "mm", up=False),
    )


def against_thin_wall(
    bore_limit: float, radius_exact: float, radius: float, segment_height: float, bore_radius: float, min_wall: float
) -> str:
    """Bore, or segment, that keeps the wall; with a radius that is too small, those of the exact one."""
    small = radius < radius_exact * (1 - ROUNDING)
    beside = (
        Phrase(", with a radius of at least {radius_exact}", radius_exact=told(radius_exact, "mm", up=True))
        if small
        else ""
    )
    segment = max(radius, radius_exact) - bore_radius - min_wall
    ways = (
        [
            Phrase(
                "set bore_radius to at most {bore_limit}{beside}",
                bore_limit=told(bore_limit, "mm", up=False),
                beside=beside,
            )
        ]
        if bore_limit > 0
        else []
    )
    if 0 < segment < segment_height and not small:
        ways.append(Phrase("set segment_height to at most {segment}", segment=told(segment, "mm", up=False)))
    return joined(ways, ", or ") or phrase("make the segment lower and the bore narrower together")


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

    stiffer = Phrase(
        "a section of {deflection} times this second moment is needed, by a narrower bore or a lower segment",
        deflection=told(deflection / allowed, "1", up=True),
    )
    if not beyond(generatrix) < 0 < beyond(span):
        return stiffer
    from scipy.optimize import brentq  # slow to import, and not needed where nothing fails

    longest = told(brentq(beyond, generatrix, span), "mm", up=False)
    return Phrase("set bearing_span to at most {longest}; or {stiffer}", longest=longest, stiffer=stiffer)
