"""Tries all rows of the table and writes ``now.py`` anew: what happens today with those that are not told as they must be."""

from __future__ import annotations

from collections import Counter
from pathlib import Path
from tempfile import TemporaryDirectory

from tests.mistakes.runner import Mistake, Told, faults, tried
from tests.mistakes.table import TABLE

ROOT = Path(__file__).parents[2]
HEAD = '''"""What happens today with the mistakes that are not told as the table wants it: these rows are expected to fail.

``python -m tests.mistakes.renew`` writes this file anew; the goal is that nothing is left in it.
"""

NOW: dict[str, str] = {
'''


def fault_class(mistake: Mistake, told: Told, found: list[str]) -> str:
    """In one word or two in what a row falls short."""
    if not told.stage:
        return "silent"
    if told.code == 70:
        return f"{told.stage} breaks"
    if told.stage != mistake.told:
        return f"{told.stage} tells it, not {mistake.told}"
    if all("the place" in each for each in found):
        return "no place"
    return "words"


def _said(told: Told, folder: str) -> str:
    """The message, without the names of folders; of a traceback what it ends with."""
    if not told.stage:
        return ""
    lines = [line for line in told.text.splitlines() if line and not line.startswith("This is a fault")]
    text = lines[-1] if "Traceback" in told.text else " ".join(told.text.split())
    return ": " + text.replace(f"{folder}/", "").replace(f"{ROOT}/", "")


def main() -> None:
    """Try each row; write and count those that fail."""
    lines, counted = [], Counter[str]()
    for mistake in TABLE:
        with TemporaryDirectory() as folder:
            told = tried(mistake, Path(folder))
        if found := faults(mistake, told):
            kind = fault_class(mistake, told, found)
            counted[kind] += 1
            lines.append(f"    {mistake.what!r}: {(kind + _said(told, folder))[: 130 - len(mistake.what)]!r},\n")
    Path(__file__).with_name("now.py").write_text(HEAD + "".join(lines) + "}  # fmt: skip\n", "utf-8")
    print(f"{len(TABLE) - len(lines)} of {len(TABLE)} rows are told as they must be")
    for kind, count in counted.most_common():
        print(f"{count:4d}  {kind}")


if __name__ == "__main__":
    main()
