"""Columns of a study are told in the language that is spoken, by the words of the plugins that they are of."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import pytest

from diecut_report.cli.main import main
from diecut_report.config.plugins import Discovery, spoken_catalogues
from diecut_report.errors import UserError
from diecut_report.study.analysis.variants import StoredColumn, compared_text, shown, titles
from diecut_report.study.storage.description import ResultColumn
from diecut_report.text.translation import know_all_plugins, know_plugins, speaking
from tests.configs import GOOD, LEVER, saved
from tests.study.studies import varied

COLUMNS = (
    ResultColumn("mechanisms.knife.eccentricity", "float", "m", "mm", "e", "Eccentricity: distance of the edge's centre from the shaft's axis"),
    ResultColumn("knife.cut_time", "float", "s", "ms", "t", "Time of the cut"),
    ResultColumn("knife.place.2", "float", "s", "ms", "t", "Time of the cut: no. 3"),
    ResultColumn("knife.place_count", "int", description="Time of the cut: how many in a turn"),
    ResultColumn("knife.checks.entry.utilisation", description="Something of mine: utilisation"),
    ResultColumn("knife.checks.entry.status", "text", description="Something of mine: verdict"),
)  # fmt: skip
STUDY = varied("[1 kN, 2 kN]")


def test_names_are_of_the_kind_s_words_and_english_is_as_it_is_stored() -> None:
    with speaking("uk"):
        found = titles(COLUMNS, {"knife": "circular_knife"})
    assert found.pop("mechanisms.knife.eccentricity").startswith("Відстань від осі вала")
    assert list(found.values()) == [
        "Тривалість розрізу (knife)", "Тривалість розрізу: № 3 (knife)", "Тривалість розрізу: скільки за оберт (knife)",
        "Something of mine: коефіцієнт використання (knife)", "Something of mine (knife)",
    ]  # fmt: skip
    assert titles(COLUMNS)["knife.place.2"] == "Time of the cut: no. 3 (knife)"


def test_values_in_a_table_have_the_sign_and_the_words_of_the_language() -> None:
    column = StoredColumn("a.b", "float", "m", "mm")
    with speaking("uk"):
        assert (shown(0.0015, column), shown(True, StoredColumn("a.c", "bool"))) == ("1,5", "так")
        table, _ = compared_text([StoredColumn("variant", "int"), column], [[0, 1.0], [1, 2.0]], 80, keep_equal=True)
    assert table.split()[:2] == ["величина", "одиниця"]


def lever(folder: Path, catalogue: str | bytes | None) -> Path:
    """A folder with a plugin of somebody, and the catalogue beside it."""
    shutil.copy(GOOD / "lever.py", folder)
    if catalogue is not None:
        (folder / "lever.uk.po").write_bytes(catalogue.encode() if isinstance(catalogue, str) else catalogue)
    return folder


FORCE = ResultColumn("mechanisms.a.force", "float", "N", "kN", "F", "Force")
HEAD = 'msgid ""\nmsgstr ""\n"Content-Type: text/plain; charset=utf-8\\n"\n'
WORDS = f'{HEAD}"Language: uk\\n"\n\nmsgid "Force"\nmsgstr "Сила на кінці"\n\nmsgid "Arm"\nmsgstr ""\n'


@pytest.mark.parametrize(("catalogue", "told"), [(WORDS, "Сила на кінці (a)"), (None, "Force (a)")])
def test_a_plugin_of_others_has_words_of_its_own_or_none(tmp_path: Path, catalogue: str | None, told: str) -> None:
    discovery = Discovery([lever(tmp_path, catalogue)])
    with speaking("uk"), speaking("uk", spoken_catalogues(discovery)):
        assert titles([FORCE], {"a": "lever"}) == {FORCE.name: told}


BROKEN = (
    b"\0\xff",
    'msgid "Force"\nmsgstr "\x1b[31mx"\n',
    f'{HEAD}"Plural-Forms: nplurals=1; plural=n/0;\\n"\n\nmsgid "a"\nmsgstr "b"\n',
)


@pytest.mark.parametrize("catalogue", BROKEN)
def test_a_broken_catalogue_is_told_with_its_file_and_hides_no_other_problem(
    tmp_path: Path, catalogue: str | bytes, capfd: pytest.CaptureFixture[str]
) -> None:
    discovery = Discovery([lever(tmp_path, catalogue)])
    with speaking("uk"), speaking("uk", spoken_catalogues(discovery)):
        with pytest.raises(UserError, match=r"lever\.uk\.po"):
            know_plugins(["lever"])
        assert [problem.file for problem in know_all_plugins()] == [str(tmp_path / "lever.uk.po")]
    config = saved(tmp_path, LEVER.replace("2 kN", "2 kg"))
    assert main(["validate", str(config), "--plugins", str(tmp_path), "--language", "uk"]) == 2
    said = capfd.readouterr().err
    assert "2 kg — це маса" in said and "lever.uk.po: Цей каталог текстів неможливо прочитати" in said
    assert "\x1b" not in said


@pytest.mark.nightly
def test_a_study_tells_which_plugin_has_no_words(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    saved(lever(tmp_path, WORDS), LEVER)
    study, out = saved(tmp_path, STUDY, "study.yaml"), tmp_path / "out"
    main(["batch", str(study), "-o", str(out), "--jobs", "1", "--plugins", str(tmp_path), "--language", "uk"])
    assert re.search(r"У каталозі uk плагіна виду 'lever' бракує текстів: \d+", capfd.readouterr().err)
    page = (out / "summary.html").read_text("utf-8")
    assert "Сила на кінці (a)" in page and "Force (a)" not in page
