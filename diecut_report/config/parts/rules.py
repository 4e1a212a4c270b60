"""Whether the parts fit each other: each rule one function, which names both places, both values and what to change."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations, pairwise
from typing import Any

from diecut_report.config.model import texts
from diecut_report.config.parts import join_rules, naming
from diecut_report.config.parts.demands import first_place, typed_paths
from diecut_report.config.parts.elements import SERVICE_KEYS, Elements
from diecut_report.config.parts.findings import (
    ElementRule,
    Finding,
    Level,
    Rule,
    finding,
    found_by,
    hubs,
    mm,
    table_row,
)
from diecut_report.config.parts.keys import WORDS, MeshKeys
from diecut_report.config.parts.masses import wheel_section
from diecut_report.config.parts.model import SAME_PLACE, MachineParts, ShaftPart
from diecut_report.config.references import WHOLE
from diecut_report.config.validation import ConfigPlace
from diecut_report.config.yaml import KeyPath
from diecut_report.errors import Problem
from diecut_report.quantities.units import unit
from diecut_report.standards import catalogue_size, standard_series
from diecut_report.standards.ranges import range_of
from diecut_report.text.phrases import Phrase, joined, phrase

LONGEST_KEY = 1.3  # of the shaft's diameter, over which a key bears
KEY_TO_FILLET = 0.1  # of the shaft's diameter
INTEGRAL_WARNED, INTEGRAL_MOST = 2.0, 4.0  # diameters of the seat, below the teeth
WALL_WARNED, WALL_LEAST, HUB_OUTSIDE = 2.5, 1.0, 1.5  # modules below a tooth, and diameters of the seat
# shares of the full steel body; of a clutch, which has shoes in place of a disc, less is usual
MASS_SHARE, MASS_POSSIBLE = (0.3, 1.05), (0.05, 1.5)
HARDNESS = (0.69, 260e6)  # σ_Hlim of R_m, Pa: quality ME of ISO 6336-5, with HV = R_m / 3.2 MPa
SIDES = {
    ("left",): phrase("on the left"),
    ("right",): phrase("on the right"),
    ("left", "right"): phrase("on both sides"),
}


def misdriven(parts: MachineParts) -> list[Problem]:
    """Return which shafts are driven by none, by several, or by themselves: nothing can be made of such parts."""
    return _problems(parts, list(found_by(parts, "driven", join_rules.driven(parts))))


def coherence(parts: MachineParts, elements: Elements) -> list[Problem]:
    """Return what is wrong with the parts; what only warns or fails a check is kept in ``parts.findings``."""
    found = [each for rule in RULES for each in found_by(parts, rule.__name__, rule(parts))]
    for of_elements in ELEMENT_RULES:
        found += found_by(parts, of_elements.__name__, of_elements(parts, elements))
    parts.findings[:] = [each for each in found if each.level != "error"]
    return _problems(parts, [each for each in found if each.level == "error"])


def _problems(parts: MachineParts, found: list[Finding]) -> list[Problem]:
    place = ConfigPlace(parts.reader.tree)
    return [place.problem(each.path, each.message) for each in found]


# Seats, bores and places along a shaft.


def _sections(part: ShaftPart) -> KeyPath:
    """Where the sections of a part's shaft are typed."""
    return (*part.shaft.path, "sections")


def seat(parts: MachineParts) -> Iterator[Finding]:
    """A hub and a bearing stand on one section, on the shaft."""
    for part in hubs(parts):
        (start, end), section, length = part.ends, part.section, part.shaft.length
        path, is_seated = (*part.path, "at"), not part.keys.rides_on and not part.keys.integral
        if start < -SAME_PLACE or end > length + SAME_PLACE or section is None:
            template = (
                "stands from {start} to {end}, but the shaft goes from 0 to {length}; move it or make the shaft longer"
            )
            yield finding(path, template, part.shaft.path, start=start, end=end, length=length)
        elif is_seated and (start < section.start - SAME_PLACE or end > section.end + SAME_PLACE):
            template = "stands from {start} to {end}, but section {number} ({diameter}) goes from {first} to {last}; move it or lengthen the section"
            yield finding(path, template, _sections(part), start=start, end=end, number=section.index + 1,
                          diameter=section.diameter, first=section.start, last=section.end)  # fmt: skip


