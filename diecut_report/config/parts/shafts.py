"""The calculations of the shafts: their loads, the shaft itself, its bearings, keys and pins."""

from __future__ import annotations

from collections.abc import Iterator
from math import atan2, cos, degrees, prod, sin
from typing import Any

from diecut_report.config.parts.demands import PlacedPort, Ratio, Typed, millimetres
from diecut_report.config.parts.keys import LOOSE
from diecut_report.config.parts.load_cases import LoadCases
from diecut_report.config.parts.masses import Masses
from diecut_report.config.parts.model import Join, MachineShaft, ShaftPart
from diecut_report.config.yaml import KeyPath
from diecut_report.standards import catalogue_type

OF_SHAFT = frozenset({"rotation", "speed", "turns_per_cycle", "load_cases", "downwards"})
OF_BEARING = frozenset({"radial_force", "tilt", "speed", "relative_angle", "cycle_speed", "on", "series", "bore_min"})
"""Keys of calculations that follow from the parts also where they are not filled in."""
NOTHING = 1e-9  # share of a force that has no part in a direction; offset (m) that is rounding


class ShaftElements(Masses, LoadCases):
    """Make the calculations of the shafts."""

    def _loads(self, shaft: MachineShaft) -> None:
        if self.lacks_torque(shaft):
            return
        own = self.inertias(shaft)
        taken = (torque for part in shaft.parts if (torque := self.torque_on(part)))
        torques = [each | {"ratio": each["ratio"].text} for each in (*taken, *own.values())]
        forces = [force for part in shaft.parts for force in (*self._port_forces(part), *self._chain_forces(part))]
        for each in (every for every in torques if "efficiency" in every):
            each["efficiency"] = self.efficiency(each["efficiency"])
        inputs: dict[str, Any] = {"main_turns": self.cycle(shaft.name)}
        if torques:
            inputs["torques"] = torques
        if hubs := [row for part in shaft.parts if part in own and (row := self._hub(part))]:
            inputs["hubs"] = hubs
        if forces:
            inputs["forces"] = forces
        if (moving := self.moved_by(shaft)) is not None:
            found = self._source("", moving.mechanism, moving.port.angle, 1)
            way = self.parts.chain_from(moving.part.shaft.name, shaft.name)
            found["ratio"] = Ratio(1, tuple(join.ratio_text for join in way)).text
            inputs["motion"] = {key: value for key, value in found.items() if key != "name"}
        if len(inputs) > 1:
            self._add(shaft.loads, "shaft_loads", inputs, shaft.path)

    def inertias(self, shaft: MachineShaft) -> dict[ShaftPart | None, dict[str, Any]]:
        """Return the torques of the inertia of a shaft that swings or turns in steps: of each part with what rides on it, and of the shaft alone.

        A chain that rolls a cylinder is of its driving sprockets, an even share of each.
        """
        if shaft.name not in self._inertias:
            self._inertias[shaft.name] = self._made_inertias(shaft)
        return self._inertias[shaft.name]

    def _made_inertias(self, shaft: MachineShaft) -> dict[ShaftPart | None, dict[str, Any]]:
        whole = self.inertia_of(shaft)
        if whole is None:
            return {}
        references = self.own_inertias(shaft)
        found: dict[ShaftPart | None, dict[str, Any]] = {}
        for part in (each for each in shaft.parts if not each.keys.rides_on):
            riders = (each.name for each in shaft.parts if each.keys.rides_on == part.name)
            terms = [references[name] for name in (part.name, *riders) if name in references]
            rolling = (each for each in self.parts.joins_of(part) if self.is_rolling(each) and part in each.drivers)
            terms += [f"{self.conveyor_inertia(each)} / {len(each.drivers)}" for each in rolling]
            if terms:
                found[part] = whole | {"name": f"{part.name}_inertia", "inertia": " + ".join(terms)}
        found[None] = whole | {"inertia": self.section_inertia(shaft)}
        return found

    def _hub(self, part: ShaftPart) -> dict[str, str] | None:
        """The torque that passes the joint of a part with its shaft; None where only its own inertia does, or the torque is not known."""
        joined = self._joined(part)
        if len(joined) != 1:
            return None
        torque = "balance" if self._balances(joined[0]) else joined[0].name
        return {"name": part.name, "torque": torque, "inertia": f"{part.name}_inertia"}

    def _joined(self, part: ShaftPart) -> list[ShaftPart]:
        """What brings a torque through the joint of a part with its shaft: itself, or those which ride on it."""
        every = (part, *(each for each in part.shaft.parts if each.keys.rides_on == part.name))
        return [each for each in every if self.torque_on(each) or self._balances(each)]

    def _port_forces(self, part: ShaftPart) -> Iterator[dict[str, Any]]:
        """The forces of a mechanism on a part, in the directions of its shaft; a second one in a direction is named across."""
        placed, taken = self.port(part), set[str]()
        if placed is None:
            return
        sign, line = -1 if placed.port.opposite else 1, self.line_of_axes(placed.mechanism)
        for shares, curve in zip(line.shares(), placed.port.forces, strict=False):
            for direction, share in self._directions(part, *shares):
                if abs(share) > NOTHING:
                    name = f"{part.name}_across_{direction}" if direction in taken else f"{part.name}_{direction}"
                    taken.add(direction)
                    yield self._source(name, placed.mechanism, curve, 1) | {"ratio": Ratio(sign * share).text}

    def _directions(self, part: ShaftPart, x: float, y: float) -> tuple[tuple[str, float], ...]:
        """The shares of a force in the frame's x and y as those in the directions of its shaft, which turns from y to z.

        A shaft that is seen turning clockwise in the frame is looked at from its other end: its z is against the frame's y.
        """
        return ("y", x), ("z", self.sense(part.shaft.name) * y)

    def _chain_shares(self, part: ShaftPart) -> tuple[Join | None, list[tuple[str, float]]]:
        """The chain on a sprocket, and the shares of its pull: towards the other one, or in its direction where it runs over idlers."""
        join = self.parts.join_of(part, "chains")
        if join is None:
            return None, []
        angle = self._angle_to(join, part) if join.driven else join.keys.direction or 0.0
        return join, [each for each in self._directions(part, cos(angle), sin(angle)) if abs(each[1]) > NOTHING]

    def _angle_to(self, join: Join, part: ShaftPart) -> float:
        """The direction from the axis of a part to that of the other one of its join, rad in the frame."""
        other = join.driven[0] if part in join.drivers else join.drivers[0]
        (x, y), (u, v) = (self.parts.axes.get(each.shaft.name, (0.0, 0.0)) for each in (part, other))
        return atan2(v - y, u - x)

    def _chain_forces(self, part: ShaftPart) -> Iterator[dict[str, Any]]:
        """The pull of a chain on its sprocket, by the torque of the driving one and with what it always pulls; losses behind it count in full."""
        join, shares = self._chain_shares(part)
        torque = None if join is None else self.torque_on(join.drivers[0])
        if join is None or torque is None:
            return
        pull = {key: value for key, value in torque.items() if key != "efficiency"}
        losses = prod(each.efficiency for each in torque.get("efficiency", ()))
        for direction, share in shares:
            always = self._always_pulled(join, share)
            constant = {"constant": always} if always else {}
            number = abs(pull["ratio"].number) * share / losses
            yield pull | {"name": f"{part.name}_{direction}", "ratio": Ratio(number, pull["ratio"].factors).text, "absolute": True,
                "lever": f"${{drive_line.{join.name}_chain_travel}} / 1 rad"} | constant  # fmt: skip

    def _idle_chain_force(self, part: ShaftPart) -> dict[str, str]:
        """The force of a chain that carries nothing on its sprocket: what it always pulls."""
        join, shares = self._chain_shares(part)
        if join is None or self.torque_on(join.drivers[0]):
            return {}
        found = ((f"force_{direction}", self._always_pulled(join, share)) for direction, share in shares)
        return {name: force for name, force in found if force}

    def _always_pulled(self, join: Join, share: float) -> str:
        """The pull of both strands by pretension and, as far as the chain is calculated, by their sag; nothing where neither is known."""
        tensions = [f"${{{join.home}.pretension}}"] if "pretension" in join.more else []
        tensions += [f"${{{join.calculation}.sag_tension}}"] if self.is_calculated(join) else []
        return f"2 * ({' + '.join(tensions)}) * {share:.12g}" if tensions else ""

    def _shaft(self, shaft: MachineShaft) -> None:
        home = shaft.calculation
        has_loads = self.is_made(shaft.loads)
        bearings = shaft.bearings
        if len(bearings) != 2 or not has_loads:
            return
        first, second = bearings
        inputs: dict[str, Any] = {
            "sections": [self._section(shaft, index) for index in range(len(shaft.sections))],
            "bearing_a": Typed((*first.path, "at")), "bearing_b": Typed((*second.path, "at")),
            "seat_a": self._seat(first), "seat_b": self._seat(second), "locating": "b" if first.keys.floating else "a",
            "loads": [load for part in shaft.parts if part.kind != "bearing" for load in self._load(part)],
            "downwards": f"{-90 * self.sense(shaft.name)} deg",
        }  # fmt: skip
        place = next((part for part in shaft.parts if self._balances(part)), None)
        if place is not None:
            for part, row in self.inertias(shaft).items():
                own = {"name": row["name"], "torque": f"${{{shaft.loads}.{row['name']}_torque}}", "seat": "none"}
                inputs["loads"].append(own | {"position": Typed((*(part or place).path, "at"))})
        derived = [notch for part in shaft.parts for notch in self._notches(part)]
        if notches := [*derived, *self._typed_notches(shaft)]:
            inputs["notches"] = notches
        if cases := self.cases_of_shaft(shaft):
            inputs["load_cases"] = cases
        if self.parts.keys.shaft_material and not {"material", "tensile_strength"} & set(shaft.more):
            inputs["material"] = Typed(("machine", "shaft_material"))
        if self.parts.keys.surface and "surface" not in shaft.more:
            inputs["surface"] = Typed(("machine", "surface"))
        if shaft.name in self.parts.ratios:
            turns = self.turns(shaft.name) * self.cycle(shaft.name)
            inputs |= {"speed": self.speed(shaft.name), "turns_per_cycle": int(turns)}
        else:
            inputs["rotation"] = f"${{{shaft.loads}.shaft_angle}}"
        more = (key for key in shaft.more if key != "notches")
        inputs |= self._beside(inputs, more, shaft.path, (*shaft.path, "parts"), OF_SHAFT)
        self._add(home, "shaft", inputs, shaft.path)

    def _seat(self, part: ShaftPart) -> str:
        return "loose" if part.keys.fit in LOOSE else "tight"

    def _notches(self, part: ShaftPart) -> Iterator[dict[str, Any]]:
        if part.keys.key:
            kind = "keyseat_pair" if part.keys.key_count > 1 else "keyseat_end_mill"
            for end in (-1, 1):
                place = Typed((*part.path, "at"), millimetres(part.keys.at + end * part.keys.key / 2))
                yield {"position": place, "type": kind}
        if part.keys.interference:
            yield {"position": Typed((*part.path, "at")), "type": "press_fit"}

    def _typed_notches(self, shaft: MachineShaft) -> Iterator[Typed]:
        """The notches that are typed beside those of the keys."""
        given = self._raw(shaft.path).get("notches")
        path = (*shaft.path, "notches")
        yield from (Typed((*path, index)) for index in range(len(given) if isinstance(given, list) else 0))

    def _load(self, part: ShaftPart) -> Iterator[dict[str, Any]]:
        loads = part.shaft.loads
        found: dict[str, Any] = {"name": part.name, "position": Typed((*part.path, "at"))}
        if part.keys.integral or part.keys.bolted or part.keys.rides_on:
            found["seat"] = "none"
        elif self._seat(part) == "loose":
            found["seat"] = "loose"
        if self.torque_on(part):
            found["torque"] = f"${{{loads}.{part.name}_torque}}"
        elif self._balances(part):
            found["torque"] = f"${{{loads}.balance}}"
        across: dict[str, Any] = {}
        for force in (*self._port_forces(part), *self._chain_forces(part)):
            name = force["name"]
            (across if "_across_" in name else found)[f"force_{name[-1]}"] = f"${{{loads}.{name}_force}}"
        place = {key: found[key] for key in ("name", "position")}
        if abs(offset := part.plane - part.keys.at) > NOTHING and {"force_y", "force_z"} & found.keys():
            place["offset"] = found["offset"] = Typed((*part.path, "at"), millimetres(offset))
        if (gear := self._gear(part)) and "torque" in found:
            found["gear"] = gear
        found |= self._belt_force(part) | self._idle_chain_force(part)
        if (mass := self.mass_on(part)) is not None:
            found["mass"] = mass
        found |= self._typed_load(part, found)
        yield found
        if across:
            yield place | {"name": f"{part.name}_across", "seat": "none"} | across

    def _typed_load(self, part: ShaftPart, found: dict[str, Any]) -> dict[str, Typed]:
        """The keys of a load that are typed at its part; a mass is one of its body."""
        join = self.parts.join_of(part)
        source = join.path if join else (*part.path, "of" if part.port else part.kind)
        follows = {"offset", "gear", "seat"} if part.kind != "load" else set()
        follows |= {"force_y", "force_z"} if join or part.port else set()
        more = (key for key in part.more if key not in ("mass", "inertia"))
        return self._beside(found, more, part.path, source, follows)

    def _balances(self, part: ShaftPart) -> bool:
        """Whether the torque on a part balances all others on its shaft: it is driven there, or by a flywheel."""
        if not self.torques_of(part.shaft):
            return False
        if (flywheel := self.flywheel(part.shaft)) is not None:
            return part is flywheel
        driving = self.parts.driving_join(part.shaft)
        return part is (driving.driven[0] if driving is not None else self.parts.motion_port(part.shaft))

    def _gear(self, part: ShaftPart) -> dict[str, Any] | None:
        join = self.parts.join_of(part, "meshes")
        if join is None or not {each.shaft.name for each in join.parts} <= self.parts.axes.keys():
            return None
        sense = self.sense(part.shaft.name)
        angle = sense * degrees(self._angle_to(join, part))
        found: dict[str, Any] = {"pitch_radius": self._pitch_radius(join, part)}
        found["mesh_angle"] = Typed(("machine", "frame"), f"{angle:.10g} deg")
        if join.keys.helix_angle:
            # a pair has teeth of opposite hands; those of a right-handed gear push against its torque
            hand = -sense if part in join.drivers else sense
            found["helix_angle"] = Typed(join.path, f"{hand * degrees(join.keys.helix_angle):.12g} deg")
        return found

    @staticmethod
    def _pitch_radius(join: Join, part: ShaftPart) -> str:
        """The reference to the pitch radius of a gear."""
        return f"${{drive_line.{join.name}_radius_{1 if part in join.drivers else 2}}}"

    def _belt_force(self, part: ShaftPart) -> dict[str, Any]:
        join, train = self.parts.join_of(part, "belts"), self.named("drive_train")
        if join is None or train is None:
            return {}
        angle = self._angle_to(join, part)
        shares = self._directions(part, cos(angle), sin(angle))
        load = f"${{{train}.shaft_load}}"
        return {f"force_{axis}": f"{load} * ({share:.12g})" for axis, share in shares if abs(share) > NOTHING}

    def _bearings(self, shaft: MachineShaft) -> None:
        home = shaft.calculation
        pairs = zip(shaft.bearings, "ab", strict=False) if self.is_made(home) else ()
        rows = [self._bearing(part, end) for part, end in pairs]
        rows += [row for part in shaft.parts if (row := self._pin_bearing(part))]
        if rows:
            inputs: dict[str, Any] = {"bearings": rows}
            if self.parts.keys.required_life:
                inputs["required_life"] = Typed(("machine", "required_life"))
            self._add(shaft.bearing_calculation, "rolling_bearing", inputs, shaft.path)

    def _bearing(self, part: ShaftPart, end: str) -> dict[str, Any]:
        home, designation = part.shaft.calculation, part.keys.designation or ""
        follows = OF_BEARING if catalogue_type(designation) is None else OF_BEARING | {"type"}
        forces = {"radial_force": f"${{{home}.reaction_{end}}}", "tilt": f"${{{home}.slope_{end}}}"}
        if not part.keys.floating and self._is_pushed(part.shaft):
            forces["axial_force"] = f"${{{home}.axial_reaction}}"
        more = self._beside(forces, part.more, part.path, (*part.shaft.path, "parts"), follows)
        found = self._catalogued(part.name, designation, more, (*part.path, "designation"))
        return found | forces | self._relative(part.shaft)

    def _is_pushed(self, shaft: MachineShaft) -> bool:
        """Whether anything pushes a shaft along its axis: helical teeth, or a force that is typed."""
        others = [part for part in shaft.parts if part.kind != "bearing"]
        meshes = [join for part in others for join in self.parts.joins_of(part) if join.word == "meshes"]
        return any(join.keys.helix_angle for join in meshes) or any("axial_force" in part.more for part in others)

    def _catalogued(self, name: str, designation: str, more: dict[str, Any], path: KeyPath) -> dict[str, Any]:
        kind = catalogue_type(designation)  # of one that is not in the tables the type is typed
        row: dict[str, Any] = {"name": name, **({"type": kind} if kind else {})}
        return row | ({"designation": Typed(path)} if designation else {}) | more

    def _relative(self, shaft: MachineShaft) -> dict[str, Any]:
        """How the rings of a shaft's bearings turn."""
        if shaft.name in self.parts.ratios:
            return {"speed": self.speed(shaft.name)}
        cycle_speed = f"{self.reference_speed} / {self.cycle(shaft.name)}"
        return {"relative_angle": f"${{{shaft.calculation}.shaft_angle}}", "cycle_speed": cycle_speed}

    def _key(self, part: ShaftPart) -> None:
        loads = part.shaft.loads
        torque = self._passed(part)
        if not part.keys.key or part.section is None or torque is None or not self.is_made(loads):
            return
        home = part.shaft.calculation
        inputs: dict[str, Any] = {
            "shaft_diameter": f"${{{home}.sections.{part.section.index}.diameter}}", "key_length": Typed((*part.path, "key")),
            "torque": torque, "form": part.keys.key_form, "key_count": part.keys.key_count, "yield_shaft": f"${{{home}.yield_strength}}",
        }  # fmt: skip
        if part in self.parts.brakes:  # its torque, which is that of its only load case
            inputs["application_factor"] = 1
        elif cases := self.cases_of_key(part):
            inputs["load_cases"] = cases
        if part.keys.hub is not None:
            inputs["hub_length"] = Typed((*part.path, "hub"))
        if self.parts.keys.gears.hub_yield:
            inputs["yield_hub"] = Typed(("machine", "gears", "hub_yield"))
        if self.parts.keys.required_life:  # by which the changes of flank are counted
            inputs["required_life"] = Typed(("machine", "required_life"))
            inputs["cycle_speed"] = f"{self.reference_speed} / {self.cycle(part.shaft.name)}"
        self._add(part.calculation("key"), "parallel_key", inputs, part.path)

    def _passed(self, part: ShaftPart) -> str | None:
        """The torque that passes the key of a part: its own, or that of the only part with one which rides on it."""
        loads, joined, has_own = part.shaft.loads, self._joined(part), part in self.inertias(part.shaft)
        if part in self.parts.brakes:
            return self.brake_torque(part)
        if len(joined) > 1:  # together they take what the only other part of the shaft gives, or give what it takes
            others = [each.name for each in part.shaft.parts if each not in joined and self.torque_on(each)]
            is_known = len(others) == 1 and not self.inertias(part.shaft)
            return f"${{{loads}.{others[0]}_torque}}" if is_known else None
        if not (joined or has_own):
            return None
        if has_own:
            return f"${{{loads}.{part.name}_{'hub' if joined else 'inertia_torque'}}}"
        return f"${{{loads}.{'balance' if self._balances(joined[0]) else f'{joined[0].name}_torque'}}}"

    def _pin(self, part: ShaftPart) -> None:
        pin, placed = part.keys.pin, self._joint(part)
        if pin is None or placed is None:
            return
        path, sizes = (*part.path, "pin"), (pin.length, pin.middle, *pin.supports)
        length, middle, *supports = (Typed(path, millimetres(each)) for each in sizes)
        inputs: dict[str, Any] = {
            "sections": [{"length": length, "diameter": Typed((*path, "diameter"))}], "bearing_a": supports[0], "bearing_b": supports[1],
            "loads": [{"name": "joint", "position": middle, "seat": "loose"} | self._joint_force(placed)],
        }  # fmt: skip
        if pin.held is not None:
            inputs["notches"] = [{"position": Typed(path, millimetres(pin.held)), "type": "press_fit"}]
        if self.parts.keys.shaft_material:
            inputs["material"] = Typed(("machine", "shaft_material"))
        if pin.allowable_deflection is not None:
            inputs["allowable_deflection"] = Typed((*path, "allowable_deflection"))
        inputs |= self._turning(placed, "rotation")
        self._add(part.calculation("pin"), "shaft", inputs, path)

    def _joint(self, part: ShaftPart) -> PlacedPort | None:
        """The port of a part where that is a joint, whose force acts on a pin."""
        placed = self.port(part)
        return placed if placed and placed.port.joint[0] else None

    @staticmethod
    def _joint_force(placed: PlacedPort) -> dict[str, Any]:
        """The force on a pin: along the joint's part where the pin is seen from there, else in the directions of the frame."""
        port, mechanism = placed.port, placed.mechanism
        if port.joint[1]:
            return {"force_y": f"${{{mechanism}.{port.joint[0]}}}"}
        return {f"force_{axis}": f"${{{mechanism}.{curve}}}" for axis, curve in zip("yz", port.forces, strict=False)}

    @staticmethod
    def _turning(placed: PlacedPort, key: str) -> dict[str, str]:
        """How a pin turns in its joint: the angle of one that swings, under this key, else its speed."""
        own = {key: placed.port.joint[1]} if placed.port.joint[1] else {"speed": placed.port.speed}
        return {name: f"${{{placed.mechanism}.{curve}}}" for name, curve in own.items()}

    def _pin_bearing(self, part: ShaftPart) -> dict[str, Any] | None:
        pin, placed = part.keys.pin, self._joint(part)
        if pin is None or pin.bearing is None or placed is None:
            return None
        home, path = part.shaft.calculation, (*part.path, "pin")
        typed = (key for key in ("limiting_speed", "rolling_elements") if getattr(pin, key) is not None)
        more = {key: Typed((*path, key)) for key in typed}
        found = self._catalogued(f"{part.name}_pin", pin.bearing, more, (*path, "bearing"))
        found["radial_force"] = f"${{{placed.mechanism}.{placed.port.joint[0]}}}"
        shaft_slope = f"${{{home}.{part.name}_slope}} + " if self.is_made(home) else ""
        found["tilt"] = f"{shaft_slope}${{{part.calculation('pin')}.joint_slope}}"
        found |= self._turning(placed, "relative_angle")
        if placed.port.joint[1]:
            found["cycle_speed"] = f"{self.reference_speed} * {self.line(placed.mechanism)[0]}"
        return found
