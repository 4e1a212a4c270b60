"""Questions to small machines, drawn with a seed: sensible ones and odd ones, and what must be true of each answer."""

from __future__ import annotations

import json
import math
import random
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from diecut_report.config.loader import Config
from diecut_report.config.plugins import Discovery
from diecut_report.design.inputs import given_numbers
from diecut_report.design.machines import CHECKS, proved, quantities
from diecut_report.press import Press
from diecut_report.study.definition.base_inputs import known_paths
from tests.configs import EXAMPLE, GOOD, HEAD

BENCHMARKS = Path(__file__).parents[2] / "benchmarks"
LEVERS = (
    HEAD
    + """\
  a: {kind: lever, force: {value: 2 kN, basis: assumed}, arm: 100 mm, allowable_moment: 250 N*m}  # the lever
  b: {kind: lever, force: "${a.force} / 2", arm: "${a.arm}", teeth: 16, width: 30 mm, allowable_moment: 90 N*m}
  c: {kind: lever, force: 1 kN, parts: [{length: 3 mm}, {length: 4 mm, label: two}], grade: coarse, hard: true}
  d: {kind: lever, force: 1 kN, arm: 0.3 m, load: "${a.torque}"}
"""
)
SIGNS = ("=", "<=", ">=", "<", "≥")
ODD_VALUES = (
    "0",
    "-1 mm",
    "1e-300 mm",
    "1e300 m",
    "5 kg",
    "five",
    "",
    "NaN",
    "inf mm",
    "20 deg",
    "0.1 m",
    "1,5 mm",
    "7",
)
ODD_QUESTIONS = (
    "", "max", "max nothing.here", "a = b", "= 5", "min press.name", "max knife.checks.reach", "é = 1", "a..b = 1", "max .", "x" * 300,
)  # fmt: skip
ODD_NAMES = (
    "", ".", "press", "press.name", "project.title", "mechanisms", "a.parts", "c.parts.0", "c.parts.9.length", "c.parts.x.length", "d.load",
    "a.kind", "a.spring.stiffness", "a.grade", "a.hard", "press.sheet", "schema_version", "a.arm.", "mechanisms.a", "\n", "a.n_points",
)  # fmt: skip


def configs() -> dict[str, Path | str]:
    """Return the small machines that are asked, as files or texts."""
    own = {name: EXAMPLE.with_name(f"{name}.yaml") for name in ("circular_knife", "folding_knife")}
    return {"levers": LEVERS, "two_mechanisms": BENCHMARKS / "two_mechanisms.yaml", **own}


class Questions:
    """Draws questions to one machine."""

    def __init__(self, file: Path) -> None:
        press = Press.read(file, Discovery([GOOD]))
        config, today, self.file = press.config, proved(press), file
        units = {name: column.unit for name, column in quantities(config).items()}
        self.today = {each.name: (each.present, each.meta.parsed_unit.si) for each in given_numbers(config)}
        self.today |= {name: (value, units[name]) for name, value in today.outputs.items() if name in units}
        self.inputs = [path for name in config.instances for path in known_paths(config, name)]
        self.numbers = list(quantities(config))
        self.checks = list(_checks(config))

    def options(self, draw: random.Random) -> tuple[str, list[str]]:
        """Return a command and what it is given."""
        command = draw.choice(("solve", "solve", "solve", "advise", "influence"))
        asked = {"solve": self._solve, "advise": self._advise, "influence": self._influence}[command]
        return command, list(asked(draw))

    def _solve(self, draw: random.Random) -> Iterator[str]:
        vary = self._input(draw)
        yield from ("--vary", vary, "--for", self._question(draw))
        if draw.random() < 0.5:
            yield "--passing"
        for option in ("--from", "--to"):
            if draw.random() < 0.25:
                yield from (option, self._value(draw, vary))

    def _advise(self, draw: random.Random) -> Iterator[str]:
        for option, chance in (("--free", 0.7), ("--free", 0.4), ("--keep", 0.4)):
            if draw.random() < chance:
                yield from (option, self._input(draw))

    def _influence(self, draw: random.Random) -> Iterator[str]:
        yield from ("--count", str(draw.randint(10, 60)), "--seed", str(draw.randint(0, 99)))
        if draw.random() < 0.5:
            yield from ("--of", draw.choice((*self.numbers, *self.inputs, *self.checks)))
        if draw.random() < 0.3:
            yield from ("--by", draw.choice(("1", "100", "0.001", "-1", "101", "nan")))
        for _ in range(draw.randint(0, 2)):
            name = self._input(draw)
            yield from ("--tolerance", f"{name}={self._value(draw, name)}")
        if draw.random() < 0.3:
            yield from ("--distribution", "uniform")

    def _input(self, draw: random.Random) -> str:
        if draw.random() < 0.1:
            return draw.choice(ODD_NAMES)
        is_given = draw.random() < 0.7
        known = [name for name in self.today if name not in self.numbers] if is_given else self.inputs
        return draw.choice(known).removeprefix("mechanisms.")

    def _value(self, draw: random.Random, name: str) -> str:
        """A value of a number: mostly near that of today."""
        if name in self.today and draw.random() < 0.8:
            value, unit = self.today[name]
            return f"{(value or 1.0) * 2 ** draw.gauss(0, 1):.4g} {unit}".removesuffix(" 1")
        if draw.random() < 0.3:
            return draw.choice(ODD_VALUES)
        return f"{10 ** draw.uniform(-3, 4):.3g}{draw.choice(('', ' mm', ' mm', ' deg', ' N', ' N*m', ' 1/h', ' MPa'))}"

    def _question(self, draw: random.Random) -> str:
        if draw.random() < 0.1:
            return draw.choice(ODD_QUESTIONS)
        name = draw.choice((*self.numbers, *self.inputs, *self.checks, *self.checks)).removeprefix("mechanisms.")
        if draw.random() < 0.4:
            return f"{draw.choice(('max', 'min'))} {name}"
        return f"{name} {draw.choice(SIGNS)} {self._value(draw, name)}"


