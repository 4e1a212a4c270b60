"""What the fuzzer kept (scripts/fuzz.py) is read to the end, or refused in words."""

from __future__ import annotations

import pytest

from tests.hostile.readers import CORPUS, READERS
from tests.hostile.seeds import seeds, words


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
