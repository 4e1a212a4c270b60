"""One variant of a study as a configuration: calculated alone it gives the row that is stored, taken it keeps the base's text."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import pyarrow.parquet as pq
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from diecut_report.cli.main import main
from diecut_report.config import yaml
from diecut_report.config.loader import load_config
from diecut_report.config.plugins import Discovery
from diecut_report.config.yaml import Tree, as_text, with_values
from diecut_report.errors import UserError
from diecut_report.quantities.units import parse_quantity
from diecut_report.study import command
from diecut_report.study.analysis.variant_config import taken_config, variant_config
from diecut_report.study.execution import variant_reports
from diecut_report.study.storage.description import Kind, ResultColumn
from tests.configs import EXAMPLES, GOOD, HEAD, PLUGINS, saved
from tests.shared import once
from tests.study.stored_study import BORE, SPEED, ten, variants, written
from tests.study.studies import varied

SHARES = PLUGINS / "shares"
BASE = """\
schema_version: 1
project: {title: 2026, document_number: 0012, date: 2026-11-21}   # as typed
press: {name: P, productivity: 3600 1/h}
mechanisms:
  a: {kind: shares, share: 7, rate: '${press.productivity}', profile: [1, 2 %, '${b.share}', 4]}
  b: {kind: shares, force: '${a.force}', grade: "1e5"}
"""
STUDY = """\
schema_version: 1
base: press.yaml
sample: {method: latin_hypercube, count: 7, seed: 3}
vary:
  mechanisms.a.share: {from: 3, to: 90}
  mechanisms.b.share: [7 %, 100 %, 0.3]
  mechanisms.a.slope: {from: 1 mm/m, to: 0.07}
  mechanisms.a.ratio: {from: 0.3, to: 3}
  mechanisms.a.angle: {from: -80 deg, to: 80}
  mechanisms.a.turn: {from: 1 deg, to: 1 rad}
  mechanisms.b.speed: {from: 7, to: 700 rad/s}
  press.productivity: {from: 1000, to: 7000}
  mechanisms.a.force: {from: 1 N, to: 7 kN}
  mechanisms.b.length: {from: 7, to: 70}
  mechanisms.b.count: [1, 2, 30]
  mechanisms.b.grade: [fine, coarse, "1e5", "no"]
  mechanisms.a.hard: [true, false]
