"""Whether what the parts name is there: parts, ports, bearings of the tables, and the strengths with which they are calculated."""

from __future__ import annotations

import re
from collections.abc import Iterator

from diecut_report.config.parts.elements import GEAR_LIMITS, Elements
from diecut_report.config.parts.findings import ElementRule, Finding, Rule, finding, hubs
from diecut_report.config.parts.keys import ChainKeys, MeshKeys
from diecut_report.config.parts.model import MachineParts, ShaftPart
from diecut_report.config.validation import quoted
from diecut_report.config.yaml import KeyPath
from diecut_report.errors import nearest
from diecut_report.mechanism.mechanism import Port
from diecut_report.standards import catalogue_size, catalogue_type
from diecut_report.text.phrases import phrase

PART_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]*")
ON_MOTORS = ("pulley", "gear", "sprocket", "coupling", "flywheel")
"""Kinds of parts that a motor's shaft carries."""
OF_BEARINGS = ("designation", "floating", "corner")
OF_HUBS = (
    "hub", "key", "key_count", "key_form", "integral", "bolted", "interference", "rides_on", "of", "pin", "plane", "fill",
)  # fmt: skip

MOST_DRAWN = 60  # shafts, joins, sections of a shaft: a results file holds no more
MOST_PARTS = 40  # of a shaft, each with its key, its pin and the bearing on that


def few(parts: MachineParts) -> Iterator[Finding]:
    """A machine has no more shafts, joins, sections and parts than can be drawn."""
    counts: list[tuple[KeyPath, int, int]] = [(("machine",), max(len(parts.shafts), len(parts.joins)), MOST_DRAWN)]
    for shaft in parts.shafts.values():
        counts += [(shaft.path, len(shaft.sections), MOST_DRAWN), (shaft.path, len(shaft.parts), MOST_PARTS)]
    for path, count, most in counts:
        if count > most:
            template = "has {count} shafts, joins, sections or parts; at most {most} are allowed"
            yield finding(path, template, count=count, most=most)


def names(parts: MachineParts) -> Iterator[Finding]:
    """Shafts, joins and parts have names that can be referred to, those of a shaft each its own."""
    homes: list[tuple[str, KeyPath]] = [(shaft.name, shaft.path) for shaft in parts.shafts.values()]
    homes += [(join.name, join.path) for join in parts.joins]
    homes += [(part.name, (*part.path, part.kind)) for part in parts.every_part]
    for name, path in homes:
        if not PART_NAME.fullmatch(name):
            template = "is {name}, which is not a name: a letter, then letters, digits and _ are allowed"
            yield finding(path, template, name=quoted(name))
    for part in parts.every_part:
        if [each.name for each in part.shaft.parts].count(part.name) > 1:
            template = "is {name}, the name of another part of this shaft; give each its own"
            yield finding((*part.path, part.kind), template, name=part.name)
        if part.keys.pin is not None and part.port is None:
            template = "stands for no port, such as drive.crank, whose force acts on the pin; give of"
            yield finding(part.path, template)


def riding(parts: MachineParts) -> Iterator[Finding]:
    """What a part rides on is a clutch or a coupling there, which takes its torque: what is fixed to another hub is bolted."""
    for part in (each for each in parts.every_part if each.keys.rides_on is not None):
        carriers = (each for each in part.shaft.parts if each.kind in ("clutch", "coupling"))
        clutches = {each.name: each for each in carriers if not each.keys.rides_on}
        carrier = clutches.get(str(part.keys.rides_on))
        if carrier is None:
            template = (
                "is {name}, which is not a clutch or coupling that this shaft carries; they are {known}; "
                "what is fixed to another hub has bolted: true"
            )
            known = ", ".join(clutches) or phrase("none")
            yield finding((*part.path, "rides_on"), template, name=quoted(part.keys.rides_on), known=known)
        elif not carrier.ends[0] <= part.keys.at <= carrier.ends[1]:
            template = "stands at {at}, but {name}, which it rides on, goes from {start} to {end}; move one of them"
            start, end = carrier.ends
            against = (*carrier.path, "at")
            yield finding(
                (*part.path, "at"), template, against, at=part.keys.at, name=carrier.name, start=start, end=end
            )


