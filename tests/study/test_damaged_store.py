"""A folder of results that is not as the run wrote it: told in words before any row, whatever was done to it, and repaired."""

from __future__ import annotations

import copy
import hashlib
import json
import os
import random
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow.parquet as pq
import pytest

from diecut_report.errors import UserError
from diecut_report.study.analysis import variants as stored_variants
from diecut_report.study.analysis.variants import opened
from diecut_report.study.execution.study_run import Where, run_study
from diecut_report.study.storage import store as stores
from diecut_report.study.storage.description import read_state, write_state
from diecut_report.study.storage.store import Store
from tests.configs import GOOD
from tests.examples import few
from tests.study.made_store import description, part
from tests.study.stored_study import ten, variants
from tests.study.studies import study

Edit = Callable[[Path], None]


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return ten(tmp_path_factory.mktemp("whole") / "out")


@pytest.fixture
def folder(whole: Path, tmp_path: Path) -> Path:
    return Path(shutil.copytree(whole, tmp_path / "out"))


def answer(folder: Path) -> str:
    """All that is told of the variants, as a table and as numbers."""
    return "".join([*variants(folder, width=200), *variants(folder, format="csv")])


def answer_or_words(folder: Path) -> str:
    """The answer, or why there is none; any other exception fails the test."""
    try:
        return answer(folder)
    except UserError as error:
        assert 20 < len(str(error)) < 4000
        return f"refused: {error}"


def refused(folder: Path) -> str:
    told = answer_or_words(folder)
    assert told.startswith("refused: "), told[:300]
    return told


# --- part files ------------------------------------------------------------------------------------------------------


def check_flipped_bits(folder: Path, count: int) -> None:
    """Each of so many bits, over all parts, changes no number without a word."""
    right, draw = answer(folder), random.Random(7)
    for path in sorted((folder / "variants").iterdir()):
        content = path.read_bytes()
        for _ in range(count):
            at, bit = draw.randrange(len(content)), draw.randrange(8)
            path.write_bytes(content[:at] + bytes([content[at] ^ 1 << bit]) + content[at + 1 :])
            assert path.name in refused(folder), (path.name, at, bit)
        path.write_bytes(content)
    assert answer(folder) == right


def test_a_flipped_bit_of_a_part_is_told_before_any_row(folder: Path) -> None:
    check_flipped_bits(folder, 40)


@pytest.mark.nightly
def test_a_flipped_bit_anywhere_is_told_before_any_row(folder: Path) -> None:
    check_flipped_bits(folder, 2000)


def _missing(folder: Path) -> None:
    (folder / "variants/part-00001.parquet").unlink()


def _rewritten(change: Callable[[Any], Any]) -> Edit:
    """Write a part again with other rows: its own checksums are valid."""

    def edit(folder: Path) -> None:
        path = folder / "variants/part-00001.parquet"
        pq.write_table(change(pq.read_table(path)), path, write_page_checksum=True)

    return edit


def _folder(folder: Path) -> None:
    _missing(folder)
    (folder / "variants/part-00001.parquet").mkdir()


def _copied(number: int) -> Edit:
    """A part once more, as the one with this number."""

    def edit(folder: Path) -> None:
        shutil.copy(folder / f"variants/part-0000{number - 1}.parquet", folder / f"variants/part-0000{number}.parquet")

    return edit


HARM: dict[str, Edit] = {
    "missing": _missing,
    "extra": _copied(2),
    "doubled": _copied(1),
    "cut rows": _rewritten(lambda table: table.slice(0, 3)),
    "doubled rows": _rewritten(lambda table: table.take([0, 0, 1, 2, 3])),
    "other order": _rewritten(lambda table: table.take([1, 0, 2, 3, 4])),
    "other version": _rewritten(lambda table: table.replace_schema_metadata({**table.schema.metadata, b"version": b"0.0.9"})),
    "same rows, other bytes": _rewritten(lambda table: table),
    "a folder": _folder,
}  # fmt: skip


