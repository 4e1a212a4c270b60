"""What is said of a number of things has all forms that its language needs, in each catalogue, with the same places in each."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from babel.messages.catalog import Message

from diecut_report.text import po_files

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
