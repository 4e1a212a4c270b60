"""Whether the parts of one machine agree where both values stand in the file: a function for each rule, over all mechanisms.

Two mechanisms are of one part where one refers to the other, or both take the same torque. What disagrees is refused with both
places; among many machines it is the reason why a variant cannot exist.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from copy import copy
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from diecut_report.config.instances import Instance, Node, Target
from diecut_report.config.parts.model import MachineParts
from diecut_report.config.validation import quoted
from diecut_report.config.yaml import KeyPath
from diecut_report.errors import Problem, nearest
from diecut_report.formulas import Array
from diecut_report.machine.calculation import Calculation
from diecut_report.mechanism.checks import Check
from diecut_report.mechanism.inputs import Block, flatten
from diecut_report.mechanism.steps import Abscissa
from diecut_report.quantities.formatting import given_shown, with_unit
from diecut_report.results.usual import numbers_of
from diecut_report.text.phrases import Phrase, joined, phrase

LENGTH, RATIO, ANGLE = 5e-5, 1e-3, 1e-3  # m; share; rad
TAKEN = {
    "shaft": ("section_diameter", "axial_reaction_max"),
    "rolling_bearing": ("bore", "axial_greatest"),
    "gear_pair": ("working_diameter_1", "working_diameter_2"),
    "cyclogram": ("torque_curve_turns",),
}
"""Results by which the rules judge, of each kind."""


@dataclass(frozen=True, eq=False)
class LinkedPart:
    """Hold a mechanism with its inputs, SI, its results, and what its inputs refer to."""

    instance: Instance
    inputs: Mapping[str, Any]
    calc: Calculation
    links: Mapping[Node, Target]

    def number(self, name: str, index: int | None = None) -> Array | None:
        """Return an input or result of all variants, of a list that of one part; None where it is not known."""
        if name in self.calc.values:
            row = self.calc.values[name]
            return numbers_of(row if index is None else row[:, index])
        given = self.inputs.get(name)
        return numbers_of(given[index] if isinstance(given, tuple) and index is not None else given)

    def target(self, *key: str | int) -> Target | None:
        """Return what an input refers to by itself; None where it is a value or an expression."""
        found = self.links.get((self.instance.name, *key))
        return None if found is None or found.expression else found

    def curves(self, *home: str | int) -> Iterator[Target]:
        """Yield the curves that the mechanism takes, or a part of it."""
        own = (self.instance.name, *home)
        return (each for node, each in self.links.items() if node[: len(own)] == own and each.is_curve)

    def sections_at(self, place: Array) -> Array:
        """Return in which sections of a shaft a place lies, (variants, sections); at a shoulder in both."""
        lengths = [_of(numbers_of(each)) for each in self.inputs["sections.length"]]
        ends = np.cumsum(np.stack(np.broadcast_arrays(*lengths, place))[:-1], axis=0).T
        starts = np.concatenate([np.zeros((len(ends), 1)), ends[:, :-1]], axis=1)
        return (place[:, None] >= starts - LENGTH) & (place[:, None] <= ends + LENGTH)


@dataclass(frozen=True, eq=False)
class Disagreement:
    """Hold two values that cannot both be: where each stands, in which variants, and what is wrong, by the variant."""

    part: LinkedPart
    key: KeyPath
    other: LinkedPart | None
    other_key: KeyPath
    wrong: Array
    template: str
    values: Mapping[str, tuple[Array, str] | str] = field(default_factory=dict)

    def problem(self, variant: int = 0) -> Problem:
        """Return what is wrong, with both places, where there is another."""
        shown = {name: _shown(given, variant) for name, given in self.values.items()}
        told = Phrase(self.template, shown)
        if self.other is None:
            return self.part.instance.place.problem(self.key, told)
        against = self.other.instance.place.problem(self.other_key, "")
        # without the file, which is the same: results keep this as what the advice led to, and do not depend on where the file stands
        place = Phrase("{path}, line {line}", path=against.path, line=against.line)
        template = "{told} (against {place}). Change the one that is not so."
        return self.part.instance.place.problem(self.key, template, told=told, place=place)


def _shown(given: tuple[Array, str] | str, variant: int) -> str:
    if isinstance(given, str):
        return given
    values, display = given
    return with_unit(*given_shown(float(values[min(variant, len(values) - 1)]), display).values())


class Machine:
    """Hold the mechanisms of one machine that were calculated."""

    def __init__(
        self,
        instances: Mapping[str, Instance | None],
        blocks: Mapping[str, Block],
        calculations: Mapping[str, Calculation],
        links: Mapping[Node, Target],
    ) -> None:
        self.parts = {
            name: LinkedPart(instance, flatten(blocks[name]), calculations[name], links)
            for name, instance in instances.items()
            if instance is not None and name in calculations
        }
        self.kinds = {name: each.mechanism.kind for name, each in instances.items() if each and each.mechanism}

    def with_part(self, part: LinkedPart) -> Machine:
        """Return the machine with a mechanism that was calculated anew."""
        made = copy(self)
        made.parts = {**self.parts, part.instance.name: part}
        vars(made).pop("gears", None)
        return made

    def of(self, kind: str) -> Iterator[LinkedPart]:
        """Yield the mechanisms of a kind."""
        return (part for part in self.parts.values() if part.calc.mechanism.kind == kind)

    def parts_of(self, kind: str, key: str) -> Iterator[tuple[LinkedPart, int]]:
        """Yield the parts of a list, by one of its keys, of each mechanism of a kind."""
        return ((part, index) for part in self.of(kind) for index in range(len(part.inputs.get(key, ()))))

    def is_of(self, name: str, *kinds: str) -> bool:
        """Return whether a name is that of a mechanism of these kinds."""
        return name in self.parts and self.parts[name].calc.mechanism.kind in kinds

    @cached_property
    def gears(self) -> dict[tuple[str, str | None], list[LinkedPart]]:
        """Return the pairs of gears by the torque that they take."""
        found: dict[tuple[str, str | None], list[LinkedPart]] = {}
        for pair in self.of("gear_pair"):
            for key in ("torque", "torque_curve"):
                if target := pair.target(key):
                    found.setdefault((target.instance, target.result), []).append(pair)
        return found

    def cycle_speed(self, target: Target) -> Array | None:
        """Return how fast the cycle of a curve is run through, rad/s; None where its mechanism does not tell."""
        calc = self.parts[target.instance].calc if target.instance in self.parts else None
        axis = calc.axis.get(str(target.result), str(target.result)) if calc else ""
        step = calc.steps.get(axis) if calc else None
        if calc is None or not isinstance(step, Abscissa) or not step.speed or axis not in calc.domains:
            return None
        speed: Array = calc[step.speed][:, 0] * 2 * np.pi / calc.domains[axis].period[:, 0]
        return speed


def _differ(one: Array, other: Array, share: float = RATIO, least: float = 0.0) -> Array:
    found: Array = np.abs(one - other) > share * np.abs(other) + least
    return found


# A rule each.


def named_shafts(machine: Machine) -> Iterator[Disagreement]:
    """What ``on`` of a bearing names is a shaft."""
    shafts = [name for name, kind in machine.kinds.items() if kind == "shaft"]
    for bearing in machine.of("rolling_bearing"):
        for index, name in enumerate(bearing.inputs.get("bearings.on", ())):
            if name is not None and name not in shafts:
                yield Disagreement(
                    bearing, ("bearings", index, "on"), None, (), np.ones(1, dtype=bool),
                    phrase("is {name}{nearest}; the name of a shaft is needed. Known: {shafts}."),
                    {"name": quoted(name), "nearest": nearest(name, shafts), "shafts": ", ".join(shafts) or "–"},
                )  # fmt: skip


def seats(machine: Machine) -> Iterator[Disagreement]:
    """A bearing has the bore of the section that it sits on: at its place where it bears the shaft's reaction, else of any."""
    for bearing, index in machine.parts_of("rolling_bearing", "bearings.name"):
        bore, (shaft, side) = bearing.number("bore", index), _seat(machine, bearing, index) or (None, "")
        diameters = shaft.calc.values.get("section_diameter") if shaft else None
        if bore is None or shaft is None or diameters is None:
            continue
        place = shaft.number(side) if side else None
        there = np.ones(diameters.shape, dtype=bool) if place is None else shaft.sections_at(place)
        fits = there & ~_differ(diameters, bore[:, None], 0.0, LENGTH)
        nearest = int(np.argmax(there[0]))
        yield Disagreement(
            bearing, ("bearings", index, "designation"), shaft, ("sections", nearest, "diameter"), (bore > 0) & ~fits.any(axis=1),
            phrase("names a bearing with the bore {bore}, but its seat on the shaft {shaft} is {seat} thick"),
            {"bore": (bore, "mm"), "seat": (diameters[:, nearest], "mm"), "shaft": shaft.instance.name},
        )  # fmt: skip


