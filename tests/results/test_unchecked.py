"""Checks that are not made: what is not checked for want of a key, what does not apply, and the self-tests of the calculation."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, ClassVar, Literal

import numpy as np
import pytest

from diecut_report.api import Annotated, Block, Chapter, Check, Inputs, Mechanism, OneOf, Quantity, Text
from diecut_report.config.plugins import Discovery
from diecut_report.declaration import faults
from diecut_report.machine.calculation import Calculation
from diecut_report.machine.steps.run import calculate
from diecut_report.mechanism.inputs import flatten
from diecut_report.results.checks import check_results
from diecut_report.results.conclusion import governing, summary
from diecut_report.results.mechanism import SelfTestFailed, mechanism_results
from diecut_report.results.mechanism_record import CheckRecord
from diecut_report.study.execution import variant_rows
from diecut_report.testing.contract import _strange_partners


class Stop(Block):
    reach: Annotated[float, Quantity("a", "N", "Reach", gt=0)]
    allowable_reach: Annotated[float | None, Quantity("[a]", "N", "Allowed reach", gt=0)] = None


class Bar(Inputs):
    one_of: ClassVar[tuple[OneOf, ...]] = (OneOf(("load",), ("weight", "tare"), optional=True),)

    force: Annotated[float, Quantity("F", "N", "Force", gt=0)] = 8
    rated: Annotated[float | None, Quantity("F_r", "N", "Rated force", gt=0)] = None
    least: Annotated[float | None, Quantity("F_l", "N", "Least force", gt=0)] = None
    width: Annotated[float | None, Quantity("b", "N", "Width", gt=0)] = None
    load: Annotated[float | None, Quantity("L", "N", "Load", gt=0)] = None
    weight: Annotated[float | None, Quantity("W", "N", "Weight", gt=0)] = None
    tare: Annotated[float | None, Quantity("T", "N", "Tare", gt=0)] = None
    material: Annotated[Literal["steel", "wood"], Text("Material")] = "wood"
    stop: Annotated[Stop | None, Text("Stop")] = None


def check(demand: Any, limit: Any, **changes: Any) -> Check:
    texts: dict[str, Any] = {"id": "c", "title": "Bar", "check_class": "strength", "demand_label": "force", "limit_label": "allowed",
                             "consequence": "relieve it", "unit": "N"}  # fmt: skip
    return Check(**{**texts, "demand": demand, "limit": limit, **changes})


def bar(*checks: Check) -> Mechanism:
    chapter = Chapter("All")
    chapter.value("doubled", "D", "N", "Doubled", lambda force: 2 * force)
    chapter.value("slack", "Δ", "N", "Slack", lambda force: 10 - force, exists=lambda force: force < 10)
    chapter.value("spread", "S", "N", "Spread", lambda force, width: force + width, needs=("width",))
    chapter.value("bent", "B", "N", "Bent", lambda force: 3 * force, needs=("material=steel",))
    chapter.value("weighed", "G", "N", "Weighed", lambda weight, tare: weight - tare, needs=("weight", "tare"))
    return Mechanism(kind="bar", version="1", title="Bar", summary="", inputs=Bar, chapters=(chapter,), checks=checks)


def calculated(*checks: Check, **values: Any) -> Calculation:
    return calculate(bar(*checks), flatten(Bar.model_validate(values)))


def made(*checks: Check, **values: Any) -> list[CheckRecord]:
    return check_results(calculated(*checks, **values))


def test_a_check_whose_limit_is_not_given_is_listed_with_its_demand_and_the_key() -> None:
    [found] = made(check("doubled", "rated"))
    assert (found.status, found.check_class, found.missing) == ("not_checked", "strength", ["rated"])
    assert (found.demand, found.limit, found.utilisation) == (16, None, None)
    assert found.message == "Not checked: force 16 N, but rated is not given."


def test_what_is_needed_for_the_demand_is_named_too_in_the_order_of_the_keys() -> None:
    [found] = made(check("spread", "rated"))
    assert (found.missing, found.demand) == (["rated", "width"], None)
    assert found.message == "Not checked: rated and width are not given."
    [found] = made(check("least", "doubled"))
    assert found.message == "Not checked: allowed 16 N, but least is not given."


@pytest.mark.parametrize(
    ("one", "given"),
    [
        (check("bent", "rated"), {}),
        (check("bent", "rated"), {"rated": 5}),
        (check("stop.reach", "stop.allowable_reach"), {}),
        (check("weighed", "rated"), {"load": 5, "rated": 3}),
        (check("doubled", "rated", only_with=("width",)), {}),
        (check("doubled", "rated", check_class="numerical"), {}),
    ],
    ids=["text", "text with its limit", "block", "alternative", "only with", "self-test"],
)  # fmt: skip
def test_what_does_not_apply_is_left_out(one: Check, given: dict[str, Any]) -> None:
    assert made(one, **given) == []


def test_what_this_machine_does_not_have_is_not_asked_for() -> None:
    assert [one.missing for one in made(check("slack", "rated"), force=9)] == [["rated"]]
    assert made(check("slack", "rated"), force=11) == []


def test_what_applies_and_lacks_a_key_is_told() -> None:
    assert made(check("bent", "rated"), material="steel")[0].missing == ["rated"]
    assert made(check("stop.reach", "stop.allowable_reach"), stop={"reach": 3})[0].missing == ["stop.allowable_reach"]
    assert made(check("weighed", "rated"))[0].missing == ["rated", "weight", "tare"]
    assert made(check("doubled", "rated", only_with=("width",)), width=1)[0].missing == ["rated"]


def test_of_checks_with_one_id_the_one_that_is_made_is_reported_else_the_first() -> None:
    both = check("spread", "rated"), check("doubled", "rated")
    assert [found.status for found in made(*both, rated=20)] == ["pass"]
    assert len(made(*both)) == 1


def test_what_is_not_checked_changes_no_status_and_is_counted() -> None:
    results = mechanism_results(calculated(check("doubled", 20.0, id="a"), check("doubled", "rated", id="b")), {})
    assert results.status == "pass" and results.absent == []
    counts = {"pass": 1, "warn": 0, "fail": 0, "not_checked": 1, "numerical": {"pass": 0, "fail": 0}}
    assert results.counts.data() == counts and summary({"bar": results.checks}, []).governing == "bar.a"


def test_a_value_sized_to_its_limit_does_not_govern_unless_it_fails() -> None:
    sized = check("doubled", 16.5, id="sized", sized_unless=("width",))
    results = mechanism_results(calculated(sized, check("doubled", 160.0, id="far")), {})
    assert results.checks[0].sized_to_limit and not results.checks[1].sized_to_limit
    assert str(governing({"bar": results.checks})) == "bar.far"
    given = mechanism_results(calculated(sized, check("doubled", 160.0, id="far"), width=1), {})
    assert str(governing({"bar": given.checks})) == "bar.sized"
    failing = mechanism_results(calculated(sized, check("doubled", 160.0, id="far"), force=9), {})
    assert str(governing({"bar": failing.checks})) == "bar.sized"


def test_what_stands_exactly_at_a_given_limit_was_not_sized_by_the_program_and_governs() -> None:
    results = mechanism_results(calculated(check("doubled", 16.0, id="same"), check("doubled", 160.0, id="far")), {})
    assert results.checks[0].utilisation == 1 and not results.checks[0].sized_to_limit
    assert str(governing({"bar": results.checks})) == "bar.same"


def test_what_the_calculation_presumes_governs_only_where_it_does_not_hold() -> None:
    """As the range of a method: that a machine lies well within it is no reserve."""
    near = check("doubled", 16.5, id="range", presumed=True)
    results = mechanism_results(calculated(near, check("doubled", 160.0, id="far")), {})
    assert results.checks[0].presumed and not results.checks[1].presumed
    assert str(governing({"bar": results.checks})) == "bar.far"
    left = mechanism_results(calculated(near, check("doubled", 160.0, id="far"), force=9), {})
    assert str(governing({"bar": left.checks})) == "bar.range"


def test_self_tests_are_counted_apart_and_never_govern() -> None:
    own = check("doubled", 16.5, id="own", check_class="numerical")
    results = mechanism_results(calculated(own, check("doubled", 160.0, id="far")), {})
    assert results.counts.numerical.data() == {"pass": 1, "fail": 0} and results.counts.passing == 1
    assert str(governing({"bar": results.checks})) == "bar.far"


def test_a_self_test_that_fails_leaves_no_results() -> None:
    own = check("doubled", 1.0, id="own", check_class="numerical", severity="warn")
    with pytest.raises(SelfTestFailed, match="Bar: Force 16 N, allowed 1 N: relieve it") as raised:
        mechanism_results(calculated(own), {})
    assert [found.id for found in raised.value.checks] == ["own"]


def test_in_a_study_self_tests_make_errors_and_what_is_not_checked_has_columns() -> None:
    own = check("doubled", 20.0, id="own", check_class="numerical")
    values = flatten(Bar.model_validate({})) | {"force": np.array([8.0, 12.0])}
    calc = calculate(bar(own, check("doubled", 20.0), check("doubled", "rated", id="b")), values, 2)
    found = variant_rows.verdicts({"bar": calc}, 2)
    assert found.names == ["bar.checks.c"] and found.unchecked == ["bar.checks.b"]
    assert list(found.faults) == [1] and "Bar" in found.faults[1]


@pytest.mark.parametrize("given", [{}, {"check_class": "strenght"}])
def test_a_check_without_an_allowed_class_is_told_with_those_that_are(given: dict[str, str]) -> None:
    texts: dict[str, Any] = {
        "id": "c",
        "title": "Bar",
        "demand_label": "f",
        "limit_label": "a",
        "consequence": "",
        "unit": "N",
    }
    [fault] = faults(bar(Check(demand="doubled", limit=3.0, **texts, **given)))
    assert "check c" in str(fault) and all(
        word in str(fault) for word in ("function", "strength", "practice", "numerical")
    )


def test_keys_that_there_are_not_are_told_of_a_check() -> None:
    told = " ".join(
        map(
            str,
            faults(
                bar(
                    check(
                        "doubled",
                        3.0,
                        only_with=("widht",),
                        at_best=("wieght",),
                        founded=("k",),
                        sized_unless=("rate",),
                    )
                )
            ),
        )
    )
    assert "only_with names widht" in told and "sized_unless names rate" in told
    assert "at_best names wieght" in told and "founded names k" in told


def test_a_kind_that_no_plugin_has_is_told_of_a_check_beside_it() -> None:
    """Such a check would never be made, and nobody would miss it."""
    discovery = Discovery([])
    assert list(_strange_partners(discovery.mechanism("press_consistency"), discovery)) == []
    timing = discovery.mechanism("cyclogram")
    misspelt = replace(
        timing, checks=tuple(replace(each, only_beside=("cylinder_drvie",)) for each in timing.checks[:1])
    )
    [told] = map(str, _strange_partners(misspelt, discovery))
    assert "no plugin has the kind cylinder_drvie" in told
