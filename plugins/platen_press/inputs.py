"""Inputs of the platen press."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar, Self

from diecut_report.api import POINTS, Annotated, Inputs, OneOf, Quantity

# fmt: off

STRETCH = "drive_deformation"
RODS = ("rod_area", "elastic_modulus")
"""Keys from which the stretch of the drive follows where it is not given."""

JOINTS = ("friction_guide", "friction_platen_pin", "friction_crank_pin", "friction_journal")
"""Keys of the single coefficients of friction f₁…f₄, in the order of a list."""

INSTEAD = {STRETCH: RODS[:1], "friction": JOINTS}
"""Keys with a default, each with those that are given instead of it."""


def coefficient(place: str, symbol: str) -> Quantity:
    """The declaration of one coefficient of friction."""
    return Quantity(symbol, "1", f"Coefficient of friction {place}", ge=0, le=1)


def without_idle_defaults(keys: Mapping[str, Any]) -> dict[str, Any]:
    """The keys, without a default that the keys beside it leave no use."""
    optional = (STRETCH, *RODS, "friction", *JOINTS)
    given = {key: value for key, value in keys.items() if value is not None or key not in optional}
    idle = [key for key, others in INSTEAD.items() if given.keys() >= set(others)]
    return given | {key: None for key in idle if key not in given}


class PlatenPress(Inputs):
    """Keys of ``platen_press``."""

    one_of: ClassVar[tuple[OneOf, ...]] = (OneOf((STRETCH,), RODS, optional=True),)
    spread: ClassVar[Mapping[str, tuple[str, ...]]] = {"friction": JOINTS}

    cycles_per_hour: Annotated[float, Quantity("n", "1/h", "Cycle rate of the platen, one revolution of the crank per cycle", gt=0, le=1e6)] = 1200
    cutting_force_max: Annotated[float, Quantity("P_max", "kN", "Maximum cutting force, of both rods together", gt=0)] = 500
    platen_mass: Annotated[float, Quantity("m", "kg", "Mass of the platen and the parts that move with it", ge=0)] = 306
    drive_deformation: Annotated[float | None,
        Quantity("Δl_m", "mm", "Elongation of the drive at the platen under the maximum cutting force; or rod_area and elastic_modulus",
            ge=1e-9)] = 0.45
    rod_area: Annotated[float | None,
        Quantity("A", "mm**2", "Cross-section of one of the two rods; with elastic_modulus gives their elongation", gt=0)] = None
    elastic_modulus: Annotated[float | None, Quantity("E", "GPa", "Elastic modulus of the rods; with rod_area gives their elongation", gt=0)] = None
    material_thickness: Annotated[float, Quantity("s", "mm", "Thickness of the board", gt=0)] = 0.5
    crank_radius: Annotated[float, Quantity("r", "mm", "Radius of the crank", gt=0)] = 110
    rod_length: Annotated[float, Quantity("l", "mm", "Unloaded length of the rods", gt=0)] = 635
    journal_radius: Annotated[float, Quantity("r_0", "mm", "Radius of the crankshaft's journals", gt=0)] = 50.25
    crank_pin_radius: Annotated[float, Quantity("r_A", "mm", "Radius of the crank pins", gt=0)] = 47.5
    platen_pin_radius: Annotated[float, Quantity("r_B", "mm", "Radius of the platen's pins", gt=0)] = 60
    friction: Annotated[float | None,
        Quantity("f", "1", "Coefficient of friction of all joints and guides; or a list of four: guides, platen pins, crank pins, journals",
            ge=0, le=1)] = 0.1
    friction_guide: Annotated[float | None, coefficient("of the guides, if different from the common one", "f_1")] = None
    friction_platen_pin: Annotated[float | None, coefficient("of the platen's pins, if different from the common one", "f_2")] = None
    friction_crank_pin: Annotated[float | None, coefficient("of the crank pins, if different from the common one", "f_3")] = None
    friction_journal: Annotated[float | None, coefficient("of the journals, if different from the common one", "f_4")] = None
    journal_length: Annotated[float | None, Quantity("b_0", "mm", "Length of one of the two journals; required for their pressure", gt=0)] = None
    crank_pin_length: Annotated[float | None, Quantity("b_A", "mm", "Length of one of the two crank pins; required for their pressure", gt=0)] = None
    platen_pin_length: Annotated[float | None,
        Quantity("b_B", "mm", "Length of one of the two platen pins; required for their pressure", gt=0)] = None
    rod_net_area: Annotated[float | None,
        Quantity("A_n", "mm**2", "Minimum cross-section of one of the two rods, at its eye or shank; required for their stress", gt=0)] = None
    offset_force: Annotated[float, Quantity("h_1", "mm", "Offset of the rods' force from the axis of the guides")] = 0
    offset_weight: Annotated[float, Quantity("h_2", "mm", "Offset of the platen's weight from the axis of the guides")] = 0
    guide_length: Annotated[float | None, Quantity("b", "mm", "Length of the guides; required if a force is offset", gt=0)] = None
    carriage_clearance: Annotated[float | None,
        Quantity("c_r", "mm", "Clearance required by the carriages at the platen; required for their window", gt=0)] = None
    allowable_torque: Annotated[float | None, Quantity("[M]", "N*m", "Allowable torque at the main shaft", gt=0)] = None
    allowable_pin_pressure: Annotated[float | None,
        Quantity("[p]", "MPa", "Allowable pressure of journals and pins, on their projected area", gt=0)] = None
    allowable_rod_stress: Annotated[float | None,
        Quantity("[σ]", "MPa", "Allowable pulsating stress of the rods, on their minimum cross-section", gt=0)] = None
    n_points: Annotated[int, POINTS] = 720

    @classmethod
    def model_validate(cls, obj: Any, **how: Any) -> Self:
        """The validated keys; see ``without_idle_defaults``."""
        return super().model_validate(without_idle_defaults(obj) if isinstance(obj, Mapping) else obj, **how)
