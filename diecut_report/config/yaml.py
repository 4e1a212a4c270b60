"""Safe YAML with positions: plain data, and for every value the line, the column and the text as typed.

The tree is built from PyYAML's event stream, never by its constructors: no object is made from a tag, nothing
recurses deeper than MAX_DEPTH, and an alias is a second way to the same node instead of a copy.

Plain scalars follow the YAML 1.2 core schema, a little narrower: null, true and false, decimal integers (010 is ten)
and floats (1e5 too). All else is text: yes, on, dates, 1:30, 0x10, .inf, .nan. What stands in quotes is text.
Merge keys (<<) and tags are refused.
"""

from __future__ import annotations

import hashlib
import json
import math
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import islice, pairwise
from pathlib import Path
from typing import Any, NoReturn

import yaml

from diecut_report.errors import MAX_CURVE_VALUES, MAX_MECHANISMS, MAX_PARTS, MAX_SHOWN, MAX_TEXT, Problem, UserError
from diecut_report.files import content
from diecut_report.text.phrases import Phrase, phrase


def syntax_problem(error: Any, text: str, file: str) -> Problem:
    """Return what is told of a text that is not YAML, with the place where it is to be mended."""
    # a quote that is never closed is mended where it begins
    mark = error.context_mark if "end of stream" in error.problem and error.context_mark else error.problem_mark
    line = [*text.splitlines(), ""][mark.line]
    indentation = len(line) - len(line.lstrip())
    tab = line.find("\t", 0, max(indentation, mark.column + 1))
    if tab in range(indentation) or tab == mark.column:
        return Problem(phrase("A tab stands here; YAML is indented with spaces. Put spaces."), file, mark.line + 1, tab + 1)  # fmt: skip
    return Problem(Phrase("This is not valid YAML: {explained}", explained=_explained(error, line)), file, mark.line + 1,
        mark.column + 1)  # fmt: skip


def _explained(error: Any, line: str) -> str:
    if "mapping values are not allowed" in error.problem:
        return phrase("a second colon or a wrong indentation. Align keys of one block; put text that holds ': ' in quotes.")  # fmt: skip
    begin = Phrase(" that begins in line {line}", line=error.context_mark.line + 1) if error.context_mark else ""
    said = f"{error.problem} {error.context}{begin}" if error.context else error.problem
    if "${" in line and "flow" in (error.context or ""):
        return phrase('a reference stands in braces or brackets without quotes, and YAML reads its brace as a map. Quote it: "${…}".')  # fmt: skip
    return Phrase("{said}. Check quotes, brackets and indentation here and just above.", said=said)


def decimal_commas(entries: Sequence[Any]) -> Iterator[tuple[int, Phrase]]:
    """Yield where a list within brackets has a number that a decimal comma parts, as in [9,5 mm, 10 mm], with what is told of it.

    [1,2,3] is a list of three: the comma is suspected where others are followed by a space, or where a unit stands behind it.
    """
    glued = [_is_glued(one, other) for one, other in pairwise(entries)]
    for index, is_glued in enumerate(glued):
        following = entries[index + 1].value if is_glued else ""
        if is_glued and (not all(glued) or not re.fullmatch(r"[\d.eE+-]+", following)):
            template = "{typed} is read as two values. Write a decimal point, or a space after the comma."
            yield index, Phrase(template, typed=f"{entries[index].value},{following}")


def _is_glued(one: Any, other: Any) -> bool:
    """Whether a whole number and what begins with a digit stand with nothing but a comma between them."""
    if not all(isinstance(each, yaml.ScalarEvent) and each.implicit[0] for each in (one, other)):
        return False
    beside = other.start_mark.index == one.end_mark.index + 1
    return beside and bool(re.fullmatch(r"[-+−]?\d+", one.value) and re.match(r"\d", other.value))


# Letters that no text of a user may hold: they act on a terminal, break a document, or make a text look like another one.


_BIDI = "\u202a-\u202e\u2066-\u2069"  # they turn the letters after them around

