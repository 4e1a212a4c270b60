"""The page engine's functions made quicker: a page comes out as the engine alone sets it, to the last byte."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import pytest

from diecut_report.report import Rendering, page_engine, quick_engine
from diecut_report.report.page_engine import HTML

PAGE = """<html lang="uk"><title>x</title><style>
@page { size: 90mm 120mm; margin: 8mm; @bottom-right { content: counter(page) " / " counter(pages) } }
body { font-size: 8pt; line-height: calc(1em + 2pt) } p { hyphens: auto; text-align: justify; margin-inline-start: 2mm }
table { width: 100%; table-layout: fixed; border-collapse: separate } td { border-bottom: 0.3pt solid #c3cbd3; overflow-wrap: break-word;
  padding: 1mm 2%; font-variant-numeric: tabular-nums } .old { border-collapse: collapse; table-layout: auto } .old td { border: 1pt solid }
.what { float: left; max-width: 22mm } .what::after { content: "…" } li::after { content: ""; display: block; clear: both }
.box { display: inline-block; width: 60%; box-sizing: border-box; border: 1pt dashed red; border-radius: 2mm; background: #eef }
.no { position: absolute; left: 0 } .eq { position: relative; padding-left: 13mm; break-inside: avoid } .far { visibility: hidden }
u { text-decoration: underline } a::after { content: target-counter(attr(href), page); position: absolute; right: 0 }
.wide { letter-spacing: 1pt; white-space: nowrap; text-overflow: ellipsis; overflow: hidden }
</style><h1 id="start">Звіт</h1><p><a href="#end">До кінця</a> <u>підкреслено</u> <span class="far">не видно</span></p>
""" + "".join(
    f"""<div class="eq" id="e{n}"><span class="no">({n})</span><p>Натискний циліндр і коромисло повертають передавальний механізм № {n}
 на кут <i>φ</i><sub>{n}</sub> = {n * 1.7:.1f}°, a word, an unbreakable-and-very-long-compound-word and one more word.</p></div>
<ul><li><span class="what">The description of {n} that is long</span> <span>M = {n * 12.5} N·m</span></li><li>{n}</li></ul>
<div class="box">Box {n} of <b>words</b></div><table{' class="old"' if n % 3 else ""}><tr><td>cell</td><td>{n}.125</td><td>cell</td></tr></table>
<p class="wide">A line that is much longer than the page is wide, number {n}, so that it ends in an ellipsis</p>"""
    for n in range(1, 9)
) + '<p id="end">Кінець</p>'  # fmt: skip


@pytest.fixture
def as_it_is() -> Iterator[Callable[[], None]]:
    """What puts the engine's own functions back, until the test has ended."""
    yield page_engine.put_back
    page_engine.put_back()
    quick_engine.hasten()


def test_a_page_comes_out_as_the_engine_alone_sets_it(as_it_is: Callable[[], None]) -> None:
    quick = HTML(string=PAGE).write_pdf(pdf_variant="pdf/ua-1")
    as_it_is()
    assert HTML(string=PAGE).write_pdf(pdf_variant="pdf/ua-1") == quick


@pytest.mark.nightly
def test_a_report_comes_out_as_the_engine_alone_sets_it(rendering: Rendering, as_it_is: Callable[[], None]) -> None:
    quick = rendering.pdf()
    as_it_is()
    assert rendering.pdf() == quick


def test_the_engine_is_left_alone_where_it_is_another_one(
    as_it_is: Callable[[], None], monkeypatch: pytest.MonkeyPatch
) -> None:
    as_it_is()
    own = {name: of.__dict__[name] for of, name, _ in quick_engine._METHODS}
    monkeypatch.setattr(quick_engine, "KNOWN", ("71.0", "0.13.0"))
    quick_engine.hasten()()
    assert {name: of.__dict__[name] for of, name, _ in quick_engine._METHODS} == own
    monkeypatch.undo()


def test_a_text_that_fits_into_a_line_is_set_once(monkeypatch: pytest.MonkeyPatch) -> None:
    from diecut_report.report import quick_texts

    asked: list[str] = []
    original = quick_texts._split

    def noted(text: str, *given: object) -> object:
        asked.append(text)
        return original(text, *given)

    monkeypatch.setattr(quick_texts, "_split", noted)
    rows = "<tr><td>same</td></tr>" * 5
    style = "table { table-layout: fixed; width: 100% }"
    HTML(string=f"<html lang=en><style>{style}</style><table>{rows}</table>").render()
    assert asked.count("same") == 1
