"""What a live page shows and changes: the file as it stands, numbers changed on the page over it, and the last machine that could be calculated."""

from __future__ import annotations

import asyncio
import os
import re
import sys
import tempfile
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, NamedTuple

from diecut_report.config import yaml
from diecut_report.config.loader import Config
from diecut_report.config.parts.reading import typed_changes, typed_text
from diecut_report.config.plugins import Discovery, said
from diecut_report.config.references import as_file, rewritten
from diecut_report.config.validation import value_at
from diecut_report.config.yaml import KeyPath, Tree, YamlNode, dotted, plain_text
from diecut_report.design.inputs import (
    DesignInput,
    choices_at_default,
    given_choices,
    given_numbers,
    given_words,
    inputs_of_parts,
    numbers_at_default,
)
from diecut_report.errors import PluginError, Problem, UserError, own_fault, refusal
from diecut_report.files import write
from diecut_report.press import Press
from diecut_report.quantities.units import UnitError, number_and_unit, parse_quantity, with_point
from diecut_report.results.warm_press import WarmPress, WarmRun
from diecut_report.study.definition.base_inputs import MECHANISMS
from diecut_report.text.phrases import phrase
from diecut_report.text.translation import say
from diecut_report.time_limit import MECHANISM_SECONDS, Overran, limited

Data = dict[str, Any]
MAX_TYPED_LENGTH = 100  # letters of a number that is typed on the page
MAX_EDITS = 1_000
MAX_STEPS = 500  # that can be undone
MAX_STATES = 20
INITIALLY, NOW = phrase("Initially"), phrase("Now")
STATE_NAME = re.compile(r"\w(?:[\w .,+=-]{0,38}[\w])?")  # also the name of a file


@dataclass(frozen=True)
class LiveMachine:
    """Hold a machine that could be calculated: the file that it was read from, that with the changes of the page, its configuration and its run.

    ``inputs`` are those that may be changed, by name; ``of_parts`` the names of those at the parts, by the mechanisms that are made of them.
    """

    tree: Tree
    changed: Tree
    config: Config
    run: WarmRun
    inputs: Mapping[str, DesignInput]
    of_parts: Mapping[str, frozenset[str]]


class _PlaceBefore(NamedTuple):
    """Hold what stood in the file where a number was changed on the page: what tells its items of lists from others, and its text."""

    items: list[object]
    typed: str | None


class _Step(NamedTuple):
    """Hold the changes of the page at a time, with what stood there."""

    edits: dict[str, str]
    found: dict[str, _PlaceBefore]


