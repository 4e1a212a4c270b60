"""A configuration file read, validated and linked, with all that is wrong reported at once."""

from __future__ import annotations

import math
from collections.abc import Container, Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from itertools import chain, count
from pathlib import Path, PurePath
from typing import Any

from diecut_report.config import instances, yaml
from diecut_report.config.instances import BlockData, Instance, Node, Slot, Target, substituted
from diecut_report.config.model import PRESS, ConfigDocument, PressBlock, Project, ReportSettings, written
from diecut_report.config.own_tables import Find, Logo, OwnTables, logo_of
from diecut_report.config.parts.expansion import Expanded, expanded, has_parts, misnamed, retyped
from diecut_report.config.parts.keys import WORDS
from diecut_report.config.parts.model import MachineParts
from diecut_report.config.plugins import Discovery, DuplicateKind, UnknownKind, said
from diecut_report.config.references import WHOLE, Linker, linked, ordered
from diecut_report.config.source_hashes import note_same_code, plugin_hash, program_hash
from diecut_report.config.validation import ConfigPlace, as_typed, declared, keys_of, quoted, spread_out, validate
from diecut_report.config.yaml import MAX_BYTES, KeyPath, Scalar, Tree, key_of, read, too_much
from diecut_report.declaration.inputs import NAME
from diecut_report.errors import PluginError, Problem, UserError, nearest, refusal, seeming_latin
from diecut_report.files import standard_input
from diecut_report.mechanism.chapters import in_form
from diecut_report.mechanism.curve_inputs import CurveInput
from diecut_report.mechanism.inputs import Block, Quantity, keys
from diecut_report.mechanism.mechanism import Mechanism, Partner, Wired, absent_partners_checks, without_checks
from diecut_report.mechanism.names import SI, Pending, Text
from diecut_report.quantities.units import Unit, UnitError, decades, number_and_unit, parse_quantity, pretty
from diecut_report.text.phrases import Phrase
from diecut_report.time_limit import contained

# Partners: the mechanisms from which a kind takes inputs by itself, and the kinds that run without being asked.


BY_THEMSELVES = ("press_consistency",)  # known by name: to ask every plugin, all would have to be loaded
FEWEST = 2  # partners that a kind needs to run by itself: a single mechanism cannot contradict another

Instances = Mapping[str, Instance | None]
Kinds = Mapping[str, str]  # of the mechanisms, by their names


def typed_beside(reference: str) -> Phrase:
    """Return what is wrong with a value in place of what a block that compares others takes from them."""
    template = "is given here, but {reference} already provides it and is compared with the others. Remove the key; change it there."
    return Phrase(template, reference=reference)


def compared(instance: Instance) -> dict[str, str]:
    """Return what a block that compares others takes from them, by its keys: their names, and references."""
    is_asked = instance.mechanism is not None and instance.mechanism.kind in BY_THEMSELVES
    return {key: instance.data[key] for key in instance.derived if is_asked}


def _offered(mechanism: Mechanism, data: Mapping[str, Any], instances: Instances, kinds: Kinds) -> dict[str, str]:
    """What the partners of a block have for it: their names, and references."""
    found: dict[str, str] = {}
    for partner in mechanism.partners:
        name = data.get(partner.key) or only(partner.kinds, _meant(partner, instances, kinds))
        if partner_fault(partner, name, kinds) or (instance := instances[str(name)]) is None:
            continue
        known = instance.given | instance.results.keys()
        found |= {partner.key: str(name)}
        found |= {key: f"${{{instance.name}.{taken}}}" for key, taken in partner.takes.items() if taken in known}
    return found


def _meant(partner: Partner, instances: Instances, kinds: Kinds) -> Kinds:
    """The mechanisms without those of which an input refers to a kind that shows another use."""

    def refers(name: str, key: str, kind: str) -> bool:
        given = instance.data.get(key) if (instance := instances.get(name)) else None
        return isinstance(given, str) and any(kinds.get(path.split(".")[0]) == kind for path in WHOLE.findall(given))

    return {name: own for name, own in kinds.items() if not any(refers(name, *each) for each in partner.unless.items())}


