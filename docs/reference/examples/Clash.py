"""Parts that stand in each other's way: for each part the index of the one that it clashes with, -1 for none."""

from __future__ import annotations

import numpy as np

from diecut_report.api import Block, Chapter, Inputs, Mechanism, Quantity, parts, total


class Cam(Block):
    place = Quantity("x", "mm", "Place on the shaft", ge=0)
    width = Quantity("w", "mm", "Width of the cam", gt=0)


class Camshaft(Inputs):
    cams = parts(Cam, "Cams on the shaft")


def overlapping(place, width):
    """Rows of shape (variants, parts); two cams overlap where they are nearer than half of their widths."""
    apart = abs(place[:, :, None] - place[:, None, :])
    near = (apart < (width[:, :, None] + width[:, None, :]) / 2) & ~np.eye(place.shape[1], dtype=bool)
    return np.where(near.any(axis=2), near.argmax(axis=2), -1)


room = Chapter("Room")
room.clash(
    "apart", overlapping, ("cams.place", "cams.width"), key="cams.{index}.place",
    message="puts cam {part} into cam {other}; move one of them",
)  # fmt: skip
room.width = total("sum", of="cams.width"), "w_Σ", "mm", "Widths of all cams"

MECHANISM = Mechanism(
    kind="camshaft", version="1.0", title="Camshaft", summary="Room on a camshaft.", inputs=Camshaft, chapters=(room,)
)

PRESS = """
mechanisms:
  camshaft: {kind: camshaft, cams: [{place: 0 mm, width: 10 mm}, {place: 30 mm, width: 20 mm}]}
"""
GIVES = {"camshaft.width": "30 mm"}
