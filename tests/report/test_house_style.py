"""A firm's own templates: they override blocks, reach plain data and nothing else, and what is wrong with them is told with file and line."""

from __future__ import annotations

import re
import resource
from collections.abc import Iterator, Mapping
from dataclasses import fields, is_dataclass
from functools import cached_property
from pathlib import Path
from types import FunctionType, MethodType, SimpleNamespace
from typing import Any

import pytest
from jinja2 import Environment, FileSystemLoader, defaults
from markupsafe import Markup

from diecut_report.cli.main import main
from diecut_report.config.plugins import Discovery
from diecut_report.errors import UserError
from diecut_report.exchange.verification import other_templates
from diecut_report.firm_folder import house_style
from diecut_report.press import drawn
from diecut_report.report.context import Material
from diecut_report.report.pages import firm_templates
from diecut_report.report.pages.firm_templates import HouseStyle, TemplateSandbox, blocks
from diecut_report.report.pages.html import (
    FILTERS,
    Screen,
    filled,
    folder,
    page,
    policy,
    template_functions,
    template_variables,
)
from diecut_report.report.pages.page_policy import refuse_fetching
from diecut_report.report.pages.pdf import Paper, sheets
from diecut_report.report.text import Catalogue
from diecut_report.results.record import Record
from tests.configs import SMALL, saved
from tests.report.made_results import typed

Data = dict[str, Any]
DOCS = Path(__file__).parents[2] / "docs"
OBEYED = policy("x")
CHARSET, META = '<meta charset="utf-8">', f'<meta http-equiv="Content-Security-Policy" content="{OBEYED}">'
HEAD = CHARSET + META
EXTENDS = '{% extends "program/report.html.j2" %}\n'


def closing(text: str) -> str:
    """A template whose block at the end has a text, on its third line."""
    return f"{EXTENDS}{{% block closing %}}\n{text}\n{{% endblock %}}\n"


def written(tmp_path: Path, **files: str) -> Path:
    """A folder with files; ``__`` stands for a dot."""
    for name, text in files.items():
        (tmp_path / name.replace("__", ".")).write_text(text, "utf-8")
    return tmp_path


@pytest.fixture
def brief(plain: Data) -> Data:
    """A brief report of one mechanism, which is soon made."""
    cylinder = plain["mechanisms"]["cylinder"]
    return plain | {"mechanisms": {"cylinder": cylinder}, "comparisons": {}, "report": {"detail": "brief"}}


@pytest.mark.nightly
def test_the_example_overrides_its_blocks_on_screen_and_in_print(plain: Data) -> None:
    house = house_style(DOCS / "house-style")
    material = Material(typed(plain), house=house)
    for text in (page(material), filled(material, Paper(material), "print")):
        assert text.index("Department of presses") < text.index("<h1>Sample press</h1>")
        assert "holds for the configuration press.yaml alone" in text
        assert text.count("Reviewed by the group") == sum(not part.lost for part in material.document.chapters)
        assert 'src="data:image/png;base64,' in text and ".house-terms" in text.partition("</style>")[0]
        assert 'id="summary"' in text and "2 parts are not calculated" in text
    assert page(Material(typed(plain), house=house_style(DOCS / "house-style"))) == page(material)


def test_the_blocks_are_those_of_the_guide() -> None:
    guide = (DOCS / "house-style.md").read_text("utf-8")
    environment = Environment(loader=FileSystemLoader(folder()), autoescape=True)
    for name in ("report.html.j2", "chapter.html.j2"):
        (line,) = re.findall(rf"^- `{re.escape(name)}`: (.*)$", guide, re.MULTILINE)
        told = re.findall(r"`(\w+)`", line.replace("(within `summary`)", ""))
        assert told == blocks(name, environment)


def test_a_folder_without_templates_changes_nothing_but_the_style(brief: Data, tmp_path: Path) -> None:
    house = house_style(written(tmp_path, house__css="h1 { color: red; }"))
    assert page(Material(typed(brief), house=house)).replace("\nh1 { color: red; }", "") == page(Material(typed(brief)))