def _seat(machine: Machine, bearing: LinkedPart, index: int) -> tuple[LinkedPart, str] | None:
    """The shaft that a bearing sits on, with the key of its place there; no key where any section may be meant."""
    target = bearing.target("bearings", index, "radial_force")
    result = str(target.result).removesuffix("_max") if target else ""
    if target and machine.is_of(target.instance, "shaft") and result in ("reaction_a", "reaction_b"):
        return machine.parts[target.instance], result.replace("reaction", "bearing")
    named = bearing.inputs.get("bearings.on", ())
    name = (named[index] if named else None) or bearing.inputs["bearings.name"][index]
    return (machine.parts[name], "") if machine.is_of(name, "shaft") else None


def keys(machine: Machine) -> Iterator[Disagreement]:
    """A key and its hub lie on the one section that the key's shaft_diameter refers to."""
    for key in machine.of("parallel_key"):
        target = key.target("shaft_diameter")
        if target is None or not machine.is_of(target.instance, "shaft") or len(target.key) != 3:
            continue
        shaft, section = machine.parts[target.instance], int(target.key[1])
        length = shaft.number("sections.length", section)
        for name in ("key_length", "hub_length"):
            own = key.number(name)
            if own is not None and length is not None:
                yield Disagreement(
                    key, (name,), shaft, ("sections", section, "length"), own > length + LENGTH,
                    phrase("is {own}, but the section of {shaft} that it sits on is only {length} long"),
                    {"own": (own, "mm"), "length": (length, "mm"), "shaft": shaft.instance.name},
                )  # fmt: skip


