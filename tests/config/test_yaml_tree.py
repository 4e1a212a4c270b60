"""Reading YAML with positions: what comes out, and that every bad file is refused in words at its place."""

from __future__ import annotations

import ast
import hashlib
import os
import stat
from pathlib import Path
from typing import Any

import pytest
import yaml

from diecut_report.config import yaml as yaml_tree
from diecut_report.config.yaml import MAX_BYTES, MAX_DEPTH, load, parse, printable
from diecut_report.errors import Problem, UserError

LOADERS = [yaml.SafeLoader, *([yaml.CSafeLoader] if yaml.__with_libyaml__ else [])]


@pytest.fixture(autouse=True, params=LOADERS, ids=lambda loader: str(loader.__name__))
def loader(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Each test runs on the C loader and on the pure one."""
    monkeypatch.setattr(yaml_tree, "LOADER", request.param)


def problems(text: str) -> tuple[Problem, ...]:
    with pytest.raises(UserError) as caught:
        parse(text, "press.yaml")
    return caught.value.problems


def only_problem(text: str) -> Problem:
    found = problems(text)
    assert len(found) == 1, found
    assert found[0].file == "press.yaml"
    return found[0]


def refused_file(path: Path) -> Problem:
    with pytest.raises(UserError) as caught:
        load(path)
    (problem,) = caught.value.problems
    assert problem.file == str(path)
    return problem


PRESS = """\
# a press
schema_version: 1
press: {name: DCP-700, sheet: {length: 700 mm, width: 470.7}}
mechanisms:
  cylinder:
    segment_height: 40
    gears:
      - teeth: 20
      - teeth: "30"
"""


def test_data_holds_plain_values() -> None:
    assert parse(PRESS, "press.yaml").data == {
        "schema_version": 1,
        "press": {"name": "DCP-700", "sheet": {"length": "700 mm", "width": 470.7}},
        "mechanisms": {"cylinder": {"segment_height": 40, "gears": [{"teeth": 20}, {"teeth": "30"}]}},
    }


@pytest.mark.parametrize(
    ("path", "value", "key"),
    [
        ((), (2, 1), (2, 1)),
        (("schema_version",), (2, 17), (2, 1)),
        (("press", "sheet", "width"), (3, 55), (3, 48)),
        (("mechanisms", "cylinder"), (6, 5), (5, 3)),
        (("mechanisms", "cylinder", "gears", 1), (9, 9), (9, 9)),
        (("mechanisms", "cylinder", "gears", 1, "teeth"), (9, 16), (9, 9)),
        (("mechanisms", "cylinder", "bore"), (6, 5), (6, 5)),  # what is not there stands at its nearest parent
        (("mechanisms", "cylinder", "bore", 3, "x"), (6, 5), (6, 5)),
    ],
)
def test_each_value_and_its_key_have_their_places(
    path: tuple[str | int, ...], value: tuple[int, int], key: tuple[int, int]
) -> None:
    tree = parse(PRESS, "press.yaml")
    assert (tree.position(path), tree.key_position(path)) == (value, key)


def test_columns_count_characters_not_bytes() -> None:
    assert parse("{назва: прес, рік: 5}", "press.yaml").position(("рік",)) == (1, 20)


def test_typed_is_the_text_in_the_file() -> None:
    tree = parse("a: 1e5\nb: '40'\nc: 0.070\nd: [1]\n", "press.yaml")
    assert [tree.typed((key,)) for key in "abc"] == ["1e5", "40", "0.070"]
    assert tree.typed(("d",)) is None
    assert tree.typed(("absent",)) is None
    assert tree.typed(("d", 0)) == "1"


SCALARS = {
    "40": 40, "-7": -7, "+7": 7, "010": 10, "0.6": 0.6, ".5": 0.5, "1.": 1.0, "1e5": 100000.0, "-1.5E-3": -0.0015,
    "null": None, "~": None, "": None, "true": True, "False": False, "'40'": "40", '"true"': "true", "''": "",
}  # fmt: skip
AS_THEY_STAND = (
    "yes", "on", "2026-11-21", "1:30", "0x10", "1_000", ".inf", ".nan", "1e400", "9" * 5000, "6000 1/h", "${press.name}",
)  # fmt: skip


def test_scalars_follow_the_core_schema() -> None:
    wanted = SCALARS | {text: text for text in AS_THEY_STAND}
    found = {text: parse(f"a: {text}\n", "press.yaml").data["a"] for text in wanted}
    assert found == wanted and {text: type(each) for text, each in found.items()} == {
        text: type(each) for text, each in wanted.items()
    }


def test_an_alias_repeats_the_value_and_points_to_where_it_is_written() -> None:
    tree = parse("a: &gear {teeth: 20}\nb: *gear\n", "press.yaml")
    assert tree.data == {"a": {"teeth": 20}, "b": {"teeth": 20}}
    assert tree.data["a"] is not tree.data["b"]
    assert tree.position(("b", "teeth")) == (1, 18)
    assert tree.typed(("b", "teeth")) == "20"


def test_every_duplicate_key_is_reported_with_the_line_of_the_first() -> None:
    found = problems("a: 1\nb: {c: 1, c: 2}\na: 3\na: {d: 1, d: 2}\n")
    assert [(p.line, p.column, p.path) for p in found] == [(2, 11, "b.c"), (3, 1, "a"), (4, 1, "a"), (4, 11, "a.d")]
    assert found[1].message == "The key 'a' stands here again; it is first in line 1. Remove one of the two."


NESTED = [f"a{n}: &a{n} {'[' * 30}{f'*a{n - 1}' if n else ''}{']' * 30}" for n in range(100)]
REFUSED = [  # a text, the line, the column and the key path of its only problem, and what the message holds
    ("press:\n  name: x\n\tsheet: 1\n", 3, 1, "", "A tab stands here; YAML is indented with spaces. Put spaces."),
    ("- a\n-\tb: 1\n", 2, 2, "", "A tab stands here"),
    ("a: 1\nb: 'open\n", 2, 4, "", "unexpected end of stream while scanning a quoted scalar that begins in line 2. Check quotes"),
    ("title: Drive: part one\n", 1, 13, "", "a second colon or a wrong indentation. Align keys of one block; put text that holds ': ' in quotes."),
    ("gears: {radius: ${cylinder.radius}}\n", 1, 18, "", 'YAML reads its brace as a map. Quote it: "${…}"'),
    *((text, None, None, "", "The file is empty. Write a YAML document.") for text in ("", "\n\n", "# only a remark\n", "---\n", "--- ''\n")),
    ("12: x", 1, 1, "", "The key 12 is not text. Put it in quotes, or rename it."),
    ("null: x", 1, 1, "", "The key null is not text."), ("{a: 1, true: 2}", 1, 8, "", "The key true is not text."),
    ("? [a, b]\n: 1", 1, 3, "", "The key (a list) is not text."),
    ("a: &a {x: 1}\nb:\n  <<: *a\n", 3, 3, "b", "Merge keys (<<) are not supported"),
    ("x: 1\na: !!python/object/apply:os.system [ls]\n", 2, 4, "a", "The tag !!python/object/apply:os.system is not allowed."),
    ("x: 1\na: !own {b: 1}\n", 2, 4, "a", "The tag !own is not allowed."), ("x: 1\na: ! 5\n", 2, 4, "a", "The tag ! is not allowed."),
    ("a: &a\n  b: [1, *a]\n", 2, 10, "a.b.1", "The alias *a stands in its own anchor, a loop"),
    ("a: *gear\n", 1, 4, "a", "The alias *gear has no anchor &gear above it"),
    *(("[" * n + "]" * n, 1, MAX_DEPTH + 1, "0.0.0", "The nesting is deeper than 50 levels") for n in (MAX_DEPTH + 1, 100_000)),
    ("\n".join(NESTED), 2, 39, "a1.0.0", "aliases included"),
    ("---\na: 1\n---\nb: 2\n", 3, 1, "", "A second YAML document begins here. Keep one document in a file."),
    ("a: 1\nb: x\x07\n", 2, 5, "", "U+0007"), ("PK\x03\x04\x00\x00", 1, 3, "", "This is not YAML text"),
    *((f"a: 1\n# x{mark}\n", 2, 4, "", f"U+{ord(mark):04X} stands here. Write it") for mark in "\u202a\u202e\u2069"),
]  # fmt: skip


@pytest.mark.parametrize(
    ("text", "line", "column", "path", "words"), REFUSED, ids=[repr(each[0][:20]) for each in REFUSED]
)
def test_what_is_refused_has_its_place(text: str, line: int, column: int, path: str, words: str) -> None:
    problem = only_problem(text)
    assert (problem.line, problem.column, problem.path) == (line, column, path)
    assert words in problem.message


def test_problems_found_before_a_syntax_error_are_kept() -> None:
    assert [p.line for p in problems("a: 1\na: 2\nb: @x\n")] == [2, 3]


def test_a_quoted_number_is_a_key() -> None:
    assert parse("'12': x", "press.yaml").data == {"12": "x"}


def test_an_alias_bomb_is_refused() -> None:
    lines = ["a0: &a0 [x, x, x, x, x, x, x, x, x, x]"]
    lines += [f"a{n}: &a{n} [{', '.join([f'*a{n - 1}'] * 10)}]" for n in range(1, 30)]
    problem = only_problem("\n".join(lines))
    # a0 … a4 hold 11, 111, 1 111, 11 111 and 111 111 values; the first *a4 in line 6 makes it more than 200 000
    assert problem.line == 6
    assert "More than 200000 values" in problem.message and "aliases" in problem.message


def test_nesting_up_to_the_limit_is_read() -> None:
    data = parse("[" * MAX_DEPTH + "]" * MAX_DEPTH, "press.yaml").data
    for _ in range(MAX_DEPTH - 1):
        (data,) = data
    assert data == []


# --- files -----------------------------------------------------------------------------------------------------------


INVISIBLE = [
    r"\xAD", r"\u034F", r"\u061C", r"\u200B", r"\u200E", r"\u200F", r"\u2062", r"\u2800", r"\u3164", r"\uFE0F", r"\uFEFF", r"\U000E0041",
]  # fmt: skip


@pytest.mark.parametrize("escape", INVISIBLE)
def test_a_text_holds_nothing_that_does_not_show(escape: str) -> None:
    letter = ast.literal_eval(f"'{escape}'")
    for place in ("title: a{}", "x{}: a", "unit: 5 m{}m", "note: '{}'"):
        assert "holds the invisible character U+" in problems(place.format(letter))[0].message
    assert parse(f"a: b  # {letter}\n", "press.yaml").data == {"a": "b"}
    assert printable(f"a{letter}b.yaml") == "a\N{REPLACEMENT CHARACTER}b.yaml"


@pytest.mark.parametrize(
    "escape", ["\\0", "\\a", "\\e", "\\x7f", "\\x9b", "\\N", "\\L", "\\P", "\\u202E", "\\u2066", "\\uFFFE", *INVISIBLE]
)
def test_escapes_bring_no_control_characters(escape: str) -> None:
    code = {"0": 0, "a": 7, "e": 27, "N": 0x85, "L": 0x2028, "P": 0x2029}.get(escape[1]) or int(escape[2:] or "0", 16)
    words = f"holds the invisible character U+{code:04X}. Write it without."
    assert [str(p) for p in problems(f'a:\n  b: "x{escape}y"\n')] == [f"press.yaml:2:6: a.b: This text {words}"]
    below = problems(f'a:\n  "x{escape}y": {{b: "{escape}"}}\n')
    assert [str(p) for p in below] == [
        f"press.yaml:2:3: a: This key {words}",
        f"press.yaml:2:{len(escape) + 13}: a.x\N{REPLACEMENT CHARACTER}y.b: This text {words}",
    ]


@pytest.mark.parametrize("escape", ["\\n", "\\r", "\\t"])
def test_a_text_may_have_lines_but_a_key_may_not(escape: str) -> None:
    assert parse(f'a: "x{escape}y"', "press.yaml").data == {"a": f"x{ast.literal_eval(f'{chr(34)}{escape}{chr(34)}')}y"}
    assert "This key holds the invisible character" in problems(f'"x{escape}y": 1')[0].message


def test_a_second_mark_of_the_byte_order_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "press.yaml"
    path.write_bytes(2 * b"\xef\xbb\xbf" + b"a: 1\n")
    assert str(refused_file(path)).startswith(f"{path}:1:1: The control character U+FEFF stands here. Write it without")


def test_load_keeps_text_and_hash_of_the_bytes(tmp_path: Path) -> None:
    path = tmp_path / "press.yaml"
    raw = b"\xef\xbb\xbfa: 1\r\nb: 2\r\n"
    path.write_bytes(raw)
    tree = load(path)
    assert tree.data == {"a": 1, "b": 2}
    assert tree.file == str(path)
    assert tree.text == "a: 1\r\nb: 2\r\n"
    assert tree.sha256 == hashlib.sha256(raw).hexdigest()
    assert tree.position(("b",)) == (2, 4)


@pytest.mark.parametrize(
    ("content", "line", "message"),
    [
        (None, None, "There is no such file. Check the name and the folder."),
        (b"", None, "The file is empty. Write a YAML document."),
        (b"a: 1\na: 2\n", 2, "The key 'a' stands here again; it is first in line 1. Remove one of the two."),
        (b"a: 1\nb: \xff\xfe\x00\x93\n", 2, "The file is not UTF-8 text. Give a YAML file, saved as UTF-8."),
    ],
)
def test_a_file_is_refused(tmp_path: Path, content: bytes | None, line: int | None, message: str) -> None:
    path = tmp_path / "press.yaml"
    if content is not None:
        path.write_bytes(content)
    problem = refused_file(path)
    assert (problem.message, problem.line) == (message, line)
    assert refused_file(tmp_path).message == "This is a folder. Give a YAML file."


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no named pipes on this system")
def test_a_pipe_is_refused_without_waiting_for_it(tmp_path: Path) -> None:
    path = tmp_path / "pipe.yaml"
    os.mkfifo(path)
    assert refused_file(path).message.startswith("This is a pipe and no regular file.")


def test_an_unreadable_file_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "press.yaml"
    path.write_text("a: 1\n", encoding="utf-8")

    def denied(*_: Any, **__: Any) -> None:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(os, "open", denied)  # the superuser may read everything, so rights alone do not show it
    message = refused_file(path).message
    assert message == "The file cannot be read: Permission denied. Check its name and its permissions."


def test_a_100_mb_file_is_refused_without_reading_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "press.yaml"
    with path.open("wb") as stream:
        stream.truncate(100_000_000)
    monkeypatch.setattr(os, "open", lambda *_: pytest.fail("the file was opened"))
    assert refused_file(path).message == "The file is too large: 100.0 MB; at most 5 MB are allowed."


def test_a_file_that_states_no_size_is_bounded_in_reading(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "press.yaml"
    path.write_bytes(b"#" * (MAX_BYTES + 5))
    stated = list(path.stat())
    stated[stat.ST_SIZE] = 0
    monkeypatch.setattr(Path, "stat", lambda _: os.stat_result(stated))
    monkeypatch.setattr(os, "fstat", lambda _: os.stat_result(stated))
    assert refused_file(path).message.startswith("The file is too large: 5.0 MB;")


def test_a_file_of_the_greatest_size_is_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(yaml_tree, "MAX_BYTES", 50_000)
    path = tmp_path / "press.yaml"
    path.write_bytes(b"a: 1 #" + b"x" * (50_000 - 6))
    assert load(path).data == {"a": 1}
    path.write_bytes(b"a: 1 #" + b"x" * (50_000 - 5))
    assert refused_file(path).message.startswith("The file is too large: ")


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("[9,5 mm, 10 mm]", ["9,5 mm"]), ("[9,5 mm]", ["9,5 mm"]), ("[1,5, 2,5]", ["1,5", "2,5"]), ("[1 mm, -2,5 mm]", ["-2,5 mm"]),
        ("[1,2,3]", []), ("[1, 2, 3]", []), ("[1 mm,2 mm]", []), ("[1 kN, 2, 3000 N]", []), ("[0.5,1 mm, 2 mm]", []), ("['1',2 mm, 3]", []),
    ],
)  # fmt: skip
def test_a_decimal_comma_in_a_list_is_no_end_of_a_value(text: str, told: list[str]) -> None:
    found = yaml_tree.read_text(f"a: {text}", "press.yaml").problems
    assert [each.message.split(" is read as two values")[0] for each in found] == told
    assert all(each.line == 1 and each.column is not None and each.path.startswith("a.") for each in found)
