"""The folder of a study: types, provenance, whole files whatever ends the run, one run at a time, exports."""

from __future__ import annotations

import csv
import errno
import json
import os
import re
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import IO, Any

import duckdb
import numpy as np
import openpyxl
import psutil
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
import scipy

from diecut_report.errors import UserError
from diecut_report.study.storage import spreadsheets as exports
from diecut_report.study.storage import store as stores
from diecut_report.study.storage.description import Description, ResultColumn, kept
from diecut_report.study.storage.spreadsheets import export
from diecut_report.study.storage.store import Store
from tests.study.made_store import MASS, SPEED, description, part, source

ROOT = Path(__file__).parents[2]
WRITER = """
import sys
from pathlib import Path
from diecut_report.study.storage.store import Store
from tests.study.made_store import part
store = Store.open(Path(sys.argv[1]))
with store.lock():
    for index in range(store.description.parts):
        rows = store.description.part_rows(index)
        store.write_part(index, part(rows.start, len(rows)))
        print(index, flush=True)
"""
HOLDER = """
import sys, time
from pathlib import Path
from diecut_report.study.storage.store import Store
with Store.open(Path(sys.argv[1])).lock():
    print("held", flush=True)
    time.sleep(600)
"""


def filled(folder: Path, study: Description | None = None) -> Store:
    store = Store.create(folder, study or description())
    fill(store)
    return store


def stored(folder: Path, study: Description, *parts: dict[str, Any]) -> Store:
    """A study with these first parts."""
    store = Store.create(folder, study)
    with store.lock():
        for index, columns in enumerate(parts):
            store.write_part(index, columns)
    return store


def fill(store: Store) -> None:
    with store.lock():
        for index in range(store.description.parts):
            rows = store.description.part_rows(index)
            store.write_part(index, part(rows.start, len(rows)))


@contextmanager
def process(code: str, folder: Path) -> Iterator[tuple[int, IO[str]]]:
    """The code in a process of its own, with its number and what it says; killed at the end."""
    command = [sys.executable, "-c", code, str(folder)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, cwd=ROOT) as run:
        assert run.stdout is not None
        yield run.pid, run.stdout
        run.kill()


def hidden(folder: Path) -> list[str]:
    return [path.name for path in folder.rglob(".*.part")]


def exported(store: Store, name: str) -> Path:
    """The variants in another format."""
    export(store, [name])
    return store.directory / f"variants.{name}"


# what is stored
def test_each_column_has_its_type_and_missing_values_are_null(tmp_path: Path) -> None:
    table, made = filled(tmp_path / "out").read().to_table(), part(0, 100)
    assert table.column_names == list(made)
    numbers, text = [pa.int64(), pa.float64(), pa.float64(), pa.int64()], pa.dictionary(pa.int32(), pa.string())
    assert table.schema.types == [*numbers, pa.bool_(), text, text, text, text]
    for name in ("variant", SPEED, "drive.reversed"):
        assert table[name].to_pylist() == made[name].tolist()
    assert table[MASS].to_pylist() == [None if n % 5 == 0 else 2.0 * n for n in range(100)]
    assert table["drive.law"].to_pylist() == made["drive.law"]


def test_schema_tells_units_and_provenance(tmp_path: Path) -> None:
    study = description()
    schema = pq.read_schema(filled(tmp_path / "out", study).part(0))
    about = schema.field(SPEED).metadata
    assert (about[b"unit"], about[b"symbol"].decode(), about[b"description"]) == (b"rad/s", "ω", b"Crank speed")
    told = {key.decode(): value.decode() for key, value in schema.metadata.items()}
    assert told == {
        "program": "diecut-report", "version": study.program, "schema_version": "1",
        "study": study.study.sha256, "base": study.base.sha256,
    }  # fmt: skip


def test_parts_are_read_by_other_programs(tmp_path: Path) -> None:
    filled(tmp_path / "out")
    asked = f"select count(*), sum(\"{MASS}\") from '{tmp_path}/out/variants/part-*.parquet'"
    with duckdb.connect() as connection:
        assert connection.execute(asked).fetchall() == [(100, sum(2.0 * n for n in range(100) if n % 5))]


