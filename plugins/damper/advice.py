"""What to change where a check fails: numbers with which all checks of the block pass once they are typed in."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from math import ceil, isfinite

import numpy as np

from diecut_report.api import Phrase, joined, outward, phrase, told
from diecut_report.plugins.damper import formulas as f

DIGITS = 4  # of lengths; a pad's side has one less, so that three sides have no more
SOFTEST, HARDEST = 20.0, 80.0  # Shore A hardness that may be given
MOST_DAMPERS, WIDEST_PAD = 100, 1.0  # beyond these no advice is given: nobody builds it
ROUNDING = 1e-9  # relative

Range = tuple[float, float]  # empty where the first is greater
NONE: Range = (np.inf, -np.inf)


@dataclass(frozen=True)
class RubberBlock:
    """A damper's numbers, SI; what is not given (a length, a hardness) has none, and a drive that does not push no force."""

    kinetic_energy: float
    elastic_modulus: float
    ring_width: float
    pad_height: float
    damper_count: float
    allowable_stress: float
    max_strain: float
    length_step: float
    driving_force: float = 0.0
    adopted_length: float | None = None
    shore_hardness: float | None = None
    dynamic_stiffness_factor: float = 1.0

    @property
    def area(self) -> float:
        """Area of all dampers together."""
        return self.damper_count * self.ring_width * self.pad_height

    @property
    def stress_limit(self) -> float:
        """Stress that is allowed and within the linear law."""
        return float(f.stress_limit(self.allowable_stress, self.elastic_modulus, self.max_strain))

    @property
    def three_sides(self) -> float:
        """Length above which the block buckles."""
        return float(f.three_sides(min(self.ring_width, self.pad_height)))

    @property
    def longest(self) -> float:
        """Length up to which the block does not buckle, as it is printed."""
        return outward(self.three_sides, up=False)

    def shortest(self, count: float, area: float) -> float:
        """Length at which so many dampers of an area take up the energy and the work of the drive."""
        if self.driving_force >= f.force_limit(count, area, self.stress_limit):
            return np.inf
        needed = (self.kinetic_energy, self.elastic_modulus, self.stress_limit, count, area, self.driving_force)
        return float(f.driven_length(*needed))

    def in_steps(self, length: float) -> float:
        """The next multiple of the step."""
        return float(f.whole_steps_above(length, self.length_step))

    def moduli(self, length: float | None) -> Range:
        """Moduli with which all checks pass at a length, or where there is none, at the sized one."""
        if length is None:
            return self._moduli_sized()
        if length > self.three_sides * (1 + ROUNDING):
            return NONE
        work = self.kinetic_energy + self.driving_force * self.max_strain * length
        borne = self.area * self.allowable_stress - 2 * self.driving_force
        stiffest = self.allowable_stress * borne * length / (2 * self.kinetic_energy)
        return 2 * work / (self.area * self.max_strain**2 * length), stiffest

    def _moduli_sized(self) -> Range:
        """The sized length strains by allowed stress over modulus, grows with the modulus, and does not bear a drive."""
        if self.driving_force > 0:
            return NONE
        longest = self.length_step * float(np.floor(self.three_sides / self.length_step + ROUNDING))
        stiffest = longest * self.area * self.allowable_stress**2 / (2 * self.kinetic_energy)
        return self.allowable_stress / self.max_strain, stiffest


def advice(names: tuple[str, ...]) -> Callable[..., str]:
    """The words for a damper of which these numbers are known."""

    def words(*numbers: float) -> str:
        with np.errstate(all="ignore"):
            return against_failure(RubberBlock(**dict(zip(names, map(np.float64, numbers), strict=True))))

    return words


def against_failure(block: RubberBlock) -> str:
    """All changes of one kind that make every check pass, and the kinds of which none does."""
    lengths, rubbers = list(_lengths(block)), list(_rubbers(block))
    changes = [*lengths, *rubbers, *([] if lengths else [*_dampers(block), *_pad(block)])]
    kind = "elastic_modulus" if block.shore_hardness is None else "shore_hardness"
    missing = [name for name, found in (("adopted_length", lengths), (kind, rubbers)) if not found]
    if not changes:
        return Phrase(
            "check kinetic_energy and allowable_stress: no adopted_length or {kind} helps, nor do up to "
            "{most_dampers} dampers or a pad of up to {widest_pad} a side",
            kind=kind,
            most_dampers=MOST_DAMPERS,
            widest_pad=told(WIDEST_PAD, "mm"),
        )
    return joined(changes, ", or ") + (
        Phrase("; no {missing} alone helps", missing=joined(missing, " or ")) if missing else ""
    )


