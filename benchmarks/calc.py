"""How long ``diecut-report calc`` takes: two mechanisms against importing what they stand on, the full press against these two.

    python benchmarks/calc.py [ROUNDS]

The commands run in turns, each in a fresh process; the least times are compared, as they are the least disturbed.
The aims: calc of two mechanisms at most 1.6 × the imports, of the full press at most 1.5 × that of two mechanisms.
"""

from __future__ import annotations

import subprocess
import sys
import time
from importlib import import_module
from pathlib import Path

TWO = Path(__file__).with_name("two_mechanisms.yaml")
FULL = Path(import_module("diecut_report.configs").__path__[0]) / "flat_cylinder_press.yaml"
CALC = [sys.executable, "-m", "diecut_report", "calc", "--quiet", "-o", "/dev/null"]
COMMANDS = {
    "imports": [sys.executable, "-c", "import numpy, scipy.optimize, pydantic, yaml"],
    "two": [*CALC, str(TWO)],
    "full": [*CALC, str(FULL)],
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
    """Run all in turns and print the least times and their ratios."""
    for command in COMMANDS.values():
        seconds(command)  # the first run fills the file cache
    least = {name: float("inf") for name in COMMANDS}
    for _ in range(rounds):
        for name, command in COMMANDS.items():
            least[name] = min(least[name], seconds(command))
    for name, value in least.items():
        print(f"{name:8} {value:.3f} s")
    print(f"two mechanisms / imports      {least['two'] / least['imports']:.2f}")
    print(f"full press / two mechanisms   {least['full'] / least['two']:.2f}")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 15)
