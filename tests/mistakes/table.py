"""Mistakes of authors: what each is, the text that it puts in place of another, where it is told, and in which words."""

from __future__ import annotations

from typing import Any

from tests.mistakes.runner import Mistake, Stage


def row(
    told: Stage, what: str, old: str, new: str, *words: str, also: tuple[tuple[str, str], ...] = (), **rest: Any
) -> Mistake:
    """A mistake of one text, ``also`` of others, told by ``told``."""
    return Mistake(what, ((old, new), *also), told, words, **rest)


def load(what: str, old: str, new: str, *words: str, **rest: Any) -> Mistake:
    """A mistake that is told when the plugin is loaded: by each command, with exit code 3, with file and line."""
    return row("load", what, old, new, *words, **rest)


def tested(what: str, old: str, new: str, *words: str, **rest: Any) -> Mistake:
    """A mistake that ``check_mechanism`` tells of a step, with numbers: dimensions, and what is printed."""
    return row("check_mechanism", what, old, new, *words, **({"placed": False} | rest))


def calc(what: str, old: str, new: str, *words: str, **rest: Any) -> Mistake:
    """A mistake that only the numbers of a machine show."""
    return row("calc", what, old, new, *words, **({"placed": False} | rest))


# Names that nothing has: misspelt ids, inputs, texts, keys. What is there twice, or in another order.

# fmt: off

NAMES = (
    load("misspelt input in needs of a profile", 'columns=("rim_x", "rim_y"))', 'columns=("rim_x", "rim_y"), needs=("backstops",))', "rim",
         "backstops", "backstop"),
    load("bind names an unknown parameter", 'height="scoop_height"', 'hight="scoop_height"', "hanging_weight", "hight", "height"),
    load("a formula's parameter is misspelt",
         "def hanging_weight(line_mass: Any, height: Any) -> Any:\n    return line_mass * GRAVITY * height",
         "def hanging_weight(line_mass: Any, hight: Any) -> Any:\n    return line_mass * GRAVITY * hight", "lift_force", "hight", "height",
         also=(('line_mass="waste_line_mass", height="scoop_height"', 'line_mass="waste_line_mass", hight="scoop_height"'),), placed=False),
    load("a field of like parts is misspelt", 'wrap="pulleys.wrap"', 'wrap="pulleys.warp"', "pulley_load", r"pulleys\.warp",
         r"pulleys\.wrap"),
    load("a field of like parts without its list", 'wrap="pulleys.wrap"', 'wrap="wrap"', "pulley_load", "wrap, which nothing gives"),
    load("reduction of an unknown curve", '"mean", of="shaft_torque"', '"mean", of="shaft_torqe"', "torque_mean", "shaft_torqe",
         "shaft_torque"),
    load("derivative of an unknown curve", '"Change of that force", of="normal_force"', '"Change of that force", of="force"', "force_slope",
         "'?force'?"),
    load("integral of an unknown curve", '"Work since the top", of="shaft_torque"', '"Work since the top", of="torque"', "work", "torque"),
    load("crossings of an unknown curve", 'leaves the bucket", of="normal_force"', 'leaves the bucket", of="normal_forces"', "release",
         "normal_forces", "normal_force"),
    load("total of an unknown row", 'all journals take", "sum", of="journal_loss"', 'all journals take", "sum", of="journal_los"',
         "journal_losses", "journal_los"),
    load("part of an unknown row", 'of="pulley_load", index=0', 'of="pulley_loads", index=0', "foot_load", "pulley_loads", "pulley_load"),
    load("breakpoints on an unknown abscissa", '"angle", "scoop_start", "scoop_end")', '"angel", "scoop_start", "scoop_end")', "scooping",
         "angel", "angle"),
    load("breakpoints on what is no abscissa", '"angle", "scoop_start", "scoop_end")', '"normal_force", "scoop_start", "scoop_end")',
         "scooping", "normal_force", "abscissa"),
    load("breakpoints at an unknown place", '"angle", "scoop_start", "scoop_end")', '"angle", "scoop_begin", "scoop_end")', "scooping",
         "scoop_begin"),
    load("lookup by an unknown input", 'by="lagging"', 'by="laging"', "head_friction", "laging", "lagging"),
    load("pick by an unknown quantity", 'of="length_wanted"', 'of="lenght_wanted"', "belt_length", "lenght_wanted", "length_wanted"),
    load("words take an unknown quantity", 'takes=("filling", "filling_needed")', 'takes=("filling", "filling_neded")', "filling_advice",
         "filling_neded", "filling_needed"),
    load("plain code takes an unknown quantity", 'takes=("belt_speed", "chute_drop")', 'takes=("belt_sped", "chute_drop")', "fall_time",
         "belt_sped", "belt_speed"),
    load("a check's limit in a block is misspelt", 'limit="backstop.allowable_force"', 'limit="backstop.allowed_force"', "check.*pawl",
         r"backstop\.allowed_force", r"backstop\.allowable_force"),
    load("a profile of an unknown curve", 'columns=("rim_x", "rim_y")', 'columns=("rim_x", "rim_z")', "rim", "rim_z"),
    load("a level of an unknown quantity", 'value="torque_mean"', 'value="torque_average"', "turn", "torque_average"),
    load("a mark at an unknown place", 'x="press_max_at"', 'x="press_max_place"', "turn", "press_max_place", "press_max_at"),
    load("a plot over an unknown abscissa", 'over a turn.", abscissa="angle"', 'over a turn.", abscissa="angles"', "turn", "angles",
         "angle"),
    load("a bar of an unknown quantity", '("waste", "lift_force")', '("waste", "lifting_force")', "pulls", "lifting_force", "lift_force"),
    load("a key of an optional block without needs", 'needs=("backstop",), absent', "absent", "pawl_force", "backstop", "needs"),
    load("an unknown field of the press", 'Quantity("ω", "rpm", "Speed of the head drum", gt=0)',
         'Quantity("ω", "rpm", "Speed of the head drum", gt=0, press=FromPress("press.speed"))', "head_speed", r"press\.speed",
         also=(("    Erratum,\n", "    Erratum,\n    FromPress,\n"),)),
    load("points of an abscissa are not declared", "    n_points: Annotated[int, POINTS] = 360",
         "    samples: Annotated[int, POINTS] = 360", "angle", "n_points", placed=False),
)

