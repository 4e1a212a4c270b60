"""Do the mechanisms belong to one press? Sizes, rates, inertias and speeds of one against those of another."""

from __future__ import annotations

from diecut_report.api import (
    ROUNDING,
    Check,
    ExampleBlock,
    Level,
    Mark,
    Mechanism,
    Panel,
    Partner,
    Plot,
    Series,
    Vary,
    Wired,
    m,
)
from diecut_report.plugins.press_consistency import relations, steps
from diecut_report.plugins.press_consistency.inputs import PressConsistency

FURTHEST_RATE = 0.02  # below the productivity, as for the speed of the drive train's output
LARGEST_INERTIA_ERROR = 5.0  # percent

MOTOR = (Vary("flywheel_inertia", "up"), Vary("motor_speed", "down"), Vary("motor_rated_torque", "up"))

CHECKS = (
    Check("timing", "function", "Timing of the press", 0.0, m.timing_slack, demand_label="required", limit_label="minimum slack of the interlocks",
        source="this method",
        consequence="the mechanisms are in each other's way; the cyclogram says which, by how much, and which offset is best. Torques, motor and "
            "flywheel are then those of a press that cannot run: fix this first, then judge them."),
    Check("format_rolled", "function", "Sheet in the feed direction and cylinder", m.side_in_feed, m.working_length, presumed=True,
        demand_label="sheet in the feed direction", limit_label="length that the cylinder unrolls", source="geometry",
        consequence="the sheet is not cut over its whole {feed_side}; take a larger cylinder or a smaller sheet."),
    Check("format_generatrix", "function", "Sheet across the feed and cylinder", m.side_across, m.generatrix_length, presumed=True,
        demand_label="sheet across the feed", limit_label="generatrix of the cylinder", source="geometry",
        consequence="the sheet reaches beyond the cylinder's end; take a longer cylinder or a smaller sheet."),
    Check("cylinder_sizes", "function", "One cylinder: sizes", m.cylinder_sizes_apart, 0.0, presumed=True, demand_label="sizes given otherwise",
        source="geometry",
        consequence="the drive or the dampers are calculated for another cylinder than the one that is sized: {cylinder_sizes}; refer to the "
            "cylinder there."),
    Check("cylinder_loads", "strength", "One cylinder: masses and moments", m.cylinder_loads_short, 0.0, severity="warn", presumed=True,
        demand_label="values less than the cylinder's", source="dynamics",
        consequence="forces and energies are calculated for a lighter cylinder than the one that is sized, or without its "
            "unbalance, or for less cutting: {cylinder_loads}; refer to the cylinder there."),
    Check("step", "function", "Sheet and step", m.side_in_feed, m.sheet_step, demand_label="sheet in the feed direction",
        limit_label="step of the transport", source="geometry",
        consequence="the next sheet comes to lie on this one; the step must be longer, or the sheet shorter."),
    Check("sheet_gap", "function", "Gap between two sheets", m.sheet_gap, m.step_room, demand_label="required for grippers and carriage",
        limit_label="gap after a step",
        consequence="there is not room enough for grippers and carriage between two sheets; the step must be longer, or the sheet shorter."),
    Check("actual_rate", "function", "Productivity and gears", m.rate_asked, m.least_rate, presumed=True, severity="warn",
        fails_beyond=1 / (1 - FURTHEST_RATE), tolerance=1e-6, demand_label="productivity", limit_label="rate given by the gears", source="kinematics",
        consequence="the press makes {least_rate} and not {rate_asked}; choose pulleys and teeth nearer to the ratio, or set press.productivity to "
            "what they give."),
    Check("true_rate", "strength", "Rate used for the loads", m.true_rate, m.productivity, presumed=True, severity="warn",
        fails_beyond=1 + FURTHEST_RATE, tolerance=1e-6, demand_label="rate under the mean torque", limit_label="productivity used for the loads",
        consequence="the motor turns faster than at its rated speed: accelerations, and what follows from them, are {load_rise} greater than "
            "calculated; set press.productivity to at least {true_rate:up}, and give the rate that is asked for as required_rate."),
    Check("driven_inertia", "strength", "Inertia behind the clutch", m.equal_inertia, m.clutch_inertia, tolerance=1e-3,
        demand_label="inertia of equal heat at the clutch, of the cylinder's drive alone", limit_label="inertia used for the clutch", presumed=True,
        consequence="an engagement at {start_angle} makes {slip_heat} of heat in {slip_time}; the crank feels {crank_inertia_mean} in the mean and "
            "up to {crank_inertia_max} at {crank_inertia_max_at}: give the clutch a driven_inertia of at least {equal_inertia:up}."),
    Check("coupled_inertia", "strength", "Other lines behind the clutch", m.lines_beside, 0.0, severity="warn", needs=("drive",),
        demand_label="lines whose inertia is not compared", source="this method",
        consequence="the inertia used for the clutch is compared with the cylinder's drive alone; of all that it drives ({clutch_lines}) the "
            "driven_inertia must be worked out by hand, at the angle where it is greatest."),
    Check("clutch_position", "function", "Clutch and offsets of the lines", m.lines_out_of_step, 0.0, founded=("single_position",),
        demand_label="drives that lose synchronism",
        consequence="a friction clutch engages at any angle, and its slip turns back what it drives; out of step with the other lines: "
            "{clutch_lines}; let the clutch drive all lines, or take one that engages at one angle only.", advise=("single_position",)),
    Check("carriages", "strength", "Mass of the carriages", m.stopped_mass, m.cylinder_mass, severity="warn",
        only_with=("damper_mass", "carriage_mass"), source="dynamics", presumed=True, demand_label="cylinder and carriages at the dampers",
        limit_label="in the drive",
        consequence="the carriages move with the cylinder's axis, but the forces of drive, chain, joints and shafts are calculated without them: "
            "give the drive a cylinder_mass of at least {stopped_mass:up}."),
    Check("damper_velocity", "strength", "Speed at the dampers", m.contact_speed, m.damper_velocity, severity="warn", demand_label="speed at contact",
        limit_label="speed used for the dampers", presumed=True,
        consequence="the dampers are met faster than calculated; that speed is reached {way_inner} before the inner and {way_outer} before the "
            "outer end: give the damper a velocity of at least {contact_speed:up}, or let it be met later."),
    Check("damper_impacts", "strength", "Impacts of the dampers", m.end_impacts, m.damper_impacts, demand_label="impacts at one end",
        limit_label="impacts used for the dampers", presumed=True,
        consequence="dampers that are met before the end of the travel are met in every stroke, and their heat is calculated for fewer: give the "
            "damper an impacts_per_hour of at least {end_impacts:up}, or leave it out; or set its contact_distance to 0, to be met beyond the "
            "stroke only."),
    Check("conveyor_mass", "strength", "Mass of the conveyor", m.chain_mass, m.conveyor_mass, only_with=("chain_mass",),
        demand_label="mass accelerated by the chain", limit_label="mass used for the transport", source="dynamics", presumed=True,
        consequence="torque, contact pressure and motor of the transport are calculated with less than the chain moves: give its conveyor_mass at "
            "least {chain_mass:up}, or take lighter chains and bars."),
    Check("conveyor_inertia", "practice", "Inertia of the conveyor", m.inertia_error, LARGEST_INERTIA_ERROR, severity="warn",
        demand_label="difference", presumed=True,
        consequence="conveyor and wheel have {moved_inertia} at the wheel's shaft, which is calculated with {wheel_inertia}; one of both is not "
            "that of this press."),
    Check("wheel_side", "strength", "Inertia on the wheel's side", m.moved_inertia, m.wheel_inertia, tolerance=1e-3, needs=("wheel_side_inertia",),
        demand_label="conveyor and parts that turn with the wheel", limit_label="inertia used for the wheel", presumed=True,
        consequence="torque, roller force and contact pressure of the wheel are greater than calculated; give it a driven_inertia of at least "
            "{moved_inertia:up}."),
    Check("motor_thermal", "strength", "Heating of the motor", m.motor_torque_rms, m.motor_rated_torque, demand_label="root mean square torque",
        limit_label="rated torque", source="this method",
        consequence="the motor gets too hot; a greater slip or a greater reserve_factor of the drive train helps, too.", advise=MOTOR),
    Check("motor_peak", "strength", "Peak torque of the motor", m.motor_torque_peak, m.breakdown_torque, demand_label="maximum torque",
        limit_label="breakdown torque",
        consequence="the motor stalls; a greater slip, a larger breakdown torque or a greater reserve_factor of the drive train helps, too.",
        advise=MOTOR),
    Check("speed_swing", "function", "Speed fluctuation", m.speed_swing, m.speed_fluctuation, severity="warn", demand_label="from the motor's slip",
        limit_label="accepted", consequence="the flywheel of {flywheel_inertia} swings more than accepted.",
        advise=(Vary("flywheel_inertia", "up"),)),
    Check("cover_angle", "function", "Play of the wheel and timing", m.cover_angle, m.dwell_margin, presumed=True, tolerance=1e-6,
        demand_label="angle used for the play", limit_label="angle left by the timing", source="geometry",
        consequence="the sheet must rest where the locking disc covers less of its arc than calculated; give the wheel a cover_angle of at most "
            "{dwell_margin:down}, or a longer dwell."),
    Check("held_in_dwell", "function", "Phases within the wheel's dwell", 1.0, m.held_in_dwell, severity="warn", presumed=True,
        only_with=("cover_angle",), demand_label="required interlocks", limit_label="given", source="this method",
        consequence="nothing in the timing says what must lie within the wheel's dwell, so that its play is calculated for an angle that nothing "
            "holds; give the cyclogram an interlock within the wheel's dwell, or apart from its motion."),
    Check("register", "function", "Play and register", m.play_total, m.register_tolerance, demand_label="total play",
        consequence="sheet and cut may lie further apart than allowed; take play out of the transport."),
    Check("whole_pitches", "function", "Whole pitches per step", m.pitch_error, ROUNDING,
        consequence="a step of {pitches} pitches stops the chain at another tooth each time; change the ratio or the sprocket so that it is a whole "
            "number."),
    Check("whole_steps", "function", "Whole steps of the gripper chain", m.loop_error, ROUNDING, only_with=("chain_links",),
        consequence="gripper bars a step apart do not fit a loop of {loop_steps} steps; change the chain's links or the step."),
)  # fmt: skip


