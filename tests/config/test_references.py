"""References: what they may stand for, the order that they ask for, and the mistakes that are found without calculating."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from diecut_report.config.loader import load_config
from diecut_report.config.plugins import Discovery
from diecut_report.config.references import rewritten
from diecut_report.config.schema import config_schema
from diecut_report.config.yaml import parse
from diecut_report.errors import UserError
from diecut_report.press import Press
from diecut_report.results.document import document
from diecut_report.results.model import ResultsRecord
from diecut_report.results.press_run import Run, compute
from diecut_report.study.definition.base_inputs import find_input
from diecut_report.study.execution.variant_rows import calculate_rows
from tests.configs import DISCOVERY, HEAD, LEVER, loaded, problems, saved


def results(folder: Path, text: str) -> ResultsRecord:
    """The results document of a config."""
    return Press.read(saved(folder, text), DISCOVERY).calculate().results


def inputs(folder: Path, text: str, name: str = "b") -> dict[str, Any]:
    """The SI values of a mechanism's inputs."""
    return {key: item.value for key, item in results(folder, text).mechanisms[name].inputs.items()}


TAKEN: dict[str, tuple[str, dict[str, Any]]] = {
    "an input, and one that has its default": (
        LEVER + "  b: {kind: lever, force: '${a.force}', teeth: '${a.teeth}'}\n", {"force": 2000, "teeth": 20}),
    "an output, whatever the order in the file": (
        HEAD + "  b: {kind: lever, force: 1, allowable_moment: '${a.moment}'}\n  a: {kind: lever, force: 2 kN, arm: 300}\n",
        {"allowable_moment": pytest.approx(600, rel=1e-15)}),
    "what another one takes from the press": (
        LEVER + "  b: {kind: lever, force: 1, speed: '${a.speed}', arm: '${press.sheet.length}'}\n",
        {"speed": pytest.approx(100 / 60 * 6.283185307179586, rel=1e-15), "arm": 0.7}),
    "a field of the press that refers to another": (
        LEVER.replace("thickness: 0.6 mm", "width: '${press.sheet.length}'") + "  b: {kind: lever, force: 1, arm: '${press.sheet.width}'}\n",
        {"arm": 0.7}),
    "what stands inside blocks and lists": (
        HEAD + "  a: {kind: lever, force: 2, parts: [{length: 3}, {length: 4}], spring: {stiffness: 7}}\n"
        "  b: {kind: lever, force: 1, parts: [{length: '${a.parts.1.length}'}], spring: {stiffness: '${a.spring.stiffness}'}}\n",
        {"parts.0.length": 0.004, "spring.stiffness": 7000}),
    "a text": (LEVER + "  b: {kind: lever, force: 1, remark: '${a.size}', grade: '${a.grade}'}\n", {"remark": "large", "grade": "fine"}),
    "what refers back, as long as no input needs itself": (
        HEAD + "  b: {kind: lever, force: 2, allowable_moment: '${c.moment}'}\n  c: {kind: lever, force: '${b.force}'}\n",
        {"allowable_moment": 200}),
}  # fmt: skip


@pytest.mark.parametrize("what", TAKEN)
def test_a_reference_takes_over(what: str, tmp_path: Path) -> None:
    text, expected = TAKEN[what]
    found = inputs(tmp_path, text)
    assert {key: found[key] for key in expected} == expected


def test_where_input_and_output_share_an_id_the_output_is_meant(tmp_path: Path) -> None:
    config = loaded(tmp_path, LEVER + "  b: {kind: lever, force: 1, arm: '${a.arm}'}\n")
    assert config.links["b", "arm"].result == "arm"


@pytest.mark.parametrize("load", ["'${a.torque}'", "[1, '${a.moment}', 3, 4]"])
def test_a_curve_may_be_a_reference_and_so_may_its_values(tmp_path: Path, load: str) -> None:
    made = results(tmp_path, LEVER + f"  b: {{kind: lever, force: 1, load: {load}}}\n").mechanisms["b"]
    assert made.outputs["taken_max"].value == pytest.approx(200, rel=1e-9)


def test_origin_path_and_text_are_kept(tmp_path: Path) -> None:
    text = LEVER + "  b: {kind: lever, force: '${ a.force }', arm: 0.30 m}\n"
    found = results(tmp_path, text).mechanisms["b"].inputs
    told = {name: (row.origin, row.path, row.text) for name, row in found.items()}
    assert {name: told[name] for name in ("force", "arm", "speed", "teeth")} == {
        "force": ("reference", "a.force", "${ a.force }"),
        "arm": ("given", "", "0.30 m"),
        "speed": ("default", "press.productivity", ""),
        "teeth": ("default", "", ""),
    }