def pitch_radii(machine: Machine) -> Iterator[Disagreement]:
    """A gear of a shaft, and the drive's pinion, has the pitch radius and the helix of the pair of gears that takes the same torque."""
    for shaft, index in machine.parts_of("shaft", "loads.name"):
        target, radius = _torque(shaft, index), shaft.number("loads.gear.pitch_radius", index)
        if target and radius is not None:
            pairs = machine.gears.get((target.instance, target.result), [])
            yield from _radius(shaft, ("loads", index, "gear", "pitch_radius"), radius, pairs)
            yield from _helix(shaft, index, pairs)
    for drive in machine.of("cylinder_drive"):
        pinion = drive.number("pinion_radius")
        if pinion is not None:
            pairs = machine.gears.get((drive.instance.name, "total_moment"), [])
            yield from _radius(drive, ("pinion_radius",), pinion, pairs)


def _torque(shaft: LinkedPart, index: int) -> Target | None:
    """The torque of a load: what it refers to, or where it balances that of a single other load, which has no teeth, the other one's."""
    torques = shaft.inputs["loads.torque"]
    if not isinstance(torques[index], str):
        return shaft.target("loads", index, "torque")
    others = [i for i, each in enumerate(torques) if i != index and each is not None and np.any(each != 0)]
    if len(others) != 1 or shaft.number("loads.gear.pitch_radius", others[0]) is not None:
        return None
    return shaft.target("loads", others[0], "torque")


