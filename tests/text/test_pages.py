"""All that is set in Ukrainian by the language of the project alone: no English word is left, and no Latin letter in a Ukrainian word.

Reports themselves stand in `tests/report/test_ukrainian.py`; here are the pages of studies, searches and checks, of differences, of the live page and
of a plugin, and Word and Excel files. Of the larger examples their results are looked at, as reports print nothing else.
"""

from __future__ import annotations

import html
import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from zipfile import ZipFile

import pytest

from diecut_report.config.loader import load_config
from diecut_report.config.plugins import Discovery
from diecut_report.design.optimisation import page as optimisation_page
from diecut_report.live.page import page as live_page
from diecut_report.live.page import page_data
from diecut_report.live.session import LiveSession
from diecut_report.press import Press
from diecut_report.report.text import translated
from diecut_report.results.model import ResultsRecord
from diecut_report.study import command
from diecut_report.study.summary import summarise
from diecut_report.testing.contract import ContractTest
from diecut_report.text import po_files
from diecut_report.text.catalogues import Catalogues, built_in_kinds
from diecut_report.text.translation import speaking
from tests.cli.test_cli import run
from tests.configs import EXAMPLES
from tests.examples import few
from tests.processes import Example
from tests.report.test_ukrainian import LATIN, OWN, VERBATIM, titles, verbatim, visible
from tests.shared import once
from tests.text.test_ukrainian_words import CATALOGUES, MIXED, PLACE

