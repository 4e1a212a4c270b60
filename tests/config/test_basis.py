"""What a value rests on: quantities as blocks, and the weakest basis of all that a reference is calculated from."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from diecut_report.config.validation import BASES, weakest
from diecut_report.results.model import ResultsRecord
from tests.config.test_references import results
from tests.configs import HEAD, LEVER, problems

CHAIN = HEAD.replace("6000 1/h", "{value: 6000 1/h, basis: assumed, note: from the customer}") + (
    "  a: {kind: lever, force: {value: 2 kN, basis: measured}, arm: {value: 100, basis: catalogue}}\n"
    "  b: {kind: lever, force: '${a.force}', arm: '${a.moment} / ${a.force}', "
    "width: {value: '2 * ${press.sheet.length}', basis: drawing, note: sheet 3}, parts: [{length: {value: 3 mm, basis: assumed}}]}\n"
    "  c: {kind: lever, force: 1, width: '${b.parts.0.length}', allowable_moment: '${b.moment}', load: [1, 2, 3, '${b.moment}']}\n"
)


@pytest.fixture(scope="module")
def chain(tmp_path_factory: pytest.TempPathFactory) -> ResultsRecord:
    return results(tmp_path_factory.mktemp("basis"), CHAIN)


@pytest.mark.parametrize(
    ("path", "basis"),
    [
        ("a.force", "measured"),
        ("b.force", "measured"),  # as what it refers to
        ("b.arm", "catalogue"),  # a.moment is of a.force (measured) and a.arm (catalogue)
        ("b.width", "given"),  # the sheet's length is no more than given, whatever the drawing
        ("b.parts.0.length", "assumed"),
        ("c.width", "assumed"),
        ("c.allowable_moment", "catalogue"),  # over two mechanisms; b's parts do not matter to its moment
        ("c.load", "catalogue"),  # a list with a reference in it
        ("a.speed", "assumed"),  # a default, derived from the press
        ("a.teeth", ""),  # a default of the mechanism
        ("c.force", "given"),
    ],
)
def test_a_reference_carries_the_weakest_basis_of_what_it_is_calculated_from(
    chain: ResultsRecord, path: str, basis: str
) -> None:
    name, _, key = path.partition(".")
    assert chain.mechanisms[name].inputs[key].basis == basis


def test_the_results_keep_value_text_and_note_of_a_block(chain: ResultsRecord) -> None:
    found = chain.mechanisms["b"].inputs["width"]
    assert (found.value, found.text, found.note) == (1.4, "2 * ${press.sheet.length}", "sheet 3")
    press = chain.press.fields[0]
    assert (press.value, press.basis, press.note) == (6000 / 3600, "assumed", "from the customer")


def test_the_summary_lists_what_is_assumed_and_not_what_refers_to_it(chain: ResultsRecord) -> None:
    assert chain.summary.assumed == ["press.productivity", "mechanisms.b.parts.0.length"]


def test_assumed_is_the_weakest_of_all() -> None:
    assert weakest(BASES) == "assumed"
    assert weakest([]) == ""


WRONG = [
    ("{value: , basis: assumed}", "b.force: is a block without a value"),
    ("{value: 1 kN, basis: }", "b.force.basis: is empty; allowed: assumed"),
    ("{value: 1 kN, basis: ~}", "b.force.basis: is empty; allowed: assumed"),
    ("{value: 2 kN, basis: guessed}", "6:48: mechanisms.b.force.basis: is “guessed”; allowed: assumed, given, catalogue,"),
    ("{value: 2 kN, basis: asumed}", "is “asumed” (did you mean 'assumed'?)"),
    ("{value: 2 kN, base: assumed}", "mechanisms.b.force.base: is an unknown key"),
    ("{basis: assumed}", "6:27: mechanisms.b.force: is a block without a value; write {value: 10 kN, basis: assumed}"),
    ("{value: 2 mm, basis: assumed}", "6:35: mechanisms.b.force.value: 2 mm is a length; a force is needed"),
    ("{value: '${a.arm}', basis: assumed}", "6:35: mechanisms.b.force.value: ${a.arm} is in m; a quantity in kN is needed"),
    ("{value: '${a.force} + 3', basis: assumed}", "6:49: mechanisms.b.force.value: ${a.force} is a force and 3 is a pure"),
    ("{value: {value: 1}}", "mechanisms.b.force.value: is a block of keys; a number"),
    ("{value: 1, note: 5}", "mechanisms.b.force.note: is 5; a text is needed"),
]  # fmt: skip


@pytest.mark.parametrize(("force", "message"), WRONG, ids=[force for force, _ in WRONG])
def test_a_wrong_block_is_told_with_its_place(tmp_path: Path, force: str, message: str) -> None:
    found = problems(tmp_path, LEVER + f"  b: {{kind: lever, force: {force}}}\n")
    assert len(found) == 1 and message in found[0]


def test_the_resolved_config_rests_on_the_same(chain: ResultsRecord, tmp_path: Path) -> None:
    again = results(tmp_path, json.dumps(chain.config.resolved))
    for name, mechanism in chain.mechanisms.items():
        for key, row in mechanism.inputs.items():
            found = again.mechanisms[name].inputs[key]
            wanted = [row.basis or "given", row.note, row.value]
            assert [found.basis or "given", found.note, found.value] == wanted, key
    assert again.press == chain.press
    assert again.config.resolved == chain.config.resolved