def braking(parts: MachineParts) -> Iterator[Finding]:
    """A brake has a torque, and stands on a shaft that a flywheel drives; one alone stops the flywheel."""
    known: list[ShaftPart] = []
    for part in parts.every_part:
        for key in ("brake_torque", "stops_per_hour") if part.kind != "brake" else ():
            if getattr(part.keys, key) is not None:
                template = "is a key of a brake, and this is a {kind}; remove the key, or make it a brake"
                yield finding((*part.path, key), template, kind=part.kind)
        if part.kind != "brake":
            continue
        if not part.keys.brake_torque:
            yield finding(
                part.path, "has no torque, by which what is between it and the flywheel is rated; give brake_torque"
            )
        elif not parts.is_braked(part):
            template = "stands neither between the flywheel and the main shaft nor, on a shaft that turns steadily, behind a clutch; put it there"
            yield finding(part.path, template)
        elif not parts.is_behind_clutch(part):
            known.append(part)
    for part in known[1:]:
        template = "is a second brake that stops the flywheel; give one of them the torque of both"
        yield finding(part.path, template, known[0].path)


def described(parts: MachineParts) -> Iterator[Finding]:
    """A shaft has sections, or it is a motor's, which drives others and carries what its maker's radial force covers."""
    for shaft in parts.shafts.values():
        path = (*shaft.path, "motor")
        if shaft.is_rated:
            if not shaft.sections:
                template = (
                    "has no sections, so that nothing on it can be calculated; give at least one, such as 60x320 r1"
                )
                yield finding(shaft.path, template)
            elif shaft.name not in parts.ratios and parts.motion_port(shaft) is None:
                template = "is turned by nothing, so that it is not calculated; join it to a shaft by a mesh, a chain (to) or a belt"
                yield finding(shaft.path, template, level="warning")
            continue
        if shaft.sections:
            template = "says that shaft and bearings are a maker's, but the shaft has sections; remove one of them"
            yield finding(path, template, (*shaft.path, "sections"))
        for part in (each for each in shaft.parts if each.kind not in ON_MOTORS):
            template = "says that shaft and bearings are a maker's, whose shaft carries no {kind}; give sections in its place, or remove the part"
            yield finding(path, template, part.path, kind=part.kind)
        if driving := parts.driving_join(shaft):
            yield finding(
                path, "stands on a shaft that {join} drives; a motor drives others", driving.path, join=driving.name
            )


def joined(parts: MachineParts) -> Iterator[Finding]:
    """Each part takes part in one join, once; sprockets side by side stand on one shaft, each with one on the other side."""
    homes: dict[ShaftPart, KeyPath] = {}
    for join in parts.joins:
        for part in join.parts:
            if part in homes:
                template = (
                    "joins {part}, which is joined already; a part takes part in one mesh, chain or belt, and once"
                )
                yield finding(join.path, template, homes[part], part=part.called)
            homes[part] = join.path
        for side in (join.drivers, join.driven):
            shafts = list(dict.fromkeys(part.shaft.name for part in side))
            if len(shafts) > 1:
                template = "has sprockets side by side on {shafts}; those of a side stand on one shaft"
                yield finding(join.path, template, shafts=" and ".join(shafts))
        if join.driven and len(join.driven) != len(join.drivers):
            template = "leads from {count} sprockets to {others}; each strand has one on either side"
            yield finding((*join.path, "to"), template, count=len(join.drivers), others=len(join.driven))
        if isinstance(join.keys, ChainKeys) and not join.driven and join.keys.moves is None:
            template = "drives no shaft and moves nothing; give to, or moves: MECHANISM.cylinder or MECHANISM.conveyor"
            yield finding(join.path, template)


def misplaced(parts: MachineParts) -> Iterator[Finding]:
    """A part has the keys of its kind alone, as no other counts."""
    for part in parts.every_part:
        lost = OF_HUBS if part.kind == "bearing" else OF_BEARINGS if part.port else (*OF_BEARINGS, "plane")
        lost = (*lost, "bore", "fill") if part.kind == "geneva_wheel" else lost
        for key in (each for each in lost if each in part.keys.model_fields_set):
            template = "is a key that a {kind} does not have; remove it"
            yield finding((*part.path, key), template, kind=part.kind.replace("_", " "))


