"""The drive line of a run: where its shafts and their parts stand, how large they are, and what rates each, as drawings show it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import prod
from typing import Literal, cast

import numpy as np

from diecut_report.config.parts.keys import ChainKeys, MeshKeys, PinKeys
from diecut_report.config.parts.masses import tooth_width
from diecut_report.config.parts.model import Join, MachineParts, MachineShaft, ShaftPart
from diecut_report.machine.calculation import Calculation
from diecut_report.mechanism.mechanism import Port
from diecut_report.results.carrying_parts import BODIES, CarryingPart, carrying_parts, dotted, rating
from diecut_report.results.drive_line_record import (
    DriveLineRecord,
    JoinRecord,
    MachineShaftRecord,
    PartKind,
    PlacedPartRecord,
    RatingRecord,
    ShaftSectionRecord,
)
from diecut_report.results.mechanism_record import CheckRecord
from diecut_report.results.press_run import Run
from diecut_report.standards import catalogue_size

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
