"""Steps that do not apply to a machine: told once for all that follow each other."""

from __future__ import annotations

from diecut_report.report.model import gathered_notes, under_heading
from diecut_report.results.mechanism_record import AbsentRecord, ItemRecord


def _note(name: str, said: str = "does not apply to this machine.") -> ItemRecord:
    return ItemRecord(type="note", id=name, description=name, text=f"{name}: {said}")


def test_what_does_not_apply_stands_in_one_sentence() -> None:
    formula = ItemRecord(type="formula", description="Its square root")
    found = gathered_notes([_note("Step"), _note("Root"), formula, _note("Share")])
    assert found[0] == ItemRecord(type="note", text="Does not apply to this machine: Step; Root.")
    assert found[1:] == [None, formula, _note("Share")]  # each step keeps its place, by which figures stand


def test_notes_of_another_kind_stay_as_they_are() -> None:
    notes = [_note("Angle", "there is none."), _note("Step"), ItemRecord(type="note", text="A remark."), None]
    assert gathered_notes(notes) == notes


def test_what_is_left_out_for_one_reason_stands_in_one_line() -> None:
    reasons = [
        ("Cam 1", "arm_length not given"),
        ("Torque", "conveyor_mass not given"),
        ("Cam 2", "arm_length not given"),
    ]
    absent = [AbsentRecord(title=title, text=f"not calculated: {text}") for title, text in reasons]
    found = [(part.title, part.text) for part in under_heading(absent, "Not calculated")]
    assert found == [("Cam 1; Cam 2", "arm_length not given"), ("Torque", "conveyor_mass not given")]
