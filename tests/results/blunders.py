"""The published press with one text changed."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path

PRESS = Path(import_module("diecut_report.configs").__path__[0]) / "flat_cylinder_press.yaml"


def changed(folder: Path, old: str, new: str) -> Path:
    """Write the press with its first such text changed."""
    text = PRESS.read_text(encoding="utf-8")
    assert old in text
    file = folder / "press.yaml"
    file.write_text(text.replace(old, new, 1), encoding="utf-8")
    return file
