"""Engines in this process and in a pool: the same results, nothing lost with a process, little in flight, a clean end, processes that are settled."""

from __future__ import annotations

import os
import platform
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path

import psutil
import pytest

from diecut_report.errors import UserError
from diecut_report.study.execution import engines
from diecut_report.study.execution.engines import Engine, InProcess, Pool, results
from diecut_report.study.execution.study_run import dask_cluster
from tests.examples import every
from tests.processes import at_most, until
from tests.study.made_store import dies_at_three, dies_in_its_result, fails_at_three, slow_square, square, warm

ROOT = Path(__file__).parents[2]
RUN = """
import sys
from pathlib import Path
from diecut_report.study.execution.engines import Pool, results
from tests.study.made_store import sleeps, warm
if __name__ == "__main__":
    folder = Path(sys.argv[1])
    try:
        with Pool(2, warm(folder)) as pool:
            list(results(pool, sleeps, range(100)))
    except KeyboardInterrupt:
        print("interrupted", flush=True)
"""
Make = Callable[[Path], Engine]
ENGINES = [lambda folder: InProcess(warm(folder)), lambda folder: Pool(2, warm(folder))]


def begun(folder: Path) -> set[int]:
    return {int(path.name.split(".")[1]) for path in folder.glob("begun.*")}


def alive(pool: Pool) -> list[int]:
    return [process.pid for process in pool._context.started if process.is_alive() and process.pid is not None]


@pytest.mark.parametrize(("make", "most"), list(zip(ENGINES, (1, 2), strict=True)))
def test_each_chunk_gives_its_result_once_and_a_worker_loads_once(tmp_path: Path, make: Make, most: int) -> None:
    with make(tmp_path) as engine:
        assert list(results(engine, square, [])) == []
        found = list(results(engine, square, range(50)))
    assert sorted(found) == [(n, n * n) for n in range(50)]
    loaded = [path.name.split(".")[1] for path in tmp_path.glob("loaded.*")]
    assert 1 <= len(loaded) == len(set(loaded)) <= most


def test_another_study_is_loaded_anew(tmp_path: Path) -> None:
    for key in ("one", "other"):
        with InProcess(warm(tmp_path, key)) as engine:
            list(results(engine, square, range(3)))
    assert len(list(tmp_path.glob("loaded.*"))) == 2


def test_chunks_are_taken_only_as_they_are_needed(tmp_path: Path) -> None:
    taken = 0

    def chunks() -> Iterator[int]:
        nonlocal taken
        while taken < 300:
            taken += 1
            yield taken

    with Pool(2, warm(tmp_path)) as pool:
        for given, _ in enumerate(results(pool, square, chunks())):
            assert taken - given <= pool.limit
    assert taken == 300


def test_memory_stays_flat_over_many_chunks(tmp_path: Path) -> None:
    with InProcess(warm(tmp_path)) as engine:
        found = results(engine, lambda _, chunk: bytes(1_000_000), iter(range(2000)))
        next(found)
        early = psutil.Process().memory_info().rss
        assert sum(1 for _ in found) == 1999
    assert psutil.Process().memory_info().rss - early < 20e6  # 2 GB went by


@pytest.mark.parametrize("make", ENGINES)
def test_exception_names_its_chunk_and_leaves_no_process(tmp_path: Path, make: Make) -> None:
    with (
        pytest.raises(ZeroDivisionError, match="nothing to divide by") as caught,
        make(tmp_path) as engine,
    ):
        list(results(engine, fails_at_three, range(1000)))
    assert caught.value.__notes__ == ["while calculating 3"]
    assert workers_of(os.getpid()) == []


def test_killed_process_loses_nothing(tmp_path: Path) -> None:
    found, killed = [], 0
    with Pool(2, warm(tmp_path)) as pool:
        for chunk, (value, _) in results(pool, slow_square, range(20)):
            found.append((chunk, value))
            if len(found) in (4, 9):  # in the middle of other chunks
                os.kill(alive(pool)[0], signal.SIGKILL)
                killed += 1
        assert killed == 2 and len(alive(pool)) == 2
    assert sorted(found) == [(n, n * n) for n in range(20)]
    assert len(begun(tmp_path)) > 2  # new processes took over


@pytest.mark.nightly
def test_process_killed_in_the_middle_of_a_result_loses_nothing(tmp_path: Path) -> None:
    """The rest of the result would be awaited for ever, as the other process could still write it."""
    with at_most(30), Pool(2, warm(tmp_path)) as pool:
        found = sorted(results(pool, dies_in_its_result, range(12)))
    assert found == [(n, n) for n in range(12)]
    assert len(begun(tmp_path)) > 2


def test_chunk_that_ends_its_process_is_told_after_three_times_and_no_other_is_blamed(tmp_path: Path) -> None:
    found = []
    with (
        pytest.raises(UserError, match=r"calculates 3 ended by itself 3 times.*fewer --jobs"),
        Pool(2, warm(tmp_path)) as pool,
    ):
        found.extend(chunk for chunk, _ in results(pool, dies_at_three, range(12)))
    assert len(list(tmp_path.glob("call.3.*"))) == engines.MAX_TRIES
    assert 3 not in found


