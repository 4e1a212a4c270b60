"""What takes a torque from which shaft, how fast the shafts turn, and after how many sheets all are back at their start."""

from __future__ import annotations

from collections.abc import Container, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from math import atan2, cos, lcm, prod, sin
from typing import Any, NamedTuple

from diecut_report.config.parts.keys import ChainKeys, MeshKeys
from diecut_report.config.parts.model import Join, MachineParts, MachineShaft, ShaftPart
from diecut_report.config.validation import value_at
from diecut_report.config.yaml import KeyPath
from diecut_report.mechanics.timing.intervals import exact_turns
from diecut_report.mechanism.mechanism import Mechanism, Port

SAME = 1e-9  # of two efficiencies
USUAL_STEPS = 6  # of a Geneva wheel whose slots are not typed


@dataclass(frozen=True)
class Typed:
    """Stand for what is typed at a path of the file, with its basis; with ``text`` for a number that a text there holds, or that follows from it.

    Such a number has the basis of all parts. ``within`` is where it would be typed if the text were written as a block; nothing where it
    is not typed as it is.
    """

    path: KeyPath
    text: str = ""
    within: KeyPath = ()

    @property
    def place(self) -> KeyPath | None:
        """Return where the value is typed, or would be in a block; None of one that only follows from what is typed."""
        return (*self.path, *self.within) if self.within or not self.text else None


@dataclass(frozen=True, eq=False)
class Element:
    """Hold a calculation made of the parts: its name, kind and inputs, the part that it is of, and where that stands."""

    name: str
    kind: str
    inputs: dict[str, Any]
    path: KeyPath


@dataclass(frozen=True)
class Ratio:
    """Hold a factor: a number, and expressions that it is multiplied by."""

    number: float
    factors: tuple[str, ...] = ()

    def times(self, *factors: str, number: float = 1.0) -> Ratio:
        """Return the factor with more of them."""
        return Ratio(self.number * number, (*self.factors, *factors))

    @property
    def text(self) -> Any:
        """Return it as it stands in a configuration."""
        return " * ".join((f"{self.number:.15g}", *self.factors)) if self.factors else self.number


class Loss(NamedTuple):
    """Hold the efficiency of a part of a torque's way, and where it is typed; nothing where it is a default."""

    efficiency: float
    path: KeyPath = ()


class PlacedPort(NamedTuple):
    """Hold a port of a mechanism and the part that stands for it."""

    mechanism: str
    port: Port
    part: ShaftPart

    @property
    def takes_torque(self) -> bool:
        """Return whether the mechanism takes a torque there, and does not move the shaft."""
        return bool(self.port.torque) and not self.port.angle


class LineOfAxes(NamedTuple):
    """Hold the direction (rad) from the axis of a mechanism's turning shaft to its other one, and the sense in which the former turns."""

    angle: float
    sense: int

    def shares(self) -> tuple[tuple[float, float], ...]:
        """Return what forces along and across the line have in the directions y and z of the shafts, the frame's x and y."""
        along, across = cos(self.angle), sin(self.angle)
        return (along, across), (-self.sense * across, self.sense * along)


def millimetres(value: float) -> str:
    """Return a length as it is written in a configuration."""
    return f"{value * 1e3:.12g} mm"


def typed_paths(value: Any) -> Iterator[KeyPath]:
    """Yield where the numbers that a value is made of are typed; of references nothing."""
    match value:
        case Typed(path=path):
            yield path
        case dict() | list():
            for part in value.values() if isinstance(value, dict) else value:
                yield from typed_paths(part)


def first_place(value: Any) -> KeyPath | None:
    """Return where the first number that a value is made of is typed; None where it is made of references alone."""
    return next(typed_paths(value), None)


def _is_of_machine(value: Any) -> bool:
    return isinstance(value, Typed) and not value.text and value.path[0] == "machine"