def bore(parts: MachineParts) -> Iterator[Finding]:
    """The bore of a bearing is the diameter of its seat or pin."""
    for part in hubs(parts):
        own = part.size("d") if part.kind == "bearing" else None
        if own is not None and part.section is not None and abs(own - part.seat) > SAME_PLACE:
            template = "has a bore of {bore}, but sits on a diameter of {seat}; take a bearing of that bore, or change section {number}"
            path, number = (*part.path, "designation"), part.section.index + 1
            yield finding(path, template, _sections(part), bore=own, seat=part.seat, number=number)
        pin = part.keys.pin
        inner = catalogue_size(pin.bearing, "d") if pin is not None and pin.bearing is not None else None
        if pin is not None and inner is not None and abs(inner - pin.diameter) > SAME_PLACE:
            template = (
                "has a bore of {bore}, but sits on a pin of {seat}; take a bearing of that bore, or change the pin"
            )
            path = (*part.path, "pin")
            yield finding((*path, "bearing"), template, (*path, "diameter"), bore=inner, seat=pin.diameter)


def overlap(parts: MachineParts) -> Iterator[Finding]:
    """Hubs and bearings of a shaft do not overlap; they may touch."""
    for shaft in (each for each in parts.shafts.values() if each.sections):
        own = [part for part in shaft.parts if not part.keys.rides_on and part.kind != "load"]
        for one, other in pairwise(sorted(own, key=lambda part: part.keys.at)):
            start, end = other.ends[0], one.ends[1]
            if start < end - SAME_PLACE:
                template = "begins at {start}, but {name} ends at {end}; move one of them by {gap}"
                path, against = (*other.path, "at"), (*one.path, "at")
                yield finding(path, template, against, start=start, name=one.name, end=end, gap=end - start)


@dataclass(frozen=True)
class _Cylinder:
    """A body as a cylinder about its axis."""

    part: ShaftPart
    radius: float
    start: float
    end: float


def _cylinders(parts: MachineParts) -> Iterator[_Cylinder]:
    for name, shaft in parts.shafts.items():
        left = parts.lefts.get(name)
        if left is None:
            continue
        for part in shaft.parts:
            radius, half = parts.body_radius(part), parts.body_width(part) / 2
            if radius is not None:
                yield _Cylinder(part, radius, left + part.keys.at - half, left + part.keys.at + half)
        if shaft.sections:
            thickest = max(shaft.sections, key=lambda each: each.diameter)
            yield _Cylinder(shaft.parts[0], thickest.diameter / 2, left + thickest.start, left + thickest.end)


def planes(parts: MachineParts) -> Iterator[Finding]:
    """Bodies of two shafts that meet in a plane leave each other room, but where they mesh."""
    tied = {frozenset((one, other)) for join in parts.joins for one in join.drivers for other in join.driven}
    found: set[frozenset[str]] = set()  # one body that reaches a shaft is said once
    for one, other in combinations(_cylinders(parts), 2):
        shafts = frozenset((one.part.shaft.name, other.part.shaft.name))
        if len(shafts) == 1 or shafts in found or frozenset((one.part, other.part)) in tied:
            continue
        distance = parts.distance(one.part.shaft.name, other.part.shaft.name)
        meet = min(one.end, other.end) - max(one.start, other.start) > SAME_PLACE
        if distance is not None and meet and distance < one.radius + other.radius - SAME_PLACE:
            found.add(shafts)
            template = "has a radius of {radius} and reaches {other} ({other_radius}) in one plane: the axes are {distance} apart; move one of them"
            yield finding(one.part.path, template, other.part.path, level="warning", radius=one.radius,
                          other=other.part.called, other_radius=other.radius, distance=distance)  # fmt: skip


def locating(parts: MachineParts) -> Iterator[Finding]:
    """One bearing of a shaft holds it along its axis, never one without ribs."""
    for shaft in parts.shafts.values():
        fixed, path = [part for part in shaft.bearings if not part.keys.floating], (*shaft.path, "parts")
        if shaft.has_body and len(shaft.bearings) != 2:
            yield finding(path, "has {count} bearings; a shaft is calculated on two", count=len(shaft.bearings))
        elif shaft.has_body and len(fixed) != 1:
            template = "has {count} bearings that hold it along its axis; exactly one is needed: write floating: true for the other"
            yield finding(path, template, count=len(fixed))
        for part in fixed if len(fixed) == 1 else ():
            designation = part.keys.designation or ""
            if designation.upper().replace(" ", "").startswith(("NU", "N2", "N3", "N1")):
                template = "is {designation}, which cannot hold the shaft along its axis; make it floating and let the other bearing do so"
                yield finding((*part.path, "designation"), template, designation=designation)


