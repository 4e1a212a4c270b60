"""The drive's drawing as it moves on a screen: rigid links at every place."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from diecut_report.config.discovery import Discovery
from diecut_report.pipeline import calc

CONFIG = Path(__file__).parents[2] / "benchmarks" / "two_mechanisms.yaml"


def test_links_keep_their_lengths_and_the_pin_follows_the_cursor() -> None:
    results = calc(CONFIG, Discovery([]), lambda _: None)[0].results
    figure = next(each for each in results["mechanisms"]["drive"]["figures"] if "moving" in each)
    moving = figure["moving"]
    links = [next(shape for shape in frame if shape["role"] == "link") for frame in moving["frames"]]
    joints = np.array([shape["points"] for shape in links])  # place, joint, coordinate
    lengths = np.hypot(*np.moveaxis(np.diff(joints, axis=1), -1, 0))
    assert np.ptp(lengths, axis=0).max() < 1e-9
    pins = joints[:, 1] - joints[:, 0]
    assert np.allclose(pins / lengths[:, :1], np.stack([np.cos(moving["places"]), np.sin(moving["places"])], axis=1))
    assert len(moving["places"]) <= 38 and moving["places"] == sorted(moving["places"])