CONTROL = re.compile(f"[^\t\n\r\x20-\x7e\x85\xa0-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]|[{_BIDI}]")
"""What a file as a whole may not hold."""
SECOND_MARK = re.compile("\ufeff")
"""What stands at the beginning where the mark of the byte order, which is not part of the text, stands twice."""
INVISIBLE = re.compile(
    "[\u00ad\u034f\u061c\u115f\u1160\u17b4\u17b5\u180b-\u180f\u200b-\u200f\u202a-\u202e\u2060-\u206f\u2800\u3164\ufe00-\ufe0f\ufeff"
    "\uffa0\ufff0-\ufffb\U0001bca0-\U0001bca3\U0001d173-\U0001d17a\U000e0000-\U000e0fff]"
)
"""What stands in a text unseen: Default_Ignorable_Code_Point of Unicode, marks of annotations, and the empty Braille pattern."""
FORBIDDEN = re.compile(f"{CONTROL.pattern}|{INVISIBLE.pattern}|[\x85\u2028\u2029]")
"""What a decoded text may not hold; an escape may bring NEL, and separators that end a line for some readers and not for others."""
FORBIDDEN_IN_KEY = re.compile(f"{FORBIDDEN.pattern}|[\t\n\r]")
"""What a decoded key may not hold."""


def forbidden_character(text: str) -> str:
    """Return the name of a letter that the text of a value may not hold, such as U+001B; "" where there is none."""
    found = FORBIDDEN.search(text)
    return f"U+{ord(found[0]):04X}" if found else ""


def printable(name: str) -> str:
    """Return a name without what no document can show: control and invisible characters, and bytes that are not UTF-8."""
    instead = "\N{REPLACEMENT CHARACTER}"
    return "".join(each if each.isprintable() and not INVISIBLE.match(each) else instead for each in name)


MAX_BYTES = 5_000_000
MAX_DEPTH = 50
MAX_VALUES = 200_000

KeyPath = tuple[str | int, ...]
Position = tuple[int, int]

LOADER: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
_WORDS: dict[str, bool | None] = dict.fromkeys(["", "~", "null", "Null", "NULL"])
_WORDS |= {word: word.lower() == "true" for word in ("true", "True", "TRUE", "false", "False", "FALSE")}
_PLACE = re.compile(r"[0-9]{1,6}")  # in a list, within a path
_INTEGER = re.compile(r"[-+]?[0-9]{1,300}")
_FLOAT = re.compile(r"[-+]?(?:\.[0-9]+|[0-9]+(?:\.[0-9]*)?)(?:[eE][-+]?[0-9]+)?")


def dotted(key: KeyPath) -> str:
    """Return a key without its places in lists: ``("loads", 1, "torque")`` → ``loads.torque``."""
    return ".".join(part for part in key if isinstance(part, str))


def key_of(path: str) -> KeyPath:
    """Return the key that a dotted path names, with its places in lists: ``loads.1.torque`` → ``("loads", 1, "torque")``."""
    return tuple(int(part) if _PLACE.fullmatch(part) else part for part in path.split("."))


@dataclass
class YamlNode:
    """One value of the file: its place (from 1), its content, and its size and depth with all aliases expanded."""

    position: Position
    scalar: Any = None
    typed: str | None = None
    children: dict[str | int, YamlNode] | None = None
    is_list: bool = False
    key_positions: dict[str | int, Position] = field(default_factory=dict)
    size: int = 1
    depth: int = 0

    def add(self, key: str | int, child: YamlNode) -> None:
        """Put a child in, or only account for it where the key is there already."""
        self.size += child.size
        self.depth = max(self.depth, child.depth + 1)
        if self.children is not None:
            self.children.setdefault(key, child)

    def plain(self) -> Any:
        """Dicts, lists and scalars of its own: nothing is shared between two aliases."""
        if self.children is None:
            return self.scalar
        plain = {key: child.plain() for key, child in self.children.items()}
        return list(plain.values()) if self.is_list else plain