FAULTS = {
    "syntax": ({"report__html__j2": EXTENDS + "{% block closing %}"}, "report.html.j2:2: Unexpected end of template"),
    "template": ({"reprot__html__j2": EXTENDS}, "is not a template of the program (did you mean 'report.html.j2'?)"),
    "extends": ({"report__html__j2": '{% extends "program/repor.html.j2" %}'}, "(did you mean 'report.html.j2'?)"),
    "itself": ({"report__html__j2": '{% extends "report.html.j2" %}'}, 'Write {% extends "program/report.html.j2" %}'),
    "block": (
        {"report__html__j2": EXTENDS + "\n{% block titel_block %}{% endblock %}"},
        "report.html.j2:3: 'titel_block' is not a block of the template (did you mean 'title_block'?)",
    ),
    "css name": ({"hous__css": ""}, "Nothing asks for 'hous.css' (did you mean 'house.css'?)"),
    "css fetches": (
        {"house__css": "\np {background: url(http://x/y.png)}"},
        "house.css:2: url(http://x/y.png would be fetched",
    ),
    "css imports": ({"house__css": '@import "x.css";'}, "house.css:1: @import would be fetched"),
    "css ends": ({"house__css": "p {}\n</style><script>"}, "house.css:2: '</' would end the style sheet"),
    "brackets": (
        {"report__html__j2": EXTENDS + "{{ " + 3000 * "(" + "1" + 3000 * ")" + " }}"},
        "cannot be read: maximum recursion",
    ),
    "digits": ({"report__html__j2": EXTENDS + "{{ " + 5000 * "9" + " }}"}, "cannot be read: Exceeds the limit"),
    "picture": ({"mark__png": "GIF89a"}, "mark.png: The file is neither a PNG nor an SVG picture"),
}


@pytest.mark.parametrize("name", FAULTS)
def test_what_is_wrong_with_the_files_is_told_before_anything_is_calculated(name: str, tmp_path: Path) -> None:
    files, words = FAULTS[name]
    with pytest.raises(UserError) as error:
        house_style(written(tmp_path, **files))
    assert words in str(error.value)


def test_what_is_no_folder_or_no_text_is_told(tmp_path: Path) -> None:
    with pytest.raises(UserError, match="This is not a folder"):
        house_style(tmp_path / "none")
    (tmp_path / "report.html.j2").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(UserError, match="is not UTF-8"):
        house_style(tmp_path)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("{{ doc.projekt }}", "has no attribute 'projekt'"),
        ("{{ 1 / 0 }}", "division by zero"),
        ("{{ ''.__class__.__mro__ }}", "access to attribute '__class__'"),
        ("{{ doc.chapters.append(1) }}", "access to attribute 'append' of 'list' object is unsafe"),
        ("{{ doc.project.update({'title': 'x'}) }}", "access to attribute 'update' of 'dict' object is unsafe"),
        ("{{ page.x }}", "'page' is undefined"),
        ("{{ math.display.__func__.__globals__ }}", "unsafe"),
        ("{{ '{0.__class__}'.format(doc) }}", "unsafe"),
        ("{% for i in range(1000000000) %}{% endfor %}", "Range too big"),
        ("{% include '/etc/passwd' %}", "'/etc/passwd' is not a template"),
        ("{% include '../pyproject.toml' %}", "'../pyproject.toml' is not a template"),
        ("{{ picture('mark.png') }}", "'mark.png' is not a picture of the folder"),
    ],
)
def test_what_goes_wrong_in_a_template_is_told_with_its_line(
    brief: Data, tmp_path: Path, text: str, words: str
) -> None:
    house = house_style(written(tmp_path, report__html__j2=closing(text)))
    with pytest.raises(UserError) as error:
        page(Material(typed(brief), house=house))
    assert str(error.value).startswith(f"{tmp_path / 'report.html.j2'}:3: ") and words in str(error.value)
    assert brief["project"]["title"] == "Sample press"


@pytest.mark.parametrize("name", ["report.html.j2", "_other.html.j2", "house.css", "mark.png"])
def test_a_link_out_of_the_folder_is_refused_and_one_within_is_not(tmp_path: Path, name: str) -> None:
    (tmp_path / "house").mkdir()
    (tmp_path / "house" / "house.css").write_text("h1 {}", "utf-8")
    (tmp_path / "house" / "_a.html.j2").symlink_to("house.css")
    assert house_style(tmp_path / "house").templates == {"_a.html.j2": "h1 {}"}
    (tmp_path / "house" / name).unlink(missing_ok=True)
    (tmp_path / "secret").write_text("password", "utf-8")
    (tmp_path / "house" / name).symlink_to("../secret")
    with pytest.raises(UserError, match=f"{re.escape(name)}: This is a link out of the folder"):
        house_style(tmp_path / "house")