class LiveSession:
    """Keep a configuration calculated while it is changed. Not for several threads at a time.

    ``faults`` is what is wrong now; ``machine`` is the last machine that could be calculated (None before the first), ``start``
    the first. ``edits`` are the numbers changed on the page and not written, by the names of their inputs, as typed; ``past`` and
    ``future`` what they were before each step, and before it was undone. ``states`` are machines kept under a name.
    """

    def __init__(self, file: Path, discovery: Discovery) -> None:
        self.file, self.discovery = file, discovery
        self.tree: Tree | None = None
        self.machine: LiveMachine | None = None
        self.start: LiveMachine | None = None
        self.faults: list[Problem] = []
        self.edits: dict[str, str] = {}
        self.past: list[_Step] = []
        self.future: list[_Step] = []
        self.states: dict[str, LiveMachine] = {}
        self.serial = 0
        self._saved: set[str] = set()
        self._stroke = ""
        self._places: dict[str, KeyPath] = {}
        self._texts: set[KeyPath] = set()
        self._found: dict[str, _PlaceBefore] = {}
        self._press = WarmPress(is_advised=False)  # a hand does not wait for advice: the page asks for it
        self._read: dict[Path, object] = {}
        self.read()

    @property
    def files(self) -> set[Path]:
        """Return the files whose change matters: the configuration, and the tables and the logo that it names."""
        named = self.machine.config.files if self.machine else ()
        return {self.file, *(self.file.parent / name for name in named)}

    @property
    def machines(self) -> dict[str, LiveMachine]:
        """Return the machines that can be compared: the first, those that were kept, and the one that is shown."""
        if self.start is None or self.machine is None:
            return {}
        return {say(INITIALLY): self.start, **self.states, say(NOW): self.machine}

    def is_stale(self) -> bool:
        """Return whether the files are others than those that were read. Any thread may ask."""
        return self._read != self.marks()

    def read(self) -> None:
        """Read the file again and calculate; changes of the page stay over it, but those that stand in it now."""
        self._read = self.marks()  # before the reading: what is saved meanwhile is another
        try:
            self.tree = yaml.read(self.file)
        except UserError as error:
            self.tree = None  # what the page changes then is calculated when the file can be read again
            self._failed(error.problems)
            return
        self._forget_written()
        self._calculate()

    def _forget_written(self) -> None:
        if self.tree is not None:
            in_file = {name: typed_text(self.tree, self._places[name]) for name in self.edits}
            self.edits = {
                name: typed for name, typed in self.edits.items() if in_file[name] != typed or self._is_moved(name)
            }

    def marks(self) -> dict[Path, object]:
        """Return by what each file is known to be another. Any thread may ask."""
        found: dict[Path, object] = {}
        for file in self.files:
            try:
                about = file.stat()
            except OSError as error:
                found[file] = error.errno
            else:
                found[file] = about.st_ino, about.st_mtime_ns, about.st_size
        return found

    def change(self, changes: Mapping[str, str], stroke: str = "") -> None:
        """Take values of the page, as typed, by the names of their inputs; UserError where one is not a value of its input.

        All changes of one ``stroke``, such as the move of a slider, are one step for ``undo``.
        """
        if (machine := self.machine) is None:
            raise refusal("Nothing can be changed before the file can be calculated.", self.file)
        taken = {name: self._judged(machine, name, typed.strip()) for name, typed in changes.items()}
        if len(self.edits.keys() | taken.keys()) > MAX_EDITS:
            raise refusal("At most {n} numbers can be changed before they are written to the file.", n=MAX_EDITS)
        self._begin_step(stroke)
        for name, typed in taken.items():
            self._places[name] = machine.inputs[name].stands
            if machine.inputs[name].is_text and typed not in ("true", "false"):  # 6017 is a number unless it has quotes
                self._texts.add(self._places[name])
            self._edit(machine.tree, name, typed)
        self._forget_written()
        self._calculate()

    def take_back(self, names: Iterable[str] | None = None) -> None:
        """Forget changes of the page: these, or all."""
        self._begin_step()
        for name in list(self.edits) if names is None else names:
            self.edits.pop(name, None)
        self._calculate()

    def undo(self) -> None:
        """Go back by a step; nothing where there is none."""
        self._go(self.past, self.future)

    def redo(self) -> None:
        """Go forward again by a step that was undone; nothing where there is none."""
        self._go(self.future, self.past)

    def _go(self, steps: list[_Step], others: list[_Step]) -> None:
        if steps:
            others.append(self._step)
            (self.edits, self._found), self._stroke = steps.pop(), ""
            self._calculate()

    @property
    def _step(self) -> _Step:
        return _Step(dict(self.edits), dict(self._found))

    def _begin_step(self, stroke: str = "") -> None:
        if not stroke or stroke != self._stroke:
            self.past = [*self.past, self._step][-MAX_STEPS:]
        self.future, self._stroke = [], stroke

    def _edit(self, tree: Tree, name: str, typed: str) -> None:
        if name not in self.edits:  # by what the page shows, which the file may not be any more
            place = self._places[name]
            self._found[name] = _PlaceBefore(_items(tree, place), typed_text(tree, place))
        self.edits[name] = typed

    def keep(self, name: str) -> None:
        """Keep the machine as it is shown under a name; UserError where there is none, or the name is taken or cannot be that of a file."""
        if self.machine is None or self.faults:
            raise refusal("This machine cannot be calculated and is not kept; see the errors.", self.file)
        if not STATE_NAME.fullmatch(name):
            template = "{name} cannot be the name of a state, which may become that of a file: use up to 40 letters, digits, spaces and .,+=-_"
            raise refusal(template, name=repr(name))
        if f"{name}.yaml" in _beside(self.machine.config):
            raise refusal(
                "The configuration names a file {name}. Keep the state under another name.", name=repr(f"{name}.yaml")
            )
        if name in self.machines:
            raise refusal("There is a state {name} already; remove it first.", name=repr(name))
        if len(self.states) == MAX_STATES:
            raise refusal("At most {n} states can be kept; remove one first.", n=MAX_STATES)
        self.states[name] = self.machine
        self.serial += 1

    def forget(self, name: str) -> None:
        """Remove a state that was kept."""
        self._state(name)
        del self.states[name]
        self._saved.discard(name)
        self.serial += 1

    def return_to(self, name: str) -> None:
        """Make the changes those of a state; UserError where the file, or one that it names, has been changed since in other places."""
        kept, file = self._state(name).changed, self.tree
        self._require_same_beside(name)
        if file is None:
            raise refusal("Nothing can be changed before the file can be calculated.", self.file)
        edits = self._edits(kept, file)
        if self._with(file, {self._places[each]: typed for each, typed in edits.items()}).data != kept.data:
            template = (
                "The file has been changed since {name} was kept. Save the state as a file of its own, and open that."
            )
            raise refusal(template, self.file, name=repr(name))
        self._begin_step()
        self.edits = {}
        for each, typed in edits.items():
            self._edit(file, each, typed)
        self._calculate()

    def _edits(self, kept: Tree, file: Tree) -> dict[str, str]:
        """The numbers changed on the page, now or before they were written, that stand otherwise in a state than in the file."""
        typed = {each: typed_text(kept, place) or "" for each, place in self._places.items()}
        return {each: text for each, text in typed.items() if text and text != typed_text(file, self._places[each])}

    def _require_same_beside(self, name: str) -> None:
        """Raise UserError where the tables or the logo of a state are not those that lie there now."""
        for beside, content in _beside(self._state(name).config).items():
            place = self.file.with_name(beside)
            with suppress(OSError):  # what cannot be read is not the same either
                if place.read_bytes() == content:
                    continue
            template = "This file has been changed since {name} was kept; with it the state is another machine."
            raise refusal(template, place, name=repr(name))

    @property
    def unsaved(self) -> Iterator[tuple[str, dict[str, str]]]:
        """Yield the changes of the page, and by its name what is otherwise than in the file in each state that was not saved."""
        yield "", self.edits
        for name, machine in self.states.items():
            if name not in self._saved:
                file = dict(_typed(self.tree.root, ())) if self.tree else {}
                kept = dict(_typed(machine.changed.root, ()))
                yield (
                    name,
                    {_told(path): kept.get(path, "–") for path in kept | file if kept.get(path) != file.get(path)},
                )

    def save(self, name: str) -> Path:
        """Write a state into a file of its name beside that of the session, and return its path.

        UserError where there is one, or a table or the logo is not as it was.
        """
        tree = self._state(name).changed
        self._require_same_beside(name)
        file = self.file.with_name(f"{name}.yaml")
        if os.path.lexists(file):
            raise refusal("There is a file of this name already. Keep the state under another name.", file)
        write(file, as_file(tree, tree.text))
        self._saved.add(name)
        return file

    def _state(self, name: str) -> LiveMachine:
        if name not in self.states:
            raise refusal("There is no state {name}.", name=repr(name))
        return self.states[name]

    def write(self) -> None:
        """Write the changes into the file, all else in it as it stands; UserError where that is not possible, and nothing is lost.

        What cannot be calculated is not written.
        """
        self.read()  # as it stands now, whatever the editor has saved meanwhile
        if self.faults or self.tree is None:
            template = "Nothing is saved because this cannot be calculated; undo a change, or fix the file first."
            raise refusal(template, self.file)
        tree, text = self.tree, self._changed(self.tree).text
        if text != tree.text:
            write(self.file.resolve(), as_file(tree, text), instead_of=tree.sha256)
        self.edits, self.past, self.future, self._stroke = {}, [], [], ""
        self.read()

    def _is_moved(self, name: str) -> bool:
        """Whether something else stands in the file where a number was changed on the page: another item of its list, or another number."""
        if self.tree is None:
            return False
        place, found = self._places[name], self._found[name]
        is_other = typed_text(self.tree, place) not in (found.typed, self.edits.get(name))
        return is_other or _items(self.tree, place) != found.items

    def _edited(self) -> dict[KeyPath, str]:
        if moved := [name for name in self.edits if self._is_moved(name)]:
            template = "{names} changed on this page, but something else stands there in the file now; take the change back, and make it again."
            raise refusal(template, self.file, names=", ".join(moved))
        return {self._places[name]: typed for name, typed in self.edits.items()}

    def _judged(self, machine: LiveMachine, name: str, typed: str) -> str:
        asked = machine.inputs.get(name)
        if asked is None:
            raise refusal("{name} is not a number that the file gives.", name=repr(name))
        if asked.asked.unit is None:
            return _chosen(asked, typed)
        if typed in asked.meta.words:
            return typed
        try:
            if len(typed) > MAX_TYPED_LENGTH:
                raise UnitError("has more than {n} letters", n=MAX_TYPED_LENGTH)
            parse_quantity(typed, asked.meta.unit)
        except UnitError as fault:
            raise UserError(Problem(str(fault), str(self.file), path=asked.asked.path)) from None
        plain = with_point(typed)
        return plain if number_and_unit(plain)[1] else self._in_its_unit(asked, plain)

    def _in_its_unit(self, asked: DesignInput, number: str) -> str:
        """A bare number is in the unit that stands beside the input: of what was typed there before, else of the file."""
        before = self.edits.get(asked.name) or (typed_text(self.tree, asked.stands) if self.tree else None)
        try:
            own = number_and_unit(before)[1] if before else ""
        except UnitError:
            own = ""
        return f"{number} {own}" if own else number

    def _calculate(self) -> None:
        if self.tree is None:
            self.serial += 1
            return
        try:
            with in_time(self.file):
                machine = self._made(self.tree)
        except UserError as error:
            self._failed(error.problems)
        except PluginError as error:
            self._failed([Problem(str(error), str(self.file))])
        except Exception as error:  # of the program itself: the page shows it, and goes on with what is saved next
            self._failed([Problem(own_fault(error), str(self.file))])
        else:
            self.machine, self.faults = machine, []
            self.start = self.start or machine
            self.serial += 1

    def _changed(self, tree: Tree) -> Tree:
        """The file with the changes in it."""
        return self._with(tree, self._edited())

    def _with(self, tree: Tree, typed: Mapping[KeyPath, str]) -> Tree:
        told = {place: plain_text(text) if place in self._texts else text for place, text in typed.items()}
        placed = {place: str(text) for place, text in typed_changes(tree, told).items()}
        return rewritten(tree, placed, self.start.config.units(placed) if self.start else {})

    def _made(self, tree: Tree) -> LiveMachine:
        changed = self._changed(tree)
        former = self.machine.config if self.machine else None
        config = Press.read(changed, self.discovery, former=former).usable().config
        run = self._press.calculate(config)
        for error in run.errors.values():
            raise error
        _require_shown(run)
        at_parts = inputs_of_parts(config)
        inputs = shown_inputs(config, changed) | {each.name: each for own in at_parts.values() for each in own}
        of_parts = {name: frozenset(each.name for each in own) for name, own in at_parts.items()}
        return LiveMachine(tree, changed, config, run, inputs, of_parts)

    def _failed(self, problems: Iterable[Problem]) -> None:
        self.faults = list(problems)
        self.serial += 1


