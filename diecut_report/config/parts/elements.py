"""The calculations that are made of the parts: each as the block of a mechanism, its inputs taken from the parts and from each other."""

from __future__ import annotations

from math import degrees, inf
from typing import Any

from diecut_report.config.parts.demands import Element, Ratio, Typed, millimetres
from diecut_report.config.parts.keys import BeltKeys, ChainKeys, MeshKeys
from diecut_report.config.parts.model import SIDES, Join, MachineShaft, ShaftPart, chain_pitch
from diecut_report.config.parts.shafts import ShaftElements
from diecut_report.mechanism.mechanism import Mechanism
from diecut_report.standards import standard_table

GEAR_LIMITS = ("sigma_h_lim", "sigma_f_lim")
OF_MESH = frozenset({"center_distance", "torque", "torque_curve", "torque_on", "sector", "slope", "load_cases"})
OF_CHAIN = frozenset({
    "pitch", "mass_per_length", "center_distance", "speed", "torque", "torque_curve", "power", "acceleration_curve", "velocity_curve",
})  # fmt: skip
"""Keys of calculations that follow from the parts also where they are not filled in: by the places of the axes, the chain, what moves it."""
SERVICE_KEYS = ("service", "hours_per_day")
SERVICE_FACTORS = {"light": ((1.1, 1.1, 1.2), (1.1, 1.2, 1.3)), "medium": ((1.1, 1.2, 1.3), (1.2, 1.3, 1.4)),
                   "heavy": ((1.2, 1.3, 1.4), (1.4, 1.5, 1.6))}  # fmt: skip
"""Factor c₂ of V-belts (Optibelt) for up to 10, up to 16 and more hours a day; the second row for a run-up torque above HIGH_RUN_UP."""
HIGH_RUN_UP = 1.8  # times the motor's rated torque


OF_TRAIN = frozenset({"vbelt", "motor_speed"})
"""Keys that a drive train needs and a machine's belt gives."""


def given_by_parts(mechanism: Mechanism) -> frozenset[str]:
    """Return the keys of a mechanism that the parts of a machine may give it."""
    ports = frozenset(key for port in mechanism.ports for key in port.fills)
    return ports | OF_TRAIN if mechanism.kind == "drive_train" else ports


