"""The comparison of the drives that are given: which is gentlest on the paper, by how much, and why."""

from __future__ import annotations

from typing import Any

from diecut_report.api import Binding, Case, Chapter, Choice, Step, Value, bind
from diecut_report.mechanics import common
from diecut_report.plugins.knife_drive import formulas
from diecut_report.plugins.knife_drive.advice import ADVICE
from diecut_report.plugins.knife_drive.working import (
    ALL,
    CRANK_ROCKER,
    CRANK_SLIDER,
    PLANETARY,
    SIGNATURE_BEYOND_DEPTH,
    Drive,
    Drives,
    grips,
    groups,
    keys,
    lacking,
)

COMPARED = (
    ("stroke", "H", "Stroke", "mm"),
    ("working_time", "t_w", "Duration of the working stroke", "ms"),
    ("contact_velocity", "V_t", "Speed at contact", "m/s"),
    ("acceleration_peak", "W_m", "Greatest acceleration in the working stroke", "m/s**2"),
    ("acceleration_end", "W_0", "Acceleration at the lowest point", "m/s**2"),
    ("end_factor", "k", "Factor of the acceleration at the lowest point", "1"),
    ("grip_size", "W_s", "Size of the acceleration in the grip", "m/s**2"),
)
# The first with the table at the edge's highest point, the second with rollers as fast as the knife
MAY_VANISH = ("contact_velocity", "grip_size")
PEAK, ALLOWED = "acceleration_peak", "allowable_paper_acceleration"


def _indexed(symbol: str, index: str) -> str:
    return f"{symbol}{',' if '_' in symbol else '_'}{index}"


def _is_best(drive: Drive, *, allowed: bool = False) -> Binding:
    """The condition that a drive's peak is the least one (and one that the paper stands)."""
    own, best = f"{drive.key}_{PEAK}", f"best_{PEAK}"
    if allowed:
        return bind(formulas.is_best_and_allowed, own=own, best=best, allowed=ALLOWED)
    return bind(common.is_at_most, smaller=own, greater=best)


def _least(drives: Drives) -> Binding:
    peaks = [f"{drive.key}_{PEAK}" for drive in drives]
    if len(peaks) == 2:
        return bind(common.smaller_of, first=peaks[0], second=peaks[1])
    return bind(formulas.least_of_three, first=peaks[0], second=peaks[1], third=peaks[2])


def _best(drives: Drives) -> tuple[Step, ...]:
    """The best of several drives, and its numbers."""
    given: dict[str, Any] = {"needs": keys(drives), "lacks": lacking(drives)}
    *first, last = drives
    words = {drive: f"the {drive.name} has the least acceleration" for drive in drives}
    cases = [Case(d.key, words[d], _is_best(d)) for d in first]
    least = Value(id=f"best_{PEAK}", symbol="W_m,best", unit="m/s**2", output=False, formula=_least(drives), **given,
                  description="Least of the greatest accelerations in the working stroke")  # fmt: skip
    best = Choice(id="best_drive", symbol="→", description="Drive that is gentlest on the paper", **given,
                  cases=(*cases, Case(last.key, words[last])))  # fmt: skip
    numbers = (
        Choice(id=f"best_{name}", symbol=_indexed(symbol, "best"), unit=unit, description=f"{title}, best drive",
               output=False, **given,
               cases=(*(Case(bind(common.same, quantity=f"{d.key}_{name}"), words[d], _is_best(d)) for d in first),
                      Case(bind(common.same, quantity=f"{last.key}_{name}"), words[last])))
        for name, symbol, title, unit in COMPARED if name != PEAK
    )  # fmt: skip
    return least, best, *numbers


def _ratios(drive: Drive) -> tuple[Step, ...]:
    """A drive's numbers to those of the best one, where there is another to compare it with."""
    return tuple(
        Value(id=f"{drive.key}_{name}_ratio", symbol=f"q_{symbol[0]}{symbol[2:]},{drive.letter}", source="this method",
              description=f"{title}: {drive.name} to best drive", needs=keys(pair), lacks=lacks,
              exists=bind(formulas.holds, flag=f"best_{name}") if name in MAY_VANISH else None,
              formula=bind(common.quotient, quantity=f"{drive.key}_{name}", by=f"best_{name}"))
        for name, symbol, title, _ in COMPARED
        for pair, lacks in _with_another(drive)
    )  # fmt: skip


def _with_another(drive: Drive) -> list[tuple[Drives, tuple[str, ...]]]:
    """Groups of drives, one of which is always given where this one and another are: each with what it must lack."""
    one, two = (d for d in ALL if d is not drive)
    return [((drive, one), ()), ((drive, two), (one.key,))]


def _verdict(drives: Drives) -> Choice:
    """In words: which drive, and whether the paper stands it."""
    kept = [Case(f"the {d.name} is gentlest on the paper, and its acceleration is allowed",
                 f"the {d.name} has the least acceleration, and it is allowed", _is_best(d, allowed=True)) for d in drives]  # fmt: skip
    broken = [(f"the {d.name} is gentlest on the paper, but its acceleration, too, is above the allowed one",
               f"the {d.name} has the least acceleration, but it is above the allowed one", d) for d in drives]  # fmt: skip
    text, words, _ = broken[-1]
    cases = (*kept, *(Case(text, words, _is_best(d)) for text, words, d in broken[:-1]), Case(text, words))
    return Choice(
        id="verdict", symbol="→", description="Verdict", needs=keys(drives), lacks=lacking(drives), cases=cases
    )