PARTNERS = (
    Partner(key="cylinder", kinds=("cylinder_sizing",), takes={"working_length": "working_length", "generatrix_length": "generatrix_length"}),
    Partner(key="drive", kinds=("cylinder_drive",), takes={
        "cylinder_mass": "cylinder_mass", "cylinder_inertia": "cylinder_inertia", "cylinder_radius": "cylinder_radius",
        "static_unbalance": "static_unbalance", "shafts_inertia": "shafts_inertia", "cylinder_rotation": "cylinder_rotation",
        "cylinder_speed": "cylinder_speed",
        "displacement": "displacement", "velocity": "velocity", "stroke": "stroke", "crank_speed": "crank_speed",
        "dead_center_outer": "dead_center_outer", "dead_center_inner": "dead_center_inner"}),
    Partner(key="transport", kinds=("cam_gear_transport", "geneva_transport"), takes={
        "sheet_step": "sheet_step", "chain_pitch": "chain_pitch", "sprocket_teeth": "sprocket_teeth", "sheet_play": "sheet_play"}),
    Partner(key="conveyor", kinds=("cam_gear_transport",), takes={"conveyor_mass": "conveyor_mass"}),
    Partner(key="chain", kinds=("roller_chain",), takes={"chain_mass": "moving_mass_total", "chain_links": "links"},
        unless={"acceleration": "cylinder_drive"}),
    Partner(key="wheel", kinds=("geneva_transport",), takes={
        "wheel_inertia": "driven_inertia", "travel_radius": "travel_radius", "cover_angle": "cover_angle"}),
    Partner(key="train", kinds=("drive_train",), takes={
        "output_speed": "output_speed", "loaded_output_speed": "loaded_output_speed",
        "flywheel_torque": "flywheel_torque", "load_turns": "torque_curve_turns",
        "flywheel_inertia": "wheel_inertia", "shafts_energy": "shafts_energy", "flywheel_speed": "shaft_2_speed", "belt_ratio": "vbelt_ratio_actual",
        "belt_efficiency": "vbelt.efficiency", "motor_rated_torque": "motor_rated_torque", "motor_speed": "motor_speed",
        "synchronous_speed": "synchronous_speed", "breakdown_ratio": "breakdown_ratio", "speed_fluctuation": "speed_fluctuation"}),
    Partner(key="clutch", kinds=("clutch",), takes={
        "clutch_torque": "design_torque", "clutch_load": "load_torque_at_engagement", "clutch_speed": "speed",
        "clutch_inertia": "driven_inertia"}),
    Partner(key="timing", kinds=("cyclogram",), always=True, takes={
        "timing_slack": "best_margin", "shaft_torque_mean": "torque_mean", "lines_energy": "kinetic_energy_mean"}),
    Partner(key="drive_line", kinds=("drive_line",), takes={"brake_torque": "brake_torque"}),
    Partner(key="damper", kinds=("damper",), takes={
        "damper_velocity": "velocity", "contact_distance": "contact_distance", "damper_impacts": "impacts_per_hour",
        "damper_mass": "mass", "carriage_mass": "carriage_mass"}),
)  # fmt: skip