def _radius(part: LinkedPart, key: KeyPath, radius: Array, pairs: list[LinkedPart]) -> Iterator[Disagreement]:
    known = [(pair, half) for pair in pairs if (half := _pitch_radius(pair)) is not None]
    if known:
        wrong = np.logical_and.reduce([_differ(radius, half, RATIO, LENGTH) for _, half in known])
        pair, half = known[0]
        yield Disagreement(
            part, key, pair, ("module",) if "module" in pair.inputs else ("teeth_1",), wrong,
            phrase("is {own}, but the pair {pair}, which takes the same torque, has the pitch radius {other} there"),
            {"own": (radius, "mm"), "other": (half, "mm"), "pair": pair.instance.name},
        )  # fmt: skip


def _helix(shaft: LinkedPart, index: int, pairs: list[LinkedPart]) -> Iterator[Disagreement]:
    for pair in pairs[:1]:
        own, other = np.abs(_of(shaft.number("loads.gear.helix_angle", index))), _of(pair.number("helix_angle"))
        yield Disagreement(
            shaft, ("loads", index, "gear", "helix_angle"), pair, ("helix_angle",), _differ(own, other, 0.0, ANGLE),
            phrase("is {own}, but the pair {pair}, which takes the same torque, has the helix angle {other}"),
            {"own": (own, "deg"), "other": (other, "deg"), "pair": pair.instance.name},
        )  # fmt: skip


def _pitch_radius(pair: LinkedPart) -> Array | None:
    """The pitch radius of the gear of a pair on which its torque acts."""
    diameter = pair.number("working_diameter_2" if pair.inputs.get("torque_on") == "wheel" else "working_diameter_1")
    return None if diameter is None else diameter / 2


def torque_seats(machine: Machine) -> Iterator[Disagreement]:
    """Where a torque goes into a shaft there is a keyseat or press fit, if the shaft has any, no farther off than its diameter."""
    for shaft in machine.of("shaft"):
        types = shaft.inputs.get("notches.type", ())
        seats_of = [i for i, each in enumerate(types) if "keyseat" in each or each in ("press_fit", "custom")]
        diameters = shaft.calc.values.get("section_diameter")
        for index, torque in enumerate(shaft.inputs.get("loads.torque", ())):
            place = shaft.number("loads.position", index)
            is_free = torque is None or shaft.inputs["loads.seat"][index] == "none"
            if is_free or not np.any(torque != 0) or not seats_of or place is None or diameters is None:
                continue
            ways = np.stack(
                np.broadcast_arrays(*(np.abs(place - _of(shaft.number("notches.position", i))) for i in seats_of))
            )
            thick = np.max(np.where(shaft.sections_at(place), diameters, 0.0), axis=1)
            wrong = np.min(ways, axis=0) > thick + LENGTH
            wrong = wrong & (np.asarray(torque) != 0) if isinstance(torque, float | np.ndarray) else wrong
            nearest = seats_of[int(np.argmin(ways[:, np.argmax(wrong) % ways.shape[1]]))]
            yield Disagreement(
                shaft, ("loads", index, "position"), shaft, ("notches", nearest, "position"), wrong,
                phrase("puts a torque into the shaft at {place}, but the nearest keyseat or press fit is at {notch}, farther off than the shaft's "
                "{thick}; a gear that is cut on the shaft has seat: none"),
                {"place": (place, "mm"), "notch": (_of(shaft.number("notches.position", nearest)), "mm"), "thick": (thick, "mm")},
            )  # fmt: skip


def _of(known: Array | None) -> Array:
    assert known is not None, "a required key"
    return known


