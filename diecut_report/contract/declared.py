"""Where in a plugin something is declared."""

from __future__ import annotations

import sys
from pathlib import Path

CONTRACT = str(Path(__file__).parent)


def declared_at() -> str:
    """Return ``file:line`` of the plugin's code that is declaring something just now."""
    frame = sys._getframe(1)
    while frame.f_back and (
        frame.f_code.co_filename.startswith(("<", CONTRACT)) or frame.f_globals.get("__name__") == "dataclasses"
    ):
        frame = frame.f_back
    return f"{frame.f_code.co_filename}:{frame.f_lineno}"
