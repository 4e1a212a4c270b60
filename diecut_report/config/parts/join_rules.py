"""Whether the axes of a machine stand where its meshes, chains and belts want them, and what these join fits."""

from __future__ import annotations

from collections.abc import Iterator
from math import inf, pi, prod
from typing import Any

from diecut_report.config.parts.elements import Elements
from diecut_report.config.parts.findings import Finding, Level, finding, mm, table_row
from diecut_report.config.parts.keys import BeltKeys, ChainKeys, MeshKeys
from diecut_report.config.parts.model import (
    SAME_PLACE,
    Join,
    MachineParts,
    MachineShaft,
    chain_pitch,
)
from diecut_report.quantities.units import UnitError, parse_quantity

RATIO = 1e-3  # relative, by which ratios may differ
SAME_RATIO = 1e-9  # relative: rounding
FURTHEST_RATE = 0.02  # relative, by which the press may be slower or faster than is asked for
BELT_CENTER = 0.02  # relative, by which tensioning moves an axis
WIDTH_TO_DIAMETER = 1.2  # of the pinion
WALL_WARNED, WALL_LEAST, HUB_OUTSIDE = 2.5, 1.0, 1.5  # modules below a tooth, and diameters of the seat


def axes(parts: MachineParts) -> Iterator[Finding]:
    """Shafts that are joined have axes in the frame: the direction of every force between them follows from these."""
    for join in (each for each in parts.joins if each.is_between_shafts):
        for shaft in dict.fromkeys(part.shaft.name for part in (*join.drivers, *join.driven)):
            if shaft not in parts.axes:
                template = "joins {shaft}, which has no axis in machine.frame, so that its forces have no direction; give {shaft}: [x, y] there"
                yield finding(parts, "frame", "error", join.path, template, ("machine",), shaft=shaft)


def driven(parts: MachineParts) -> Iterator[Finding]:
    """A shaft is driven by one other, or by a mechanism: joins name the driving part first, from the motor on and from each mechanism on."""
    for shaft in parts.shafts.values():
        joins = [each for each in parts.joins if any(part.shaft is shaft for part in each.driven)]
        port = parts.motion_port(shaft)
        if port is not None and port.shaft is shaft and joins:
            template = "drives {shaft}, which {mechanism} moves; name the part of {shaft} first, as the driving one"
            yield finding(
                parts, "driven", "error", joins[0].path, template, port.path, shaft=shaft.name, mechanism=port.keys.of
            )
        elif port is not None and port.shaft is not shaft and not joins:
            template = "is driven by no other shaft, though {mechanism} moves it by way of {other}; name the driving part of each join first"
            yield finding(
                parts, "driven", "error", shaft.path, template, port.path, mechanism=port.keys.of, other=port.shaft.name
            )
        elif len({each.drivers[0].shaft.name for each in joins}) > 1:
            one, other = list({each.drivers[0].shaft.name: each for each in joins}.values())[:2]
            template = "drives {shaft}, which {other} drives too; name the driving part of each join first"
            yield finding(parts, "driven", "error", other.path, template, one.path, shaft=shaft.name, other=one.name)
        elif unlike := next((each for each in joins[1:] if abs(each.ratio / joins[0].ratio - 1) > SAME_RATIO), None):
            one = joins[0]
            template = "turns {shaft} {there} times as fast as {driver}, but {other} {ratio} times, so that neither can turn; give both one ratio"
            yield finding(parts, "driven", "error", unlike.path, template, one.path, shaft=shaft.name, driver=one.drivers[0].shaft.name,
                there=f"{unlike.ratio:.6g}", other=one.name, ratio=f"{one.ratio:.6g}")  # fmt: skip
        elif joins and _drives_itself(parts, shaft):
            template = "closes a ring of shafts that drive each other; take one of its joins away"
            yield finding(parts, "driven", "error", joins[0].path, template)


def _drives_itself(parts: MachineParts, shaft: MachineShaft) -> bool:
    """Whether the shafts that drive a shaft, one behind the other, lead back to it."""
    seen, here = set[str](), shaft
    while (join := parts.driving_join(here)) is not None and here.name not in seen:
        seen.add(here.name)
        here = join.drivers[0].shaft
    return here is shaft and bool(seen)


def stages(parts: MachineParts, elements: Elements) -> Iterator[Finding]:
    """Between a rocker and what moves the cylinder there is one pair, the sector and the pinion, which the drive calculates."""
    for chain in (each for each in parts.joins if isinstance(each.keys, ChainKeys) and each.keys.moves):
        mechanism, _, what = str(chain.keys.moves).partition(".")
        port = next(
            (part for shaft in parts.shafts.values() for part in shaft.parts if part.port == (mechanism, "rocker")),
            None,
        )
        if port is None or what != "cylinder":
            continue
        way = elements.chain_from(port.shaft.name, chain.drivers[0].shaft.name)
        if len(way) > 1:
            template = "moves the cylinder {count} joins behind {shaft}; the drive has one pair between them: put its sprockets on the pinion's shaft"
            yield finding(
                parts, "stages", "error", chain.path, template, port.path, count=len(way), shaft=port.shaft.name
            )


