"""Runs the tests of a plugin or module with a change in it, in as little time as may be; for scripts/mutate.py.

For each plugin or module a server is forked from a process that has the libraries imported. It imports all of the program that does not import
that plugin or module. Each mutant is a fork of the server. The tests that noticed other mutants come first, then the quick ones; the first that
fails ends it; nothing is shrunk and no trace is written. A test that takes more than five times what it took before, and three seconds of
processor time, is ended and has noticed the mutant. What the tests of ``most`` seconds did not notice stays open. A test that notices one is run
without the change, too: it must pass.
"""

from __future__ import annotations

import compileall
import gc
import json
import linecache
import os
import resource
import signal
import sys
import time
import warnings
from collections import Counter
from collections.abc import Callable, Iterable
from contextlib import suppress
from importlib import import_module
from pathlib import Path
from py_compile import PycInvalidationMode
from typing import Any, NoReturn

import pytest
from change_signs import Copy
from hypothesis.internal.conjecture import providers
from module_imports import module_of, unmoved
from unit_tests import tests_asked, units

LIBRARIES = ("numpy", "scipy.optimize", "scipy.integrate", "scipy.interpolate", "scipy.linalg", "scipy.signal", "scipy.stats", "pydantic",
             "yaml", "click", "jinja2", "babel", "pyarrow", "duckdb", "matplotlib.figure", "_hypothesis_pytestplugin", "filelock")  # fmt: skip
MEMORY = 6_000_000_000  # bytes of addresses for a mutant that asks for more and more
COLLECTION = 60.0  # seconds of processor time until the tests are found
UNKNOWN = 5.0  # seconds of a test that was not run yet
WAITED = 900  # seconds on the clock, for what waits and takes no processor time
BEGINS = signal.ITIMER_PROF
IMPORTED = (
    "ignore:Module already imported:pytest.PytestAssertRewriteWarning"  # hypothesis, before pytest could rewrite it
)
SILENT = [
    "-x",
    "-q",
    "--tb=no",
    "--assert=plain",
    "-W",
    IMPORTED,
    *(f"-pno:{name}" for name in ("cacheprovider", "xdist", "unraisableexception")),
]
KILLED, SURVIVED, TIMEOUT, OPEN = "killed", "survived", "timeout", "open"
SPENT = 77  # the exit code of tests that passed for as long as they may


class Tests:
    """What pytest is told, as a plugin of it: which tests, in which order, how long each may take; and what it tells."""

    def __init__(
        self, words: dict[str, str], seconds: dict[str, float], kills: Counter[str], told: Path, most: float
    ) -> None:
        self.words, self.seconds, self.kills, self.told, self.most = words, seconds, kills, told, most
        self.took: Counter[str] = Counter()

    def pytest_configure(self) -> None:
        """Let hypothesis stop at the first example that fails, the same ones each time."""
        from hypothesis import Phase, settings

        phases = [Phase.explicit, Phase.generate]
        profile = settings(settings.get_profile("ci"), phases=phases, database=None, report_multiple_bugs=False)
        settings.register_profile("mutants", profile)
        settings.load_profile("mutants")

    @pytest.hookimpl(trylast=True)
    def pytest_collection_modifyitems(self, items: list[pytest.Item]) -> None:
        """Keep what was asked for, those first that notice most and take least."""
        asked = [item for item in items if self._is_asked(*item.nodeid.split("::", 1))]
        items[:] = sorted(asked, key=lambda item: self._cost(item.nodeid))

    def _cost(self, name: str) -> float:
        """The time that a test costs for each mutant that it is likely to notice."""
        return (self.seconds.get(name, 0.1) + 0.01) / (self.kills[name] + 0.1)

    def _is_asked(self, file: str, name: str) -> bool:
        return self.words.get(file, "") in name

    @pytest.hookimpl(tryfirst=True)
    def pytest_runtest_protocol(self, item: pytest.Item) -> None:
        """Begin the time that a test may take, if there is time for another."""
        if time.process_time() > self.most:
            self.tell("")
            os._exit(SPENT)
        signal.setitimer(BEGINS, 3 + 5 * self.seconds.get(item.nodeid, UNKNOWN))
        self.tell(item.nodeid)

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """Note what a test took; the first that fails is the end."""
        self.took[report.nodeid] += report.duration
        if report.failed:
            self.end(report.nodeid)

    def pytest_collectreport(self, report: pytest.CollectReport) -> None:
        """End where a file cannot be imported any more."""
        if report.failed:
            self.end(report.nodeid)

    def end(self, failed: str) -> NoReturn:
        """Tell what was found and end this process at once."""
        self.tell(failed)
        os._exit(1 if failed else 0)

    def tell(self, failed: str) -> None:
        """Write which test is running or has failed, and what the others took."""
        self.told.write_text(json.dumps({"failed": failed, "took": self.took}), "utf-8")


