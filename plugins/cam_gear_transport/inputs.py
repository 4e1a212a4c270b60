"""Inputs of the cam-gear stepper."""

from __future__ import annotations

from diecut_report.api import FromPress, Inputs, Quantity, Text, samples
from diecut_report.mechanics.motion_laws import LAWS

# fmt: off

TURNS = ("0.01 deg", "3600 deg")
# of less the return would be nearly a turn, within which curves are too narrow to be proved
DWELL = ("1 deg", "360 deg")


def _arm_angle(number: str) -> Quantity:
    return Quantity(
        f"χ_{number}",
        "deg",
        f"Angle of arm {number} from the outward line O₁O₃ at the start of the dwell, counter-clockwise",
        ge=-360,
        le=360,
        optional=True,
    )


class CamGearTransport(Inputs):
    """Keys of ``cam_gear_transport``."""

    dwell_angle = Quantity("φ_22", "deg", "Dwell of the gear as a disc angle (phase II)", gt=0, lt=360, plausible=DWELL)
    sector_dwell_sweep = Quantity("γ_32", "deg", "Sweep of the sector during the dwell (phase II)", gt=0, plausible=TURNS, default=60)
    sector_stop_sweep = Quantity("γ_3(3+1)", "deg", "Sweep of the sector while it stops and starts, phases III and I together", gt=0, plausible=TURNS,
        default=20)
    motion_law = Text("Law of motion with which the sector stops, returns and starts", options=LAWS, default="cycloidal")
    center_distance = Quantity("R_2", "mm", "Radius of the pin O₃ on the disc: centre distance of gear and sector", gt=0)
    cycles_per_hour = Quantity("n", "1/h", "Cycle rate: one revolution of the disc and one sheet per cycle", gt=0,
        press=FromPress("press.productivity"))
    min_return_time = Quantity("T_min", "1", "Minimum acceptable fraction of a revolution for the sector's return", gt=0, lt=1, default=0.1)
    module = Quantity("m", "mm", "Module; if given, gear and sector must have whole numbers of teeth", gt=0, optional=True)
    sprocket_teeth = Quantity("z_s", "1", "Number of teeth of the conveyor's sprocket; required with chain_pitch for the sheet's motion", gt=0,
        integer=True, optional=True)
    chain_pitch = Quantity("p", "mm", "Pitch of the conveyor's chain", gt=0, optional=True)
    sprocket_ratio = Quantity("u", "1", "Revolutions of the sprocket per revolution of the gear", gt=0, plausible=("0.001", "1000"), default=1)
    allowable_sheet_acceleration = Quantity("[a_s]", "m/s**2", "Allowable acceleration of the sheet", gt=0, optional=True)
    grammage = Quantity("m_A", "g/m**2", "Mass of the board per unit area; required with gripper_force for the grip check", gt=0, optional=True)
    sheet_length = Quantity("L_s", "mm", "Length of the sheet", gt=0, press=FromPress("press.sheet.length", optional=True))
    sheet_width = Quantity("B_s", "mm", "Width of the sheet", gt=0, press=FromPress("press.sheet.width", optional=True))
    gripper_force = Quantity("[F_g]", "N", "Total force with which the grippers hold a sheet", gt=0, optional=True)
    rest_tolerance = Quantity("e", "mm", "Tolerance on the sheet's position within which it counts as at rest; required for that phase", gt=0,
        optional=True)
    conveyor_mass = Quantity("m_c", "kg", "Mass that moves with the conveyor's chain, sheets included; required for the torque", gt=0, optional=True)
    allowable_torque = Quantity("[M]", "N*m", "Allowable torque at the disc's shaft", gt=0, optional=True)
    sector_inertia = Quantity("J_3", "kg*m**2", "Moment of inertia of sector and rocker about O₃, balanced there; 0 neglects it", ge=0, default=0)
    arm_length = Quantity("a", "mm", "Length of the rocker's arms; required with the roller's radius and both angles for the cams", gt=0,
        optional=True)
    roller_radius = Quantity("r", "mm", "Radius of the rocker's rollers", gt=0, optional=True)
    arm_angle_1 = _arm_angle("1")
    arm_angle_2 = _arm_angle("2")
    max_pressure_angle = Quantity("[δ]", "deg", "Maximum acceptable pressure angle of the cams", gt=0, lt=90, default=45)
    roller_width = Quantity("b", "mm", "Contact width of the roller on the cam; required with conveyor_mass for the contact pressure", gt=0,
        optional=True)
    elastic_modulus = Quantity("E", "GPa", "Elastic modulus of rollers and cams", gt=0, default=210)
    poisson_ratio = Quantity("ν", "1", "Poisson's ratio of rollers and cams", ge=0, lt=0.5, default=0.3)
    allowable_contact_pressure = Quantity("[p_H]", "MPa", "Allowable contact pressure between roller and cam", gt=0, optional=True)
    n_points = samples(720)


MODULES = (1, 1.25, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10, 12, 16, 20)
"""The usual modules, in mm."""

CAMS = ("arm_length", "roller_radius", "arm_angle_1", "arm_angle_2")
"""The keys with which the cams are synthesised."""

SHEET = ("sprocket_teeth", "chain_pitch")
"""The keys with which the motion of the sheet is known."""

GRIPPED = (*SHEET, "grammage", "sheet_length", "sheet_width")
"""The keys with which the pull of the sheet at its grippers is known."""

TORQUE = (*SHEET, "conveyor_mass")
"""The keys with which torque and forces are known."""
