"""The mechanisms of a config (and its press): which inputs have a value, and what their results are called."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Annotated, Any

from pydantic import create_model

from diecut_report.config.own_tables import SOURCE, Entry, OwnTables
from diecut_report.config.validation import (
    BASES,
    KEYS,
    LEAST_REASON,
    MAX_NAMED,
    Basis,
    ConfigPlace,
    blocks,
    copied,
    keys_of,
    quoted,
    validate,
    value_at,
)
from diecut_report.config.yaml import KeyPath, dotted
from diecut_report.errors import Problem, latin_letters, nearest
from diecut_report.formulas.condition_parts import TypedExpression
from diecut_report.formulas.formula import Formula
from diecut_report.mechanism.chapters import Chapter
from diecut_report.mechanism.curve_inputs import CurveInput, FromTable, InOtherUnit, is_in
from diecut_report.mechanism.inputs import (
    Block,
    Meta,
    Quantity,
    Varying,
    allowed,
    fields,
    flatten,
    list_inputs,
    texts_given,
)
from diecut_report.mechanism.mechanism import Mechanism
from diecut_report.mechanism.names import SI, FromPress, Pending, Text
from diecut_report.mechanism.steps import PREFIX, ComputedCurve, PartNames, Step, part_result
from diecut_report.quantities.units import UnitError, kind_name, unit
from diecut_report.text.phrases import MessageError, Phrase, phrase

# The data of a block as it counts: an entry of the user's own tables that is named gives its keys, with what they rest on.


CATALOGUE = "catalogue"


@dataclass
class BlockData:
    """Hold the data of a block with what entries of tables give, where that stands, and what its values rest on.

    ``entries`` are those that give a key, ``naming`` the keys that may name an entry, each with the keys that it gives.
    """

    data: dict[str, Any]
    place: ConfigPlace
    tables: OwnTables
    bases: dict[KeyPath, Basis] = field(default_factory=dict)
    entries: dict[KeyPath, Entry] = field(default_factory=dict)
    naming: dict[KeyPath, tuple[KeyPath, ...]] = field(default_factory=dict)
    problems: list[Problem] = field(default_factory=list)

    @staticmethod
    def read(model: type[Block], data: Mapping[str, Any], place: ConfigPlace, tables: OwnTables) -> BlockData:
        """Return the data of a block with the keys of the entries that it names, and what all of it rests on."""
        found = BlockData(copied(dict(data)), place, tables)
        for own, block, home in reversed(list(blocks(model, found.data))):
            for rule in own.from_tables:
                found._take(own, rule, block, home)
        for own, block, home in list(blocks(model, found.data)):
            for name, (_, meta, _, _) in keys_of(own).items():
                key, given = (*home, name), block.get(name)
                if isinstance(given, dict) and (unit := _unit_of(meta, given)):
                    block[name] = found._value(unit, given, key)
                if isinstance(meta, Quantity) and name in block:
                    found._rest_on_entry(key)
        return found

    def anew(
        self, model: type[Block], data: dict[str, Any], changed: Iterable[KeyPath], place: ConfigPlace
    ) -> BlockData:
        """Return the same for other data, whose keys ``changed``: what other entries gave before is left out."""
        for key in (given for name in changed for given in self.naming.get(name, ()) if given in self.entries):
            value_at(data, key[:-1]).pop(key[-1], None)
        return BlockData.read(model, data, place, self.tables)

    @property
    def sources(self) -> dict[str, str]:
        """Return each file with the sources of what is taken from it."""
        found: dict[str, list[str]] = {}
        for entry in dict.fromkeys(self.entries.values()):
            found.setdefault(entry.file, []).append(f"{entry.name}: {entry.source}")
        return {file: "; ".join(said) for file, said in found.items()}

    def _take(self, model: type[Block], rule: FromTable, block: dict[str, Any], home: KeyPath) -> None:
        """Put the keys of the entry into the block that names it."""
        self._judge(model, rule)
        key, known = (*home, rule.key), tuple(self.tables.entries.get(rule.table, ()))
        self.naming[key] = tuple((*home, own) for own in rule.gives)
        self.place = replace(self.place, named={**self.place.named, key: known})
        given = block.get(rule.key)
        name = given if isinstance(given, str) else self.place.typed(key) if given is not None else None
        entry = self.tables.entries.get(rule.table, {}).get(name or "")
        if entry is None:
            if name is not None and not _texts(model, rule):  # of which the model judges
                self.problems.append(self.place.problem(key, _unknown_entry(rule.table, name, known)))
            return
        del block[rule.key]
        if rule.stands_for:
            block[rule.key] = rule.stands_for
        for own, theirs in rule.gives.items():
            if theirs in entry.keys and block.get(own) is None:
                block[own] = entry.keys[theirs]
                self.entries[(*home, own)] = entry
                stands = {(*home, own): (entry.tree, (*entry.path, theirs))}
                self.place = replace(self.place, elsewhere={**self.place.elsewhere, **stands})

    def _judge(self, model: type[Block], rule: FromTable) -> None:
        """Judge all entries of a table by the block that may take them, whether it does or not."""
        known = {_plain(text): text for text in _texts(model, rule)}
        for entry in self.tables.entries.get(rule.table, {}).values():
            mark = (*entry.path, entry.tree.file, model.__name__, rule.key)
            if mark not in self.tables.judged:
                self.tables.judged.add(mark)
                self.tables.problems += _faults(model, rule, entry)
                standard = known.get(_plain(entry.name), entry.name)
                if standard != entry.name:
                    template = "is nearly named as the standard {standard}, which is taken where that is named; write {standard}, or another name"
                    place = ConfigPlace(entry.tree)
                    self.tables.problems.append(place.problem(entry.path, template, at_key=True, standard=standard))

    def _rest_on_entry(self, key: KeyPath) -> None:
        """Let a quantity that comes from an entry rest on it, as far as the entry itself does not say."""
        for length in range(1, len(key) + 1):
            if entry := self.entries.get(key[:length]):
                said = self.bases.get(key, Basis())
                self.bases[key] = replace(said, basis=said.basis or CATALOGUE, note=said.note or entry.note)

    def _value(self, unit: str, given: dict[str, Any], key: KeyPath) -> Any:
        """The value of a quantity that stands as a block; the block itself where it is not one."""
        faults = list(self._faults(unit, given, key))
        self.problems += faults
        if given.get("value") is None:
            return 1.0 if faults else given  # what is wrong has been reported
        listed = {**self.place.listed, key: (*self.place.inner(key), "value")}
        self.place = replace(self.place, listed=listed)
        if not faults:
            self.bases[key] = Basis(*(given.get(name) or "" for name in ("basis", "note", "beyond")))
        return given["value"]

    def _faults(self, unit: str, given: dict[str, Any], key: KeyPath) -> Iterator[Problem]:
        if given.get("value") is None:
            template = "is a block without a value; write {value: 10 {unit}, basis: assumed}, or the value alone"
            yield self.place.problem(key, Phrase(template, unit=unit).replace("10 1,", "10,"))
        for name in given:
            if name not in KEYS:
                template = "is an unknown key{nearest}. A quantity that stands as a block has {keys}."
                near, keys = nearest(name, KEYS), ", ".join(KEYS)
                yield self.place.problem((*key, name), template, at_key=True, nearest=near, keys=keys)
        basis, note = given.get("basis"), given.get("note")
        if "basis" in given and basis not in BASES:
            near = nearest(basis, BASES) if isinstance(basis, str) else ""
            template = "is {basis}{near}; allowed: {bases}"
            yield self.place.problem((*key, "basis"), template, basis=quoted(basis), near=near, bases=", ".join(BASES))
        if note is not None and not isinstance(note, str):
            template = "is {note}; a text is needed, in quotes where it is a number"
            yield self.place.problem((*key, "note"), template, note=quoted(note))
        reason = given.get("beyond")
        if reason is not None and not (isinstance(reason, str) and len(reason.strip()) >= LEAST_REASON):
            template = (
                "is {reason}; say in at least {least} characters why the value is right though no other machine has it"
            )
            yield self.place.problem((*key, "beyond"), template, reason=quoted(reason), least=LEAST_REASON)


def _unit_of(meta: Meta | None, given: Mapping[str, Any]) -> str:
    """The unit of a value that stands as a block; nothing where the block is something else."""
    if isinstance(meta, Varying) and meta.extremes and {"min", "max"} & given.keys():
        return ""
    if isinstance(meta, Quantity | CurveInput):
        return meta.unit
    return "1" if isinstance(meta, Text) and "value" in given else ""


def _texts(model: type[Block], rule: FromTable) -> tuple[str, ...]:
    """The texts that a key may have beside the names of entries."""
    return allowed(keys_of(model)[rule.key].field.annotation, None)


def _plain(name: str) -> str:
    """A name without what is easily overlooked: blanks, capitals, and letters that only look Latin."""
    return "".join(latin_letters(name).split()).casefold()


def _unknown_entry(table: str, name: str, known: Sequence[str]) -> str:
    if not known:
        file = phrase("in a file that materials: names")
        template = "is {name}, but there is no table {table} of your own: put {table}: {{name_2}: {…}} {file}"
        return Phrase(template, name=quoted(name), table=table, name_2=name, file=file)
    template = "is {name}{nearest}; {table} has {known}"
    listed = ", ".join(known[:MAX_NAMED])
    return Phrase(template, name=quoted(name), nearest=nearest(name, known), table=table, known=listed)


def _faults(model: type[Block], rule: FromTable, entry: Entry) -> Iterator[Problem]:
    place, known = ConfigPlace(entry.tree, entry.path), list(rule.gives.values())
    for key in entry.keys:
        if key not in known:
            template = "is an unknown key{nearest}. An entry of {table} has {text}."
            near, keys = nearest(key, known), ", ".join([SOURCE, *known])
            yield place.problem((key,), template, at_key=True, nearest=near, table=rule.table, text=keys)
    for own, theirs in rule.gives.items():
        if theirs in entry.keys:
            field = keys_of(model)[own].field
            annotation: Any = Annotated[field.annotation, *field.metadata]
            form = create_model(model.__name__, __base__=Block, **{theirs: (annotation, ...)})  # type: ignore[call-overload]
            made = BlockData.read(form, {theirs: entry.keys[theirs]}, place, OwnTables())
            yield from made.problems
            yield from validate(form, made.data, made.place)[1]


# What references stand for.


Node = KeyPath  # (instance,) is its calculation, (instance, key, …) one of its inputs


@dataclass(frozen=True)
class Target:
    """What a reference stands for: an output (``result``) or an input (``key``) of an instance.

    An expression stands for what is calculated from its ``terms``, the targets of its references; ``path`` is its text.
    """

    path: str
    instance: str
    key: KeyPath = ()
    result: str | None = None
    unit: str | None = None
    is_curve: bool = False
    is_default: bool = False  # not written by the user: the press's field that stands in for an absent input
    formula: Formula | None = None
    is_broken: bool = False  # the plugin of what it refers to cannot be loaded
    expression: TypedExpression | None = None
    terms: tuple[Target, ...] = ()
    phase_unit: str | None = None  # of a phase: the SI unit of what it runs over
    is_mechanism: bool = False  # it stands for the mechanism as a whole

    @property
    def node(self) -> Node:
        """What must be known before what a single reference stands for."""
        return (self.instance,) if self.result is not None or self.is_broken else (self.instance, *self.key)

    @property
    def single(self) -> tuple[Target, ...]:
        """The single references: those of an expression, or itself."""
        return self.terms if self.expression else (self,)

    @property
    def told(self) -> str:
        """What messages call it."""
        return f"“{self.path}”" if self.expression else f"${{{self.path}}}"


class Unresolved(MessageError, LookupError):
    """A reference that stands for nothing, in words."""


@dataclass(frozen=True)
class Slot:
    """A declared input in a block that is there: its key, its declaration, and its value in the file or its default."""

    key: KeyPath
    meta: Meta | None
    value: Any
    is_given: bool
    is_required: bool

    @cached_property
    def name(self) -> str:
        """What steps and checks call it: its key without the places in lists."""
        return dotted(self.key)


def slots(model: type[Block], data: Mapping[str, Any], key: KeyPath = ()) -> Iterator[Slot]:
    """All inputs of a block and of the blocks and lists given in it."""
    for name, known in keys_of(model).items():
        given, own = data.get(name), (*key, name)
        value = known.default if given is None else given
        yield Slot(own, known.meta, value, given is not None, known.field.is_required())
        parts = list(enumerate(given)) if isinstance(given, list) else [(None, given)]
        for index, part in parts if known.block else []:
            if known.block and isinstance(part, dict):
                yield from slots(known.block, part, own if index is None else (*own, index))


FOLLOWING = ("slots", "by_key", "given", "results", "phases", "rows")  # from the inputs of an instance


class Instance:
    """A mechanism of the config, or the press (which has no calculation)."""

    def __init__(
        self, name: str, model: type[Block], data: dict[str, Any], place: ConfigPlace, mechanism: Mechanism | None,
        bases: Mapping[KeyPath, Basis], own: BlockData,
    ) -> None:  # fmt: skip
        self.name, self.model, self.data, self.place, self.mechanism = name, model, data, place, mechanism
        self.bases, self.own = bases, own  # what comes from the user's own tables, as it was read
        self.without: frozenset[KeyPath] = frozenset()
        self.derived: frozenset[str] = frozenset()  # inputs taken from partners
        self.founded: Mapping[KeyPath, Any] = {}  # of varied inputs the values that their basis is of

    def is_like(self, other: Instance) -> bool:
        """Return whether another one has the same inputs, to the last letter."""
        is_same = self.model is other.model and self.mechanism is other.mechanism and self.without == other.without
        return is_same and repr(self.data) == repr(other.data)

    def follow(self, other: Instance) -> None:
        """Take over what follows from the inputs of one that has the same."""
        self.__dict__.update({known: other.__dict__[known] for known in FOLLOWING if known in other.__dict__})

    def take(self, found: Mapping[str, str]) -> None:
        """Take inputs from partners: names, and references that keep no value where a machine does not have what they name."""
        self.data |= found
        self.derived = frozenset(found)
        self.forget()

    def leave_out(self, keys: Iterable[KeyPath]) -> None:
        """Inputs that keep no value, as the press does not give their optional default."""
        without = frozenset(keys)
        if without != self.without:
            self.without = without
            self.forget()

    def forget(self) -> None:
        """Forget what follows from the inputs, as they have changed."""
        for known in FOLLOWING:
            self.__dict__.pop(known, None)

    @cached_property
    def slots(self) -> tuple[Slot, ...]:
        """All inputs of the blocks and lists that are given in it."""
        return tuple(slots(self.model, self.data))

    @cached_property
    def by_key(self) -> dict[KeyPath, Slot]:
        """The same by their keys."""
        return {slot.key: slot for slot in self.slots}

    @cached_property
    def given(self) -> frozenset[str]:
        """The ids of the inputs that have a value: given, by default, or from the press."""
        found: set[str] = set(self.mechanism.facts) if self.mechanism else set()
        for slot in self.slots:
            name = slot.name
            if isinstance(slot.value, Block):
                found |= set(flatten(slot.value, f"{name}."))
            from_press = default_of(slot) is not None and slot.key not in self.without
            if slot.value not in (None, []) or slot.is_required or from_press:
                found.add(name)
            if isinstance(slot.meta, Text):
                found |= texts_given({name: slot.value})
        return frozenset(found)

    @cached_property
    def results(self) -> dict[str, tuple[str | None, bool]]:
        """What the calculation gives with these inputs: the SI unit (None for a text), and whether it is a curve or row."""
        if self.mechanism is None:
            return {}
        found = dict(self.mechanism.results_of(self.given))
        for _, step in self.mechanism.active(self.given):
            for name in self.names_of_parts(step.named_by):
                found[part_result(name, step)] = found[step.id][0], isinstance(step, ComputedCurve)
            if step.named_by and isinstance(step, ComputedCurve):
                del found[step.id]
        return found

    def names_of_parts(self, path: str) -> list[str]:
        """Return the names that the blocks of a list have in the file; none where there is no such list."""
        home, _, key = path.rpartition(".")
        blocks = self.data.get(home) if home else None
        return [str(block.get(key)) for block in blocks if isinstance(block, dict)] if isinstance(blocks, list) else []

    @cached_property
    def phases(self) -> dict[str, str]:
        """The phases that there are with these inputs (``phases.NAME``), each with the SI unit of what it runs over."""
        return self.mechanism.phases_of(self.given) if self.mechanism else {}

    def no_phase(self, phase: str) -> str:
        """Why there is no such phase, in words."""
        if phase in self.declared_steps:
            missing = self.missing(phase)
            template = "exists only if {missing} is given in {name}."
            return Phrase(template, missing=" and ".join(missing), name=self.name)
        name, known = phase.removeprefix(PREFIX), [each.removeprefix(PREFIX) for each in self.phases]
        near = nearest(name, known)
        message = Phrase(" Known: {known}.", known=", ".join(known)) if known else phrase(" Its kind has none.")
        template = "names no phase: {name} has no phase {name_2}{near}.{told}"
        return Phrase(template, name=self.name, name_2=repr(name), near=near, told=("" if near else message))

    def missing(self, id: str) -> list[str]:
        """Return the inputs that a step of the mechanism needs and that are not given."""
        chapter, step = self.declared_steps[id]
        return [key for key in (*chapter.needs, *step.needs) if key not in self.given]

    @cached_property
    def rows(self) -> dict[str, str]:
        """The results that have a value for each part of a list, with that list."""
        if self.mechanism is None:
            return {}
        lists = {*list_inputs(self.model).values()}
        lists |= {step.id for _, step in self.mechanism.steps if isinstance(step, PartNames)}
        return {name: home for name, home in self.mechanism.axes(self.given).items() if home in lists}

    def value(self, key: KeyPath) -> Any:
        """The value of an input that is not a reference: an SI number, a text, true or false, values of a curve, or None."""
        slot, value = self._given_at(key)
        is_own = slot.key == key and isinstance(slot.meta, Quantity | CurveInput)
        return slot.meta.validate(value) if is_own and value is not None and slot.meta else value

    def is_in_other_unit(self, key: KeyPath, meta: Quantity) -> bool:
        """Return whether the value of an input that is not a reference is given in the other kind of unit that its key allows."""
        if not meta.or_unit or dotted(key) not in self.given:
            return False
        _, value = self._given_at(key)
        if isinstance(value, Pending | SI):  # stands in for one
            return value.unit == meta.other.parsed_unit.si
        return isinstance(value, InOtherUnit) or (isinstance(value, str) and is_in(value, meta.or_unit))

    def _given_at(self, key: KeyPath) -> tuple[Slot, Any]:
        """The slot that an input is in, and what it has as it is given."""
        slot = next(self.by_key[key[:n]] for n in range(len(key), 0, -1) if key[:n] in self.by_key)
        value = slot.value
        for part in key[len(slot.key) :]:  # within a block that is there by default
            if value is None:  # an optional block that is not given
                return slot, None
            value = getattr(value, part) if isinstance(part, str) else value[part]
        return slot, value

    @cached_property
    def declared_steps(self) -> dict[str, tuple[Chapter, Step]]:
        """Every step of the mechanism by its id, whether it takes part or not."""
        return {step.id: (section, step) for section, step in self.mechanism.steps} if self.mechanism else {}

    @cached_property
    def declared(self) -> dict[str, Step]:
        """Those steps without their chapters."""
        return {name: step for name, (_, step) in self.declared_steps.items()}


def default_of(slot: Slot) -> FromPress | None:
    """The press's default that stands in for an input without a value."""
    return slot.meta.press if isinstance(slot.meta, Quantity) and slot.value is None else None


