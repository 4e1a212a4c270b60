"""Makes docs/validation.md from the rows that the tests check: ``python -m tests.validation.page``."""

from __future__ import annotations

from pathlib import Path
from types import ModuleType

from diecut_report.quantities.formatting import number_text
from tests.validation.rows import Row, modules

PAGE = Path(__file__).parents[2] / "docs" / "validation.md"

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


if __name__ == "__main__":
    PAGE.parent.mkdir(exist_ok=True)
    PAGE.write_text(page(), encoding="utf-8")