TWICE = (
    load("two profiles with one id", 'exports=(Profile(id="rim"',
         'exports=(Profile(id="rim", title="Rim", columns=("rim_y", "rim_x")), Profile(id="rim"', "rim", "twice|two|both|once"),
    load("an input declared twice", "    height: Annotated[",
         '    bulk_density: Annotated[float, Quantity("γ", "kg/m**3", "Density", gt=0)] = 200\n    height: Annotated[', "bulk_density",
         "twice|two|both|once"),
    load("a formula defined twice", "@formula\ndef length_by_wraps(centre: Any, small_pulley: Any, large_pulley: Any)",
         "@formula\ndef hanging_weight(centre: Any, small_pulley: Any, large_pulley: Any)", "hanging_weight", "twice|two|both|once",
         also=(("right=length_by_wraps", "right=hanging_weight"),)),
    load("an id with a space", 'value("throw"', 'value("throw of waste"', "throw of waste"),
    load("a step that takes itself", "lambda lift_force, scoop_force, journal_losses: lift_force + scoop_force + journal_losses",
         "lambda lift_force, scoop_force, circumferential_pull: lift_force + scoop_force + circumferential_pull", "circumferential_pull",
         "itself|before|later|order"),
)


# The author's form: chapters, their calls, and formulas written as lambdas.

WASTE = "lambda mass_rate, belt_speed: mass_rate / belt_speed)"
RATIO = 'drive.ratio_of_speeds = m.large_pulley / m.small_pulley, "i", "1", "Ratio of the belt drive"'
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
         'm.lift_force * m.head_diameter / (2 * m.backstop.radius)',
         "lambda lift_force, head_diameter, backstop: lift_force * head_diameter / (2 * backstop.radius)",
         "pawl_force", r"backstop\.radius", "a block"),
    load("a whole list in a lambda", '2 * m.strand_weight * np.sin(m.pulleys.wrap / 2)',
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
    load("a case whose words are forgotten", GRAVITY, GRAVITY.replace('"the pole is above the buckets", ', ""), "discharge", "words|text"),
)

