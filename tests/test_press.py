"""The whole way: results document, statuses, what a broken plugin leaves; the mended press with one thing made absurd does not pass."""

from __future__ import annotations

import errno
import hashlib
import json
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import yaml

from diecut_report.config.plugins import Discovery
from diecut_report.errors import UserError
from diecut_report.press import Press
from diecut_report.report import rendering
from diecut_report.results.conclusion import governing
from diecut_report.results.mechanism_record import CheckRecord
from diecut_report.results.model import ResultsRecord
from diecut_report.results.results_file import results_text
from tests.configs import BROKEN, DISCOVERY, EXAMPLE, EXAMPLES, GOOD, HEAD, LEVER, saved
from tests.examples import few
from tests.processes import Example
from tests.records import filled
from tests.test_mending import MENDED, calculated, verdicts

ALL = Discovery([GOOD, BROKEN])
FAILS = LEVER.replace("force: 2 kN", "force: 2 kN, allowable_moment: 150")


def results(path: Path, discovery: Discovery = DISCOVERY) -> ResultsRecord:
    """The results document of a config."""
    return Press.read(path, discovery).calculate().results


# --- the document ----------------------------------------------------------------------------------------------------


def test_the_document_holds_what_the_contract_names(tmp_path: Path) -> None:
    path = saved(tmp_path, FAILS)
    found = json.loads(Press.read(path, DISCOVERY).calculate().text)
    assert found["schema_version"] == 1
    assert found["program"]["name"] == "diecut-report"
    assert found["config"]["file"] == "press.yaml"
    assert found["config"]["sha256"] == hashlib.sha256(path.read_bytes()).hexdigest()
    assert found["config"]["source_text"] == FAILS
    assert found["project"] == {
        "title": "Test", "document_number": "", "revision": "", "date": None, "organisation": "", "prepared_by": "",
        "checked_by": "", "norm_checked_by": "", "approved_by": "", "department": "", "document_type": "", "revisions": [], "language": "en",
    }  # fmt: skip
    assert (found["status"], found["mechanisms"]["a"]["status"]) == ("fail", "fail")
    assert found["governing"] == {"mechanism": "a", "check": "moment"}
    assert found["mechanisms"]["a"]["checks"][0]["utilisation"] == pytest.approx(200 / 150, rel=1e-12)
    assert found["mechanisms"]["a"]["outputs"]["moment"]["value"] == 200


def test_press_fields_are_si_with_their_text_in_the_display_unit(tmp_path: Path) -> None:
    press = results(saved(tmp_path, LEVER)).press
    assert press.name == "P"
    told = [(f.path, f.value, f.unit, f.display.data()) for f in press.fields]
    assert told == [
        ("press.productivity", 6000 / 3600, "1/s", {"text": "6000", "unit": "1/h"}),
        ("press.sheet.length", 0.7, "m", {"text": "700", "unit": "mm"}),
        ("press.sheet.thickness", 0.0006, "m", {"text": "0.6", "unit": "mm"}),
    ]


@pytest.mark.parametrize(
    "text",
    [
        pytest.param(EXAMPLE.read_text("utf-8"), marks=pytest.mark.nightly),
        FAILS + "  b: {kind: lever, force: '${a.force}', parts: [{length: 3}], load: [1, 2, 3, '${a.moment}']}\n",
    ],
)
def test_the_resolved_config_gives_the_same_results(tmp_path: Path, text: str) -> None:
    first = results(saved(tmp_path, text))
    again = results(saved(tmp_path, json.dumps(first.config.resolved), "again.yaml"))
    for name, data in first.mechanisms.items():
        assert again.mechanisms[name].outputs == data.outputs
        assert again.mechanisms[name].checks == data.checks
    assert again.press == first.press


def test_the_results_text_is_strict_json_with_exact_floats() -> None:
    resolved = {"a": {"b": {"c": {"d": {"e": 0.1 + 0.2}}}}, "list": [1e-300, True, None], "none": {}}
    text = results_text(filled(ResultsRecord, {"config": {"resolved": resolved}}))
    assert json.loads(text)["config"]["resolved"] == resolved and "0.30000000000000004" in text
    with pytest.raises(ValueError, match="not JSON compliant"):
        results_text(filled(ResultsRecord, {"config": {"resolved": {"a": float("nan")}}}))


def test_equal_inputs_give_equal_bytes_in_every_process(example: Example) -> None:
    """Of reports too: tests/hostile/test_surroundings.py, tests/report/test_html.py."""
    assert (example.code, example.told) == (1, Press.read(EXAMPLE, Discovery([])).calculate().text)


def check_(status: str, utilisation: float | None) -> CheckRecord:
    data = {"id": f"{status} {utilisation}", "class": "strength", "status": status, "utilisation": utilisation}
    return filled(CheckRecord, data)


