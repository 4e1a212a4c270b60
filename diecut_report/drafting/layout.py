"""Lines of a configuration with a comment beside each, in two columns."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from textwrap import wrap

UNBROKEN = "\N{NO-BREAK SPACE}"  # where a line is not to end; a plain space in the file
WIDTH, WIDEST, LEAST = 150, 66, 60  # letters of a line, of its code at most, of a comment at least


@dataclass(frozen=True)
class DraftLine:
    """Hold a line of a configuration and what is said of it; one that is ``off`` is a comment itself, to be turned on."""

    indent: int
    code: str
    comment: str = ""
    off: bool = False

    @property
    def text(self) -> str:
        """Return the line without its comment."""
        return " " * self.indent + ("# " if self.off else "") + self.code


def laid_out(lines: Sequence[DraftLine]) -> Iterator[str]:
    """Yield the lines of a block, their comments below each other; a long comment goes on in the next lines."""
    lengths = [len(line.text) for line in lines if line.comment and len(line.text) <= WIDEST]
    column = max(lengths, default=0) + 2
    for line in lines:
        yield from _with_comment(line, column)


def remarks(text: str, indent: int = 0) -> Iterator[str]:
    """Yield a text as lines of comment."""
    for paragraph in text.split("\n"):
        head = " " * indent + "# "
        yield from (f"{head}{part}" for part in wrap(paragraph, WIDTH - len(head), break_long_words=False) or [""])


def _with_comment(line: DraftLine, column: int) -> Iterator[str]:
    if not line.comment:
        yield line.text
        return
    start = max(column, len(line.text) + 2)
    parts = wrap(line.comment, max(LEAST, WIDTH - start - 2), break_long_words=False, break_on_hyphens=False)
    heads = (line.text.ljust(start), *(" " * start for _ in parts[1:]))
    yield from (f"{head}# {part}".replace(UNBROKEN, " ") for head, part in zip(heads, parts, strict=True))


def shifted(lines: Iterable[DraftLine], by: int, *, off: bool = False) -> Iterator[DraftLine]:
    """Yield lines of a block within another one; ``off`` turns them into comments, whose indents stay behind the mark."""
    for line in lines:
        if off:
            yield DraftLine(by, " " * line.indent + line.code, line.comment, off=True)
        else:
            yield DraftLine(line.indent + by, line.code, line.comment, line.off)
