"""What the program writes out as a config is read back as the very same numbers."""

from __future__ import annotations

import codecs
import difflib
import hashlib
import json
import math
from pathlib import Path
from typing import Any

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from diecut_report.config import yaml
from diecut_report.config.plugins import Discovery
from diecut_report.config.references import as_file, rewritten
from diecut_report.config.yaml import KeyPath, load, parse
from diecut_report.errors import UserError
from diecut_report.press import Press
from diecut_report.quantities import units
from diecut_report.quantities.formatting import as_given, as_typed
from diecut_report.quantities.units import unit
from diecut_report.results.model import ResultsRecord
from tests.configs import EXAMPLE, EXAMPLES, PLUGINS, saved
from tests.examples import few

TABLE: dict[str, Any] = json.loads(units.TABLE_FILE.read_text(encoding="utf-8"))
RARE = ("ppm", "mm/m", "ft/m", "permille", "min/h", "°", "N*s/m", "kg*m**2/s**3", "mile/hour")  # read by pint
IDLE = next(path for path in EXAMPLES if path.stem == "elastic_transport")  # motion_curve takes the place of a default
SHARES = Discovery([PLUGINS / "shares"])
numbers = st.floats(min_value=-1e250, max_value=1e250, allow_subnormal=False)


SOME = {*list(TABLE["units"])[::4], *RARE[::2]}  # what a unit does to a value is one factor and one offset


@pytest.mark.parametrize("name", few([*TABLE["units"], *RARE], keep=lambda name: name in SOME))
@settings(max_examples=6)
@given(value=numbers)
@example(value=0.07)
@example(value=1.0)
@example(value=0.08333333333333333)
@example(value=0.1 + 0.2)
@example(value=4.616304968611814e16)  # its shortest text is half-way to the next float
@example(value=-1e-300)
def test_a_value_of_any_unit_is_read_back_as_the_same_float(name: str, value: float) -> None:
    for typed in (as_given(value, name), as_typed(value, name)):
        read = yaml.parse(json.dumps({"key": typed}), "test").data["key"]
        found = units.parse_quantity(read, name)
        assert found.hex() == value.hex()


def test_a_value_with_a_dimension_stands_in_si_whatever_the_keys_unit() -> None:
    assert [n for n in TABLE["units"] if unit(n).si != "1" and as_given(0.1, n) != f"0.1 {unit(n).si}"] == []


def test_pure_numbers_stand_in_the_keys_own_unit() -> None:
    assert as_given(0.125, "1") == 0.125
    assert as_given(0.125, "%") == "12.5 %"
    assert as_given(1.0, "%") == "100 %"
    assert as_given(0.1 + 0.2, "%") == "30.000000000000004 %"


@pytest.mark.parametrize(
    ("value", "name", "text"),
    [(0.0553, "mm", "55.3 mm"), (2 * math.pi / 60 * 43.5, "rpm", "43.5 rpm"), (0.125, "%", "12.5 %"),
     (6000 / 3600, "1/h", "6000 1/h"), (1 / 3, "m", "0.3333333333333333 m"), (3.0, "1", 3.0)],
)  # fmt: skip
def test_a_value_is_written_as_a_designer_types_it(value: float, name: str, text: str | float) -> None:
    assert as_typed(value, name) == text


@pytest.mark.parametrize(
    "text", ["1e5 kN", "12.5", "0.1 %", "7.3 um", "1e-400 mm", "0e99999999999999999999 mm", "-.5e-3 rad"]
)
def test_a_text_means_its_decimal_number_rounded_once(text: str) -> None:
    number, _, own = text.partition(" ")
    factor = {"kN": 1e3, "%": 1e-2, "um": 1e-6, "mm": 1e-3}.get(own, 1.0)
    assert units.parse_quantity(text, own or "1") == pytest.approx(float(number) * factor, rel=1e-15)


def test_numbers_that_no_float_holds_are_refused_in_words() -> None:
    for text in ("1e400 kN", "1e99999999999999999999 kN", "-1e308 t"):
        with pytest.raises(units.UnitError, match=r"not a finite number|too large"):
            units.parse_quantity(text, unit(text.split()[1]).text)


def calculated(path: Path) -> ResultsRecord:
    return Press.read(path, SHARES).calculate().results


def numbers_of(results: ResultsRecord) -> dict[str, Any]:
    return {name: (data.outputs, data.checks, data.curves) for name, data in results.mechanisms.items()}


SHARED = """\
schema_version: 1
project: {title: Shares}
press: {name: P}
mechanisms:
  a: {kind: shares, share: 7, angle: 30, profile: [1, 2 %, 3.5, 4]}
  b: {kind: shares, share: 0.123456789012345678 %, count: 7, slope: 3 mm/m, profile: '${a.profile}'}
  c: {kind: shares, profile: ['${b.share}', '${a.ratio}', 2, 7 %]}
"""