class Tree:
    """A YAML file as data, with its places.

    `data` holds plain dicts, lists and scalars; `text` the file's text; `sha256` its hash; `name` what documents call it;
    `problems` what is wrong with its form, such as keys that stand twice: it is not to be used, but what else is wrong can be told.
    """

    def __init__(
        self, root: YamlNode, file: str, text: str, sha256: str, name: str = "", problems: Sequence[Problem] = ()
    ) -> None:
        self.root = root
        self.data: Any = root.plain()
        self.file, self.name, self.text, self.sha256, self.problems = file, name or file, text, sha256, tuple(problems)

    def position(self, path: KeyPath) -> Position:
        """Line and column (from 1) of the value at `path`, or of its nearest parent that exists.

        Within an alias it is the place where the value is written, at the anchor.
        """
        return self._walk(path)[-1].position

    def key_position(self, path: KeyPath) -> Position:
        """Line and column (from 1) of the key at the end of `path`; for list items and unknown keys as `position`."""
        nodes = self._walk(path)
        if path and len(nodes) == len(path) + 1:
            return nodes[-2].key_positions.get(path[-1], nodes[-1].position)
        return nodes[-1].position

    def offset(self, path: KeyPath, letter: int) -> int:
        """Columns from the beginning of the text at `path` to one of its letters; 0 where the text is not written in one piece."""
        line, column = self.position(path)
        written, text = self.text.splitlines()[line - 1][column - 1 :], self.typed(path) or ""
        quoted = written[:1] in "\"'"
        return letter + quoted if written.startswith(text, quoted) else 0

    def typed(self, path: KeyPath) -> str | None:
        """The scalar at `path` as typed, without quotes; None for a dict, a list, or what is not there."""
        nodes = self._walk(path)
        return nodes[-1].typed if len(nodes) == len(path) + 1 else None

    def node(self, path: KeyPath) -> YamlNode:
        """The value at `path`, or its nearest parent that exists."""
        return self._walk(path)[-1]

    def _walk(self, path: KeyPath) -> list[YamlNode]:
        nodes = [self.root]
        for step in path:
            child = (nodes[-1].children or {}).get(step)
            if child is None:
                break
            nodes.append(child)
        return nodes


def load(path: Path, raw: bytes | None = None) -> Tree:
    """Read a YAML file, or take what it holds. UserError with all that is wrong with it, or the reason why it cannot be read."""
    return _sound(read(path, raw))


def parse(text: str, file: str) -> Tree:
    """The same for a text; `file` is the name that messages show."""
    return _sound(read_text(text, file))


def _sound(tree: Tree) -> Tree:
    if tree.problems:
        raise UserError(tree.problems)
    return tree


def read(path: Path, raw: bytes | None = None) -> Tree:
    """Read a YAML file for a reader who tells the problems of the tree beside its own; UserError where it cannot be read at all."""
    raw = content(path, MAX_BYTES, phrase("a YAML file")) if raw is None else raw
    try:
        text = raw.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = raw.count(b"\n", 0, error.start) + 1
        message = phrase("The file is not UTF-8 text. Give a YAML file, saved as UTF-8.")
        raise UserError(Problem(message, str(path), line)) from error
    return _parse(text, str(path), hashlib.sha256(raw).hexdigest())


def read_text(text: str, file: str) -> Tree:
    """The same for a text; `file` is the name that messages show."""
    return _parse(text, file, hashlib.sha256(text.encode("utf-8")).hexdigest())


def _parse(text: str, file: str, sha256: str) -> Tree:
    if control := SECOND_MARK.match(text) or CONTROL.search(text):
        before = text[: control.start()]
        place = before.count("\n") + 1, len(before) - before.rfind("\n")
        advice = phrase("Write it without.") if control[0] > " " else phrase("This is not YAML text. Give a text file.")
        template = "The control character U+{ord} stands here. {advice}"
        raise UserError(Problem(Phrase(template, ord=f"{ord(control[0]):04X}", advice=advice), file, *place))
    builder = _Builder(file)
    try:
        root = builder.build(yaml.parse(text, Loader=LOADER))
    except yaml.MarkedYAMLError as error:
        raise UserError([*builder.problems, syntax_problem(error, text, file)]) from None
    return Tree(root, file, text, sha256, problems=builder.problems)