def shown_inputs(config: Config, tree: Tree) -> dict[str, DesignInput]:
    """Return by name the inputs of the mechanisms that a file gives, and those at default whose block stands in it."""
    if (parts := config.parts) is not None:  # what is made of them, most of the machine, stands in no file
        typed = {name: each for name, each in config.instances.items() if not parts.follows((name,))}
        config = replace(config, instances=typed)
    every = (*given_numbers(config), *given_words(config), *given_choices(config))
    given = [each for each in every if tree.typed(each.stands) is not None]
    at_default = (*numbers_at_default(config), *choices_at_default(config))
    own = [each for each in at_default if isinstance(value_at(tree.data, each.stands[:-1]), dict)]
    return {each.name: each for each in (*given, *own)}


def _items(tree: Tree, place: KeyPath) -> list[object]:
    """What tells the items of lists at a place from others: their texts, such as a name, else all that is typed beside it."""
    found: list[object] = []
    for depth, step in enumerate(place):
        if isinstance(step, int):
            items = tree.node(place[:depth]).children or {}
            if not items:  # a text of several, such as sections
                found.append((tree.typed(place[:depth]) or "").count(","))
                break
            typed = {at: dict(_typed(item, ())) for at, item in items.items()}
            names = {at: {key: text for key, text in own.items() if _is_name(key, text)} for at, own in typed.items()}
            own, rest = names.get(step), place[depth + 1 :]
            is_alone = bool(own) and list(names.values()).count(own or {}) == 1
            beside = {key: text for key, text in typed.get(step, {}).items() if key[: len(rest)] != rest}
            found.append(own if is_alone else (len(items), beside))
    return found


