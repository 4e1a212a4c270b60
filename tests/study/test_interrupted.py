"""A run that is ended in its middle, through the command line: nothing finished is lost or done again, no process stays."""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import psutil
import pyarrow.parquet as pq
import pytest

from tests.configs import GOOD, LEVER, saved
from tests.processes import until

ROWS = 120_000
SPENT = 60  # seconds after which a run hangs
PARTS = 16  # files, of at most 8192 variants
STUDY = """\
schema_version: 1
base: press.yaml
sample: {method: grid}
vary:
  mechanisms.a.force: {from: 1 kN, to: 3 kN, count: 120000}
"""
TABLE = """\
schema_version: 1
base: ../press.yaml
sample: {method: zip}
vary:
  mechanisms.a.force: {table: ../data/x.csv, column: force}
  mechanisms.a.arm: {table: x.csv, column: arm}
"""


ROOT = Path(__file__).parents[2]
PLACE = os.environ | {"PYTHONPATH": str(ROOT)}


def command(*arguments: str | Path) -> list[str]:
    return [sys.executable, "-m", "tests.study.without_summary", "batch", *map(str, arguments), "--plugins", str(GOOD)]


def finished(*arguments: str | Path) -> subprocess.CompletedProcess[str]:
    """The command, run to its end."""
    return subprocess.run(command(*arguments), capture_output=True, text=True, timeout=SPENT, check=False, env=PLACE)


@contextmanager
def begun(folder: Path, parts: int) -> Iterator[subprocess.Popen[str]]:
    """A run of the study in two processes that has finished some parts, in a process group of its own."""
    saved(folder, LEVER)
    study = saved(folder, STUDY, "study.yaml")
    asked = command(study, "-o", folder / "out", "--jobs", "2")
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    with subprocess.Popen(asked, **pipes, text=True, process_group=0, env=PLACE) as run:
        try:
            until(lambda: len(stored(folder / "out")) >= parts or run.poll() is not None, SPENT)
            assert run.poll() is None
            yield run
        finally:
            run.kill()


def stored(folder: Path) -> dict[str, tuple[int, int]]:
    """The part files, each with what tells whether it was written again."""
    found = (folder / "variants").glob("part-*.parquet")
    return {path.name: (path.stat().st_ino, path.stat().st_mtime_ns) for path in found}


def are_complete(folder: Path) -> bool:
    """Whether all variants are there, once each, with the values that they must have, and nothing half-written."""
    paths = sorted((folder / "variants").iterdir())
    columns: dict[str, Any] = {}
    for name in ("variant", "mechanisms.a.force", "a.moment", "a.arm"):
        columns[name] = np.concatenate([pq.read_table(path, columns=[name])[name].to_numpy() for path in paths])
    force = np.linspace(1000, 3000, ROWS)
    return (
        bool((columns["variant"] == np.arange(ROWS)).all())
        and np.allclose(columns["mechanisms.a.force"], force, rtol=1e-15)
        and np.allclose(columns["a.moment"], force * columns["a.arm"], rtol=1e-14)
        and json.loads((folder / "study.json").read_text())["state"] == "complete"
        and list(folder.rglob(".*.part")) == []
    )


def end(run: subprocess.Popen[str], by: Callable[[], None]) -> tuple[str, str]:
    """What the run says when it is ended; no process of it stays."""
    workers = psutil.Process(run.pid).children(recursive=True)
    assert len(workers) >= 2
    by()
    said = run.communicate(timeout=SPENT)
    until(lambda: not any(worker.is_running() for worker in workers), 20)
    return said


def test_killed_run_is_continued_without_its_study(tmp_path: Path) -> None:
    out = tmp_path / "out"
    with begun(tmp_path, 5) as run:
        end(run, run.kill)
    before = stored(out)
    damaged = sorted(before)[2]
    (out / "variants" / damaged).write_bytes(b"PAR1")
    (out / "variants/.0123456789abcdef.part").write_bytes(b"PAR1")
    (tmp_path / "study.yaml").unlink()
    (tmp_path / "press.yaml").unlink()
    assert 5 <= len(before) < PARTS
    run_again = finished("--resume", out)
    after = stored(out)
    assert (run_again.returncode, run_again.stdout) == (0, "") and "120000 variants: 120000 pass" in run_again.stderr
    assert {name for name in before if after[name] != before[name]} == {damaged}
    assert len(after) == PARTS and are_complete(out)


