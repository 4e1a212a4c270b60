"""Whether the axes of a machine stand where its meshes, chains and belts want them, and what these join fits."""

from __future__ import annotations

from collections.abc import Iterator
from math import inf, pi, prod
from typing import Any

from diecut_report.config.parts.elements import Elements
from diecut_report.config.parts.findings import ElementRule, Finding, Rule, finding, mm
from diecut_report.config.parts.keys import BeltKeys, ChainKeys, MeshKeys
from diecut_report.config.parts.model import SAME_PLACE, Join, MachineParts, ShaftPart, chain_pitch
from diecut_report.quantities.units import UnitError, parse_quantity

RATIO = 1e-3  # relative, by which ratios may differ
SAME_RATIO = 1e-9  # relative: rounding
FURTHEST_RATE = 0.02  # relative, by which the press may be slower or faster than is asked for
BELT_CENTER = 0.02  # relative, by which tensioning moves an axis
WIDTH_TO_DIAMETER = 1.2  # of the pinion


def axes(parts: MachineParts) -> Iterator[Finding]:
    """Shafts that are joined have axes in the frame: the direction of every force between them follows from these."""
    for join in (each for each in parts.joins if each.driven):
        for shaft in dict.fromkeys(part.shaft.name for part in join.parts):
            if shaft not in parts.axes:
                template = "joins {shaft}, which has no axis in machine.frame, so that its forces have no direction; give {shaft}: [x, y] there"
                yield finding(join.path, template, ("machine",), shaft=shaft)


def driven(parts: MachineParts) -> Iterator[Finding]:
    """A shaft is driven by one other, or by a mechanism: joins name the driving part first, from the motor on and from each mechanism on."""
    for shaft in parts.shafts.values():
        joins = [each for each in parts.joins if any(part.shaft is shaft for part in each.driven)]
        by_driver = {each.driving_shaft.name: each for each in joins}
        port, way = parts.motion_port(shaft), parts.driving_joins(shaft)
        if port is not None and port.shaft is shaft and joins:
            template = "drives {shaft}, which {mechanism} moves; name the part of {shaft} first, as the driving one"
            yield finding(joins[0].path, template, port.path, shaft=shaft.name, mechanism=port.keys.of)
        elif port is not None and port.shaft is not shaft and not joins:
            template = "is driven by no other shaft, though {mechanism} moves it by way of {other}; name the driving part of each join first"
            yield finding(shaft.path, template, port.path, mechanism=port.keys.of, other=port.shaft.name)
        elif len(by_driver) > 1:
            one, other = list(by_driver.values())[:2]
            template = "drives {shaft}, which {other} drives too; name the driving part of each join first"
            yield finding(other.path, template, one.path, shaft=shaft.name, other=one.name)
        elif unlike := next((each for each in joins[1:] if abs(each.ratio / joins[0].ratio - 1) > SAME_RATIO), None):
            one, there, ratio = joins[0], f"{unlike.ratio:.6g}", f"{joins[0].ratio:.6g}"
            template = "turns {shaft} {there} times as fast as {driver}, but {other} {ratio} times, so that neither can turn; give both one ratio"
            shafts: dict[str, Any] = {"shaft": shaft.name, "driver": one.driving_shaft.name}
            yield finding(unlike.path, template, one.path, there=there, other=one.name, ratio=ratio, **shafts)
        elif way and way[-1].driving_shaft is shaft:
            template = "closes a ring of shafts that drive each other; take one of its joins away"
            yield finding(joins[0].path, template)


def part_of_port(parts: MachineParts, mechanism: str, port: str) -> ShaftPart | None:
    """Return the part that stands for a port of a mechanism."""
    return next((each for each in parts.every_part if each.port == (mechanism, port)), None)


def stages(parts: MachineParts, elements: Elements) -> Iterator[Finding]:
    """Between a rocker and what moves the cylinder there is one pair, the sector and the pinion, which the drive calculates."""
    for chain in (each for each in parts.joins if each.moves):
        mechanism, what = chain.moves or ("", "")
        rocker = part_of_port(parts, mechanism, "rocker")
        if rocker is None or what != "cylinder":
            continue
        way = parts.chain_from(rocker.shaft.name, chain.driving_shaft.name)
        if len(way) > 1:
            template = "moves the cylinder {count} joins behind {shaft}; the drive has one pair between them: put its sprockets on the pinion's shaft"
            yield finding(chain.path, template, rocker.path, count=len(way), shaft=rocker.shaft.name)


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
        shaft, motor = join.driving_shaft, join.driving_shaft.keys.motor
        if motor is None or shaft.name not in parts.ratios or asked <= 0:
            continue
        parts.reader.read.add(f"{name}.required_rate" if required else "press.productivity")
        there = motor.speed / (2 * pi) / abs(parts.ratios[shaft.name])
        if abs(there / asked - 1) > FURTHEST_RATE:
            template = "makes {there} sheets an hour of the motor's speed, but {asked} are asked for: change diameters, teeth or the rate"
            rates: dict[str, Any] = {"there": f"{there * 3600:.4g}", "asked": f"{asked * 3600:.4g}"}
            yield finding((*join.path, "diameters"), template, (*shaft.path, "motor", "speed"), **rates)


