"""The built site is looked at in a browser: what a page says there, and what it does not show, is told."""

from __future__ import annotations

from pathlib import Path

import pytest

from tools.site import look

MENU = '<div class="sidebar-tree"></div>'
DRAWN = "<figure class=drawn><svg></svg></figure><math></math>"


def site(folder: Path, index: str, gallery: str) -> Path:
    (folder / "gallery").mkdir()
    (folder / "index.html").write_text(f"<!doctype html><title>Site</title>{index}", "utf-8")
    (folder / "gallery" / "circular_knife.html").write_text(f"<!doctype html><title>Knife</title>{gallery}", "utf-8")
    return folder


@pytest.mark.nightly
def test_pages_that_complain_or_show_nothing_are_told(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    assert look.main(site(tmp_path, f"{MENU}<script>nothere()</script>", "empty")) == 1
    told = capfd.readouterr().out
    assert 'index.html: "Uncaught ReferenceError: nothere is not defined' in told
    assert "gallery/circular_knife.html: what a reader comes for is not shown" in told


@pytest.mark.nightly
def test_sound_pages_are_looked_at(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    assert look.main(site(tmp_path, MENU, DRAWN)) == 0
    assert capfd.readouterr().out == "looked at in a browser: index.html, gallery/circular_knife.html\n"


def test_without_a_browser_it_is_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(look, "PROGRAMS", ())
    monkeypatch.delenv("CHROMIUM", raising=False)
    assert look.main(tmp_path) == 0
    assert "not looked at in a browser: chromium is not installed" in capfd.readouterr().out
