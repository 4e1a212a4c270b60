"""What the cyclogram tells of the press: which lines a clutch takes out of step, and all times at the rate that the gears give."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from diecut_report.api import Cell, GivenMechanism, ListedColumn, Phrase, Refusal, named, phrase

TIMES = (
    ListedColumn("what", "Quantity"), ListedColumn("time", "At the productivity", "t", "ms"),
    ListedColumn("actual_time", "At the rate given by the gears", "t_a", "ms"),
)  # fmt: skip
DWELL, MOVING = "dwell", "moving"  # phases of a Geneva wheel
PHASE, MARGIN_START, MARGIN_END, PHASE_TIME = 1, 5, 6, 7  # columns of the cyclogram's tables


def lines_out_of_step(drives: tuple[str, ...], single_position: bool, timing: GivenMechanism) -> float:
    """Return how many lines lose their offset to the others where the clutch engages; Refusal where one is named that is not a line."""
    lines = timing.texts("lines.mechanism")
    strange = next((name for name in drives if name not in lines), None)
    if strange is not None:
        raise Refusal(
            "clutch_drives",
            Phrase(
                "names {strange}, which is not a line of {name}; these are {lines}",
                strange=strange,
                name=timing.name,
                lines=named(lines, ", "),
            ),
        )
    return 0.0 if single_position or set(drives) == set(lines) else float(len(set(drives)))


def held_in_dwell(timing: GivenMechanism, wheel: GivenMechanism) -> int:
    """Return how many interlocks hold something within the dwell of the wheel."""
    return len(_dwell_margins(timing, wheel))


def dwell_margin(timing: GivenMechanism, wheel: GivenMechanism) -> float:
    """Return the least angle of the wheel's crank between an end of its dwell and what must lie within, rad; 0 where nothing must."""
    return min(_dwell_margins(timing, wheel), default=0.0)


def _dwell_margins(timing: GivenMechanism, wheel: GivenMechanism) -> list[float]:
    """The margins of what must lie within the dwell, or apart from the motion, of the wheel, whichever of both is named first."""
    turns = dict(zip(timing.texts("lines.mechanism"), timing.parts("line_turns"), strict=True))
    sides = (timing.texts(f"interlocks.{side}") for side in ("phase", "within", "apart_from"))
    rests = [
        _of(within, wheel.name) == DWELL or (apart and MOVING in (_of(phase, wheel.name), _of(apart, wheel.name)))
        for phase, within, apart in zip(*sides, strict=True)
    ]
    return [
        turns[wheel.name] * margin for rest, margin in zip(rests, timing.parts("margin_least"), strict=True) if rest
    ]


def _of(named: str, line: str) -> str:
    """The phase that a name means, be it of all its turns or of a numbered one; empty where it is another line's."""
    home, _, phase = named.partition(".")
    return phase.partition(".")[0] if home == line else ""


def is_coupled(drives: tuple[str, ...], drive: GivenMechanism) -> float:
    """Return whether the clutch drives the cylinder."""
    return float(drive.name in drives)


def lines_beside(drives: tuple[str, ...], drive: GivenMechanism) -> float:
    """Return how many lines a clutch drives beside the cylinder's."""
    return float(len({*drives} - {drive.name}))


def listed(drives: tuple[str, ...]) -> str:
    """Return the lines that a clutch drives, by their names."""
    return Phrase("{names}", names=", ".join(drives))  # a text alone would be translated where it is a word, too


def times(given: Mapping[str, Any]) -> Iterator[tuple[Cell, ...]]:
    """Return the times of a sheet, of all phases and of all margins, at the productivity and at the actual rate."""
    timing: GivenMechanism = given["timing"]
    slower = float(given["productivity"][0, 0] / given["actual_rate"][0, 0])
    for what, time in _times(timing):
        yield what, time, None if time is None else time * slower


def _times(timing: GivenMechanism) -> Iterator[tuple[str, float | None]]:
    yield phrase("sheet"), timing.number("sheet_time")
    yield phrase("common period"), timing.number("period_time")
    for row in timing.listing("main_phases"):
        yield phrase(str(row[PHASE])), _number(row[PHASE_TIME])
    for row in timing.listing("margins"):
        yield Phrase("{row}, margin at the start", row=row[0]), _number(row[MARGIN_START])
        yield Phrase("{row}, margin at the end", row=row[0]), _number(row[MARGIN_END])


def _number(cell: Cell) -> float | None:
    return cell if isinstance(cell, float) else None
