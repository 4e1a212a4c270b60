"""Links, pipes and devices where files are to be written or plugins are sought: what they point to stays as it is, none is waited for."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from itertools import product
from pathlib import Path

import pytest

from diecut_report.cli.main import main
from diecut_report.files import remove_stale, write, write_all
from tests.configs import GOOD, LEVER, saved
from tests.examples import few

SECRET = b"not to be touched"


@pytest.fixture
def secret(tmp_path: Path) -> Path:
    """A file of somebody else."""
    path = tmp_path / "elsewhere" / "secret"
    path.parent.mkdir()
    path.write_bytes(SECRET)
    return path


def calc(config: Path, target: object) -> int:
    return main(["calc", str(config), "-o", str(target), "--plugins", str(GOOD), "--quiet"])


@pytest.mark.parametrize("target", ["elsewhere/secret", "none", "out.json"], ids=["a file", "nothing", "itself"])
def test_calc_replaces_a_link_and_not_its_target(tmp_path: Path, secret: Path, target: str) -> None:
    link = tmp_path / "out.json"
    link.symlink_to(tmp_path / target)
    assert calc(saved(tmp_path, LEVER), link) == 0 and link.is_file() and not link.is_symlink()
    assert secret.read_bytes() == SECRET and not (tmp_path / "none").exists()


def test_a_second_name_of_a_file_keeps_the_content(tmp_path: Path, secret: Path) -> None:
    twin = tmp_path / "twin.json"
    twin.hardlink_to(secret)
    assert calc(saved(tmp_path, LEVER), twin) == 0
    assert secret.read_bytes() == SECRET


@pytest.mark.parametrize("kind", ["link", "pipe", "device"])
def test_files_of_a_folder_are_replaced_whatever_stands_there(tmp_path: Path, secret: Path, kind: str) -> None:
    place = tmp_path / "summary.html"
    if kind == "pipe":
        os.mkfifo(place)
    else:
        place.symlink_to(secret if kind == "link" else "/dev/full")
    write_all({place: b"new"}, keep=tmp_path / "study.json")
    assert place.read_bytes() == b"new" and not place.is_symlink() and secret.read_bytes() == SECRET
    place.unlink()
    place.symlink_to(secret)
    write(place, b"newer")
    assert place.read_bytes() == b"newer" and secret.read_bytes() == SECRET


def test_a_link_to_a_folder_is_not_taken_for_a_file(
    tmp_path: Path, secret: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    link = tmp_path / "link.json"
    link.symlink_to(secret.parent)
    assert calc(saved(tmp_path, LEVER), link) == 2
    assert "a folder has this name" in capfd.readouterr().err and link.is_symlink()


@pytest.mark.parametrize(
    ("name", "to_file"),
    few(
        product(("/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"), (True, False)),
        keep=lambda one: one == ("/dev/stdout", True),
    ),
)
def test_the_names_of_standard_output_are_written_into(tmp_path: Path, name: str, to_file: bool) -> None:
    config, out = saved(tmp_path, LEVER), tmp_path / "out"
    command = [sys.executable, "-m", "diecut_report", "calc", str(config), "-o", name, "--plugins", str(GOOD)]
    if to_file:
        with out.open("wb") as file:
            assert subprocess.run(command, stdout=file).returncode == 0
        told = out.read_bytes()
    else:
        done = subprocess.run(command, stdout=subprocess.PIPE)
        assert done.returncode == 0
        told = done.stdout
    assert told.startswith(b"{\n") and told.endswith(b"}\n")
    assert Path("/dev/stdout").is_symlink() and not Path(name).name.endswith(".part")


def test_a_link_among_what_a_killed_run_left_is_removed_alone(tmp_path: Path, secret: Path) -> None:
    folder = tmp_path / "study"
    folder.mkdir()
    (folder / ".a.part").symlink_to(secret.parent)
    (folder / ".b.part").symlink_to(secret)
    remove_stale(folder)
    assert list(folder.iterdir()) == [] and secret.read_bytes() == SECRET


@pytest.mark.parametrize("name", ["variants", "reports", "tables"])
def test_a_folder_of_a_study_that_is_a_link_is_refused(
    stored: Path, tmp_path: Path, secret: Path, capfd: pytest.CaptureFixture[str], name: str
) -> None:
    if (stored / name).exists():
        (stored / name).rename(tmp_path / "moved")
    (stored / name).symlink_to(secret.parent)
    assert main(["batch", "--resume", str(stored), "--plugins", str(GOOD), "--quiet"]) == 2
    assert f"{stored / name}: This is a link." in capfd.readouterr().err
    assert sorted(secret.parent.iterdir()) == [secret]


def calculated(tmp_path: Path) -> subprocess.CompletedProcess[str]:
    """What becomes of a lever with the plugins of a folder; one that waits fails the test."""
    command = [
        sys.executable,
        "-P",
        "-m",
        "diecut_report",
        "validate",
        saved(tmp_path, LEVER),
        "--plugins",
        tmp_path / "plugins",
    ]
    return subprocess.run(list(map(str, command)), capture_output=True, text=True, timeout=60)


@pytest.mark.nightly
def test_pipes_beside_a_plugin_are_no_part_of_it(tmp_path: Path) -> None:
    folder = tmp_path / "plugins" / "lever"
    folder.mkdir(parents=True)
    shutil.copy(GOOD / "lever.py", folder / "__init__.py")
    for name in ("data.json", "other.py", "../data.json", "../other.py"):
        os.mkfifo(folder / name)
    assert calculated(tmp_path).returncode == 0


@pytest.mark.nightly
def test_a_pipe_is_not_a_plugin(tmp_path: Path) -> None:
    (tmp_path / "plugins").mkdir()
    os.mkfifo(tmp_path / "plugins" / "lever.py")
    done = calculated(tmp_path)
    assert done.returncode == 2 and "'lever' is not a known kind" in done.stderr
    (tmp_path / "plugins" / "kinds.yaml").write_text("lever: lever.py", "utf-8")
    done = calculated(tmp_path)
    assert done.returncode == 3 and "it is not a regular file" in done.stderr
