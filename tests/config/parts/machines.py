"""The machines of parts among the examples: whole, and with other texts in some of their places."""

from __future__ import annotations

from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Any

from diecut_report.config.loader import Config, examined
from diecut_report.config.parts.findings import Finding
from diecut_report.config.parts.model import MachineParts
from diecut_report.config.plugins import Discovery
from diecut_report.config.yaml import parse

FILE = Path(import_module("diecut_report.configs").__path__[0]) / "machines" / "flat_cylinder.yaml"
TEXT = FILE.read_text("utf-8")
CORRECTED = FILE.with_stem("flat_cylinder_corrected").read_text("utf-8")
DISCOVERY = Discovery([])
Change = tuple[str, str]


@dataclass(frozen=True)
class Machine:
    """A machine as it is read, and what is wrong with it."""

    config: Config
    problems: list[str]

    @property
    def parts(self) -> MachineParts:
        """Its parts."""
        assert self.config.parts is not None
        return self.config.parts

    @property
    def made(self) -> dict[str, Any]:
        """Its mechanisms and the calculations of its parts, as the file of mechanisms has them."""
        return dict(self.config.tree.data["mechanisms"])

    @property
    def told(self) -> str:
        """All that is wrong with it."""
        return "\n".join(self.problems)

    def found(self, rule: str) -> list[Finding]:
        """What a rule doubts."""
        return [each for each in self.parts.findings if each.rule == rule]


def machine(*changes: Change, text: str = TEXT) -> Machine:
    """The machine of a text with other words in some places, each the first where it stands."""
    for old, new in changes:
        assert old in text, old
        text = text.replace(old, new, 1)
    config, problems = examined(parse(text, str(FILE)), DISCOVERY)
    return Machine(config, [str(each) for each in problems])


def sound(*changes: Change, text: str = TEXT) -> Machine:
    """The same machine, with which nothing is wrong."""
    found = machine(*changes, text=text)
    assert found.problems == []
    return found
