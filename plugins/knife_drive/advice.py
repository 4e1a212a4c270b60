"""What a message advises: rounded so that it is enough as printed, and no drive's check is spoilt that passes now."""

from __future__ import annotations

from functools import partial
from math import inf, sqrt
from typing import NamedTuple

from diecut_report.api import Phrase, Steps, joined, outward, phrase, told
from diecut_report.plugins.knife_drive.working import ALL, Drives, groups, keys, lacking

ENOUGH = 1e-9  # share by which a limit itself is kept clear of
MACHINE = ("cylinder_rate", "roller_ratio", "roller_velocity", "grip_time", "allowable_grip_acceleration")
TIMES = ("signature_interval", "roller_time")
SHORTER = phrase("a drive with a shorter working stroke")
Range = tuple[float, float]


class Machine(NamedTuple):
    """The rollers, and of each drive the speed with which gripping begins and, with a signature's length, the working time."""

    rate: float
    ratio: float
    rollers: float
    grip_time: float
    allowed: float
    speeds: tuple[float, ...]
    interval: float = inf
    roller_time: float = 0.0
    working: tuple[float, ...] = ()

    def gentle(self, speed: float) -> Range:
        """Speeds of the rollers with which the grip is gentle enough for a signature of this speed."""
        change = self.allowed * self.grip_time
        return max(speed - change, 0.0), speed + change

    def in_time(self, working: float) -> Range:
        """Speeds of the rollers with which the table is free in time after this working time."""
        left = self.interval - working
        return (self.rollers * self.roller_time / left if left > 0 else inf), inf

    def ratios(self, own: Range) -> str:
        """Roller ratios for a range of the rollers' speeds, in words: good for all checks, or else for those that pass now, too.

        Empty where there are none.
        """
        others = [*map(self.gentle, self.speeds), *map(self.in_time, self.working)]
        passing = [one for one in others if one[0] <= self.rollers <= one[1]]
        return self._ratio([own, *others]) or self._ratio([own, *passing])

    def _ratio(self, ranges: list[Range]) -> str:
        """Roller ratios that bring the rollers into all of several ranges of speeds, in words; empty where none do."""
        low, high = max(least for least, _ in ranges), min(most for _, most in ranges)
        share = self.ratio / self.rollers
        first, last = outward(low * share * (1 + ENOUGH), up=True), outward(high * share * (1 - ENOUGH), up=False)
        if first > last or first == inf or last <= 0:
            return ""
        if last == inf:
            return Phrase("a roller_ratio of at least {first}", first=told(first, "1"))
        start = Phrase("from {first} to", first=told(first, "1")) if first else phrase("of at most")
        return f"a roller_ratio {start} {told(last, '1')}"


def slower(rate: float, acceleration: float, allowed: float) -> str:
    """The rate at which an acceleration that grows with its square is allowed, in words."""
    return Phrase(
        "a cylinder_rate of at most {rate}",
        rate=told(rate * sqrt(allowed / acceleration) * (1 - ENOUGH), "1/h", up=False),
    )


def paper(rate: float, acceleration: float, allowed: float) -> str:
    """What lowers the acceleration of the paper by the knife."""
    return Phrase("take {slower}, or a drive with a shorter stroke", slower=slower(rate, acceleration, allowed))


def grip(own: int, scales: bool, machine: Machine) -> str:
    """What makes the grip of the rollers gentler; ``scales`` says that the knife's speed follows the machine's."""
    ways = [machine.ratios(machine.gentle(machine.speeds[own]))]
    if scales:
        size = abs(machine.rollers - machine.speeds[own]) / machine.grip_time
        ways.append(slower(machine.rate, size, machine.allowed))
    told_ways = joined(filter(None, ways), " or ")
    return (
        Phrase("take {told_ways}; a greater grip_angle helps too", told_ways=told_ways)
        if told_ways
        else phrase("make grip_angle greater")
    )


def time_on_table(own: int, machine: Machine) -> str:
    """What frees the table in time."""
    needed = machine.in_time(machine.working[own])
    if needed[0] == inf:
        return Phrase("the knife's working stroke alone takes as long: take {shorter}", shorter=SHORTER)
    ratios = machine.ratios(needed)
    if ratios:
        return Phrase("take {ratios}, or {shorter}", ratios=ratios, shorter=SHORTER)
    return Phrase(
        "faster rollers would grip it too hard: take {shorter}, or a greater grip_angle and then faster rollers",
        shorter=SHORTER,
    )


def links(crank: float, coupler: float, rocker: float, frame: float) -> str:
    """What makes four links a crank-rocker."""
    *others, longest = sorted((coupler, rocker, frame))
    room = min(others[0], sum(others) - longest)
    if room > 0:
        return Phrase("make the crank shorter than {room}", room=told(room, "mm", up=False))
    return Phrase(
        "make the longest of the other links shorter than the two others together, {others}",
        others=told(sum(others), "mm", up=False),
    )


def _of(group: Drives, timed: bool, numbers: tuple[float, ...]) -> Machine:
    """The machine of the numbers that ``_takes`` names."""
    first, count = len(MACHINE), len(group)
    rate, ratio, rollers, grip_time, allowed = numbers[:first]
    machine = Machine(rate, ratio, rollers, grip_time, allowed, numbers[first : first + count])
    if not timed:
        return machine
    interval, roller_time, *working = numbers[first + count :]
    return machine._replace(interval=interval, roller_time=roller_time, working=tuple(working))


def _takes(group: Drives, timed: bool) -> tuple[str, ...]:
    speeds, times = (tuple(f"{d.key}_{name}" for d in group) for name in ("grip_velocity", "working_time"))
    return (*MACHINE, *speeds, *((*TIMES, *times) if timed else ()))


def _grip_words(group: Drives, own: int, timed: bool, scales: bool, *numbers: float) -> str:
    return grip(own, scales, _of(group, timed, numbers))


def _time_words(group: Drives, own: int, *numbers: float) -> str:
    return time_on_table(own, _of(group, True, numbers))


def _in_group(group: Drives, own: int) -> Steps:
    """The advice on one drive's grip and time in a group of drives, for what may be given besides."""
    drive, length, speed = group[own].key, ("signature_length",), ("grip_speed",)
    steps = Steps()
    for timed in (False, True):
        for scales in (False, True):
            steps.words(
                f"{drive}_grip_advice",
                partial(_grip_words, group, own, timed, scales),
                _takes(group, timed),
                needs=(*keys(group), *(length if timed else ()), *(() if scales else speed)),
                lacks=(*lacking(group), *(() if timed else length), *(speed if scales else ())),
            )
    steps.words(
        f"{drive}_time_advice",
        partial(_time_words, group, own),
        _takes(group, True),
        needs=(*keys(group), *length),
        lacks=lacking(group),
    )
    return steps


ADVICE = Steps()
for drive in ALL:
    takes = ("cylinder_rate", f"{drive.key}_acceleration_peak", "allowable_paper_acceleration")
    ADVICE.words(f"{drive.key}_paper_advice", paper, takes, needs=(drive.key,))
ADVICE.add(_in_group(group, own) for group in groups() for own in range(len(group)))
