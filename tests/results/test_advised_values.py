"""Which values an advice names: of small machines, whose limits are known by hand."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from diecut_report.api import Chapter, Check, Inputs, Mechanism, Quantity, Text
from diecut_report.machine.steps.run import calculate
from diecut_report.mechanism.checks import AdviceWay
from diecut_report.results.checks import check_results


class Pin(Inputs):
    grade: Annotated[Literal["soft", "hard"], Text("Grade")] = "soft"
    bore: Annotated[float, Quantity("d", "mm", "Bore", gt=0)] = 10


def pin(*checks: Check, advise: tuple[AdviceWay, ...]) -> Mechanism:
    """A pin that gives way when it is soft, and breaks when it is hard."""
    chapter = Chapter("Pin")
    chapter.lookup("strength", "σ", "MPa", "Strength", {"soft": 1.0, "hard": 4.0}, by="grade")
    chapter.value("notch", "k", "1", "Notch sensitivity", lambda: 1, needs=("grade=soft",))
    chapter.value("notch", "k", "1", "Notch sensitivity", lambda: 3, needs=("grade=hard",))
    chapter.value("pressure", "p", "MPa", "Pressure", lambda bore: 2e6 * 0.01 / bore)
    strong = check("strong", "pressure", "strength", unit="MPa", advise=advise)
    return Mechanism(
        kind="pin", version="1", title="", summary="", inputs=Pin, chapters=(chapter,), checks=(strong, *checks)
    )


def check(id: str, demand: str, limit: str | float, **more: Any) -> Check:
    """A check that something holds."""
    sound = {"check_class": "strength", "title": id, "demand_label": "", "limit_label": "", "consequence": "it breaks."}
    return Check(**{"id": id, "unit": "1", "demand": demand, "limit": limit, **sound, **more})


def message(mechanism: Mechanism, **inputs: Any) -> str:
    """What the first check of a machine says."""
    return str(check_results(calculate(mechanism, inputs))[0].message)


def test_a_text_that_makes_another_check_fail_says_so() -> None:
    machine = pin(check("tough", "notch", 2.0), advise=("grade",))
    assert "Set grade to hard (this check then fails: “tough”)." in message(machine, grade="soft", bore=0.01)