def test_a_link_to_itself_is_told_in_words(tmp_path: Path) -> None:
    (tmp_path / "house.css").symlink_to("house.css")
    with pytest.raises(UserError, match=r"house\.css: The file cannot be read: Too many levels of symbolic links"):
        house_style(tmp_path)
    (tmp_path / "plugins").symlink_to("plugins")
    with pytest.raises(UserError, match="There is no such folder of plugins"):
        assert Discovery([tmp_path / "plugins"]).origins


def test_loops_within_too_many_loops_are_told(brief: Data, tmp_path: Path) -> None:
    loops = "".join(f"{{% for i{number} in [1] %}}" for number in range(30)) + "{% endfor %}" * 30
    house = house_style(written(tmp_path, report__html__j2=closing(loops)))
    with pytest.raises(UserError, match="cannot be filled: too many statically nested blocks"):
        page(Material(typed(brief), house=house))


@pytest.mark.parametrize(
    "place", ['<a rel="attachment" href="file:///etc/passwd">x</a>', '<p style="background: \\75rl(http://x/y)">']
)
def test_what_only_print_would_fetch_is_told(brief: Data, tmp_path: Path, place: str) -> None:
    house = house_style(written(tmp_path, report__html__j2=f"<!DOCTYPE html><title>x</title>{place}"))
    with pytest.raises(UserError, match=r"(etc/passwd|x/y).*a report fetches nothing"):
        sheets(Material(typed(brief), house=house))


@pytest.mark.parametrize("text", ["<style>p{width:calc(1px/0)}@page{size:0 0}</style>", "<div>" * 1500])
def test_what_the_page_engine_cannot_set_is_told(brief: Data, tmp_path: Path, text: str) -> None:
    house = house_style(written(tmp_path, report__html__j2=closing(text)))
    with pytest.raises(UserError, match="The sheets cannot be set with these templates"):
        sheets(Material(typed(brief), house=house))