def _told(path: KeyPath) -> str:
    """What a place of the file is called on the page."""
    return dotted(path).removeprefix(f"{MECHANISMS}.").removesuffix(".value")


def _is_name(key: KeyPath, text: str) -> bool:
    return text[:1].isalpha() and key[-1:] not in (("basis",), ("note",))


def _typed(node: YamlNode, path: KeyPath) -> Iterator[tuple[KeyPath, str]]:
    """All that is typed in a node, by its place there."""
    if node.typed is not None:
        yield path, node.typed
    for key, child in (node.children or {}).items():
        yield from _typed(child, (*path, key))


@contextmanager
def in_time(file: Path) -> Iterator[None]:
    """Let what runs within take so long at most; UserError with the place in the plugin that does not come back."""
    try:
        with limited(MECHANISM_SECONDS):
            yield
    except Overran as cause:
        template = "it did not finish within {seconds} s ({said})"
        raise refusal(template, file, seconds=f"{MECHANISM_SECONDS:g}", said=said(cause)) from cause


def _chosen(asked: DesignInput, typed: str) -> str:
    if typed not in asked.options:
        template = "{given} is not a value of {name}; allowed: {options}."
        raise refusal(template, given=repr(typed[:MAX_TYPED_LENGTH]), name=asked.name, options=", ".join(asked.options))
    return typed