def rate(parts: MachineParts, elements: Elements) -> Iterator[Finding]:
    """The motor, the pulleys and the teeth turn the main shaft as often as sheets are asked for."""
    name, press = elements.named("press_consistency") or "", parts.reader.data.get("press")
    required = elements.blocks.get(name, {}).get("required_rate")
    given: Any = required or (press.get("productivity") if isinstance(press, dict) else None)
    try:
        asked = parse_quantity(given["value"] if isinstance(given, dict) else given, "1/h")
    except (KeyError, TypeError, UnitError):  # a reference, or what is told where the rate is read
        return
    for join in (each for each in parts.joins if each.word == "belts"):
        motor = join.drivers[0].shaft
        if motor.keys.motor is None or motor.name not in parts.ratios or asked <= 0:
            continue
        parts.reader.read.add(f"{name}.required_rate" if required else "press.productivity")
        there = motor.keys.motor.speed / (2 * pi) / abs(parts.ratios[motor.name])
        if abs(there / asked - 1) > FURTHEST_RATE:
            template = "makes {there} sheets an hour of the motor's speed, but {asked} are asked for: change diameters, teeth or the rate"
            yield finding(parts, "rate", "error", (*join.path, "diameters"), template, (*motor.path, "motor", "speed"),
                there=f"{there * 3600:.4g}", asked=f"{asked * 3600:.4g}")  # fmt: skip


def losses(parts: MachineParts, elements: Elements) -> Iterator[Finding]:
    """The losses that the cyclogram knows of between the main shaft and a line are no less than those of the meshes there."""
    timing = elements.named("cyclogram")
    lines = elements.blocks[timing].get("lines", []) if timing else []
    for index, line in enumerate(lines if isinstance(lines, list) else []):
        name = str(line.get("mechanism")) if isinstance(line, dict) else ""
        part = next(
            (each for shaft in parts.shafts.values() for each in shaft.parts if each.port == (name, "crank")), None
        )
        if part is None:
            continue
        meshes = [
            join for join in elements.chain_from(parts.keys.anchor, part.shaft.name) if isinstance(join.keys, MeshKeys)
        ]
        typed = parts.reader.typed_number(str(timing), f"lines.{index}.path_efficiency")
        if typed is None and "path_efficiency" in line:
            template = "refers to what is calculated, so that the parts are not known to lose it, too; type a number"
            yield finding(
                parts, "losses", "error", ("mechanisms", str(timing), "lines", index, "path_efficiency"), template
            )
        said = 1.0 if typed is None else typed
        there = prod(join.keys.efficiency for join in meshes)
        if meshes and said > there + RATIO:
            template = "has the efficiency {there}, but the cyclogram calculates with {said} for {name}: the main shaft takes more than it says"
            yield finding(parts, "losses", "warning", meshes[0].path, template, ("mechanisms", str(timing), "lines", index),
                there=f"{there:.4g}", said=f"{said:.4g}", name=name)  # fmt: skip


def clutch_lines(parts: MachineParts, elements: Elements) -> Iterator[Finding]:
    """The lines that a clutch is said to drive are those behind it."""
    taking = [
        part
        for shaft in parts.shafts.values()
        for part in shaft.parts
        if (port := elements.port(part)) and port.torque and not port.angle
    ]
    behind = {part.port[0] for part in taking if part.port and parts.is_behind_clutch(part)}
    consistency = elements.named("press_consistency")
    typed = elements.blocks[consistency].get("clutch_drives") if consistency else None
    if behind and isinstance(typed, list) and {str(each) for each in typed} != behind:
        template = "is {typed}, but of the parts the clutch drives {behind}; name these"
        yield finding(parts, "losses", "error", ("mechanisms", str(consistency), "clutch_drives"), template,
            typed=", ".join(map(str, typed)), behind=", ".join(sorted(behind)))  # fmt: skip


def one_belt(parts: MachineParts) -> Iterator[Finding]:
    """One belt is calculated, with the drive train, which knows the motor that pulls it."""
    for join in [each for each in parts.joins if each.word == "belts"][1:]:
        template = "is a second belt; one alone is calculated, by the drive train: give what this one drives as a load of its shaft"
        yield finding(parts, "belt", "error", join.path, template)