@pytest.mark.parametrize("letter", ["\0", "\x1b", "\ud800", "\uffff"])
def test_letters_that_no_page_can_hold_are_refused(letter: str) -> None:
    with pytest.raises(UserError, match=f"A template writes U\\+{ord(letter):04X}"):
        refuse_fetching(f"{HEAD}a{letter}b", "house", OBEYED, "report.html.j2")


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ('<img src="http://example.com/x.png" alt="">', "<img> http://example.com/x.png would be fetched"),
        ('<link rel="stylesheet" href="x.css">', "<link> x.css would be fetched"),
        ('<p style="background: url(//x)">', "url(//x would be fetched"),
        ("<style>@import 'x';</style>", "@import would be fetched"),
        ('<iframe src="file:///etc/passwd"></iframe>', "<iframe> file:///etc/passwd would be fetched"),
        ('<meta http-equiv="refresh" content="0; url=http://x">', "<meta> refresh would be fetched"),
        ('<img srcset="//x 2x" alt="">', "<img> //x 2x would be fetched"),
        ("<form action=x>", "<form> x would be fetched"),
        ("<button formaction=x>", "<button> x would be fetched"),
        ('<svg><image href="x"/></svg>', "<image> x would be fetched"),
        ('<svg><use xlink:href="x#a"/></svg>', "<use> x#a would be fetched"),
        ('<svg><a><set attributeName="href" to="javascript:x"/></a></svg>', "<set> would be fetched"),
        ('<a href=" java\nscript:alert(1)">x</a>', "would be fetched"),
        ('<p onclick="x">', "<p onclick> would be fetched"),
        ('<svg><rect fill="\\75rl(//x)"/></svg>', "url(//x would be fetched"),
        ("<style>@\\69mport 'x';</style>", "@import would be fetched"),
        ("<style>p{background:\\75rl(//x)}</style>", "url(//x would be fetched"),
        ("<style>p{background:image-set('//x' 1x)}</style>", "image-set(//x would be fetched"),
        ("<style>p{background:u/**/rl(//x) url( '//y' )}</style>", "url(//y would be fetched"),
        ("<style>@font-face{src:url(//x)}</style>", "url(//x would be fetched"),
        ("<svg><style>@import 'x'</style></svg>", "@import would be fetched"),
        (
            '<img srcset="data:image/png;base64,AA== 1x, //x 2x" alt="">',
            "<img> data:image/png;base64,AA== 1x, //x 2x would be fetched",
        ),
        (
            '<link rel="stylesheet" href="data:text/css,@import url(//x)">',
            "<link> data:text/css,@import url(//x) would be fetched",
        ),
        ('<a rel="nofollow Attachment" href="data:,x">x</a>', "<a rel=nofollow Attachment> would be fetched"),
        ("<template shadowrootmode=open><img src=//x></template>", "<img> //x would be fetched"),
        ("<svg><foreignObject><p><img src=//x></p></foreignObject></svg>", "<img> //x would be fetched"),
        (
            "<math><annotation-xml encoding=text/html><img src=//x></annotation-xml></math>",
            "<img> //x would be fetched",
        ),
        ("<svg><title><style>@import '//x'</style></title></svg>", "@import would be fetched"),
        ("<style><title/>@import '//x'</style>", "@import would be fetched"),
        ("<math><mi xlink:href=javascript:x>", "<mi> javascript:x would be fetched"),
        ("<style>p{--x:url(//x)}</style>", "url(//x would be fetched"),
        ("<style>p{content:src('//x')}</style>", "src(//x would be fetched"),
        ("<style>@namespace url(//x);</style>", "url(//x would be fetched"),
        ("<style>@media print{@\\69 mport '//x';p{cursor:URL(//x)}}</style>", "url(//x would be fetched"),
        ("<input type=image src=//x>", "<input> //x would be fetched"),
        ("<body background=//x>", "<body> //x would be fetched"),
        ("<a ping=//x href='#x'>", "<a> //x would be fetched"),
        ("<script>x</script>", "<script> would be fetched"),
        ("<noscript><img src=//x></noscript>", "<noscript> would be fetched"),
        ("<style>p{x:" + 20_000 * "(" + "url(//x", "url(//x would be fetched"),
        ('<meta http-equiv="Content-Security-Policy" content="">', "has lost its Content-Security-Policy"),
    ],
)
def test_a_page_that_fetches_is_refused(text: str, words: str) -> None:
    with pytest.raises(UserError) as error:
        refuse_fetching(f"{HEAD}{text}", "house", OBEYED, "report.html.j2")
    assert words in str(error.value)


OUTSIDE = '<meta http-equiv="refresh" content="0;url=//x">'


@pytest.mark.parametrize(
    "text",
    [
        f"<select><svg><select><![CDATA[><textarea>]]>{OUTSIDE}</textarea></select>",  # what each browser reads in its own way
        f"<select><math><select><![CDATA[><textarea>]]>{OUTSIDE}</textarea></select>",
        f'<select><svg><select><style><a title="</style><textarea>">{OUTSIDE}</textarea></select>',
        f"<select><option><svg><select><![CDATA[><!--]]>{OUTSIDE}--></option></select>",
        f"<datalist><select><math><option><![CDATA[><!--]]>{OUTSIDE}--></select></datalist>",
        f"<select>{OUTSIDE}</select>", f"<select><option value='>{OUTSIDE}'>x</option></select>", f'<select title="<svg>{OUTSIDE}"></select>',
        f"<template><col><textarea></template>{OUTSIDE}</textarea>", f"<template><col><style></template>{OUTSIDE}</style>",
        f'<svg></p><style><a title="</style>{OUTSIDE}"></style>', f'<math></p><style><a title="</style>{OUTSIDE}"></style>',
        f'<svg></br><textarea><a title="</textarea>{OUTSIDE}">', f"<!-- {OUTSIDE} -->", f"<title>{OUTSIDE}</title>", f"<xmp>{OUTSIDE}</xmp>",
        f"<x}}meta><!-- {OUTSIDE} --></x}}meta>", f"<svg><meta}}></svg><x:meta></x:meta><!-- {OUTSIDE} -->",
        "<!--<IFRAME\nsrc=x>-->", "<p title='<form/x>'>", "<textarea><script></textarea>", "<p title='<template>'>", 50_000 * "<!--<base -->",
    ],
)  # fmt: skip
def test_no_text_holds_what_a_browser_may_take_for_an_element(text: str) -> None:
    """No parser reads every page as every browser does."""
    with pytest.raises(UserError, match=r"<\w+ stands in a text|would be fetched"):
        refuse_fetching(f"{HEAD}{text}", "house", OBEYED, "report.html.j2")


