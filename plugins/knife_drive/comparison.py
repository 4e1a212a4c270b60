"""The comparison of the drives that are given: which is gentlest on the paper, by how much, and why."""

from __future__ import annotations

from functools import reduce
from textwrap import wrap
from typing import Any

import numpy as np

from diecut_report.api import (
    Chapter,
    Phrase,
    Shape,
    Steps,
    View,
    box,
    case,
    choice,
    inner,
    m,
    phrase,
    told,
    value,
)
from diecut_report.plugins.knife_drive import working
from diecut_report.plugins.knife_drive.working import (
    ALL,
    CRANK_ROCKER,
    CRANK_SLIDER,
    PLANETARY,
    SIGNATURE_BEYOND_DEPTH,
    DriveKind,
    Drives,
    grips,
    groups,
    keys,
    lacking,
)

# fmt: off

LINES = (
    (phrase("Working stroke"), "working_angle", "deg"),
    (phrase("Its duration"), "working_time", "ms"),
    (phrase("Speed at contact"), "contact_velocity", "m/s"),
    (phrase("Maximum acceleration"), "acceleration_peak", "m/s**2"),
    (phrase("Acceleration at the end"), "acceleration_end", "m/s**2"),
    (phrase("Stroke"), "stroke", "mm"),
    (phrase("Factor"), "end_factor", "1"),
    (phrase("Acceleration in the grip"), "grip_size", "m/s**2"),
    (phrase("Time on the table"), "table_time", "ms"),
)
FIRST, OTHER, HIGH = 1.5, 1.6, 0.3  # widths of the columns, height of a line
GAP = 0.06  # between boxes
LETTERS = 15  # on a width of one


def table(view: View) -> list[Shape]:
    """Boxes of a table."""
    drives = [drive for drive in ALL if f"{drive.key}_stroke" in view]
    rows = [("", [drive.name for drive in drives])]
    rows += [(title, [_cell(view, f"{drive.key}_{name}", unit) for drive in drives]) for title, name, unit in LINES
             if f"{drives[0].key}_{name}" in view]  # fmt: skip
    shapes = []
    for index, (title, cells) in enumerate(rows):
        y, role = -index * HIGH, "body" if index == 0 else "outline"
        shapes.append(box((FIRST / 2, y), FIRST - GAP, HIGH - GAP, [title] if title else ["Drive"], "body"))
        shapes += [
            box((FIRST + (i + 0.5) * OTHER, y), OTHER - GAP, HIGH - GAP, [cell], role) for i, cell in enumerate(cells)
        ]
    width = FIRST + OTHER * len(drives)
    words = _verdicts(view)
    high = HIGH * sum(len(wrap(text, int(width * LETTERS))) for text in words)
    below = -HIGH * (len(rows) - 0.5) - high / 2
    return [*shapes, box((width / 2, below), width - GAP, high - GAP, words, "body")]


def _verdicts(view: View) -> list[str]:
    """Which drive is best, and why the planetary drive differs from the best other one."""
    found: list[str] = [Phrase("Verdict: {verdict}.", verdict=view.word("verdict"))]
    if "acceleration_ratio_planetary" in view:
        stroke, factor = view["stroke_ratio_planetary"], view["factor_ratio_planetary"]
        found.append(
            Phrase(
                "Planetary drive compared with the best other one at the end: {stroke} = {stroke_2} (stroke) × "
                "{factor} (factor); {reason}.",
                stroke=f"{stroke * factor:.2f}",
                stroke_2=f"{stroke:.2f}",
                factor=f"{factor:.2f}",
                reason=view.word("reason"),
            )
        )
    return found


def _cell(view: View, name: str, unit: str) -> str:
    """A number, and its ratio to the best drive's where there is one; the time on the table beside what there is of it."""
    if name.endswith("table_time"):
        return Phrase(
            "{time} of {interval}", time=told(view[name], unit), interval=told(view["signature_interval"], unit)
        )
    ratio = view.get(f"{name}_ratio", 0.0)
    return f"{told(view[name], unit)} (× {ratio:.2f})" if ratio else told(view[name], unit)


COMPARED = (
    ("stroke", "H", "Stroke", "mm"),
    ("working_time", "t_w", "Duration of the working stroke", "ms"),
    ("contact_velocity", "V_t", "Speed at contact", "m/s"),
    ("acceleration_peak", "a_m", "Maximum acceleration in the working stroke", "m/s**2"),
    ("acceleration_end", "a_0", "Acceleration at the lowest point", "m/s**2"),
    ("end_factor", "k", "Factor of the acceleration at the lowest point", "1"),
    ("grip_size", "a_s", "Absolute acceleration in the grip", "m/s**2"),
)
# The first with the table at the edge's highest point, the second with rollers as fast as the knife
MAY_VANISH = ("contact_velocity", "grip_size")
PEAK, ALLOWED = "acceleration_peak", "allowable_paper_acceleration"


