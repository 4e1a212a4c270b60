"""The parts of a machine as they stand together: shafts with their sections and parts, what joins them, speeds, axes and places."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from math import hypot
from typing import Any, Literal

from diecut_report.config.parts.keys import PART_KINDS, BeltKeys, ChainKeys, MachineKeys, MeshKeys, PartKeys, ShaftKeys
from diecut_report.config.parts.reading import PartsReader
from diecut_report.config.validation import ConfigPlace
from diecut_report.config.yaml import KeyPath
from diecut_report.errors import nearest
from diecut_report.mechanics import drive_line
from diecut_report.quantities.units import unit
from diecut_report.standards import catalogue_size, standard_table
from diecut_report.text.phrases import Phrase

CREEP = 0.01  # share of its speed that a V-belt loses
SIDES = {
    "meshes": ("gear", "pair.0", "pair.1"),
    "chains": ("sprocket", "sprockets", "to"),
    "belts": ("pulley", "pulleys.0", "pulleys.1"),
}
"""Of each word the kind of the parts that are joined, and where the driving and the driven ones are named."""
SAME_PLACE = 0.05e-3  # m, by which two places that are one may differ
DEDENDUM = 1.25  # modules, of the basic rack (ISO 53, profile A)


@dataclass(frozen=True)
class ShaftSection:
    """Hold a section of a shaft, m: where it begins and ends from the left end."""

    index: int
    start: float
    end: float
    diameter: float
    bore: float
    fillet: float | None


@dataclass(frozen=True, eq=False)
class ShaftPart:
    """Hold a part on a shaft."""

    shaft: MachineShaft
    index: int
    keys: PartKeys
    more: tuple[str, ...]

    @cached_property
    def kind(self) -> str:
        """Return its kind: bearing, gear, crank …"""
        return next(kind for kind in PART_KINDS if getattr(self.keys, kind) is not None)

    @property
    def name(self) -> str:
        """Return its name on the shaft."""
        return str(getattr(self.keys, self.kind))

    @property
    def path(self) -> KeyPath:
        """Return where it stands in the file."""
        return (*self.shaft.path, "parts", self.index)

    @property
    def called(self) -> str:
        """Return what messages and results call it: SHAFT.NAME."""
        return f"{self.shaft.name}.{self.name}"

    @cached_property
    def section(self) -> ShaftSection | None:
        """Return the section that its middle lies on."""
        return self.shaft.section_at(self.keys.at)

    @cached_property
    def seat(self) -> float:
        """Return the diameter of the shaft at its middle, m; 0 where the shaft is not modelled."""
        return self.section.diameter if self.section else 0.0

    @cached_property
    def hub(self) -> float:
        """Return the length of its hub or ring along the shaft, m."""
        if self.keys.hub is not None:
            return self.keys.hub
        return (self.size("B") if self.kind == "bearing" else self.keys.width) or 0.0

    def size(self, column: Literal["d", "D", "B", "r"]) -> float | None:
        """Return a dimension of a bearing, m: as typed, else of the catalogue; r is the least corner of its inner ring."""
        typed = {"d": self.keys.bore, "D": self.keys.outside, "B": self.keys.width, "r": self.keys.corner}[column]
        return typed if typed is not None or not self.keys.designation else catalogue_size(self.keys.designation, column)  # fmt: skip

    @property
    def ends(self) -> tuple[float, float]:
        """Return where its hub begins and ends, m from the shaft's left end."""
        return self.keys.at - self.hub / 2, self.keys.at + self.hub / 2

    @cached_property
    def shoulders(self) -> dict[str, tuple[ShaftSection, float | None]]:
        """Return the thicker sections that it touches, by its side, left or right, each with the fillet radius of the step."""
        sections, own = self.shaft.sections, self.section
        if own is None:
            return {}
        beside = {"left": (own.index - 1, own.start - self.ends[0]), "right": (own.index + 1, own.end - self.ends[1])}
        return {
            side: (sections[index], sections[min(index, own.index)].fillet)
            for side, (index, gap) in beside.items()
            if index in range(len(sections)) and abs(gap) <= SAME_PLACE and sections[index].diameter > own.diameter + SAME_PLACE
        }  # fmt: skip

    @property
    def is_carried(self) -> bool:
        """Return whether something joins it to the shaft that carries a torque and can be rated or named."""
        keys = self.keys
        return bool(keys.key or keys.integral or keys.bolted or keys.interference or keys.rides_on)

    @property
    def outward(self) -> int:
        """Return +1 where it stands right of the middle of the bearings, so that its outer face is the right one, else −1."""
        return 1 if self.keys.at >= self.shaft.middle else -1

    @cached_property
    def plane(self) -> float:
        """Return the plane of its pin, or of its force, m from the shaft's left end."""
        pin, beyond = self.keys.pin, self.keys.plane
        if pin is not None and pin.span_start is not None and pin.span_end is not None:
            return self.keys.at + pin.plane - (pin.span_start + pin.span_end) / 2
        distance = pin.plane if pin is not None else beyond
        return self.keys.at if distance is None else self.keys.at + self.outward * (self.hub / 2 + distance)

    def calculation(self, of: Literal["key", "pin"]) -> str:
        """Return the name of the calculation of its key or its pin."""
        return f"{self.shaft.calculation}_{self.name}_{of}"

    @property
    def port(self) -> tuple[str, str] | None:
        """Return the mechanism and the port that it is of."""
        mechanism, _, port = (self.keys.of or "").partition(".")
        return (mechanism, port) if port else None


