"""The drive line of a run: its parts that carry load, what rates each, where they stand and how large they are, as drawings show them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from math import prod
from typing import Any, Literal, cast

import numpy as np

from diecut_report.config.parts.keys import ChainKeys, MeshKeys, PinKeys
from diecut_report.config.parts.masses import tooth_width
from diecut_report.config.parts.model import Join, MachineParts, MachineShaft, ShaftPart
from diecut_report.machine.calculation import Calculation
from diecut_report.mechanism.mechanism import Port
from diecut_report.results.conclusion import governing
from diecut_report.results.mechanism_record import CheckRecord
from diecut_report.results.model import (
    DriveLineRecord,
    JoinRecord,
    MachineShaftRecord,
    OpenRecord,
    PartCountRecord,
    PartKind,
    PlacedPartRecord,
    RatingRecord,
    ShaftSectionRecord,
    State,
)
from diecut_report.results.press_run import Run
from diecut_report.standards import catalogue_size
from diecut_report.text.phrases import Phrase, phrase

# The parts that carry load, with the calculation that rates each, and those that no method rates.


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
    is_body, pin = part.kind in BODIES, part.keys.pin
    found = {
        phrase("{part}: no mechanism of its name calculates how it engages"): part.kind == "clutch"
        and mechanisms.get(part.name) != "clutch",
        phrase("{part}: no method rates its body"): is_body,
        phrase("{part}: no method rates where it passes into its shaft"): is_body and part.keys.integral,
        phrase("{part}: no method rates its press fit"): part.keys.interference is not None,
        phrase("{part}: no method rates its bolts"): part.keys.bolted,
        phrase("{part}: no calculation rates its pin"): part.kind in ("crank", "rocker") and pin is None,
        phrase("{part}: the bearing of its pin is not given"): pin is not None and pin.bearing is None,
        phrase("{part}: no method rates the press fit of its pin"): pin is not None and pin.held is not None,
    }
    return (template for template, is_so in found.items() if is_so)


# Where the shafts and their parts stand, how large they are, and what rates each.


NOTHING = RatingRecord(state="none")
KINDS: Mapping[str, Literal["mesh", "chain", "belt"]] = {"meshes": "mesh", "chains": "chain", "belts": "belt"}


def drive_line(run: Run, checks: Mapping[str, Sequence[CheckRecord]]) -> DriveLineRecord | None:
    """Return the drive line of a run; None where the parts of the machine are not modelled."""
    parts = run.config.parts
    if parts is None:
        return None
    found = _DriveLine(parts, run.config.named("drive_train"), run.calculations, checks)
    shafts = [found.shaft(each) for each in parts.shafts.values()]
    return DriveLineRecord(shafts=shafts, joins=[found.join(each) for each in parts.joins])


@dataclass(frozen=True)
class _DriveLine:
    parts: MachineParts
    train: str | None
    calculations: Mapping[str, Calculation]
    checks: Mapping[str, Sequence[CheckRecord]]

    # What rates a part.

    @cached_property
    def _carrying(self) -> dict[tuple[str, str], CarryingPart]:
        return {(each.path, each.name): each for each in carrying_parts(self.parts, self.train)}

    def _rating(self, path: str, name: str) -> RatingRecord:
        own = self._carrying.get((path, name))
        return rating([own], self.checks) if own else NOTHING

    def _body(self, part: ShaftPart) -> RatingRecord:
        """What rates the body of a part: the calculations of its joins; of a bearing its own."""
        if part.kind in BODIES:
            return RatingRecord(state="accepted" if part.keys.accepted else "not_rated")
        joins = [self._carrying[dotted(each.path), each.name] for each in self.parts.joins_of(part)]
        return rating(joins, self.checks) if joins else self._rating(dotted(part.path), part.called)

    # Where it stands.

    def shaft(self, shaft: MachineShaft) -> MachineShaftRecord:
        sections = [
            ShaftSectionRecord(start=each.start, end=each.end, diameter=each.diameter, bore=each.bore)
            for each in shaft.sections
        ]
        axis = self.parts.axes.get(shaft.name)
        return MachineShaftRecord(
            name=shaft.name,
            axis=list(axis) if axis else None,
            left=self.parts.lefts.get(shaft.name),
            sections=sections,
            parts=[each for part in shaft.parts for each in self._of_part(part)],
            rating=self._rating(dotted(shaft.path), shaft.name),
        )

    def join(self, join: Join) -> JoinRecord:
        drivers, driven = ([part.called for part in side] for side in (join.drivers, join.driven))
        rates = self._rating(dotted(join.path), join.name)
        return JoinRecord(name=join.name, kind=KINDS[join.word], drivers=drivers, driven=driven, rating=rates)

    def _of_part(self, part: ShaftPart) -> Iterator[PlacedPartRecord]:
        """The part, then its key, its pin and the bearing on that."""
        start, end = part.ends
        port = self._port(part)
        placed = PlacedPartRecord(
            name=part.called, kind=cast(PartKind, part.kind), start=start, end=end, seat=part.seat,
            radius=self._radius(part, port), of=part.keys.of or "",
            outside=(part.size("D") or 0.0) if part.kind == "bearing" else 0.0, width=self._width(part), toothed=self._toothed(part),
            slots=self._slots(part, port), rating=self._body(part),
        )  # fmt: skip
        yield placed
        if part.keys.key:
            half = part.keys.key / 2
            ends = {"start": part.keys.at - half, "end": part.keys.at + half}
            yield self._piece(part, "key", kind="key", seat=part.seat, **ends)
        if part.keys.pin is not None:
            yield from self._pin(part, part.keys.pin, placed.radius)

    def _piece(self, part: ShaftPart, name: str, **fields: object) -> PlacedPartRecord:
        called = f"{part.called}.{name}"
        home = {"name": called, "rating": self._rating(dotted(part.path), called)}
        return PlacedPartRecord.model_validate(home | fields)

    def _pin(self, part: ShaftPart, pin: PinKeys, radius: float) -> Iterator[PlacedPartRecord]:
        ends = _pin_ends(part, pin)
        off = {"seat": pin.diameter, "radius": radius}
        yield self._piece(part, "pin", kind="pin", start=min(ends), end=max(ends), **off)
        if pin.bearing:
            half = (catalogue_size(pin.bearing, "B") or 0.0) / 2
            outside = catalogue_size(pin.bearing, "D") or 0.0
            ring = {"start": part.plane - half, "end": part.plane + half, "outside": outside}
            yield self._piece(part, "pin.bearing", kind="pin_bearing", **ring, **off)

    # How large it is.

    def _port(self, part: ShaftPart) -> Port | None:
        calc = self.calculations.get(part.port[0]) if part.port else None
        ports = calc.mechanism.ports if calc else ()
        return next((each for each in ports if part.port and each.name == part.port[1]), None)

    def _number(self, part: ShaftPart, name: str) -> float:
        assert part.port is not None, "the number is of a port"
        calc = self.calculations[part.port[0]]
        found = calc.values.get(name, calc.inputs.get(name))
        return 0.0 if found is None else float(np.ravel(found)[0])

    def _radius(self, part: ShaftPart, port: Port | None) -> float:
        own = self.parts.body_radius(part)
        if own is None and port is not None and port.radius:
            return prod(self._number(part, name) for name in port.radius)
        return own or 0.0

    def _width(self, part: ShaftPart) -> float:
        join = next(self.parts.joins_of(part), None)
        is_toothed = join is not None and isinstance(join.keys, ChainKeys) and part.keys.width is None
        found = tooth_width(join.keys) if join is not None and is_toothed else self.parts.body_width(part)
        return 0.0 if found == part.hub else found

    def _toothed(self, part: ShaftPart) -> float:
        """The share of the circumference that has teeth: of the greater one of a pair whose teeth are not all there."""
        for join in self.parts.joins_of(part):
            keys = join.keys
            if isinstance(keys, MeshKeys) and keys.teeth_present:
                teeth, other = (keys.teeth_1, keys.teeth_2) if part in join.drivers else (keys.teeth_2, keys.teeth_1)
                if teeth > other:
                    return min(1.0, keys.teeth_present / teeth)
        return 1.0

    def _slots(self, part: ShaftPart, port: Port | None) -> int:
        is_wheel = part.kind == "geneva_wheel" and port is not None and port.advance
        return int(self._number(part, port.advance)) if port is not None and is_wheel else 0


def _pin_ends(part: ShaftPart, pin: PinKeys) -> tuple[float, float]:
    """Where a pin begins and ends, m from the shaft's left end: held in the disc's outer face, or over both supports about the hub's middle."""
    if pin.held is not None:
        face = part.keys.at + part.outward * part.hub / 2
        return face - part.outward * pin.held, face + part.outward * 2 * pin.plane
    length = (pin.span_start or 0.0) + (pin.span_end or 0.0)
    return part.keys.at - length / 2, part.keys.at + length / 2
