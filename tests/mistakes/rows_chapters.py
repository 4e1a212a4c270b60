"""The author's form: chapters, their calls, and formulas written as lambdas."""

from __future__ import annotations

from tests.mistakes.rows import load, tested

# fmt: off

WASTE = "lambda mass_rate, belt_speed: mass_rate / belt_speed)"
RATIO = 'drive.value("ratio_of_speeds", "i", "1", "Ratio of the belt drive", lambda small_pulley, large_pulley: large_pulley / small_pulley)'
EULER = "lambda head_friction, head_wrap: np.exp(head_friction * as_number(head_wrap))"
SPEED = '"belt_speed", "v", "m/s", "Speed of the belt", lambda head_speed, head_diameter: head_speed * head_diameter / 2,'
HOLDING = 'holding = Chapter("Backstop", needs=("backstop",), absent="no backstop is given")\n'
LISTED = "chapters=(conveying, discharge, pull, shaft, drive, holding)"
GRAVITY = 'case("by gravity", "the pole is above the buckets", lambda head_diameter, pole_distance: head_diameter < pole_distance)'

LAMBDAS = (
    load("a lambda's parameter is misspelt", WASTE, WASTE.replace("belt_speed", "belt_sped"), "waste_line_mass", "belt_sped", "belt_speed"),
    load("a lambda takes more than its parameters", WASTE, "lambda mass_rate: mass_rate / belt_speed)", "waste_line_mass", "'belt_speed'"),
    load("a default in a lambda", RATIO, RATIO.replace("large_pulley:", "large_pulley=280:"), "ratio_of_speeds", "large_pulley", "default"),
    load("a lambda over a number of a loop", RATIO,
         f'for factor in (1, 2):\n    {RATIO}'.replace('"ratio_of_speeds", "i"', 'f"ratio_{factor}", f"i_{factor}"')
         .replace(": large_pulley", ": factor * large_pulley"), "ratio_1", "'factor'", "constants"),
    load("a lambda over a local number", RATIO,
         f"def declare(factor):\n    {RATIO}\n\n\ndeclare(2)".replace(": large_pulley", ": factor * large_pulley"),
         "ratio_of_speeds", "'factor'", "constants"),
    load("a product in place of a lambda", SPEED, SPEED.replace("lambda head_speed, head_diameter: ", ""), "NameError", "head_speed"),
    load("a number in place of a lambda", RATIO, RATIO.replace("lambda small_pulley, large_pulley: large_pulley / small_pulley", "2"),
         "ratio_of_speeds", "lambda|formula"),
    load("a function of NumPy in place of a lambda", RATIO,
         RATIO.replace("lambda small_pulley, large_pulley: large_pulley / small_pulley", "np.sqrt"), "ratio_of_speeds", "sqrt", "lambda"),
    load("a helper without @formula", EULER, "lambda head_friction, head_wrap: euler(head_friction, head_wrap)",
         "euler_ratio", r"euler\(", "other formulas",
         also=(('pull = Chapter("Pull")', 'def euler(friction: Any, wrap: Any) -> Any:\n    return np.exp(friction * as_number(wrap))\n\n\n'
                'pull = Chapter("Pull")'),)),
    load("plain code as a formula", '"How far the waste flies meanwhile", lambda belt_speed, fall_time: belt_speed * fall_time',
         '"How far the waste flies meanwhile", falling_time', "throw", "drop", "bind|which nothing gives"),
    load("a field of a block in a lambda",
         'bind(lambda lift_force, head_diameter, arm: lift_force * head_diameter / (2 * arm), arm="backstop.radius")',
         "lambda lift_force, head_diameter, backstop: lift_force * head_diameter / (2 * backstop.radius)",
         "pawl_force", r"backstop\.radius", "a block"),
    load("a whole list in a lambda", 'bind(lambda strand_weight, wrap: 2 * strand_weight * np.sin(wrap / 2), wrap="pulleys.wrap")',
         "lambda strand_weight, pulleys: 2 * strand_weight * pulleys", "pulley_load", r"pulleys\.(wrap|diameter)|a block|a field"),
    load("what a call gives back as a quantity", 'pull.running("losses_so_far"',
         'total = pull.total("all", "U_a", "N", "All", "sum", of="journal_loss")\n'
         'pull.value("twice", "U_2", "N", "Twice", bind(lambda loss: 2 * loss, loss=total))\npull.running("losses_so_far"', "loss", "None"),
    tested("as_number forgotten in an exponential", EULER, "lambda head_friction, head_wrap: np.exp(head_friction * head_wrap)",
           "euler_ratio", "rad"),
    tested("as_number forgotten of an angular speed", "as_number(head_speed) ** 2 * head_diameter / (2 * GRAVITY)",
           "head_speed**2 * head_diameter / (2 * GRAVITY)", "froude_number", r"rad\*\*2"),
    tested("as_angle forgotten", "as_angle(np.sqrt(2 * GRAVITY / head_diameter))", "np.sqrt(2 * GRAVITY / head_diameter)", "speed_limit", "rad/s"),
    tested("as_number of what a sine takes", "np.sin(wrap / 2)", "np.sin(as_number(wrap) / 2)", "pulley_load", "angle|rad"),
    tested("as_number of what is no angle", "np.exp(head_friction * as_number(head_wrap))", "np.exp(as_number(head_friction) * as_number(head_wrap))",
           "euler_ratio", "as_number"),
    tested("as_number of a length", "lambda lift_force, scoop_pull, head_diameter: (lift_force + scoop_pull) * head_diameter / 2",
           "lambda lift_force, scoop_pull, head_diameter: (lift_force + scoop_pull) * as_number(head_diameter) / 2", "shaft_torque", "as_number"),
    tested("as_angle of an angle", "lambda head_diameter, angle: head_diameter / 2 * np.sin(angle)",
           "lambda head_diameter, angle: head_diameter / 2 * np.sin(as_angle(angle))", "rim_x", "as_angle"),
    tested("as_angle of a number", "lambda small_pulley, large_pulley: large_pulley / small_pulley",
           "lambda small_pulley, large_pulley: as_angle(large_pulley / small_pulley)", "ratio_of_speeds", "rad"),
)