def losses(parts: MachineParts, elements: Elements) -> Iterator[Finding]:
    """The losses that the cyclogram knows of between the main shaft and a line are no less than those of the meshes there."""
    timing = str(elements.named("cyclogram"))
    for index, line in enumerate(elements.lines):
        name, path = str(line.get("mechanism")), ("mechanisms", timing, "lines", index)
        part = part_of_port(parts, name, "crank")
        if part is None:
            continue
        way = parts.chain_from(parts.keys.anchor, part.shaft.name)
        meshes = [join for join in way if isinstance(join.keys, MeshKeys)]
        typed = parts.reader.typed_number(timing, f"lines.{index}.path_efficiency")
        if typed is None and "path_efficiency" in line:
            template = "refers to what is calculated, so that the parts are not known to lose it, too; type a number"
            yield finding((*path, "path_efficiency"), template)
        said, there = 1.0 if typed is None else typed, prod(join.keys.efficiency for join in meshes)
        if meshes and said > there + RATIO:
            template = "has the efficiency {there}, but the cyclogram calculates with {said} for {name}: the main shaft takes more than it says"
            shares: dict[str, Any] = {"there": f"{there:.4g}", "said": f"{said:.4g}"}
            yield finding(meshes[0].path, template, path, level="warning", name=name, **shares)


def clutch_lines(parts: MachineParts, elements: Elements) -> Iterator[Finding]:
    """The lines that a clutch is said to drive are those behind it."""
    behind = {each.mechanism for each in elements.taking if parts.is_behind_clutch(each.part)}
    consistency = elements.named("press_consistency")
    typed = elements.blocks[consistency].get("clutch_drives") if consistency else None
    if behind and isinstance(typed, list) and {str(each) for each in typed} != behind:
        template = "is {typed}, but of the parts the clutch drives {behind}; name these"
        path, names = ("mechanisms", str(consistency), "clutch_drives"), ", ".join(map(str, typed))
        yield finding(path, template, typed=names, behind=", ".join(sorted(behind)))


def one_belt(parts: MachineParts) -> Iterator[Finding]:
    """One belt is calculated, with the drive train, which knows the motor that pulls it."""
    for join in [each for each in parts.joins if each.word == "belts"][1:]:
        template = "is a second belt; one alone is calculated, by the drive train: give what this one drives as a load of its shaft"
        yield finding(join.path, template)


def center(parts: MachineParts) -> Iterator[Finding]:
    """The axes of the frame are as far apart as a mesh, a chain or a belt wants."""
    for join in (each for each in parts.joins if each.driven):
        is_belt = isinstance(join.keys, BeltKeys)
        one, other = join.driving_shaft.name, join.driven_shaft.name
        there, wanted = parts.distance(one, other), belt_center(join) if is_belt else join.center_distance
        if is_belt and wanted is None:
            template = "is too short for its pulleys of {diameters}, which would touch; take a longer belt"
            diameters = " / ".join(map(mm, join.sizes))
            yield finding((*join.path, "length"), template, (*join.path, "diameters"), diameters=diameters)
        if there is None or wanted is None:
            continue
        allowed, what = SAME_PLACE, "teeth or module"
        if is_belt:
            allowed, what = BELT_CENTER * wanted, "length or diameters"
        elif isinstance(join.keys, ChainKeys):
            allowed, what = chain_pitch(join.keys) / 2, "links"
        if abs(there - wanted) > allowed:
            template = "puts the axes {wanted} apart, but in the frame {one} and {other} are {there} apart; move an axis or change {what}"
            given: dict[str, Any] = {"wanted": wanted, "one": one, "other": other, "there": there, "what": what}
            yield finding(join.path, template, ("machine", "frame", other), **given)


def belt_center(join: Join) -> float | None:
    """Return the distance of the axes of a belt of its length, m; None where it does not go round its pulleys."""
    small, large = sorted(join.sizes)
    free = join.keys.length - pi * (small + large) / 2
    found = (free + max(free**2 - 2 * (large - small) ** 2, 0) ** 0.5) / 4
    return float(found) if found > (small + large) / 2 else None


def shifts(parts: MachineParts) -> Iterator[Finding]:
    """Profile shifts leave the distance of the axes: frame, radii and forces are of the reference circles."""
    keys = ("shift_1", "shift_2")
    for join in (each for each in parts.joins if {*keys} & {*each.more}):
        block = parts.reader.data["meshes"][join.name]
        given = [each.get("value") if isinstance(each, dict) else each for each in map(block.get, keys)]
        try:
            total = sum(float(each or 0) for each in given)
        except (TypeError, ValueError):  # a reference
            total = inf
        if abs(total) > SAME_RATIO:
            template = (
                "shifts its profiles, and the two do not add up to zero, so that its axes would not stand as the frame has them, which the forces "
                "are of: take shift_2 = −shift_1"
            )
            yield finding((*join.path, next(key for key in keys if key in block)), template)


