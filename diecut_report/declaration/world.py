"""Which inputs may be given together: what is optional, which texts are allowed, of which keys one group is needed."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import chain, combinations
from typing import Any, Literal, NamedTuple, get_args, get_origin

from diecut_report.contract.inputs import Block, Meta, Quantity, Text, meta_of, nested
from diecut_report.contract.placeholders import OneOf
from diecut_report.languages.phrases import Phrase, joined

GIVEN, OTHER = "given", "another text"
Given = str | None  # what is known of an input: that it is given, its text, or None where it is left out


class When(NamedTuple):
    """When something is part of the calculation: all of these tokens hold, and none of those."""

    needs: frozenset[str]
    lacks: frozenset[str] = frozenset()

    def with_(self, other: When) -> When:
        """Return when both are."""
        return When(self.needs | other.needs, self.lacks | other.lacks)


ALWAYS = When(frozenset())


@dataclass(frozen=True)
class Key:
    """An input (or a block of inputs): whether it may be left out, its allowed texts, the list whose parts have it."""

    path: str
    meta: Meta | None
    annotation: Any
    is_block: bool
    may_be_absent: bool
    home: str = ""
    texts: tuple[str, ...] = ()
    has_default: bool = False


@dataclass
class World:
    """The inputs of a mechanism by their paths, and what may be given of them."""

    keys: dict[str, Key]
    rules: tuple[tuple[str, OneOf], ...]
    """Of which keys one group is needed, each rule with the path of the block that it is for."""
    _found: dict[Any, dict[str, Given] | None] = field(default_factory=dict)

    def example(self, holds: When, never: Sequence[When] = ()) -> dict[str, Given] | None:
        """Return what may be given so that something is calculated and none of the others; None where that cannot be.

        An input with a default is taken as given where others are asked about: only its model knows with what it is put to None.
        """
        if any(other.needs <= holds.needs and other.lacks <= holds.lacks for other in never):
            return None
        asked = holds, tuple(never)
        if asked not in self._found:
            self._found[asked] = next(self._search(holds, never, self._variables(holds, never), {}), None)
        return self._found[asked]

    def _search(
        self, holds: When, never: Sequence[When], open_ones: Sequence[str], known: dict[str, Given]
    ) -> Iterator[dict[str, Given]]:
        if (
            _judged(holds, known) is False
            or any(_judged(other, known) for other in never)
            or not self._is_allowed(known)
        ):
            return
        if not open_ones:
            yield known
            return
        for value in self._values(open_ones[0], known):
            if value is None and never and self.keys[open_ones[0]].has_default:
                continue
            yield from self._search(holds, never, open_ones[1:], {**known, open_ones[0]: value})

    def _variables(self, holds: When, never: Sequence[When]) -> list[str]:
        """The inputs on which it depends; those that something needs come first, blocks before what is in them."""
        tokens = [
            *sorted(holds.needs | holds.lacks),
            *(t for other in never for t in sorted(other.needs | other.lacks)),
        ]
        paths = [token.partition("=")[0] for token in tokens]
        grouped = [
            {f"{home}{key}" for key in chain((rule.when.partition("=")[0],) * bool(rule.when), *rule.groups)}
            for home, rule in self.rules
        ]
        paths += [key for keys in grouped if keys.intersection(paths) for key in sorted(keys)]
        found = [above for path in paths for above in (*_above(path), path)]
        return [path for path in dict.fromkeys(found) if path in self.keys]

    def _values(self, path: str, known: Mapping[str, Given]) -> Iterator[Given]:
        key = self.keys[path]
        if any(known.get(above, GIVEN) is None for above in _above(path)):
            yield None
            return
        yield from key.texts or ((OTHER, GIVEN) if isinstance(key.meta, Text) and not key.is_block else (GIVEN,))
        if key.may_be_absent:
            yield None

    def _is_allowed(self, known: Mapping[str, Given]) -> bool:
        """Whether the rules let these be given together, as far as all that they name is known; what they refuse stays refused."""
        return all(_keeps(home, rule, known, self.keys) for home, rule in self.rules)


def _keeps(home: str, rule: OneOf, known: Mapping[str, Given], keys: Mapping[str, Key]) -> bool:
    """Whether a rule lets these be given; a key with a default is there without being typed, so that it may stand in no group."""
    names = {key: f"{home}{key}" for group in rule.groups for key in group}
    if rule.when and not _holds(f"{home}{rule.when}", known):
        return True
    if not all(path in known for path in names.values()) or (home and known.get(home.removesuffix(".")) is None):
        return True
    typed = [key for key, path in names.items() if known[path] is not None and not keys[path].has_default]
    free = [key for key, path in names.items() if known[path] is not None and keys[path].has_default]
    chosen = chain.from_iterable(combinations(free, count) for count in range(len(free) + 1))
    return any(not rule.fault([*typed, *more]) for more in chosen)


def _above(path: str) -> list[str]:
    parts = path.split(".")
    return [".".join(parts[:count]) for count in range(1, len(parts))]


def _judged(when: When, known: Mapping[str, Given]) -> bool | None:
    """Whether something is calculated; None where what is known does not say."""
    said = [
        *((_holds(token, known), True) for token in when.needs),
        *((_holds(token, known), False) for token in when.lacks),
    ]
    if any(found is not None and found is not wanted for found, wanted in said):
        return False
    return None if any(found is None for found, _ in said) else True


def _holds(token: str, known: Mapping[str, Given]) -> bool | None:
    path, is_text, text = token.partition("=")
    if path not in known:
        return None
    return known[path] == text if is_text else known[path] is not None


def world(model: type[Block]) -> World:
    """Return what may be given of a mechanism's inputs."""
    return World({key.path: key for key in _keys(model)}, tuple(_rules(model)))


