"""Tables of a user's own beside the configuration: what they give, what is printed of them, and what is wrong with one."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from diecut_report.config.own_tables import MAX_FILES
from diecut_report.config.plugins import Discovery
from diecut_report.config.schema import config_schema
from diecut_report.config.yaml import MAX_BYTES
from diecut_report.errors import UserError
from diecut_report.plugins.shaft import MECHANISM
from diecut_report.press import Press
from diecut_report.results.model import ResultsRecord
from diecut_report.study.definition.study_file import load_study
from diecut_report.study.execution.study_run import contents
from diecut_report.study.execution.worker import Chunk, calculate, load
from tests.configs import saved

TABLES = """\
source: Works standard 12, 2024
steels:
  own:
    source: Saarstahl, sheet 34CrNiMo6, 2021
    strengths:
      - {diameter: 40 mm, tensile_strength: 1100 MPa, yield_strength: 900 MPa, fatigue_strength: 500 MPa}
      - {diameter: 100 mm, tensile_strength: 1000 MPa, yield_strength: 800 MPa, fatigue_strength: 450 MPa}
gear_materials:
  18CrNiMo7-6: {sigma_h_lim: {value: 1500 MPa, basis: standard, note: grade MQ}, sigma_f_lim: 500 MPa}
chains:
  strong: {pitch: 19.05 mm, pin_diameter: 5.72 mm, bearing_area: 89 mm**2, breaking_load: 35 kN, mass_per_length: 1.3 kg/m}
keys:
  wide: {width: 18 mm, height: 10 mm, depth_shaft: 6 mm, depth_hub: 4.3 mm, yield_key: 450 MPa}
"""
SHAFT = """\
  shaft:
    kind: shaft
    sections: [{length: 200 mm, diameter: 40 mm}, {length: 100 mm, diameter: 35 mm}]
    bearing_a: 20 mm
    bearing_b: 180 mm
    material: own
    loads:
      - {name: wheel, position: 280 mm, force_y: 2 kN, torque: 100 N*m}
      - {name: pulley, position: 100 mm, torque: balance}
"""
OTHERS = """\
  gears: {kind: gear_pair, module: 4 mm, teeth_1: 20, teeth_2: 40, face_width: 40 mm, torque: 300, material_1: 18CrNiMo7-6, material_2: 18CrNiMo7-6}
  chain: {kind: roller_chain, chain: strong, teeth_1: 19, center_distance: 600 mm, speed: 300 rpm, torque: 200 N*m, application_factor: 1.2}
  key: {kind: parallel_key, key: wide, shaft_diameter: 55 mm, torque: 400 N*m, application_factor: 1.2, yield_shaft: 650 MPa, yield_hub: 370 MPa}
