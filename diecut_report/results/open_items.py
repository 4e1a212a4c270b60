"""What is left open of a machine though no check fails: values without a basis, parts that nothing rates, checks that warn or are not made."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

from diecut_report.config.instances import Instance, Slot
from diecut_report.config.model import PRESS
from diecut_report.config.source_hashes import plugin_code
from diecut_report.config.validation import ASSUMED, names_something
from diecut_report.machine.calculation import Calculation
from diecut_report.mechanism.inputs import POINTS, Quantity
from diecut_report.mechanism.names import Text
from diecut_report.quantities.units import unit
from diecut_report.results.carrying_parts import counted, unrated
from diecut_report.results.conclusion import LEFT, CalculatedCount, judged, summary, unsettled
from diecut_report.results.mechanism_record import CheckRecord
from diecut_report.results.model import OpenRecord, SummaryRecord
from diecut_report.results.origins import assumed, input_path, is_default
from diecut_report.results.press_run import Run
from diecut_report.results.record import OpenKind
from diecut_report.standards.ranges import asks_basis, open_choices, range_of, unranged, zero_is_open
from diecut_report.text.phrases import Phrase, phrase

FORCES = ("N", "N*m")  # SI units of what a part carries
LIMIT = "allowable_"  # of a key: beyond its usual range nothing founds it
UNPROVED = phrase("it is not proved that no check depends on it")
"""Why a value is open as long as nobody has calculated the machine with others."""


def run_summary(run: Run, checks: Mapping[str, Sequence[CheckRecord]]) -> SummaryRecord:
    """Return the verdict on a run as numbers; an assumed value is open as long as it is not proved harmless."""
    found = summary(checks, assumed(run.config)).with_(open=open_items(run, checks))
    if run.config.parts is not None:
        found = found.with_(parts=counted(run.config.parts, run.config.named("drive_train"), checks))
    lost = {*run.errors, *run.skipped} & {*run.config.kinds, *(case.name for case in run.cases)}
    total = len(run.config.kinds) + len(run.cases)
    return judged(found, CalculatedCount(total, len(lost), bool(run.cases)))


def open_items(run: Run, checks: Mapping[str, Sequence[CheckRecord]]) -> list[OpenRecord]:
    """Return all that is open of a run, in the order of ``LEFT``."""
    owner = run.config.project.prepared_by or ""
    mechanisms = {name: calc.mechanism for name, calc in run.calculations.items()}
    mechanisms |= {case.name: case.comparison.mechanism for case in run.cases}
    doubtful = [name for name, own in mechanisms.items() if plugin_code(own).get("plugin_check") == "failed"]
    found = unsettled(checks, doubtful, owner)
    if run.config.parts is not None:
        found += unrated(run.config.parts, run.config.named("drive_train"), checks, owner)
    for name, ports in free_ports(run).items() if run.config.parts is None else ():
        why = Phrase("no part takes {ports}", ports=", ".join(ports))
        found.append(OpenRecord(what="not_rated", path=f"mechanisms.{name}", owner=owner, why=why))
    found += [OpenRecord(what=each.what, path=each.path, owner=owner, why=each.why) for each in open_values(run)]
    order = list(LEFT)
    return sorted(found, key=lambda each: order.index(each.what))


def free_ports(run: Run) -> dict[str, list[str]]:
    """Return of each mechanism that makes forces the curves of force and torque that nothing takes.

    A mechanism that takes a force, a torque or all of another one is a part which rates it, or hands on what it declares as its reactions.
    A mechanism that is calculated alone belongs to no drive line.
    """
    taken = {(each.instance, each.result) for target in run.config.links.values() for each in target.single}
    forces = {name: _forces(calc) for name, calc in run.calculations.items()}
    given = {(name, force) for name, own in forces.items() for force in own}
    parts = {
        node[0]
        for node, target in run.config.links.items()
        if any(each.is_mechanism or (each.instance, each.result) in given for each in target.single)
    }
    asked = {
        name: [force for force in own if name not in parts or force in run.calculations[name].mechanism.reactions]
        for name, own in forces.items()
    }
    found = {name: [force for force in own if (name, force) not in taken] for name, own in asked.items()}
    return {name: own for name, own in found.items() if own and len(forces) > 1}


def _forces(calc: Calculation) -> list[str]:
    return [name for name, step in calc.curves.items() if step.output and unit(step.unit).si in FORCES]


class OpenValue(NamedTuple):
    """Hold an open value: its path, what it rests on, and why it is open."""

    path: str
    what: OpenKind
    why: str


def open_values(run: Run) -> Iterator[OpenValue]:
    """Yield the inputs that are assumed, have the value that they would have if nobody typed them, or ask for a basis and have none.

    A default of zero has nothing below or above it that would be usual, unless the table of ranges says so.
    """
    for name, instance in run.config.instances.items():
        if instance is None or name not in run.blocks:
            continue
        unranged_keys = unranged(run.config.kinds.get(name, PRESS))
        for slot in instance.slots:
            path = input_path(name, slot.key)
            if what := _rests_on(run, instance, slot):
                yield OpenValue(path, what, unranged_keys.get(slot.name, UNPROVED) if slot.is_given else UNPROVED)
            elif why := _open_choice(run, instance, slot):
                yield OpenValue(path, "assumed", why)


def _rests_on(run: Run, instance: Instance, slot: Slot) -> OpenKind | None:
    """What an input rests on, where that is open."""
    said = instance.bases.get(slot.key)
    is_assumed = said is not None and said.basis == ASSUMED
    is_number = (
        isinstance(slot.meta, Quantity)
        and slot.meta is not POINTS
        and isinstance(slot.value, int | float | str)
        and slot.value not in slot.meta.words
    )
    if (instance.name, *slot.key) in run.config.links or not is_number:
        return "assumed" if is_assumed else None
    value, kind = instance.value(slot.key), run.config.kinds.get(instance.name, PRESS)
    usual = range_of(kind, slot.name)
    if not slot.is_given or is_default(run.blocks[instance.name], slot.key):
        return "default" if value or usual or zero_is_open(kind, slot.name) else None
    is_unranged, is_limit = slot.name in unranged(kind), str(slot.key[-1]).startswith(LIMIT)
    beyond = usual is not None and is_limit and not usual.of and not usual.usual[0] <= value <= usual.usual[1]
    unsaid = is_unranged and is_limit and not names_something(said.note if said else "")
    asks = beyond or asks_basis(kind, slot.name)
    founded = run.bases.is_founded((instance.name, *slot.key)) and not (beyond or unsaid)
    return "assumed" if is_assumed or (asks and not founded) else None


def _open_choice(run: Run, instance: Instance, slot: Slot) -> str:
    """Why a text of an input is open; nothing where it is not, or is made of the parts of the machine."""
    parts = run.config.parts
    if not isinstance(slot.meta, Text | Quantity) or (parts is not None and instance.name in parts.calculations):
        return ""
    why = open_choices(run.config.kinds.get(instance.name, PRESS)).get((slot.name, str(slot.value)), "")
    return "" if run.bases.is_founded((instance.name, *slot.key)) else why