@pytest.mark.parametrize(
    ("checks", "expected"),
    [
        ([check_("pass", 0.9), check_("warn", 0.5), check_("fail", 1.1), check_("fail", 1.2)], "fail 1.2"),
        ([check_("fail", 5.0), check_("fail", None), check_("pass", 0.1)], "fail None"),
        ([check_("pass", 0.3), check_("pass", 0.7)], "pass 0.7"),
        ([check_("pass", None), check_("pass", 0.01)], "pass 0.01"),
        ([check_("warn", None), check_("pass", 0.99)], "warn None"),
    ],
)
def test_the_worst_check_governs(checks: list[CheckRecord], expected: str) -> None:
    assert str(governing({"m": checks})) == f"m.{expected}"


def test_without_checks_nothing_governs() -> None:
    assert governing({"m": []}) is None


# --- broken plugins and impossible machines --------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("kind", "words"),
    [("breaks_in_calculation", "RuntimeError: the plugin fell over"), ("breaks_at_import", "it cannot be loaded from")],
)
def test_a_broken_mechanism_is_in_error_and_the_others_are_kept(tmp_path: Path, kind: str, words: str) -> None:
    text = FAILS + (
        f"  x: {{kind: {kind}}}\n"
        "  b: {kind: lever, force: 1, arm: '${x.result}'}\n"
        "  c: {kind: lever, force: 1, arm: '${b.arm}'}\n"
    )
    outcome = Press.read(saved(tmp_path, text), ALL).calculate()
    found = outcome.results.mechanisms
    assert {name: data.status for name, data in found.items()} == {
        "a": "fail",
        "x": "error",
        "b": "skipped",
        "c": "skipped",
    }
    assert outcome.results.status == "error"
    assert f"mechanism 'x' of plugin '{kind}'" in found["x"].error and words in found["x"].error
    assert found["b"].error == "It refers to x, which gives no results."
    assert found["a"].outputs["moment"].value == 200
    assert [str(error) for error in outcome.broken] == [found["x"].error]
    results_text(outcome.results)


def test_a_broken_mechanism_still_has_every_part_of_a_result(tmp_path: Path) -> None:
    found = results(saved(tmp_path, LEVER + "  x: {kind: breaks_at_import}\n"), ALL).mechanisms
    assert found["x"].data().keys() == (found["a"].data().keys() | {"error"}) - {"plugin_file", "plugin_check"}


COMPARED = LEVER + "  x: {kind: breaks_in_comparison}\n"
BOTH = "rod_comparison-a-x"


def test_a_broken_comparison_is_in_error_and_the_mechanisms_are_kept(tmp_path: Path) -> None:
    outcome = Press.read(saved(tmp_path, COMPARED), ALL).calculate()
    found = outcome.results.comparisons[BOTH]
    assert (found.status, outcome.results.status) == ("error", "error")
    assert (found.kind, found.title, found.plugin_version) == ("rod_comparison", "Lever and rod compared", "2")
    assert found.between == ["a", "x"]
    assert "RuntimeError: the comparison fell over" in found.error
    assert [str(error) for error in outcome.broken] == [found.error]
    assert {data.status for data in outcome.results.mechanisms.values()} == {"pass"}
    assert outcome.results.mechanisms["x"].outputs["result"].value == 0.01
    results_text(outcome.results)


def test_a_broken_comparison_still_has_every_part_of_a_result(tmp_path: Path) -> None:
    found = results(saved(tmp_path, COMPARED), ALL)
    assert found.comparisons[BOTH].data().keys() == found.mechanisms["a"].data().keys() | {"error", "between"}


def test_an_impossible_machine_is_bad_input_at_its_key(tmp_path: Path) -> None:
    text = HEAD + "  a: {kind: lever, force: 1, teeth: 101}\n  b: {kind: lever, force: 1, teeth: 200}\n"
    with pytest.raises(UserError) as caught:
        results(saved(tmp_path, text))
    told = [(p.line, p.column, p.path, p.message) for p in caught.value.problems]
    assert told == [
        (5, 37, "mechanisms.a.teeth", "is 101; a hundred at most"),
        (6, 37, "mechanisms.b.teeth", "is 200; a hundred at most"),
    ]


# --- writing ---------------------------------------------------------------------------------------------------------


class Painted:
    """A rendering that costs nothing."""

    def __init__(self, results: ResultsRecord, *_: object) -> None:
        self.title = results.project.title
        self.faults: list[Any] = []

    def html(self) -> str:
        return f"<p>{self.title} in {self.__class__.__name__}</p>"

    def pdf(self, _begun: Callable[[int], object]) -> bytes:
        return b"%PDF"


@pytest.fixture
def painted(monkeypatch: pytest.MonkeyPatch) -> type[Painted]:
    """The rendering, replaced by one that costs nothing; its methods can be replaced in turn."""
    own = type("Own", (Painted,), {})
    monkeypatch.setattr(rendering, "Rendering", own)
    return own


