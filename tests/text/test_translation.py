"""Sources in another language: the program's are said word by word, those of others as they are given, or as a whole."""

from __future__ import annotations

from pathlib import Path

import pytest

from diecut_report.config.plugins import Discovery
from diecut_report.text.catalogues import Catalogues
from diecut_report.text.translation import Translator

HEAD = 'msgid ""\nmsgstr ""\n"Language: uk\\n"\n"Content-Type: text/plain; charset=utf-8\\n"\n\n'


@pytest.fixture
def words(tmp_path: Path) -> Translator:
    (tmp_path / "hook.uk.po").write_text(f'{HEAD}msgid "the works\' sheet"\nmsgstr "аркуш заводу"\n', "utf-8")
    return Translator(Catalogues("uk", lambda kind: tmp_path / f"{kind}.py"), {}, ",")


@pytest.mark.parametrize("text", ["Table of geometry and input, chart 3", "002 eq. 17"])
def test_a_foreign_source_is_printed_as_it_is_given(words: Translator, text: str) -> None:
    assert words.source(text, "clutch") != text
    assert words.source(text, "hook") == words.source(text, "none_at_all") == text


def test_a_foreign_source_of_its_own_catalogue_is_said_as_that_has_it(words: Translator) -> None:
    assert words.source("the works' sheet", "hook") == "аркуш заводу"


def test_a_paper_is_cited_in_the_language_that_it_is_written_in_and_others_as_they_are(words: Translator) -> None:
    [source] = Discovery().mechanism("knife_drive").sources
    assert words.paper(source.citation).startswith("Дідич В. П., Нагорнюк С. О. Порівняльний аналіз механізмів")
    assert words.paper("Pilkey W. D. Stress Concentration Factors.") == "Pilkey W. D. Stress Concentration Factors."
