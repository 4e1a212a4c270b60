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

from diecut_report.cli.main import main
from tests.configs import GOOD, LEVER, saved
from tests.processes import until
from tests.study.studies import varied

ROWS = 8_192
SPENT = 180  # seconds after which a run hangs
PARTS = 16  # files
STUDY = varied(f"{{from: 1 kN, to: 3 kN, count: {ROWS}}}")
TABLE = """\
schema_version: 1
base: ../press.yaml
sample: {method: zip}
vary:
  mechanisms.a.force: {table: ../data/x.csv, column: force}
  mechanisms.a.arm: {table: x.csv, column: arm}
"""


ROOT = Path(__file__).parents[2]
PLACE = os.environ | {"PYTHONPATH": str(ROOT), "DELAY": "0.3"}


pytestmark = pytest.mark.usefixtures("without_summary")
Run = Callable[..., tuple[int, str, str]]


@pytest.fixture
def finished(capfd: pytest.CaptureFixture[str]) -> Run:
    """Give the command, run to its end in this process: its exit code, standard output and error."""

    def run(*arguments: str | Path) -> tuple[int, str, str]:
        code = main(["batch", *map(str, arguments), "--plugins", str(GOOD)])
        return code, *capfd.readouterr()

    return run


@contextmanager
def begun(folder: Path, parts: int) -> Iterator[subprocess.Popen[str]]:
    """A run of the study in two processes that has finished some parts, in a process group of its own."""
    saved(folder, LEVER)
    study = saved(folder, STUDY, "study.yaml")
    program = [sys.executable, "-m", "tests.study.without_summary"]
    asked = [*program, "batch", study, "-o", folder / "out", "--jobs", "2", "--plugins", GOOD]
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


@pytest.mark.nightly
@pytest.mark.parametrize("after", [3, 5, 8, 10])
def test_killed_run_is_continued_without_its_study(tmp_path: Path, after: int, finished: Run) -> None:
    out = tmp_path / "out"
    with begun(tmp_path, after) as run:
        end(run, run.kill)
    before = stored(out)
    damaged = sorted(before)[2]
    (out / "variants" / damaged).write_bytes(b"PAR1")
    (out / "variants/.0123456789abcdef.part").write_bytes(b"PAR1")
    (tmp_path / "study.yaml").unlink()
    (tmp_path / "press.yaml").unlink()
    assert after <= len(before) < PARTS
    code, told, said = finished("--resume", out, "--jobs", "1")
    then = stored(out)
    assert (code, told) == (0, "") and f"{ROWS} variants: {ROWS} pass" in said
    assert {name for name in before if then[name] != before[name]} == {damaged}
    assert len(then) == PARTS and are_complete(out)


def test_a_study_that_is_continued_without_its_file_keeps_its_name(tmp_path: Path, finished: Run) -> None:
    saved(tmp_path, LEVER)
    study, out = saved(tmp_path, STUDY.replace(f"{ROWS}", "3"), "speeds of the press.yaml"), tmp_path / "out"
    finished(study, "-o", out)
    before = json.loads((out / "study.json").read_text())
    next((out / "variants").iterdir()).unlink()
    assert finished("--resume", out)[0] == 0
    again = json.loads((out / "study.json").read_text())
    assert before["study"] == again["study"] == "speeds of the press.yaml"


@pytest.mark.nightly
@pytest.mark.parametrize("whole_group", [True, False])
def test_interrupted_run_says_how_to_continue_and_is_continued_by_its_own_study_alone(
    tmp_path: Path, whole_group: bool, finished: Run
) -> None:
    """Ctrl-C reaches all processes of a terminal; `kill -INT` only the one that it names."""
    out = tmp_path / "out"
    with begun(tmp_path, 2) as run:
        said = end(run, lambda: (os.killpg if whole_group else os.kill)(run.pid, signal.SIGINT))
    assert run.returncode == 130
    assert said == ("", f"stopped; what is finished is kept. Continue with: diecut-report batch --resume {out}\n")
    before = stored(out)
    assert 2 <= len(before) < PARTS and list(out.rglob(".*.part")) == []
    study = saved(tmp_path, STUDY.replace("3 kN", "4 kN"), "study.yaml")
    code, _, told = finished(study, "--resume", out)
    assert code == 2 and "study.yaml: The study file has changed since the results were begun." in told
    assert f"+  mechanisms.a.force: {{from: 1 kN, to: 4 kN, count: {ROWS}}}" in told
    assert stored(out) == before
    assert finished(saved(tmp_path, STUDY, "study.yaml"), "--resume", out, "--jobs", "1")[0] == 0
    assert before.items() <= stored(out).items() and are_complete(out)


@pytest.mark.nightly
def test_second_run_in_a_folder_is_refused_and_the_first_goes_on_even_without_a_worker(
    tmp_path: Path, finished: Run
) -> None:
    out = tmp_path / "out"
    with begun(tmp_path, 2) as run:
        os.killpg(run.pid, signal.SIGSTOP)  # it holds the folder as long as this takes
        for second in (finished(tmp_path / "study.yaml", "-o", out), finished("--resume", out)):
            assert second[:2] == (2, "")
            assert second[2].startswith(f"{out}: Another run uses this folder: process {run.pid} on ")
        workers = [each for each in psutil.Process(run.pid).children() if "spawn_main" in " ".join(each.cmdline())]
        workers[0].kill()
        os.killpg(run.pid, signal.SIGCONT)
        said = run.communicate(timeout=SPENT)
    assert run.returncode == 0 and f"{ROWS} variants" in said[1] and are_complete(out)


@pytest.mark.nightly
def test_tables_are_kept_with_the_results(tmp_path: Path, finished: Run) -> None:
    """Two tables of one name, one of them outside of the study's folder; workers get them too."""
    place = tmp_path / "studies"
    for folder in (place, tmp_path / "data"):
        folder.mkdir()
    saved(tmp_path, LEVER)
    saved(tmp_path / "data", "force [N]\n" + "".join(f"{n}\n" for n in range(1000, 3000)), "x.csv")
    saved(place, "arm [mm]\n" + "".join(f"{n / 10}\n" for n in range(1000, 3000)), "x.csv")
    study = saved(place, TABLE, "study.yaml")
    out = tmp_path / "out"
    assert finished(study, "-o", out, "--jobs", "2")[0] == 0
    whole = pq.read_table(out / "variants").drop_columns(["error"])
    assert whole["a.moment"].to_numpy() == pytest.approx([n * n / 1e4 for n in range(1000, 3000)], rel=1e-14)
    for part in (0, 3):
        (out / f"variants/part-0000{part}.parquet").unlink()
    for kept in (place, tmp_path / "data"):
        shutil.rmtree(kept)
    (tmp_path / "press.yaml").unlink()
    code, _, told = finished("--resume", out, "--jobs", "2")
    assert code == 0, told
    assert pq.read_table(out / "variants").drop_columns(["error"]).equals(whole)
    assert sorted(path.name for path in (out / "tables").iterdir()) == ["1-x.csv", "2-x.csv"]
    (out / "variants/part-00001.parquet").unlink()
    (out / "tables/2-x.csv").write_text("arm [mm]\n1\n")
    code, _, told = finished("--resume", out)
    assert code == 2 and "2-x.csv: This copy of x.csv is missing or has changed" in told