KNIFE = next(path for path in EXAMPLES if path.stem == "circular_knife")
ECCENTRICITY = "vary:\n  mechanisms.knife.eccentricity: {from: 14 mm, to: 26 mm"
STUDY = f"""\
schema_version: 1
base: base.yaml
sample: {{method: grid}}
{ECCENTRICITY}, count: 4}}
  mechanisms.knife.depth: [108 mm, 112 mm, 119 mm]
objectives: [{{minimise: knife.cut_time}}, {{minimise: knife.reach_greatest}}]
"""
SEARCH = f"""\
schema_version: 1
base: base.yaml
{ECCENTRICITY}}}
  mechanisms.knife.depth: {{from: 105 mm, to: 119 mm}}
optimise:
  objectives: [{{minimise: knife.cut_time}}, {{minimise: knife.reach_greatest}}]
  {{evaluations: 40, population: 20, points: 2}}
""".replace("  {evaluations: 40, population: 20, points: 2}", "  evaluations: 40\n  population: 20\n  points: 2")
KEYS = {
    "count",
    "minimise",
    "out",
    "front",
    "csv",
    "json",
    "xlsx",
    "html",
    "SHA",
    "take",
    "none",
    "yaml",
    "study",
    "base",
    "search",
}
"""Words of files, commands and keys that pages show as they are typed."""
OFFICE = re.compile(r"<(?:w:t|t|dc:\w+)(?: [^>]*)?>([^<]*)<")
PRINTED = ("title", "label", "description", "words", "caption")  # of results: also where a single word stands there
OF_LIVE = ("title", "text", "message", "advice", "figures", "shown")


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with all that is made of a machine whose project is Ukrainian, while messages are English."""
    return once(tmp_path_factory, "ukrainian_pages", _make)


def _make(folder: Path) -> None:
    base = folder / "base.yaml"
    base.write_text(KNIFE.read_text("utf-8").replace("language: en", "language: uk"), "utf-8")
    (folder / "knife.yaml").write_text(base.read_text("utf-8").replace("value: 20 mm", "value: 21 mm"), "utf-8")
    for name, text in (("study", STUDY), ("search", SEARCH)):
        (folder / f"{name}.yaml").write_text(text, "utf-8")
    with pytest.MonkeyPatch.context() as patch:
        for name in ("DIECUT_REPORT_LANGUAGE", "LC_ALL", "LC_MESSAGES", "LANG"):
            patch.delenv(name, raising=False)
        patch.setattr(command, "summarise", lambda out, discovery: summarise(out, ["html"], discovery))
        patch.setattr(optimisation_page, "sheets", lambda _: b"")
        for given in (
            ("batch", folder / "study.yaml", "-o", folder / "study"),
            ("optimise", folder / "search.yaml", "-o", folder / "search"),
        ):
            assert run(*given, "--jobs", "1", "--quiet") in (0, 1)
        assert run("report", base, "-o", folder, "--format", "docx,xlsx,json", "--detail", "full", "--quiet") == 0
        assert run("check", base, folder / "knife.yaml", "-o", folder, "--format", "html,xlsx", "--quiet") == 0
    _live(folder, base)
    _plugin(folder, base)


def _live(folder: Path, base: Path) -> None:
    from diecut_report.config.plugins import catalogues_of

    session = LiveSession(base, Discovery([]))
    with speaking("uk", catalogues_of("uk", Discovery([]))):
        (folder / "live.html").write_bytes(live_page(base.name))
        (folder / "live.json").write_text(json.dumps(page_data(session), ensure_ascii=False), "utf-8")


def _plugin(folder: Path, base: Path) -> None:
    known = Discovery([])
    test = ContractTest(known.mechanism("circular_knife"), known, load_config(base, known), "knife", "uk")
    assert test.tried_alone("figures").status == "pass"
    (folder / "plugin.html").write_text(test.page, "utf-8")


@pytest.fixture(scope="module")
def known(made: Path) -> set[str]:
    """Words that stand as the user or a source wrote them."""
    results = json.loads((made / "base.json").read_text("utf-8"))
    written = [(made / name).read_text("utf-8") for name in ("base.yaml", "study.yaml", "search.yaml")]
    told = (*verbatim(results), *written)
    return {word for text in told for word in re.findall(r"[A-Za-z]+", text)} | OWN | KEYS | titles()


def texts_of(file: Path) -> Iterator[str]:
    """All that is read in a file."""
    if file.suffix == ".html":
        yield from visible(re.sub(r"<script\b.*?</script>", " ", file.read_text("utf-8"), flags=re.DOTALL))
    elif file.suffix == ".json":
        yield from _shown(json.loads(file.read_text("utf-8")))
    else:
        with ZipFile(file) as archive:
            for name in archive.namelist():
                if name.endswith(".xml"):
                    told = map(html.unescape, OFFICE.findall(archive.read(name).decode()))
                    yield from (text for text in told if not text.startswith("/"))  # the path of a file


def _shown(data: Any, key: str = "") -> Iterator[str]:
    """What the live page shows of its data; of the summary that is numbers alone."""
    if isinstance(data, dict):
        for name, part in data.items():
            yield from _shown(part, name) if name != "summary" else ()
    elif isinstance(data, list):
        for part in data:
            yield from _shown(part, key)
    elif isinstance(data, str) and key in OF_LIVE:
        yield data


def said(data: Any, key: str = "") -> Iterator[str]:
    """The sentences of plain data, and its titles."""
    if isinstance(data, dict):
        for name, part in data.items():
            yield from said(part, name)
    elif isinstance(data, list | tuple):
        for part in data:
            yield from said(part, key)
    elif isinstance(data, str) and key not in (*VERBATIM, "value") and (" " in data or key in PRINTED):
        yield data


PAGES = {
    "study/summary.html": "Підсумок дослідження",
    "search/optimisation.html": "Тривалість розрізу (knife)",
    "machines.html": "Висновки",
    "machines.xlsx": "висновок",
    "base.docx": "Тривалість розрізу",
    "base.xlsx": "Тривалість розрізу",
    "live.html": "Скасувати все",
    "live.json": "Тривалість розрізу",
    "plugin.html": "Тривалість розрізу",
}


@pytest.mark.nightly
@pytest.mark.parametrize("name", PAGES)
def test_no_english_is_left(name: str, made: Path, known: set[str]) -> None:
    told = list(texts_of(made / name))
    assert any(PAGES[name].lower() in text.lower() for text in told)
    assert {word: text.strip() for text in told for word in LATIN.findall(text) if word not in known} == {}
    assert [text for text in told if MIXED.search(text)] == []


@pytest.mark.nightly
def test_differences_are_told_in_ukrainian(made: Path, known: set[str], capfd: pytest.CaptureFixture[str]) -> None:
    assert run("diff", made / "base.yaml", made / "knife.yaml", "--format", "html") == 0
    told = visible(re.sub(r"<script\b.*?</script>", " ", capfd.readouterr().out, flags=re.DOTALL))
    assert {word: text for text in told for word in LATIN.findall(text) if word not in known} == {}
    assert [text for text in told if MIXED.search(text)] == []


def left_over(results: ResultsRecord) -> dict[str, str]:
    """English words, and words of two alphabets, of results as they are printed in Ukrainian."""
    shown = translated(results.with_(project=results.project.with_(language="uk")), Catalogues("uk")).data()
    printed = list(said([shown.get(part, {}) for part in ("mechanisms", "comparisons", "press")]))
    given = (*verbatim({**results.data(), "config": None}), "none")
    known = {word for text in given for word in re.findall(r"[A-Za-z]+", text)} | OWN | titles() | {*built_in_kinds()}
    return {
        word: text for text in printed for word in [*LATIN.findall(text), *MIXED.findall(text)] if word not in known
    }


@pytest.mark.nightly
def test_the_published_press_is_ukrainian(example: Example) -> None:
    assert left_over(ResultsRecord.model_validate_json(example.told)) == {}


@pytest.mark.parametrize(
    "config",
    few(
        [path for path in EXAMPLES if path.stem != "flat_cylinder_press"],
        lambda path: path.stem == "flat_cylinder_belt_press",
    ),
    ids=lambda path: path.stem,
)
def test_an_example_is_ukrainian(config: Path) -> None:
    outcome = Press.read(config, Discovery([])).calculate()
    assert left_over(outcome.results) == {}


@pytest.mark.parametrize("name", CATALOGUES)
def test_english_texts_have_english_letters(name: str) -> None:
    """What documents and messages say in English is what catalogues translate."""
    ids = [each for m in po_files.read(CATALOGUES[name], "uk") for each in ((m.id,) if isinstance(m.id, str) else m.id)]
    assert [text for text in ids if re.search("[а-яіїєґё]", PLACE.sub("", text), re.IGNORECASE)] == []