class _Builder:
    """Builds the tree of one document and gathers `problems` on the way; UserError only where going on is senseless."""

    def __init__(self, file: str) -> None:
        self.file = file
        self.problems: list[Problem] = []
        self._anchors: dict[str, YamlNode | None] = {}  # None while the anchored value is still open
        self._values = 0
        self._events: Iterator[Any] = iter(())

    def build(self, events: Iterator[Any]) -> YamlNode:
        self._events = events
        next(events)
        if isinstance(next(events), yaml.StreamEndEvent):
            self._stop(phrase("The file is empty. Write a YAML document."), (None, None))
        root = self._node(next(events), ())
        next(events)
        if isinstance(second := next(events), yaml.DocumentStartEvent):
            self._report(phrase("A second YAML document begins here. Keep one document in a file."), _position(second), ())  # fmt: skip
        if root.typed == "" and not self.problems:
            self._stop(phrase("The file is empty. Write a YAML document."), (None, None))
        return root

    def _report(self, message: str, place: tuple[int | None, int | None], path: KeyPath) -> None:
        self.problems.append(Problem(message, self.file, *place, path=".".join(str(step) for step in path)))

    def _stop(self, message: str, place: tuple[int | None, int | None], path: KeyPath = ()) -> NoReturn:
        self._report(message, place, path)
        raise UserError(self.problems)

    def _node(self, event: Any, path: KeyPath, *, is_key: bool = False) -> YamlNode:
        if isinstance(event, yaml.AliasEvent):
            return self._alias(event, path)
        self._count(1, event, path)
        if event.tag is not None:
            template = "The tag {tag} is not allowed. {advice}"
            tag = event.tag.replace("tag:yaml.org,2002:", "!!")
            advice = phrase("Remove it; put the value in quotes where text is meant.")
            self._report(Phrase(template, tag=tag, advice=advice), _position(event), path)
        if event.anchor is not None:
            self._anchors[event.anchor] = None
        if isinstance(event, yaml.ScalarEvent):
            if not is_key:
                self._refuse_forbidden("text", FORBIDDEN.search(event.value), event, path)
            node = YamlNode(_position(event), resolved(event.value) if event.implicit[0] else event.value, event.value)
        else:
            node = self._collection(event, path)
        if event.anchor is not None:
            self._anchors[event.anchor] = node
        return node

    def _count(self, more: int, event: Any, path: KeyPath) -> None:
        self._values += more
        if self._values > MAX_VALUES:
            message = Phrase("More than {max_values} values, counting repetitions by aliases (*name). Write fewer.",
                max_values=MAX_VALUES)  # fmt: skip
            self._stop(message, _position(event), path)

    def _refuse_forbidden(self, what: str, found: re.Match[str] | None, event: Any, path: KeyPath) -> None:
        """Report what a text holds when it is decoded: escapes within quotes bring what the file itself may not hold."""
        if found:
            words, code = "This {what} holds the invisible character U+{ord}. Write it without.", f"{ord(found[0]):04X}"
            self._report(Phrase(words, what=what, ord=code), _position(event), path)

    def _alias(self, event: Any, path: KeyPath) -> YamlNode:
        name, place = event.anchor, _position(event)
        anchored = self._anchors.get(name)
        if anchored is None:
            fault = Phrase("has no anchor &{name} above it", name=name)
            fault = phrase("stands in its own anchor, a loop") if name in self._anchors else fault
            advice = phrase("Write the value itself, or put text that begins with * in quotes.")
            self._report(Phrase("The alias *{name} {fault}. {advice}", name=name, fault=fault, advice=advice), place, path)  # fmt: skip
            return YamlNode(place, written := f"*{name}", written)  # what refers to it is not to blame
        self._count(anchored.size, event, path)
        self._check_depth(anchored, event, path)
        return anchored

    def _collection(self, event: Any, path: KeyPath) -> YamlNode:
        node = YamlNode(_position(event), children={}, is_list=isinstance(event, yaml.SequenceStartEvent), depth=1)
        self._check_depth(node, event, path)
        entries = []
        while not isinstance(event := next(self._events), (yaml.SequenceEndEvent, yaml.MappingEndEvent)):
            if node.is_list:
                entries.append(event)
                node.add(len(entries) - 1, self._node(event, (*path, len(entries) - 1)))
            else:
                key = self._key(event, node, path)
                node.add(key, self._node(next(self._events), (*path, key)))
        for index, words in decimal_commas(entries):
            self._report(words, _position(entries[index]), (*path, index))
        return node

    def _check_depth(self, node: YamlNode, event: Any, path: KeyPath) -> None:
        if len(path) + node.depth > MAX_DEPTH:
            message = Phrase("The nesting is deeper than {max_depth} levels, aliases included. Flatten it.", max_depth=MAX_DEPTH)  # fmt: skip
            self._stop(message, _position(event), path[:3])

    def _key(self, event: Any, node: YamlNode, path: KeyPath) -> str:
        """The key as text, with a problem reported if it is not text, a merge key, or a duplicate."""
        key, place = self._node(event, (*path, "?"), is_key=True), _position(event)
        text = key.typed if key.typed is not None else "(a list)" if key.is_list else "(a mapping)"
        self._refuse_forbidden("key", FORBIDDEN_IN_KEY.search(text), event, path)
        text = FORBIDDEN_IN_KEY.sub("\N{REPLACEMENT CHARACTER}", text)  # in what is told of values below it
        if not isinstance(key.scalar, str):
            self._report(Phrase("The key {text} is not text. Put it in quotes, or rename it.", text=text or '(empty)'), place, path)  # fmt: skip
        elif text == "<<" and isinstance(event, yaml.ScalarEvent) and event.implicit[0]:
            self._report(phrase("Merge keys (<<) are not supported. Write the keys out, or alias whole values."), place, path)  # fmt: skip
        elif text in node.key_positions:
            first = node.key_positions[text][0]
            template = "The key {text} stands here again; it is first in line {first}. Remove one of the two."
            message = Phrase(template, text=repr(text), first=first)
            self._report(message, place, (*path, text))
        node.size += key.size
        node.key_positions.setdefault(text, place)
        return text