def noted(folder: Path, path: Path, rows: int) -> None:
    """Note the hash of a part's bytes in study.json, as if the program had been misled."""
    known = read_state(folder)
    known["part_files"][path.name] = {"sha256": hashlib.sha256(path.read_bytes()).hexdigest(), "variants": rows}
    write_state(folder, known)


@pytest.mark.parametrize("name", HARM)
def test_a_part_that_the_run_did_not_write_is_told_by_its_name(folder: Path, name: str) -> None:
    HARM[name](folder)
    assert "part-0000" in refused(folder)


@pytest.mark.parametrize("name", HARM)
def test_a_part_whose_hash_was_noted_by_hand_is_told_too(folder: Path, name: str) -> None:
    """What the part holds is judged beside its bytes."""
    HARM[name](folder)
    for path in (path for path in (folder / "variants").iterdir() if path.is_file()):
        noted(folder, path, pq.read_metadata(path).num_rows)
    if name == "same rows, other bytes":
        assert answer(folder)
    else:
        refused(folder)


def test_part_of_another_study_is_told(folder: Path, tmp_path: Path) -> None:
    other = ten(tmp_path / "other", text="schema_version: 1\n")
    shutil.copy(other / "variants/part-00001.parquet", folder / "variants/part-00001.parquet")
    assert "part-00001.parquet: This part of the results is damaged or not of this study" in refused(folder)


def test_a_question_that_the_database_refuses_is_told_in_words(folder: Path) -> None:
    with pytest.raises(UserError, match="The query on the stored variants failed"), opened(folder) as stored:
        stored.rows("SELECT variant * 9223372036854775807 * 9 FROM v")


@pytest.mark.parametrize("rows", [5, 200_000])
def test_a_part_of_more_rows_than_it_may_have_is_not_read(
    folder: Path, monkeypatch: pytest.MonkeyPatch, rows: int
) -> None:
    """A few megabytes may hold millions of rows that are alike, each of which takes room when it is read."""
    _rewritten(lambda table: table.take([0] * 200_000))(folder)
    noted(folder, folder / "variants/part-00001.parquet", rows)
    read = pq.ParquetFile.read

    def only_few(part: pq.ParquetFile, *args: object, **more: object) -> object:
        assert part.metadata.num_rows < 10
        return read(part, *args, **more)

    monkeypatch.setattr(pq.ParquetFile, "read", only_few)
    refused(folder)


@pytest.mark.parametrize("name", ["base.yaml", "study.yaml"])
def test_a_copy_that_grew_is_refused_before_it_is_read(folder: Path, name: str) -> None:
    os.truncate(folder / name, 30 * 2**30)  # it takes no room on the disk
    assert "too large" in refused(folder)


