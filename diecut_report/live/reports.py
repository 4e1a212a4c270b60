"""LiveReports of a live machine, made by a process of their own, so that the page goes on while the sheets are set."""

from __future__ import annotations

import asyncio
import sys
import tempfile
from pathlib import Path
from typing import Any, NamedTuple

from diecut_report.errors import Problem, UserError
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.results.results_file import encoded, results_text

MEDIA_TYPES = {"html": "text/html; charset=utf-8", "pdf": "application/pdf"}
NAME = "report"
PATIENCE = 900.0  # seconds for a report; while one is made the next waits


class MadeReport(NamedTuple):
    """Hold a report as a browser takes it."""

    content: bytes
    media_type: str
    headers: dict[str, str]


class LiveReports:
    """Make reports, one at a time, in a language or in that of the project; ``folders`` are those of foreign plugins."""

    def __init__(self, folders: tuple[Path, ...], language: str | None) -> None:
        self.folders, self.language = folders, language
        self._one = asyncio.Lock()

    async def made(self, results: dict[str, Any], form: str) -> MadeReport:
        """Return the report of these results as ``html`` or ``pdf``; UserError in the words of the command where it cannot be made."""
        if form not in MEDIA_TYPES:
            raise UserError(
                Problem(
                    Phrase(
                        "{form} is not a format here; there are {known}.", form=repr(form), known=", ".join(MEDIA_TYPES)
                    )
                )
            )
        async with self._one:
            with tempfile.TemporaryDirectory(prefix="diecut-report-") as folder:
                content = await self._rendered(Path(folder), encoded(results_text(results)), form)
        return MadeReport(content, MEDIA_TYPES[form], {"content-disposition": f'inline; filename="{NAME}.{form}"'})

    async def _rendered(self, folder: Path, results: bytes, form: str) -> bytes:
        (folder / f"{NAME}.json").write_bytes(results)
        options = [part for place in self.folders for part in ("--plugins", str(place.absolute()))]
        options += ["--language", self.language] if self.language else []
        command = [
            sys.executable,
            "-P",
            "-m",
            "diecut_report",
            "render",
            f"{NAME}.json",
            "-o",
            "made",
            "--format",
            form,
            "--quiet",
        ]
        process = await asyncio.create_subprocess_exec(*command, *options, cwd=folder, stdin=asyncio.subprocess.DEVNULL,
                                                       stdout=asyncio.subprocess.DEVNULL, stderr=asyncio.subprocess.PIPE)  # fmt: skip
        try:
            async with asyncio.timeout(PATIENCE):
                _, told = await process.communicate()
        except asyncio.CancelledError:
            process.kill()
            raise
        except TimeoutError:
            process.kill()
            await process.wait()
            words = "The report was not made within {seconds} s, and was given up."
            raise UserError(Problem(Phrase(words, seconds=f"{PATIENCE:g}"))) from None
        files = list((folder / "made").glob(f"*.{form}"))
        if not files:
            raise UserError(Problem(told.decode(errors="replace").strip() or phrase("The report was not made.")))
        return files[0].read_bytes()
