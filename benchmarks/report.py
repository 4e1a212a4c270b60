"""What ``diecut-report report`` takes: processor time, peak memory and sheets of one press, as ratios of one run.

    python benchmarks/report.py [ROUNDS] [PYTHON CONFIG]

PYTHON is the interpreter of an environment in which an earlier version of the program is installed, CONFIG a press that both versions
can read (that of the earlier one). All commands run in turns, each in a fresh process; the least times are compared, of the
processor, as they hardly depend on what else the machine does. The aims: a ``brief`` PDF at most 2.5 × the calculation and what an
empty page takes together, HTML at most 0.2 × the PDF, less than 350 MB, and ``standard`` HTML and PDF at most 0.45 × those of version 8c8da44.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from importlib import import_module
from pathlib import Path
from typing import NamedTuple

import pikepdf

FULL = Path(import_module("diecut_report.configs").__path__[0]) / "flat_cylinder_press.yaml"
EMPTY = (
    "from diecut_report.report.pages.page_engine import HTML; HTML(string='<html lang=en><title>x</title>').write_pdf()"
)
BOTH, MB = "html,pdf", 1024  # kilobytes
REPORTS = {
    "brief pdf": ("brief", "pdf"), "standard html": ("standard", "html"), "standard pdf": ("standard", "pdf"),
    "standard both": ("standard", BOTH), "full both": ("full", BOTH),
}  # fmt: skip


class Taken(NamedTuple):
    """Processor time, s, and peak memory, MB, of a command."""

    seconds: float
    memory: float


def taken(command: list[str]) -> Taken:
    """Run a command and return what it took."""
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    if os.waitstatus_to_exitcode(status) not in (0, 1):  # 1: a check of the press fails, as it should
        raise SystemExit(f"{command} ended with {status}")
    return Taken(usage.ru_utime + usage.ru_stime, usage.ru_maxrss / MB)


def commands(config: Path, folder: Path, landed: str | None) -> dict[str, list[str]]:
    """Return the commands that are compared; each report lies in a folder of its own."""
    program = [sys.executable, "-m", "diecut_report"]
    found = {
        "calc": [*program, "calc", "--quiet", "-o", os.devnull, str(config)],
        "empty page": [sys.executable, "-c", EMPTY],
    }
    for name, (detail, formats) in REPORTS.items():
        asked = ["--format", formats, "--detail", detail]
        found[name] = [*program, "report", "--quiet", str(config), "-o", str(_made(folder, name)), *asked]
    if landed:
        asked = ["-o", str(_made(folder, "landed both")), "--format", BOTH]
        found["landed both"] = [landed, "-m", "diecut_report", "report", "--quiet", str(config), *asked]
    return found


def _made(folder: Path, name: str) -> Path:
    made = folder / name.replace(" ", "_")
    made.mkdir(exist_ok=True)
    return made


def main(rounds: int, landed: str | None, config: Path) -> None:
    """Run all in turns; print the least times, the memory, the sheets, and the ratios."""
    with tempfile.TemporaryDirectory() as name:
        folder, least = Path(name), dict[str, Taken]()
        every = commands(config, folder, landed)
        for _ in range(rounds):
            for each, command in every.items():
                now = taken(command)
                least[each] = min(least.get(each, now), now)
        for each, (seconds, memory) in least.items():
            print(f"{each:14} {seconds:7.2f} s {memory:6.0f} MB {_sheets(folder, each)}")
    for told, above, below, aim in _ratios(bool(landed)):
        ratio = sum(least[each].seconds for each in above) / sum(least[each].seconds for each in below)
        print(f"{told:44} {ratio:5.2f} (aim {aim})")


def _sheets(folder: Path, name: str) -> str:
    for file in _made(folder, name).glob("*.pdf"):
        with pikepdf.open(file) as opened:
            return f"{len(opened.pages):4} sheets"
    return ""


def _ratios(has_landed: bool) -> list[tuple[str, list[str], list[str], float]]:
    """Return what is compared: words, what is above and below the line, and the aim."""
    found = [
        ("brief pdf / (calc + empty page)", ["brief pdf"], ["calc", "empty page"], 2.5),
        ("standard html / standard pdf", ["standard html"], ["standard pdf"], 0.2),
    ]
    if has_landed:
        found.append(("standard html and pdf / the same, landed", ["standard both"], ["landed both"], 0.45))
    return found


if __name__ == "__main__":
    given = sys.argv[1:]
    main(
        int(given[0]) if given else 3, given[1] if len(given) > 2 else None, Path(given[2]) if len(given) > 2 else FULL
    )
