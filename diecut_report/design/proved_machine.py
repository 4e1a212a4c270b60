"""One machine of a configuration with values written into its text, read again and calculated by itself, as its report would."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

from diecut_report.config.discovery import Discovery
from diecut_report.config.instances import Instance
from diecut_report.config.loader import Config, load_config
from diecut_report.config.written_values import as_file, written
from diecut_report.config.yaml_tree import KeyPath, Tree, parse
from diecut_report.engine import Calculation
from diecut_report.errors import Problem, UserError
from diecut_report.files import write_all
from diecut_report.languages.phrases import Phrase
from diecut_report.results.checks import check_results
from diecut_report.results.mechanism import SelfTestFailed
from diecut_report.results.press_run import Run
from diecut_report.results.summary import failed_self_tests, governing
from diecut_report.study.execution.result_columns import output_values

Data = dict[str, Any]


@dataclass(frozen=True)
class ProvedMachine:
    """Hold a machine that was calculated alone: the text that it was read from, its results and checks."""

    tree: Tree
    config: Config
    calculations: Mapping[str, Calculation]
    checked: Mapping[str, list[Data]]

    @cached_property
    def outputs(self) -> dict[str, float]:
        """Return its numbers by name, SI."""
        found = {n: v for name, calc in self.calculations.items() for n, v in output_values(name, calc).items()}
        return {name: float(v[0]) for name, v in found.items() if v.dtype.kind in "fi" and v[0] == v[0]}

    def checks(self, status: str) -> list[tuple[str, Data]]:
        """Return its checks of a status, each with its name ``drive.crank_torque``."""
        return [(f"{name}.{each['id']}", each) for name, each in self._each() if each["status"] == status]

    @property
    def status(self) -> str:
        return next((status for status in ("fail", "warn") if self.checks(status)), "pass")

    @property
    def governing(self) -> str | None:
        """Return the check that governs."""
        found = governing({name: {"checks": checks} for name, checks in self.checked.items()})
        return f"{found['mechanism']}.{found['check']}" if found else None

    def _each(self) -> Iterator[tuple[str, Data]]:
        yield from ((name, each) for name, checks in self.checked.items() for each in checks)


def proved(tree: Tree, values: Mapping[KeyPath, str], discovery: Discovery) -> ProvedMachine:
    """Write values into the text of a configuration, by their places, and calculate what it then says.

    UserError where a value cannot be written or the machine cannot exist; PluginError where a plugin breaks.
    """
    text = written(tree, values) if values else tree.text
    changed = parse(text, tree.file)
    again = Tree(changed.root, tree.file, text, changed.sha256, tree.name)
    config = load_config(again, discovery)
    run = _CheckedRun(config, lambda _: None)
    if run.problems:
        raise UserError(run.problems)
    for error in run.errors.values():
        raise error
    return ProvedMachine(again, config, run.calculations, run.checked)


def write_config(tree: Tree, machine: ProvedMachine, target: Path) -> None:
    """Write the machine's text as a file: whole, or not at all. UserError where it could not be read there as it is here."""
    home = Path(tree.file).resolve().parent
    if machine.config.files and target.resolve().parent != home:
        words = "The configuration names files beside it ({files}), which would not be found there. Write it into the folder {folder}."
        raise UserError(Problem(Phrase(words, files=", ".join(machine.config.files), folder=home), str(target)))
    write_all({target: as_file(tree, machine.tree.text)}, keep=Path(tree.file), through=True)


class _CheckedRun(Run):
    """One way through the graph that judges each mechanism and prints nothing."""

    def __init__(self, config: Config, tell: Any) -> None:
        self.checked: dict[str, list[Data]] = {}
        super().__init__(config, tell)

    def _comparisons(self) -> None:
        """Mechanisms that are compared have no checks."""

    def _printed(self, instance: Instance, calculation: Calculation) -> None:
        checks = check_results(calculation)
        if failed := failed_self_tests(checks):
            raise SelfTestFailed(failed)
        self.checked[instance.name] = [each for each in checks if each["class"] != "numerical"]
