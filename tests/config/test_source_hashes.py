"""The hash of the code that calculates: the same wherever it lies, another where a formula or a table is another."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from diecut_report.cli.main import main
from diecut_report.config.plugins import GROUP, Discovery
from diecut_report.config.source_hashes import PACKAGE, plugin_hash, program_hash
from diecut_report.errors import UserError
from diecut_report.press import Press
from diecut_report.report.rendering import Rendering
from diecut_report.results.model import ResultsRecord
from diecut_report.study.execution import worker
from tests.configs import GOOD, HEAD, LEVER, SMALL, saved
from tests.examples import few
from tests.study.studies import STUDY

TELL = "from diecut_report.config.source_hashes import *; import diecut_report; print(program_hash(), diecut_report.__file__)"


def copy_of_program(place: Path) -> Path:
    """The program as a wheel installs it, at another place."""
    import diecut_report.plugins as plugins

    ignored = shutil.ignore_patterns("__pycache__", "plugins", "configs", "templates")
    package = Path(shutil.copytree(PACKAGE, place / "diecut_report", ignore=ignored))
    shutil.copytree(plugins.__path__[0], package / "plugins")
    return package


def hash_at(place: Path) -> str:
    """What a process tells that runs the copy, and that leaves compiled files there."""
    usual = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    own = usual | {"PYTHONPATH": str(place)}
    done = subprocess.run([sys.executable, "-c", TELL], cwd=place, env=own, capture_output=True, text=True, check=True)
    digest, file = done.stdout.split()
    assert Path(file).is_relative_to(place)
    return digest


@pytest.mark.nightly
def test_the_hash_of_the_program_does_not_depend_on_its_place_or_on_compiled_files(tmp_path: Path) -> None:
    package = copy_of_program(tmp_path)
    assert hash_at(tmp_path) == program_hash()
    assert list(package.rglob("*.pyc")) and hash_at(tmp_path) == program_hash()


@pytest.mark.parametrize(
    "name",
    few(
        ["mechanics/common.py", "standards/data/renard_r10.json", "quantities/units_table.json", "plugins/__init__.py"],
        keep=lambda name: "common" in name or "renard" in name,
    ),
)
def test_another_formula_or_table_is_another_program(tmp_path: Path, name: str) -> None:
    path = copy_of_program(tmp_path) / name
    path.write_bytes(path.read_bytes() + b"\n")
    assert hash_at(tmp_path) != program_hash()


def test_a_plugin_of_the_program_is_hashed_by_itself(tmp_path: Path) -> None:
    path = copy_of_program(tmp_path) / "plugins" / "clutch" / "__init__.py"
    path.write_bytes(path.read_bytes() + b"\n")
    assert hash_at(tmp_path) == program_hash()


CODE = (GOOD / "lever.py").read_text("utf-8")


def lever(folder: Path) -> Path:
    """A folder with a copy of the plugin lever."""
    folder.mkdir()
    saved(folder, CODE, "lever.py")
    return folder


def hash_of_lever(folder: Path) -> str:
    return plugin_hash(Discovery([folder]).mechanism("lever"))


def hashes(place: Path, *folders: dict[str, str]) -> list[str]:
    """The hash of the plugin lever in each of these folders, whose files are given by their names."""
    found = []
    for number, files in enumerate(folders):
        for name, text in files.items():
            path = place / str(number) / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, "utf-8")
        found.append(hash_of_lever(place / str(number)))
    return found


def test_a_plugin_has_the_hash_of_its_code_and_of_its_tables(tmp_path: Path) -> None:
    named = {"lever.py": f'{CODE}\nTABLE = "steels.csv"'}
    tables = {"steels.csv": "1\n"}, {"steels.csv": "2\n"}, {"steels.csv": "1\n", "other.csv": "of nobody"}
    alone = ({"lever.py": code} for code in (CODE, CODE, f"{CODE}\n# more"))
    whole, same, more, one, other, again = hashes(tmp_path, *alone, *(named | table for table in tables))
    assert re.fullmatch("[0-9a-f]{64}", whole) and whole == same != more
    assert one == again != other


READS = "from pathlib import Path\nLIMIT = float(Path(__file__).with_suffix('.txt').read_text())\n"
PROJECT = f"[project.entry-points.'{GROUP}']\nlever = 'levers.one'\n"


@pytest.mark.parametrize(
    ("files", "changed"),
    [
        ({"lever/__init__.py": CODE}, "lever/more/deep.py"),
        ({"lever.py": CODE + READS}, "lever.txt"),
        ({"pyproject.toml": PROJECT, "src/levers/__init__.py": "", "src/levers/one.py": CODE}, "src/levers/factors.py"),
    ],
    ids=["a module of its folder", "a table that it reads", "another module of its package"],
)
def test_what_a_plugin_is_made_of_is_in_its_hash(tmp_path: Path, files: dict[str, str], changed: str) -> None:
    one, other, again = hashes(tmp_path, *(files | {changed: text} for text in ("1", "2", "1")))
    assert one == again != other


def test_results_and_report_tell_the_hashes(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    folder = lever(tmp_path / "plugins")
    saved(folder, "import sys\n", "extend_laws.py")
    config = saved(tmp_path, LEVER)
    assert main(["calc", str(config), "--plugins", str(folder), "--quiet"]) in (0, 1)
    found = json.loads(capfd.readouterr().out)
    assert found["program"]["source_sha256"] == program_hash()
    assert list(found["program"]["extensions"]) == ["extend_laws"]
    digest = found["mechanisms"]["a"]["plugin_sha256"]
    assert digest == hash_of_lever(folder)
    page = re.sub(r"<[^>]+>", " ", Rendering(ResultsRecord.model_validate(found)).html())
    for told in (program_hash(), digest, found["program"]["extensions"]["extend_laws"]):
        assert re.search(rf"source\s+{told[:12]}\s", page)


def test_results_tell_whether_the_formulas_of_a_plugin_are_sound_and_judge_them_when_it_changes(tmp_path: Path) -> None:
    wrong = CODE.replace("m.force * m.arm, ", "m.force + m.arm, ")
    for number, content in enumerate([CODE, wrong, wrong, CODE]):
        check = "failed" if content == wrong else "passed"
        folder = tmp_path / str(number)
        folder.mkdir()
        saved(folder, content, "lever.py")
        outcome = Press.read(saved(folder, LEVER), Discovery([folder])).calculate()
        assert outcome.results.mechanisms["a"].plugin_check == check
        template = "The formulas of the plugin of 'lever' have faults; do not rely on its results."
        assert outcome.warnings[:1] == ((template,) if check == "failed" else ())
        assert all(fault.startswith("  lever.py:") for fault in outcome.warnings[1:])


def test_a_foreign_plugin_is_named_by_its_file_and_not_by_where_it_lies(tmp_path: Path) -> None:
    package = tmp_path / "secret place" / "lever"
    package.mkdir(parents=True)
    shutil.copy(GOOD / "lever.py", package / "__init__.py")
    other = saved(tmp_path, LEVER + SMALL.removeprefix(HEAD))
    for folder, file in ((GOOD, "lever.py"), (tmp_path / "secret place", "lever/__init__.py")):
        found = Press.read(other, Discovery([folder])).calculate().results
        digest = found.mechanisms["a"].plugin_sha256
        assert found.mechanisms["a"].plugin_file == file and digest
        assert not found.mechanisms["clutch"].plugin_file  # comes with the program
        page = re.sub(r"\s+", " ", re.sub(r"<[^>]+>", " ", Rendering(found).html()))
        assert f"{file} , declarations and formulas checked source {digest[:12]}" in page
        assert "secret place" not in page + json.dumps(found.data())


def run(*arguments: str | Path) -> subprocess.CompletedProcess[str]:
    """A command in a process of its own, which reads the plugins anew."""
    command = [sys.executable, "-m", "tests.study.without_summary", *map(str, arguments)]
    place = os.environ | {"PYTHONPATH": str(Path(__file__).parents[2])}
    return subprocess.run(command, capture_output=True, text=True, check=False, env=place)


def here(*arguments: str | Path) -> int:
    """The exit code of a command in this process."""
    return main([*map(str, arguments), "--quiet"])


@pytest.mark.nightly
@pytest.mark.usefixtures("without_summary")
def test_a_run_is_not_continued_with_other_code_of_the_same_version(tmp_path: Path) -> None:
    folder, out = lever(tmp_path / "plugins"), tmp_path / "out"
    saved(tmp_path, LEVER)
    study = saved(tmp_path, STUDY.replace("  mechanisms.a.grade: [fine, coarse]\n", ""), "study.yaml")
    assert here("batch", study, "-o", out, "--plugins", folder) in (0, 1)
    before = (out / "study.json").read_bytes()
    (out / "variants/part-00000.parquet").unlink()
    (folder / "lever.py").write_text((folder / "lever.py").read_text("utf-8") + "\n# other\n", "utf-8")
    for given in ([study], []):
        refused = run("batch", *given, "--resume", out, "--plugins", folder)
        assert refused.returncode == 2, refused.stderr
        assert "The source of the plugin lever has changed since the results were begun (SHA-256 " in refused.stderr
        assert "in another folder" in refused.stderr
    assert (out / "study.json").read_bytes() == before and not (out / "variants/part-00000.parquet").exists()


@pytest.mark.nightly
@pytest.mark.usefixtures("without_summary")
def test_a_variant_that_other_code_calculates_is_told(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    folder, out = lever(tmp_path / "plugins"), tmp_path / "out"
    saved(tmp_path, LEVER)
    study = saved(tmp_path, STUDY.replace("  mechanisms.a.grade: [fine, coarse]\n", ""), "study.yaml")
    assert here("batch", study, "-o", out, "--plugins", folder) in (0, 1)
    asked = ("report", f"{out}#1", "-o", tmp_path, "--format", "json", "--plugins", folder)
    assert here(*asked) in (0, 1) and "source" not in capfd.readouterr().err
    before = hash_of_lever(folder)
    saved(folder, (folder / "lever.py").read_text("utf-8") + "\n# other\n", "lever.py")
    saved(folder, "import sys\n", "extend_laws.py")
    told, now = run(*asked), run("calc", f"{out}#1", "--plugins", folder, "--quiet")
    assert told.returncode in (0, 1)
    words = f"The source of the plugin lever is not what the study was calculated by (SHA-256 {before[:12]} then, "
    assert f"warning: {words}" in told.stderr and "numbers of this variant may differ" in told.stderr
    assert "warning: The source of the extension extend_laws is not what" in now.stderr
    for results in ((tmp_path / "out-1.json").read_text("utf-8"), now.stdout):
        assert f"# {words}" in json.loads(results)["config"]["source_text"]


def test_a_process_with_other_code_than_the_run_calculates_nothing(tmp_path: Path) -> None:
    base, study = saved(tmp_path, LEVER), STUDY.replace("  mechanisms.a.grade: [fine, coarse]\n", "").encode()
    files, plugins = {"press.yaml": base.read_bytes()}, [str(GOOD)]
    known = {"program": program_hash(), "plugin lever": plugin_hash(Discovery([GOOD]).mechanism("lever"))}
    assert worker.load(study, files, plugins, known)
    with pytest.raises(UserError, match=r"The source of the plugin lever is not the one that this run was begun with"):
        worker.load(study, files, plugins, known | {"plugin lever": "0" * 64})