def only(wanted: Container[str], kinds: Kinds) -> str | None:
    """Return the only mechanism of these kinds; None where there is none, or where there are several."""
    found = [name for name, kind in kinds.items() if kind in wanted]
    return found[0] if len(found) == 1 else None


def partner_fault(partner: Partner, name: Any, kinds: Kinds) -> str:
    """Return what is wrong with the name of a partner, in words; nothing where it is right."""
    wanted = " or ".join(partner.kinds)
    if not isinstance(name, str) or name not in kinds:
        near = nearest(name, kinds) if isinstance(name, str) else ""
        template = "is {name}; the name of a mechanism of kind {wanted} is needed{near}. Known: {kinds}."
        return Phrase(template, name=quoted(name), wanted=wanted, near=near, kinds=", ".join(kinds))
    if kinds[name] not in partner.kinds:
        template = "is {name}, of kind {kinds}; the name of a mechanism of kind {wanted} is needed."
        return Phrase(template, name=name, kinds=kinds[name], wanted=wanted)
    return ""


def free_name(name: str, taken: Container[str]) -> str:
    """Return a name that is not taken: this one, with a number from the second on."""
    return next(each for each in chain([name], (f"{name}_{number}" for number in count(2))) if each not in taken)


# A configuration or a study from standard input.


SHOWN, STANDARD_INPUT_NAME = "<stdin>", "stdin.yaml"  # what messages and documents call it


def load_standard_input() -> Tree:
    """Read YAML from standard input, up to its end; what its text names is sought from the current folder."""
    tree = read(Path(SHOWN), standard_input(MAX_BYTES, SHOWN))
    tree.name = STANDARD_INPUT_NAME
    return tree


# Files of studies, which are no configurations: known by their keys, and refused where a configuration is needed.


KEYS = frozenset({"base", "vary", "sample"})
"""By each of which a study is known, also where another is forgotten or mistyped."""


def is_study(tree: Tree) -> bool:
    """Return whether a file is a study rather than a configuration."""
    return isinstance(tree.data, dict) and "mechanisms" not in tree.data and not KEYS.isdisjoint(tree.data)


def refuse_study(tree: Tree) -> None:
    """Raise UserError where a study is given for a configuration: with the command that takes it, and its base."""
    if is_study(tree):
        command = "optimise" if "optimise" in tree.data else "batch"
        template = "This is a study: calculate it with diecut-report {command} {file}, or give its base, {base}"
        base = PurePath(tree.file).parent / str(tree.data.get("base", "…"))
        raise refusal(template, tree.file, command=command, file=tree.file, base=base)


# Numbers without a unit that their key's own unit makes absurd and another unit usual: crank_length: 0.16 is 0.16 mm, and 0.16 m is meant.
#
# What is usual of a key is near the value of the example and the default of its mechanism kind. Only bare numbers are asked about: who types
# the unit has answered.


FAR = 100  # times greater or less than what is usual: a number that is asked about
NEAR = 10  # and one in the unit that may be meant


def bare_numbers(instance: Instance) -> Iterator[Problem]:
    """Yield a question for each number of a mechanism, or of the press, that its unit makes absurd and another one usual."""
    for slot in instance.slots:
        if slot.is_given and isinstance(slot.meta, Quantity) and slot.meta.unit != "1":
            number = _bare(slot.value)
            usual = _usual(instance, slot, slot.meta) if number else []
            meant = _unit_meant(number, slot.meta.parsed_unit, usual)
            if meant is not None:
                template = "is {number} without a unit, which is {own} here; {other} is usual. Write the one that is meant, with its unit."
                own, other = (f"{number:.15g} {pretty(each.text)}" for each in (slot.meta.parsed_unit, meant))
                yield instance.place.problem(slot.key, template, number=f"{number:.15g}", own=own, other=other)


def _bare(value: Any) -> float:
    """The number of a value that has no unit; 0, of which nothing is asked, for anything else."""
    if isinstance(value, str):
        with suppress(UnitError):
            number, own = number_and_unit(value)
            return 0.0 if own else float(number)
        return 0.0
    return float(value) if isinstance(value, int | float) and not isinstance(value, bool) else 0.0


