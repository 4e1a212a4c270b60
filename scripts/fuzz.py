"""Feeds one reader of the program with inputs that are grown by what they reach in the code (atheris, libFuzzer).

    .venv/bin/python -m pip install atheris          # once; it is needed for nothing else
    .venv/bin/python scripts/fuzz.py TARGET [LIBFUZZER OPTIONS]
    .venv/bin/python scripts/fuzz.py all SECONDS     # each target for so long, one after the other

TARGET is config, study, unit, condition, constraint, table or stored. What a reader refuses in words is right; all else stops the run: another
exception, more than 20 s for one input, more than 500 MB. The input that does it is left as ``crash-*`` in the current folder.
The corpus lies in tests/hostile/corpus/TARGET and is kept: run ``-merge=1`` to keep it small. Its inputs are read in each test run.
"""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[1]
CORPUS = ROOT / "tests" / "hostile" / "corpus"
TARGETS = ("config", "study", "unit", "condition", "constraint", "table", "stored")
LIMITS = [
    "-rss_limit_mb=1000",
    "-timeout=20",
    "-max_len=20000",
]  # the program itself takes 500 MB with the instruments in it


def fuzz(target: str, options: list[str]) -> None:
    """Run one target in this process until it is stopped."""
    import atheris

    with atheris.instrument_imports(include=["diecut_report", "yaml"]):
        sys.path.insert(0, str(ROOT))
        from tests.hostile.readers import READERS
    folder = CORPUS / target
    folder.mkdir(parents=True, exist_ok=True)
    read = READERS[target]()
    atheris.Setup([sys.argv[0], str(folder), *LIMITS, *options], read)
    atheris.Fuzz()


def main() -> int:
    """Run what was asked for."""
    if len(sys.argv) > 2 and sys.argv[1] == "all":
        seconds = f"-max_total_time={int(sys.argv[2])}"
        codes = {name: subprocess.call([sys.executable, "-P", __file__, name, seconds]) for name in TARGETS}
        print("\n".join(f"{name:10} {'nothing found' if code == 0 else 'see above'}" for name, code in codes.items()))
        return int(any(codes.values()))
    if len(sys.argv) < 2 or sys.argv[1] not in TARGETS:
        print(__doc__)
        return 2
    os.environ["HYPOTHESIS_PROFILE"] = "ci"
    fuzz(sys.argv[1], sys.argv[2:])
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
