"""What to change, in words with values that pass: dwell and sweeps, the sheet's acceleration, module, roller and cycles."""

from __future__ import annotations

from math import sqrt

from diecut_report.api import Phrase, below, joined, phrase, si, told
from diecut_report.plugins.cam_gear_transport import formulas

MODULES = (20, 16, 12, 10, 8, 6, 5, 4, 3, 2.5, 2, 1.5, 1.25, 1)  # mm, the usual ones
UNDERCUT = 17  # least teeth of a gear without undercut


def angle_below(angle: float) -> str:
    """An angle in print, rounded down to four digits, and less than itself."""
    return f"{below(angle / si(1, 'deg')):g}°"


def leaves_return(dwell: float, sweep: float) -> str:
    """Words on what leaves the return more time."""
    either = Phrase("a dwell_angle of at most {angle_below}", angle_below=angle_below(dwell)) if dwell > 0 else ""
    other = (
        Phrase("a sector_stop_sweep of at most {angle_below} with this dwell", angle_below=angle_below(sweep))
        if sweep > 0
        else ""
    )
    return joined(filter(None, (either, other)), " or ") or phrase(
        "a shorter dwell_angle with a smaller sector_stop_sweep"
    )


def leaves_return_with_teeth(dwell: float, sweep: float) -> str:
    """The same where gear and sector have whole teeth."""
    return Phrase("{leaves_return} (with these teeth)", leaves_return=leaves_return(dwell, sweep))


def slower(cycles: float, share: float) -> str:
    """Words on the cycles that keep a limit, to which there is so large a share of the present ones."""
    return Phrase("a cycles_per_hour of at most {cycles}", cycles=told(cycles * share, "1/h", up=False))


def gentler_grip(cycles: float, force: float, held: float) -> str:
    """Words on the cycles at which the grippers hold the sheet, whose pull grows with their square."""
    return slower(cycles, sqrt(held / force))


def gentler_sheet(
    peak: float,
    allowed: float,
    dwell_share: float,
    held: float,
    stop: float,
    peak_velocity: float,
    least_return: float,
    cycles: float,
) -> str:
    """Words on the sweeps of stop and start, and the cycles, that keep the sheet's allowed acceleration.

    A narrow sweep makes the stop hard (γ/t²), a wide one hurries the return: from where the stop is soft enough to where the
    return is still slow enough the sheet is within its limit.
    """
    left, rate = 1 - dwell_share, peak_velocity * dwell_share / held
    limit = max(1 / (stop * rate**2), (held + stop) / (left - rate * stop) ** 2) * allowed / peak
    lowest, slow = 1 / (rate**2 * limit), slower(cycles, sqrt(allowed / peak))
    highest = min(_return_limit(held, left, rate, limit), (left - least_return) / rate)
    up, down = told(lowest, "deg", up=True), angle_below(highest) if highest > 0 else ""
    if down and float(up[:-1]) <= float(down[:-1]):
        return Phrase("take a sector_stop_sweep from {up} to {down}, or {slow}", up=up, down=down, slow=slow)
    return Phrase(
        "no sector_stop_sweep alone keeps it with this dwell; take {slow}, or a shorter dwell_angle or step", slow=slow
    )


def _return_limit(held: float, left: float, rate: float, limit: float) -> float:
    """Sweep of stop and start at which the return reaches its limit: held + γ = limit·(left − rate·γ)²; below zero without one."""
    if limit * left**2 <= held:
        return -1.0
    half = limit * left * rate + 0.5
    return (limit * left**2 - held) / (half + sqrt(half**2 - limit * rate**2 * (limit * left**2 - held)))


def finer_teeth(center_distance: float, sweep: float, dwell: float) -> str:
    """Words on a usual module with which gear and sector have whole teeth and the gear has no undercut."""
    for module in MODULES:
        together = formulas.teeth_together(center_distance, module / 1000)
        teeth = formulas.gear_teeth(together, sweep, dwell)
        if formulas.is_whole(together) and teeth >= UNDERCUT and formulas.other_teeth(together, teeth) >= 1:
            return Phrase("a module of {module} mm", module=f"{module:g}")
    return phrase("a smaller module")


def smaller_roller(least_radius: float, tangent_distance: float) -> str:
    """Words on the roller that neither undercuts its profile nor makes it cross itself."""
    if tangent_distance <= 0:
        return phrase("no roller passes with these arms")
    return Phrase(
        "take a roller_radius of at most {least_radius} mm",
        least_radius=f"{below(min(least_radius, tangent_distance) * 1000):g}",
    )


def softer_contact(pressure: float, allowed: float, width: float, cycles: float) -> str:
    """Words on the width of roller, and the cycles, that keep the allowed pressure: all forces grow with the square of the speed."""
    wide = told(width * (pressure / allowed) ** 2, "mm", up=True)
    return Phrase(
        "take a roller_width of at least {wide}, or {slower}, or a lighter conveyor",
        wide=wide,
        slower=slower(cycles, allowed / pressure),
    )