def speeds(machine: Machine) -> Iterator[Disagreement]:
    """An element has the speed of the mechanism whose curves load it, and a bearing that of its shaft."""
    for shaft in machine.of("shaft"):
        rotation = shaft.inputs.get("rotation")
        if isinstance(rotation, str) and rotation == "turning":
            yield from _speed(machine, shaft, ("speed",), _of(shaft.number("turns_per_cycle")))
    for key in machine.of("parallel_key"):
        yield from _speed(machine, key, ("cycle_speed",), np.ones(1))
    for bearing, index in machine.parts_of("rolling_bearing", "bearings.name"):
        yield from _speed(machine, bearing, ("bearings", index, "cycle_speed"), np.ones(1))
        yield from _speed_of_shaft(machine, bearing, index)


def _speed(
    machine: Machine, part: LinkedPart, key: KeyPath, turns: Array, own: Array | None = None
) -> Iterator[Disagreement]:
    index = key[1] if len(key) > 1 else None
    if own is None:
        own = part.number(".".join(str(each) for each in key if isinstance(each, str)), index)  # type: ignore[arg-type]
    known = ((each, machine.cycle_speed(each)) for each in part.curves(*key[:-1]))
    target, speed = next(((each, speed) for each, speed in known if speed is not None), (None, None))
    if own is None or target is None or speed is None:
        return
    source = machine.parts[target.instance]
    step = source.calc.steps[source.calc.axis.get(str(target.result), str(target.result))]
    assert isinstance(step, Abscissa), "it has a speed"
    other_key = tuple(step.speed.removeprefix("inputs.").split(".")) if step.speed else ()
    yield Disagreement(
        part, key, source, other_key, _differ(own, speed * turns),
        phrase("is {own}, but the curves that load it come from {other}, at {speed}"),
        {"own": (own, "rpm"), "speed": (speed * turns, "rpm"), "other": source.instance.name},
    )  # fmt: skip


def _speed_of_shaft(machine: Machine, bearing: LinkedPart, index: int) -> Iterator[Disagreement]:
    own, found = bearing.number("bearings.speed", index), _seat(machine, bearing, index)
    speed = found[0].number("speed") if found and found[1] else None
    if found and own is not None and speed is not None:
        yield Disagreement(
            bearing, ("bearings", index, "speed"), found[0], ("speed",), _differ(np.abs(own), speed),
            phrase("is {own}, but the shaft {shaft}, whose reaction it bears, turns at {speed}"),
            {"own": (own, "rpm"), "speed": (speed, "rpm"), "shaft": found[0].instance.name},
        )  # fmt: skip


def axial_forces(machine: Machine) -> Iterator[Disagreement]:
    """The bearing that locates a shaft bears what pushes the shaft along its axis."""
    for bearing, index in machine.parts_of("rolling_bearing", "bearings.name"):
        shaft, side = _seat(machine, bearing, index) or (None, "")
        if shaft is None or side != f"bearing_{shaft.inputs['locating']}":
            continue
        own, push = bearing.number("axial_greatest", index), shaft.number("axial_reaction_max")
        if own is not None and push is not None:
            yield Disagreement(
                bearing, ("bearings", index, "axial_force"), shaft, ("locating",), own < push * (1 - RATIO),
                phrase("is at most {own}, but the shaft {shaft}, which this bearing locates, is pushed along its axis by up to {push}; "
                "refer to its axial_reaction"),
                {"own": (own, "N"), "push": (push, "N"), "shaft": shaft.instance.name},
            )  # fmt: skip


def sprockets(machine: Machine) -> Iterator[Disagreement]:
    """The chain of a conveyor has the teeth and the pitch of the transport's sprocket, whose motion it takes."""
    for chain in machine.of("roller_chain"):
        names = {each.instance for each in chain.curves()}
        known = (name for name in names if machine.is_of(name, "cam_gear_transport", "geneva_transport"))
        for transport in map(machine.parts.__getitem__, known):
            for own_key, other_key, display in (("teeth_1", "sprocket_teeth", "1"), ("pitch", "chain_pitch", "mm")):
                own, other = chain.number(own_key), transport.number(other_key)
                if own is not None and other is not None:
                    key = own_key if own_key in chain.inputs else "chain"
                    yield Disagreement(
                        chain, (key,), transport, (other_key,), _differ(own, other),
                        phrase("gives {own}, but the sprocket of {transport}, whose motion it takes, has {other}"),
                        {"own": (own, display), "other": (other, display), "transport": transport.instance.name},
                    )  # fmt: skip