def substituted(
    instance: Instance, links: Mapping[Node, Target], value: Callable[[Node, Target], Any]
) -> dict[str, Any]:
    """The data of an instance with what stands in for its references; defaults of the press are left to ``value`` too."""
    data: dict[str, Any] = copied(instance.data)
    for node, target in links.items():
        if node[0] == instance.name:
            value_at(data, node[1:-1])[node[-1]] = value(node, target)
    return data


# The units in which a report shows its quantities: ``report: {units: {length: m, drive.crank_speed: rad/s}}``.


DIMENSIONS = {
    "length": "m", "area": "m**2", "volume": "m**3", "second_moment_of_area": "m**4", "mass": "kg", "density": "kg/m**3",
    "moment_of_inertia": "kg*m**2", "force": "N", "line_force": "N/m", "moment": "N*m", "energy": "J", "stress": "Pa",
    "speed": "m/s", "acceleration": "m/s**2", "angle": "rad", "rotational_speed": "rad/s", "angular_acceleration": "rad/s**2",
    "time": "s", "frequency": "1/s", "power": "W", "temperature_difference": "K",
}  # fmt: skip
"""What a report may choose one unit for, by the SI unit of its quantities."""

UNITS = "units"


def faults(given: Any, instances: Mapping[str, Instance | None], place: ConfigPlace) -> Iterator[Problem]:
    """Yield what is wrong with the chosen units; ``place`` is that of the report's block."""
    if given is None:
        return
    if not isinstance(given, dict):
        template = "is {given}; keys with units are needed, as in units: {length: mm, rotational_speed: rad/s}"
        yield place.problem((UNITS,), template, given=quoted(given))
        return
    for key, chosen in given.items():
        wanted = wanted_units(key, instances)
        if isinstance(wanted, str):
            yield place.problem((UNITS, key), wanted, at_key=True)
        elif fault := _unit_fault(chosen, wanted):
            yield place.problem((UNITS, key), fault)