def _indexed(symbol: str, index: str) -> str:
    return f"{symbol}{',' if '_' in symbol else '_'}{index}"


def _is_best(drive: DriveKind, *, allowed: bool = False) -> Any:
    """The condition that a drive's peak is the least one (and one that the paper stands)."""
    own, best = m[f"{drive.key}_{PEAK}"], m[f"best_{PEAK}"]
    if allowed:
        return (own <= best) & (best <= m[ALLOWED])
    return own <= best


def _least(drives: Drives) -> Any:
    return reduce(np.minimum, [m[f"{drive.key}_{PEAK}"] for drive in drives])


def _best(chapter: Steps, drives: Drives) -> None:
    """The best of several drives, and its numbers."""
    given: dict[str, Any] = {"needs": keys(drives), "lacks": lacking(drives)}
    *first, last = drives
    words = {drive: f"the {drive.name} has the lowest acceleration" for drive in drives}
    chapter[f"best_{PEAK}"] = inner(_least(drives), **given), "a_m,best", "m/s**2", "Lowest of the maximum accelerations in the working stroke"
    chapter.best_drive = (choice(*(case(d.key, words[d], _is_best(d)) for d in first), case(last.key, words[last]), **given), "→", "1",
        "Drive with the lowest acceleration of the paper")
    for name, symbol, title, unit in COMPARED:
        if name != PEAK:
            chapter[f"best_{name}"] = (choice(*(case(m[f"{d.key}_{name}"], words[d], _is_best(d)) for d in first),
                case(m[f"{last.key}_{name}"], words[last]), output=False, **given), _indexed(symbol, "best"), unit, f"{title}, best drive")


def _ratios(chapter: Steps, drive: DriveKind) -> None:
    """A drive's numbers to those of the best one, where there is another to compare it with."""
    for name, symbol, title, _ in COMPARED:
        for pair, lacks in _with_another(drive):
            chapter[f"{drive.key}_{name}_ratio"] = (value(m[f"{drive.key}_{name}"] / m[f"best_{name}"],
                exists=working.holds.of(flag=m[f"best_{name}"]) if name in MAY_VANISH else None, needs=keys(pair), lacks=lacks),
                f"q_{symbol[0]}{symbol[2:]},{drive.letter}", "1", f"{title}: {drive.name} to best drive", "this method")


def _with_another(drive: DriveKind) -> list[tuple[Drives, tuple[str, ...]]]:
    """Groups of drives, one of which is always given where this one and another are: each with what it must lack."""
    one, two = (d for d in ALL if d is not drive)
    return [((drive, one), ()), ((drive, two), (one.key,))]


def _verdict(chapter: Steps, drives: Drives) -> None:
    """In words: which drive, and whether the paper stands it."""
    kept = [case(f"the {d.name} is gentlest on the paper, and its acceleration is allowed",
    f"the {d.name} has the lowest acceleration, and it is allowed", _is_best(d, allowed=True)) for d in drives]  # fmt: skip
    broken = [(f"the {d.name} is gentlest on the paper, but its acceleration, too, is above the allowed one",
               f"the {d.name} has the lowest acceleration, but it is above the allowed one", d) for d in drives]  # fmt: skip
    text, words, _ = broken[-1]
    cases = (*kept, *(case(text, words, _is_best(d)) for text, words, d in broken[:-1]), case(text, words))
    chapter.verdict = choice(*cases, needs=keys(drives), lacks=lacking(drives)), "→", "1", "Verdict"


def _alone(chapter: Steps, drive: DriveKind) -> None:
    """A drive that is given alone is the best one."""
    given: dict[str, Any] = {"needs": (drive.key,), "lacks": lacking((drive,))}
    stands = m[f"{drive.key}_{PEAK}"] <= m[ALLOWED]
    chapter.best_drive = (choice(case(drive.key, "the only drive that is given, and its acceleration is allowed", stands),
        case(drive.key, "the only drive that is given, though its acceleration is above the allowed one"), **given), "→", "1",
        "Drive with the lowest acceleration of the paper")
    chapter.verdict = (choice(case(f"only the {drive.name} is given; its acceleration is allowed", "its acceleration is allowed", stands),
        case(f"only the {drive.name} is given; its acceleration is above the allowed one", "it is not allowed"), **given), "→", "1", "Verdict")