@pytest.mark.parametrize("values", [[1.0, np.inf, None], np.array([1.0, -np.inf, np.nan])])
def test_what_is_no_finite_number_is_null(tmp_path: Path, values: Any) -> None:
    teeth = np.array([1.0, np.nan, 3.0])
    made = {"variant": range(3), "status": ["pass"] * 3, MASS: values, "train.teeth": teeth}
    table = stored(tmp_path, description(3), made).read().to_table()
    assert table[MASS].to_pylist() == [1.0, None, None]
    assert table["train.teeth"].to_pylist() == [1, None, 3]
    assert table[SPEED].null_count == 3  # not given: applies to none


def test_curves_are_lists_of_unlike_lengths_and_stand_in_the_part_files_alone(tmp_path: Path) -> None:
    given = [np.array([1.0, 2.0, 3.0]), None, np.array([]), [4, np.inf], np.array([5.0])]
    made = {"variant": range(5), "status": ["pass"] * 5, "drive.torque": given}
    store = stored(tmp_path / "out", description(5, columns=(ResultColumn("drive.torque", "curve", "N*m"),)), made)
    assert store.read().to_table()["drive.torque"].to_pylist() == [[1, 2, 3], None, [], [4, None], [5]]
    assert store.done_parts() == {0}
    with duckdb.connect() as connection:
        asked = f"select \"drive.torque\"[1] from '{tmp_path}/out/variants/part-*.parquet' order by variant"
        assert connection.execute(asked).fetchall() == [(1.0,), (None,), (None,), (4.0,), (5.0,)]
    [told] = export(store, ["csv", "xlsx"])
    assert "torque" not in (tmp_path / "out/variants.csv").read_text()
    files = "variants.csv and variants.xlsx"
    assert told.startswith(f"{files}: without the curves drive.torque, which only the Parquet files in")


@pytest.mark.parametrize(
    ("columns", "words"),
    [
        ({"status": ["pass"], "train.teeth": np.array([0.5])}, "train.teeth cannot hold"),
        ({"status": ["pass"], MASS: ["heavy"]}, "cylinder.mass cannot hold"),
        ({"status": ["pass"], MASS: [1.0, 2.0]}, "2 values for 1 variants"),
        ({"status": ["pass"], "strange": [1.0]}, "strange"),
        ({MASS: [1.0]}, "needs its status"),
    ],
)
def test_part_of_another_shape_is_refused(tmp_path: Path, columns: dict[str, Any], words: str) -> None:
    store = Store.create(tmp_path / "out", description())
    with store.lock(), pytest.raises(ValueError, match=words):
        store.write_part(0, {"variant": [0], **columns})
    assert store.done_parts() == set()


def test_dropped_rows_leave_their_numbers_free(tmp_path: Path) -> None:
    two, none = {"variant": np.array([2, 7]), "status": ["pass", "fail"]}, {"variant": np.array([], int), "status": []}
    store = stored(tmp_path / "out", description(20), two, none)
    with store.lock():
        store.finish()
        store.note({"seconds": 2.5})
    assert store.read(["variant"]).to_table().to_pydict() == {"variant": [2, 7]}
    state = json.loads((tmp_path / "out/study.json").read_text())
    assert state["counts"] == {"sample": 20, "variants": 2, "dropped": 18, "pass": 1, "fail": 1}
    assert (state["state"], state["seconds"], state["parts"]) == ("complete", 2.5, 2)


def test_state_runs_until_all_parts_are_there(tmp_path: Path) -> None:
    store = Store.create(tmp_path / "out", description())
    with store.lock():
        store.start({"varied": [SPEED]})
    assert store.state["state"] == "running" and store.state["varied"] == [SPEED]
    assert store.state["columns"][SPEED]["unit"] == "rad/s"
    with store.lock(), pytest.raises(RuntimeError, match="10 parts are missing"):
        store.finish()