@pytest.mark.parametrize(
    "text",
    [
        '<select id="a"><option value="">x</option><option>&lt;meta&gt;</option></select>', "<p title='&lt;meta'>&lt;script&gt;</p>",
        "<metadata></metadata>", "<x-form></x-form>", "<p>a<meta-b</p>", "<linearGradient/>", "<p>1 < meta</p>", "<form></form>",
    ],
)  # fmt: skip
def test_what_no_browser_takes_for_an_element_is_taken(text: str) -> None:
    refuse_fetching(f"{HEAD}{text}", "house", OBEYED, "report.html.j2")


@pytest.mark.parametrize(
    "head",
    [
        f"<textarea>{HEAD}</textarea>", f"<body>{HEAD}", f"<title>{HEAD}</title>", f"<noscript>{HEAD}</noscript>", f"<!--{HEAD}-->",
        f"<template>{HEAD}</template>", f"<p>x</p>{HEAD}", f"<style>p{{}}</style>{HEAD}", f"<template></template>{HEAD}",
        META, f"<meta charset=gbk>{META}", f"<meta name=x>{META}", f"{META}{CHARSET}", f"{HEAD}{META}",
        HEAD.replace(OBEYED, OBEYED + " 'unsafe-inline'"), HEAD.replace(OBEYED, OBEYED + "; connect-src *"), HEAD.replace(OBEYED, OBEYED[:-9]),
    ],
)  # fmt: skip
def test_a_policy_that_browsers_do_not_obey_is_lost(head: str) -> None:
    with pytest.raises(UserError, match="has lost its Content-Security-Policy"):
        refuse_fetching(f"<!DOCTYPE html>{head}", "house", OBEYED, "report.html.j2")


def test_pages_are_judged_whatever_their_medium(brief: Data, tmp_path: Path) -> None:
    text = '<img src="http://example.com/x.png" alt="">'
    material = Material(typed(brief), house=house_style(written(tmp_path, report__html__j2=closing(text))))
    for kind, medium in (("screen", Screen(material)), ("print", Paper(material))):
        with pytest.raises(UserError, match=r"<img> http://example\.com/x\.png would be fetched"):
            filled(material, medium, kind)


def test_what_lies_in_the_page_and_links_are_not_fetched() -> None:
    text = '<a href="https://example.com">x</a><img src="data:image/png;base64,AA=="><use xlink:href="#a"/><p style="fill: url(#b)">'
    refuse_fetching(f"{HEAD}{text}", "house", OBEYED, "report.html.j2")


def test_a_fault_of_the_program_itself_stays_one(brief: Data, tmp_path: Path) -> None:
    house = house_style(written(tmp_path, report__html__j2=closing("x")))
    results = typed(brief)
    broken = results.mechanisms["cylinder"].with_(outputs=None)
    with pytest.raises(AttributeError, match="NoneType"):
        page(Material(results.with_(mechanisms={"cylinder": broken}), house=house))


def test_the_command_refuses_before_it_calculates(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "house").mkdir()
    house = written(tmp_path / "house", report__html__j2=EXTENDS + "{% block x %}{% endblock %}")
    arguments = ["report", str(saved(tmp_path, SMALL)), "-o", str(tmp_path / "out"), "--format", "html", "--quiet"]
    assert main([*arguments, "--template", str(house)]) == 2
    assert "report.html.j2:2: 'x' is not a block" in capfd.readouterr().err and not (tmp_path / "out").exists()


@pytest.mark.nightly
def test_pages_set_with_the_same_templates_are_verified(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "house").mkdir()
    house = written(tmp_path / "house", report__html__j2=closing("<p>Ours</p>"))
    arguments = [str(saved(tmp_path, SMALL)), "-o", str(tmp_path / "out"), "--format", "html", "--quiet"]
    assert main(["report", *arguments, "--template", str(house)]) == 0
    page = tmp_path / "out" / "press.html"
    assert "<p>Ours</p>" in page.read_text("utf-8")
    assert main(["verify", str(page), "--quiet", "--template", str(house)]) == 0
    assert "byte for byte" in capfd.readouterr().out