@pytest.mark.parametrize("whole_group", [True, pytest.param(False, marks=pytest.mark.nightly)])
def test_interrupted_run_says_how_to_continue_and_is_continued(tmp_path: Path, whole_group: bool) -> None:
    """Ctrl-C reaches all processes of a terminal; `kill -INT` only the one that it names."""
    out = tmp_path / "out"
    with begun(tmp_path, 3) as run:
        said = end(run, lambda: (os.killpg if whole_group else os.kill)(run.pid, signal.SIGINT))
    assert run.returncode == 130
    assert said == ("", f"stopped; what is finished is kept. Continue with: diecut-report batch --resume {out}\n")
    before = stored(out)
    assert 3 <= len(before) < PARTS and list(out.rglob(".*.part")) == []
    run_again = finished(tmp_path / "study.yaml", "--resume", out)
    assert run_again.returncode == 0
    assert before.items() <= stored(out).items() and are_complete(out)


def test_second_run_in_a_folder_is_refused_and_the_first_goes_on(tmp_path: Path) -> None:
    out = tmp_path / "out"
    with begun(tmp_path, 2) as run:
        os.killpg(run.pid, signal.SIGSTOP)  # it holds the folder as long as this takes
        for second in (finished(tmp_path / "study.yaml", "-o", out), finished("--resume", out)):
            assert (second.returncode, second.stdout) == (2, "")
            assert second.stderr.startswith(f"{out}: Another run uses this folder: process {run.pid} on ")
        os.killpg(run.pid, signal.SIGCONT)
        run.communicate(timeout=SPENT)
    assert run.returncode == 0 and are_complete(out)


def test_changed_study_is_refused_with_what_changed(tmp_path: Path) -> None:
    out = tmp_path / "out"
    with begun(tmp_path, 2) as run:
        end(run, run.kill)
    before = stored(out)
    study = saved(tmp_path, STUDY.replace("3 kN", "4 kN"), "study.yaml")
    refused = finished(study, "--resume", out)
    assert refused.returncode == 2
    assert "study.yaml: The study file has changed since the results were begun." in refused.stderr
    assert "+  mechanisms.a.force: {from: 1 kN, to: 4 kN, count: 120000}" in refused.stderr
    assert stored(out) == before


@pytest.mark.nightly
@pytest.mark.parametrize("after", [1, 3, 5, 8, 10])
def test_run_killed_at_any_time_is_continued(tmp_path: Path, after: int) -> None:
    out = tmp_path / "out"
    with begun(tmp_path, after) as run:
        end(run, run.kill)
    before = stored(out)
    assert finished("--resume", out).returncode == 0
    assert before.items() <= stored(out).items() and are_complete(out)


def test_killed_worker_is_replaced(tmp_path: Path) -> None:
    with begun(tmp_path, 2) as run:
        workers = [each for each in psutil.Process(run.pid).children() if "spawn_main" in " ".join(each.cmdline())]
        workers[0].kill()
        said = run.communicate(timeout=SPENT)
    assert run.returncode == 0 and "120000 variants" in said[1] and are_complete(tmp_path / "out")


def test_tables_are_kept_with_the_results(tmp_path: Path) -> None:
    """Two tables of one name, one of them outside of the study's folder; workers get them too."""
    place = tmp_path / "studies"
    for folder in (place, tmp_path / "data"):
        folder.mkdir()
    saved(tmp_path, LEVER)
    saved(tmp_path / "data", "force [N]\n" + "".join(f"{n}\n" for n in range(1000, 3000)), "x.csv")
    saved(place, "arm [mm]\n" + "".join(f"{n / 10}\n" for n in range(1000, 3000)), "x.csv")
    study = saved(place, TABLE, "study.yaml")
    out = tmp_path / "out"
    assert finished(study, "-o", out, "--jobs", "2").returncode == 0
    whole = pq.read_table(out / "variants").drop_columns(["error"])
    assert whole["a.moment"].to_numpy() == pytest.approx([n * n / 1e4 for n in range(1000, 3000)], rel=1e-14)
    for part in (0, 3):
        (out / f"variants/part-0000{part}.parquet").unlink()
    for kept in (place, tmp_path / "data"):
        shutil.rmtree(kept)
    (tmp_path / "press.yaml").unlink()
    again = finished("--resume", out, "--jobs", "2")
    assert again.returncode == 0, again.stderr
    assert pq.read_table(out / "variants").drop_columns(["error"]).equals(whole)
    assert sorted(path.name for path in (out / "tables").iterdir()) == ["1-x.csv", "2-x.csv"]
    (out / "variants/part-00001.parquet").unlink()
    (out / "tables/2-x.csv").write_text("arm [mm]\n1\n")
    refused = finished("--resume", out)
    assert refused.returncode == 2 and "2-x.csv: This copy of x.csv is missing or has changed" in refused.stderr