SEVERAL = groups(least=2)

best = Chapter("Comparison", text="The best drive is the one with the lowest maximum acceleration in the working stroke; ratios refer to its values.")
best.add(SIGNATURE_BEYOND_DEPTH)
best.add(grips(drive) for drive in ALL)
for drive in ALL:
    _alone(best, drive)
for drives in SEVERAL:
    _best(best, drives)
for drive in ALL:
    _ratios(best, drive)
for drives in SEVERAL:
    _verdict(best, drives)

OTHERS = (("acceleration_peak", "a_m", "Maximum acceleration in the working stroke", "m/s**2"), ("stroke", "H", "Stroke", "mm"),
          ("end_factor", "k", "Factor of the acceleration at the lowest point", "1"))


def _best_other(chapter: Steps) -> None:
    """The numbers of the better one of the two other drives."""
    is_slider = m[f"{CRANK_SLIDER.key}_{PEAK}"] <= m[f"{CRANK_ROCKER.key}_{PEAK}"]
    for name, symbol, title, unit in OTHERS:
        chapter[f"other_{name}"] = (choice(case(m[f"{CRANK_SLIDER.key}_{name}"], "the crank-slider is the gentler one", is_slider),
            case(m[f"{CRANK_ROCKER.key}_{name}"], "the crank-rocker is the gentler one"), needs=(PLANETARY.key, CRANK_SLIDER.key, CRANK_ROCKER.key),
            output=False), _indexed(symbol, "other"), unit, f"{title}, best other drive")
    for drive in (CRANK_SLIDER, CRANK_ROCKER):
        for name, symbol, title, unit in OTHERS:
            chapter[f"other_{name}"] = (inner(m[f"{drive.key}_{name}"], needs=(PLANETARY.key, drive.key), lacks=lacking((PLANETARY, drive))),
                _indexed(symbol, "other"), unit, f"{title}, other drive")


def _of_planetary(chapter: Steps, lacks: tuple[str, ...], *pair: str) -> None:
    """Why the planetary drive differs from the best other one: its acceleration is stroke times factor times ω²/2."""
    given: dict[str, Any] = {"needs": pair, "lacks": lacks}

    def ratio(name: str, symbol: str, title: str, of: str) -> None:
        chapter[name] = (value(m[f"{PLANETARY.key}_{of}"] / m[f"other_{of}"], **given), symbol, "1", f"{title}: planetary drive to best other drive",
            "this method")

    ratio("acceleration_ratio_planetary", "q_W", "Maximum acceleration", PEAK)
    ratio("stroke_ratio_planetary", "q_H", "Stroke", "stroke")
    ratio("factor_ratio_planetary", "q_k", "Factor of the acceleration at the lowest point", "end_factor")
    chapter.reason = (choice(case("mostly its stroke", "the strokes differ more than the factors of the drives",
        np.maximum(m.stroke_ratio_planetary, 1 / m.stroke_ratio_planetary) >= np.maximum(m.factor_ratio_planetary, 1 / m.factor_ratio_planetary)),
        case("mostly the kind of drive", "the factors of the drives differ more than the strokes"), **given), "→", "1",
        "Cause of the difference in the planetary drive's acceleration")


why = Chapter("Why the drives differ",
    text="At the lowest point the acceleration is a₀ = k·H·ω₁²/2: the stroke H times a factor k of the drive, which is 1 for the planetary drive "
        "and 1 + r/l for the crank-slider. With usual links the factors are near 1, so for equal strokes the drives differ little; a shorter stroke "
        "at the same working depth lowers the acceleration in proportion.", needs=(PLANETARY.key,),
    absent="The planetary drive against the others: there is no block planetary.")
_best_other(why)
_of_planetary(why, (), PLANETARY.key, CRANK_SLIDER.key)
_of_planetary(why, (CRANK_SLIDER.key,), PLANETARY.key, CRANK_ROCKER.key)

grip = Chapter("Knife and rollers",
    text="No drive spares the signature the jump from the knife's speed, which falls to zero at the lowest point, to that of the rollers.")
for drives in SEVERAL:
    grip.grip_verdict = (choice(case("the grip of the rollers, not the knife",
        "with the best drive the grip accelerates the signature more than the knife does", m[f"best_{PEAK}"] < m.best_grip_size),
        case("the knife, not the grip of the rollers", "with the best drive the knife accelerates the signature at least as much"),
        needs=keys(drives), lacks=lacking(drives)), "→", "1", "More severe for the paper")
