"""A real Dask cluster on this machine: a scheduler and two workers as processes of their own."""

from __future__ import annotations

import os
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pyarrow.parquet as pq
import pytest

from diecut_report.errors import UserError
from diecut_report.study.execution import dask_cluster as module
from diecut_report.study.execution.engines import SAFE_PATH, Function, results
from diecut_report.study.execution.study_run import Counts, Where, dask_cluster, run_study
from tests.configs import GOOD
from tests.design.optimisation.searches import optimised, search_file
from tests.processes import until
from tests.study.made_store import dies_at_three, fails_at_three, slow_square, square, warm
from tests.study.studies import study

ROOT = Path(__file__).parents[2]


@dataclass
class Cluster:
    """Processes of a cluster; all are ended with it."""

    address: str
    folder: Path
    started: list[subprocess.Popen[bytes]] = field(default_factory=list)

    def start(self, *arguments: str) -> subprocess.Popen[bytes]:
        environment = os.environ | {"PYTHONPATH": str(ROOT), "DASK_DISTRIBUTED__SCHEDULER__ALLOWED_FAILURES": "2"}
        with (self.folder / "log").open("ab") as log:
            command = [sys.executable, "-m", "dask", *arguments]
            self.started.append(subprocess.Popen(command, stdout=log, stderr=log, env=environment, cwd=self.folder))
        return self.started[-1]

    def worker(self) -> subprocess.Popen[bytes]:
        where = ("--local-directory", str(self.folder), "--no-dashboard")
        return self.start("worker", self.address, "--nthreads", "1", "--no-nanny", *where)


def is_open(port: int) -> bool:
    """Whether something listens there."""
    with socket.socket() as asked:
        return asked.connect_ex(("127.0.0.1", port)) == 0


@pytest.fixture
def cluster(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Cluster]:
    monkeypatch.setattr(module, "TIMEOUT", 60)  # the machine may be busy
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    folder = tmp_path / "cluster"
    folder.mkdir()
    made = Cluster(f"tcp://127.0.0.1:{port}", folder)
    try:
        made.start("scheduler", "--host", "127.0.0.1", "--port", str(port), "--no-dashboard")
        until(lambda: is_open(port), 60)
        yield made
    finally:
        for process in reversed(made.started):
            process.kill()
            process.wait(timeout=60)


def calculated(address: str, folder: Path, function: Function, chunks: Iterable[int]) -> list[tuple[int, Any]]:
    with dask_cluster(address, warm(folder)) as engine:
        return list(results(engine, function, chunks))


STUDY = """\
schema_version: 1
base: press.yaml
sample: {method: latin_hypercube, count: 40000}
constraints: ["mechanisms.a.force < '2.95 kN'"]
vary:
  mechanisms.a.force: {from: 1 kN, to: 3 kN}
  mechanisms.a.arm: [100 mm, 150 mm, 200 mm]
  mechanisms.a.grade: [fine, coarse]
"""


@pytest.mark.nightly
def test_study_on_a_cluster_that_loses_a_worker_has_the_rows_of_one_in_this_process(
    cluster: Cluster, tmp_path: Path
) -> None:
    first, _ = cluster.worker(), cluster.worker()
    made = study(tmp_path, STUDY)
    killed = []

    def kill(counts: Counts) -> None:
        if counts.done > 5000 and not killed:
            killed.append(counts.done)
            first.send_signal(signal.SIGKILL)

    remote, own = (Where(jobs=1, dask=address, plugins=(str(GOOD),)) for address in (cluster.address, None))
    there = run_study(made, tmp_path / "there", remote, resume=False, tell=kill)
    here = run_study(made, tmp_path / "here", own, resume=False, tell=lambda _: None)
    assert killed and killed[0] < 40_000
    assert there.counts == here.counts and there.counts["dropped"] == 1000 and there.counts["pass"] > 10_000
    rows = [pq.read_table(outcome.store.directory / "variants") for outcome in (there, here)]
    assert rows[0].equals(rows[1]) and rows[0].num_rows == 39_000


