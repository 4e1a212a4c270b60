"""Makes docs/validation.md, and the counts of docs/trust.md, from the rows that the tests check: ``python -m tests.validation.page``."""

from __future__ import annotations

import re
from collections import Counter
from pathlib import Path
from types import ModuleType

from diecut_report.quantities.formatting import number_text
from tests.validation.rows import Row, modules

PAGE = Path(__file__).parents[2] / "docs" / "validation.md"
TRUST = PAGE.with_name("trust.md")
COUNTED = re.compile(r"lists\s\d+\snumbers of papers.*?cannot be reproduced\.", re.DOTALL)

HEAD = """# Validation: what the papers print, and what the program computes

Made from the rows in `tests/validation/` by `python -m tests.validation.page`; the tests check each of them.
A number *agrees* when ours rounds to the printed one. For a *mistake* the test follows the source's own arithmetic to the
printed number, so that its reason is known and not guessed. A *worked example* is printed in no paper: it was calculated apart from
the program, by hand or with another method, and the program must meet it.

"""


def shown(row: Row, value: float) -> str:
    """A number with four significant digits in the row's unit."""
    power = int(row.printed.partition("e")[2] or 0)
    return number_text(value / 10.0**power) + (f"e{power}" if power else "")


def line(row: Row) -> str:
    """A row of the table."""
    return f"| {row.place} | {row.quantity} | {row.printed} | {shown(row, row.ours())} | {row.unit} | {row.verdict} | {row.why} |"


def title_of(module: ModuleType) -> str:
    """The title of a module's chapter: a source's number, or the kind."""
    group, _, name = module.__name__.rpartition(".")[2].partition("_")
    return name if group == "source" else f"`{name}`"


def chapter(module: ModuleType) -> str:
    """The table of one module's rows under what it says of itself."""
    head, _, source = (module.__doc__ or "").partition("\n\n")
    table = [
        "| place | quantity | printed | computed | unit | verdict | why |",
        "| --- | --- | --- | --- | --- | --- | --- |",
        *map(line, module.ROWS),
    ]
    paragraph = f"{head.strip()} {' '.join(source.split())}".strip()
    return f"## {title_of(module)}\n\n{paragraph}\n\n" + "\n".join(table) + "\n"


def page() -> str:
    """The whole page."""
    return HEAD + "\n".join(map(chapter, modules()))


def counts() -> str:
    """What docs/trust.md says of the rows."""
    rows = [row for module in modules() for row in module.ROWS]
    found = Counter(row.verdict for row in rows)
    assert set(found) == {"agrees", "mistake", "cannot be reproduced"}, found
    return (
        f"lists {len(rows)} numbers of papers and worked examples beside those of the program:\n{found['agrees']} agree, in "
        f"{found['mistake']} the paper is mistaken and its own arithmetic is followed to its number, {found['cannot be reproduced']} "
        "cannot be reproduced."
    )


def trusted(text: str) -> str:
    """The text of docs/trust.md with the counts of today."""
    found, replaced = COUNTED.subn(counts(), text)
    assert replaced == 1, "docs/trust.md does not count the rows of validation.md"
    return found


if __name__ == "__main__":
    PAGE.parent.mkdir(exist_ok=True)
    PAGE.write_text(page(), encoding="utf-8")
    TRUST.write_text(trusted(TRUST.read_text(encoding="utf-8")), encoding="utf-8")
