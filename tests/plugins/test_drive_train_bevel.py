"""A pair of bevel gears is drawn as one: cones whose sides meet, and not discs."""

from __future__ import annotations

from diecut_report.plugins.drive_train.figures import _pair


def test_the_cones_of_a_bevel_pair_touch_and_taper_and_its_label_says_so() -> None:
    *cones, words = _pair(10.0, 40.0, 0.0, (20, 40), "bevel")
    driver, driven = (list(each["points"]) for each in cones)
    heights = [[y for _, y in each] for each in (driver, driven)]
    assert min(heights[0]) == max(heights[1])  # they touch between the shafts
    for each in (driver, driven):
        wide, narrow = (
            sorted(y for x, y in each if x == at) for at in (min(x for x, _ in each), max(x for x, _ in each))
        )
        assert narrow[1] - narrow[0] < wide[1] - wide[0]  # each is wider on one side
    assert str(words["text"]) == "bevel, z = 20 : 40"
    spur = _pair(10.0, 40.0, 0.0, (20, 40), "spur")
    assert str(spur[-1]["text"]) == "z = 20 : 40"
    assert len({y for _, y in spur[0]["points"]}) == 2
