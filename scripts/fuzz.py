"""Feeds one reader of the program with inputs that are grown by what they reach in the code (atheris, libFuzzer).

    .venv/bin/python -m pip install atheris          # once; it is needed for nothing else
    .venv/bin/python scripts/fuzz.py TARGET [LIBFUZZER OPTIONS]
    .venv/bin/python scripts/fuzz.py all SECONDS     # each target for so long, one after the other
    .venv/bin/python scripts/fuzz.py keep TARGET     # the few of what has grown that reach as much, into the kept corpus

TARGET is config, study, unit, condition, constraint, table or stored. What a reader refuses in words is right; all else stops the run: another
exception, even one that a library only prints, more than 20 s for one input, more than 500 MB. The input that does it is left as
``crash-*`` in the current folder: it goes into tests/hostile/corpus/TARGET, whose inputs are read in each test run. What is new grows
in build/fuzz/TARGET from that corpus, from sound inputs and from the words of the program (tests/hostile/seeds.py).
"""

from __future__ import annotations

import os
import shlex
import subprocess
import sys
from collections.abc import Iterable, Iterator
from pathlib import Path

ROOT = Path(__file__).parents[1]
CORPUS = ROOT / "tests" / "hostile" / "corpus"
TARGETS = ("config", "study", "unit", "condition", "constraint", "table", "stored")
KEEP = "-set_cover_merge=1"  # of libFuzzer: the fewest inputs that reach as much
GROWN = ROOT / "build" / "fuzz"
LIMITS = [
    "-rss_limit_mb=750",
    "-timeout=20",
    "-max_len=20000",
]  # the program itself takes 250 MB with the instruments in it


def fuzz(target: str, options: list[str]) -> None:
    """Run one target in this process until it is stopped."""
    import atheris

    with atheris.instrument_imports(include=["diecut_report", "yaml"]):
        sys.path.insert(0, str(ROOT))
        from tests.hostile.readers import READERS
        from tests.hostile.seeds import seeds, words
    read = READERS[target]()
    ignored: list[BaseException] = []
    sys.unraisablehook = lambda fault: ignored.append(fault.exc_value or RuntimeError(str(fault.err_msg)))

    def checked(data: bytes) -> None:
        read(data)
        if ignored:
            raise ignored.pop()

    grown, kept = GROWN / target / "grown", CORPUS / target
    grown.mkdir(parents=True, exist_ok=True)
    kept.mkdir(parents=True, exist_ok=True)
    folders = [kept, grown] if KEEP in options else [grown, kept]  # what is new goes into the first
    files = [*map(str, folders), *_written(GROWN / target, seeds(target), words(target))]
    atheris.Setup([_again(GROWN / target, target), *files, *LIMITS, *options], checked)
    atheris.Fuzz()


def _written(folder: Path, seeds: Iterable[bytes], words: Iterable[str]) -> Iterator[str]:
    """Write the sound inputs and the words as files; the arguments that name them."""
    sound = folder / "seeds"
    sound.mkdir(exist_ok=True)
    for number, seed in enumerate(seeds):
        (sound / str(number)).write_bytes(seed)
    yield str(sound)
    if escaped := ["".join(f"\\x{byte:02x}" for byte in word.encode()) for word in sorted(words)]:
        (folder / "words").write_text("".join(f'"{word}"\n' for word in escaped))
        yield f"-dict={folder / 'words'}"


def _again(folder: Path, target: str) -> str:
    """Write the command that libFuzzer begins other processes of itself by, as it does to keep the few."""
    script = folder / "run"
    script.write_text(f'#!/bin/sh\nexec {shlex.quote(sys.executable)} -P {shlex.quote(__file__)} {target} "$@"\n')
    script.chmod(0o755)
    return str(script)


def main() -> int:
    """Run what was asked for."""
    if len(sys.argv) > 2 and sys.argv[1] == "all":
        seconds = f"-max_total_time={int(sys.argv[2])}"
        codes = {name: subprocess.call([sys.executable, "-P", __file__, name, seconds]) for name in TARGETS}
        print("\n".join(f"{name:10} {'nothing found' if code == 0 else 'see above'}" for name, code in codes.items()))
        return int(any(codes.values()))
    if sys.argv[1:2] == ["keep"]:
        sys.argv[1:] = [*sys.argv[2:3], KEEP]
    if len(sys.argv) < 2 or sys.argv[1] not in TARGETS:
        print(__doc__)
        return 2
    os.environ["HYPOTHESIS_PROFILE"] = "ci"
    fuzz(sys.argv[1], sys.argv[2:])
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
