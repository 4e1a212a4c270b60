"""Makes docs/validation.md from the rows that the tests check: ``python -m tests.validation.page``."""

from __future__ import annotations

from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from types import ModuleType

from diecut_report.texts import number_text
from tests.validation.rows import Row

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


def chapters() -> Iterator[tuple[str, ModuleType]]:
    """The modules with rows, each with the title of its chapter: those of sources first."""
    for file in sorted(Path(__file__).parent.glob("source_*.py")):
        yield file.stem.removeprefix("source_"), import_module(f"{__package__}.{file.stem}")
    for file in sorted(Path(__file__).parent.glob("rows_*.py")):
        yield f"`{file.stem.removeprefix('rows_')}`", import_module(f"{__package__}.{file.stem}")


def chapter(title: str, module: ModuleType) -> str:
    """The table of one module's rows under what it says of itself."""
    head, _, source = (module.__doc__ or "").partition("\n\n")
    table = [
        "| place | quantity | printed | computed | unit | verdict | why |",
        "| --- | --- | --- | --- | --- | --- | --- |",
        *map(line, module.ROWS),
    ]
    paragraph = f"{head.strip()} {' '.join(source.split())}".strip()
    return f"## {title}\n\n{paragraph}\n\n" + "\n".join(table) + "\n"


def page() -> str:
    """The whole page."""
    return HEAD + "\n".join(chapter(title, module) for title, module in chapters())


if __name__ == "__main__":
    PAGE.parent.mkdir(exist_ok=True)
    PAGE.write_text(page(), encoding="utf-8")
