"""What is left open of a machine though no check fails: values without a basis, parts that nothing rates, checks that warn or are not made."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from diecut_report.config.instances import Instance, Slot
from diecut_report.config.model import PRESS
from diecut_report.config.source_hashes import plugin_code
from diecut_report.config.validation import ASSUMED
from diecut_report.machine.calculation import Calculation
from diecut_report.mechanism.inputs import POINTS, Quantity
from diecut_report.quantities.units import unit
from diecut_report.results.carrying_parts import counted, unrated
from diecut_report.results.conclusion import LEFT, CalculatedCount, judged, summary, unsettled
from diecut_report.results.mechanism_record import CheckRecord
from diecut_report.results.model import OpenRecord, SummaryRecord
from diecut_report.results.origins import assumed, input_path, is_default
from diecut_report.results.press_run import Run
from diecut_report.results.record import OpenKind
from diecut_report.standards.ranges import UsualRange, range_of
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
    found += [OpenRecord(what=what, path=path, owner=owner, why=UNPROVED) for path, what in open_values(run)]
    order = list(LEFT)
    return sorted(found, key=lambda each: order.index(each.what))


def free_ports(run: Run) -> dict[str, list[str]]:
    """Return of each mechanism that makes forces the curves of force and torque that nothing takes.

    A mechanism that takes a force, a torque or all of another one is a part which rates it, or hands it on. A mechanism that is
    calculated alone belongs to no drive line.
    """
    taken = {(each.instance, each.result) for target in run.config.links.values() for each in target.single}
    forces = {name: _forces(calc) for name, calc in run.calculations.items()}
    given = {(name, force) for name, own in forces.items() for force in own}
    parts = {
        node[0]
        for node, target in run.config.links.items()
        if any(each.is_mechanism or (each.instance, each.result) in given for each in target.single)
    }
    found = {
        name: [force for force in own if (name, force) not in taken]
        for name, own in forces.items()
        if name not in parts
    }
    return {name: own for name, own in found.items() if own and len(forces) > 1}


def _forces(calc: Calculation) -> list[str]:
    return [name for name, step in calc.curves.items() if step.output and unit(step.unit).si in FORCES]


def open_values(run: Run) -> Iterator[tuple[str, OpenKind]]:
    """Yield the paths of inputs that are assumed, or have the value that they would have if nobody typed them.

    A default of zero has nothing below or above it that would be usual, unless the table of ranges says so.
    """
    for name, instance in run.config.instances.items():
        if instance is None or name not in run.blocks:
            continue
        for slot in instance.slots:
            if what := _rests_on(run, instance, slot):
                yield input_path(name, slot.key), what


def _rests_on(run: Run, instance: Instance, slot: Slot) -> OpenKind | None:
    """What an input rests on, where that is open."""
    said = instance.bases.get(slot.key)
    is_assumed = said is not None and said.basis == ASSUMED
    is_number = (
        isinstance(slot.meta, Quantity) and slot.meta is not POINTS and isinstance(slot.value, int | float | str)
    )
    if (instance.name, *slot.key) in run.config.links or not is_number:
        return "assumed" if is_assumed else None
    value = instance.value(slot.key)
    usual = range_of(run.config.kinds.get(instance.name, PRESS), slot.name)
    if not slot.is_given or is_default(run.blocks[instance.name], slot.key):
        return "default" if value or usual else None
    founded = run.bases.is_founded((instance.name, *slot.key)) and not _is_beyond(slot, value, usual)
    asks = usual is not None and (usual.needs_basis or _is_beyond(slot, value, usual))
    return "assumed" if is_assumed or (asks and not founded) else None


def _is_beyond(slot: Slot, value: float, usual: UsualRange | None) -> bool:
    """Whether an input allows more, or less, than is usual."""
    is_limit = usual is not None and not usual.of and str(slot.key[-1]).startswith(LIMIT)
    return is_limit and usual is not None and not usual.usual[0] <= value <= usual.usual[1]
