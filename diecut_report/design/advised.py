"""The advice of several failing checks put together, where it names keys and values."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import Any

from diecut_report.config.loader import Config
from diecut_report.contract.inputs import Block, Quantity
from diecut_report.design.changeable import is_stepped
from diecut_report.design.design_choices import options_of, texts_of
from diecut_report.design.design_inputs import DesignInput, design_input
from diecut_report.errors import UserError
from diecut_report.results.advised_changes import AdvisedChange, advised_changes
from diecut_report.study.definition.base_inputs import MECHANISMS, Input, UnknownPath, find_input

Data = dict[str, Any]


@dataclass
class Advised:
    """Hold what the failing checks advise: numbers by their inputs, texts and yes/no by theirs.

    ``others`` are the numbers that they advise, in any of their ways.
    """

    numbers: dict[str, tuple[DesignInput, float]]
    choices: dict[str, tuple[Input, str]]
    others: dict[str, DesignInput] = field(default_factory=dict)

    def leave_out(self, is_out: Callable[[str], bool]) -> None:
        """Forget what is advised of inputs with such a path."""
        self.numbers = {path: each for path, each in self.numbers.items() if not is_out(path)}
        self.choices = {path: each for path, each in self.choices.items() if not is_out(path)}
        self.others = {path: each for path, each in self.others.items() if not is_out(path)}

    @property
    def asked(self) -> dict[str, Input]:
        """Return all inputs that are advised, by their paths."""
        numbers = {path: design.asked for path, design in self.others.items()}
        return numbers | {path: asked for path, (asked, _) in self.choices.items()}

    @property
    def stepped(self) -> dict[Input, str]:
        """Return the numbers that take some values alone, as they are typed."""
        return {each.asked: each.typed(value) for each, value in self.numbers.values() if is_stepped(each)}

    @property
    def is_empty(self) -> bool:
        return not self.numbers and not self.choices


def advised(config: Config, failing: Iterable[tuple[str, Data]]) -> Advised:
    """Return what failing checks, each with its name, advise by their first way that can be taken; of several bounds of one input the furthest.

    The numbers of their other ways are ``others``.
    """
    found = Advised({}, {})
    for name, check in failing:
        home = name.split(".")[0]
        instance = config.instances.get(home)
        model = instance.model if instance else Block
        is_taken = False
        for way in advised_changes(str(check["message"]), model.model_fields, texts_of(model)):
            known = Advised({}, {}) if is_taken else found
            taken = [_take(config, known, f"{MECHANISMS}.{home}.{change.key}", change) for change in way]
            is_taken = is_taken or any(taken)
            found.others |= {path: design for path, (design, _) in known.numbers.items()}
    return found


def _take(config: Config, found: Advised, path: str, change: AdvisedChange) -> bool:
    """Note a change that can be made, of a number the value that is furthest from today's; return whether it can."""
    try:
        asked = find_input(config, path)
        if not isinstance(asked.meta, Quantity):
            if change.value not in options_of(asked):
                return False
            found.choices.setdefault(path, (asked, change.value))
            return True
        design = design_input(config, path)
        values = [design.read(value) for value in (change.value, change.other) if value]
    except (UnknownPath, UserError, ValueError):  # of another mechanism, calculated, or not a value of this key
        return False
    if not design.today:
        return False
    today = design.today
    value = min(values, key=lambda each: abs(each - today))
    other = found.numbers.get(design.asked.path, (design, today))[1]
    furthest = max((value, other), key=lambda each: abs(each - today))
    found.numbers[design.asked.path] = (design, furthest)
    return True
