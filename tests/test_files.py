"""A file that is replaced keeps its mode, owner and names."""

from __future__ import annotations

import hashlib
import os
import stat
from collections.abc import Callable
from pathlib import Path

import pytest

from diecut_report import files
from diecut_report.study.storage.state_form import continuing

Write = Callable[[Path, bytes], None]
WAYS = [files.write, lambda path, content: files.write_all({path: content}, None)]


@pytest.fixture(params=WAYS, ids=["write", "write_all"])
def write(request: pytest.FixtureRequest) -> Write:
    """One of the two ways to write a file."""
    found: Write = request.param
    return found


@pytest.mark.parametrize("mode", [0o600, 0o640, 0o664, 0o755])
def test_a_file_keeps_its_mode(write: Write, mode: int, tmp_path: Path) -> None:
    path = tmp_path / "a"
    path.write_bytes(b"before")
    path.chmod(mode)
    write(path, b"after")
    assert path.read_bytes() == b"after" and stat.S_IMODE(path.stat().st_mode) == mode


def test_a_file_keeps_its_owner_where_that_may_be(
    write: Write, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    given: list[tuple[int, int]] = []
    monkeypatch.setattr(os, "chown", lambda _path, user, group: given.append((user, group)))
    path = tmp_path / "a"
    path.write_bytes(b"before")
    write(path, b"after")
    assert given == [(path.stat().st_uid, path.stat().st_gid)]

    def refused(*_: object) -> None:
        raise PermissionError

    monkeypatch.setattr(os, "chown", refused)
    write(path, b"again")
    assert path.read_bytes() == b"again"


def test_all_names_of_a_file_hold_what_it_is_rewritten_with(tmp_path: Path) -> None:
    path, other = tmp_path / "a", tmp_path / "b"
    path.write_bytes(b"before, and longer")
    other.hardlink_to(path)
    files.write(path, b"after", instead_of=hashlib.sha256(b"before, and longer").hexdigest())
    assert other.read_bytes() == b"after" and path.samefile(other)
    assert sorted(each.name for each in tmp_path.iterdir()) == ["a", "b"]


def test_a_link_is_replaced_and_what_it_points_to_kept(write: Write, tmp_path: Path) -> None:
    path, other = tmp_path / "a", tmp_path / "b"
    other.write_bytes(b"kept")
    path.symlink_to(other)
    write(path, b"after")
    assert other.read_bytes() == b"kept" and path.read_bytes() == b"after" and not path.is_symlink()


def test_a_file_that_is_another_by_now_is_not_replaced(tmp_path: Path) -> None:
    path = tmp_path / "a"
    path.write_bytes(b"saved meanwhile")
    with pytest.raises(files.UserError, match="Another program has saved this file"):
        files.write(path, b"after", instead_of="0" * 64)
    assert path.read_bytes() == b"saved meanwhile" and list(tmp_path.iterdir()) == [path]


def test_the_command_that_continues_a_study_is_one_that_can_be_typed() -> None:
    assert continuing(Path("my study; rm x"), {}) == "diecut-report batch --resume 'my study; rm x'"
    assert continuing(Path("a\nb\x1b"), {}).isprintable()