def mounting(parts: MachineParts) -> Iterator[Finding]:
    """A part can be put on from one end: no section on the way is thicker than its bore."""
    for part in hubs(parts):
        section, sections = part.section, part.shaft.sections
        if section is None or part.keys.integral or part.keys.rides_on:
            continue
        inner = part.keys.bore or part.seat
        sides = sections[: section.index], sections[section.index + 1 :]
        if all(any(each.diameter > inner + SAME_PLACE for each in side) for side in sides):
            template = "has a bore of {bore}, but sections on both sides are thicker: it cannot be put on; make one side thinner or the seat thicker"
            yield finding((*part.path, "at"), template, _sections(part), bore=inner)


def shoulder(parts: MachineParts) -> Iterator[Finding]:
    """A shoulder that a bearing rests on is as high as its ring needs, not as high as the other ring, and rounded less than its corner."""
    for part in (each for each in hubs(parts) if each.kind == "bearing"):
        corner, outside, place = part.size("r"), part.size("D"), _sections(part)
        if outside is None or not part.shoulders:
            continue
        if corner is None:
            template = "rests on a shoulder, but its ring's corner is not known, so that neither height nor fillet is checked; give its corner"
            yield finding(part.path, template, place, level="warning")
            continue
        row = table_row("bearing_shoulders", corner)
        height = row["h0" if (part.keys.designation or "").startswith("60") else "h"]
        least, most = part.seat + 2 * height, outside - 2 * height
        for step, fillet in part.shoulders.values():
            if not least - SAME_PLACE <= step.diameter <= most + SAME_PLACE:
                template = "rests on a shoulder of {diameter}; its rings want {least} to {most}: change section {number}, or put a ring between"
                own: dict[str, Any] = {"diameter": step.diameter, "number": step.index + 1}
                yield finding(part.path, template, place, level="warning", least=least, most=most, **own)
            if fillet is not None and fillet > corner - SAME_PLACE:
                template = "rests on a shoulder with a fillet of {fillet}, too large for its ring with corners from {corner}; take less than {most}"
                yield finding(part.path, template, place, fillet=fillet, corner=corner, most=corner - SAME_PLACE)


def stop(parts: MachineParts) -> Iterator[Finding]:
    """What is put on a shaft is held in both directions: by a shoulder, the part beside it, or a ring, sleeve, nut or press fit."""
    for shaft in parts.shafts.values():
        loose = []
        for part in (each for each in hubs(parts) if each.shaft is shaft and each.section is not None):
            keys = part.keys
            if keys.integral or keys.bolted or keys.interference or keys.rides_on:
                continue
            if keys.stop == "shoulder" and not part.shoulders:
                template = (
                    "is stopped by a shoulder, but touches no thicker section; move it to one, or give another stop"
                )
                yield finding((*part.path, "stop"), template, _sections(part), level="warning")
            elif (
                keys.stop in (None, "shoulder") and parts.keys.stop is None and (sides := SIDES.get(_free_sides(part)))
            ):
                loose.append(Phrase("{part} {sides}", part=part.name, sides=sides))
        if loose:
            template = "nothing holds along the shaft: {loose}; move them to a shoulder, or give stop, there or to all parts under machine"
            yield finding(shaft.path, template, level="warning", loose=joined(loose, ", "))


def _free_sides(part: ShaftPart) -> tuple[str, ...]:
    """On which sides a part touches neither a shoulder nor another part."""
    ends = [each.ends for each in part.shaft.parts if each is not part and each.kind != "load"]
    beside = {
        "left": any(abs(end - part.ends[0]) <= SAME_PLACE for _, end in ends),
        "right": any(abs(start - part.ends[1]) <= SAME_PLACE for start, _ in ends),
    }
    return tuple(side for side, is_held in beside.items() if not is_held and side not in part.shoulders)


# Keys and what carries a torque.