def made(config: Path, folder: Path, formats: tuple[str, ...] = ("html", "pdf", "json")) -> tuple[Path, ...]:
    """The files that a report writes."""
    return Press.read(config, DISCOVERY).calculate().report(folder, formats).written


def below(folder: Path) -> list[str]:
    """All that is in a folder, hidden files included."""
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*"))


@pytest.mark.usefixtures("painted")
def test_a_report_is_written_beside_each_other_under_the_configs_name(tmp_path: Path) -> None:
    written = made(saved(tmp_path, LEVER, "my.press.yaml"), tmp_path / "new" / "folder")
    assert [path.name for path in written] == ["my.press.html", "my.press.pdf", "my.press.json"]
    assert below(tmp_path / "new") == ["folder", "folder/my.press.html", "folder/my.press.json", "folder/my.press.pdf"]
    assert (tmp_path / "new/folder/my.press.html").read_text() == "<p>Test in Own</p>"


@pytest.mark.usefixtures("painted")
def test_only_the_asked_formats_are_written_in_the_asked_order(tmp_path: Path) -> None:
    written = made(saved(tmp_path, LEVER), tmp_path / "out", ("json", "html"))
    assert [path.name for path in written] == ["press.json", "press.html"]
    assert below(tmp_path / "out") == ["press.html", "press.json"]


def full(*_: object) -> bytes:
    raise OSError(errno.ENOSPC, "No space left on device")


def no_pango(*_: object) -> bytes:
    raise OSError(
        "cannot load library 'libpango-1.0-0': libpango-1.0-0: cannot open shared object file. Additionally, …"
    )


def falls_over(*_: object) -> bytes:
    raise ZeroDivisionError


@pytest.mark.parametrize("fault", [falls_over, no_pango, full])
def test_a_rendering_that_fails_leaves_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, painted: type[Painted], fault: Callable[..., bytes]
) -> None:
    monkeypatch.setattr(painted, "pdf", fault)
    config = saved(tmp_path, LEVER)
    with pytest.raises((UserError, ZeroDivisionError, OSError)):
        made(config, tmp_path / "out")
    assert below(tmp_path) == ["press.yaml"]


def test_a_missing_system_library_is_told_with_the_command_that_installs_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, painted: type[Painted]
) -> None:
    monkeypatch.setattr(painted, "pdf", no_pango)
    with pytest.raises(
        UserError, match=r"missing: 'libpango-1.0-0'. Install it .*apt-get install libpango-1.0-0 .*--format html,json"
    ):
        made(saved(tmp_path, LEVER), tmp_path / "out")


