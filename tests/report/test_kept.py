"""Figures that are kept from one report to the next: the same to the last byte, and only while nothing changes that they show."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

import pytest

from diecut_report.report.figures import by_type, kept
from diecut_report.report.figures.by_type import render
from diecut_report.report.figures.style import SizesSize, Svg
from diecut_report.report.text import Catalogue
from diecut_report.results.figure_record import FigureRecord
from diecut_report.results.mechanism_record import CurveRecord
from tests.records import filled

WORDS = Catalogue("en")
QUARTERS = [0.0, 1.5, 3.0, 4.5]
PANEL = {"title": "T", "unit": "N", "series": [{"curve": "force", "label": ""}]}
PLOT = filled(FigureRecord, {"type": "plot", "title": "Force", "abscissa": "angle", "panels": [PANEL]})


def curves(*values: float, other: float = 0.0) -> dict[str, CurveRecord]:
    """Return an angle, a force over it, and a curve that no figure shows."""
    names = {"angle": (QUARTERS, "rad"), "force": (list(values), "N"), "other": ([other] * 4, "N")}
    return {
        name: filled(CurveRecord, {"values": each, "unit": unit, "display_unit": unit, "abscissa": "angle"})
        for name, (each, unit) in names.items()
    }


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return the folder of kept figures, which is not there yet."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    return tmp_path / "diecut-report" / "figures"


@pytest.fixture
def drawn(monkeypatch: pytest.MonkeyPatch) -> Iterator[list[str]]:
    """Return the keys of the figures that are really drawn."""
    keys, draw = list[str](), by_type.drawn
    monkeypatch.setattr(by_type, "drawn", lambda build, title, key: (keys.append(key), draw(build, title, key))[1])
    yield keys


def plot(
    *values: float, other: float = 0.0, key: str = "A.1", language: str = "en", size: SizesSize = SizesSize.LOW
) -> Svg:
    """Return the figure of a force."""
    return render(PLOT, curves(*values, other=other), Catalogue(language), key, size)


def test_a_figure_of_the_same_data_is_drawn_once(folder: Path, drawn: list[str]) -> None:
    first, again = plot(1, 2, 3, 4), plot(1, 2, 3, 4, other=5)
    assert first == again and drawn == ["A.1"], "a curve that it does not show is nothing to it"
    assert len(list(folder.iterdir())) == 1


@pytest.mark.parametrize(
    "more", [{"key": "A.2"}, {"language": "uk"}, {"size": SizesSize.LARGE}], ids=["number", "language", "size"]
)  # fmt: skip
def test_a_figure_with_anything_else_is_drawn_anew(folder: Path, drawn: list[str], more: dict[str, str]) -> None:
    plot(1, 2, 3, 4)
    assert plot(1, 2, 3, 4.000000000000001).text and plot(1, 2, 3, 4, **more).text  # type: ignore[arg-type]
    assert len(drawn) == 3 and len(list(folder.iterdir())) == 3


def test_other_code_draws_anew(folder: Path, drawn: list[str], monkeypatch: pytest.MonkeyPatch) -> None:
    plot(1, 2, 3, 4)
    monkeypatch.setattr(kept, "_code", lambda: "of another version")
    plot(1, 2, 3, 4)
    assert len(drawn) == 2


@pytest.mark.parametrize("damage", [b"", b"{", b'["<svg onload=1>", "1", 2]', b'["<svg/>", 1.0]', b"\xff"])
def test_what_is_damaged_is_drawn_anew_and_mended(folder: Path, drawn: list[str], damage: bytes) -> None:
    made = plot(1, 2, 3, 4)
    [file] = folder.iterdir()
    whole = file.read_bytes()
    file.write_bytes(damage)
    assert plot(1, 2, 3, 4) == made and len(drawn) == 2 and file.read_bytes() == whole


@pytest.mark.parametrize("mode", [0o777, 0o770, 0o702])
def test_a_folder_that_others_may_write_into_is_not_used(folder: Path, drawn: list[str], mode: int) -> None:
    plot(1, 2, 3, 4)
    folder.chmod(mode)
    plot(1, 2, 3, 4)
    assert len(drawn) == 2


def test_without_a_folder_figures_are_drawn(tmp_path: Path, drawn: list[str], monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "file").touch()
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "file"))
    assert plot(1, 2, 3, 4) == plot(1, 2, 3, 4) and len(drawn) == 2
    kept.make_room()


def test_of_too_many_figures_those_written_first_are_removed(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(kept, "MAX_KEPT", 3)
    for number in range(4):
        plot(1, 2, 3, number)
        newest = max(folder.iterdir(), key=lambda file: file.stat().st_mtime_ns)
        os.utime(newest, (number, number))
    kept.make_room()
    assert sorted(file.stat().st_mtime for file in folder.iterdir()) == [2, 3]