def key(parts: MachineParts) -> Iterator[Finding]:
    """A key is no longer than its hub, of a standard length, on one section, and ends away from a fillet."""
    lengths = standard_series("din_6885_lengths")
    known = [value * unit(lengths.unit).factor for value in lengths.values]
    for part in hubs(parts):
        if not part.keys.key or part.section is None:
            continue
        path, long, hub = (*part.path, "key"), part.keys.key, part.keys.hub
        if hub is not None and long > hub + SAME_PLACE:
            template = "is {length} long, but its hub is {hub} long; take a key that is not longer than the hub"
            yield finding(path, template, (*part.path, "hub"), length=long, hub=hub)
        if not any(abs(long - each) <= SAME_PLACE for each in known):
            nearest_two = sorted(sorted(known, key=lambda each: abs(each - long))[:2])
            template = "is {length} long, which is not a length of DIN 6885-1; take {lengths}"
            yield finding(path, template, length=long, lengths=" or ".join(map(mm, nearest_two)))
        yield from _key_on_section(part, long)


def _key_on_section(part: ShaftPart, long: float) -> Iterator[Finding]:
    section, path, place = part.section, (*part.path, "key"), _sections(part)
    assert section is not None, "it is looked up before"
    start, end, diameter = part.keys.at - long / 2, part.keys.at + long / 2, section.diameter
    if start < section.start - SAME_PLACE or end > section.end + SAME_PLACE:
        template = "goes from {start} to {end}, but its section ends at {first} and {last}; take a shorter key"
        yield finding(path, template, place, start=start, end=end, first=section.start, last=section.end)
        return
    deep = table_row("parallel_keys", diameter)["t1"]
    if (diameter - section.bore) / 2 <= deep:
        template = (
            "lies in a keyseat {deep} deep, but the wall around the bore of {bore} is not thicker; take a smaller bore"
        )
        yield finding(path, template, place, deep=deep, bore=section.bore)
    bearing = long - key_width(diameter) if part.keys.key_form == "A" else long
    if bearing > LONGEST_KEY * diameter + SAME_PLACE:
        template = "bears over {length}, more than {share} times the diameter {diameter}: the torque enters at its end; take a shorter key"
        yield finding(path, template, level="warning", length=bearing, share=str(LONGEST_KEY), diameter=diameter)
    steps = [start - section.start] if section.index else []
    steps += [section.end - end] if section.index < len(part.shaft.sections) - 1 else []
    near = max(min(steps, default=math.inf), 0.0)  # but for rounding
    if near < KEY_TO_FILLET * diameter - SAME_PLACE:
        template = "ends {distance} from a step, less than a tenth of the diameter {diameter}: both notches act together; move or shorten it"
        yield finding(path, template, place, level="warning", distance=near, diameter=diameter)


def key_width(diameter: float) -> float:
    """Return the width of the key for a shaft, m (DIN 6885-1)."""
    return table_row("parallel_keys", diameter)["b"]


def wall(parts: MachineParts) -> Iterator[Finding]:
    """Below the teeth of a keyed gear or sprocket enough is left above the keyway, and around its seat."""
    for part, join in ((part, each) for each in parts.joins for part in each.parts):
        if not part.keys.key or part.section is None or (root := join.root(part)) is None:
            continue
        keyway = table_row("parallel_keys", part.seat)["t2"]
        if isinstance(join.keys, MeshKeys):
            module, left = join.keys.module, (root - part.seat) / 2 - keyway
            if left < WALL_WARNED * module * (1 - 1e-9):
                level: Level = "error" if left < WALL_LEAST * module else "warning"
                template = "leaves {left} between teeth and keyway, {modules} modules; {wanted} are wanted: take a larger gear or a thinner seat"
                shares = {"modules": f"{left / module:.3g}", "wanted": str(WALL_WARNED)}
                yield finding(part.path, template, (*join.path, "module"), level=level, left=left, **shares)
        if root < HUB_OUTSIDE * part.seat * (1 - 1e-9):
            level = "error" if root < part.seat + 2 * keyway else "warning"
            template = "is {root} thick below its teeth, less than {share} times its seat of {seat}; take more teeth, or a thinner seat"
            yield finding(
                part.path, template, join.path, level=level, root=root, share=str(HUB_OUTSIDE), seat=part.seat
            )


