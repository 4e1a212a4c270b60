"""What a reader has been told already: formulas of this chapter, and all of an earlier chapter of the same kind. Nothing is printed twice."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

Data = Mapping[str, Any]
SAME = (
    "type",
    "symbol",
    "equation",
    "relation",
    "condition",
    "words",
    "operation",
    "of",
    "method",
    "key",
    "column",
    "table",
    "by",
    "where",
)
FEWEST = 5  # operations of a formula that is rather named than printed again with other letters
MANY = 7  # formulas of one form in a section, of which a short one, too, is printed once: the ratios of drives that are compared
MOST_LETTERS = 4  # that differ


class Reference(NamedTuple):
    """Where a formula stands, and which letters take the place of which there."""

    number: str
    letters: tuple[tuple[str, str], ...] = ()


class _KnownFormula(NamedTuple):
    number: str
    item: Data
    letters: tuple[str, ...]  # of its tree, each once, in their order


@dataclass
class ToldBefore:
    """Remembers the formulas, texts and symbols of a chapter; ``letter`` is that of the earlier chapter of the same kind."""

    letter: str = ""
    steps: dict[str, _KnownFormula] = field(default_factory=dict)
    named: dict[str, tuple[Data, Reference]] = field(
        default_factory=dict
    )  # steps that only name where their formula stands
    texts: set[str] = field(default_factory=set)
    shapes: dict[str, _KnownFormula] = field(default_factory=dict)
    repeated: set[str] = field(default_factory=set)  # forms of short formulas that fill the section

    def begin(self, items: Sequence[Data]) -> None:
        """Learn which short formulas fill the section that begins."""
        counted = Counter(_shape(item)[0] for item in items)
        self.repeated = {shape for shape, count in counted.items() if shape and count >= MANY}

    def next(self, letter: str) -> ToldBefore:
        """What is known when another chapter of this kind begins; ``letter`` is this one's."""
        return ToldBefore(self.letter or letter, dict(self.steps), dict(self.named), set(self.texts))

    def find(self, item: Data) -> Reference | None:
        """Where the same step of an earlier chapter stands, or the same formula of this one."""
        name = item.get("id", "")
        before, named = self.steps.get(name), self.named.get(name)
        if before and _are_same(before.item, item):
            return Reference(before.number)
        if named and _are_same(named[0], item):
            return named[1]
        shape, letters = self._named_form(item)
        known = self.shapes.get(shape) if shape else None
        if known is None:
            return None
        differing = tuple(pair for pair in zip(letters, known.letters, strict=True) if pair[0] != pair[1])
        is_plain = not {new for new, _ in differing} & {old for _, old in differing}  # no letters change places
        return Reference(known.number, differing) if is_plain and len(differing) <= MOST_LETTERS else None

    def keep(self, item: Data, number: str) -> None:
        """Remember a step that is printed."""
        shape, letters = self._named_form(item)
        formula = _KnownFormula(number, item, letters)
        if "id" in item:
            self.steps.setdefault(item["id"], formula)
        if shape:
            self.shapes.setdefault(shape, formula)

    def _named_form(self, item: Data) -> tuple[str, tuple[str, ...]]:
        """The form of a formula and its letters, where it is rather named than printed again."""
        shape, letters = _shape(item)
        is_named = shape in self.repeated or (shape and _operations(item["equation"]) >= FEWEST)
        return (shape, letters) if is_named else ("", ())

    def keep_named(self, item: Data, reference: Reference) -> None:
        """Remember a step of which only is said where its formula stands: the next chapter says the same."""
        if "id" in item and item["id"] not in self.steps:
            self.named.setdefault(item["id"], (item, reference))

    def new(self, texts: Sequence[str]) -> list[str]:
        """Those of the texts that were not told; they are now."""
        found = [text for text in texts if text not in self.texts]
        self.texts.update(texts)
        return found


def _are_same(one: Data, other: Data) -> bool:
    return all(one.get(key) == other.get(key) for key in SAME)


def _shape(item: Data) -> tuple[str, tuple[str, ...]]:
    """A formula with its letters numbered, and the letters; nothing of one that stands for several."""
    tree = item.get("equation")
    if item["type"] != "formula" or not tree or item.get("where"):
        return "", ()
    letters = tuple(dict.fromkeys(_letters(tree)))
    places = {letter: index for index, letter in enumerate(letters)}
    return json.dumps(_numbered(tree, places), ensure_ascii=False), letters


def _is_letter(tree: Any) -> bool:
    return isinstance(tree, list) and len(tree) == 2 and tree[0] == "sym"


def _letters(tree: Any) -> Iterator[str]:
    if _is_letter(tree):
        yield tree[1]
    elif isinstance(tree, list):
        for part in tree:
            yield from _letters(part)


def _numbered(tree: Any, places: Mapping[str, int]) -> Any:
    if _is_letter(tree):
        return places[tree[1]]
    return [_numbered(part, places) for part in tree] if isinstance(tree, list) else tree


def _operations(tree: Any) -> int:
    """How many operations a tree holds."""
    if not isinstance(tree, list) or _is_letter(tree) or tree[:1] in (["num"], ["qty"]):
        return 0
    return (isinstance(tree[0], str) if tree else 0) + sum(_operations(part) for part in tree)
