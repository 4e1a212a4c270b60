"""Values written into a configuration's text: what else stands in the file stays, byte for byte."""

from __future__ import annotations

import codecs
import difflib
import hashlib
from pathlib import Path

import pytest

from diecut_report.config.references import as_file, written
from diecut_report.config.yaml import KeyPath, load, parse
from diecut_report.errors import UserError
from tests.configs import EXAMPLE

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
    assert written(parse(text, "f"), {path: value}) == text.replace(old, new.replace("\n", line_end))


def test_several_values_at_once() -> None:
    made = written(parse(TEXT, "f"), {("plain",): "1 mm", ("last",): "22", ("parts", 1, "size"): "333"})
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
        written(parse(TEXT, "f"), {path: "9"})
    assert words in str(error.value)


def test_of_several_values_that_one_is_named_which_cannot_be_written() -> None:
    with pytest.raises(UserError) as error:
        written(parse(TEXT, "f"), {("plain",): "1 mm", ("anchored",): "9", ("last",): "2"})
    assert str(error.value).startswith("f:4:11: anchored: stands in a part that an anchor")


def test_the_published_press_differs_in_one_line_alone() -> None:
    tree = load(EXAMPLE)
    made = written(tree, {("mechanisms", "drive", "crank_length", "value"): "110 mm"})
    changed = [line for line in difflib.ndiff(tree.text.splitlines(), made.splitlines()) if line[0] in "+-"]
    assert [line.split(":", 1)[1].strip() for line in changed] == [
        "{value: 100 mm, basis: assumed}",
        "{value: 110 mm, basis: assumed}",
    ]


def test_a_byte_order_mark_is_kept(tmp_path: Path) -> None:
    file = tmp_path / "a.yaml"
    file.write_bytes(codecs.BOM_UTF8 + b"a: 1\r\n")
    tree = load(file)
    assert as_file(tree, written(tree, {("a",): "2"})) == codecs.BOM_UTF8 + b"a: 2\r\n"
    assert hashlib.sha256(as_file(tree, tree.text)).hexdigest() == tree.sha256