@dataclass(eq=False)
class Demands:
    """Know what the parts take from their shafts; ``blocks`` are the mechanisms as the file has them, ``of_kind`` the declarations of their kinds."""

    parts: MachineParts
    blocks: Mapping[str, Any]
    of_kind: Mapping[str, Mechanism]
    made: list[Element] = field(default_factory=list)
    fills: dict[str, dict[str, Any]] = field(default_factory=dict)
    twice: list[tuple[KeyPath, KeyPath]] = field(default_factory=list)  # typed keys that follow, each with from where
    counted: set[KeyPath] = field(default_factory=set)  # typed efficiencies that count in a torque
    _torques: dict[ShaftPart, dict[str, Any] | None] = field(default_factory=dict)
    _inertial: dict[MachineShaft, dict[str, Any] | None] = field(default_factory=dict)
    _inertias: dict[str, dict[ShaftPart | None, dict[str, Any]]] = field(default_factory=dict)

    def _beside(
        self,
        inputs: Mapping[str, Any],
        more: Iterable[str],
        path: KeyPath,
        source: KeyPath,
        follows: Container[str] = (),
    ) -> dict[str, Typed]:
        """The keys of a part that go on to its calculation, which has ``inputs`` already.

        What follows from the parts (of itself, or from ``source``) is not typed again, which is noted; what ``machine`` gives
        all of them may be.
        """
        found = {}
        for key in more:
            derived = inputs.get(key)
            if key in follows or (key in inputs and not _is_of_machine(derived)):
                self.twice.append(((*path, key), first_place(derived) or source))
            else:
                found[key] = Typed((*path, key))
        return found

    def _add(self, name: str, kind: str, inputs: dict[str, Any], path: KeyPath) -> None:
        self.made.append(Element(name, kind, inputs, path))

    def is_made(self, name: str) -> bool:
        """Return whether a calculation of this name is made."""
        return any(each.name == name for each in self.made)

    # How the machine turns.

    reference_speed = "${drive_line.reference_speed}"

    def named(self, kind: str) -> str | None:
        """Return the only mechanism of a kind."""
        found = [name for name, each in self.parts.mechanisms.items() if each == kind]
        return found[0] if len(found) == 1 else None

    @staticmethod
    def speed(shaft: str) -> str:
        """Return the reference to the speed of a shaft that turns steadily."""
        return f"${{drive_line.{shaft}_speed}}"

    def turns(self, shaft: str) -> Fraction:
        """Return the revolutions of a shaft for each of the main shaft: of one that turns in steps, in the mean; 0 of one that swings."""
        if shaft in self.parts.ratios:
            found = Fraction(1)
            for join, onward in self.parts.routes[shaft]:
                ratio = Fraction(abs(join.ratio)).limit_denominator(10_000) or Fraction(1, 10_000)
                found = found * ratio if onward else found / ratio
            return found
        moving = self.moved_by(self.parts.shafts[shaft])
        if moving is None or not moving.port.advance:
            return Fraction(0)
        steps = self.parts.reader.typed_number(moving.mechanism, moving.port.advance)
        found = self.line(moving.mechanism)[0] / max(int(USUAL_STEPS if steps is None else steps), 1)
        for join in self.parts.chain_from(moving.part.shaft.name, shaft):
            found *= Fraction(abs(join.ratio)).limit_denominator(10_000)
        return found

    def sense(self, shaft: str) -> int:
        """Return +1 for a shaft that turns, or whose angle is counted, as the shaft which is seen turning anticlockwise in the frame, else −1."""
        if shaft in self.parts.ratios:
            return 1 if self.parts.ratios[shaft] * self.parts.ratios[self._reference] > 0 else -1
        moving = self.moved_by(self.parts.shafts[shaft])
        if moving is None:
            return 1
        joins = self.parts.chain_from(moving.part.shaft.name, shaft)
        turned = sum(isinstance(join.keys, MeshKeys) for join in joins) + moving.port.backwards
        sense = self.line_of_axes(moving.mechanism).sense
        return -sense if turned % 2 else sense

    def line_of_axes(self, mechanism: str) -> LineOfAxes:
        """Return how the line between the axes of a mechanism's two shafts lies in the frame."""
        shafts = [part.shaft.name for part in self.parts.every_part if part.port and part.port[0] == mechanism]
        turning = next((name for name in shafts if name in self.parts.ratios), "")
        other = next((name for name in shafts if name not in self.parts.ratios), "")
        sense = self.sense(turning) if turning else 1
        if not {turning, other} <= self.parts.axes.keys():
            return LineOfAxes(0.0, sense)
        (x, y), (u, v) = self.parts.axes[turning], self.parts.axes[other]
        return LineOfAxes(atan2(v - y, u - x), sense)

    @property
    def _reference(self) -> str:
        """The shaft that is seen turning anticlockwise in the frame: a linkage's crank, else any shaft with a mechanism's forces, else the anchor."""
        steady = (part for name in self.parts.ratios for part in self.parts.shafts[name].parts)
        directed = [placed for part in steady if (placed := self.port(part)) and len(placed.port.forces) > 1]
        linkages = [placed for placed in directed if not self._turns_in_steps(placed.mechanism)]
        return next((placed.part.shaft.name for placed in (*linkages, *directed)), self.parts.keys.anchor)

    def _turns_in_steps(self, mechanism: str) -> bool:
        return any(port.advance for port in self.of_kind[self.parts.mechanisms[mechanism]].ports)

    def moved_by(self, shaft: MachineShaft) -> PlacedPort | None:
        """Return by what a shaft swings or turns in steps; None of one that turns steadily."""
        part = self.parts.motion_port(shaft)
        return None if part is None else self.port(part)

    @property
    def period(self) -> int:
        """Return the revolutions of the main shaft after which all lines are back at their start."""
        return lcm(*(self.line(name)[0].denominator for name in self.parts.mechanisms))

    @cached_property
    def lines(self) -> list[Mapping[str, Any]]:
        """Return the blocks of the lines in the cyclogram; what is no block stands as an empty one."""
        lines = self.blocks.get(self.named("cyclogram") or "", {}).get("lines", [])
        return [line if isinstance(line, dict) else {} for line in lines] if isinstance(lines, list) else []

    def _line_place(self, mechanism: str) -> tuple[str, int, Mapping[str, Any]] | None:
        """The cyclogram, and a mechanism's line in it: its number from 0, and its block."""
        timing = self.named("cyclogram") or ""
        places = ((timing, index, line) for index, line in enumerate(self.lines) if line.get("mechanism") == mechanism)
        return next(places, None)

    def line(self, mechanism: str) -> tuple[Fraction, str]:
        """Return the revolutions of a mechanism for each of the main shaft, and the reference to its offset."""
        place = self._line_place(mechanism)
        if place is None:
            return Fraction(1), "0 deg"
        timing, index, line = place
        self.parts.reader.read.add(f"{timing}.lines.{index}.turns_per_sheet")
        try:
            turns = exact_turns(str(line.get("turns_per_sheet", "1")))
        except ValueError:
            turns = Fraction(1)
        return turns, f"${{{timing}.line_offset.{index}}}"

    def cycle(self, shaft: str) -> int:
        """Return the revolutions of the main shaft after which a shaft and the machine are back at their start."""
        return lcm(self.turns(shaft).denominator, self.period)

    def port(self, part: ShaftPart) -> PlacedPort | None:
        """Return the port that a part stands for."""
        mechanism, name = part.port or ("", "")
        declared = self.of_kind.get(self.parts.mechanisms.get(mechanism, ""))
        ports = (
            PlacedPort(mechanism, port, part) for port in (declared.ports if declared else ()) if port.name == name
        )
        return next(ports, None)

    @property
    def port_names(self) -> list[str]:
        """Return the ports of all mechanisms, as parts name them."""
        known = ((name, self.of_kind[kind]) for name, kind in self.parts.mechanisms.items() if kind in self.of_kind)
        return [f"{name}.{port.name}" for name, mechanism in known for port in mechanism.ports]

    # What the parts take from their shafts.

    def _source(self, name: str, mechanism: str, curve: str, sign: int) -> dict[str, Any]:
        turns, offset = self.line(mechanism)
        found = {"name": name, "mechanism": mechanism, "curve": curve, "turns_per_sheet": str(turns), "offset": offset}
        return found | {"ratio": Ratio(sign)}

    def torque_on(self, part: ShaftPart) -> dict[str, Any] | None:
        """Return what a part takes from its shaft, against its turning; None where nothing is known of it."""
        if part not in self._torques:  # it is asked for again and again, from every part before it
            self._torques[part] = None  # of shafts that drive each other, which is told where joins are judged
            self._torques[part] = self._torque_on(part)
        return self._torques[part]

    def _torque_on(self, part: ShaftPart) -> dict[str, Any] | None:
        placed = self.port(part)
        if placed and placed.takes_torque:
            taken = self._source(part.name, placed.mechanism, placed.port.torque, -1)
            lost = self._lost_before(placed)
            return taken | {"efficiency": (lost,)} if lost else taken
        for join in self.parts.joins_of(part):
            if part in join.drivers and (found := self._of_swing(part) or self._through(join, len(join.drivers))):
                return found | {"name": part.name}
            if part in join.driven and self.flywheel(part.shaft) and (found := self._motor_torque(part)):
                return found | {"name": part.name}
            # drives its share of the inertia, the first one the rest; of what else the shaft takes nobody knows the shares
            if part in join.driven[1:] and not self._takes(part.shaft) and (own := self.inertia_of(part.shaft)):
                return own | {"name": part.name, "ratio": own["ratio"].times(number=-1 / len(join.driven))}
        return None

    def _of_swing(self, part: ShaftPart) -> dict[str, Any] | None:
        """What a mechanism takes from the only gear on the shaft that it swings: losses behind that shaft, and the shaft's inertia, are in it."""
        moving = self.moved_by(part.shaft)
        drivers = [each for each in part.shaft.parts if any(each in join.drivers for join in self.parts.joins_of(each))]
        if moving is None or moving.part.shaft is not part.shaft or len(drivers) > 1:
            return None
        port = moving.port
        return None if port.advance or not port.torque else self._source(part.name, moving.mechanism, port.torque, -1)

    def lacks_torque(self, shaft: MachineShaft) -> bool:
        """Return whether the torque on one of a shaft's parts is not known, so that nothing that the shaft carries is."""
        is_judged = shaft.name == self.parts.keys.anchor and self.named("cyclogram") is not None
        return (is_judged and not self.is_whole) or any(self._is_unknown(part) for part in shaft.parts)

    @cached_property
    def is_whole(self) -> bool:
        """Return whether the lines of the cyclogram are what the parts take from the main shaft: no other torque, and no mechanism elsewhere."""
        timed = {str(line.get("mechanism")) for line in self.lines if line}
        behind = self.parts.is_behind_anchor
        return (
            not self.blocks.get(self.named("cyclogram") or "", {}).get("friction")
            and timed == {each.mechanism for each in self.taking if behind(each.part.shaft)}
            and all(behind(each.part.shaft) for each in self.taking)
            and not self._takes_more()
        )

    @property
    def taking(self) -> list[PlacedPort]:
        """Return the ports by which mechanisms take a torque from shafts that they do not move."""
        return [each for part in self.parts.every_part if (each := self.port(part)) and each.takes_torque]

    def _takes_more(self) -> bool:
        """Whether a shaft behind the main one, or one that a mechanism moves, takes a torque that no mechanism knows of."""
        anchor = self.parts.shafts[self.parts.keys.anchor]
        before = {name for name in self.parts.shafts if self.parts.chain_from(name, anchor.name)} | {anchor.name}
        after = [shaft for name, shaft in self.parts.shafts.items() if name not in before]
        joins = [join for join in self.parts.joins if join.driving_shaft in after]
        behind = [part for shaft in after if self.parts.is_behind_anchor(shaft) for part in shaft.parts]
        return (
            any("torque" in part.more for shaft in after for part in shaft.parts)
            or any(not join.driven and not join.moves for join in joins)
            or any(self._is_unknown(part) for part in behind)
        )

    def _is_unknown(self, part: ShaftPart) -> bool:
        if self.torque_on(part):
            return False
        driven = [each for each in self.parts.joins_of(part) if part in each.driven]
        follows_motor = self.flywheel(part.shaft) is not None and bool(driven)
        is_asked = follows_motor and bool(self.torques_of(part.shaft))
        is_shared = any(part in each.driven[1:] for each in driven) and self._takes(part.shaft)
        pulling = (each for each in driven if each.word == "chains" and not self.torque_on(each.drivers[0]))
        is_pulled = not all(self._takes_nothing(each) for each in pulling)
        driving = (each for each in self.parts.joins_of(part) if part in each.drivers)
        return is_asked or is_shared or is_pulled or not all(self._is_idle(each) for each in driving)

    def _takes(self, shaft: MachineShaft) -> bool:
        """Whether a shaft drives others, or a mechanism."""
        return any(part.port or any(part in join.drivers for join in self.parts.joins_of(part)) for part in shaft.parts)

    def _is_idle(self, join: Join) -> bool:
        """Whether a join drives a shaft of which is known that it takes nothing."""
        return self._takes_nothing(join) and not self.lacks_torque(join.driven_shaft)

    def _takes_nothing(self, join: Join) -> bool:
        """Whether a join drives a shaft of whose parts none is known to take a torque, and moves nothing else."""
        if not join.driven or join.moves:
            return False
        shaft = join.driven_shaft
        return not self._has_torque(shaft) and not self.torques_of(shaft)

    def flywheel(self, shaft: MachineShaft) -> ShaftPart | None:
        """Return the flywheel on a shaft that a motor drives by a belt; None where there is none, or nothing is known of the motor."""
        driving, train = self.parts.driving_join(shaft), self.named("drive_train")
        if driving is None or driving.word != "belts" or train is None:
            return None
        return shaft.flywheel

    def _motor_torque(self, part: ShaftPart) -> dict[str, Any] | None:
        """The motor's torque on the pulley beside a flywheel: it follows what the other parts take, and the flywheel gives the rest."""
        others = (self.torque_on(each) for each in part.shaft.parts if each is not part)
        demand = self._added([found for found in others if found])
        if demand is None:
            return None
        lag = f"${{{self.named('drive_train')}.motor_time_constant}} * {self.reference_speed}"
        return demand | {"ratio": demand["ratio"].times(number=-1), "lag": lag}

    def _through(self, join: Join, share: int) -> dict[str, Any] | None:
        """What a join takes from its driving shaft, each of several sprockets its share."""
        if isinstance(join.keys, ChainKeys) and (join.moves or not join.driven):
            return self._moved(join, share)
        driven = join.driven_shaft
        if any(each is not join and {*each.driven} & {*driven.parts} for each in self.parts.joins):
            return None  # how joins side by side share a torque is not known
        if driven.name == self.parts.keys.anchor and (timing := self.named("cyclogram")):
            if not self.is_whole:
                return None
            main: dict[str, Any] = {"mechanism": timing, "curve": "main_shaft_torque", "turns_per_sheet": "main"}
            demand: dict[str, Any] | None = main | {"ratio": Ratio(-1)}
        elif any(self._is_unknown(part) for part in driven.parts if part not in join.driven):
            return None
        else:
            demand = self._added([each for each in self.torques_of(driven) if "lag" not in each])
        if demand is None:
            return None
        found = demand | {"ratio": demand["ratio"].times(join.ratio_text, number=1 / share)}
        if isinstance(join.keys, MeshKeys) and not self._swings(driven):
            found["efficiency"] = (*demand.get("efficiency", ()), self.loss(join))
        return found

    def _lost_before(self, placed: PlacedPort) -> Loss | None:
        """What the cyclogram loses on the way to a mechanism beyond the meshes there: the mechanism takes as much more from its shaft."""
        place, shaft = self._line_place(placed.mechanism), placed.part.shaft
        if place is None or not self.parts.is_behind_anchor(shaft):
            return None
        timing, index, _ = place
        typed = self.parts.reader.typed_number(timing, f"lines.{index}.path_efficiency")
        way = self.parts.chain_from(self.parts.keys.anchor, shaft.name)
        meshes = prod(self.loss(join).efficiency for join in way)
        if typed is None or typed >= meshes - SAME:
            return None
        return Loss(typed / meshes, ("mechanisms", timing, "lines", index, "path_efficiency"))

    def loss(self, join: Join) -> Loss:
        """Return the efficiency of a join: chains and belts lose nothing here."""
        if not isinstance(join.keys, MeshKeys):
            return Loss(1.0)
        path = (*join.path, "efficiency") if "efficiency" in self._raw(join.path) else ()
        return Loss(join.keys.efficiency, path)

    def _swings(self, shaft: MachineShaft) -> bool:
        """Whether a shaft turns to and fro, so that the sign of a torque on it does not tell which way the power flows."""
        moving = self.moved_by(shaft)
        return moving is not None and not moving.port.advance

    def efficiency(self, losses: Sequence[Loss]) -> Any:
        """Return the efficiency of losses one behind the other: of a single mesh as it is typed, else the number."""
        typed, number = [each.path for each in losses if each.path], prod(each.efficiency for each in losses)
        self.counted.update(typed)
        if len(losses) == 1 and typed and typed[0][0] == "meshes":
            return Typed(typed[0])
        return Typed(typed[0], f"{number:.15g}") if typed else number

    def _added(self, every: list[dict[str, Any]]) -> dict[str, Any] | None:
        """The demands of several parts of one curve as one, such as of two chains side by side; None where they are unlike."""
        alike = {(each["mechanism"], each["curve"], each["ratio"].factors, each.get("efficiency")) for each in every}
        if len(alike) != 1:
            return None
        first = every[0]
        if "inertia" not in first:
            return first | {"ratio": Ratio(sum(each["ratio"].number for each in every), first["ratio"].factors)}
        inertia = " + ".join(f"{-each['ratio'].number:.15g} * ({each['inertia']})" for each in every)
        return first | {"ratio": Ratio(-1, first["ratio"].factors), "inertia": inertia}

    def inertia_of(self, shaft: MachineShaft) -> dict[str, Any] | None:
        """Return the torque that a shaft which swings or turns in steps takes by its inertia and the chains that roll a cylinder; None of others."""
        if shaft not in self._inertial:  # it is asked for at every part
            self._inertial[shaft] = self._inertia_of(shaft)
        return self._inertial[shaft]

    def _inertia_of(self, shaft: MachineShaft) -> dict[str, Any] | None:
        moving = self.moved_by(shaft)
        if moving is None or not moving.port.acceleration or any(self._of_swing(part) for part in shaft.parts):
            return None
        factors = tuple(each.ratio_text for each in self.parts.chain_from(moving.part.shaft.name, shaft.name))
        found = self._source("inertia", moving.mechanism, moving.port.acceleration, -1)
        rolling = (each for each in self.parts.joins if self.is_rolling(each) and each.driving_shaft is shaft)
        own = " + ".join([f"${{{shaft.body}.inertia}}", *(self.conveyor_inertia(each) for each in rolling)])
        return found | {"ratio": Ratio(-1, factors), "inertia": own}

    def is_rolling(self, join: Join) -> bool:
        """Return whether a join is a chain that rolls a cylinder."""
        mechanism, what = join.moves or ("", "")
        return what == "cylinder" and self.parts.mechanisms.get(mechanism) == "cylinder_drive"

    def is_calculated(self, chain: Join) -> bool:
        """Return whether a chain is calculated as a conveyor: one that says what of a mechanism it moves."""
        mechanism, what = chain.moves or ("", "")
        if chain.driven and self._drives_a_torque(chain.driven_shaft):
            return False
        return self.is_rolling(chain) or (what == "conveyor" and mechanism in self.parts.mechanisms)

    def torques_of(self, shaft: MachineShaft) -> list[dict[str, Any]]:
        """Return all torques on a shaft but the one that balances them; none where its parts take none."""
        found = [torque for part in shaft.parts if (torque := self.torque_on(part))]
        own = self.inertia_of(shaft)
        return [*found, own] if own else found

    def _moved(self, join: Join, share: int) -> dict[str, Any] | None:
        """What chains take from their sprockets to move the part of a mechanism that they name, each its share."""
        mechanism, what = join.moves or ("", "")
        if self.is_rolling(join):
            if join.driven:  # what the shaft over there takes follows another curve
                return None
            losses = f"1 / (${{{mechanism}.efficiency_chain}} * ${{{mechanism}.efficiency_bearings}})"  # also where it brakes: safe
            return self._source("", mechanism, "cylinder_moment", -1) | {"ratio": Ratio(-1 / share, (losses,))}
        ports = (placed for part in self.parts.every_part if (placed := self.port(part)))
        wheel = next((each for each in ports if each.mechanism == mechanism and each.port.advance), None)
        if wheel is None or what != "conveyor" or (join.driven and self._drives_a_torque(join.driven_shaft)):
            return None
        way = self.parts.chain_from(wheel.part.shaft.name, join.driving_shaft.name)
        inertia = self.conveyor_inertia(join)
        if join.driven:
            inertia += f" + ({self.inertia_behind(join.driven_shaft, has_losses=True)}) * {join.ratio_text}**2"
        ratio = Ratio(-1 / share, tuple(each.ratio_text for each in way))
        return self._source("", mechanism, wheel.port.torque, -1) | {"ratio": ratio, "inertia": inertia}

    def _drives_a_torque(self, start: MachineShaft) -> bool:
        """Whether a shaft, or one that it drives, takes a torque beside those of inertias."""
        shafts = self.parts.shafts.values()
        return any(
            self._has_torque(each) for each in shafts if each is start or self.parts.chain_from(start.name, each.name)
        )

    @staticmethod
    def _has_torque(shaft: MachineShaft) -> bool:
        """Whether a mechanism, or a typed torque, acts on one of a shaft's parts."""
        return any(part.port or "torque" in part.more for part in shaft.parts)

    def inertia_behind(self, start: MachineShaft, *chains: Join, has_losses: bool = False) -> str:
        """Return the inertia of a shaft with all that it drives, and with what these chains move, at that shaft.

        With the losses of the meshes between it counts for the torque that drives it; where it brakes that is safe.
        """
        group = [self.parts.shafts[name] for name in self.parts.shafts if name in self.parts.groups[start.name]]
        terms = []
        for shaft in (each for each in group if each.has_body):
            way = self.parts.chain_from(start.name, shaft.name)
            if shaft is start or way:
                meshes = [join for join in way if isinstance(join.keys, MeshKeys) and has_losses]
                lost = [f"{1 / prod(join.keys.efficiency for join in meshes):.12g}"] if meshes else []
                ratios = (f"{join.ratio_text}**2" for join in way)
                terms.append(" * ".join([f"${{{shaft.body}.inertia}}", *ratios, *lost]))
        for chain in chains:
            way = self.parts.chain_from(start.name, chain.driving_shaft.name)
            terms.append(" * ".join([self.conveyor_inertia(chain), *(f"{join.ratio_text}**2" for join in way)]))
        return " + ".join(terms)

    @staticmethod
    def conveyor_inertia(chain: Join) -> str:
        """Return the inertia of what a chain moves at its driving sprockets."""
        return f"${{drive_line.{chain.name}_chain_mass}} * (${{drive_line.{chain.name}_chain_travel}} / 1 rad)**2"

    def _raw(self, path: KeyPath) -> Mapping[str, Any]:
        data = value_at(self.parts.reader.data, path)
        return data if isinstance(data, dict) else {}
