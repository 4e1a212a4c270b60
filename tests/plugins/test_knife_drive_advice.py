"""What the failing checks of the folding knife advise: typed back in as printed it makes the check pass and spoils none that passed."""

from __future__ import annotations

import re
from typing import Any

import numpy as np
import pytest

from diecut_report.machine.calculation import Impossible
from diecut_report.plugins.knife_drive import advice
from diecut_report.results.checks import check_results
from tests.examples import few
from tests.plugins.test_knife_drive import INNER, LINKAGE, OUTER, PLANETARY, SLIDER, knife

LIMIT = re.compile(r"a (roller_ratio|cylinder_rate) of at (?:most|least) ([\d.e+-]+)")
RANGE = re.compile(r"a (roller_ratio) from ([\d.e+-]+) to ([\d.e+-]+)")
Keys = dict[str, Any]


def statuses(keys: Keys) -> dict[str, dict[str, Any]]:
    return {check.id: check for check in check_results(knife(**keys))}


def advised(message: str) -> list[tuple[str, float]]:
    """Keys and values that a message names."""
    ends = [(key, float(end)) for key, *pair in RANGE.findall(message) for end in pair]
    return [(key, float(value)) for key, value in LIMIT.findall(message)] + ends


def random_knife(draw: np.random.Generator) -> Keys:
    """A knife with any of the drives, some of its checks failing."""
    u = draw.uniform
    blocks = [
        {"planetary": {"carrier_radius": u(15, 80)}},
        {"crank_slider": {"crank_radius": u(25, 60), "rod_length": u(65, 200)}},
        {"crank_rocker": LINKAGE | {"knife_arm": u(80, 200), "lowest_dead_center": draw.choice(["outer", "inner"])}},
    ]
    keys: Keys = {"cylinder_rate": u(8000, 50000), "working_depth": u(15, 35), "roller_ratio": u(0.3, 4), "grip_angle": u(3, 15), "n_points": 36,
                  "allowable_paper_acceleration": u(100, 2000), "allowable_grip_acceleration": 10 ** u(2.5, 4)}  # fmt: skip
    for block in draw.permutation(np.arange(3))[: draw.integers(1, 4)]:
        keys |= blocks[block]
    return keys | ({"signature_length": u(100, 900)} if draw.random() < 0.7 else {})


@pytest.mark.parametrize(("count", "least"), few([(10, 0), (120, 20)], keep=lambda tried: tried[0] == 10))
def test_followed_advice_makes_its_check_pass_and_spoils_none(count: int, least: int) -> None:
    draw, followed = np.random.default_rng(5), {"paper": 0, "grip": 0, "time": 0}
    for _ in range(count):
        keys = random_knife(draw)
        before = statuses(keys)
        for name, check in before.items():
            for key, value in advised(check["message"]) if check["status"] == "fail" else ():
                after = statuses(keys | {key: value})
                assert after[name]["status"] == "pass", check["message"]
                spoilt = [n for n, c in after.items() if c["status"] == "fail" and before[n]["status"] == "pass"]
                assert spoilt == [], check["message"]
                followed[next(word for word in followed if word in name)] += 1
    assert min(followed.values()) > least


def test_a_given_speed_of_the_signature_leaves_only_the_rollers_to_change() -> None:
    for speed, word in (("0.5 m/s", "at most"), ("6 m/s", "from")):
        keys: Keys = {
            **SLIDER,
            "grip_speed": speed,
            "roller_ratio": 2 if word == "at most" else 0.2,
            "allowable_grip_acceleration": 900,
        }
        message = statuses(keys)["crank_slider_grip_acceleration"]["message"]
        assert word in message and "cylinder_rate" not in message
        for key, value in advised(message):
            assert statuses(keys | {key: value})["crank_slider_grip_acceleration"]["status"] == "pass"


def test_a_working_stroke_longer_than_the_interval_asks_for_another_drive() -> None:
    keys: Keys = {**SLIDER, "drive_ratio": 0.4, "signature_length": 273}
    assert "working stroke alone takes as long" in statuses(keys)["crank_slider_time_budget"]["message"]


def test_rollers_that_would_be_fast_enough_but_grip_too_hard_are_not_advised() -> None:
    keys: Keys = {**SLIDER, "signature_length": 900, "allowable_grip_acceleration": 6700}
    found = statuses(keys)
    assert found["crank_slider_grip_acceleration"]["status"] == "pass"
    assert "faster rollers would grip it too hard" in found["crank_slider_time_budget"]["message"]


@pytest.mark.parametrize("keys", [PLANETARY, SLIDER, OUTER, INNER], ids=["planetary", "slider", "outer", "inner"])
@pytest.mark.parametrize("wrong", [{"working_depth": 300}, {"grip_angle": 170}], ids=["depth", "grip"])
def test_what_a_refusal_names_is_possible_as_printed(keys: Keys, wrong: Keys) -> None:
    with pytest.raises(Impossible) as refused:
        knife(**keys, **wrong)
    found = re.search(r"at most ([\d.]+)", refused.value.message)
    assert found and refused.value.key in wrong
    knife(**keys, **{refused.value.key: float(found[1])})


@pytest.mark.parametrize("change", [{"crank": 85}, {"frame": 180}, {"rocker": 30}])
def test_the_crank_that_is_named_turns(change: Keys) -> None:
    links = LINKAGE | change
    words = advice.links(*(links[name] / 1000 for name in ("crank", "coupler", "rocker", "frame")))
    found = re.search(r"crank shorter than ([\d.]+) mm", words)
    assert found
    knife(crank_rocker=links | {"crank": 0.999 * float(found[1])}, working_depth=5)
    with pytest.raises(Impossible):
        knife(crank_rocker=links | {"crank": 1.001 * float(found[1])}, working_depth=5)