def _between(key: str, low: str, high: str) -> str:
    return (
        Phrase("set {key} to {low}", key=key, low=low)
        if low == high
        else Phrase("set {key} to between {low} and {high}", key=key, low=low, high=high)
    )


def _lengths(block: RubberBlock) -> Iterator[str]:
    """Lengths of this block that pass."""
    least = block.shortest(block.damper_count, block.ring_width * block.pad_height)
    low, high = outward(least, up=True), block.longest
    if low <= high:
        yield _between("adopted_length", told(low, "mm", DIGITS), told(high, "mm", DIGITS))
    if block.adopted_length is not None and not block.driving_force:
        sized = block.in_steps(
            f.free_length(block.kinetic_energy, block.elastic_modulus, 1, block.area, block.allowable_stress)
        )
        if least <= sized * (1 + ROUNDING) and sized <= block.three_sides * (1 + ROUNDING):
            yield phrase("leave adopted_length out, and the length is sized")


def _rubbers(block: RubberBlock) -> Iterator[str]:
    """Moduli, or hardnesses, that pass with the length as it is now, or else with another one."""
    at_longest = Phrase(" with adopted_length: {longest}", longest=told(block.longest, "mm", DIGITS))
    sized = "" if block.adopted_length is None else phrase(" and leave adopted_length out")
    lengths = {block.adopted_length: "", None: sized, block.longest: at_longest}
    for length, words in lengths.items():
        spoken = _rubber(block, block.moduli(length))
        if spoken:
            yield spoken + words
            return


def _rubber(block: RubberBlock, moduli: Range) -> str:
    """Moduli as the key that is given takes them; nothing where there is none."""
    key, display, digits = "elastic_modulus", "MPa", (3, DIGITS)
    if not 0 < moduli[0] <= moduli[1]:
        return ""
    low, high = (modulus / block.dynamic_stiffness_factor for modulus in moduli)
    if block.shore_hardness is not None:
        low, high = max(_hardness(low), SOFTEST), min(_hardness(high), HARDEST)
        key, display, digits = "shore_hardness", "1", (2, 3)
    for shown in digits:
        least, most = outward(low, True, shown), outward(high, False, shown)
        if least <= most and isfinite(most):
            return _between(key, told(least, display, shown), told(most, display, shown))
    return ""


def _hardness(modulus: float) -> float:
    """Hardness of a rubber by Gent's relation, within the hardnesses that may be given and one beyond each end."""
    softest, hardest = SOFTEST - 1, HARDEST + 1
    if modulus <= f.gent_modulus(softest):
        return softest
    if modulus >= f.gent_modulus(hardest):
        return hardest
    from scipy.optimize import brentq  # slow to import, and not needed where nothing fails

    return float(brentq(lambda hardness: f.gent_modulus(hardness) - modulus, softest, hardest))


def _dampers(block: RubberBlock) -> Iterator[str]:
    """More dampers of this pad, with their length."""
    area, longest, stress = block.ring_width * block.pad_height, block.longest, block.stress_limit
    demanded = 2 * block.kinetic_energy * block.elastic_modulus / (longest * stress) + 2 * block.driving_force
    count = demanded / (area * stress)
    if count <= MOST_DAMPERS:
        whole = max(ceil(count - ROUNDING), round(block.damper_count) + 1)
        length = min(outward(block.in_steps(block.shortest(whole, area)), up=True), longest)
        yield Phrase(
            "take {whole} dampers of this pad with adopted_length: {length}",
            whole=whole,
            length=told(length, "mm", DIGITS),
        )


def _pad(block: RubberBlock) -> Iterator[str]:
    """A square pad whose length of three sides passes: n·[σ]·b³ − 2F·b = 2W·E/(3[σ])."""
    borne = block.damper_count * block.stress_limit
    still = (2 * block.kinetic_energy * block.elastic_modulus / (3 * block.stress_limit * borne)) ** (1 / 3)
    pushed = 2 * block.driving_force / (borne * still**2)
    if not (isfinite(still) and isfinite(pushed)):
        return
    least = still * float(np.roots([1, 0, -pushed, -1]).real.max())
    side = outward(block.in_steps(least), up=True, digits=DIGITS - 1)
    if side <= WIDEST_PAD:
        length = min(outward(block.in_steps(block.shortest(block.damper_count, side**2)), up=True), 3 * side)
        shown = told(side, "mm", DIGITS - 1)
        yield Phrase(
            "take a pad of at least {shown} by {shown} with adopted_length: {length}",
            shown=shown,
            length=told(length, "mm", DIGITS),
        )
