"""Inputs of the gear pair."""

from __future__ import annotations

from typing import Any, ClassVar, Literal

from diecut_report.api import POINTS, Annotated, Block, CurveInput, FromTable, Inputs, OneOf, Quantity, Text

# fmt: off

GEARS = {1: "pinion", 2: "wheel"}

class Sector(Block):
    """Keys of the block ``sector``: the wheel is a part of a full circle and swings."""

    swing: Annotated[float, Quantity("γ", "deg", "Swing of the sector, from end to end", gt=0, lt=360)]
    teeth_present: Annotated[int | None, Quantity("z_p", "1", "Number of teeth of the sector", ge=1, integer=True)] = None


class MeshLoadCase(Block):
    """A load case beside the run."""

    name: Annotated[Literal["engage", "start", "stop"], Text("Engagement of the clutch, start of the motor, or stop by the brake")]
    torque: Annotated[float, Quantity("T_j", "N*m", "Torque of the load case on the pinion, its size", ge=0)]
    cycles: Annotated[float, Quantity("N_j", "1", "Number of its load cycles in the life; it counts for pitting above 10⁵", ge=0,
        plausible=("1", "1e12"))]


Flanks = Literal["through_hardened", "case_hardened", "grey_iron"]
OF_MATERIAL = ("sigma_h_lim", "sigma_f_lim", "elastic_modulus")


