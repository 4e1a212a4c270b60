"""The HTML report: order, escaping, nothing from outside; what it has for a reader at a screen, and that all is there without scripts."""

from __future__ import annotations

import base64
import json
import math
import re
from hashlib import sha256
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from jinja2 import UndefinedError

from diecut_report.api import chart_panel, line
from diecut_report.cli.main import main
from diecut_report.report.figures.labels import Across, ChartLine, PanelData
from diecut_report.report.pages import html
from diecut_report.report.pages.html import SCRIPTS, folder
from diecut_report.report.reader_data import (
    ReaderRows,
    _figure,
    _is_readable,
    _line,
    _room,
    _shape,
    figure_readings,
    reader_data,
)
from diecut_report.report.rendering import Rendering
from diecut_report.report.text import Catalogue
from diecut_report.results.figure_record import CircleRecord, FigureRecord, MovedRecord
from diecut_report.results.mechanism_record import CurveRecord
from diecut_report.results.model import ProgramRecord, ResultsRecord
from diecut_report.results.record import Record
from diecut_report.text.catalogues import UnknownLanguage
from tests.docs.pages import ROOT
from tests.examples import few
from tests.hostile.test_pages import CHROMIUM, browsed
from tests.records import filled
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


UPLOT = {  # version 1.6.32 as it is published, with its licence
    "uPlot.iife.min.js": "19c8d4c6ad88929a79f4ae49d6f7161566dfd0ba3d15cc495e974f787eb78f1f",
    "uPlot.min.css": "df630c6a8d6f8eeaff264b50f73ce5b114f646ffd9a0bb74f049b0a00135fa04",
    "LICENSE.txt": "8f989229699b4fe2f1a0432d0e9edc338a8a911e250e2d1b01ecd770a5f5b1bd",
}
BREAKING = "</script><!--<script>alert(1)</script>\u2028&amp;"


def _scripts(page: str) -> tuple[str, list[str]]:
    """The data of a page's scripts, and the scripts that a browser runs."""
    found = re.findall(r"<script([^>]*)>(.*?)</script>", page, re.DOTALL)
    data = [text for attributes, text in found if 'type="application/json"' in attributes]
    assert len(data) == 1
    return data[0], [text for attributes, text in found if not attributes]


def _data(page: str) -> dict[str, Any]:
    found: dict[str, Any] = json.loads(_scripts(page)[0])
    return found


def test_the_policy_allows_the_scripts_of_the_page_by_their_hashes_and_no_others(html: str) -> None:
    policy = re.findall(r'http-equiv="Content-Security-Policy" content="([^"]*)"', html)
    rules = dict(rule.strip().partition(" ")[::2] for rule in policy[0].replace("&#39;", "'").split(";"))
    hashes = [base64.b64encode(sha256(text.encode()).digest()).decode() for text in _scripts(html)[1]]
    assert len(hashes) == len(SCRIPTS)
    assert rules["script-src"].split() == [f"'sha256-{found}'" for found in hashes]
    assert rules["default-src"] == "'none'" and rules["base-uri"] == "'none'" and rules["form-action"] == "'none'"


def test_no_element_has_a_script_of_its_own(html: str) -> None:
    elements = re.sub(r"(<script[^>]*>).*?</script>", r"\1", html, flags=re.DOTALL)
    assert not re.search(r"<[^>]*\son[a-z]+\s*=|javascript:", elements)


def test_the_plotting_library_is_as_published() -> None:
    files = {path.name: sha256(path.read_bytes()).hexdigest() for path in (folder() / "uplot").iterdir()}
    assert files == UPLOT
    assert "v1.6.32" in (folder() / "uplot" / "uPlot.iife.min.js").read_text("utf-8")[:100]


def test_no_script_of_the_page_could_end_its_own_element() -> None:
    for path in folder().rglob("*.js"):
        text = path.read_bytes()
        assert b"</script" not in text and b"<!--" not in text and b"\r" not in text, path.name


