"""The HTML report: order, escaping, nothing from outside."""

from __future__ import annotations

import re
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import pytest
from jinja2 import UndefinedError

from diecut_report.report.pages import html
from diecut_report.report.pages.html import SCRIPTS
from diecut_report.report.rendering import Rendering
from diecut_report.results.model import ProgramRecord, ResultsRecord
from diecut_report.results.record import Record
from diecut_report.text.catalogues import UnknownLanguage
from tests.examples import few
from tests.report.made_results import typed

BAD = "<script>alert(1)</script>"
VOID = {"wbr", "meta", "img", "br", "col", "path", "use", "rect", "link", "mspace", "circle", "line", "input"}


class Balance(HTMLParser):
    """Checks that tags close in order, and collects ids and links."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.ids: list[str] = []
        self.targets: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        given = dict(attrs)
        self.ids += [given["id"] or ""] if "id" in given else []
        self.targets += [(given["href"] or "")[1:]] if tag == "a" and "download" not in given else []
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.ids += [value or "" for name, value in attrs if name == "id"]

    def handle_endtag(self, tag: str) -> None:
        if tag not in VOID:
            assert self.open.pop() == tag


def test_tags_balance_ids_are_unique_and_links_have_a_target(html: str) -> None:
    page = Balance()
    page.feed(html)
    assert page.open == []
    assert len(page.ids) == len(set(page.ids))
    assert page.targets and set(page.targets) <= set(page.ids)


def test_nothing_comes_from_outside(html: str) -> None:
    addresses = set(re.findall(r"https?://[^\"'\s<>)]+", html))
    of_comment = {"https://github.com/leeoniya/uPlot"}  # where the plotting library names itself
    assert addresses <= {"http://www.w3.org/2000/svg", "http://www.w3.org/1999/xlink"} | of_comment
    assert not re.search(r"<(link|iframe|object|embed|base|form)\b|<script[^>]*\bsrc", html)
    assert set(re.findall(r"url\(\"?([^\")]{0,10})", html)) <= {"data:font/"} | set(
        re.findall(r"url\((#[^)\"]{0,9})", html)
    )


def test_failures_stand_before_warnings_and_passes(html: str) -> None:
    table = html[html.index('<table class="checks"') :]
    table = table[: table.index("</table>")]
    assert re.findall(r'<tr class="(\w+)">', table) == ["fail", "warn", "pass", "pass", "pass"]
    assert html.index("The bore breaks through the flat") < html.index('<table class="checks"')


def test_broken_and_skipped_mechanisms_are_told(html: str) -> None:
    assert "the plugin broke: division by zero in eq. 4" in html
    assert "2 parts are not calculated" in html or "1 part is not calculated" in html
    assert "This mechanism could not be calculated." in html
    assert "refers to cam, which is in error" in html


def test_a_press_with_nothing_but_a_name_has_no_empty_table(plain: dict[str, Any], html: str) -> None:
    assert '<table class="inputs press-data">' in html
    plain["press"]["fields"] = []
    page = Rendering(typed(plain)).html()
    assert 'press-data"' not in page and '<h2 id="press">' in page
    assert "The configuration gives only the name of the press." in page


def test_inputs_show_where_they_come_from(html: str) -> None:
    assert "${press.sheet.length}" in re.sub(r"</?(?:wbr|span)[^>]*>", "", html)  # a line may break behind its dots
    assert "default, from press.productivity" in html


def test_size_stays_below_the_agreed_limit(html: str) -> None:
    assert len(html.encode()) < 1_500_000


def _poisoned(value: Any) -> Any:
    """All texts that people write, with a script in them; names and numbers that the program writes stay."""
    value = value.data() if isinstance(value, Record) else value
    if isinstance(value, dict):
        return {k: BAD if k in WRITTEN and isinstance(v, str) else _poisoned(v) for k, v in value.items()}
    return [_poisoned(part) for part in value] if isinstance(value, list) else value


WRITTEN = {
    "title", "document_number", "revision", "date", "organisation", "prepared_by", "checked_by", "approved_by", "description",
    "by", "name", "source_text", "file", "error", "summary", "message", "source", "citation", "caption", "label", "note", "words",
    "method", "demand_label", "limit_label", "text", "path", "kind", "plugin_version", "sha256",
}  # fmt: skip


@pytest.mark.parametrize("document", ["plain", pytest.param("results", marks=pytest.mark.nightly)])
def test_scripts_in_any_text_are_only_text(request: pytest.FixtureRequest, document: str) -> None:
    """Of the figures' texts tests/report/test_figures.py has one too."""
    poisoned = _poisoned(request.getfixturevalue(document))
    for mechanism in poisoned["mechanisms"].values():
        mechanism["assumptions"] = [BAD]
        for row in [*mechanism.get("outputs", {}).values(), *mechanism.get("inputs", {}).values()]:
            row["symbol"] = BAD
    poisoned["program"]["name"] = "diecut-report"  # which no other program writes
    page = Rendering(typed(poisoned)).html()
    assert re.findall(r"<script[^>]*>", page) == [
        '<script type="application/json" id="reader-data">',
        *["<script>"] * len(SCRIPTS),
    ]
    assert BAD not in page
    assert page.count("&lt;script&gt;") > 60