@dataclass(frozen=True, eq=False)
class MachineShaft:
    """Hold a shaft."""

    name: str
    keys: ShaftKeys
    path: KeyPath
    more: tuple[str, ...]
    parts: list[ShaftPart] = field(default_factory=list)

    @property
    def calculation(self) -> str:
        """Return the name of its calculation; those of its body, loads and bearings begin with it."""
        return f"shafts_{self.name}"

    @property
    def body(self) -> str:
        """Return the name of the calculation of its mass and inertia."""
        return f"{self.calculation}_body"

    @property
    def loads(self) -> str:
        """Return the name of the calculation of its loads."""
        return f"{self.calculation}_loads"

    @property
    def bearing_calculation(self) -> str:
        """Return the name of the calculation of its bearings and those of its pins."""
        return f"{self.calculation}_bearings"

    @cached_property
    def sections(self) -> tuple[ShaftSection, ...]:
        """Return its sections from left to right."""
        found, start = [], 0.0
        for index, each in enumerate(self.keys.sections):
            found.append(ShaftSection(index, start, start + each.length, each.diameter, each.bore, each.fillet_radius))
            start += each.length
        return tuple(found)

    @property
    def length(self) -> float:
        """Return its length, m."""
        return self.sections[-1].end if self.sections else 0.0

    def section_at(self, place: float) -> ShaftSection | None:
        """Return the section at a place; at a step the one to its right."""
        for each in self.sections:
            if each.start - SAME_PLACE <= place < each.end or place == each.end == self.length:
                return each
        return None

    @property
    def bearings(self) -> list[ShaftPart]:
        """Return its bearings from left to right."""
        return sorted(self.of_kind("bearing"), key=lambda part: part.keys.at)

    def of_kind(self, kind: str) -> list[ShaftPart]:
        """Return its parts of a kind."""
        return [part for part in self.parts if part.kind == kind]

    @property
    def flywheel(self) -> ShaftPart | None:
        """Return the flywheel on it; None where there is none."""
        return next(iter(self.of_kind("flywheel")), None)

    @property
    def middle(self) -> float:
        """Return the middle between its bearings, m."""
        own = [part.keys.at for part in self.bearings] or [self.length / 2]
        return (own[0] + own[-1]) / 2

    @property
    def is_rated(self) -> bool:
        """Return whether it is calculated: one of a motor is its maker's."""
        return self.keys.motor is None

    @property
    def has_body(self) -> bool:
        """Return whether its mass and inertia are calculated."""
        return self.is_rated and bool(self.sections)


