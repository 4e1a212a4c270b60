"""Whether the parts fit each other: each rule one function, which names both places, both values and what to change."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import combinations, pairwise

from diecut_report.config.model import texts
from diecut_report.config.parts.demands import first_place, typed_paths
from diecut_report.config.parts.elements import SERVICE_KEYS, Elements
from diecut_report.config.parts.findings import Finding, Level, finding, hubs, mm, table_row
from diecut_report.config.parts.join_rules import (
    axes,
    center,
    chain,
    clutch_lines,
    driven,
    frame,
    losses,
    mesh_pair,
    one_belt,
    rate,
    ratios,
    sector,
    shifts,
    stages,
    wall,
)
from diecut_report.config.parts.keys import WORDS, MeshKeys
from diecut_report.config.parts.masses import filled, inert, massive, weighed
from diecut_report.config.parts.model import (
    SAME_PLACE,
    MachineParts,
    MachineShaft,
    ShaftPart,
)
from diecut_report.config.parts.naming import (
    bores,
    braking,
    described,
    designations,
    few,
    joined,
    misplaced,
    names,
    ports,
    riding,
    strengths,
)
from diecut_report.config.references import WHOLE
from diecut_report.config.validation import ConfigPlace
from diecut_report.errors import Problem
from diecut_report.quantities.units import unit
from diecut_report.standards import catalogue_size, standard_series
from diecut_report.standards.ranges import range_of
from diecut_report.text.phrases import Phrase, phrase
from diecut_report.text.phrases import joined as joined_phrases

LONGEST_KEY = 1.3  # of the shaft's diameter, over which a key bears
KEY_TO_FILLET = 0.1  # of the shaft's diameter
INTEGRAL_WARNED, INTEGRAL_MOST = 2.0, 4.0  # diameters of the seat, below the teeth
HARDNESS = (0.69, 260e6)  # σ_Hlim of R_m, Pa: quality ME of ISO 6336-5, with HV = R_m / 3.2 MPa
SIDES = {
    ("left",): phrase("on the left"),
    ("right",): phrase("on the right"),
    ("left", "right"): phrase("on both sides"),
}


def misdriven(parts: MachineParts) -> list[Problem]:
    """Return which shafts are driven by none, by several, or by themselves: nothing can be made of such parts."""
    place = ConfigPlace(parts.reader.tree)
    return [place.problem(each.path, each.message) for each in driven(parts)]


def coherence(parts: MachineParts, elements: Elements) -> list[Problem]:
    """Return what is wrong with the parts; what only warns or fails a check is kept in ``parts.findings``."""
    of_mechanisms = (
        rule(parts, elements)
        for rule in (
            ports,
            ratios,
            rate,
            stages,
            losses,
            clutch_lines,
            weighed,
            inert,
            massive,
            filled,
            _typed_twice,
            _untied,
            _unused,
        )
    )
    found = [each for own in (*(rule(parts) for rule in RULES), *of_mechanisms) for each in own]
    parts.findings[:] = [each for each in found if each.level != "error"]
    place = ConfigPlace(parts.reader.tree)
    return [place.problem(each.path, each.message) for each in found if each.level == "error"]


# Seats, bores and places along a shaft.


def seat(parts: MachineParts) -> Iterator[Finding]:
    """A hub and a bearing stand on one section, on the shaft."""
    for shaft, part in hubs(parts):
        start, end = part.ends
        section = part.section
        on_shaft = start >= -SAME_PLACE and end <= shaft.length + SAME_PLACE
        if not on_shaft or section is None:
            template = (
                "stands from {start} to {end}, but the shaft goes from 0 to {length}; move it or make the shaft longer"
            )
            yield finding(
                parts,
                "seat",
                "error",
                (*part.path, "at"),
                template,
                shaft.path,
                start=mm(start),
                end=mm(end),
                length=mm(shaft.length),
            )
        elif (
            (start < section.start - SAME_PLACE or end > section.end + SAME_PLACE)
            and not part.keys.rides_on
            and not part.keys.integral
        ):
            template = "stands from {start} to {end}, but section {number} ({diameter}) goes from {first} to {last}; move it or lengthen the section"
            yield finding(parts, "seat", "error", (*part.path, "at"), template, (*shaft.path, "sections"), start=mm(start), end=mm(end),
                number=section.index + 1, diameter=mm(section.diameter), first=mm(section.start), last=mm(section.end))  # fmt: skip


def bore(parts: MachineParts) -> Iterator[Finding]:
    """The bore of a bearing is the diameter of its seat or pin."""
    for shaft, part in hubs(parts):
        own = part.size("d") if part.kind == "bearing" else None
        if own is not None and part.section is not None and abs(own - part.seat) > SAME_PLACE:
            template = "has a bore of {bore}, but sits on a diameter of {seat}; take a bearing of that bore, or change section {number}"
            yield finding(parts, "bore", "error", (*part.path, "designation"), template, (*shaft.path, "sections"), bore=mm(own), seat=mm(part.seat),
                number=part.section.index + 1)  # fmt: skip
        pin = part.keys.pin
        if pin is not None and pin.bearing is not None:
            inner = catalogue_size(pin.bearing, "d")
            if inner is not None and abs(inner - pin.diameter) > SAME_PLACE:
                template = (
                    "has a bore of {bore}, but sits on a pin of {seat}; take a bearing of that bore, or change the pin"
                )
                yield finding(parts, "bore", "error", (*part.path, "pin", "bearing"), template, (*part.path, "pin", "diameter"), bore=mm(inner),
                    seat=mm(pin.diameter))  # fmt: skip


def overlap(parts: MachineParts) -> Iterator[Finding]:
    """Hubs and bearings of a shaft do not overlap; they may touch."""
    for shaft in parts.shafts.values():
        own = sorted(
            (part for part in shaft.parts if not part.keys.rides_on and part.kind != "load"),
            key=lambda part: part.keys.at,
        )
        for one, other in pairwise(own) if shaft.sections else ():
            if other.ends[0] < one.ends[1] - SAME_PLACE:
                template = "begins at {start}, but {name} ends at {end}; move one of them by {gap}"
                yield finding(parts, "overlap", "error", (*other.path, "at"), template, (*one.path, "at"), start=mm(other.ends[0]), name=one.name,
                    end=mm(one.ends[1]), gap=mm(one.ends[1] - other.ends[0]))  # fmt: skip


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
            radius = parts.body_radius(part)
            width = parts.body_width(part)
            if radius is not None:
                yield _Cylinder(part, radius, left + part.keys.at - width / 2, left + part.keys.at + width / 2)
        if shaft.sections:
            thickest = max(shaft.sections, key=lambda each: each.diameter)
            yield _Cylinder(shaft.parts[0], thickest.diameter / 2, left + thickest.start, left + thickest.end)


def planes(parts: MachineParts) -> Iterator[Finding]:
    """Bodies of two shafts that meet in a plane leave each other room, but where they mesh."""
    joined = {frozenset((one, other)) for join in parts.joins for one in join.drivers for other in join.driven}
    found: set[frozenset[str]] = set()  # one body that reaches a shaft is said once
    for one, other in combinations(_cylinders(parts), 2):
        shafts = frozenset((one.part.shaft.name, other.part.shaft.name))
        if len(shafts) == 1 or shafts in found or frozenset((one.part, other.part)) in joined:
            continue
        distance = parts.distance(one.part.shaft.name, other.part.shaft.name)
        meet = min(one.end, other.end) - max(one.start, other.start) > SAME_PLACE
        if distance is not None and meet and distance < one.radius + other.radius - SAME_PLACE:
            found.add(shafts)
            template = "has a radius of {radius} and reaches {other} ({other_radius}) in one plane: the axes are {distance} apart; move one of them"
            yield finding(parts, "overlap", "warning", one.part.path, template, other.part.path, radius=mm(one.radius), other=other.part.called,
                other_radius=mm(other.radius), distance=mm(distance))  # fmt: skip


def locating(parts: MachineParts) -> Iterator[Finding]:
    """One bearing of a shaft holds it along its axis, never one without ribs."""
    for shaft in parts.shafts.values():
        fixed = [part for part in shaft.bearings if not part.keys.floating]
        if shaft.is_rated and shaft.sections and len(shaft.bearings) != 2:
            template = "has {count} bearings; a shaft is calculated on two"
            yield finding(parts, "locating", "error", (*shaft.path, "parts"), template, count=len(shaft.bearings))
        elif shaft.is_rated and shaft.sections and len(fixed) != 1:
            template = "has {count} bearings that hold it along its axis; exactly one is needed: write floating: true for the other"
            yield finding(parts, "locating", "error", (*shaft.path, "parts"), template, count=len(fixed))
        for part in fixed if len(fixed) == 1 else ():
            if (part.keys.designation or "").upper().replace(" ", "").startswith(("NU", "N2", "N3", "N1")):
                template = "is {designation}, which cannot hold the shaft along its axis; make it floating and let the other bearing do so"
                yield finding(
                    parts, "locating", "error", (*part.path, "designation"), template, designation=part.keys.designation
                )


def mounting(parts: MachineParts) -> Iterator[Finding]:
    """A part can be put on from one end: no section on the way is thicker than its bore."""
    for shaft, part in hubs(parts):
        section = part.section
        if section is None or part.keys.integral or part.keys.rides_on:
            continue
        inner = part.keys.bore if part.keys.bore else part.seat
        own = section.index
        sides = shaft.sections[:own], shaft.sections[own + 1 :]
        if all(any(each.diameter > inner + SAME_PLACE for each in side) for side in sides):
            template = "has a bore of {bore}, but sections on both sides are thicker: it cannot be put on; make one side thinner or the seat thicker"
            yield finding(
                parts, "mounting", "error", (*part.path, "at"), template, (*shaft.path, "sections"), bore=mm(inner)
            )


def shoulder(parts: MachineParts) -> Iterator[Finding]:
    """A shoulder that a bearing rests on is as high as its ring needs, not as high as the other ring, and rounded less than its corner."""
    for shaft, part in hubs(parts):
        corner, outside = part.size("r"), part.size("D")
        if part.kind != "bearing" or outside is None:
            continue
        if corner is None:
            if part.shoulders:
                template = "rests on a shoulder, but its ring's corner is not known, so that neither height nor fillet is checked; give its corner"
                yield finding(parts, "shoulder", "warning", part.path, template, (*shaft.path, "sections"))
            continue
        row = table_row("bearing_shoulders", corner)
        height = row["h0" if (part.keys.designation or "").startswith("60") else "h"]
        least, most = part.seat + 2 * height, outside - 2 * height
        for step, fillet in part.shoulders.values():
            place = (*shaft.path, "sections")
            if not least - SAME_PLACE <= step.diameter <= most + SAME_PLACE:
                template = "rests on a shoulder of {diameter}; its rings want {least} to {most}: change section {number}, or put a ring between"
                yield finding(parts, "shoulder", "warning", part.path, template, place, diameter=mm(step.diameter), least=mm(least),
                    most=mm(most), number=step.index + 1)  # fmt: skip
            if fillet is not None and fillet > corner - SAME_PLACE:
                template = "rests on a shoulder with a fillet of {fillet}, too large for its ring with corners from {corner}; take less than {most}"
                yield finding(parts, "shoulder", "error", part.path, template, place, fillet=mm(fillet), corner=mm(corner),
                    most=mm(corner - SAME_PLACE))  # fmt: skip


def stop(parts: MachineParts) -> Iterator[Finding]:
    """What is put on a shaft is held in both directions: by a shoulder, the part beside it, or a ring, sleeve, nut or press fit."""
    for shaft in parts.shafts.values():
        loose = []
        for part in (part for _, part in hubs(parts) if part.shaft is shaft and part.section is not None):
            keys = part.keys
            if keys.integral or keys.bolted or keys.interference or keys.rides_on:
                continue
            if keys.stop == "shoulder" and not part.shoulders:
                template = (
                    "is stopped by a shoulder, but touches no thicker section; move it to one, or give another stop"
                )
                yield finding(parts, "stop", "warning", (*part.path, "stop"), template, (*shaft.path, "sections"))
            elif (
                keys.stop in (None, "shoulder") and parts.keys.stop is None and (sides := SIDES.get(_free_sides(part)))
            ):
                loose.append(Phrase("{part} {sides}", part=part.name, sides=sides))
        if loose:
            template = "nothing holds along the shaft: {loose}; move them to a shoulder, or give stop, there or to all parts under machine"
            yield finding(parts, "stop", "warning", shaft.path, template, loose=joined_phrases(loose, ", "))


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
    for shaft, part in hubs(parts):
        if not part.keys.key or part.section is None:
            continue
        path, long = (*part.path, "key"), part.keys.key
        if part.keys.hub is not None and long > part.keys.hub + SAME_PLACE:
            template = "is {length} long, but its hub is {hub} long; take a key that is not longer than the hub"
            yield finding(
                parts, "key", "error", path, template, (*part.path, "hub"), length=mm(long), hub=mm(part.keys.hub)
            )
        if not any(abs(long - each) <= SAME_PLACE for each in known):
            nearest_two = sorted(known, key=lambda each: abs(each - long))[:2]
            template = "is {length} long, which is not a length of DIN 6885-1; take {lengths}"
            yield finding(
                parts,
                "key",
                "error",
                path,
                template,
                length=mm(long),
                lengths=" or ".join(mm(each) for each in sorted(nearest_two)),
            )
        yield from _key_on_section(parts, shaft, part, long)


def _key_on_section(parts: MachineParts, shaft: MachineShaft, part: ShaftPart, long: float) -> Iterator[Finding]:
    section, path = part.section, (*part.path, "key")
    assert section is not None, "it is looked up before"
    start, end = part.keys.at - long / 2, part.keys.at + long / 2
    if start < section.start - SAME_PLACE or end > section.end + SAME_PLACE:
        template = "goes from {start} to {end}, but its section ends at {first} and {last}; take a shorter key"
        yield finding(parts, "key", "error", path, template, (*shaft.path, "sections"), start=mm(start), end=mm(end), first=mm(section.start),
            last=mm(section.end))  # fmt: skip
        return
    deep = table_row("parallel_keys", section.diameter)["t1"]
    if (section.diameter - section.bore) / 2 <= deep:
        template = (
            "lies in a keyseat {deep} deep, but the wall around the bore of {bore} is not thicker; take a smaller bore"
        )
        yield finding(
            parts, "key", "error", path, template, (*shaft.path, "sections"), deep=mm(deep), bore=mm(section.bore)
        )
    bearing = long - key_width(section.diameter) if part.keys.key_form == "A" else long
    if bearing > LONGEST_KEY * section.diameter + SAME_PLACE:
        template = "bears over {length}, more than {share} times the diameter {diameter}: the torque enters at its end; take a shorter key"
        yield finding(
            parts,
            "key",
            "warning",
            path,
            template,
            length=mm(bearing),
            share=LONGEST_KEY,
            diameter=mm(section.diameter),
        )
    steps = [start - section.start] if section.index else []
    steps += [section.end - end] if section.index < len(shaft.sections) - 1 else []
    near = max(min(steps, default=math.inf), 0.0)  # but for rounding
    if near < KEY_TO_FILLET * section.diameter - SAME_PLACE:
        template = "ends {distance} from a step, less than a tenth of the diameter {diameter}: both notches act together; move or shorten it"
        yield finding(
            parts,
            "key",
            "warning",
            path,
            template,
            (*shaft.path, "sections"),
            distance=mm(near),
            diameter=mm(section.diameter),
        )


def key_width(diameter: float) -> float:
    """Return the width of the key for a shaft, m (DIN 6885-1)."""
    return table_row("parallel_keys", diameter)["b"]


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
        shown = {"limit": gears.sigma_h_lim, "hub": gears.hub_yield, "most": most}
        yield finding(
            parts,
            "steel",
            "warning",
            own,
            template,
            hub,
            **{name: f"{value / 1e6:.4g} MPa" for name, value in shown.items()},
        )


def torque_carried(parts: MachineParts) -> Iterator[Finding]:
    """What takes a torque from its shaft, or gives it one, is keyed, pressed on, cut on it or bolted, in one of these ways."""
    for part in (part for _, part in hubs(parts)):
        carries = (part, *(each for each in part.shaft.parts if each.keys.rides_on == part.name))
        takes = any(list(parts.joins_of(each)) or each.port is not None or each.kind == "brake" for each in carries)
        if takes and part.kind != "bearing" and not part.is_carried:
            template = "carries a torque, but nothing joins it to the shaft; give key, interference, integral: true or bolted: true"
            yield finding(parts, "torque_carried", "fail", part.path, template)
        ways = [way for way in ("key", "interference", "integral", "bolted", "rides_on") if getattr(part.keys, way)]
        if len(ways) > 1:
            template = "is joined to its shaft by {ways}, of which one alone is calculated; give one"
            yield finding(parts, "torque_carried", "error", part.path, template, ways=", ".join(ways))


def integral(parts: MachineParts) -> Iterator[Finding]:
    """Gears, cranks and rockers are in one piece with a shaft; a gear is not much thicker below its teeth than its shaft, else it is a wheel."""
    for part in (part for _, part in hubs(parts)):
        if part.keys.integral and part.kind not in ("gear", "crank", "rocker"):
            template = "is not made in one piece with a shaft, as gears, cranks and rockers are; give key, interference or bolted: true"
            yield finding(parts, "integral", "error", (*part.path, "integral"), template)
    for join in parts.joins:
        for part in (*join.drivers, *join.driven) if isinstance(join.keys, MeshKeys) else ():
            if not part.keys.integral or part.section is None:
                continue
            root = join.root(part)
            assert root is not None, "a gear has one"
            if root < part.seat - SAME_PLACE:
                template = "is {root} thick below its teeth, which are cut into a shaft of {seat}; make its section that thick, as it is calculated"
                yield finding(parts, "integral", "error", (*part.path, "integral"), template, (*part.shaft.path, "sections"), root=mm(root),
                    seat=mm(part.seat))  # fmt: skip
            if root > INTEGRAL_WARNED * part.seat:
                level: Level = "error" if root > INTEGRAL_MOST * part.seat else "warning"
                template = "is cut on a shaft of {seat}, but is {root} thick below its teeth: no such shaft is turned; give key or interference"
                yield finding(
                    parts, "integral", level, (*part.path, "integral"), template, seat=mm(part.seat), root=mm(root)
                )


def force_plane(parts: MachineParts) -> Iterator[Finding]:
    """A crank's or rocker's force has a plane beyond the face of its hub; without a pin of the machine no nearer than half the roller's width."""
    for part in (part for _, part in hubs(parts)):
        if part.kind in ("crank", "rocker", "cam") and part.port is not None and not part.hub:
            template = "has no hub, so that it is not known where its face is, beyond which its force acts; give hub"
            yield finding(parts, "pin_plane", "error", part.path, template)
        if part.kind not in ("crank", "rocker", "cam") or part.port is None or part.keys.pin is not None:
            continue
        if part.keys.plane is None:
            template = "has neither a pin nor a plane, so that it is not known how far beyond the disc its force acts; give plane"
            yield finding(parts, "pin_plane", "error", part.path, template)
            continue
        width = parts.reader.typed_number(part.port[0], "roller_width") or 0.0
        if part.keys.plane < width / 2 - SAME_PLACE:
            template = "is {plane} beyond the disc, but the roller is {width} wide and would stand in the disc; give at least half of it"
            yield finding(parts, "pin_plane", "error", (*part.path, "plane"), template, ("mechanisms", part.port[0], "roller_width"),
                plane=mm(part.keys.plane), width=mm(width))  # fmt: skip