def _unit_meant(number: float, own: Unit, usual: list[float]) -> Unit | None:
    """The unit in which a number is near a usual value, where it is far from all of them in its own."""
    sizes = [abs(value) for value in usual if value]

    def distance(given: Unit) -> float:
        return min(abs(math.log10(abs(number) * given.factor / size)) for size in sizes)

    if not number or not sizes or distance(own) < math.log10(FAR):
        return None
    near = min(decades(own), key=distance, default=own)
    return near if distance(near) <= math.log10(NEAR) else None


def _usual(instance: Instance, slot: Slot, meta: Quantity) -> list[float]:
    """The values of a key in the example of its kind, and its default, SI."""
    example = instance.mechanism.example if instance.mechanism else None
    found = list(_numbers(example.inputs, slot.name.split("."), meta)) if example else []
    known = keys_of(instance.model).get(str(slot.key[0])) if len(slot.key) == 1 else None
    return [*found, *_numbers(known.default if known else None, [], meta)]


def _numbers(given: Any, path: list[str], meta: Quantity) -> Iterator[float]:
    """Yield the quantities at a path of an example, of the parts of a list each; what is referred to has none."""
    match given:
        case Wired():
            yield from _numbers(given.value, path, meta)
            yield from _numbers(given.otherwise, path, meta)
        case list() | tuple():
            for part in given:
                yield from _numbers(part, path, meta)
        case Mapping():
            key, *rest = path or ["value"]
            yield from _numbers(given.get(key), rest, meta)
        case str() | int() | float() if not path:
            with suppress(UnitError):
                yield parse_quantity(given, meta.unit)


# The configuration.


RESERVED = (PRESS, "project", *WORDS)


@dataclass(frozen=True)
class Config:
    """A valid configuration: the press and the mechanisms with what their references stand for.

    ``instances`` holds the press and, in the order of the file, the mechanisms; None stands for one whose plugin cannot
    be loaded (``broken`` tells why). ``order`` is the order in which inputs and calculations can be known. ``extensions`` were
    run before, each with the hash of its code. ``tables`` are the user's own, by the names that the file gives them.
    """

    tree: Tree
    project: Project
    instances: Mapping[str, Instance | None]
    kinds: Mapping[str, str]
    links: Mapping[Node, Target]
    order: tuple[Node, ...]
    broken: Mapping[str, PluginError]
    extensions: Mapping[str, str]
    tables: Mapping[str, Tree]
    report: ReportSettings
    logo: Logo | None
    parts: MachineParts | None
    lacks_parts: bool  # they are not all right, so that the mechanisms lack what they give
    discovery: Discovery
    find: Find | None

    @property
    def files(self) -> dict[str, str]:
        """The SHA-256 of the files that the configuration names, by their names in it."""
        logo = {self.logo.name: self.logo.sha256} if self.logo else {}
        return {name: tree.sha256 for name, tree in self.tables.items()} | logo

    def named(self, kind: str) -> str | None:
        """Return the only mechanism of a kind."""
        return only((kind,), self.kinds)

    def units(self, places: Iterable[KeyPath]) -> dict[KeyPath, str]:
        """Return the units in which numbers without one count, by their places in the file; of what is no quantity there is none."""
        made = [instance for instance in self.instances.values() if instance is not None]
        slots = ((each.place.stands(slot.key)[1], slot.meta) for each in made for slot in each.slots)
        known = {path: meta.unit for path, meta in slots if isinstance(meta, Quantity)}
        return {path: known[path] for path in places if path in known}

    def retyped(self, changes: Mapping[KeyPath, Scalar]) -> tuple[Config, list[Problem]]:
        """Return the machine with these values in their places, its parts made anew, and what is wrong with it."""
        tree = self.parts.reader.tree if self.parts else self.tree
        config, problems = examined(retyped(tree, changes), self.discovery, find=self.find)
        return config, in_order(problems)

    @property
    def source_hashes(self) -> dict[str, str]:
        """The SHA-256 of the code of all that calculates this configuration, by its name in words."""
        made = [instance.mechanism for instance in self.instances.values() if instance and instance.mechanism]
        plugins = {f"plugin {mechanism.kind}": plugin_hash(mechanism) for mechanism in made}
        extensions = {f"extension {name}": digest for name, digest in self.extensions.items()}
        return {"program": program_hash(), **dict(sorted((plugins | extensions).items()))}


