"""A file that is replaced keeps its mode, owner, attributes and names."""

from __future__ import annotations

import errno
import hashlib
import os
import signal
import stat
import struct
import time
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

import pytest

from diecut_report import files
from diecut_report.errors import Unwritable, UserError
from diecut_report.study.storage.description import continuing

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

    def refused(_path: object, user: int, group: int) -> None:
        given.append((user, group))
        raise PermissionError

    given.clear()
    monkeypatch.setattr(os, "chown", refused)
    write(path, b"again")
    assert path.read_bytes() == b"again"
    assert given[1] == (-1, path.stat().st_gid)  # whoever may not give it away leaves it at least to its group


ACCESS = "system.posix_acl_access"
LIST = struct.pack(
    "<I" + "HHI" * 5, 2, 1, 6, 2**32 - 1, 2, 6, 12345, 4, 4, 2**32 - 1, 16, 6, 2**32 - 1, 32, 0, 2**32 - 1
)
"""An access list: u::rw-,u:12345:rw-,g::r--,m::rw-,o::---"""


def given(path: Path, name: str, value: bytes) -> None:
    """Set an attribute; skip the test where the disk has none."""
    try:
        os.setxattr(path, name, value)
    except OSError as error:
        pytest.skip(f"no attributes here: {error}")


def test_a_file_keeps_its_access_list_and_attributes(write: Write, tmp_path: Path) -> None:
    path = tmp_path / "a"
    path.write_bytes(b"before")
    given(path, ACCESS, LIST)
    given(path, "user.origin", b"office")
    write(path, b"after")
    assert os.getxattr(path, ACCESS) == LIST and os.getxattr(path, "user.origin") == b"office"


def test_a_file_without_an_access_list_does_not_get_that_of_its_folder(write: Write, tmp_path: Path) -> None:
    path = tmp_path / "a"
    path.write_bytes(b"before")
    path.chmod(0o640)
    given(tmp_path, "system.posix_acl_default", LIST)
    write(path, b"after")
    assert ACCESS not in os.listxattr(path) and stat.S_IMODE(path.stat().st_mode) == 0o640


def test_what_is_to_take_the_place_of_a_file_is_read_by_nobody_else_meanwhile(tmp_path: Path) -> None:
    path = tmp_path / "a"
    with files.replaced(path) as temporary:
        assert stat.S_IMODE(temporary.stat().st_mode) == 0o666 & ~umask()
    with files.replaced(path) as temporary:
        assert stat.S_IMODE(temporary.stat().st_mode) == 0o600


def umask() -> int:
    """Return what this process takes from the modes of new files."""
    found = os.umask(0)
    os.umask(found)
    return found


def test_all_names_of_a_file_hold_what_it_is_rewritten_with(tmp_path: Path) -> None:
    path, other = tmp_path / "a", tmp_path / "b"
    path.write_bytes(b"before, and longer")
    other.hardlink_to(path)
    files.write(path, b"after", instead_of=hashlib.sha256(b"before, and longer").hexdigest())
    assert other.read_bytes() == b"after" and path.samefile(other)
    assert sorted(each.name for each in tmp_path.iterdir()) == ["a", "b"]


def test_a_full_disk_leaves_all_names_of_a_file_as_they_were(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path, other = tmp_path / "a", tmp_path / "b"
    path.write_bytes(b"before")
    other.hardlink_to(path)

    def full(*_: object) -> None:
        raise OSError(errno.ENOSPC, "full")

    monkeypatch.setattr(os, "posix_fallocate", full)
    with pytest.raises(Unwritable, match=r"the disk is full\. Nothing was written; free disk space and try again"):
        files.write(path, b"after, and longer", instead_of=hashlib.sha256(b"before").hexdigest())
    assert other.read_bytes() == b"before" and len(list(tmp_path.iterdir())) == 2


def test_an_interrupt_leaves_nothing_half_written(
    write: Write, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A Ctrl-C may come as soon as the temporary file is there."""
    touch = Path.touch

    def interrupted(path: Path, *args: int, **more: bool) -> None:
        touch(path, *args, **more)
        raise KeyboardInterrupt

    monkeypatch.setattr(Path, "touch", interrupted)
    with pytest.raises(KeyboardInterrupt):
        write(tmp_path / "a", b"new")
    assert list(tmp_path.iterdir()) == []


def test_the_system_ends_a_run_and_nothing_is_left_half_written(
    write: Write, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    touch = Path.touch

    def ended(path: Path, *args: int, **more: bool) -> None:
        touch(path, *args, **more)
        os.kill(os.getpid(), signal.SIGTERM)

    monkeypatch.setattr(Path, "touch", ended)
    child = os.fork()
    if not child:
        with suppress(KeyboardInterrupt):
            write(tmp_path / "a", b"new")
        os._exit(7)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 7 and list(tmp_path.iterdir()) == []
    assert signal.getsignal(signal.SIGTERM) is signal.SIG_DFL


def test_a_link_is_replaced_and_what_it_points_to_kept(write: Write, tmp_path: Path) -> None:
    path, other = tmp_path / "a", tmp_path / "b"
    other.write_bytes(b"kept")
    path.symlink_to(other)
    write(path, b"after")
    assert other.read_bytes() == b"kept" and path.read_bytes() == b"after" and not path.is_symlink()


def test_a_file_that_is_another_by_now_is_not_replaced(tmp_path: Path) -> None:
    path = tmp_path / "a"
    path.write_bytes(b"saved meanwhile")
    with pytest.raises(UserError, match="Another program has saved this file"):
        files.write(path, b"after", instead_of="0" * 64)
    assert path.read_bytes() == b"saved meanwhile" and list(tmp_path.iterdir()) == [path]


def test_what_another_program_saves_until_the_last_moment_stays(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path, synced = tmp_path / "a", files._sync
    path.write_bytes(b"before")

    def saved_meanwhile(file: Path) -> None:
        synced(file)
        path.write_bytes(b"saved meanwhile")

    monkeypatch.setattr(files, "_sync", saved_meanwhile)  # it takes longest of all
    with pytest.raises(UserError, match="Another program has saved this file"):
        files.write(path, b"after", instead_of=hashlib.sha256(b"before").hexdigest())
    assert path.read_bytes() == b"saved meanwhile"


def test_a_file_in_place_of_a_link_has_the_mode_of_a_new_one(tmp_path: Path) -> None:
    (tmp_path / "led to").touch()
    (tmp_path / "link").symlink_to(tmp_path / "led to")
    files.write_all({tmp_path / "link": b"x", tmp_path / "new": b"x"}, keep=None)
    assert (tmp_path / "link").lstat().st_mode == (tmp_path / "new").lstat().st_mode


def test_temporary_files_are_removed_where_the_system_ends_the_program(tmp_path: Path) -> None:
    with pytest.raises(KeyboardInterrupt), files.room(tmp_path):
        assert list(tmp_path.iterdir())
        os.kill(os.getpid(), signal.SIGTERM)
        time.sleep(10)
    assert not list(tmp_path.iterdir()) and signal.getsignal(signal.SIGTERM) is signal.SIG_DFL


def test_a_file_that_is_gone_by_now_is_not_made_again(tmp_path: Path) -> None:
    with pytest.raises(UserError, match="Another program has saved this file"):
        files.write(tmp_path / "a", b"after", instead_of="0" * 64)
    assert not list(tmp_path.iterdir())


def test_the_command_that_continues_a_study_is_one_that_can_be_typed() -> None:
    assert continuing(Path("my study; rm x"), {}) == "diecut-report batch --resume 'my study; rm x'"
    assert continuing(Path("a\nb\x1b"), {}).isprintable()
