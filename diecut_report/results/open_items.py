"""What is left open of a machine though no check fails: values without a basis, parts that nothing rates, checks that warn or are not made."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from diecut_report.config.instances import Instance, Node, Slot
from diecut_report.config.model import PRESS
from diecut_report.config.parts.model import MachineParts
from diecut_report.config.references import WHOLE
from diecut_report.config.source_hashes import plugin_code
from diecut_report.config.validation import ASSUMED, is_founded, keys_of, names_something
from diecut_report.config.yaml import KeyPath
from diecut_report.formulas import Array
from diecut_report.mechanism.inputs import Quantity, Samples, Varying, flatten
from diecut_report.mechanism.names import SI
from diecut_report.mechanism.steps import Reduction
from diecut_report.quantities.units import unit
from diecut_report.results.conclusion import LEFT, judged, summary, unsettled
from diecut_report.results.drive_line import accepted, counted, unrated
from diecut_report.results.mechanism_record import CheckRecord
from diecut_report.results.model import OpenRecord, SummaryRecord
from diecut_report.results.origins import as_founded, assumed, at_default, input_path, is_default, value_in
from diecut_report.results.press_run import Run
from diecut_report.results.record import OpenKind
from diecut_report.results.usual import unbounded
from diecut_report.standards import catalogue_type
from diecut_report.standards.ranges import asks_basis, by_reference, open_choices, range_of, unranged, zero_is_open
from diecut_report.text.phrases import Phrase, phrase

FORCES = ("N", "N*m")  # SI units of what a part carries
LIMIT = "allowable_"  # of a key: beyond its usual range nothing founds it
CURVE = "_curve"  # of the input beside a number that takes its course over a cycle
ONE_OF_CURVE = phrase(
    "it is one number of a curve: how the load changes over a cycle, and how often it changes its side, is left out"
)
UNBOUNDED = phrase("nothing tells what it is held against, and nothing says where it comes from")
UNPROVED = phrase("it is not proved that no check depends on it")
"""Why a value is open as long as nobody has calculated the machine with others."""


def run_summary(run: Run, checks: Mapping[str, Sequence[CheckRecord]]) -> SummaryRecord:
    """Return the verdict on a run as numbers; an assumed value is open as long as it is not proved harmless."""
    found = summary(checks, assumed(run.config)).with_(open=open_items(run, checks))
    if run.config.parts is not None:
        given = run.config.parts, run.config.named("drive_train"), checks
        found = found.with_(parts=counted(*given), accepted=[*accepted(*given)])
    lost = {*run.errors, *run.skipped} & {*run.config.kinds, *(case.name for case in run.cases)}
    total = len(run.config.kinds) + len(run.cases)
    return judged(found, total, len(lost), are_compared=bool(run.cases))


def open_items(run: Run, checks: Mapping[str, Sequence[CheckRecord]]) -> list[OpenRecord]:
    """Return all that is open of a run, in the order of ``LEFT``."""
    owner = _owner(run)
    found = unsettled(checks, doubtful(run), owner)
    if run.config.parts is not None:
        found += unrated(run.config.parts, run.config.named("drive_train"), checks, owner)
    found += [*unrated_forces(run), *open_values(run)]
    order = list(LEFT)
    return sorted(found, key=lambda each: order.index(each.what))


def doubtful(run: Run) -> list[str]:
    """Return the mechanisms of a run whose plugin has faults in its formulas."""
    mechanisms = {name: calc.mechanism for name, calc in run.calculations.items()}
    mechanisms |= {case.name: case.comparison.mechanism for case in run.cases}
    return [name for name, own in mechanisms.items() if plugin_code(own).get("plugin_check") == "failed"]


def _owner(run: Run) -> str:
    return run.config.project.prepared_by or ""


def unrated_forces(run: Run) -> Iterator[OpenRecord]:
    """Yield of each mechanism the curves of force and torque that nothing takes, and of each load the component that it leaves out.

    A mechanism that takes a force, a torque or all of another one is a part which rates it, or hands on what it declares as its reactions.
    A mechanism that is calculated alone belongs to no drive line. In a machine of parts they are the ports for which no part stands.
    """
    found = _untaken_forces(run) if run.config.parts is None else _ports_without_part(run, run.config.parts)
    for path, why in (*found, *_without_line(run)):
        yield OpenRecord(what="not_rated", path=path, owner=_owner(run), why=why)


def _untaken_forces(run: Run) -> Iterator[tuple[str, Phrase]]:
    links = run.config.links.items()
    taken = {(each.instance, each.result) for _, target in links for each in target.single}
    forces = {
        name: [force for force, step in calc.curves.items() if step.output and unit(step.unit).si in FORCES]
        for name, calc in run.calculations.items()
    }
    given = {(name, force) for name, own in forces.items() for force in own}
    parts = {
        node[0]
        for node, target in links
        if any(each.is_mechanism or (each.instance, each.result) in given for each in target.single)
    }
    for name, own in forces.items() if len(forces) > 1 else ():
        reactions = run.calculations[name].mechanism.reactions
        # without any declared, components of one force are among them
        asked = reactions if reactions or name in parts else own
        if free := [force for force in own if force in asked and (name, force) not in taken]:
            yield f"mechanisms.{name}", Phrase("no part takes {ports}", ports=", ".join(free))
        elif run.calculations[name].mechanism.ports:
            yield (
                f"mechanisms.{name}",
                phrase("nothing says of which parts its forces pass: shafts and meshes describe them"),
            )
    yield from _taken_in_part(run)
    yield from _unlocated(run)


DRIVEN = (
    "cylinder_drive",
    "cam_gear_transport",
    "geneva_transport",
    "platen_press",
    "circular_knife",
)  # by the main shaft


def _without_line(run: Run) -> Iterator[tuple[str, Phrase]]:
    """The mechanisms that a main shaft may drive, and that are no line of the cyclogram: what sums the torques does not know of them."""
    timings = [name for name, kind in run.config.kinds.items() if kind == "cyclogram" and name in run.calculations]
    links = run.config.links.items()
    lines = {target.instance for (home, *_), target in links if home in timings and target.is_mechanism}
    for name, kind in run.config.kinds.items() if timings else ():
        if kind in DRIVEN and name in run.calculations and name not in lines:
            template = "it is not a line of {timing}, so that motor and flywheel are calculated without its torque"
            yield f"mechanisms.{name}", Phrase(template, timing=timings[0])


WITHOUT_RIBS = re.compile(r"\s*NU?\s*\d", re.IGNORECASE)  # N 212, NU1009: on one ring alone


def _unlocated(run: Run) -> Iterator[tuple[str, Phrase]]:
    """The shafts whose bearings are all calculated as cylindrical roller bearings without ribs."""
    found: dict[str, list[bool]] = {}
    for name in (name for name, kind in run.config.kinds.items() if kind == "rolling_bearing"):
        inputs = run.calculations[name].inputs if name in run.calculations else {}
        rows = zip(
            *(inputs.get(key, ()) for key in ("bearings.series", "bearings.designation") if key in inputs), strict=True
        )
        for index, texts in enumerate(rows):
            target = run.config.links.get((name, "bearings", index, "radial_force"))
            if target is not None and target.result in ("reaction_a", "reaction_b"):
                known = [
                    text for text in map(str, texts) if WITHOUT_RIBS.match(text) or catalogue_type(text) == "roller"
                ]
                found.setdefault(target.instance, []).append(bool(known))
    for shaft, floating in found.items():
        if len(floating) > 1 and all(floating):
            yield (
                f"mechanisms.{shaft}",
                phrase(
                    "all of its bearings are cylindrical roller bearings N or NU, which do not hold it along its axis"
                ),
            )


def _ports_without_part(run: Run, parts: MachineParts) -> Iterator[tuple[str, Phrase]]:
    known = {part.port for shaft in parts.shafts.values() for part in shaft.parts}
    for name, calc in run.calculations.items():
        left = [port.name for port in calc.mechanism.ports if (name, port.name) not in known]
        if left:
            yield f"mechanisms.{name}", Phrase("no part stands for {ports}", ports=", ".join(left))


def _taken_in_part(run: Run) -> Iterator[tuple[str, Phrase]]:
    """The loads that take one component of a force, and not the other."""
    taken: dict[tuple[Node, str], set[str]] = {}
    for node, target in run.config.links.items():
        for each in target.single:
            taken.setdefault((node[:-1], each.instance), set()).add(str(each.result))
    for (node, name), results in taken.items():
        ports = run.calculations[name].mechanism.ports if name in run.calculations else ()
        for forces in {port.forces for port in ports if results.intersection(port.forces)}:
            if left := [force for force in forces if force not in results]:
                path = input_path(str(node[0]), node[1:])
                yield path, Phrase("takes no {ports} of {name}", ports=", ".join(left), name=name)


def open_values(run: Run) -> Iterator[OpenRecord]:
    """Yield the inputs that are assumed, have the value that they would have if nobody typed them, or ask for a basis and have none.

    A default of zero has nothing below or above it that would be usual, unless the table of ranges says so.
    """
    for name, instance in run.config.instances.items():
        if instance is None or name not in run.blocks:
            continue
        unranged_keys = unranged(run.config.kinds.get(name, PRESS), _is_alone(run, name))
        unbounded_keys = _unbounded(run, instance)
        for slot in (each for each in instance.slots if _is_there(run, instance, each) and not _is_varied(each)):
            is_bounded = slot.key not in unbounded_keys
            what = _rests_on(run, instance, slot, _standing(run, instance, slot), is_bounded=is_bounded)
            if what is None:
                what, why = "assumed", _open_choice(run, instance, slot) or _one_of_curve(run, instance, slot)
            elif not slot.is_given:
                why = UNPROVED
            else:
                why = unranged_keys.get(slot.name, UNPROVED) if is_bounded else UNBOUNDED
            if why:
                yield OpenRecord(what=what, path=input_path(name, slot.key), owner=_owner(run), why=why)


def varied_open(run: Run, count: int) -> Array:
    """Return in which of so many machines an input that is not the same in all of them is open, shape (count,)."""
    found = np.zeros(count, dtype=bool)
    for name, instance in run.config.instances.items():
        varied = (
            [slot for slot in instance.slots if _is_varied(slot)] if instance is not None and name in run.blocks else []
        )
        if instance is None or not varied:
            continue
        unbounded_keys = _unbounded(run, instance)
        for slot in varied:
            values, row = np.unique(np.asarray(slot.value.value, dtype=float), return_inverse=True)
            typed = np.broadcast_to(at_default(run.blocks[name], slot.key), (count,))
            standing = (_Standing(float(value), bool(typed[row == index][0])) for index, value in enumerate(values))
            is_bounded = slot.key not in unbounded_keys
            is_open = [_rests_on(run, instance, slot, each, is_bounded=is_bounded) is not None for each in standing]
            found |= np.array(is_open)[row] & (typed | ~np.asarray(as_founded(instance, run.blocks[name], slot.key)))
    return found


def _unbounded(run: Run, instance: Instance) -> set[KeyPath]:
    """The keys of a mechanism whose usual range bounds nothing here."""
    calc = run.calculations.get(instance.name)
    return unbounded(instance, flatten(run.blocks[instance.name]), run.beside(instance), calc.values) if calc else set()


def _is_there(run: Run, instance: Instance, slot: Slot) -> bool:
    """Whether an input has a value; of what is left out nothing can be open."""
    return slot.value is not None or (instance.name, *slot.key) in run.config.links


def _is_varied(slot: Slot) -> bool:
    """Whether an input is not the same in all of several machines."""
    return isinstance(slot.value, SI) and np.ndim(slot.value.value) > 0


class _Standing(NamedTuple):
    """Hold the value of an input, SI, and whether it would have it if nobody typed it."""

    value: Any
    is_default: bool


def _standing(run: Run, instance: Instance, slot: Slot) -> _Standing | None:
    """A typed number as it stands in all machines; None of what refers to others or is no number, and of one that is not the same in all."""
    is_number = (
        isinstance(slot.meta, Quantity)
        and not isinstance(slot.meta, Samples)
        and (instance.name, *slot.key) not in run.config.links
    )
    if not is_number or not isinstance(slot.value, int | float | str) or slot.value in slot.meta.words:  # type: ignore[union-attr]
        return None
    block = run.blocks[instance.name]
    return _Standing(value_in(block, slot.key), not slot.is_given or is_default(block, slot.key))


def _rests_on(
    run: Run, instance: Instance, slot: Slot, standing: _Standing | None, *, is_bounded: bool
) -> OpenKind | None:
    """What an input rests on, where that is open; what no row bounds asks for a basis."""
    said = instance.bases.get(slot.key)
    is_assumed = said is not None and said.basis == ASSUMED
    kind, target = run.config.kinds.get(instance.name, PRESS), run.config.links.get((instance.name, *slot.key))
    is_alone = _is_alone(run, instance.name)
    asks = not is_bounded or asks_basis(kind, slot.name, is_alone)
    if asks and is_formula(run.config.parts, instance, slot):
        return None if is_founded(said.basis if said else "", said.note if said else "") else "assumed"
    if target is not None or standing is None:
        return "assumed" if is_assumed else None
    value = standing.value
    usual = range_of(kind, slot.name)
    if not slot.is_given or standing.is_default:
        return "default" if value or usual or _leaves_out(run, instance, slot) else None
    is_unranged, is_limit = slot.name in unranged(kind), str(slot.key[-1]).startswith(LIMIT)
    beyond = usual is not None and is_limit and not usual.of and not usual.usual[0] <= value <= usual.usual[1]
    unsaid = is_unranged and is_limit and not names_something(said.note if said else "")
    is_drawn_load = not is_alone and said is not None and said.basis == "drawing" and by_reference(kind, slot.name)
    founded = run.bases.is_founded((instance.name, *slot.key)) and not (beyond or unsaid or is_drawn_load)
    return "assumed" if is_assumed or ((asks or beyond) and not founded) else None


def is_formula(parts: MachineParts | None, instance: Instance, slot: Slot) -> bool:
    """Return whether a formula of others stands in the file, with what is of nobody in it: a reference alone is none, nor one that parts make."""
    tree, path = instance.place.stands(slot.key)
    path = path if tree.typed(path) else (*path, "value")
    typed = (tree.typed(path) or "").strip()
    if "${" not in typed or WHOLE.fullmatch(typed):
        return False
    return parts is None or tree.position(path) in parts.reader.formulas


def _leaves_out(run: Run, instance: Instance, slot: Slot) -> bool:
    """Whether a default of zero leaves something out that nothing beside it stands for."""
    unless = zero_is_open(run.config.kinds.get(instance.name, PRESS), slot.name)
    if unless is None or _is_of_parts(run, instance.name):
        return False
    home = slot.key[:-1]
    beside = {each.key[len(home)] for each in instance.slots if each.is_given and each.key[: len(home)] == home}
    return beside.isdisjoint(unless)


def _is_alone(run: Run, name: str) -> bool:
    """Whether the loads of a mechanism are no others' results: it has none beside it, or the parts of the machine give them."""
    return len(run.config.kinds) == 1 or _is_of_parts(run, name)