def load_config(given: Path | Tree, discovery: Discovery, *, find: Find | None = None) -> Config:
    """Read and validate a configuration, with what runs by itself; UserError with all its problems. A broken plugin is kept in ``broken``.

    ``find`` says where the tables are that the file names, where they are not beside it.
    """
    config, problems = examined(given, discovery, find=find)
    if problems:
        raise UserError(in_order(problems))
    return config


def examined(given: Path | Tree, discovery: Discovery, *, find: Find | None = None) -> tuple[Config, list[Problem]]:
    """Return a configuration as far as it can be read, with all that is wrong with it; UserError where it cannot be read at all."""
    tree = given if isinstance(given, Tree) else yaml.read(given)
    refuse_study(tree)
    if excess := too_much(tree):
        raise UserError([*tree.problems, *excess])
    discovery.extend()
    tree, wrong = misnamed(tree)
    found = Expanded(tree, problems=wrong) if wrong else None
    if has_parts(tree.data):
        found = expanded(tree, lambda kind: _declared(discovery, kind))
    tree = found.tree if found else tree
    tables = OwnTables.read(tree, find)
    made = frozenset(each.name for each in found.elements.made) if found and found.elements else frozenset()
    reader = _ConfigReader(tree, discovery, tables, made)
    linker = linked(reader.instances)
    order, loops = ordered(linker)
    logo, faults = logo_of(tree, find)
    problems = [*reader.problems, *tables.problems, *_unknown_tables(reader), *faults]
    problems += [*linker.problems, *_wrong_values(reader, linker), *loops]
    units = reader.report and reader.report.units
    problems += instances.faults(units, reader.instances, ConfigPlace(tree, ("report",)))
    broken = reader.broken if problems else {}
    problems += [reader.place.problem(("mechanisms", name, "kind"), str(error)) for name, error in broken.items()]
    if found and found.problems:  # without their parts the mechanisms lack what these give them
        problems = [*found.problems, *(each for each in problems if _stands_alone(tree, each))]
    problems = beside(tree, problems)
    project = reader.project or Project.model_validate({"title": "?"})  # of a file with problems
    config = Config(tree, project, reader.instances, reader.kinds, linker.links, tuple(order), reader.broken,
                    dict(sorted(discovery.extended.items())), tables.trees, reader.report or ReportSettings(), logo,
                    found.parts if found else None, bool(found and found.problems), discovery, find)  # fmt: skip
    return config, problems


def _unknown_tables(reader: _ConfigReader) -> Iterator[Problem]:
    """Tables of the user's own that no kind takes: one of another name would stand beside the standard one that is taken in its place."""
    used = {each.mechanism for each in reader.instances.values() if each and each.mechanism}
    entries, discovery = reader.tables.entries, reader.discovery
    if not set(entries) - _tables_of(used):
        return
    known = _tables_of(filter(None, (_declared(discovery, kind) for kind in discovery.origins)))
    for table in set(entries) - known:
        first = next(iter(entries[table].values()))
        template = "is a table that no kind takes{near}; there are {known}"
        place, names = ConfigPlace(first.tree), ", ".join(sorted(known))
        yield place.problem((table,), template, at_key=True, near=nearest(table, known), known=names)


def _tables_of(mechanisms: Iterable[Mechanism]) -> set[str]:
    blocks = (
        block for each in mechanisms for block in (each.inputs, *(key.block for key in keys(each.inputs).values()))
    )
    return {rule.table for block in blocks if block for rule in block.from_tables}


def _stands_alone(tree: Tree, problem: Problem) -> bool:
    """Whether a problem is of a typed value that refers to nothing, so that it has nothing to do with the parts."""
    typed = tree.typed(key_of(problem.path))
    return typed is not None and "${" not in typed


def _declared(discovery: Discovery, kind: str) -> Mechanism | None:
    """The declarations of a kind; None of one that cannot be loaded, which is told where it is named."""
    try:
        return discovery.mechanism(kind)
    except (UnknownKind, DuplicateKind, PluginError):
        return None