def steel(parts: MachineParts) -> Iterator[Finding]:
    """Flanks of through-hardened gears bear no more than their steel does, whose strength follows from what their hubs yield at."""
    gears = parts.keys.gears
    if gears.flanks not in (None, "through_hardened") or gears.sigma_h_lim is None or gears.hub_yield is None:
        return
    usual = range_of("shaft", "yield_strength")  # as a share of the tensile strength
    assert usual is not None, "the table of ranges has it"
    most = HARDNESS[0] * gears.hub_yield / usual.usual[0] + HARDNESS[1]
    if gears.sigma_h_lim > most:
        template = "is {limit}, but through-hardened steel with hubs of {hub} has {most} at most (ISO 6336-5, ME); give flanks, or the steel's own"
        own, hub = (("machine", "gears", key) for key in ("sigma_h_lim", "hub_yield"))
        given = {"limit": gears.sigma_h_lim, "hub": gears.hub_yield, "most": most}
        shown = {name: f"{value / 1e6:.4g} MPa" for name, value in given.items()}
        yield finding(own, template, hub, level="warning", **shown)


def torque_carried(parts: MachineParts) -> Iterator[Finding]:
    """What takes a torque from its shaft, or gives it one, is keyed, pressed on, cut on it or bolted, in one of these ways."""
    for part in hubs(parts):
        carries = (part, *(each for each in part.shaft.parts if each.keys.rides_on == part.name))
        takes = any(parts.join_of(each) or each.port is not None or each.kind == "brake" for each in carries)
        if takes and part.kind != "bearing" and not part.is_carried:
            template = "carries a torque, but nothing joins it to the shaft; give key, interference, integral: true or bolted: true"
            yield finding(part.path, template, level="fail")
        ways = [way for way in ("key", "interference", "integral", "bolted", "rides_on") if getattr(part.keys, way)]
        if len(ways) > 1:
            template = "is joined to its shaft by {ways}, of which one alone is calculated; give one"
            yield finding(part.path, template, ways=", ".join(ways))


def integral(parts: MachineParts) -> Iterator[Finding]:
    """Gears, cranks and rockers are in one piece with a shaft; a gear is not much thicker below its teeth than its shaft, else it is a wheel."""
    for part in hubs(parts):
        if part.keys.integral and part.kind not in ("gear", "crank", "rocker"):
            template = "is not made in one piece with a shaft, as gears, cranks and rockers are; give key, interference or bolted: true"
            yield finding((*part.path, "integral"), template)
    meshes = (each for each in parts.joins if isinstance(each.keys, MeshKeys))
    for part, join in ((part, mesh) for mesh in meshes for part in mesh.parts):
        root, seat, path = join.root(part), part.seat, (*part.path, "integral")
        if root is None or not part.keys.integral or part.section is None:
            continue
        if root < seat - SAME_PLACE:
            template = "is {root} thick below its teeth, which are cut into a shaft of {seat}; make its section that thick, as it is calculated"
            yield finding(path, template, _sections(part), root=root, seat=seat)
        if root > INTEGRAL_WARNED * seat:
            level: Level = "error" if root > INTEGRAL_MOST * seat else "warning"
            template = "is cut on a shaft of {seat}, but is {root} thick below its teeth: no such shaft is turned; give key or interference"
            yield finding(path, template, level=level, seat=seat, root=root)


def force_plane(parts: MachineParts) -> Iterator[Finding]:
    """A crank's or rocker's force has a plane beyond the face of its hub; without a pin of the machine no nearer than half the roller's width."""
    for part in (each for each in hubs(parts) if each.kind in ("crank", "rocker", "cam") and each.port is not None):
        if not part.hub:
            template = "has no hub, so that it is not known where its face is, beyond which its force acts; give hub"
            yield finding(part.path, template)
        if part.keys.pin is not None or part.port is None:
            continue
        if part.keys.plane is None:
            template = "has neither a pin nor a plane, so that it is not known how far beyond the disc its force acts; give plane"
            yield finding(part.path, template)
            continue
        mechanism, _ = part.port
        width = parts.reader.typed_number(mechanism, "roller_width") or 0.0
        if part.keys.plane < width / 2 - SAME_PLACE:
            template = "is {plane} beyond the disc, but the roller is {width} wide and would stand in the disc; give at least half of it"
            against = ("mechanisms", mechanism, "roller_width")
            yield finding((*part.path, "plane"), template, against, plane=part.keys.plane, width=width)


