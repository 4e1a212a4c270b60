"""What a live page shows and changes: the file as it stands, numbers changed on the page over it, and the last machine that could be calculated."""

from __future__ import annotations

import asyncio
import sys
import tempfile
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from diecut_report.config import yaml
from diecut_report.config.loader import Config
from diecut_report.config.plugins import Discovery, said
from diecut_report.config.references import as_file, rewritten
from diecut_report.config.yaml import KeyPath, Tree, YamlNode
from diecut_report.design.inputs import DesignInput, given_choices, given_numbers
from diecut_report.errors import PluginError, Problem, UserError, own_fault, refusal
from diecut_report.files import write
from diecut_report.press import Press
from diecut_report.quantities.units import UnitError, number_and_unit, parse_quantity, with_point
from diecut_report.results.warm_press import WarmPress, WarmRun
from diecut_report.text.phrases import phrase
from diecut_report.time_limit import MECHANISM_SECONDS, Overran, limited

Data = dict[str, Any]
MAX_TYPED_LENGTH = 100  # letters of a number that is typed on the page
MAX_EDITS = 1_000


@dataclass(frozen=True)
class LiveMachine:
    """Hold a machine that could be calculated: the file that it was read from, its configuration, its run, and its inputs by name."""

    tree: Tree
    config: Config
    run: WarmRun
    inputs: Mapping[str, DesignInput]


class LiveSession:
    """Keep a configuration calculated while it is changed. Not for several threads at a time.

    ``faults`` is what is wrong now; ``machine`` is the last machine that could be calculated (None before the first), ``start``
    the first. ``edits`` are the numbers changed on the page and not written, by the names of their inputs, as typed.
    """

    def __init__(self, file: Path, discovery: Discovery) -> None:
        self.file, self.discovery = file, discovery
        self.tree: Tree | None = None
        self.machine: LiveMachine | None = None
        self.start: LiveMachine | None = None
        self.faults: list[Problem] = []
        self.edits: dict[str, str] = {}
        self.serial = 0
        self._places: dict[str, KeyPath] = {}
        self._items: dict[str, list[object]] = {}
        self._typed: dict[str, str | None] = {}
        self._press = WarmPress()
        self._read: dict[Path, object] = {}
        self.read()

    @property
    def files(self) -> set[Path]:
        """Return the files whose change matters: the configuration, and the tables and the logo that it names."""
        named = self.machine.config.files if self.machine else ()
        return {self.file, *(self.file.parent / name for name in named)}

    def is_stale(self) -> bool:
        """Return whether the files are others than those that were read. Any thread may ask."""
        return self._read != self._marks()

    def read(self) -> None:
        """Read the file again and calculate; changes of the page stay over it, but those that stand in it now."""
        self._read = self._marks()  # before the reading: what is saved meanwhile is another
        try:
            self.tree = yaml.read(self.file)
        except UserError as error:
            self._failed(error.problems)
            return
        self._forget_written()
        self._calculate()

    def _forget_written(self) -> None:
        if self.tree is not None:
            in_file = {name: self.tree.typed(self._places[name]) for name in self.edits}
            self.edits = {
                name: typed for name, typed in self.edits.items() if in_file[name] != typed or self._is_moved(name)
            }

    def _marks(self) -> dict[Path, object]:
        found: dict[Path, object] = {}
        for file in self.files:
            try:
                about = file.stat()
            except OSError as error:
                found[file] = error.errno
            else:
                found[file] = about.st_ino, about.st_mtime_ns, about.st_size
        return found

    def change(self, changes: Mapping[str, str]) -> None:
        """Take values of the page, as typed, by the names of their inputs; UserError where one is not a value of its input."""
        if (machine := self.machine) is None:
            raise refusal("Nothing can be changed before the file can be calculated.", self.file)
        taken = {name: self._judged(machine, name, typed.strip()) for name, typed in changes.items()}
        if len(self.edits.keys() | taken.keys()) > MAX_EDITS:
            raise refusal("At most {n} numbers can be changed before they are written to the file.", n=MAX_EDITS)
        for name, typed in taken.items():
            self._places[name] = machine.inputs[name].stands
            if name not in self.edits:  # by what the page shows, which the file may not be any more
                self._items[name] = _items(machine.tree, self._places[name])
                self._typed[name] = machine.tree.typed(self._places[name])
            self.edits[name] = typed
        self._forget_written()
        self._calculate()

    def take_back(self, names: Iterable[str] | None = None) -> None:
        """Forget changes of the page: these, or all."""
        for name in list(self.edits) if names is None else names:
            self.edits.pop(name, None)
        self._calculate()

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
        self.edits = {}
        self.read()

    def _is_moved(self, name: str) -> bool:
        """Whether something else stands in the file where a number was changed on the page: another item of its list, or another number."""
        if self.tree is None:
            return False
        is_other = self.tree.typed(self._places[name]) not in (self._typed[name], self.edits.get(name))
        return is_other or _items(self.tree, self._places[name]) != self._items[name]

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
        try:
            if len(typed) > MAX_TYPED_LENGTH:
                raise UnitError("has more than {n} letters", n=MAX_TYPED_LENGTH)
            parse_quantity(typed, asked.meta.unit)
        except UnitError as fault:
            raise UserError(Problem(str(fault), str(self.file), path=asked.asked.path)) from None
        plain = with_point(typed)
        return plain if number_and_unit(plain)[1] else self._in_its_unit(asked, plain)

    def _in_its_unit(self, asked: DesignInput, number: str) -> str:
        """A bare number is in the unit that stands beside the input, which is the one that the file gives it in."""
        stands = self.tree.typed(asked.stands) if self.tree else None
        try:
            is_bare = stands is None or not number_and_unit(stands)[1]
        except UnitError:
            is_bare = True
        return number if is_bare or asked.unit == "1" else f"{number} {asked.unit}"

    def _calculate(self) -> None:
        if self.tree is None:
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
        edited = self._edited()
        return rewritten(tree, edited, self.start.config.units(edited) if self.start else {})

    def _made(self, tree: Tree) -> LiveMachine:
        config = Press.read(self._changed(tree), self.discovery).usable().config
        run = self._press.calculate(config)
        for error in run.errors.values():
            raise error
        _require_shown(run)
        given = [*given_numbers(config), *given_choices(config)]
        return LiveMachine(tree, config, run, typed_in(tree, given))

    def _failed(self, problems: Iterable[Problem]) -> None:
        self.faults = list(problems)
        self.serial += 1


