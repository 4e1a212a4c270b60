"""Where an input comes from: given in the file, by default, or by reference."""

from __future__ import annotations

from diecut_report.config.instances import Instance, Slot
from diecut_report.config.loader import Config
from diecut_report.results.stated_inputs import Origin, Provenance


def origin_of(config: Config, instance: Instance, slot: Slot) -> Provenance:
    """Return where an input comes from; what it rests on is not said."""
    target = config.links.get((instance.name, *slot.key))
    typed = instance.place.typed(slot.key) if slot.is_given else None
    if target is not None and target.expression:
        return Provenance("expression", "", typed, tuple(term.path for term in target.terms))
    origin: Origin = "default" if not slot.is_given else "reference" if target else "given"
    return Provenance(origin, target.path if target else "", typed)