def test_versions_of_what_calculates_are_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    store = Store.create(tmp_path / "out", description())
    own = {"python": [sys.version.split()[0]], "numpy": [np.__version__], "scipy": [scipy.__version__]}
    with store.lock():
        for _ in range(2):
            store.start({})
            assert store.state["libraries"] == own
        monkeypatch.setattr(stores, "libraries", lambda: {"python": own["python"][0], "numpy": "9.9", "scipy": "9"})
        store.start({})
    assert store.state["libraries"] == {**own, "numpy": [np.__version__, "9.9"], "scipy": [scipy.__version__, "9"]}


def test_nothing_is_written_without_the_lock(tmp_path: Path) -> None:
    with pytest.raises(RuntimeError, match="not locked"):
        Store.create(tmp_path / "out", description()).write_part(0, part(0, 10))


def test_batches_come_in_the_order_of_the_variants(tmp_path: Path) -> None:
    store = Store.create(tmp_path / "out", description())
    with store.lock():
        for index in reversed(range(10)):
            store.write_part(index, part(10 * index, 10))
    assert [n for batch in store.batches(["variant"]) for n in batch.column(0).to_pylist()] == list(range(100))


# one study, one run
def test_files_of_the_study_are_kept(tmp_path: Path) -> None:
    Store.create(tmp_path / "out", description())
    assert (tmp_path / "out/study.yaml").read_text() == "count: 9\n"
    (tmp_path / "out/base.yaml").unlink()  # as if killed before it was there
    with pytest.raises(UserError, match=r"base\.yaml: This copy of press\.yaml is missing.*batch STUDY --resume"):
        kept(tmp_path / "out")
    continued = Store.open(tmp_path / "out", description())
    with continued.lock():
        continued.start({})
    assert (tmp_path / "out/base.yaml").read_text().startswith("title: press")


def test_tables_of_the_study_are_kept_within_the_folder(tmp_path: Path) -> None:
    tables = tuple(source(f"{place}/a.csv", place) for place in ("../data", str(tmp_path), "x"))
    Store.create(tmp_path / "out", description(tables=tables))
    copies = kept(tmp_path / "out")
    texts = {name: path.read_text() for name, path in copies.items() if name != "press.yaml"}
    assert texts == {table.file: str(Path(table.file).parent) for table in tables}
    assert sorted(tmp_path.iterdir()) == [tmp_path / "out"]
    assert sorted(path.name for path in (tmp_path / "out/tables").iterdir()) == ["1-a.csv", "2-a.csv", "3-a.csv"]
    copies["x/a.csv"].write_text("other")
    with pytest.raises(UserError, match=r"tables/3-a\.csv: This copy of x/a\.csv is missing or has changed"):
        kept(tmp_path / "out")


def test_folder_with_anything_in_it_is_refused_and_one_without_results_told(tmp_path: Path) -> None:
    (tmp_path / "base.yaml").write_text("mine")
    with pytest.raises(UserError, match=r"not empty \(base.yaml"):
        Store.create(tmp_path, description())
    assert (tmp_path / "base.yaml").read_text() == "mine"
    with pytest.raises(UserError, match=r"study\.json is missing"):
        Store.open(tmp_path)
    filled(tmp_path / "out")
    with pytest.raises(UserError, match=r"here already.*--resume"):
        Store.create(tmp_path / "out", description())


def test_same_study_is_continued_with_the_parts_and_the_name_of_the_folder(tmp_path: Path) -> None:
    """Its copy in the folder, which a run without the study is continued from, has another name."""
    named = description(chunk=64)
    filled(tmp_path / "out", description())
    store = Store.open(tmp_path / "out", replace(named, study=replace(named.study, file="study.yaml")))
    assert store.description.chunk == 10 and store.done_parts() == set(range(10))
    assert store.description.study == named.study and named.study.file != "study.yaml"