def center(parts: MachineParts) -> Iterator[Finding]:
    """The axes of the frame are as far apart as a mesh, a chain or a belt wants."""
    for join in (each for each in parts.joins if each.is_between_shafts):
        is_belt = isinstance(join.keys, BeltKeys)
        one, other = join.drivers[0].shaft.name, join.driven[0].shaft.name
        there, wanted = parts.distance(one, other), belt_center(join) if is_belt else join.center_distance
        if is_belt and wanted is None:
            template = "is too short for its pulleys of {diameters}, which would touch; take a longer belt"
            diameters = f"{mm(join.keys.diameter_1)} / {mm(join.keys.diameter_2)}"
            yield finding(
                parts,
                "center",
                "error",
                (*join.path, "length"),
                template,
                (*join.path, "diameters"),
                diameters=diameters,
            )
        if there is None or wanted is None:
            continue
        allowed, what = SAME_PLACE, "teeth or module"
        if is_belt:
            allowed, what = BELT_CENTER * wanted, "length or diameters"
        elif isinstance(join.keys, ChainKeys):
            allowed, what = chain_pitch(join.keys) / 2, "links"
        if abs(there - wanted) > allowed:
            template = "puts the axes {wanted} apart, but in the frame {one} and {other} are {there} apart; move an axis or change {what}"
            yield finding(parts, "center", "error", join.path, template, ("machine", "frame", other), wanted=mm(wanted), one=one, other=other,
                there=mm(there), what=what)  # fmt: skip


def belt_center(join: Join) -> float | None:
    """Return the distance of the axes of a belt of its length, m; None where it does not go round its pulleys."""
    small, large = sorted((join.keys.diameter_1, join.keys.diameter_2))
    free = join.keys.length - pi * (small + large) / 2
    found = (free + max(free**2 - 2 * (large - small) ** 2, 0) ** 0.5) / 4
    return float(found) if found > (small + large) / 2 else None


def shifts(parts: MachineParts) -> Iterator[Finding]:
    """Profile shifts leave the distance of the axes: frame, radii and forces are of the reference circles."""
    for join in (each for each in parts.joins if {"shift_1", "shift_2"} & {*each.more}):
        block = parts.reader.data["meshes"][join.name]
        given = [
            each.get("value") if isinstance(each, dict) else each for each in map(block.get, ("shift_1", "shift_2"))
        ]
        try:
            total = sum(float(each or 0) for each in given)
        except (TypeError, ValueError):  # a reference
            total = inf
        if abs(total) > SAME_RATIO:
            template = (
                "shifts its profiles, and the two do not add up to zero, so that its axes would not stand as the frame has them, which the forces "
                "are of: take shift_2 = −shift_1"
            )
            yield finding(
                parts, "center", "error", (*join.path, "shift_1" if "shift_1" in block else "shift_2"), template
            )


def frame(parts: MachineParts) -> Iterator[Finding]:
    """The axes of the frame are as far apart as the mechanisms on them want."""
    for kind, first, second in (("cylinder_drive", "crank", "rocker"), ("geneva_transport", "crank", "wheel")):
        for name in (each for each, own in parts.mechanisms.items() if own == kind):
            ports = {
                part.port[1]: part
                for shaft in parts.shafts.values()
                for part in shaft.parts
                if part.port and part.port[0] == name
            }
            wanted = parts.reader.typed_number(name, "center_distance") if kind == "geneva_transport" else None
            if kind == "cylinder_drive" and (crank := parts.reader.typed_number(name, "crank_length")) is not None:
                wanted = crank * (parts.reader.typed_number(name, "frame_ratio") or 5.0)
            if wanted is None or not {first, second} <= ports.keys():
                continue
            there = parts.distance(ports[first].shaft.name, ports[second].shaft.name)
            if there is not None and abs(there - wanted) > SAME_PLACE:
                template = "wants the axes of {one} and {other} {wanted} apart, but in the frame they are {there} apart; move an axis"
                yield finding(parts, "frame", "error", ("mechanisms", name), template, ("machine", "frame", ports[second].shaft.name),
                    one=ports[first].shaft.name, other=ports[second].shaft.name, wanted=mm(wanted), there=mm(there))  # fmt: skip


