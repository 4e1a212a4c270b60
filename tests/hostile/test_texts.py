"""Control and invisible characters in texts that are no YAML, and what the fuzzer kept (scripts/fuzz.py): read to the end, or refused in words."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from diecut_report.cli.main import main
from diecut_report.config.yaml import parse, with_values
from diecut_report.errors import UserError
from diecut_report.study.storage.description import write_state
from tests.configs import GOOD
from tests.hostile.readers import CORPUS, READERS
from tests.hostile.seeds import seeds, words


@pytest.mark.parametrize("text", ["a\0b", "a\x1b]0;t\a", "a\u202eb", "a\u2028b", "a\ufffe", "a\u00adb", "\u3164"])
def test_a_value_that_is_put_into_a_tree_is_judged_as_one_that_is_read(text: str) -> None:
    with pytest.raises(UserError, match=r"press.yaml: project.title: The value .* holds the invisible character U\+"):
        with_values(parse("project: {title: a}", "press.yaml"), {("project", "title"): text}, "name", "heading")


def test_a_stored_study_brings_no_control_characters_into_a_report(
    stored: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    state = json.loads((stored / "study.json").read_text("utf-8"))
    write_state(stored, state | {"study": "\x1b[2J\n\u202ex.yaml"})  # by somebody who seals it too
    assert main(["calc", f"{stored}#1", "--plugins", str(GOOD)]) == 0
    printed = "".join(capfd.readouterr())
    title = json.loads(printed[printed.index("{") : printed.rindex("}") + 1])["project"]["title"]
    assert "\x1b" not in title and "\u202e" not in title


@pytest.mark.parametrize("target", READERS)
@pytest.mark.nightly
def test_what_the_fuzzer_kept_is_read_or_refused_in_words(target: str) -> None:
    kept = sorted((CORPUS / target).iterdir())
    read = READERS[target]()
    assert kept
    for path in kept:
        read(path.read_bytes())


@pytest.mark.parametrize("target", READERS)
def test_the_sound_inputs_that_the_fuzzer_begins_with_are_read(target: str) -> None:
    read = READERS[target]()
    for seed in seeds(target):
        read(seed)
    assert words(target)