# each: the inner part of a second lever, and the whole problem
WRONG = [
    ("force: '${c.moment}'", "6:27: mechanisms.b.force: ${c.moment}: there is no mechanism 'c'. Known: press, a, b."),
    ("force: '${pres.name}'", "6:27: mechanisms.b.force: ${pres.name}: there is no mechanism 'pres' (did you mean 'press'?). Known: press, a, b."),
    ("force: '${project.title}'", "6:27: mechanisms.b.force: ${project.title}: there is no mechanism 'project'. Known: press, a, b."),
    ("force: '${a.forc}'", "6:27: mechanisms.b.force: ${a.forc}: a has no 'forc' (did you mean 'force'?)."),
    ("force: '${a.force.x}'", "6:27: mechanisms.b.force: ${a.force.x}: a has no 'force.x' (did you mean 'force'?)."),
    ("force: '${a}'", "6:27: mechanisms.b.force: ${a} names no value; add an output or input, as in ${a.moment}."),
    ("force: '${}'", "6:27: mechanisms.b.force: ${}: there is no mechanism ''. Known: press, a, b."),
    ("force: '${a.arm}'", "6:27: mechanisms.b.force: ${a.arm} is in m; a quantity in kN is needed here"),
    ("force: '${press.name}'", "6:27: mechanisms.b.force: ${press.name} is not a number; a quantity in kN is needed"),
    ("force: '${a.torque}'", "6:27: mechanisms.b.force: ${a.torque} is a curve; a single number is needed here"),
    ("force: 1, speed: '${press.productivity}'", "6:37: mechanisms.b.speed: ${press.productivity} is in 1/s; a quantity in rpm is needed here"),
    ("force: 1, load: '${a.moment}'", "6:36: mechanisms.b.load: ${a.moment} is not a curve in N*m"),
    ("force: 1, load: [1, 2, 3, '${a.force}']",
     "6:46: mechanisms.b.load.3: ${a.force} is not a single quantity in N·m, as the other values are"),
    ("force: 1, remark: '${a.force}'", "6:38: mechanisms.b.remark: ${a.force} is a number in N; a text (Remark) is needed here"),
    ("force: 1, spring: '${a.force}'", "6:38: mechanisms.b.spring: ${a.force} is a number in N; a block of keys is needed here"),
    ("force: 1, arm: '${press.sheet}'",
     "6:35: mechanisms.b.arm: ${press.sheet} is a block or a list; refer to one of its values (length, width, thickness)."),
    ("force: 1, arm: '${press.sheet.width}'",
     "6:35: mechanisms.b.arm: ${press.sheet.width} is not given; it is optional. Give press.sheet.width, or write the value itself here."),
    ("force: 1, arm: '${a.width}'", "6:35: mechanisms.b.arm: ${a.width} is not given; it is optional. Give a.width, or write the value itself here."),
    ("force: 1, arm: '${a.pressure}'", "6:35: mechanisms.b.arm: ${a.pressure} is calculated only if width is given in a."),
    ("force: 1, arm: '${a.length}'", "6:35: mechanisms.b.arm: ${a.length} is calculated only if parts is given in a."),
    ("force: 1, arm: '${a.parts.0.length}'", "6:35: mechanisms.b.arm: ${a.parts.0.length} is not given; it is optional. Give a.parts.0.length,"),
    ("force: 1, arm: '${b.parts.2.length}', parts: [{length: 1}]",
     "6:35: mechanisms.b.arm: ${b.parts.2.length}: the list has 1 entries, counted from 0."),
    ("force: 'about ${a.force}'", "6:27: mechanisms.b.force: 'about' is not expected here; a value of the configuration stands as ${NAME.KEY}"),
    ("force: 1, remark: 'about ${a.force}'",
     "6:38: mechanisms.b.remark: “about ${a.force}” mixes a reference with text; a reference stands for a whole value, as in ${press.name}."),
    ("force: '${a.force'", "6:27: mechanisms.b.force: “${a.force” mixes a reference with text;"),
    ("force: 1, allowable_moment: '${b.moment}'",
     "6:48: mechanisms.b.allowable_moment: refers to itself: b.allowable_moment → b.moment → b.allowable_moment. Give one of"),
    ("force: 1, arm: '${b.arm}'", "6:35: mechanisms.b.arm: refers to itself: b.arm → b.arm. Give one of these inputs a value of its own."),
]  # fmt: skip


@pytest.mark.parametrize(("inner", "message"), WRONG, ids=[inner for inner, _ in WRONG])
def test_a_wrong_reference_is_told_with_its_place(tmp_path: Path, inner: str, message: str) -> None:
    found = problems(tmp_path, LEVER + f"  b: {{kind: lever, {inner}}}\n")
    assert [line[: len(message)] for line in found] == [message]


def test_every_loop_is_shown_whole(tmp_path: Path) -> None:
    text = HEAD + (
        "  a: {kind: lever, force: 1, allowable_moment: '${b.moment}'}\n"
        "  b: {kind: lever, force: 1, allowable_moment: '${c.moment}'}\n"
        "  c: {kind: lever, force: 1, allowable_moment: '${a.moment}'}\n"
        "  d: {kind: lever, force: 1, width: '${e.width}'}\n  e: {kind: lever, force: 1, width: '${d.width}'}\n"
    )
    around = "a.allowable_moment → b.moment → b.allowable_moment → c.moment → c.allowable_moment → a.moment → a.allowable_moment"
    assert problems(tmp_path, text) == [
        f"5:48: mechanisms.a.allowable_moment: refers to itself: {around}. Give one of these inputs a value of its own.",
        "8:37: mechanisms.d.width: refers to itself: d.width → e.width → d.width. Give one of these inputs a value of its own.",
    ]


