"""What to change, in words with values that pass: stiffness, duration of the rise, law of motion."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np

from diecut_report.api import Phrase, joined, outward, told
from diecut_report.mechanics.followers import peaks
from diecut_report.mechanics.motion_laws import LAWS
from diecut_report.plugins.elastic_follower.motion import STIFFEST

DIGITS = 4
SOUND = 1 - 1e-9  # share of a limit that a named value keeps
TRIED = 600  # stiffnesses above the given one


def keeps(law: str, ratio: float, damping: float, rise: float, residual: float) -> bool:
    """Whether a law keeps both limits with so many natural periods within the rise."""
    found = peaks(LAWS[law], ratio, damping)
    return bool(found.rise <= SOUND * rise and found.residual <= SOUND * residual)


def tuned(law: str, ratio: float, damping: float, rise: float, residual: float) -> Iterator[float]:
    """Numbers of natural periods above the machine's own with which both limits are kept, the least first."""
    tried = np.geomspace(ratio, STIFFEST, TRIED)[1:]
    found = peaks(LAWS[law], tried, damping)
    yield from tried[(found.rise <= SOUND * rise) & (found.residual <= SOUND * residual)]


def passing(unit: str, time: str) -> Callable[..., str]:
    """The words of advice for a rise by a law, with the units of stiffness and rise_time."""

    def words(
        law: str, stiffness: float, ratio: float, damping: float, lasts: float, rise: float, residual: float
    ) -> str:
        """Stiffness, rise_time or law with which both limits are kept, for one machine."""
        limits = (damping, rise, residual)
        told_ways = [
            *_stiffer(law, stiffness, ratio, limits, unit),
            *_slower(law, lasts, ratio, limits, time),
            *_other(law, ratio, limits),
        ]
        told_ways = told_ways or [*_both(law, stiffness, ratio, limits, unit)]
        if told_ways:
            return Phrase("take {told_ways}", told_ways=joined(told_ways, ", or "))
        return Phrase(
            "no stiffer drive up to λ = {stiffest} and no other law keeps both limits: allow more, or give "
            "the drive more damping",
            stiffest=STIFFEST,
        )

    return words


def _stiffer(law: str, stiffness: float, ratio: float, limits: tuple[float, float, float], unit: str) -> Iterator[str]:
    for wanted in tuned(law, ratio, *limits):
        found = outward(stiffness * (wanted / ratio) ** 2, up=True, digits=DIGITS)
        if keeps(law, ratio * float(np.sqrt(found / stiffness)), *limits):
            yield Phrase("a stiffness of {found}", found=told(found, unit, DIGITS))
            return


def _slower(law: str, lasts: float, ratio: float, limits: tuple[float, float, float], unit: str) -> Iterator[str]:
    for wanted in tuned(law, ratio, *limits):
        found = outward(lasts * wanted / ratio, up=True, digits=DIGITS)
        if unit == "1" and found > 1:
            return
        if keeps(law, ratio * found / lasts, *limits):
            yield Phrase("a rise_time of {found}", found=told(found, unit, DIGITS))
            return


def _other(law: str, ratio: float, limits: tuple[float, float, float]) -> Iterator[str]:
    others = [name for name in LAWS if name != law and keeps(name, ratio, *limits)]
    if others:
        best = min(others, key=lambda name: float(max(peaks(LAWS[name], ratio, limits[0]))) * LAWS[name].A)
        yield Phrase("motion_law: {best} with this drive", best=best)


def _both(law: str, stiffness: float, ratio: float, limits: tuple[float, float, float], unit: str) -> Iterator[str]:
    """Another law with the least stiffer drive, where nothing alone helps."""
    wanted = {name: next(tuned(name, ratio, *limits), np.inf) for name in LAWS if name != law}
    best = min(wanted, key=lambda name: wanted[name])
    if np.isfinite(wanted[best]):
        yield from (
            Phrase("motion_law: {best} with {stiffer}", best=best, stiffer=stiffer)
            for stiffer in _stiffer(best, stiffness, ratio, limits, unit)
        )
