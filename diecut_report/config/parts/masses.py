"""Masses and moments of inertia of the shafts with their parts, and the rules that hold typed ones against the parts' dimensions."""

from __future__ import annotations

from collections.abc import Container, Iterable, Iterator, Sequence
from math import pi, prod
from typing import Any

from diecut_report.config.parts.demands import Demands, TypedNumber, TypedValue, millimetres
from diecut_report.config.parts.findings import Finding, Level, finding, hubs, mm
from diecut_report.config.parts.keys import ChainKeys, MeshKeys
from diecut_report.config.parts.model import Join, MachineParts, MachineShaft, ShaftPart, chain_pitch
from diecut_report.config.yaml import KeyPath
from diecut_report.mechanics.geneva_wheel import area_and_polar, crank_radius
from diecut_report.quantities.units import unit
from diecut_report.standards import standard_table

STEEL = 7850  # kg/m³
# shares of the full steel body; of a clutch, which has shoes in place of a disc, less is usual
MASS_SHARE, MASS_POSSIBLE = (0.3, 1.05), (0.05, 1.5)


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
            return {key: TypedValue((*path, key)) for key in self._raw(path)}
        found = {key: getattr(own, key) for key in ("length", "diameter", "bore", "fillet_radius")}
        return {
            key: TypedNumber(millimetres(value), (*shaft.path, "sections"), (index, key))
            for key, value in found.items()
            if value
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

    def mass_on(self, part: ShaftPart) -> Any:
        """Return the mass of a part that loads its shaft: of a disc, typed, of the flywheel that the drive train sizes, or of a Geneva wheel."""
        if self._disc(part):
            return f"${{{part.shaft.body}.{part.name}_disc_mass}}"
        if "mass" in part.more:
            return TypedValue((*part.path, "mass"))
        if self.is_sized(part):
            return f"${{{self.named('drive_train')}.flywheel_mass}}"
        section = wheel_section(self.parts, part)
        return (
            None
            if section is None or part.keys.width is None
            else TypedNumber(f"{STEEL * part.keys.width * section[0]:.12g} kg", part.path)
        )

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
            found["inertia"] = TypedValue((*part.path, "inertia"))
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
        join = next(self.parts.joins_of(part), None)
        if join is None or self._disc(part) is None:
            return None
        width = self._width(part, join) or 0.0
        wanted = join.keys.width if isinstance(join.keys, MeshKeys) else width
        full, bore = (2 * join.radius(part)) ** 2, part.seat if part.keys.bore is None else part.keys.bore
        return (
            float(part.keys.fill * (full - bore**2) / (full - part.seat**2) * width / wanted)
            if full > part.seat**2
            else None
        )

    def full_inertia(self, part: ShaftPart) -> float | None:
        """Return the moment of inertia of that body about its shaft's axis where it is a disc or a Geneva wheel, kg·m²."""
        mass, radius, section = self.full_mass(part), self.parts.body_radius(part), wheel_section(self.parts, part)
        if mass is not None and section is not None:
            return mass * section[1] / section[0]
        return None if mass is None or radius is None else mass * radius**2 / 2

    def _pin_radius(self, part: ShaftPart) -> float | None:
        """The distance of the pin or roller of a crank or rocker from its axis, m; None where it is not typed."""
        port = self.port(part)
        if port is not None and port.radius and (typed := _typed(self.parts, part, port.radius)):
            return prod(typed)
        typed = _typed(self.parts, part, ("center_distance", "slots")) if part.kind == "crank" else []
        return crank_radius(*typed) if typed else None

    def _share(self, part: ShaftPart) -> float:
        """What of a full disc a gear is: of a sector the teeth that are there."""
        join = next(self.parts.joins_of(part), None)
        if join is None or not isinstance(keys := join.keys, MeshKeys) or keys.teeth_present is None:
            return 1.0
        own, other = (keys.teeth_1, keys.teeth_2) if part in join.drivers else (keys.teeth_2, keys.teeth_1)
        return keys.teeth_present / own if own > other else 1.0


def wheel_section(parts: MachineParts, part: ShaftPart) -> tuple[float, float] | None:
    """Return area (m²) and polar second moment of area (m⁴) of a Geneva wheel; None of other parts, or where its dimensions are not typed."""
    typed = _typed(parts, part, ("slots", "center_distance", "roller_radius")) if part.kind == "geneva_wheel" else []
    if not typed or not part.port:
        return None
    slots, distance, radius = typed
    return area_and_polar(
        int(slots), distance, radius, parts.reader.typed_number(part.port[0], "locking_radius"), part.seat
    )


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


def weighed(parts: MachineParts, elements: Masses) -> Iterator[Finding]:
    """Each body has a mass that loads its shaft, and an inertia: a Geneva wheel by its width, a flywheel as it is typed."""
    for _, part in hubs(parts):
        has_inertia = "inertia" in part.more
        if part.kind == "geneva_wheel" and elements.mass_on(part) is None:
            template = "has no mass, so that its weight and its inertia would be left out; give width or mass"
            yield finding(parts, "mass", "error", part.path, template)
        elif part.kind == "geneva_wheel" and not has_inertia and wheel_section(parts, part) is None:
            template = (
                "has no inertia, as slots, center_distance or roller_radius of its mechanism is not typed; give inertia"
            )
            yield finding(parts, "mass", "error", part.path, template)
        elif part.kind == "flywheel" and (elements.mass_on(part) is None or not has_inertia):
            template = "has no {missing}, so that it counts for nothing; give it, or refer with inertia to flywheel_inertia of the drive train"
            missing = "inertia" if not has_inertia else "mass"
            yield finding(parts, "mass", "error", part.path, template, missing=missing)


def inert(parts: MachineParts, elements: Masses) -> Iterator[Finding]:
    """What swings or turns in steps has an inertia, a free force with a mass too."""
    template = (
        "has a mass and no inertia on a shaft that does not turn steadily, so that the torque to move it would be left out; give inertia, about "
        "the shaft's axis, or outside"
    )
    for part in (each for shaft in parts.shafts.values() for each in shaft.parts if elements.has_no_inertia(each)):
        yield finding(parts, "mass", "error", part.path, template)


def massive(parts: MachineParts, elements: Masses) -> Iterator[Finding]:
    """A mass or moment of inertia is that of a steel body of the part's dimensions, as far as these are known, and never nothing."""
    for _, part in hubs(parts):
        bodies = ("mass", "kg", elements.full_mass(part)), ("inertia", "kg·m²", elements.full_inertia(part))
        for key, of, full in bodies:
            typed, path = parts.reader.typed_body(part.path, key), (*part.path, key)
            refers_to_train = part.kind == "flywheel" and elements.is_of_train(part, key)
            if parts.reader.is_of_results(part.path, key) and not refers_to_train:
                template = "is of what is calculated, which nothing holds against the part; type it. A flywheel may refer to the drive train's"
                yield finding(parts, "mass", "error", path, template)
            elif typed == 0:
                template = "is zero, as nothing is that turns; give its own, or leave the key out"
                yield finding(parts, "mass", "error", path, template)
            elif typed is not None and full is not None:
                yield from _share_of_body(parts, part, path, (typed, full), of)


def filled(parts: MachineParts, elements: Masses) -> Iterator[Finding]:
    """A body is not much less than the full disc of its dimensions, and a Geneva wheel as wide as its roller wants."""
    for _, part in hubs(parts):
        share, width = elements.share_of_disc(part), part.keys.width
        if share is not None and share < MASS_SHARE[0]:
            template = "leaves by fill, bore and width {share} of its full steel disc; {least} at least is usual"
            level: Level = "warning" if share >= MASS_POSSIBLE[0] else "error"
            yield finding(parts, "mass", level, part.path, template, share=f"{share:.3g}", least=MASS_SHARE[0])
        if part.kind == "geneva_wheel" and part.port and width is not None:
            roller = parts.reader.typed_number(part.port[0], "roller_width") or 0.0
            if width < roller / 2:
                template = (
                    "is {width} wide, less than half of the roller of {roller} that runs in it; give its own width"
                )
                yield finding(
                    parts, "mass", "error", (*part.path, "width"), template, width=mm(width), roller=mm(roller)
                )


def _share_of_body(
    parts: MachineParts, part: ShaftPart, path: KeyPath, bodies: tuple[float, float], of: str
) -> Iterator[Finding]:
    typed, full = bodies
    least, most = MASS_SHARE[0] if part.kind != "clutch" else MASS_POSSIBLE[0], MASS_SHARE[1]
    if not least <= typed / full <= most:
        is_possible = MASS_POSSIBLE[0] <= typed / full <= MASS_POSSIBLE[1]
        template = "is {typed}, but the full steel body of its dimensions has {full}; {least} to {most} of it are usual"
        yield finding(parts, "mass", "warning" if is_possible else "error", path, template, typed=f"{typed:.4g} {of}", full=f"{full:.3g} {of}",
            least=least, most=most)  # fmt: skip