def test_the_data_of_scripts_are_the_curves_in_the_units_that_are_shown(html: str, results: dict[str, Any]) -> None:
    """Held against the results by hand: each sample of the velocity and of the torque, over degrees for radians."""
    data = _data(html)
    panels = {
        panel["title"]: panel for figure in data["figures"].values() for panel in figure["panels"]
        if panel["across"]["unit"] == "°"
    }  # fmt: skip
    curves = results["mechanisms"]["drive"]["curves"]
    for title, name in (("Velocity", "velocity"), ("Torque", "crank_torque")):
        line = panels[title]["lines"][0]
        xs, ys = (np.array(data["rows"][line[key]]) for key in ("x", "y"))
        angles, values = np.degrees(curves["crank_angle"]["values"]), np.array(curves[name]["values"])
        near = np.abs(xs - angles[:, None]).argmin(axis=1)
        assert np.abs(xs[near] - angles).max() <= 1e-3
        assert np.abs(ys[near] - values).max() <= 1e-4 * np.abs(values).max()


def test_every_figure_is_there_without_scripts(html: str) -> None:
    for number in _data(html)["figures"]:
        figure = re.search(rf'<figure id="fig-{number}">.*?</figure>', html, re.DOTALL)
        assert figure and "<svg" in figure[0] and "<title>" in figure[0]


def test_tools_that_need_a_script_are_hidden_without_one(html: str) -> None:
    assert html.count('<div class="tools" hidden>') == 1
    assert html.count('<div class="filters" hidden>') == 1


def test_each_check_of_the_machine_stands_in_the_list_of_all_checks(html: str, results: dict[str, Any]) -> None:
    table = html[html.index('<table class="finds"') :]
    listed = re.findall(r'<tr data-status="(\w+)"', table[: table.index("</table>")])
    checks = [
        check for mechanism in (*results["mechanisms"].values(), *results["comparisons"].values())
        for check in mechanism.get("checks", ()) if check.get("class") != "numerical"
    ]  # fmt: skip
    assert checks and sorted(listed) == sorted(check["status"] for check in checks)


def test_chapters_have_their_verdict_in_the_contents(html: str, results: dict[str, Any]) -> None:
    contents = html[html.index('<nav class="toc"') : html.index("</nav>")]
    chapters = [*results["mechanisms"].values(), *results.get("comparisons", {}).values()]
    marks = re.findall(r'<span class="mk (\w+)" role="img" aria-label="([^"]+)"', contents)
    assert len(marks) == len(chapters)
    assert ("error", "error") in marks and ("fail", "fail") in marks


def test_no_text_breaks_out_of_the_data(plain: dict[str, Any]) -> None:
    panel = {"title": BREAKING, "unit": "mm", "lines": [{"x": [0.0, 1.0], "y": [0.0, 1.0], "label": BREAKING}], "fills": [],
             "marks": [], "levels": [], "verticals": [], "x": {"title": BREAKING, "symbol": "x", "unit": "mm"}}  # fmt: skip
    drawn = next(
        mechanism for mechanism in plain["mechanisms"].values() if mechanism["status"] not in ("error", "skipped")
    )
    drawn["sections"] = []
    drawn["figures"] = [{"id": "x", "title": "Hostile", "caption": "", "type": "chart", "panels": [panel], "shows": []}]
    material = Rendering(typed(plain))
    material.__dict__["figures"] = {number: None for part in material.document.chapters for number, _ in part.figures}
    text = reader_data(material)  # drawn or not: no font has all of these characters
    assert not set("<>&\u2028") & set(text)
    assert BREAKING in json.dumps(json.loads(text), ensure_ascii=False)


def test_a_line_keeps_its_jump_and_its_gap() -> None:
    pool, nan = ReaderRows(), math.nan
    made = _line(ChartLine(np.array([0.0, 1.0, 1.0, nan, 2.0]), np.array([1.0, 2.0, 5.0, 7.0, 6.00004]), "F_t"), pool)
    assert pool.rows[made["x"]] == [0.0, 1.0, 1.0, 1.0, 2.0]
    assert pool.rows[made["y"]] == [1.0, 2.0, 5.0, None, 6.0]


