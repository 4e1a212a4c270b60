"""Inputs of the gear pair."""

from __future__ import annotations

from diecut_report.api import Block, CurveInput, FromTable, Inputs, OneOf, Quantity, Text, block, parts, samples

# fmt: off

GEARS = {1: "pinion", 2: "wheel"}

class Sector(Block):
    """Keys of the block ``sector``: the wheel is a part of a full circle and swings."""

    swing = Quantity("γ", "deg", "Swing of the sector, from end to end", gt=0, lt=360)
    teeth_present = Quantity("z_p", "1", "Number of teeth of the sector", ge=1, integer=True, optional=True)


class MeshLoadCase(Block):
    """A load case beside the run."""

    name = Text("Engagement of the clutch, start of the motor, or stop by the brake", ("engage", "start", "stop"))
    torque = Quantity("T_j", "N*m", "Torque of the load case on the pinion, its size", ge=0)
    cycles = Quantity("N_j", "1", "Number of its load cycles in the life; it counts for pitting above 10⁵", ge=0, plausible=("1", "1e12"))


Flanks = ("through_hardened", "case_hardened", "grey_iron")
OF_MATERIAL = ("sigma_h_lim", "sigma_f_lim", "elastic_modulus")


class ExternalGearPair(Inputs):
    """Keys of ``gear_pair``."""

    one_of = (
        OneOf(("torque",), ("torque_curve",)),
        OneOf(("shift_2",), ("center_distance", "module"), shared=("module",), optional=True),
    )

    curve_keys = {"torque": "torque_curve"}
    from_tables = tuple(
        FromTable(f"material_{gear}", "gear_materials", {f"{key}_{gear}": key for key in OF_MATERIAL})
        for gear in (1, 2)
    )

    module = Quantity("m_n", "mm", "Normal module; if omitted, the smallest module of ISO 54 that is sufficient is selected", gt=0, optional=True)
    teeth_1 = Quantity("z_1", "1", "Number of teeth of the pinion", ge=5, integer=True)
    teeth_2 = Quantity("z_2", "1", "Number of teeth of the wheel, not fewer; for a sector that of the full circle", ge=5, integer=True)
    face_width = Quantity("b", "mm", "Common face width, the smaller of the two", gt=0)
    helix_angle = Quantity("β", "deg", "Helix angle at the reference circle", ge=0, le=30, default=0)
    pressure_angle = Quantity("α_n", "deg", "Normal pressure angle", ge=14.5, le=25, default=20)
    shift_1 = Quantity("x_1", "1", "Profile shift coefficient of the pinion", ge=-1, le=1.5, default=0)
    shift_2 = Quantity("x_2", "1", "Profile shift coefficient of the wheel; default: 0 without center_distance", ge=-1, le=1.5, optional=True)
    center_distance = Quantity("a", "mm", "Centre distance; determines the wheel's profile shift", gt=0, optional=True)
    addendum = Quantity("h_aP", "1", "Addendum factor of the basic rack (ISO 53, profile A)", gt=0, default=1.0)
    dedendum = Quantity("h_fP", "1", "Dedendum factor of the basic rack (ISO 53, profile A)", gt=0, default=1.25)
    root_radius = Quantity("ρ_fP", "1", "Root fillet radius factor of the basic rack (ISO 53, profile A)", gt=0, default=0.38)
    keep_clearance = Text("Tips shortened so that the tip clearance remains that of the basic rack", default=False)
    torque = Quantity("T", "N*m", "Torque, signed; a reference to a curve over a cycle is used as torque_curve", optional=True)
    torque_curve = CurveInput("T_φ", "N*m", "Torque over a cycle, signed, in the place of torque", optional=True)
    torque_on = Text("Gear on which the torque acts", ("pinion", "wheel"), default="pinion")
    load_cases = parts(MeshLoadCase, "Load cases beside the run: for the tooth root, and for pitting where they are frequent", optional=True)
    speed = Quantity("n_1", "rpm", "Speed of the pinion, the greatest one; required for pitch line velocity and power", gt=0, optional=True)
    grade = Quantity("Q", "1", "Grade of accuracy of the worse gear (ISO 1328-1:2013); with it and the speed the K factors are calculated", ge=3,
        le=11, integer=True, optional=True)
    crowned = Text("Teeth crowned by half of the misalignments by manufacture and load", default=False)
    slope = Quantity("Δv′", "mrad", "Difference of the slopes of both shafts at the mesh, in the plane of action; with it K_Hβ is calculated",
        plausible=("1e-7 rad", "0.1 rad"), optional=True)
    flanks_1 = Text("Flanks of the pinion, by which it runs in; case_hardened also for nitrided ones", Flanks, default="through_hardened")
    flanks_2 = Text("Flanks of the wheel, by which it runs in; case_hardened also for nitrided ones", Flanks, default="through_hardened")
    application_factor = Quantity("K_A", "1", "Application factor; default 1.25 (1 where a torque curve includes the dynamics)", ge=1, optional=True)
    dynamic_factor = Quantity("K_V", "1", "Dynamic factor; default: calculated, or 1.1 without grade and speed", ge=1, optional=True)
    face_load_factor = Quantity("K_Hβ", "1", "Face load factor for contact stress; default: calculated, or 1.3 without grade, speed and slope", ge=1,
        optional=True)
    transverse_load_factor = Quantity("K_Hα", "1", "Transverse load factor; default: calculated, or without grade and speed 1 (helical teeth 1.2)",
        ge=1, optional=True)
    material_1 = Text("Material of the pinion: an entry of gear_materials in a table of your own, in place of its limits", optional=True)
    material_2 = Text("Material of the wheel: an entry of gear_materials in a table of your own, in place of its limits", optional=True)
    sigma_h_lim_1 = Quantity("σ_Hlim1", "MPa", "Allowable contact stress number of the pinion (ISO 6336-5)", gt=0)
    sigma_h_lim_2 = Quantity("σ_Hlim2", "MPa", "Allowable contact stress number of the wheel (ISO 6336-5)", gt=0)
    sigma_f_lim_1 = Quantity("σ_Flim1", "MPa", "Nominal bending stress number of the pinion (ISO 6336-5; σ_FE is twice this)", gt=0)
    sigma_f_lim_2 = Quantity("σ_Flim2", "MPa", "Nominal bending stress number of the wheel (ISO 6336-5; σ_FE is twice this)", gt=0)
    elastic_modulus_1 = Quantity("E_1", "GPa", "Modulus of elasticity of the pinion (steel)", gt=0, default=206)
    elastic_modulus_2 = Quantity("E_2", "GPa", "Modulus of elasticity of the wheel (steel)", gt=0, default=206)
    life_factor_h_1 = Quantity("Z_NT1", "1", "Life factor of the pinion for contact stress", ge=0.85, le=1.6, default=1)
    life_factor_h_2 = Quantity("Z_NT2", "1", "Life factor of the wheel for contact stress", ge=0.85, le=1.6, default=1)
    life_factor_f_1 = Quantity("Y_NT1", "1", "Life factor of the pinion for tooth root stress", ge=0.85, le=2.5, default=1)
    life_factor_f_2 = Quantity("Y_NT2", "1", "Life factor of the wheel for tooth root stress", ge=0.85, le=2.5, default=1)
    film_factor = Quantity("Z_LRvWX", "1", "Product of the factors for lubricant film, roughness, speed, work hardening and size", ge=0.5, le=1.3,
        default=1)
    notch_size_factor = Quantity("Y_δRX", "1", "Product of the factors for notch sensitivity, roughness and size", ge=0.5, le=1.3, default=1)
    alternating_factor = Quantity("Y_M", "1", "Mean stress influence factor; default 0.7 where the torque reverses, otherwise 1", gt=0, le=1,
        optional=True)
    required_pitting_safety = Quantity("S_Hmin", "1", "Required safety factor against pitting", ge=1, default=1.0)
    required_root_safety = Quantity("S_Fmin", "1", "Required safety factor against tooth breakage", ge=1, default=1.4)
    sector = block(Sector, "The wheel is an oscillating sector", optional=True)
    n_points = samples(360)
