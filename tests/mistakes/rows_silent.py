"""Mistakes that gave a wrong number, or another one each time, in silence."""

from __future__ import annotations

from tests.mistakes.rows import calc, load

# fmt: off

LAST_INPUT = "    n_points: Annotated[int, POINTS] = 360"
NUMPY = "import numpy as np\n"
PYDANTIC = ((NUMPY, f"{NUMPY}from pydantic import AfterValidator, Field, field_validator, model_validator\n"),)
HEIGHT = 'Quantity("H", "m", "Height of lift", gt=0, le=60)]'
THROW = 'discharge.value("throw", "s_f", "mm", "How far the waste flies meanwhile", lambda belt_speed, fall_time: belt_speed * fall_time)'
FALL = "return np.sqrt(2 * drop / GRAVITY) + 0 * speed"
CURVE = "lambda head_diameter, angle: head_diameter / 2 * np.sin(angle))"
PERIOD = "period=2 * np.pi"
LATER = ('discharge.computed("later_{k}", "t_{k}", "s", "Later", lambda speed: k * speed, takes=("fall_time",), method="as given")'
         .replace('"later_{k}"', 'f"later_{k}"').replace('"t_{k}"', 'f"t_{k}"'))

SILENT = (
    load("a step with the id of an input", THROW, THROW.replace('"throw"', '"height"'), "step height", "has the id of an input",
         "name the step otherwise"),
    load("a step with the name of a place", THROW, THROW.replace('"throw"', '"press_max_at"'), "press_max",
         "press_max_at as the place of its extreme",
         "name one of them otherwise"),
    load("a step with the name of a count", THROW, THROW.replace('"throw"', '"release_count"'), "release",
         "release_count as the number of its crossings"),
    load("a step with the name of a crossing", THROW, THROW.replace('"throw"', '"release_2"'), "release", "release_2 as one of its crossings"),
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
