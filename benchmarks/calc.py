"""How long ``diecut-report calc`` takes, against importing what it stands on; ratios of one run.

    python benchmarks/calc.py [ROUNDS]

Both commands run alternately, each in a fresh process; the least times are compared, as they are the least disturbed.
The aim: at most 1.6.
"""

from __future__ import annotations

import subprocess
import sys
import time
from importlib import import_module
from pathlib import Path

CONFIG = Path(import_module("diecut_report.configs").__path__[0]) / "flat_cylinder_press.yaml"
COMMANDS = {
    "imports": [sys.executable, "-c", "import numpy, scipy.optimize, pydantic, yaml"],
    "calc": [sys.executable, "-m", "diecut_report", "calc", "--quiet", str(CONFIG), "-o", "/dev/null"],
}


def seconds(command: list[str]) -> float:
    """Wall time of one run."""
    start = time.perf_counter()
    done = subprocess.run(command, check=False, stdout=subprocess.DEVNULL)
    elapsed = time.perf_counter() - start
    if done.returncode not in (0, 1):  # 1: a check of the press fails, as it should
        raise SystemExit(f"{command} ended with {done.returncode}")
    return elapsed


def main(rounds: int) -> None:
    """Run both in turns and print the least times and their ratio."""
    for command in COMMANDS.values():
        seconds(command)  # the first run fills the file cache
    least = {name: float("inf") for name in COMMANDS}
    for _ in range(rounds):
        for name, command in COMMANDS.items():
            least[name] = min(least[name], seconds(command))
    for name, value in least.items():
        print(f"{name:8} {value:.3f} s")
    print(f"ratio    {least['calc'] / least['imports']:.2f}")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 15)