def pins(parts: MachineParts) -> Iterator[Finding]:
    """The bearing of a pin stands on it with its whole width, off the face of its disc or off both its supports."""
    for part, pin in ((part, part.keys.pin) for part in hubs(parts) if part.keys.pin is not None):
        home, place = (*part.path, "pin"), pin.middle
        width = (catalogue_size(pin.bearing, "B") or 0.0) if pin.bearing else 0.0
        if pin.held is not None and pin.held > part.hub + SAME_PLACE > SAME_PLACE:
            template = "is {held}, but the hub of {name} is {hub} long; a pin is held within its disc"
            yield finding((*home, "held"), template, (*part.path, "hub"), held=pin.held, name=part.called, hub=part.hub)
        near = pin.supports[1] if pin.held is not None else min(pin.supports, key=lambda each: abs(place - each))
        first, last = place - width / 2, place + width / 2
        if (off := abs(place - near)) < width / 2 - SAME_PLACE:
            support = (
                Phrase("the support at {place}", place=mm(near)) if pin.held is None else phrase("the disc's face")
            )
            template = "has its middle {off} off {support}, but {bearing} is {width} wide; give at least half of that"
            against = (*home, "bearing")
            yield finding(
                (*home, "plane"), template, against, off=off, support=support, bearing=pin.bearing, width=width
            )
        elif first < -SAME_PLACE or last > pin.length + SAME_PLACE:
            template = "reaches from {start} to {end}, but the pin from {first} to {last}; move it, or the supports"
            own: dict[str, Any] = {"start": first, "end": last, "first": 0.0, "last": pin.length}
            yield finding((*home, "plane"), template, (*home, "span"), **own)


# Masses and moments of inertia.


def weighed(parts: MachineParts, elements: Elements) -> Iterator[Finding]:
    """Each body has a mass that loads its shaft, and an inertia: a Geneva wheel by its width, a flywheel as it is typed."""
    for part in hubs(parts):
        has_inertia, is_massless = "inertia" in part.more, elements.mass_on(part) is None
        if part.kind == "geneva_wheel" and is_massless:
            template = "has no mass, so that its weight and its inertia would be left out; give width or mass"
            yield finding(part.path, template)
        elif part.kind == "geneva_wheel" and not has_inertia and wheel_section(parts, part) is None:
            template = (
                "has no inertia, as slots, center_distance or roller_radius of its mechanism is not typed; give inertia"
            )
            yield finding(part.path, template)
        elif part.kind == "flywheel" and (is_massless or not has_inertia):
            template = "has no {missing}, so that it counts for nothing; give it, or refer with inertia to flywheel_inertia of the drive train"
            yield finding(part.path, template, missing="mass" if has_inertia else "inertia")


def inert(parts: MachineParts, elements: Elements) -> Iterator[Finding]:
    """What swings or turns in steps has an inertia, a free force with a mass too."""
    template = (
        "has a mass and no inertia on a shaft that does not turn steadily, so that the torque to move it would be left out; give inertia, about "
        "the shaft's axis, or outside"
    )
    for part in (each for each in parts.every_part if elements.has_no_inertia(each)):
        yield finding(part.path, template)


def massive(parts: MachineParts, elements: Elements) -> Iterator[Finding]:
    """A mass or moment of inertia is that of a steel body of the part's dimensions, as far as these are known, and never nothing."""
    for part in hubs(parts):
        bodies = ("mass", "kg", elements.full_mass(part)), ("inertia", "kg·m²", elements.full_inertia(part))
        for key, of, full in bodies:
            typed, path = parts.reader.typed_body(part.path, key), (*part.path, key)
            refers_to_train = part.kind == "flywheel" and elements.is_of_train(part, key)
            if parts.reader.is_of_results(part.path, key) and not refers_to_train:
                template = "is of what is calculated, which nothing holds against the part; type it. A flywheel may refer to the drive train's"
                yield finding(path, template)
            elif typed == 0:
                yield finding(path, "is zero, as nothing is that turns; give its own, or leave the key out")
            elif typed is not None and full is not None:
                least, most = MASS_SHARE[0] if part.kind != "clutch" else MASS_POSSIBLE[0], MASS_SHARE[1]
                if not least <= typed / full <= most:
                    template = "is {typed}, but the full steel body of its dimensions has {full}; {least} to {most} of it are usual"
                    ends, given = (str(least), str(most)), (f"{typed:.4g} {of}", f"{full:.3g} {of}")
                    yield finding(path, template, level=_mass_level(typed / full), typed=given[0], full=given[1],
                                  least=ends[0], most=ends[1])  # fmt: skip