def designations(parts: MachineParts) -> Iterator[Finding]:
    """A bearing is one of the tables, or its dimensions are typed."""
    for part in hubs(parts):
        designation, pin = part.keys.designation or phrase("not given"), part.keys.pin
        if part.kind == "bearing" and any(part.size(column) is None for column in ("d", "D", "B")):
            template = (
                "is {designation}, which is not in the tables; give its bore, outside and width, or another designation"
            )
            yield finding(part.path, template, designation=designation)
        elif part.kind == "bearing" and "type" not in part.more and catalogue_type(part.keys.designation or "") is None:
            template = "is {designation}, which is not in the tables; give its type: deep_groove, ball or roller"
            yield finding(part.path, template, designation=designation)
        if pin is None:
            continue
        if pin.bearing is not None and catalogue_size(pin.bearing, "d") is None:
            template = "is {designation}, which is not in the tables; take another one, or leave the pin's bearing out"
            yield finding((*part.path, "pin", "bearing"), template, designation=pin.bearing)
        start, end = pin.span_start, pin.span_end
        if start is not None and end is not None and start >= end:
            template = "goes from {start} to {end}; the first support stands before the second"
            yield finding((*part.path, "pin", "span"), template, start=start, end=end)


def bores(parts: MachineParts) -> Iterator[Finding]:
    """The bore of a section is smaller than its diameter."""
    for shaft in parts.shafts.values():
        for section in (each for each in shaft.sections if each.bore >= each.diameter):
            template = "has section {number} bored to {bore}, but {diameter} thick; take a smaller bore"
            number, path = section.index + 1, (*shaft.path, "sections")
            yield finding(path, template, number=number, bore=section.bore, diameter=section.diameter)


def strengths(parts: MachineParts) -> Iterator[Finding]:
    """What keys and gears are made of is given, once for all or at the pair."""
    gears = parts.keys.gears
    if gears.hub_yield is None and any(part.keys.key for part in hubs(parts)):
        template = "lacks gears.hub_yield, the yield strength of the hubs, with which the keys are calculated"
        yield finding(("machine",), template)
    lacking = [key for key in GEAR_LIMITS if getattr(gears, key) is None]
    for join in (each for each in parts.joins if isinstance(each.keys, MeshKeys)):
        ways = {key: [{f"{key}_{gear}", f"material_{gear}"} & set(join.more) for gear in (1, 2)] for key in lacking}
        if missing := [key for key, given in ways.items() if not all(given)]:
            template = "lacks {keys}: give it under machine.gears, or for both gears here, or name a material of each"
            yield finding(join.path, template, keys=" and ".join(missing))


def _fitting(port: Port) -> tuple[str, ...]:
    """The kinds of parts that may stand for a port: with the pin of a joint, turned in steps, or any that turns."""
    if port.joint[0]:
        return "crank", "rocker"
    return ("geneva_wheel",) if port.advance else ("crank", "cam")


def ports(parts: MachineParts, elements: Elements) -> Iterator[Finding]:
    """What a part stands for, or a chain moves, is there."""
    for part in (each for each in parts.every_part if each.keys.of is not None):
        placed, path, of = elements.port(part), (*part.path, "of"), str(part.keys.of)
        if placed is None:
            known = elements.port_names
            template = "is {of}, which is not a port of a mechanism{near}; there are {known}"
            yield finding(path, template, of=of, near=nearest(of, known), known=", ".join(known) or phrase("none"))
        elif part.kind not in (fitting := _fitting(placed.port)):
            template = "is a key of a {kind}, which {of} does not act on; parts that it acts on are {known}"
            yield finding(path, template, kind=part.kind, of=of, known=", ".join(fitting))
        elif part.keys.pin is not None and not placed.port.joint[0]:
            template = "is a key that {of} has no force for, so that no pin is calculated; remove it, and give plane"
            yield finding((*part.path, "pin"), template, of=of)
    for join in (each for each in parts.joins if each.moves):
        mechanism, what = join.moves or ("", "")
        wanted = "cylinder" if parts.mechanisms.get(mechanism) == "cylinder_drive" else "conveyor"
        if mechanism not in parts.mechanisms or what != wanted:
            template = "is {moves}, which no mechanism has moved; write MECHANISM.cylinder or MECHANISM.conveyor"
            yield finding((*join.path, "moves"), template, moves=join.keys.moves)


RULES: tuple[Rule, ...] = (
    few, names, riding, braking, described, joined, misplaced, designations, bores, strengths,
)  # fmt: skip
ELEMENT_RULES: tuple[ElementRule, ...] = (ports,)