def _position(event: Any) -> Position:
    return event.start_mark.line + 1, event.start_mark.column + 1


def resolved(text: str) -> Any:
    """Return the value of a plain scalar by the core schema."""
    if text in _WORDS:
        return _WORDS[text]
    if _INTEGER.fullmatch(text):
        return int(text)
    value = float(text) if _FLOAT.fullmatch(text) else math.inf
    return value if math.isfinite(value) else text


SIGNS = ",[]{}#:&*!|>'\"%@`\n"  # of YAML, or within its braces


def plain_text(text: str) -> str:
    """Return a text as it is typed: in quotes where it would be read as something else."""
    is_plain = text == text.strip() and resolved(text) == text and not any(sign in text for sign in SIGNS)
    return text if is_plain and not text.startswith(("-", "?")) else json.dumps(text, ensure_ascii=False)


# A YAML tree with other values in some of its places, and a tree written as text that reads back as the same tree.


Scalar = str | int | float


def with_values(tree: Tree, values: Mapping[KeyPath, Scalar], name: str, heading: str) -> Tree:
    """Return the tree with these values, each at the place of what it stands for; blocks that are missing are made.

    ``name`` is what documents call it, ``heading`` the comment above its text; messages name the tree's own file and lines.
    """
    root = tree.root
    for path, value in values.items():
        if isinstance(value, str) and (found := forbidden_character(value)):
            template = "The value that is to stand here holds the invisible character {found}; it is not taken."
            raise UserError(Problem(Phrase(template, found=found), tree.file, path=".".join(map(str, path))))
        root = _changed(root, path, value)
    text = f"# {heading}\n{as_text(root)}"
    return Tree(root, tree.file, text, hashlib.sha256(text.encode()).hexdigest(), name)


def with_root(tree: Tree, root: YamlNode) -> Tree:
    """Return the file with other data, whose places are those of the file's text, which stays."""
    return Tree(root, tree.file, tree.text, tree.sha256, tree.name, tree.problems)


