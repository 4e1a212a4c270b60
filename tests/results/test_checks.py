"""Checks on rows, on curves and with two bounds, alone and in a study; those that are not made; and the self-tests of the calculation."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
import pytest

from diecut_report.api import (
    Block,
    Chapter,
    Check,
    Inputs,
    Mechanism,
    OneOf,
    Quantity,
    Text,
    block,
    formula,
    m,
    parts,
    samples,
    value,
)
from diecut_report.config.plugins import Discovery
from diecut_report.declaration import faults
from diecut_report.machine.calculation import Calculation
from diecut_report.machine.steps.run import calculate
from diecut_report.mechanism.inputs import flatten
from diecut_report.mechanism.names import Misdeclared
from diecut_report.mechanism.steps import Abscissa, Value
from diecut_report.report.chapters.chapters import chapter
from diecut_report.report.equations import Equations
from diecut_report.report.text import Catalogue
from diecut_report.results.checks import check_results
from diecut_report.results.conclusion import governing, summary
from diecut_report.results.mechanism import SelfTestFailed, mechanism_results
from diecut_report.results.mechanism_record import CheckRecord, PlaceRecord
from diecut_report.study.execution import variant_rows
from diecut_report.testing.contract import _strange_partners


class Rung(Block):
    load = Quantity("F", "N", "Load of the bar")
    rated = Quantity("F_r", "N", "Rated load", optional=True)


class Rack(Inputs):
    bars = parts(Rung, "Bars")
    strength = Quantity("F_z", "N", "Strength", default=10)
    swing = Quantity("a", "N", "Amplitude", default=3)
    phase = Quantity("α", "rad", "Phase", default=0.1)
    play = Quantity("j", "mm", "Play", default=0.3)
    n_points = samples(36)


@formula
def doubled(load: Any) -> Any:
    return 2 * load


@formula
def wave(angle: Any, swing: Any, phase: Any) -> Any:
    return swing * np.sin(angle - phase)


@formula
def bound_of(angle: Any, swing: Any) -> Any:
    return swing * (2 + np.cos(angle))


def check(demand: Any, limit: Any, **changes: Any) -> Check:
    texts = {"id": "c", "title": "Bars", "demand_label": "force", "limit_label": "allowed", "consequence": "relieve it"}
    known = {"check_class": "strength", "unit": "N", "demand": demand, "limit": limit}
    return Check(**{**texts, **known, **changes})


def rack(*checks: Check) -> Mechanism:
    steps = (
        Value(id="force", symbol="S", unit="N", description="Force", formula=doubled.of(load=m.bars.load)),
        Abscissa(id="angle", symbol="φ", unit="deg", description="Angle", period=2 * np.pi),
        Value(id="torque", symbol="T", unit="N", description="Wave", formula=wave),
        Value(id="bound", symbol="B", unit="N", description="Bound", formula=bound_of),
    )
    chapters = (Chapter("All", steps=steps),)
    return Mechanism(kind="rack", version="1", title="", summary="", inputs=Rack, chapters=chapters, checks=checks)


def calculated(made: Check, loads: tuple[float, ...] = (1, 6, 4), **values: Any) -> Calculation:
    bars = [{"load": load} for load in loads]
    given = flatten(Rack.model_validate({"bars": bars, **values}))
    return calculate(rack(made), given)


def judged(made: Check, **values: Any) -> CheckRecord:
    [found] = check_results(calculated(made, **values))
    return found


def test_a_check_on_a_row_judges_every_part_and_the_worst_governs() -> None:
    found = judged(check("force", "strength", consequence="relieve bar {part}, that of {bars.load}"))
    assert [(p.status, p.utilisation) for p in found.parts] == [("pass", 0.2), ("fail", 1.2), ("pass", 0.8)]
    assert (found.status, found.part, found.demand, found.limit, found.utilisation) == ("fail", 2, 12, 10, 1.2)  # fmt: skip
    assert found.message == "Force 12 N, allowed 10 N at part 2 of 3: relieve bar 2, that of 6 N"


@pytest.mark.parametrize("index", [3, -4])
def test_a_part_that_there_is_not_is_told_at_its_check(index: int) -> None:
    template = r"test_checks\.py:\d+: check c is of part index={} alone, counted from 0, but there are 3 parts"
    with pytest.raises(Misdeclared, match=template.format(index)):
        judged(check("bars.load", 5.0, index=index))
    assert judged(check("bars.load", 5.0, index=2)).demand == 4


def test_a_margin_that_is_the_rounding_of_equal_sides_is_none() -> None:
    limit = 8.812338466287342  # kg·m² of a wheel's side, added up in another order
    for above, margin in ((1.8e-15, 0), (1e-6, -1e-6)):
        (found,) = check_results(calculated(check(limit + above, limit, tolerance=1e-3, unit="kg*m**2")))
        assert found.status == "pass" and float(found.margin_display.text) == margin


@pytest.mark.parametrize("limit", [12.0, -12.0, 0.3])
def test_a_demand_at_its_limit_holds_but_for_rounding(limit: float) -> None:
    size = abs(limit)
    assert judged(check(limit + 5e-10 * size, limit)).status == "pass"
    assert judged(check(limit + 2e-9 * size, limit)).status == "fail"
    assert judged(check(limit, limit, operator="<")).status == "fail"  # what must be below is
    assert judged(check(limit - 1e-12 * size, limit, operator="<")).status == "pass"


def test_a_row_may_be_the_limit_too() -> None:
    found = judged(check(3.0, "force"), loads=(5, 1, 1))
    assert (found.status, found.part, found.limit) == ("fail", 2, 2)  # of two alike the first
    assert [part.limit for part in found.parts] == [10, 2, 2]


def test_of_parts_without_a_utilisation_the_one_furthest_beyond_governs() -> None:
    found = judged(check("force", 0.0))
    assert (found.part, found.utilisation) == (2, None)


def test_a_part_without_the_quantity_is_not_judged() -> None:
    rated = check("force", "bars.rated")
    given = flatten(Rack.model_validate({"bars": [{"load": 9}, {"load": 2, "rated": 5}, {"load": 1, "rated": 1}]}))
    [found] = check_results(calculate(rack(rated), given))
    assert [part.status for part in found.parts] == [None, "pass", "fail"] and found.part == 3
    given = flatten(Rack.model_validate({"bars": [{"load": 9}, {"load": 2, "rated": 5}, {"load": 1, "rated": 4}]}))
    calc = calculate(rack(rated), given)
    [left] = check_results(calc)  # the others hold, of it nobody knows
    assert (left.status, left.missing) == ("not_checked", ["bars.0.rated"])
    assert variant_rows.verdicts({"rack": calc}, 1).unchecked == ["rack.checks.c"]
    [unmade] = check_results(calculated(rated))
    assert (unmade.status, unmade.missing) == ("not_checked", ["bars.rated"])
    assert (unmade.demand, unmade.limit) == (12, None)


def test_a_check_on_a_curve_judges_its_extreme_and_not_its_samples() -> None:
    found = judged(check("torque", 2.999))
    # of the 36 samples none is above 2.992
    assert found.status == "fail" and found.demand == pytest.approx(3, rel=1e-12)
    assert found.message == "Force 3 N, allowed 2.999 N at φ = 95.73°: relieve it"
    assert found.at == PlaceRecord(symbol="φ", text="95.73", unit="deg")


def test_two_curves_are_compared_where_the_one_is_furthest_beyond_the_other() -> None:
    found = judged(check("torque", "bound"), phase=0.0)
    place = np.deg2rad(135)  # of the greatest sin φ − cos φ − 2
    assert found.demand == pytest.approx(3 * np.sin(place), rel=1e-6)
    assert found.limit == pytest.approx(3 * (2 + np.cos(place)), rel=1e-6) and found.at and found.at.text == "135"


def test_a_curve_may_be_what_there_is() -> None:
    found = judged(check(-3.5, "torque"))
    assert found.status == "pass" and found.limit == pytest.approx(-3, rel=1e-12)


BOUNDS = {0.1: ("fail", "Play 0.1 mm, at least 0.2 mm (allowed 0.4 mm): relieve it", 2.0),
          0.21: ("pass", "Play 0.21 mm, at least 0.2 mm (allowed 0.4 mm).", 0.2 / 0.21),
          0.39: ("pass", "Play 0.39 mm, allowed 0.4 mm (at least 0.2 mm).", 0.39 / 0.4),
          0.5: ("fail", "Play 0.5 mm, allowed 0.4 mm (at least 0.2 mm): relieve it", 1.25)}  # fmt: skip


@pytest.mark.parametrize("play", BOUNDS)
def test_a_two_sided_check_is_judged_on_both_sides_and_names_the_one_that_governs(play: float) -> None:
    found = judged(check("play", 0.4, at_least=0.2, unit="mm", demand_label="play"), play=play)
    status, message, utilisation = BOUNDS[play]
    assert (found.status, found.message) == (status, message)
    assert found.utilisation == pytest.approx(utilisation) == found.demand / found.limit


def test_a_two_sided_check_on_a_row_and_on_a_curve() -> None:
    found = judged(check("force", 20.0, at_least=4.0))
    assert [part.utilisation for part in found.parts] == pytest.approx([2, 0.6, 0.5])
    assert found.part == 1 and found.message == "Force 2 N, at least 4 N (allowed 20 N) at part 1 of 3: relieve it"
    low = judged(check("torque", 5.0, at_least=-2.0))
    assert low.status == "fail" and low.limit == pytest.approx(-3) and low.at and low.at.text == "275.73"


CHECKS = (
    check("force", "strength"), check("torque", 2.5), check("torque", "bound", operator="<"), check(3.0, "force"),
    check("play", 0.4, at_least=0.2, unit="mm"), check("force", 11.0, at_least=1.0), check("torque", 2.5, at_least=-2.0),
    check("bars.load", 5.0, severity="warn"),
)  # fmt: skip


@pytest.mark.parametrize("number", range(len(CHECKS)))
@pytest.mark.parametrize("count", [3, 12])
def test_a_study_judges_as_each_machine_alone(number: int, count: int) -> None:
    made = rack(CHECKS[number])
    random = np.random.default_rng(number)
    varied = {name: random.uniform(*ends, count) for name, ends in
              {"strength": (1, 15), "swing": (1, 5), "phase": (0, 6), "play": (1e-4, 5e-4)}.items()}  # fmt: skip
    loads = random.uniform(0.2, 7, (3, count))
    together = calculate(made, {"bars": True, "n_points": 36, **varied, "bars.load": tuple(loads)}, count)
    found = variant_rows.verdicts({"rack": together}, count)
    for i in range(count):
        one = {name: values[i] for name, values in varied.items()}
        alone = calculate(made, {"bars": True, "n_points": 36, **one, "bars.load": tuple(loads[:, i])})
        [single] = check_results(alone)
        assert variant_rows.STATUS[found.codes[0, i]] == single.status
        expected = np.nan if single.utilisation is None else single.utilisation
        np.testing.assert_allclose(found.ratios[0, i], expected, rtol=1e-9)


def test_the_report_shows_the_worst_part_and_a_table_of_all() -> None:
    results = mechanism_results(calculated(check("force", "strength")), {})
    part = chapter("A", "rack", results, Equations(Catalogue("en"), lambda _: 0.0), Catalogue("en"))
    [row] = part.checks
    assert row.title == "Bars, no. 2" and row.demand.startswith("12") and row.parts is not None
    lines = [(number, *(cell.text for cell in cells)) for number, cells in row.parts.lines]
    assert [line[0] for line in lines] == ["1", "2", "3"] and [line[1] for line in lines] == ["2", "12", "8"]
    assert [line[4] for line in lines] == ["pass", "fail", "pass"]


# Checks that are not made for want of a key, or do not apply, and the self-tests of the calculation.


class Stop(Block):
    reach = Quantity("a", "N", "Reach", gt=0)
    allowable_reach = Quantity("[a]", "N", "Allowed reach", gt=0, optional=True)


class Bar(Inputs):
    one_of = (OneOf(("load",), ("weight", "tare"), optional=True),)

    force = Quantity("F", "N", "Force", gt=0, default=8)
    rated = Quantity("F_r", "N", "Rated force", gt=0, optional=True)
    least = Quantity("F_l", "N", "Least force", gt=0, optional=True)
    width = Quantity("b", "N", "Width", gt=0, optional=True)
    load = Quantity("L", "N", "Load", gt=0, optional=True)
    weight = Quantity("W", "N", "Weight", gt=0, optional=True)
    tare = Quantity("T", "N", "Tare", gt=0, optional=True)
    material = Text("Material", ("steel", "wood"), default="wood")
    stop = block(Stop, "Stop", optional=True)


bar_check = partial(check, title="Bar")


def bar(*checks: Check) -> Mechanism:
    chapter = Chapter("All")
    chapter.doubled = 2 * m.force, "D", "N", "Doubled"
    chapter.slack = value(10 - m.force, exists=m.force < 10), "Δ", "N", "Slack"
    chapter.spread = value(m.force + m.width, needs=("width",)), "S", "N", "Spread"
    chapter.bent = value(3 * m.force, needs=("material=steel",)), "B", "N", "Bent"
    chapter.weighed = value(m.weight - m.tare, needs=("weight", "tare")), "G", "N", "Weighed"
    return Mechanism(kind="bar", version="1", title="Bar", summary="", inputs=Bar, chapters=(chapter,), checks=checks)


def calculated_bar(*checks: Check, **values: Any) -> Calculation:
    return calculate(bar(*checks), flatten(Bar.model_validate(values)))


def made_bar(*checks: Check, **values: Any) -> list[CheckRecord]:
    return check_results(calculated_bar(*checks, **values))


def test_a_check_whose_limit_is_not_given_is_listed_with_its_demand_and_the_key() -> None:
    [found] = made_bar(bar_check("doubled", "rated"))
    assert (found.status, found.check_class, found.missing) == ("not_checked", "strength", ["rated"])
    assert (found.demand, found.limit, found.utilisation) == (16, None, None)
    assert found.message == "Not checked: force 16 N, but rated is not given."


def test_what_is_needed_for_the_demand_is_named_too_in_the_order_of_the_keys() -> None:
    [found] = made_bar(bar_check("spread", "rated"))
    assert (found.missing, found.demand) == (["rated", "width"], None)
    assert found.message == "Not checked: rated and width are not given."
    [found] = made_bar(bar_check("least", "doubled"))
    assert found.message == "Not checked: allowed 16 N, but least is not given."


@pytest.mark.parametrize(
    ("one", "given"),
    [
        (bar_check("bent", "rated"), {}),
        (bar_check("bent", "rated"), {"rated": 5}),
        (bar_check("stop.reach", "stop.allowable_reach"), {}),
        (bar_check("weighed", "rated"), {"load": 5, "rated": 3}),
        (bar_check("doubled", "rated", only_with=("width",)), {}),
        (bar_check("doubled", "rated", check_class="numerical"), {}),
    ],
    ids=["text", "text with its limit", "block", "alternative", "only with", "self-test"],
)  # fmt: skip
def test_what_does_not_apply_is_left_out(one: Check, given: dict[str, Any]) -> None:
    assert made_bar(one, **given) == []


def test_what_this_machine_does_not_have_is_not_asked_for() -> None:
    assert [one.missing for one in made_bar(bar_check("slack", "rated"), force=9)] == [["rated"]]
    assert made_bar(bar_check("slack", "rated"), force=11) == []


def test_what_applies_and_lacks_a_key_is_told() -> None:
    assert made_bar(bar_check("bent", "rated"), material="steel")[0].missing == ["rated"]
    assert made_bar(bar_check("stop.reach", "stop.allowable_reach"), stop={"reach": 3})[0].missing == [
        "stop.allowable_reach"
    ]
    assert made_bar(bar_check("weighed", "rated"))[0].missing == ["rated", "weight", "tare"]
    assert made_bar(bar_check("doubled", "rated", only_with=("width",)), width=1)[0].missing == ["rated"]


def test_of_checks_with_one_id_the_one_that_is_made_is_reported_else_the_first() -> None:
    both = bar_check("spread", "rated"), bar_check("doubled", "rated")
    assert [found.status for found in made_bar(*both, rated=20)] == ["pass"]
    assert len(made_bar(*both)) == 1


def test_what_is_not_checked_changes_no_status_and_is_counted() -> None:
    results = mechanism_results(
        calculated_bar(bar_check("doubled", 20.0, id="a"), bar_check("doubled", "rated", id="b")), {}
    )
    assert results.status == "pass" and results.absent == []
    counts = {"pass": 1, "warn": 0, "fail": 0, "not_checked": 1, "numerical": {"pass": 0, "fail": 0}}
    assert results.counts.data() == counts and summary({"bar": results.checks}, []).governing == "bar.a"


@pytest.mark.parametrize(
    ("near", "given", "governs"),
    [
        ({"id": "sized", "sized_unless": ("width",)}, {}, "far"),
        ({"id": "sized", "sized_unless": ("width",)}, {"width": 1}, "sized"),
        ({"id": "sized", "sized_unless": ("width",)}, {"force": 9}, "sized"),  # it fails
        ({"id": "same", "limit": 16.0}, {}, "same"),  # what stands exactly at a given limit was not sized by the program
        ({"id": "range", "presumed": True}, {}, "far"),  # that a machine lies well within the range of a method is no reserve
        ({"id": "range", "presumed": True}, {"force": 9}, "range"),  # it does not hold
        ({"id": "own", "check_class": "numerical"}, {}, "far"),
    ],
)  # fmt: skip
def test_what_shows_no_reserve_does_not_govern_unless_it_fails(near: Any, given: Any, governs: str) -> None:
    first = bar_check("doubled", near.get("limit", 16.5), **{key: near[key] for key in near if key != "limit"})
    results = mechanism_results(calculated_bar(first, bar_check("doubled", 160.0, id="far"), **given), {})
    found, other = results.checks
    assert str(governing({"bar": results.checks})) == f"bar.{governs}"
    assert found.sized_to_limit is ("sized_unless" in near and "width" not in given) and not other.sized_to_limit
    assert found.presumed is ("presumed" in near) and not other.presumed
    is_own, counts = found.check_class == "numerical", results.counts
    assert counts.numerical.data() == {"pass": int(is_own), "fail": 0} and counts.passing + counts.fail == 2 - is_own
    assert found.utilisation == found.demand / found.limit


def test_a_self_test_that_fails_leaves_no_results() -> None:
    own = bar_check("doubled", 1.0, id="own", check_class="numerical", severity="warn")
    with pytest.raises(SelfTestFailed, match="Bar: Force 16 N, allowed 1 N: relieve it") as raised:
        mechanism_results(calculated_bar(own), {})
    assert [found.id for found in raised.value.checks] == ["own"]


def test_in_a_study_self_tests_make_errors_and_what_is_not_checked_has_columns() -> None:
    own = bar_check("doubled", 20.0, id="own", check_class="numerical")
    values = flatten(Bar.model_validate({})) | {"force": np.array([8.0, 12.0])}
    calc = calculate(bar(own, bar_check("doubled", 20.0), bar_check("doubled", "rated", id="b")), values, 2)
    found = variant_rows.verdicts({"bar": calc}, 2)
    assert found.names == ["bar.checks.c"] and found.unchecked == ["bar.checks.b"]
    assert list(found.faults) == [1] and "Bar" in found.faults[1]


@pytest.mark.parametrize(
    ("five", "options", "told"),
    [
        (("c", "strenght", "Bar", "doubled", 3.0), {}, "c has 'strenght' in the place of its class (safety, function, strength, "),
        (("c", "Bar", "strength", "doubled", 3.0), {}, "c has 'Bar' in the place of its class"),
        (("c", "strength", m.doubled, 3.0, "Bar"), {}, "c has m.doubled in the place of its title"),
        ((m.doubled, 3.0, "c", "strength", "Bar"), {}, " has m.doubled in the place of its id"),
        (("c", "strength", "Bar", True, 3.0), {}, "c has True in the place of a quantity or a number as its demand"),
        (("c", "strength", "Bar", "doubled", ("rated",)), {}, "c has ('rated',) in the place of a quantity or a number as its limit"),
        (("c", "strength", "Bar", "doubled"), {}, "c: missing a required argument: 'limit'"),
        (("c", "Bar", "doubled", 3.0), {}, "c has 'Bar' in the place of its class"),
        (("c", "strength", "Bar", "doubled", 3.0, "N"), {}, "c: too many positional arguments"),
        (("c", "strength", "Bar", "doubled", 3.0), {"demand_lable": "f"}, "c has no option demand_lable (did you mean 'demand_label'?)"),
    ],
)  # fmt: skip
def test_a_check_in_another_order_is_told_with_the_line_and_the_right_one(
    five: tuple[Any, ...], options: dict[str, Any], told: str
) -> None:
    with pytest.raises(Misdeclared) as refused:
        Check(*five, consequence="", **options)
    place, _, text = str(refused.value).partition(": ")
    assert place.startswith(__file__) and told in text
    assert options or 'write Check("id", "class", "title", m.demand, m.limit, consequence="…")' in text


def test_a_check_without_a_consequence_is_told() -> None:
    with pytest.raises(Misdeclared, match="check c: missing a required argument: 'consequence'; write Check"):
        Check("c", "strength", "Bar", "doubled", 3.0)  # type: ignore[call-arg]


def test_keys_that_there_are_not_are_told_of_a_check() -> None:
    wrong = {"only_with": ("widht",), "at_best": ("wieght",), "founded": ("k",), "sized_unless": ("rate",)}
    told = " ".join(map(str, faults(bar(bar_check("doubled", 3.0, **wrong)))))
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
