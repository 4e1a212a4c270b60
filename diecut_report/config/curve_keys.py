"""Keys that take a number or a curve: a value that is a curve stands under the key of the curve, wherever it was typed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from diecut_report.config.instances import Instance
from diecut_report.config.references import Linker


def linked(instances: Mapping[str, Instance | None]) -> Linker:
    """Return the links of all instances, whose curves stand under their own keys then (``Block.curve_keys``).

    What a mechanism gives may depend on that, and so whether a reference to it is a curve: it is asked until nothing moves.
    """
    linker = Linker(instances)
    while _any_moved(instances, linker):
        linker = Linker(instances)
    return linker


def _any_moved(instances: Mapping[str, Instance | None], linker: Linker) -> bool:
    """Lay curves under their own keys, but where that is asked of an instance that has just changed; return whether there were any."""
    moved: set[str] = set()
    for instance in filter(None, instances.values()):
        asked = (linker.links.get((instance.name, key)) for key in instance.model.curve_keys)
        if not any(target.instance in moved for target in asked if target) and _moved(instance, linker):
            moved.add(instance.name)
    return bool(moved)


def _moved(instance: Instance, linker: Linker) -> bool:
    """Lay curves under their own keys; return whether there were any."""
    found = [
        (key, curve)
        for key, curve in instance.model.curve_keys.items()
        if instance.data.get(curve) is None and _is_curve(instance, key, linker)
    ]
    for key, curve in found:
        instance.data[curve] = instance.data.pop(key)
        instance.place = replace(instance.place, listed={**instance.place.listed, (curve,): (key,)})
        instance.bases = {(curve,) if at == (key,) else at: basis for at, basis in instance.bases.items()}
    if found:
        instance.forget()
    return bool(found)


def _is_curve(instance: Instance, key: str, linker: Linker) -> bool:
    target = linker.links.get((instance.name, key))
    return isinstance(instance.data.get(key), list) or (target is not None and target.is_curve)
