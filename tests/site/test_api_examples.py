"""Each name that a plugin may import stands in the reference with an example, and each example gives what it says."""

from __future__ import annotations

import importlib.util
import sys
from pathlib import Path

import pytest

from diecut_report import api
from diecut_report.declaration.formula_checks import check_mechanism
from diecut_report.mechanism.mechanism import Mechanism
from diecut_report.quantities.units import parse_quantity
from tools.site.api_examples import ApiExample, api_examples, example_of, given_by, run

EXAMPLES = [pytest.param(each, id=each.name) for each in api_examples()]


def test_each_name_of_the_interface_has_an_example() -> None:
    assert [name for name in api.__all__ if example_of(name) is None] == []


def test_a_name_that_is_imported_and_not_used_has_no_example_by_that(tmp_path: Path) -> None:
    text = '"""Words."""\n\nfrom diecut_report.api import Root, lookup, told\n\nchapter.bore = lookup(told), "d", "mm", "Bore"\n'
    (tmp_path / "one.py").write_text(text, encoding="utf-8")
    (example,) = api_examples(tmp_path)
    assert example.shows == {"told", "lookup", "Lookup"} and example.words == "Words."


@pytest.mark.parametrize("example", EXAMPLES)
def test_an_example_gives_what_it_says(example: ApiExample) -> None:
    assert example.words.endswith("."), "begin it with a sentence of what it shows"
    results = run(example)
    if results is None:
        return
    assert [figure for each in results.mechanisms.values() for figure in each.figures if figure.error] == []
    assert example.said["GIVES"]
    for name, told in example.said["GIVES"].items():
        given = given_by(results, name)
        expected = told if isinstance(given.value, str) else parse_quantity(told, given.unit)
        assert given.value == (told if isinstance(expected, str) else pytest.approx(expected, rel=1e-3))


@pytest.mark.parametrize("example", [each for each in EXAMPLES if each.values[0].kinds])  # type: ignore[attr-defined]
def test_the_mechanisms_of_an_example_keep_the_contract(example: ApiExample) -> None:
    spec = importlib.util.spec_from_file_location(f"api_example_{example.name}", example.file)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module  # annotations are read there
    spec.loader.exec_module(module)
    for name in example.kinds.values():
        mechanism = getattr(module, name)
        assert isinstance(mechanism, Mechanism)
        check_mechanism(mechanism)