def test_pages_set_with_other_templates_are_not_compared() -> None:
    carried: Any = SimpleNamespace(results=typed({"report": {"template_sha256": "ab" * 32}}))
    own = ("not compared, since they are set with templates of their own (SHA-256 abababababab); "
           "--template DIR names the templates")  # fmt: skip
    assert other_templates(carried, HouseStyle("other")) == other_templates(carried, None) == own
    carried.results = typed({})
    assert "the program's templates alone" in other_templates(carried, HouseStyle("other"))
    assert other_templates(carried, None) == ""


PLAIN = (str, int, float, bytes, type(None))
CALLED = {
    "Screen.display", "Screen.beside", "Screen.fits_beside", "Screen.has_room_beside", "Screen.figure",
    "Paper.display", "Paper.beside", "Paper.fits_beside", "Paper.has_room_beside",
    "Paper.figure", "Material.failed", "Material.are_abreast", "HouseStyle._picture", "CheckRow.repeats", "PrintedChapter.count",
    "ValueRow.named_formula", "make_cycler", "Cycler", "Joiner", "Namespace", "safe_range",
}  # fmt: skip
"""All that a template may call, but for its own macros and methods of texts and containers."""


def reached(value: Any, path: str, seen: set[int]) -> Iterator[tuple[str, Any]]:
    """Yield what a template reaches from a value, with the path to it."""
    yield path, value
    if isinstance(value, PLAIN) or id(value) in seen or path.endswith(".packed.packed"):  # which gives one like itself
        return
    seen.add(id(value))
    if isinstance(value, Mapping):
        for key, each in value.items():
            yield from reached(each, f"{path}[{key!r}]", seen)
    elif is_dataclass(value) or isinstance(value, Record) or hasattr(type(value), "_fields"):
        for name in names_of(value):
            if name != "outcome" or value.result:  # which tables and notes have not
                yield from reached(getattr(value, name), f"{path}.{name}", seen)
    if isinstance(value, (list, tuple, set, frozenset)):
        for index, each in enumerate(value):
            yield from reached(each, f"{path}[{index}]", seen)


def names_of(value: Any) -> list[str]:
    """The public fields and properties of a data class, or of a part of the results."""
    if isinstance(value, Record):
        return [*type(value).model_fields, *(name for name in dir(type(value)) if _is_own(type(value), name))]
    declared = [each.name for each in fields(value)] if is_dataclass(value) else list(value._fields)
    made = [name for name in dir(type(value)) if isinstance(getattr(type(value), name), property | cached_property)]
    return [name for name in {*declared, *made} if not name.startswith("_")]


def _is_own(kind: type[Record], name: str) -> bool:
    """Whether a part of the results declares a name, and what makes such parts does not."""
    is_made = isinstance(getattr(kind, name, None), property | cached_property)
    return not name.startswith("_") and not hasattr(Record, name) and is_made


def is_plain(value: Any) -> bool:
    """Whether a value is data: a text, a number, a container, a data class, a part of the results; the report's words are a mapping of texts."""
    is_record = (is_dataclass(value) or isinstance(value, Record)) and not isinstance(value, type)
    return is_record or isinstance(value, (*PLAIN, list, tuple, set, frozenset, Mapping, Catalogue))


@pytest.mark.parametrize("medium", [Screen, Paper])
def test_all_that_a_template_reaches_is_plain_data_or_a_listed_function(plain: Data, medium: Any) -> None:
    house = HouseStyle("house")
    material = Material(typed(plain), house=house)
    given = template_variables(material, medium(material), "print", "", "")
    environment = house.environment(folder(), FILTERS, template_functions(given))
    count = 0
    for path, value in reached(given | environment.globals, "", set()):
        count += 1
        assert is_plain(value) or value.__qualname__ in CALLED, path
    assert count > 2000  # the report itself
    assert {each.__qualname__ for each in environment.allowed} <= CALLED