class Elements(ShaftElements):
    """Make all calculations of the parts."""

    def all(self) -> list[Element]:
        """Return all calculations."""
        for shaft in (each for each in self.parts.shafts.values() if each.has_body):
            self._body(shaft)
            self._loads(shaft)
            self._shaft(shaft)
            self._bearings(shaft)
            for part in shaft.parts:
                self._key(part)
                self._pin(part)
        for join in self.parts.joins:
            {"meshes": self._mesh, "chains": self._chain, "belts": self._belt}[join.word](join)
        self._drive_line()
        self._fill_ports()
        return self.made

    def _fill_ports(self) -> None:
        for part in self.parts.every_part:
            if placed := self.port(part):
                given = {key: self._provided(part, of) for key, of in placed.port.fills.items()}
                known = {key: value for key, value in given.items() if value is not None}
                self.fills.setdefault(placed.mechanism, {}).update(known)
            if self.is_calculated_clutch(part):
                self.fills.setdefault(part.name, {}).update(self._of_clutch(part))

    def _of_clutch(self, part: ShaftPart) -> dict[str, Any]:
        """What a clutch is given: the speed of its shaft, and the torque that passes it."""
        name, torque = part.shaft.name, self._passed(part) if self.is_made(part.shaft.loads) else None
        speed = {"speed": self.speed(name)} if name in self.parts.ratios else {}
        return speed | ({"torque_curve": torque} if torque else {})

    def _provided(self, part: ShaftPart, what: str) -> Any:
        """What the parts give a mechanism at one of its ports; nothing where several meshes there are not alike."""
        meshes = [join for join in self.parts.joins if join.word == "meshes" and join.driving_shaft is part.shaft]
        chains = self._chains_that_move(part, "conveyor")
        way = self.parts.chain_from(part.shaft.name, chains[0].driving_shaft.name) if chains else meshes[:1]
        if len({mesh.ratio for mesh in meshes}) > 1 and not chains:
            return None
        if what == "own_inertia":
            return f"${{{part.shaft.body}.inertia}}" if meshes and self.is_made(part.shaft.body) else None
        if what == "driven_inertia":
            rolled = self._chains_that_move(part, "cylinder")
            return " + ".join(self.inertia_behind(each.driven_shaft, *rolled) for each in meshes) or None
        if what == "efficiency":
            toothed = [self.loss(join) for join in way if isinstance(join.keys, MeshKeys)]
            return self.efficiency(toothed) if toothed else None
        if what == "ratio":
            return " * ".join(join.ratio_text for join in way).strip("()" if len(way) == 1 else "") or None
        if what == "pinion_radius" and meshes:
            return self._pitch_radius(meshes[0], meshes[0].driven[0])
        if what == "inertia":
            return self.inertia_behind(part.shaft, *chains) if chains else None
        if what == "teeth" and chains:
            return Typed((*chains[0].path, "teeth"), str(chains[0].keys.teeth_1))
        if what == "pitch" and chains:
            return Typed((*chains[0].path, "chain"), millimetres(chain_pitch(chains[0].keys)))
        return None

    def _chains_that_move(self, part: ShaftPart, what: str) -> list[Join]:
        """The chains that move the conveyor or cylinder of the mechanism that moves a part's shaft."""
        return [join for join in self.parts.joins if part.port and join.moves == (part.port[0], what)]

    def _drive_line(self) -> None:
        speeds: list[dict[str, Any]] = []
        turning, moving = list[dict[str, Any]](), list[dict[str, Any]]()
        for name, shaft in self.parts.shafts.items():
            has_body = self.is_made(shaft.body)
            mass = {"name": name, "mass": self.whole(shaft, "mass")}
            if name in self.parts.ratios:
                if has_body:
                    ratio = f"${{drive_line.shafts.{len(speeds)}.ratio}}"
                    turning.append(mass | {"ratio": ratio, "inertia": self.whole(shaft, "inertia")})
                speeds.append({"name": name, "ratio": self._ratio_of_route(name)})
            elif has_body:
                moving.append(mass)
        inputs: dict[str, Any] = {}
        productivity = self.blocks.get(self.named("cyclogram") or "", {}).get("productivity")
        if "${" in str(productivity):
            inputs["reference_speed"] = f"{productivity} * 1 revolution"
        inputs["shafts"] = speeds
        inputs |= {word: rows for word in SIDES if (rows := self._joins(word))}
        for part, home in self.parts.brakes.items():
            inputs.setdefault(home.partition(".")[0], []).append(self._brake(part, speeds))
        if rolling := [row for join in self.parts.joins if (row := self._rolling(join))]:
            inputs["rolling"] = rolling
        self._add("drive_line", "drive_line", inputs, ("machine",))
        if turning:
            whole = {"shafts": turning} | ({"moving": moving} if moving else {})
            self._add("machine_inertia", "machine_inertia", whole, ("machine",))

    def _ratio_of_route(self, shaft: str) -> Any:
        """The speed of a shaft for each of the main one."""
        route = self.parts.routes[shaft]
        return Ratio(1, tuple(join.ratio_text if onward else f"1 / {join.ratio_text}" for join, onward in route)).text

    @staticmethod
    def _brake(part: ShaftPart, speeds: list[dict[str, Any]]) -> dict[str, Any]:
        """A brake, with the speed of its shaft."""
        ratio = next(index for index, row in enumerate(speeds) if row["name"] == part.shaft.name)
        torque = Typed((*part.path, "brake_torque"))
        name = f"{part.shaft.name}_{part.name}"
        return {"name": name, "torque": torque, "ratio": f"${{drive_line.shafts.{ratio}.ratio}}"}

    def _rolling(self, join: Join) -> dict[str, Any] | None:
        """A chain that rolls a cylinder."""
        if not self.is_rolling(join) or join.moves is None:
            return None
        numbers = {"teeth": f"${{{join.home}.teeth_1}}", "pitch": f"${{{join.home}.pitch}}"}
        return {"name": join.name} | numbers | {"radius": f"${{{join.moves[0]}.cylinder_radius}}"}

    def _joins(self, word: str) -> list[dict[str, Any]]:
        """The numbers of the joins of a word, which all others refer to."""
        return [{"name": join.name} | self._numbers(join) for join in self.parts.joins if join.word == word]

    @staticmethod
    def _numbers(join: Join) -> dict[str, Any]:
        keys, path = join.keys, join.path
        if isinstance(keys, BeltKeys):
            home, names = (*path, "diameters"), ("diameter_1", "diameter_2")
            return {name: Typed(home, millimetres(size)) for name, size in zip(names, join.sizes, strict=True)}
        names = ("teeth_1", "teeth_2")
        row: dict[str, Any] = {
            name: Typed((*path, "teeth"), str(size)) for name, size in zip(names, join.sizes, strict=True)
        }
        if isinstance(keys, MeshKeys):
            typed = ("module", "helix_angle") if keys.helix_angle else ("module",)
            return row | {key: Typed((*path, key)) for key in typed}
        weight = standard_table("roller_chains").by_name("mass_per_length")[keys.chain]
        row["pitch"] = Typed((*path, "chain"), millimetres(chain_pitch(keys)))
        row["links"] = Typed((*path, "links"))
        row["strands"] = len(keys.sprockets)
        row["mass_per_length"] = Typed((*path, "chain"), f"{weight:g} kg/m")
        return row | {key: Typed((*path, key)) for key in ("moving_mass", "pretension") if key in join.more}

    def _mesh(self, join: Join) -> None:
        keys, path = join.keys, join.path
        pinion, wheel = join.parts if keys.teeth_1 <= keys.teeth_2 else join.parts[::-1]
        first = 1 if pinion in join.drivers else 2
        inputs: dict[str, Any] = {
            "module": f"${{{join.home}.module}}", "teeth_1": f"${{{join.home}.teeth_{first}}}", "teeth_2": f"${{{join.home}.teeth_{3 - first}}}",
            "face_width": Typed((*path, "width")),
        }  # fmt: skip
        if keys.helix_angle:
            typed = (*path, "helix_angle")
            size = Typed(typed, f"{-degrees(keys.helix_angle):.12g} deg")
            inputs["helix_angle"] = Typed(typed) if keys.helix_angle > 0 else size
        torque = self._torque_reference(pinion)
        inputs |= {"torque": torque} if torque else {"torque": self._torque_reference(wheel), "torque_on": "wheel"}
        if inputs["torque"] is None:
            return
        inputs |= self._accuracy(pinion, wheel)
        if cases := self.cases_of_mesh(join, pinion):
            inputs["load_cases"] = cases
        for limit in GEAR_LIMITS:
            if getattr(self.parts.keys.gears, limit):
                gears = (gear for gear in (1, 2) if f"material_{gear}" not in join.more)  # which says its own
                inputs |= {f"{limit}_{gear}": Typed(("machine", "gears", limit)) for gear in gears}
        moving = self.parts.motion_port(wheel.shaft)
        if keys.teeth_present and moving is not None and moving.port:
            present = Typed((*path, "teeth_present"))
            inputs["sector"] = {"swing": f"${{{moving.port[0]}.swing_angle}}", "teeth_present": present}
        inputs |= {"application_factor": 1} | self._beside(inputs, join.more, path, join.drivers[0].path, OF_MESH)
        self._add(join.calculation, "gear_pair", inputs, path)

    def _accuracy(self, pinion: ShaftPart, wheel: ShaftPart) -> dict[str, Any]:
        """What the load factors of a pair follow from, as far as it is known: speed, grade, and how the shafts stand askew."""
        gears, bearings = self.parts.keys.gears, pinion.shaft.bearing_calculation
        found: dict[str, Any] = {}
        if pinion.shaft.name in self.parts.ratios:
            found["speed"] = self.speed(pinion.shaft.name)
        elif self.is_made(bearings):
            found["speed"] = f"${{{bearings}.{pinion.shaft.bearings[0].name}_speed_max}}"
        found |= {key: Typed(("machine", "gears", key)) for key in ("grade", "crowned") if getattr(gears, key)}
        if gears.flanks:
            found |= {f"flanks_{gear}": Typed(("machine", "gears", "flanks")) for gear in (1, 2)}
        if self._has_teeth(pinion) and self._has_teeth(wheel):
            slopes = (f"${{{part.shaft.calculation}.{part.name}_mesh_slope}}" for part in (pinion, wheel))
            found["slope"] = " + ".join(slopes)
        return found

    def _has_teeth(self, part: ShaftPart) -> bool:
        """Whether the calculation of its shaft has the forces on the teeth of a gear."""
        shaft = next((each for each in self.made if each.name == part.shaft.calculation), None)
        return shaft is not None and any(load["name"] == part.name and "gear" in load for load in shaft.inputs["loads"])

    def _torque_reference(self, part: ShaftPart) -> str | None:
        loads = part.shaft.loads
        if not self.is_made(loads):
            return None
        if self.torque_on(part):
            return f"${{{loads}.{part.name}_torque}}"
        return f"${{{loads}.balance}}" if self._balances(part) else None

    def _chain(self, join: Join) -> None:
        if not self.is_calculated(join):
            return
        keys: ChainKeys = join.keys
        mechanism, _ = join.moves or ("", "")
        inputs: dict[str, Any] = {
            "chain": keys.chain, "use": "conveyor", "strands": len(keys.sprockets), "teeth_1": f"${{{join.home}.teeth_1}}",
            "teeth_2": f"${{{join.home}.teeth_2}}", "links": f"${{{join.home}.links}}",
        }  # fmt: skip
        if self.is_rolling(join):
            inputs |= {"acceleration": f"${{{mechanism}.acceleration}}", "velocity": f"${{{mechanism}.velocity}}",
                       # with the unbalance, which counts most at the ends of the travel, where the acceleration is greatest
                       "moving_mass": {"value": f"(${{{mechanism}.reduced_inertia}} + 2 * ${{{mechanism}.cylinder_radius}} * "
                                                f"${{{mechanism}.static_unbalance}}) / ${{{mechanism}.cylinder_radius}}**2",
                                    "beyond": "the chains move the cylinder, not gripper bars with a sheet"},
                       "process_force": f"${{{mechanism}.cutting_moment}} / ${{{mechanism}.cylinder_radius}}"}  # fmt: skip
        else:
            inputs |= {key: f"${{{mechanism}.sheet_{key}}}" for key in ("acceleration", "velocity")}
            if join.driven:
                inputs["driven_inertia"] = self.inertia_behind(join.driven_shaft, has_losses=True)
        typed = self._beside(inputs, join.more, join.path, (*join.path, "moves"), OF_CHAIN)
        inputs |= typed | {key: f"${{{join.home}.{key}}}" for key in ("moving_mass", "pretension") if key in typed}
        self._add(join.calculation, "roller_chain", inputs, join.path)

    def _belt(self, join: Join) -> None:
        train = self.named("drive_train")
        if train is None:
            return
        keys, path = join.keys, join.path
        distance = self.parts.distance(join.driving_shaft.name, join.driven_shaft.name)
        vbelt: dict[str, Any] = {"section": keys.section}
        vbelt["driver_diameter"] = Typed((*path, "diameters"), millimetres(keys.diameter_1))
        if distance is not None:
            vbelt["center_distance"] = Typed(("machine", "frame"), millimetres(distance))
        vbelt |= {key: Typed((*path, key)) for key in ("count", "tension") if getattr(keys, key) is not None}
        if typed := [key for key in SERVICE_KEYS if key in self._raw(("machine",))]:
            vbelt["service_factor"] = Typed(("machine", typed[0]), f"{self._service_factor(train):g}")
        more = (key for key in join.more if key != "power_per_belt")
        vbelt |= self._beside(vbelt, more, path, ("machine",), {"center_distance"})
        vbelt["driven_diameter"] = Typed((*path, "diameters"), millimetres(keys.diameter_2))
        fills: dict[str, Any] = {"vbelt": vbelt, "gears": self._train_gears(join.driven_shaft.name)}
        fills |= self._shafts_inertia(join.driven_shaft)
        if "power_per_belt" in join.more:
            fills["power_per_belt"] = Typed((*path, "power_per_belt"))
        if motor := join.driving_shaft.keys.motor:
            home = (*join.driving_shaft.path, "motor")
            fills["motor_speed"] = Typed((*home, "speed"))
            if motor.radial_force is not None:
                fills["allowable_radial_force"] = Typed((*home, "radial_force"))
        self.fills.setdefault(train, {}).update(fills)

    def _shafts_inertia(self, shaft: MachineShaft) -> dict[str, Any]:
        """What the motor runs up beside the flywheel and the lines: the flywheel's shaft, and the steadily turning ones behind it."""
        flywheel = self.flywheel(shaft)
        is_typed = flywheel is not None and "inertia" in flywheel.more and not self.is_sized(flywheel)
        mounted = {"mounted_inertia": Typed((*flywheel.path, "inertia"))} if flywheel and is_typed else {}
        if flywheel and is_typed and flywheel.keys.outside is not None:
            mounted["mounted_diameter"] = Typed((*flywheel.path, "outside"))
        behind = [name for name in self.parts.ratios if self.parts.chain_from(shaft.name, name)]
        own = self.inertia_without(shaft, {flywheel.name} if flywheel else ()) if self.is_made(shaft.body) else ""
        output = self.inertia_of_steady(self.parts.keys.anchor, behind)
        found = {"shaft_2_inertia": own, "output_shafts_inertia": output}
        return mounted | {key: text for key, text in found.items() if text}

    def _service_factor(self, train: str) -> float:
        """The factor on the motor's power for the belts: the greater one where the run-up torque is not a number of the file."""
        keys, run_up = self.parts.keys, "run_up_torque_ratio"
        usual = self.of_kind["drive_train"].inputs.model_fields[run_up].default
        typed = self.parts.reader.typed_number(train, run_up)
        ratio = typed or (inf if run_up in self._raw(("mechanisms", train)) else usual)
        return SERVICE_FACTORS[keys.service][ratio > HIGH_RUN_UP][(keys.hours_per_day > 10) + (keys.hours_per_day > 16)]

    def _train_gears(self, shaft: str) -> list[dict[str, Any]]:
        """The gear pairs from the flywheel's shaft to the main one; a chain is a pair of the same ratio."""
        found = []
        for join, _ in reversed(self.parts.routes.get(shaft, [])):
            if not isinstance(join.keys, BeltKeys):
                names = ("driver_teeth", "driven_teeth")
                teeth = (Typed((*join.path, "teeth"), str(size)) for size in join.sizes)
                pair: dict[str, Any] = dict(zip(names, teeth, strict=True))
                if "efficiency" in self._raw(join.path):
                    pair["efficiency"] = Typed((*join.path, "efficiency"))
                found.append(pair)
        return found