def _rules(model: type[Block], prefix: str = "") -> Iterator[tuple[str, OneOf]]:
    yield from ((prefix, rule) for rule in model.one_of)
    for name, declared in model.model_fields.items():
        block = nested(declared.annotation)
        if block and not block[1]:
            yield from _rules(block[0], f"{prefix}{name}.")


def _keys(model: type[Block], prefix: str = "", home: str = "") -> Iterator[Key]:
    for name, declared in model.model_fields.items():
        block, meta, path = nested(declared.annotation), meta_of(model, name), f"{prefix}{name}"
        default = declared.get_default(call_default_factory=True)
        from_press = isinstance(meta, Quantity) and meta.press is not None and not meta.press.optional
        is_empty = declared.is_required() or default is None or default == []
        may_be_none = type(None) in get_args(declared.annotation)  # with a default too: a model may put it to None
        absent = not declared.is_required() and (default == [] or may_be_none) and not from_press
        yield Key(
            path,
            meta,
            declared.annotation,
            bool(block),
            absent,
            home,
            tuple(allowed(declared.annotation, meta)),
            not is_empty,
        )
        if block:
            yield from _keys(block[0], f"{path}.", path if block[1] else home)


def allowed(annotation: Any, meta: Meta | None) -> Iterable[str]:
    """Return the texts that an input may be, as they stand in tokens; none where it takes any."""
    if isinstance(meta, Text) and meta.options:
        return tuple(meta.options)
    found: list[str] = []
    for part in (annotation, *get_args(annotation)):
        if get_origin(part) is Literal:
            found += [str(text).lower() if isinstance(text, bool) else str(text) for text in get_args(part)]
        elif part is bool:
            found += ["true", "false"]
    return found


def told(given: Mapping[str, Given], tokens: Iterable[str]) -> str:
    """Return in words what is given, of the inputs that tokens name; empty where there is none."""
    paths = dict.fromkeys(token.partition("=")[0] for token in tokens)
    words = []
    for path in sorted(path for path in paths if path in given):
        text = given[path]
        given_text = f"{path}={text}" if text not in (GIVEN, OTHER) else path
        words.append(Phrase("without {path}", path=path) if text is None else Phrase("with {given}", given=given_text))
    return joined(words, " and ")
