"""Masses and moments of inertia of the shafts with their parts."""

from __future__ import annotations

from collections.abc import Container, Iterable, Sequence
from math import pi, prod
from typing import Any

from diecut_report.config.parts.demands import Demands, Typed, millimetres
from diecut_report.config.parts.keys import ChainKeys, MeshKeys
from diecut_report.config.parts.model import Join, MachineParts, MachineShaft, ShaftPart, chain_pitch
from diecut_report.mechanics.geneva_wheel import area_and_polar, crank_radius
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
            elif self._is_body(part):
                bodies.append({"name": part.name} | self._mass(part, f"{home}.bodies.{len(bodies)}.mass"))
        inputs: dict[str, Any] = {"discs": discs} | ({"bodies": bodies} if bodies else {})
        self._add(home, "shaft_body", inputs, shaft.path)

    def own_inertias(self, shaft: MachineShaft) -> dict[str, str]:
        """Return the references to the moments of inertia of the parts on a shaft, by their names; nothing of those that have none."""
        found: dict[str, str] = {}
        bodies = 0
        for part in shaft.parts:
            if self._disc(part):
                found[part.name] = f"${{{shaft.body}.{part.name}_disc_inertia}}"
            elif self._is_body(part):
                if "inertia" in self._mass(part, ""):
                    found[part.name] = f"${{{shaft.body}.bodies.{bodies}.inertia}}"
                bodies += 1
        return found

    def section_inertia(self, shaft: MachineShaft) -> str:
        """Return the moment of inertia of a shaft without its parts."""
        return " + ".join(f"${{{shaft.body}.section_{index + 1}_disc_inertia}}" for index in range(len(shaft.sections)))

    def inertia_without(self, shaft: MachineShaft, left_out: Container[str]) -> str:
        """Return the moment of inertia of a shaft with its parts, but for those that are named."""
        parts = (text for name, text in self.own_inertias(shaft).items() if name not in left_out)
        return " + ".join([self.section_inertia(shaft), *parts])

    def inertia_of_steady(self, start: str, names: Iterable[str]) -> str:
        """Return the moment of inertia of shafts that turn steadily, with their parts, at one of them; nothing where no mass of them is known."""
        own = self.parts.ratios[start]
        every = ((self.parts.shafts[name], abs(self.parts.ratios[name] / own)) for name in names)
        known = ((shaft, ratio) for shaft, ratio in every if self.is_made(shaft.body))
        return " + ".join(f"({self.whole(shaft, 'inertia')}) * {ratio:.15g}**2" for shaft, ratio in known)

    def whole(self, shaft: MachineShaft, what: str) -> str:
        """Return the mass or inertia of a shaft with all its parts."""
        parts = (part for part in shaft.parts if self._is_apart(part))
        return " + ".join([f"${{{shaft.body}.{what}}}", *(self._typed_text(part, what) for part in parts)])

    def _is_apart(self, part: ShaftPart) -> bool:
        """Whether a part is the flywheel that follows from the drive train, which takes the inertia of the others from its shaft's body."""
        return part.kind == "flywheel" and any(self.is_of_train(part, key) for key in ("mass", "inertia"))

    def _typed_text(self, part: ShaftPart, what: str) -> str:
        """The mass or inertia of a flywheel, a number or a reference to the drive train's."""
        typed = self.parts.reader.typed_body(part.path, what)
        unit_ = "kg" if what == "mass" else "kg*m**2"
        return f"${{{self.named('drive_train')}.flywheel_{what}}}" if typed is None else f"{typed:.12g} {unit_}"

    def _is_body(self, part: ShaftPart) -> bool:
        """Whether a part that is no disc has a mass or inertia in its shaft's body."""
        if self._is_apart(part):
            return False
        return "mass" in part.more or part.kind == "geneva_wheel" or "inertia" in part.more

    def _section_disc(self, shaft: MachineShaft, index: int) -> dict[str, Any]:
        section = self._section(shaft, index)
        found = {"name": f"section_{index + 1}", "diameter": section["diameter"], "width": section["length"]}
        return found | ({"bore": section["bore"]} if "bore" in section else {})

    def _section(self, shaft: MachineShaft, index: int) -> dict[str, Any]:
        own, path = shaft.keys.sections[index], (*shaft.path, "sections", index)
        if isinstance(self._raw(shaft.path).get("sections"), list):
            return {key: Typed((*path, key)) for key in self._raw(path)}
        found = {key: getattr(own, key) for key in ("length", "diameter", "bore", "fillet_radius")}
        home = (*shaft.path, "sections")
        return {key: Typed(home, millimetres(value), (index, key)) for key, value in found.items() if value}

    def _disc(self, part: ShaftPart) -> dict[str, Any] | None:
        """A part as a disc; None where its mass is typed or nothing is known of it."""
        join = self.parts.join_of(part)
        if "mass" in part.more or part.kind == "geneva_wheel" or join is None:
            return None
        width = self._width(part, join)
        if width is None:
            return None
        bore = part.keys.bore if part.keys.bore is not None else part.seat
        found: dict[str, Any] = {"diameter": Typed(join.path, millimetres(2 * join.radius(part)))}
        found["width"] = Typed(part.path, millimetres(width))
        found |= {"bore": Typed(part.path, millimetres(bore))} if bore else {}
        return found | ({"fill": Typed((*part.path, "fill"))} if part.keys.fill != 1 else {})

    @staticmethod
    def _width(part: ShaftPart, join: Join) -> float | None:
        if part.keys.width is not None:
            return part.keys.width
        if isinstance(join.keys, MeshKeys):
            return join.keys.width
        return tooth_width(join.keys) if isinstance(join.keys, ChainKeys) else part.keys.hub

    def mass_on(self, part: ShaftPart) -> Any:
        """Return the mass of a part that loads its shaft: of a disc, typed, of the flywheel that the drive train sizes, or of a Geneva wheel."""
        if self._disc(part):
            return f"${{{part.shaft.body}.{part.name}_disc_mass}}"
        if "mass" in part.more:
            return Typed((*part.path, "mass"))
        if self.is_sized(part):
            return f"${{{self.named('drive_train')}.flywheel_mass}}"
        section = wheel_section(self.parts, part)
        if section is None or part.keys.width is None:
            return None
        return Typed(part.path, f"{STEEL * part.keys.width * section[0]:.12g} kg")

    def is_sized(self, part: ShaftPart) -> bool:
        """Return whether a part is the flywheel that the drive train sizes."""
        return part.kind == "flywheel" and self.is_of_train(part, "inertia")

    def is_of_train(self, part: ShaftPart, key: str) -> bool:
        """Return whether a part has the mass or inertia of the flywheel that the drive train sizes."""
        return str(self._raw(part.path).get(key)) == f"${{{self.named('drive_train')}.flywheel_{key}}}"

    def _mass(self, part: ShaftPart, mass: str) -> dict[str, Any]:
        """The mass of a part, and its inertia: typed, or of a Geneva wheel or a disc without bore of that ``mass``."""
        found: dict[str, Any] = {"mass": self.mass_on(part) or 0}
        if "inertia" in part.more:
            found["inertia"] = Typed((*part.path, "inertia"))
        elif section := wheel_section(self.parts, part):
            found["inertia"] = f"${{{mass}}} * {section[1] / section[0] * 1e6:.12g} mm**2"
        elif radius := self._disc_radius(part):
            found["inertia"] = f"${{{mass}}} * ({millimetres(radius)})**2 / 2"
        return found

    def _disc_radius(self, part: ShaftPart) -> float | None:
        """The radius of the disc that a part of typed mass counts as, m: of an arm that swings or turns in steps that of its pin.

        The arm has a third of m r² where it is a bar, and up to all of it where its mass sits at the pin. What joins to nothing and turns
        steadily takes no torque by its inertia, and counts by its mass alone.
        """
        if any(self.parts.joins_of(part)):
            return self.parts.body_radius(part)
        is_steady = part.shaft.name in self.parts.ratios
        return None if is_steady else self.parts.body_radius(part) or self._pin_radius(part)

    def has_no_inertia(self, part: ShaftPart) -> bool:
        """Return whether a part has a mass on a shaft that swings or turns in steps, and no inertia follows from its dimensions or is typed."""
        has_mass_alone = {"mass", "inertia"} & set(part.more) == {"mass"}
        if part.shaft.name in self.parts.ratios or not has_mass_alone:
            return False
        return wheel_section(self.parts, part) is None and self._disc_radius(part) is None

    def full_mass(self, part: ShaftPart) -> float | None:
        """Return the mass of the full steel body of a part's dimensions, kg; None where these are not known.

        It is a disc, of a sector its share; of a rocker a bar from axis to pin, as wide as its hub, and twice as high as the shaft is thick.
        """
        width, section = self.parts.body_width(part), wheel_section(self.parts, part)
        radius = self.parts.body_radius(part) or self._pin_radius(part)
        if section is not None:
            area = section[0]
        elif radius is None:
            return None
        else:
            area = 2 * part.seat * radius if part.kind == "rocker" else pi * radius**2 * self._share(part)
        return STEEL * area * width or None

    def share_of_disc(self, part: ShaftPart) -> float | None:
        """Return what a part's typed bore, width and fraction leave of the disc on its seat, as wide as the mesh; None of one that is no disc."""
        join = self.parts.join_of(part)
        if join is None or self._disc(part) is None:
            return None
        width = self._width(part, join) or 0.0
        wanted = join.keys.width if isinstance(join.keys, MeshKeys) else width
        full, bore = (2 * join.radius(part)) ** 2, part.seat if part.keys.bore is None else part.keys.bore
        if full <= part.seat**2:
            return None
        return float(part.keys.fill * (full - bore**2) / (full - part.seat**2) * width / wanted)

    def full_inertia(self, part: ShaftPart) -> float | None:
        """Return the moment of inertia of that body about its shaft's axis where it is a disc or a Geneva wheel, kg·m²."""
        mass, radius, section = self.full_mass(part), self.parts.body_radius(part), wheel_section(self.parts, part)
        if mass is not None and section is not None:
            return mass * section[1] / section[0]
        return None if mass is None or radius is None else mass * radius**2 / 2

    def _pin_radius(self, part: ShaftPart) -> float | None:
        """The distance of the pin or roller of a crank or rocker from its axis, m; None where it is not typed."""
        placed = self.port(part)
        if placed and placed.port.radius and (typed := _typed(self.parts, part, placed.port.radius)):
            return prod(typed)
        typed = _typed(self.parts, part, ("center_distance", "slots")) if part.kind == "crank" else []
        return crank_radius(*typed) if typed else None

    def _share(self, part: ShaftPart) -> float:
        """What of a full disc a gear is: of a sector the teeth that are there."""
        join = self.parts.join_of(part)
        if join is None or not isinstance(keys := join.keys, MeshKeys) or keys.teeth_present is None:
            return 1.0
        own, other = join.sizes if part in join.drivers else join.sizes[::-1]
        return keys.teeth_present / own if own > other else 1.0


