"""The keys that the parts of a machine take: a form of each block, with a comment beside each key, made of the declarations that judge the file."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from diecut_report.config.drafting import OPEN, STEP, BlockWriter, DraftLine, laid_out, remarks, shifted
from diecut_report.config.parts.keys import MachineKeys
from diecut_report.config.parts.reading import BODY, MODELS, PAIRS
from diecut_report.text.translation import said, say

GO_ON_TO = {
    "shafts": ("shaft", "rolling_bearing", "parallel_key"),
    "meshes": ("gear_pair",),
    "chains": ("roller_chain",),
    "belts": ("drive_train",),
}
"""Kinds that calculate the parts, to which keys that are not their own go on."""


def part_forms(words: Iterable[str]) -> str:
    """Return the forms of blocks such as ``shafts`` one below the other, in the language that is spoken."""
    return "\n\n".join("\n".join(_form(word)) for word in words) + "\n"


def _form(word: str) -> Iterator[str]:
    template = (
        "Each key stands with its symbol, meaning and range; a bare number is in the unit that stands here. Remove the # of "
        "the keys that you give, and put in a value where … stands."
    )
    yield from remarks(say(template))
    if kinds := GO_ON_TO.get(word):
        template = "Other keys go on to the calculation that is made of it: `diecut-report new {kinds}` explains them."
        yield from remarks(say(template, kinds=" ".join(kinds)))
    home = [DraftLine("NAME:", indent=STEP)] if word in MODELS else []
    yield from laid_out([DraftLine(f"{word}:"), *home, *shifted(_keys(word), STEP * (1 + len(home)))])


def _keys(word: str) -> Iterator[DraftLine]:
    """The keys of a block, with those whose texts are taken apart, and those of a body that may refer to results."""
    model = MODELS.get(word, MachineKeys)
    yield from BlockWriter().off(model, {})
    if pair := PAIRS.get(model):
        words = say("in place of {keys}: {form}", keys=", ".join(pair.single), form=said(pair.form))
        yield DraftLine(f"{pair.key}: {OPEN}", words, off=True)
    if word == "shafts":
        for key, meta in BODY.items():
            yield DraftLine(
                f"{' ' * 2 * STEP}{key}: {OPEN} {meta.unit}", f"{meta.symbol}: {said(meta.description)}", off=True
            )
        words = say("in place of the list: diameter x length in mm, r with the fillet; 60/30x320 is bored 30")
        yield DraftLine("sections: 45x70 r1, 60x320", words, off=True)
