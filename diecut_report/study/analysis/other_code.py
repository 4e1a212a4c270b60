"""What calculates a stored variant by other code than the study was calculated by."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from diecut_report.config.discovery import Discovery, DuplicateKind, UnknownKind
from diecut_report.config.source_hashes import plugin_hash, program_hash
from diecut_report.errors import PluginError
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.study.storage.description import code_told

SHORT = 12  # of a hash, as in a report
ABSENT = ""


def other_code(sources: Mapping[str, str], kinds: Iterable[str], discovery: Discovery) -> list[str]:
    """Return in words what has other code now than the ``sources`` of a study have noted, for variants of these kinds."""
    discovery.extend()
    now = {"program": program_hash()} | dict(_plugins(kinds, discovery))
    now |= {f"extension {name}": digest for name, digest in discovery.extended.items()}
    gone = [name for name in sources if name.startswith("extension ") and name not in now]
    pairs = [(name, sources.get(name, ABSENT), now.get(name, ABSENT)) for name in (*now, *gone)]
    return [
        Phrase(
            "The source of the {name} is not what the study was calculated by (SHA-256 {old} then, {new} "
            "now): the numbers of this variant may differ from those that are stored.",
            name=code_told(name),
            old=old[:SHORT] or phrase("none"),
            new=new[:SHORT] or phrase("none"),
        )
        for name, old, new in pairs
        if old != new and name.isprintable()  # a name of study.json may be by anybody
    ]


def _plugins(kinds: Iterable[str], discovery: Discovery) -> Iterator[tuple[str, str]]:
    for kind in dict.fromkeys(kinds):
        try:
            yield f"plugin {kind}", plugin_hash(discovery.mechanism(kind))
        except (PluginError, UnknownKind, DuplicateKind):  # reported where the configuration is read
            continue
