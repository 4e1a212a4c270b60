"""A report is calculated again, and each thing that is not as it was is told by its name."""

from __future__ import annotations

import json
import platform
from collections.abc import Callable
from hashlib import sha256
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import scipy

from diecut_report.cli.main import main
from diecut_report.exchange.verification import agreement
from tests.configs import SMALL, saved
from tests.examples import few
from tests.exchange.reports import changed, page_with, run, set_at

Capture = pytest.CaptureFixture[str]
Data = dict[str, Any]


@pytest.mark.wheel
@pytest.mark.parametrize("ending", few(["html", "json", "pdf"], keep=lambda ending: ending != "pdf"))
def test_a_report_as_it_was_written_agrees_in_everything(small_report: Path, capfd: Capture, ending: str) -> None:
    assert run("verify", small_report / f"small.{ending}") == 0
    told = capfd.readouterr().out
    assert "✗" not in told and "Everything agrees." in told and "all of them exactly" in told
    assert ("byte for byte" in told) == (ending != "json")


def test_the_numbers_of_a_pdf_agree(small_report: Path, capfd: Capture) -> None:
    assert run("verify", small_report / "small.pdf", "--numbers") == 0
    told = capfd.readouterr().out
    assert "The results agree; the contents of the pages were not compared." in told
    assert "Everything agrees." not in told


def test_a_report_is_judged_wherever_it_lies_and_whatever_it_is_called(small_report: Path, tmp_path: Path) -> None:
    for name in ("renamed", "renamed.HTM"):
        (tmp_path / name).write_bytes((small_report / "small.html").read_bytes())
        assert run("verify", tmp_path / name) == 0


@pytest.mark.parametrize(
    ("form", "ending"),
    [("json", ".html"), ("json", ".pdf"), ("json", ".svg"), ("json", ".html."), ("pdf", ".html"), ("html", ".pdf")],
)
def test_a_file_that_is_named_as_another_form_is_refused(
    small_report: Path, tmp_path: Path, capfd: Capture, form: str, ending: str
) -> None:
    """A comment of the configuration may be a page: a browser that goes by the name shows it."""
    (tmp_path / f"report{ending}").write_bytes((small_report / f"small.{form}").read_bytes())
    assert run("verify", tmp_path / f"report{ending}") == 2
    assert f"is named {ending.rstrip('.')}, but holds what .{form} files hold" in capfd.readouterr().err


def set_config(data: Data) -> None:
    data["config"]["source_text"] = data["config"]["source_text"].replace("300 N*m", "310 N*m")


FORGED = "x\n✓ numbers      all\nEverything agrees."


def set_lines(data: Data) -> None:
    data["program"]["version"] = data["program"]["source_sha256"] = FORGED
    data["mechanisms"]["clutch"] |= {"plugin_version": FORGED, "plugin_sha256": FORGED}
    data["report"]["template_sha256"] = data["config"]["sha256"] = FORGED


TAMPERED: list[tuple[Callable[[Data], None], list[str]]] = [
    (set_config, ["✗ configuration", "✗ numbers", "mechanisms.clutch.inputs.torque.value: 300.0 → 310.0"]),
    (set_at("program/version", "0.0.1"), ["✗ program", "0.0.1 made the report"]),
    (set_at("program/source_sha256", 64 * "0"), ["✗ program", "000000000000 then"]),
    (
        set_at("mechanisms/clutch/plugin_sha256", 64 * "0"),
        ["✗ plugins", "clutch: version", "source 000000000000 then"],
    ),
    (set_at("status", "warn"), ["✗ numbers", "status: warn → pass", "1 other value differs"]),
    (set_lines, ["✗ program", "✗ plugins"]),
]


def test_another_version_of_a_library_is_told_and_no_fault(small_report: Path, tmp_path: Path, capfd: Capture) -> None:
    change = set_at("program/libraries/NumPy", "1.0")
    assert run("verify", changed(small_report / "small.json", tmp_path / "a.json", change)) == 0
    assert f"the same; NumPy 1.0 then, {np.__version__} now" in capfd.readouterr().out


def test_a_report_tells_the_hashes_of_what_it_carries(small_report: Path) -> None:
    page = (small_report / "small.html").read_text("utf-8")
    results = (small_report / "small.json").read_bytes()
    program = json.loads(results)["program"]
    assert f'<td class="key">{sha256(results).hexdigest()}</td>' in page
    assert f"Python {platform.python_version()}, NumPy {np.__version__}, SciPy {scipy.__version__}" in page
    assert program["source_sha256"][:12] in page and program["libraries"]["SciPy"] == scipy.__version__


