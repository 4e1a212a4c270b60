"""What to change where a check fails: numbers with which it passes once they are typed in."""

from __future__ import annotations

from diecut_report.api import Phrase, below, phrase, si, told

STIFFEST = 1e-6  # m, stretch below which no drive can be built


def softest_drive(deformation_limit: float) -> str:
    """The stretch of the drive with which friction holds the relaxing rods back."""
    return _held(deformation_limit) or Phrase(
        "set drive_deformation to at most {less}", less=_less(deformation_limit, "mm")
    )


def thinnest_rods(deformation_limit: float, drive_deformation: float, rod_area: float, elastic_modulus: float) -> str:
    """The rods' cross-section with which friction holds them back when they relax."""
    if _held(deformation_limit):
        return _held(deformation_limit)
    # a hair less stretch than the limit, for at the limit itself the check fails
    least = rod_area * drive_deformation / (deformation_limit * (1 - 1e-9))
    return Phrase(
        "set rod_area to at least {least} at elastic_modulus: {elastic_modulus}",
        least=told(least, "mm**2", up=True),
        elastic_modulus=told(elastic_modulus, "GPa"),
    )


def _held(deformation_limit: float) -> str:
    """Words for joints with next to no friction: no drive is stiff enough for them."""
    return (
        ""
        if deformation_limit > STIFFEST
        else phrase("check friction, for with so little of it in the joints any stretch does so")
    )


def _less(value: float, display: str) -> str:
    """A number rounded down, and less than itself."""
    return told(si(below(value / si(1, display)), display), display)


def smaller_force(
    torque_max: float,
    allowable_torque: float,
    cutting_force_max: float,
    torque_max_angle: float,
    cutting_start_angle: float,
    inertia_force_max: float,
    crank_radius: float,
    weight_torque: float = 0.0,
) -> str:
    """The cutting force with which the torque is allowed; ``weight_torque`` is what of it the force does not change.

    While cutting, torque falls at least in proportion to the force, but for the guides' friction under the platen's weight.
    """
    idle = 2 * inertia_force_max * crank_radius + weight_torque  # more than the torque of free travel
    if torque_max_angle > cutting_start_angle or idle >= allowable_torque:
        return phrase(
            "a slower machine, a lighter platen or less friction lowers it, for the platen's own motion takes so much"
        )
    share = (allowable_torque - weight_torque) / (torque_max - weight_torque)
    force = told(share * cutting_force_max, "kN", up=False)
    return Phrase(
        "set cutting_force_max to at most {force}, with shorter rules or softer board; a stiffer drive lowers it too",
        force=force,
    )