def filled(parts: MachineParts, elements: Elements) -> Iterator[Finding]:
    """A body is not much less than the full disc of its dimensions, and a Geneva wheel as wide as its roller wants."""
    for part in hubs(parts):
        share, width = elements.share_of_disc(part), part.keys.width
        if share is not None and share < MASS_SHARE[0]:
            template = "leaves by fill, bore and width {share} of its full steel disc; {least} at least is usual"
            least = str(MASS_SHARE[0])
            yield finding(part.path, template, level=_mass_level(share), share=f"{share:.3g}", least=least)
        if part.kind == "geneva_wheel" and part.port and width is not None:
            roller = parts.reader.typed_number(part.port[0], "roller_width") or 0.0
            if width < roller / 2:
                template = (
                    "is {width} wide, less than half of the roller of {roller} that runs in it; give its own width"
                )
                yield finding((*part.path, "width"), template, width=width, roller=roller)


def _mass_level(share: float) -> Level:
    return "warning" if MASS_POSSIBLE[0] <= share <= MASS_POSSIBLE[1] else "error"


# What is typed in vain.


def typed_twice(parts: MachineParts, elements: Elements) -> Iterator[Finding]:
    """What follows from the parts is typed neither in the block of a mechanism nor at a part."""
    template = "is given here, but follows from the parts; remove the key"
    for name, fills in elements.fills.items():
        for given in fills.keys() & elements.blocks.get(name, {}).keys():
            yield finding(("mechanisms", name, given), template, first_place(fills[given]) or ("shafts",))
    for path, against in elements.twice:
        yield finding(path, template, against)


def untied(parts: MachineParts, elements: Elements) -> Iterator[Finding]:
    """A block that is calculated as a part's calculations are belongs to a part, to which a value of it refers."""
    kinds, made = {each.kind for each in elements.made}, {each.name for each in elements.made}
    for name, block in elements.blocks.items():
        kind = parts.mechanisms[name]
        roots = {path.strip().split(".")[0] for _, text in texts(block) for path in WHOLE.findall(text)}
        if kind in kinds and not roots & {*WORDS, *made}:
            template = "is a {kind}, as they are calculated of the parts, but refers to none of them; make it a part, or refer to its part"
            yield finding(("mechanisms", name), template, level="warning", kind=kind)


def unused(parts: MachineParts, elements: Elements) -> Iterator[Finding]:
    """What is typed at a part beside its own keys goes into its calculation, and the efficiency of a mesh into a torque."""
    used = elements.counted | {*typed_paths([*(each.inputs for each in elements.made), *elements.fills.values()])}
    wheels = (part for part in hubs(parts) if part.kind == "flywheel")
    used |= {(*part.path, key) for part in wheels for key in ("mass", "inertia") if elements.is_of_train(part, key)}
    used |= {path[:length] for path in used for length in range(len(path))}
    told = {given for given, _ in elements.twice}
    homes = [(shaft.path, shaft.more, shaft) for shaft in parts.shafts.values()]
    homes += [(part.path, part.more, part.shaft) for part in parts.every_part]
    for path, more, shaft in homes:
        for own in ((*path, key) for key in more if elements.is_made(shaft.calculation)):
            if own not in used | told:
                yield finding(own, "goes into no calculation of this part; remove the key")
    for join in (each for each in parts.joins if isinstance(each.keys, MeshKeys)):
        own = (*join.path, "efficiency")
        if "efficiency" in parts.reader.data["meshes"][join.name] and own not in used:
            template = "goes into no calculation, as no torque on this pair is known by which way the power flows; remove the key"
            yield finding(own, template)
    for shaft in (each for each in parts.shafts.values() if each.keys.motor and each.keys.motor.radial_force):
        if (own := (*shaft.path, "motor", "radial_force")) not in used:
            yield finding(own, "is compared with the load of no V-belt; remove the key")
    service = [("machine", key) for key in SERVICE_KEYS if key in parts.reader.data["machine"]]
    for own in service if not used.intersection(service) else ():
        yield finding(own, "goes into no calculation, since no V-belt is calculated; remove the key")


RULES: tuple[Rule, ...] = (
    *naming.RULES, seat, bore, overlap, planes, locating, mounting, shoulder, stop, key, wall, steel, torque_carried, integral,
    force_plane, pins, *join_rules.RULES,
)  # fmt: skip
ELEMENT_RULES: tuple[ElementRule, ...] = (
    *naming.ELEMENT_RULES, *join_rules.ELEMENT_RULES, weighed, inert, massive, filled, typed_twice, untied, unused,
)  # fmt: skip
