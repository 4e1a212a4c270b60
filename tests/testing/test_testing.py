"""The contract test for plugin authors finds each kind of flaw."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from diecut_report.api import Chapter, Check, Formula, Mechanism, Step, Value, bind, formula
from diecut_report.declaration.formula_checks import check_mechanism
from tests.machine.toy import MECHANISM, READ, ROOTED, Toy, same


@formula
def force_and_arm(force: Any, arm: Any) -> Any:
    return force + arm


@formula
def moment(force: Any, arm: Any) -> Any:
    return force * arm


def mechanism(*steps: Step, checks: tuple[Check, ...] = ()) -> Mechanism:
    """A mechanism of these steps on the toy's inputs."""
    return replace(MECHANISM, inputs=Toy, chapters=(Chapter("Steps", steps=(*steps, READ)),), checks=checks, figures=())


def value(**changes: Any) -> Value:
    """A sound step with changes."""
    sound: dict[str, Any] = {"id": "m", "symbol": "M", "unit": "N*m", "description": "Moment", "formula": moment}
    return Value(**sound | changes)


def check(**changes: Any) -> Check:
    """A sound check with changes."""
    sound: dict[str, Any] = {
        "id": "c",
        "check_class": "strength",
        "title": "c",
        "demand": "m",
        "limit": 3.0,
        "unit": "N*m",
        "demand_label": "",
        "limit_label": "",
    }
    return Check(**{"consequence": ""} | sound | changes)


@pytest.mark.parametrize("sound", [mechanism(value(), checks=(check(),)), MECHANISM, ROOTED])
def test_a_sound_mechanism_passes(sound: Mechanism) -> None:
    check_mechanism(sound)


def rooted(**changes: Any) -> Mechanism:
    """The mechanism with a root, its step changed."""
    step = replace(ROOTED.chapters[0].steps[0], **changes)
    return replace(ROOTED, chapters=(Chapter("Root", steps=(step,)),))


class Lying(Formula):
    """A formula that computes something else than it prints."""

    def __call__(self, *args: Any, **kwargs: Any) -> Any:
        return 2 * super().__call__(*args, **kwargs)


FLAWS = {
    "a length added to a force": (mechanism(value(formula=force_and_arm)), "brings together N .force. and m .arm."),
    "another unit than declared": (mechanism(value(unit="N")), "declared is N"),
    "an id that nothing gives": (
        mechanism(value(formula=bind(moment, arm="lever"))),
        "takes lever, which nothing gives",
    ),
    "a check of an unknown id": (
        mechanism(value(), checks=(check(demand="torque"),)),
        "takes torque, which nothing gives",
    ),
    "a check in another kind of unit": (mechanism(value(), checks=(check(unit="mm"),)), "check c: is in mm"),
    "a quantity without a symbol": (mechanism(value(symbol="")), "no symbol"),
    "a print that is not what is computed": (mechanism(value(formula=Lying(moment.function))), "prints"),
    "a bracket in another unit than the root": (rooted(low=bind(same, quantity="force")), "gives"),
    "a relation between unlike quantities": (rooted(right=bind(same, quantity="force")), "the relation equals"),
}


@pytest.mark.parametrize("flaw", FLAWS)
def test_a_flaw_is_named(flaw: str) -> None:
    broken, words = FLAWS[flaw]
    with pytest.raises(AssertionError, match=words):
        check_mechanism(broken)
