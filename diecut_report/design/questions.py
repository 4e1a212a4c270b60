"""What a designer asks of a machine: a quantity that is to have a value, stay below or above one, or be as small or great as can be."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal

from diecut_report.config.loader import Config
from diecut_report.config.model import PRESS
from diecut_report.design.design_inputs import design_input
from diecut_report.design.varied_machines import CHECKS, UTILISATION, narrowed, quantities
from diecut_report.errors import Problem, UserError, nearest
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.quantities.formatting import told
from diecut_report.quantities.units import UnitError, parse_quantity, unit
from diecut_report.study.definition.base_inputs import Input
from diecut_report.study.execution.result_columns import columns_of

Kind = Literal["=", "<=", ">=", "max", "min"]
COMPARED = re.compile(r"\s*(?P<name>[\w.-]+?)\s*(?P<sign>==|=|<=|>=|≤|≥|<|>)\s*(?P<value>.+?)\s*")
EXTREME = re.compile(r"\s*(?P<way>max|maximise|maximize|min|minimise|minimize)\s+(?P<name>[\w.-]+)\s*")
SIGNS: dict[str, Kind] = {"==": "=", "=": "=", "<=": "<=", "≤": "<=", "<": "<=", ">=": ">=", "≥": ">=", ">": ">="}
SHOWN = 12  # known names that a message lists


@dataclass(frozen=True)
class AskedNumber:
    """Hold a number that a machine gives, or an input of it: its name, its column among the results, the unit it is read in."""

    name: str
    column: str
    unit: str
    home: str
    asked: Input | None = None
    description: str = ""

    @property
    def si(self) -> str:
        """Return its SI unit."""
        return unit(self.unit).si

    def told(self, value: float, digits: int = 6) -> str:
        """Return a value (SI) as one says it."""
        return told(value, self.unit, digits)


@dataclass(frozen=True)
class DesignQuestion:
    """Hold what is asked: a quantity, what it is to be, and the value (SI) where that is one."""

    quantity: AskedNumber
    kind: Kind
    value: float = 0.0

    @property
    def told(self) -> str:
        """Return it as it may be typed."""
        name = self.quantity.name
        return (
            f"{self.kind} {name}"
            if self.kind in ("max", "min")
            else f"{name} {self.kind} {self.quantity.told(self.value)}"
        )


def question(config: Config, text: str) -> DesignQuestion:
    """Read what is asked, such as ``drive.crank_torque_peak = 400 N*m`` or ``max press.productivity``; UserError in words."""
    if extreme := EXTREME.fullmatch(text):
        return DesignQuestion(quantity(config, extreme["name"]), "max" if extreme["way"].startswith("max") else "min")
    compared = COMPARED.fullmatch(text)
    if compared is None:
        words = (
            "{text} is not a question; write one such as “drive.crank_torque_peak = 400 N*m”, "
            "“cylinder.mass <= 90 kg” or “max press.productivity”."
        )
        raise UserError(Problem(Phrase(words, text=repr(text)), path="--for"))
    asked = quantity(config, compared["name"])
    try:
        return DesignQuestion(asked, SIGNS[compared["sign"]], parse_quantity(compared["value"], asked.unit))
    except UnitError as fault:
        raise UserError(Problem(Phrase("{name}: {fault}", name=asked.name, fault=fault), path="--for")) from None


def quantity(config: Config, name: str) -> AskedNumber:
    """Return the number that a name stands for: an output, the utilisation of a check, or an input; UserError in words."""
    home, _, own = name.removeprefix("mechanisms.").partition(".")
    column = quantities(config).get(f"{home}.{own}")
    if column is not None:
        return AskedNumber(column.name, column.name, column.display or column.unit, home, None, column.description)
    if own.startswith(CHECKS[1:]):
        return _utilisation(config, home, own.removeprefix(CHECKS[1:]).removesuffix(UTILISATION))
    if home == PRESS or (home in config.instances and _is_input(config, home, own)):
        found = design_input(config, name)
        return AskedNumber(
            found.name, found.asked.path, found.unit, found.asked.instance, found.asked, found.meta.description
        )
    raise UserError(Problem(_unknown(config, home, own), config.tree.file))


def needed(config: Config, asked: AskedNumber, varied: Input) -> Config:
    """Return what must be calculated for a number: that of an output alone; of an input the whole, which says whether it can be."""
    return config if asked.asked is not None else narrowed(config, [asked.home, varied.instance])


def _utilisation(config: Config, home: str, check: str) -> AskedNumber:
    column = f"{home}{CHECKS}{check}{UTILISATION}"
    known = [each.name for each in columns_of(config) if each.name.endswith(UTILISATION)]
    if column not in known:
        own = [name for name in known if name.startswith(f"{home}.")]
        words = "{home}.checks.{check} is not a check{near}."
        near = nearest(column, own or known)
        raise UserError(Problem(Phrase(words, home=home, check=check, near=near), config.tree.file))
    return AskedNumber(column, column, "1", home)


def _is_input(config: Config, home: str, own: str) -> bool:
    instance = config.instances[home]
    return instance is not None and own.split(".")[0] in instance.model.model_fields


def _unknown(config: Config, home: str, own: str) -> Phrase:
    mechanisms = [name for name in config.instances if name != PRESS]
    if home not in config.instances:
        words = "{name}: there is no mechanism {home}{near}. Known: {known}."
        near = nearest(home, mechanisms)
        return Phrase(words, name=f"{home}.{own}", home=repr(home), near=near, known=", ".join(mechanisms))
    known = [name.removeprefix(f"{home}.") for name in quantities(config) if name.startswith(f"{home}.")]
    if not own:
        words = "{home} names no number; add one, as in {example}."
        return Phrase(words, home=home, example=f"{home}.{next(iter(known), 'output')}")
    words = "{name} is neither a number that {home} gives nor an input of it{near}."
    return Phrase(words, name=f"{home}.{own}", home=home, near=nearest(own, known) or _listed(known))


def _listed(names: Iterable[str]) -> Phrase:
    every = list(names)
    if len(every) > SHOWN:
        return Phrase("; it gives {names} and {n} more", names=", ".join(every[:SHOWN]), n=len(every) - SHOWN)
    return Phrase("; it gives {names}", names=", ".join(every) or phrase("none"))