@dataclass(frozen=True, eq=False)
class Join:
    """Hold what joins two shafts: a mesh, a chain or a belt, from the driving part to the driven one (none: to a mechanism)."""

    word: str
    index: int  # among those of its word
    name: str
    keys: Any
    path: KeyPath
    more: tuple[str, ...]
    drivers: tuple[ShaftPart, ...]
    driven: tuple[ShaftPart, ...]

    @property
    def parts(self) -> tuple[ShaftPart, ...]:
        """Return its driving parts and then the driven ones."""
        return (*self.drivers, *self.driven)

    @property
    def moves(self) -> tuple[str, str] | None:
        """Return the mechanism of which a chain moves a part, and that: cylinder or conveyor; None of a join that moves none."""
        mechanism, dot, what = (getattr(self.keys, "moves", None) or "").partition(".")
        return (mechanism, what) if mechanism or dot else None

    @property
    def driving_shaft(self) -> MachineShaft:
        """Return the shaft that it is driven by."""
        return self.drivers[0].shaft

    @property
    def driven_shaft(self) -> MachineShaft:
        """Return the shaft that it drives; IndexError where it drives none."""
        return self.driven[0].shaft

    @property
    def sizes(self) -> tuple[float, float]:
        """Return what its ratio is of, on the driving and on the driven side: numbers of teeth, or diameters of pulleys in m."""
        if isinstance(self.keys, BeltKeys):
            return self.keys.diameter_1, self.keys.diameter_2
        return self.keys.teeth_1, self.keys.teeth_2 or self.keys.teeth_1

    @property
    def ratio(self) -> float:
        """Return the speed of the driven shaft for each of the driving one; below zero where it turns the other way."""
        ratio = float(drive_line.speed_ratio(*self.sizes))
        if isinstance(self.keys, MeshKeys):
            return -ratio
        return ratio * (1 - CREEP) if isinstance(self.keys, BeltKeys) else ratio

    @property
    def calculation(self) -> str:
        """Return the name of its own calculation; a belt's is part of the drive train."""
        return f"{self.word}_{self.name}"

    @property
    def home(self) -> str:
        """Return where its numbers stand among the inputs of the calculation of the whole drive line."""
        return f"drive_line.{self.word}.{self.index}"

    @property
    def ratio_text(self) -> str:
        """Return the ratio without its sign as an expression, of references to what it follows from."""
        if isinstance(self.keys, BeltKeys):
            return f"(${{{self.home}.diameter_1}} / ${{{self.home}.diameter_2}} * {1 - CREEP:g})"
        return f"(${{{self.home}.teeth_1}} / ${{{self.home}.teeth_2}})"

    def radius(self, part: ShaftPart) -> float:
        """Return the pitch radius of one of its parts, m."""
        keys, size = self.keys, self.sizes[part not in self.drivers]
        match keys:
            case MeshKeys():
                return float(drive_line.pitch_radius(keys.module, size, keys.helix_angle))
            case ChainKeys():
                return float(drive_line.sprocket_diameter(chain_pitch(keys), size)) / 2
        return size / 2

    def root(self, part: ShaftPart) -> float | None:
        """Return the diameter of a gear or sprocket below its teeth, m; None of a pulley."""
        if isinstance(self.keys, MeshKeys):
            return float(drive_line.root_diameter(2 * self.radius(part), self.keys.module, DEDENDUM, 0))
        if isinstance(self.keys, ChainKeys):
            rollers = standard_table("iso_606_roller_diameters")
            return 2 * self.radius(part) - float(rollers.values[self.keys.chain] * unit(rollers.unit).factor)
        return None

    @property
    def center_distance(self) -> float | None:
        """Return the distance of the axes that follows from the join itself, m; None of a belt, which is tensioned."""
        if isinstance(self.keys, MeshKeys):
            return float(drive_line.center_distance(self.radius(self.drivers[0]), self.radius(self.driven[0])))
        if isinstance(self.keys, ChainKeys) and self.driven:
            free = drive_line.free_links(self.keys.links, *self.sizes)
            room = max(float(drive_line.links_discriminant(free, *self.sizes)), 0.0)
            return float(drive_line.chain_center_distance(chain_pitch(self.keys), free, room))
        return None


def chain_pitch(keys: ChainKeys) -> float:
    """Return the pitch of a chain, m."""
    table = standard_table("iso_606_pitches")
    return float(table.values[keys.chain] * unit(table.unit).factor)


