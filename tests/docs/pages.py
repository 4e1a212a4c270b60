"""Pages whose blocks are executed, in their order and in one folder.

A line ``<!-- VERB PATH -->`` before a block says what becomes of it: ``file`` writes it there, ``append`` puts it at the end of that
file, but before its ``MECHANISM``, ``end`` replaces that end, ``keep`` shows what is in a file of the repository. In a block
``console`` each ``$ command`` is run and its output compared with what stands below; a line ``…`` stands for any lines. A block ``pycon``
is a session of Python. Every block of Python, YAML and TOML must be used, or say ``<!-- shown -->``.
"""

from __future__ import annotations

import contextlib
import doctest
import io
import linecache
import os
import re
import runpy
import shlex
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest

from diecut_report.cli.main import main

ROOT = Path(__file__).parents[2]
BLOCK = re.compile(
    r"(?:^<!-- (?P<verb>\w+) ?(?P<path>\S*) -->\n)?^```(?P<language>\w+)\n(?P<text>.*?)^```$", re.MULTILINE | re.DOTALL
)
EXECUTED = {"python", "yaml", "toml", "ini", "csv", "po"}
END = "\nMECHANISM = "
Run = Callable[[list[str]], str]


@dataclass(frozen=True)
class PageBlock:
    """A block of a page, with the line where it begins and what becomes of it."""

    line: int
    language: str
    text: str
    verb: str
    path: str


def page_blocks(page: Path) -> Iterator[PageBlock]:
    """The blocks of a page."""
    whole = page.read_text("utf-8")
    for found in BLOCK.finditer(whole):
        line = whole.count("\n", 0, found.start("text")) + 1
        yield PageBlock(line, found["language"], found["text"], found["verb"] or "", found["path"] or "")


def commands(text: str) -> Iterator[tuple[str, list[str]]]:
    """Each command of a console with the lines that it is shown to print."""
    for part in re.split(r"^\$ ", text, flags=re.MULTILINE)[1:]:
        command, _, output = part.partition("\n")
        yield command, output.splitlines()


def alike(shown: list[str], told: list[str]) -> bool:
    """Whether lines are those that are shown; a line ``…`` stands for any."""
    if not shown:
        return not told
    if shown[0].strip() == "…":
        return any(alike(shown[1:], told[start:]) for start in range(len(told) + 1))
    return bool(told) and shown[0].rstrip() == told[0].rstrip() and alike(shown[1:], told[1:])


class PageRun:
    """Executes the blocks of a page in a folder; ``skipped`` are the beginnings of commands that are left out."""

    def __init__(self, page: Path, folder: Path, skipped: tuple[str, ...] = ()) -> None:
        self.page, self.folder, self.skipped = page, folder, skipped
        self.names: dict[str, object] = {}
        self.found: dict[str, Run] = {"python": self._python, "diecut-report": self._program, "cat": self._cat}

    def execute(self) -> int:
        """Execute all blocks and return how many these were; AssertionError with the line of one that is not as it says."""
        blocks = list(page_blocks(self.page))
        with contextlib.chdir(self.folder):
            for block in blocks:
                self._one(block, f"{self.page.name}:{block.line}")
        return len(blocks)

    def _one(self, block: PageBlock, where: str) -> None:
        if block.verb:
            getattr(self, f"_{block.verb}")(block)
        elif block.language == "console":
            self._console(block, where)
        elif block.language == "pycon":
            self._session(block, where)
        else:
            assert block.language not in EXECUTED, f"{where}: this block is not executed"

    def _file(self, block: PageBlock) -> None:
        file = self.folder / block.path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(block.text, "utf-8")
        self._forget()

    def _append(self, block: PageBlock) -> None:
        head, end, tail = (self.folder / block.path).read_text("utf-8").partition(END)
        (self.folder / block.path).write_text(f"{head}\n{block.text}\n{end}{tail}", "utf-8")
        self._forget()

    def _end(self, block: PageBlock) -> None:
        head, _, _ = (self.folder / block.path).read_text("utf-8").partition(END)
        (self.folder / block.path).write_text(f"{head}\n{block.text}", "utf-8")
        self._forget()

    def _keep(self, block: PageBlock) -> None:
        text = (ROOT / block.path).read_text("utf-8")
        assert block.text in text, f"{self.page.name}:{block.line}: this is not what {block.path} holds"

    def _shown(self, block: PageBlock) -> None:
        """Shown alone."""

    def _forget(self) -> None:
        """Modules of plugins are read anew, as in a new process."""
        for name in [name for name in sys.modules if name.startswith("diecut_report_local_")]:
            del sys.modules[name]
        linecache.clearcache()

    def _console(self, block: PageBlock, where: str) -> None:
        for command, shown in commands(block.text):
            if command.startswith(self.skipped):
                continue
            name, *arguments = shlex.split(command.partition(" #")[0])
            told = self.found[name](arguments)
            assert alike(shown, told.splitlines()), f"{where}: $ {command}\nprints\n{told}"

    def _session(self, block: PageBlock, where: str) -> None:
        test = doctest.DocTestParser().get_doctest(block.text, self.names, where, str(self.page), block.line)
        told = io.StringIO()
        doctest.DocTestRunner(verbose=False, optionflags=doctest.NORMALIZE_WHITESPACE | doctest.ELLIPSIS).run(
            test, out=told.write, clear_globs=False
        )
        assert not told.getvalue(), told.getvalue()
        self.names = test.globs

    def _program(self, arguments: list[str]) -> str:
        raw = io.BytesIO()
        told = io.TextIOWrapper(raw, "utf-8", write_through=True)
        with contextlib.redirect_stdout(told), contextlib.redirect_stderr(told):
            code = main(arguments)
        text = raw.getvalue().decode("utf-8")
        assert code in (0, 1), text
        return text.replace(f"{self.folder}/", "")

    def _python(self, arguments: list[str]) -> str:
        told = io.StringIO()
        with contextlib.redirect_stdout(told), pytest.MonkeyPatch.context() as patch:
            patch.syspath_prepend(self.folder)
            if arguments[:2] == ["-m", "pytest"]:
                return self._tests(arguments[2:])
            patch.setattr(sys, "argv", arguments)
            runpy.run_path(arguments[0], run_name="__main__")
        return told.getvalue()

    def _tests(self, arguments: list[str]) -> str:
        """Run the tests of a file one by one in this process, and tell of them as pytest does."""
        (file,) = (name for name in arguments if name.endswith(".py"))
        sys.modules.pop("try_it", None)
        names = runpy.run_path(file)
        tests = [value for name, value in names.items() if name.startswith("test_")]
        for test in tests:
            test()
        return f"{'.' * len(tests):<73}[100%]\nfound {len(tests)}\n"

    def _cat(self, arguments: list[str]) -> str:
        return Path(arguments[0]).read_text("utf-8")


os.environ.setdefault("COLUMNS", "160")