"""
HEAD = """\
schema_version: 1
project: {title: Own tables}
press: {name: P}
materials: steels.yaml
mechanisms:
"""
DISCOVERY = Discovery([])
NOTE = "own, steels.yaml: Saarstahl, sheet 34CrNiMo6, 2021"


def results(folder: Path, config: str, tables: str = TABLES) -> ResultsRecord:
    """The results of a configuration with its tables beside it."""
    saved(folder, tables, "steels.yaml")
    return Press.read(saved(folder, config), DISCOVERY).calculate().results


def problems(folder: Path, config: str = HEAD + SHAFT, tables: str = TABLES) -> list[str]:
    """What is wrong with both, by file, line, column and key."""
    with pytest.raises(UserError) as found:
        results(folder, config, tables)
    return [str(problem).replace(f"{folder}{os.sep}", "") for problem in found.value.problems]


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> ResultsRecord:
    return results(tmp_path_factory.mktemp("own"), HEAD + SHAFT + OTHERS)


@pytest.mark.parametrize(
    ("mechanism", "key", "value", "basis", "note"),
    [
        ("shaft", "strengths.1.tensile_strength", 1000e6, "catalogue", NOTE),
        ("gears", "sigma_h_lim_1", 1500e6, "standard", "grade MQ"),
        ("gears", "sigma_f_lim_2", 500e6, "catalogue", "18CrNiMo7-6, steels.yaml: Works standard 12, 2024"),
        ("chain", "breaking_load", 35e3, "catalogue", "strong, steels.yaml: Works standard 12, 2024"),
        ("key", "width", 18e-3, "catalogue", "wide, steels.yaml: Works standard 12, 2024"),
    ],
)
def test_an_entry_gives_its_values_with_their_source(
    made: ResultsRecord, mechanism: str, key: str, value: float, basis: str, note: str
) -> None:
    found = made.mechanisms[mechanism].inputs[key]
    assert (found.value, found.basis, found.note) == (pytest.approx(value), basis, note)


def test_the_source_of_a_table_stands_among_those_of_the_mechanism(made: ResultsRecord) -> None:
    assert made.mechanisms["shaft"].sources[-1].data() == {
        "id": "steels.yaml",
        "citation": NOTE.replace(", steels.yaml", ""),
    }


def test_the_results_hold_the_tables_with_their_hash(made: ResultsRecord, tmp_path: Path) -> None:
    (found,) = made.config.materials
    assert (found.file, found.source_text) == ("steels.yaml", TABLES)
    other = results(tmp_path, HEAD + SHAFT, TABLES + "# changed\n").config.materials[0].sha256
    assert other != found.sha256


def test_results_without_tables_say_nothing_of_them(tmp_path: Path) -> None:
    config = (HEAD + SHAFT).replace("materials: steels.yaml\n", "").replace("material: own", "material: C45E+QT")
    assert "materials" not in results(tmp_path, config).config.data()


@pytest.mark.parametrize(
    ("diameter", "tensile", "fatigue"), [(40, 1100e6, 500e6), (40.1, 1000e6, 450e6), (100, 1000e6, 450e6)]
)
def test_a_steel_has_the_strengths_of_the_least_size_that_holds_the_shaft(
    tmp_path: Path, diameter: float, tensile: float, fatigue: float
) -> None:
    found = results(tmp_path, (HEAD + SHAFT).replace("diameter: 40 mm", f"diameter: {diameter} mm"))
    outputs = found.mechanisms["shaft"].outputs
    assert outputs["tensile_strength"].value == pytest.approx(tensile)
    assert outputs["specimen_endurance"].value == pytest.approx(fatigue)


def test_without_a_fatigue_strength_it_is_half_the_tensile_strength(tmp_path: Path) -> None:
    tables = TABLES.replace(", fatigue_strength: 500 MPa", "").replace(", fatigue_strength: 450 MPa", "")
    found = results(tmp_path, HEAD + SHAFT, tables).mechanisms["shaft"].outputs["specimen_endurance"].value
    assert found == pytest.approx(550e6)


def test_what_the_block_gives_itself_stays(tmp_path: Path) -> None:
    config = HEAD + OTHERS.replace("chain: strong", "chain: strong, breaking_load: 20 kN")
    assert results(tmp_path, config).mechanisms["chain"].inputs["breaking_load"].value == 20e3


def test_the_resolved_configuration_needs_no_table(made: ResultsRecord) -> None:
    resolved = made.config.resolved["mechanisms"]["shaft"]
    assert "material" not in resolved and len(resolved["strengths"]) == 2


def test_several_files_are_read(tmp_path: Path) -> None:
    (tmp_path / "data").mkdir()
    first, second = TABLES.split("gear_materials:")
    saved(tmp_path / "data", "source: Works\ngear_materials:" + second, "gears.yml")
    config = HEAD.replace("steels.yaml", "[steels.yaml, data/gears.yml]") + SHAFT + OTHERS
    assert [each.file for each in results(tmp_path, config, first).config.materials] == [
        "steels.yaml",
        "data/gears.yml",
    ]


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("yield_strength: 900 MPa", "yield_strength: 900 kg", "steels.yaml:6:71: steels.own.strengths.0.yield_strength: 900 kg is a mass"),
        ("yield_strength: 900 MPa", "yield_strenght: 900 MPa", "(did you mean 'yield_strength'?)"),
        (", yield_strength: 900 MPa", "", "steels.own.strengths.0.yield_strength: is missing"),
        ("tensile_strength: 1100 MPa", "tensile_strength: 11000 MPa", "steels.own.strengths.0.tensile_strength: 11000 MPa is out of range"),
        ("diameter: 40 mm", "diameter: 4e9 mm", "is not plausible"),
        ("    strengths:", "    strength:", "steels.yaml:5:5: steels.own.strength: is an unknown key (did you mean 'strengths'?)"),
        ("source: Works standard 12, 2024\n", "", "has no source"),
        ("source: Works standard 12, 2024", "source: ''", "steels.yaml:1:9: source: is “”; a text is needed"),
        ("source: Works standard 12, 2024", "source: '.'", "steels.yaml:1:9: source: is “.”; a text is needed"),
        ("steels:\n  own:", "stels:\n  own:", "is “own”; allowed: 42CrMo4+QT, C45E+QT, C45E+N"),
        ("  own:", "  'c45E +QT':", "is nearly named as the standard C45E+QT, which is taken where that is named"),
        ("  own:", "  \u042145E+QT:", "is nearly named as the standard C45E+QT"),  # a Cyrillic letter
        ("chains:", "chans:", "chans: is a table that no kind takes (did you mean 'chains'?); there are chains, gear_materials, keys, steels"),
        ("  own:", "  owm:", "is “own” (did you mean 'owm'?); allowed: 42CrMo4+QT, C45E+QT, C45E+N, owm"),
        ("sigma_f_lim: 500 MPa", "sigma_f_lim: '${press.name}'", "a table holds values, and no references"),
        ("keys:", "keys: 3\nother:", "is 3; entries by their names are needed"),
        ("900 MPa, fatigue_strength: 500 MPa", "900 MPa", "gives the fatigue strength of some diameters"),
        ("diameter: 40 mm", "diameter: 140 mm", "are not in the order of their diameters"),
        ("diameter: 100 mm", "diameter: 39.9 mm", "are not in the order of their diameters"),
        ("fatigue_strength: 500 MPa", "fatigue_strength: 1200 MPa", "not below the tensile strength"),
    ],
)  # fmt: skip
def test_what_is_wrong_with_a_table_is_told_with_its_place(tmp_path: Path, old: str, new: str, words: str) -> None:
    assert any(words in found for found in problems(tmp_path, tables=TABLES.replace(old, new, 1)))


def test_a_shaft_beyond_the_sizes_of_its_steel_is_refused(tmp_path: Path) -> None:
    config = (HEAD + SHAFT).replace("diameter: 40 mm", "diameter: 120 mm")
    assert "are known up to 100 mm, but the shaft has 120 mm" in problems(tmp_path, config)[0]


def test_entries_that_nothing_takes_are_judged_too(tmp_path: Path) -> None:
    tables = TABLES.replace("gear_materials:", "  unused: {strengths: [{diameter: 1 kg}]}\ngear_materials:")
    assert any(
        "steels.unused.strengths.0.diameter: 1 kg is a mass" in found for found in problems(tmp_path, tables=tables)
    )


def test_a_faulty_entry_is_told_once(tmp_path: Path) -> None:
    tables = TABLES.replace("diameter: 40 mm", "diameter: -40 mm")
    assert len([found for found in problems(tmp_path, tables=tables) if "-40 mm" in found]) == 1


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("../steels.yaml", "tables lie beside the configuration"),
        ("/etc/passwd", "tables lie beside the configuration"),
        ("'C:\\steels.yaml'", "tables lie beside the configuration"),
        ("steels.csv", "a YAML file is needed"),
        ("other.yaml", "there is no file"),
        ("folder.yaml", "This is a folder"),
        ("pipe.yaml", "This is a pipe"),
        ("large.yaml", "The file is too large"),
        ("list.yaml", "The file holds a list"),
        ("3", "materials: is 3; the name of a YAML file is needed"),
        ("[steels.yaml, [4]]", "materials.1: is a list; the name of a YAML file is needed"),
        ("[steels.yaml, again.yaml]", "stands in steels.yaml too"),
        (str(["steels.yaml"] * (MAX_FILES + 1)), f"at most {MAX_FILES} are allowed"),
    ],
)
def test_a_file_that_cannot_be_a_table_is_refused(tmp_path: Path, name: str, words: str) -> None:
    (tmp_path / "folder.yaml").mkdir()
    os.mkfifo(tmp_path / "pipe.yaml")
    saved(tmp_path, " " * (MAX_BYTES + 1), "large.yaml")
    saved(tmp_path, "[1, 2]", "list.yaml")
    saved(tmp_path, TABLES, "again.yaml")
    config = HEAD.replace("steels.yaml", name) + SHAFT
    assert any(words in each for each in problems(tmp_path, config))


def test_an_unknown_entry_of_a_key_without_texts_of_its_own_is_told(tmp_path: Path) -> None:
    config = HEAD + OTHERS.replace("material_1: 18CrNiMo7-6", "material_1: 18CrNiMo7")
    assert any(
        "is “18CrNiMo7” (did you mean '18CrNiMo7-6'?); gear_materials has 18CrNiMo7-6" in each
        for each in problems(tmp_path, config)
    )
    alone = HEAD.replace("materials: steels.yaml\n", "") + OTHERS
    assert any("there is no table gear_materials of your own" in each for each in problems(tmp_path, alone))


def test_a_steel_with_strengths_beside_it_is_refused(tmp_path: Path) -> None:
    config = HEAD + SHAFT.replace(
        "material: own", "material: own\n    tensile_strength: 900 MPa\n    yield_strength: 600 MPa"
    )
    assert any("only one can hold" in each for each in problems(tmp_path, config))


def test_the_schema_lets_a_key_name_an_entry() -> None:
    schema = config_schema({"shaft": MECHANISM}, {})
    assert "materials" in schema["properties"]
    allowed = schema["$defs"]["shaft"]["properties"]["material"]["anyOf"][0]["anyOf"][0]["anyOf"]
    assert {"type": "string", "maxLength": 500} in allowed


# --- studies ------------------------------------------------------------------------------------------------------------

STUDY = """\
schema_version: 1
base: press.yaml
sample: {method: grid}
vary:
  mechanisms.shaft.material: [42CrMo4+QT, own]
  mechanisms.chain.chain: [12B, strong]
