"""A configuration that begins with chosen kinds: which mechanisms it has, their values, and its text."""

from __future__ import annotations

from collections import ChainMap
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from diecut_report.config.discovery import Discovery, DuplicateKind, UnknownKind
from diecut_report.config.model import Press, Project
from diecut_report.config.validation import keys_of
from diecut_report.contract.inputs import Block
from diecut_report.contract.mechanism import Mechanism
from diecut_report.drafting.blocks import BlockWriter
from diecut_report.drafting.choices import Drafted, by_kind, chosen, free_name
from diecut_report.drafting.explanations import Explained
from diecut_report.drafting.guesses import completed, unguessed
from diecut_report.drafting.layout import DraftLine, laid_out, remarks, shifted
from diecut_report.drafting.scalars import typed
from diecut_report.drafting.wiring import NeedsKind, Wiring
from diecut_report.errors import PluginError
from diecut_report.languages.catalogues import SOURCE_LANGUAGE
from diecut_report.languages.phrases import Phrase
from diecut_report.languages.speech import said, say, spoken_language

PRESS: Mapping[str, Any] = {
    "productivity": "6000 1/h",
    "sheet": {"length": "700 mm", "width": "470.7 mm", "thickness": "0.6 mm"},
}
"""The press of source 000; an example may be made for another one."""


@dataclass(frozen=True)
class Draft:
    """Hold the text of a configuration, and what is to be told of it.

    ``added`` are mechanisms that others cannot be without, each with the one that asks for it; ``guessed`` the keys whose values no
    example gives, ``open`` those that have no value.
    """

    text: str
    mechanisms: tuple[Drafted, ...]
    added: tuple[tuple[Drafted, Drafted], ...]
    guessed: tuple[str, ...]
    open: tuple[str, ...]


@dataclass
class _Drafting:
    """Brings the mechanisms together that a draft has, and the values of their keys."""

    discovery: Discovery
    mechanisms: list[Drafted]
    added: list[tuple[Drafted, Drafted]] = field(default_factory=list)
    values: dict[str, dict[str, Any]] = field(default_factory=dict)

    def wire(self) -> None:
        """Find the values of all mechanisms, with those of other kinds that they cannot be without."""
        while (lacking := self._wired()) is not None:
            self.mechanisms.append(lacking)

    def _wired(self) -> Drafted | None:
        """Wire all mechanisms; return one that is to be added before, None where nothing is missing."""
        names = by_kind(self.mechanisms)
        for each in self.mechanisms:
            example = each.mechanism.example
            try:
                self.values[each.name] = Wiring(names, each).inputs(example.inputs) if example else {}
            except NeedsKind as need:
                mechanism = self._mechanism(need.kind, each)
                new = Drafted(free_name(mechanism, [m.name for m in self.mechanisms]), need.kind, mechanism)
                self.added.append((new, each))
                return new
        return None

    def _mechanism(self, kind: str, asking: Drafted) -> Mechanism:
        try:
            return self.discovery.mechanism(kind)
        except (UnknownKind, DuplicateKind) as fault:
            words = Phrase("its example cannot be without another mechanism: {fault}", fault=str(fault))
            raise PluginError(words, asking.kind, asking.name) from fault


def draft(given: Sequence[str], discovery: Discovery, file: str = "my_press.yaml") -> Draft:
    """Return a configuration of mechanisms such as ``clutch`` and ``clutch:main``, in the language that is spoken.

    ``file`` is what it is to be called.
    """
    made = _Drafting(discovery, chosen(given, discovery))
    made.wire()
    values = {each.name: completed(each.mechanism.inputs, made.values[each.name]) for each in made.mechanisms}
    guessed = [f"{name}.{key}" for name, found in values.items() for key in found if key not in made.values[name]]
    lacking = [
        f"{each.name}.{key}" for each in made.mechanisms for key in unguessed(each.mechanism.inputs, values[each.name])
    ]
    text = "\n".join([*_head(made.mechanisms, file), *_mechanisms(made.mechanisms, values)]) + "\n"
    return Draft(text, tuple(made.mechanisms), tuple(made.added), tuple(guessed), tuple(lacking))


# --- text ------------------------------------------------------------------------------------------------------------


def _head(mechanisms: Sequence[Drafted], file: str) -> Iterator[str]:
    titles = [said(each.mechanism.title, each.kind) for each in mechanisms]
    yield from remarks("\n".join(dict.fromkeys(titles)))
    yield "#"
    yield f"#   diecut-report report {file} -o build"
    yield "#"
    yield from remarks(say(
        "Each line has a key, its value, and its symbol, meaning and range. A quantity carries its unit (40 mm, 0.07 m, 21 kN); a bare "
        "number is in the unit that stands here. {reference} takes a number or a curve of another mechanism or of the press. Values with "
        "`basis: assumed` are those of an example: put in your own, without the braces, and the report no longer counts them as assumed. "
        "Lines behind # are optional: remove the first # of such a line, and put in a value where … stands.",
        reference="${NAME.QUANTITY}",
    ))  # fmt: skip
    yield ""
    yield "schema_version: 1"
    yield ""
    yield from _block("project", say("what the title block of every sheet says"), Project, _project())
    yield ""
    yield from _block("press", say("what all mechanisms share"), Press, _press(mechanisms))


def _project() -> dict[str, Any]:
    language = spoken_language()
    return {"title": say("New press")} | ({"language": language} if language != SOURCE_LANGUAGE else {})


def _press(mechanisms: Sequence[Drafted]) -> dict[str, Any]:
    """The values of the press: those that the examples are made for, the first first, where none of them is of the usual press."""
    found: dict[str, Any] = {"name": say("My press"), **PRESS, "sheet": dict(PRESS["sheet"])}
    own = [
        each.mechanism.example.press for each in mechanisms if each.mechanism.example and each.mechanism.example.press
    ]
    for path, value in ChainMap(*map(dict, own)).items() if len(own) == len(mechanisms) else ():
        home, _, key = path.rpartition(".")
        (found[home] if home else found)[key] = value
    return found


def _block(name: str, words: str, model: type[Block], data: Mapping[str, Any]) -> Iterator[str]:
    written = BlockWriter(Explained()).lines(model, data)
    if model is Project:  # whose list of revisions stands in one line
        written = _project_lines(data)
    yield f"{name}: # {words}"
    yield from laid_out(list(shifted(written, 2)))


def _project_lines(data: Mapping[str, Any]) -> Iterator[DraftLine]:
    writer = BlockWriter(Explained())
    yield from writer.given(Project, data)
    single = [name for name, known in keys_of(Project).items() if known.block is None]
    off = [line for line in writer.off(Project, data) if line.code.partition(":")[0] in single]
    yield from off


def _mechanisms(mechanisms: Sequence[Drafted], values: Mapping[str, Mapping[str, Any]]) -> Iterator[str]:
    yield ""
    yield "mechanisms:"
    for number, each in enumerate(mechanisms):
        if number:
            yield ""
        yield from remarks(f"{said(each.mechanism.title, each.kind)}. {said(each.mechanism.summary, each.kind)}", 2)
        yield f"  {each.name}:"
        writer = BlockWriter(Explained(each.kind, each.mechanism))
        kind = DraftLine(0, f"kind: {typed(each.kind)}")
        body = [kind, *writer.lines(each.mechanism.inputs, values[each.name])]
        yield from laid_out(list(shifted(body, 4)))