def wheel_section(parts: MachineParts, part: ShaftPart) -> tuple[float, float] | None:
    """Return area (m²) and polar second moment of area (m⁴) of a Geneva wheel; None of other parts, or where its dimensions are not typed."""
    typed = _typed(parts, part, ("slots", "center_distance", "roller_radius")) if part.kind == "geneva_wheel" else []
    if not typed or not part.port:
        return None
    slots, distance, radius = typed
    locking = parts.reader.typed_number(part.port[0], "locking_radius")
    return area_and_polar(int(slots), distance, radius, locking, part.seat)


def _typed(parts: MachineParts, part: ShaftPart, keys: Sequence[str]) -> list[float]:
    """What is typed at these keys of the mechanism that a part belongs to, SI; nothing where one of them is not."""
    given = [parts.reader.typed_number(part.port[0], key) for key in keys] if part.port else []
    return [each for each in given if each is not None] if None not in given else []


def tooth_width(keys: ChainKeys) -> float:
    """Return the width of a sprocket's teeth, m: 0.93 of the chain's inner width up to a pitch of 12.7 mm, 0.95 above (ISO 606).

    It is cut down to tenths of a millimetre, as the masses of the method's sheet want; catalogues have 11.1 mm for 12B, where this gives 11.0.
    """
    table = standard_table("iso_606_inner_widths")
    share = 0.93 if chain_pitch(keys) <= 12.7e-3 * (1 + 1e-9) else 0.95
    return int(share * table.values[keys.chain] * 10) / 10 * unit(table.unit).factor