def _checks(config: Config) -> Iterator[str]:
    for name, instance in config.instances.items():
        for check in instance.mechanism.checks if instance and instance.mechanism else ():
            yield f"{name}{CHECKS}{check.id}"


def faults(command: str, code: int, out: str, err: str) -> Iterator[str]:
    """Yield what is not as it must be of a command with ``--format json``."""
    if code not in (0, 1, 2):
        yield f"ends with {code}"
    if "Traceback" in err or "Warning" in err or "NaN" in out or "Infinity" in out:
        yield "speaks of itself, or of what is no number"
    if code == 2 and (out or not err.strip()):
        yield "bad input is told in words, and nothing else is written"
    if code in (0, 1):
        yield from {"solve": _solved, "advise": _advised, "influence": _told}[command](code, json.loads(out))


def _solved(code: int, answer: dict[str, Any]) -> Iterator[str]:
    found, asked, vary = answer["solutions"], answer["for"], answer["vary"]
    if bool(found) != (code == 0) or bool(answer["machine"]) != (code == 0):
        yield "the code says another thing than the answer"
    for each in found:
        span = 1e-4 * (abs(vary["from"]) + abs(vary["to"]))
        if not vary["from"] - span <= each["value"] <= vary["to"] + span and each["role"] != "today":
            yield f"{each['value']} is outside of the range"
        if each["reached"] is None or not _holds(asked, each["reached"]):
            yield f"{each['reached']} is not {asked['kind']} {asked.get('value')}"
    if found and asked["passing"] and answer["machine"]["failing"]:
        yield "not all checks pass"
    if found and asked["kind"] == "=" and vary["today"] is not None:
        away = [abs(each["value"] - vary["today"]) for each in found]
        if min(away) < away[0] * (1 - 1e-6):
            yield "the first is not the nearest"


def _holds(asked: dict[str, Any], reached: float) -> bool:
    value = asked.get("value", reached)
    close = 1e-5 * max(abs(value), abs(reached), 1e-12)
    held = {"=": abs(reached - value) <= close, "<=": reached <= value + close, ">=": reached >= value - close}
    return held.get(asked["kind"], True)


def _advised(code: int, answer: dict[str, Any]) -> Iterator[str]:
    if (code == 1) != (bool(answer["failing"]) and answer["machine"] is None):
        yield "the code says another thing than the answer"
    if answer["machine"] is not None and answer["machine"]["status"] not in ("pass", "warn"):
        yield "what was found fails"
    if code == 1 and not answer["left"]:
        yield "no check is said to fail"


def _told(code: int, answer: dict[str, Any]) -> Iterator[str]:
    chances = answer["tolerances"] and [answer["tolerances"]["no_check_fails"], *answer["tolerances"]["checks"]]
    for each in chances or ():
        low, high = each["interval"]
        if not 0 <= low <= each["probability"] <= high <= 1:
            yield f"{each} is not a probability within its interval"
    for tornado in answer["tornados"]:
        for bar in tornado["bars"]:
            if not all(math.isfinite(value) for value in bar.values() if isinstance(value, float)):
                yield f"{bar} holds what is no number"
    if code:
        yield "influence has nothing to fail for"
