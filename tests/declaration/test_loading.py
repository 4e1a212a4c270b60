"""A faulty plugin of others is as one that cannot be loaded; a sound one is remembered until one of its files changes."""

from __future__ import annotations

import json
import os
from pathlib import Path

import pytest

from diecut_report import declaration
from diecut_report.cli.main import main
from diecut_report.config.plugins import Discovery
from diecut_report.errors import PluginError
from tests.configs import GOOD

LEVER = (GOOD / "lever.py").read_text("utf-8")
CONFIG = """\
schema_version: 1
project: {title: Test}
press: {name: P}
mechanisms:
  a: {kind: lever, force: 2 kN, speed: 1 rpm}
  b: {kind: faulty, force: 2 kN, speed: 1 rpm}
"""


@pytest.fixture(autouse=True)
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder of its own for what is remembered."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    return tmp_path / "cache" / "diecut-report" / "declarations"


def plugin(folder: Path, name: str, *changes: tuple[str, str]) -> Path:
    text = LEVER.replace('kind="lever"', f'kind="{name}"')
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    folder.mkdir(exist_ok=True)
    (folder / f"{name}.py").write_text(text, "utf-8")
    return folder


WRONG = (('needs=("width",)', 'needs=("widht",)'), ("is {teeth};", "is {tooth};"))


def test_all_faults_are_told_with_plugin_file_and_line(tmp_path: Path) -> None:
    with pytest.raises(PluginError) as caught:
        Discovery([plugin(tmp_path / "own", "faulty", *WRONG)]).mechanism("faulty")
    head, *lines = str(caught.value).splitlines()
    assert head == f"plugin 'faulty': {tmp_path / 'own' / 'faulty.py'} has invalid declarations:"
    assert [line.split(":")[0].strip() for line in lines] == ["faulty.py"] * len(lines)
    assert any(
        "step pressure: needs names widht, which is not an input (did you mean 'width'?)" in line for line in lines
    )
    assert any("step teeth_limit: the message names tooth, which nothing gives" in line for line in lines)


def test_a_faulty_plugin_gives_3_and_the_results_of_the_others(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "press.yaml").write_text(CONFIG)
    folder = plugin(tmp_path / "own", "faulty", *WRONG)
    assert main(["calc", str(tmp_path / "press.yaml"), "--plugins", str(GOOD), "--plugins", str(folder)]) == 3
    out, err = capfd.readouterr()
    found = json.loads(out)["mechanisms"]
    assert found["a"]["outputs"]["moment"]["value"] == 200 and found["b"]["status"] == "error"
    assert err.startswith("mechanism 'b' of plugin 'faulty':") and "widht" in err and "tooth" in err


def judged(folder: Path, name: str, monkeypatch: pytest.MonkeyPatch) -> int:
    """How often the plugin is judged when it is loaded."""
    count = []
    real = declaration.faults
    monkeypatch.setattr(declaration, "faults", lambda mechanism: count.append(1) or real(mechanism))
    Discovery([folder]).mechanism(name)
    monkeypatch.setattr(declaration, "faults", real)
    return len(count)


def test_a_sound_plugin_is_judged_once_until_it_changes(
    tmp_path: Path, cache: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = plugin(tmp_path / "own", "own")
    assert [judged(folder, "own", monkeypatch) for _ in range(2)] == [1, 0]
    assert len(list(cache.iterdir())) == 1
    (folder / "own.py").write_text((folder / "own.py").read_text("utf-8") + "\n# changed\n", "utf-8")
    assert judged(folder, "own", monkeypatch) == 1


@pytest.mark.parametrize("place", ["", "relative", "/dev/null/nowhere"])
def test_where_nothing_can_be_remembered_the_plugin_is_judged_each_time(
    place: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", place)
    monkeypatch.setenv("HOME", "/dev/null")
    folder = plugin(tmp_path / "own", "own")
    assert [judged(folder, "own", monkeypatch) for _ in range(2)] == [1, 1]
    assert not os.path.exists("relative")


def test_the_programs_own_plugins_are_not_judged_at_run_time(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(declaration, "faults_at_load", lambda mechanism: pytest.fail("judged"))
    assert Discovery().mechanism("cylinder_sizing").kind == "cylinder_sizing"