class ExternalGearPair(Inputs):
    """Keys of ``gear_pair``."""

    one_of: ClassVar[tuple[OneOf, ...]] = (
        OneOf(("torque",), ("torque_curve",)),
        OneOf(("shift_2",), ("center_distance", "module"), shared=("module",), optional=True),
    )

    curve_keys: ClassVar[dict[str, str]] = {"torque": "torque_curve"}
    from_tables: ClassVar[tuple[FromTable, ...]] = tuple(
        FromTable(f"material_{gear}", "gear_materials", {f"{key}_{gear}": key for key in OF_MATERIAL})
        for gear in (1, 2)
    )

    module: Annotated[float | None,
        Quantity("m_n", "mm", "Normal module; if omitted, the smallest module of ISO 54 that is sufficient is selected", gt=0)] = None
    teeth_1: Annotated[int, Quantity("z_1", "1", "Number of teeth of the pinion", ge=5, integer=True)]
    teeth_2: Annotated[int, Quantity("z_2", "1", "Number of teeth of the wheel, not fewer; for a sector that of the full circle", ge=5, integer=True)]
    face_width: Annotated[float, Quantity("b", "mm", "Common face width, the smaller of the two", gt=0)]
    helix_angle: Annotated[float, Quantity("β", "deg", "Helix angle at the reference circle", ge=0, le=30)] = 0
    pressure_angle: Annotated[float, Quantity("α_n", "deg", "Normal pressure angle", ge=14.5, le=25)] = 20
    shift_1: Annotated[float, Quantity("x_1", "1", "Profile shift coefficient of the pinion", ge=-1, le=1.5)] = 0
    shift_2: Annotated[float | None,
        Quantity("x_2", "1", "Profile shift coefficient of the wheel; default: 0 without center_distance", ge=-1, le=1.5)] = None
    center_distance: Annotated[float | None, Quantity("a", "mm", "Centre distance; determines the wheel's profile shift", gt=0)] = None
    addendum: Annotated[float, Quantity("h_aP", "1", "Addendum factor of the basic rack (ISO 53, profile A)", gt=0)] = 1.0
    dedendum: Annotated[float, Quantity("h_fP", "1", "Dedendum factor of the basic rack (ISO 53, profile A)", gt=0)] = 1.25
    root_radius: Annotated[float, Quantity("ρ_fP", "1", "Root fillet radius factor of the basic rack (ISO 53, profile A)", gt=0)] = 0.38
    keep_clearance: Annotated[bool, Text("Tips shortened so that the tip clearance remains that of the basic rack")] = False
    torque: Annotated[float | None, Quantity("T", "N*m", "Torque, signed; a reference to a curve over a cycle is used as torque_curve")] = None
    torque_curve: Annotated[Any | None, CurveInput("T_φ", "N*m", "Torque over a cycle, signed, in the place of torque")] = None
    torque_on: Annotated[Literal["pinion", "wheel"], Text("Gear on which the torque acts")] = "pinion"
    load_cases: Annotated[list[MeshLoadCase], Text("Load cases beside the run: for the tooth root, and for pitting where they are frequent")] = []  # noqa: RUF012
    speed: Annotated[float | None,
        Quantity("n_1", "rpm", "Speed of the pinion, the greatest one; required for pitch line velocity and power", gt=0)] = None
    grade: Annotated[int | None,
        Quantity("Q", "1", "Grade of accuracy of the worse gear (ISO 1328-1:2013); with it and the speed the K factors are calculated", ge=3, le=11,
            integer=True)] = None
    crowned: Annotated[bool, Text("Teeth crowned by half of the misalignments by manufacture and load")] = False
    slope: Annotated[float | None,
        Quantity("Δv′", "mrad", "Difference of the slopes of both shafts at the mesh, in the plane of action; with it K_Hβ is calculated",
            plausible=("1e-7 rad", "0.1 rad"))] = None
    flanks_1: Annotated[Flanks, Text("Flanks of the pinion, by which it runs in; case_hardened also for nitrided ones")] = "through_hardened"
    flanks_2: Annotated[Flanks, Text("Flanks of the wheel, by which it runs in; case_hardened also for nitrided ones")] = "through_hardened"
    application_factor: Annotated[float | None,
        Quantity("K_A", "1", "Application factor; default 1.25 (1 where a torque curve includes the dynamics)", ge=1)] = None
    dynamic_factor: Annotated[float | None,
        Quantity("K_V", "1", "Dynamic factor; default: calculated, or 1.1 without grade and speed", ge=1)] = None
    face_load_factor: Annotated[float | None,
        Quantity("K_Hβ", "1", "Face load factor for contact stress; default: calculated, or 1.3 without grade, speed and slope", ge=1)] = None
    transverse_load_factor: Annotated[float | None,
        Quantity("K_Hα", "1", "Transverse load factor; default: calculated, or without grade and speed 1 (helical teeth 1.2)", ge=1)] = None
    material_1: Annotated[str | None,
        Text("Material of the pinion: an entry of gear_materials in a table of your own, in place of its limits")] = None
    material_2: Annotated[str | None, Text("Material of the wheel: an entry of gear_materials in a table of your own, in place of its limits")] = None
    sigma_h_lim_1: Annotated[float, Quantity("σ_Hlim1", "MPa", "Allowable contact stress number of the pinion (ISO 6336-5)", gt=0)]
    sigma_h_lim_2: Annotated[float, Quantity("σ_Hlim2", "MPa", "Allowable contact stress number of the wheel (ISO 6336-5)", gt=0)]
    sigma_f_lim_1: Annotated[float, Quantity("σ_Flim1", "MPa", "Nominal bending stress number of the pinion (ISO 6336-5; σ_FE is twice this)", gt=0)]
    sigma_f_lim_2: Annotated[float, Quantity("σ_Flim2", "MPa", "Nominal bending stress number of the wheel (ISO 6336-5; σ_FE is twice this)", gt=0)]
    elastic_modulus_1: Annotated[float, Quantity("E_1", "GPa", "Modulus of elasticity of the pinion (steel)", gt=0)] = 206
    elastic_modulus_2: Annotated[float, Quantity("E_2", "GPa", "Modulus of elasticity of the wheel (steel)", gt=0)] = 206
    life_factor_h_1: Annotated[float, Quantity("Z_NT1", "1", "Life factor of the pinion for contact stress", ge=0.85, le=1.6)] = 1
    life_factor_h_2: Annotated[float, Quantity("Z_NT2", "1", "Life factor of the wheel for contact stress", ge=0.85, le=1.6)] = 1
    life_factor_f_1: Annotated[float, Quantity("Y_NT1", "1", "Life factor of the pinion for tooth root stress", ge=0.85, le=2.5)] = 1
    life_factor_f_2: Annotated[float, Quantity("Y_NT2", "1", "Life factor of the wheel for tooth root stress", ge=0.85, le=2.5)] = 1
    film_factor: Annotated[float,
        Quantity("Z_LRvWX", "1", "Product of the factors for lubricant film, roughness, speed, work hardening and size", ge=0.5, le=1.3)] = 1
    notch_size_factor: Annotated[float,
        Quantity("Y_δRX", "1", "Product of the factors for notch sensitivity, roughness and size", ge=0.5, le=1.3)] = 1
    alternating_factor: Annotated[float | None,
        Quantity("Y_M", "1", "Mean stress influence factor; default 0.7 where the torque reverses, otherwise 1", gt=0, le=1)] = None
    required_pitting_safety: Annotated[float, Quantity("S_Hmin", "1", "Required safety factor against pitting", ge=1)] = 1.0
    required_root_safety: Annotated[float, Quantity("S_Fmin", "1", "Required safety factor against tooth breakage", ge=1)] = 1.4
    sector: Annotated[Sector | None, Text("The wheel is an oscillating sector")] = None
    n_points: Annotated[int, POINTS] = 360