def beside(tree: Tree, problems: Iterable[Problem]) -> list[Problem]:
    """Return the problems of the form of a file, and those that these do not make."""
    told = {(each.file, each.line, each.column) for each in tree.problems}
    return [*tree.problems, *(each for each in problems if (each.file, each.line, each.column) not in told)]


def in_order(problems: Iterable[Problem]) -> list[Problem]:
    """Return problems of one file in the order of its lines, each once."""
    return sorted(dict.fromkeys(problems), key=lambda p: (p.line or 0, p.column or 0))


@dataclass
class _ConfigReader:
    """Reads the fixed part and finds the model of each mechanism."""

    tree: Tree
    discovery: Discovery
    tables: OwnTables
    made: frozenset[str]  # calculations that the parts of the machine make
    instances: dict[str, Instance | None] = field(default_factory=dict)
    kinds: dict[str, str] = field(default_factory=dict)
    broken: dict[str, PluginError] = field(default_factory=dict)
    problems: list[Problem] = field(default_factory=list)
    with_partners: list[str] = field(default_factory=list)
    project: Project | None = None
    report: ReportSettings | None = None

    def __post_init__(self) -> None:
        self.place = ConfigPlace(self.tree)
        whole = as_typed(ConfigDocument, self.tree.data, self.place)
        document, self.problems = validate(ConfigDocument, whole, self.place)
        self.project = document.project if document else None
        self.report = document.report if document else None
        data = whole if isinstance(whole, dict) else {}
        self.instances[PRESS] = None
        press, home = written(PRESS, data), written("mechanisms", data)
        if isinstance(data.get(press), dict):
            self._add(PRESS, PressBlock, data[press], ConfigPlace(self.tree, (press,)))
        mechanisms = data.get(home)
        for name, body in mechanisms.items() if isinstance(mechanisms, dict) else []:
            self.instances.setdefault(name, None)
            self._mechanism(name, body, ConfigPlace(self.tree, (home, name)))
        for kind in BY_THEMSELVES:
            wanted = {each for partner in self.discovery.mechanism(kind).partners for each in partner.kinds}
            partners = sum(each in wanted for name, each in self.kinds.items() if name not in self.made)
            if kind not in self.kinds.values() and partners >= FEWEST:
                own_name = free_name(kind, self.instances)
                self._of_kind(own_name, kind, {}, ConfigPlace(self.tree, ("mechanisms", own_name)))
        for name in self.with_partners:
            self._take_from_partners(name)

    def _take_from_partners(self, name: str) -> None:
        """Add to a block what its partners give it, when these are known."""
        instance = self.instances[name]
        assert instance is not None and instance.mechanism is not None, "it was added when it was read"
        whole, data = instance.mechanism, instance.data
        for partner in whole.partners:
            named = data.get(partner.key)
            if named is not None and (fault := partner_fault(partner, named, self.kinds)):
                self.problems.append(instance.place.problem((partner.key,), fault))
        offered = _offered(whole, data, self.instances, self.kinds)
        names = {partner.key for partner in whole.partners}
        for key, reference in offered.items() if whole.kind in BY_THEMSELVES else ():  # a verdict must not be typed
            if key not in names and data.get(key) not in (None, reference):
                self.problems.append(instance.place.problem((key,), typed_beside(reference)))
        instance.take({key: text for key, text in offered.items() if data.get(key) is None})
        instance.mechanism = without_checks(whole, absent_partners_checks(whole, self.kinds.values(), instance.given))
        note_same_code(instance.mechanism, whole)
        self._probe(name)

    def _add(
        self, name: str, model: type[Block], data: dict[str, Any], place: ConfigPlace, mechanism: Any = None
    ) -> None:
        data, place, problems = spread_out(model, data, place)
        own = BlockData.read(model, data, place, self.tables)
        self.problems += [*problems, *own.problems]
        form = in_form(model, [key for key, value in own.data.items() if value is not None])
        typed = as_typed(form, own.data, own.place)
        self.instances[name] = Instance(name, form, typed, own.place, mechanism, own.bases, own)

    def _mechanism(self, name: str, body: Any, place: ConfigPlace) -> None:
        if name not in self.made and (fault := name_fault(name)):
            self.problems.append(place.problem((), fault, at_key=True))
        elif not isinstance(body, dict):
            template = "is {body}; a block of keys with its kind is needed"
            self.problems.append(place.problem((), template, body=quoted(body)))
        elif not isinstance(body.get("kind"), str):
            origins, given = ", ".join(self.discovery.origins), quoted(body.get("kind"))
            absent = place.absent(("kind",), "is missing. Give one of: {origins}.", origins=origins)
            wrong = place.problem(("kind",), "is {kind}; the name of a kind is needed", kind=given)
            self.problems.append(wrong if "kind" in body else absent)
        else:
            self._of_kind(name, body["kind"], {key: value for key, value in body.items() if key != "kind"}, place)

    def _of_kind(self, name: str, kind: str, data: dict[str, Any], place: ConfigPlace) -> None:
        self.kinds[name] = kind
        try:
            mechanism = self.discovery.mechanism(kind)
            self._add(name, mechanism.inputs, data, place, mechanism)
            if mechanism.partners or any(check.only_beside for check in mechanism.checks):
                self.with_partners.append(name)
            else:
                self._probe(name)
        except UnknownKind as fault:
            self.problems.append(place.problem(("kind",), seeming_latin(kind) or str(fault)))
        except (DuplicateKind, PluginError) as error:
            self.instances[name] = None
            self.broken[name] = _of_instance(error, kind, name)

    def _probe(self, name: str) -> None:
        """Ask the plugin once what it gives with these inputs, so that what is wrong with it shows here."""
        instance = self.instances[name]
        try:
            assert instance is not None
            with contained():
                _ = instance.given, instance.results
        except Exception as cause:
            words = Phrase("its declarations are invalid: {said}", said=said(cause))
            raise PluginError(words, self.kinds[name]) from cause


