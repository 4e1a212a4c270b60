"""References to phases, ``${drive.phases.cutting}``, in a single run and in a study; what is wrong with them is told in words."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from diecut_report.config.loader import load_config
from diecut_report.config.plugins import Discovery
from diecut_report.config.schema import config_schema
from diecut_report.errors import UserError
from diecut_report.results.document import document
from diecut_report.results.press_run import Run, compute
from diecut_report.study.definition.base_inputs import find_input
from diecut_report.study.execution.variant_rows import calculate_rows

PLUGIN = '''
"""How long a phase of another mechanism lasts, as an angle."""

from typing import Any

import numpy as np

from diecut_report.api import Annotated, Chapter, GivenPhase, Inputs, Mechanism, PhaseInput


class Watch(Inputs):
    watched: Annotated[Any, PhaseInput("A", "deg", "What is watched")]


def length(phase: GivenPhase) -> Any:
    count = phase.calculation.count
    return np.array([[sum(end - start for start, end in phase.intervals(row))] for row in range(count)])


chapter = Chapter("Watch")
chapter.computed("length", "l", "deg", "Length of the phase", length, ("watched",), "sum of its intervals")
MECHANISM = Mechanism(kind="watch", version="1", title="Watch", summary="Watch.", inputs=Watch, chapters=(chapter,))
'''
TEXT = """\
schema_version: 1
project: {{title: Test}}
press: {{name: P, productivity: 6000 1/h}}
mechanisms:
  feeder: {{kind: cam_gear_transport, dwell_angle: 160 deg, center_distance: 300 mm, sprocket_teeth: 30, chain_pitch: 19.05 mm{more}}}
  eye: {{kind: watch, watched: "{watched}"}}
"""


@pytest.fixture(name="discovery")
def with_plugin(tmp_path: Path) -> Discovery:
    (tmp_path / "plugins").mkdir()
    (tmp_path / "plugins" / "watch.py").write_text(PLUGIN, "utf-8")
    return Discovery([tmp_path / "plugins"])


def run(folder: Path, discovery: Discovery, watched: str, more: str = "") -> Run:
    """The config with this reference, calculated."""
    file = folder / "press.yaml"
    file.write_text(TEXT.format(watched=watched, more=more), "utf-8")
    return compute(load_config(file, discovery), lambda _: None)


def test_a_phase_of_another_mechanism_is_taken_by_reference(tmp_path: Path, discovery: Discovery) -> None:
    found = run(tmp_path, discovery, "${feeder.phases.dwell}")
    assert found.calculations["eye"]["length"] == pytest.approx(np.radians(160))
    told = found.results["eye"]["inputs"]["watched"]
    assert (told["origin"], told["path"], told["value"]) == (
        "reference",
        "feeder.phases.dwell",
        "${feeder.phases.dwell}",
    )
    assert document(found)["config"]["resolved"]["mechanisms"]["eye"]["watched"] == "${feeder.phases.dwell}"


def test_a_study_takes_the_phase_of_each_variant(tmp_path: Path, discovery: Discovery) -> None:
    base = run(tmp_path, discovery, "${feeder.phases.rest}", ", rest_tolerance: 0.1 mm").config
    tolerances = np.array([1e-4, 1e-3, 5e-3])
    asked = find_input(base, "mechanisms.feeder.rest_tolerance")
    rows = calculate_rows(base, {asked: tolerances}, 3)
    single = [
        float(
            run(tmp_path, discovery, "${feeder.phases.rest}", f", rest_tolerance: {1e3 * e} mm").calculations["eye"][
                "length"
            ][0, 0]
        )
        for e in tolerances
    ]
    assert rows.columns["eye.length"] == pytest.approx(single, rel=1e-9)
    assert not rows.slow


FAULTS: dict[str, Any] = {
    "an unknown phase": ("${feeder.phases.dwel}", "names no phase: feeder has no phase 'dwel' (did you mean 'dwell'?)"),
    "a phase without its key": ("${feeder.phases.rest}", "is there only if rest_tolerance is given in feeder."),
    "a number": ("${feeder.sheet_step}", "${feeder.sheet_step} is not a phase; a reference to a phase is needed"),
    "a text": ("dwell", "'dwell' is not a phase; a reference to a phase is needed"),
}


@pytest.mark.parametrize("what", FAULTS)
def test_what_is_no_phase_is_told(what: str, tmp_path: Path, discovery: Discovery) -> None:
    watched, words = FAULTS[what]
    with pytest.raises(UserError) as error:
        run(tmp_path, discovery, watched)
    assert words in str(error.value), str(error.value)
    assert "mechanisms.eye.watched" in str(error.value)


def test_a_phase_is_neither_a_number_nor_a_text(tmp_path: Path, discovery: Discovery) -> None:
    with pytest.raises(UserError) as error:
        run(tmp_path, discovery, "${feeder.phases.dwell}", ", conveyor_mass: '${feeder.phases.dwell}'")
    assert "mechanisms.feeder.conveyor_mass" in str(error.value)
    assert "is not a number" in str(error.value)


def test_a_phase_over_time_is_refused_where_one_over_an_angle_is_needed(tmp_path: Path, discovery: Discovery) -> None:
    text = TEXT.format(watched="${link.phases.moving}", more="") + (
        "  link: {kind: elastic_follower, inertia: 0.8, stiffness: 5200, rise: 1.2 rad, rise_time: 0.2, cycles_per_hour: 1800}\n"
    )
    file = tmp_path / "press.yaml"
    file.write_text(text, "utf-8")
    with pytest.raises(UserError) as error:
        load_config(file, discovery)
    assert "is a phase over an abscissa in s; one in ° is needed here" in str(error.value)


def test_the_schema_takes_a_reference_to_a_phase_and_the_name_of_a_mechanism(discovery: Discovery) -> None:
    kinds = {kind: discovery.mechanism(kind) for kind in ("watch", "cyclogram")}
    schema = config_schema(kinds, {})["$defs"]
    assert "reference to a phase" in schema["watch"]["properties"]["watched"]["description"]
    line = schema["cyclogram"]["properties"]["lines"]["items"]["properties"]
    assert line["mechanism"]["type"] == "string"
    assert {"enum": ["auto"]} in line["offset"]["anyOf"]