def wanted_units(key: Any, instances: Mapping[str, Instance | None]) -> tuple[str, ...] | str:
    """Return the units of what a key names, a dimension or ``MECHANISM.QUANTITY``; in words why it names nothing."""
    if key in DIMENSIONS:
        return (DIMENSIONS[key],)
    name, dot, quantity = str(key).partition(".")
    if not dot:
        near = nearest(name, DIMENSIONS)
        template = "is not a dimension{near}; give MECHANISM.QUANTITY, or one of: {dimensions}"
        return Phrase(template, near=near, dimensions=", ".join(DIMENSIONS))
    instance = instances.get(name)
    if instance is None:
        known = [each for each, found in instances.items() if found is not None]
        template = "names {name}, which is not there{nearest}; known: {known}"
        return Phrase(template, name=name, nearest=nearest(name, known), known=", ".join(known))
    units = _units(instance)
    if quantity not in units:
        template = "names {quantity}, which is not a quantity of {name} with a number{nearest}"
        return Phrase(template, quantity=quantity, name=name, nearest=nearest(quantity, units))
    return units[quantity]


def _units(instance: Instance) -> dict[str, tuple[str, ...]]:
    found: dict[str, tuple[str, ...]] = {}
    steps = instance.mechanism.steps if instance.mechanism else ()
    named: list[tuple[str, Quantity | Step]] = [(step.id, step) for _, step in steps]
    named += [(name, meta) for name, meta in fields(instance.model) if isinstance(meta, Quantity)]
    for name, declared in named:
        found[name] = (*found.get(name, ()), declared.unit, *(other for _, other in declared.units))
    return found