def _of_instance(error: DuplicateKind | PluginError, kind: str, name: str) -> PluginError:
    named = PluginError(error.message if isinstance(error, PluginError) else str(error), kind, name)
    named.__cause__ = error.__cause__ or error
    return named


def name_fault(name: str) -> str:
    """Return why a mechanism cannot have this name; nothing where it can."""
    if seeming := seeming_latin(name):
        return seeming
    if name in RESERVED:
        return Phrase("the name {name} is reserved. Choose another one.", name=repr(name))
    if not NAME.fullmatch(name):
        return Phrase("{name} is not a name: a letter, then letters, digits, _ and - are allowed.", name=quoted(name))
    return ""


def _wrong_values(reader: _ConfigReader, linker: Linker) -> list[Problem]:
    """What is wrong with the values of the press and the mechanisms, as far as it can be known without calculating.

    A plugin whose own validator breaks is kept in the reader's ``broken``.
    """
    problems: list[Problem] = []
    unresolved = dict.fromkeys(linker.unresolved, Target("", "", is_broken=True))
    for instance in reader.instances.values():
        if instance is None:
            continue
        written = {node: target for node, target in linker.links.items() if not target.is_default} | unresolved
        data = substituted(instance, written, lambda node, target, own=instance: _pending(own, node, target))  # type: ignore[misc]
        # a text, and what a broken plugin would give, can be judged only when it is known
        own = [(node[1:], target) for node, target in written.items() if node[0] == instance.name]
        texts = {key for key, each in own if each.unit is None and isinstance(declared(instance.model, key), Text)}
        left_open = {key for key, each in own if each.is_broken or (key in texts and not each.phase_unit)}
        try:
            wrong = validate(instance.model, data, instance.place, left_open)[1]
            asked = list(bare_numbers(instance))  # says more than that such a value is not plausible
            places = {each.path for each in asked}
            problems += [*asked, *(each for each in wrong if each.path not in places)]
        except PluginError as error:
            reader.broken[instance.name] = _of_instance(error, reader.kinds.get(instance.name, ""), instance.name)
    return problems


def _pending(instance: Instance, node: Node, target: Target) -> Any:
    curve = declared(instance.model, node[1:-1]) if len(node) > 2 else None
    if isinstance(curve, CurveInput):
        return SI(0.0, curve.unit, target.path)  # one value of a list, whose kind the linker has judged
    return Pending(target.path, target.unit, target.is_curve, target.phase_unit, target.is_mechanism)