def pins(parts: MachineParts) -> Iterator[Finding]:
    """The bearing of a pin stands on it with its whole width, off the face of its disc or off both its supports."""
    for part, pin in ((part, part.keys.pin) for _, part in hubs(parts) if part.keys.pin is not None):
        path, place = (*part.path, "pin", "plane"), pin.middle
        width = (catalogue_size(pin.bearing, "B") or 0.0) if pin.bearing else 0.0
        if pin.held is not None and pin.held > part.hub + SAME_PLACE > SAME_PLACE:
            template = "is {held}, but the hub of {name} is {hub} long; a pin is held within its disc"
            yield finding(parts, "pin_plane", "error", (*part.path, "pin", "held"), template, (*part.path, "hub"), held=mm(pin.held),
                name=part.called, hub=mm(part.hub))  # fmt: skip
        near = pin.supports[1] if pin.held is not None else min(pin.supports, key=lambda each: abs(place - each))
        if (off := abs(place - near)) < width / 2 - SAME_PLACE:
            support = (
                phrase("the disc's face") if pin.held is not None else Phrase("the support at {place}", place=mm(near))
            )
            template = "has its middle {off} off {support}, but {bearing} is {width} wide; give at least half of that"
            yield finding(parts, "pin_plane", "error", path, template, (*part.path, "pin", "bearing"), off=mm(off), support=support,
                bearing=pin.bearing, width=mm(width))  # fmt: skip
        elif not width / 2 - SAME_PLACE <= place <= pin.length - width / 2 + SAME_PLACE:
            template = "reaches from {start} to {end}, but the pin from {first} to {last}; move it, or the supports"
            yield finding(parts, "pin_plane", "error", path, template, (*part.path, "pin", "span"), start=mm(place - width / 2),
                end=mm(place + width / 2), first=mm(0), last=mm(pin.length))  # fmt: skip


