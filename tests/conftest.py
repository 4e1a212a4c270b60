"""Settings of the whole test suite."""

from __future__ import annotations

import atexit
import gc
import os
import signal
import tempfile
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, settings

from diecut_report.__main__ import THREADS

# As many threads for linear algebra as the program takes: with more of them sums may differ in their last digit. Read by NumPy when it is loaded.
os.environ |= dict.fromkeys(THREADS, "1")

from diecut_report.config.plugins import Discovery
from diecut_report.design.findings import with_findings
from diecut_report.press import Press
from tests.configs import EXAMPLE, SMALL, saved
from tests.examples import FEW, MANY
from tests.processes import Example, in_another_process
from tests.shared import once

# How many examples hypothesis draws: few, new ones at each run ("local"); few, the same at each run, so that a change is
# judged by what it changes ("ci", where CI is set); many ("nightly", scripts/nightly.sh). HYPOTHESIS_PROFILE names another.
# No deadline: a first call may compile, import or wait for a busy machine, which says nothing about the code.
# Many random machines cannot exist and are passed over, and a calculation takes some milliseconds: both are no fault.
_COMMON: dict[str, Any] = {
    "deadline": None,
    "print_blob": True,
    "suppress_health_check": [HealthCheck.filter_too_much, HealthCheck.too_slow],
}
settings.register_profile("local", max_examples=FEW, **_COMMON)
settings.register_profile("ci", max_examples=FEW, derandomize=True, **_COMMON)
settings.register_profile("nightly", max_examples=MANY, **_COMMON)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE") or ("ci" if "CI" in os.environ else "local"))

# Where the suite runs in the background of a shell, Ctrl-C is ignored by all that it starts; some tests send it.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)

# What is remembered of plugins belongs to the user, not to the suite: it has a folder of its own.
os.environ["XDG_CACHE_HOME"] = tempfile.mkdtemp(prefix="diecut-report-tests-")


# Collecting nine thousand tests makes hundreds of thousands of objects that stay. To look through them for garbage again and
# again is a sixth of the collection's time.
gc.disable()


def pytest_collection_finish() -> None:
    """Leave what collection has made out of all later collections of garbage."""
    gc.collect()
    gc.freeze()
    atexit.register(
        gc.unfreeze
    )  # and not before pytest's last five collections, or libraries that count their objects tell of leaks
    # to look through what few tests leave costs a tenth of them; the program looks less often still
    gc.set_threshold(100_000)
    gc.enable()


@pytest.fixture(scope="session", autouse=True)
def compiled_templates() -> None:
    """Templates are compiled once."""
    from diecut_report.report.pages.firm_templates import OPTIONS
    from tests.templates import Compiled

    OPTIONS["bytecode_cache"] = Compiled()


@pytest.fixture(scope="session")
def small_report(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Give the folder with the report of a small press (HTML, PDF and results), made once for all workers of a run."""

    def make(folder: Path) -> None:
        config = saved(tmp_path_factory.getbasetemp(), SMALL, "small.yaml")
        with_findings(Press.read(config, Discovery([])).calculate()).report(folder, ("html", "pdf", "json"))

    return once(tmp_path_factory, "small_report", make)


@pytest.fixture(scope="session")
def example(tmp_path_factory: pytest.TempPathFactory) -> Example:
    """Give what the command calc says of the published press, asked once for all workers in a process of its own."""

    def make(folder: Path) -> None:
        in_another_process("calc", EXAMPLE).store(folder)

    return Example.stored(once(tmp_path_factory, "example", make))


@pytest.fixture
def without_summary(monkeypatch: pytest.MonkeyPatch) -> None:
    """Studies are left without their summary, which takes seconds."""
    monkeypatch.setattr("diecut_report.study.command.summarise", lambda *_, **__: None)


@pytest.fixture
def without_advice(monkeypatch: pytest.MonkeyPatch) -> None:
    """Failing checks are left without advice, which takes longer than all the rest; tests/results/test_advice.py follows it."""
    monkeypatch.setattr("diecut_report.results.advice.Advisor.ways", lambda *_: [])


@pytest.fixture
def with_html_summary(monkeypatch: pytest.MonkeyPatch) -> None:
    """Studies get their summary as HTML alone."""
    from diecut_report.study import command
    from diecut_report.study.summary import summarise

    monkeypatch.setattr(command, "summarise", lambda folder, discovery: summarise(folder, ["html"], discovery))