CALLS = (
    load("id and symbol exchanged", '"belt_speed", "v", ', '"v", "belt_speed", ', "belt_speed, which nothing gives|v", placed=False),
    load("symbol and unit of a step exchanged", '"v", "m/s"', '"m/s", "v"', "belt_speed", "unit", "'v'"),
    load("unit and description exchanged", '"m/s", "Speed of the belt"', '"Speed of the belt", "m/s"', "belt_speed", "unit", "Speed of the belt"),
    load("the description is forgotten", '"Speed of the belt", lambda', "lambda", "value", "formula"),
    load("the unit is forgotten", '"belt_speed", "v", "m/s", ', '"belt_speed", "v", ', "value", "formula"),
    load("formula and description exchanged", SPEED,
         '"belt_speed", "v", "m/s", lambda head_speed, head_diameter: head_speed * head_diameter / 2, "Speed of the belt",', "belt_speed",
         "formula"),
    load("operation and curve exchanged", '"Maximum torque", "max", of="shaft_torque"', '"Maximum torque", "shaft_torque", of="max"',
         "torque_max", "max, which nothing gives"),
    load("table and text of a lookup exchanged", '{"bare": 0.2, "rubber": 0.3}, by="lagging"', '"lagging", by={"bare": 0.2, "rubber": 0.3}',
         "head_friction", "table|by"),
    load("a requirement without its condition", '"not_thrown", lambda froude_number: froude_number < 1, key', '"not_thrown", key', "condition"),
    load("an unknown call of a chapter", 'discharge.reduction("press_max", "N_max", "N", "Greatest force on the waste", "max", ',
         'discharge.maximum("press_max", "N_max", "N", "Greatest force on the waste", ', "maximum"),
    load("a misspelt call of a chapter", 'conveying.value("belt_speed"', 'conveying.vaule("belt_speed"', "Chapter", "vaule"),
    load("a text for a tuple in needs of a chapter", 'needs=("backstop",), absent', 'needs="backstop", absent', "Backstop", r"tuple|comma|,\)"),
    load("a text for a tuple in takes", 'takes=("filling", "filling_needed")', 'takes="filling"', "filling_advice", "takes", r"tuple|comma|,\)"),
    load("a tuple of places", '"angle", "scoop_start", "scoop_end")', '"angle", ("scoop_start", "scoop_end"))', "scooping", "places|tuple"),
    load("a list of cases", f"{GRAVITY},\n                 case(\"mixed\", \"the pole is among the buckets\")",
         f'[{GRAVITY}, case("mixed", "the pole is among the buckets")]', "discharge", "case"),
    load("a case without words", 'case("mixed", "the pole is among the buckets")', 'case("mixed")', "words"),
    load("a case in the middle without a condition", GRAVITY, f'{GRAVITY}, case("between", "the pole is near")', "discharge", "condition"),
    load("a case whose words are forgotten", GRAVITY, GRAVITY.replace('"the pole is above the buckets", ', ""), "discharge", "words|text"),
)

