"""One machine of a mechanism, calculated as a report calculates it: ``calculate(MECHANISM, {"teeth": 30})``."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from diecut_report.config import yaml_tree
from diecut_report.config.discovery import Discovery, DuplicateKind, Origin, UnknownKind
from diecut_report.config.loader import Config, load_config
from diecut_report.contract.mechanism import Mechanism
from diecut_report.errors import PluginError, Problem, UserError
from diecut_report.results.document import document
from diecut_report.results.press_run import compute
from diecut_report.testing.found_values import MechanismFound

Keys = Mapping[str, Any]
FILE = "inputs"  # what stands where a message would name the file


class Refused(ValueError):
    """Report inputs that are not allowed, or a machine that cannot be, each in words: ``arm: −3 mm is out of range; …``."""

    def __init__(self, problems: Iterable[str]) -> None:
        self.problems = tuple(problems)
        super().__init__("\n".join(self.problems))


class WithMechanism(Discovery):
    """Knows the kinds that are here, and a mechanism that is in memory, which stands before any other of its kind."""

    def __init__(self, mechanism: Mechanism, folders: Iterable[Path] = ()) -> None:
        super().__init__(folders)
        self.given = mechanism

    @cached_property
    def origins(self) -> dict[str, list[Origin]]:
        """Return each kind with the places that give it."""
        found, file = super().origins, Path(self.given.at.rpartition(":")[0])
        same = [origin for origin in found.get(self.given.kind, []) if origin.is_own]
        own = Origin(self.given.kind, str(file), lambda: self.given, lambda: file, is_own=bool(same))
        return {**found, self.given.kind: [own]}


def load(kind: str, folder: str | Path | None = None) -> Mechanism:
    """Return the mechanism of a kind: of a folder of plugins, or of those that are built in or installed.

    LookupError where there is none, PluginError where the plugin is broken, each in words.
    """
    try:
        return Discovery([] if folder is None else [Path(folder)]).mechanism(kind)
    except (UnknownKind, DuplicateKind) as fault:
        raise LookupError(str(fault)) from None


def calculate(
    mechanism: Mechanism, inputs: Keys, *, press: Keys | None = None, others: Mapping[str, Keys] | None = None,
    plugins: Iterable[str | Path] = (),
) -> MechanismFound:  # fmt: skip
    """Return what a mechanism gives for inputs that are written as in a configuration: numbers, or texts with units.

    ``press`` are keys of the press (productivity, sheet), ``others`` further mechanisms by their names, for what is referred to
    (``"motion": "${cams.position}"``), ``plugins`` folders with their kinds. Raises Refused where inputs are not allowed or the
    machine cannot be, PluginError where the plugin breaks, with file and line.
    """
    try:
        run = compute(configured(mechanism, inputs, press, others, plugins), lambda _: None)
    except UserError as error:
        raise Refused(_told(problem, mechanism.kind) for problem in error.problems) from None
    if run.errors:
        raise next(iter(run.errors.values()))
    if mechanism.kind in run.skipped:
        raise Refused([run.skipped[mechanism.kind]])
    return MechanismFound(document(run)["mechanisms"][mechanism.kind])


def configured(
    mechanism: Mechanism, inputs: Keys, press: Keys | None = None, others: Mapping[str, Keys] | None = None,
    plugins: Iterable[str | Path] = (),
) -> Config:  # fmt: skip
    """Return the checked configuration of one machine; UserError with all that is wrong with it."""
    blocks = {**(others or {}), mechanism.kind: {"kind": mechanism.kind, **inputs}}
    whole = {
        "schema_version": 1, "project": {"title": mechanism.title}, "press": {"name": "-", **(press or {})}, "mechanisms": blocks,
    }  # fmt: skip
    text = json.dumps(whole, default=_plain, ensure_ascii=False)
    config = load_config(yaml_tree.parse(text, FILE), WithMechanism(mechanism, map(Path, plugins)))
    if broken := config.broken.get(mechanism.kind):
        raise broken
    return config


def _plain(value: Any) -> Any:
    """A number of NumPy as Python has it."""
    if isinstance(value, np.generic | np.ndarray):
        return value.tolist()
    raise TypeError(
        f"{value!r} is not what a configuration may hold: a number, a text, true or false, a list, keys with values"
    )


def _told(problem: Problem, kind: str) -> str:
    path = problem.path.removeprefix(f"mechanisms.{kind}").removeprefix(".")
    return f"{path}: {problem.message}" if path else problem.message


__all__ = ["PluginError", "Refused", "calculate", "configured", "load"]