@pytest.mark.nightly
def test_a_search_on_a_cluster_has_the_bytes_of_one_in_this_process(
    cluster: Cluster, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("diecut_report.design.optimisation.command._files", lambda *_: {})
    cluster.worker()
    asked = search_file(tmp_path, more="evaluations: 900, population: 300")  # two chunks in a generation
    assert optimised(asked, tmp_path / "there", "--quiet", "--dask", cluster.address) == 0
    assert optimised(asked, tmp_path / "here", "--quiet") == 0
    there, here = (sorted((tmp_path / name / "variants").iterdir()) for name in ("there", "here"))
    assert [path.read_bytes() for path in there] == [path.read_bytes() for path in here] and len(here) == 3


@pytest.mark.nightly
def test_worker_that_joins_later_takes_part(cluster: Cluster, tmp_path: Path) -> None:
    cluster.worker()
    workers = set()
    with dask_cluster(cluster.address, warm(tmp_path)) as engine:
        for chunk, (_, process) in results(engine, slow_square, range(300)):
            workers.add(process)
            if chunk == 0:
                cluster.worker()
            if len(workers) == 2:
                break
    assert len(workers) == 2


@pytest.mark.nightly
def test_exception_names_its_chunk_and_the_cluster_can_be_used_again(cluster: Cluster, tmp_path: Path) -> None:
    cluster.worker()
    with pytest.raises(ZeroDivisionError) as caught:
        calculated(cluster.address, tmp_path, fails_at_three, range(100))
    assert caught.value.__notes__ == ["while calculating 3"]
    assert sorted(calculated(cluster.address, tmp_path, square, range(30))) == [(n, n * n) for n in range(30)]


@pytest.mark.nightly
def test_chunk_that_ends_its_workers_is_told(cluster: Cluster, tmp_path: Path) -> None:
    for _ in range(4):
        cluster.worker()
    with pytest.raises(UserError, match="process that calculates 3 ended"):
        calculated(cluster.address, tmp_path, dies_at_three, [3])


@pytest.mark.nightly
def test_lost_scheduler_is_told(cluster: Cluster, tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    cluster.worker()
    with (
        pytest.raises(UserError, match=r"cannot be reached any more\. .*--resume"),
        dask_cluster(cluster.address, warm(tmp_path)) as engine,
    ):
        for chunk, _ in results(engine, slow_square, range(1000)):
            if chunk == 2:
                cluster.started[0].kill()
    assert [record.name for record in caplog.records] == []  # no traceback beside the words


@pytest.mark.nightly
def test_cluster_without_workers_is_told(cluster: Cluster, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "TIMEOUT", 2)
    with pytest.raises(UserError, match=f"no workers.*dask worker {cluster.address}"):
        calculated(cluster.address, tmp_path, square, [])


@pytest.mark.parametrize("address", ["foo://127.0.0.1:8786", "127.0.0.1", "nonsense", "tcp://127.0.0.1:port"])
def test_address_that_is_none_is_told(tmp_path: Path, address: str) -> None:
    with pytest.raises(UserError, match=r"not an address of a Dask scheduler.*tcp://HOST:PORT"):
        calculated(address, tmp_path, square, [])


@pytest.mark.nightly
@pytest.mark.parametrize("address", ["tcp://127.0.0.1:1", "nosuch.invalid:8786"])
def test_scheduler_that_is_not_there_is_told_within_its_time(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, address: str
) -> None:
    monkeypatch.setattr(module, "TIMEOUT", 2)
    began = time.monotonic()
    with pytest.raises(UserError, match=f"scheduler at .*{address} cannot be reached"):
        calculated(address, tmp_path, square, [])
    assert time.monotonic() - began < 5


def test_worker_with_another_version_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(UserError, match=r"has version .* of the program, this is 9\.9"):
        module._work("9.9", "key", square, 1)


@pytest.mark.nightly
def test_a_worker_started_as_it_is_told_runs_nothing_from_its_folder(cluster: Cluster, tmp_path: Path) -> None:
    """As the message says: PYTHONSAFEPATH=1; also the process that the worker's nanny starts."""
    told = tmp_path / "trapped"
    for name in ("multiprocessing", "yaml", "numpy"):
        (cluster.folder / f"{name}.py").write_text(f"open({str(told)!r}, 'a').write({name!r})\n", "utf-8")
    unsafe = {name: value for name, value in os.environ.items() if name != SAFE_PATH}
    subprocess.run(
        [sys.executable, "-m", "dask", "--version"], cwd=cluster.folder, env=unsafe, capture_output=True, check=False
    )
    assert told.exists()  # where the folder comes first they are run
    told.unlink()
    safe = unsafe | {SAFE_PATH: "1", "PYTHONPATH": str(ROOT)}
    command = [sys.executable, "-m", "dask", "worker", cluster.address, "--nthreads", "1", "--no-dashboard"]
    with (cluster.folder / "log").open("ab") as log:
        cluster.started.append(subprocess.Popen(command, stdout=log, stderr=log, env=safe, cwd=cluster.folder))
    found = calculated(cluster.address, tmp_path, square, range(3))
    assert sorted(found) == [(0, 0), (1, 1), (2, 4)] and not told.exists()
