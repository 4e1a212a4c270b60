"""Tries a mistake on the plugin as its author would: load it, test it, calculate, and where asked report and study it."""

from __future__ import annotations

import io
import json
import re
from contextlib import redirect_stderr, redirect_stdout
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal

from diecut_report.cli.main import main
from diecut_report.config.plugins import Discovery
from diecut_report.declaration.formula_checks import check_mechanism
from diecut_report.errors import PluginError

KIND = "bucket_elevator"
PLUGIN = Path(__file__).with_name(f"{KIND}.py")
SOURCE = PLUGIN.read_text("utf-8")
NEAR = 10  # lines between what is told and what was changed: a declaration may begin some lines above

Stage = Literal["load", "check_mechanism", "calc", "report", "study", ""]
STAGES: tuple[Stage, ...] = ("load", "check_mechanism", "calc", "report", "study")

MACHINE: dict[str, Any] = {
    "kind": KIND, "capacity": "12 t/h", "height": "12 m", "head_speed": "46 rpm", "allowable_torque": "400 N*m", "n_points": 36,
    "pulleys": [{"diameter": "400 mm", "journal_diameter": "60 mm"},
                {"diameter": "200 mm", "journal_diameter": "40 mm", "wrap": "30 deg"}],
    "backstop": {"radius": "150 mm", "allowable_force": "2 kN"},
}  # fmt: skip


@dataclass(frozen=True)
class Mistake:
    """A mistake in words, the texts that it puts in place of others, and where and how it must be told.

    ``told`` is the first place that tells it, ``words`` are patterns that the message holds, beside the plugin's name.
    ``placed`` says that the message names the plugin's file and the line, or one near to it. ``kept`` says that the numbers
    are calculated all the same. ``keys`` are changes of the machine.
    """

    what: str
    changes: tuple[tuple[str, str], ...]
    told: Stage
    words: tuple[str, ...]
    code: int = 3
    placed: bool = True
    kept: bool = False
    keys: dict[str, Any] = field(default_factory=dict)

    @property
    def source(self) -> str:
        """The plugin with the mistake; each text that is replaced stands in it exactly once."""
        text = SOURCE
        for old, new in self.changes:
            assert text.count(old) == 1, f"{self.what}: {old!r} stands {text.count(old)} times in the plugin"
            text = text.replace(old, new)
        return text

    @property
    def line(self) -> int:
        """The line of the first change."""
        text = SOURCE[: SOURCE.index(self.changes[0][0])] if self.changes else ""
        return text.count("\n") + 1


@dataclass(frozen=True)
class Told:
    """Where a mistake was told first, with which exit code, in which words; and the results of the mechanism, if any."""

    stage: Stage
    code: int
    text: str
    results: dict[str, Any]


def tried(mistake: Mistake, folder: Path) -> Told:
    """What happens with a mistake, from one place to the next until one tells it."""
    file = folder / f"{KIND}.py"
    file.write_text(mistake.source, "utf-8")
    try:
        mechanism = Discovery([folder]).mechanism(KIND)
    except PluginError as error:
        return Told("load", 3, str(error), {})
    try:
        check_mechanism(mechanism)
    except AssertionError as flaws:
        return Told("check_mechanism", 1, str(flaws), {})
    except Exception as broken:  # the test of an author must speak to him, and not break
        return Told("check_mechanism", 70, f"{type(broken).__name__}: {broken}", {})
    return _used(mistake, folder)


def write_machine(mistake: Mistake, folder: Path) -> None:
    """Write a press of the machine, and a study of it, into the plugin's folder."""
    machine = {key: value for key, value in (MACHINE | mistake.keys).items() if value is not None}
    base = {
        "schema_version": 1,
        "project": {"title": "Mistake"},
        "press": {"name": "P"},
        "mechanisms": {"lift": machine},
    }
    (folder / "press.yaml").write_text(json.dumps(base), "utf-8")
    study = {"schema_version": 1, "base": "press.yaml", "sample": {"method": "grid"},
             "vary": {"mechanisms.lift.head_speed": ["46 rpm", "50 rpm"]}}  # fmt: skip
    (folder / "study.yaml").write_text(json.dumps(study), "utf-8")


def _used(mistake: Mistake, folder: Path) -> Told:
    write_machine(mistake, folder)
    found = _command(folder, "calc", folder / "press.yaml", "-o", folder / "press.json")
    if found.code or mistake.told not in ("report", "study"):
        return found
    if mistake.told == "report":
        return _command(folder, "report", folder / "press.yaml", "-o", folder, "--format", "html,json")
    return _command(folder, "batch", folder / "study.yaml", "-o", folder / "out")


def _command(folder: Path, command: Stage | Literal["batch"], *arguments: object) -> Told:
    errors = io.StringIO()
    with redirect_stderr(errors), redirect_stdout(io.StringIO()):
        code = main([command, *map(str, arguments), "--plugins", str(folder)])
    stage: Stage = "study" if command == "batch" else command
    file = folder / "press.json"
    results = json.loads(file.read_text("utf-8"))["mechanisms"]["lift"] if file.exists() else {}
    told = code or "error." in errors.getvalue()  # a study goes on without the machines that fail, and says so
    return Told(stage if told else "", code, errors.getvalue(), results)


def faults(mistake: Mistake, told: Told) -> list[str]:
    """In what the telling of a mistake falls short; empty where it is as it must be."""
    if told.stage != mistake.told:
        return [f"told by {told.stage or 'nothing'}, not by {mistake.told}: {told.text.strip()[-400:]}"]
    wanted = 1 if told.stage == "check_mechanism" else mistake.code
    found = [f"exit code {told.code}, not {wanted}"] if told.code != wanted else []
    named = () if mistake.code == 2 else (KIND,)  # a machine that cannot be is told by its place in the user's file
    found += [f"a traceback: {told.text.strip()[-400:]}"] if "Traceback" in told.text else []
    found += [
        f"without {words!r}: {told.text}" for words in (*named, *mistake.words) if not re.search(words, told.text)
    ]
    lines = [int(number) for number in re.findall(rf"{KIND}\.py(?::|, line )(\d+)", told.text)]
    if mistake.placed and not any(abs(line - mistake.line) <= NEAR for line in lines):
        found.append(f"without the place {KIND}.py:{mistake.line}: {told.text}")
    if mistake.kept and not told.results.get("outputs"):
        found.append("the numbers are lost with it")
    return found
