"""Files beside the report: tables with full precision, drawings that read back point by point, the same bytes again."""

from __future__ import annotations

import csv
import io
import math
import os
import subprocess
import sys
from hashlib import sha256
from pathlib import Path
from typing import Any

import ezdxf
import pytest
from ezdxf.document import Drawing

from diecut_report.report import profile_files
from diecut_report.results.results_file import results_text
from tests.report.made_results import curves, export, mechanism, typed

Data = dict[str, Any]
COLUMNS = ("cam_1_x", "cam_1_y", "cam_1_pitch_x", "cam_1_pitch_y")
AGAIN = """
import sys
from pathlib import Path
from hashlib import sha256
from diecut_report.report.profile_files import written
from diecut_report.results.model import ResultsRecord
results = ResultsRecord.model_validate_json(Path(sys.argv[1]).read_bytes())
for name, content in written(results)[0].items():
    print(name, sha256(content).hexdigest())
"""


def _results(*columns: str, samples: int = 72) -> Data:
    return {
        "mechanisms": {"feeder": mechanism("Feeder", curves=curves(samples), exports=[export(*(columns or COLUMNS))])}
    }


def exports(results: Data) -> dict[str, bytes]:
    """Return the files beside the report of these results; raise what one of them is refused with."""
    files, faults = profile_files.written(typed(results))
    for *_, cause in faults:
        raise cause
    return files


def _drawing(content: bytes) -> Drawing:
    return ezdxf.read(io.StringIO(content.decode("utf-8")))


def _points(drawing: Drawing, layer: str) -> list[tuple[float, float]]:
    [line] = drawing.modelspace().query(f'LWPOLYLINE[layer=="{layer}"]')
    return [(x, y) for x, y in line.get_points("xy")]  # type: ignore[attr-defined]


def test_a_profile_gives_a_drawing_and_a_table() -> None:
    assert list(exports(_results())) == ["feeder.cam_1.dxf", "feeder.cam_1.csv"]


def test_nothing_is_written_for_mechanisms_without_profiles() -> None:
    assert exports({"mechanisms": {"a": mechanism("A"), "b": {"kind": "b", "status": "error"}}}) == {}


def test_comparisons_may_have_profiles_too() -> None:
    results = _results()
    results["comparisons"] = {"both": results["mechanisms"].pop("feeder")}
    assert list(exports(results)) == ["both.cam_1.dxf", "both.cam_1.csv"]


# tables
def test_table_has_one_row_of_heads_with_units_and_a_row_for_each_sample() -> None:
    text = exports(_results())["feeder.cam_1.csv"].decode()
    assert (
        text.split("\n")[0]
        == '"disc_angle [deg]","cam_1_x [mm]","cam_1_y [mm]","cam_1_pitch_x [mm]","cam_1_pitch_y [mm]"'
    )
    assert "\r" not in text and text.endswith("\n")
    assert len(list(csv.reader(io.StringIO(text)))) == 73


def test_table_holds_the_values_at_full_precision_in_display_units() -> None:
    rows = list(csv.DictReader(io.StringIO(exports(_results())["feeder.cam_1.csv"].decode())))
    made = curves()
    for row, angle, x in zip(rows, made["disc_angle"]["values"], made["cam_1_x"]["values"], strict=True):
        assert float(row["disc_angle [deg]"]) == pytest.approx(math.degrees(angle), rel=1e-14)
        assert float(row["cam_1_x [mm]"]) == pytest.approx(1000 * x, rel=1e-14, abs=1e-300)


# drawings
def test_drawing_is_in_millimetres_and_without_faults() -> None:
    drawing = _drawing(exports(_results())["feeder.cam_1.dxf"])
    assert drawing.dxfversion >= "AC1024"
    assert (drawing.header["$INSUNITS"], drawing.header["$MEASUREMENT"]) == (4, 1)
    auditor = drawing.audit()
    assert auditor.errors == [] and auditor.fixes == []