def typed_in(tree: Tree, inputs: Iterable[DesignInput]) -> dict[str, DesignInput]:
    """Return by name the inputs that a file gives; those that the parts of its machine make are changed where the parts are described."""
    return {each.name: each for each in inputs if tree.typed(each.stands) is not None}


def _items(tree: Tree, place: KeyPath) -> list[object]:
    """What tells the items of lists at a place from others: their texts, such as a name, else all that is typed beside it."""
    found: list[object] = []
    for depth, step in enumerate(place):
        if isinstance(step, int):
            items = tree.node(place[:depth]).children or {}
            typed = {at: dict(_typed(item, ())) for at, item in items.items()}
            names = {at: {key: text for key, text in own.items() if _is_name(key, text)} for at, own in typed.items()}
            own, rest = names.get(step), place[depth + 1 :]
            is_alone = bool(own) and list(names.values()).count(own or {}) == 1
            beside = {key: text for key, text in typed.get(step, {}).items() if key[: len(rest)] != rest}
            found.append(own if is_alone else (len(items), beside))
    return found


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
    """Make reports, one at a time, in a language or in that of the project; ``folders`` are those of foreign plugins."""

    def __init__(self, folders: tuple[Path, ...], language: str | None) -> None:
        self.folders, self.language = folders, language
        self._one = asyncio.Lock()

    async def made(self, config: Config, form: str) -> bytes:
        """Return the report of a configuration as ``html`` or ``pdf``, the command's own; UserError in its words where it cannot be made."""
        if form not in MEDIA_TYPES:
            raise refusal(
                "{form} is not a format here; there are {known}.", form=repr(form), known=", ".join(MEDIA_TYPES)
            )
        async with self._one:
            with tempfile.TemporaryDirectory(prefix="diecut-report-") as folder:
                _laid_out(Path(folder), config)
                return await self._reported(Path(folder), Path(config.tree.name).name, form)

    async def _reported(self, folder: Path, name: str, form: str) -> bytes:
        options = [part for place in self.folders for part in ("--plugins", str(place.absolute()))]
        options += ["--language", self.language] if self.language else []
        command = ["-P", "-m", "diecut_report", "report", name, "-o", "made", "--format", form, "--quiet"]
        process = await asyncio.create_subprocess_exec(
            sys.executable, *command, *options, cwd=folder, stdin=asyncio.subprocess.DEVNULL,
            stdout=asyncio.subprocess.DEVNULL, stderr=asyncio.subprocess.PIPE,
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


def _laid_out(folder: Path, config: Config) -> None:
    """Write a configuration as it is now into a folder, with the tables and the logo that it names beside it or below."""
    files = {Path(config.tree.name).name: as_file(config.tree, config.tree.text)}
    files |= {name: as_file(table, table.text) for name, table in config.tables.items()}
    files |= {config.logo.name: config.logo.content} if config.logo else {}
    for name, content in files.items():
        place = folder / name
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_bytes(content)