reports: [3]
"""


@pytest.fixture(scope="module")
def out(tmp_path_factory: pytest.TempPathFactory) -> Path:
    def make(folder: Path) -> None:
        saved(folder, BASE)
        study = saved(folder, STUDY, "study.yaml")
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(command, "summarise", lambda *_, **__: None)
            patch.setattr(variant_reports, "FORMATS", ("json",))
            assert main(["batch", str(study), "-o", str(folder / "out"), "--plugins", str(SHARES), "--quiet"]) in (0, 1)

    return once(tmp_path_factory, "study_of_shares", make) / "out"


def rows(out: Path) -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = pq.read_table(out / "variants").to_pylist()
    return found


def calc(config: object, capfd: pytest.CaptureFixture[str]) -> dict[str, Any]:
    assert main(["calc", str(config), "--plugins", str(SHARES), "--quiet"]) in (0, 1)
    found: dict[str, Any] = json.loads(capfd.readouterr().out)
    return found


def differences(row: dict[str, Any], results: dict[str, Any]) -> list[str]:
    """The inputs, outputs and verdicts of the results that are not those of the row."""
    found = []
    for name, mechanism in results["mechanisms"].items():
        known = {f"mechanisms.{name}.{key}": each["value"] for key, each in mechanism["inputs"].items()}
        known |= {f"{name}.{key}": each["value"] for key, each in mechanism["outputs"].items()}
        known |= {f"{name}.checks.{check['id']}.status": check["status"] for check in mechanism["checks"]}
        for key, value in known.items():
            stored = row.get(key, value)
            is_number = isinstance(stored, float)
            exact = 0.0 if key.startswith("mechanisms.") else 1e-12
            if not (math.isclose(stored, value, rel_tol=exact) if is_number else stored in (value, str(value).lower())):
                found.append(f"{key}: {stored} and {value}")
    return found


def test_each_variant_calculated_alone_gives_the_row_that_is_stored(
    out: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    assert [row["status"] for row in rows(out)].count("error") == 0
    assert len({row["mechanisms.b.share"] for row in rows(out)}) == 3
    for row in rows(out):
        assert differences(row, calc(f"{out}#{row['variant']}", capfd)) == []


def test_the_config_in_a_variants_report_can_be_run(
    out: Path, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    report = json.loads((out / "reports" / "3.json").read_text("utf-8"))
    project = report["project"]
    assert report["config"]["file"] == "3.yaml"
    assert (project["title"], project["document_number"]) == ("2026 – variant 3 of study", "0012/V3")
    assert calc(saved(tmp_path, report["config"]["source_text"], "3.yaml"), capfd) == report


def test_a_fault_of_a_variant_names_the_base_that_is_kept(
    out: Path, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    plugin = (SHARES / "shares.py").read_text("utf-8")
    saved(tmp_path, plugin.replace('"Share", gt=0, le=100, default=5)', '"Share", gt=0, le=1, default=1)'), "shares.py")
    assert main(["calc", f"{out}#0", "--plugins", str(tmp_path), "--quiet"]) == 2
    warning, told = capfd.readouterr().err.splitlines()[:2]
    assert warning.startswith("warning: The source of the plugin shares is not what the study was calculated by")
    share = rows(out)[0]["mechanisms.a.share"]
    assert told.startswith(f"{out / 'base.yaml'}:5:28: mechanisms.a.share: {share * 100:.6g}"[:-4])
    assert "is out of range; allowed: > 0 %, ≤ 1 %" in told


@pytest.mark.usefixtures("without_summary")
def test_a_value_that_the_base_gives_in_a_list_stands_in_that_list(tmp_path: Path) -> None:
    text = next(path for path in EXAMPLES if path.stem == "platen_press_zppt30").read_text("utf-8")
    saved(tmp_path, text.replace("friction: 0.1 ", "friction: [0.1, 0.11, 0.12, 0.13] "))
    study = saved(tmp_path, varied("[0.02, 0.04]", path="mechanisms.platen.friction_platen_pin"), "study.yaml")
    assert main(["batch", str(study), "-o", str(tmp_path / "out"), "--quiet"]) in (0, 1)
    config = load_config(variant_config(tmp_path / "out", 1, Discovery([]), "one.yaml"), Discovery([]))
    given = config.instances["platen"]
    assert given is not None
    assert [given.data[f"friction_{name}"] for name in ("guide", "platen_pin", "journal")] == [0.1, 0.04, 0.13]


texts = st.text(st.characters(codec="utf-8", exclude_categories=("Cs", "Cc", "Cf")), max_size=12)
texts = texts.filter(lambda text: not yaml.FORBIDDEN.search(text))  # which are refused, by tests of their own
WORDS = ["", "~", "null", "yes", "1e5", "0012", "089", "1:30", "0x10", ".5", "- a", "a: b", "# no",
         "<<", "*a", "&a", "é · °", " x ", "a\nb\n", "%"]  # fmt: skip
words = st.sampled_from(WORDS)
keys = st.text("abcxyz_", min_size=1, max_size=4)
scalars = st.none() | st.booleans() | st.integers() | st.floats(allow_nan=False, allow_infinity=False) | texts | words
trees = st.dictionaries(
    keys,
    st.recursive(
        scalars, lambda inner: st.lists(inner, max_size=3) | st.dictionaries(keys, inner, max_size=3), max_leaves=8
    ),
    min_size=1,
)


@given(data=trees)
@example(data={"a": "1e5", "b": [], "c": {}, "d": None, "e": [[1], {"f": "no"}]})
def test_a_tree_as_text_reads_back_as_the_same_tree(data: dict[str, Any]) -> None:
    root = yaml.parse(json.dumps(data, ensure_ascii=False), "test").root
    assert yaml.parse(as_text(root), "again").data == yaml.parse(json.dumps(data, ensure_ascii=False), "test").data


def test_plain_scalars_stay_as_they_were_typed() -> None:
    typed = "number: 0012\nsize: 1e5\nis_hard: True\nday: 2026-11-21\nword: yes\n"
    assert as_text(yaml.parse(typed, "test").root) == typed


def test_blocks_that_are_missing_are_made_at_the_place_of_their_parent() -> None:
    tree = yaml.parse("a:\n  b: 1\n", "base.yaml")
    changed = with_values(tree, {("a", "c", "d"): "2 mm"}, "new.yaml", "Changed")
    assert changed.data == {"a": {"b": 1, "c": {"d": "2 mm"}}} and tree.data == {"a": {"b": 1}}
    assert changed.position(("a", "c", "d")) == (2, 3)
    assert changed.text == "# Changed\na:\n  b: 1\n  c:\n    d: 2 mm\n"


def test_two_variants_are_held_against_each_other(out: Path, capfd: pytest.CaptureFixture[str]) -> None:
    asked = ["diff", f"{out}#0", f"{out}#1", "--format", "json", "--plugins", str(SHARES), "--quiet"]
    assert main(asked) in (0, 1)
    found = json.loads(capfd.readouterr().out)
    changed = {row["path"]: [row[side]["value"] for side in ("old", "new") if row[side]] for row in found["inputs"]}
    for path in ("mechanisms.a.share", "mechanisms.b.length"):
        assert changed[path.removeprefix("mechanisms.")] == pytest.approx([row[path] for row in rows(out)[:2]])
    assert found["old"]["file"] == "out-0.yaml" and found["new"]["file"] == "out-1.yaml"


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return ten(tmp_path_factory.mktemp("taken") / "out")


# --- the configuration of a variant ----------------------------------------------------------------------------------


def taken(folder: Path, variant: int) -> Tree:
    """The configuration of a variant; what it is as text reads back as the same."""
    tree = variant_config(folder, variant, Discovery([]), f"study-{variant}.yaml")
    assert yaml.parse(tree.text, "variant").data == tree.data
    return tree


def test_a_variants_configuration_is_the_base_with_its_values(folder: Path) -> None:
    tree = taken(folder, 4)
    base, data = yaml.load(folder / "base.yaml").data, tree.data
    assert tree.text.startswith("# Variant 4 of study.yaml: ")
    assert (tree.name, tree.file) == ("study-4.yaml", str(folder / "base.yaml"))
    assert data["mechanisms"]["cylinder"].pop("bore_radius") == "65 mm"
    speed = data["mechanisms"]["drive"].pop("crank_speed")
    assert speed.endswith(" rpm") and parse_quantity(speed, "rpm") == 2 * math.pi / 60 * 50
    del base["mechanisms"]["cylinder"]["bore_radius"], base["mechanisms"]["drive"]["crank_speed"]
    assert data.pop("project") == {"title": "Two mechanisms – variant 4 of study"}
    del base["project"]
    assert data == base
    path = ("mechanisms", "cylinder", "bore_radius")  # its problems name the line of the base
    assert tree.position(path) == (9, 18)
    assert tree.typed(path) == "65 mm"
    assert tree.position(("mechanisms", "cylinder", "segment_height")) == (10, 21)


BASES: dict[str, tuple[str, Kind, Any, Any]] = {
    "lists and blocks": ("mechanisms.drive.gears.1.driver_teeth", "int", 24, 24),
    "a flow block in a list": ("mechanisms.drive.gears.0.driver_teeth", "float", 24.0, 24),
    "a key in %": ("mechanisms.drive.slip", "float", 0.07, "7 %"),
    "a key in %, 100 of them": ("mechanisms.drive.slip", "float", 1.0, "100 %"),
    "a key that the base leaves out": ("mechanisms.drive.n_points", "int", 720, 720),
    "a field of the press": ("press.sheet.thickness", "float", 0.0008, "0.8 mm"),
    "a block that the base leaves out": ("press.rollers.first.width", "float", 0.5, "500 mm"),
    "a text": ("mechanisms.drive.motion_law", "text", "modified_sine", "modified_sine"),
    "a text that looks like a number": ("mechanisms.drive.motion_law", "text", "12", "12"),
}


@pytest.mark.parametrize("name", BASES)
def test_a_value_goes_where_its_path_leads(tmp_path: Path, name: str) -> None:
    path, kind, value, expected = BASES[name]
    column = ResultColumn(path, kind, "m" if path.startswith("press") else "1", "%" if path.endswith("slip") else "")
    out = written(tmp_path / "out", [column], {path: [value], "status": ["pass"]}, varied=[path])
    data = taken(out, 0).data
    for key in path.split("."):
        data = data[int(key)] if key.isdecimal() else data[key]
    assert data == expected and type(data) is type(expected)


def test_a_value_beside_an_anchor_changes_one_place_only(tmp_path: Path) -> None:
    base = "mechanisms:\n  a: &a {bore_radius: 70 mm}\n  cylinder: *a\n"
    out = ten(tmp_path / "out", varied=[BORE], base=base)
    data = taken(out, 3).data
    assert data["mechanisms"] == {"a": {"bore_radius": "70 mm"}, "cylinder": {"bore_radius": "65 mm"}}


def test_a_variant_that_is_not_stored_is_told(folder: Path) -> None:
    with pytest.raises(UserError, match=r"no variant 17 here.*0 … 9"):
        taken(folder, 17)


# --- taken for a file of its own ---


def test_its_values_are_read_back_as_those_that_were_calculated_and_all_else_stays(folder: Path) -> None:
    text = taken_config(folder, 4, Discovery([]))[0].decode()
    (row,) = json.loads("".join(variants(folder, "variant = 4", format="json")))["variants"]
    data = yaml.parse(text, "taken").data["mechanisms"]
    assert parse_quantity(data["cylinder"]["bore_radius"], "mm") == row[BORE]
    assert parse_quantity(data["drive"]["crank_speed"], "rpm") == row[SPEED]  # a reference stood there
    base = (folder / "base.yaml").read_text("utf-8").splitlines()
    heading, *lines = text.splitlines()
    changed = [(old, new) for old, new in zip(base, lines, strict=True) if old != new]
    assert heading == "# Variant 4 of study.yaml" and len(changed) == 2
    assert all(old.partition("#")[2] == new.partition("#")[2] for old, new in changed)
    rounded = taken_config(folder, 4, Discovery([]), digits=2)[0].decode()
    data = yaml.parse(rounded, "taken").data["mechanisms"]
    assert (data["cylinder"]["bore_radius"], data["drive"]["crank_speed"]) == ("65 mm", "50 rpm")


def test_the_command_writes_it_and_tells_how_the_study_judged_it(
    folder: Path, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    assert main(["take", f"{folder}#4", "-o", str(tmp_path / "mine.yaml")]) == 0
    assert "in the study: fail, governed by drive.checks.play" in capfd.readouterr().err
    assert (tmp_path / "mine.yaml").read_bytes() == taken_config(folder, 4, Discovery([]))[0]
    assert main(["take", f"{folder}#4", "-o", "-"]) == 0
    assert capfd.readouterr().out.encode() == (tmp_path / "mine.yaml").read_bytes()


@pytest.mark.parametrize(
    ("number", "words"), [("#99", "no variant 99"), ("#9", "leaves no wall"), ("", "names no variant")]
)
def test_what_cannot_be_taken_is_told(
    folder: Path, tmp_path: Path, capfd: pytest.CaptureFixture[str], number: str, words: str
) -> None:
    assert main(["take", f"{folder}{number}", "-o", str(tmp_path / "never.yaml")]) == 2
    assert words in capfd.readouterr().err and not (tmp_path / "never.yaml").exists()


@pytest.mark.parametrize(
    "name", ["base.yaml", "study.json", "study.yaml", "variants/part-00000.parquet", "variants/x.csv"]
)
def test_what_the_study_has_stored_is_not_written_over(
    folder: Path, capfd: pytest.CaptureFixture[str], name: str
) -> None:
    before = {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}
    assert main(["take", f"{folder}#4", "-o", str(folder / name)]) == 2
    assert main(["variants", str(folder), "--format", "csv", "-o", str(folder / name)]) == 2
    told = capfd.readouterr().err
    assert told.count("Choose another place with -o.") == 2
    assert {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()} == before


def test_what_the_study_was_made_of_is_not_written_over(
    folder: Path, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    base = tmp_path / "my_press.yaml"
    base.write_bytes((folder / "base.yaml").read_bytes())
    assert main(["take", f"{folder}#4", "-o", str(base)]) == 2
    assert "of which the study was made, and would be overwritten" in capfd.readouterr().err
    assert base.read_bytes() == (folder / "base.yaml").read_bytes()


@pytest.mark.usefixtures("without_summary")
def test_a_stored_variant_is_solved_and_written_with_what_was_found(tmp_path: Path) -> None:
    saved(tmp_path, HEAD + "  a: {kind: lever, force: 2 kN, arm: 100 mm, allowable_moment: 250 N*m}  # the lever\n")
    study, variant = saved(tmp_path, varied("[1 kN, 3 kN]"), "study.yaml"), f"{tmp_path / 'out'}#1"
    plugins = ("--plugins", str(GOOD))
    assert main(["batch", str(study), "-o", str(tmp_path / "out"), *plugins]) == 1
    target, asked = tmp_path / "solved.yaml", ("--vary", "a.arm", "--for", "a.moment = 240 N*m")
    assert main(["solve", variant, *asked, "-o", str(target), *plugins]) == 0
    found = yaml.load(target)
    assert found.data["mechanisms"]["a"] | {"force": "3 kN", "arm": "80 mm"} == found.data["mechanisms"]["a"]
    assert "those that were calculated" not in found.text
    assert main(["advise", variant, "-o", str(tmp_path / "mended.yaml"), *plugins]) == 0
