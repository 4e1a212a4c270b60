"""A machine in two new processes, in one before another machine and in the other after it: equal inputs are to give equal results."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Iterable, Iterator
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from diecut_report.config.instances import Instance
from diecut_report.config.loader import Config
from diecut_report.config.plugins import Discovery, in_folder, said
from diecut_report.machine.calculation import Calculation, Impossible, Unproven
from diecut_report.machine.steps.run import calculate
from diecut_report.mechanism.inputs import Block, flatten
from diecut_report.mechanism.mechanism import Mechanism
from diecut_report.press import Press
from diecut_report.results.document import document
from diecut_report.results.press_run import ReportedRun
from diecut_report.testing.machines import MachineCase, one_of
from diecut_report.text.phrases import Phrase

ORDERS = ("before", "after")  # when the other machine is calculated; with what the hashes of texts begin is its place
SEED = 3  # of the other machine
SHORT = 40  # letters of values that are told
RESULTS = "results.json"
Data = dict[str, Any]


def unlike_again(config: Config, name: str, discovery: Discovery) -> Iterator[tuple[str, str]]:
    """Yield what of a mechanism differs between two new processes, of its configuration's file: its id, and in words how."""
    with TemporaryDirectory() as folder:
        begun = [_begun(Path(folder), order, config, name, discovery) for order in ORDERS]
        try:
            codes = [process.wait() for process in begun]
        finally:
            for process in begun:
                process.kill()
                process.wait()
        found = [_read(Path(folder) / order, code) for order, code in zip(ORDERS, codes, strict=True)]
    yield from _differences(*found)


def _begun(home: Path, order: str, config: Config, name: str, discovery: Discovery) -> subprocess.Popen[bytes]:
    """A process in a folder of its own, in which texts have other hashes than in the other process."""
    folder = home / order
    folder.mkdir()
    command = [sys.executable, "-m", __name__, order, str(Path(config.tree.file).absolute()), name, *discovery.paths]
    own = {"PYTHONHASHSEED": str(ORDERS.index(order)), "PYTHONSAFEPATH": "1"}
    quiet = subprocess.DEVNULL
    return subprocess.Popen(command, cwd=folder, env={**os.environ, **own}, stdin=quiet, stdout=quiet, stderr=quiet)


def _read(folder: Path, code: int) -> Data:
    if code or not (file := folder / RESULTS).is_file():
        return {"error": Phrase("ends with {code}", code=str(code))}
    found: Data = json.loads(file.read_text("utf-8"))
    return found


def _differences(one: Data, other: Data) -> Iterator[tuple[str, str]]:
    for found in (one, other):
        if "error" in found:
            yield "", Phrase("cannot be calculated in a new process: {error}", error=found["error"])
            return
    template = (
        "differs between two new processes, one of which calculates another machine first{values}: equal inputs are to give equal results; "
        "ask no clock and no chance, and keep nothing between two calls"
    )
    numbers = _unlike(one["other"], other["other"])
    for id, sides in (numbers or _unlike(_by_id(one["machine"]), _by_id(other["machine"]))).items():
        told = Phrase(" ({one}, {other})", one=sides[0], other=sides[1]) if len(max(sides, key=len)) < SHORT else ""
        yield id, Phrase(template, values=told)


def _unlike(one: Data, other: Data) -> dict[str, tuple[str, str]]:
    return {id: (json.dumps(one[id]), json.dumps(other.get(id))) for id in one if one[id] != other.get(id)}


def _by_id(record: Data) -> Data:
    """Each quantity, check and figure of a mechanism's results by its id; all else by its field."""
    found: Data = {}
    for field, part in record.items():
        named: Iterable[tuple[str, Any]] = [(field, part)]
        if isinstance(part, dict):
            named = part.items()
        elif isinstance(part, list) and all(isinstance(each, dict) and "id" in each for each in part):
            named = [(each["id"], each) for each in part]
        for id, each in named:
            found.setdefault(id, []).append(each)  # a check may have the name of what it compares
    return found


# What the new process does.


class _Both(ReportedRun):
    """Calculate a press, and before or after one of its mechanisms another machine of the same kind."""

    def __init__(self, config: Config, name: str, order: str) -> None:
        self.asked, self.order, self.other = name, order, dict[str, Any]()
        super().__init__(config, lambda _: None)

    def _made(self, instance: Instance, mechanism: Mechanism, block: Block) -> Calculation:
        if instance.name == self.asked and self.order == "before":
            self.other = _other(mechanism, block)
        made = super()._made(instance, mechanism, block)
        if instance.name == self.asked and self.order == "after":
            self.other = _other(mechanism, block)
        return made


def _other(mechanism: Mechanism, block: Block) -> Data:
    """The numbers and texts of a machine that is little unlike another one, by id."""
    machine = MachineCase(mechanism, flatten(block))
    try:
        calc = calculate(mechanism, {**machine.values, **one_of(machine.varied(1, SEED), 0)})
    except (Impossible, Unproven) as refused:
        return {"": str(refused)}
    return {name: values[0].tolist() for name, values in calc.values.items()}


def found_here(order: str, file: Path, name: str, folders: list[Path]) -> Data:
    """Return the results of a mechanism of a configuration, and the numbers of the other machine; what broke in words."""
    try:
        own = [origin for folder in folders for origin in in_folder(folder)]  # before installed ones of the same name
        discovery = Discovery(folders, own)
        discovery.extend()
        run = _Both(Press.read(file, discovery).config, name, order)
        if name in run.errors:
            return {"error": run.errors[name].message}
        return {"machine": document(run).mechanisms[name].data(), "other": run.other}
    except Exception as cause:
        return {"error": said(cause)}


if __name__ == "__main__":
    _, asked_order, asked_file, asked_name, *asked_folders = sys.argv
    results = found_here(asked_order, Path(asked_file), asked_name, [Path(folder) for folder in asked_folders])
    Path(RESULTS).write_text(json.dumps(results, ensure_ascii=False), "utf-8")