def test_missing_data_is_an_error_and_no_gap(plain: dict[str, Any]) -> None:
    results = typed(plain)
    lacking = results.with_(program=ProgramRecord.model_construct(name="diecut-report"))
    with pytest.raises(UndefinedError, match="version"):
        Rendering(lacking).html()
    told = results.data()
    del told["program"]["version"]
    with pytest.raises(ValueError, match=r"program\.version"):
        ResultsRecord.model_validate(told)


def test_optional_title_block_entries_may_be_missing(plain: dict[str, Any]) -> None:
    plain["project"] = {"title": "Bare"}
    assert "<h1>Bare</h1>" in Rendering(typed(plain)).html()


def test_templates_have_no_words_of_their_own() -> None:
    of_reports = [
        path for path in html.folder().glob("*.j2") if not path.name.startswith("summary")
    ]  # which is English
    assert of_reports
    for path in of_reports:
        text = re.sub(
            r"\{#.*?#\}|\{%.*?%\}|\{\{.*?\}\}|<[^>]*>", " ", path.read_text(encoding="utf-8"), flags=re.DOTALL
        )
        assert not re.findall(r"[^\W\d_]{2,}", text.replace("&nbsp;", " ")), path.name


def test_language_without_a_catalogue_is_refused(results: dict[str, Any]) -> None:
    found = typed(results)
    with pytest.raises(UnknownLanguage):
        Rendering(found.with_(project=found.project.with_(language="xx")))


def test_a_description_stands_in_an_element_of_its_own_before_another_one() -> None:
    """A page engine that finds no room for the second one breaks the text before it at its first blank: Mean | torque at the shaft key."""
    bare = re.compile(r"(?<!<span>)\{\{ \w+\.description\|prose \}\}(?:\{%[^%]*%\})* ?<span")
    pages = [
        page for page in html.folder().glob("*.j2") if page.name != "notebook.html.j2"
    ]  # which is never set in sheets
    assert [(page.name, found[0]) for page in pages for found in bare.finditer(page.read_text("utf-8"))] == []


def test_figures_on_a_screen_have_texts_of_one_size(html: str) -> None:
    """Each is as much larger than on paper as any other: the letters of a narrow one are not those of a heading."""
    sizes = re.findall(r'<svg[^>]*viewBox="0 0 ([\d.]+) [\d.]+"( class="small")? width="([\d.]+)pt"', html)
    assert len(sizes) > 2
    for natural, small, shown in sizes:
        assert float(shown) / float(natural) == pytest.approx(1.35, abs=1e-3) and bool(small) == (float(natural) < 300)


# A report can be made again from a results file alone.


@pytest.mark.parametrize("ending", few(["html", "pdf"], keep=lambda ending: ending == "html"))
def test_the_report_of_a_results_file_is_the_report(small_report: Path, ending: str) -> None:
    file = small_report / "small.json"
    again = Rendering(ResultsRecord.model_validate_json(file.read_bytes()))
    made = again.html().encode() if ending == "html" else again.pdf()
    assert made == file.with_suffix(f".{ending}").read_bytes()


@pytest.mark.wheel
def test_a_report_is_made_with_all_that_is_installed(small_report: Path) -> None:
    assert {path.suffix for path in small_report.iterdir()} == {".html", ".pdf", ".json"}
    assert "<svg" in (small_report / "small.html").read_text(encoding="utf-8")
