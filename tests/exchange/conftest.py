"""What follows from a configuration, and the pages of results, made once for all tests of a module."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any

import pytest

from diecut_report.exchange import verification
from diecut_report.press import Press


@pytest.fixture(scope="module")
def known() -> dict[str, Any]:
    """What has been calculated and set, by what it was made of."""
    return {}


@pytest.fixture
def made_once(known: dict[str, Any], monkeypatch: pytest.MonkeyPatch) -> None:
    """However often a report is verified, its configuration is calculated once, and its pages are set once."""

    def once(home: object, name: str, of: Callable[..., str]) -> None:
        make = getattr(home, name)

        def made(*given: Any) -> Any:
            key = f"{name} {of(*given)}"
            return known[key] if key in known else known.setdefault(key, make(*given))

        monkeypatch.setattr(home, name, made)

    def of_press(press: Press) -> str:
        tree = press.config.tree
        return f"{tree.text}{tree.name}{tree.sha256}{press.config.files}"

    once(Press, "calculate", of_press)
    once(verification, "with_findings", lambda made: of_press(made.press))
    once(verification, "document", lambda results, formats, *_: f"{formats} {json.dumps(results.data())}")
