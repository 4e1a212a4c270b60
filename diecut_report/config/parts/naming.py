"""Whether what the parts name is there: parts, ports, bearings of the tables, and the strengths with which they are calculated."""

from __future__ import annotations

from collections.abc import Iterator

from diecut_report.config.model import NAME
from diecut_report.config.parts.elements import GEAR_LIMITS, Elements
from diecut_report.config.parts.findings import Finding, finding, hubs, mm
from diecut_report.config.parts.keys import ChainKeys, MeshKeys
from diecut_report.config.parts.model import MachineParts, catalogue_size
from diecut_report.errors import nearest
from diecut_report.text.phrases import phrase


def names(parts: MachineParts) -> Iterator[Finding]:
    """Parts of a shaft have names of their own, and what they ride on, stand for or move is there."""
    for shaft in parts.shafts.values():
        known = [part.name for part in shaft.parts]
        for part in shaft.parts:
            if not NAME.fullmatch(part.name):
                template = "is {name}, which is not a name: a letter, then letters, digits, _ and - are allowed"
                yield finding(parts, "names", "error", (*part.path, part.kind), template, name=repr(part.name))
            if known.count(part.name) > 1:
                template = "is {name}, the name of another part of this shaft; give each its own"
                yield finding(parts, "names", "error", (*part.path, part.kind), template, name=part.name)
            if part.keys.rides_on is not None and part.keys.rides_on not in known:
                template = "is {name}, which is not a part of this shaft; they are {known}"
                yield finding(
                    parts,
                    "names",
                    "error",
                    (*part.path, "rides_on"),
                    template,
                    name=part.keys.rides_on,
                    known=", ".join(known),
                )
            if part.keys.pin is not None and part.port is None:
                template = "stands for no port, such as drive.crank, whose force acts on the pin; give of"
                yield finding(parts, "names", "error", part.path, template)


def designations(parts: MachineParts) -> Iterator[Finding]:
    """A bearing is one of the tables, or its dimensions are typed."""
    for _, part in hubs(parts):
        if part.kind == "bearing" and any(part.size(column) is None for column in ("d", "D", "B")):
            template = (
                "is {designation}, which is not in the tables; give its bore, outside and width, or another designation"
            )
            designation = part.keys.designation or phrase("not given")
            yield finding(parts, "catalogue", "error", part.path, template, designation=designation)
        pin = part.keys.pin
        if pin is not None and pin.bearing is not None and catalogue_size(pin.bearing, "d") is None:
            template = "is {designation}, which is not in the tables; take another one, or leave the pin's bearing out"
            yield finding(
                parts, "catalogue", "error", (*part.path, "pin", "bearing"), template, designation=pin.bearing
            )
        if (
            pin is not None
            and pin.span_start is not None
            and pin.span_end is not None
            and pin.span_start >= pin.span_end
        ):
            template = "goes from {start} to {end}; the first support stands before the second"
            yield finding(
                parts,
                "pin_plane",
                "error",
                (*part.path, "pin", "span"),
                template,
                start=mm(pin.span_start),
                end=mm(pin.span_end),
            )


def bores(parts: MachineParts) -> Iterator[Finding]:
    """The bore of a section is smaller than its diameter."""
    for shaft in parts.shafts.values():
        for section in (each for each in shaft.sections if each.bore >= each.diameter):
            template = "has section {number} bored to {bore}, but {diameter} thick; take a smaller bore"
            yield finding(parts, "bore", "error", (*shaft.path, "sections"), template, number=section.index + 1, bore=mm(section.bore),
                diameter=mm(section.diameter))  # fmt: skip


def strengths(parts: MachineParts) -> Iterator[Finding]:
    """What keys and gears are made of is given, once for all or at the pair."""
    gears = parts.keys.gears
    if gears.hub_yield is None and any(part.keys.key for _, part in hubs(parts)):
        template = "lacks gears.hub_yield, the yield strength of the hubs, with which the keys are calculated"
        yield finding(parts, "strengths", "error", ("machine",), template)
    for join in (each for each in parts.joins if isinstance(each.keys, MeshKeys)):
        missing = [
            key for key in GEAR_LIMITS if getattr(gears, key) is None and not {f"{key}_1", f"{key}_2"} <= set(join.more)
        ]
        if missing:
            template = "lacks {keys}: give it under machine.gears, or for both gears here"
            yield finding(parts, "strengths", "error", join.path, template, keys=" and ".join(missing))


def ports(parts: MachineParts, elements: Elements) -> Iterator[Finding]:
    """What a part stands for, or a chain moves, is there."""
    for part in (each for shaft in parts.shafts.values() for each in shaft.parts if each.keys.of is not None):
        if elements.port(part) is None:
            known = elements.port_names
            template = "is {of}, which is not a port of a mechanism{near}; there are {known}"
            yield finding(parts, "names", "error", (*part.path, "of"), template, of=part.keys.of, near=nearest(str(part.keys.of), known),
                known=", ".join(known) or phrase("none"))  # fmt: skip
    for join in (each for each in parts.joins if isinstance(each.keys, ChainKeys) and each.keys.moves):
        mechanism, _, what = join.keys.moves.partition(".")
        wanted = "cylinder" if parts.mechanisms.get(mechanism) == "cylinder_drive" else "conveyor"
        if mechanism not in parts.mechanisms or what != wanted:
            template = "is {moves}, which no mechanism has moved; write MECHANISM.cylinder or MECHANISM.conveyor"
            yield finding(parts, "names", "error", (*join.path, "moves"), template, moves=join.keys.moves)