def test_rounding_takes_no_more_than_a_cursor_can_show_and_no_minus_stays_before_zero() -> None:
    pool = ReaderRows()
    assert pool.rows[pool.row([123456.0, -1e-9, 0.0, math.inf], 5)] == [123460.0, 0.0, 0.0, None]
    assert math.copysign(1.0, pool.rows[0][1] or 0.0) == 1.0


def _diagram(x: list[float], name: str = "φ") -> PanelData:
    lines = [ChartLine(np.array(x), np.zeros(len(x)), "")]
    return PanelData(title="T", unit="N", across=Across("Angle", name, "deg", 0.0, 2.0), lines=lines)


@pytest.mark.parametrize(("x", "readable"), [([0.0, 1.0, 2.0], True), ([0.0, 2.0, 1.0], False), ([0.0], False)])
def test_a_line_is_read_where_it_has_one_height_at_a_place(x: list[float], readable: bool) -> None:
    assert _is_readable(_diagram(x)) is readable


QUARTERS = [0.0, math.pi / 2, math.pi, 3 * math.pi / 2]
ANGLE = CurveRecord(unit="rad", display_unit="deg", symbol="φ", description="Angle", source="", values=QUARTERS)
FORCE = CurveRecord(
    unit="N",
    display_unit="N",
    symbol="F",
    description="Force",
    source="",
    abscissa="angle",
    values=[1.0, -2.0, 3.0, -4.0],
)


def _chart(symbol: str, over: str = "") -> FigureRecord:
    """A chart from a quarter of a turn before zero to half a turn, perhaps over the angle of the results."""
    x = [-math.pi / 2, 0.0, math.pi]
    panel = chart_panel("T", "N", "Angle", symbol, "deg", lines=[line(x, [0.0, 1.0, 2.0], "")], over=over)
    return filled(FigureRecord, {"type": "chart", "title": "T", "panels": [panel]})


def test_diagrams_of_a_mechanism_over_the_same_angle_share_their_cursor() -> None:
    pool, words, curves = ReaderRows(), Catalogue("en"), {"angle": ANGLE, "force": FORCE}
    panel = {
        "title": "T",
        "unit": "N",
        "series": [{"curve": "force", "label": ""}],
        "levels": [],
        "marks": [],
        "spans": [],
    }
    plot = filled(FigureRecord, {"type": "plot", "title": "T", "abscissa": "angle", "panels": [panel]})
    shown = [("a", _chart("ψ")), ("a", plot), ("a", _chart("ψ", "angle")), ("a", _chart("φ")), ("b", plot)]
    made = [_figure(name, figure, curves, words, pool) for name, figure in shown]
    assert [each and each["panels"][0]["group"] for each in made] == [0, 1, 1, 1, 2]
    assert pool.turns == [None, pytest.approx(360.0), pytest.approx(360.0)], "a place of another turn is the same place"


def test_a_polar_figure_is_read_over_its_angle_with_the_sign_of_its_curve() -> None:
    series = [{"curve": "force", "label": "F"}]
    polar = filled(FigureRecord, {"type": "polar", "title": "T", "abscissa": "angle", "unit": "N", "series": series})
    found = figure_readings("a", polar, {"angle": ANGLE, "force": FORCE}, Catalogue("en"))
    assert found and found["beside"]
    (own,) = found["panels"][0]["lines"]
    assert found["rows"][own["x"]] == [0, 90, 180, 270, 360] and found["rows"][own["y"]] == [1, -2, 3, -4, 1]