def frame(parts: MachineParts) -> Iterator[Finding]:
    """The axes of the frame are as far apart as the mechanisms on them want."""
    typed = parts.reader.typed_number
    for kind, other_port in (("cylinder_drive", "rocker"), ("geneva_transport", "wheel")):
        for name in (each for each, own in parts.mechanisms.items() if own == kind):
            first, second = part_of_port(parts, name, "crank"), part_of_port(parts, name, other_port)
            wanted = typed(name, "center_distance") if kind == "geneva_transport" else typed(name, "crank_length")
            if wanted is None or first is None or second is None:
                continue
            if kind == "cylinder_drive":
                wanted *= typed(name, "frame_ratio") or 5.0
            one, other = first.shaft.name, second.shaft.name
            there = parts.distance(one, other)
            if there is not None and abs(there - wanted) > SAME_PLACE:
                template = "wants the axes of {one} and {other} {wanted} apart, but in the frame they are {there} apart; move an axis"
                path, against = ("mechanisms", name), ("machine", "frame", other)
                yield finding(path, template, against, one=one, other=other, wanted=wanted, there=there)


def mesh_pair(parts: MachineParts) -> Iterator[Finding]:
    """A mesh is no wider than its hubs, and its gears stand in one plane."""
    for join in (each for each in parts.joins if isinstance(each.keys, MeshKeys)):
        width, pinion = join.keys.width, 2 * min(join.radius(part) for part in join.parts)
        for part in join.parts:
            if part.keys.hub is not None and width > part.keys.hub + SAME_PLACE:
                template = "is {width} wide, but the hub of {name} is {hub} long; make the hub at least as long"
                against = (*part.path, "hub")
                yield finding(
                    (*join.path, "width"), template, against, width=width, name=part.called, hub=part.keys.hub
                )
        if width > WIDTH_TO_DIAMETER * pinion + SAME_PLACE:
            template = "is {width} wide, more than {share} times the pinion's diameter {diameter}: the teeth do not bear evenly; take a narrower pair"
            share = str(WIDTH_TO_DIAMETER)
            yield finding((*join.path, "width"), template, level="warning", width=width, share=share, diameter=pinion)
    for one, here, other, there in parts.planes:
        lefts = parts.lefts
        if {one.shaft.name, other.shaft.name} <= lefts.keys():
            apart = abs(lefts[one.shaft.name] + here - lefts[other.shaft.name] - there)
            if apart > SAME_PLACE:
                template = (
                    "stands {apart} beside {name}, with which it works; give left of one of the shafts, or move a part"
                )
                yield finding((*other.path, "at"), template, (*one.path, "at"), apart=apart, name=one.called)


def sector(parts: MachineParts) -> Iterator[Finding]:
    """A sector has no more than two thirds of the teeth of its circle."""
    for join in (each for each in parts.joins if isinstance(each.keys, MeshKeys) and each.keys.teeth_present):
        teeth, whole = join.keys.teeth_present, max(join.sizes)
        if teeth > 2 * whole / 3:
            template = "is {teeth}, more than two thirds of the {whole} teeth of the full circle; a sector has fewer"
            yield finding((*join.path, "teeth_present"), template, teeth=teeth, whole=whole)


def chain(parts: MachineParts) -> Iterator[Finding]:
    """A chain has an even number of links, and says what it moves, and where it pulls."""
    for join in (each for each in parts.joins if isinstance(each.keys, ChainKeys)):
        if join.keys.links % 2:
            template = "is {links}, which needs a cranked link; take an even number"
            yield finding((*join.path, "links"), template, level="warning", links=join.keys.links)
        if join.driven and join.keys.direction is not None:
            yield finding((*join.path, "direction"), "follows from the axes of the two sprockets; remove the key")
        if not join.driven and join.keys.direction is None:
            template = "runs over idlers, and nothing says in which direction it pulls its sprocket: along the frame's x is taken; give direction"
            yield finding(join.path, template, level="warning")
        if "moving_mass" in join.more and not join.keys.moves:
            yield finding((*join.path, "moving_mass"), "is moved by chains that say what they move; give moves")


def ratios(parts: MachineParts, elements: Elements) -> Iterator[Finding]:
    """A shaft turns as often as the mechanism on it wants."""
    for part in (each for each in parts.every_part if each.port and each.shaft.name in parts.ratios):
        mechanism, _ = part.port or ("", "")
        wanted, there = elements.line(mechanism)[0], abs(parts.ratios[part.shaft.name])
        if abs(there / float(wanted) - 1) > RATIO:
            template = "turns {there} times a sheet by the teeth, but {mechanism} turns {wanted} times a sheet; change teeth or turns_per_sheet"
            yield finding(part.path, template, there=f"{there:.6g}", mechanism=mechanism, wanted=str(wanted))


RULES: tuple[Rule, ...] = (axes, one_belt, center, shifts, frame, mesh_pair, sector, chain)
ELEMENT_RULES: tuple[ElementRule, ...] = (ratios, rate, stages, losses, clutch_lines)
