"""Firm templates reach plain data and plain functions, nothing else: by a crawl of all that they see, and by known ways out of a sandbox."""

from __future__ import annotations

import resource
from collections.abc import Iterator, Mapping
from dataclasses import fields, is_dataclass
from functools import cached_property
from types import FunctionType, MethodType
from typing import Any

import pytest
from jinja2 import defaults
from markupsafe import Markup

from diecut_report.config.plugins import Discovery
from diecut_report.errors import UserError
from diecut_report.press import drawn
from diecut_report.report.context import Material
from diecut_report.report.pages import firm_templates
from diecut_report.report.pages.firm_templates import HouseStyle, TemplateSandbox
from diecut_report.report.pages.html import FILTERS, Screen, folder, template_functions, template_variables
from diecut_report.report.pages.pdf import Paper
from diecut_report.report.text import Catalogue
from diecut_report.results.record import Record
from tests.report.made_results import typed

Data = dict[str, Any]
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
def brief(plain: Data) -> Data:
    """A brief report of one mechanism, which is soon made."""
    mechanisms = {"cylinder": plain["mechanisms"]["cylinder"]}
    return plain | {"mechanisms": mechanisms, "comparisons": {}, "report": {"detail": "brief"}}


def closed(results: Data, text: str) -> str:
    """The page with a template's text at its end."""
    template = '{% extends "program/report.html.j2" %}\n{% block closing %}\n' + text + "\n{% endblock %}\n"
    house = HouseStyle("house", {"report.html.j2": template})
    return drawn(typed(results), ["html"], Discovery([]), lambda _: None, house).contents["html"].decode()


@pytest.mark.parametrize("text", WAYS_OUT)
def test_a_way_out_of_the_sandbox_is_closed(brief: Data, text: str) -> None:
    with pytest.raises(
        UserError, match=r"unsafe|not safely callable|has no attribute|is undefined|no blocks? named|no parent block"
    ):
        closed(brief, text)


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
    brief: Data, text: str, words: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(firm_templates, "SECONDS", 2.0)
    monkeypatch.setattr(firm_templates, "MEMORY", 2**28)
    before = resource.getrlimit(resource.RLIMIT_AS)
    with pytest.raises(UserError, match=words):
        closed(brief, text)
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
