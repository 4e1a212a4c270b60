"""Masses and moments of inertia of the shafts with their parts."""

from __future__ import annotations

from typing import Any

from diecut_report.config.parts.demands import Demands, TypedNumber, TypedValue, millimetres
from diecut_report.config.parts.keys import ChainKeys, MeshKeys
from diecut_report.config.parts.model import Join, MachineShaft, ShaftPart, chain_pitch
from diecut_report.mechanics.geneva_wheel import area_and_polar
from diecut_report.quantities.units import unit
from diecut_report.standards import standard_table

STEEL = 7850  # kg/m³


class Masses(Demands):
    """Make the calculations of masses and moments of inertia."""

    def _body(self, shaft: MachineShaft) -> None:
        home = shaft.body
        discs: list[dict[str, Any]] = [self._section_disc(shaft, index) for index in range(len(shaft.sections))]
        bodies: list[dict[str, Any]] = []
        for part in shaft.parts:
            if disc := self._disc(part):
                discs.append({"name": part.name} | disc)
            elif "mass" in part.more or part.kind == "geneva_wheel" or "inertia" in part.more:
                bodies.append({"name": part.name} | self._mass(part, f"{home}.bodies.{len(bodies)}.mass"))
        inputs: dict[str, Any] = {"discs": discs} | ({"bodies": bodies} if bodies else {})
        self._add(home, "shaft_body", inputs, shaft.path)

    def _section_disc(self, shaft: MachineShaft, index: int) -> dict[str, Any]:
        section = self._section(shaft, index)
        found = {"name": f"section_{index + 1}", "diameter": section["diameter"], "width": section["length"]}
        return found | ({"bore": section["bore"]} if "bore" in section else {})

    def _section(self, shaft: MachineShaft, index: int) -> dict[str, Any]:
        own, path = shaft.keys.sections[index], (*shaft.path, "sections", index)
        if isinstance(self._raw(shaft.path).get("sections"), list):
            return {key: TypedValue((*path, key)) for key in self._raw(path)}
        found = {key: getattr(own, key) for key in ("length", "diameter", "bore", "fillet_radius")}
        return {
            key: TypedNumber(millimetres(value), (*shaft.path, "sections")) for key, value in found.items() if value
        }

    def _disc(self, part: ShaftPart) -> dict[str, Any] | None:
        """A part as a disc; None where its mass is typed or nothing is known of it."""
        join = next(self.parts.joins_of(part), None)
        if "mass" in part.more or part.kind == "geneva_wheel" or join is None:
            return None
        width = self._width(part, join)
        if width is None:
            return None
        found = {
            "diameter": TypedNumber(millimetres(2 * join.radius(part)), join.path),
            "width": TypedNumber(millimetres(width), part.path),
        }
        bore = part.keys.bore if part.keys.bore is not None else part.seat
        found |= {"bore": TypedNumber(millimetres(bore), part.path)} if bore else {}
        return found | ({"fill": TypedValue((*part.path, "fill"))} if part.keys.fill != 1 else {})

    @staticmethod
    def _width(part: ShaftPart, join: Join) -> float | None:
        if part.keys.width is not None:
            return part.keys.width
        if isinstance(join.keys, MeshKeys):
            return join.keys.width
        return tooth_width(join.keys) if isinstance(join.keys, ChainKeys) else part.keys.hub

    def _has_mass(self, part: ShaftPart) -> bool:
        return "mass" in part.more or self._is_sized(part) or self._disc(part) is not None

    def _is_sized(self, part: ShaftPart) -> bool:
        """Whether a part is the flywheel that the drive train sizes."""
        train = f"${{{self.named('drive_train')}.flywheel_inertia}}"
        return part.kind == "flywheel" and str(self._raw(part.path).get("inertia")) == train

    def _given_mass(self, part: ShaftPart) -> Any:
        return (
            f"${{{self.named('drive_train')}.flywheel_mass}}"
            if self._is_sized(part)
            else TypedValue((*part.path, "mass"))
        )

    def _mass(self, part: ShaftPart, mass: str) -> dict[str, Any]:
        """The mass of a part as it is typed, and its inertia: typed, or of a disc of that ``mass`` without bore."""
        join = next(self.parts.joins_of(part), None)
        found: dict[str, Any] = {"mass": self._given_mass(part) if "mass" in part.more or self._is_sized(part) else 0}
        if "inertia" in part.more:
            return found | {"inertia": TypedValue((*part.path, "inertia"))}
        if part.kind == "geneva_wheel" and "mass" not in part.more:
            return self._geneva_wheel(part)
        if join is not None:
            found["inertia"] = f"${{{mass}}} * ({millimetres(join.radius(part))})**2 / 2"
        return found

    def _geneva_wheel(self, part: ShaftPart) -> dict[str, Any]:
        mechanism = str(part.port and part.port[0])
        keys = self.parts.reader.typed_block(mechanism)
        if part.keys.width is None or not {"slots", "center_distance", "roller_radius"} <= keys.keys():
            return {"mass": 0}
        area, polar = area_and_polar(
            int(keys["slots"]), keys["center_distance"], keys["roller_radius"], keys.get("locking_radius"), part.seat
        )
        weight = STEEL * part.keys.width
        return {
            "mass": TypedNumber(f"{weight * area:.12g} kg", part.path),
            "inertia": TypedNumber(f"{weight * polar:.12g} kg*m**2", part.path),
        }


def tooth_width(keys: ChainKeys) -> float:
    """Return the width of a sprocket's teeth, m: 0.93 of the chain's inner width up to a pitch of 12.7 mm, 0.95 above (ISO 606).

    It is cut down to tenths of a millimetre, as the masses of the method's sheet want; catalogues have 11.1 mm for 12B, where this gives 11.0.
    """
    table = standard_table("iso_606_inner_widths")
    share = 0.93 if chain_pitch(keys) <= 12.7e-3 * (1 + 1e-9) else 0.95
    return int(share * table.values[keys.chain] * 10) / 10 * unit(table.unit).factor
