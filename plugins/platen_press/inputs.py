"""Inputs of the platen press."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, ClassVar, Self

from diecut_report.api import POINTS, Annotated, Inputs, OneOf, Quantity

JOINTS = {
    "friction_guide": "guides",
    "friction_platen_pin": "platen pins",
    "friction_crank_pin": "crank pins",
    "friction_journal": "journals",
}
"""Keys of the single coefficients of friction f₁…f₄, in the order of a list, and where each acts."""


class Frictions(Quantity):
    """A coefficient of friction, or a list of one for each place."""

    def validate(self, given: Any) -> Any:
        """The coefficient, or a tuple of one for each place; ValueError in words where it is not allowed."""
        if not isinstance(given, list):
            return super().validate(given)
        if len(given) != len(JOINTS):
            order = f"{len(JOINTS)} in this order: {', '.join(JOINTS.values())}"
            raise ValueError(f"has {len(given) or 'no'} values; give one coefficient for all, or {order}")
        return tuple(self._one_of(value, place) for value, place in zip(given, JOINTS.values(), strict=True))

    def _one_of(self, value: Any, place: str) -> Any:
        """One value of a list; a reference in it comes as a text with the unit of pure numbers."""
        try:
            return super().validate(value.removesuffix(" 1") if isinstance(value, str) else value)
        except ValueError as fault:
            raise ValueError(f"of the {place}: {fault}") from fault


EVERYWHERE = Frictions(
    "f",
    "1",
    f"Coefficient of friction of all joints and guides; or a list of four: {', '.join(JOINTS.values())}",
    ge=0,
    le=1,
)


def coefficient(place: str, symbol: str) -> Quantity:
    """The declaration of one coefficient of friction."""
    return Quantity(symbol, "1", f"Coefficient of friction {place}", ge=0, le=1)


class Stretch(OneOf):
    """What the stretch of the drive follows from; without any of the keys its default holds."""

    def fault(self, given: Iterable[str]) -> str:
        """What is wrong with the keys that are given, in words; empty where nothing is."""
        own = set(given).intersection(key for group in self.groups for key in group)
        return super().fault(own) if own else ""


def shared_out(keys: Mapping[str, Any]) -> dict[str, Any]:
    """The keys with a list of frictions as single ones, and without the default stretch where the rods' own is asked for."""
    found = dict(keys)
    if isinstance(found.get("friction"), list):
        found |= _single(found)
    elif found.get("friction", 0.0) is None and not found.keys() >= JOINTS.keys():
        found["friction"] = []  # refused in words
    if "rod_area" in found or "elastic_modulus" in found:
        found.setdefault("drive_deformation", None)
    return found


def _single(keys: Mapping[str, Any]) -> dict[str, Any]:
    """The values of a list of frictions under their own keys, where these are not given; nothing where the list is at fault."""
    try:
        values = EVERYWHERE.validate(keys["friction"])
    except ValueError:
        return {}  # the key's own validation says why
    return (
        dict(zip(JOINTS, values, strict=True)) | {key: keys[key] for key in JOINTS if key in keys} | {"friction": None}
    )


class PlatenPress(Inputs):
    """Keys of ``platen_press``."""

    one_of: ClassVar[tuple[OneOf, ...]] = (Stretch(("drive_deformation",), ("rod_area", "elastic_modulus")),)

    cycles_per_hour: Annotated[
        float, Quantity("n", "1/h", "Cycles of the platen, one turn of the crank each", gt=0)
    ] = 1200
    cutting_force_max: Annotated[
        float, Quantity("P_max", "kN", "Greatest cutting force, of both rods together", gt=0)
    ] = 500
    platen_mass: Annotated[float, Quantity("m", "kg", "Mass of the platen with what moves with it", ge=0)] = 306
    drive_deformation: Annotated[
        float | None,
        Quantity(
            "Δl_m",
            "mm",
            "Stretch of the drive at the platen under the greatest cutting force; or rod_area and elastic_modulus",
            gt=0,
        ),
    ] = 0.45
    rod_area: Annotated[
        float | None,
        Quantity("A", "mm**2", "Cross-section of one of the two rods; with elastic_modulus their stretch", gt=0),
    ] = None
    elastic_modulus: Annotated[
        float | None, Quantity("E", "GPa", "Elastic modulus of the rods; with rod_area their stretch", gt=0)
    ] = None
    material_thickness: Annotated[float, Quantity("s", "mm", "Thickness of the board", gt=0)] = 0.5
    crank_radius: Annotated[float, Quantity("r", "mm", "Radius of the crank", gt=0)] = 110
    rod_length: Annotated[float, Quantity("l", "mm", "Length of the rods without load", gt=0)] = 635
    journal_radius: Annotated[float, Quantity("r_0", "mm", "Radius of the crankshaft's journals", gt=0)] = 50.25
    crank_pin_radius: Annotated[float, Quantity("r_A", "mm", "Radius of the crank pins", gt=0)] = 47.5
    platen_pin_radius: Annotated[float, Quantity("r_B", "mm", "Radius of the platen's pins", gt=0)] = 60
    friction: Annotated[float | None, EVERYWHERE] = 0.1
    friction_guide: Annotated[float | None, coefficient("of the guides, where it is not that of all", "f_1")] = None
    friction_platen_pin: Annotated[
        float | None, coefficient("of the platen's pins, where it is not that of all", "f_2")
    ] = None
    friction_crank_pin: Annotated[
        float | None, coefficient("of the crank pins, where it is not that of all", "f_3")
    ] = None
    friction_journal: Annotated[float | None, coefficient("of the journals, where it is not that of all", "f_4")] = None
    journal_length: Annotated[
        float | None, Quantity("b_0", "mm", "Length of one of the two journals; with it their pressure", gt=0)
    ] = None
    crank_pin_length: Annotated[
        float | None, Quantity("b_A", "mm", "Length of one of the two crank pins; with it their pressure", gt=0)
    ] = None
    platen_pin_length: Annotated[
        float | None, Quantity("b_B", "mm", "Length of one of the two platen pins; with it their pressure", gt=0)
    ] = None
    offset_force: Annotated[float, Quantity("h_1", "mm", "Offset of the rods' force from the axis of the guides")] = 0
    offset_weight: Annotated[
        float, Quantity("h_2", "mm", "Offset of the platen's weight from the axis of the guides")
    ] = 0
    guide_length: Annotated[
        float | None, Quantity("b", "mm", "Length of the guides; needed where a force is offset", gt=0)
    ] = None
    allowable_torque: Annotated[float | None, Quantity("[M]", "N*m", "Allowed torque at the main shaft", gt=0)] = None
    allowable_pin_pressure: Annotated[
        float | None, Quantity("[p]", "MPa", "Allowed pressure of journals and pins, on their projected area", gt=0)
    ] = None
    n_points: Annotated[int, POINTS] = 720

    @classmethod
    def model_validate(cls, obj: Any, **how: Any) -> Self:
        """The validated keys; see ``shared_out``."""
        return super().model_validate(shared_out(obj) if isinstance(obj, Mapping) else obj, **how)