@pytest.mark.parametrize(("layer", "pair"), [("PROFILE", COLUMNS[:2]), ("PITCH_CURVE", COLUMNS[2:])])
def test_points_read_back_are_the_samples(layer: str, pair: tuple[str, str]) -> None:
    made = curves(720)
    found = _points(_drawing(exports(_results(samples=720))["feeder.cam_1.dxf"]), layer)
    expected = list(zip(made[pair[0]]["values"], made[pair[1]]["values"], strict=True))
    assert len(found) == 720
    assert max(math.hypot(x - 1000 * a, y - 1000 * b) for (x, y), (a, b) in zip(found, expected, strict=True)) < 1e-9


def test_profile_over_a_turn_is_closed_and_one_over_less_is_open() -> None:
    results = _results()
    whole = _drawing(exports(results)["feeder.cam_1.dxf"]).modelspace().query("LWPOLYLINE")
    assert all(line.closed for line in whole)  # type: ignore[attr-defined]
    axis = results["mechanisms"]["feeder"]["curves"]["disc_angle"]
    axis["values"] = [0.5 * value for value in axis["values"]]
    half = _drawing(exports(results)["feeder.cam_1.dxf"]).modelspace().query("LWPOLYLINE")
    assert not any(line.closed for line in half)  # type: ignore[attr-defined]


def test_axis_is_marked_by_a_circle_on_its_own_layer() -> None:
    drawing = _drawing(exports(_results())["feeder.cam_1.dxf"])
    [circle] = drawing.modelspace().query('CIRCLE[layer=="CENTER"]')
    assert tuple(circle.dxf.center) == (0, 0, 0)
    assert 0 < circle.dxf.radius < 10  # within the profile, whose least radius is 40 mm
    assert {entity.dxf.layer for entity in drawing.modelspace()} == {"PROFILE", "PITCH_CURVE", "CENTER"}


def test_profile_alone_has_no_pitch_curve() -> None:
    drawing = _drawing(exports(_results("cam_1_x", "cam_1_y"))["feeder.cam_1.dxf"])
    assert [entity.dxf.layer for entity in drawing.modelspace()] == ["PROFILE", "CENTER"]


def test_extents_are_those_of_the_curves() -> None:
    drawing = _drawing(exports(_results())["feeder.cam_1.dxf"])
    points = _points(drawing, "PROFILE") + _points(drawing, "PITCH_CURVE")
    low, high = drawing.header["$EXTMIN"], drawing.header["$EXTMAX"]
    assert low[:2] == pytest.approx([min(p[axis] for p in points) for axis in (0, 1)])
    assert high[:2] == pytest.approx([max(p[axis] for p in points) for axis in (0, 1)])


# the same again
def test_equal_results_give_equal_bytes_and_settings_stay() -> None:
    before = ezdxf.options.write_fixed_meta_data_for_testing
    assert exports(_results()) == exports(_results())
    assert ezdxf.options.write_fixed_meta_data_for_testing == before


@pytest.mark.nightly
def test_equal_results_give_equal_bytes_in_another_process(tmp_path: Path) -> None:
    file = tmp_path / "results.json"
    file.write_text(results_text(typed(_results())), encoding="utf-8")

    there = subprocess.run(
        [sys.executable, "-c", AGAIN, str(file)],
        env=os.environ | {"PYTHONHASHSEED": "4711", "TZ": "Asia/Tokyo"},
        capture_output=True,
        text=True,
        check=True,
    )
    here = [f"{name} {sha256(content).hexdigest()}" for name, content in exports(_results()).items()]
    assert len(here) == 2 and there.stdout.splitlines() == here


# what cannot be written
def test_curve_that_is_no_length_is_refused() -> None:
    results = _results()
    results["mechanisms"]["feeder"]["curves"]["cam_1_y"]["unit"] = "rad"
    with pytest.raises(ValueError, match="cam_1_y is not a length"):
        exports(results)


def test_unknown_type_is_refused() -> None:
    results = _results()
    results["mechanisms"]["feeder"]["exports"][0]["type"] = "solid"
    with pytest.raises(ValueError, match=r"(?s)mechanisms\.feeder\.exports\.0\.type.*'table' or 'profile'"):
        exports(results)


@pytest.mark.nightly
def test_the_library_is_imported_only_when_a_profile_is_drawn() -> None:
    code = (
        "import sys, diecut_report.report.profile_files as e; from tests.report.made_results import typed;"
        "e.written(typed({'mechanisms': {}})); print('ezdxf' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout == "False\n"