def _require_shown(run: WarmRun) -> None:
    """Raise PluginError for what the page shows at once and is refused only there: here it is told, a page that looks would get nothing."""
    for name, calculation in run.calculations.items():
        try:
            run.key_outputs(name)
        except Exception as cause:  # of any kind: the plugin's own, as wherever it is calculated
            raise PluginError(said(cause), calculation.mechanism.kind, name) from cause


# Reports of a live machine, made by a process of their own, so that the page goes on while the sheets are set.


MEDIA_TYPES = {"html": "text/html; charset=utf-8", "pdf": "application/pdf"}
NAME = "report"
REPORT_SECONDS = 900.0  # for a report; while one is made the next waits


class LiveReports:
    """Make reports and comparisons, one at a time, in a language or in that of the project; ``folders`` are those of foreign plugins."""

    def __init__(self, folders: tuple[Path, ...], language: str | None) -> None:
        self.folders, self.language = folders, language
        self._one = asyncio.Lock()

    async def made(self, config: Config, form: str) -> bytes:
        """Return the report of a configuration as ``html`` or ``pdf``, the command's own; UserError in its words where it cannot be made."""
        if form not in MEDIA_TYPES:
            raise refusal(
                "{form} is not a format here; there are {known}.", form=repr(form), known=", ".join(MEDIA_TYPES)
            )
        name = Path(config.tree.name).name
        return await self._of_command({name: config}, ["report", name], form)

    async def compared(self, machines: Mapping[str, Config]) -> bytes:
        """Return the comparison of machines, by what they are called, as HTML; UserError in words where it cannot be made."""
        configs = {f"{index}/{name}.yaml": config for index, (name, config) in enumerate(machines.items())}
        return await self._of_command(configs, ["compare", *configs], "html")

    async def _of_command(self, configs: Mapping[str, Config], command: list[str], form: str) -> bytes:
        """Write configurations by their paths into a folder and return what the command makes of them."""
        async with self._one:
            with tempfile.TemporaryDirectory(prefix="diecut-report-") as folder:
                for path, config in configs.items():
                    _laid_out(Path(folder) / path, config)
                return await self._run(Path(folder), command, form)

    async def _run(self, folder: Path, command: list[str], form: str) -> bytes:
        options = [part for place in self.folders for part in ("--plugins", str(place.absolute()))]
        options += ["--language", self.language] if self.language else []
        process = await asyncio.create_subprocess_exec(
            sys.executable, "-P", "-m", "diecut_report", *command, "-o", "made", "--format", form, "--quiet", *options,
            cwd=folder, stdin=asyncio.subprocess.DEVNULL, stdout=asyncio.subprocess.DEVNULL, stderr=asyncio.subprocess.PIPE,
        )  # fmt: skip
        try:
            async with asyncio.timeout(REPORT_SECONDS):
                _, told = await process.communicate()
        except asyncio.CancelledError:
            process.kill()
            raise
        except TimeoutError:
            process.kill()
            await process.wait()
            template = "The report was not finished within {seconds} s and was aborted."
            raise refusal(template, seconds=f"{REPORT_SECONDS:g}") from None
        files = list((folder / "made").glob(f"*.{form}"))
        if not files:
            raise refusal(told.decode(errors="replace").strip() or phrase("The report was not generated."))
        return files[0].read_bytes()


def _beside(config: Config) -> dict[str, bytes]:
    """The tables and the logo that a configuration names, by their paths from its folder."""
    files = {name: as_file(table, table.text) for name, table in config.tables.items()}
    return files | ({config.logo.name: config.logo.content} if config.logo else {})


def _laid_out(file: Path, config: Config) -> None:
    """Write a configuration as it is now into a file, and the tables and the logo that it names beside it or below."""
    for name, content in {file.name: as_file(config.tree, config.tree.text), **_beside(config)}.items():
        place = file.parent / name
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_bytes(content)
