"""What failing checks advise, held against the whole machine: what it would contradict is left out, and each key named where it is typed."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import islice
from typing import Any

import numpy as np

from diecut_report.config.instances import Instance, Node
from diecut_report.config.loader import Config
from diecut_report.config.model import PRESS
from diecut_report.config.parts.expansion import refused
from diecut_report.config.parts.model import SAME_PLACE, MachineParts, ShaftPart
from diecut_report.config.references import upstream
from diecut_report.config.yaml import KeyPath, Scalar, dotted, key_of, resolved
from diecut_report.machine.calculation import Calculation
from diecut_report.machine.mechanism import intervals, phases_of
from diecut_report.machine.steps.run import recalculated
from diecut_report.mechanism.inputs import Block, Quantity, flatten
from diecut_report.mechanism.mechanism import Mechanism
from diecut_report.quantities.formatting import outward
from diecut_report.quantities.units import unit
from diecut_report.results.advice import AdvisedCheck, Way, printed
from diecut_report.results.checks import checks_of, verdicts
from diecut_report.results.coherence import DRIVE_LINE, Machine, disagreements
from diecut_report.results.mechanism_record import CheckRecord, KeyChangeRecord
from diecut_report.results.press_run import Run, Tell, same_inputs
from diecut_report.results.record import Value
from diecut_report.results.trials import parts_of
from diecut_report.results.usual import outside
from diecut_report.standards import bearing_series, catalogue_size, stronger_bearings
from diecut_report.text.phrases import Counted, Phrase, joined, named, phrase

OF_BEARING = ("limiting_speed", "rolling_elements")  # what may be typed of one beside its designation
LARGER = 4  # bearings of a series that are tried with their seats
ROUNDED = 1e-6  # mm by which a whole one may be exceeded
FURTHER, DIGITS = (0.1, 0.3, 1.0), 4  # shares of a change by which more is tried, and how many digits it has
CALCULATED = phrase("{key} is {origin}, which is calculated; change what it follows from.")
FOUNDED = "Say what {key} rests on, by its basis; without it the check is not made."
Typed = dict[Node, tuple[Value, str]]  # values by the inputs that are typed, with their unit


def advised(
    run: Run, checks: Mapping[str, list[CheckRecord]], tell: Tell = lambda _: None
) -> dict[str, list[CheckRecord]]:
    """Return the checks of all mechanisms, of which the failing ones advise what the machine allows, where it is typed.

    ``tell`` is called with the name of the mechanism before each value that is tried; what it raises ends the search.
    """
    machine = _WholeMachine(run, tell)
    return {name: [machine.advised(name, check) for check in own] for name, own in checks.items()}


@dataclass(frozen=True, eq=False)
class _WholeMachine:
    """A calculated machine in which the advice of its checks is tried."""

    run: Run
    tell: Tell

    def advised(self, name: str, check: CheckRecord) -> CheckRecord:
        """Return a check with what can be followed of its advice."""
        calc = self.run.calculations.get(name)
        known: AdvisedCheck | None = calc.advised.get(check.id) if calc else None
        if calc is None or known is None:
            return check
        ways = self._holding(name, check.id, known.ways)
        if not ways and (kept := self._not_alone(name, known.ways)):
            ways = self._holding(name, check.id, known.again(kept))
        if not ways and known.ways:
            ways = list(filter(None, (self._with_bearings(name, check.id, way) for way in known.ways)))
        elif not ways:
            ways = list(filter(None, [self._larger_bearing(name, check.id)]))
        made = check.with_(**AdvisedCheck(known.finding, ways).fields) if ways != known.ways else check
        changes = [change for way in ways for change in way.changes]
        founded = next(each.founded for each in checks_of(calc) if each.id == check.id)
        own = (each.key for each in changes if not each.mechanism and dotted(key_of(each.key)) in founded)
        words = dict.fromkeys(self._origins(name, changes)) | dict.fromkeys(Phrase(FOUNDED, key=key) for key in own)
        words |= dict.fromkeys(self._of_bearings(name, changes))
        return made.with_(message=joined([made.message, *words], " ")) if words else made

    def _origins(self, name: str, changes: Iterable[KeyChangeRecord]) -> Iterator[Phrase]:
        """Yield where keys that are changed take their values from, those of one place together."""
        found: dict[tuple[str, bool], dict[str, None]] = {}
        for change in changes:
            found.setdefault(self._origin(_node(name, change)), {})[change.told] = None
        for (origin, is_result), keys in found.items():
            if origin and is_result:
                yield from (Phrase(CALCULATED, key=key, origin=origin) for key in keys)
            elif origin:
                one = "{keys} follows from {origin}; change it there, so that everything that depends on it stays consistent."
                many = "{keys} follow from {origin}; change them there, so that everything that depends on them stays consistent."
                yield Counted(len(keys), one, many, keys=named(list(keys), ", "), origin=origin)

    def _of_bearings(self, name: str, changes: Iterable[KeyChangeRecord]) -> Iterator[Phrase]:
        """Yield what is typed for bearings that are replaced, and belongs to the former ones."""
        sources = self.run.config.parts.sources if self.run.config.parts else {}
        for change in changes:
            *bearing, key = _node(name, change)
            keys = [each for each in OF_BEARING if key == "designation" and sources.get((*bearing, each))]
            if keys:
                template = "Give {keys} of {designation}, too: what is typed there is of the former bearing."
                yield Phrase(template, keys=named(keys, " and "), designation=str(change.value))

    def _holding(self, name: str, check: str, ways: Iterable[Way]) -> list[Way]:
        """The ways as far as the machine allows them, with which the check holds when all that is made of the parts follows."""
        return list(filter(None, (self._fitting(name, check, way) or self._further(name, check, way) for way in ways)))

    def _further(self, name: str, check: str, way: Way) -> Way | None:
        """A way of a single number that goes further, as all that follows from it makes the check harder to hold; None where none is found."""
        change, present = way.changes[0], self._present(name, way.changes[0])
        values = change.value if isinstance(change.value, list) else [change.value]
        numbers = [each for each in values if isinstance(each, float | int)]
        if len(way.changes) > 1 or present is None or not numbers:
            return None
        nearest = min(numbers, key=lambda each: abs(each - present))
        relation = "equal" if isinstance(change.value, list) else change.relation
        for share in FURTHER:
            value = outward(nearest + share * (nearest - present), nearest > present, DIGITS)
            tried = change.with_(relation=relation, value=value)
            if self._suits(name, check, [tried]):
                return replace(way, changes=[tried])
        return None

    def _with_bearings(self, name: str, check: str, way: Way) -> Way | None:
        """A way in which sections of a shaft grow, each bearing on them being a larger one of its series; None where none holds.

        What else grows does so to whole millimetres: as far as it is advised, or in the proportion of the seats.
        """
        parts = self.run.config.parts
        shaft = next((each for each in parts.shafts.values() if each.calculation == name), None) if parts else None
        if not parts or not shaft or any(not isinstance(change.value, int | float) for change in way.changes):
            return None
        wanted = {change.key: unit(change.unit).to_si(float(change.value)) for change in way.changes}  # type: ignore[arg-type]
        seats = {
            part: key
            for part in shaft.bearings
            if part.section and (key := f"sections.{part.section.index}.diameter") in wanted
        }
        larger = {part: next(_of_bore(part, wanted[key]), "") for part, key in seats.items()}
        if not larger or not all(larger.values()):
            return None
        bores = {seats[part]: catalogue_size(text, "d") or 0.0 for part, text in larger.items()}
        with_them = [change for part, text in larger.items() for change in _another_bearing(parts, name, part, text)]
        for share in (1.0, max(bores[key] / wanted[key] for key in bores)):
            grown = {key: bores.get(key) or _whole(key, share * size) for key, size in wanted.items()}
            changes = [
                change.with_(relation="equal", value=_shown(grown[change.key], change.unit)) for change in way.changes
            ]
            if self._suits(name, check, [*changes, *with_them], is_sound=True):
                return replace(way, changes=[*changes, *with_them])
        return None

    def _larger_bearing(self, name: str, check: str) -> Way | None:
        """A bearing with which the check of one of them holds: the weakest of the same bore, or the next of its series with its seat."""
        parts = self.run.config.parts
        index = next(each.index for each in checks_of(self.run.calculations[name]) if each.id == check)
        place = parts.sources.get((name, "bearings", index, "designation")) if parts and index is not None else None
        if not parts or not place:
            return None
        part = next((each for shaft in parts.shafts.values() for each in shaft.parts if each.path == place[:-1]), None)
        for tried in _stronger(parts, name, part) if part else _in_place(parts, name, place):
            strongest = next((each for each in reversed(tried) if self._allows(name, each)), None)
            # what the strongest one does not mend, such as a speed or a swing, none beside it does
            if strongest is not None and self._suits(name, check, strongest):
                sound = (each for each in tried if self._suits(name, check, each, is_sound=True))
                if (changes := next(sound, None)) is not None:
                    return Way(changes, 0)
        return None

    def _present(self, name: str, change: KeyChangeRecord) -> float | None:
        """The value that a key has today, in the unit of its change."""
        path = key_of(change.key)
        values = parts_of(self.run.calculations[name].inputs.get(dotted(path)))
        index = next((part for part in path if isinstance(part, int)), 0)
        known = values[index] if index < len(values) else None
        return None if known is None else unit(change.unit).from_si(float(known))

    def _holds(self, name: str, check: str, made: Typed, *, is_sound: bool = False) -> bool:
        """Whether a check holds in the machine with these values at its parts; ``is_sound``: and no other of its mechanism fails by them."""
        config, problems = self.run.config.retyped(self._by_place(made))
        if problems:
            return False
        changed = _ChangedRun(self.run, config, name)
        calc = changed.calculations.get(name)
        if calc is None or changed.problems:
            return False
        found = {each.id: each.status for each in verdicts(calc)}
        return found.get(check) not in ("fail", "warn") and not (is_sound and self._worse(name, found))

    def _worse(self, name: str, found: Mapping[str, str]) -> bool:
        """Whether a check of a mechanism fails that does not fail today."""
        failing = {each.id for each in verdicts(self.run.calculations[name]) if each.status == "fail"}
        return any(status == "fail" and each not in failing for each, status in found.items())

    def _not_alone(self, name: str, ways: Iterable[Way]) -> frozenset[str]:
        """Which numbers that several ways change together the machine does not allow by themselves, such as the seat of a bearing."""
        changes = [change for way in ways if len(way.changes) > 1 for change in way.changes]
        alone = {each.key: self._allows(name, [each]) for each in changes if not isinstance(each.value, list)}
        refused = (key for key, is_allowed in alone.items() if not is_allowed)
        return frozenset(refused) if any(alone.values()) else frozenset()

    def _fitting(self, name: str, check: str, way: Way) -> Way | None:
        """A way as far as the machine allows it: of several values of one change those that it does; None where it allows none."""
        single = [list(_single(change)) for change in way.changes]
        if len(single) > 1 or len(single[0]) == 1:
            return way if self._suits(name, check, [first for first, *_ in single]) else None
        values = [each.value for each in single[0] if self._suits(name, check, [each])]
        if not values:
            return None
        [change] = way.changes
        fitting = {"value": values} if len(values) > 1 else {"relation": "equal", "value": values[0]}
        return replace(way, changes=[change.with_(**fitting)])

    def _suits(self, name: str, check: str, changes: Sequence[KeyChangeRecord], *, is_sound: bool = False) -> bool:
        """Whether the parts of the machine agree with changes to one value each, and a check holds with them.

        ``is_sound``: and no other check of its mechanism fails by them.
        """
        self.tell(name)
        if not self._allows(name, changes):
            return False
        # over what calculates a key, too, its value may be typed
        over = {node: typed for node, typed in _given(name, changes).items() if self._beginning(node) is None}
        typed = self._typed(name, changes)
        made = self._made_anew(typed) | self._felt(name, typed | over)
        return not made or self._holds(name, check, made, is_sound=is_sound)

    def _allows(self, name: str, changes: Iterable[KeyChangeRecord]) -> bool:
        """Whether the parts of the machine agree with changes of a mechanism's keys; of a key that is calculated nothing is known."""
        typed, parts = self._typed(name, changes), self.run.config.parts
        made = self._made_anew(typed)
        if parts and made and self._contradicts(parts, made):
            return False
        return not self._disagrees({node: given for node, given in typed.items() if node not in made})

    def _typed(self, name: str, changes: Iterable[KeyChangeRecord]) -> Typed:
        """The values of changes by where they are typed."""
        begun = {self._beginning(node): given for node, given in _given(name, changes).items()}
        return {node: given for node, given in begun.items() if node is not None}

    def _made_anew(self, typed: Typed) -> Typed:
        """Those that stand at the parts, with which all that is made of them is made anew."""
        parts = self.run.config.parts
        return {node: given for node, given in typed.items() if parts and parts.follows(node)}

    def _felt(self, name: str, typed: Typed) -> Typed:
        """Those that a mechanism feels by another way, too: what it, or a mechanism that it follows from, refers to them for."""
        links = self.run.config.links
        within = upstream(links, [name])
        sources = {each.node for (home, *_), target in links.items() if home in within for each in target.single}
        return {node: given for node, given in typed.items() if node in sources}

    def _contradicts(self, parts: MachineParts, made: Typed) -> bool:
        """Whether parts do not fit each other with these values, or one of them is nowhere in the file."""
        if None in map(parts.typed_at, made):
            return True
        instances = (each for each in self.run.config.instances.values() if each and each.mechanism)
        kinds = {each.mechanism.kind: each.mechanism for each in instances if each.mechanism}
        return refused(parts, self._by_place(made), kinds)

    def _by_place(self, made: Typed) -> dict[KeyPath, Scalar]:
        """What stands in the places of the file with these values; a text, such as the bearing 6306, is no number."""
        places = {node: self._place(node) for node in made}
        values = {
            node: value if isinstance(value, str) else resolved(printed(value, own))
            for node, (value, own) in made.items()
        }
        return {path: values[node] for node, path in places.items() if path is not None}

    def _place(self, node: Node) -> KeyPath | None:
        """Where an input is typed, at the parts or in its own block; None where that is in a table, or several."""
        parts, instance = self.run.config.parts, self.run.config.instances.get(str(node[0]))
        if parts and parts.follows(node):
            return parts.typed_at(node)
        tree, place = instance.place.stands(node[1:]) if instance else (None, None)
        return place if tree is self.run.config.tree else None

    def _disagrees(self, typed: Typed) -> bool:
        """Whether mechanisms contradict each other that take these values, each calculated with them alone, or one has what none has."""
        machine, changed = self._machine, dict[str, dict[str, Any]]()
        for begin, (value, _) in typed.items():
            for node in (begin, *self._followers.get(begin, ())):
                if (name := str(node[0])) in machine.parts:
                    _put(changed.setdefault(name, {}), machine.parts[name].calc, node[1:], value)
        for name, inputs in changed.items():
            own = machine.parts[name]
            calc, taken = recalculated(own.calc, inputs, 1), {**own.inputs, **inputs}
            beside = self.run.beside(own.instance)
            if calc is None or any(each.slips.any() for each in outside(own.instance, taken, beside, calc.values)):
                return True
            if any(intervals(own.calc, phase) and not intervals(calc, phase) for phase in phases_of(own.calc)):
                return True  # which the timing may name
            machine = machine.with_part(replace(own, inputs=taken, calc=calc))
        return bool(changed) and any(True for _ in disagreements(machine))

    @cached_property
    def _machine(self) -> Machine:
        run = self.run
        return Machine(run.config.instances, run.blocks, run.calculations, run.config.links)

    @cached_property
    def _followers(self) -> dict[Node, list[Node]]:
        """The inputs that take a typed value by reference, by where it is typed."""
        found: dict[Node, list[Node]] = {}
        for node in self.run.config.links:
            if (begin := self._beginning(node)) is not None:
                found.setdefault(begin, []).append(node)
        return found

    def _beginning(self, node: Node) -> Node | None:
        """The input whose typed value an input has; None where that is calculated."""
        while (target := self.run.config.links.get(node)) is not None:
            if target.expression or target.result is not None or target.formula:
                return None
            node = target.node
        return node

    def _origin(self, node: Node) -> tuple[str, bool]:
        """Where the value of an input that is not typed itself begins, and whether that is a result: else a field of the press, or a key.

        Nothing of others.
        """
        links, parts, origin = self.run.config.links, self.run.config.parts, ""
        while (target := links.get(node)) is not None and not target.expression:
            origin, node = target.path, target.node
            if target.result is not None:
                return origin, True
        place = parts.typed_at(node) if parts and parts.follows(node) else None
        if not parts or not place:
            return origin, False
        ends = (end for end in range(1, len(place)) if parts.reader.tree.typed(place[:end]) is not None)
        told = place[: next(ends, len(place))]  # a text may hold the number
        return ".".join(map(str, told)).removesuffix(".value"), False