def turns(machine: Machine) -> Iterator[Disagreement]:
    """A drive train takes the torque of the main shaft over as many revolutions as the cyclogram gives it."""
    for train in machine.of("drive_train"):
        target = train.target("torque_curve")
        if target is None or not machine.is_of(target.instance, "cyclogram"):
            continue
        timing, key = machine.parts[target.instance], "torque_curve_turns"
        own, other = train.number(key), timing.number(key)
        if own is not None and other is not None:
            yield Disagreement(
                train, (key,), timing, ("lines",), _differ(own, other),
                phrase("is {own}, but the torque curve of {timing} spans {other} revolutions of the main shaft; refer to its torque_curve_turns"),
                {"own": (own, "1"), "other": (other, "1"), "timing": timing.instance.name},
            )  # fmt: skip


def train_speeds(machine: Machine) -> Iterator[Disagreement]:
    """The shaft whose torque a drive train takes turns as fast as its output."""
    for train in machine.of("drive_train"):
        turned = train.number("torque_curve_turns")
        if turned is not None:
            # what the pulleys make of it is another result of this name
            asked = numbers_of(train.inputs["output_speed"])
            yield from _speed(machine, train, ("output_speed",), turned, asked)


RULES: tuple[Callable[[Machine], Iterator[Disagreement]], ...] = (
    named_shafts,
    seats,
    keys,
    pitch_radii,
    torque_seats,
    speeds,
    axial_forces,
    sprockets,
    turns,
    train_speeds,
)


def disagreements(machine: Machine) -> Iterator[Disagreement]:
    """Yield what does not agree in a machine, or in any of its variants."""
    return (each for rule in RULES for each in rule(machine) if np.any(each.wrong))


# What the parts of the machine are found to contradict: an error is refused when the file is read, all else is a check of the drive line.


DRIVE_LINE = "drive_line"  # the kind that has the checks of the machine's parts
FITS, CARRIED = "parts_fit", "torque_carried"
PlacedFinding = tuple[str, Phrase]  # the level of what a rule found, and what is said of it with its place


def placed_findings(parts: MachineParts | None, kind: str) -> tuple[PlacedFinding, ...]:
    """Return what the rules of the parts found, of the kind that has their checks; nothing of another one."""
    if parts is None or kind != DRIVE_LINE:
        return ()
    template = "{place}: {message}"
    return tuple(
        (each.level, Phrase(template, place=parts.line(each.path), message=each.message)) for each in parts.findings
    )


def finding_check(level: str, texts: Sequence[Phrase]) -> Check:
    """Return the check of what warns, or fails, of the parts."""
    is_failure = level == "fail"
    title, label = (
        (phrase("Torque carried"), phrase("parts that nothing joins to their shaft")) if is_failure
        else (phrase("Parts that fit each other"), phrase("doubtful places"))
    )  # fmt: skip
    return Check(CARRIED if is_failure else FITS, "function" if is_failure else "practice", title,
        CARRIED if is_failure else FITS, 0.0, severity="fail" if is_failure else "warn", unit="1", demand_label=label,
        limit_label=phrase("allowed"), consequence=Phrase("{findings}.", findings=joined(texts, "; ")))  # fmt: skip


def note_findings(calc: Calculation, findings: Sequence[PlacedFinding]) -> None:
    """Give the calculation of the drive line the checks of its parts; those that nothing contradicts are left out."""
    checks = []
    for level in ("warning", "fail"):
        if texts := [text for own, text in findings if own == level]:
            checks.append(finding_check(level, texts))
            calc.values[checks[-1].id] = np.full((calc.count, 1), float(len(texts)))
    calc.further_checks = (*(each for each in calc.further_checks if each.id not in (FITS, CARRIED)), *checks)