def mesh_pair(parts: MachineParts) -> Iterator[Finding]:
    """A mesh is no wider than its hubs, and its gears stand in one plane."""
    for join in (each for each in parts.joins if isinstance(each.keys, MeshKeys)):
        pinion = 2 * min(join.radius(join.drivers[0]), join.radius(join.driven[0]))
        for part in (*join.drivers, *join.driven):
            if part.keys.hub is not None and join.keys.width > part.keys.hub + SAME_PLACE:
                template = "is {width} wide, but the hub of {name} is {hub} long; make the hub at least as long"
                yield finding(parts, "mesh_pair", "error", (*join.path, "width"), template, (*part.path, "hub"), width=mm(join.keys.width),
                    name=part.called, hub=mm(part.keys.hub))  # fmt: skip
        if join.keys.width > WIDTH_TO_DIAMETER * pinion + SAME_PLACE:
            template = "is {width} wide, more than {share} times the pinion's diameter {diameter}: the teeth do not bear evenly; take a narrower pair"
            yield finding(parts, "mesh_pair", "warning", (*join.path, "width"), template, width=mm(join.keys.width), share=WIDTH_TO_DIAMETER,
                diameter=mm(pinion))  # fmt: skip
    for one, here, other, there in parts.planes:
        lefts = parts.lefts
        if {one.shaft.name, other.shaft.name} <= lefts.keys():
            apart = abs(lefts[one.shaft.name] + here - lefts[other.shaft.name] - there)
            if apart > SAME_PLACE:
                template = (
                    "stands {apart} beside {name}, with which it works; give left of one of the shafts, or move a part"
                )
                yield finding(
                    parts,
                    "mesh_pair",
                    "error",
                    (*other.path, "at"),
                    template,
                    (*one.path, "at"),
                    apart=mm(apart),
                    name=one.called,
                )


def wall(parts: MachineParts) -> Iterator[Finding]:
    """Below the teeth of a keyed gear or sprocket enough is left above the keyway, and around its seat."""
    for join in parts.joins:
        for part in (*join.drivers, *join.driven):
            if not part.keys.key or part.section is None or (root := join.root(part)) is None:
                continue
            keyway = table_row("parallel_keys", part.seat)["t2"]
            if isinstance(join.keys, MeshKeys):
                module, left = join.keys.module, (root - part.seat) / 2 - keyway
                if left < WALL_WARNED * module * (1 - 1e-9):
                    level: Level = "error" if left < WALL_LEAST * module else "warning"
                    template = "leaves {left} between teeth and keyway, {modules} modules; {wanted} are wanted: take a larger gear or a thinner seat"
                    yield finding(parts, "wall", level, part.path, template, (*join.path, "module"), left=mm(left), modules=f"{left / module:.3g}",
                        wanted=WALL_WARNED)  # fmt: skip
            if root < HUB_OUTSIDE * part.seat * (1 - 1e-9):
                is_gone = root < part.seat + 2 * keyway
                template = "is {root} thick below its teeth, less than {share} times its seat of {seat}; take more teeth, or a thinner seat"
                yield finding(parts, "wall", "error" if is_gone else "warning", part.path, template, join.path, root=mm(root), share=HUB_OUTSIDE,
                    seat=mm(part.seat))  # fmt: skip


def sector(parts: MachineParts) -> Iterator[Finding]:
    """A sector has no more than two thirds of the teeth of its circle."""
    for join in (each for each in parts.joins if isinstance(each.keys, MeshKeys) and each.keys.teeth_present):
        whole = max(join.keys.teeth_1, join.keys.teeth_2)
        if join.keys.teeth_present > 2 * whole / 3:
            template = "is {teeth}, more than two thirds of the {whole} teeth of the full circle; a sector has fewer"
            yield finding(
                parts,
                "sector",
                "error",
                (*join.path, "teeth_present"),
                template,
                teeth=join.keys.teeth_present,
                whole=whole,
            )


def chain(parts: MachineParts) -> Iterator[Finding]:
    """A chain has an even number of links, and says what it moves, and where it pulls."""
    for join in (each for each in parts.joins if isinstance(each.keys, ChainKeys)):
        if join.keys.links % 2:
            template = "is {links}, which needs a cranked link; take an even number"
            yield finding(parts, "chain", "warning", (*join.path, "links"), template, links=join.keys.links)
        if join.driven and join.keys.direction is not None:
            template = "follows from the axes of the two sprockets; remove the key"
            yield finding(parts, "chain", "error", (*join.path, "direction"), template)
        if not join.driven and join.keys.direction is None:
            template = "runs over idlers, and nothing says in which direction it pulls its sprocket: along the frame's x is taken; give direction"
            yield finding(parts, "chain", "warning", join.path, template)
        if "moving_mass" in join.more and not join.keys.moves:
            template = "is moved by chains that say what they move; give moves"
            yield finding(parts, "chain", "error", (*join.path, "moving_mass"), template)


def ratios(parts: MachineParts, elements: Elements) -> Iterator[Finding]:
    """A shaft turns as often as the mechanism on it wants."""
    for shaft in parts.shafts.values():
        for part in (each for each in shaft.parts if each.port and shaft.name in parts.ratios):
            assert part.port is not None
            wanted, _ = elements.line(part.port[0])
            there = abs(parts.ratios[shaft.name])
            if abs(there / float(wanted) - 1) > RATIO:
                template = "turns {there} times a sheet by the teeth, but {mechanism} turns {wanted} times a sheet; change teeth or turns_per_sheet"
                yield finding(
                    parts,
                    "ratio",
                    "error",
                    part.path,
                    template,
                    there=f"{there:.6g}",
                    mechanism=part.port[0],
                    wanted=str(wanted),
                )