class _ChangedRun(Run):
    """A machine with other values at its parts, as far as one mechanism follows from it: what is as it was is not calculated again."""

    def __init__(self, before: Run, config: Config, name: str) -> None:
        self.before, self.wanted = before, {PRESS, *upstream(config.links, [name])}
        super().__init__(config, lambda _: None)

    def _mechanism(self, name: str) -> None:
        if name in self.wanted:
            super()._mechanism(name)

    def _made(self, instance: Instance, mechanism: Mechanism, block: Block) -> Calculation:
        known = self.before.calculations.get(instance.name)
        is_known = (
            known is not None and mechanism.kind != DRIVE_LINE
        )  # which is judged by what is found of the parts, too
        if known is None or not is_known or not same_inputs(flatten(self.before.blocks[instance.name]), flatten(block)):
            return super()._made(instance, mechanism, block)
        return known

    def _agree(self) -> None:
        """What the parts are refused for is known before."""


def _of_bore(part: ShaftPart, bore: float) -> Iterator[str]:
    """Yield the bearings of the series of one whose bore is not below that, m, the smallest first."""
    return (name for name, own in bearing_series(part.keys.designation or "").items() if own >= bore - SAME_PLACE)


def _stronger(parts: MachineParts, name: str, part: ShaftPart) -> Iterator[list[list[KeyChangeRecord]]]:
    """Yield the changes to stronger bearings on a shaft, the weakest first: to those of the same bore; to larger ones, each with its seat."""
    same = stronger_bearings(part.keys.designation or "")
    yield [_another_bearing(parts, name, part, text) for text in same]
    if part.section:
        place = (*part.shaft.path, "sections", part.section.index, "diameter")
        yield [
            [*_another_bearing(parts, name, part, text), _typed_there(parts, name, place, _bore_of(text), "mm")]
            for text in islice(_of_bore(part, part.seat + 2 * SAME_PLACE), LARGER)
        ]