class Server:
    """Tells what becomes of the mutants of one plugin or module. Lives in a process of its own."""

    def __init__(self, copy: Copy, unit: str, most: float) -> None:
        self.copy, self.unit, self.most = copy, unit, most
        self.kills: Counter[str] = Counter()
        self.seconds: dict[str, float] = {}
        self.sound: set[str] = set()  # tests that have been seen to pass without a change
        self.rounds = [merged(asked) for asked in in_rounds(tests_asked(unit))]
        os.chdir(copy.folder)
        os.environ |= {"PYTHONPATH": str(copy.program.parent), "HYPOTHESIS_PROFILE": "ci"}
        sys.path[0:1] = [str(copy.program.parent)]  # before the checkout's, in the place of scripts/
        for name in unmoved(unit):
            with suppress(ImportError):
                import_module(name)
        if left := [file for file in units()[unit] if module_of(file) in sys.modules]:
            raise SystemExit(f"{unit}: {left[0]} is imported before it is changed")
        linecache.clearcache()
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # it says that this is slow
            providers._get_local_constants()  # hypothesis reads the numbers of all modules; what it has read, it keeps
        gc.collect()
        gc.freeze()

    def fate(self, file: Path, text: str) -> tuple[str, str]:
        """What becomes of a changed file, and the test that noticed it, which passes without the change."""
        place = self.copy.place(file)
        whole = place.read_bytes()
        place.write_text(text, "utf-8")
        try:
            fate, by = self._first_failure()
        finally:
            place.write_bytes(whole)
        if fate in (KILLED, TIMEOUT):
            self.kills[by] += 1
            self._try_unchanged(by)
        return fate, by

    def _first_failure(self) -> tuple[str, str]:
        for words in self.rounds:
            fate, found = self._forked(words)
            if fate != SURVIVED:
                return fate, found["failed"]
        return SURVIVED, ""

    def _try_unchanged(self, test: str) -> None:
        """Demand that a test passes without a change, once; of a file that cannot be imported, that it can."""
        if test in self.sound:
            return
        file, _, name = test.partition("::")
        fate, found = self._forked({file: name} if file else self.rounds[0])
        if fate in (KILLED, TIMEOUT):
            raise SystemExit(f"{self.unit}: {found['failed'] or test} fails as it is")
        self.sound.add(test)

    def _forked(self, words: dict[str, str]) -> tuple[str, dict[str, Any]]:
        """Run tests in a fork; how it ended, and what it told."""
        told = self.copy.folder / "told.json"
        told.unlink(missing_ok=True)
        child = os.fork()
        if child == 0:
            self._run(words, told)
        status = os.waitpid(child, 0)[1]
        with suppress(ProcessLookupError):
            os.killpg(child, signal.SIGKILL)  # what it may have started
        found = json.loads(told.read_text("utf-8")) if told.exists() else {"failed": "", "took": {}}
        self.seconds |= {test: seconds for test, seconds in found["took"].items() if test != found["failed"]}
        if os.WIFSIGNALED(status):
            is_late = os.WTERMSIG(status) in (signal.SIGPROF, signal.SIGALRM)
            return TIMEOUT if is_late else KILLED, found
        return {0: SURVIVED, SPENT: OPEN}.get(os.WEXITSTATUS(status), KILLED), found

    def _run(self, words: dict[str, str], told: Path) -> NoReturn:
        """Run tests and end this process."""
        try:
            os.setpgid(0, 0)
            self._limit()
            tests = Tests(words, self.seconds, self.kills, told, time.process_time() + self.most)
            code = pytest.main([*SILENT, *words], plugins=[tests])
            tests.end("" if code == pytest.ExitCode.OK else f"pytest ended with {code}")
        finally:
            os._exit(1)

    def _limit(self) -> None:
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
        signal.alarm(WAITED)
        signal.setitimer(BEGINS, COLLECTION)
        silent = os.open(os.devnull, os.O_RDWR)
        for stream in (0, 1, 2):
            os.dup2(silent, stream)


def in_rounds(asked: list[list[str]]) -> list[list[list[str]]]:
    """What is asked of pytest, in rounds: first the plugin's own tests, then the contract of all, whose helpers load every plugin."""
    own = [some for some in asked if "test_contract" not in some[0]]
    return [some for some in (own, [one for one in asked if one not in own]) if some]


def merged(asked: Iterable[list[str]]) -> dict[str, str]:
    """The files of a round, with the word that the names of their tests must hold."""
    found: dict[str, str] = {}
    for some in asked:
        at = some.index("-k") if "-k" in some else len(some)
        found |= dict.fromkeys(some[:at], "".join(some[at + 1 :]))
    return found


# --- a server for each ------------------------------------------------------------------------------------------------


def prepared(work: Path) -> Copy:
    """A copy of the program, compiled, and the libraries in this process."""
    for name in LIBRARIES:
        import_module(name)
    copy = Copy(work)
    hashed = PycInvalidationMode.CHECKED_HASH  # a file may change twice within a second
    compileall.compile_dir(str(copy.folder), quiet=2, invalidation_mode=hashed)
    sys.dont_write_bytecode = True
    return copy


def in_server(copy: Copy, unit: str, most: float, work: Callable[[Server], None]) -> None:
    """Do some work in a server of its own."""
    child = os.fork()
    if child == 0:
        code = 1
        try:
            work(Server(copy, unit, most))
            code = 0
        except SystemExit as end:
            print(end, file=sys.stderr)
        except BaseException:
            sys.excepthook(*sys.exc_info())
        finally:
            sys.stdout.flush()
            os._exit(code)
    if os.waitpid(child, 0)[1]:
        raise SystemExit(f"{unit}: see above")
