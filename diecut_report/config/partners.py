"""Partners: the mechanisms from which a kind takes inputs by itself, and the kinds that run without being asked."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from diecut_report.config.instances import Instance
from diecut_report.config.validation import told
from diecut_report.contract.mechanism import Mechanism, Partner
from diecut_report.errors import nearest
from diecut_report.languages.phrases import Phrase

BY_THEMSELVES = ("press_consistency",)  # known by name: to ask every plugin, all would have to be loaded
FEWEST = 2  # partners that a kind needs to run by itself: a single mechanism cannot contradict another

Instances = Mapping[str, Instance | None]
Kinds = Mapping[str, str]  # of the mechanisms, by their names


def taken(mechanism: Mechanism, data: Mapping[str, Any], instances: Instances, kinds: Kinds) -> dict[str, str]:
    """Return what a block takes from its partners where it gives nothing itself: their names, and references to what they have."""
    return {key: text for key, text in _offered(mechanism, data, instances, kinds).items() if data.get(key) is None}


def overruled(
    mechanism: Mechanism, data: Mapping[str, Any], instances: Instances, kinds: Kinds
) -> Iterator[tuple[str, Phrase]]:
    """Yield the keys of a block that compares others which are typed in place of what these have, with what is wrong: a verdict must not be typed."""
    if mechanism.kind not in BY_THEMSELVES:
        return
    names = {partner.key for partner in mechanism.partners}
    for key, reference in _offered(mechanism, data, instances, kinds).items():
        if key not in names and data.get(key) not in (None, reference):
            yield key, typed_beside(reference)


def typed_beside(reference: str) -> Phrase:
    """Return what is wrong with a value in place of what a block that compares others takes from them."""
    words = "is typed here, but {reference} has it, which is compared with the others. Remove the key; change it there."
    return Phrase(words, reference=reference)


def compared(instance: Instance) -> dict[str, str]:
    """Return what a block that compares others takes from them, by its keys: their names, and references."""
    is_asked = instance.mechanism is not None and instance.mechanism.kind in BY_THEMSELVES
    return {key: instance.data[key] for key in instance.derived if is_asked}


def _offered(mechanism: Mechanism, data: Mapping[str, Any], instances: Instances, kinds: Kinds) -> dict[str, str]:
    """What the partners of a block have for it: their names, and references."""
    found: dict[str, str] = {}
    for partner in mechanism.partners:
        name = data.get(partner.key) or only(partner, kinds)
        if fault(partner, name, kinds) or (instance := instances[str(name)]) is None:
            continue
        found |= {partner.key: str(name)} | dict(_references(partner, instance))
    return found


def only(partner: Partner, kinds: Kinds) -> str | None:
    """Return the only mechanism of a partner's kinds; None where there is none, or where there are several."""
    found = [name for name, kind in kinds.items() if kind in partner.kinds]
    return found[0] if len(found) == 1 else None


def fault(partner: Partner, name: Any, kinds: Kinds) -> str:
    """Return what is wrong with the name of a partner, in words; nothing where it is right."""
    wanted = " or ".join(partner.kinds)
    if not isinstance(name, str) or name not in kinds:
        near = nearest(name, kinds) if isinstance(name, str) else ""
        return Phrase(
            "is {name}; the name of a mechanism of kind {wanted} is needed{near}. Known: {kinds}.",
            name=told(name),
            wanted=wanted,
            near=near,
            kinds=", ".join(kinds),
        )
    if kinds[name] not in partner.kinds:
        return Phrase(
            "is {name}, of kind {kinds}; the name of a mechanism of kind {wanted} is needed.",
            name=name,
            kinds=kinds[name],
            wanted=wanted,
        )
    return ""


def is_called_for(mechanism: Mechanism, kinds: Kinds) -> bool:
    """Return whether a config has mechanisms enough for a kind to run by itself."""
    wanted = {kind for partner in mechanism.partners for kind in partner.kinds}
    return sum(kind in wanted for kind in kinds.values()) >= FEWEST


def free_name(kind: str, instances: Instances) -> str:
    """Return a name for what runs by itself: its kind, with a number where a mechanism is called so."""
    names = (kind, *(f"{kind}_{number}" for number in range(2, len(instances) + 3)))
    return next(name for name in names if name not in instances)


def _references(partner: Partner, instance: Instance) -> Iterator[tuple[str, str]]:
    for key, name in partner.takes.items():
        if name in instance.results or name in instance.given:
            yield key, f"${{{instance.name}.{name}}}"
