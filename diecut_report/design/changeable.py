"""Which inputs may be changed to mend a machine: those that the designer names, else what gives the parts their form."""

from __future__ import annotations

import re
from collections.abc import Container, Iterable

from diecut_report.config.loader import Config
from diecut_report.config.model import PRESS
from diecut_report.contract.inputs import Quantity
from diecut_report.design.demanded import demanded
from diecut_report.design.design_inputs import DesignInput, any_input, design_input, given_numbers
from diecut_report.errors import Problem, UserError
from diecut_report.languages.phrases import Phrase
from diecut_report.study.definition.base_inputs import Input

FORM = ("m", "rad")  # SI units of sizes and angles, which give a part its form
RATIO = re.compile(r"(^|_)ratio($|_)")
LIMIT = re.compile(
    r"^(allowable|allowed|required|min|max|limiting|least|greatest|available|accepted)_|(^|_)(margin|tolerance)s?$"
)
FIXED_BASES = ("standard", "catalogue", "measured")


def changeable(
    config: Config, free: Iterable[str], keep: Container[str], advised: Iterable[str] = ()
) -> list[DesignInput]:
    """Return the inputs that may be changed: numbers named by ``free``, else sizes, angles and ratios, and what is advised, but for those paths.

    What the press is for, what checks demand, limits, loads, materials and numbers of parts stay as they are unless they are named.
    UserError where one of those that are named has no value.
    """
    if free:
        named = [design_input(config, name) for name in free]
        _require_values(config, named)
        named = [each for each in named if not is_stepped(each)]
    else:
        own = [each for each in given_numbers(config) if is_form(config, each) and not is_stepped(each)]
        named = own + [design_input(config, name) for name in advised]
    found = {each.asked.path: each for each in named if each.asked.path not in keep and each.today}
    return list(found.values())


def named_paths(config: Config, names: Iterable[str]) -> tuple[list[str], set[str]]:
    """Return of names of inputs those that stand for a number, and the paths of all, also of texts and yes/no."""
    numbers, paths = [], set()
    for name in names:
        asked = any_input(config, name)
        if isinstance(asked.meta, Quantity):
            numbers.append(name)
            paths.add(design_input(config, name).asked.path)
        else:
            paths.add(asked.path)
    return numbers, paths


def _require_values(config: Config, named: Iterable[DesignInput]) -> None:
    for each in named:
        if not each.today:
            words = "{input} has no value today, or is zero, and has no share that could be changed; give it one first."
            raise UserError(Problem(Phrase(words, input=each.name), config.tree.file, path="--free"))


def is_stepped(design: DesignInput) -> bool:
    """Return whether a number takes some values alone, and so none between them."""
    return design.is_whole or bool(design.meta.listed)


def is_form(config: Config, design: DesignInput) -> bool:
    """Return whether an input gives a part its form, and is neither demanded nor fixed by what it rests on."""
    instance = config.instances[design.asked.instance]
    key = str(design.asked.key[-1])
    if instance is None or design.asked.instance == PRESS or design.is_whole or LIMIT.search(key):
        return False
    if instance.mechanism and _id(design) in demanded(instance.mechanism):
        return False
    if is_fixed(config, design.asked):
        return False
    own = design.meta.parsed_unit.si
    return own in FORM or (own == "1" and RATIO.search(key) is not None)


def is_fixed(config: Config, asked: Input) -> bool:
    """Return whether an input rests on what no designer changes: a standard, a catalogue, a measurement."""
    instance = config.instances[asked.instance]
    basis = instance.bases.get(asked.key) if instance else None
    return basis is not None and basis.basis in FIXED_BASES


def _id(design: DesignInput) -> str:
    """What the steps and checks of its mechanism call it: without the number of a part."""
    return ".".join(part for part in design.asked.key if isinstance(part, str))