def _typed_twice(parts: MachineParts, elements: Elements) -> Iterator[Finding]:
    """What follows from the parts is typed neither in the block of a mechanism nor at a part."""
    template = "is given here, but follows from the parts; remove the key"
    for name, fills in elements.fills.items():
        block = elements.blocks.get(name, {})
        for given in fills.keys() & block.keys():
            against = first_place(fills[given]) or ("shafts",)
            yield finding(parts, "typed_twice", "error", ("mechanisms", name, given), template, against)
    for path, against in elements.twice:
        yield finding(parts, "typed_twice", "error", path, template, against)


def _untied(parts: MachineParts, elements: Elements) -> Iterator[Finding]:
    """A block that is calculated as a part's calculations are belongs to a part, to which a value of it refers."""
    kinds, made = {each.kind for each in elements.made}, {each.name for each in elements.made}
    for name, block in elements.blocks.items():
        roots = {path.strip().split(".")[0] for _, text in texts(block) for path in WHOLE.findall(text)}
        if parts.mechanisms[name] in kinds and not roots & {*WORDS, *made}:
            template = "is a {kind}, as they are calculated of the parts, but refers to none of them; make it a part, or refer to its part"
            yield finding(
                parts, "block_without_part", "warning", ("mechanisms", name), template, kind=parts.mechanisms[name]
            )


