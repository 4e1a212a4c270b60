"""What to change where a check fails: texts with numbers that pass when they are put in."""

from __future__ import annotations

from math import ceil, floor, isfinite, log10

from diecut_report.api import told

DIGITS = 3


def rounded(value: float, up: bool) -> float:
    """A number rounded up or down to so many significant digits as are printed; what has no digits stays."""
    if not (isfinite(value) and value > 0):
        return value
    step = 10.0 ** (floor(log10(value)) - DIGITS + 1)
    return step * (ceil(value / step - 1e-9) if up else floor(value / step + 1e-9))


def against_stress(free_length: float) -> str:
    """Words where the given length is too short."""
    enough = told(rounded(free_length, up=True), "mm", DIGITS)
    return f"set adopted_length to at least {enough}, or leave it out, and the length is sized"


def against_strain(
    modulus: float, strain: float, max_strain: float, allowable_stress: float, adopted_length: float
) -> str:
    """Words where the rubber is strained too far: at one length the strain falls with the root of modulus and length."""
    excess = (strain / max_strain) ** 2
    stiffer = told(rounded(max(allowable_stress / max_strain, modulus * excess), up=True), "MPa", DIGITS)
    longer = told(rounded(adopted_length * excess, up=True), "mm", DIGITS)
    return f"take a rubber with a modulus of at least {stiffer}, or set adopted_length to at least {longer}"


def against_buckling(
    side: float, count: float, length: float, modulus: float, allowable_stress: float, max_strain: float
) -> str:
    """Words where the block buckles: a wider pad, more dampers, a softer rubber if that is not strained too far."""
    softer = rounded(modulus, up=False)
    advice = f"take a pad of at least {told(side, 'mm', DIGITS)} by {told(side, 'mm', DIGITS)}, or {count:.0f} dampers of this pad"
    held = f"each at a length of at most {told(rounded(length, up=False), 'mm', DIGITS)}"
    if allowable_stress <= softer * max_strain:
        return f"{advice}, or a rubber with a modulus of at most {told(softer, 'MPa', DIGITS)}, {held}"
    return f"{advice}, {held}; a softer rubber alone does not help: short enough, it would be strained by more than {max_strain:g}"


def against_drive(length: float, count: float, adopted_length: float) -> str:
    """Words where the drive that still pushes overloads the dampers."""
    more = f"{count:.0f} dampers with adopted_length: {told(adopted_length, 'mm', DIGITS)}"
    if isfinite(length):
        return f"set adopted_length to {told(length, 'mm', DIGITS)}, or take {more}"
    return f"no length helps against this force; take {more}, or a drive that lets go before the stop"