@pytest.mark.parametrize(
    ("changed", "words"),
    [
        ({"study": source("speeds.yaml", "count: 10\n")}, r"study file has changed.*\n *-count: 9\n *\+count: 10"),
        ({"base": source("press.yaml", "title: press\nmass: 6 kg\n")}, r"base configuration has.*\n *-mass: 5 kg\n *\+mass: 6 kg"),
        ({"rows": 90}, "sample had 100 rows, now it has 90"),
        ({"tables": (source("a.csv", "2"), source("b.csv", "1"))}, r"a\.csv: This table has changed since"),
        ({"tables": (source("a.csv", "2"), source("b.csv", "1"))}, r"b\.csv: This table is new"),
        ({"tables": ()}, r"a\.csv: This table is no longer"),
        ({"program": "9.9"}, r"begun with version .* this is 9\.9"),
        ({"plugins": {"clutch": "2"}}, "plugin 'clutch' was 1 .* it is 2"),
        ({"columns": description().columns[1:]}, f"columns of the results differ: {re.escape(SPEED)}"),
    ],
)  # fmt: skip
def test_changed_study_is_refused_with_what_changed(tmp_path: Path, changed: dict[str, Any], words: str) -> None:
    before = description(tables=(source("a.csv", "1"),), plugins={"clutch": "1"})
    filled(tmp_path / "out", before)
    Store.open(tmp_path / "out", before)
    with pytest.raises(UserError) as caught:
        Store.open(tmp_path / "out", replace(before, **changed))
    assert re.search(words, str(caught.value))


def test_folder_in_use_tells_who_uses_it(tmp_path: Path) -> None:
    store = filled(tmp_path / "out")
    with process(HOLDER, tmp_path / "out") as (number, said):
        assert said.readline() == "held\n"
        with pytest.raises(UserError, match=rf"process {number} on {os.uname().nodename}"), store.lock():
            pass
    with store.lock():  # a killed run holds nothing
        pass


# whole or absent
@pytest.mark.nightly
def test_killed_writer_leaves_whole_parts_alone(tmp_path: Path) -> None:
    study = description(200_000, 500)
    store = Store.create(tmp_path / "out", study)
    for wait in (3, 40):
        with process(WRITER, tmp_path / "out") as (_, said):
            told = [said.readline() for _ in range(wait)]
            time.sleep(0.003 * wait / 40)  # somewhere in a part
        again = Store.open(tmp_path / "out", study)
        assert len(told) <= len(again.done_parts()) == len(again.parts()) < 400
        for index, path in again.parts().items():
            assert pq.read_table(path)["variant"].to_pylist() == list(again.description.part_rows(index))
    (tmp_path / "out/variants/.0123456789abcdef.part").write_bytes(b"PAR1")
    (tmp_path / "out/reports/.abc.part").mkdir(parents=True)
    (tmp_path / "out/reports/.abc.part/openpyxl").touch()
    with store.lock():
        assert hidden(tmp_path / "out") == []


def test_part_of_which_some_bytes_have_changed_is_to_be_calculated_again(tmp_path: Path) -> None:
    store = filled(tmp_path / "out", description(3000, 3000))
    content = bytearray(store.part(0).read_bytes())
    place = len(content) // 4
    content[place : place + 64] = bytes(64)
    store.part(0).write_bytes(content)
    assert store.done_parts() == set()
    with pytest.raises(UserError, match=r"part-00000\.parquet: .* damaged"):
        export(store, ["csv"])
    assert hidden(tmp_path) == [] and not (tmp_path / "out/variants.csv").exists()


@pytest.mark.parametrize("name", ["part-copy.parquet", "part-3.parquet", "part-00003 (1).parquet"])
def test_file_that_only_looks_like_a_part_is_told(tmp_path: Path, name: str) -> None:
    store = filled(tmp_path / "out")
    (tmp_path / "out/variants" / name).write_bytes(b"PAR1")
    with pytest.raises(UserError, match=re.escape(f"{name}: This is not a part of the results. Move it")):
        store.done_parts()


