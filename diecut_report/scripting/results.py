"""The results of a machine: its verdict, its mechanisms, the results file, and its report."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping
from functools import cached_property
from pathlib import Path
from typing import Any

from diecut_report import pipeline
from diecut_report.config.discovery import Discovery
from diecut_report.config.loader import Config
from diecut_report.config.model import DETAILS
from diecut_report.errors import ConfigError, PluginError, Problem, nearest
from diecut_report.exchange.rendering import document
from diecut_report.files import write_all
from diecut_report.languages.catalogues import SOURCE_LANGUAGE
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.languages.speech import said, speaking
from diecut_report.results.conclusion import conclusion
from diecut_report.results.results_file import encoded, results_text
from diecut_report.scripting.mechanism_results import MechanismResults
from diecut_report.scripting.named_parts import NamedParts, unknown
from diecut_report.scripting.parts import CheckList, CheckResult
from diecut_report.scripting.printable import Printable
from diecut_report.scripting.spoken import known_language, told_in

Data = dict[str, Any]


class Results(Mapping[str, MechanismResults]):
    """Hold what was calculated of a machine: a mapping of its mechanisms by name.

    ``errors`` are the plugins that broke; the results of the other mechanisms stand. ``config`` is what was calculated, None of
    results that were read from a file.
    """

    def __init__(
        self, data: Data, discovery: Discovery, language: str | None, *, config: Config | None = None, errors: Iterable[PluginError] = ()
    ) -> None:  # fmt: skip
        self._data, self.language, self._printable = data, language, Printable(data, discovery, language)
        self.config, self.errors = config, tuple(errors)

    # --- verdict -----------------------------------------------------------------------------------------------------

    @property
    def status(self) -> str:
        """Return the verdict on the machine: ``pass``, ``warn`` or ``fail``; ``error`` where a mechanism could not be calculated."""
        return str(self._data["status"])

    @property
    def summary(self) -> Data:
        """Return how many checks there are of each status, the governing one, and the paths of assumed inputs (``summary`` of the results file)."""
        return dict(self.data["summary"])

    @property
    def conclusion(self) -> str:
        """Return the first line on the machine, as the report says it: what fails, and what is left open."""
        with speaking(self.language or SOURCE_LANGUAGE):
            return said(conclusion(self._data))

    @property
    def governing(self) -> CheckResult | None:
        """Return the check that governs; None where none is made."""
        named = self._data["governing"]
        return None if named is None else self[named["mechanism"]].checks[named["check"]]

    @cached_property
    def checks(self) -> CheckList:
        """Return the checks of all mechanisms, in their order."""
        return CheckList([check for mechanism in self.values() for check in mechanism.checks], self._printable)

    # --- mechanisms --------------------------------------------------------------------------------------------------

    @cached_property
    def _mechanisms(self) -> dict[str, MechanismResults]:
        return {name: MechanismResults(name, data, self._printable) for name, data in self._data["mechanisms"].items()}

    @cached_property
    def comparisons(self) -> NamedParts[MechanismResults]:
        """Return the comparisons between mechanisms by name."""
        found = {
            name: MechanismResults(name, data, self._printable)
            for name, data in self._data.get("comparisons", {}).items()
        }
        return NamedParts(found, phrase("there is no comparison"), self.language)

    def __getitem__(self, name: str) -> MechanismResults:
        """Return the results of a mechanism; UnknownName where there is none of that name."""
        if name not in self._mechanisms:
            with told_in(self.language):
                raise unknown(Phrase("there is no mechanism"), name, list(self._mechanisms))
        return self._mechanisms[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._mechanisms)

    def __len__(self) -> int:
        return len(self._mechanisms)

    def _ipython_key_completions_(self) -> list[str]:
        return list(self)

    # --- the results file --------------------------------------------------------------------------------------------

    @cached_property
    def data(self) -> Data:
        """Return the results as plain data, as in the results file (docs/results-file.md); what is changed in it changes nothing else."""
        found: Data = json.loads(self.to_json())
        return found

    @property
    def sha256(self) -> str:
        """Return the SHA-256 of the configuration that they follow from."""
        return str(self._data["config"]["sha256"])

    def to_json(self) -> str:
        """Return the results file, which is that of the command ``calc``."""
        return results_text(self._data)

    def save(self, file: str | Path) -> Path:
        """Write the results file; Unwritable in words where that is not possible."""
        return self._write(Path(file), encoded(self.to_json()))

    def _write(self, path: Path, content: bytes) -> Path:
        with told_in(self.language):
            write_all({path: content}, keep=Path(self.config.tree.file) if self.config else None)
        return path

    # --- the report --------------------------------------------------------------------------------------------------

    def report(
        self, file: str | Path, *, detail: str | None = None, only: Iterable[str] = (), language: str | None = None
    ) -> Path:
        """Write the report as PDF, HTML, DOCX or XLSX, by the ending of the file; it is that of the command ``report``.

        ``detail`` is ``brief``, ``standard`` or ``full``, ``only`` the mechanisms that alone are shown, ``language`` that of the
        document; without them as the configuration has it. ConfigError for another ending, detail, mechanism or language, Unwritable
        where the file cannot be written; PluginError where a figure cannot be drawn: the file is written then without it.
        """
        path = Path(file)
        with told_in(self.language):
            form = _form(path)
            asked = pipeline.AskedReport(known_language(language), _detail(detail), tuple(only))
        for name in asked.only:
            self[name]
        with told_in(self.language):
            content, lost = self._rendered(form, asked)
        self._write(path, content)
        for each in lost:
            raise PluginError(f"{each.what} {each.id}: {each.words}", self[each.mechanism].kind, each.mechanism)
        return path

    def _rendered(self, form: str, asked: pipeline.AskedReport) -> tuple[bytes, list[pipeline.Lost]]:
        data = self._reported()
        asked.told(data)
        catalogues = pipeline.catalogues_of(data, self._printable.discovery, (form,))
        contents, lost = document(data, (form,), lambda _: None, self._data["config"]["file"], catalogues)
        return contents[form], lost

    def _reported(self) -> Data:
        """The results with what a report alone tells: what of the assumed values matters, and what comes of the advice."""
        data = self._printable.copied()
        if self.config is not None and not self.errors:
            from diecut_report.design.followed_advice import followed
            from diecut_report.design.report_influence import influenced
            from diecut_report.study.analysis.assumed import moves

            if data["summary"]["assumed"]:
                data["summary"]["moves"] = moves(self.config, data)
            if data["summary"]["fail"] and (found := followed(self.config, data)):
                data["summary"]["advice"] = found
            if matters := influenced(self.config):
                data["influence"] = matters
        return data

    # --- shown -------------------------------------------------------------------------------------------------------

    def __repr__(self) -> str:
        counts = self._data["summary"]
        told = ", ".join(
            f"{counts[status]} {status}" for status in ("fail", "warn", "pass", "not_checked") if counts[status]
        )
        return f"<results of {self._data['press']['name']}: {self.status} ({told or 'no checks'}); {', '.join(self)}>"

    def _repr_html_(self) -> str:
        from diecut_report.scripting.display import results_html

        return results_html(self._printable)


def _form(path: Path) -> str:
    form = path.suffix.removeprefix(".").lower()
    if form not in pipeline.DRAWN:
        words = Phrase(
            "{form} is not a format of a report; known: {known}.",
            form=repr(path.suffix),
            known=", ".join(pipeline.DRAWN),
        )
        raise ConfigError(Problem(words, str(path)))
    return form


def _detail(detail: str | None) -> str | None:
    if detail is None or detail in DETAILS:
        return detail
    near = nearest(detail, DETAILS)
    words = Phrase(
        "{given} is not a detail{nearest}; known: {known}.", given=repr(detail), nearest=near, known=", ".join(DETAILS)
    )
    raise ConfigError(Problem(words, path="detail"))