CHAPTERS = (
    load("a quantity in another chapter", 'pull.value("tight_pull"', 'holding.value("tight_pull"', "holding", placed=False),
    load("a chapter that is not listed", LISTED, LISTED.replace("drive, ", ""), "power", "which nothing gives", placed=False),
    load("a chapter that is not listed and that nothing asks", HOLDING,
         'spare = Chapter("Spare")\nspare.spare = m.belt_mass * m.height, "m_s", "kg", "Spare"\n' + HOLDING,
         "Spare", "chapters"),
    load("one name for two chapters of which the first is lost", HOLDING,
         'spare = Chapter("Spare")\nspare.spare = m.belt_mass * m.height, "m_s", "kg", "Spare"\n'
         'spare = Chapter("Again")\nspare.again = m.belt_mass * m.height, "m_a", "kg", "Again"\n' + HOLDING,
         "'Spare'", "another one spare", "chapters", also=((LISTED, LISTED.replace("holding", "holding, spare")),)),
    load("a chapter named as a quantity that nothing lists", HOLDING,
         'spare = Chapter("Spare")\nspare.spare = m.belt_mass * m.height, "m_s", "kg", "Spare"\n'
         'spare.again = 2 * m.spare, "m_a", "kg", "Again"\n' + HOLDING, "'Spare'", "chapters"),
    load("a family of steps that is added to no chapter", HOLDING,
         'spare = Steps()\nspare.spare = m.belt_mass * m.height, "m_s", "kg", "Spare"\n' + HOLDING,
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


# Declarations: fields, units, kinds of quantities, figures.

DECLARED = (
    load("a misspelt field of a step", 'lacks=("pretension",)', 'lack=("pretension",)', "lack", "lacks"),
    load("a misspelt field of a check", 'severity="warn"', 'severty="warn"', "Check", "severty"),
    load("a misspelt field of the mechanism", "    assumptions=(", "    asumptions=(", "Mechanism", "asumptions"),
    load("a step without a formula",
         '"Wrap of the smaller pulley",\n            '
         'lambda centre, small_pulley, large_pulley: 2 * np.arccos((large_pulley - small_pulley) / (2 * centre)))',
         '"Wrap of the smaller pulley")', "value", "formula"),
    load("a step without a symbol", '"throw", "s_f", ', '"throw", "", ', "throw", "symbol"),
    load("a check without a consequence", ', consequence="the belt slips: raise pretension."', "", "consequence"),
    load("a text for a tuple in needs of a step", 'needs=("lagging=rubber",)', 'needs=("lagging=rubber")', "lagging_pressure",
         "lagging=rubber", r"tuple|comma|,\)"),
    load("a text for a tuple in needs of a check", 'needs=("allowable_torque",)', 'needs="allowable_torque"', "torque", "allowable_torque",
         r"tuple|comma|,\)"),
    load("a list for a tuple in needs", 'needs=("lagging=rubber",)', 'needs=["lagging=rubber"]', "lagging_pressure", "tuple"),
    load("one chapter in place of a tuple", "chapters=(conveying, discharge, pull, shaft, drive, holding)", "chapters=(conveying)",
         "chapters", r"tuple|comma|,\)"),
    load("one erratum's id in place of a tuple", 'touches=("discharge", "pole_distance")', 'touches="discharge"', "errat|touches",
         r"tuple|comma|,\)"),
    load("one profile in place of a tuple", 'exports=(Profile(id="rim", title="Rim of the head drum", columns=("rim_x", "rim_y")),)',
         'exports=Profile(id="rim", title="Rim of the head drum", columns=("rim_x", "rim_y"))', "exports", r"tuple|comma|,\)"),
    load("a check without a class", 'check_class="strength", title="Slip of the belt"', 'title="Slip of the belt"', "slip", "check_class",
         "function.*strength.*practice.*numerical"),
    load("no digits", "/ efficiency, source", "/ efficiency, digits=0, source", "power", "digits"),
    load("an unknown unit of a check", 'limit="small_wrap", unit="deg"', 'limit="small_wrap", unit="degr"', "wrap", "degr"),
    load("an unknown unit of a panel", 'title="Torque", unit="N*m"', 'title="Torque", unit="Newton"', "turn", "Newton"),
    load("series by a text without the text", "series=(1400, 1600, 1800, 2000)", 'series=standard_series_by("iso_4184_lengths")',
         "belt_length", "by", also=(("    standard_series,\n", "    standard_series,\n    standard_series_by,\n"),)),
    load("a check of a whole list", 'demand="tight_pull"', 'demand="pulleys"', "pull", "pulleys"),
    load("a level in another unit than its panel", 'value="torque_mean"', 'value="lift_force"', "turn", "lift_force"),
    load("a mark that is not over the abscissa", 'x="press_max_at"', 'x="throw"', "turn", "throw"),
    load("a bar of a curve", '("waste", "lift_force")', '("waste", "normal_force")', "pulls", "normal_force", "curve"),
    load("a profile of one column", 'columns=("rim_x", "rim_y")', 'columns=("rim_x",)', "rim", "column"),
    load("derivative of a number", '"Change of that force", of="normal_force"', '"Change of that force", of="bucket_load"', "force_slope",
         "bucket_load", "curve"),
    load("crossings of a row", 'leaves the bucket", of="normal_force"', 'leaves the bucket", of="pulleys.wrap"', "release",
         r"pulleys\.wrap", "curve"),
    load("per_piece on a number", "lambda small_pulley, large_pulley: large_pulley / small_pulley",
         "lambda small_pulley, large_pulley: large_pulley / small_pulley, per_piece=True", "ratio_of_speeds", "per_piece"),
    calc("an abscissa of no length", "period=2 * np.pi", "period=0", "angle", "no length"),
    load("an abscissa over an unknown period", "period=2 * np.pi", 'period="turn_time"', "angle", "turn_time"),
    load("an abscissa without intervals", "period=2 * np.pi", "period=2 * np.pi, intervals=0", "angle", "intervals"),
    load("a lookup with a text that is never given", '"foil": 6}', '"foil": 6, "film": 7}', "scoop_height", "film"),
    load("a text in a lookup's table", '"foil": 6}', '"foil": "6 m"}', "scoop_height", "6 m", "number"),
    load("a pick from nothing", "series=(1400, 1600, 1800, 2000)", "series=()", "belt_length", "series|value"),
    load("an unknown standard series", 'standard_series("iec_60072_ratings")', 'standard_series("iec_ratings")', "iec_ratings",
         "iec_60072_ratings", placed=False),
)


# Inputs. The file of a plugin.

INPUTS = (
    load("a yes or no without a Text", "    height: Annotated[", "    closed: bool = True\n    height: Annotated[", "closed", "Text"),
    load("plausible sizes of another kind of quantity", '"Mass of the belt", gt=0', '"Mass of the belt", gt=0, plausible=("1 mm", "1 m")',
         "belt_mass", "1 mm", "kg/m"),
    load("plausible sizes without a unit", '"Mass of the belt", gt=0', '"Mass of the belt", gt=0, plausible=(0, 9)', "belt_mass",
         "plausible"),
    load("a default that is not a number", "gt=0, le=100)] = 75", 'gt=0, le=100)] = "most"', "filling", "most"),
    load("bounds that nothing keeps", '"Share of a bucket that may be filled", gt=0, le=100',
         '"Share of a bucket that may be filled", gt=100, le=0', "filling", "100", "0"),
    load("bounds that nothing keeps of what has no default", '"Height of lift", gt=0, le=60', '"Height of lift", gt=60, le=0', "height",
         "60", "exchange"),
    load("a free text in a lookup", 'lagging: Annotated[Literal["bare", "rubber"]', "lagging: Annotated[str", "head_friction", "lagging",
         placed=False),
    load("an optional input without its default", 'Quantity("T_0", "N", "Pull of the take-up on each strand", ge=0)] = None',
         'Quantity("T_0", "N", "Pull of the take-up on each strand", ge=0)]', "pretension", "None"),
    load("a quantity without a description", 'Quantity("q_b", "kg/m", "Mass of the belt", gt=0)', 'Quantity("q_b", "kg/m", gt=0)',
         "Quantity", "description", placed=False),
    load("a misspelt bound", 'Quantity("q_b", "kg/m", "Mass of the belt", gt=0)', 'Quantity("q_b", "kg/m", "Mass of the belt", min=0)',
         "Quantity", "min", placed=False),
    load("a text as a bound", '"Mass of the belt", gt=0', '"Mass of the belt", gt="0 kg/m"', "belt_mass", "0 kg/m"),
    load("inputs that are not Inputs", "class Elevator(Inputs):", "class Elevator(Block):", "Elevator", "Inputs"),
    load("inputs of no class at all", "class Elevator(Inputs):", "class Elevator:", "Elevator", "Inputs"),
    load("like parts that are not a Block", "class Pulley(Block):", "class Pulley:", "Pulley|pulleys", "Block"),
    load("like parts that are a model of pydantic", "class Pulley(Block):", "class Pulley(BaseModel):", "pulleys", "Block",
         also=(("import numpy as np\n", "import numpy as np\nfrom pydantic import BaseModel\n"),)),
    load("inputs as an object", "inputs=Elevator,", "inputs=Elevator(),", "Elevator|inputs"),
    load("a whole number that is not declared whole", "height: Annotated[float", "height: Annotated[int", "height", "integer"),
    load("an input that is named as a key of the program", "    height: Annotated[",
         '    kind: Annotated[float, Quantity("k", "1", "Kind")] = 1\n    height: Annotated[', "kind"),
    load("a temperature in degrees Celsius", "    height: Annotated[",
         '    warmth: Annotated[float, Quantity("t", "degC", "Warmth")] = 20\n    height: Annotated[', "warmth", "degC"),
    tested("symbol and unit exchanged", 'Quantity("H", "m", "Height of lift"', 'Quantity("m", "H", "Height of lift"',
         "height|hanging_weight"),
    tested("an input that nothing takes", "    height: Annotated[",
         '    slope: Annotated[float, Quantity("β", "deg", "Slope", ge=0)] = 0\n    height: Annotated[', "slope"),
)

MODULE = (
    load("no MECHANISM", "MECHANISM = Mechanism(", "ELEVATOR = Mechanism(", "MECHANISM", placed=False),
    load("another thing as MECHANISM", "MECHANISM = Mechanism(", "MECHANISM = dict(", "dict", "Mechanism", placed=False),
    load("a kind that is not the file's name", 'kind="bucket_elevator"', 'kind="elevator"', "'elevator'", "bucket_elevator", placed=False),
    load("no version", '    version="1.0",\n', "", "version"),
    load("a number as version", 'version="1.0"', "version=1.0", "version", "text"),
    load("a colon is missing", "class Pulley(Block):", "class Pulley(Block)", "SyntaxError", "expected ':'"),
    load("a bracket is not closed", 'CHECKS = (\n    Check(id="filling"', 'CHECKS = (\n    Check((id="filling"', "SyntaxError"),
    load("a tab among spaces", "    slope = np.arcsin", "\tslope = np.arcsin", "IndentationError|TabError"),
    load("a wrong indent", "    slope = np.arcsin", "  slope = np.arcsin", "IndentationError"),
    load("an unknown name of the api", "    Chapter,\n", "    Chaptre,\n", "Chaptre", r"diecut_report\.api"),
    load("a name that is not imported", "    Profile,\n", "", "NameError", "Profile", placed=False),
    load("an import of the engine", "import numpy as np\n", "import numpy as np\nfrom diecut_report.machine.steps.run import calculate\n",
         r"diecut_report\.machine\.steps\.run", r"diecut_report\.api"),
    load("an import of what the api has from elsewhere", "import numpy as np\n",
         "import numpy as np\nfrom diecut_report.mechanism.steps import Value\n", r"diecut_report\.mechanism\.steps",
         r"import Value from diecut_report\.api"),
    load("an import of a library that is not there", "import numpy as np\n", "import numpy as np\nimport sympie\n", "sympie"),
)


# Bodies of formulas.

FORMULAS = (
    load("no return", "    return line_mass * GRAVITY * height", "    weight = line_mass * GRAVITY * height", "hanging_weight", "return"),
    load("a return of nothing", "    return line_mass * GRAVITY * height", "    return", "hanging_weight", "return"),
    load("a condition as a statement", "    return line_mass * GRAVITY * height",
         "    if height > 1:\n        return line_mass * GRAVITY\n    return line_mass * GRAVITY * height", "hanging_weight",
         "if height > 1"),
    load("a loop", "    return line_mass * GRAVITY * height",
         "    for _ in range(2):\n        height = height / 1.4\n    return line_mass * GRAVITY * height", "hanging_weight", "for _ in"),
    load("a conditional expression", "high=lambda belt_length: belt_length / 2",
         "high=lambda belt_length: belt_length / 2 if belt_length > 1 else belt_length", "centre", "belt_length / 2 if belt_length > 1"),
    load("math in place of NumPy", "as_angle(np.sqrt(", "as_angle(math.sqrt(", "speed_limit", r"math\.sqrt", r"np\.sqrt",
         also=(("import numpy as np\n", "import math\n\nimport numpy as np\n"),), placed=False),
    load("a formula with the name of the function that it calls",
         "@formula\ndef length_by_wraps(centre: Any, small_pulley: Any, large_pulley: Any) -> Any:\n    half_wrap = np.arccos(",
         "@formula\ndef arccos(centre: Any, small_pulley: Any, large_pulley: Any) -> Any:\n    half_wrap = arccos(", "arccos",
         also=(("right=length_by_wraps", "right=arccos"),)),
    load("a formula that calls itself", "    return line_mass * GRAVITY * height", "    return hanging_weight(line_mass, GRAVITY * height)",
         "hanging_weight", "itself"),
    load("a function that is none of the known", "np.exp(head_friction * as_number(head_wrap))",
         "np.exp2(head_friction * as_number(head_wrap))", "euler_ratio", "exp2"),
    load("a misspelt function", "np.exp(head_friction * as_number(head_wrap))", "np.epx(head_friction * as_number(head_wrap))",
         "euler_ratio", "epx"),
    load("an unknown name", "np.exp(head_friction * as_number(head_wrap))", "np.exp(head_friction * as_number(wrap))", "euler_ratio",
         "wrap"),
    load("plain code in a formula", "np.exp(head_friction * as_number(head_wrap))",
         "np.exp(head_friction * falling_time(head_friction, head_wrap))", "euler_ratio", "falling_time"),
    load("a misspelt constant of NumPy", "half_wrap = np.arccos", "half_wrap = 0 * np.PI + np.arccos", "length_by_wraps", r"np\.PI"),
    load("a plain number of the module", "return line_mass * GRAVITY * height", "return line_mass * G * height", "hanging_weight", "'G'",
         "constants", also=(("# --- calculation\n", "# --- calculation\n\nG = 9.80665\n"),), placed=False),
    load("a text in a formula", "high=lambda belt_length: belt_length / 2", 'high=lambda belt_length: belt_length / "2"', "centre",
         "\"2\"|'2'"),
    load("an f-string in a formula", "    return line_mass * GRAVITY * height",
         '    note = f"{height}"\n    return line_mass * GRAVITY * height', "hanging_weight", "height"),
    load("a walrus", "high=lambda belt_length: belt_length / 2", "high=lambda belt_length: (half := belt_length / 2)", "centre", "half"),
    load("two names at once", "    return line_mass * GRAVITY * height",
         "    weight, rest = line_mass * GRAVITY * height, 0\n    return weight", "hanging_weight", "weight, rest"),
    load("a name changed in place", "    return line_mass * GRAVITY * height", "    height *= GRAVITY\n    return line_mass * height",
         "hanging_weight", r"height \*="),
    load("an index", "high=lambda belt_length: belt_length / 2", "high=lambda belt_length: belt_length[0] / 2", "centre",
         r"belt_length\[0\]"),
    load("a method", "high=lambda belt_length: belt_length / 2", "high=lambda belt_length: belt_length.clip(0) / 2", "centre", "clip"),
    load("a lambda", "    return line_mass * GRAVITY * height",
         "    weight = lambda mass: mass * GRAVITY * height\n    return weight(line_mass)", "hanging_weight", "lambda"),
    load("print in a formula", "    return line_mass * GRAVITY * height", "    print(height)\n    return line_mass * GRAVITY * height",
         "hanging_weight", "print"),
    load("a caret for a power", "GRAVITY / as_number(head_speed) ** 2", "GRAVITY / as_number(head_speed) ^ 2", "pole_distance", r"\^ 2"),
    load("an integer division", "high=lambda belt_length: belt_length / 2", "high=lambda belt_length: belt_length // 2", "centre", "//"),
    load("a remainder", "high=lambda belt_length: belt_length / 2", "high=lambda belt_length: belt_length % 2", "centre", "%"),
    load("a comparison chain", "(angle > scoop_start) & (angle < scoop_end)", "scoop_start < angle < scoop_end", "is_scooping",
         "scoop_start < angle < scoop_end"),
    load("and in place of &", "(angle > scoop_start) & (angle < scoop_end)", "angle > scoop_start and angle < scoop_end", "is_scooping",
         "angle > scoop_start and angle < scoop_end"),
    load("not in place of ~", "(angle > scoop_start) & (angle < scoop_end)", "not angle < scoop_start", "is_scooping",
         "not angle < scoop_start"),
    load("no brackets around a comparison", "(angle > scoop_start) & (angle < scoop_end)", "angle > scoop_start & angle < scoop_end",
         "is_scooping"),
    load("np.where with one argument", "np.where(is_scooping > 0, scoop_force * 2 * np.pi / (scoop_end - scoop_start), 0 * scoop_force)",
         "np.where(is_scooping > 0)", "scoop_pull", r"np\.where"),
    load("np.where with two arguments", "np.where(is_scooping > 0, scoop_force * 2 * np.pi / (scoop_end - scoop_start), 0 * scoop_force)",
         "np.where(is_scooping > 0, scoop_force * 2 * np.pi / (scoop_end - scoop_start))", "scoop_pull", r"np\.where"),
    load("a constant in another than its SI unit", "return line_mass * GRAVITY * height", "return line_mass * G * height", r"\bg\b", "SI",
         also=(("# --- calculation\n", '# --- calculation\n\nG = Constant(9806.65, "g", "mm/s**2")\n'),
               ("    Chapter,\n", "    Chapter,\n    Constant,\n"),),
         placed=False),
    load("a keyword in a call", "np.ceil((2 * height + np.pi * head_diameter) / bucket_pitch)",
         "np.round(a=(2 * height + np.pi * head_diameter) / bucket_pitch)", "bucket_count", "a="),
    load("too few arguments of a formula", "lambda mass_rate, belt_speed: mass_rate / belt_speed)",
         "lambda mass_rate: normal_force(mass_rate))", "waste_line_mass", "normal_force"),
    load("too many arguments of a function", "np.exp(head_friction * as_number(head_wrap))", "np.exp(head_friction, as_number(head_wrap))",
         "euler_ratio", "exp"),
    load("*args", "def hanging_weight(line_mass: Any, height: Any) -> Any:\n    return line_mass * GRAVITY * height",
         "def hanging_weight(*line_mass: Any) -> Any:\n    return line_mass[0] * GRAVITY * line_mass[1]", "hanging_weight", "line_mass"),
    load("a default of a parameter", "def hanging_weight(line_mass: Any, height: Any)",
         "def hanging_weight(line_mass: Any, height: Any = 2)", "hanging_weight", "default"),
    load("a list as a default", "def hanging_weight(line_mass: Any, height: Any)",
         "def hanging_weight(line_mass: Any, height: Any, seen: Any = [])", "lift_force", "default"),
    load("a formula in place of its name", "right=length_by_wraps", 'right="length_by_wraps"', "length_by_wraps"),
    load("a formula that is called", "right=length_by_wraps", "right=length_by_wraps(1, 2, 3)", "length_by_wraps|centre"),
)


# Dimensions, which the author's test tells. What only numbers of a machine show.

DIMENSIONS = (
    tested("another unit than the formula gives", '"v", "m/s"', '"v", "m"', "belt_speed", "rad/s, declared is m"),
    tested("rad/s declared as Hz", 'discharge.value("pole_distance"',
         'discharge.value("rate", "n", "Hz", "Rate", lambda head_speed: 2 * head_speed)\ndischarge.value("pole_distance"', "rate", "rad",
         "Hz|1/s"),
    tested("an angle declared as a pure number", '"α_1", "deg"', '"α_1", "1"', "small_wrap", "rad",
         also=(('limit="small_wrap", unit="deg"', 'limit="small_wrap", unit="1"'),)),
    tested("degrees forgotten: a pure number in a sine", 'Quantity("α_i", "deg"', 'Quantity("α_i", "1"', "pulley_load", "rad",
         keys={"pulleys": [{"diameter": "400 mm", "journal_diameter": "60 mm"}]}),
    tested("millimetres added as a bare number", "2 * wanted_centre + np.pi", "5 + 2 * wanted_centre + np.pi", "length_wanted"),
    tested("a wrong exponent", "as_number(head_speed) ** 2 * head_diameter / (2 * GRAVITY)",
         "as_number(head_speed) * head_diameter / (2 * GRAVITY)", "froude_number"),
    tested("a factor forgotten", "return line_mass * GRAVITY * height", "return line_mass * GRAVITY", "lift_force|hanging_weight"),
    tested("gravity as a bare number", "return line_mass * GRAVITY * height", "return line_mass * 9.81 * height",
         "lift_force|hanging_weight"),
    tested("an exponential of a force", "np.exp(head_friction * as_number(head_wrap))", "np.exp(lift_force * as_number(head_wrap))",
         "euler_ratio", also=(("lambda head_friction, head_wrap", "lambda lift_force, head_wrap"),)),
    tested("a force added to a length", "lambda slack_pull, circumferential_pull: slack_pull + circumferential_pull",
         "lambda slack_pull, height: slack_pull + height", "tight_pull"),
    tested("unlike quantities compared", "lambda head_diameter, pole_distance: head_diameter < pole_distance",
         "lambda head_diameter, belt_speed: head_diameter < belt_speed", "discharge"),
    tested("a derivative in another unit", '"N/rad"', '"N/s"', "force_slope", "rad"),
    tested("an integral in the curve's unit", '"W", "J"', '"W", "N"', "work"),
    tested("an abscissa's period in another unit", "period=2 * np.pi", 'period="chute_drop"', "angle"),
    tested("breakpoints in another unit than the abscissa", '"angle", "scoop_start", "scoop_end")', '"angle", "scoop_start", "chute_drop")',
         "scooping"),
    tested("an unlike relation proves a root", 'left=m.belt_length', 'left=m.power',
         "centre"),
    tested("a root's end in another unit", "high=lambda belt_length: belt_length / 2", "high=lambda power: power / 2", "centre"),
    tested("degrees bound as a plain number", "lambda head_friction, head_wrap: np.exp(head_friction * as_number(head_wrap))",
         "np.exp(m.head_friction * as_number(180))", "euler_ratio",
         "rad|head_wrap"),
    tested("plain numbers bound where a quantity is needed", "lambda froude_number: froude_number < 1",
         "lambda head_diameter: head_diameter < 1", "not_thrown"),
)

NUMBERS = (
    calc("a division by zero", "circumferential_pull / (euler_ratio - 1)", "circumferential_pull / (euler_ratio - euler_ratio)",
         "slack_needed"),
    calc("an inverse sine beyond its range", "2 * np.arccos((large_pulley - small_pulley)",
         "2 * np.arccos((20 * large_pulley - small_pulley)", "small_wrap"),
    calc("a root of a negative number", "np.sqrt(2 * GRAVITY / head_diameter)", "np.sqrt(-2 * GRAVITY / head_diameter)", "speed_limit"),
    calc("a root without a change of sign", "high=lambda belt_length: belt_length / 2",
         "high=lambda small_pulley, large_pulley: (large_pulley - small_pulley) * 0.6", "centre", "sign"),
    calc("a root whose proof does not hold", "large_pulley * (np.pi - half_wrap)", "large_pulley * (np.pi + half_wrap)",
         "Distance of the shafts", "proof|prove"),
    calc("a part that is not there", 'of="pulley_load", index=0', 'of="pulley_load", index=5', "foot_load", "5|6", "2", code=2),
    calc("an abscissa whose period is zero here", "period=2 * np.pi", 'period="scoop_start"', "angle", keys={"scoop_start": "0 deg"}),
    calc("a count that is not whole", "np.exp(head_friction * as_number(head_wrap))",
         "np.exp(head_friction * as_number(head_wrap)), whole=True", "euler_ratio", "whole"),
    calc("a jump without a breakpoint", 'shaft.breakpoints("scooping", "angle", "scoop_start", "scoop_end")\n', "", "torque|work|scoop"),
    calc("one of two breakpoints forgotten", '"angle", "scoop_start", "scoop_end")', '"angle", "scoop_start")', "torque|work|scoop"),
    calc("a narrow jump without a breakpoint", 'shaft.breakpoints("scooping", "angle", "scoop_start", "scoop_end")\n', "",
         "torque|work|scoop", also=((", per_piece=True", ""),), keys={"scoop_end": "102 deg"}),
    calc("a pick beyond its series", 'series=standard_series("iec_60072_ratings")', "series=(0.1, 0.2)", "motor_power", code=2),
    calc("plain code that gives a wrong shape", "return np.sqrt(2 * drop / GRAVITY) + 0 * speed", "return np.zeros(3)", "fall_time",
         r"\(3,\)"),
    calc("plain code that gives no number", "return np.sqrt(2 * drop / GRAVITY) + 0 * speed", "return np.nan * speed", "fall_time"),
    calc("plain code that gives a text", "return np.sqrt(2 * drop / GRAVITY) + 0 * speed", 'return "long"', "fall_time", "long"),
    calc("plain code that gives nothing", "return np.sqrt(2 * drop / GRAVITY) + 0 * speed", "np.sqrt(2 * drop / GRAVITY)", "fall_time",
         "None"),
    calc("plain code that fails", "return np.sqrt(2 * drop / GRAVITY) + 0 * speed", "return speed.nothing", "nothing", placed=True),
    calc("words that fail", "return f\"buckets that are {told(needed / filling - 1, '%', 2)} greater carry it\"",
         'return "more: " + needed', "str", placed=True, keys={"filling": "50 %"}),
    calc("words that are no text", "return f\"buckets that are {told(needed / filling - 1, '%', 2)} greater carry it\"", "return needed",
         "filling_advice", "text", keys={"filling": "50 %"}),
    calc("a drawing that fails", 'radius = view["head_diameter"] / 2', 'radius = view["head_diametr"] / 2', "figure.*head", "head_diametr",
         kept=True),
    row("calc", "a drawing that gives nothing", "    return [circle(", "    [circle(", "figure.*head", placed=False, kept=True),
    row("report", "a wrong role in a drawing", '(0.0, 0.0), radius, "outline")', '(0.0, 0.0), radius, "outlin")', "figure.*head", "outlin",
         "outline", placed=False, kept=True),
    calc("a drawing with a point that is no number", "circle((0.0, 0.0), radius", "circle((0.0, np.nan), radius", "figure.*head",
         kept=True),
    row("calc", "a shape that is a text", "    return [circle((0.0, 0.0)", '    return ["circle", circle((0.0, 0.0)', "figure.*head",
         placed=False, kept=True),
    calc("a drawing that asks a text of a number", 'view.text("head_diameter")', 'view.text("drum")', "figure.*head", "drum", kept=True),
    row("study", "plain code that fails for some machines of a study", "return np.sqrt(2 * drop / GRAVITY) + 0 * speed",
         "if (speed > 1.25).any():\n        raise RuntimeError('too fast')\n    return np.sqrt(2 * drop / GRAVITY) + 0 * speed", "1 error",
         "too fast", code=0),
)


# Mistakes that gave a wrong number, or another one each time, in silence.

LAST_INPUT = "    n_points: Annotated[int, POINTS] = 360"
NUMPY = "import numpy as np\n"
PYDANTIC = ((NUMPY, f"{NUMPY}from pydantic import AfterValidator, Field, field_validator, model_validator\n"),)
HEIGHT = 'Quantity("H", "m", "Height of lift", gt=0, le=60)]'
THROW = 'discharge.throw = m.belt_speed * m.fall_time, "s_f", "mm", "How far the waste flies meanwhile"'
FALL = "return np.sqrt(2 * drop / GRAVITY) + 0 * speed"
CURVE = "lambda head_diameter, angle: head_diameter / 2 * np.sin(angle))"
PERIOD = "period=2 * np.pi"
LATER = ('discharge["later_{k}"] = computed(lambda speed: k * speed, takes=("fall_time",), method="as given"), "t_{k}", "s", "Later"'
         .replace('"later_{k}"', 'f"later_{k}"').replace('"t_{k}"', 'f"t_{k}"'))

SILENT = (
    load("a step called inputs", THROW, THROW.replace('"throw"', '"inputs"'), "step inputs", "reserved"),
    load("a step called by a word of Python", THROW, THROW.replace('"throw"', '"lambda"'), "step lambda", "reserved"),
    load("a period in degrees", PERIOD, "period=360", "step angle", "the period 360", r"2 \* np\.pi"),
    load("a phase between bare degrees", THROW, 'discharge.phase("falling", "moving", "Falls", "angle", (100, 160))\n' + THROW, "phase falling",
         "goes to 100, a number without a unit", "by its id"),
    load("a phase whose period is a bare number", THROW,
         'discharge.phase("falling", "moving", "Falls", "angle", ("scoop_start", "scoop_end"), period=360)\n' + THROW,
         r"phases\.falling|phase falling", "period=360", "by its id"),
    load("a place of print as a bare number", PERIOD, f"{PERIOD}, shown_at=90", "step angle", "shown_at=90", "by its id"),
    load("a bare number as a breakpoint", '"angle", "scoop_start", "scoop_end")', '"angle", 100, "scoop_end")', "scooping", "100", "each an id"),
    load("plain code that asks the clock", FALL, "import time\n    return 0 * speed + time.time()", "falling_time", "the clock",
         "take it as an input"),
    load("plain code that asks chance", FALL, "return 0 * speed + np.random.rand()", "falling_time", "chance", "take it as an input"),
    load("plain code that reads a file", FALL, 'return 0 * speed + float(open("fall.txt").read())', "falling_time", "a file",
         "when the module is loaded"),
    load("plain code that asks the surroundings", FALL, "import os\n    return 0 * speed + len(os.environ)", "falling_time", "around the program"),
    load("plain code that ends the program", FALL, "import os\n    os._exit(0)", "falling_time", "ends the whole program", "Refusal"),
    load("plain code over a number of a loop", THROW, f"for k in (1, 2):\n    {LATER}\n{THROW}", "takes k of the loop", "partial"),
    load("inputs that a validator changes", LAST_INPUT,
         f'{LAST_INPUT}\n\n    @field_validator("height")\n    @classmethod\n    def half(cls, value):\n        return value / 2',
         "Elevator", r"half\)?, so that another value than the user's may count", "require", also=PYDANTIC, placed=False),
    load("inputs that a validator of all changes", LAST_INPUT,
         f'{LAST_INPUT}\n\n    @model_validator(mode="before")\n    @classmethod\n    def half(cls, data):\n        return data | {{"height": 3.0}}',
         "Elevator", "half", "another value", also=PYDANTIC, placed=False),
    load("inputs that are changed when they are made", LAST_INPUT,
         f'{LAST_INPUT}\n\n    def model_post_init(self, _):\n        object.__setattr__(self, "height", 3.0)',
         "Elevator", "model_post_init", "another value", placed=False),
    load("an input that a validator changes", HEIGHT, HEIGHT.replace("]", ", AfterValidator(lambda value: value / 2)]"), "input height",
         "AfterValidator", "another value", also=PYDANTIC),
    load("an input whose bounds stand beside its quantity", HEIGHT, HEIGHT.replace("]", ", Field(lt=50)]"), "input height", "Lt", "bounds",
         also=PYDANTIC),
    load("a list that may be empty", 'Text("Pulleys that turn the belt, without the head drum")]',
         'Text("Pulleys that turn the belt, without the head drum")] = []', "journal_loss", r"pulleys\.diameter, but pulleys may have no parts",
         r'needs=\("pulleys",\)', placed=False),
    load("a row that stands twice in a table", '{"bare": 0.2, "rubber": 0.3}', '{"bare": 0.2, "rubber": 0.3, "rubber": 0.5}', "'rubber'", "twice",
         "only the last one counts"),
    calc("plain code that changes what it is given", FALL, "speed += 1\n    return np.sqrt(2 * drop / GRAVITY) + 0 * speed", "read-only",
         placed=True),
    calc("plain code that gives short numbers", FALL, "return (100 * speed).astype(np.int8)", "fall_time", "64 bits"),
    calc("plain code that gives single precision", FALL, "return (0 * speed + 1).astype(np.float32)", "fall_time", "64 bits"),
    calc("plain code that gives a truth value for a time", FALL, "return speed > 0", "fall_time", "a number in SI of s"),
    calc("plain code that gives masked numbers", FALL, "return np.ma.masked_greater(speed, 0)", "fall_time", "must return a number"),
    calc("plain code that gives a number beyond all", FALL, "return 10**400", "fall_time", "a number too large to calculate with"),
    calc("plain code that gives complex numbers", FALL, "return speed * 1j", "fall_time", "must return a number"),
    calc("plain code that leaves the program", FALL, "raise SystemExit(0)", "SystemExit", placed=True),
    calc("plain code that calls itself", FALL, "return falling_time(speed, drop)", "RecursionError", placed=True),
    calc("plain code that asks for too much memory", FALL, "return np.ones(10**14)", "MemoryError", placed=True),
    calc("a curve with a pole", CURVE, "lambda head_diameter, angle: head_diameter / 2 * np.tan(angle))", "rim_x", "jumps or has a pole",
         "φ = (90|270)",
         "breakpoints of angle", placed=True),
    calc("an angle that wraps",
         CURVE, "lambda head_diameter, angle: head_diameter / 2 * as_number(np.arctan2(np.sin(angle), np.cos(angle))))", "rim_x",
         "jumps or has a pole", "φ = 180", placed=True),
    calc("a derivative over a corner", "return bucket_load * (GRAVITY * np.cos(angle) - centripetal)",
         "return bucket_load * (GRAVITY * np.abs(np.cos(angle)) - centripetal)", "normal_force", "bends most near φ = (90|270)",
         "breakpoints of angle"),
)

TABLE: tuple[Mistake, ...] = (
    *NAMES, *TWICE, *LAMBDAS, *CALLS, *CHAPTERS, *DECLARED, *INPUTS, *MODULE, *FORMULAS, *DIMENSIONS, *NUMBERS, *SILENT,
)