def test_filters_and_tests_are_those_of_jinja_and_of_the_report() -> None:
    environment = HouseStyle("house").environment(folder(), FILTERS, [])
    assert environment.filters == defaults.DEFAULT_FILTERS | FILTERS | {"round": firm_templates._rounded}
    assert environment.tests == defaults.DEFAULT_TESTS
    for each in FILTERS.values():
        assert isinstance(getattr(each, "func", each), FunctionType) and not isinstance(each, MethodType)


WAYS_OUT = [
    # what the report's own objects hold
    '{{ math.material.house.environment("/", {}) }}',
    '{{ math.material }}',
    '{{ math.display.__self__.material }}',
    "{{ figure.__self__ }}",
    "{{ figure['__self__'] }}",
    "{{ abreast.__func__.__globals__ }}",
    '{{ failed|attr("__self__") }}',
    '{{ [figure]|map(attribute="__self__")|first }}',
    '{{ [math]|map(attribute="display.__self__.material.house")|list }}',
    '{{ ([math.display]|groupby("__self__"))[0][0].material }}',
    '{{ [doc]|sum(attribute="__class__") }}',
    "{{ doc.words._own }}",
    "{{ doc.words._texts }}",
    "{{ doc.__dataclass_fields__ }}",
    "{{ doc['__class__'] }}",
    # what pydantic puts into each part of the results
    "{{ doc.press.model_dump() }}",
    "{{ doc.press.model_config }}",
    "{{ doc.press.model_fields_set }}",
    "{{ doc.press.model_extra }}",
    "{{ doc.press.model_construct }}",
    "{{ doc.press['with_'] }}",
    "{{ doc.press|attr('data') }}",
    # Jinja's own
    "{{ cycler.__init__.__globals__.os.popen('id').read() }}",
    "{{ cycler('a').__init__.__globals__ }}",
    "{{ joiner.__init__ }}",
    "{{ namespace.__init__.__globals__ }}",
    "{{ namespace(x=cycler).x.__mro__ }}",
    "{{ lipsum.__globals__ }}",
    "{{ dict.mro() }}",
    "{{ self._TemplateReference__context }}",
    "{{ self.closing.__globals__ }}",
    "{{ super._context }}",
    "{% macro x() %}{% endmacro %}{{ x._func }}",
    "{% macro x() %}{% endmacro %}{{ x._environment }}",
    "{% macro x() %}{{ caller._environment }}{% endmacro %}{% call x() %}{% endcall %}",
    "{% for x in [1] %}{{ loop._iterable }}{% endfor %}",
    "{% import 'macros.html.j2' as m %}{{ m._body_stream }}",
    "{% import 'macros.html.j2' as m %}{{ m.__init__.__globals__ }}",
    # Python's
    "{{ ''.__class__.__mro__ }}",
    "{{ 'x'.format(1) }}",
    "{{ '{0.__class__}'.format_map({}) }}",
    "{{ ('{0.__class__}'|safe).format(doc) }}",
    "{{ (1).to_bytes(2, 'big') }}",
    "{{ 'x'.encode('utf-8') }}",
    "{{ ''.translate({}) }}",
    "{{ ''.maketrans('a', 'b') }}",
    "{{ {}.fromkeys([1]) }}",
    "{{ [].sort() }}",
    "{{ ({}|items).gi_frame.f_globals }}",
    "{{ ([1]|map('string')).gi_code }}",
    "{{ cycler(figure).current.__self__ }}",
    "{{ namespace(x=figure).x.__func__ }}",
    "{{ picture.__self__.templates }}",
    "{{ namespace(**{'__self__': 'x', '__name__': 'upper', '__call__': figure}).__call__ }}",
]  # fmt: skip


@pytest.fixture
def sandboxed(plain: Data) -> Data:
    """A brief report of one mechanism, which is soon made."""
    mechanisms = {"cylinder": plain["mechanisms"]["cylinder"]}
    return plain | {"mechanisms": mechanisms, "comparisons": {}, "report": {"detail": "brief"}}


def closed(results: Data, text: str) -> str:
    """The page with a template's text at its end."""
    template = '{% extends "program/report.html.j2" %}\n{% block closing %}\n' + text + "\n{% endblock %}\n"
    house = HouseStyle("house", {"report.html.j2": template})
    return drawn(typed(results), ["html"], Discovery([]), lambda _: None, house).contents["html"].decode()


