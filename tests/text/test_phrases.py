"""Texts that remember what they were filled with."""

from __future__ import annotations

import json
import pickle
import re
from pathlib import Path
from typing import Any

import pytest
from babel.messages.catalog import Message

from diecut_report.cli.main import main
from diecut_report.config.plugins import Discovery
from diecut_report.errors import PluginError, Problem, nearest
from diecut_report.text import po_files
from diecut_report.text.catalogues import Catalogues
from diecut_report.text.phrases import Counted, Phrase, capital, joined, message_data, message_of, named, phrase
from diecut_report.text.translation import (
    Translator,
    decimal_sign,
    localised,
    said,
    say,
    say_counted,
    speaking,
    spoken_language,
)
from tests.cli.test_cli import Capture, run


def test_a_phrase_is_its_english_text() -> None:
    message = Phrase("set {key} to {low:up}", {"key": "radius", "low:up": "40 mm"})
    assert message == "set radius to 40 mm" and json.dumps([message]) == '["set radius to 40 mm"]'


def test_a_phrase_keeps_its_parts_through_str_and_pickle() -> None:
    message = Phrase("take {count}", count=3)
    for copy in (str(message), pickle.loads(pickle.dumps(message))):
        assert isinstance(copy, Phrase) and (copy.template, copy.values) == ("take {count}", {"count": "3"})


def test_what_is_added_to_a_phrase_keeps_the_parts_of_both() -> None:
    said = "now " + Phrase("take {count}", count=3) + "; no more"
    assert said == "now take 3; no more"
    values = message_data(said)["values"]
    assert values["next"] == message_data(phrase("; no more"))
    assert values["first"]["values"]["next"] == message_data(Phrase("take {count}", count=3))


def test_texts_that_are_joined_are_said_one_by_one_and_names_as_they_are() -> None:
    assert joined(["more", "less", "none"], ", or ") == "more, or less, or none" and joined([], " or ") == ""
    texts, names = message_data(joined(["more", "less"], ", or ")), message_data(named(["mass", "speed"], " and "))
    assert texts["template"] == "{first}, or {next}" and texts["values"]["first"] == message_data("more")
    assert (names["template"], names["values"]) == ("{first} and {next}", {"first": "mass", "next": "speed"})


def test_a_sentence_begins_with_a_capital_letter() -> None:
    assert capital("take it") == "Take it" and capital("") == ""


@pytest.mark.parametrize(
    "text",
    [Phrase("{n} parts", n=2), phrase("alone"), Counted(3, "{n} part of {of}", "{n} parts of {of}", of=phrase("it")),
     Counted(1, "{n} part", "{n} parts"), capital(Phrase("set {key}", key="mass"))],
)  # fmt: skip
def test_a_message_is_read_back_as_it_was_made(text: Phrase) -> None:
    read = message_of(json.loads(json.dumps(message_data(text))))
    assert (read, type(read), message_data(read)) == (text, type(text), message_data(text))


@pytest.mark.parametrize(
    "change",
    [{"text": "3 parts"}, {"values": {"n": "3"}}, {"template": "{n} wheels"}, {"values": {"n": 2}}, {"values": None}, {"one": "{n} part"},
     {"count": 2}, {"one": "{n} part", "count": True}, {"one": "{n} part", "count": 1}, {"more": ""}],
)  # fmt: skip
def test_what_is_not_the_template_with_its_values_is_no_message(change: dict[str, Any]) -> None:
    with pytest.raises(ValueError, match="message"):
        message_of(message_data(Phrase("{n} parts", n=2)) | change)


def test_messages_within_messages_have_an_end() -> None:
    made = message_data(phrase("x"))
    for _ in range(60):
        made = {"template": "{a}", "values": {"a": made}, "text": "x"}
    with pytest.raises(ValueError, match="message"):
        message_of(made)


# What is said of a number of things has all forms that its language needs, in each catalogue, with the same places in each.


ROOT = Path(__file__).parents[2]
FILES = sorted(
    [
        *ROOT.glob("diecut_report/locale/uk.po"),
        *ROOT.glob("plugins/*/locale/uk.po"),
        *ROOT.glob("examples/**/locale/uk.po"),
    ]
)
PLACE = re.compile(r"\{[^{}]*\}")


def faults(message: Message) -> list[str]:
    """What is wrong with the forms of a message that goes with a number, in Ukrainian: 1 and 21, 2 and 34, 5 and 11."""
    one, many = message.id
    forms = message.string if isinstance(message.string, tuple) else (message.string,)
    wanted = set(PLACE.findall(many))
    found = [] if len(forms) == 3 else [f"{many}: {len(forms)} forms"]
    found += [f"{one}: takes what the form for many does not"] * (not set(PLACE.findall(one)) <= wanted)
    found += [f"{many}: form {number} is empty" for number, form in enumerate(forms) if not (form or "").strip()]
    return found + [
        f"{many}: form {number} has {PLACE.findall(form)}"
        for number, form in enumerate(forms)
        if form and set(PLACE.findall(form)) != wanted  # the first is that of 21, too: it says the number where many do
    ]


@pytest.mark.parametrize("file", FILES, ids=lambda file: f"{file.parts[-3]}")
def test_each_number_has_its_form(file: Path) -> None:
    catalogue = po_files.read(file, "uk")
    assert catalogue.num_plurals == 3 and "n%10==1" in catalogue.plural_expr.replace(" ", "")
    assert [fault for message in catalogue if isinstance(message.id, tuple) for fault in faults(message)] == []


def test_the_program_counts() -> None:
    """So that the test above finds something."""
    catalogue = po_files.read(ROOT / "diecut_report" / "locale" / "uk.po", "uk")
    assert sum(isinstance(message.id, tuple) for message in catalogue) > 50