def _in_place(parts: MachineParts, name: str, place: KeyPath) -> Iterator[list[list[KeyChangeRecord]]]:
    """Yield the changes to stronger bearings of the same bore at a place of the file, as on a pin, the weakest first."""
    same = stronger_bearings(str(parts.reader.tree.typed(place) or ""))
    yield [[_typed_there(parts, name, place, text)] for text in same]


def _bore_of(designation: str) -> float:
    """The bore of a bearing of the catalogue, mm."""
    return _shown(catalogue_size(designation, "d") or 0.0, "mm")


def _another_bearing(parts: MachineParts, name: str, part: ShaftPart, designation: str) -> list[KeyChangeRecord]:
    """The changes by which a bearing on a shaft is another one, with its ring at the shoulder that it rests on."""
    wider, [*sides] = (catalogue_size(designation, "B") or 0.0) - (part.size("B") or 0.0), part.shoulders
    changes = [_typed_there(parts, name, (*part.path, "designation"), designation)]
    if wider and len(sides) == 1:
        at = part.keys.at + (wider / 2 if sides == ["left"] else -wider / 2)
        changes.append(_typed_there(parts, name, (*part.path, "at"), _shown(at, "mm"), "mm"))
    return changes


def _typed_there(parts: MachineParts, name: str, place: KeyPath, value: Value, own: str = "1") -> KeyChangeRecord:
    """The change of what is typed at a place of the parts, which stands in the advice of a mechanism."""
    home, *key = min(
        (node for node, typed in parts.sources.items() if typed == place), key=lambda node: node[1:] != place[2:]
    )
    return KeyChangeRecord(
        key=".".join(map(str, key)),
        mechanism="" if home == name else str(home),
        relation="equal",
        value=value,
        unit=own,
    )