@pytest.mark.parametrize("text", WAYS_OUT)
def test_a_way_out_of_the_sandbox_is_closed(sandboxed: Data, text: str) -> None:
    with pytest.raises(
        UserError, match=r"unsafe|not safely callable|has no attribute|is undefined|no blocks? named|no parent block"
    ):
        closed(sandboxed, text)


ENDLESS = [
    # whole numbers, which Python reckons without looking up
    ("{{ 2 ** 100000000 }}", "a whole number of too many digits"),
    ("{{ 1 if (9 ** 9) ** (9 ** 9) }}", "a whole number of too many digits"),
    ("{% set n = namespace(x=3) %}{% for i in range(40) %}{% set n.x = n.x * n.x %}{% endfor %}", "a whole number of too many digits"),
    ("{% set x = ('f' * 100000)|int(base=16) %}{{ x // 3 }}", "a whole number of too many digits"),
    ("{{ 1.5|round(1000000000, 'ceil') }}", "a number is rounded to too many decimals"),
    ("{{ 1|round(-1000000000) }}", "a number is rounded to too many decimals"),
    # memory
    ("{{ 'a' * 10 ** 12 }}", "MemoryError"),
    ("{{ [1]|batch(10 ** 12, 0)|list }}", "MemoryError"),
    ("{% set n = namespace(x='aaaa') %}{% for i in range(60) %}{% set n.x = n.x ~ n.x %}{% endfor %}", "MemoryError|was not finished within 2 s"),
    # loops
    ("{% for i in range(99999) %}{% for j in range(99999) %}{% endfor %}{% endfor %}", "was not finished within 2 s and was aborted"),
    ("{% include 'report.html.j2' %}", "was not finished within 2 s and was aborted|maximum recursion"),
    ("{% macro m() %}{{ m() }}{% endmacro %}{{ m() }}", "maximum recursion"),
    ("{{ self.closing() }}", "maximum recursion"),
    # a formula of the template's own, nested so deep that the library would overrun its stack
    ("{{ math.display(namespace(latex='{' * 100000 ~ '}' * 100000)) }}", "nesting deeper than 64 levels"),
    # what goes wrong in Jinja itself
    ("{% filter attr('__class__') %}a{% endfilter %}", "cannot be filled"),
    ("{{ ('f' * 10000)|int(base=16) }}", "cannot be filled: Exceeds the limit"),
]  # fmt: skip


@pytest.mark.filterwarnings(
    "ignore::pytest.PytestUnraisableExceptionWarning"
)  # the end may come within a hook of the collector
@pytest.mark.parametrize(("text", "words"), ENDLESS)
def test_what_never_ends_or_takes_all_memory_is_told(
    sandboxed: Data, text: str, words: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(firm_templates, "SECONDS", 2.0)
    monkeypatch.setattr(firm_templates, "MEMORY", 2**28)
    before = resource.getrlimit(resource.RLIMIT_AS)
    with pytest.raises(UserError, match=words):
        closed(sandboxed, text)
    assert resource.getrlimit(resource.RLIMIT_AS) == before


def test_what_is_plain_is_read_and_called() -> None:
    sandbox = TemplateSandbox([])
    for text, shown in [
        ("{% set n = namespace(x=1) %}{% set n.x = 2 %}{{ n.x }}", "2"),
        ("{% for x in [1, 2] %}{{ loop.cycle('a', 'b') }}{{ loop.index }}{% endfor %}", "a1b2"),
        ("{{ 'a b'.split()|join('-') }}{{ {'a': 1}.get('a') }}{{ [1, 1].count(1) }}", "a-b12"),
        ("{% set c = cycler('x', 'y') %}{{ c.next() }}{{ c.next() }}", "xy"),
        ("{% macro m(a) %}{{ a }}{{ caller() }}{% endmacro %}{% call m(1) %}2{% endcall %}", "12"),
        ("{{ ('<b>'|safe).upper() }}", str(Markup("<B>"))),
        ("{{ 7.256|round(2) }}{{ 'a' * 3 }}{{ 2 ** 10 }}{{ '%03d' % 7 }}{{ 7 // 2 }}", "7.26aaa10240073"),
        ("{{ range(3)|list }}", "[0, 1, 2]"),
    ]:
        assert sandbox.from_string(text).render() == shown