CHAPTERS = (
    load("a quantity in another chapter", 'pull.value("tight_pull"', 'holding.value("tight_pull"', "holding", placed=False),
    load("a quantity in a later chapter", 'pull.value("tight_pull", "T_1", "N", "Pull of the tight strand",',
         'shaft.value("tight_pull", "T_1", "N", "Pull of the tight strand",', "lagging_pressure", "tight_pull",
         "before|later", also=(('pull = Chapter("Pull")', 'pull = Chapter("Pull")\nshaft = Chapter("Head shaft")'),
                               ('\nshaft = Chapter("Head shaft")\nshaft.breakpoints', "\nshaft.breakpoints"))),
    load("a chapter that is not listed", LISTED, LISTED.replace("drive, ", ""), "power", "which nothing gives", placed=False),
    load("a chapter that is not listed and that nothing asks", HOLDING,
         'spare = Chapter("Spare")\nspare.value("spare", "m_s", "kg", "Spare", lambda belt_mass, height: belt_mass * height)\n' + HOLDING,
         "Spare", "chapters"),
    load("one name for two chapters of which the first is lost", HOLDING,
         'spare = Chapter("Spare")\nspare.value("spare", "m_s", "kg", "Spare", lambda belt_mass, height: belt_mass * height)\n'
         'spare = Chapter("Again")\nspare.value("again", "m_a", "kg", "Again", lambda belt_mass, height: belt_mass * height)\n' + HOLDING,
         "'Spare'", "another one spare", "chapters", also=((LISTED, LISTED.replace("holding", "holding, spare")),)),
    load("a chapter named as a quantity that nothing lists", HOLDING,
         'spare = Chapter("Spare")\nspare.value("spare", "m_s", "kg", "Spare", lambda belt_mass, height: belt_mass * height)\n'
         'spare.value("again", "m_a", "kg", "Again", lambda spare: 2 * spare)\n' + HOLDING, "'Spare'", "chapters"),
    load("a family of steps that is added to no chapter", HOLDING,
         'spare = Steps()\nspare.value("spare", "m_s", "kg", "Spare", lambda belt_mass, height: belt_mass * height)\n' + HOLDING,
         "spare", "add", also=(("    Source,\n", "    Source,\n    Steps,\n"),)),
    load("a family of steps in place of a chapter", 'holding = Chapter("Backstop", needs=("backstop",), absent="no backstop is given")',
         "holding = Steps()", "holding|chapters|Steps", "Chapter", also=(("    Source,\n", "    Source,\n    Steps,\n"),), placed=False),
    load("a chapter listed twice", LISTED, LISTED.replace("shaft, ", "shaft, shaft, "), "Head shaft|scooping", "twice|two|both|once|another",
         placed=False),
    load("a family of steps added twice", 'holding = Chapter("Backstop"', "pull.add(shaft)\nholding = Chapter(\"Backstop\"",
         "scooping|torque_max", "another|twice", placed=False),
    load("one name for two chapters", 'drive = Chapter("Drive")', 'shaft = Chapter("Drive")', "drive", placed=False),
    load("a chapter's text by position", 'Chapter("Drive")', 'Chapter("Drive", "Gear and belt.")', "Chapter", "positional"),
    load("a chapter without a title", 'Chapter("Drive")', "Chapter()", "Chapter", "title"),
    load("a misspelt field of a chapter", 'Chapter("Backstop", needs=', 'Chapter("Backstop", need=', "Chapter", "'need'"),
)