def _alone(drive: Drive) -> tuple[Step, ...]:
    """A drive that is given alone is the best one."""
    given: dict[str, Any] = {"needs": (drive.key,), "lacks": lacking((drive,))}
    stands = bind(common.is_at_most, smaller=f"{drive.key}_{PEAK}", greater=ALLOWED)
    return (
        Choice(id="best_drive", symbol="→", description="Drive that is gentlest on the paper", **given,
               cases=(Case(drive.key, "the only drive that is given, and its acceleration is allowed", stands),
                      Case(drive.key, "the only drive that is given, though its acceleration is above the allowed one"))),
        Choice(id="verdict", symbol="→", description="Verdict", **given,
               cases=(Case(f"only the {drive.name} is given; its acceleration is allowed", "its acceleration is allowed", stands),
                      Case(f"only the {drive.name} is given; its acceleration is above the allowed one", "it is not allowed"))),
    )  # fmt: skip


SEVERAL = groups(least=2)

BEST = Chapter(
    "Comparison",
    text="The best drive is the one with the least greatest acceleration in the working stroke; ratios are to its numbers.",
    steps=(
        SIGNATURE_BEYOND_DEPTH,
        *(grips(drive) for drive in ALL),
        *ADVICE,
        *(step for drive in ALL for step in _alone(drive)),
        *(step for drives in SEVERAL for step in _best(drives)),
        *(step for drive in ALL for step in _ratios(drive)),
        *(_verdict(drives) for drives in SEVERAL),
    ),
)

OTHERS = (("acceleration_peak", "W_m", "Greatest acceleration in the working stroke", "m/s**2"), ("stroke", "H", "Stroke", "mm"),
          ("end_factor", "k", "Factor of the acceleration at the lowest point", "1"))  # fmt: skip


def _best_other() -> tuple[Step, ...]:
    """The numbers of the better one of the two other drives."""
    is_slider = bind(common.is_at_most, smaller=f"{CRANK_SLIDER.key}_{PEAK}", greater=f"{CRANK_ROCKER.key}_{PEAK}")
    both = tuple(
        Choice(id=f"other_{name}", symbol=_indexed(symbol, "other"), unit=unit, description=f"{title}, best other drive", output=False,
               needs=(PLANETARY.key, CRANK_SLIDER.key, CRANK_ROCKER.key),
               cases=(Case(bind(common.same, quantity=f"{CRANK_SLIDER.key}_{name}"), "the crank-slider is the gentler one", is_slider),
                      Case(bind(common.same, quantity=f"{CRANK_ROCKER.key}_{name}"), "the crank-rocker is the gentler one")))
        for name, symbol, title, unit in OTHERS
    )  # fmt: skip
    single = tuple(
        Value(id=f"other_{name}", symbol=_indexed(symbol, "other"), unit=unit, description=f"{title}, other drive", output=False,
              needs=(PLANETARY.key, drive.key), lacks=lacking((PLANETARY, drive)),
              formula=bind(common.same, quantity=f"{drive.key}_{name}"))
        for drive in (CRANK_SLIDER, CRANK_ROCKER) for name, symbol, title, unit in OTHERS
    )  # fmt: skip
    return both + single


def _of_planetary(lacks: tuple[str, ...], *pair: str) -> tuple[Step, ...]:
    """Why the planetary drive differs from the best other one: its acceleration is stroke times factor times ω²/2."""
    given: dict[str, Any] = {"needs": pair, "lacks": lacks}

    def ratio(name: str, symbol: str, title: str, of: str) -> Value:
        return Value(id=name, symbol=symbol, description=f"{title}: planetary drive to best other drive", source="this method", **given,
                     formula=bind(common.quotient, quantity=f"{PLANETARY.key}_{of}", by=f"other_{of}"))  # fmt: skip

    return (
        ratio("acceleration_ratio_planetary", "q_W", "Greatest acceleration", PEAK),
        ratio("stroke_ratio_planetary", "q_H", "Stroke", "stroke"),
        ratio("factor_ratio_planetary", "q_k", "Factor of the acceleration at the lowest point", "end_factor"),
        Choice(id="reason", symbol="→", description="What makes the planetary drive's acceleration differ", **given,
               cases=(Case("mostly its stroke", "the strokes differ more than the factors of the drives",
                           bind(formulas.is_by_stroke, stroke_ratio="stroke_ratio_planetary", factor_ratio="factor_ratio_planetary")),
                      Case("mostly the kind of drive", "the factors of the drives differ more than the strokes"))),
    )  # fmt: skip


WHY = Chapter(
    "Why the drives differ",
    text="At the lowest point the acceleration is W₀ = k·H·ω₁²/2: stroke H times a factor k of the drive, which is 1 for the planetary drive and "
    "1 + r/l for the crank-slider. With usual links the factors are near 1, so at equal stroke the drives differ little; a shorter stroke at the "
    "same working depth lowers the acceleration in proportion.",
    needs=(PLANETARY.key,),
    absent="The planetary drive against the others: there is no block planetary.",
    steps=(
        *_best_other(),
        *_of_planetary((), PLANETARY.key, CRANK_SLIDER.key),
        *_of_planetary((CRANK_SLIDER.key,), PLANETARY.key, CRANK_ROCKER.key),
    ),
)


def _grip(drives: Drives) -> Choice:
    return Choice(
        id="grip_verdict", symbol="→", description="What asks more of the paper", needs=keys(drives), lacks=lacking(drives),
        cases=(Case("the grip of the rollers, not the knife", "with the best drive the grip accelerates the signature more than the knife does",
                    bind(common.is_below, smaller=f"best_{PEAK}", greater="best_grip_size")),
               Case("the knife, not the grip of the rollers", "with the best drive the knife accelerates the signature at least as much")),
    )  # fmt: skip


GRIP = Chapter(
    "Knife and rollers",
    text="No drive spares the signature the jump from the knife's speed, which falls to nothing at the lowest point, to that of the rollers.",
    steps=tuple(_grip(drives) for drives in SEVERAL),
)