def with_value(tree: Tree, path: KeyPath, value: Any) -> Tree:
    """Return the file with plain data at a path, or put into its block there; the places stay those of the file."""
    return with_root(tree, _changed(tree.root, path, value))


def _changed(node: YamlNode, path: KeyPath, value: Any) -> YamlNode:
    """Return a copy of the node with the value below it: an alias of the node keeps what it has."""
    if not path:
        return _node_of(value, node.position)
    children = node.children or {}
    changed = _changed(children.get(path[0], YamlNode(node.position)), path[1:], value)
    return replace(node, scalar=None, typed=None, children=children | {path[0]: changed})


def _node_of(value: Any, position: Position) -> YamlNode:
    if not isinstance(value, dict | list):
        return YamlNode(position, value, str(value))
    parts = value.items() if isinstance(value, dict) else enumerate(value)
    children: dict[str | int, YamlNode] = {key: _node_of(part, position) for key, part in parts}
    return YamlNode(
        position, children=children, is_list=isinstance(value, list), key_positions=dict.fromkeys(children, position)
    )


def as_text(root: YamlNode) -> str:
    """Return the tree as YAML; comments, anchors and the layout of the file that it was read from are not kept."""
    ends = yaml.DocumentEndEvent(), yaml.StreamEndEvent()
    events = [yaml.StreamStartEvent(), yaml.DocumentStartEvent(), *_events(root), *ends]
    text: str = yaml.emit(events, allow_unicode=True, width=math.inf)
    return text


def _events(node: YamlNode) -> Iterator[Any]:
    if node.children is None:
        yield _scalar(node.scalar, node.typed)
        return
    start: Any = yaml.SequenceStartEvent if node.is_list else yaml.MappingStartEvent
    yield start(anchor=None, tag=None, implicit=True, flow_style=not node.children)
    for key, child in node.children.items():
        if not node.is_list:
            yield _scalar(key, str(key))
        yield from _events(child)
    yield yaml.SequenceEndEvent() if node.is_list else yaml.MappingEndEvent()


def _scalar(value: Any, typed: str | None) -> Any:
    """Return a scalar as it was typed; a text that would be read as something else stands in quotes."""
    text = "null" if value is None else str(typed)
    is_other = isinstance(value, str) and resolved(text) != text
    return yaml.ScalarEvent(None, None, (not is_other, True), text, style='"' if is_other else None)


# What is too much in a config: long texts, long lists, many mechanisms. Told before anything is made of it.


def too_much(tree: Tree) -> list[Problem]:
    """Return what a config holds too much of, in words; the first of them where there are many."""
    found: list[Problem] = []
    for path, message in islice(_excess(tree.data, ()), MAX_SHOWN):
        parts = (part if len(part := str(step)) <= MAX_TEXT else f"{part[:40]}…" for step in path)
        found.append(Problem(message, tree.file, *tree.position(path), ".".join(parts)))
    return found


def _excess(data: Any, path: KeyPath) -> Iterator[tuple[KeyPath, str]]:
    match data:
        case str() if len(data) > MAX_TEXT:
            template = "has {count} characters; at most {max_text} are allowed. Shorten it."
            yield (path, Phrase(template, count=len(data), max_text=MAX_TEXT))
        case dict():
            if path == ("mechanisms",) and len(data) > MAX_MECHANISMS:
                template = "has {count} mechanisms; at most {max_mechanisms} are allowed. Split the configuration."
                yield (path, Phrase(template, count=len(data), max_mechanisms=MAX_MECHANISMS))
                return
            for key, part in data.items():
                if len(key) > MAX_TEXT:
                    template = "is a key of {count} characters; at most {max_text} are allowed. Shorten it."
                    yield ((*path, key), Phrase(template, count=len(key), max_text=MAX_TEXT))
                else:
                    yield from _excess(part, (*path, key))
        case list():
            most = MAX_PARTS if any(isinstance(part, dict | list) for part in data) else MAX_CURVE_VALUES
            if len(data) > most:
                template = "has {count} entries; at most {most} are allowed. Give fewer."
                yield (path, Phrase(template, count=len(data), most=most))
                return
            for index, part in enumerate(data):
                yield from _excess(part, (*path, index))
