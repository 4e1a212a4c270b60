"""Which inputs may be changed to mend a machine: those that the designer names, else what gives the parts their form."""

from __future__ import annotations

import re
from collections.abc import Iterable

from diecut_report.config.loader import Config
from diecut_report.config.model import PRESS
from diecut_report.design.design_inputs import DesignInput, design_input, given_numbers
from diecut_report.errors import Problem, UserError

FORM = ("m", "rad")  # SI units of sizes and angles, which give a part its form
RATIO = re.compile(r"(^|_)ratio($|_)")
LIMIT = re.compile(
    r"^(allowable|allowed|required|min|max|limiting|least|greatest|available|accepted)_|(^|_)(margin|tolerance)s?$"
)
FIXED_BASES = ("standard", "catalogue", "measured")


def changeable(
    config: Config, free: Iterable[str], keep: Iterable[str], advised: Iterable[str] = ()
) -> list[DesignInput]:
    """Return the inputs that may be changed: those named by ``free``, else sizes, angles and ratios, and what is advised, but for ``keep``.

    What the press is for, limits, loads, materials and numbers of parts stay as they are unless they are named.
    UserError where nothing is left.
    """
    named = [design_input(config, name) for name in free]
    kept = {design_input(config, name).asked.path for name in keep}
    if not named:
        own = [each for each in given_numbers(config) if _is_form(config, each)]
        named = own + [design_input(config, name) for name in advised]
    found = {each.asked.path: each for each in named if each.asked.path not in kept and each.today}
    if not found:
        words = "nothing is free to be changed: name inputs that have a value today and are not zero by --free, or keep fewer by --keep."
        raise UserError(Problem(words, config.tree.file))
    return list(found.values())


def _is_form(config: Config, design: DesignInput) -> bool:
    instance = config.instances[design.asked.instance]
    key = str(design.asked.key[-1])
    if instance is None or design.asked.instance == PRESS or design.is_whole or LIMIT.search(key):
        return False
    basis = instance.bases.get(design.asked.key)
    if basis is not None and basis.basis in FIXED_BASES:
        return False
    own = design.meta.parsed_unit.si
    return own in FORM or (own == "1" and RATIO.search(key) is not None)
