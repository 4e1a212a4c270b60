"""The words that the script of the live page says, by the names that it has for them; they come with the page as data."""

from __future__ import annotations

import json

from diecut_report.languages.phrases import phrase
from diecut_report.languages.speech import said

WORDS = {
    "verdict_fault": phrase("The file cannot be calculated"),
    "count_pass": phrase("{n} pass"),
    "governing": phrase("governing: {check}"),
    "failed_before": phrase("at the start {n} failed"),
    "status_pass": phrase("pass"),
    "status_warn": phrase("warn"),
    "status_fail": phrase("fail"),
    "status_not_checked": phrase("not checked"),
    "more_faults": phrase("and {n} more"),
    "write": phrase("Write to file"),
    "write_n": phrase("Write {n} to file"),
    "written": phrase("Written to {file}."),
    "taken_back": phrase("Taken back: {n}."),
    "put_back": phrase("Put back again"),
    "take_back": phrase("Take back"),
    "take_back_of": phrase("Take back {input}"),
    "slider": phrase("{input}, slider"),
    "before": phrase("at the start {value}"),
    "no_inputs": phrase("The file gives no number here that is not taken from elsewhere."),
    "not_found": phrase("No input that the file gives has this in its key or words."),
    "effect": phrase("Effect"),
    "effect_of": phrase("Effect of {input}"),
    "effect_line": phrase("utilisation from {first} to {last}"),
    "absent_before": phrase("not there"),
    "drawing": phrase("drawing …"),
    "refused": phrase("The program does not take this ({status})."),
    "no_answer": phrase("The program does not answer; is it still running?"),
    "making": phrase("The report is being made; it opens in a tab of its own."),
    "lost": phrase("The program does not answer. If it was started anew, open the address that it prints."),
}
"""What is in braces the script fills in."""


def words() -> str:
    """Return the words in the language that is spoken, as JSON."""
    return json.dumps({name: said(text) for name, text in WORDS.items()}, ensure_ascii=False)
