"""A key that may be given in another kind of unit: a delay as an angle of the shaft, or as a time."""

from __future__ import annotations

from diecut_report.api import Chapter, InOtherUnit, Inputs, Mechanism, Quantity, computed


class Valve(Inputs):
    speed = Quantity("ω", "rpm", "Speed of the main shaft", gt=0)
    delay = Quantity("φ", "deg", "Delay of the valve, also as a time", ge=0, or_unit="ms")


def delay_angle(delay, speed):
    """A time passes by the speed; an angle stays. ``speed`` has the shape (variants, 1)."""
    return delay.value * speed if isinstance(delay, InOtherUnit) else 0 * speed + delay


timing = Chapter("Timing")
METHOD = "a delay that is a time is multiplied by the speed"
timing.delay_angle = computed(delay_angle, ("delay", "speed"), METHOD), "φ_d", "deg", "Angle by which the valve is late"

MECHANISM = Mechanism(
    kind="valve", version="1.0", title="Valve", summary="Delay of a valve.", inputs=Valve, chapters=(timing,)
)

PRESS = """
mechanisms:
  by_angle: {kind: valve, speed: 60 rpm, delay: 10 deg}
  by_time: {kind: valve, speed: 60 rpm, delay: 20 ms}
"""
GIVES = {"by_angle.delay_angle": "10 deg", "by_time.delay_angle": "7.2 deg"}
