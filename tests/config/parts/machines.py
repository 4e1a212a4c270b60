"""The machines of parts among the examples: whole, and with other texts in some of their places."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache, lru_cache
from importlib import import_module
from pathlib import Path
from typing import Any

from diecut_report.config.loader import Config, examined, load_config
from diecut_report.config.parts.findings import Finding
from diecut_report.config.parts.model import MachineParts
from diecut_report.config.plugins import Discovery
from diecut_report.config.yaml import parse
from diecut_report.results.warm_press import WarmPress, WarmRun

FILE = Path(import_module("diecut_report.configs").__path__[0]) / "machines" / "flat_cylinder.yaml"
TEXT = FILE.read_text("utf-8")
CORRECTED = FILE.with_stem("flat_cylinder_corrected").read_text("utf-8")
DISCOVERY = Discovery([])
PRESS = WarmPress(is_advised=False)  # remembers what a change leaves as it is
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


@cache
def whole() -> Config:
    """The first machine as it stands, with which nothing is wrong."""
    return load_config(FILE, DISCOVERY)


@lru_cache(32)
def machine(*changes: Change, text: str = TEXT) -> Machine:
    """The machine of a text with other words in some places, each the first where it stands."""
    for old, new in changes:
        assert old in text, old
        text = text.replace(old, new, 1)
    config, problems = examined(parse(text, str(FILE)), DISCOVERY, former=whole())
    return Machine(config, [str(each) for each in problems])


def sound(*changes: Change, text: str = TEXT) -> Machine:
    """The same machine, with which nothing is wrong."""
    found = machine(*changes, text=text)
    assert found.problems == []
    return found


def run_of(*changes: Change, text: str = TEXT) -> WarmRun:
    """The same machine, calculated."""
    return PRESS.calculate(sound(*changes, text=text).config)
