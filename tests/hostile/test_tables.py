"""Hostile tables: each is read or refused in words, soon, and with little memory."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from tests.hostile.bounded import read
from tests.hostile.made_tables import LARGEST, QUICK, made
from tests.shared import once

pytestmark = pytest.mark.nightly  # how tables are read at all is tried in tests/study
Told = dict[str, tuple[list[str], float, int]]
GROWTH = 500_000_000  # bytes


@pytest.fixture(scope="module")
def told(tmp_path_factory: pytest.TempPathFactory) -> Told:
    """What is told of each table, read once for all workers."""

    def make(folder: Path) -> None:
        tables = tmp_path_factory.mktemp("tables")
        plain = tables / "plain.csv"
        plain.write_text("a,b\n1,2\n")
        (folder / "told.json").write_text(json.dumps(read(plain, made(tables, QUICK))))

    found: Told = json.loads((once(tmp_path_factory, "told_of_tables", make) / "told.json").read_text())
    return found


def test_each_is_read_or_refused_in_words_and_soon(told: Told) -> None:
    assert told.keys() == QUICK.keys()
    assert {name: seconds for name, (_, seconds, _) in told.items() if seconds > 8} == {}
    words = [line for lines, _, _ in told.values() for line in lines]
    assert [line for line in words if len(line) > 5000 or re.search(r"Traceback|Error\(", line)] == []


def test_none_takes_much_memory(told: Told) -> None:
    assert {name: growth for name, (_, _, growth) in told.items() if growth > GROWTH} == {}


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("pipe.csv", "This is a pipe and no regular file. Give a table (.csv)."),
        ("zero.csv", "This is a device and no regular file."),
        ("random.xlsx", "This is a device and no regular file."),
        ("folder.xlsx", "This is a folder. Give a table (.xlsx)."),
        ("socket.csv", "This is a socket and no regular file."),
        ("loop.csv", "The file cannot be read: Too many levels of symbolic links."),
        ("hole.csv", "The file is too large: 20000.0 MB; at most 200 MB are allowed."),
        ("hole.xlsx", "at most 25 MB are allowed."),
        ("line.csv", "row 1 is too long"),
        (
            "quote.csv",
            "a row that ends in another line, or is longer than 1 MB; look for a quotation mark that is not closed",
        ),
        ("columns.csv", "has 900001 columns; at most 16384 are allowed."),
        ("blank.csv", "has 5,000,001 rows × 9 columns; at most 10,000,000 cells are allowed."),
        ("packed cell.xlsx", "holds 120.0 MB when it is unpacked; at most 100 MB are allowed."),
        ("far cell.xlsx", "has a cell far from the others"),
        ("far row.xlsx", "has a cell far from the others"),
        ("empty rows.xlsx", "has more than 500,000 cells, or as many other parts."),
        ("many fonts.xlsx", "or as many other parts."),
        ("entities.xlsx", "is not an XLSX workbook, or a damaged one"),
        ("strings with entities.xlsx", "is not an XLSX workbook, or a damaged one"),
        ("other letters.xlsx", "is not an XLSX workbook, or a damaged one"),
        ("cut.xlsx", "is not an XLSX workbook, or a damaged one"),
        ("string 9.xlsx", "is not an XLSX workbook, or a damaged one"),
        ("letters.xlsx", "holds a text of more than a million letters"),
        ("attributes.xlsx", "holds a text of more than a million letters"),
        ("comment.xlsx", "holds a text of more than a million letters"),
        ("two bytes.xlsx", "is not an XLSX workbook, or a damaged one"),
        ("members.xlsx", "files within; a workbook has some dozens."),
        ("text.parquet", "when it is unpacked; at most 500 MB are allowed."),
        ("rows.parquet", "has 11,000,000 rows × 1 columns; at most 10,000,000 cells are allowed."),
        ("columns.parquet", "has 17000 columns; at most 16384 are allowed."),
        ("cut.parquet", "is not a Parquet file, or a damaged one"),
    ],
)
def test_what_is_refused_says_why(told: Told, name: str, words: str) -> None:
    assert any(words in line for line in told[name][0]), told[name][0]


def test_rows_of_another_length_and_wrong_cells_are_told_as_a_few_and_their_number(told: Told) -> None:
    assert len(told["ragged.csv"][0]) == 101
    assert told["ragged.csv"][0][-1].endswith("99900 more rows have not as many cells as the header")
    assert told["words.csv"][0][-1].endswith("99995 more cells of this column are wrong")


def test_a_flipped_bit_costs_no_traceback(told: Told) -> None:
    lines = [told[name][0] for name in QUICK if name.startswith("bit")]
    refused = [line for line in lines if "or a damaged one" in line[0]]
    assert len(refused) > len(lines) / 2 and all(lines)


@pytest.mark.parametrize("name", LARGEST)
def test_the_largest_that_is_read_takes_bearable_memory(tmp_path: Path, name: str) -> None:
    plain = tmp_path / "plain.csv"
    plain.write_text("a,b\n1,2\n")
    ((_, (lines, _, growth)),) = read(plain, made(tmp_path, {name: LARGEST[name]})).items()
    assert lines and growth < 2 * GROWTH