def test_a_value_that_a_reference_brings_is_held_to_the_bounds(tmp_path: Path) -> None:
    taken = "  b: {kind: lever, force: 1, arm: '${press.sheet.length}'}\n"
    found = problems(tmp_path, LEVER + taken + "  c: {kind: lever, force: 1, teeth: '${b.arm}'}\n")
    assert found == ["7:37: mechanisms.c.teeth: ${b.arm} is in m; a quantity in 1 is needed here"]
    with pytest.raises(UserError) as caught:
        results(tmp_path, LEVER.replace("length: 700 mm", "length: 1.5 m") + taken)
    (problem,) = caught.value.problems
    assert (problem.line, problem.column, problem.path) == (6, 35, "mechanisms.b.arm")
    assert problem.message == "1500 mm (from press.sheet.length) is out of range; allowed: > 0 mm, ≤ 1000 mm"


def test_a_text_that_a_reference_brings_is_held_to_the_choices(tmp_path: Path) -> None:
    with pytest.raises(UserError) as caught:
        results(tmp_path, LEVER + "  b: {kind: lever, force: 1, grade: '${a.size}'}\n")
    assert [(p.path, p.message) for p in caught.value.problems] == [
        ("mechanisms.b.grade", "is “large”; allowed: fine, coarse")
    ]


def test_places_that_a_curve_crosses_are_referred_to_one_by_one(tmp_path: Path) -> None:
    cylinder = "cylinder_radius: 105 mm, cylinder_length: 700 mm, cylinder_mass: 80 kg, cylinder_inertia: 0.9 kg*m**2"
    text = HEAD + f"  d: {{kind: cylinder_drive, {cylinder}}}\n  b: {{kind: lever, force: '${{d.torque_reversal}}'}}\n"
    (problem,) = problems(tmp_path, text)
    assert "${d.torque_reversal} has several values; refer to one of them, as in ${d.torque_reversal_1}." in problem


# References to phases, ``${drive.phases.cutting}``, in a single run and in a study; what is wrong with them is told in words.


PLUGIN = '''
"""How long a phase of another mechanism lasts, as an angle."""

from typing import Any

import numpy as np

from diecut_report.api import Chapter, GivenPhase, Inputs, Mechanism, PhaseInput, computed


class Watch(Inputs):
    watched = PhaseInput("A", "deg", "What is watched")


def length(phase: GivenPhase) -> Any:
    count = phase.calculation.count
    return np.array([[sum(end - start for start, end in phase.intervals(row))] for row in range(count)])


chapter = Chapter("Watch")
chapter.length = computed(length, ("watched",), "sum of its intervals"), "l", "deg", "Length of the phase"
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
    told = found.results["eye"].inputs["watched"]
    assert (told.origin, told.path, told.value) == (
        "reference",
        "feeder.phases.dwell",
        "${feeder.phases.dwell}",
    )
    assert document(found).config.resolved["mechanisms"]["eye"]["watched"] == "${feeder.phases.dwell}"


def test_a_study_takes_the_phase_of_each_variant(tmp_path: Path, discovery: Discovery) -> None:
    base = run(tmp_path, discovery, "${feeder.phases.rest}", ", rest_tolerance: 0.1 mm").config
    tolerances = np.array([1e-4, 1e-3, 5e-3])
    asked = find_input(base, "mechanisms.feeder.rest_tolerance")
    rows = calculate_rows(base, {asked: tolerances}, 3)
    more = [f", rest_tolerance: {1e3 * each} mm" for each in tolerances]
    alone = [run(tmp_path, discovery, "${feeder.phases.rest}", each).calculations["eye"] for each in more]
    single = [float(each["length"][0, 0]) for each in alone]
    assert rows.columns["eye.length"] == pytest.approx(single, rel=1e-9)
    assert not rows.slow


FAULTS: dict[str, Any] = {
    "an unknown phase": ("${feeder.phases.dwel}", "names no phase: feeder has no phase 'dwel' (did you mean 'dwell'?)"),
    "a phase without its key": ("${feeder.phases.rest}", "exists only if rest_tolerance is given in feeder."),
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


@pytest.mark.parametrize(
    "block",
    [
        "{driver_teeth: {value: 18, basis: drawing}, driven_teeth: {value: 87, basis: drawing}}",
        "driver_teeth: {value: 18, basis: drawing}\n        driven_teeth: {value: 87, basis: drawing}",
    ],
)
def test_a_key_goes_into_a_block_whose_values_all_say_their_basis(block: str) -> None:
    tree = parse(f"mechanisms:\n  train:\n    gears:\n      - {block}\n", "a.yaml")
    found = rewritten(tree, {("mechanisms", "train", "gears", 0, "efficiency"): "0.978"})
    own = found.data["mechanisms"]["train"]["gears"][0]
    assert own["efficiency"] == 0.978 and own["driver_teeth"] == {"value": 18, "basis": "drawing"} and len(own) == 3