def started(folder: Path) -> subprocess.Popen[str]:
    """A process of its own that runs a pool of two, which leave their traces in the folder."""
    script, pipe = folder / "run.py", subprocess.PIPE
    script.write_text(RUN)
    paths = os.environ | {"PYTHONPATH": str(ROOT)}
    command = [sys.executable, str(script), str(folder)]
    return subprocess.Popen(command, stdout=pipe, stderr=pipe, text=True, env=paths, process_group=0)


@pytest.mark.nightly
@pytest.mark.parametrize("sent", every(2, [signal.SIGKILL, signal.SIGINT]))
def test_ended_run_leaves_no_process(tmp_path: Path, sent: signal.Signals) -> None:
    run = started(tmp_path)
    until(lambda: len(begun(tmp_path)) == 2)
    workers = begun(tmp_path)
    os.killpg(run.pid, sent) if sent is signal.SIGINT else run.kill()  # Ctrl-C goes to all processes of a terminal
    said, errors = run.communicate(timeout=20)
    until(lambda: not any(psutil.pid_exists(worker) for worker in workers), 10)
    assert (said, errors) == (("interrupted\n", "") if sent is signal.SIGINT else ("", errors))


@pytest.mark.parametrize("later", [0, 0.05, 0.1])
def test_interrupt_while_the_processes_begin_is_silent(tmp_path: Path, later: float) -> None:
    run = started(tmp_path)
    until(lambda: workers_of(run.pid))
    workers = workers_of(run.pid)
    time.sleep(later)  # in another place of their beginning
    os.killpg(run.pid, signal.SIGINT)
    assert run.communicate(timeout=20) == ("interrupted\n", "")
    until(lambda: not any(psutil.pid_exists(worker) for worker in workers), 10)


def workers_of(run: int) -> list[int]:
    """Processes of a pool, which may have begun just now."""
    found = []
    for child in psutil.Process(run).children(recursive=True):
        with suppress(psutil.NoSuchProcess):
            found += [child.pid] if "spawn_main" in " ".join(child.cmdline()) else []
    return found


def test_interrupt_in_this_process_goes_through(tmp_path: Path) -> None:
    def interrupted(_: object, chunk: int) -> int:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt), InProcess(warm(tmp_path)) as engine:
        list(results(engine, interrupted, range(3)))


def test_missing_dask_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    monkeypatch.delitem(sys.modules, "diecut_report.study.execution.dask_cluster", raising=False)
    with pytest.raises(UserError, match=r"pip install --require-hashes -r requirements-cluster\.lock"):
        dask_cluster("tcp://127.0.0.1:1", warm(tmp_path))


def printed(code: str, *arguments: str, around: dict[str, str] | None = None) -> str:
    """What a process of its own prints."""
    command = [sys.executable, "-c", code, *arguments]
    return subprocess.run(command, check=True, capture_output=True, text=True, env=around).stdout


def test_dask_is_imported_only_for_a_cluster() -> None:
    code = "import sys, diecut_report.study.execution.engines; print({'dask', 'distributed', 'pyarrow'} & set(sys.modules))"
    assert printed(code) == "set()\n"


COUNT = """
import resource, sys
import numpy as np
from diecut_report.study.execution.engines import settle
if sys.argv[1] == "settled":
    settle()
def chunk():
    return [np.ones(1 << 17) for _ in range(20)]
chunk()
before = resource.getrusage(resource.RUSAGE_SELF).ru_minflt
for _ in range(10):
    chunk()
print(resource.getrusage(resource.RUSAGE_SELF).ru_minflt - before)
"""


@pytest.mark.skipif(platform.libc_ver()[0] != "glibc", reason="only glibc has this setting")
@pytest.mark.nightly
def test_the_next_chunk_takes_no_new_pages() -> None:
    assert int(printed(COUNT, "settled")) < 200 < int(printed(COUNT, "as it was"))


THREADS = """
import numpy as np
from diecut_report.study.execution.engines import settle
from threadpoolctl import threadpool_info
settle()
print({pool["num_threads"] for pool in threadpool_info() if pool["user_api"] == "blas"})
"""


def test_linear_algebra_takes_one_thread() -> None:
    assert printed(THREADS, around=os.environ | {"OPENBLAS_NUM_THREADS": "2"}) == "{1}\n"


STARTED = """
import os, sys
from diecut_report.__main__ import run
sys.argv = ["diecut-report", "--version"]
def told(code):
    from threadpoolctl import threadpool_info
    print(code, *(library["num_threads"] for library in threadpool_info() if library["user_api"] == "blas"))
os._exit = told
run()
"""


@pytest.mark.parametrize(("given", "expected"), [({}, "1"), ({"OPENBLAS_NUM_THREADS": "2"}, "2")])
def test_the_program_takes_one_thread_for_products_unless_the_user_says_otherwise(
    given: dict[str, str], expected: str
) -> None:
    around = {name: value for name, value in os.environ.items() if "_NUM_THREADS" not in name}
    code, *threads = printed(STARTED, around=around | given).splitlines()[-1].split()
    assert code == "0"
    if os.cpu_count() != 1 and threads:
        assert set(threads) == {expected}