FIGURES = (
    Plot(
        "crank_inertia",
        "Equivalent inertia at the crank",
        "The inertia of equal kinetic energy over a revolution of the crank: zero where the cylinder stands, and different in the two "
        "strokes because the unbalance swings. Its mean is used for the run-up.",
        abscissa="crank_angle",
        needs=steps.CYLINDER,
        panels=(
            Panel(
                "Equivalent inertia",
                "kg*m**2",
                series=(Series("crank_inertia", "at the crank"),),
                levels=(Level("crank_inertia_mean", "mean"),),
                marks=(Mark("crank_inertia_max_at", "crank_inertia_max", "maximum"),),
            ),
        ),
    ),
)


EXAMPLE = ExampleBlock(
    "consistency",
    {
        "cylinder": "<cylinder_sizing>",
        "drive": "<cylinder_drive>",
        "transport": Wired("<geneva_transport>", otherwise="<cam_gear_transport>"),
        "conveyor": "<cam_gear_transport>",
        "chain": "<roller_chain>",
        "wheel": "<geneva_transport>",
        "train": "<drive_train>",
        "clutch": "<clutch>",
        "timing": "<cyclogram>",
        "damper": "<damper>",
        "sheet_gap": "90 mm",
        "register_tolerance": "0.3 mm",
        "clutch_drives": Wired(["<cylinder_drive>"], needs=("cyclogram", "clutch")),
        "single_position": Wired(True, needs=("clutch",)),
    },
)


