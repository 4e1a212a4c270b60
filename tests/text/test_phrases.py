"""Texts that remember what they were filled with."""

from __future__ import annotations

import json
import pickle

from diecut_report.text.phrases import Phrase, capital, joined, named, phrase, wordings


def test_a_phrase_is_its_english_text() -> None:
    said = Phrase("set {key} to {low:up}", {"key": "radius", "low:up": "40 mm"})
    assert said == "set radius to 40 mm" and json.dumps([said]) == '["set radius to 40 mm"]'


def test_a_phrase_keeps_its_parts_through_str_and_pickle() -> None:
    said = Phrase("take {count}", count=3)
    for copy in (str(said), pickle.loads(pickle.dumps(said))):
        assert isinstance(copy, Phrase) and (copy.template, copy.values) == ("take {count}", {"count": "3"})


def test_what_is_added_to_a_phrase_keeps_the_parts_of_both() -> None:
    said = "now " + Phrase("take {count}", count=3) + "; no more"
    assert said == "now take 3; no more"
    (made,) = wordings([said]).values()
    assert made["values"]["next"] == {"text": "; no more"}
    assert made["values"]["first"]["values"]["next"] == {"text": "take {count}", "values": {"count": "3"}}


def test_texts_that_are_joined_are_said_one_by_one_and_names_as_they_are() -> None:
    assert joined(["more", "less", "none"], ", or ") == "more, or less, or none" and joined([], " or ") == ""
    (texts,) = wordings([joined(["more", "less"], ", or ")]).values()
    (names,) = wordings([named(["mass", "speed"], " and ")]).values()
    assert texts == {"text": "{first}, or {next}", "values": {"first": {"text": "more"}, "next": {"text": "less"}}}
    assert names == {"text": "{first} and {next}", "values": {"first": "mass", "next": "speed"}}


def test_a_sentence_begins_with_a_capital_letter() -> None:
    assert capital("take it") == "Take it" and capital("") == ""


def test_wordings_are_those_of_phrases_with_values_wherever_they_stand() -> None:
    data = {"a": [Phrase("{n} parts", n=2)], "b": {"c": phrase("alone")}, "d": "plain", "e": [1.0, 2.0]}
    assert wordings(data) == {"2 parts": {"text": "{n} parts", "values": {"n": "2"}}}