@pytest.mark.usefixtures("painted")
def test_a_full_disk_leaves_what_was_there(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    config, out = saved(tmp_path, LEVER), tmp_path / "out"
    made(config, out)
    before = {path.name: path.read_bytes() for path in out.iterdir()}
    whole = Path.write_bytes

    def half(path: Path, content: bytes) -> int:
        whole(path, content[: len(content) // 2])
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(
        Path, "write_bytes", lambda path, content: (whole if content == b"%PDF" else half)(path, content)
    )
    saved(tmp_path, LEVER.replace("2 kN", "3 kN"))
    with pytest.raises(
        UserError, match=r"cannot be written: the disk is full\. Nothing was written; free disk space and try again\."
    ):
        made(config, out, ("pdf", "html", "json"))
    assert {path.name: path.read_bytes() for path in out.iterdir()} == before


@pytest.mark.usefixtures("painted")
def test_folders_made_in_vain_are_removed_again(tmp_path: Path) -> None:
    config = saved(tmp_path, LEVER)
    (tmp_path / "taken").mkdir()
    (tmp_path / "taken" / "press.pdf").mkdir()
    with pytest.raises(UserError, match="a folder has this name"):
        made(config, tmp_path / "taken")
    with pytest.raises(UserError, match="a part of the path is a file"):
        made(config, tmp_path / "press.yaml" / "out")
    with pytest.raises(UserError, match="the name is too long"):
        made(config, tmp_path / "new" / ("n" * 300))
    assert below(tmp_path) == ["press.yaml", "taken", "taken/press.pdf"]


@pytest.mark.usefixtures("painted")
@pytest.mark.skipif(not Path("/proc/self").exists(), reason="needs a folder that nobody can write to")
def test_a_folder_that_cannot_be_written_to_is_told(tmp_path: Path) -> None:
    with pytest.raises(UserError) as caught:
        made(saved(tmp_path, LEVER), Path("/proc/self/fdinfo"))
    (problem,) = caught.value.problems
    assert problem.file == "/proc/self/fdinfo/press.html" and problem.message.startswith("This cannot be written: ")


@pytest.mark.usefixtures("painted")
def test_the_config_is_never_written_over(tmp_path: Path) -> None:
    config = saved(tmp_path, LEVER, "press.json")
    with pytest.raises(UserError, match="This file was given and would be overwritten"):
        made(config, tmp_path, ("html", "json"))
    assert below(tmp_path) == ["press.json"] and config.read_text("utf-8") == LEVER


@pytest.mark.usefixtures("painted")
def test_a_link_is_replaced_and_not_what_it_points_to(tmp_path: Path) -> None:
    out = tmp_path / "out"
    out.mkdir()
    (out / "press.json").symlink_to(tmp_path / "kept.json")
    made(saved(tmp_path, LEVER), out, ("json",))
    assert not (out / "press.json").is_symlink() and not (tmp_path / "kept.json").exists()
    assert json.loads((out / "press.json").read_text("utf-8"))["status"] == "pass"


def test_a_report_of_a_broken_plugin_is_written_all_the_same(tmp_path: Path) -> None:
    text = LEVER + "  broken: {kind: breaks_in_calculation}\n  b: {kind: lever, force: 1, arm: '${broken.result}'}\n"
    written = Press.read(saved(tmp_path, text), ALL).calculate().report(tmp_path, ("html",)).written
    html = written[0].read_text("utf-8")
    assert "the plugin fell over" in html and "It refers to broken" in html


def test_a_report_tells_of_a_broken_comparison(tmp_path: Path) -> None:
    written = Press.read(saved(tmp_path, COMPARED), ALL).calculate().report(tmp_path, ("html",)).written
    html = written[0].read_text("utf-8")
    chapter = html[html.index('<h2 id="m-C">') :]
    assert "This comparison could not be calculated." in chapter and "the comparison fell over" in chapter
    assert "1 part is not calculated" in html or "mechanisms and comparisons were not calculated." in html


@pytest.mark.nightly
def test_the_examples_are_calculated_without_slow_imports() -> None:
    """All but the one of tests/cli/test_cli.py, ``test_calc_imports_nothing_that_draws_or_is_slow``."""
    code = (
        "import sys; from pathlib import Path; from diecut_report.config.plugins import Discovery; from diecut_report.press import Press\n"
        f"for name in {[str(path) for path in EXAMPLES if path != EXAMPLE]!r}: Press.read(Path(name), Discovery([])).calculate()\n"
        "print(sorted({'pint', 'matplotlib', 'weasyprint', 'jinja2', 'ezdxf', 'scipy.stats'} & set(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "[]\n"


PINS = ("crank_pin", "rocker_pin")
BORED = {f"mechanisms.bearings.bearings.{i}.designation": None for i in (2, 3)}  # which thin pins would contradict
ABSURD: list[tuple[str, dict[str, Any], str, set[str]]] = [
    ("a sheet longer than the step", {"press.sheet.width": "750 mm"}, "fail", {"consistency.step", "consistency.sheet_gap"}),
    ("a cylinder shorter than the sheet", {"mechanisms.cylinder.generatrix_length": "400 mm"}, "fail", {"consistency.format_generatrix"}),
    ("a crank of 5 mm", {"mechanisms.drive.crank_length": "5 mm"}, "fail",
     {"drive.joint_force", "crankshaft.fatigue", *(f"{pin}.yield" for pin in PINS), "bearings.main_b_static"}),
    ("pins of 5 mm", {f"mechanisms.{pin}.sections.0.diameter": "5 mm" for pin in PINS} | BORED, "fail",
     {f"{pin}.{check}" for pin in PINS for check in ("fatigue", "yield")}),
    ("no limit of sheet and roller",
     {f"mechanisms.cross.{key}": None for key in ("allowable_contact_pressure", "allowable_sheet_acceleration", "gripper_force")},
     "not_checked", {"cross.contact_pressure", "cross.sheet_acceleration", "cross.grippers"}),
]  # fmt: skip


def made_absurd(changes: dict[str, Any]) -> dict[str, Any]:
    """The mended press with values at paths; None takes a key away."""
    data: dict[str, Any] = yaml.safe_load(MENDED.read_text(encoding="utf-8"))
    for path, value in changes.items():
        *parents, key = path.split(".")
        place: Any = data
        for parent in parents:
            place = place[int(parent)] if parent.isdigit() else place[parent]
        if value is None:
            del place[key]
        else:
            place[key] = value
    return data


@pytest.mark.parametrize(
    ("changes", "status", "checks"),
    few([case[1:] for case in ABSURD], keep=lambda case: case[1] == "not_checked"),
)
def test_a_press_that_nobody_may_build_does_not_pass(
    tmp_path: Path, changes: dict[str, Any], status: str, checks: set[str]
) -> None:
    assert checks <= verdicts(calculated(tmp_path, made_absurd(changes))).get(status, set())