MECHANISM = Mechanism(
    kind="press_consistency",
    version="1.0",
    title="Consistency of the press",
    summary="Compares the mechanisms of a press with one another: the sheet with cylinder and step, the rate given by the gears with the "
            "productivity, the equivalent inertia at the crank with that of the clutch, the speed before the ends of the travel with that of the "
            "dampers, the conveyor's mass with the wheel's inertia, the motor with a load that its flywheel smooths in part, the plays with the "
            "register.",
    inputs=PressConsistency,
    example=EXAMPLE,
    chapters=(steps.sides, relations.sizes, steps.rate, steps.inertia, steps.engagement, steps.coupling,
              steps.ends_chapter, steps.conveyor, steps.motor_chapter, steps.stopping, steps.dwell, steps.register),
    key_results=("step_room", "actual_rate", "crank_inertia_mean", "crank_inertia_max", "slip_heat", "equal_inertia", "way_inner", "way_outer",
                 "motor_torque_rms", "motor_torque_peak", "speed_swing", "play_total"),
    checks=CHECKS,
    figures=FIGURES,
    partners=PARTNERS,
    assumptions=(
        "Not checked: when grippers open and close; feeder, delivery and stripping; elasticity and backlash between the lines; whether the flat "
        "sweeps over parts other than the carriages; the speed fluctuation of the main shaft, with which times vary while angles hold.",
        "Values that two mechanisms share are compared if both give them; a value given by only one is not checked.",
        "The clutch slips at constant torque, and its driving side keeps its speed. Not checked: whether shafts, keys and teeth withstand the "
        "slip torque, which exceeds that of the cycle by the service factor.",
        "The motor's torque is linear in its speed between the synchronous and the rated one, and extrapolated beyond; near its breakdown "
        "torque, and below the rated voltage, a real motor falls short of this line.",
    ),
)  # fmt: skip