@dataclass(eq=False)
class MachineParts:
    """Hold all parts of a machine; ``mechanisms`` are the kinds of the mechanisms by their names."""

    reader: PartsReader
    keys: MachineKeys
    axes: Mapping[str, tuple[float, float]]
    mechanisms: Mapping[str, str]
    shafts: dict[str, MachineShaft] = field(default_factory=dict)
    joins: list[Join] = field(default_factory=list)
    findings: list[Any] = field(default_factory=list)
    # calculations, and keys of mechanisms, that follow from the parts
    derived: set[KeyPath] = field(default_factory=set)
    sources: dict[KeyPath, KeyPath | None] = field(default_factory=dict)  # where each, and each key of it, is typed
    # those that are made of parts, with the part: shafts.crank
    calculations: dict[str, str] = field(default_factory=dict)

    @staticmethod
    def read(reader: PartsReader, mechanisms: Mapping[str, str]) -> MachineParts | None:
        """Return the parts of a file; None where they cannot be read, with what is wrong in the reader's problems."""
        machine = reader.machine()
        if machine is None:
            return None
        found = MachineParts(reader, machine.keys, reader.frame(), mechanisms)
        for name, block in reader.blocks("shafts"):
            shaft = found.shafts[name] = MachineShaft(name, block.keys, block.path, block.more)
            raw = reader.data["shafts"][name]["parts"]
            for index, keys in enumerate(block.keys.parts):
                more = tuple(key for key in raw[index] if key not in PartKeys.model_fields)
                shaft.parts.append(ShaftPart(shaft, index, keys, more))
        for word in ("meshes", "chains", "belts"):
            for name, block in reader.blocks(word):
                found._join(word, name, block.keys, block.path, block.more)
        if machine.keys.anchor not in found.shafts and not reader.problems:
            name, known = machine.keys.anchor, ", ".join(found.shafts)
            template = "is {name}, which is not one of the shafts{near}; they are {shafts}"
            near = nearest(name, found.shafts)
            found.fault(("machine", "anchor"), template, name=name, near=near, shafts=known)
        return found

    @property
    def every_part(self) -> list[ShaftPart]:
        """Return the parts of all shafts."""
        return [part for shaft in self.shafts.values() for part in shaft.parts]

    def fault(self, path: KeyPath, template: str, **values: object) -> None:
        """Note what is wrong with what stands at a path."""
        self.reader.problems.append(ConfigPlace(self.reader.tree).problem(path, Phrase(template, **values)))

    def follows(self, node: KeyPath) -> bool:
        """Return whether an input of a mechanism follows from the parts."""
        return node[:1] in self.derived or node[:2] in self.derived

    def is_made_with(self, node: KeyPath) -> bool:
        """Return whether the parts are made with an input of a mechanism or of the press: they change with it."""
        return ".".join(map(str, node)) in self.reader.read

    def where(self, path: KeyPath) -> str:
        """Return the file, line and column of a path, as messages name a second place."""
        line, column = self.reader.tree.position(path)
        return f"{self.reader.tree.file}:{line}:{column}"

    def typed_at(self, node: KeyPath) -> KeyPath | None:
        """Return where the value of an input that follows from the parts is typed, or may be; None where it is of no single place."""
        home = self.sources.get(node[:1])
        path = self.sources[node] if node in self.sources else (*home, *node[1:]) if home else None
        is_block = path is not None and "value" in (self.reader.tree.node(path).children or {})
        return (*path, "value") if path is not None and is_block else path

    def called(self, place: KeyPath) -> str:
        """Return what a place is called: a part of a shaft by its name, ``shafts.main.parts.wheel.hub``; a value as its key."""
        path = tuple(step for step in place if step != "value")
        if path[0] == "shafts" and path[2:3] == ("parts",):
            names = (part.name for part in self.shafts[str(path[1])].parts if part.path == path[:4])
            path = (*path[:3], next(names, path[3]), *path[4:])
        return ".".join(map(str, path))

    def line(self, path: KeyPath) -> Phrase:
        """Return the path with its line, as results name a place: where the file stands is not of the machine."""
        return Phrase("{path}, line {line}", path=".".join(map(str, path)), line=self.reader.tree.position(path)[0])

    def _join(self, word: str, name: str, keys: Any, path: KeyPath, more: tuple[str, ...]) -> None:
        kind, first, second = SIDES[word]
        sides: list[tuple[ShaftPart, ...]] = []
        for key in (first, second):
            texts, _, number = key.partition(".")
            places = [int(number)] if number else range(len(getattr(keys, texts)))
            found = [self._named(getattr(keys, texts)[place], kind, (*path, texts, place)) for place in places]
            if None in found:
                return
            sides.append(tuple(part for part in found if part is not None))
        if any(one.shaft is other.shaft for one in sides[0] for other in sides[1]):
            self.fault(path, "joins parts of one shaft; it drives one shaft by another")
            return
        index = sum(each.word == word for each in self.joins)
        self.joins.append(Join(word, index, name, keys, path, more, sides[0], sides[1]))

    def _named(self, text: str, kind: str, path: KeyPath) -> ShaftPart | None:
        """The part that SHAFT.NAME names; None where there is none, which is noted."""
        shaft, _, name = text.partition(".")
        shafts = self.reader.data["shafts"]
        is_unread = shaft in shafts if isinstance(shafts, dict) else shafts is not None
        if shaft not in self.shafts and is_unread:  # which is told there
            return None
        own = {part.name: part for part in self.shafts[shaft].of_kind(kind)} if shaft in self.shafts else {}
        if name in own:
            return own[name]
        known = [part.called for part in self.every_part if part.kind == kind]
        template = "names {text}, but there is no such {kind}{near}; there are {known}"
        self.fault(path, template, text=text, kind=kind, near=nearest(text, known), known=", ".join(known) or "none")
        return None

    # How the shafts turn.

    @cached_property
    def routes(self) -> dict[str, list[tuple[Join, bool]]]:
        """Return the joins from the anchor to each shaft that turns steadily, each with whether it is passed towards the driven side."""
        found: dict[str, list[tuple[Join, bool]]] = {self.keys.anchor: []}
        while True:
            more: dict[str, list[tuple[Join, bool]]] = {}
            for join in (each for each in self.joins if each.driven):
                one, other = join.driving_shaft.name, join.driven_shaft.name
                if one in found and other not in found:
                    more.setdefault(other, [*found[one], (join, True)])
                if other in found and one not in found:
                    more.setdefault(one, [*found[other], (join, False)])
            if not more:
                return found
            found |= more

    @cached_property
    def ratios(self) -> dict[str, float]:
        """Return the speeds of the shafts that turn steadily, for one turn of the anchor."""
        found = dict.fromkeys(self.routes, 1.0)
        for shaft, route in self.routes.items():
            for join, onward in route:
                found[shaft] = found[shaft] * join.ratio if onward else found[shaft] / join.ratio
        return found

    def driving_join(self, shaft: MachineShaft) -> Join | None:
        """Return the join by which a shaft is driven."""
        return next((each for each in self.joins if any(part.shaft is shaft for part in each.driven)), None)

    def driving_joins(self, shaft: MachineShaft) -> list[Join]:
        """Return the joins by which a shaft is driven, the nearest first; of shafts that drive each other each join once."""
        found: list[Join] = []
        while (join := self.driving_join(shaft)) is not None and join not in found:
            found.append(join)
            shaft = join.driving_shaft
        return found

    def chain_from(self, start: str, shaft: str) -> list[Join]:
        """Return the joins by which a shaft drives another one, the first of them first; none where it does not."""
        way = self.driving_joins(self.shafts[shaft])
        places = [place for place, join in enumerate(way) if join.driving_shaft.name == start]
        return way[places[0] :: -1] if places and shaft != start else []

    def is_behind_anchor(self, shaft: MachineShaft) -> bool:
        """Return whether the main shaft drives a shaft, or is it."""
        return shaft.name == self.keys.anchor or bool(self.chain_from(self.keys.anchor, shaft.name))

    @cached_property
    def brakes(self) -> dict[ShaftPart, str]:
        """Return the brakes on shafts that turn steadily, each with its row in the drive line: ``clutch_brakes.0`` behind a clutch."""
        found: dict[ShaftPart, str] = {}
        for part in self.every_part:
            if part.shaft.name in self.ratios and part.keys.brake_torque:
                word = "clutch_brakes" if self.is_behind_clutch(part) else "brakes"
                found[part] = f"{word}.{sum(each.startswith(word) for each in found.values())}"
        return found

    def from_flywheel(self, part: ShaftPart) -> list[Join] | None:
        """Return the joins between a part's shaft and that of the flywheel which drives it, the nearest first; None where none does."""
        joins = self.driving_joins(part.shaft)
        shafts = [part.shaft, *(join.driving_shaft for join in joins)]
        return next((joins[:count] for count, shaft in enumerate(shafts) if shaft.flywheel), None)

    def is_braked(self, part: ShaftPart) -> bool:
        """Return whether a brake may stand where a part does: from the flywheel's shaft to the main one, or behind a clutch."""
        anchor = self.shafts[self.keys.anchor]
        before = self.from_flywheel(anchor.parts[0]) if anchor.parts else None
        between = {anchor.name, *(join.driving_shaft.name for join in before or ())}
        is_driven = part.shaft.name in self.ratios and self.from_flywheel(part) is not None
        return is_driven and (part.shaft.name in between or self.is_behind_clutch(part))

    def is_behind_clutch(self, part: ShaftPart) -> bool:
        """Return whether a clutch is between a part and the flywheel that drives its shaft."""
        joins = self.from_flywheel(part) or []
        first = joins[-1].driving_shaft if joins else part.shaft
        between = [*(each for join in joins for each in join.parts), *first.of_kind("flywheel")]
        clutches = {each.called for each in self.every_part if each.kind == "clutch"}
        return any(f"{each.shaft.name}.{each.keys.rides_on}" in clutches for each in between)

    def joins_of(self, part: ShaftPart) -> Iterator[Join]:
        """Yield the joins that a part takes part in."""
        yield from (each for each in self.joins if part in each.parts)

    def body_radius(self, part: ShaftPart) -> float | None:
        """Return the radius of a part's body, m: its pitch radius, or its outer one; None where it is not known."""
        if join := self.join_of(part):
            return join.radius(part)
        if part.kind == "clutch" and self.mechanisms.get(part.name) == "clutch":
            return self.reader.typed_number(part.name, "shoe_radius")
        return None if part.keys.outside is None else part.keys.outside / 2

    def join_of(self, part: ShaftPart, word: str = "") -> Join | None:
        """Return the join that a part takes part in, of this word where one is given; None where there is none."""
        return next((each for each in self.joins_of(part) if word in ("", each.word)), None)

    def body_width(self, part: ShaftPart) -> float:
        """Return the width of a part's body along its shaft, m."""
        join = self.join_of(part)
        return part.keys.width or (join.keys.width if join and isinstance(join.keys, MeshKeys) else part.hub)

    def motion_port(self, shaft: MachineShaft) -> ShaftPart | None:
        """Return the part of the port whose mechanism moves the shaft's group to and fro, or in steps; None of one that turns steadily."""
        if shaft.name in self.ratios:
            return None
        tied = (each for name, each in self.shafts.items() if name in self.groups[shaft.name])
        return next((part for each in tied for part in each.parts if part.port), None)

    @cached_property
    def groups(self) -> dict[str, set[str]]:
        """Return the shafts that joins tie to each shaft, with itself."""
        found = {name: {name} for name in self.shafts}
        for join in (each for each in self.joins if each.driven):
            tied = set[str]().union(*(found[part.shaft.name] for part in join.parts))
            found |= dict.fromkeys(tied, tied)
        return found

    # Where the shafts stand along their axes.

    @cached_property
    def planes(self) -> list[tuple[ShaftPart, float, ShaftPart, float]]:
        """Return what must lie in one plane: two parts, each with its plane from its shaft's left end, m."""
        # of strands each
        pairs = (pair for each in self.joins for pair in zip(each.drivers, each.driven, strict=False))
        found = [(one, one.keys.at, other, other.keys.at) for one, other in pairs]
        ports = {part.port: part for part in self.every_part if part.port}
        for (mechanism, port), part in ports.items():
            other = ports.get((mechanism, {"crank": "rocker", "disc": "gear"}.get(port, "wheel")))
            if port in ("crank", "disc") and other is None:
                other = ports.get((mechanism, "wheel"))
            if port in ("crank", "disc") and other is not None:
                found.append((part, part.plane, other, other.plane if other.keys.pin else other.keys.at))
        return found

    @cached_property
    def lefts(self) -> dict[str, float]:
        """Return the axial places of the shafts' left ends, m: typed, else by the first join; the anchor's is 0."""
        found = {name: shaft.keys.left for name, shaft in self.shafts.items() if shaft.keys.left is not None}
        found.setdefault(self.keys.anchor, 0.0)
        while True:
            more: dict[str, float] = {}
            for one, here, other, there in self.planes:
                first, second = one.shaft.name, other.shaft.name
                if first in found and second not in found:
                    more.setdefault(second, found[first] + here - there)
                if second in found and first not in found:
                    more.setdefault(first, found[second] + there - here)
            if not more:
                return found
            found |= more

    def distance(self, one: str, other: str) -> float | None:
        """Return the distance of two axes in the frame, m; None where one is not there."""
        if one not in self.axes or other not in self.axes:
            return None
        (x, y), (u, v) = self.axes[one], self.axes[other]
        return hypot(u - x, v - y)