@pytest.mark.parametrize(("shown", "finest"), [("mm", [-3, 2]), ("deg", [-2, 3]), ("N*m", None)])
def test_the_cursor_reads_no_finer_than_is_printed(shown: str, finest: list[int] | None) -> None:
    panel = chart_panel("T", shown, "Angle", "φ", "deg", lines=[line([0.0, 1.0], [0.0, 1.0], "")])
    found = figure_readings("a", filled(FigureRecord, {"type": "chart", "panels": [panel]}), {}, Catalogue("en"))
    assert found and found["panels"][0]["finest"] == (finest and tuple(finest))


def test_a_moving_drawing_has_the_numbers_of_its_shapes_at_each_place() -> None:
    """A crank of 1 m by hand: its pin at (cos φ, sin φ); a wheel that turns with it a quarter of a turn behind."""
    angles = [0.0, math.pi / 2, math.pi]
    pins = [[math.cos(a), math.sin(a)] for a in angles]
    spoke = {"shape": "polyline", "points": [[0.0, 0.0], [2.0, 0.0]], "closed": False, "role": "body"}
    pool = ReaderRows()
    moves = [[0.0, 0.0, *pin] for pin in pins]
    crank = _shape(MovedRecord(shape="polyline", role="link", closed=False, moves=moves), pool, "deg")
    moves = [[0.0, 5.0, a - math.pi / 2] for a in angles]
    wheel = _shape(MovedRecord(shape="rigid", shapes=[spoke], moves=moves), pool, "deg")
    still = _shape(CircleRecord(shape="circle", center=[1.0, 2.0], radius=0.123456789, role="ghost"), pool, "deg")
    assert [pool.rows[row] for row in crank["rows"]] == [[0], [0], [1, 0, -1], [0, 1, 0]]
    assert [pool.rows[row] for row in wheel["rows"]] == [[0], [5], [-90, 0, 90]]
    assert wheel["shapes"][0]["numbers"] == [0, 0, 2, 0] and still["numbers"] == [1, 2, 0.1235]


def test_a_moving_drawing_has_room_for_all_that_it_ever_reaches() -> None:
    spoke = {"shape": "polyline", "points": [[0.0, 0.0], [2.0, 0.0]], "closed": False, "role": "body"}
    turns = [[1.0, 0.0, angle] for angle in np.linspace(0, 2 * math.pi, 73)]
    wheel = MovedRecord(shape="rigid", shapes=[spoke], moves=turns)
    roller = MovedRecord(shape="circle", role="mark", moves=[[0.0, 3.0, 1.0], [0.0, 1.0, 1.0]])
    left, top, width, height = _room([wheel, roller])
    assert np.allclose([left, top, width, height], [-1.18, -4.18, 4.36, 6.36])


# A drawing that moves, as a browser draws it.


PAGE = ROOT / "docs" / "how-to" / "moving-drawings.md"
PRESS = """\
schema_version: 1
project: {title: Cam}
press: {name: Press}
mechanisms:
  cam: {kind: cam_drive}
"""


@pytest.mark.nightly
@pytest.mark.skipif(CHROMIUM is None, reason="needs Chromium")
def test_the_frame_has_its_strokes_on_a_screen_too(tmp_path: Path) -> None:
    code = re.search(r"<!-- file my_plugins/cam_drive.py -->\n```python\n(.*?)```", PAGE.read_text("utf-8"), re.DOTALL)
    assert code
    (tmp_path / "cam_drive.py").write_text(code[1], "utf-8")
    (tmp_path / "cam.yaml").write_text(PRESS, "utf-8")
    command = ["report", tmp_path / "cam.yaml", "--plugins", tmp_path, "--format", "html", "-o", tmp_path, "--quiet"]
    assert main([*map(str, command)]) == 0
    shown = browsed(tmp_path, (tmp_path / "cam.html").read_text("utf-8"), "--dump-dom").stdout
    ways = re.findall(r'class="m-ground" d="([^"]*)"', shown)
    assert ways and all(way.startswith("M-0.06 0.06l0.12 0M") and way.count("l") > 15 for way in ways)