def test_mechanism_may_be_called_as_a_column(tmp_path: Path) -> None:
    columns = (ResultColumn("status.mass"), ResultColumn("variant.status", "text"))
    made = {"variant": [0, 1], "status": ["pass", "fail"], "status.mass": [1, 2], "variant.status": ["a", "b"]}
    store = stored(tmp_path / "out", description(2, columns=columns), made)
    assert store.counts() == {"sample": 2, "variants": 2, "pass": 1, "fail": 1}
    assert exported(store, "csv").read_text().splitlines()[1:] == ['0,1,"a","pass",,', '1,2,"b","fail",,']


@pytest.fixture
def small_disk(tmp_path: Path) -> Iterator[Path]:
    """A disk of 200 kB where this user may make one (root on Linux); told by its absence elsewhere."""
    disk = tmp_path / "disk"
    disk.mkdir()
    made = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=200k", "tmpfs", str(disk)], capture_output=True)
    if made.returncode:
        yield tmp_path / "no disk"
        return
    yield disk
    subprocess.run(["umount", str(disk)], check=True)


def limited(monkeypatch: pytest.MonkeyPatch) -> None:
    """Any file of more than 8 kB finds the disk full after its first half."""

    def write_bytes(path: Path, content: bytes) -> int:
        with path.open("wb") as file:
            file.write(bytes(content)[: len(content) // 2])
            if path.parent.name == "variants" and len(content) > 8000:
                raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
            return file.write(bytes(content)[len(content) // 2 :])

    monkeypatch.setattr(Path, "write_bytes", write_bytes)


@contextmanager
def room_made(disk: Path, patch: pytest.MonkeyPatch) -> Iterator[None]:
    """The disk is larger now."""
    if disk.name == "no disk":
        patch.undo()
    else:
        subprocess.run(["mount", "-o", "remount,size=50m", str(disk)], check=True)
    yield


def test_full_disk_is_told_and_leaves_nothing_half_written(small_disk: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    store = Store.create(small_disk / "out", description(100_000, 1000))
    if small_disk.name == "no disk":
        limited(monkeypatch)
    words = r"(part-.*parquet|study\.json): This cannot be written: the disk is full.*--resume"
    with pytest.raises(UserError, match=words):
        fill(store)
    there = store.done_parts()
    assert hidden(small_disk / "out") == [] and there == set(store.parts()) != set(range(100))
    assert store.state["state"] == "running"
    with room_made(small_disk, monkeypatch), store.lock():
        for index in set(range(100)) - there:
            store.write_part(index, part(1000 * index, 1000))
        store.finish()
        assert store.counts()["variants"] == 100_000


@pytest.mark.parametrize("number", [errno.ENOSPC, errno.EDQUOT, errno.EIO])
@pytest.mark.parametrize("call", ["write_bytes", "replace"])
def test_error_of_the_disk_leaves_the_part_before(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, call: str, number: int
) -> None:
    store = filled(tmp_path / "out")
    before, whole = store.part(3).read_bytes(), getattr(Path, call)

    def broken(path: Path, *given: Any) -> Any:
        if path.parent.name == "variants":
            raise OSError(number, os.strerror(number))
        return whole(path, *given)

    with store.lock():
        with monkeypatch.context() as patch:
            patch.setattr(Path, call, broken)
            with pytest.raises(UserError, match=r"part-00003\.parquet: This cannot be written"):
                store.write_part(3, part(30, 10))
        assert store.part(3).read_bytes() == before and hidden(tmp_path) == []
        store.write_part(3, part(30, 10))


def test_interrupt_in_the_middle_of_a_file_leaves_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    store = Store.create(tmp_path / "out", description())

    def interrupted(path: Path, content: bytes) -> int:
        with path.open("wb") as file:
            file.write(bytes(content)[:100])
        raise KeyboardInterrupt

    with store.lock():
        monkeypatch.setattr(Path, "write_bytes", interrupted)
        with pytest.raises(KeyboardInterrupt):
            store.write_part(0, part(0, 10))
        assert hidden(tmp_path) == [] and store.parts() == {}
        monkeypatch.undo()


@pytest.mark.nightly
@pytest.mark.parametrize("parts", [50, 150])
def test_memory_stays_flat_over_many_parts(tmp_path: Path, parts: int) -> None:
    columns = tuple(ResultColumn(f"a.{number}") for number in range(50))
    store = Store.create(tmp_path / "out", description(4000 * parts, 4000, columns=columns))
    values = np.random.default_rng(0).random((50, 4000))

    def write(some: range) -> int:
        for index in some:
            content: dict[str, Any] = {column.name: row for column, row in zip(columns, values + index, strict=True)}
            store.write_part(index, content | {"status": ["pass"] * 4000})
        return int(psutil.Process().memory_info().rss)

    with store.lock():
        early, late = write(range(parts // 5)), write(range(parts // 5, parts))
        assert late - early < 0.16 * 1.6e6 * 4 / 5 * parts  # what the parts between hold is 1.6 MB each
        store.finish()
    export(store, ["csv"])
    assert psutil.Process().memory_info().rss - early < 150e6


# tables for other programs
def test_csv_reads_back_exactly(tmp_path: Path) -> None:
    path = exported(filled(tmp_path / "out"), "csv")
    with path.open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert [float(row[f"{SPEED} [rad/s]"]) for row in rows] == [n / 7 for n in range(100)]
    assert [row[f"{MASS} [kg]"] for row in rows][:6] == ["", "2", "4", "6", "8", ""]
    assert [int(row["variant"]) for row in rows] == list(range(100))
    assert rows[1]["drive.law"] == "harmonic" and rows[0]["drive.reversed"] == "true"


def test_workbook_has_as_many_sheets_as_the_rows_need(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(exports, "SHEET_ROWS", 41)
    [told] = export(filled(tmp_path / "out"), ["xlsx"])
    assert told == "variants.xlsx: 100 variants in 3 sheets, as a sheet holds 41 rows."
    book = openpyxl.load_workbook(tmp_path / "out/variants.xlsx")
    sheets = [list(sheet.iter_rows(values_only=True)) for sheet in book]
    assert [len(rows) for rows in sheets] == [41, 41, 21]
    assert {rows[0] for rows in sheets} == {sheets[0][0]} and sheets[0][0][:2] == ("variant", f"{SPEED} [rad/s]")
    assert [row[0] for rows in sheets for row in rows[1:]] == list(range(100))
    assert [row[1] for rows in sheets for row in rows[1:]] == pytest.approx([n / 7 for n in range(100)], rel=1e-15)
    assert sheets[0][1][2] is None and sheets[0][1][4] is True


def test_texts_of_a_workbook_stay_texts(tmp_path: Path) -> None:
    made = {"variant": [0, 1], "status": ["error"] * 2, "error": ["=1+1", "a\x00b"]}
    path = exported(stored(tmp_path / "out", description(2), made), "xlsx")
    rows = list(openpyxl.load_workbook(path).worksheets[0].iter_rows(min_row=2))
    assert [row[-1].value for row in rows] == ["=1+1", "a\N{REPLACEMENT CHARACTER}b"]
    assert rows[0][-1].data_type == "s"


def test_more_columns_than_a_sheet_holds_are_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(exports, "SHEET_COLUMNS", 8)
    store = filled(tmp_path / "out")
    with pytest.raises(UserError, match=r"9 columns; a sheet holds 8\. Use CSV"):
        export(store, ["xlsx"])
    assert hidden(tmp_path) == [] and not (tmp_path / "out/variants.xlsx").exists()


def test_workbook_that_finds_no_room_leaves_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    store, places = filled(tmp_path / "out"), []

    def batches(*_: object) -> Iterator[pa.RecordBatch]:
        yield pa.record_batch([pa.array([1])], names=["variant"])
        places.extend(tmp_path.rglob("openpyxl.*"))
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(store, "batches", batches)
    with pytest.raises(UserError, match="out: This cannot be written: the disk is full"):
        export(store, ["xlsx"])
    assert places and not any(place.exists() for place in places)  # its temporary files were in the folder
    assert hidden(tmp_path) == [] and not (tmp_path / "out/variants.xlsx").exists()
    monkeypatch.undo()
    assert exported(store, "xlsx").exists()
