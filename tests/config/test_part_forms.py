"""What ``new shafts`` shows: every key that the parts of a machine take, as it may be typed."""

from __future__ import annotations

import re

import pytest

from diecut_report.cli.main import main
from diecut_report.config.part_forms import GO_ON_TO, part_forms
from diecut_report.config.parts.keys import WORDS, MachineKeys
from diecut_report.config.parts.reading import BODY, MODELS, PAIRS
from diecut_report.config.validation import keys_of
from diecut_report.mechanism.inputs import Block, Quantity
from tests.config.parts.machines import CORRECTED, machine


def keys(model: type[Block]) -> set[str]:
    """The keys of a block and of those within it."""
    found = set[str]()
    for name, known in keys_of(model).items():
        found |= {name} | (keys(known.block) if known.block else set())
    return found


@pytest.mark.parametrize("word", WORDS)
def test_every_key_of_a_block_is_shown(word: str) -> None:
    model = MODELS.get(word, MachineKeys)
    pairs = {PAIRS[model].key} if model in PAIRS else set()
    shown = set(re.findall(r"^[ #-]*(\w+):", part_forms([word]), re.MULTILINE)) - {word, "NAME"}
    assert shown == keys(model) | pairs | ({*BODY} if word == "shafts" else set())


def test_a_key_is_shown_with_what_its_declaration_says() -> None:
    text = part_forms(["meshes"])
    known = keys_of(MODELS["meshes"])["efficiency"]
    assert isinstance(known.meta, Quantity)
    (line,) = [each for each in text.splitlines() if " efficiency:" in each]
    assert {f"{known.default}", known.meta.symbol, known.meta.description} <= set(
        re.split(r"[#;:] ?| {2,}", line.replace("efficiency: ", ""))
    )
    assert re.search(r"# width: … mm +# b: Common face width; > 0.mm; required", text)


def test_what_goes_on_goes_on_to_the_kinds_that_are_named() -> None:
    parts = machine(text=CORRECTED).config.parts
    assert parts is not None
    made = machine(text=CORRECTED).made
    for name, place in parts.calculations.items():
        assert made[name]["kind"] in {*GO_ON_TO[place.split(".")[0]], "shaft_body", "shaft_loads"}, name


def test_parts_and_kinds_are_not_mixed(capfd: pytest.CaptureFixture[str]) -> None:
    assert main(["new", "meshes", "clutch"]) == 2
    assert "Keys of parts are asked for (meshes)" in capfd.readouterr().err
    assert main(["new", "meshes", "belts"]) == 0
    out, _ = capfd.readouterr()
    assert out.index("meshes:") < out.index("belts:")