def _whole(key: str, size: float) -> float:
    """A diameter in whole millimetres, not below a size; another number as it is."""
    return math.ceil(1000 * size - ROUNDED) / 1000 if key.endswith(".diameter") else size


def _shown(value: float, own: str) -> float:
    return float(f"{unit(own).from_si(value):.12g}")


def _single(change: KeyChangeRecord) -> Iterator[KeyChangeRecord]:
    """Yield a change to each of its values."""
    for value in change.value if isinstance(change.value, list) else [change.value]:
        yield change.with_(value=value)


def _given(name: str, changes: Iterable[KeyChangeRecord]) -> Typed:
    """The values of changes to one value each, by the inputs that they change."""
    return {_node(name, each): (each.value, each.unit) for each in changes if not isinstance(each.value, list)}


def _node(name: str, change: KeyChangeRecord) -> Node:
    """The input that an advice of a mechanism changes."""
    return (change.mechanism or name, *key_of(change.key))


def _put(inputs: dict[str, Any], calc: Calculation, key: KeyPath, value: Value) -> None:
    """Put a value, as it is told of an input, into the inputs with which a mechanism is calculated."""
    name = dotted(key)
    meta = calc.meta.get(name)
    given: Any = np.array([meta.parsed_unit.to_si(float(value))]) if isinstance(meta, Quantity) else value
    index = next((part for part in key if isinstance(part, int)), None)
    if index is not None:
        row = inputs.get(name, calc.inputs[name])
        parts = list(row[0] if isinstance(row, np.ndarray) else row)
        given = (*parts[:index], given, *parts[index + 1 :])
    inputs[name] = given
