"""Where an author's file declares something: every declared thing carries it, so that what is wrong with it is reported there."""

from __future__ import annotations

import sys
from dataclasses import field
from typing import Any

OWN = "diecut_report.contract"


def here() -> str:
    """Return the place, ``file:line``, of the call outside the contract that declares what is being made."""
    frame = sys._getframe(1)
    while frame.f_globals.get("__name__", "").startswith(OWN) and frame.f_back is not None:
        frame = frame.f_back
    return f"{frame.f_code.co_filename}:{frame.f_lineno}"


def placed() -> Any:
    """Return a field ``at`` with the place where its owner is declared: no part of its value, kept by ``dataclasses.replace``."""
    return field(default_factory=here, kw_only=True, repr=False, compare=False)


class Misdeclared(TypeError):
    """Report that what a plugin declares cannot be made; the text says so with the place that is named, or where it is declared now."""

    def __init__(self, text: str, at: str = "") -> None:
        super().__init__(f"{at or here()}: {text}")
