"""What to change where a check of the gear pair fails: numbers that pass once they are typed in."""

from __future__ import annotations

from collections.abc import Callable

from diecut_report.api import Phrase, joined, phrase, told

KEYS = ("application_factor", "dynamic_factor", "face_load_factor", "transverse_load_factor")


def assumed_factors(*assumed: float) -> str:
    """The keys of the factors that are assumed."""
    names = [key for key, is_assumed in zip(KEYS, assumed, strict=True) if is_assumed]
    return joined([joined(names[:-1], ", "), names[-1]] if len(names) > 1 else names, " and ")


def no_module(face_width: float) -> str:
    """Words where no module of the series is enough."""
    return Phrase(
        "take a greater face_width than {face_width}, better steel or a smaller torque, or give a module",
        face_width=told(face_width, "mm"),
    )


def greater_module(module: float, least: float) -> str:
    """The module of the series with which flank and root of both gears hold, where there is one."""
    return Phrase(", or set module to {least}", least=told(least, "mm")) if least > module else ""


def greater_module_and_distance(_: float) -> str:
    """Words where the module is bound to the distance of the axes."""
    return phrase(", or take a greater center_distance and module")


def _wider(width: float, widest: float) -> str:
    return (
        Phrase(", or set face_width to at least {width}", width=told(width, "mm", up=True)) if width <= widest else ""
    )


def against_pitting(gear: int) -> Callable[..., str]:
    """Words for a gear whose flank fails: the contact stress falls at least with the root of the width."""

    def advice(limit: float, safety: float, required: float, face_width: float, widest: float) -> str:
        lacking = required / safety
        stronger = Phrase(
            "set sigma_h_lim_{gear} to at least {limit}", gear=gear, limit=told(limit * lacking, "MPa", up=True)
        )
        return stronger + _wider(face_width * lacking**2, widest)

    return advice


def against_breakage(gear: int) -> Callable[..., str]:
    """Words for a gear whose root fails: with the width the load's unevenness grows, at most to that of the flank."""

    def advice(
        limit: float, safety: float, required: float, face_width: float, widest: float, face_load: float, at_root: float
    ) -> str:
        lacking = required / safety
        stronger = Phrase(
            "set sigma_f_lim_{gear} to at least {limit}", gear=gear, limit=told(limit * lacking, "MPa", up=True)
        )
        return stronger + _wider(face_width * lacking * face_load / at_root, widest)

    return advice


def against_undercut(shift_1: float, least_1: float, shift_2: float, least_2: float) -> str:
    """Shifts from which no root is undercut."""
    pairs = (("shift_1", shift_1, least_1), ("shift_2", shift_2, least_2))
    changes = [
        Phrase("set {key} to at least {least}", key=key, least=told(least, "1", up=True))
        for key, shift, least in pairs
        if shift < least
    ]
    return joined(changes, " and ")


def against_undercut_at_distance(shift_1: float, least_1: float, shift_2: float, least_2: float) -> str:
    """The same where the wheel's shift follows from the distance of the axes."""
    if shift_1 < least_1:
        return Phrase("set shift_1 to at least {least_1}", least_1=told(least_1, "1", up=True))
    most = told(shift_1 + shift_2 - least_2, "1", up=False)
    return Phrase("set shift_1 to at most {most}, so that the wheel has the rest", most=most)


def clearance_for(share: float) -> Callable[..., str]:
    """Words for tips that come nearer to the roots than this share of the module."""

    def advice(clearance: float, module: float, addendum: float, dedendum: float) -> str:
        if dedendum - addendum >= share * (1 - 1e-9):
            return phrase("set keep_clearance to true")
        return Phrase(
            "set dedendum to at least {dedendum}", dedendum=told(dedendum + share - clearance / module, "1", up=True)
        )

    return advice
