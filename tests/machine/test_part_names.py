"""Parts of one name: a result or a failing check of one of them was lost in silence."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from diecut_report.testing.machines import Refused, calculate, load
from diecut_report.testing.values import MechanismFound

SPRINGS = """
from diecut_report.api import *


class Spring(Block):
    name: Annotated[str, Text("Name")]
    force: Annotated[float, Quantity("F_i", "N", "Force")]


class Springs(Inputs):
    springs: Annotated[list[Spring], Text("Springs")]
    allowed: Annotated[float, Quantity("F_z", "N", "Allowed force")] = 10


def check(id, named_by=""):
    return Check(id=id, check_class="strength", title=id, demand="springs.force", limit="allowed", unit="N",
                 demand_label="force", limit_label="allowed", consequence="x.", named_by=named_by)


chapter = Chapter("All")
chapter.value("pull", "P_i", "N", "Pull", bind(lambda force: 2 * force, force="springs.force"), named_by="%(named)s")
chapter.value("push_pull", "Q_i", "N", "Both", bind(lambda force: 3 * force, force="springs.force"), named_by="%(named)s")
MECHANISM = Mechanism(kind="springs", version="1", title="S", summary="S.", inputs=Springs, chapters=(chapter,), checks=(%(checks)s))
"""
NAMED, EACH = "springs.name", 'check("force", "springs.name"),'


def calculated(folder: Path, names: tuple[str, ...], checks: str = "", named: str = "") -> MechanismFound:
    (folder / "springs.py").write_text(SPRINGS % {"checks": checks, "named": named}, "utf-8")
    given: dict[str, Any] = {"springs": [{"name": name, "force": 100 if i == 0 else 1} for i, name in enumerate(names)]}
    return calculate(load("springs", folder), given, plugins=[folder])


def test_parts_with_names_of_their_own_are_calculated(tmp_path: Path) -> None:
    found = calculated(tmp_path, ("left", "right"), EACH, NAMED)
    assert (found["left_pull"].shown, found["right_pull"].shown) == ("200 N", "2 N")
    assert {name: each.status for name, each in found.checks.items()} == {"force_left": "fail", "force_right": "pass"}


LOST = {
    "results": ("", NAMED, ("a", "b", "a"), "springs.2.name: is a, as is that of part 1 of springs; give each part a name of its own"),
    "a failing check": (EACH, "", ("a", "a"), "springs.1.name: is a, as is that of part 1 of springs"),
    "what plain code keeps by its name": ("", "", ("a", "a"), "springs.1.name: is a, as is that of part 1 of springs"),
    "a result of another row": ("", NAMED, ("a", "a_push"), "is a, with which its result a_push_pull would be called as another one"),
    "a check of the machine": (EACH + 'check("force_b"),', "", ("a", "b"), "springs.1.name: is b, with which its check force_b would be"),
}  # fmt: skip


@pytest.mark.parametrize("what", LOST)
def test_two_parts_of_one_name_are_refused(tmp_path: Path, what: str) -> None:
    checks, named, names, words = LOST[what]
    with pytest.raises(Refused) as caught:
        calculated(tmp_path, names, checks, named)
    assert words in str(caught.value)