@pytest.mark.parametrize(
    "text", [SHARED, pytest.param(IDLE.read_text("utf-8"), marks=pytest.mark.nightly)], ids=["shares", "idle default"]
)
def test_the_resolved_config_calculates_to_the_same_results(tmp_path: Path, text: str) -> None:
    first = calculated(saved(tmp_path, text))
    again = calculated(saved(tmp_path, json.dumps(first.config.resolved), "again.yaml"))
    assert numbers_of(again) == numbers_of(first)
    assert again.config.resolved == first.config.resolved
    assert again.press == first.press


# Values written into a configuration's text: what else stands in the file stays, byte for byte.


TEXT = """\
# a press
plain: 70 mm # paper
block: {value: "0.5 mm", basis: assumed, note: "one, two"}   # guessed
anchored: &bore 40 mm
again: *bore
parts:
  - {name: first, size: 3}
  - name: second  # the other

    size: 4
shared: &all {x: 1}
copy: *all
formula: 2 * ${parts.0.size}
ж: 'Ж'
last: 1"""


@pytest.mark.parametrize(
    ("path", "value", "old", "new"),
    [
        (("plain",), "60 mm", "plain: 70 mm #", "plain: 60 mm #"),
        (("block", "value"), "0.7 mm", '{value: "0.5 mm",', "{value: 0.7 mm,"),
        (("parts", 0, "size"), "5", "size: 3}", "size: 5}"),
        (("parts", 1, "size"), "5", "size: 4", "size: 5"),
        (("last",), "2.5 kN", "last: 1", "last: 2.5 kN"),
        (("parts", 0, "new"), "7", "{name: first,", "{name: first, new: 7,"),
        (("parts", 1, "new"), "7", "# the other\n", "# the other\n    new: 7\n"),
        (("new",), "true", "# paper\n", "# paper\nnew: true\n"),
    ],
)
@pytest.mark.parametrize("line_end", ["\n", "\r\n"])
def test_one_value_changes_and_nothing_else(path: KeyPath, value: str, old: str, new: str, line_end: str) -> None:
    text = TEXT.replace("\n", line_end)
    assert text.count(old := old.replace("\n", line_end)) == 1
    assert rewritten(parse(text, "f"), {path: value}).text == text.replace(old, new.replace("\n", line_end))


def test_several_values_at_once() -> None:
    made = rewritten(parse(TEXT, "f"), {("plain",): "1 mm", ("last",): "22", ("parts", 1, "size"): "333"}).text
    assert parse(made, "f").data == parse(TEXT, "f").data | {
        "plain": "1 mm",
        "last": 22,
        "parts": [{"name": "first", "size": 3}, {"name": "second", "size": 333}],
    }


@pytest.mark.parametrize(
    ("path", "words"),
    [
        (("formula",), "f:13:10: formula: holds ${…}, a reference or an expression"),
        (("copy", "x"), "copy.x: stands in a part that an anchor"),
        (("anchored",), "anchored: stands in a part that an anchor"),
        (("absent", "x"), "absent.x: cannot be put into the file, as the block"),
    ],
)
def test_what_cannot_be_written_is_refused_in_words(path: KeyPath, words: str) -> None:
    with pytest.raises(UserError) as error:
        rewritten(parse(TEXT, "f"), {path: "9"})
    assert words in str(error.value)


def test_of_several_values_that_one_is_named_which_cannot_be_written() -> None:
    with pytest.raises(UserError) as error:
        rewritten(parse(TEXT, "f"), {("plain",): "1 mm", ("anchored",): "9", ("last",): "2"})
    assert str(error.value).startswith("f:4:11: anchored: stands in a part that an anchor")


def test_the_published_press_differs_in_one_line_alone() -> None:
    tree = load(EXAMPLE)
    made = rewritten(tree, {("mechanisms", "drive", "crank_length", "value"): "110 mm"}).text
    changed = [line for line in difflib.ndiff(tree.text.splitlines(), made.splitlines()) if line[0] in "+-"]
    assert [line.split(":", 1)[1].strip() for line in changed] == [
        "{value: 100 mm, basis: assumed}",
        "{value: 110 mm, basis: assumed}",
    ]


def test_a_byte_order_mark_is_kept(tmp_path: Path) -> None:
    file = tmp_path / "a.yaml"
    file.write_bytes(codecs.BOM_UTF8 + b"a: 1\r\n")
    tree = load(file)
    assert as_file(tree, rewritten(tree, {("a",): "2"}).text) == codecs.BOM_UTF8 + b"a: 2\r\n"
    assert hashlib.sha256(as_file(tree, tree.text)).hexdigest() == tree.sha256