def test_of_many_columns_one_thread_holds_a_piece_each(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """DuckDB keeps 60 kB for each column and thread: 3400 columns did not fit 400 MB."""

    def settings() -> tuple[int, int]:
        asked = "SELECT current_setting('threads'), current_setting('memory_limit')"
        with opened(folder) as stored:
            ((threads, memory),) = stored.rows(asked)
        return int(threads), round(float(str(memory).split()[0]))

    few = settings()
    monkeypatch.setattr(stored_variants, "MOST_COLUMNS", 3)
    monkeypatch.setattr(stored_variants, "OF_COLUMN", 20)
    threads, memory = settings()
    assert threads == 1 and memory > few[1] + 100


# --- what was verified is remembered -----------------------------------------------------------------------------------


def remembering(monkeypatch: pytest.MonkeyPatch, cache: Path) -> None:
    """What was verified is remembered there, however small it is."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(cache))
    monkeypatch.setattr(stores, "REMEMBERED_SIZE", 1)
    monkeypatch.setattr(stores, "SETTLED", 0)


def test_large_parts_are_read_once(folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    remembering(monkeypatch, tmp_path / "cache")
    right, read = answer(folder), []
    assert list((tmp_path / "cache").rglob("*.json"))
    monkeypatch.setattr("hashlib.file_digest", lambda *_: read.append(1))
    assert answer(folder) == right and read == []
    monkeypatch.undo()
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    path = folder / "variants/part-00001.parquet"
    content, times = path.read_bytes(), path.stat()
    path.write_bytes(content[:99] + bytes([content[99] ^ 1]) + content[100:])
    os.utime(path, ns=(times.st_atime_ns, times.st_mtime_ns))  # size and time of change are as before
    assert "part-00001" in refused(folder)


MARKED = '{{"part-00000.parquet": {{"sha256": "", "mark": [{mark}], "counts": {{}}}}}}'


@pytest.mark.nightly
def test_a_memory_that_cannot_be_read_or_written_costs_nothing(
    folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    remembering(monkeypatch, tmp_path / "cache")
    right = answer(folder)
    (file,) = (tmp_path / "cache").rglob("*.json")
    for text in ("[]", "{", MARKED.format(mark='"x"'), MARKED.format(mark="1")):
        file.write_text(text)
        with opened(folder) as stored:
            assert len(stored.rows("SELECT variant FROM v")) == 10
    (tmp_path / "file").touch()
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "file"))
    assert answer(folder) == right


# --- study.json --------------------------------------------------------------------------------------------------------

VALUES = (None, True, -1, 0, 1, 7, 10**30, 1.5, "", "x", "m", [], ["x"], {}, {"x": 1})


def edits(data: Any) -> Iterator[tuple[str, Any]]:
    """Each single edit of study.json: a key deleted, added, given another value, swapped with its neighbour."""
    for path in places(data):
        for value in (*VALUES, *_near(_home(data, path)[path[-1]])):
            edited = copy.deepcopy(data)
            _home(edited, path)[path[-1]] = value
            yield f"{path} = {value!r}", edited
        deleted, swapped = copy.deepcopy(data), copy.deepcopy(data)
        del _home(deleted, path)[path[-1]]
        yield f"{path} deleted", deleted
        _swap(_home(swapped, path), path[-1])
        yield f"{path} swapped", swapped
    yield "a key more", data | {"strange": 1}


def _near(value: Any) -> tuple[Any, ...]:
    if isinstance(value, bool | float | int):
        return (value + 1, value - 1, float(value))
    return (f"{value}x", value[::-1], value.upper()) if isinstance(value, str) else ()


def places(data: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    inner = data.items() if isinstance(data, dict) else enumerate(data) if isinstance(data, list) else ()
    for key, value in inner:
        yield (*path, key)
        yield from places(value, (*path, key))


def _home(data: Any, path: tuple[Any, ...]) -> Any:
    """The block or list in which a place is."""
    for key in path[:-1]:
        data = data[key]
    return data


def _swap(home: Any, key: Any) -> None:
    """Exchange a value with the next one of its block or list."""
    keys = list(home) if isinstance(home, dict) else list(range(len(home)))
    other = keys[(keys.index(key) + 1) % len(keys)]
    home[key], home[other] = home[other], home[key]


@pytest.mark.nightly
def test_any_single_edit_of_the_state_is_told_in_words(folder: Path) -> None:
    """The answer is the same with each of these edits, or there is none, in words that name the file."""
    file = folder / "study.json"
    right, data = answer(folder), json.loads(file.read_text())
    for name, edited in edits(data):
        file.write_text(json.dumps(edited))
        found = answer_or_words(folder)
        assert found == right or (found.startswith("refused: ") and "study.json" in found), name
        assert (edited == data and json.dumps(edited) == json.dumps(data)) or found != right, name


@pytest.mark.parametrize(
    ("key", "value", "words"),
    [
        ("rows", "ten", "study.json: rows: 'ten' is given; a whole number is needed."),
        ("rows", -1, "rows: -1 is given; at least 0 is needed."),
        ("state", "done", "state: 'done' is given; allowed is 'running' or 'complete'."),
        ("columns", None, "columns: null is given; a block of keys is needed."),
        ("varied", [], "varied: a list is given; at least one entry is needed."),
        ("varied", ["drive.sped"], "varied: 'drive.sped' is given; the name of a column is needed"),
        ("schema_version", 2, "schema_version: 2 is given; allowed is 1."),
        ("stat", 1, "stat: This key is unknown (did you mean 'state'?)."),
        ("a\nstudy.json: rows: fine", 1, r"'a\nstudy.json: rows: fine': This key is unknown"),
        ("x" * 10_000, 1, "'xxxxxxxxxxxx...xxxxxxxxxxxxx': This key is unknown"),
        ("seconds", 2.5, "This file has been changed since the program wrote it"),
    ],
)
def test_the_words_say_the_key_what_was_given_and_what_is_allowed(
    folder: Path, key: str, value: Any, words: str
) -> None:
    _edit_state(**{key: value})(folder)
    assert words in refused(folder)


@pytest.mark.parametrize(
    "text",
    ["", "null", "7", "[]", '"x"', "{" * 9, "[" * 100_000, '{"rows": NaN}', '{"rows": ' + "9" * 5000 + "}", "\ufeff{}"],
)
def test_what_is_no_state_is_told(folder: Path, text: str) -> None:
    (folder / "study.json").write_text(text, "utf-8")
    assert "study.json" in refused(folder)


# --- repaired ------------------------------------------------------------------------------------------------------------


def resumed(place: Path) -> Path:
    """The small study of levers of this place, run or continued in its folder."""
    out = place / "out"
    run_study(study(place), out, Where(1, plugins=(str(GOOD),)), resume=out.exists(), tell=lambda _: None)
    return out


def _edit_state(**changed: Any) -> Edit:
    def edit(folder: Path) -> None:
        data = json.loads((folder / "study.json").read_text())
        (folder / "study.json").write_text(json.dumps(data | changed))

    return edit


REPAIRED: dict[str, Edit] = {
    "missing": lambda folder: (folder / "variants/part-00000.parquet").unlink(),
    "damaged": lambda folder: (folder / "variants/part-00000.parquet").write_bytes(b"PAR1"),
    "extra": _copied(1),
    "varied": _edit_state(varied=["mechanisms.a.force"]),
    "objectives": _edit_state(objectives=[{"minimise": "a.moment"}]),
    "seconds": _edit_state(seconds=1e9),
    "counts": _edit_state(counts={"sample": 6, "variants": 6, "pass": 6, "dropped": 512}),
    "part_files": _edit_state(part_files={}),
    "parts": _edit_state(parts=3),
}


@pytest.mark.parametrize("name", few(REPAIRED, keep=lambda name: name in ("damaged", "counts", "part_files")))
def test_a_run_that_is_continued_repairs(tmp_path: Path, name: str) -> None:
    out = resumed(tmp_path)
    right, known = answer(out), read_state(out)
    REPAIRED[name](out)
    refused(out)
    assert resumed(tmp_path) == out and answer(out) == right
    of_time = {"seconds": 0, "seal": ""}
    assert read_state(out) | of_time == known | of_time


def test_a_part_between_its_hash_and_its_file_is_no_fault_of_a_run(tmp_path: Path) -> None:
    """A run that was killed there, or goes on meanwhile: the part is to be calculated, the others can be asked."""
    store = Store.create(tmp_path / "out", description(20))
    with store.lock():
        store.write_part(0, part(0, 10))
        store.write_part(1, part(10, 10))
    store.part(1).unlink()
    assert store.done_parts() == {0}
    assert np.array_equal(store.read(["variant"]).to_table()["variant"], np.arange(10))


def test_a_cache_that_is_named_from_the_current_folder_is_not_taken(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """By its specification a relative one does not count: nothing is written beside a config."""
    monkeypatch.setenv("XDG_CACHE_HOME", "cache")
    monkeypatch.setenv("HOME", str(tmp_path))
    file = stores.memory_file(tmp_path)
    assert file is not None and file.is_relative_to(tmp_path / ".cache")