def _is_of_parts(run: Run, name: str) -> bool:
    """Whether the parts of the machine make the calculation, with all that they know."""
    return run.config.parts is not None and name in run.config.parts.calculations


def _open_choice(run: Run, instance: Instance, slot: Slot) -> str:
    """Why a text of an input is open; nothing where it is not, or is made of the parts of the machine."""
    row = open_choices(run.config.kinds.get(instance.name, PRESS)).get((slot.name, str(slot.value)))
    if row is None or (_is_of_parts(run, instance.name) and not row.typed_in_parts):
        return ""
    founded = slot.is_given and run.bases.is_founded((instance.name, *slot.key))
    return phrase(row.reason) if instance.given.issuperset(row.given) and not founded else ""


def _one_of_curve(run: Run, instance: Instance, slot: Slot) -> str:
    """Why a reference to one number of a curve is open, where the input takes the curve itself."""
    target = run.config.links.get((instance.name, *slot.key))
    if target is None or not (
        isinstance(slot.meta, Varying) or f"{slot.name}{CURVE}" in keys_of(type(run.blocks[instance.name]))
    ):
        return ""
    known = [
        (run.calculations[each.instance].steps, each.result)
        for each in target.single
        if each.instance in run.calculations
    ]
    is_one = any(isinstance(steps.get(str(result)), Reduction) for steps, result in known)
    return ONE_OF_CURVE if is_one else ""
