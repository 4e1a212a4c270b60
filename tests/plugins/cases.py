"""Machines of every kind for the contract test: those of the examples, and such as have all that the examples leave out."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np

from diecut_report.config.loader import load_config
from diecut_report.config.plugins import Discovery
from diecut_report.machine.calculation import Calculation, CurveHandle
from diecut_report.mechanics.motion_laws import LAWS
from diecut_report.mechanism.names import SI
from diecut_report.quantities.units import unit
from diecut_report.results.press_run import Found, found
from diecut_report.results.warm_press import WarmPress, WarmRun
from diecut_report.testing.machines import MachineCase as Case
from diecut_report.testing.machines import Ranges
from tests.configs import EXAMPLES
from tests.machines import PUBLISHED_CYLINDER, PUBLISHED_DRIVE, UNBALANCED, inputs
from tests.plugins import bearings, chains, machine_parts
from tests.plugins.clutches import COOLED
from tests.plugins.drive_trains import EXAMPLE as TRAIN
from tests.plugins.drive_trains import PAIRS, UNEVEN
from tests.plugins.followers import SHAFT
from tests.plugins.gears import AT_DISTANCE, GRADED, SECTOR, SIZED, SIZED_BY_GRADE
from tests.plugins.keys import OWN, TURNING
from tests.plugins.keys import SIZED as SIZED_KEY
from tests.plugins.platens import GUIDED
from tests.plugins.presses import whole_press
from tests.plugins.shafts import CRANKSHAFT, LAYSHAFT, OWN_STEEL, STANDING
from tests.plugins.shafts import SIZED as SIZED_SHAFT
from tests.plugins.steppers import LOADED, PUBLISHED
from tests.validation.rows_circular_knife import KEYS as CIRCULAR
from tests.validation.rows_damper import WORKED as DAMPER

DISCOVERY = Discovery([])
OF_KINDS = {kind: DISCOVERY.mechanism(kind) for kind in DISCOVERY.origins}
COMPARISONS = {c.mechanism.kind: c.mechanism for mechanism in OF_KINDS.values() for c in mechanism.comparisons}
MECHANISMS = OF_KINDS | COMPARISONS
CONFIGS = {path.stem: load_config(path, DISCOVERY) for path in EXAMPLES}

# Keys that the examples do not give, and limits (SI) wide enough that some machines cannot exist.
KNIFE: dict[str, Any] = {"working_depth": 40, "signature_length": 273, "n_points": 72}
LINKAGE: dict[str, Any] = {"crank": 20, "coupler": 110, "rocker": 80, "frame": 120, "knife_arm": 107}
KNIVES: dict[str, Any] = KNIFE | {"planetary": {"carrier_radius": 65.656}, "crank_slider": {"crank_radius": 35, "rod_length": 140}}  # fmt: skip
CROSS: dict[str, Any] = {
    "slots": 6, "center_distance": "200 mm", "crank_speed": "100 rpm", "roller_radius": "10 mm", "sprocket_teeth": 24,
    "chain_pitch": "31.75 mm", "gear_ratio": 4, "driven_inertia": 1, "own_inertia": 0.2, "efficiency": 0.95, "roller_width": "20 mm", "n_points": 72,
    "allowable_torque": 300, "allowable_sheet_play": "0.3 mm",
}  # fmt: skip
BELT: dict[str, Any] = {
    "cylinder_radius": "105 mm", "driven_radius": "60 mm", "cylinder_velocity": "1 m/s", "shaft_speed": "150 rpm", "pitch": "8 mm",
    "pulleys": [{"x": 0, "y": 0, "radius": 100, "side": "inside"}, {"x": 600, "y": 0, "radius": 100, "side": "inside"},
                {"x": 300, "y": 70, "radius": 50, "side": "outside"}],
}  # fmt: skip
SLIDE: dict[str, Any] = {
    "mass": "0.8 kg",
    "stiffness": "5200 N/m",
    "damping_ratio": 0.05,
    "rise": "1.2 m",
    "rise_time": "0.2 s",
}
LIMITED = {
    "crank_length": "100 mm", "pinion_radius": "60 mm", "allowable_torque": 600, "allowable_acceleration": 15, "allowable_tooth_force": 10,
    "allowable_joint_force": 10,
}  # fmt: skip
FULL: dict[str, dict[str, dict[str, Any]]] = {
    "cam_gear_transport": {law: PUBLISHED | LOADED | {"motion_law": law, "allowable_torque": 300, "n_points": 72} for law in LAWS},
    "circular_knife": {"worked": CIRCULAR | {"n_points": 72, "allowable_force": 20, "allowable_torque": 1}},
    "clutch": {"cooled": COOLED | {"available_force": 4000, "allowable_slip_time": 1}},
    "cylinder_drive": {
        "unbalanced": PUBLISHED_DRIVE | UNBALANCED | LIMITED | {"n_points": 72, "pinion_inertia": 0.03, "rocker_inertia": 1.2},
        "published": PUBLISHED_DRIVE | {"n_points": 72},
    },
    "cylinder_sizing": {"published": PUBLISHED_CYLINDER, "sized": {"working_length": 500, "segment_height": 30, "generatrix_length": 700}},
    "damper": {"driven": DAMPER | {"drive": {"force": 1}, "impacts_per_hour": 3000, "allowable_force": 4000, "allowable_deceleration": 50,
                                   "allowable_heat_power": 10}},
    "drive_train": {
        "flywheel": TRAIN | {"gears": PAIRS, "torque_curve": UNEVEN, "torque_mean": 189.1667, "torque_peak": 1500, "power_per_belt": 2},
        "toothed belt": TRAIN | {"toothed_belt": BELT},
    },
    "drive_line": {"line": machine_parts.LINE},
    "elastic_follower": {
        "shaft": SHAFT | {"n_points": 72, "motion_law": "modified_trapezoidal", "allowable_torque": 100},
        "slide": SLIDE | {"n_points": 72, "allowable_torque": 100},
    },
    "gear_pair": {
        "sector": SECTOR | {"n_points": 72}, "sized": SIZED, "at distance": AT_DISTANCE, "graded": GRADED, "sized by grade": SIZED_BY_GRADE,
    },
    "geneva_transport": {"loaded": CROSS},
    "knife_drive": {side: KNIVES | {"crank_rocker": LINKAGE | {"lowest_dead_center": side}} for side in ("outer", "inner")},
    "machine_inertia": {"moving": machine_parts.INERTIA},
    "parallel_key": {"turning": TURNING | {"n_points": 72}, "sized": SIZED_KEY, "own dimensions": OWN},
    "platen_press": {"guided": GUIDED | {"n_points": 72, "crank_pin_length": "100 mm"}},
    "press_consistency": {"whole": whole_press()},
    "roller_chain": {
        "grippers": chains.GRIPPERS | {"n_points": 72}, "uneven": chains.UNEVEN | {"n_points": 72}, "custom": chains.CUSTOM,
        "rated": chains.RATED, "even acceleration": chains.without(chains.GRIPPERS, "acceleration_curve") | {"acceleration": 30},
        "even velocity": chains.without(chains.GRIPPERS, "velocity_curve", "chain") | {"velocity": 1},
        "numbers": chains.without(chains.GRIPPERS, "velocity_curve", "acceleration_curve") | {"velocity": 1, "acceleration": 30},
    },
    "rolling_bearing": {
        "numbers": {"bearings": [bearings.BALL | {"axial_force": 900}, bearings.BALL | {"name": "other", "radial_force": -9000}], "n_points": 72},
        "kinds": {"bearings": [bearings.ANGULAR, bearings.ROLLER, bearings.SOUGHT, bearings.SOUGHT_ROLLER], "reliability": 95, "n_points": 72},
        "curves": {"bearings": [bearings.SWINGING, bearings.WAVING, bearings.JUMPING, bearings.SOUGHT | {
            "axial_force": bearings.WAVING["axial_force"]}], "required_static_safety": 2, "n_points": 72},
    },
    "shaft": {"crank": CRANKSHAFT | {"speed": 50}, "lay": LAYSHAFT, "standing": STANDING, "sized": SIZED_SHAFT, "own steel": OWN_STEEL},
    "shaft_body": {"bored": machine_parts.BODY},
    "shaft_loads": {name: machine_parts.with_mechanisms(keys) for name, keys in
                    (("stepped", machine_parts.STEPPED), ("swinging", machine_parts.SWINGING))},
}  # fmt: skip
WIDELY: dict[str, Ranges] = {
    "cam_gear_transport": {"dwell_angle": (1.5, 4.2), "sector_stop_sweep": (0.1, 0.6), "arm_length": (0.05, 0.1), "cycles_per_hour": (1, 2)},
    "circular_knife": {"eccentricity": (0.01, 0.04), "edge_radius": (0.06, 0.14), "front_distance": (0.01, 0.06),
                       "thickness": (2e-4, 3e-3), "friction": (0, 0.4)},
    "clutch": {"torque": (10, 2000), "wedge_angle": (0.02, 1.5), "wedge_friction": (0, 0.9), "load_torque_at_engagement": (0, 300),
               "engagements_per_hour": (0, 0.1), "drum_mass": (0.5, 30)},
    "cylinder_drive": {"frame_ratio": (4.6, 6.2), "coupler_ratio": (4.6, 5.6), "rocker_ratio": (1.9, 3.0), "crank_speed": (3, 13),
                       "cylinder_mass": (40, 160), "static_unbalance": (0, 3), "cutting_arc_fraction": (0.3, 1.0),
                       "efficiency_four_bar": (0.6, 1.0), "cutting_force_per_length": (0, 8e4)},
    "cylinder_sizing": {"working_length": (0.2, 0.9), "segment_height": (0.005, 0.06), "bore_radius": (0, 0.13)},
    "damper": {"kinetic_energy": (1, 500), "drive.force": (1, 5000), "ring_width": (1e-3, 0.2)},
    "drive_train": {"output_speed": (5, 40), "vbelt.center_distance": (0.5, 0.9), "toothed_belt.shaft_speed": (2, 60)},
    "drive_line": {"reference_speed": (1, 20)},
    "elastic_follower": {"stiffness": (1e3, 9e4), "damping_ratio": (0, 0.5), "dwell_cycles": (0.5, 9)},
    "gear_pair": {"teeth_1": (8, 40), "teeth_2": (20, 90), "helix_angle": (0, 0.5), "shift_1": (-0.5, 1), "torque": (5, 3000),
                  "face_width": (0.01, 0.1), "root_radius": (0.1, 0.5), "center_distance": (0.15, 0.2)},
    "geneva_transport": {"slots": (3, 18), "center_distance": (0.05, 0.3), "roller_radius": (0.004, 0.03), "crank_speed": (3, 20),
                         "driven_inertia": (0.1, 9), "locking_clearance": (0, 2e-4)},
    "knife_drive": {"working_depth": (0.005, 0.06), "cylinder_rate": (2, 12), "planetary.carrier_radius": (0.012, 0.08),
                    "crank_slider.crank_radius": (0.02, 0.05), "crank_slider.rod_length": (0.045, 0.2),
                    "crank_rocker.crank": (0.012, 0.04), "crank_rocker.knife_arm": (0.08, 0.25), "grip_angle": (0.02, 0.2)},
    "machine_inertia": {},
    "parallel_key": {"shaft_diameter": (0.006, 0.22), "torque": (1, 9000), "chamfer": (0, 0.004), "key_length": (0.01, 0.12),
                     "torque_peak": (300, 2000)},
    "platen_press": {"material_thickness": (1e-4, 3e-3), "drive_deformation": (1e-4, 2e-3), "rod_length": (0.08, 1.2),
                     "cycles_per_hour": (0.1, 2), "offset_force": (-0.02, 0.02), "friction": (0, 0.3)},
    "roller_chain": {"teeth_1": (6, 60), "center_distance": (0.05, 2), "links": (20, 400), "torque": (1, 3000), "speed": (1, 200),
                     "strands": (1, 4), "moving_mass": (0, 50), "power": (100, 50000)},
    "press_consistency": {"clutch_load": (0, 900), "clutch_speed": (2, 12), "contact_distance": (0.005, 0.9),
                          "flywheel_inertia": (0.1, 20), "damper_velocity": (0.1, 4)},
    "rolling_bearing": {"required_life": (3.6e6, 3.6e9), "service_factor": (1, 2)},
    "shaft": {"bearing_a": (0.0, 0.06), "bearing_b": (0.2, 0.32), "yield_strength": (3e8, 1.2e9), "tensile_strength": (4e8, 1e9)},
    "shaft_body": {},
    "shaft_loads": {"main_turns": (1, 6), "motion.offset": (-9, 9)},
}  # fmt: skip


@cache
def example(stem: str) -> WarmRun:
    """An example, calculated; nothing of it is printed."""
    return WarmPress(is_advised=False).calculate(CONFIGS[stem])


def names(kind: str) -> list[str]:
    """The machines of a kind: those of the examples as ``EXAMPLE-NAME``, and the full ones."""
    if kind in COMPARISONS:
        return [f"{stem}-" for stem, config in CONFIGS.items() if kind in _compared(set(config.kinds.values()))]
    found = [f"{stem}-{name}" for stem, config in CONFIGS.items() for name, k in config.kinds.items() if k == kind]
    return [*found, *FULL.get(kind, {})]


def _compared(kinds: set[str]) -> set[str]:
    """The comparisons that are made between mechanisms of these kinds."""
    return {c.mechanism.kind for kind in kinds for c in OF_KINDS[kind].comparisons if kinds.issuperset(c.kinds)}


def case(kind: str, name: str) -> Case:
    """A machine of a kind by its name."""
    stem, _, instance = name.partition("-")
    if name in FULL.get(kind, {}):
        return Case(MECHANISMS[kind], inputs(MECHANISMS[kind], FULL[kind][name]), WIDELY[kind])
    run = example(stem)
    if kind in COMPARISONS:
        return Case(
            MECHANISMS[kind],
            _taken(next(each for each in found(run.calculations) if each.comparison.mechanism.kind == kind), run),
            {},
        )
    return Case(MECHANISMS[kind], _given(run.calculations[instance]), {})


def _given(calc: Calculation) -> dict[str, Any]:
    """What a single machine was calculated from, as the engine takes it, with fewer samples of its curves."""
    values = {name: value if not isinstance(value, np.ndarray) else tuple(map(float, value[0])) if name in calc.axis else float(value[0, 0])
              for name, value in calc.inputs.items()}  # fmt: skip
    return values | ({"n_points": 72} if "n_points" in values else {})


def _taken(case: Found, run: WarmRun) -> dict[str, Any]:
    """What a comparison takes from the results of others, as the engine takes it."""
    values: dict[str, Any] = {}
    for key, (kind, name) in case.comparison.takes.items():
        calc = run.calculations[case.between[kind]]
        known = calc.values.get(name, calc.inputs.get(name))
        if name in calc.curves:
            values[key] = CurveHandle(calc, name)
        elif isinstance(known, str):
            values[key] = known
        elif known is not None and not np.isnan(known[0, 0]):
            values[key] = SI(float(known[0, 0]), unit(calc.step_or_input(name).unit).si, name)
    return inputs(case.comparison.mechanism, values)