@pytest.mark.parametrize(
    ("forms", "told"),
    [
        (("{n} варіант", "{n} варіанти", "{n} варіантів"), []),
        (("{n} варіант", "{n} варіантів"), ["{n} variants: 2 forms"]),
        (("{n} варіант", " ", "{n} варіантів"), ["{n} variants: form 1 is empty", "{n} variants: form 1 has []"]),
        (("один варіант", "{n} варіанти", "{n} варіантів"), ["{n} variants: form 0 has []"]),
        (("{n} варіант", "{m} варіанти", "{n} варіантів"), ["{n} variants: form 1 has ['{m}']"]),
    ],
)
def test_a_fault_is_seen(forms: tuple[str, ...], told: list[str]) -> None:
    assert faults(Message(("{n} variant", "{n} variants"), forms)) == told


# Sources in another language: the program's are said word by word, those of others as they are given, or as a whole.


HEAD = 'msgid ""\nmsgstr ""\n"Language: uk\\n"\n"Content-Type: text/plain; charset=utf-8\\n"\n\n'


@pytest.fixture
def words(tmp_path: Path) -> Translator:
    (tmp_path / "hook.uk.po").write_text(f'{HEAD}msgid "the works\' sheet"\nmsgstr "аркуш заводу"\n', "utf-8")
    return Translator(Catalogues("uk", lambda kind: tmp_path / f"{kind}.py"), ",")


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


# What is said in the language that is spoken: phrases, numbers of things, messages of the command line.


VARIANTS = ("{n} variant", "{n} variants")
BAD = "schema_version: 1\npress: {name: P}\nmechanisms:\n  a: {kind: circular_knife, depth: 5 kg}\n"


@pytest.mark.parametrize(
    ("count", "words"), [(1, "1 варіант"), (3, "3 варіанти"), (5, "5 варіантів"), (21, "21 варіант")]
)
def test_a_number_of_things_has_the_form_that_its_language_wants(count: int, words: str) -> None:
    assert say_counted(count, *VARIANTS) == f"{count} variant{'s' * (count != 1)}"
    with speaking("uk"):
        assert say_counted(count, *VARIANTS) == words


def test_a_counted_phrase_keeps_its_number_through_pickle() -> None:
    copy = pickle.loads(pickle.dumps(Counted(3, *VARIANTS)))
    with speaking("uk"):
        assert said(copy) == "3 варіанти"


def test_a_language_holds_within_its_block_alone() -> None:
    with speaking("uk"):
        assert (spoken_language(), decimal_sign(), say("Everything agrees.")) == ("uk", ",", "Усе збігається.")
        assert localised("0.5 … 1.25") == "0,5 … 1,25"
        with speaking("en"):
            assert say("Everything agrees.") == "Everything agrees."
    assert (spoken_language(), localised("0.5")) == ("en", "0.5")


def test_a_problem_is_said_with_its_place_and_what_was_typed_as_it_stands() -> None:
    message = Phrase(
        "is {given}{near}; allowed: {choices}", given="1.5", near=nearest("masss", ["mass"]), choices="mass"
    )
    problem = Problem(message, "press.2.yaml", 3, 5, "a.b")
    assert str(problem) == "press.2.yaml:3:5: a.b: is 1.5 (did you mean 'mass'?); allowed: mass"
    with speaking("uk"):
        assert said(str(problem)) == "press.2.yaml:3:5: a.b: задано 1.5 (можливо, 'mass'?); допустимі: mass"
        assert said(str(PluginError("oh", "clutch", "a"))) == "механізм 'a', плагін 'clutch': oh"


def test_errors_name_file_line_and_key_in_ukrainian(tmp_path: Path, capfd: Capture) -> None:
    file = tmp_path / "bad.yaml"
    file.write_text(BAD, "utf-8")
    assert run("validate", file, "--language", "uk") == 2
    told = capfd.readouterr().err.splitlines()
    assert f"{file}:4:36: mechanisms.a.depth: 5 kg — це маса; потрібно: довжина, наприклад" in "\n".join(told)
    assert any(line.endswith("edge_radius: не задано. Задати в mm (> 0 mm): Радіус леза відносно його центра (більший за ексцентриситет).")
               for line in told)  # fmt: skip


@pytest.mark.parametrize(
    ("variable", "value", "words"),
    [
        ("DIECUT_REPORT_LANGUAGE", "uk", "помилок немає"),
        ("LC_ALL", "uk_UA.UTF-8", "помилок немає"),
        ("LANG", "de_DE", "valid"),
    ],
)
def test_the_environment_chooses_the_language_of_messages(
    variable: str, value: str, words: str, monkeypatch: pytest.MonkeyPatch, capfd: Capture
) -> None:
    for name in ("DIECUT_REPORT_LANGUAGE", "LC_ALL", "LC_MESSAGES", "LANG"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv(variable, value)
    assert run("validate", Path(__file__).parents[2] / "configs" / "circular_knife.yaml") == 0
    assert words in capfd.readouterr().err
    assert spoken_language() == "en"


def test_a_variable_that_names_no_known_language_is_told(monkeypatch: pytest.MonkeyPatch, capfd: Capture) -> None:
    monkeypatch.setenv("DIECUT_REPORT_LANGUAGE", "de")
    assert run("plugins") == 2
    assert (
        "DIECUT_REPORT_LANGUAGE: The language is 'de', of which the program has no catalogue" in capfd.readouterr().err
    )


def test_help_is_ukrainian(capfd: Capture) -> None:
    assert main(["--language", "uk", "--help"]) == 0
    said_there = capfd.readouterr().out
    assert "Виклик:" in said_there and "Команди:" in said_there and "Порівн" not in said_there.split("Команди:")[0]
    assert "Options" not in said_there and "Show" not in said_there