def _unused(parts: MachineParts, elements: Elements) -> Iterator[Finding]:
    """What is typed at a part beside its own keys goes into its calculation, and the efficiency of a mesh into a torque."""
    used = elements.counted | {*typed_paths([*(each.inputs for each in elements.made), *elements.fills.values()])}
    wheels = (part for _, part in hubs(parts) if part.kind == "flywheel")
    used |= {(*part.path, key) for part in wheels for key in ("mass", "inertia") if elements.is_of_train(part, key)}
    homes = [(shaft.path, shaft.more, f"shafts_{shaft.name}") for shaft in parts.shafts.values()]
    homes += [(part.path, part.more, f"shafts_{name}") for name, shaft in parts.shafts.items() for part in shaft.parts]
    for path, more, calculation in homes:
        for key in more if elements.is_made(calculation) else ():
            own = (*path, key)
            if own not in {each[: len(own)] for each in used} | {given for given, _ in elements.twice}:
                yield finding(parts, "names", "error", own, "goes into no calculation of this part; remove the key")
    for join in (each for each in parts.joins if isinstance(each.keys, MeshKeys)):
        own = (*join.path, "efficiency")
        typed = parts.reader.data["meshes"][join.name]
        if "efficiency" in typed and own not in {each[: len(own)] for each in used}:
            template = "goes into no calculation, as no torque on this pair is known by which way the power flows; remove the key"
            yield finding(parts, "names", "error", own, template)
    for own in (
        (*each.path, "motor", "radial_force")
        for each in parts.shafts.values()
        if each.keys.motor and each.keys.motor.radial_force
    ):
        if own not in used:
            yield finding(parts, "names", "error", own, "is compared with the load of no V-belt; remove the key")
    service = [("machine", key) for key in SERVICE_KEYS if key in parts.reader.data["machine"]]
    if not used.intersection(service):
        for own in service:
            yield finding(
                parts, "names", "error", own, "goes into no calculation, since no V-belt is calculated; remove the key"
            )


RULES: tuple[Callable[[MachineParts], Iterator[Finding]], ...] = (
    few, names, riding, braking, described, joined, misplaced, designations, bores, strengths, seat, bore, overlap, planes, locating, mounting,
    shoulder, stop, key, wall, steel, torque_carried, integral, force_plane, pins, axes, one_belt, center, shifts, frame, mesh_pair, sector, chain,
)  # fmt: skip