"""


@pytest.fixture
def study_folder(tmp_path: Path) -> Path:
    saved(tmp_path, TABLES, "steels.yaml")
    saved(tmp_path, HEAD + SHAFT + OTHERS)
    return tmp_path


def test_a_study_varies_between_standard_materials_and_own_ones(study_folder: Path) -> None:
    study = load_study(saved(study_folder, STUDY, "study.yaml"), DISCOVERY)
    columns = calculate(study, Chunk(0, 0, 4)).columns
    assert [round(each / 1e6) for each in columns["shaft.tensile_strength"]] == [1000, 1000, 1100, 1100]
    ratio = columns["chain.safety_static"][1] / columns["chain.safety_static"][0]
    assert ratio == pytest.approx(35 / 28.9, rel=2e-3)  # the breaking loads; the masses differ a little
    assert list(columns["error"]) == [None] * 4


def test_a_worker_elsewhere_gets_the_tables_too(study_folder: Path) -> None:
    study = load_study(saved(study_folder, STUDY, "study.yaml"), DISCOVERY)
    assert set(study.tables) == {"steels.yaml"}
    away = load(Path(study.tree.file).read_bytes(), contents(study), [], study.base.source_hashes)
    assert away.base.tables["steels.yaml"].sha256 == study.base.tables["steels.yaml"].sha256


def test_a_study_refuses_a_material_that_is_in_no_table(study_folder: Path) -> None:
    with pytest.raises(UserError, match="allowed: 42CrMo4\\+QT, C45E\\+QT, C45E\\+N, own"):
        load_study(saved(study_folder, STUDY.replace("QT, own", "QT, owm"), "study.yaml"), DISCOVERY)