def _unit_fault(chosen: Any, wanted: tuple[str, ...]) -> str:
    """Why a unit cannot be that of a quantity; nothing where it can."""
    if not isinstance(chosen, str):
        return Phrase("is {chosen}; a unit is needed, such as {wanted}", chosen=repr(chosen), wanted=wanted[0])
    try:
        found = unit(chosen)
    except UnitError as error:
        template = "{error} Give a unit of {kind_name}, such as {wanted}."
        return Phrase(template, error=error, kind_name=kind_name(unit(wanted[0])), wanted=wanted[0])
    if found.si not in {unit(each).si for each in wanted}:
        template = "is a unit of {kind_name}; one of {kind_name_2} is needed, such as {wanted}"
        return Phrase(template, kind_name=kind_name(found), kind_name_2=kind_name(unit(wanted[0])), wanted=wanted[0])
    return ""


def by_si(chosen: Mapping[str, str]) -> dict[str, str]:
    """Return the units that are chosen for all quantities of a dimension, by their SI units."""
    return {DIMENSIONS[key]: unit(text).text for key, text in chosen.items() if key in DIMENSIONS}


def by_id(chosen: Mapping[str, str], name: str) -> dict[str, str]:
    """Return the units that are chosen for single quantities of a mechanism, by their ids."""
    own = {key.partition("."): text for key, text in chosen.items() if key not in DIMENSIONS}
    return {quantity: unit(text).text for (home, _, quantity), text in own.items() if home == name}