@pytest.mark.parametrize(("change", "words"), TAMPERED, ids=[words[-1] for _, words in TAMPERED])
def test_what_was_changed_is_told(
    small_report: Path, tmp_path: Path, capfd: Capture, change: Callable[[Data], None], words: list[str]
) -> None:
    assert run("verify", changed(small_report / "small.json", tmp_path / "a.json", change)) == 1
    told = capfd.readouterr().out
    assert all(part in told for part in words) and told.endswith("Not everything agrees.\n")
    assert not any(line.startswith(("✓ numbers      all", "Everything agrees")) for line in told.splitlines())


def test_a_number_that_was_changed_is_told_with_what_comes_out(
    small_report: Path, tmp_path: Path, capfd: Capture
) -> None:
    data = json.loads((small_report / "small.json").read_text("utf-8"))
    name, row = next(iter(data["mechanisms"]["clutch"]["outputs"].items()))
    true, row["value"] = row["value"], row["value"] * 1.001
    (tmp_path / "a.html").write_bytes(page_with(json.dumps(data).encode()))
    assert run("verify", tmp_path / "a.html") == 1
    told = capfd.readouterr().out
    assert f"mechanisms.clutch.outputs.{name}.value: {row['value']} → {true}" in told
    assert "not compared" in told  # no page is made of numbers that are not the program's own


def test_a_page_that_shows_other_numbers_than_it_carries_does_not_agree(
    small_report: Path, tmp_path: Path, capfd: Capture
) -> None:
    page = (small_report / "small.html").read_text("utf-8")
    assert page.count("300") > 1
    (tmp_path / "a.html").write_text(page.replace(">300<", ">200<", 1), "utf-8")
    assert run("verify", tmp_path / "a.html") == 1
    told = capfd.readouterr().out
    assert "✓ numbers" in told and "✗ pages" in told


def test_a_configuration_that_cannot_be_calculated_any_more_is_bad_input(
    small_report: Path, tmp_path: Path, capfd: Capture
) -> None:
    def change(data: Data) -> None:
        data["config"]["source_text"] = data["config"]["source_text"].replace("kind: clutch", "kind: clutchh")

    path = changed(small_report / "small.json", tmp_path / "a.json", change)
    assert run("verify", path) == 2
    assert f"{path} (its configuration):5:" in capfd.readouterr().err


def test_a_language_that_was_chosen_for_the_report_is_no_difference(tmp_path: Path) -> None:
    config = saved(tmp_path, SMALL, "a.yaml")
    assert run("report", config, "-o", tmp_path, "--format", "html,json", "--language", "en", "--quiet") == 0
    assert run("verify", tmp_path / "a.html") == 0


# --- two documents held against each other ---------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("first", "second"), [(1.0, 1 + 1e-12), (1e-17, -1e-17), ([1e3, 1e-14], [1e3, 3e-14]), (2, 2.0)]
)
def test_rounding_in_the_last_digits_is_no_difference(first: object, second: object) -> None:
    found = agreement({"a": first}, {"a": second})
    assert found.differences == []


@pytest.mark.parametrize(
    ("first", "second"),
    [
        (1.0, 1.0001),
        (0.0, 1e-9),
        ([1.0, 2.0], [1.0]),
        (True, 1),
        ("1", 1),
        (None, 0),
        ({"b": 1}, {}),
        ([1e3, 0], [1e3, 1e-3]),
    ],
)
def test_what_differs_is_a_difference(first: object, second: object) -> None:
    for pair in ((first, second), (second, first)):
        (found,) = agreement({"a": pair[0]}, {"a": pair[1]}).differences
        assert found.path.split(".")[0] == "a"


def test_the_verdict_is_told_before_the_curves() -> None:
    old = {"mechanisms": {"a": {"curves": {"x": 1}, "outputs": {"m": 1}}}, "status": "pass"}
    new = {"mechanisms": {"a": {"curves": {"x": 2}, "outputs": {"m": 2}}}, "status": "fail"}
    assert [each.path for each in agreement(old, new).differences] == [
        "status",
        "mechanisms.a.outputs.m",
        "mechanisms.a.curves.x",
    ]


def test_a_calculation_with_a_formula_of_its_own_name_agrees_with_what_was_written_of_it(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    text = """\
schema_version: 1
project: {title: Gears}
press: {name: P}
mechanisms:
  pair: {kind: gear_pair, module: 5 mm, teeth_1: 24, teeth_2: 48, face_width: 50 mm, torque: 200 N*m, sigma_h_lim_1: 767 MPa,
    sigma_h_lim_2: 767 MPa, sigma_f_lim_1: 314 MPa, sigma_f_lim_2: 314 MPa}
"""
    file, results = tmp_path / "press.yaml", tmp_path / "press.json"
    file.write_text(text, "utf-8")
    main(["calc", str(file), "-o", str(results)])
    assert main(["verify", str(results)]) == 0, capfd.readouterr().out
