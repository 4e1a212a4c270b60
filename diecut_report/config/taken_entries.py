"""What blocks take from the user's own tables: an entry that is named gives its keys, with what they rest on."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Annotated, Any, Literal, get_args, get_origin

from pydantic import create_model

from diecut_report.config.basis import Basis, BasisReader
from diecut_report.config.own_tables import SOURCE, Entry, OwnTables
from diecut_report.config.validation import NAMED, ConfigPlace, keys_of, told, validate
from diecut_report.config.yaml_tree import KeyPath
from diecut_report.contract.from_tables import FromTable
from diecut_report.contract.inputs import Block, Quantity
from diecut_report.errors import Problem, nearest
from diecut_report.languages.phrases import Phrase, phrase

CATALOGUE = "catalogue"


@dataclass(frozen=True)
class Taken:
    """Hold the data of a block with what its entries give, where that stands, and what it is from."""

    data: dict[str, Any]
    place: ConfigPlace
    bases: Mapping[KeyPath, Basis]
    tables: OwnTables
    entries: Mapping[KeyPath, Entry]
    problems: Sequence[Problem]
    naming: Mapping[KeyPath, tuple[KeyPath, ...]]
    """Keys that may name an entry, each with the keys that it gives."""

    @property
    def sources(self) -> dict[str, str]:
        """Return each file with the sources of what is taken from it."""
        found: dict[str, list[str]] = {}
        for entry in dict.fromkeys(self.entries.values()):
            found.setdefault(entry.file, []).append(f"{entry.name}: {entry.source}")
        return {file: "; ".join(said) for file, said in found.items()}

    def names(self, key: KeyPath) -> tuple[str, ...]:
        """Return the names of entries that a key may have."""
        return self.place.named.get(key, ())


def taken(model: type[Block], data: Mapping[str, Any], place: ConfigPlace, tables: OwnTables) -> Taken:
    """Return the data of a block with the keys of the entries that it names, and what all of it rests on."""
    taker = _Taker(place, tables)
    found = taker.block(model, data, ())
    stands = {key: (entry.tree, (*entry.path, theirs)) for key, (entry, theirs) in taker.found.items()}
    own = replace(place, elsewhere={**place.elsewhere, **stands}, named=taker.known)
    stated = BasisReader.read(model, found, own)
    entries = {key: entry for key, (entry, _) in taker.found.items()}
    for key, entry in entries.items():
        for each in _quantities(model, stated.data, key):
            said = stated.bases.get(each, Basis())
            stated.bases[each] = Basis(said.basis or CATALOGUE, said.note or entry.note)
    return Taken(
        stated.data, stated.place, stated.bases, tables, entries, (*taker.problems, *stated.problems), taker.gives
    )


def taken_anew(
    model: type[Block], before: Taken, data: dict[str, Any], changed: Iterable[KeyPath], place: ConfigPlace
) -> Taken:
    """Return what a block takes whose keys ``changed``: what other entries gave before is left out."""
    for key in changed:
        for given in before.naming.get(key, ()):
            if given in before.entries:
                _left_out(data, given)
    return taken(model, data, place, before.tables)


def _left_out(data: Any, key: KeyPath) -> None:
    for part in key[:-1]:
        data = data[part]
    data.pop(key[-1], None)


@dataclass
class _Taker:
    place: ConfigPlace
    tables: OwnTables
    found: dict[KeyPath, tuple[Entry, str]] = field(default_factory=dict)
    problems: list[Problem] = field(default_factory=list)
    known: dict[KeyPath, tuple[str, ...]] = field(default_factory=dict)
    gives: dict[KeyPath, tuple[KeyPath, ...]] = field(default_factory=dict)

    def block(self, model: type[Block], data: Mapping[str, Any], key: KeyPath) -> dict[str, Any]:
        known = keys_of(model)
        made = {
            name: self._inner(known[name].block, part, (*key, name)) if name in known else part
            for name, part in data.items()
        }
        for rule in model.from_tables:
            self._take(model, rule, made, key)
        return made

    def _inner(self, model: type[Block] | None, given: Any, key: KeyPath) -> Any:
        if model is None:
            return given
        if isinstance(given, list):
            return [self._inner(model, part, (*key, index)) for index, part in enumerate(given)]
        return self.block(model, given, key) if isinstance(given, dict) else given

    def _take(self, model: type[Block], rule: FromTable, made: dict[str, Any], key: KeyPath) -> None:
        self._judge(model, rule)
        self.known[(*key, rule.key)] = tuple(self.tables.names(rule.table))
        self.gives[(*key, rule.key)] = tuple((*key, own) for own in rule.gives)
        given = made.get(rule.key)
        name = given if isinstance(given, str) else self.place.typed((*key, rule.key)) if given is not None else None
        entry = self.tables.entries.get(rule.table, {}).get(name or "")
        if entry is None:
            if name is not None and not _has_texts(model, rule.key):
                self.problems.append(self.place.problem((*key, rule.key), self._unknown(rule.table, name)))
            return
        del made[rule.key]
        if rule.stands_for:
            made[rule.key] = rule.stands_for
        for own, theirs in rule.gives.items():
            if theirs in entry.keys and made.get(own) is None:
                made[own] = entry.keys[theirs]
                self.found[(*key, own)] = (entry, theirs)

    def _unknown(self, table: str, name: str) -> str:
        known = self.tables.names(table)
        if not known:
            file = phrase("in a file that materials: names")
            return Phrase(
                "is {name}, but there is no table {table} of your own: put {table}: {{name_2}: {…}} {file}",
                name=told(name),
                table=table,
                name_2=name,
                file=file,
            )
        return Phrase(
            "is {name}{nearest}; {table} has {known}",
            name=told(name),
            nearest=nearest(name, known),
            table=table,
            known=", ".join(known[:NAMED]),
        )

    def _judge(self, model: type[Block], rule: FromTable) -> None:
        """Judge all entries of a table by the block that may take them, whether it does or not."""
        for entry in self.tables.entries.get(rule.table, {}).values():
            mark = (*entry.path, entry.tree.file, model.__name__, rule.key)
            if mark not in self.tables.judged:
                self.tables.judged.add(mark)
                self.tables.problems += _faults(model, rule, entry)


def _has_texts(model: type[Block], key: str) -> bool:
    """Whether a key has texts of its own, so that the model judges what is none of them."""
    return any(get_origin(part) is Literal for part in _parts(keys_of(model)[key].field.annotation))


def _parts(annotation: Any) -> tuple[Any, ...]:
    return (annotation, *get_args(annotation))


def _faults(model: type[Block], rule: FromTable, entry: Entry) -> Iterator[Problem]:
    """What is wrong with the keys of an entry, as the block judges them."""
    place, known = ConfigPlace(entry.tree, entry.path), list(rule.gives.values())
    for key in entry.keys:
        if key not in known:
            words = Phrase(
                "is an unknown key{nearest}. An entry of {table} has {text}.",
                nearest=nearest(key, known),
                table=rule.table,
                text=", ".join([SOURCE, *known]),
            )
            yield place.problem((key,), words, at_key=True)
    for own, theirs in rule.gives.items():
        if theirs in entry.keys:
            field = keys_of(model)[own].field
            annotation: Any = Annotated[field.annotation, *field.metadata]
            form = create_model(model.__name__, __base__=Block, **{theirs: (annotation, ...)})  # type: ignore[call-overload]
            stated = BasisReader.read(form, {theirs: entry.keys[theirs]}, place)
            yield from stated.problems
            yield from validate(form, stated.data, stated.place)[1]


def _quantities(model: type[Block], data: Any, key: KeyPath, home: KeyPath = ()) -> Iterator[KeyPath]:
    """The quantities at a key of a block, and in the blocks that stand there."""
    name, *rest = key
    known = keys_of(model)[str(name)]
    part = data[name]
    own = (*home, name)
    if known.block is None:
        if isinstance(known.meta, Quantity):
            yield own
        return
    if rest and isinstance(part, list):
        index, *rest = rest
        part, own = part[int(index)], (*own, index)
    if rest:
        yield from _quantities(known.block, part, tuple(rest), own)
        return
    for at, inner in enumerate(part) if isinstance(part, list) else [(None, part)]:
        for each in inner if isinstance(inner, dict) else ():
            if each in keys_of(known.block):
                yield from _quantities(known.block, inner, (each,), own if at is None else (*own, at))
