"""From a study to one of its variants and back: the config of a variant, calculated alone, gives the row that is stored."""

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
from diecut_report.config.yaml import as_text, with_values
from diecut_report.study import command
from diecut_report.study.analysis.variant_config import variant_config
from diecut_report.study.execution import variant_reports
from tests.configs import EXAMPLES, PLUGINS, saved
from tests.shared import once

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
    assert report["config"]["file"] == "3.yaml"
    assert (report["project"]["title"], report["project"]["document_number"]) == (
        "2026 – variant 3 of study",
        "0012/V3",
    )
    again = calc(saved(tmp_path, report["config"]["source_text"], "3.yaml"), capfd)
    assert again == report


def test_a_fault_of_a_variant_names_the_base_that_is_kept(
    out: Path, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    plugin = (
        (SHARES / "shares.py").read_text("utf-8").replace('"Share", gt=0, le=100)] = 5', '"Share", gt=0, le=1)] = 1')
    )
    saved(tmp_path, plugin, "shares.py")
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
    path = "mechanisms.platen.friction_platen_pin"
    study = f"schema_version: 1\nbase: press.yaml\nsample: {{method: grid}}\nvary: {{{path}: [0.02, 0.04]}}\n"
    assert main(["batch", str(saved(tmp_path, study, "study.yaml")), "-o", str(tmp_path / "out"), "--quiet"]) in (0, 1)
    config = load_config(variant_config(tmp_path / "out", 1, Discovery([]), "one.yaml"), Discovery([]))
    given = config.instances["platen"]
    assert given is not None and [given.data[f"friction_{name}"] for name in ("guide", "platen_pin", "journal")] == [
        0.1,
        0.04,
        0.13,
    ]


texts = st.text(st.characters(codec="utf-8", exclude_categories=("Cs", "Cc")), max_size=12)
words = st.sampled_from(
    [
        "",
        "~",
        "null",
        "yes",
        "1e5",
        "0012",
        "089",
        "1:30",
        "0x10",
        ".5",
        "- a",
        "a: b",
        "# no",
        "<<",
        "*a",
        "&a",
        "é · °",
        " x ",
        "a\nb\n",
        "%",
    ]
)
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
    first, second = (rows(out)[number] for number in (0, 1))
    assert main(["diff", f"{out}#0", f"{out}#1", "--format", "json", "--plugins", str(SHARES), "--quiet"]) in (0, 1)
    found = json.loads(capfd.readouterr().out)
    changed = {
        row["path"]: (row["old"]["value"], row["new"]["value"]) for row in found["inputs"] if row["old"] and row["new"]
    }
    for path in ("mechanisms.a.share", "mechanisms.b.length"):
        assert changed[path.removeprefix("mechanisms.")] == pytest.approx((first[path], second[path]))
    assert found["old"]["file"] == "out-0.yaml" and found["new"]["file"] == "out-1.yaml"
