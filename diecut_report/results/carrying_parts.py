"""The parts of a machine that carry load, with the calculation that rates each, and those that no method rates."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

from diecut_report.config.parts.model import Join, MachineParts, ShaftPart
from diecut_report.results.conclusion import governing
from diecut_report.results.drive_line_record import RatingRecord, State
from diecut_report.results.mechanism_record import CheckRecord
from diecut_report.results.model import OpenRecord, PartCountRecord
from diecut_report.text.phrases import Phrase, phrase

BODIES = ("crank", "rocker", "geneva_wheel", "clutch", "coupling", "brake", "cam")
"""Kinds of parts whose bodies no method rates."""


@dataclass(frozen=True)
class CarryingPart:
    """Hold a part: what it is called, where it stands in the file, the calculation that would rate it, and who accepts it without.

    ``is_own`` tells which checks of that calculation are the part's own, where it rates several parts.
    """

    name: str
    path: str
    calculation: str
    accepted: str = ""
    is_own: Callable[[CheckRecord], bool] = lambda check: True


def carrying_parts(parts: MachineParts, train: str | None) -> Iterator[CarryingPart]:
    """Yield the parts that carry load and have a method: shafts, pins, bearings, keys, meshes, chains, belts."""
    for shaft in (each for each in parts.shafts.values() if each.is_rated and each.sections):
        yield CarryingPart(shaft.name, dotted(shaft.path), shaft.calculation)
        for part in shaft.parts:
            yield from _of_part(part)
    for join in parts.joins:
        path, accepted = dotted(join.path), _accepted(join.keys)
        if join.word == "belts":
            yield CarryingPart(join.name, path, train or "", accepted, lambda check: check.id.startswith("vbelt"))
        else:
            yield CarryingPart(join.name, path, join.calculation, accepted)


def _accepted(keys: Any) -> str:
    """Who accepts a part without a rating; nothing where nobody does."""
    return keys.accepted.by if keys.accepted else ""


def _of_part(part: ShaftPart) -> Iterator[CarryingPart]:
    path, accepted = dotted(part.path), _accepted(part.keys)
    if part.kind == "bearing":
        yield CarryingPart(part.called, path, part.shaft.bearing_calculation, accepted, partial(_is_of, part.name))
    if part.keys.key:
        yield CarryingPart(f"{part.called}.key", path, part.calculation("key"), accepted)
    if part.keys.pin is not None:
        yield CarryingPart(f"{part.called}.pin", path, part.calculation("pin"), accepted)
        if part.keys.pin.bearing:
            own = partial(_is_of, f"{part.name}_pin")
            yield CarryingPart(f"{part.called}.pin.bearing", path, part.shaft.bearing_calculation, accepted, own)


def _is_of(bearing: str, check: CheckRecord) -> bool:
    """Whether a check of several bearings is of this one."""
    return getattr(check.title, "values", {}).get("name") == bearing


def dotted(path: Sequence[str | int]) -> str:
    """Return where a part stands in the file, as results name the place."""
    return ".".join(map(str, path))


def is_rated(part: CarryingPart, checks: Mapping[str, Sequence[CheckRecord]]) -> bool:
    """Return whether its calculation rates a part: it has checks of its strength, and each of them was made."""
    own = (check for check in checks.get(part.calculation, ()) if part.is_own(check))
    strength = [check for check in own if check.check_class == "strength"]
    return bool(strength) and all(check.status != "not_checked" for check in strength)


def rating(own: Sequence[CarryingPart], checks: Mapping[str, Sequence[CheckRecord]]) -> RatingRecord:
    """Return what rates a part, and the check that governs it: none of practice, which does not say whether it holds.

    ``own`` are its calculations, of a wheel in two meshes both.
    """
    made = {
        each.calculation: [
            one for one in checks.get(each.calculation, ()) if each.is_own(one) and one.check_class != "practice"
        ]
        for each in own
    }
    found, known = governing(made), [name for name in made if name in checks]
    left = [each for each in own if not is_rated(each, checks)]
    state: State = "rated" if not left else "accepted" if all(each.accepted for each in left) else "not_rated"
    if found is None:
        return RatingRecord(state=state, calculation=known[0] if known else "")
    return RatingRecord(state=state, calculation=found.mechanism, check=found.check)


def counted(parts: MachineParts, train: str | None, checks: Mapping[str, Sequence[CheckRecord]]) -> PartCountRecord:
    """Return how many parts carry load, and how many of them are rated or accepted without."""
    every = list(carrying_parts(parts, train))
    rated = [part for part in every if is_rated(part, checks)]
    accepted = sum(bool(part.accepted) for part in every if part not in rated)
    left = len(every) - len(rated) - accepted
    return PartCountRecord(carrying=len(every), rated=len(rated), accepted=accepted, not_rated=left)


def unrated(
    parts: MachineParts, train: str | None, checks: Mapping[str, Sequence[CheckRecord]], owner: str
) -> Iterator[OpenRecord]:
    """Yield the parts that carry load and are neither rated nor accepted, with the reason."""

    def record(path: str, why: Phrase) -> OpenRecord:
        return OpenRecord(what="not_rated", path=path, owner=parts.keys.owner or owner, why=why)

    for part in carrying_parts(parts, train):
        if not (part.accepted or is_rated(part, checks)):
            is_there = part.calculation in checks
            why = phrase("not all of its checks of strength are made") if is_there else phrase("its load is not known")
            yield record(part.path, Phrase("{part}: {why}", part=part.name, why=why))
    for shaft in (each for each in parts.shafts.values() if each.keys.motor):
        if any(join.word != "belts" or train is None for join in parts.joins if join.drivers[0].shaft is shaft):
            template = "{part}: no method compares the force on its shaft with that which its maker allows"
            yield record(dotted(shaft.path), Phrase(template, part=shaft.name))
    every = [part for shaft in parts.shafts.values() for part in shaft.parts]
    driven = [join.driven[0].shaft for join in parts.joins if join.word == "belts" and join.driven]
    if train is not None and not any(
        part.kind == "flywheel" and part.shaft in (driven or [part.shaft]) for part in every
    ):
        why = phrase("it sizes a flywheel, and no part of the shaft that it drives is that")
        yield record(f"mechanisms.{train}", why)
    clutches = {part.name for part in every if part.kind == "clutch"}
    for name in (name for name, kind in parts.mechanisms.items() if kind == "clutch" and name not in clutches):
        why = phrase("no part of the machine is this clutch, so that its engagement loads nothing")
        yield record(f"mechanisms.{name}", why)
    if not any(row.startswith("brakes") for row in parts.brakes.values()):
        for name in (name for name, kind in parts.mechanisms.items() if kind == "press_consistency"):
            if "brake_torque" in parts.reader.data["mechanisms"][name]:
                why = phrase("no part of the machine is this brake, so that its torque loads nothing")
                yield record(f"mechanisms.{name}.brake_torque", why)
    for each in (part for part in every if part.keys.accepted is None):
        for template in _without_method(each, parts.mechanisms):
            yield record(dotted(each.path), Phrase(template, part=each.called))


def accepted(
    parts: MachineParts, train: str | None, checks: Mapping[str, Sequence[CheckRecord]]
) -> Iterator[OpenRecord]:
    """Yield what of the parts is not rated and accepted by somebody: each thing that it leaves out, who accepts it, and why."""
    left = [
        (each.path, Phrase("{part}: not all of its checks of strength are made", part=each.name))
        for each in carrying_parts(parts, train) if each.accepted and not is_rated(each, checks)
    ]  # fmt: skip
    every = [part for shaft in parts.shafts.values() for part in shaft.parts if part.keys.accepted]
    left += [
        (dotted(each.path), Phrase(template, part=each.called))
        for each in every for template in _without_method(each, parts.mechanisms)
    ]  # fmt: skip
    owners: list[ShaftPart | Join] = [*every, *parts.joins]
    blocks = {dotted(each.path): each.keys.accepted for each in owners if each.keys.accepted}
    for path, what in left:
        why = Phrase("{what}; accepted: {reason}", what=what, reason=blocks[path].reason)
        yield OpenRecord(what="not_rated", path=path, owner=blocks[path].by, why=why)


def _without_method(part: ShaftPart, mechanisms: Mapping[str, str]) -> Iterator[str]:
    """What of a part carries load and has no method of calculation, with the kinds of the mechanisms by their names."""
    if part.kind == "clutch" and mechanisms.get(part.name) != "clutch":
        yield phrase("{part}: no mechanism of its name calculates how it engages")
    if part.kind in BODIES:
        yield phrase("{part}: no method rates its body")
    if part.keys.integral and part.kind in BODIES:
        yield phrase("{part}: no method rates where it passes into its shaft")
    if part.keys.interference is not None:
        yield phrase("{part}: no method rates its press fit")
    if part.keys.bolted:
        yield phrase("{part}: no method rates its bolts")
    if part.kind in ("crank", "rocker") and part.keys.pin is None:
        yield phrase("{part}: no calculation rates its pin")
    if part.keys.pin is not None and part.keys.pin.bearing is None:
        yield phrase("{part}: the bearing of its pin is not given")
    if part.keys.pin is not None and part.keys.pin.held is not None:
        yield phrase("{part}: no method rates the press fit of its pin")
