"""Load cases beside the run: which torque passes which part where the clutch engages, the motor starts, and the brake stops the machine."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import product
from math import prod
from typing import Any

from diecut_report.config.parts.demands import Demands, Typed
from diecut_report.config.parts.keys import MeshKeys
from diecut_report.config.parts.model import Join, MachineShaft, ShaftPart

FREQUENT = "1e6"  # engagements of a clutch, or stops by a brake, whose number is not known: they count for pitting


@dataclass(frozen=True, eq=False)
class Passing:
    """Hold a torque that passes a shaft in a load case, as an expression: from a part to another one, or sprockets side by side in even shares."""

    case: str
    torque: str
    enters: Sequence[ShaftPart]
    leaves: Sequence[ShaftPart]

    @property
    def shaft(self) -> MachineShaft:
        """Return the shaft that it passes."""
        return self.enters[0].shaft

    def at(self, part: ShaftPart) -> str:
        """Return what of it passes the joint of a part, or of one that rides on it, with the shaft; empty for nothing."""
        riders = {part.name, *(each.name for each in part.shaft.parts if each.keys.rides_on == part.name)}
        sides = [side for side in (self.enters, self.leaves) if riders & {each.name for each in side}]
        if part.shaft is not self.shaft or not sides:
            return ""
        return self.torque if len(sides[0]) == 1 else f"({self.torque}) / {len(sides[0])}"


@dataclass(frozen=True, eq=False)
class Meshing:
    """Hold a torque on the driving gear of a pair in a load case, as an expression, and how often it acts in the life."""

    case: str
    torque: str
    join: Join
    cycles: Any


class LoadCases(Demands):
    """Know the load cases of the parts: the clutch's design torque on both its sides, the motor's and the brake's up to the flywheel."""

    @cached_property
    def load_cases(self) -> list[Passing | Meshing]:
        """Return all torques of load cases."""
        return [*self._engagements(), *self._starts(), *self._stops()]

    def passing(self, shaft: MachineShaft) -> list[Passing]:
        """Return the load cases of a shaft."""
        return [each for each in self.load_cases if isinstance(each, Passing) and each.shaft is shaft]

    def meshing(self, join: Join) -> list[Meshing]:
        """Return the load cases of a pair of gears."""
        return [each for each in self.load_cases if isinstance(each, Meshing) and each.join is join]

    # The clutch: its torque acts on what is between it and the flywheel, and on what it drives, as far as that turns steadily.

    def _engagements(self) -> Iterator[Passing | Meshing]:
        for shaft in (self.parts.shafts[name] for name in self.parts.ratios):
            for clutch in (part for part in shaft.of_kind("clutch") if self.is_calculated_clutch(part)):
                yield from self._from_clutch(shaft, f"${{{clutch.name}.design_torque}}")

    def is_calculated_clutch(self, part: ShaftPart) -> bool:
        """Return whether a part is a clutch that a mechanism of its name calculates."""
        return part.kind == "clutch" and self.parts.mechanisms.get(part.name) == "clutch"

    def _from_clutch(self, shaft: MachineShaft, torque: str) -> Iterator[Passing | Meshing]:
        driving = self.parts.driving_join(shaft)
        if driving is not None and shaft.flywheel is None:
            yield from self._towards_flywheel("engage", driving, torque, self._engagements_in_life)
        if enters := self._source_of(shaft):
            yield from self._onward("engage", enters, torque, self._engagements_in_life)

    def _source_of(self, shaft: MachineShaft) -> Sequence[ShaftPart]:
        """The parts from which a shaft is driven: its flywheel, else those of the join before it; none where nothing drives it."""
        driving = self.parts.driving_join(shaft)
        return (shaft.flywheel,) if shaft.flywheel else driving.driven if driving else ()

    def _onward(self, case: str, enters: Sequence[ShaftPart], torque: str, cycles: Any) -> Iterator[Passing | Meshing]:
        """The torque on a shaft from the part that drives it, and on the steadily turning shafts that it drives."""
        shaft = enters[0].shaft
        driving = self.parts.driving_join(shaft)
        driven = (*enters, *(driving.driven if driving else ()))
        for part in (each for each in shaft.parts if each not in driven and self.torque_on(each)):
            joins = [each for each in self.parts.joins_of(part) if part in each.drivers]
            beside = joins[0].drivers if joins else (part,)
            if part is beside[0]:
                yield Passing(case, torque, enters, beside)
            for join in (each for each in joins if part is each.drivers[0]):
                if join.driven and join.driven_shaft.name in self.parts.ratios:
                    if isinstance(join.keys, MeshKeys):
                        yield Meshing(case, torque, join, cycles)
                    yield from self._onward(case, join.driven, f"{torque} / {join.ratio_text}", cycles)

    def _towards_flywheel(self, case: str, join: Join, torque: str, cycles: Any) -> Iterator[Passing | Meshing]:
        """The torque on the driving side of a join and of all before it, up to the shaft with the flywheel."""
        while True:
            if isinstance(join.keys, MeshKeys):
                torque = f"{torque} * {join.ratio_text} / {join.keys.efficiency:.15g}"
                yield Meshing(case, torque, join, cycles)
            else:
                torque = f"{torque} * {join.ratio_text}"
            shaft = join.driving_shaft
            before, source = self.parts.driving_join(shaft), self._source_of(shaft)
            if not source:
                return
            yield Passing(case, torque, source, join.drivers)
            if shaft.flywheel is not None or before is None:
                return
            join = before

    # The motor: its breakdown torque acts on what is between it and the flywheel.

    def _starts(self) -> Iterator[Passing]:
        train = self.named("drive_train")
        for join in (each for each in self.parts.joins if each.word == "belts" and train is not None):
            flywheel = join.driven_shaft.flywheel
            if flywheel is not None and join.driving_shaft.keys.motor is not None:
                torque = f"${{{train}.vbelt_peak_torque}} * ${{drive_line.{join.name}_belt_ratio}}"
                yield Passing("start", torque, join.driven[:1], (flywheel,))

    # The brake: its torque acts on all between it and the flywheel, with what the mechanisms take there; behind a clutch on what it drives.

    def _stops(self) -> Iterator[Passing | Meshing]:
        for brake in self.parts.brakes:
            torque, cycles = self.brake_torque(brake), self._stops_in_life(brake)
            if self.parts.is_behind_clutch(brake):
                yield from self._onward("stop", (brake,), torque, cycles)
                continue
            for each in self._to_flywheel_from(brake, torque, cycles):
                shaft = each.shaft if isinstance(each, Passing) else each.join.driving_shaft
                yield replace(each, torque=" + ".join([each.torque, *self._taken_by_run(shaft)]))

    def _to_flywheel_from(self, brake: ShaftPart, torque: str, cycles: Any) -> Iterator[Passing | Meshing]:
        driving, source = self.parts.driving_join(brake.shaft), self._source_of(brake.shaft)
        if source:
            yield Passing("stop", torque, source, (brake,))
        if driving is not None and brake.shaft.flywheel is None:
            yield from self._towards_flywheel("stop", driving, torque, cycles)

    def _taken_by_run(self, shaft: MachineShaft) -> Iterator[str]:
        """The greatest torque that the lines take at the main shaft, on a shaft from the flywheel's to the main one."""
        timing, anchor = self.named("cyclogram"), self.parts.keys.anchor
        way = self.parts.chain_from(shaft.name, anchor)
        if timing is not None and (way or shaft.name == anchor):
            losses = [f"1 / {prod(self.loss(join).efficiency for join in way):.15g}"] if way else []
            yield " * ".join([f"${{{timing}.torque_peak}}", *(join.ratio_text for join in way), *losses])

    def brake_torque(self, brake: ShaftPart) -> str:
        """Return the reference to the torque of a brake."""
        return f"${{drive_line.{self.parts.brakes[brake]}.torque}}"

    # As inputs.

    def cases_of_shaft(self, shaft: MachineShaft) -> list[dict[str, Any]]:
        """Return the load cases of a shaft as its calculation takes them: numbered where a torque may pass between several parts.

        Between sprockets side by side all of it may pass one of them, which is safe.
        """
        found: list[dict[str, Any]] = []
        for each in self.passing(shaft):
            for enters, leaves in product(each.enters, each.leaves):
                count = sum(row["name"].startswith(each.case) for row in found)
                name = f"{each.case}_{count + 1}" if count else each.case
                found.append({"name": name, "torque": each.torque, "enters": enters.name, "leaves": leaves.name})
        return found

    def cases_of_key(self, part: ShaftPart) -> list[dict[str, Any]]:
        """Return the load cases of the key of a part."""
        own = dict.fromkeys((each.case, torque) for each in self.passing(part.shaft) if (torque := each.at(part)))
        return [{"name": case, "torque": torque} for case, torque in own]

    def cases_of_mesh(self, join: Join, pinion: ShaftPart) -> list[dict[str, Any]]:
        """Return the load cases of a pair of gears, as torques on its pinion."""
        found = []
        for each in self.meshing(join):
            torque = each.torque if pinion in join.drivers else f"({each.torque}) / {join.ratio_text}"
            found.append({"name": each.case, "torque": torque, "cycles": each.cycles})
        return found

    @property
    def _engagements_in_life(self) -> str:
        """How often the clutch engages in the life of the machine; often, where no life is asked for, or there are several clutches."""
        clutch, life = self.named("clutch"), self.parts.keys.required_life
        return f"${{{clutch}.engagements_per_hour}} * {life / 3600:.12g} h" if clutch and life else FREQUENT

    def _stops_in_life(self, brake: ShaftPart) -> str | Typed:
        """How often a brake stops the machine in its life; often, where that is not said or no life is asked for."""
        stops, life = brake.keys.stops_per_hour, self.parts.keys.required_life
        if stops is None or not life:
            return FREQUENT
        return Typed((*brake.path, "stops_per_hour"), f"{stops * life:.12g}")
