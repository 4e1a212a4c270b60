"""How long ``diecut-report report`` takes for HTML and PDF, against the practical route; ratios of one run.

    python benchmarks/report.py [ROUNDS]

The practical route sets the same content as PDF alone: as many pages, formulas and figures, each formula an SVG of mathra
and each figure an SVG of matplotlib, both as ``<img>``, and leaves WeasyPrint as it is. It starts from calculated results, so
that it has less to do. Both run alternately, each in a fresh process; the least times are compared. The aim: at most 1.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from importlib import import_module
from pathlib import Path

from calc import seconds

CONFIG = Path(import_module("diecut_report.configs").__path__[0]) / "flat_cylinder_press.yaml"
PRACTICAL = Path(__file__).with_name("practical_route.py")


def main(rounds: int) -> None:
    """Run both in turns and print the least times and their ratio."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        program = [sys.executable, "-m", "diecut_report"]
        subprocess.run([*program, "report", "--quiet", str(CONFIG), "-o", name, "--format", "json"], check=False)
        results = folder / f"{CONFIG.stem}.json"
        commands = {
            "practical": [sys.executable, str(PRACTICAL), str(results), str(folder / "practical.pdf")],
            "report": [*program, "report", "--quiet", str(CONFIG), "-o", name, "--format", "html,pdf"],
        }
        for command in commands.values():
            seconds(command)  # the first run fills the file cache
        least = {
            key: min(times) for key, times in zip(commands, zip(*_turns(commands, rounds), strict=True), strict=True)
        }
    for key, value in least.items():
        print(f"{key:10} {value:.2f} s")
    print(f"ratio      {least['report'] / least['practical']:.2f}")


def _turns(commands: dict[str, list[str]], rounds: int) -> list[list[float]]:
    return [[seconds(command) for command in commands.values()] for _ in range(rounds)]


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 5)
